"""The real port of a proxy: threads read and write it, so that it never holds up an event loop.

Laws: what comes from the port is handed to the loop before more is read, and what waits to be written is limited:
neither side can fill the memory.
"""

import asyncio
from collections.abc import Callable
from contextlib import suppress
from queue import Full, Queue
from threading import Thread
from typing import Any

import serial
from serial import rfc2217

from i7000.device import Uart

__all__ = ["Target", "TargetError", "open_port"]

_MOST_WAITING = 256
"""The maximum number of writes that wait for the port."""
_LOOK = 0.1
"""The interval in seconds at which the reader looks whether it is to end."""
_WRITE_TIMEOUT = 5.0
_STOP_BITS = {1: serial.STOPBITS_ONE, 1.5: serial.STOPBITS_ONE_POINT_FIVE, 2: serial.STOPBITS_TWO}


class TargetError(OSError):
    """A port that cannot be opened, or that is gone; the text names it and the reason."""


def open_port(target: str, uart: Uart) -> Any:  # noqa: ANN401 - pyserial has no type for all of its ports
    """Open a serial device, or a URL of pyserial.

    Errors: `TargetError`.
    """
    try:
        port: Any = serial.serial_for_url(target, do_not_open=True)
        port.timeout = _LOOK
        if not isinstance(port, rfc2217.Serial):  # which refuses such a limit
            port.write_timeout = _WRITE_TIMEOUT
        _tune(port, uart)
        port.open()
    except Exception as error:  # noqa: BLE001 - pyserial lets errors of termios and of sockets through
        raise TargetError(f"{target}: {getattr(error, 'strerror', None) or error}") from None
    return port


def _tune(port: Any, uart: Uart) -> None:  # noqa: ANN401 - as above
    port.baudrate, port.bytesize = uart.rate, uart.data_bits
    port.parity, port.stopbits = uart.parity, _STOP_BITS[uart.stop_bits]


class Target:
    """An open port in use by a loop."""

    def __init__(self, port: Any) -> None:  # noqa: ANN401 - as above
        """Take an open port; nothing is read or written before `start`."""
        self._port = port
        self._loop = asyncio.get_running_loop()
        self._received: Callable[[bytes], None] = lambda _: None
        self._lost: Callable[[TargetError], None] = lambda _: None
        self._ended = False
        self._waiting: Queue[Callable[[], object] | None] = Queue(_MOST_WAITING)
        self._threads: list[Thread] = []

    def start(self, received: Callable[[bytes], None], lost: Callable[[TargetError], None]) -> None:
        """Start to read and write; `received` and `lost` are called in the loop, `lost` when the port is gone."""
        self._received, self._lost = received, lost
        self._threads += [Thread(target=run, name="i7000 port", daemon=True) for run in (self._read, self._write)]
        for thread in self._threads:
            thread.start()

    def write(self, data: bytes) -> bool:
        """Write bytes soon; return False, and drop them, if too much waits."""
        return self._put(lambda: self._port.write(data))

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
            thread.join(_WRITE_TIMEOUT)
        with suppress(OSError, ValueError):
            self._port.close()

    def _read(self) -> None:
        with suppress(RuntimeError):  # The loop has ended.
            while not self._ended:
                try:
                    data = self._port.read(max(1, min(self._port.in_waiting, 4096)))
                except Exception as error:  # noqa: BLE001 - pyserial raises many kinds for a port that is gone
                    self._fail(error)
                    return
                if data:
                    asyncio.run_coroutine_threadsafe(self._hand_over(data), self._loop).result()

    async def _hand_over(self, data: bytes) -> None:
        self._received(data)

    def _write(self) -> None:
        while do := self._waiting.get():
            if self._ended:
                return
            try:
                do()
            except Exception as error:  # noqa: BLE001 - as above
                self._fail(error)
                return

    def _fail(self, error: Exception) -> None:
        if self._ended:
            return
        name = getattr(self._port, "name", None) or getattr(self._port, "port", "the port")
        with suppress(RuntimeError):  # The loop has ended.
            self._loop.call_soon_threadsafe(self._lost, TargetError(f"{name}: {error}"))
