"""How signals on the inputs of simulated modules are written: ``2:0-3=ramp:0V:10V:60``.

Laws: any text gives a value or a `UsageError` that names what was written and what could have been.
"""

from collections.abc import Callable, Iterable, Sequence
from functools import cache

from i7000 import InvalidValueError, Unit
from i7000.cli.module import named
from i7000.cli.numbers import integer
from i7000.cli.words import (
    UsageError,
    channel_numbers,
    near,
    quantity,
)
from i7000.describe import address as address_words
from i7000.device import Eeprom, Signal
from i7000.simulator.files import UnsuitableFileError
from i7000.simulator.recordings import read_recording
from i7000.simulator.sources import (
    COLD_JUNCTION,
    OPEN,
    Fixed,
    Noise,
    Ramp,
    Sine,
    Source,
    Sources,
    default_sources,
)

__all__ = ["read_signals"]


# --- signals ----------------------------------------------------------------------------------------------------------

_FORMS = {
    "ramp": "ramp:LOW:HIGH:SECONDS",
    "sine": "sine:MEAN:AMPLITUDE:SECONDS",
    "noise": "noise:MEAN:DEVIATION",
    "open": "open",
    "csv": "csv:FILE",
}


def read_signals(
    texts: Iterable[str], eeproms: Sequence[Eeprom], seed: int = 0, connected: Iterable[Sources] | None = None
) -> tuple[Sources, ...]:
    """Read what is connected to each of several modules; the rest is as in `connected`, or that of `default_sources`.

    Shape: ``[ADDRESS:]CHANNELS=SOURCE``, for the modules with that address or for all; later ones count.
        CHANNELS: ``0``, ``0-3``, ``0,2,5``, ``all``, or ``cjc``. SOURCE: a quantity, ``open``, or one of the others
        with colons between its parts; numbers without a unit have that of the type of the channel.
    Special: each noise is another one, with the same `seed` the same each time.
    Errors: `UsageError`.

    >>> from i7000 import Model
    >>> from i7000.device import factory
    >>> (sources,) = read_signals(["all=open", "01:0-1=ramp:0:10:60"], [factory(Model.I_7017)])
    >>> sources.channels[0], sources.channels[2] is OPEN
    (Ramp(low=0.0, high=10.0, period=60.0, unit=<Unit.VOLT: 'V'>), True)
    """
    found = [default_sources(eeprom) for eeprom in eeproms] if connected is None else list(connected)
    for text in texts:
        with named(repr(text)):
            where, equals, what = text.partition("=")
            if not equals:
                raise UsageError("write [ADDRESS:]CHANNELS=SIGNAL, such as 0=1.5V")
            address, _, channels = where.rpartition(":")
            make = _maker(what.strip())
            for module in _addressed(address.strip(), eeproms):
                units = _units(channels.strip(), eeproms[module])
                found[module] = _connected(found[module], make(units, f"{seed}.{module}"))
    return tuple(found)


def _addressed(address: str, eeproms: Sequence[Eeprom]) -> list[int]:
    """Return the modules with the address; all if it is empty."""
    if not address:
        return list(range(len(eeproms)))
    wanted = integer(address)
    found = [module for module, eeprom in enumerate(eeproms) if eeprom.address == wanted]
    if not found:
        known = ", ".join(map(address_words, sorted({eeprom.address for eeprom in eeproms})))
        raise UsageError(f"no module has the address {address_words(wanted)}, only {known}")
    return found


def _units(text: str, eeprom: Eeprom) -> dict[str, Unit]:
    """Return the columns of a recording that are meant, with the units of plain numbers in them."""
    if text.lower() == "cjc":
        return {COLD_JUNCTION: Unit.CELSIUS}
    try:
        channels = channel_numbers(text, len(eeprom.type_codes))
    except UsageError as error:
        raise UsageError(f"{eeprom.model.value} at {address_words(eeprom.address)}: {error}; or cjc") from None
    return {str(channel): eeprom.type_codes[channel].unit for channel in channels}


def _connected(sources: Sources, changed: dict[str, Source]) -> Sources:
    """Change what is connected, by columns."""
    channels = tuple(changed.get(str(channel), source) for channel, source in enumerate(sources.channels))
    try:
        return Sources(channels, changed.get(COLD_JUNCTION, sources.cold_junction))
    except InvalidValueError as refusal:  # of the cold junction: the others are sources
        raise UsageError(f"cjc must be {refusal.allowed}") from None


def _maker(text: str) -> Callable[[dict[str, Unit], str], dict[str, Source]]:
    """Read what is the same for all modules: the result makes the sources of columns with units, and a seed."""
    kind, _, file = text.partition(":")
    if kind.lower() != "csv" or not file:
        return lambda units, seed: {name: _source(text, unit, f"{seed}.{name}") for name, unit in units.items()}
    read = cache(_recording)  # once for all modules of the same types
    return lambda units, seed: read(file, tuple(units.items()))  # noqa: ARG005


def _recording(file: str, units: Iterable[tuple[str, Unit]]) -> dict[str, Source]:
    try:
        return {**read_recording(file, dict(units))}
    except UnsuitableFileError as error:
        raise UsageError(error) from None
    except OSError as error:
        raise UsageError(f"{file}: {error.strerror}") from None
    except ValueError as error:  # what is wrong in it, or no name of a file
        raise UsageError(f"{file}: {error}") from None


def _source(text: str, unit: Unit, seed: str) -> Source:
    kind, *parts = text.split(":")
    match kind.lower(), parts:
        case "open", []:
            return OPEN
        case "ramp", [low_text, high_text, period]:
            low, high, unit = _pair(low_text, high_text, unit)
            return Ramp(low, high, _seconds(period), unit)
        case "sine", [mean_text, amplitude_text, period]:
            mean, amplitude, unit = _pair(mean_text, amplitude_text, unit)
            return Sine(mean, amplitude, _seconds(period), unit)
        case "noise", [mean_text, deviation_text]:
            mean, deviation, unit = _pair(mean_text, deviation_text, unit)
            return Noise(mean, deviation, unit, seed=seed)
    if kind.lower() in _FORMS:
        raise UsageError(f"{text!r} is not {_FORMS[kind.lower()]}")
    if kind[:1].isalpha():
        forms = ", ".join(_FORMS.values())
        raise UsageError(
            f"{text!r} is not a signal: give a quantity such as 1.5V, {forms}{near(kind.lower(), list(_FORMS))}"
        )
    value, said = quantity(text)
    return Fixed(Signal(value, said or unit))


def _pair(first: str, second: str, unit: Unit) -> tuple[float, float, Unit]:
    """Read two quantities of one unit, which is needed only once."""
    (first_value, first_unit), (second_value, second_unit) = quantity(first), quantity(second)
    if first_unit and second_unit and first_unit is not second_unit:
        raise UsageError(f"{first} and {second} have different units")
    return first_value, second_value, first_unit or second_unit or unit


def _seconds(text: str) -> float:
    value, unit = quantity(text.removesuffix("s"))
    if unit:
        raise UsageError(f"{text!r} is not a time: give seconds without a unit")
    return value
