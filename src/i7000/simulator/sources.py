"""Signal sources for the inputs of simulated modules.

Laws: a source is a pure function of the sample number. A source that could return an impossible value is refused when
it is made. Inputs are sampled `SAMPLES_A_SECOND` times a second, and a sample holds until the next.
"""

from array import array
from bisect import bisect_right
from collections.abc import Iterable
from functools import lru_cache
from itertools import islice
from math import floor, inf, isfinite, isnan, pi, sin
from operator import lt
from random import Random
from typing import TypeAlias

from attrs import Attribute, field, frozen

from i7000.device import OPEN_WIRE, Eeprom, Signal, Signals
from i7000.errors import InvalidValueError
from i7000.type_codes import TypeCode, Unit

__all__ = [
    "COLD_JUNCTION",
    "OPEN",
    "SAMPLES_A_SECOND",
    "Fixed",
    "Noise",
    "Ramp",
    "Recorded",
    "Sine",
    "Source",
    "Sources",
    "default_sources",
]

SAMPLES_A_SECOND = 10

COLD_JUNCTION = "cold_junction"
"""The column of a recording with the cold-junction temperatures."""

_ROOM_TEMPERATURE = 25.0
_MOST_DEVIATIONS = 4.0
_LATEST = 1e300
"""The longest simulation in seconds: tenths of it still fit in a float."""
_REMEMBERED = 1024
"""The number of cached samples, of all modules together: more than the modules on one line."""


def _finite(_: object, attribute: "Attribute[float]", value: float) -> None:
    if not isfinite(value):
        raise InvalidValueError(attribute.name, value, "a finite number", "")


def _not_negative(_: object, attribute: "Attribute[float]", value: float) -> None:
    if not 0 <= value < inf:
        raise InvalidValueError(attribute.name, value, "0 or more", "")


def _positive(_: object, attribute: "Attribute[float]", value: float) -> None:
    if not 0 < value < inf:
        raise InvalidValueError(attribute.name, value, "more than 0 seconds", "")


# --- sources ----------------------------------------------------------------------------------------------------------


@frozen
class Fixed:
    """A constant value, or an open wire."""

    signal: Signal | None

    @property
    def extremes(self) -> tuple[Signal | None, ...]:
        """The values that it can return."""
        return (self.signal,)

    def sample(self, number: int) -> Signal | None:  # noqa: ARG002 - the same for all
        """Return the value at a sample number."""
        return self.signal


OPEN = Fixed(OPEN_WIRE)
"""An open wire: nothing is connected."""


@frozen
class Ramp:
    """A sawtooth: from `low` up towards `high` in `period`, then at once back to `low`.

    Unit: `period` in seconds.
    Errors: `InvalidValueError`.

    >>> Ramp(0, 10, 60, Unit.VOLT).sample(150)
    Signal(value=2.5, unit=<Unit.VOLT: 'V'>)
    """

    low: float = field(converter=float, validator=_finite)
    high: float = field(converter=float, validator=_finite)
    period: float = field(converter=float, validator=_positive)
    unit: Unit

    def __attrs_post_init__(self) -> None:
        if self.high < self.low:
            raise InvalidValueError("high", self.high, f"{self.low:g} or more", "")

    @property
    def extremes(self) -> tuple[Signal | None, ...]:
        """The lowest and the highest value."""
        return Signal(self.low, self.unit), Signal(self.high, self.unit)

    def sample(self, number: int) -> Signal | None:
        """Return the value at a sample number."""
        done = _phase(number, self.period)
        value = self.low * (1 - done) + self.high * done  # never more than the larger of both, as high - low might be
        return Signal(min(max(value, self.low), self.high), self.unit)


