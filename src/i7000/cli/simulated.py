"""How simulated modules and what is connected to them are written.

Notation: ``M-7019R@B3.7,address=02,type=K`` is a module, ``02:0-3=ramp:0V:10V:60`` what is on some of its channels.
Laws: any text gives a value or a `UsageError` that names what was written and what could have been.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from typing import Any

from attrs import evolve, frozen

from i7000 import (
    BaudRate,
    CharacterFormat,
    DataFormat,
    EncodeError,
    Firmware,
    ModbusDataFormat,
    Model,
    Protocol,
    TypeCode,
    Unit,
    dcon,
)
from i7000.cli.choices import FILTERS, PROTOCOLS
from i7000.cli.numbers import integer
from i7000.cli.refusals import as_written
from i7000.cli.words import (
    UsageError,
    baud_rate,
    channel_numbers,
    choice,
    member,
    near,
    quantity,
    truth,
    type_codes,
)
from i7000.device import Eeprom, Signal, factory, power_on
from i7000.dissect.numbers import address_words
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

__all__ = ["read_module", "read_signals"]


@contextmanager
def _named(*names: str) -> Iterator[None]:
    """Tell in errors what was read."""
    try:
        yield
    except (UsageError, EncodeError) as error:
        raise UsageError(": ".join((*names, str(error)))) from None


# --- modules ----------------------------------------------------------------------------------------------------------


def read_module(text: str, address: int) -> tuple[Eeprom, bool]:
    """Read a module: what it remembers, and whether it gets power with the INIT switch set.

    Shape: ``MODEL[@FIRMWARE][,name=value...]``; what is not said is the factory's, but the address, which is `address`.
    Errors: `UsageError`.

    >>> eeprom, init = read_module("I-7018@B2.9,type=K,checksum=true", 0x02)
    >>> eeprom.model.value, str(eeprom.firmware), eeprom.address, eeprom.type_codes[7].name, init
    ('I-7018', 'B2.9', 2, 'K', False)
    """
    head, *assignments = text.split(",")
    model, at, firmware = head.partition("@")
    written: dict[str, tuple[str, str]] = {}
    with _named(repr(text)):
        made = factory(Model.find(model.strip()), Firmware(firmware.strip()) if at else None)
        values = _assigned(assignments, made, written)
        init_switch = values[""].pop("init_switch", False)
        try:
            eeprom = evolve(
                made,
                line_settings=evolve(made.line_settings, **values["line_settings"]),
                report_settings=evolve(made.report_settings, **values["report_settings"]),
                **{"address": address} | values[""],
            )
            _check(eeprom)
        except EncodeError as refusal:
            if refusal.field not in written:
                raise
            raise as_written(refusal, *written[refusal.field]) from None
    return eeprom, init_switch


def _assigned(
    assignments: Iterable[str], made: Eeprom, written: dict[str, tuple[str, str]]
) -> dict[str, dict[str, Any]]:
    """Read the values of fields: those of the EEPROM, and those of its bytes CC and FF.

    Special: `written` gets the name and text of each field.
    """
    values: dict[str, dict[str, Any]] = {"": {}, "line_settings": {}, "report_settings": {}}
    for assignment in assignments:
        name, equals, value = (part.strip() for part in assignment.partition("="))
        if not equals:
            raise UsageError(f"{assignment!r} is not name=value")
        if name not in _SETTINGS:
            raise UsageError(f"a module has no {name!r}: {', '.join(_SETTINGS)}{near(name, list(_SETTINGS))}")
        setting = _SETTINGS[name]
        before, _ = written.setdefault(setting.field, (name, value))
        if setting.field in values[setting.within]:
            raise UsageError(
                f"{name} is given twice" if before == name else f"give {before} or {name}: they are the same"
            )
        if not setting.scope.holds(made.model):
            raise UsageError(f"{made.model.value} has no {name}: {setting.scope.text}")
        with _named(name):
            values[setting.within][setting.field] = setting.read(value, made)
    return values


def _check(eeprom: Eeprom) -> None:
    """Refuse what the module could not have been set to.

    Errors: `EncodeError`.
    """
    profile = power_on(eeprom, now=0.0).profile
    code = profile.type_codes[0]
    command = dcon.SetConfiguration(eeprom.address, eeprom.address, code, eeprom.line_settings, eeprom.report_settings)
    command.check(profile)


def _defined_baud_rate(text: str) -> BaudRate:
    rate = baud_rate(text)
    if not isinstance(rate, BaudRate):
        raise UsageError(f"{text} baud is none of {', '.join(str(known.bits_per_second) for known in BaudRate)}")
    return rate


def _channels(text: str, made: Eeprom) -> int:
    return dcon.mask_of(channel_numbers(text, len(made.type_codes), "/"))


def _counts(unit: Unit | None, scale: int, low: int, high: int) -> Callable[[str], int]:
    """Read a number as so many counts of one `scale`-th."""

    def read(text: str) -> int:
        value, said = quantity(text)
        counts = round(min(max(value * scale, low - 1), high + 1))
        if said not in (None, unit) or abs(counts - value * scale) > _EXACT or not low <= counts <= high:
            span = f"{low / scale:g}..{high / scale:g} in steps of {1 / scale:g}"
            raise UsageError(f"{text!r} cannot be: {span} {unit or ''}".rstrip())
        return counts

    return read


def _each(field: str, read: Callable[[str], Any]) -> Callable[[str, Eeprom], tuple[Any, ...]]:
    """Read one for all channels, or one for each; for the connecting mode with fewer channels too."""

    def values(text: str, made: Eeprom) -> tuple[Any, ...]:
        found = tuple(map(read, text.split("/")))
        others: tuple[Any, ...] = getattr(made, field)
        if len(found) == 1:
            return found * len(others)
        if len(found) not in (made.model.channels, len(others)):
            counts = " or ".join(map(str, sorted({1, made.model.channels, len(others)})))
            raise UsageError(f"{text!r} has {len(found)} values: {counts} with / between, {made.model.value}")
        return found + others[len(found) :]

    return values


def _type(text: str) -> TypeCode:
    return type_codes(text)[0]


_EXACT = 1e-6
_HUNDREDTHS = _counts(Unit.CELSIUS, 100, -0x1000, 0x1000)
_TENTHS = _counts(Unit.CELSIUS, 10, -0x80, 0x7F)


@frozen
class _Scope:
    """Who has a setting."""

    text: str
    holds: Callable[[Model], bool]


_EVERY = _Scope("every model", lambda model: True)  # noqa: ARG005
_MODBUS = _Scope("M-7000 series only", lambda model: Protocol.MODBUS_RTU in model.protocols)
_CJC = _Scope("7018 and 7019 series only", lambda model: model.cjc)
_7019 = _Scope("7019 series only", lambda model: model.series == "7019")
_OPEN_WIRE = _Scope("models that notice an open wire only", lambda model: model.open_wire_detection)


@frozen
class _Setting:
    """What can be said of a module."""

    field: str
    read: Callable[[str, Eeprom], Any]
    scope: _Scope = _EVERY
    within: str = ""
    """The byte of the EEPROM that it is in."""


def _of(field: str, read: Callable[[str], Any], scope: _Scope = _EVERY, within: str = "") -> _Setting:
    return _Setting(field, lambda text, made: read(text), scope, within)  # noqa: ARG005


_SETTINGS: dict[str, _Setting] = {
    "address": _of("address", integer),
    "type": _Setting("type_codes", _each("type_codes", _type)),
    "protocol": _of("protocol", lambda text: choice(text, PROTOCOLS)),
    "baud": _of("baud_rate", _defined_baud_rate, within="line_settings"),
    "character_format": _of("character_format", lambda text: member(text, CharacterFormat), within="line_settings"),
    "checksum": _of("checksum", truth, within="report_settings"),
    "format": _of("data_format", lambda text: member(text, DataFormat), within="report_settings"),
    "fast_mode": _of("fast_mode", truth, within="report_settings"),
    "filter": _of("filter", lambda text: choice(text, FILTERS), within="report_settings"),
    "modbus_format": _of("modbus_data_format", lambda text: member(text, ModbusDataFormat), _MODBUS),
    "response_delay": _of("response_delay", integer, _MODBUS),
    "single_ended": _of("single_ended", truth),
    "mask": _of("channel_mask", integer),
    "channels": _Setting("channel_mask", _channels),
    "name": _of("name", str),
    "init": _of("init_switch", truth),
    "open_wire_detection": _of("open_wire_detection", truth, _OPEN_WIRE),
    "cjc_enabled": _of("cjc_enabled", truth, _CJC),
    "cjc_offset": _of("cjc_offset", _HUNDREDTHS, _CJC),
    "channel_offsets": _Setting("channel_offsets", _each("channel_offsets", _TENTHS), _CJC),
    "channel_cjc_offsets": _Setting("channel_cjc_offsets", _each("channel_cjc_offsets", _HUNDREDTHS), _7019),
    "host_watchdog_enabled": _of("host_watchdog_enabled", truth),
    "host_watchdog_timeout": _of("host_watchdog_timeout", _counts(None, 10, 0, 0xFF)),
}


# --- signals ----------------------------------------------------------------------------------------------------------

_FORMS = {
    "ramp": "ramp:LOW:HIGH:SECONDS",
    "sine": "sine:MEAN:AMPLITUDE:SECONDS",
    "noise": "noise:MEAN:DEVIATION",
    "open": "open",
    "csv": "csv:FILE",
}


def read_signals(texts: Iterable[str], eeproms: Sequence[Eeprom], seed: int = 0) -> tuple[Sources, ...]:
    """Read what is connected to each of several modules; what is not said is that of `default_sources`.

    Shape: ``[ADDRESS:]CHANNELS=SOURCE``, for the modules with that address or for all; later ones count.
        CHANNELS: ``0``, ``0-3``, ``0,2,5``, ``all``, or ``cjc``. SOURCE: a quantity, ``open``, or one of the others
        with colons between its parts; numbers without a unit have that of the type of the channel.
    Special: each noise is another one, with the same `seed` the same each time.
    Errors: `UsageError`.

    >>> from i7000.device import factory
    >>> (sources,) = read_signals(["all=open", "01:0-1=ramp:0:10:60"], [factory(Model.I_7017)])
    >>> sources.channels[0], sources.channels[2] is OPEN
    (Ramp(low=0.0, high=10.0, period=60.0, unit=<Unit.VOLT: 'V'>), True)
    """
    found = [default_sources(eeprom) for eeprom in eeproms]
    for text in texts:
        with _named(repr(text)):
            where, equals, what = text.partition("=")
            if not equals:
                raise UsageError("it is not [ADDRESS:]CHANNELS=SOURCE")
            address, _, channels = where.rpartition(":")
            make = _maker(what.strip())
            for module in _addressed(address.strip(), eeproms):
                units = _units(channels.strip(), eeproms[module])
                found[module] = _connected(found[module], make(units, f"{seed}.{module}"))
    return tuple(found)


def _addressed(address: str, eeproms: Sequence[Eeprom]) -> list[int]:
    """Tell which modules have the address; all, if none is given."""
    if not address:
        return list(range(len(eeproms)))
    wanted = integer(address)
    found = [module for module, eeprom in enumerate(eeproms) if eeprom.address == wanted]
    if not found:
        known = ", ".join(map(address_words, sorted({eeprom.address for eeprom in eeproms})))
        raise UsageError(f"no module has the address {address_words(wanted)}, only {known}")
    return found


def _units(text: str, eeprom: Eeprom) -> dict[str, Unit]:
    """Tell which columns of a recording are meant, and the units of plain numbers there."""
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
    return Sources(channels, changed.get(COLD_JUNCTION, sources.cold_junction))


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
        raise UsageError(f"{text!r} is no source: a quantity as 1.5V, {forms}{near(kind.lower(), list(_FORMS))}")
    value, said = quantity(text)
    return Fixed(Signal(value, said or unit))


def _pair(first: str, second: str, unit: Unit) -> tuple[float, float, Unit]:
    """Read two quantities of one unit, which need be said only once."""
    (first_value, first_unit), (second_value, second_unit) = quantity(first), quantity(second)
    if first_unit and second_unit and first_unit is not second_unit:
        raise UsageError(f"{first} and {second} have different units")
    return first_value, second_value, first_unit or second_unit or unit


def _seconds(text: str) -> float:
    value, unit = quantity(text.removesuffix("s"))
    if unit:
        raise UsageError(f"{text!r} is no time: seconds")
    return value
