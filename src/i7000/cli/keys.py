"""The keys of a live view: single keys, and commands of `control` that are typed.

Laws: a terminal is left as it was. A process in the background neither reads its terminal nor changes it, which would
stop the process.
"""

import asyncio
import os
import sys
from codecs import getincrementaldecoder
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.text import Text

from i7000.cli.control import LONGEST_LINE, Control
from i7000.cli.faults import faults_words
from i7000.simulator.faults import Faults

__all__ = ["Prompt", "pressed"]

_ESCAPE, _BACKSPACES, _ENTER = "\x1b", "\x08\x7f", "\r\n"
_AT_ONCE = 256
_AGAIN = 1.0
"""The seconds until a process in the background looks again whether it is in the foreground."""


class Prompt:
    """What the keys have done: the command that is being typed, and the last answer."""

    def __init__(self, control: Control, *, power: bool = True, changed: Callable[[], object] = lambda: None) -> None:
        """Make one; `power` is whether there are modules to power, and `changed` is called when `line` changes."""
        self._control = control
        self._power = power
        self.changed = changed
        self._typed: str | None = None
        self._said = ""
        self._faults = Faults()
        """The faults that were switched off."""
        self._tasks: set[asyncio.Task[None]] = set()

    def line(self) -> Text:
        """Return the line to show: what is typed, or the last answer and the keys."""
        if self._typed is not None:
            return Text.assemble((":", "bold"), self._typed, ("_", "dim"), ("  Enter runs it, Esc does not", "dim"))
        text = Text()
        now = faults_words(self._control.line.faults)
        if self._said:
            said = "ok" if self._said == f"ok {now}" else self._said
            text.append(f"{said}  ", "red" if said.startswith("error") else "green")
        if now != "off":
            text.append(f"faults {now}  ", "magenta")
        return text.append(f"q quit  {'p power cycle  ' if self._power else ''}f faults  : command", "dim")

    def press(self, keys: str) -> None:
        """Process keys that were pressed; a sequence that begins with Escape, such as an arrow, is ignored."""
        if keys.startswith(_ESCAPE) and len(keys) > 1:
            return
        for key in keys:
            if self._typed is None:
                self._press(key)
            else:
                self._type(self._typed, key)
        self.changed()

    def _press(self, key: str) -> None:
        self._said = ""
        if key == "q":
            self._control.line.end()
        elif key == "p" and self._power:
            self._run("power-cycle")
        elif key == "f":
            self._switch_faults()
        elif key == ":":
            self._typed = ""

    def _type(self, typed: str, key: str) -> None:
        if key in _ENTER:
            self._typed = None
            if typed.strip():
                self._run(typed)
        elif key == _ESCAPE:
            self._typed = None
        elif key in _BACKSPACES:
            self._typed = typed[:-1] if typed else None
        elif key.isprintable() and len(typed) < LONGEST_LINE:
            self._typed = typed + key

    def _switch_faults(self) -> None:
        """Switch all faults off, or those on again that were switched off."""
        line, off = self._control.line, Faults()
        if line.faults == off == self._faults:
            self._said = "error: there are no faults: type :fault late=0.1"
            return
        line.faults, self._faults = (self._faults if line.faults == off else off), line.faults

    def _run(self, command: str) -> None:
        async def run() -> None:
            self._said = await self._control.answer(command)
            self.changed()

        task = asyncio.get_running_loop().create_task(run())
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)


@contextmanager
def pressed(prompt: Prompt) -> Iterator[None]:
    """Give a prompt the keys that are pressed on the terminal at standard input, which shows none of them."""
    import termios  # noqa: PLC0415 - POSIX only
    import tty  # noqa: PLC0415

    loop, descriptor = asyncio.get_running_loop(), sys.stdin.fileno()
    before = termios.tcgetattr(descriptor)
    decoder = getincrementaldecoder("utf-8")("replace")
    waiting: list[asyncio.TimerHandle] = []

    def begin() -> None:
        waiting.clear()
        if _is_in_foreground(descriptor):
            tty.setcbreak(descriptor, termios.TCSANOW)
            loop.add_reader(descriptor, read)
        else:
            waiting.append(loop.call_later(_AGAIN, begin))

    def read() -> None:
        if not _is_in_foreground(descriptor):
            loop.remove_reader(descriptor)
            waiting.append(loop.call_later(_AGAIN, begin))
            return
        try:
            data = os.read(descriptor, _AT_ONCE)
        except OSError:
            data = b""
        if data:
            prompt.press(decoder.decode(data))
        else:  # The terminal is gone.
            loop.remove_reader(descriptor)

    begin()
    try:
        yield
    finally:
        loop.remove_reader(descriptor)
        for handle in waiting:
            handle.cancel()
        if _is_in_foreground(descriptor):
            termios.tcsetattr(descriptor, termios.TCSANOW, before)


def _is_in_foreground(descriptor: int) -> bool:
    """Return whether this process may read the terminal and change it."""
    try:
        return os.tcgetpgrp(descriptor) == os.getpgrp()
    except OSError:
        return False
