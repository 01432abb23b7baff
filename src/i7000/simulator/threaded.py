"""A simulator in a thread of its own, for tests and programs without an event loop.

Laws: every call returns after its effect, or raises what the simulator raises; leaving the context stops the thread,
closes the port and disconnects all hosts.
"""

import asyncio
from collections.abc import Callable, Iterator
from contextlib import AbstractAsyncContextManager, AsyncExitStack, contextmanager
from threading import Thread
from typing import Literal, Self, TypeVar

from attrs import evolve

from i7000.device import Eeprom, Signal, State, factory
from i7000.errors import InvalidValueError
from i7000.models import Model
from i7000.simulator.faults import Faults
from i7000.simulator.observed import Change, Observed
from i7000.simulator.simulator import Simulated, Simulator
from i7000.simulator.sources import COLD_JUNCTION, Fixed, Source, Sources, default_sources
from i7000.simulator.tcp import listen

__all__ = ["RunningSimulator", "simulate"]

T = TypeVar("T")
Over = Literal["pty", "socket", "rfc2217"]
_PATIENCE = 30.0
"""The seconds after which a call of a simulator that does not react fails."""


class RunningSimulator(str):
    """The URL of a simulator that runs in another thread: the port for a driver, as pyserial takes it.

    It is a text: a path, ``socket://...`` or ``rfc2217://...``. Its other methods operate the simulator, and may be
    called from any thread.
    """

    __slots__ = ("simulator",)

    simulator: Simulator
    """The simulator; use it only inside of functions for `call`."""

    def __new__(cls, url: str, simulator: Simulator) -> Self:
        """Make the URL of a simulator."""
        running = super().__new__(cls, url)
        running.simulator = simulator
        return running

    def call(self, function: Callable[[Simulator], T]) -> T:
        """Call a function with the simulator, in its thread; return or raise what the function does."""

        async def called() -> T:
            return function(self.simulator)

        return asyncio.run_coroutine_threadsafe(called(), self.simulator.loop).result(_PATIENCE)

    @property
    def faults(self) -> Faults:
        """The faults of the line; assign others at any time."""
        return self.simulator.faults

    @faults.setter
    def faults(self, faults: Faults) -> None:
        self.call(lambda simulator: setattr(simulator, "faults", faults))

    @property
    def modules(self) -> tuple[State, ...]:
        """The modules as they are now."""
        return self.call(lambda simulator: simulator.bus.modules)

    def connect(self, channel: int | str, source: Source | Signal | None, *, address: int | None = None) -> None:
        """Connect a source, or a constant signal, to a channel of the module at an address, or of all modules.

        Special: None is an open wire; the channel ``cold_junction`` is the temperature of the terminals.
        Errors: `InvalidValueError`.
        """
        source = Fixed(source) if source is None or isinstance(source, Signal) else source

        def connect(simulator: Simulator) -> None:
            places = _places(simulator, address)
            changed = [sources for _, _, sources in simulator.modules()]
            for place in places:
                changed[place] = _connected(changed[place], channel, source)
            simulator.connect(changed)

        self.call(connect)

    def power_cycle(self, address: int | None = None) -> None:
        """Switch the power of the module at an address off and on, or of all modules.

        Errors: `InvalidValueError` if no module has the address.
        """
        self.call(lambda simulator: simulator.power_cycle(_places(simulator, address)))

    def switch_init(self, address: int, *, on: bool) -> None:
        """Move the INIT switch of the module at an address; most of its effect is at the next power-on.

        Errors: `InvalidValueError` if no module has the address.
        """

        def switch(simulator: Simulator) -> None:
            for place in _places(simulator, address):
                simulator.switch_init(place, on=on)

        self.call(switch)


def _places(simulator: Simulator, address: int | None) -> tuple[int, ...]:
    """Return the places of the modules with an address in their EEPROM, or of all."""
    if address is None:
        return tuple(range(len(simulator.bus.modules)))
    found = simulator.places(address)
    if not found:
        known = ", ".join(f"{module.eeprom.address:02X}h" for module in simulator.bus.modules)
        raise InvalidValueError("address", address, f"that of a module: {known}", "")
    return found


