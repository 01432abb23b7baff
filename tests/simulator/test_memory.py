import json
import re
from collections.abc import Callable
from pathlib import Path
from time import process_time
from typing import Any

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from i7000 import Model, TypeCode
from i7000.device import CAPACITY, Eeprom, Log, Record, State, factory
from i7000.errors import I7000Error
from i7000.simulator.memory import MemoryFileError, load, save
from i7000.strategies.device import states
from tests.simulator.eeproms import MODULES, eeproms


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "bus.json"


# --- round trips ------------------------------------------------------------------------------------------------------


@pytest.mark.no_cover
@given(st.lists(eeproms(), max_size=3).map(tuple))
def test_what_was_saved_is_loaded(tmp_path_factory: pytest.TempPathFactory, modules: tuple[Eeprom, ...]) -> None:
    path = tmp_path_factory.getbasetemp() / "round-trip.json"

    save(path, modules)

    assert load(path) == modules
    assert [it.firmware.text for it in load(path)] == [it.firmware.text for it in modules]


@pytest.mark.no_cover
@given(states())
def test_what_a_module_remembers_after_what_it_has_heard_is_loaded(
    tmp_path_factory: pytest.TempPathFactory, state: State
) -> None:
    path = tmp_path_factory.getbasetemp() / "heard.json"

    save(path, [state.eeprom])

    assert load(path) == (state.eeprom,)


@pytest.mark.parametrize("model", Model, ids=lambda model: model.value)
def test_the_factory_settings_of_every_model_are_loaded(path: Path, model: Model) -> None:
    save(path, [factory(model)])

    assert load(path) == (factory(model),)


def test_what_is_loaded_is_saved_as_it_was(path: Path) -> None:
    save(path, MODULES)
    text = path.read_text("ascii")

    save(path, load(path))

    assert path.read_text("ascii") == text


def test_a_file_is_for_people(path: Path) -> None:
    save(path, MODULES)
    text = path.read_text("ascii")

    lines = {line.strip().removesuffix(",") for line in text.splitlines()}
    assert lines >= {
        '"version": 1',
        '"model": "M-7019R"',
        '"firmware": "B3.7"',
        '"address": "1F"',
        '"channel_mask": "0000FF"',
        '"type_codes": ["08", "08", "08", "08", "08", "08", "08", "08"]',
        '"line_settings": {"baud_rate": 9600, "character_format": "E81"}',
        '"log": null',
        f'{{"index": 1, "words": "{" ".join(f"{word:04X}" for word in range(16))}", "time": 946684801}}',
    }
    assert text.endswith("}\n")


def test_one_setting_that_changes_is_one_line_of_a_diff_besides_the_crc(path: Path) -> None:
    save(path, MODULES)
    before = path.read_text("ascii").splitlines()

    save(path, (evolve(MODULES[0], cjc_offset=-7), MODULES[1]))

    changed = [new for old, new in zip(before, path.read_text("ascii").splitlines(), strict=True) if old != new]
    assert [line.split(":")[0].strip() for line in changed] == ['"crc"', '"cjc_offset"']


def test_a_full_log_is_saved_and_loaded(path: Path) -> None:
    records = tuple(Record(index, tuple(range(index, index + 16)), index) for index in range(CAPACITY))
    full = evolve(factory(Model.M_7017mC_16), log=Log(records=records))
    save(path, [full])

    assert load(path) == (full,)


# --- edited and damaged files -----------------------------------------------------------------------------------------


def refusal(path: Path, content: str | bytes) -> MemoryFileError:
    """Refuse a file, and leave it as it is."""
    data = content if isinstance(content, bytes) else content.encode()
    path.write_bytes(data)
    with pytest.raises(MemoryFileError) as caught:
        load(path)
    assert data == path.read_bytes()
    place = caught.value.place
    assert str(caught.value).startswith(f"{path} " if place == "the file" else f"{path}: {place}: ")
    return caught.value


def saved(path: Path) -> str:
    save(path, MODULES)
    return path.read_text("ascii")


def test_an_edited_file_is_loaded_without_its_crc(path: Path) -> None:
    edited = re.sub(r'  "crc": "[0-9A-F]{8}",\n', "", saved(path)).replace('"cjc_offset": 0', '"cjc_offset": 5')
    path.write_text(edited)

    assert [it.cjc_offset for it in load(path)] == [5, 5]


def test_the_layout_of_a_file_is_not_in_its_crc(path: Path) -> None:
    path.write_text(json.dumps(json.loads(saved(path)), sort_keys=True))

    assert load(path) == MODULES


