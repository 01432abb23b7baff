"""``i7000 replay``."""

import inspect
import json
from collections.abc import Callable
from pathlib import Path

import pytest

from i7000 import Model
from i7000.cli.check import check
from i7000.cli.harm import HARMLESS, HarmOptions
from i7000.cli.replay import replay
from i7000.conformance.replay import Replayed
from i7000.host.procedures import Procedure, Snapshot, Wait
from i7000.link import LinkError
from tests.firmwares import FirmwarePort, Play, played
from tests.terminal import Run, plain, run
from tests.test_cli_check import LIES, SIM, lying, records

__all__ = ["plain", "played", "run"]

NAMED = b"~01O"


@pytest.fixture
def report(run: Run, tmp_path: Path) -> str:
    """A report of checks that read, one of them in pieces."""
    path = tmp_path / "run.jsonl"
    assert run("check", SIM, "link", LIES, "timing", "values", "--report", f"json={path}").code == 0
    return str(path)


def test_a_module_that_answers_as_before_is_the_same(run: Run, report: str) -> None:
    told = run("replay", report)

    assert (told.code, told.out.count("\n")) == (0, 1)
    assert told.out.split()[1:3] == ["of", told.out.split()[0]]


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


def test_a_silent_module_is_sent_nothing_of_the_report(run: Run, report: str, played: Play) -> None:
    played(FirmwarePort(lambda _frame, _answer: None))
    told = run("replay", report, SIM, "--timeout-scale", "0.1")

    assert (told.code, told.out) == (3, "")
    assert "does not answer" in told.err


