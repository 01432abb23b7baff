"""``i7000 check``."""

import errno
import json
import os
import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from i7000 import Model, spec
from i7000.cli.check_schema import SCHEMA
from i7000.cli.check_screen import Screen
from i7000.cli.check_text import details
from i7000.conformance.checks import STEPS
from i7000.conformance.run import CheckResult
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Verdict
from i7000.host.procedures import Procedure, Snapshot, Wait
from tests.firmwares import FirmwarePort, Lost, Play, played
from tests.terminal import Run, plain, run

__all__ = ["plain", "played", "run"]

VALID = Draft202012Validator(json.loads(SCHEMA))
SIM = "sim:I-7018"
LIES = "dcon/2.38/reply"
"""The check that `lying` does not pass."""

REQUIRED = spec.statements()[LIES].requirement


def lying(frame: bytes, answer: bytes | None) -> bytes | None:
    """Answer a timeout with a sign and a digit too few."""
    return b"!01+9\r" if frame == b"~012\r" else answer


def records(path: Path) -> list[dict[str, Any]]:
    """The lines of a report; all of them are valid, and the last is the end."""
    found = [json.loads(line) for line in path.read_text("ascii").splitlines()]
    for record in found:
        VALID.validate(record)
    assert (found[0]["record"], found[-1]["record"]) == ("run-start", "run-end")
    return found


def verdicts(path: Path) -> dict[str, str]:
    return {record["id"]: record["verdict"] for record in records(path) if record["record"] == "check"}


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of its own."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def steps(monkeypatch: pytest.MonkeyPatch, name: str, made: Callable[[Subject], Procedure[None]]) -> None:
    """Make the steps of a check others."""
    monkeypatch.setattr("i7000.conformance.run.STEPS", {**STEPS, name: made})


# --- exit codes -------------------------------------------------------------------------------------------------------


def test_a_module_without_a_fault_passes(run: Run, here: Path) -> None:
    told = run("check", SIM, "link", "--report", "json=run.jsonl")

    assert (told.code, set(verdicts(here / "run.jsonl").values())) == (0, {"PASS"})
    assert told.out.splitlines()[0] == "link"
    assert told.out.splitlines()[-1] == "4 PASS"


def test_a_failure_is_shown_with_its_bytes_and_how_to_repeat_it(run: Run, played: Play) -> None:
    played(FirmwarePort(lying))
    told = run("check", SIM, LIES, "--seed", "3", "--timeout-scale", "2")

    assert told.code == 1
    assert (
        told.out
        == f"""\
link
  link/alive                               PASS              54 ms  2.24, 3.3.1
dcon
  dcon/2.38/reply                          FAIL              51 ms  2.38
    length at byte 5 of !01+9\\r; allowed: 6 characters: !AAEVV (manual 2.38)
    sent      7E 30 31 32 0D                                    ~012.
    received  21 30 31 2B 39 0D                                 !01+9.
                       ^^ 30 is right
    expected  !01000
    repeated  FAIL, FAIL
    required  {REQUIRED}
    repeat    i7000 check sim:I-7018 dcon/2.38/reply --seed 3 --timeout-scale 2
  dcon/2.38/reply-n1                       PASS             361 ms  2, 2.38
2 PASS, 1 FAIL
"""
    )


def renamed(frame: bytes, answer: bytes | None) -> bytes | None:
    """Acknowledge another name, and keep the one of before."""
    return b"!017018\r" if frame == b"$01M\r" else answer


