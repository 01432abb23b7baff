"""A bus of simulated modules, and its hosts; the clock and randomness are here.

Laws: `i7000.device` defines the behaviour of modules. Hosts share the modules, but not incomplete frames. Memory is
limited, whatever hosts send or do not read: excess bytes are lost, as on a real line, and counted.
"""

import asyncio
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from itertools import chain
from random import Random
from time import monotonic, time

from attrs import evolve, frozen

from i7000.device import Bus, Ear, Eeprom, Heard, Signals, State, Uart, advance, power_on
from i7000.errors import I7000Error, Noise
from i7000.simulator.changes import changes
from i7000.simulator.deliveries import Deliveries
from i7000.simulator.faults import Exchange, Faults, Piece, Transfer
from i7000.simulator.foreign import LONGEST, deaf_module, foreign_frames
from i7000.simulator.observed import Change, Observed
from i7000.simulator.sources import SAMPLES_A_SECOND, Sources

__all__ = ["UNREAD", "Host", "Simulated", "Simulator"]

UNREAD = "an answer was lost: its host does not read"
"""The text of a notice."""
_SILENCE = 0.02
"""The silence in seconds that ends a Modbus RTU frame: more than 3.5 characters, as networks do not keep time."""
_MOST_FAULTS = 16
"""The maximum number of faults kept until there is an event to report them with."""
_TICK = 0.25
"""The interval in seconds at which modules notice the time without traffic."""


@frozen
class Simulated:
    """A module to simulate, and its input signals."""

    eeprom: Eeprom
    sources: Sources
    init_switch: bool = False


