"""``i7000 coverage``: what a recorded run has met."""

import json
from collections.abc import Iterable
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from i7000.cli.coverage import SCHEMA
from i7000.recording import Carried, End, Record, Start, text
from tests.simulation import KELVIN, free_port, simulated, talk
from tests.terminal import Run

START = Start("2026-11-30T16:30:00.000000+00:00", "i7000 simulate", "0.1.0", "I-7018")


def recording(path: Path, *records: Record) -> Path:
    path.write_text("".join(f"{text(record)}\n" for record in (START, *records)))
    return path


def exchanges(*pairs: tuple[bytes, bytes]) -> Iterable[Carried]:
    for number, (command, answer) in enumerate(pairs):
        yield Carried(number, command, sent=True)
        yield Carried(number + 0.1, answer, sent=False)


def test_a_run_says_what_it_met_and_what_it_did_not(run: Run, tmp_path: Path) -> None:
    path = recording(
        tmp_path / "run.jsonl",
        *exchanges((b"$01M\r", b"!017018\r"), (b"#01\r", b">" + b"+9999.9" * 8 + b"\r"), (b"$01M\r", b"?01\r")),
        End(9.0),
    )

    told = run("coverage", str(path), "--model", "I-7018,type=K")

    first, never, met, errata, not_asked, *rows = told.out.splitlines()
    assert (told.code, told.err) == (0, "")
    assert first == "2 of 22 commands; 1 of them were refused"
    assert never.startswith("never met: exception, silence, late answer, damaged answer")
    assert met == "met: ?AA 1, over range 1"
    assert errata.startswith("errata: E")
    assert not_asked.startswith("not asked: 2.1 2.4 2.5")
    assert rows == [
        "2.3    #AA                      ReadAnalogInputs             1 asked: 1 answered",
        "2.24   $AAM                     ReadModuleName               2 asked: 1 answered, 1 refused",
    ]


def test_the_faults_of_a_simulation_are_met(run: Run, tmp_path: Path) -> None:
    port, path = free_port(), tmp_path / "run.jsonl"
    simulated(
        run,
        *("--model", KELVIN, "--tcp", str(port), "--fault", "duplicate=1", "--record", str(path)),
        meanwhile=lambda: talk(f"socket://127.0.0.1:{port}", b"#01\r"),
    )

    told = run("coverage", str(path), "--json")

    (record,) = told.records
    Draft202012Validator(json.loads(SCHEMA)).validate(record)
    assert record["kinds"]["answer that comes twice"] == 1
    (row,) = (it for it in record["commands"] if it["asked"])
    assert (row["key"], row["name"], row["answered"]) == ("2.3", "ReadAnalogInputs", 1)


def test_notes_of_bytes_without_a_frame_count(run: Run, tmp_path: Path) -> None:
    path = recording(
        tmp_path / "run.jsonl",
        Carried(0.0, b"$01M\r", sent=True),
        Carried(0.1, b"", sent=False, notes=("the answer is lost",)),
        Carried(1.0, b"$01M\r$01F\r", sent=True),
        End(2.0),
    )

    told = run("coverage", str(path), "--json")

    assert told.records[0]["kinds"]["silence"] == 4
    assert [it["asked"] for it in told.records[0]["commands"] if it["asked"]] == [1, 2]


def test_a_recording_without_an_end_is_damaged(run: Run, tmp_path: Path) -> None:
    path = recording(tmp_path / "run.jsonl", *exchanges((b"$01M\r", b"!017018\r")))

    told = run("coverage", str(path))

    assert told.code == 1
    assert "1 of 43 commands" in told.out
    assert told.err == "i7000: 1 lines are damaged or missing: line 3\n"


@pytest.mark.parametrize("records", [(END := End(0.0),), (Carried(0.0, b"!017018\r", sent=False), END)])
def test_a_recording_without_a_command_has_nothing(run: Run, tmp_path: Path, records: tuple[Record, ...]) -> None:
    told = run("coverage", str(recording(tmp_path / "run.jsonl", *records)))

    assert (told.code, told.err) == (5, "i7000: the recording has no command\n")


def test_an_empty_file_has_nothing(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "run.jsonl"
    path.touch()

    assert run("coverage", str(path)).code == 5


def test_codes_and_what_is_not_understood_are_shown(run: Run, tmp_path: Path) -> None:
    path = recording(
        tmp_path / "run.jsonl",
        *exchanges((bytes.fromhex("010400000002 71cb"), bytes.fromhex("018402c2c1"))),
        Carried(5.0, b"$01A\r", sent=True),
        Carried(6.0, b"$01Q\r", sent=True),
        End(9.0),
    )

    told = run("coverage", str(path))

    assert "exceptions: 02 1" in told.out
    assert "several meanings: 1" in told.out
    assert "not understood, or of other models: 1" in told.out


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((), "give a recording"),
        (("/no/such/file",), "/no/such/file: No such file"),
        ((__file__,), "is not a recording"),
        ((__file__, "--model", "X"), "there is no model 'X'"),
    ],
)
def test_wrong_usage_is_explained(run: Run, arguments: tuple[str, ...], said: str) -> None:
    told = run("coverage", *arguments)

    assert (told.code, told.out) == (2, "")
    assert said in told.err


def test_the_schema_is_shown(run: Run) -> None:
    assert run("coverage", "--schema").out == f"{SCHEMA}\n"
    Draft202012Validator.check_schema(json.loads(SCHEMA))
