"""What pseudo-terminals and networks connect hosts to: a simulated bus, or a proxy of a real line."""

from collections.abc import Callable
from typing import Protocol

from i7000.device import Uart

__all__ = ["End", "Served"]


class End(Protocol):
    """The end of the line of one host."""

    @property
    def uart(self) -> Uart | None:
        """The line settings of the host; None if they do not matter."""

    @uart.setter
    def uart(self, uart: Uart) -> None: ...

    def receive(self, data: bytes) -> None:
        """Process the bytes that the host sends."""

    def finish(self, finished: Callable[[], None]) -> None:
        """Call `finished` as soon as no response is delayed."""

    def close(self) -> None:
        """Disconnect the host: it receives nothing more."""


class Served(Protocol):
    """A line that hosts can be connected to."""

    def host(self, name: str, write: Callable[[bytes], None]) -> End:
        """Connect a host; `write` is called with the bytes that it receives."""

    def notice(self, text: str) -> None:
        """Count a notice, and report it the first time."""
