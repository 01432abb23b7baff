"""``i7000 listen --judge``, and ``i7000 listen`` of a file."""

import json
import signal
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from i7000.cli.judge_schema import SCHEMA
from i7000.cli.readers import stamped
from i7000.dissect.timing import Times
from i7000.link import LinkError
from i7000.recording import Carried, End, Record, Start, text
from tests.terminal import Run, Told, plain, run
from tests.test_cli_listen import REQUEST, RESPONSE, listened

__all__ = ["plain", "run"]

BROKEN = b"""\
12:00:01.000 TX $012
12:00:01.020 RX !01050600
12:00:02.000 TX #**
12:00:02.001 TX $01M
12:00:02.030 RX !017018
"""
GOOD = BROKEN.replace(b"02.001", b"02.010")
SHOWN = """\
4    12:00:02.001  $01M
     listen/driver/ask-after-broadcast  driver, address 01  (must; manual 2.2, 2.35)
     A driver waits 2 ms after #** and ~** before the next command.
     1 ms after SynchronizedSampling, line 3: 2 ms needed
driver, no single address: 1 frame, no finding
driver, address 01: 2 frames, 1 finding
     listen/driver/ask-after-broadcast (must)  1
module, address 01: 2 frames, no finding
verdict: broken, 1 finding that count
"""
VALID = Draft202012Validator(json.loads(SCHEMA))


def log(folder: Path, data: bytes, name: str = "bus.log") -> str:
    path = folder / name
    path.write_bytes(data)
    return str(path)


def recorded(folder: Path, *carried: tuple[float, bytes], program: str = "i7000 proxy", end: bool = True) -> str:
    began = Start("2026-11-30T12:00:00+00:00", program, "0", "COM3")
    records: list[Record] = [began, *[Carried(at, wire) for at, wire in carried]]
    data = "".join(f"{text(it)}\n" for it in records + [End(99.0)] * end)
    return log(folder, data.encode(), "bus.jsonl")


def ids(told: Told) -> list[str]:
    """The ids of the findings; every record is valid, and the last is the verdict."""
    for record in told.records:
        VALID.validate(record)
    first, *findings, last = told.records
    assert (first["record"], last["record"], last["exit_code"]) == ("run-start", "run-end", told.code)
    return [record["id"] for record in findings]


def test_findings_and_the_verdict_of_a_log_are_shown(run: Run, tmp_path: Path) -> None:
    told = run("listen", log(tmp_path, BROKEN), "--judge")

    assert (told.code, told.out, told.err) == (1, SHOWN, "")


def test_the_guide_shows_a_finding_as_it_is_printed() -> None:
    guide = (Path(__file__).parents[1] / "docs" / "judge_a_line.md").read_text("utf-8")

    assert "".join(SHOWN.splitlines(keepends=True)[:4]) in guide


def test_a_good_log_is_kept(run: Run, tmp_path: Path) -> None:
    told = run("listen", log(tmp_path, GOOD), "--judge")

    assert (told.code, told.out.splitlines()[-1]) == (0, "verdict: kept")


def test_findings_are_records(run: Run, tmp_path: Path) -> None:
    path = log(tmp_path, BROKEN)
    told = run("listen", path, "--judge", "--json")

    assert ids(told) == ["listen/driver/ask-after-broadcast"]
    assert told.records[0]["target"] == path
    assert told.records[1] | {"requirement": "", "what": ""} == {
        "record": "finding", "id": "listen/driver/ask-after-broadcast", "side": "driver", "address": 1, "level": "must",
        "sections": ["2.2", "2.35"], "errata": [], "requirement": "", "what": "", "number": 4, "line": 4,
        "time": "12:00:02.001", "protocol": "dcon", "frame": "$01M", "wire": "2430314d0d",
    }  # fmt: skip
    assert (told.records[2]["verdict"], told.records[2]["frames"]) == ("broken", 5)


