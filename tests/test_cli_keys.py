"""The keys of the live view."""

import asyncio
import errno
import fcntl
import os
import pty
import subprocess
import termios
from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager, suppress
from select import select
from time import monotonic
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000.cli import keys
from i7000.cli.control import LONGEST_LINE, Control
from i7000.cli.keys import Prompt, pressed
from i7000.cli.operating import module_commands
from i7000.simulator import Change, Faults, Simulator
from tests.simulation import process
from tests.simulator.running import I_7018
from tests.waiting import ENOUGH

HINT = "q quit  p power cycle  f faults  : command"


def prompted(do: Callable[[Simulator, Prompt], Awaitable[Any]], *, power: bool = True) -> Any:
    """What comes of using the prompt of a simulator."""

    async def run() -> Any:
        simulator = Simulator([I_7018])
        return await do(simulator, Prompt(Control(simulator, module_commands(simulator, 0)), power=power))

    return asyncio.run(run())


def shown(*presses: str, faults: Faults = Faults(), power: bool = True) -> list[str]:  # noqa: B008 - frozen
    """The prompt after each press."""

    async def press(simulator: Simulator, prompt: Prompt) -> list[str]:
        simulator.faults = faults
        lines = []
        for pressed_keys in presses:
            prompt.press(pressed_keys)
            for _ in range(5):
                await asyncio.sleep(0)
            lines.append(prompt.line().plain)
        return lines

    found: list[str] = prompted(press, power=power)
    return found


def test_the_keys_are_shown() -> None:
    assert shown("") == [HINT]
    assert shown("", power=False) == ["q quit  f faults  : command"]


def test_a_command_is_typed_run_and_answered() -> None:
    assert shown(":", "fault latx", "\x7fe=0.1", "\r", "\x1b[A", "f") == [
        ":_  Enter runs it, Esc does not",
        ":fault latx_  Enter runs it, Esc does not",
        ":fault late=0.1_  Enter runs it, Esc does not",
        f"ok  faults late=0.1:0.3  {HINT}",
        f"ok  faults late=0.1:0.3  {HINT}",
        HINT,
    ]


@pytest.mark.parametrize("keys", [":fault late=1\x1b", ":f\x7f\x7f", ":\n", ":  \n", "x", "\t"])
def test_what_is_not_entered_has_no_effect(keys: str) -> None:
    *_, last = shown(*keys)

    assert last == HINT


def test_faults_are_switched_off_and_on_again() -> None:
    off, on = shown("f", "f", faults=Faults(late=0.1))

    assert off == HINT
    assert on == f"faults late=0.1:0.3  {HINT}"


def test_without_faults_the_way_to_have_some_is_shown() -> None:
    assert shown("f") == [f"error: there are no faults: type :fault late=0.1  {HINT}"]


def test_power_is_cycled_by_a_key() -> None:
    changed: list[Change] = []

    async def press(simulator: Simulator, prompt: Prompt) -> str:
        simulator.watch = changed.append
        prompt.press("p")
        await asyncio.sleep(0.01)
        return prompt.line().plain

    assert prompted(press) == f"ok  {HINT}"
    assert [it.what for it in changed] == [("power cycle",)]


def test_where_there_are_no_modules_no_power_is_cycled() -> None:
    assert shown("p", power=False) == ["q quit  f faults  : command"]


def test_a_key_ends_the_simulation() -> None:
    async def press(simulator: Simulator, prompt: Prompt) -> None:
        prompt.press("q")
        await asyncio.wait_for(simulator.run(), ENOUGH)

    prompted(press)


def test_a_command_has_an_end() -> None:
    (line,) = shown(":" + "x" * 2000)

    assert line.count("x") == LONGEST_LINE


@given(st.lists(st.text(alphabet=st.characters() | st.sampled_from(":q\r\x1b\x7f"), max_size=20), max_size=10))
def test_any_keys_can_be_pressed(presses: list[str]) -> None:
    for line in shown(*presses):
        assert line


# --- a terminal -------------------------------------------------------------------------------------------------------


@contextmanager
def terminal(monkeypatch: pytest.MonkeyPatch, *, foreground: bool = True) -> Iterator[int]:
    """A terminal at standard input; the value is the end of the person."""
    person, program = pty.openpty()
    monkeypatch.setattr(keys, "_is_in_foreground", lambda _: foreground)
    monkeypatch.setattr(keys, "_AGAIN", 0.01)
    with os.fdopen(program, closefd=False) as stdin:
        monkeypatch.setattr("sys.stdin", stdin)
        try:
            yield person
        finally:
            for descriptor in (person, program):
                with suppress(OSError):
                    os.close(descriptor)


