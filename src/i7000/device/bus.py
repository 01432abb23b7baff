"""Several modules on one pair of wires, of any models and protocols; hosts can send in any pieces.

Laws: every module with the protocol and the line settings of a frame hears it once it is complete. If modules have the
line settings of the host, any chunking gives the same frames in the same order; other modules hear a pause between
chunks.
"""

from collections.abc import Sequence
from functools import lru_cache
from itertools import zip_longest
from typing import NamedTuple

from attrs import field

from i7000 import dcon, modbus
from i7000.arguments import LARGEST_FLOAT, as_bytes, as_tuple, check_clock, check_seconds, check_type
from i7000.device.module import is_for, step
from i7000.device.signals import Signals
from i7000.device.state import State
from i7000.device.uart import Uart, hear_at
from i7000.errors import InvalidValueError, Noise
from i7000.frozen import frozen
from i7000.profile import Profile
from i7000.settings import LineSettings, Protocol

__all__ = ["Bus", "Ear", "Heard"]


class Reception(NamedTuple):
    """How some modules of a bus receive: their protocol, and their line settings if they differ from the host's."""

    protocol: Protocol
    uart: Uart | None


@frozen
class Ear:
    """The receive state of one host: the sent bytes that may still become a frame.

    Shape: `uart` has the line settings of the host; None means those of each module, for networks and pseudo-terminals,
        which have no line settings.
    """

    uart: Uart | None = None
    rests: tuple[tuple[Reception, bytes], ...] = field(default=(), kw_only=True)
    dcon_reported: bool = field(default=False, kw_only=True)
    """Whether a DCON frame was reported since the line was silent: modules of the other protocol hear it as noise."""

    def __attrs_post_init__(self) -> None:
        if self.uart is not None and not isinstance(self.uart, Uart):
            raise InvalidValueError("uart", self.uart, "a Uart, or None", "1.11")
        if not isinstance(self.rests, tuple) or not all(map(_is_rest, self.rests)):
            raise InvalidValueError("rests", self.rests, "the rests that `Bus.hear` returned", "")
        if not isinstance(self.dcon_reported, bool):
            raise InvalidValueError("dcon_reported", self.dcon_reported, "True or False", "")

    @property
    def waiting(self) -> bool:
        """Whether there are bytes that only silence can complete."""
        return any(reception.protocol is Protocol.MODBUS_RTU for reception, _ in self.rests)

    def ends_with(self, frame: bytes | Noise) -> bool:
        """Return whether all bytes that wait for silence end with a frame, so that nothing came after it."""
        if isinstance(frame, Noise):
            return False
        end = as_bytes("frame", frame)
        return self.waiting and all(rest.endswith(end) for _, rest in self.rests)


def _is_rest(rest: object) -> bool:
    return isinstance(rest, tuple) and len(rest) == 2 and isinstance(rest[0], Reception) and isinstance(rest[1], bytes)


@frozen
class Heard:
    """A frame that modules heard, with its effect; or bytes that are not a frame to any module."""

    frame: bytes | Noise
    protocol: Protocol
    module: int | None = None
    """The place on the bus of the addressed module; None for a broadcast, or for an address that no module has."""
    profile: Profile | None = None
    """The profile of the module before the frame."""
    answer: bytes | None = None
    delay: float = 0.0
    """The seconds that the module waits before its response (40488)."""