@pytest.mark.usefixtures("here")
def test_a_failure_of_a_write_shows_the_write_too(run: Run, played: Play) -> None:
    played(FirmwarePort(renamed))
    told = run(
        "check", SIM, "dcon/2.33/set", "--allow", "write",
        *(it for kind in ("json", "html", "junit") for it in ("--report", f"{kind}=run.{kind}")),
    )  # fmt: skip

    assert told.code == 1
    lines = [line.split() for line in told.out.splitlines() if line.startswith("    ")]
    assert [line[0] for line in lines[1:5]] == ["wrote", "answered", "sent", "received"]
    assert [line[-1] for line in lines[2:5]] == ["!01.", "$01M.", "!017018."]
    record = next(it for it in records(Path("run.json")) if it.get("id") == "dcon/2.33/set")
    assert [bytes.fromhex(record[name]) for name in ("wrote", "answered", "sent", "received")] == [
        b"~01OTest 7\r", b"!01\r", b"$01M\r", b"!017018\r",
    ]  # fmt: skip
    assert "<tr><th>wrote</th>" in Path("run.html").read_text("utf-8")
    assert f"wrote: {record['wrote']}" in Path("run.junit").read_text("utf-8")


def test_a_refused_selection_names_the_nearest_check(run: Run) -> None:
    told = run("check", SIM, "link/alife")

    assert (told.code, "near it: link/alive" in told.err) == (2, True)


def test_a_silent_module_is_a_line_error(run: Run) -> None:
    told = run("check", SIM, "--address", "2")

    assert (told.code, "address 02 does not answer" in told.err) == (3, True)


def test_a_port_that_is_not_there_is_a_line_error(run: Run) -> None:
    assert run("check", "/dev/no-such-port").code == 3


