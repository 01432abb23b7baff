"""What stands at which address: the maps of the manual as rules on the model and its firmware (manual 3.1, 3.2, 3.4).

Laws: a row of a map is computed here from what the model has; the nine maps as printed stand in ``spec/tables``. A
thing has one name in every map, and a row for each of its numbers where the manual gives it two (30001 and 40001).
"""

from collections.abc import Iterator
from enum import Enum

from attrs import evolve

from i7000.frozen import frozen
from i7000.modbus.cold_junction import OFFSET_LIMIT
from i7000.models import CONFIGURABLE, Gates, Model, gates, series
from i7000.profile import Profile
from i7000.settings import Protocol

__all__ = ["Access", "Area", "Kind", "Register", "rows"]


class Area(Enum):
    """A table of addresses: the digit that the manual puts before its numbers."""

    bits: bool
    """Whether an item is one bit; else it is 16."""

    COIL = 0
    DISCRETE_INPUT = 1
    INPUT_REGISTER = 3
    HOLDING_REGISTER = 4


for _area in Area:
    _area.bits = _area in (Area.COIL, Area.DISCRETE_INPUT)


class Kind(Enum):
    """How the bits or words of an item are a value."""

    width: int
    """Items that one value takes."""

    BOOL = "bool"
    READING = "reading"
    """A word in the Modbus data format."""
    UINT16 = "uint16"
    INT16 = "int16"
    INT8 = "int8"
    """The low byte in two's complement, the high byte zero (E62)."""
    UINT32 = "uint32"
    """Two registers, the low word first; where clock and log are concerned, as the coil ``big_endian`` says (E75)."""
    CODE = "code"
    BITS = "bits"
    RECORD = "record"
    """16 readings and a time stamp of two registers."""


for _kind in Kind:
    _kind.width = {Kind.UINT32: 2, Kind.RECORD: 18}.get(_kind, 1)


class Access(Enum):
    """What can be done with an item."""

    READ = "R"
    READ_WRITE = "R/W"
    WRITE = "W"


@frozen
class Register:
    """A row of a map: one item or several of the same kind, a channel each.

    Shape: `address` is that of the frames, from 0; `number` the manual's, from 1, with the digit of the area before.
    Unit: `scale` of `unit` a count; `minimum` and `maximum` are counts.
    Manual: 3.4.
    """

    name: str
    area: Area
    address: int
    count: int = 1
    access: Access = Access.READ_WRITE
    kind: Kind = Kind.UINT16
    unit: str | None = None
    scale: float | None = None
    minimum: int | None = None
    maximum: int | None = None

    @property
    def number(self) -> str:
        """The manual's number of the first item: ``40489``."""
        return f"{self.area.value}{self.address + 1:04d}"

    @property
    def last_number(self) -> str:
        """The manual's number of the last item."""
        return f"{self.area.value}{self.address + self.count:04d}"


OPEN_WIRE: Gates = gates(series("M-7019Z"), M_7018R="B4.5", M_7018Z="B4.4", M_7019R="B3.7")
"""Open wire detection by Modbus; M-7018R has it from an older firmware on by DCON (E68)."""
_LAST_TYPE_CODE = 0x1C
_RECORDS = 6


def rows(profile: Profile) -> tuple[Register, ...]:
    """List what the module of `profile` has, in the order of the areas and addresses.

    Special: firmware older than the maps has what functions 02 and 04 read (3.1, 3.2) and nothing else; an I-7000
        module has nothing.
    Manual: 3.4.1 to 3.4.9; E43, E55, E56, E71, E88.
    """
    if Protocol.MODBUS_RTU not in profile.model.protocols:
        return ()
    found = list(_inputs(profile))
    if "3.4" not in profile.refused:
        found += [*map(_alias, found), *_channels(profile), *_module(profile), *_coils(profile)]
        if profile.model is Model.M_7017mC_16:
            found += _logger()
    return tuple(sorted(found, key=lambda row: (row.area.value, row.address)))


def _alias(row: Register) -> Register:
    """The same among the holding registers, or coils: what is read only has two numbers each."""
    return evolve(row, area=Area.COIL if row.area is Area.DISCRETE_INPUT else Area.HOLDING_REGISTER)


def _printed_channels(profile: Profile) -> int:
    """Channels that the map has: those of the single-ended mode, if there is one by command."""
    model = profile.model
    return model.single_ended_channels or model.channels


def _inputs(profile: Profile) -> Iterator[Register]:
    model, read, words = profile.model, Access.READ, Area.INPUT_REGISTER
    if "3.1" not in profile.refused:
        yield Register("range_status", Area.DISCRETE_INPUT, 128, model.channels, read, Kind.BOOL, None, None, 0, 1)
    yield Register("analog_input", words, 0, _printed_channels(profile), read, Kind.READING)
    if model is Model.M_7018_16:
        yield Register("temperature", words, 32, 16, read, Kind.INT16, "degC", 1)
    if model.cjc:
        yield Register("cjc_temperature", words, 128, 1, read, Kind.INT16, "degC", 0.01)
    if model is Model.M_7017mC_16:
        yield Register("log_records", words, 1000, Kind.RECORD.width * _RECORDS, read, Kind.RECORD)


