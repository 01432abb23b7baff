"""A simulator that runs beside the test, in an event loop of its own; and what hosts talk to it with."""

import asyncio
import socket
from collections.abc import Callable, Iterator
from contextlib import AbstractAsyncContextManager, AsyncExitStack, contextmanager
from functools import partial
from threading import Thread
from typing import Any, TypeVar

import serial
from attrs import define, evolve, field

from i7000 import Firmware, Model, Protocol, Unit
from i7000.device import Signal, factory
from i7000.simulator.faults import Faults
from i7000.simulator.observed import Observed
from i7000.simulator.pseudo_terminal import open_pty
from i7000.simulator.rfc2217 import Rfc2217Connection
from i7000.simulator.simulator import Simulated, Simulator
from i7000.simulator.sources import Fixed, Sources, default_sources
from i7000.simulator.tcp import listen
from tests.waiting import ENOUGH

__all__ = [
    "I_7018",
    "RFC_2217",
    "SAID",
    "TRANSPORTS",
    "Network",
    "Running",
    "Transport",
    "ask",
    "connected",
    "module",
    "port",
    "running",
]

T = TypeVar("T")
Transport = Callable[[Simulator], AbstractAsyncContextManager[str]]


def module(
    model: Model,
    firmware: str | None = None,
    *,
    sources: Sources | None = None,
    init_switch: bool = False,
    **stored: Any,
) -> Simulated:
    """A module from the factory, speaking DCON if nothing else is said, with changes to its EEPROM."""
    made = factory(model, None if firmware is None else Firmware(firmware))
    eeprom = evolve(made, **{"protocol": Protocol.DCON} | stored)
    return Simulated(eeprom, sources or default_sources(eeprom), init_switch)


@define
class Running:
    """A simulator in its loop; `place` is where hosts find it."""

    loop: asyncio.AbstractEventLoop
    simulator: Simulator
    place: str
    observed: list[Observed] = field(factory=list)

    def call(self, function: Callable[[], T]) -> T:
        """Call something where the simulator runs."""

        async def called() -> T:
            return function()

        return asyncio.run_coroutine_threadsafe(called(), self.loop).result(ENOUGH)


@contextmanager
def running(
    transport: Transport, *modules: Simulated, faults: Faults | None = None, seed: int = 0, **others: Any
) -> Iterator[Running]:
    """Run a simulator until the test is done with it."""
    loop = asyncio.new_event_loop()
    opened = AsyncExitStack()

    async def start() -> tuple[Running, asyncio.Task[None]]:
        simulator = Simulator(modules, faults=faults, seed=seed, **others)
        here = Running(loop, simulator, await opened.enter_async_context(transport(simulator)))
        simulator.observe = here.observed.append
        return here, loop.create_task(simulator.run())

    async def stop(simulator: Simulator, task: asyncio.Task[None]) -> None:
        simulator.end()
        await opened.aclose()
        await task

    thread = Thread(target=loop.run_forever, daemon=True)
    thread.start()
    try:
        here, task = asyncio.run_coroutine_threadsafe(start(), loop).result(ENOUGH)
        try:
            yield here
        finally:
            asyncio.run_coroutine_threadsafe(stop(here.simulator, task), loop).result(ENOUGH)
    finally:
        loop.call_soon_threadsafe(loop.stop)
        thread.join(ENOUGH)
        loop.close()


# --- a module, and hosts ----------------------------------------------------------------------------------------------

I_7018 = module(
    Model.I_7018,
    sources=Sources(tuple(Fixed(Signal(value, Unit.VOLT)) for value in (1.5, -1.0, 0.25, 0, 0, 0, 0, 0))),
)
SAID = b">+1.5000-1.0000+0.2500" + b"+0.0000" * 5 + b"\r"
RFC_2217 = partial(listen, connection=Rfc2217Connection)
TRANSPORTS: dict[str, Transport] = {"pty": open_pty, "socket": listen, "rfc2217": RFC_2217}


@contextmanager
def port(here: Running, scheme: str, **settings: Any) -> Iterator[serial.Serial]:
    """What a host opens."""
    url = here.place if scheme == "pty" else f"{scheme}://{here.place}"
    opened: Any = serial.serial_for_url(url, timeout=ENOUGH, **settings)
    with opened:
        yield opened


def connected(here: Running) -> socket.socket:
    """A connection without a protocol."""
    host, _, number = here.place.rpartition(":")
    return socket.create_connection((host, int(number)), timeout=ENOUGH)


def ask(opened: serial.Serial, request: bytes, length: int) -> bytes:
    """Send a request, and read so many bytes."""
    opened.write(request)
    return bytes(opened.read(length))


class Network(asyncio.Transport):
    """A connection to a host that reads nothing."""

    def __init__(self, unread: int = 0) -> None:
        super().__init__()
        self.unread = unread
        self.written: list[bytes] = []
        self.closed = False

    def is_closing(self) -> bool:
        """Whether it has been closed."""
        return self.closed

    def close(self) -> None:
        """Close it."""
        self.closed = True

    def get_write_buffer_size(self) -> int:
        """Return how many bytes wait for the host."""
        return self.unread

    def write(self, data: Any) -> None:
        """Keep what the host does not read."""
        self.written.append(bytes(data))
        self.unread += len(data)
