"""The real port of a proxy: threads read and write it, so that an event loop never waits for it.

Laws: what comes from the port is handed to the loop before more is read, and what waits to be written is limited:
neither side can fill the memory.
"""

import asyncio
from collections.abc import Callable
from contextlib import suppress
from queue import Full, Queue
from threading import Thread
from typing import Any

from i7000.device import Uart
from i7000.errors import I7000Error
from i7000.link.errors import LinkError
from i7000.link.port import Port, close, named, read, write
from i7000.link.worker import done_in

__all__ = ["Target"]

_MOST_WAITING = 256
"""The maximum number of writes that wait for the port."""
_LOOK = 0.1
"""The interval in seconds at which the reader looks whether it is to end."""
_PATIENCE = 6.0
"""The seconds that the end waits for a thread, which a port can hold up for a little less."""


def _tune(port: Any, uart: Uart) -> None:  # noqa: ANN401 - `bytesize` is not an attribute of every port
    settings = {"baudrate": uart.rate, "bytesize": uart.data_bits, "parity": uart.parity, "stopbits": uart.stop_bits}
    try:
        for name, value in settings.items():
            if getattr(port, name, value) != value:
                setattr(port, name, value)
    except Exception as error:
        raise LinkError(f"{named(port)}: the port cannot be set to {uart}: {error}") from error


class Target:
    """An open port in use by a loop."""

    def __init__(self, port: Port) -> None:
        """Take an open port; nothing is read or written before `start`."""
        self._port = port
        self._loop = asyncio.get_running_loop()
        self._received: Callable[[bytes], None] = lambda _: None
        self._lost: Callable[[Exception], None] = lambda _: None
        self._ended = False
        self._waiting: Queue[Callable[[], object] | None] = Queue(_MOST_WAITING)
        self._threads: list[Thread] = []

    def start(self, received: Callable[[bytes], None], lost: Callable[[Exception], None]) -> None:
        """Start to read and write; `received` and `lost` are called in the loop, `lost` when the port is gone."""
        self._received, self._lost = received, lost
        self._threads += [Thread(target=run, name="i7000 port", daemon=True) for run in (self._read, self._write)]
        for thread in self._threads:
            thread.start()

    def write(self, data: bytes) -> bool:
        """Write bytes soon; return False, and drop them, if too much waits."""
        return self._put(lambda: write(self._port, data))

    def tune(self, uart: Uart) -> bool:
        """Change the line settings, after what waits is written; return False if too much waits."""
        return self._put(lambda: _tune(self._port, uart))

    def _put(self, do: Callable[[], object]) -> bool:
        try:
            self._waiting.put_nowait(do)
        except Full:
            return False
        return True

    async def close(self) -> None:
        """Close the port, and wait until the threads have ended."""
        self._ended = True
        with suppress(Full):
            self._waiting.put_nowait(None)
        await asyncio.to_thread(self._end)

    def _end(self) -> None:
        for thread in self._threads:
            thread.join(_PATIENCE)
        close(self._port)

    def _read(self) -> None:
        while not self._ended:
            try:
                data = read(self._port, _LOOK)
            except I7000Error as error:
                self._fail(error)
                return
            if data and not done_in(self._loop, self._hand_over(data)):
                return

    async def _hand_over(self, data: bytes) -> None:
        self._received(data)

    def _write(self) -> None:
        while do := self._waiting.get():
            if self._ended:
                return
            try:
                do()
            except I7000Error as error:
                self._fail(error)
                return

    def _fail(self, error: I7000Error) -> None:
        if not self._ended:
            with suppress(RuntimeError):  # The loop has ended.
                self._loop.call_soon_threadsafe(self._lost, error)
