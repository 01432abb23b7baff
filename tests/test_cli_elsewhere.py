"""Line settings that are not given: found by `i7000 check`."""

import signal
import sys

import pytest

from i7000.conformance.checks import STEPS
from i7000.conformance.subject import Subject
from i7000.host.procedures import Procedure
from tests.firmwares import FirmwarePort, Play, played
from tests.terminal import Run, plain, run

__all__ = ["plain", "played", "run"]

FAST = "sim:M-7018,protocol=dcon,baud=115200,character_format=E81"


@pytest.mark.parametrize(
    ("target", "options", "found"),
    [
        (FAST, (), "address 01 answers at 115200 E81, DCON without a checksum"),
        (FAST, ("--baud", "115200"), "address 01 answers at 115200 E81"),
        (FAST, ("--character-format", "E81"), "address 01 answers at 115200 E81"),
        ("sim:M-7018,protocol=rtu,baud=1200,address=7", ("--address", "7"), "answers at 1200 N81, Modbus RTU"),
        ("sim:I-7018,baud=19200,checksum=true", (), "answers at 19200 N81, DCON with a checksum"),
    ],
)
def test_line_settings_that_are_not_given_are_found(
    run: Run, target: str, options: tuple[str, ...], found: str
) -> None:
    told = run("check", target, "link/alive", *options)

    assert (told.code, told.out.splitlines()[-1]) == (0, "1 PASS")
    assert found in told.err


def test_the_command_that_repeats_a_check_has_the_line_settings_that_were_found(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    def failing(module: Subject) -> Procedure[None]:
        yield from module.expect(module.sentinel)
        raise module.wrong("it is wrong", b"$", b"!", "!")

    monkeypatch.setattr("i7000.conformance.run.STEPS", {**STEPS, "link/alive": failing})
    told = run("check", FAST, "link/alive")

    assert f"repeat    i7000 check {FAST} link/alive --baud 115200 --character-format E81\n" in told.out


@pytest.mark.parametrize(
    ("options", "tried"),
    [
        ((), "at 9600 N81 and at 31 other line settings: 1200 to 115200 baud, N81, N82, E81, O81"),
        (("--baud", "9600"), "at 9600 N81 and at 3 other line settings: 9600 baud, N81, N82, E81, O81"),
        (("--character-format", "N82"), "at 9600 N82 and at 7 other line settings: 1200 to 115200 baud, N82"),
    ],
)
def test_a_silent_module_is_an_error_with_what_was_tried(run: Run, options: tuple[str, ...], tried: str) -> None:
    told = run("check", "sim:I-7018", "--address", "2", *options)

    assert told.code == 3
    assert "address 02 does not answer: " in told.err
    assert f"; tried: DCON without a checksum, DCON with a checksum, Modbus RTU, {tried}\n" in told.err


def test_line_settings_that_are_given_are_not_looked_for(run: Run) -> None:
    told = run("check", FAST, "--baud", "9600", "--character-format", "N81")

    assert (told.code, "other line settings" in told.err) == (3, False)


def test_a_program_has_no_line_settings_to_look_for(run: Run) -> None:
    target = f"exec:{sys.executable} -c 'import sys; sys.stdin.read()'"
    told = run("check", target, "--protocol", "dcon", "--no-checksum", "--timeout", "0.05", "--retries", "0")

    assert (told.code, "other line settings" in told.err) == (3, False)


def test_other_commands_ask_only_at_the_given_line_settings(run: Run) -> None:
    told = run("read", FAST)

    assert (told.code, "other line settings" in told.err) == (3, False)


def test_the_search_says_first_how_long_it_can_take(run: Run) -> None:
    told = run("check", FAST, "link/alive")

    assert "address 01 does not answer at 9600 N81: looking for it at 31 other line settings, up to " in told.err


def test_ctrl_c_ends_the_search(run: Run, played: Play) -> None:
    def interrupted(wire: bytes) -> bytes:
        if port.baudrate != 9600:
            signal.raise_signal(signal.SIGINT)
        return wire

    port = FirmwarePort(lambda *_: None, edit=interrupted)
    played(port)
    told = run("check", "sim:I-7018")

    assert (told.code, port.baudrate) == (130, 115200)
