"""A simulator that runs beside the test, in an event loop of its own."""

import asyncio
from collections.abc import Callable, Iterator
from contextlib import AbstractAsyncContextManager, AsyncExitStack, contextmanager
from threading import Thread
from typing import Any, TypeVar

from attrs import define, evolve, field

from i7000 import Firmware, Model, Protocol
from i7000.device import factory
from i7000.simulator.faults import Faults
from i7000.simulator.observed import Observed
from i7000.simulator.simulator import Simulated, Simulator
from i7000.simulator.sources import Sources, default_sources

__all__ = ["Running", "Transport", "module", "running"]

T = TypeVar("T")
Transport = Callable[[Simulator], AbstractAsyncContextManager[str]]
_ENOUGH = 20.0


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

        return asyncio.run_coroutine_threadsafe(called(), self.loop).result(_ENOUGH)


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
        here, task = asyncio.run_coroutine_threadsafe(start(), loop).result(_ENOUGH)
        try:
            yield here
        finally:
            asyncio.run_coroutine_threadsafe(stop(here.simulator, task), loop).result(_ENOUGH)
    finally:
        loop.call_soon_threadsafe(loop.stop)
        thread.join(_ENOUGH)
        loop.close()