@pytest.mark.parametrize("data", [b"", b"nothing here\n", b"12:00:01 RX !01050600\n"])
def test_nothing_that_can_be_judged_is_no_success(run: Run, tmp_path: Path, data: bytes) -> None:
    told = run("listen", log(tmp_path, data), "--judge")
    records = run("listen", log(tmp_path, data), "--judge", "--json")

    assert (told.code, told.out.splitlines()[-1]) == (5, "verdict: nothing was heard that could be judged")
    assert (ids(records), records.records[-1]["verdict"]) == ([], "nothing")


def test_findings_of_other_levels_count_only_if_you_are_strict(run: Run, tmp_path: Path) -> None:
    path = log(tmp_path, b"12:00:01.000 $012\n12:00:01.500 !01050600\n")

    told, strict = run("listen", path, "--judge"), run("listen", path, "--judge", "--strict")

    assert (told.code, told.out.splitlines()[-1]) == (0, "verdict: kept, 1 finding of other levels")
    assert (strict.code, strict.out.splitlines()[-1]) == (1, "verdict: broken, 1 finding that count")
    assert run("listen", path, "--judge", "--strict", "--timeout", "0.6").code == 0


def test_only_the_wanted_address_is_judged(run: Run, tmp_path: Path) -> None:
    path = log(tmp_path, BROKEN.replace(b"$01M", b"$02M").replace(b"!017018", b"!027018"))

    assert ids(run("listen", path, "--judge", "--json", "--address", "1")) == []
    assert ids(run("listen", path, "--judge", "--json", "--address", "2")) == ["listen/driver/ask-after-broadcast"]


def test_a_recording_is_judged_byte_by_byte(run: Run, tmp_path: Path) -> None:
    pieces = [(1.0, REQUEST[:4]), (1.005, REQUEST[4:]), (1.1, RESPONSE)]
    path = recorded(tmp_path, *pieces)

    assert ids(run("listen", path, "--judge", "--json", "--baud", "9600")) == ["listen/driver/gap-in-request"]
    told = run("listen", path, "--judge")
    assert "not judged, because the times cannot tell:\n     listen/driver/gap-before-request  1\n" in told.out


def test_what_a_listener_recorded_has_the_times_of_an_adapter(run: Run, tmp_path: Path) -> None:
    pieces = [(1.0, b"#**\r"), (1.001, b"$012\r"), (1.1, b"!01050600\r"), (2.0, b"$012\r"), (2.0, b"!01050600\r")]
    found = run("listen", recorded(tmp_path, *pieces), "--judge")
    lumps = run("listen", recorded(tmp_path, *pieces, program="i7000 listen"), "--judge")

    assert found.code == 1
    assert lumps.code == 0
    assert "withdrawn: 1 finding: the adapter collects bytes" in lumps.out