class Simulator:
    """A bus of modules with power."""

    def __init__(  # noqa: PLR0913 - all but the modules are options
        self,
        modules: Iterable[Simulated],
        *,
        faults: Faults | None = None,
        seed: int = 0,
        store: Callable[[Sequence[Eeprom]], None] | None = None,
        observe: Callable[[Observed], None] | None = None,
        watch: Callable[[Change], None] | None = None,
        report: Callable[[str], None] | None = None,
    ) -> None:
        """Power on modules.

        Shape: `store` is called with the EEPROMs of all modules when one changes, `observe` with all traffic, `watch`
            with all changes of modules, `report` with each new notice.
        Special: the time of the modules is real time, but never goes back.
        """
        self.faults = faults or Faults()
        self.chance = Random(seed)  # noqa: S311 - repeatable
        self.store = store
        self.observe = observe
        self.watch = watch
        self._changes: list[Change] = []
        """The changes of modules that are not reported yet."""
        self.report = report
        self.notices: Counter[str] = Counter()
        """The notices, and how often each happened."""
        self.loop = asyncio.get_running_loop()
        self._ended: asyncio.Future[None] = self.loop.create_future()
        self._epoch = time() - monotonic()
        self.began = self.now
        """The time of its start, in seconds since 1970."""
        self._simulated = tuple(modules)
        self._sampled: tuple[int, tuple[Signals, ...]] | None = None
        self.bus = Bus(tuple([self._powered_on(module.eeprom, module) for module in self._simulated]))

    @property
    def now(self) -> float:
        """The time of the modules, in seconds."""
        return self._epoch + monotonic()

    @property
    def signals(self) -> tuple[Signals, ...]:
        """The signals at the inputs of each module now; unchanged until the next sample."""
        number = int((self.now - self.began) * SAMPLES_A_SECOND)
        if self._sampled is None or self._sampled[0] != number:
            seconds = number / SAMPLES_A_SECOND
            self._sampled = number, tuple([module.sources.at(seconds) for module in self._simulated])
        return self._sampled[1]

    def modules(self) -> tuple[tuple[State, Signals, Sources], ...]:
        """Return the modules as they are now, with their signals and the sources of these."""
        sources = [module.sources for module in self._simulated]
        return tuple(zip(self.bus.modules, self.signals, sources, strict=True))

    def places(self, address: int) -> tuple[int, ...]:
        """Return the places on the bus of the modules that have an address in their EEPROM."""
        return tuple(place for place, module in enumerate(self.bus.modules) if module.eeprom.address == address)

    def connect(self, sources: Iterable[Sources]) -> None:
        """Connect other signals to the inputs, for each module."""
        pairs = zip(self._simulated, sources, strict=True)
        self._simulated = tuple(evolve(module, sources=source) for module, source in pairs)
        self._sampled = None

    def power_cycle(self, places: Iterable[int] | None = None) -> None:
        """Switch the power of modules off and on: those at some places on the bus, or all."""
        modules = list(self.bus.modules)
        cycled = range(len(modules)) if places is None else sorted(set(places))
        for place in cycled:
            modules[place] = self._powered_on(modules[place].eeprom, self._simulated[place])
        if self.change(Bus(tuple(modules))):
            for place in cycled:
                mode = " in INIT mode" if modules[place].ram.init_mode else ""
                self._changed(modules[place], (f"power cycle{mode}",))
        self.report_changes()

    def _powered_on(self, eeprom: Eeprom, module: Simulated) -> State:
        return power_on(eeprom, init_switch=module.init_switch, now=self.now)

    def switch_init(self, place: int, *, on: bool) -> None:
        """Move the INIT switch of the module at a place on the bus; most of its effect is at the next power-on."""
        simulated, modules = list(self._simulated), list(self.bus.modules)
        simulated[place] = evolve(simulated[place], init_switch=on)
        modules[place] = modules[place].switched(init_switch=on)
        self._simulated = tuple(simulated)
        self.bus = evolve(self.bus, modules=tuple(modules))
        self._changed(modules[place], (f"INIT switch {'on' if on else 'off'}",))
        self.report_changes()

    def host(self, name: str, write: Callable[[bytes], None]) -> "Host":
        """Connect a host to the bus, as `Host` describes."""
        return Host(self, name, write)

    def advance(self) -> None:
        """Move the time of the modules on to now."""
        now = self.now
        moved = [advance(module, own, now) for module, own in zip(self.bus.modules, self.signals, strict=True)]
        self.change(Bus(tuple(moved)))
        self.report_changes()

    def change(self, bus: Bus) -> bool:
        """Replace the bus by `bus`, and store changes of EEPROMs.

        Return False, and keep the old bus, if storing fails: the simulation then ends.
        """
        pairs = zip(self.bus.modules, bus.modules, strict=True)
        changed = [(before, after) for before, after in pairs if before.eeprom is not after.eeprom]
        if changed and self.store:
            if self._ended.done():
                return False
            try:
                self.store([module.eeprom for module in bus.modules])
            except (OSError, I7000Error) as error:
                self._ended.set_exception(error)
                return False
        self.bus = bus
        if self.watch:
            for before, after in changed:
                if what := changes(before.eeprom, after.eeprom):
                    self._changed(after, what, stored=True)
        return True

    def _changed(self, module: State, what: tuple[str, ...], *, stored: bool = False) -> None:
        at = self.now - self.began
        self._changes.append(Change(at, module.eeprom.address, module.eeprom.model, what, stored=stored))

    def report_changes(self) -> None:
        """Report the changes of modules since the last call to the watcher: after the command that caused them."""
        reported, self._changes = self._changes, []
        if self.watch:
            for change in reported:
                self.watch(change)

    def observed(self, client: str, heard: Heard, faults: tuple[str, ...], pieces: tuple[Piece, ...] = ()) -> None:
        """Report what modules heard, and their answer, to the observer of the line."""
        if self.observe:
            at = self.now - self.began
            deaf = deaf_module(self.bus.modules, heard)
            frame, protocol, profile, answer = heard.frame, heard.protocol, heard.profile, heard.answer
            self.observe(Observed(at, client, frame, protocol, profile, answer, faults, deaf, pieces))

    def notice(self, text: str) -> None:
        """Count a notice, and report it the first time."""
        self.notices[text] += 1
        if self.report and self.notices[text] == 1:
            self.report(text)

    async def run(self) -> None:
        """Move the time on until `end` is called.

        Errors: `OSError` or `I7000Error` of `store`.
        """
        while not self._ended.done():
            self.advance()
            await asyncio.wait((self._ended,), timeout=_TICK)
        self._ended.result()

    def end(self) -> None:
        """Make `run` return."""
        if not self._ended.done():
            self._ended.set_result(None)