def modes() -> list[Any]:
    import sys  # noqa: PLC0415 - the one of the test

    return termios.tcgetattr(sys.stdin.fileno())


def test_keys_are_read_one_by_one_and_the_terminal_is_left_as_it_was(monkeypatch: pytest.MonkeyPatch) -> None:
    async def press(simulator: Simulator, prompt: Prompt) -> tuple[list[Any], ...]:
        before = modes()
        with pressed(prompt):
            during = modes()
            os.write(person, b"\xe2")
            os.write(person, b"\x98\x83q")
            await asyncio.wait_for(simulator.run(), ENOUGH)
        return before, during, modes()

    with terminal(monkeypatch) as person:
        before, during, after = prompted(press)

    assert not during[3] & (termios.ECHO | termios.ICANON)
    assert during[3] & termios.ISIG
    assert before == after


def test_in_the_background_the_terminal_is_neither_read_nor_changed(monkeypatch: pytest.MonkeyPatch) -> None:
    async def press(simulator: Simulator, prompt: Prompt) -> list[Any]:
        before = modes()
        with pressed(prompt):
            os.write(person, b"x\n")
            await asyncio.sleep(0.05)
            assert modes() == before
            monkeypatch.setattr(keys, "_is_in_foreground", lambda _: True)
            os.write(person, b"q")
            await asyncio.wait_for(simulator.run(), ENOUGH)
            monkeypatch.setattr(keys, "_is_in_foreground", lambda _: False)
            os.write(person, b"f")
            await asyncio.sleep(0.05)
            return [prompt.line().plain]

    with terminal(monkeypatch, foreground=False) as person:
        assert prompted(press) == [HINT]


def test_a_terminal_that_is_gone_is_no_error(monkeypatch: pytest.MonkeyPatch) -> None:
    async def press(_: Simulator, prompt: Prompt) -> None:
        with pressed(prompt):
            os.close(person)
            await asyncio.sleep(0.05)
            monkeypatch.setattr(keys, "_is_in_foreground", lambda _: False)

    with terminal(monkeypatch) as person:
        prompted(press)


def test_a_terminal_that_refuses_to_be_read_is_no_error(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> bytes:
        raise OSError(errno.EIO, "Input/output error")

    async def press(_: Simulator, prompt: Prompt) -> str:
        with pressed(prompt):
            monkeypatch.setattr("i7000.cli.keys.os.read", refuse)
            os.write(person, b"f")
            await asyncio.sleep(0.05)
            return prompt.line().plain

    with terminal(monkeypatch) as person:
        assert prompted(press) == HINT


def test_a_terminal_of_another_program_is_not_in_the_foreground() -> None:
    person, program = pty.openpty()
    try:
        assert not keys._is_in_foreground(program)  # noqa: SLF001 - there is no terminal of our own in a test
    finally:
        os.close(person)
        os.close(program)


def test_in_a_terminal_keys_operate_the_simulation_and_end_it() -> None:
    person, program = pty.openpty()

    def become_foreground() -> None:
        os.setsid()
        fcntl.ioctl(0, termios.TIOCSCTTY, 0)

    ends: dict[str, Any] = {"stdin": program, "stdout": program, "stderr": subprocess.PIPE}
    environment = os.environ | {"TERM": "xterm"}
    with process("--model", "I-7018", "--tcp", "0", preexec_fn=become_foreground, env=environment, **ends) as started:
        before = termios.tcgetattr(program)
        shown_until(person, b": command")
        os.write(person, b":fault late=0.1\r")
        shown_until(person, b"late=0.1:0.3")
        os.write(person, b"p")
        screen = shown_until(person, b"01 I-7018")
        os.write(person, b"q")
        code = started.wait(ENOUGH)
        after = termios.tcgetattr(program)
    os.close(person)
    os.close(program)

    assert b"V_2_5" in screen
    assert (code, before) == (0, after)


def shown_until(person: int, *wanted: bytes) -> bytes:
    """Read what a terminal shows until it has shown something."""
    heard = b""
    deadline = monotonic() + ENOUGH
    while not all(it in heard for it in wanted):
        assert select([person], [], [], max(0.0, deadline - monotonic()))[0]
        heard += os.read(person, 1 << 16)
    return heard