def test_a_module_that_stops_answering_is_sent_nothing(run: Run, report: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def nothing(*_: object) -> Procedure[Snapshot]:
        yield Wait(0.0)
        return Snapshot(Model.I_7018)

    monkeypatch.setattr("i7000.cli.replaying.snapshot", nothing)
    told = run("replay", report)

    assert (told.code, told.out, "stopped answering: nothing was sent" in told.err) == (3, "", True)


def test_a_missing_answer_is_shown(run: Run, report: str, played: Play) -> None:
    played(FirmwarePort(lambda frame, answer: None if frame == b"#01\r" else answer))
    told = run("replay", report, SIM)

    assert told.code == 1
    assert "    received nothing" in told.out.splitlines()


class Counted:
    """What acts when frames with these bytes were sent so many times, and loses one frame."""

    def __init__(self, begins: bytes, times: int, act: Callable[[], object], loses: bytes = b"") -> None:
        self.begins, self.left, self.act, self.loses = begins, times, act, loses

    def __call__(self, data: bytes) -> bytes:
        """Count it, and act."""
        if data.startswith(self.begins):
            self.left -= 1
            if self.left == -1:
                self.act()
        return b"\r" if data == self.loses else data


def lost() -> None:
    raise LinkError("the port is lost: gone")


def stopped() -> None:
    raise KeyboardInterrupt


def test_a_lost_port_is_a_line_error(run: Run, report: str, played: Play) -> None:
    played(FirmwarePort(edit=Counted(b"#01", 0, lost)))

    assert run("replay", report, SIM).code == 3


@pytest.fixture
def written(run: Run, tmp_path: Path) -> str:
    """A report of a check that changes a setting, cut off before it was restored; with the digest of that."""
    path = tmp_path / "run.jsonl"
    options = ("--allow", "write", "--snapshot", str(tmp_path / "before.json"), "--report", f"json={path}")
    assert run("check", SIM, "dcon/2.33/set", *options).code == 0
    return str(path)


def cut(path: str) -> str:
    """Leave out all frames of a report from the second one on that sets something, and its end."""
    lines = Path(path).read_text().splitlines()
    sets = [at for at, line in enumerate(lines) if f'"wire": "{NAMED.hex()}' in line]
    Path(path).write_text("\n".join(lines[: sets[1]] + [line for line in lines if '"check"' in line[:20]]) + "\n")
    return path


def test_what_is_not_allowed_is_not_sent(run: Run, written: str) -> None:
    refused = run("replay", written)

    assert (refused.code, "was not sent: it changes a setting (--allow write)" in refused.err) == (2, True)


def test_what_changes_settings_is_sent_with_the_settings_in_a_file(run: Run, written: str, tmp_path: Path) -> None:
    told = run("replay", written, "--allow", "write", "--snapshot", str(tmp_path / "kept.json"))

    assert (told.code, "restored" in told.out) == (0, False)
    assert json.loads((tmp_path / "kept.json").read_text())["model"] == "I-7018"
    assert f"are in {tmp_path / 'kept.json'}" in told.err


def kept_in(written: str) -> tuple[str, ...]:
    return ("--allow", "write", "--snapshot", str(Path(written).with_name("kept.json")))


def test_what_a_report_leaves_changed_is_restored(run: Run, written: str, played: Play) -> None:
    port = FirmwarePort()
    played(port)
    told = run("replay", cut(written), *kept_in(written))

    assert (told.code, port.kept_name) == (0, "7018")
    assert told.out.splitlines()[-1] == "restored: name"
    assert "INCOMPLETE: the last line is missing" in told.err


def test_writes_end_with_the_budget_and_are_undone(run: Run, written: str, played: Play) -> None:
    port = FirmwarePort()
    played(port)
    told = run("replay", written, *kept_in(written), "--eeprom-writes", "1")

    assert (told.code, port.kept_name) == (2, "7018")
    assert "the budget of 1 writes that change settings is used up" in told.err


@pytest.mark.parametrize(("act", "code"), [(lost, 6), (stopped, 130)])
def test_whatever_ends_a_replay_the_module_is_restored_or_named(
    run: Run, written: str, played: Play, act: Callable[[], object], code: int
) -> None:
    port = FirmwarePort(edit=Counted(NAMED, 1, act))
    played(port)
    told = run("replay", written, *kept_in(written))

    assert told.code == code
    assert (port.kept_name == "7018") is (code != 6)
    assert ("restore it with i7000 restore" in told.err) is (code == 6)


@pytest.fixture
def broken(monkeypatch: pytest.MonkeyPatch) -> Callable[[BaseException], None]:
    """Raise an error when a name was set."""

    def break_with(error: BaseException) -> None:
        def tell(_: object, told: Replayed) -> None:
            if any(wire.startswith(NAMED) for wire in told.sent):
                raise error

        monkeypatch.setattr("i7000.cli.replaying._Replaying._tell", tell)

    return break_with


def test_an_error_of_this_program_ends_a_replay_with_the_module_restored(
    run: Run, written: str, played: Play, broken: Callable[[BaseException], None]
) -> None:
    port = FirmwarePort()
    played(port)
    broken(RuntimeError("broken"))
    told = run("replay", written, *kept_in(written))

    assert (told.code, port.kept_name) == (4, "7018")
    assert "internal error: RuntimeError: broken" in told.err


def test_output_that_cannot_be_written_ends_a_replay_with_the_module_restored(
    run: Run, written: str, played: Play, broken: Callable[[BaseException], None]
) -> None:
    port = FirmwarePort()
    played(port)
    broken(PermissionError(13, "Permission denied", "out"))
    told = run("replay", written, *kept_in(written))

    assert (told.code, port.kept_name) == (2, "7018")


def test_a_module_that_is_left_changed_is_the_exit_code(
    run: Run, written: str, played: Play, broken: Callable[[BaseException], None]
) -> None:
    played(FirmwarePort(edit=Counted(NAMED, 9, lost, b"~01O7018\r")))
    broken(RuntimeError("broken"))
    told = run("replay", written, *kept_in(written))

    assert told.code == 6
    assert "left changed: name" in told.err
    assert "internal error: RuntimeError: broken" in told.err


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--allow", "comm"), "add --i-can-power-cycle"),
        (("--allow", "calibration"), "add --confirm NAME"),
        (("--allow", "calibration", "--confirm", "7017"), "--confirm 7017: the name of the module is 7018"),
        (("--eeprom-writes", "-1"), "--eeprom-writes -1: give 0 to 10000"),
        (("--allow", "write", "--snapshot", "{report}"), "exists: give the name of a new file"),
    ],
)
def test_what_could_do_harm_needs_the_options_of_a_check(
    run: Run, report: str, options: tuple[str, ...], message: str
) -> None:
    told = run("replay", report, *(option.replace("{report}", report) for option in options))

    assert (told.code, message in told.err) == (2, True)


@pytest.mark.parametrize(
    ("target", "message"),
    [
        ("sim:I-7017", "its model is I-7017, not I-7018"),
        ("sim:I-7018,name=OTHER", "its name is OTHER, not 7018"),
        ("sim:M-7018,protocol=rtu", "is not the module of the report"),
    ],
)
def test_another_module_than_that_of_the_report_is_refused(run: Run, report: str, target: str, message: str) -> None:
    told = run("replay", report, target)

    assert (told.code, told.out, message in told.err) == (2, "", True)


