"""A bus of simulated modules, and the hosts that talk to it: the clock and chance are here, the rules are not.

Laws: what modules do is what `i7000.device` says; hosts share the modules, not what they have half sent.
"""

import asyncio
from collections.abc import Callable, Iterable, Sequence
from random import Random
from time import monotonic, time

from attrs import evolve, frozen

from i7000.device import Bus, Ear, Eeprom, Heard, Signals, State, Uart, advance, power_on
from i7000.errors import I7000Error, Noise
from i7000.simulator.faults import Faults
from i7000.simulator.observed import Observed
from i7000.simulator.sources import SAMPLES_A_SECOND, Sources

__all__ = ["Host", "Simulated", "Simulator"]

_SILENCE = 0.02
"""Seconds after which a frame of Modbus RTU is over: more than 3.5 characters, as networks do not keep time."""
_MOST_FAULTS = 16
"""Faults that are remembered until there is something of which they can be told."""
_TICK = 0.25
"""Seconds after which modules notice that time has passed, if nobody talks to them."""


@frozen
class Simulated:
    """A module to be simulated, and what is on its inputs."""

    eeprom: Eeprom
    sources: Sources
    init_switch: bool = False


class Simulator:
    """A bus of modules that have power."""

    def __init__(
        self,
        modules: Iterable[Simulated],
        *,
        faults: Faults | None = None,
        seed: int = 0,
        store: Callable[[Sequence[Eeprom]], None] | None = None,
        observe: Callable[[Observed], None] | None = None,
    ) -> None:
        """Give power to modules.

        Shape: `store` is called with the EEPROMs of all modules when one has changed, `observe` with all traffic.
        Special: the modules' time is that of the world, but never goes back.
        """
        self.faults = faults or Faults()
        self.chance = Random(seed)  # noqa: S311 - repeatable
        self.store = store
        self.observe = observe
        self._ended: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._epoch = time() - monotonic()
        self._began = self.now
        self._simulated = tuple(modules)
        self._sampled: tuple[int, tuple[Signals, ...]] | None = None
        self.bus = Bus(())
        self.power_cycle()

    @property
    def now(self) -> float:
        """The time of the modules, in seconds."""
        return self._epoch + monotonic()

    @property
    def signals(self) -> tuple[Signals, ...]:
        """What is on the inputs of each module now: the same until they are sampled again."""
        number = int((self.now - self._began) * SAMPLES_A_SECOND)
        if self._sampled is None or self._sampled[0] != number:
            seconds = number / SAMPLES_A_SECOND
            self._sampled = number, tuple([module.sources.at(seconds) for module in self._simulated])
        return self._sampled[1]

    def modules(self) -> tuple[tuple[State, Signals], ...]:
        """Tell the modules as they are now, with what is on their inputs."""
        return tuple(zip(self.bus.modules, self.signals, strict=True))

    def connect(self, sources: Iterable[Sources]) -> None:
        """Connect other signals to the inputs, for each module."""
        pairs = zip(self._simulated, sources, strict=True)
        self._simulated = tuple(evolve(module, sources=source) for module, source in pairs)
        self._sampled = None

    def power_cycle(self) -> None:
        """Take the power of all modules away, and give it back."""
        eeproms = [module.eeprom for module in self.bus.modules or self._simulated]
        self.bus = Bus(
            tuple(
                power_on(eeprom, init_switch=module.init_switch, now=self.now)
                for eeprom, module in zip(eeproms, self._simulated, strict=True)
            )
        )

    def advance(self) -> None:
        """Let the modules notice that time has passed."""
        now = self.now
        self.change(Bus(tuple(advance(module, signals, now) for module, signals in self.modules())))

    def change(self, bus: Bus) -> bool:
        """Make `bus` what there is, and store what has changed in its EEPROMs.

        Return False, and leave the bus as it was, if that cannot be stored: the simulation has ended then.
        """
        changed = any(one.eeprom is not other.eeprom for one, other in zip(bus.modules, self.bus.modules, strict=True))
        if changed and self.store:
            if self._ended.done():
                return False
            try:
                self.store([module.eeprom for module in bus.modules])
            except (OSError, I7000Error) as error:
                self._ended.set_exception(error)
                return False
        self.bus = bus
        return True

    def tell(self, client: str, heard: Heard, faults: tuple[str, ...]) -> None:
        """Tell who observes the line."""
        if self.observe:
            at = self.now - self._began
            self.observe(Observed(at, client, heard.frame, heard.protocol, heard.profile, heard.answer, faults))

    async def run(self) -> None:
        """Let time pass until `end` is called.

        Errors: `OSError` or `I7000Error` of `store`.
        """
        while not self._ended.done():
            self.advance()
            await asyncio.wait((self._ended,), timeout=_TICK)
        self._ended.result()

    def end(self) -> None:
        """Have `run` return."""
        if not self._ended.done():
            self._ended.set_result(None)


