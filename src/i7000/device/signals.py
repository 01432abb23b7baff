"""The signals at the inputs of a module, in physical units.

Laws: a signal is what a meter at the terminals shows; `i7000.device.measurement` computes the readings.
"""

from attrs import field, frozen

from i7000.arguments import check_int, is_number
from i7000.errors import InvalidValueError
from i7000.type_codes import Unit

__all__ = ["OPEN_WIRE", "Signal", "Signals"]


@frozen
class Signal:
    """The signal at one input: a voltage, a current, or the temperature of a thermocouple's hot end.

    Errors: `InvalidValueError` for a value that is not finite, and for an invalid unit.
    """

    value: float
    unit: Unit

    def __attrs_post_init__(self) -> None:
        if not is_number(self.value):
            raise InvalidValueError("value", self.value, "a finite number", "")
        if not isinstance(self.unit, Unit):
            raise InvalidValueError("unit", self.unit, f"a member of Unit: {', '.join(Unit.__members__)}", "")


OPEN_WIRE = None
"""An input without a connection."""

_COLDEST, _HOTTEST = -200.0, 200.0


def _degrees(value: float) -> float:
    return float(value) if is_number(value) else value


@frozen(cache_hash=True)
class Signals:
    """The signals at all inputs of a module, channel 0 first; inputs beyond the last one are open.

    Unit: `cold_junction`, the temperature at the terminals, in degrees Celsius.
    Errors: `InvalidValueError` for channels that are not a tuple of signals, and for a temperature that no module
        survives.

    >>> Signals.of(Unit.VOLT, 1.5, -2.0).channel(1), Signals().channel(7)
    (Signal(value=-2.0, unit=<Unit.VOLT: 'V'>), None)
    """

    channels: tuple[Signal | None, ...] = ()
    cold_junction: float = field(default=25.0, kw_only=True, converter=_degrees)

    def __attrs_post_init__(self) -> None:
        if not isinstance(self.channels, tuple) or not {Signal, type(OPEN_WIRE)}.issuperset(map(type, self.channels)):
            raise InvalidValueError("channels", self.channels, "a tuple of signals and open wires", "")
        if not is_number(self.cold_junction) or not _COLDEST <= self.cold_junction <= _HOTTEST:
            raise InvalidValueError("cold_junction", self.cold_junction, f"{_COLDEST:g}..{_HOTTEST:g} degC", "2.11")

    @classmethod
    def of(cls, unit: Unit, *values: float, cold_junction: float = 25.0) -> "Signals":
        """Return signals that all have the same unit."""
        return cls(tuple(Signal(value, unit) for value in values), cold_junction=cold_junction)

    def channel(self, number: int) -> Signal | None:
        """Return the signal of one channel; an open wire for a channel that is not connected."""
        check_int("number", number)
        return self.channels[number] if 0 <= number < len(self.channels) else OPEN_WIRE
