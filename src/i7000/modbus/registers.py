"""The address maps of the manual, as rules on the model and its firmware (manual 3.1, 3.2, 3.4).

Laws: the rows of a map are computed from the features of the model; ``spec/tables`` has the nine maps as printed. A
setting has one name in every map, and a row for each of its numbers if the manual gives it two (30001 and 40001).
"""

from collections.abc import Callable, Iterator
from enum import Enum
from functools import partial
from typing import Any

from attrs import evolve, field

from i7000 import describe
from i7000.availability import Availability
from i7000.frozen import frozen
from i7000.models import CONFIGURABLE, Firmware, Gates, Model, gates_of, series
from i7000.profile import CHANNEL_OFFSETS, CJC_OFFSETS, RESPONSE_DELAYS, Profile
from i7000.settings import CjcUpdate, Filter, LineSettings, LogCommand, ModbusDataFormat, Protocol, is_int
from i7000.type_codes import TypeCode

__all__ = ["Access", "Area", "Kind", "Register", "WordOrder"]


class Area(Enum):
    """A table of addresses; the value is the digit that the manual puts before its numbers."""

    bits: bool
    """Whether an item is one bit; otherwise it is 16."""

    COIL = 0
    DISCRETE_INPUT = 1
    INPUT_REGISTER = 3
    HOLDING_REGISTER = 4


for _area in Area:
    _area.bits = _area in (Area.COIL, Area.DISCRETE_INPUT)


class Kind(Enum):
    """How the bits or words of an item form a value."""

    width: int
    """The number of items of one value."""

    BOOL = "bool"
    READING = "reading"
    """A word in the Modbus data format."""
    UINT16 = "uint16"
    INT16 = "int16"
    INT8 = "int8"
    """The low byte in two's complement, the high byte zero (E62)."""
    UINT32 = "uint32"
    """Two registers, in the `Register.word_order`."""
    CODE = "code"
    BITS = "bits"
    RECORD = "record"
    """16 readings and a time stamp of two registers, in the `Register.word_order`."""


for _kind in Kind:
    _kind.width = {Kind.UINT32: 2, Kind.RECORD: 18}.get(_kind, 1)


class Access(Enum):
    """What a host can do with an item: read it, write it, or both."""

    READ = "R"
    READ_WRITE = "R/W"
    WRITE = "W"


class WordOrder(Enum):
    """The order of the two words of a 32-bit value (E75)."""

    LOW_FIRST = "low"
    """The low word comes first, in every setting of the module."""
    SELECTED = "selected"
    """The coil ``big_endian`` decides: the low word comes first unless it is set."""


@frozen
class Register:
    """A row of a map: one item, or several of the same kind, one for each channel.

    Shape: `address` is the address in frames, from 0; `number` is the manual's, from 1, preceded by the digit of the
        area.
    Unit: one count is `scale` of `unit`; `minimum` and `maximum` are counts.
    Manual: 3.4.
    """

    name: str
    area: Area
    address: int
    count: int = 1
    access: Access = field(default=Access.READ_WRITE, kw_only=True)
    kind: Kind = field(default=Kind.UINT16, kw_only=True)
    unit: str | None = field(default=None, kw_only=True)
    scale: float | None = field(default=None, kw_only=True)
    minimum: int | None = field(default=None, kw_only=True)
    maximum: int | None = field(default=None, kw_only=True)
    values: Any = field(default=None, kw_only=True)
    """The type of the values, if they are not plain numbers or bits: an enumeration, `LineSettings`, `Firmware`."""
    labels: tuple[str, ...] = field(default=(), kw_only=True)
    """The meaning of the values, from 0 on, if neither their type nor yes and no shows it."""
    cleared_by: int | None = field(default=None, kw_only=True)
    """The only value that can be written: it clears a counter or state of the module."""
    word_order: WordOrder | None = field(default=None, kw_only=True)
    """The word order of kinds with 32-bit numbers."""
    ends_when_read: bool = field(default=False, kw_only=True)
    """Whether reading changes the row: the reset status is set only for the first reader."""
    fact: str | None = field(default=None, kw_only=True)
    """The property of the module that it contains, if other rows or frames are read differently for it, or if it shows
    which module this is: ``types``, ``modbus_data_format``, ``single_ended``, ``mask``, ``firmware``, ``series``,
    ``address``."""
    words: Callable[[Any], str] = field(default=describe.value, kw_only=True, repr=False)
    """Returns the value in words, without its unit: see `describe`."""

    @property
    def number(self) -> str:
        """The manual's number of the first item: ``40489``."""
        return f"{self.area.value}{self.address + 1:04d}"

    @property
    def last_number(self) -> str:
        """The manual's number of the last item."""
        return f"{self.area.value}{self.address + self.count:04d}"

    def describe(self, value: Any) -> str:  # noqa: ANN401 - of any row
        """Return a value of the row, or of one of its channels, in words and with its unit."""
        if self.labels and is_int(int(value), 0, len(self.labels) - 1):
            return self.labels[int(value)]
        return f"{self.words(value)} {self.unit}" if self.unit else self.words(value)