class Host:
    """One host's end of the line."""

    def __init__(
        self, simulator: Simulator, name: str, write: Callable[[bytes], None], uart: Uart | None = None
    ) -> None:
        """Connect a host.

        Shape: `write` is called with what comes back; `uart` is how the host sends and hears, None: as each module.
        """
        self.simulator = simulator
        self.name = name
        self.ear = Ear(uart)
        self._write = write
        self._loop = asyncio.get_running_loop()
        self._silence: asyncio.TimerHandle | None = None
        self._later: set[asyncio.TimerHandle] = set()
        self._faults: tuple[str, ...] = ()

    def receive(self, data: bytes) -> None:
        """Take what the host sends."""
        simulator = self.simulator
        if simulator.faults.echo:
            self._write(data)
        carried, faults = simulator.faults.carried(data, simulator.chance)
        self._faults = (*self._faults, *faults)[-_MOST_FAULTS:]
        signals, now = simulator.signals, simulator.now
        bus, ear, told = simulator.bus.hear(self.ear, carried, signals, now)
        if told and told[-1].answer is not None and ear.ends_with(told[-1].frame):
            bus, ear, others = bus.silence(ear, signals, now)  # A module answers when the line is silent.
            told += tuple([heard for heard in others if not isinstance(heard.frame, Noise)])
        self._take(bus, ear, told)

    @property
    def uart(self) -> Uart | None:
        """How it sends and hears."""
        return self.ear.uart

    @uart.setter
    def uart(self, uart: Uart) -> None:
        self.ear = evolve(self.ear, uart=uart)

    def close(self) -> None:
        """Disconnect it: nothing comes back any more."""
        self._stop_waiting()
        for handle in self._later:
            handle.cancel()

    def _silent(self) -> None:
        simulator = self.simulator
        self._take(*simulator.bus.silence(self.ear, simulator.signals, simulator.now))

    def _take(self, bus: Bus, ear: Ear, told: Sequence[Heard]) -> None:
        if not self.simulator.change(bus):
            return  # Whatever is answered has been stored.
        self.ear = ear
        faults = self._faults
        if told:
            self._faults = ()
        for heard in told:
            happened = faults if heard.answer is None else (*faults, *self._answer(heard.answer, heard.delay))
            self.simulator.tell(self.name, heard, happened)
        self._stop_waiting()
        if ear.waiting:
            self._silence = self._loop.call_later(_SILENCE, self._silent)

    def _stop_waiting(self) -> None:
        if self._silence:
            self._silence.cancel()
            self._silence = None

    def _answer(self, answer: bytes, delay: float) -> tuple[str, ...]:
        character_time = (self.uart or Uart()).character_time
        transfer = self.simulator.faults.delivered(answer, character_time, self.simulator.chance)
        for piece in transfer.pieces:
            if delay + piece.after:
                self._write_later(delay + piece.after, piece.wire)
            else:
                self._write(piece.wire)
        return transfer.faults

    def _write_later(self, seconds: float, wire: bytes) -> None:
        def write() -> None:
            self._later.discard(handle)
            self._write(wire)

        handle = self._loop.call_later(seconds, write)
        self._later.add(handle)
