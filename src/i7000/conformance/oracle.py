"""Which answers of a module are allowed: those of its twin, the device model with the same settings.

Laws: settings, identity and refusals must be those of the twin, byte for byte. What a module measures, counts or
remembers since its power-on is unknown: there, any value that a module of this type can send is allowed.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import lru_cache
from typing import Any, Self, cast

from attrs import evolve, fields_dict

from i7000 import dcon, modbus
from i7000.device import Eeprom, Log, Signals, State, factory, power_on, step
from i7000.errors import DecodeError, Fault, shown
from i7000.frozen import frozen
from i7000.host.procedures import NOT_SETTINGS, Snapshot
from i7000.host.procedures.settings import known_settings
from i7000.message import Query, Response
from i7000.modbus import Area, Kind, Register
from i7000.models import Firmware, Model, series
from i7000.profile import Profile
from i7000.readings import Reading, Status
from i7000.settings import DataFormat, Protocol
from i7000.type_codes import MIXED

__all__ = ["Answer", "Twin", "difference", "eeprom_of", "is_exact", "rows_of"]


# --- the settings of a snapshot ---------------------------------------------------------------------------------------

_TENTHS = frozenset({"host_watchdog_timeout", "temperature_offset"})
_HUNDREDTHS = frozenset({"module_cjc_offset", "cjc_offset"})
_SCALES = {**dict.fromkeys(_TENTHS, 10), **dict.fromkeys(_HUNDREDTHS, 100)}
_FIELDS = {
    "module_cjc_offset": "cjc_offset",
    "sampling_rate": "sampling_rate_8_hz",
    "type_code": "type_codes",
    "temperature_offset": "channel_offsets",
    "cjc_offset": "channel_cjc_offsets",
}
"""The fields of `Eeprom` that are not named as the settings; 7018 modules keep all offsets in one of them."""
_7018_SERIES = series("7018")
_OF_REPORTS = frozenset({"data_format", "filter", "fast_mode", "checksum"})
_OF_LINE = frozenset({"baud_rate", "character_format"})
_DATES = ("year", "month", "date", "hour", "minute", "second")
_LOG_TUPLES: Mapping[str, tuple[str, ...]] = {"period": _DATES[3:], "start": _DATES, "end": _DATES}


def eeprom_of(snapshot: Snapshot) -> Eeprom:
    """Return the memory of a module with the settings of a snapshot; what was not read is as from the factory."""
    known = known_settings(snapshot.model)
    typed: dict[str, Any] = {name: known[name].values.typed(name, plain) for name, plain in snapshot.settings}
    fields = _FIELDS | ({"cjc_offset": "channel_offsets"} if snapshot.model in _7018_SERIES else {})
    memory = factory(snapshot.model, None if snapshot.firmware is None else Firmware(snapshot.firmware))
    changes: dict[str, Any] = {"protocol": snapshot.protocol}
    lists: dict[str, list[Any]] = {}
    report: dict[str, Any] = {}
    line: dict[str, Any] = {}
    log: dict[str, Any] = {}
    for name, of_people in typed.items():
        base, _, channel = name.partition(".")
        scale = 10 if fields.get(base) == "channel_offsets" else _SCALES.get(base)
        value = of_people if scale is None else round(of_people * scale)
        if base.startswith("log_"):
            log[base.removeprefix("log_")] = value
        elif base in _OF_REPORTS:
            report[base] = value
        elif base in _OF_LINE:
            line[base] = value
        elif channel:
            lists.setdefault(fields.get(base, base), list(getattr(memory, fields.get(base, base))))[int(channel)] = (
                value
            )
        elif base == "type_code":
            changes["type_codes"] = (value,) * len(memory.type_codes)
        else:
            changes[fields.get(base, base)] = value
    changes |= {name: tuple(values) for name, values in lists.items()}
    changes["report_settings"] = evolve(memory.report_settings, **report)
    changes["line_settings"] = evolve(memory.line_settings, **line)
    if log:
        changes["log"] = _log(memory.log, log)
    return evolve(memory, **changes)


def _log(log: Log, given: Mapping[str, Any]) -> Log:
    changes: dict[str, Any] = {}
    for field, parts in _LOG_TUPLES.items():
        held = getattr(log, field)
        changes[field] = tuple(given.get(f"{field}_{part}", old) for part, old in zip(parts, held, strict=True))
    return evolve(
        log, **changes, command=given.get("command", log.command), overwrite=bool(given.get("overwrite", log.overwrite))
    )


# --- the twin ---------------------------------------------------------------------------------------------------------


@frozen
class Answer:
    """What the twin answers to a frame, and how to read it.

    Shape: `wire` is None for silence. `query` is the command or request; None if the twin does not have it. `profile`
        is that of the twin before the frame.
    """

    wire: bytes | None
    query: Query[Any] | None
    profile: Profile
    enabled: int
    """The mask of the channels that were on."""


@frozen
class Twin:
    """The device model with the settings of the module under test."""

    state: State

    @classmethod
    def of(cls, eeprom: Eeprom, now: float, *, init_switch: bool = False) -> Self:
        """Return the twin of a module, after its power-on."""
        return cls(power_on(eeprom, init_switch=init_switch, now=now))

    def hear(self, frame: bytes, now: float) -> tuple["Twin", Answer]:
        """Give the twin a whole frame; return it afterwards, with its answer."""
        state, wire = step(self.state, frame, Signals(), max(now, self.state.clock))
        return Twin(state), Answer(wire, _query(frame, self.state), self.state.profile, self.state.enabled)


def _query(frame: bytes, state: State) -> Query[Any] | None:
    decode: Any = modbus.decode_request if state.ram.protocol is Protocol.MODBUS_RTU else dcon.decode_command
    try:
        found: Query[Any] = decode(frame, state.profile)
    except DecodeError:
        return None
    return found


def difference(answer: Answer, heard: bytes) -> str | None:
    """Return what is wrong with the answer of a module, in words; None if it is allowed."""
    if heard == (answer.wire or b""):
        return None
    if answer.wire is None:
        return f"answered {len(heard)} bytes where silence is right"
    if not heard:
        return "no answer"
    return "another answer" if answer.query is None else _decoded_difference(answer, answer.query, answer.wire, heard)


def is_exact(answer: Answer) -> bool:
    """Return whether only the bytes of the twin are allowed: nothing in them is measured, remembered or open."""
    query: Any = answer.query
    if query is None:
        return True
    if isinstance(query, modbus.Request):
        if issubclass(query.response, (*_ANY_OF_ITS_FIELDS, modbus.ChannelMask)):
            return False
        first, places = getattr(query, "first_item", None), _places(answer.profile.model, _firmware(answer.profile))
        return (
            first is None
            or query.response.area is None
            or not any(_varies(places[query.response.area].get(first + at)) for at in range(getattr(query, "count", 1)))
        )
    return not issubclass(query.response, (*_READINGS, dcon.AnalogInput, *_UNKNOWN))


def _varies(place: tuple[Register, int] | None) -> bool:
    return place is not None and (
        place[0].kind in (Kind.READING, Kind.RECORD, Kind.INT8) or place[0].name in _REMEMBERED
    )


def _decoded_difference(answer: Answer, query: Query[Any], right: bytes, heard: bytes) -> str | None:
    of_modbus = isinstance(query, modbus.Request)
    decode: Any = modbus.decode_response if of_modbus else dcon.decode_response
    try:
        response = decode(heard, query, answer.profile)
    except DecodeError as error:
        return str(error)
    expected = decode(right, query, answer.profile)
    if type(response) is not type(expected):
        return f"{type(response).__name__} where {type(expected).__name__} is right"
    return (_modbus_difference if of_modbus else _dcon_difference)(answer, response, expected)


# --- DCON -------------------------------------------------------------------------------------------------------------

_BLANK = series("7019")
"""The models whose disabled channels are blanks (E25)."""
_UNKNOWN = (dcon.CjcTemperature, dcon.Diagnostics, dcon.HostWatchdogStatus, dcon.CjcUpdateSetting)
"""The responses that depend on what the module measures or remembers since its power-on."""


_READINGS = (dcon.AnalogInputs, dcon.AnalogInputsHex, dcon.SynchronizedData)


def _dcon_difference(answer: Answer, response: Response, expected: Response) -> str | None:
    if isinstance(response, _READINGS):
        channels = range(len(response.values))
        return _readings_difference(answer, lambda: readings_of(response, answer.profile), channels)
    if isinstance(response, dcon.AnalogInput):
        channel = cast(dcon.ReadAnalogInput, answer.query).channel
        return _readings_difference(answer, lambda: readings_of(response, answer.profile, channel), (channel,))
    if isinstance(response, _UNKNOWN):
        return None
    if isinstance(response, dcon.Configuration) and isinstance(expected, dcon.Configuration):
        return _configuration_difference(answer, response, expected)
    return _fields_difference(response, expected)


def _configuration_difference(answer: Answer, response: dcon.Configuration, expected: dcon.Configuration) -> str | None:
    """Compare configurations; the type code of channels that are set one by one is open (E81)."""
    if not answer.profile.model.type_by_configuration or expected.type_code == MIXED:
        response = evolve(response, type_code=expected.type_code)
    return None if response == expected else _fields_difference(response, expected)


def readings_of(
    response: dcon.AnalogInputs | dcon.AnalogInputsHex | dcon.SynchronizedData | dcon.AnalogInput,
    profile: Profile,
    channel: int = 0,
) -> tuple[Reading, ...]:
    """Return the readings of a report, or of one channel; how far they may be beyond their range is open (E121).

    Errors: `DecodeError` for a field of another form, and for a number with other decimals than its type has.
    """
    if isinstance(response, dcon.AnalogInput):
        fields: tuple[str, ...] = (response.value,)
        found: tuple[Reading, ...] = (dcon.reading(response, channel, profile, lenient=True),)
    else:
        fields = response.values
        found = dcon.readings(response, profile, lenient=True)
    if profile.data_format is DataFormat.ENGINEERING and not isinstance(response, dcon.AnalogInputsHex):
        for at, (text, reading) in enumerate(zip(fields, found, strict=True), channel):
            decimals = profile.type_codes[at].decimals
            if reading.value is not None and text[-1 - decimals] != ".":
                allowed = f"{decimals} decimals, type {profile.type_codes[at]:02X}"
                field = f"the value of channel {at}"
                raise DecodeError(Fault.NUMBER, text.encode(), field=field, allowed=allowed, section="1.11")
    return found


def _readings_difference(answer: Answer, read: Callable[[], Sequence[Reading]], channels: Iterable[int]) -> str | None:
    """Compare readings by their shape; what a disabled channel has is known of the fields of few models only (E25)."""
    if answer.profile.type_codes:
        try:
            readings = read()
        except DecodeError as error:
            return str(error)
        for channel, reading in zip(channels, readings, strict=True):
            disabled = not answer.enabled >> channel & 1
            blank = reading.status is Status.DISABLED
            if disabled and not blank and answer.profile.model in _BLANK:
                return f"channel {channel} is disabled, but not blank"
            if blank and not disabled:
                return f"channel {channel} is enabled, but blank"
    return None


def _fields_difference(response: Response, expected: Response) -> str:
    for name in fields_dict(type(expected)):  # type: ignore[arg-type] # of an attrs class
        value, right = getattr(response, name), getattr(expected, name)
        if value != right:
            return f"{name} is {shown(value)} where {shown(right)} is right"
    return "another answer, which means the same"


# --- Modbus -----------------------------------------------------------------------------------------------------------

_REMEMBERED = frozenset(NOT_SETTINGS) | {
    "range_status",
    "cjc_temperature",
    "temperature",
    "reset_status",
    "log_last_index",
    "log_status",
    "firmware_version",
}
"""The rows that depend on what the module measures or remembers, and those whose content is open (E75)."""
_ANY_OF_ITS_FIELDS = (modbus.CjcUpdateSetting, modbus.FirmwareVersion)
"""The responses of function 46h that are not known from the settings, or whose bytes are open (E75)."""


def _modbus_difference(answer: Answer, response: Any, expected: Any) -> str | None:  # noqa: ANN401 - of any request
    query: Any = answer.query
    if isinstance(response, _ANY_OF_ITS_FIELDS):
        return None
    if isinstance(response, modbus.ChannelMask):
        same = _swapped(response.mask, answer.profile) == expected.mask
        return None if same else _fields_difference(response, expected)
    if response.area is None or query.first_item is None or not hasattr(response, "values"):
        return _fields_difference(response, expected)
    places = _places(answer.profile.model, _firmware(answer.profile))[response.area]
    for at, (value, right) in enumerate(zip(response.values, expected.values, strict=True)):
        place = None if value == right else places.get(query.first_item + at)
        if place is None:
            continue
        row, item = place
        found = _item_difference(answer, row, value, right)
        if found:
            return f"{row.area.value}{row.address + item + 1:04d}: {found}"
    return None


def _swapped(mask: int, profile: Profile) -> int:
    """Return a mask of several bytes with their order reversed, which is open (E61)."""
    return int.from_bytes(mask.to_bytes(profile.mask_digits // 2, "big"), "little")


def _firmware(profile: Profile) -> str | None:
    return None if profile.firmware is None else profile.firmware.text


def rows_of(profile: Profile) -> tuple[Register, ...]:
    """Return the rows of the address map of a module."""
    return _rows_of(evolve(profile, type_codes=()))


@lru_cache(maxsize=64)
def _rows_of(profile: Profile) -> tuple[Register, ...]:
    return tuple(modbus.RegisterMap(profile))


@lru_cache(maxsize=64)
def _places(model: Model, firmware: str | None) -> Mapping[Area, Mapping[int, tuple[Register, int]]]:
    """Return the row of each address of a map, and the place of the item in its row."""
    profile = Profile(model, firmware=None if firmware is None else Firmware(firmware), type_codes=())
    found: dict[Area, dict[int, tuple[Register, int]]] = {area: {} for area in Area}
    for row in rows_of(profile):
        found[row.area] |= {row.address + at: (row, at) for at in range(row.count)}
    return found


def _item_difference(answer: Answer, row: Register, value: int, right: int) -> str | None:
    """Return what is wrong with an item that is not the one of the twin."""
    name = answer.profile.model.modbus_name
    if (
        row.kind is Kind.READING
        or (
            row.name == "module_name" and value.to_bytes(2, "big") in (name[:2], name[2:])
        )  # in which order, is open (E75)
        or (row.name == "module_type_code" and right == MIXED)  # E81
        or (
            row.name == "channel_mask" and answer.profile.model is Model.M_7018_16 and not (value ^ right) & 0xFF
        )  # E12
        or (row.kind is Kind.INT8 and not (value ^ right) & 0xFF)  # the high byte is open (E62)
    ):
        return None
    if row.kind is not Kind.RECORD and row.name not in _REMEMBERED:
        return f"{row.name} is {value} where {right} is right"
    number = value - 0x10000 if row.kind is Kind.INT16 and value > 0x7FFF else value
    if row.minimum is not None and row.maximum is not None and not row.minimum <= number <= row.maximum:
        return f"{row.name} is {number}, beyond {row.minimum}..{row.maximum}"
    return None