def test_a_fault_of_this_program_is_an_error_of_its_check(
    run: Run, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(module: Subject) -> Procedure[None]:
        yield from module.expect(module.sentinel)
        raise ZeroDivisionError("it broke")

    steps(monkeypatch, "link/no-echo", broken)
    told = run("check", SIM, "link", "--report", "json=run.jsonl")

    assert told.code == 4
    assert verdicts(here / "run.jsonl") == {
        "link/alive": "PASS", "link/no-stray-bytes": "PASS", "link/no-echo": "ERROR", "link/prompt": "PASS",
    }  # fmt: skip
    assert "internal error: ZeroDivisionError: it broke (broken, line" in told.out


def test_no_time_decides_nothing(run: Run) -> None:
    told = run("check", SIM, "link", "timing", "--max-time", "0.001s")

    assert (told.code, "the 0.001 s of the run are over" in told.out) == (0, True)


def test_checks_of_the_other_protocol_alone_decide_nothing(run: Run) -> None:
    told = run("check", SIM, "map/coil/reset_status")

    assert told.code == 5
    assert " not applicable: I-7018 does not have what they test" in told.out


def test_what_is_not_allowed_is_counted_with_what_to_allow(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    alone(monkeypatch)
    told = run("check", SIM, "init/switch")

    assert told.code == 5
    assert told.out == "1 SKIP\n  1 not allowed:\n    1 need --allow comm\n"


@pytest.mark.usefixtures("here")
def test_a_pair_whose_negative_half_is_not_allowed_does_not_fail_the_run(run: Run) -> None:
    told = run("check", SIM, "dcon/2.39/timeout", "link", "--allow", "comm", "--i-can-power-cycle")

    assert told.code == 0
    assert "    2 need --allow broadcast\n" in told.out


def alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Select only what is named, not what it needs."""
    monkeypatch.setattr("i7000.conformance.selection._completed", lambda found, _: found)


def test_nothing_that_was_received_decides_nothing(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def deaf(module: Subject) -> Procedure[None]:
        yield from module.wait(0.1)

    steps(monkeypatch, "link/alive", deaf)
    told = run("check", SIM, "link/alive")

    assert told.code == 5
    assert "INCONCLUSIVE" in told.out
    assert "nothing was received" in told.out


def test_a_strange_module_fails_only_if_it_is_strict(run: Run, played: Play) -> None:
    played(FirmwarePort(delay=0.3))
    lenient = run("check", SIM, "link/prompt", "--timeout", "0.5")
    played(FirmwarePort(delay=0.3))

    assert (lenient.code, run("check", SIM, "link/prompt", "--strict", "--timeout", "0.5").code) == (0, 1)


# --- what is left -----------------------------------------------------------------------------------------------------


def test_the_settings_are_in_a_file_before_anything_is_written(run: Run, here: Path, played: Play) -> None:
    found: list[bool] = []

    def seen(wire: bytes) -> bytes:
        found.append((here / "before.json").exists())
        return wire

    played(FirmwarePort(edit=seen))
    told = run("check", SIM, "stateful/settings", "--allow", "write", "--snapshot", "before.json")

    assert (told.code, found[0], found[-1]) == (0, False, True)
    assert Snapshot.from_json((here / "before.json").read_bytes()).name == "7018"
    assert "writes to the EEPROM" in told.out


def test_a_file_that_exists_is_refused_before_anything_is_sent(run: Run, here: Path, played: Play) -> None:
    (here / "before.json").write_text("mine")
    sent: list[bytes] = []

    def seen(wire: bytes) -> bytes:
        sent.append(wire)
        return wire

    played(FirmwarePort(edit=seen))
    told = run("check", SIM, "stateful/settings", "--allow", "write", "--snapshot", "before.json")

    assert (told.code, sent, (here / "before.json").read_text()) == (2, [], "mine")


def test_a_full_disk_ends_the_run_before_anything_is_written(
    run: Run, here: Path, played: Play, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(path: str, text: str) -> None:  # noqa: ARG001
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), path)

    monkeypatch.setattr("i7000.cli.keeping.write_new", full)
    port = FirmwarePort()
    played(port)
    before = port.modules[0].eeprom
    told = run("check", SIM, "--allow", "write")

    assert (told.code, port.modules[0].eeprom == before) == (2, True)
    assert not list(here.iterdir())


def test_a_default_file_has_the_settings(run: Run, here: Path) -> None:
    told = run("check", SIM, "link/alive", "--allow", "write")

    assert told.code == 0
    assert [file.name.startswith("i7000-I-7018-01-") for file in here.iterdir()] == [True]


def changing(module: Subject) -> Procedure[None]:
    """Change the name, and do not change it back."""
    yield from module.send(b"~01OMINE\r")
    raise ZeroDivisionError("it broke")


def test_what_a_broken_check_changed_is_restored(
    run: Run, here: Path, played: Play, monkeypatch: pytest.MonkeyPatch
) -> None:
    port = FirmwarePort()
    played(port)
    steps(monkeypatch, "stateful/settings", changing)
    told = run("check", SIM, "stateful/settings", "link", "--allow", "write", "--report", "json=run.jsonl")
    end = records(here / "run.jsonl")[-1]

    assert told.code == 4
    assert (end["restored"], end["left_changed"], end["silent"]) == (["name"], [], False)
    assert port.kept_name == "7018"


def locked(wire: bytes) -> bytes:
    """Take any name but the one of before."""
    return b"$01ZZZ\r" if wire.startswith(b"~01O7018") else wire


def test_a_module_that_cannot_be_restored_is_told_with_what_to_do(
    run: Run, here: Path, played: Play, monkeypatch: pytest.MonkeyPatch
) -> None:
    played(FirmwarePort(edit=locked))
    steps(monkeypatch, "stateful/settings", changing)
    told = run(
        "check", SIM, "stateful/settings", "init", "--allow", "write", "--snapshot", "a b.json",
        "--report", "json=run.jsonl",
    )  # fmt: skip

    assert told.code == 6
    assert records(here / "run.jsonl")[-1]["left_changed"] == ["name"]
    assert "left changed: name\n" in told.err
    assert "restore it with i7000 restore sim:I-7018 'a b.json'" in told.err


def test_ctrl_c_restores_the_module(run: Run, here: Path, played: Play, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(module: Subject) -> Procedure[None]:
        yield from module.send(b"~01OMINE\r")
        os.kill(os.getpid(), signal.SIGINT)
        yield from module.wait(1.0)

    port = FirmwarePort()
    played(port)
    steps(monkeypatch, "stateful/settings", interrupted)
    told = run("check", SIM, "link/alive", "stateful/settings", "--allow", "write", "--report", "json=run.jsonl")
    end = records(here / "run.jsonl")[-1]

    assert told.code == 130
    assert (end["complete"], end["restored"], port.kept_name) == (False, ["name"], "7018")
    assert "INCOMPLETE: stopped before the end" in told.err


def pressing(times: int) -> Callable[[bytes], bytes]:
    """Press Ctrl-C so often after the name was changed, once for each frame."""
    left = [0]

    def press(wire: bytes) -> bytes:
        if wire.startswith(b"~01OMINE"):
            left[0] = times
        elif left[0]:
            left[0] -= 1
            os.kill(os.getpid(), signal.SIGINT)
        return wire

    return press


def pressed(module: Subject) -> Procedure[None]:
    """Change the name, and press Ctrl-C."""
    yield from module.send(b"~01OMINE\r")
    os.kill(os.getpid(), signal.SIGINT)
    yield from module.wait(1.0)


@pytest.mark.parametrize(
    ("times", "code", "name"),
    [(0, 130, "7018"), (1, 130, "7018"), (2, 6, "MINE"), (9, 6, "MINE")],
)
def test_more_ctrl_c_lose_neither_the_summary_nor_the_exit_code(  # noqa: PLR0913, PLR0917 - fixtures
    run: Run, here: Path, played: Play, monkeypatch: pytest.MonkeyPatch, times: int, code: int, name: str
) -> None:
    port = FirmwarePort(edit=pressing(times))
    played(port)
    steps(monkeypatch, "stateful/settings", pressed)
    shown = Screen.summary

    def summary(*arguments: Any) -> None:
        os.kill(os.getpid(), signal.SIGINT)
        shown(*arguments)

    monkeypatch.setattr(Screen, "summary", summary)
    told = run(
        "check", SIM, "link/alive", "stateful/settings", "--allow", "write", "--report", "json=run.jsonl",
        "--snapshot", "before.json",
    )  # fmt: skip
    end = records(here / "run.jsonl")[-1]

    assert (told.code, port.kept_name) == (code, name)
    assert (end["complete"], end["exit_code"]) == (False, code)
    assert "1 PASS\n" in told.out
    assert "INCOMPLETE: stopped before the end" in told.err
    assert ("press Ctrl-C once more to leave it as it is" in told.err) == bool(times)
    assert ("restore it with i7000 restore sim:I-7018 before.json" in told.err) == (code == 6)


@pytest.mark.parametrize(("times", "code"), [(1, 0), (2, 130)])
def test_ctrl_c_while_a_module_is_compared_at_the_end_does_not_lose_the_summary(
    run: Run, played: Play, monkeypatch: pytest.MonkeyPatch, times: int, code: int
) -> None:
    left = [0]

    def press(wire: bytes) -> bytes:
        if left[0]:
            left[0] -= 1
            os.kill(os.getpid(), signal.SIGINT)
        return wire

    def last(module: Subject) -> Procedure[None]:
        yield from module.expect(module.sentinel)
        left[0] = times

    played(FirmwarePort(edit=press))
    steps(monkeypatch, "link/alive", last)
    told = run("check", SIM, "link/alive")

    assert (told.code, "1 PASS\n" in told.out) == (code, True)


@pytest.mark.parametrize("allow", [(), ("--allow", "write")])
def test_a_port_lost_midway_ends_the_run(
    run: Run, here: Path, played: Play, monkeypatch: pytest.MonkeyPatch, allow: tuple[str, ...]
) -> None:
    code = 6 if allow else 3

    def lost(module: Subject) -> Procedure[None]:
        yield from module.send(b"$01XX\r")

    name = "stateful/settings" if allow else "stateful/reads"
    steps(monkeypatch, name, lost)
    played(FirmwarePort(edit=Lost(b"$01XX")))
    told = run("check", SIM, "link/alive", name, *allow, "--report", "json=run.jsonl")
    end = records(here / "run.jsonl")[-1]

    assert told.code == code
    assert (end["complete"], end["exit_code"], end["left_changed"]) == (False, code, None)
    assert "the port is lost: gone: INCOMPLETE" in told.err
    assert ("restore it with" in told.err) == bool(allow)


@pytest.mark.parametrize("allow", [(), ("--allow", "write")])
def test_a_module_that_falls_silent_ends_with_an_error(
    run: Run, here: Path, played: Play, monkeypatch: pytest.MonkeyPatch, allow: tuple[str, ...]
) -> None:
    died: list[bytes] = []

    def dying(frame: bytes, answer: bytes | None) -> bytes | None:
        died.extend([frame] * frame.startswith(b"$01XX"))
        return None if died else answer

    def last(module: Subject) -> Procedure[None]:
        yield from module.expect(module.sentinel)
        yield from module.send(b"$01XX\r")

    name = "stateful/settings" if allow else "stateful/reads"
    steps(monkeypatch, name, last)
    played(FirmwarePort(dying))
    told = run("check", SIM, name, *allow, "--report", "json=run.jsonl")

    assert (told.code, records(here / "run.jsonl")[-1]["silent"]) == (6 if allow else 3, True)
    assert "the module does not answer any more" in told.err


def test_a_closed_output_restores_the_module_and_ends(
    run: Run, here: Path, played: Play, monkeypatch: pytest.MonkeyPatch
) -> None:
    port = FirmwarePort()
    played(port)

    def closed(*_: object) -> None:
        raise BrokenPipeError

    monkeypatch.setattr("i7000.cli.check_screen.Screen.show", closed)
    told = run("check", SIM, "link/alive", "--report", "json=run.jsonl")

    assert (told.code, records(here / "run.jsonl")[-1]["complete"]) == (141, False)


def test_a_fault_outside_of_checks_restores_the_module(
    run: Run, here: Path, played: Play, monkeypatch: pytest.MonkeyPatch
) -> None:
    played(FirmwarePort())

    def broken(*_: object) -> None:
        raise ZeroDivisionError("it broke")

    monkeypatch.setattr("i7000.cli.check_screen.Screen.show", broken)
    told = run("check", SIM, "link/alive", "--report", "json=run.jsonl")

    assert (told.code, records(here / "run.jsonl")[-1]["exit_code"]) == (4, 4)
    assert "internal error: ZeroDivisionError: it broke: INCOMPLETE" in told.err


@pytest.mark.usefixtures("here")
def test_a_report_that_cannot_be_written_any_more_is_told(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr("i7000.cli.check_stream.write_report", full)
    told = run("check", SIM, "link/alive", "--report", "html=page.html")

    assert told.code == 2
    assert "page.html: No space left on device: this report is not complete" in told.err


def test_a_full_disk_while_the_report_is_written_does_not_end_the_run(run: Run) -> None:
    told = run("check", SIM, "link/alive", "--report", "json=/dev/full")

    assert told.code == 2
    assert "1 PASS" in told.out
    assert "/dev/full: No space left on device: this report is not complete" in told.err


# --- options ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--allow", "harm"), "--allow harm: give write, broadcast, comm, calibration"),
        (("--allow", "comm"), "add --i-can-power-cycle"),
        (("--allow", "calibration"), "add --confirm NAME"),
        (("--allow", "calibration", "--confirm", "7017"), "--confirm 7017: the name of the module is 7018"),
        (("--timeout-scale", "0"), "--timeout-scale 0: give 0.1 to 100"),
        (("--eeprom-writes", "-1"), "--eeprom-writes -1: give 0 to 10000"),
        (("--max-time", "soon"), "--max-time soon"),
        (("--baseline-update",), "--baseline-update needs --baseline FILE"),
        (("--certify", "link"), "--certify checks everything"),
        (("--certify", "--baseline", "known.json"), "--certify checks everything"),
        (("--report", "run.jsonl"), "--report run.jsonl: give KIND=FILE; kinds are json, html"),
        (("--report", "json="), "--report json=: give KIND=FILE"),
        (("--report", "json=a", "--report", "html=./a"), "--report html=./a: another report has this file"),
        (("--report", "json=no-folder/a"), "no-folder/a: No such file or directory"),
        (("--report", "json=a", "--report", "html=b/../a"), "another report has this file"),
        (("--explain", "link/alife"), "i7000: there is no check 'link/alife': "),
        (("--explain", "link/alife"), "near it: link/alive"),
        (("--explain", "link"), "--explain link: give one id"),
        (("--list", "nothing"), "a section of the manual"),
    ],
)
def test_options_that_cannot_be_are_refused(run: Run, here: Path, options: tuple[str, ...], message: str) -> None:
    told = run("check", SIM, *options)

    assert (told.code, here.is_dir()) == (2, True)
    assert message in told.err


def test_a_run_needs_a_target(run: Run) -> None:
    assert (run("check").code, run("check", "--schema").code) == (2, 0)


def test_the_schema_is_printed(run: Run) -> None:
    assert json.loads(run("check", "--schema").out) == json.loads(SCHEMA)


def test_checks_are_listed_and_explained(run: Run) -> None:
    assert run("check", "--list", "link/alive").out.split() == [
        "link/alive", "must", "the", "module", "answers",
    ]  # fmt: skip
    assert run("check", "--explain", "init/switch").out.splitlines()[0] == "init/switch  power-on with the INIT switch"


# --- the baseline -----------------------------------------------------------------------------------------------------


def test_a_baseline_makes_known_failures_pass(run: Run, here: Path, played: Play) -> None:
    codes = []
    for options in (("--baseline-update",), (), ("--quiet",)):
        played(FirmwarePort(lying))
        told = run("check", SIM, LIES, "--baseline", "known.json", *options)
        codes.append(told.code)

    assert codes == [0, 0, 0]
    assert json.loads((here / "known.json").read_text()) == {"schema_version": 1, "failures": {LIES: "FAIL"}}
    assert told.out == "2 PASS, 1 FAIL\n"


def test_an_update_drops_what_passes_and_keeps_what_was_not_run(run: Run, here: Path) -> None:
    baseline(here, {LIES: "FAIL", "link/alive": "FLAKY", "map/coil/reset_status": "WARN"})
    told = run("check", SIM, LIES, "--baseline", "known.json", "--baseline-update")

    assert told.code == 0
    assert json.loads((here / "known.json").read_text())["failures"] == {"map/coil/reset_status": "WARN"}
    assert f"in the baseline, but passed: {LIES}, link/alive" in told.out


def test_a_failure_that_is_worse_than_known_counts(run: Run, here: Path, played: Play) -> None:
    baseline(here, {LIES: "WARN"})
    played(FirmwarePort(lying))

    assert run("check", SIM, LIES, "--baseline", "known.json").code == 1


def baseline(here: Path, failures: object) -> None:
    (here / "known.json").write_text(json.dumps({"schema_version": 1, "failures": failures}))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "this is not a baseline"),
        ("[" * 100_000, "this is not a baseline"),
        ("{}", "this is not a baseline"),
        ('{"schema_version": 1, "failures": []}', "this is not a baseline"),
        ('{"schema_version": 1, "failures": {"link/alive": "PASS"}}', "this is not a baseline"),
        (" " * (1 << 20) + "{}", "this is not a baseline"),
        (
            '{"schema_version": 1, "failures": {"link/alife": "FAIL"}}',
            "there is no check link/alife; did you mean link",
        ),
    ],
)
def test_a_file_that_is_no_baseline_is_refused(run: Run, here: Path, text: str, message: str) -> None:
    (here / "known.json").write_text(text)
    told = run("check", SIM, "link/alive", "--baseline", "known.json")

    assert (told.code, message in told.err) == (2, True)


def test_a_baseline_that_is_not_there_is_refused(run: Run, here: Path) -> None:
    told = run("check", SIM, "link/alive", "--baseline", str(here / "known.json"))

    assert (told.code, "No such file" in told.err) == (2, True)


def test_a_baseline_that_cannot_be_written_is_told(run: Run, here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(path: str, *_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), path)

    monkeypatch.setattr("i7000.cli.checking.write_baseline", full)
    told = run("check", SIM, "link/alive", "--baseline", "known.json", "--baseline-update")

    assert (told.code, here.is_dir(), "known.json: No space left" in told.err) == (2, True, True)


# --- the whole --------------------------------------------------------------------------------------------------------


READS_ONLY = "for observe, memory; not allowed: broadcast, write, comm, calibration; without a statement"


def test_a_certificate_ends_with_one_word_and_what_it_is_for(run: Run, played: Play) -> None:
    passed = run("check", SIM, "--certify", "--quiet")
    cut = run("check", SIM, "--certify", "--quiet", "--max-time", "1s")
    played(FirmwarePort(lying))
    failed = run("check", SIM, "--certify", "--quiet")

    assert [(told.code, told.out.splitlines()[-1]) for told in (passed, cut, failed)] == [
        (0, f"PASSED {READS_ONLY}"), (5, f"UNDECIDED {READS_ONLY}"), (1, f"FAILED {READS_ONLY}"),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("options", "scope"),
    [
        (("write",), "for observe, memory, write; not allowed: broadcast, comm, calibration; without a statement"),
        (
            ("broadcast", "comm", "calibration"),
            "for observe, memory, broadcast, write, comm, calibration; without a statement",
        ),
    ],
)
@pytest.mark.usefixtures("here")
def test_a_certificate_names_what_was_allowed(run: Run, options: tuple[str, ...], scope: str) -> None:
    allow = [it for option in options for it in ("--allow", option)]
    told = run(
        "check", SIM, "--certify", "--quiet", "--max-time", "0.1s", *allow, "--i-can-power-cycle", "--confirm", "7018"
    )

    assert told.out.splitlines()[-1] == f"UNDECIDED {scope}"


def test_two_runs_with_one_seed_give_the_same_report(run: Run, here: Path) -> None:
    for name in ("a", "b"):
        run("check", "sim:I-7018", "stateful", "values", "--allow", "write", "--report", f"json={name}.jsonl")
    found = [timeless(records(here / f"{name}.jsonl")) for name in ("a", "b")]

    assert found[0] == found[1]


def timeless(report: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return [{name: value for name, value in record.items() if name not in ("time", "digest")} for record in report]


def test_the_budget_of_writes_is_kept(run: Run, here: Path, played: Play) -> None:
    port = FirmwarePort()
    played(port)
    told = run(
        "check", SIM, "dcon", "--allow", "write", "--eeprom-writes", "1", "--report", "json=run.jsonl",
    )  # fmt: skip
    end = records(here / "run.jsonl")[-1]

    assert (end["writes"], end["restored"], end["left_changed"]) == (0, [], [])
    assert "the EEPROM writes of the run are used up" in told.out
    assert "0 of at most 1 writes to the EEPROM" in told.out


@pytest.mark.parametrize(
    "target",
    [
        "sim:M-7019R,type=K",
        "sim:I-7018,address=0",
        "sim:I-7018,address=255",
        "sim:M-7018,protocol=dcon,baud=115200",
    ],
)
def test_modules_with_other_settings_pass(run: Run, target: str) -> None:
    options = {"address=0": ("--address", "0"), "address=255": ("--address", "255"), "baud": ("--baud", "115200")}
    given = [it for key, value in options.items() if key in target for it in value]
    told = run("check", target, "link", "frame", *given)

    assert told.code == 0, told.out


def test_a_module_in_init_mode_passes_and_is_named_so(run: Run) -> None:
    told = run("check", "sim:I-7018,init=on,address=5", "link", "frame", "--address", "0")

    assert told.code == 0, told.out
    assert "it is in INIT mode; stored: address 05" in told.err


def test_a_module_in_init_mode_is_not_checked_for_what_begins_outside_of_it(run: Run, here: Path) -> None:
    options = ("--address", "0", "--allow", "comm", "--i-can-power-cycle")
    told = run("check", "sim:I-7018,init=on,address=5", *options)

    assert (told.code, list(here.iterdir())) == (2, [])
    assert "I-7018 at address 00 is in INIT mode" in told.err


def test_the_echo_of_an_adapter_is_dropped(run: Run, played: Play) -> None:
    port = FirmwarePort()
    port.faults = type(port.faults)(echo=True)
    played(port)
    told = run("check", SIM, "link", "--echo")

    assert told.code == 0, told.out


def test_modules_of_both_protocols_on_one_line_are_checked(run: Run) -> None:
    line = "sim:I-7018+M-7018,protocol=rtu"

    assert [run("check", line, "link", "frame", "--address", str(at)).code for at in (1, 2)] == [0, 0]


def test_the_time_of_a_run_is_estimated_at_a_real_port(run: Run, played: Play) -> None:
    played(FirmwarePort())
    told = run("check", "COM9", "link/alive", "--max-time", "1min")
    played(FirmwarePort())

    assert "this takes about 1 s" in told.err
    assert "this takes about 1 s" in run("check", "COM9", "link/alive").err


# --- the terminal -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("file", ["", "1"])
def test_progress_is_drawn_on_a_terminal(run: Run, monkeypatch: pytest.MonkeyPatch, file: str) -> None:
    monkeypatch.setattr("i7000.cli.text.Printer.is_interactive", property(lambda _: True))
    monkeypatch.setenv("FORCE_COLOR", file)
    told = run("check", SIM, "link/prompt", "init/switch")

    assert told.code == 0
    assert "link/prompt" in told.out


def result(received: bytes, right: bytes) -> CheckResult:
    statement = spec.statements()["link/alive"]
    return CheckResult(statement, Verdict.FAIL, sent=b"$", received=received, right=right)


@pytest.mark.parametrize(
    ("received", "right", "words"),
    [
        (
            b"!01",
            b"!0100",
            ["received  21 30 31 ", "         ^^ 30 is missing"],
        ),
        (b"!0100", b"!01", ["         ^^ too many bytes"]),
        (b"!01", b"!01", []),
        (b"!" * 20, b"!" * 18, ["received  " + "21 " * 16, "21 21 21 21", "      ^^ too many bytes"]),
        (b"!" * 16, b"!" * 17, ["received  " + "21 " * 16, " " * 62 + "^^ 21 is missing"]),
        (b"!" * 300, b"", ["and 172 more bytes"]),
    ],
)
def test_a_caret_is_at_the_first_byte_that_is_not_right(received: bytes, right: bytes, words: list[str]) -> None:
    lines = ["".join(text for text, _ in line) for line in details(result(received, right), "again")]

    assert all(any(word.rstrip() in line for line in lines) for word in words), lines
    assert any("^^" in line for line in lines) == any("^^" in word for word in words)
    assert max(map(len, lines)) <= 100


def test_a_module_that_stops_answering_before_the_run_is_told(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def nothing(*_: object) -> Procedure[Snapshot]:
        yield Wait(0.0)
        return Snapshot(Model.I_7018)

    monkeypatch.setattr("i7000.cli.checking.snapshot", nothing)
    told = run("check", SIM, "link/alive")

    assert (told.code, "stopped answering: nothing was checked" in told.err) == (3, True)


def test_a_restoration_that_is_broken_off_is_told(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def stopped(*_: object, **__: object) -> Procedure[None]:
        yield Wait(0.0)
        raise KeyboardInterrupt

    monkeypatch.setattr("i7000.cli.keeping.settle", stopped)
    told = run("check", SIM, "link/alive")

    assert (told.code, "the module could not be restored: stopped" in told.err) == (3, True)