class Host:
    """The end of the line of one host."""

    def __init__(
        self, simulator: Simulator, name: str, write: Callable[[bytes], None], uart: Uart | None = None
    ) -> None:
        """Connect a host to the bus.

        Shape: `write` is called with received bytes; `uart` has the line settings of the host, None for those of each
            module.
        """
        self.simulator = simulator
        self.name = name
        self.ear = Ear(uart)
        self._write = write
        self._loop = asyncio.get_running_loop()
        self._silence: asyncio.TimerHandle | None = None
        self._deliveries = Deliveries(write, simulator.notice)
        self._deliveries.delivered = self._check_finished
        self._finished: Callable[[], None] | None = None
        self._faults: tuple[str, ...] = ()
        self._noises: list[tuple[Heard, tuple[str, ...]]] = []
        """Noise that may be a frame of the other protocol, once the line is silent."""
        self._last_request: bytes | None = None
        self._last_answer: bytes | None = None
        self._earlier: bytes | None = None
        """The answer to the last request that differed from the last one."""
        self._not_understood = b""
        """The bytes received since the line was silent, or since the last frame."""

    def receive(self, data: bytes) -> None:
        """Process the bytes that the host sends."""
        simulator = self.simulator
        if simulator.faults.echo:
            self._write(data)
        carried, faults = simulator.faults.requests.carried(data, simulator.chance)
        self._faults = (*self._faults, *faults)[-_MOST_FAULTS:]
        signals, now = simulator.signals, simulator.now
        bus, ear, told = simulator.bus.hear(self.ear, carried, signals, now)
        if told and told[-1].answer is not None and ear.ends_with(told[-1].frame):
            bus, ear, others = bus.silence(ear, signals, now)  # A module answers when the line is silent.
            told += tuple([heard for heard in others if not isinstance(heard.frame, Noise)])
        self._not_understood += carried
        self._take(bus, ear, told)
        if len(self._not_understood) > LONGEST:
            self._report_noises()

    @property
    def uart(self) -> Uart | None:
        """The line settings of the host."""
        return self.ear.uart

    @uart.setter
    def uart(self, uart: Uart) -> None:
        self.ear = evolve(self.ear, uart=uart)

    def finish(self, finished: Callable[[], None]) -> None:
        """Call `finished` as soon as no response is delayed."""
        self._finished = finished
        self._check_finished()

    def close(self) -> None:
        """Disconnect the host: it receives nothing more."""
        self._stop_waiting()
        self._deliveries.close()

    def _silent(self) -> None:
        simulator = self.simulator
        bus, ear, told = simulator.bus.silence(self.ear, simulator.signals, simulator.now)
        if all(isinstance(heard.frame, Noise) for heard in told):
            foreign = foreign_frames(bus.modules, self._not_understood)
            if foreign:
                told = foreign
                self._faults = (*chain(*[faults for _, faults in self._noises]), *self._faults)[-_MOST_FAULTS:]
                self._noises.clear()
        self._take(bus, ear, told)
        self._report_noises()
        self._stop_waiting()
        self._check_finished()

    def _take(self, bus: Bus, ear: Ear, told: Sequence[Heard]) -> None:
        if not self.simulator.change(bus):
            return  # Whatever is answered has been stored.
        self.ear = ear
        faults = self._faults
        if told:
            self._faults = ()
        for heard in told:
            if isinstance(heard.frame, Noise):
                self._noises.append((heard, faults))
                continue
            self._report_noises()
            transfer = Transfer(()) if heard.answer is None else self._answer(heard.frame, heard.answer, heard)
            self.simulator.observed(self.name, heard, (*faults, *transfer.faults), transfer.pieces)
        self.simulator.report_changes()
        self._stop_waiting()
        if ear.waiting or self._noises:
            self._silence = self._loop.call_later(_SILENCE, self._silent)

    def _report_noises(self) -> None:
        """Report the noise collected so far."""
        noises, self._noises = self._noises, []
        self._not_understood = b""
        for heard, faults in noises:
            self.simulator.observed(self.name, heard, faults)

    def _stop_waiting(self) -> None:
        if self._silence:
            self._silence.cancel()
            self._silence = None

    def _answer(self, request: bytes, answer: bytes, heard: Heard) -> Transfer:
        """Send a response, and return what arrives of it, with the delay of the module."""
        character_time = (self.uart or Uart()).character_time
        exchange = self._exchange(request, answer, heard)
        faults = self.simulator.faults.answers(exchange.address)
        transfer = faults.delivered(answer, character_time, self.simulator.chance, exchange)
        pieces = tuple([Piece(piece.wire, piece.after + heard.delay) for piece in transfer.pieces])
        return self._deliveries.send(Transfer(pieces, transfer.faults))

    def _exchange(self, request: bytes, answer: bytes, heard: Heard) -> Exchange:
        """Return the exchange of an answer, and remember the answer."""
        if request != self._last_request:
            self._last_request, self._earlier = request, self._last_answer
        self._last_answer = answer
        checksum = heard.profile is not None and heard.profile.checksum
        return Exchange(request, heard.protocol, checksum, self._earlier)

    def _check_finished(self) -> None:
        if self._finished and not self._deliveries and not self._silence:
            self._finished()
