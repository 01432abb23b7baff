"""A serial port in virtual time, and an event loop that waits for it: whatever a driver does, no time passes really."""

import asyncio
import heapq
import selectors
from collections.abc import Callable, Iterable, Sequence
from itertools import count
from random import Random
from typing import Any

from i7000.device import Bus, Ear, Signals, State, Uart
from i7000.simulator.faults import Faults, Piece

__all__ = ["Answer", "Port", "run", "simulated"]

Answer = Callable[[bytes, float], Iterable[Piece]]
"""What comes back for written bytes, and how much later each piece begins."""
FILENO = 1000


class Port:
    """What drivers use of `serial.Serial`, and a clock.

    Bytes arrive one after the other, each when the line has carried it: pieces that would overlap follow each other.
    """

    def __init__(self, answer: Answer, uart: Uart | None = None) -> None:
        self.answer, self.character_time = answer, (uart or Uart()).character_time
        self.timeout: float | None = None
        self.fails: type[BaseException] | None = None
        """What the next call of `read` after a request raises, once."""
        self.time = 0.0
        self.written: list[bytes] = []
        self._coming: list[tuple[float, int, int]] = []
        self._order = count()
        self._free_at = 0.0
        self._received = bytearray()

    def now(self) -> float:
        return self.time

    def sleep(self, seconds: float) -> None:
        self.time += seconds

    def fileno(self) -> int:
        return FILENO

    def write(self, wire: bytes) -> int:
        self.written.append(wire)
        for piece in self.answer(wire, self.time):
            for byte in piece.wire:
                heapq.heappush(self._coming, (self.time + piece.after, next(self._order), byte))
        return len(wire)

    @property
    def in_waiting(self) -> int:
        while self._coming and self._next_at(self.time) <= self.time:
            self._free_at = self._next_at(self.time)
            self._received.append(heapq.heappop(self._coming)[2])
        return len(self._received)

    def _next_at(self, otherwise: float) -> float:
        """When the line has carried the next byte."""
        return max(self._free_at, self._coming[0][0]) + self.character_time if self._coming else otherwise

    def wait(self, until: float) -> None:
        """Move the time on until there is something to read, or until a time."""
        if not self.in_waiting:
            self.time = max(self.time, min(until, self._next_at(until)))

    def read(self, size: int = 1) -> bytes:
        if self.fails and self.written:
            failure, self.fails = self.fails, None
            raise failure
        return self._read(lambda: self.in_waiting >= size, size)

    def read_until(self, end: bytes) -> bytes:
        return self._read(lambda: end in self._received[: self.in_waiting], None, end)

    def _read(self, enough: Callable[[], bool], size: int | None, end: bytes = b"") -> bytes:
        over = self.time + (self.timeout or 0.0)
        while not enough() and self.time < over:
            self.time = max(self.time, min(over, self._next_at(over)))
        stop = self._received.find(end) + len(end) if end and end in self._received else size
        data = bytes(self._received[:stop])
        del self._received[: len(data)]
        return data


def simulated(modules: Sequence[State], signals: Sequence[Signals], faults: Faults, seed: int) -> Answer:
    """Return what modules answer on a line with faults."""
    bus, chance, character_time = Bus(tuple(modules)), Random(seed), Uart().character_time

    def answer(wire: bytes, now: float) -> Iterable[Piece]:
        nonlocal bus
        bus, ear, heard = bus.hear(Ear(), wire, signals, now)
        bus, _, more = bus.silence(ear, signals, now)
        for frame in (*heard, *more):
            if frame.answer is not None:
                delay = frame.delay + len(wire) * character_time
                for piece in faults.delivered(frame.answer, character_time, chance).pieces:
                    yield Piece(piece.wire, piece.after + delay)

    return answer


# --- an event loop ----------------------------------------------------------------------------------------------------


class _Selector(selectors.SelectSelector):
    def __init__(self, port: Port) -> None:
        super().__init__()
        self.port = port

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        watched = self.get_map().get(FILENO)
        until = self.port.time + (0.0 if timeout is None else max(0.0, timeout))
        if watched:
            self.port.wait(until)
        else:
            self.port.time = until
        return [(watched, selectors.EVENT_READ)] if watched and self.port.in_waiting else []


class _Loop(asyncio.SelectorEventLoop):
    def __init__(self, port: Port) -> None:
        super().__init__(_Selector(port))
        self._port = port

    def time(self) -> float:
        return self._port.time


def run(port: Port, main: Callable[[], Any]) -> Any:
    """Run a coroutine function in the time of a port."""
    with asyncio.Runner(loop_factory=lambda: _Loop(port)) as runner:
        return runner.run(main())