def _connected(sources: Sources, channel: int | str, source: Source) -> Sources:
    if channel == COLD_JUNCTION:
        return evolve(sources, cold_junction=source)
    if not isinstance(channel, int) or not 0 <= channel < len(sources.channels):
        allowed = f"0..{len(sources.channels) - 1} or {COLD_JUNCTION}"
        raise InvalidValueError("channel", channel, allowed, "")
    channels = list(sources.channels)
    channels[channel] = source
    return evolve(sources, channels=tuple(channels))


@contextmanager
def simulate(
    *modules: Simulated | Eeprom | Model,
    faults: Faults | None = None,
    seed: int = 0,
    over: Over | None = None,
    observe: Callable[[Observed], None] | None = None,
    watch: Callable[[Change], None] | None = None,
) -> Iterator[RunningSimulator]:
    """Simulate modules in another thread while the context is entered.

    Shape: a `Model` has its factory settings and as address its number, from 1 on; models and EEPROMs have the signals
        of `default_sources`. `over` selects a pseudo-terminal, TCP or RFC 2217; the default is a pseudo-terminal, or
        RFC 2217 on systems without. `observe` and `watch` are called in the other thread.
    Errors: `OSError` if the port cannot be opened.

    >>> from i7000.models import Model
    >>> with simulate(Model.I_7018, over="socket") as url:
    ...     url.startswith("socket://127.0.0.1:")
    True
    """
    simulated = [_simulated(module, number) for number, module in enumerate(modules, 1)]
    transport = _transport(over)
    loop = asyncio.new_event_loop()
    opened = AsyncExitStack()

    async def start() -> tuple[RunningSimulator, asyncio.Task[None]]:
        simulator = Simulator(simulated, faults=faults, seed=seed, observe=observe, watch=watch)
        scheme, open_port = transport
        place = await opened.enter_async_context(open_port(simulator))
        return RunningSimulator(scheme + place, simulator), loop.create_task(simulator.run())

    async def stop(simulator: Simulator, task: "asyncio.Task[None]") -> None:
        simulator.end()
        await opened.aclose()
        await task

    thread = Thread(target=loop.run_forever, name="i7000 simulator", daemon=True)
    thread.start()
    try:
        running, task = asyncio.run_coroutine_threadsafe(start(), loop).result(_PATIENCE)
        try:
            yield running
        finally:
            asyncio.run_coroutine_threadsafe(stop(running.simulator, task), loop).result(_PATIENCE)
    finally:
        loop.call_soon_threadsafe(loop.stop)
        thread.join(_PATIENCE)
        loop.close()


def _simulated(module: Simulated | Eeprom | Model, number: int) -> Simulated:
    if isinstance(module, Model):
        module = evolve(factory(module), address=number)
    return Simulated(module, default_sources(module)) if isinstance(module, Eeprom) else module


_Transport = Callable[[Simulator], AbstractAsyncContextManager[str]]


def _transport(over: Over | None) -> tuple[str, _Transport]:
    """Return the beginning of a URL, and how its port is opened."""
    if over in (None, "pty"):
        try:
            from i7000.simulator.pseudo_terminal import open_pty  # noqa: PLC0415 - POSIX only
        except ModuleNotFoundError:
            if over == "pty":
                raise InvalidValueError("over", over, "socket or rfc2217 on this system", "") from None
        else:
            return "", open_pty
    if over == "socket":
        return "socket://", listen
    if over in (None, "rfc2217"):
        from i7000.simulator.rfc2217 import Rfc2217Connection  # noqa: PLC0415 - few need it

        return "rfc2217://", lambda simulator: listen(simulator, connection=Rfc2217Connection)
    raise InvalidValueError("over", over, "pty, socket or rfc2217", "")