def test_a_capture_is_judged(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = str(tmp_path / "bus.pcapng")
    listened(run, monkeypatch, (0.5, b"#**\r"), (0.001, b"$012\r"), (0.1, b"!01050600\r"), options=("--pcap", path))

    assert ids(run("listen", path, "--judge", "--json")) == ["listen/driver/ask-after-broadcast"]


def test_a_damaged_file_is_judged_as_far_as_it_goes(run: Run, tmp_path: Path) -> None:
    path = recorded(tmp_path, (1.0, b"$012\r"), (1.1, b"!01050600\r"), end=False)
    told, records = run("listen", path, "--judge"), run("listen", path, "--judge", "--json")

    assert told.code == 1
    assert "verdict: kept" in told.out
    assert "damaged: 1 place of the file" in told.out
    assert "the recording has no end" in told.err
    assert (ids(records), records.records[-1]["damaged"]) == ([], 1)


def test_of_a_file_full_of_damage_the_first_places_are_named(run: Run, tmp_path: Path) -> None:
    began = text(Start("2026-11-30T12:00:00+00:00", "i7000 proxy", "0", "COM3"))
    told = run("listen", log(tmp_path, "\n".join([began, *["damage"] * 100]).encode()), "--judge")

    assert (told.code, len(told.err.splitlines())) == (5, 20)
    assert "damaged: 101 places of the file" in told.out


def test_noise_is_counted(run: Run, tmp_path: Path) -> None:
    told = run("listen", recorded(tmp_path, (1.0, b"$012\r"), (1.1, b"!01050600\r"), (3.0, b"\xff\xfe")), "--judge")

    assert told.code == 0
    assert "not judged: 1 piece of noise, or answers before the first command" in told.out


# --- at a port --------------------------------------------------------------------------------------------------------


def test_a_port_is_judged_until_the_end(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    coming = ((0.5, b"#**\r"), (0.0005, b"$014\r"), (0.1, b"?01\r"))
    told = listened(run, monkeypatch, *coming, options=("--judge", "--json"))

    assert ids(told) == ["listen/driver/ask-after-broadcast"]
    assert (told.code, told.records[1]["time"]) == (1, "2027-01-15T08:00:00.750500+00:00")


def test_a_port_with_nothing_on_it_is_no_success(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    assert listened(run, monkeypatch, options=("--judge",)).code == 5


def test_ctrl_c_ends_with_the_verdict(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    coming = ((0.5, b"$012\r"), (0.1, b"!01050600\r"), (0.125, signal.SIGINT))
    told = listened(run, monkeypatch, *coming, options=("--judge", "--json"))

    assert (ids(told), told.code, told.records[-1]["verdict"]) == ([], 130, "kept")


def test_a_lost_port_ends_with_the_verdict(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    coming = ((0.5, b"$01m\r"), (0.5, LinkError("COM3: the port is lost: gone")))
    told = listened(run, monkeypatch, *coming, options=("--judge", "--json"))

    assert (ids(told), told.code) == (["listen/driver/lower-case"], 3)


# --- files without a judgement, options -------------------------------------------------------------------------------


def test_a_file_is_shown_as_a_port_is(run: Run, tmp_path: Path) -> None:
    told = run("listen", log(tmp_path, BROKEN), "--json", "--only", "ModuleName")

    assert [record["name"] for record in told.records] == ["ModuleName"]
    assert told.code == 0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--seconds", "5"), "is a file: --record, --pcap and --seconds are for a port"),
        (("--record", "other.jsonl"), "is a file: --record, --pcap and --seconds are for a port"),
        (("--timeout", "1"), "--timeout and --strict are for --judge"),
        (("--strict",), "--timeout and --strict are for --judge"),
        (("--judge", "--timeout", "0"), "--timeout 0: give more than 0, at most 60 seconds"),
        (("--judge", "--timeout", "nan"), "--timeout nan: give more than 0, at most 60 seconds"),
        (("--judge", "--only", "ModuleName"), "--only is for frames; --judge shows findings"),
    ],
)
def test_options_that_do_not_fit_are_refused(run: Run, tmp_path: Path, options: tuple[str, ...], message: str) -> None:
    told = run("listen", log(tmp_path, GOOD), *options)

    assert told.code == 2
    assert message in told.err
    assert not (tmp_path / "other.jsonl").exists()


def test_the_schema_of_the_findings_is_printed(run: Run) -> None:
    assert json.loads(run("listen", "--judge", "--schema").out) == json.loads(SCHEMA)


@pytest.mark.parametrize(
    ("time", "times"),
    [
        ("00:00:01", Times(1.0, 1.0, resolution=1.0)),
        ("0001-01-01 00:00:01,5", Times(86401.5, 86401.5, resolution=0.1)),
        ("2026-13-01T00:00:01.5", None),
        ("1e99 s", None),
    ],
)
def test_the_time_of_a_log_is_as_fine_as_it_is_written(time: str, times: Times | None) -> None:
    assert stamped(time) == times
