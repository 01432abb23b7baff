"""The responses on their way to one host.

Laws: memory is limited: responses beyond the limit are lost completely, and say so.
"""

import asyncio
from collections.abc import Callable, Sequence

from i7000.simulator.faults import Piece, Transfer

__all__ = ["LOST", "MOST_LATE_BYTES", "MOST_LATE_PIECES", "Deliveries"]

MOST_LATE_PIECES = 1 << 10
"""The maximum number of delayed pieces of responses to one host."""
MOST_LATE_BYTES = 1 << 16
"""The maximum number of their bytes; a response beyond either limit is lost completely."""
LOST = "an answer was lost: too many are late"
"""The text of a notice."""


class Deliveries:
    """The responses on their way to one host, which receives them by `write`; each has its delay."""

    def __init__(self, write: Callable[[bytes], None], notice: Callable[[str], None]) -> None:
        """Make one without responses; `notice` is called with each notice."""
        self._write = write
        self._notice = notice
        self._loop = asyncio.get_running_loop()
        self._later: dict[asyncio.TimerHandle, int] = {}
        """The delayed pieces, and their lengths."""
        self.delivered: Callable[[], None] = lambda: None
        """It is called after each delayed piece."""

    def __bool__(self) -> bool:
        """Return whether a response is delayed."""
        return bool(self._later)

    def send(self, transfer: Transfer) -> Transfer:
        """Send a response, and return what is sent of it: nothing if too much is delayed."""
        late = [piece for piece in transfer.pieces if piece.after]
        if late and not self._has_room(late):
            self._notice(LOST)
            return Transfer((), (*transfer.faults, LOST))
        for piece in transfer.pieces:
            if piece.after:
                self._send_later(piece.after, piece.wire)
            else:
                self._write(piece.wire)
        return transfer

    def close(self) -> None:
        """Drop what is delayed."""
        for handle in self._later:
            handle.cancel()

    def _has_room(self, late: Sequence[Piece]) -> bool:
        size = sum(self._later.values()) + sum(len(piece.wire) for piece in late)
        return len(self._later) + len(late) <= MOST_LATE_PIECES and size <= MOST_LATE_BYTES

    def _send_later(self, seconds: float, wire: bytes) -> None:
        def send() -> None:
            del self._later[handle]
            self._write(wire)
            self.delivered()

        handle = self._loop.call_later(seconds, send)
        self._later[handle] = len(wire)