def _channels(profile: Profile) -> Iterator[Register]:
    """What each channel has a holding register for."""
    model, write, words = profile.model, Access.READ_WRITE, Area.HOLDING_REGISTER
    channels = _printed_channels(profile)
    if profile.has(CONFIGURABLE):
        yield Register("type_code", words, 256, channels, write, Kind.CODE, None, None, 0, _LAST_TYPE_CODE)
    if model.series == "7019":
        yield Register("temperature_offset", words, 288, channels, write, Kind.INT16, "degC", 0.1, -128, 127)
        yield Register("cjc_offset", words, 352, channels, write, Kind.INT16, "degC", 0.01, -OFFSET_LIMIT, OFFSET_LIMIT)
    if model.series == "7018":
        yield Register("cjc_offset", words, 352, channels, write, Kind.INT8, "degC", 0.1, -128, 127)


def _module(profile: Profile) -> Iterator[Register]:
    """What the module has a holding register for."""
    model, read, write, words = profile.model, Access.READ, Access.READ_WRITE, Area.HOLDING_REGISTER
    yield Register("firmware_version", words, 480, 2, read, Kind.UINT32)
    yield Register("module_name", words, 482, 2, read, Kind.UINT32)
    yield Register("module_address", words, 484, 1, write, Kind.UINT16, None, None, 1, 247)
    yield Register("line_settings", words, 485, 1, write, Kind.BITS, None, None, 0x03, 0xCA)
    if model.type_by_configuration:
        yield Register("module_type_code", words, 486, 1, write, Kind.CODE, None, None, 0, _LAST_TYPE_CODE)
    yield Register("response_delay", words, 487, 1, write, Kind.UINT16, "ms", 1, 0, 30)
    yield Register("host_watchdog_timeout", words, 488, 1, write, Kind.UINT16, "s", 0.1, 0, 255)
    mask = (1 << min(_printed_channels(profile), 16)) - 1
    yield Register("channel_mask", words, 489, 1, write, Kind.BITS, None, None, 0, mask)
    if model.cjc:
        yield Register("module_cjc_offset", words, 490, 1, write, Kind.INT16, "degC", 0.01, -OFFSET_LIMIT, OFFSET_LIMIT)
    yield Register("host_watchdog_timeout_count", words, 491)
    if model.series == "7019":
        yield Register("cjc_update", words, 492, 1, write, Kind.CODE, None, None, 0, 2)
    if model is Model.M_7017Z:
        yield Register("channel_mask_high", words, 496, 1, write, Kind.BITS, None, None, 0, 0xF)


def _coils(profile: Profile) -> Iterator[Register]:  # noqa: C901 - a list
    model = profile.model

    def coil(name: str, address: int, access: Access = Access.READ_WRITE, minimum: int = 0) -> Register:
        return Register(name, Area.COIL, address, 1, access, Kind.BOOL, None, None, minimum, 1)

    yield coil("protocol", 256)
    if model is not Model.M_7017mC_16:
        yield coil("filter", 258)
    if model.cjc or model is Model.M_7017Z:
        yield coil("host_watchdog_mode", 259)
    yield coil("host_watchdog_enabled", 260)
    if model.cjc:
        yield coil("cjc_enabled", 267)
    yield coil("modbus_data_format", 268)
    yield coil("host_watchdog_timed_out", 269)
    if model.fast_mode:
        yield coil("fast_mode", 270)
    if model.series == "7019" or model is Model.M_7017mC_16:
        yield coil("load_factory_calibration", 271, Access.WRITE, 1)
    yield coil("reset_status", 272, Access.READ)
    if model is Model.M_7019R:
        yield coil("sampling_rate", 273)
    if profile.has(OPEN_WIRE):
        yield coil("open_wire_detection", 275)
    if model is Model.M_7017Z:
        yield coil("single_ended", 276)
    if model is Model.M_7017mC_16:
        yield coil("big_endian", 282)


_DATE = (("year", 2000, 2159), ("month", 1, 12), ("date", 1, 31), ("hour", 0, 23), ("minute", 0, 59), ("second", 0, 59))
_PERIOD = (("hour", "h", 24), ("minute", "min", 59), ("second", "s", 59))


def _logger() -> Iterator[Register]:
    """The clock and the data logger of the M-7017mC-16."""
    read, write, words = Access.READ, Access.READ_WRITE, Area.HOLDING_REGISTER
    yield Register("rtc_epoch", words, 16, 2, write, Kind.UINT32, "s", 1)
    yield Register("log_last_index", words, 870, 2, read, Kind.UINT32)
    yield Register("log_read_index", words, 872, 2, write, Kind.UINT32)
    yield Register("log_status", words, 874, 1, read, Kind.CODE, None, None, 0, 1)
    yield Register("log_command", words, 875, 1, write, Kind.CODE, None, None, 0, 2)
    yield Register("log_overwrite", words, 876, 1, write, Kind.CODE, None, None, 0, 1)
    for at, (part, unit, most) in enumerate(_PERIOD):
        yield Register(f"log_period_{part}", words, 877 + at, 1, write, Kind.UINT16, unit, 1, 0, most)
    for name, address in (("rtc", 864), ("log_start", 880), ("log_end", 886)):
        for at, (part, low, high) in enumerate(_DATE):
            yield Register(f"{name}_{part}", words, address + at, 1, write, Kind.UINT16, None, None, low, high)