@frozen
class Sine:
    """A sine around `mean`, which is its first value.

    Unit: `period` in seconds.
    Errors: `InvalidValueError`.

    >>> [Sine(5, 2, 1.2, Unit.VOLT).sample(number).value for number in (0, 3, 9)]
    [5.0, 7.0, 3.0]
    """

    mean: float = field(converter=float, validator=_finite)
    amplitude: float = field(converter=float, validator=_not_negative)
    period: float = field(converter=float, validator=_positive)
    unit: Unit

    def __attrs_post_init__(self) -> None:
        _ = self.extremes

    @property
    def extremes(self) -> tuple[Signal | None, ...]:
        """The lowest and the highest value."""
        return Signal(self.mean - self.amplitude, self.unit), Signal(self.mean + self.amplitude, self.unit)

    def sample(self, number: int) -> Signal | None:
        """Return the value at a sample number."""
        return Signal(self.mean + self.amplitude * sin(2 * pi * _phase(number, self.period)), self.unit)


@frozen
class Noise:
    """Normally distributed values around `mean`, new at each sample and limited to 4 deviations.

    Special: the same seed repeats the noise.
    Errors: `InvalidValueError`.

    >>> Noise(5, 0.1, Unit.VOLT, seed=1).sample(7) == Noise(5, 0.1, Unit.VOLT, seed=1).sample(7)
    True
    """

    mean: float = field(converter=float, validator=_finite)
    deviation: float = field(converter=float, validator=_not_negative)
    unit: Unit
    seed: int | str = field(default=0, kw_only=True)

    def __attrs_post_init__(self) -> None:
        _ = self.extremes

    @property
    def extremes(self) -> tuple[Signal | None, ...]:
        """The lowest and the highest value."""
        most = _MOST_DEVIATIONS * self.deviation
        return Signal(self.mean - most, self.unit), Signal(self.mean + most, self.unit)

    def sample(self, number: int) -> Signal | None:
        """Return the value at a sample number."""
        deviations = Random(f"{self.seed} {number}").gauss(0.0, 1.0)  # noqa: S311 - no secret
        deviations = min(max(deviations, -_MOST_DEVIATIONS), _MOST_DEVIATIONS)
        return Signal(self.mean + self.deviation * deviations, self.unit)


def _doubles(values: Iterable[float]) -> "array[float]":
    return values if isinstance(values, array) else array("d", values)


@frozen(cache_hash=True)
class Recorded:
    """Recorded values: each holds until the next row, the last for ever; the first also holds before its time.

    Shape: `seconds` of each row, ascending, and as many `values`, nan for an open wire. Arrays are not copied; do not
        change them.
    Errors: `InvalidValueError`.

    >>> from math import nan
    >>> recorded = Recorded((0, 2.5), (1.5, nan), Unit.VOLT)
    >>> recorded.sample(24), recorded.sample(25)
    (Signal(value=1.5, unit=<Unit.VOLT: 'V'>), None)
    """

    seconds: "array[float]" = field(converter=_doubles, eq=array.tobytes)
    values: "array[float]" = field(converter=_doubles, eq=array.tobytes)
    unit: Unit

    def __attrs_post_init__(self) -> None:
        if not self.seconds or len(self.seconds) != len(self.values):
            raise InvalidValueError("values", self.values, "as many as seconds, and at least one", "")
        if not (self.seconds[0] >= 0 and self.seconds[-1] < inf):
            raise InvalidValueError("seconds", self.seconds, "0 or more", "")
        if not all(map(lt, self.seconds, islice(self.seconds, 1, None))):
            raise InvalidValueError("seconds", self.seconds, "each more than the one before", "")
        if not isfinite(sum(self.values)) and inf in map(abs, self.values):
            raise InvalidValueError("values", self.values, "finite numbers, or nan for an open wire", "")

    @property
    def extremes(self) -> tuple[Signal | None, ...]:
        """The lowest and the highest value, and an open wire if there is one."""
        known = [value for value in self.values if not isnan(value)]
        found = [Signal(value, self.unit) for value in (min(known), max(known))] if known else []
        return (*found, OPEN_WIRE) if len(known) < len(self.values) else tuple(found)

    def sample(self, number: int) -> Signal | None:
        """Return the value at a sample number."""
        row = bisect_right(self.seconds, number / SAMPLES_A_SECOND) - 1
        value = self.values[max(row, 0)]
        return OPEN_WIRE if isnan(value) else Signal(value, self.unit)