def test_an_edited_report_is_sent_only_if_that_is_allowed(run: Run, report: str) -> None:
    path = Path(report)
    path.write_text(path.read_text().replace('"exit_code": 0', '"exit_code": 1'))
    refused, told = run("replay", report), run("replay", report, "--edited")

    assert (refused.code, "give --edited to send it all the same" in refused.err) == (2, True)
    assert (told.code, "changed after it was written" in told.err) == (0, True)


def test_a_report_of_a_given_model_is_replayed_with_that_model(run: Run, report: str) -> None:
    assert run("check", SIM, "link", "--model", "I-7018", "--report", f"json={report}").code == 0

    assert run("replay", report).code == 0


def test_a_report_of_modbus_is_sent_again(run: Run, tmp_path: Path) -> None:
    path = str(tmp_path / "run.jsonl")
    assert run("check", "sim:M-7017", "rtu", "--protocol", "rtu", "--report", f"json={path}").code in (0, 1)
    told = run("replay", path)

    assert told.code == 0, told.out


def test_what_could_do_harm_has_the_same_options_as_in_a_check() -> None:
    options = [inspect.signature(command).parameters["harm"] for command in (check, replay)]

    assert [(it.annotation, it.default) for it in options] == [(HarmOptions, HARMLESS)] * 2


COMM = ("--allow", "comm", "--allow", "broadcast", "--i-can-power-cycle")


def recorded(run: Run, folder: Path, target: str, *checks: str) -> str:
    """A report of checks that change the line settings, or switch the power."""
    path = folder / "run.jsonl"
    told = run("check", target, *checks, *COMM, "--report", f"json={path}", "--snapshot", str(folder / "a.json"))
    assert told.code == 0, told.out
    records(path)
    return str(path)


@pytest.mark.parametrize(
    ("target", "checks", "kinds"),
    [
        ("sim:I-7018", ("init/switch-line", "init/new-address"), {"line", "power"}),
        ("sim:I-7018,baud=19200", ("init/switch-line",), {"line", "power"}),
        ("sim:M-7019R,protocol=dcon", ("init/soft-init",), {"line"}),
        ("sim:M-7017,protocol=rtu", ("rtu/46/06/set", "init/switch-protocol"), {"power"}),
        ("sim:I-7018", ("dcon/2.39/timeout",), set()),
    ],
)
def test_line_settings_and_the_power_change_as_in_the_report(
    run: Run, tmp_path: Path, target: str, checks: tuple[str, ...], kinds: set[str]
) -> None:
    path = recorded(run, tmp_path, target, *checks)
    told = run("replay", path, *COMM, "--snapshot", str(tmp_path / "b.json"))

    assert told.code == 0, told.out
    assert kinds <= {it["record"] for it in records(Path(path))}
    assert int(told.out.split()[0]) > 3


def test_a_report_whose_power_cannot_be_switched_again_is_refused(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = recorded(run, tmp_path, SIM, "init/switch-line")
    monkeypatch.setattr("i7000.link.guarded._OPTIONAL", {"now", "sleep"})
    told = run("replay", path, *COMM, "--snapshot", str(tmp_path / "b.json"))

    assert told.code == 2
    assert f"{path}: init/switch-line, 0." in told.err
    assert "the power was switched off and on then, and this port cannot do that" in told.err


@pytest.mark.parametrize("changed", [("19200", "19201"), ('"N81"', '"N83"'), ("19200", '"19200"')])
def test_line_settings_that_no_module_has_are_damage(run: Run, tmp_path: Path, changed: tuple[str, str]) -> None:
    path = Path(recorded(run, tmp_path, "sim:M-7019R,protocol=dcon", "init/soft-init"))
    lines = [it.replace(*changed) if '"record": "line"' in it else it for it in path.read_text().splitlines()]
    number = 1 + next(at for at, it in enumerate(lines) if it != path.read_text().splitlines()[at])
    path.write_text("\n".join(lines) + "\n")
    told = run("replay", str(path), *COMM)

    assert told.code == 2
    assert f"{path}: line {number}: no line settings of a module: give --edited" in told.err


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
    told = run("replay", report, "--edited", *options)

    assert (told.code, message in told.err) == (2, True)
