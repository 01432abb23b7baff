"""Every fuzz target holds for its seeds, for what it once failed on, and for a few inputs of any kind."""

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fuzz import seeds as seeds_module
from fuzz.codec_targets import classes_without_a_command
from fuzz.inputs import HEADER, header, pieces, profile_of
from fuzz.seeds import main, seeds
from fuzz.targets import FOLDER, TARGETS, regressions
from i7000 import Model, Profile, TypeCode, dcon, modbus

pytestmark = pytest.mark.no_cover

MOST_SEEDS = 150
each_target = pytest.mark.parametrize("target", TARGETS)
REGRESSIONS = [
    pytest.param(target, path, id=f"{target}/{path.name}") for target in TARGETS for path in regressions(target)
]


@each_target
def test_a_target_holds_for_its_seeds(target: str) -> None:
    found = seeds(target)

    assert found
    for seed in found[:: max(1, len(found) // MOST_SEEDS)]:
        TARGETS[target].run(seed)


@pytest.mark.parametrize(("target", "path"), REGRESSIONS)
def test_a_target_holds_for_what_it_once_failed_on(target: str, path: Path) -> None:
    TARGETS[target].run(path.read_bytes())


@each_target
@given(st.binary(max_size=40) | st.binary(max_size=40).map(lambda data: data[:HEADER] + b"\x80$01" + data[HEADER:]))
def test_a_target_holds_for_any_bytes(target: str, data: bytes) -> None:
    TARGETS[target].run(data)


@each_target
def test_no_seed_is_longer_than_its_target_takes(target: str) -> None:
    assert max(map(len, seeds(target))) <= TARGETS[target].longest


def test_what_a_target_once_failed_on_is_kept_in_a_folder_of_its_name() -> None:
    folders = {path.name for path in (FOLDER / "regressions").iterdir()}

    assert folders <= set(TARGETS)
    assert REGRESSIONS


def test_every_target_has_a_program_and_every_program_a_target() -> None:
    programs = {
        path.stem.removesuffix("_fuzzer"): path.read_text("utf-8") for path in (FOLDER / "fuzzers").glob("*_fuzzer.py")
    }

    assert set(programs) == set(TARGETS)
    assert [name for name, source in programs.items() if f'main("{name}")' not in source] == []


def test_every_dictionary_is_used_and_has_the_syntax_of_libfuzzer() -> None:
    used = {target.dictionary for target in TARGETS.values()}
    lines = [line for name in used for line in (FOLDER / f"dictionaries/{name}.dict").read_text("utf-8").splitlines()]
    entry = re.compile(r'"(?:[^"\\\x00-\x1f]|\\\\|\\"|\\x[0-9a-f]{2})+"')

    assert used == {path.stem for path in (FOLDER / "dictionaries").iterdir()}
    assert [line for line in lines if line and not line.startswith("#") and not entry.fullmatch(line)] == []


def test_every_message_class_is_among_what_the_decoders_of_responses_are_asked() -> None:
    assert classes_without_a_command() == ()


@pytest.mark.parametrize("model", Model)
def test_the_header_of_a_profile_selects_it(model: Model) -> None:
    types = Profile(model).type_codes or (TypeCode.J,) * Profile(model).channels
    profile = Profile(model, checksum=True, type_codes=types)

    assert profile_of(header(profile)) == profile


def test_every_three_bytes_select_a_profile() -> None:
    profiles = {profile_of(bytes((model, settings, 15))) for model in range(len(Model)) for settings in range(256)}

    assert {profile.model for profile in profiles} == set(Model)
    assert any(profile.single_ended for profile in profiles)
    assert any(profile.legacy_sentinels for profile in profiles)
    assert any(len(set(profile.type_codes)) > 1 for profile in profiles)


@given(st.binary(max_size=400), st.integers(0, 255))
def test_pieces_are_the_data_and_not_many(data: bytes, cut: int) -> None:
    found = list(pieces(data, cut))

    assert b"".join(found) == data
    assert len(found) <= 34


def test_seeds_are_written_as_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(seeds_module, "TARGETS", {"dcon_split": TARGETS["dcon_split"]})

    assert main([str(tmp_path)]) == 0
    written = {path.read_bytes() for path in (tmp_path / "dcon_split").iterdir()}

    assert written == set(seeds("dcon_split"))
    assert capsys.readouterr().out == f"dcon_split: {len(written)} seeds\n"


def test_seeds_need_the_name_of_a_folder(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([]) == 2
    assert capsys.readouterr().err == "python -m fuzz.seeds FOLDER\n"


# --- that the targets notice ------------------------------------------------------------------------------------------


def test_a_decoder_that_raises_another_error_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(frame: bytes, *_: object) -> None:
        raise IndexError(frame)

    monkeypatch.setattr(dcon, "decode_command", fail)

    with pytest.raises(IndexError):
        TARGETS["dcon_command"].run(b"\0\0\0\x80$012")


def test_a_splitter_that_loses_a_byte_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    split = modbus.split
    monkeypatch.setattr(modbus, "split", lambda data, **options: (split(data, **options)[0], b""))

    with pytest.raises(AssertionError):
        TARGETS["modbus_split"].run(b"\x0f\0\0\0\0\5\1\4\0")