Source: TypeAlias = Fixed | Ramp | Sine | Noise | Recorded


def _phase(number: int, period: float) -> float:
    """Return the elapsed part of the period: 0.0 up to less than 1.0."""
    samples = period * SAMPLES_A_SECOND
    return number % samples / samples


# --- of a module ------------------------------------------------------------------------------------------------------


@frozen(cache_hash=True)
class Sources:
    """The sources connected to a module, channel 0 first; inputs without a source are open.

    Errors: `InvalidValueError` for a cold junction that can be anything but a valid temperature of `Signals`.

    >>> sources = Sources((Ramp(0, 10, 60, Unit.VOLT), OPEN))
    >>> sources.at(15.07).channels, sources.at(15.07) is sources.at(15.0)
    ((Signal(value=2.5, unit=<Unit.VOLT: 'V'>), None), True)
    """

    channels: tuple[Source, ...] = ()
    cold_junction: Source = Fixed(Signal(_ROOM_TEMPERATURE, Unit.CELSIUS))
    _constant: Signals | None = field(init=False, eq=False, repr=False)
    """The signals, if they never change."""

    def __attrs_post_init__(self) -> None:
        for signal in self.cold_junction.extremes:
            _temperature(signal)
        constant = all(isinstance(source, Fixed) for source in (*self.channels, self.cold_junction))
        object.__setattr__(self, "_constant", _sample(self, 0) if constant else None)

    def at(self, seconds: float) -> Signals:
        """Return the signals at a time: those of the last sample, and the same object while nothing changes.

        Time: seconds from the start.
        Errors: `InvalidValueError` for an invalid time.
        """
        if not 0 <= seconds < inf:
            raise InvalidValueError("seconds", seconds, "0 or more", "")
        if self._constant is not None:
            return self._constant
        return _remembered_sample(self, floor(min(seconds, _LATEST) * SAMPLES_A_SECOND))


def _sample(sources: Sources, number: int) -> Signals:
    channels = tuple([source.sample(number) for source in sources.channels])
    return _one(Signals(channels, cold_junction=_temperature(sources.cold_junction.sample(number))))


_remembered_sample = lru_cache(_REMEMBERED)(_sample)


@lru_cache(_REMEMBERED)
def _one(signals: Signals) -> Signals:
    """Return one object for all equal signals."""
    return signals


def _temperature(signal: Signal | None) -> float:
    """Return the temperature of a cold junction.

    Errors: `InvalidValueError`, also from `Signals`, which checks the limits.
    """
    if signal is None or signal.unit is not Unit.CELSIUS:
        raise InvalidValueError(COLD_JUNCTION, signal, "a temperature in degC", "2.11")
    return Signals(cold_junction=signal.value).cold_junction


def default_sources(eeprom: Eeprom) -> Sources:
    """Return the default sources of a module: a different value within the span for each channel.

    Special: the cold junction has 25 degC.

    >>> from i7000.device import factory
    >>> from i7000.models import Model
    >>> [source.signal.value for source in default_sources(factory(Model.I_7017)).channels]
    [1.111, 2.222, 3.333, 4.444, 5.556, 6.667, 7.778, 8.889]
    """
    count = len(eeprom.type_codes)
    return Sources(tuple(_within(code, (channel + 1) / (count + 1)) for channel, code in enumerate(eeprom.type_codes)))


def _within(code: TypeCode, part: float) -> Fixed:
    low = max(0.0, code.minimum)
    return Fixed(Signal(round(low + (code.maximum - low) * part, code.decimals), code.unit))
