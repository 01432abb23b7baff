"""Questions before a change, at a real terminal: Ctrl-C is a key there."""

import io
import os
import pty
import select
import signal
import subprocess
import sys
from pathlib import Path
from threading import Event, Thread, get_ident, main_thread
from time import monotonic

import pytest

from i7000 import Model
from i7000.cli import confirm
from i7000.cli.port import broken_off_by_signals
from i7000.host.procedures import Snapshot
from tests.each import each
from tests.waiting import ENOUGH, until

SIMULATED = "sim:I-7018"
AT_TERMINAL = (
    "import os, sys; os.open(os.ttyname(0), os.O_RDWR); from i7000.cli import main; sys.exit(main(sys.argv[1:]))"
)
"""The command line in a session of its own: the first terminal that it opens is the one whose Ctrl-C it gets."""


def answered(keys: bytes, *arguments: str) -> tuple[int, str]:
    """The exit code, and what the terminal shows, after keys were pressed at the question of a command."""
    person, program = pty.openpty()
    try:
        with subprocess.Popen(  # noqa: S603
            [sys.executable, "-c", AT_TERMINAL, *arguments],
            stdin=program, stdout=program, stderr=program, start_new_session=True,
        ) as started:  # fmt: skip
            try:
                shown = shown_until(person, b"[y/N] ")
                os.write(person, keys)
                code = started.wait(ENOUGH)
            finally:
                started.kill()
        return code, (shown + shown_until(person)).decode()
    finally:
        os.close(person)
        os.close(program)


def shown_until(person: int, last: bytes = b"") -> bytes:
    """What a terminal shows until a text is there; without one, what is there already."""
    shown, deadline = b"", monotonic() + (ENOUGH if last else 0)
    while not last or last not in shown:
        if not select.select([person], [], [], max(0, deadline - monotonic()))[0]:
            assert not last, shown
            break
        shown += os.read(person, 1 << 16)
    return shown


SOON = 5.0
"""Seconds after which a wait that does not end is ended by an answer."""
FUTEX = ("98", "202")
"""The system call in which a thread waits for another one, on the usual processors."""


def waits_for_input() -> bool:
    """Whether the main thread waits in a system call that is not for another thread."""
    call = Path(f"/proc/self/task/{main_thread().native_id}/syscall").read_text(encoding="ascii").split()[0]
    return call not in ("running", *FUTEX)


@pytest.mark.skipif(not Path("/proc/self/syscall").exists(), reason="the system does not show system calls")
def test_a_signal_that_does_not_reach_the_read_ends_the_wait_for_an_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    """A signal that another thread gets is like one that comes just before a read: it interrupts no system call."""
    person, program = pty.openpty()
    ended, missed = Event(), Event()

    def press() -> None:
        until(waits_for_input)
        signal.pthread_kill(get_ident(), signal.SIGINT)
        if not ended.wait(SOON):
            missed.set()
            os.write(person, b"y\n")

    with os.fdopen(program, "r+b", buffering=0) as raw, broken_off_by_signals() as ending:
        monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BufferedReader(raw)))
        presser = Thread(target=press)
        try:
            presser.start()
            with pytest.raises(KeyboardInterrupt), ending.breakable():
                confirm._answer()  # noqa: SLF001
            assert ending.number == signal.SIGINT
            assert not missed.is_set()
        finally:
            ended.set()
            presser.join()
            os.close(person)


@each(
    "arguments",
    [
        ("set", SIMULATED, "address=7"),
        ("send", SIMULATED, "CalibrateSpan", "address=1"),
        ("restore", SIMULATED, "oven.json"),
    ],
)
def test_ctrl_c_at_a_question_ends_the_command_at_once_although_yes_was_typed(
    arguments: tuple[str, ...], tmp_path: Path
) -> None:
    file = tmp_path / "oven.json"
    file.write_text(Snapshot(Model.I_7018, settings={"host_watchdog_timeout": 2.5}).to_json())
    arguments = tuple(str(file) if it == file.name else it for it in arguments)

    code, shown = answered(b"y\x03", *arguments)

    question, _, after = shown.replace("\r", "").partition("[y/N] ")
    assert "address 01: I-7018" in question
    assert code == 130
    assert after.strip("\n") in (
        "",
        "y",
        "^C",
        "y^C",
        "^Cy",
        "y^Cy",
    )  # a terminal discards at Ctrl-C what it has not yet shown
