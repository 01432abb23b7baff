"""How a module is described: ``M-7019R@B3.7,address=2,type=K``.

Laws: any text gives a value or a `UsageError` that names what was written and what could have been.
"""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Any

from attrs import evolve, frozen

from i7000 import (
    BaudRate,
    CharacterFormat,
    DataFormat,
    Firmware,
    InvalidValueError,
    ModbusDataFormat,
    Model,
    Protocol,
    TypeCode,
    Unit,
    dcon,
)
from i7000.cli.choices import FILTERS, PROTOCOLS, protocol_word
from i7000.cli.numbers import baud_rate, integer
from i7000.cli.refusals import as_written
from i7000.cli.words import UsageError, channel_numbers, choice, member, model, near, quantity, truth, type_codes
from i7000.device import Eeprom, factory, power_on

__all__ = ["Described", "named", "read_module"]


@contextmanager
def named(*names: str) -> Iterator[None]:
    """Put the name of what is read in front of errors."""
    try:
        yield
    except (UsageError, InvalidValueError) as error:
        raise UsageError(": ".join((*names, str(error)))) from None


@frozen
class Described:
    """A module as it was described."""

    eeprom: Eeprom
    """Its settings."""
    init_switch: bool
    """Whether it gets power with the INIT switch set."""
    given: frozenset[str]
    """The names of the settings in the description, and ``firmware``."""


def read_module(text: str, address: int, given: str = "--model") -> Described:
    """Read a module.

    Shape: ``MODEL[@FIRMWARE][,name=value...]``; other settings have the factory default, the address is `address`.
        `given` is what the text was written after, for messages.
    Errors: `UsageError`.

    >>> described = read_module("I-7018@B2.9,type=K,checksum=true", 0x02)
    >>> eeprom = described.eeprom
    >>> eeprom.model.value, str(eeprom.firmware), eeprom.address, eeprom.type_codes[7].name, sorted(described.given)
    ('I-7018', 'B2.9', 2, 'K', ['checksum', 'firmware', 'type'])
    """
    head, *assignments = text.split(",")
    name, at, firmware = head.partition("@")
    written: dict[str, tuple[str, str]] = {}
    with named(f"{given} {text or repr(text)}"):
        made = factory(model(name.strip()), Firmware(firmware.strip()) if at else None)
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
        except InvalidValueError as refusal:
            if refusal.field not in written:
                raise
            raise as_written(refusal, *written[refusal.field]) from None
    names = {assignment.partition("=")[0].strip() for assignment in assignments}
    return Described(eeprom, init_switch, frozenset(names | {"firmware"} if at else names))


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
            raise UsageError(f"{assignment!r} is not name=value, such as type=K")
        if name not in _SETTINGS:
            hint = near(name, _SETTINGS) or f": the settings are {', '.join(_SETTINGS)}"
            raise UsageError(f"a module has no setting {name!r}{hint}")
        setting = _SETTINGS[name]
        before, _ = written.setdefault(setting.field, (name, value))
        if setting.field in values[setting.within]:
            raise UsageError(
                f"{name} is given twice" if before == name else f"give {before} or {name}: they are the same"
            )
        if not setting.scope.holds(made.model):
            raise UsageError(f"{made.model.value} has no {name}: {setting.scope.text}")
        with named(name):
            values[setting.within][setting.field] = setting.read(value, made)
    return values


def _check(eeprom: Eeprom) -> None:
    """Refuse settings that the module cannot have.

    Errors: `InvalidValueError`.
    """
    profile = power_on(eeprom, now=0.0).profile
    code = profile.type_codes[0]
    command = dcon.SetConfiguration(eeprom.address, eeprom.address, code, eeprom.line_settings, eeprom.report_settings)
    command.check(profile)


def _defined_baud_rate(text: str) -> BaudRate:
    rate = baud_rate(text)
    if not isinstance(rate, BaudRate):
        raise UsageError(
            f"{text} is not a baud rate: give one of {', '.join(str(known.bits_per_second) for known in BaudRate)}"
        )
    return rate


def _channels(text: str, made: Eeprom) -> int:
    return dcon.mask_of(channel_numbers(text, len(made.type_codes), "/"))


def _counts(unit: Unit | None, scale: int, low: int, high: int) -> Callable[[str], int]:
    """Read a number as so many counts of one `scale`-th."""

    def read(text: str) -> int:
        value, said = quantity(text)
        counts = round(min(max(value * scale, low - 1), high + 1))
        if said not in (None, unit) or abs(counts - value * scale) > _EXACT or not low <= counts <= high:
            span = f"{low / scale:g}..{high / scale:g} {unit or ''}".rstrip()
            raise UsageError(f"{text!r} is not within {span} in steps of {1 / scale:g}")
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
            raise UsageError(
                f"{text!r} has {len(found)} values: {made.model.value} takes {counts}, with / between them"
            )
        return found + others[len(found) :]

    return values


def _type(text: str) -> TypeCode:
    return type_codes(text)[0]


_EXACT = 1e-6
_HUNDREDTHS = _counts(Unit.CELSIUS, 100, -0x1000, 0x1000)
_TENTHS = _counts(Unit.CELSIUS, 10, -0x80, 0x7F)


@frozen
class _Scope:
    """The models that have a setting."""

    text: str
    holds: Callable[[Model], bool]


_EVERY = _Scope("every model", lambda model: True)  # noqa: ARG005
_MODBUS = _Scope("M-7000 series only", lambda model: Protocol.MODBUS_RTU in model.protocols)
_CJC = _Scope("7018 and 7019 series only", lambda model: model.cjc)
_7019 = _Scope("7019 series only", lambda model: model.series == "7019")
_OPEN_WIRE = _Scope("models that notice an open wire only", lambda model: model.open_wire_detection)


@frozen
class _Setting:
    """A setting in the description of a module."""

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
    "protocol": _of("protocol", lambda text: choice(protocol_word(text), PROTOCOLS)),
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
