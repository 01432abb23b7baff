"""The real port of a proxy, in its threads."""

import asyncio
import os
import pty
import threading
import tty
from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager
from typing import Any

import pytest
import serial

from i7000.device import Uart
from i7000.link import LinkError, open_target
from i7000.simulator.target import Target
from tests.waiting import ENOUGH


@contextmanager
def device() -> Iterator[tuple[int, str]]:
    """A serial port; the value is its other end and its path."""
    end, near = pty.openpty()
    try:
        tty.setraw(near)
        yield end, os.ttyname(near)
    finally:
        os.close(end)
        os.close(near)


def used(port: Any, do: Callable[[Target, "asyncio.Queue[Any]"], Awaitable[Any]]) -> Any:
    """What comes of using a port; the queue has what comes from it."""

    async def run() -> Any:
        target = Target(port)
        came: asyncio.Queue[Any] = asyncio.Queue()
        target.start(came.put_nowait, came.put_nowait)
        try:
            return await asyncio.wait_for(do(target, came), ENOUGH)
        finally:
            await target.close()

    found = asyncio.run(run())
    assert not [thread for thread in threading.enumerate() if thread.name == "i7000 port"]
    return found


def test_bytes_pass_in_both_directions() -> None:
    async def talk(target: Target, came: "asyncio.Queue[Any]") -> bytes:
        assert target.write(b"#0")
        assert target.tune(Uart(19200, stop_bits=2))
        assert target.write(b"1\r")
        heard = b""
        while len(heard) < 4:
            heard += await asyncio.to_thread(os.read, end, 100)
        os.write(end, b">+1.0000\r")
        answer = b""
        while len(answer) < 9:
            answer += await came.get()
        return heard + answer

    with device() as (end, path):
        port: Any = open_target(path)
        assert used(port, talk) == b"#01\r>+1.0000\r"

    assert (port.baudrate, port.stopbits, port.is_open) == (19200, 2, False)


class Broken(serial.SerialBase):
    """A port that fails."""

    in_waiting = 0

    def __init__(self, *, reads: bool) -> None:
        super().__init__()
        self.is_open = True
        self.reads = reads
        self.name = "COM9"

    def _reconfigure_port(self) -> None:
        pass

    def read(self, size: int = 1) -> bytes:  # noqa: ARG002
        if self.reads:
            raise TypeError("byte indices must be integers")
        threading.Event().wait(0.01)
        return b""

    def write(self, b: Any, /) -> int:  # noqa: ARG002
        raise serial.SerialTimeoutException("Write timeout")

    def close(self) -> None:
        raise OSError("gone")


@pytest.mark.parametrize(
    ("reads", "said"),
    [(True, "byte indices must be integers"), (False, "Write timeout")],
)
def test_a_port_that_fails_is_lost(*, reads: bool, said: str) -> None:
    async def wait(target: Target, came: "asyncio.Queue[Any]") -> str:
        target.write(b"#01\r")
        return str(await came.get())

    assert used(Broken(reads=reads), wait) == f"COM9: the port is lost: {said}"


def test_a_port_that_takes_nothing_does_not_fill_the_memory() -> None:
    async def flood(target: Target, _: "asyncio.Queue[Any]") -> tuple[int, bool]:
        taken = int(target.write(b"#01\r"))
        assert await asyncio.to_thread(begun.wait, ENOUGH)  # from now on the thread takes nothing more
        while target.write(b"#01\r"):
            taken += 1
        return taken, target.tune(Uart())

    class Slow(Broken):
        def write(self, b: Any, /) -> int:  # noqa: ARG002
            begun.set()
            going_on.wait(ENOUGH)
            return 4

        def close(self) -> None:
            pass

    begun, going_on = threading.Event(), threading.Event()

    async def flood_and_go_on(target: Target, came: "asyncio.Queue[Any]") -> tuple[int, bool]:
        found = await flood(target, came)
        asyncio.get_running_loop().call_later(0.2, going_on.set)
        return found

    taken, tuned = used(Slow(reads=False), flood_and_go_on)

    assert 256 <= taken <= 257
    assert not tuned


def test_a_failure_while_it_is_closed_is_no_loss() -> None:
    async def close(target: Target, came: "asyncio.Queue[Any]") -> bool:
        target._ended = True  # noqa: SLF001 - as `close` begins
        target.write(b"x")
        target._fail(LinkError("gone"))  # noqa: SLF001
        await asyncio.sleep(0.01)
        return came.empty()

    assert used(Broken(reads=False), close)


def test_a_port_that_was_never_started_is_closed() -> None:
    with device() as (_, path):
        port: Any = open_target(path)

        async def close() -> None:
            await Target(port).close()

        asyncio.run(close())

    assert not port.is_open


def test_line_settings_that_a_port_does_not_have_are_a_loss() -> None:
    class Fixed(Broken):
        def __setattr__(self, name: str, value: object) -> None:
            if (name, value) == ("baudrate", 19200):
                raise OSError("Invalid argument")
            super().__setattr__(name, value)

    async def tune(target: Target, came: "asyncio.Queue[Any]") -> str:
        target.tune(Uart(19200))
        return str(await came.get())

    assert used(Fixed(reads=False), tune).startswith("COM9: the port cannot be set to Uart(rate=19200")