OPEN_WIRE: Gates = gates_of(series("M-7019Z"), M_7018R="B4.5", M_7018Z="B4.4", M_7019R="B3.7")
"""Open wire detection by Modbus; by DCON, M-7018R has it from an older firmware on (E68)."""
_LAST_TYPE_CODE = 0x1C
_MASK_BITS = 16
_RECORDS = 6


def rows(profile: Profile) -> tuple[Register, ...]:
    """Return the rows of the module of `profile`, in the order of the areas and addresses.

    Special: firmware older than the maps has only the inputs that functions 02 and 04 read (3.1, 3.2); an I-7000 module
        has no rows.
    Manual: 3.4.1 to 3.4.9; E43, E55, E56, E71, E88.
    """
    if Protocol.MODBUS_RTU not in profile.model.protocols:
        return ()
    found = list(_inputs(profile))
    if Availability.ADDRESS_MAP not in profile.refused:
        found += [*map(_alias, found), *_channels(profile), *_module(profile), *_coils(profile)]
        if profile.model is Model.M_7017mC_16:
            found += _logger()
    return tuple(sorted(found, key=lambda row: (row.area.value, row.address)))


def _alias(row: Register) -> Register:
    """Return the same row among the holding registers or coils: read-only items have two numbers each."""
    return evolve(row, area=Area.COIL if row.area is Area.DISCRETE_INPUT else Area.HOLDING_REGISTER)


def _printed_channels(profile: Profile) -> int:
    """Return the number of channels in the map: those of single-ended mode, if a command can select it."""
    model = profile.model
    return model.single_ended_channels or model.channels


def _inputs(profile: Profile) -> Iterator[Register]:
    model, words = profile.model, Area.INPUT_REGISTER
    read = partial(Register, access=Access.READ)
    if Availability.RANGE_STATUS not in profile.refused:
        yield read("range_status", Area.DISCRETE_INPUT, 128, model.channels, kind=Kind.BOOL, minimum=0, maximum=1)
    yield read("analog_input", words, 0, _printed_channels(profile), kind=Kind.READING)
    if model is Model.M_7018_16:
        yield read("temperature", words, 32, 16, kind=Kind.INT16, unit="degC", scale=1)
    if model.cjc:
        yield read("cjc_temperature", words, 128, kind=Kind.INT16, unit="degC", scale=0.01)
    if model is Model.M_7017mC_16:
        count = Kind.RECORD.width * _RECORDS
        yield read("log_records", words, 1000, count, kind=Kind.RECORD, word_order=WordOrder.SELECTED)


def _holding(name: str, address: int, count: int = 1, **facts: Any) -> Register:  # noqa: ANN401 - fields of `Register`
    return Register(name, Area.HOLDING_REGISTER, address, count, **facts)


_TYPE_CODE = partial(
    _holding,
    kind=Kind.CODE,
    minimum=0,
    maximum=_LAST_TYPE_CODE,
    values=TypeCode,
    words=describe.type_code,
    fact="types",
)
_OFFSET = partial(_holding, kind=Kind.INT16, unit="degC", scale=0.01, minimum=CJC_OFFSETS[0], maximum=CJC_OFFSETS[1])
_TENTHS = partial(_holding, unit="degC", scale=0.1, minimum=CHANNEL_OFFSETS[0], maximum=CHANNEL_OFFSETS[1])
_MASK = partial(_holding, kind=Kind.BITS, minimum=0, words=describe.mask)


def _channels(profile: Profile) -> Iterator[Register]:
    """Return the holding registers with a value for each channel."""
    model, channels = profile.model, _printed_channels(profile)
    if profile.has(CONFIGURABLE):
        yield _TYPE_CODE("type_code", 256, channels)
    if model.series == "7019":
        yield _TENTHS("temperature_offset", 288, channels, kind=Kind.INT16)
        yield _OFFSET("cjc_offset", 352, channels)
    if model.series == "7018":
        yield _TENTHS("cjc_offset", 352, channels, kind=Kind.INT8)


