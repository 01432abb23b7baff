"""How a campaign grows past one machine: a shared example database, and corpora that are merged."""

import subprocess
import sys
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path
from unittest import SkipTest

import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from hypothesis.database import DirectoryBasedExampleDatabase

from fuzz.engine import INSTALL
from fuzz.targets import FOLDER
from tests.conftest import examples

ALL = tuple(Phase)


def seen_by(database: object, phases: tuple[Phase, ...]) -> list[bytes]:
    """Run a property that fails for some bytes, with a database, and return the inputs that it was given."""
    seen: list[bytes] = []

    @settings(database=database, phases=phases, derandomize=False, max_examples=500)  # type: ignore[arg-type]
    @given(st.binary())
    def holds(data: bytes) -> None:
        seen.append(data)
        assert b"\xff" not in data

    with suppress(AssertionError, SkipTest):  # skipped if there is no example to replay
        holds()
    return seen


def test_an_example_that_one_machine_found_is_replayed_from_the_shared_database_by_another(tmp_path: Path) -> None:
    shared, own, other = tmp_path / "shared", tmp_path / "own", tmp_path / "other"

    found = seen_by(examples(own, shared, write=True), ALL)
    replayed = seen_by(examples(other, shared), (Phase.reuse,))

    assert b"\xff" in found
    assert b"\xff" in replayed
    assert seen_by(examples(tmp_path / "alone", None), (Phase.reuse,)) == []


def test_a_machine_that_only_reads_the_shared_database_writes_its_own(tmp_path: Path) -> None:
    shared, own = tmp_path / "shared", tmp_path / "own"
    shared.mkdir()

    found = seen_by(examples(own, shared), ALL)

    assert b"\xff" in found
    assert list(shared.rglob("*")) == []
    assert b"\xff" in seen_by(DirectoryBasedExampleDatabase(own), (Phase.reuse,))


@pytest.mark.skipif(find_spec("atheris") is None, reason=INSTALL)
def test_a_corpus_gets_from_another_one_what_is_new_to_it_and_nothing_else(tmp_path: Path) -> None:
    own, other = tmp_path / "own", tmp_path / "other"
    for folder in (own, other):
        folder.mkdir()
    (own / "a").write_bytes(b"\x0f\x00+025.12")
    (other / "the same").write_bytes(b"\x0f\x00+025.13")
    (other / "new").write_bytes(b"\x0f\x02       ")

    command = [sys.executable, "-m", "fuzz.fuzzers.reading_text_fuzzer", "-merge=1", str(own), str(other)]
    subprocess.run(command, cwd=FOLDER.parent, check=True, capture_output=True, timeout=120)  # noqa: S603

    kept = {path.read_bytes() for path in own.iterdir()}
    assert len(kept) > 1
    assert kept <= {path.read_bytes() for folder in (own, other) for path in folder.iterdir()}