def test_a_whole_number_stands_for_a_moment_too(path: Path) -> None:
    edited = re.sub(r'  "crc": "[0-9A-F]{8}",\n', "", saved(path)).replace("946684800.0", "946684800")
    path.write_text(edited)

    assert load(path) == MODULES


def test_a_digit_that_changed_is_noticed(path: Path) -> None:
    text = saved(path)

    error = refusal(path, text.replace('"cjc_offset": 0', '"cjc_offset": 8'))

    assert error.place == "crc"
    assert error.allowed.endswith("or none, if they were changed on purpose")


@given(st.data())
def test_a_byte_that_changed_is_noticed_or_means_nothing(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    path = tmp_path_factory.getbasetemp() / "damaged.json"
    save(path, MODULES)
    whole = path.read_bytes()
    at = data.draw(st.integers(0, len(whole) - 1))
    path.write_bytes(whole[:at] + data.draw(st.binary(min_size=1, max_size=1)) + whole[at + 1 :])

    try:
        loaded = load(path)
    except MemoryFileError:
        return
    assert loaded == MODULES


@given(st.binary(max_size=200))
def test_any_bytes_are_refused_by_one_error(tmp_path_factory: pytest.TempPathFactory, data: bytes) -> None:
    path = tmp_path_factory.getbasetemp() / "any.json"
    path.write_bytes(data)

    with pytest.raises(MemoryFileError):
        load(path)


@given(
    st.recursive(
        st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
        lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
    ),
    st.sampled_from(("modules", "firmware", "type_codes", "line_settings", "log")),
)
def test_any_json_in_the_place_of_a_value_is_refused_or_the_same(
    tmp_path_factory: pytest.TempPathFactory, value: Any, name: str
) -> None:
    path = tmp_path_factory.getbasetemp() / "value.json"
    save(path, MODULES)
    document = json.loads(path.read_text("ascii"))
    (document if name == "modules" else document["modules"][0])[name] = value
    path.write_text(json.dumps(document))

    try:
        loaded = load(path)
    except MemoryFileError:
        return
    assert loaded == MODULES


def test_an_empty_file_is_refused(path: Path) -> None:
    error = refusal(path, "")

    assert (error.place, error.reason, error.allowed) == ("the file", "is empty", "a file with contents")


def test_a_file_of_100_megabytes_is_refused_before_it_is_read(path: Path) -> None:
    with path.open("wb") as file:
        file.truncate(100_000_000)

    with pytest.raises(MemoryFileError) as refused:
        load(path)

    assert str(refused.value) == f"{path} has 100 MB; allowed: 40 MB"


@pytest.mark.parametrize(
    ("digits", "shown"), [("9" * 20, "9" * 20), ("-" + "9" * 19, "-" + "9" * 19), ("1" * 21, "a number of 21 digits")]
)
def test_the_error_for_a_number_of_more_than_20_digits_has_its_length(path: Path, digits: str, shown: str) -> None:
    error = refusal(path, saved(path).replace('"cjc_offset": 0', f'"cjc_offset": {digits}', 1))

    assert error.place == "modules[0].cjc_offset"
    assert error.reason == f"cannot be {shown}"


@pytest.mark.no_cover
def test_a_key_that_is_there_twice_is_found_in_linear_time(path: Path) -> None:
    def seconds(count: int) -> float:
        """The least time of three, with the last of so many keys twice."""
        keys = ", ".join(f'"{number}": 0' for number in range(count))
        path.write_text(f'{{{keys}, "{count - 1}": 0}}')
        times = []
        for _ in range(3):
            began = process_time()
            with pytest.raises(MemoryFileError, match=f"cannot be an object that has '{count - 1}' twice"):
                load(path)
            times.append(process_time() - began)
        return min(times)

    assert seconds(100_000) < 30 * seconds(10_000)


@pytest.mark.parametrize("keep", [1, 100, 500, -3])
def test_a_truncated_file_is_refused(path: Path, keep: int) -> None:
    error = refusal(path, saved(path)[:keep])

    assert error.place.startswith("line ")
    assert error.reason.startswith("is not JSON")


REFUSED: dict[str, tuple[Callable[[str], str | bytes], str, str]] = {
    "trailing garbage": (lambda text: text + "x", "line 75 column 1", "is not JSON (Extra data)"),
    "a byte order mark": (lambda text: "\ufeff" + text, "line 1 column 1", "is not JSON"),
    "UTF-16": (lambda text: text.encode("utf-16"), "byte 0", "is FF"),
    "Latin-1": (lambda text: text.encode().replace(b"7019R", b"7019\xe4"), "byte 111", "is E4"),
    "deep nesting": (lambda _: "[" * 100_000, "the document", "is nested too deep"),
    "a list": (lambda _: "[]", "the document", "cannot be []"),
    "a number": (lambda _: "1", "the document", "cannot be 1"),
    "another format": (lambda text: text.replace("i7000 modules", "modules"), "format", "cannot be 'modules'"),
    "another version": (lambda text: text.replace('"version": 1', '"version": 2'), "version", "cannot be 2"),
    "a version of 1.0": (lambda text: text.replace('"version": 1', '"version": 1.0'), "version", "cannot be 1.0"),
    "a version of true": (lambda text: text.replace('"version": 1', '"version": true'), "version", "cannot be True"),
    "no version": (lambda text: text.replace('  "version": 1,\n', ""), "version", "cannot be None"),
    "no modules": (lambda text: text.replace('"modules"', '"module"'), "the document", "has no 'modules'"),
    "another key": (lambda text: text.replace('"version": 1,', '"version": 1, "x": 1,'), "the document", "has 'x'"),
    "a key twice": (
        lambda text: text.replace('"address": "01",', '"address": "01", "address": "01",'),
        "modules[0]",
        "cannot be an object that has 'address' twice",
    ),
    "modules that are an object": (
        lambda text: re.sub(r'"modules": .*', '"modules": {}}', text, flags=re.DOTALL),
        "modules",
        "cannot be {}",
    ),
    "a module that is null": (
        lambda text: re.sub(r'"modules": .*', '"modules": [null]}', text, flags=re.DOTALL),
        "modules[0]",
        "cannot be None",
    ),
    "another CRC": (lambda text: re.sub('"crc": "[^"]*"', '"crc": null', text), "crc", "cannot be None"),
    "an unknown field": (
        lambda text: text.replace('"log": null', '"log": null, "logs": null'), "modules[0]", "has 'logs'",
    ),
    "a missing field that has a default": (
        lambda text: text.replace('      "cjc_offset": 0,\n', "", 1), "modules[0]", "has no 'cjc_offset'",
    ),
    "a missing field within": (
        lambda text: text.replace('"fast_mode": false, ', "", 1), "modules[0].report_settings", "has no 'fast_mode'",
    ),
    "reserved bits": (
        lambda text: text.replace('"fast_mode"', '"reserved": 0, "fast_mode"', 1),
        "modules[0].report_settings",
        "has 'reserved'",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_a_file_is_refused_with_the_place_and_the_reason(path: Path, case: str) -> None:
    change, place, reason = REFUSED[case]

    error = refusal(path, change(saved(path)))

    assert error.place == place
    assert error.reason.startswith(reason)


VALUES = [
    ('"model": "M-7019R"', '"model": "M-7019"', "model"),
    ('"firmware": "B3.7"', '"firmware": "3.7"', "firmware"),
    ('"firmware": "B3.7"', '"firmware": 3.7', "firmware"),
    ('"type_codes": ["08"', '"type_codes": [8', "type_codes[0]"),
    ('"type_codes": ["08"', '"type_codes": ["8"', "type_codes[0]"),
    ('"type_codes": ["08"', '"type_codes": ["0f"', "type_codes[0]"),
    ('"type_codes": ["08"', '"type_codes": ["1B"', "type_codes"),
    ('"type_codes": ["08"', '"type_codes": ["08", "08"', "type_codes"),
    ('"name": "7019R"', '"name": "7019RRR"', "name"),
    ('"name": "7019R"', r'"name": "7019\u001b"', "name"),
    ('"name": "7019R"', '"name": 7019', "name"),
    ('"protocol": "modbus_rtu"', '"protocol": 1', "protocol"),
    ('"channel_mask": "0000FF"', '"channel_mask": "0001FF"', "channel_mask"),
    ('"channel_mask": "0000FF"', '"channel_mask": "FF"', "channel_mask"),
    ('"channel_offsets": [0', '"channel_offsets": [128', "channel_offsets"),
    ('"channel_offsets": [0', '"channel_offsets": [0.0', "channel_offsets[0]"),
    ('"address": "01"', '"address": 1', "address"),
    ('"address": "01"', '"address": "1"', "address"),
    ('"address": "01"', '"address": "0g"', "address"),
    ('"address": "01"', '"address": "01\\n"', "address"),
    ('"baud_rate": 9600', '"baud_rate": 9601', "line_settings.baud_rate"),
    ('"baud_rate": 9600', '"baud_rate": 9600.0', "line_settings.baud_rate"),
    ('"baud_rate": 9600', '"baud_rate": "9600"', "line_settings.baud_rate"),
    ('"character_format": "N81"', '"character_format": "n81"', "line_settings.character_format"),
    ('"checksum": false', '"checksum": 0', "report_settings.checksum"),
    ('"single_ended": false', '"single_ended": true', "single_ended"),
    ('"single_ended": false', '"single_ended": null', "single_ended"),
    ('"cjc_offset": 0', '"cjc_offset": true', "cjc_offset"),
    ('"cjc_offset": 0', '"cjc_offset": "1"', "cjc_offset"),
    ('"cjc_offset": 0', '"cjc_offset": 1.5', "cjc_offset"),
    ('"cjc_offset": 0', '"cjc_offset": 1e3', "cjc_offset"),
    ('"cjc_offset": 0', '"cjc_offset": 4097', "cjc_offset"),
    ('"cjc_offset": 0', '"cjc_offset": NaN', "cjc_offset"),
    ('"cjc_offset": 0', f'"cjc_offset": {"9" * 5000}', "cjc_offset"),
    ('"cjc_offset": 0', '"cjc_offset": {"a": 1, "a": 1}', "cjc_offset"),
    ('"log": null', '"log": {}', "log"),
    ('"log": null', '"log": []', "log"),
]


@pytest.mark.parametrize(("old", "new", "place"), VALUES, ids=[new[:50] for _, new, _ in VALUES])
def test_a_value_that_no_module_has_is_refused_where_it_stands(path: Path, old: str, new: str, place: str) -> None:
    text = saved(path)
    assert old in text

    error = refusal(path, text.replace(old, new, 1))

    assert error.place == f"modules[0].{place}"
    assert error.allowed


OF_THE_LOG = [
    ('"clock_offset": 946684800.0', '"clock_offset": NaN', "clock_offset"),
    ('"clock_offset": 946684800.0', '"clock_offset": -Infinity', "clock_offset"),
    ('"clock_offset": 946684800.0', '"clock_offset": 1e999', "clock_offset"),
    ('"clock_offset": 946684800.0', '"clock_offset": "0"', "clock_offset"),
    ('"clock_offset": 946684800.0', '"clock_offset": false', "clock_offset"),
    ('"command": "period"', '"command": "PERIOD"', "command"),
    ('"period": [0, 0, 10]', '"period": [0, 0, 60]', "period"),
    ('"period": [0, 0, 10]', '"period": [0, 0]', "period"),
    ('"period": [0, 0, 10]', '"period": "0010"', "period"),
    ('"start": [2000, 1', '"start": [2000, 0', "start"),
    ('"end": [2159, 12', '"end": [2159, 13', "end"),
    ('"read_index": 1', '"read_index": -1', "read_index"),
    ('"last_index": 1', '"last_index": 4294967296', "last_index"),
    ('"words": "0000 0001', '"words": "0000  0001', "records[0].words"),
    ('"words": "0000 0001', '"words": "0000 0001 0002', "records[0].words"),
    ('"words": "0000', '"words": "000a', "records[0].words"),
    ('"time": 946684801', '"time": -1', "records[0].time"),
    ('{"index": 1,', '{"index": 4294967296,', "records[0].index"),
    ('{"index": 1,', '{"index": 1.0,', "records[0].index"),
    ('{"index": 1,', "{", "records[0]"),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "place"), OF_THE_LOG, ids=[new for _, new, _ in OF_THE_LOG])
def test_a_value_that_no_log_has_is_refused_where_it_stands(path: Path, old: str, new: str, place: str) -> None:
    text = saved(path)
    assert old in text

    error = refusal(path, text.replace(old, new, 1))

    assert error.place == f"modules[1].log.{place}"


def test_more_records_than_a_log_has_room_for_are_refused(path: Path) -> None:
    text = saved(path)
    record = re.search(r"\{\"index\".*\}", text)
    assert record

    error = refusal(path, text.replace(record[0], ",".join([record[0]] * (CAPACITY + 1))))

    assert (error.place, error.reason, error.allowed) == (
        "modules[1].log.records",
        "cannot be 1025",
        "0..1024 (manual 3.4.3)",
    )


def test_an_error_names_the_file_the_place_and_the_allowed_values(path: Path) -> None:
    error = refusal(path, saved(path).replace('"cjc_offset": 0', '"cjc_offset": 5000', 1))

    assert str(error) == f"{path}: modules[0].cjc_offset: cannot be 5000; allowed: -4096..4096 (manual 3.4)"
    assert isinstance(error, I7000Error)
    assert isinstance(error, ValueError)


def test_an_error_has_its_reason_if_there_is_one(path: Path) -> None:
    only_i = evolve(factory(Model.I_7018), type_codes=(TypeCode.K,) * 8)
    save(path, [only_i])
    mixed = path.read_text("ascii").replace('["0F"', '["0E"')

    assert "one type for all channels" in str(refusal(path, mixed))


def test_a_missing_file_is_reported(path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        load(path)