@frozen
class Bus:
    """Modules that all hear the same frames."""

    modules: tuple[State, ...]
    clock: float = field(default=-LARGEST_FLOAT, kw_only=True, eq=False, repr=False)
    """The time of the last call; it is not part of equality."""

    def __attrs_post_init__(self) -> None:
        if not isinstance(self.modules, tuple) or not {State}.issuperset(map(type, self.modules)):
            raise InvalidValueError("modules", self.modules, "a tuple of State", "")
        check_seconds("clock", self.clock)

    def step(self, frame: bytes, signals: Sequence[Signals], now: float) -> tuple["Bus", bytes | None]:
        r"""Give a frame to all modules; return the bus after it, and the response or None for silence.

        Shape: `signals` has the signals of each module, in the order of the modules.
        Errors: `InvalidValueError` for the wrong number of signals, and for a time that is not finite; `StateError` for
            a time before the last, as in `hear` and `silence`.
        Special: if several modules answer at once, each bit is 1 where all send 1 (E112, assumption): equal responses
            look like one.

        >>> from i7000 import Model
        >>> from i7000.device import factory, power_on
        >>> bus = Bus((power_on(factory(Model.I_7018), now=0.0), power_on(factory(Model.M_7019R), now=0.0)))
        >>> bus.step(b"$01M\r", (Signals(), Signals()), 0.0)[1]
        b'!017018\r'
        """
        frame, signals = as_bytes("frame", frame), self._checked(signals, now)
        after, answers = [], []
        for module, own in zip(self.modules, signals, strict=True):
            state, answer = step(module, frame, own, now)
            after.append(state)
            if answer is not None:
                answers.append(answer)
        return Bus(tuple(after), clock=now), _collided(answers)

    def _checked(self, signals: Sequence[Signals], now: float) -> tuple[Signals, ...]:
        """Check the time and the signals of each module."""
        check_clock(now, self.clock)
        signals = as_tuple("signals", signals)
        if not {Signals}.issuperset(map(type, signals)):
            for own in signals:
                check_type("signals", own, Signals)
        if len(signals) != len(self.modules):
            raise InvalidValueError("signals", len(signals), f"{len(self.modules)}, one for each module", "")
        return signals

    def hear(
        self, ear: Ear, data: bytes, signals: Sequence[Signals], now: float
    ) -> tuple["Bus", Ear, tuple[Heard, ...]]:
        r"""Give all modules the bytes that a host sends: a complete frame, a piece of one, or several.

        Special: bytes that are noise to some modules and a frame to others are reported only as the frame.

        >>> from i7000 import Model
        >>> from i7000.device import factory, power_on
        >>> bus, ear = Bus((power_on(factory(Model.I_7018), now=0.0),)), Ear()
        >>> bus, ear, heard = bus.hear(ear, b"$01", [Signals()], 0.0)
        >>> bus.hear(ear, b"M\r", [Signals()], 0.0)[2][0].answer
        b'!017018\r'
        """
        check_type("ear", ear, Ear)
        data, signals = as_bytes("data", data), self._checked(signals, now)
        rests = dict(ear.rests)
        found: list[tuple[Reception, bytes | Noise]] = []
        left = []
        for reception in dict.fromkeys([_reception(module, ear) for module in self.modules]):
            heard = data if ear.uart is None or reception.uart is None else hear_at(data, ear.uart, reception.uart)
            parts, rest = _split(reception, rests.get(reception, b"") + heard)
            found += [(reception, part) for part in parts]
            if rest:
                left.append((reception, rest))
        if len(data) > 1 and _is_mixed(found):
            return self._hear_in_turn(ear, data, signals, now)
        bus, told = self._hear(ear, found, signals, now)
        reported = ear.dcon_reported or any(it.protocol is Protocol.DCON for it in told)
        return bus, Ear(ear.uart, rests=tuple(left), dcon_reported=reported), told

    def _hear_in_turn(
        self, ear: Ear, data: bytes, signals: Sequence[Signals], now: float
    ) -> tuple["Bus", Ear, tuple[Heard, ...]]:
        """Process one half after the other, so that the frames of several protocols are in the order of their ends."""
        half = len(data) // 2
        bus, ear, first = self.hear(ear, data[:half], signals, now)
        bus, ear, second = bus.hear(ear, data[half:], signals, now)
        return bus, ear, _without_foreign_noise(first + second)

    def silence(self, ear: Ear, signals: Sequence[Signals], now: float) -> tuple["Bus", Ear, tuple[Heard, ...]]:
        """Process a silence of 3.5 characters for all modules; it ends a frame of Modbus RTU.

        Manual: 3.
        """
        check_type("ear", ear, Ear)
        signals = self._checked(signals, now)
        found = [(reception, part) for reception, rest in ear.rests for part in _flush(reception, rest)]
        left = tuple((reception, rest) for reception, rest in ear.rests if reception.protocol is Protocol.DCON)
        if ear.dcon_reported:
            found = [(reception, part) for reception, part in found if not isinstance(part, Noise)]
        bus, told = self._hear(ear, found, signals, now)
        return bus, Ear(ear.uart, rests=left), told

    def _hear(
        self, ear: Ear, found: Sequence[tuple[Reception, bytes | Noise]], signals: Sequence[Signals], now: float
    ) -> tuple["Bus", tuple[Heard, ...]]:
        modules, told = list(self.modules), []
        for reception, part in found:
            if isinstance(part, Noise):
                told.append(Heard(part, reception.protocol))
            else:
                told.append(_hear_frame(modules, ear, reception, part, signals, now))
        return Bus(tuple(modules), clock=now), _without_foreign_noise(told)


