"""``i7000 replay``."""

import json
from pathlib import Path

import pytest

from tests.firmwares import FirmwarePort, Lost, Play, played
from tests.terminal import Run, plain, run
from tests.test_cli_check import LIES, SIM, lying

__all__ = ["plain", "played", "run"]


@pytest.fixture
def report(run: Run, tmp_path: Path) -> str:
    """A report of checks that read, one of them in pieces."""
    path = tmp_path / "run.jsonl"
    assert run("check", SIM, "link", LIES, "timing", "values", "--report", f"json={path}").code == 0
    return str(path)


def test_a_module_that_answers_as_before_is_the_same(run: Run, report: str) -> None:
    told = run("replay", report)

    assert (told.code, told.out.split()[:2], told.out.count("\n")) == (0, [told.out.split()[2], "of"], 1)


def test_another_answer_is_shown(run: Run, report: str, played: Play) -> None:
    played(FirmwarePort(lying))
    told = run("replay", report, SIM)

    assert told.code == 1
    assert told.out.splitlines()[:4] == [
        LIES,
        "    sent     7e 30 31 32 0d",
        "    recorded 21 30 31 30 30 30 0d",
        "    received 21 30 31 2b 39 0d",
    ]


def test_a_silent_module_answers_nothing_of_the_report(run: Run, report: str, played: Play) -> None:
    played(FirmwarePort(lambda _frame, _answer: None))
    told = run("replay", report, SIM, "--timeout-scale", "0.1")

    assert told.code == 1
    assert "    received nothing" in told.out.splitlines()


def test_a_lost_port_is_a_line_error(run: Run, report: str, played: Play) -> None:
    played(FirmwarePort(edit=Lost(b"~012")))

    assert run("replay", report, SIM).code == 3


def test_what_is_not_allowed_is_not_sent(run: Run, tmp_path: Path) -> None:
    path = str(tmp_path / "run.jsonl")
    options = ("--allow", "write", "--snapshot", str(tmp_path / "before.json"), "--report", f"json={path}")
    assert run("check", SIM, "stateful/settings", *options).code == 0
    refused = run("replay", path)

    assert (refused.code, "was not sent: it changes a setting (--allow write)" in refused.err) == (2, True)
    assert run("replay", path, "--allow", "write").code == 0


def test_a_report_of_modbus_is_sent_again(run: Run, tmp_path: Path) -> None:
    path = str(tmp_path / "run.jsonl")
    assert run("check", "sim:M-7017", "rtu", "--protocol", "rtu", "--report", f"json={path}").code in (0, 1)
    told = run("replay", path)

    assert told.code == 0, told.out


def test_a_report_without_frames_decides_nothing(run: Run, report: str) -> None:
    path = Path(report)
    first = path.read_text().splitlines()[0]
    path.write_text(first + "\n")

    assert run("replay", report).code == 5


@pytest.mark.parametrize(
    ("change", "options", "message"),
    [
        (None, ("--timeout-scale", "1000"), "--timeout-scale 1000: give 0.1 to 100"),
        ({"record": "other"}, (), "it does not begin with a run-start"),
        ({"target": "nothing://"}, (), "nothing://"),
    ],
)
def test_what_cannot_be_replayed_is_refused(
    run: Run, report: str, change: dict[str, str] | None, options: tuple[str, ...], message: str
) -> None:
    path = Path(report)
    first, *rest = path.read_text().splitlines()
    path.write_text("\n".join([json.dumps(json.loads(first) | (change or {})), *rest]) + "\n")
    told = run("replay", report, *options)

    assert (told.code, message in told.err) == (2, True)
