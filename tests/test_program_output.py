"""What the program ``i7000`` does with its output: large pieces, closed pipes, full disks, exit codes."""

import io
import os
import pty
import signal
import subprocess
import sys
from collections.abc import Callable

import pytest

from i7000.cli import app
from i7000.cli.text import Printer
from i7000_cli import CLOSED, FAILED, INTERRUPTED, program, roomy

PROGRAM = (sys.executable, "-m", "i7000_cli")

# --- pieces -----------------------------------------------------------------------------------------------------------


def test_output_is_written_in_large_pieces() -> None:
    reading, writing = os.pipe()
    os.set_blocking(reading, False)
    with os.fdopen(writing, "w", encoding="latin-1", errors="backslashreplace") as file:
        output = roomy(file)
        assert output
        output.write("\xe9\u20ac\n" * 5000)
        with pytest.raises(BlockingIOError):
            os.read(reading, 1 << 16)
        output.flush()

        assert os.read(reading, 1 << 16) == b"\xe9\\u20ac\n" * 5000
    os.close(reading)


def test_output_on_a_terminal_is_shown_line_by_line() -> None:
    end, near = pty.openpty()
    with os.fdopen(near, "w", encoding="ascii") as terminal:
        assert roomy(terminal) is terminal
    os.close(end)


@pytest.mark.parametrize("output", [None, io.StringIO()])
def test_output_that_is_no_file_of_the_system_stays(output: io.StringIO | None) -> None:
    assert roomy(output) is output


# --- output that nobody reads -----------------------------------------------------------------------------------------


def written_to(descriptor: int, write: Callable[[io.TextIOWrapper], int]) -> int:
    """Run a program whose output is a descriptor, which is closed then."""
    with pytest.MonkeyPatch.context() as patched, open(descriptor, "w", encoding="ascii") as output:
        patched.setattr(sys, "stdout", output)
        return program(lambda: write(output))


def test_what_was_printed_before_ctrl_c_is_written(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "_exit", sys.exit)
    reading, writing = os.pipe()

    def decode_and_be_interrupted(_: object) -> int:
        Printer().record({}, [[("what was decoded", "")]])
        os.kill(os.getpid(), signal.SIGINT)
        return 0

    with pytest.raises(SystemExit):
        written_to(writing, decode_and_be_interrupted)

    assert os.read(reading, 100) == b"what was decoded\n"
    os.close(reading)


def some(output: io.TextIOWrapper) -> int:
    output.write("some")
    return 0


def test_a_pipe_that_nobody_reads_has_an_exit_code_of_its_own() -> None:
    read, write = os.pipe()
    os.close(read)

    assert written_to(write, some) == CLOSED


def test_a_full_disk_is_a_failure(capsys: pytest.CaptureFixture[str]) -> None:
    code = written_to(os.open("/dev/full", os.O_WRONLY), some)

    assert (code, capsys.readouterr().err) == (FAILED, NO_ROOM)


def test_a_failure_that_was_reported_is_not_reported_again(capsys: pytest.CaptureFixture[str]) -> None:
    code = written_to(os.open("/dev/full", os.O_WRONLY), lambda output: some(output) or FAILED)

    assert (code, capsys.readouterr().err) == (FAILED, "")


FRAMES = ["$012\\r"] * 300
NO_ROOM = "the output cannot be written: No space left on device\n"


@pytest.mark.parametrize(
    "arguments",
    [
        ("commands",),
        ("--help",),
        ("decode", "$012"),
        ("decode", "$01"),
        ("decode", *FRAMES),
        ("registers", "--model", "M-7018"),
    ],
    ids=lambda it: " ".join(it)[:20],
)
def test_a_command_whose_output_finds_no_room_says_so_once(arguments: tuple[str, ...]) -> None:
    with open("/dev/full", "wb") as full:  # noqa: PTH123
        ended = subprocess.run(  # noqa: S603 - ourselves
            [*PROGRAM, *arguments], stdout=full, stderr=subprocess.PIPE, check=False
        )

    assert ended.returncode == FAILED
    assert ended.stderr.count(b"No space left on device") == 1
    assert b"Traceback" not in ended.stderr


def test_a_full_disk_for_output_and_errors_alike_is_a_failure() -> None:
    with open("/dev/full", "wb") as full:  # noqa: PTH123
        assert subprocess.call([*PROGRAM, "commands"], stdout=full, stderr=full) == FAILED  # noqa: S603 - ourselves


@pytest.mark.parametrize("arguments", [("commands",), ("--help",), ("decode", "$012")], ids=lambda it: it[0])
def test_a_command_whose_output_is_not_read_ends_without_a_word(arguments: tuple[str, ...]) -> None:
    read, write = os.pipe()
    os.close(read)

    ended = subprocess.run(  # noqa: S603 - ourselves
        [*PROGRAM, *arguments], stdout=write, stderr=subprocess.PIPE, check=False
    )
    os.close(write)

    assert (ended.returncode, ended.stderr) == (CLOSED, b"")


@pytest.mark.parametrize(
    ("error", "code"), [(BrokenPipeError(), CLOSED), (SystemExit(1), CLOSED), (KeyboardInterrupt(), INTERRUPTED)]
)
def test_what_ends_a_command_has_an_exit_code(
    error: BaseException, code: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def end(*_: object, **__: object) -> None:
        raise error

    monkeypatch.setattr(app, "app", end)

    assert app.run(["commands"]) == code
    assert capsys.readouterr() == ("", "")


@pytest.mark.parametrize(("arguments", "code"), [(["commands"], 0), (["decode", "$01"], 1)])
def test_a_command_without_an_output_writes_nothing(
    arguments: list[str], code: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "stdout", None)

    assert program(lambda: app.run(arguments)) == code


def test_a_terminal_that_is_gone_is_no_other_error(monkeypatch: pytest.MonkeyPatch) -> None:
    with open("/dev/full", "w", encoding="ascii") as full:  # noqa: PTH123
        monkeypatch.setattr(sys, "stderr", full)

        assert app.run(["decode", "--file", "/no/such/file"]) == 2
        with pytest.raises(OSError, match="No space"):
            full.flush()
        monkeypatch.undo()
        os.dup2(os.open(os.devnull, os.O_WRONLY), full.fileno())