def _module(profile: Profile) -> Iterator[Register]:
    """Return the holding registers of the whole module."""
    model = profile.model
    read_32 = partial(_holding, count=2, access=Access.READ, kind=Kind.UINT32, word_order=WordOrder.LOW_FIRST)
    yield read_32("firmware_version", 480, values=Firmware, words=describe.firmware, fact="firmware")
    yield read_32("module_name", 482, values=str, words=describe.series, fact="series")
    yield _holding("module_address", 484, minimum=1, maximum=247, words=describe.address, fact="address")
    yield _holding(
        "line_settings", 485, kind=Kind.BITS, minimum=0x03, maximum=0xCA,
        values=LineSettings, words=describe.line_settings,
    )  # fmt: skip
    if model.type_by_configuration:
        yield _TYPE_CODE("module_type_code", 486)
    yield _holding("response_delay", 487, unit="ms", scale=1, minimum=RESPONSE_DELAYS[0], maximum=RESPONSE_DELAYS[1])
    yield _holding("host_watchdog_timeout", 488, unit="s", scale=0.1, minimum=0, maximum=255)
    bits = _printed_channels(profile)
    whole = "mask" if bits <= _MASK_BITS else None
    yield _MASK("channel_mask", 489, maximum=(1 << min(bits, _MASK_BITS)) - 1, fact=whole)
    if model.cjc:
        yield _OFFSET("module_cjc_offset", 490)
    yield _holding("host_watchdog_timeout_count", 491, cleared_by=0)
    if model.series == "7019":
        yield _holding("cjc_update", 492, kind=Kind.CODE, minimum=0, maximum=2, values=CjcUpdate)
    if model is Model.M_7017Z:
        yield _MASK("channel_mask_high", 496, maximum=0xF, words=lambda mask: describe.mask(mask, 16))


def _coils(profile: Profile) -> Iterator[Register]:  # noqa: C901 - a list
    model = profile.model

    def coil(name: str, address: int, minimum: int = 0, **facts: Any) -> Register:  # noqa: ANN401 - of `Register`
        return Register(name, Area.COIL, address, kind=Kind.BOOL, minimum=minimum, maximum=1, **facts)

    yield coil("protocol", 256, values=Protocol)
    if model is not Model.M_7017mC_16:
        yield coil("filter", 258, values=Filter)
    if model.cjc or model is Model.M_7017Z:
        yield coil("host_watchdog_mode", 259)
    yield coil("host_watchdog_enabled", 260)
    if model.cjc:
        yield coil("cjc_enabled", 267)
    yield coil("modbus_data_format", 268, values=ModbusDataFormat, fact="modbus_data_format")
    yield coil("host_watchdog_timed_out", 269, cleared_by=1)
    if model.fast_mode:
        yield coil("fast_mode", 270)
    if model.series == "7019" or model is Model.M_7017mC_16:
        yield coil("load_factory_calibration", 271, minimum=1, access=Access.WRITE)
    yield coil("reset_status", 272, access=Access.READ, ends_when_read=True)
    if model is Model.M_7019R:
        yield coil("sampling_rate", 273, labels=("10 Hz", "8 Hz"))
    if profile.has(OPEN_WIRE):
        yield coil("open_wire_detection", 275)
    if model is Model.M_7017Z:
        yield coil("single_ended", 276, fact="single_ended")
    if model is Model.M_7017mC_16:
        yield coil("big_endian", 282)


_DATE = (("year", 2000, 2159), ("month", 1, 12), ("date", 1, 31), ("hour", 0, 23), ("minute", 0, 59), ("second", 0, 59))
_PERIOD = (("hour", "h", 24), ("minute", "min", 59), ("second", "s", 59))


def _logger() -> Iterator[Register]:
    """Return the registers of the clock and the data logger of the M-7017mC-16."""
    long = partial(_holding, count=2, kind=Kind.UINT32, word_order=WordOrder.SELECTED)
    code = partial(_holding, kind=Kind.CODE, minimum=0)
    yield long("rtc_epoch", 16, unit="s", scale=1)
    yield long("log_last_index", 870, access=Access.READ)
    yield long("log_read_index", 872)
    yield code("log_status", 874, maximum=1, access=Access.READ, labels=("stopped", "running"))
    yield code("log_command", 875, maximum=2, values=LogCommand)
    yield code("log_overwrite", 876, maximum=1, labels=("stop", "go on writing"))
    for at, (part, unit, most) in enumerate(_PERIOD):
        yield _holding(f"log_period_{part}", 877 + at, unit=unit, scale=1, minimum=0, maximum=most)
    for name, address in (("rtc", 864), ("log_start", 880), ("log_end", 886)):
        for at, (part, low, high) in enumerate(_DATE):
            yield _holding(f"{name}_{part}", address + at, minimum=low, maximum=high)