def _hear_frame(  # noqa: PLR0913, PLR0917 - those of the bus
    modules: list[State], ear: Ear, reception: Reception, frame: bytes, signals: Sequence[Signals], now: float
) -> Heard:
    """Give a frame to the modules that receive it, and replace their states."""
    asked: int | None = None
    before: State | None = None
    answers = []
    for place, module in enumerate(modules):
        if _reception(module, ear) != reception:
            continue
        if before is None and is_for(module, frame):
            asked, before = place, module
        modules[place], answer = step(module, frame, signals[place], now)
        if answer is not None:
            answers.append(answer)
    if before is None:
        return Heard(frame, reception.protocol)
    heard = _collided(answers)
    if heard is not None and ear.uart is not None and reception.uart is not None:
        heard = hear_at(heard, reception.uart, ear.uart)
    return Heard(frame, reception.protocol, asked, before.profile, heard, before.response_delay)


_AT_ANY_LINE = {protocol: Reception(protocol, None) for protocol in Protocol}


def _reception(module: State, ear: Ear) -> Reception:
    if ear.uart is None:
        return _AT_ANY_LINE[module.ram.protocol]
    return _reception_at(module.ram.protocol, module.ram.line_settings, ear.uart)


@lru_cache(maxsize=4096)
def _reception_at(protocol: Protocol, line: LineSettings, uart: Uart) -> Reception:
    own = Uart.of(line)
    return Reception(protocol, None if own.sounds_like(uart) else own)


def _is_mixed(found: list[tuple[Reception, bytes | Noise]]) -> bool:
    """Return whether there are frames of several protocols, all unchanged by line settings."""
    receptions = {reception for reception, part in found if not isinstance(part, Noise)}
    return len(receptions) > 1 and all(reception.uart is None for reception in receptions)


def _without_foreign_noise(told: Sequence[Heard]) -> tuple[Heard, ...]:
    """Remove noise of some modules where others heard a frame."""
    spoken = {heard.protocol for heard in told if not isinstance(heard.frame, Noise)}
    return tuple([heard for heard in told if not spoken or heard.protocol in spoken])


def _split(reception: Reception, heard: bytes) -> tuple[tuple[bytes | Noise, ...], bytes]:
    if reception.protocol is Protocol.DCON:
        return dcon.split(heard)
    parts, rest = modbus.split(heard, modbus.Side.REQUESTS)
    last = parts[-1] if parts else b""
    if isinstance(last, Noise) and len(last.wire) + len(rest) <= modbus.LONGEST_FRAME:
        return parts[:-1], last.wire + rest  # It could be a request of an unknown function: wait for silence.
    return parts, rest


def _flush(reception: Reception, rest: bytes) -> tuple[bytes | Noise, ...]:
    return () if reception.protocol is Protocol.DCON else modbus.flush(rest, modbus.Side.REQUESTS)


def _collided(answers: list[bytes]) -> bytes | None:
    if not answers:
        return None
    heard, *others = answers
    for other in others:
        heard = bytes(one & two for one, two in zip_longest(heard, other, fillvalue=0xFF))
    return heard
