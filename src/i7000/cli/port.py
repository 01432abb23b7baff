"""The commands that open a port: their options, and how they end at Ctrl-C.

`Ending` remembers a signal, `BreakingEnding` also breaks off what waits.

Laws: what opening a port needs is imported when one is opened.
"""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import TYPE_CHECKING, Annotated, Literal

from attrs import evolve, frozen
from cyclopts import Parameter

from i7000 import BaudRate, CharacterFormat, InvalidValueError, LineSettings
from i7000.cli.numbers import baud_rate
from i7000.cli.words import LineError, UsageError

if TYPE_CHECKING:
    from i7000.host import Policy
    from i7000.link import Port

__all__ = [
    "DEFAULT_ASKING",
    "DEFAULT_LINE",
    "AskOptions",
    "BreakingEnding",
    "Ending",
    "LineOptions",
    "Target",
    "broken_off_by_signals",
    "ended_by_signals",
    "opened",
]

Target = Annotated[
    str,
    Parameter(
        help="The port: a device such as /dev/ttyUSB0 or COM3, a URL of pyserial such as rfc2217://host:port,"
        " sim:M-7019R,type=K for a simulated module, or exec:COMMAND for a program."
    ),
]


@Parameter(name="*")
@frozen
class LineOptions:
    """The settings of the line; None is what was not given."""

    baud: str | None = None
    """Baud rate of the line: 1200 to 115200. Default: 9600."""
    character_format: Literal["N81", "N82", "E81", "O81"] | None = None
    """Parity and stop bits of the line, with 8 data bits. Default: N81."""

    def settings(self, otherwise: LineSettings = LineSettings()) -> LineSettings:  # noqa: B008 - frozen
        """Return the settings, from `otherwise` unless they are given.

        Errors: `UsageError` for a baud rate that no module has.
        """
        line = otherwise
        if self.baud is not None:
            rate = baud_rate(self.baud)
            if not isinstance(rate, BaudRate):
                raise UsageError(f"--baud {self.baud}: no module has this baud rate")
            line = evolve(line, baud_rate=rate)
        if self.character_format is not None:
            line = evolve(line, character_format=CharacterFormat[self.character_format])
        return line

    def others(self) -> tuple[LineSettings, ...]:
        """Return the other settings that a module can have: what is given is the same in all of them.

        Errors: as for `settings`.
        """
        from i7000.host.procedures import EVERY_LINE  # noqa: PLC0415 - most commands do without it

        first = self.settings()
        return tuple(line for line in EVERY_LINE if line != first and self.settings(line) == line)


DEFAULT_LINE = LineOptions()


@Parameter(name="*")
@frozen
class AskOptions:
    """How modules are asked."""

    timeout: float | None = None
    """Seconds until a response has to begin, with the delays of adapters and networks. Default: 0.2; 0.1 for
    `i7000 scan`. Example: --timeout 1."""
    retries: int | None = None
    """How often a request without a response is sent again: 0 to 100. Default: 2; 0 for `i7000 scan`."""
    echo: Annotated[bool, Parameter(negative="")] = False
    """Drop the echo of what is sent, which some 2-wire adapters return."""

    def policy(self, otherwise: "Policy | None" = None) -> "Policy":
        """Return the timeouts and retries, from `otherwise` unless they are given.

        Errors: `UsageError` for numbers beyond the range.
        """
        from i7000.host import Policy  # noqa: PLC0415 - most commands do without it

        policy = otherwise or Policy()
        if self.timeout is not None:
            if not 0 < self.timeout <= _LONGEST_TIMEOUT:
                raise UsageError(f"--timeout {self.timeout:g}: give more than 0, at most {_LONGEST_TIMEOUT} seconds")
            policy = evolve(policy, turnaround=self.timeout, grace=max(policy.grace, self.timeout / 2))
        if self.retries is not None:
            if not 0 <= self.retries <= _MOST_RETRIES:
                raise UsageError(f"--retries {self.retries}: give 0 to {_MOST_RETRIES}")
            policy = evolve(policy, retries=self.retries)
        return policy


DEFAULT_ASKING = AskOptions()
_LONGEST_TIMEOUT = 60
_MOST_RETRIES = 100


@contextmanager
def opened(target: str, line: LineSettings) -> "Iterator[Port]":
    """Open the port of a target until the end.

    Errors: `UsageError` for a text that is not a target; `LineError` if it cannot be opened.
    """
    from i7000.link import LinkError, open_target  # noqa: PLC0415 - pyserial takes time, and may not be there

    try:
        port = open_target(target, line)
    except InvalidValueError as error:
        raise UsageError(error) from None
    except LinkError as error:
        raise LineError(error) from None
    try:
        yield port
    finally:
        port.close()


class Ending:
    """The signal that asked the program to end."""

    def __init__(self) -> None:
        self.number = 0
        """Its number; 0 until there is one."""

    def ask(self, number: int, _frame: FrameType | None) -> None:
        """Remember a signal; this handles signals."""
        self.number = number


class BreakingEnding(Ending):
    """An ending that breaks off what waits, and never what writes.

    Laws: `KeyboardInterrupt` is raised within `breakable` only, or for a second signal before `hold`.
    """

    def __init__(self) -> None:
        super().__init__()
        self._breakable = self._held = False
        self._warn: Callable[[], None] | None = None
        """What answers the next signal instead of breaking off."""

    def ask(self, number: int, frame: FrameType | None) -> None:
        """Remember a signal, and break off what may be; this handles signals."""
        again = self.number != 0
        super().ask(number, frame)
        warn, self._warn = self._warn, None
        if warn:
            warn()
        elif self._breakable or (again and not self._held):
            self._breakable = False  # what ends because of this signal is not broken off by the next one
            raise KeyboardInterrupt

    def hold(self) -> None:
        """Make signals break off only what is `breakable` or `insistent` from now on."""
        self._held = True

    @contextmanager
    def insistent(self, warn: Callable[[], None]) -> Iterator[None]:
        """Call `warn` at the next signal within the block, and raise `KeyboardInterrupt` at the one after it."""
        self._warn = warn
        self._breakable = True
        try:
            yield
        finally:
            self._breakable = False
            self._warn = None

    @contextmanager
    def breakable(self) -> Iterator[None]:
        """Make a signal raise `KeyboardInterrupt` until the end of the block, also one that came before."""
        try:
            self._breakable = True
            if self.number:
                raise KeyboardInterrupt
            yield
        finally:
            self._breakable = False


@contextmanager
def ended_by_signals() -> Iterator[Ending]:
    """Make Ctrl-C, and the signals that come when the program is ended or its terminal hangs up, ask for the end."""
    ending = Ending()
    with _handling(ending):
        yield ending


@contextmanager
def broken_off_by_signals() -> Iterator[BreakingEnding]:
    """Make the same signals break off what waits, and ask for the end."""
    ending = BreakingEnding()
    with _handling(ending):
        yield ending


@contextmanager
def _handling(ending: Ending) -> Iterator[None]:
    numbers = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
    before = {number: signal.getsignal(number) for number in numbers}
    try:
        for number, handler in before.items():
            if handler is not signal.SIG_IGN:
                signal.signal(number, ending.ask)
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
