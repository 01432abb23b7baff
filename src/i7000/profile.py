"""The properties of a module that a host needs to decode its bytes (manual 1.9, 1.11)."""

from collections.abc import Callable, Mapping
from functools import lru_cache
from operator import itemgetter
from typing import NamedTuple

from attrs import Factory, field

from i7000.arguments import check_int, check_type, kind_words
from i7000.availability import Availability
from i7000.errors import EncodeError
from i7000.fields import TEXT_WIDTH
from i7000.frozen import frozen
from i7000.models import CONFIGURABLE, Firmware, Gates, Model
from i7000.names import LONGEST_NAME, is_name
from i7000.settings import (
    BaudRate,
    CharacterFormat,
    DataFormat,
    Filter,
    LineSettings,
    ModbusDataFormat,
    Protocol,
    ReportSettings,
)
from i7000.type_codes import TypeCode, Unit

__all__ = ["Profile"]

LAST_LEGACY = Firmware("B1.4")
"""The last firmware of the I-7018 series that sends out-of-range readings in five characters (E49)."""


CJC_OFFSETS = (-0x1000, 0x1000)
"""The CJC offsets of a module and, on the 7019 series, of a channel, in counts of 0.01 degC (2.18, 3.4)."""
CHANNEL_OFFSETS = (-0x80, 0x7F)
"""The other offsets of a channel, in counts of 0.1 degC (3.4; E62)."""
RESPONSE_DELAYS = (0, 30)
"""The response delays of a module by Modbus, in milliseconds (3.4)."""


class Numbers(NamedTuple):
    """The form of the numbers of all channels in a report in engineering units."""

    width: int
    """The length of the data in characters."""
    points: slice | Callable[[str], tuple[str, ...]]
    """The positions of the points: a slice if all channels have one type, else a function that selects them."""
    all_points: str | tuple[str, ...]
    """The characters at these positions."""
    lowest: tuple[float, ...]
    """The lowest number of each channel."""
    highest: tuple[float, ...]


def _factory_types(profile: "Profile") -> tuple[TypeCode, ...]:
    known = isinstance(profile.model, Model) and isinstance(profile.single_ended, bool)
    return _places(profile.model, single_ended=profile.single_ended).types if known else ()


@frozen
class Profile:
    """The properties of a module that a host needs to decode its bytes. Only `model` is required.

    Shape: `type_codes` has one entry for each channel, or is empty if the types are unknown (the default of the
        I-7018BL). Every other field has the factory default.
    Errors: `EncodeError` for a combination that no module has. `attrs.evolve` makes a changed copy.
    Manual: 1.9, 1.11; E35, E83.

    >>> profile = Profile(Model.M_7017Z)
    >>> profile.channels, profile.mask_digits, profile.type_codes[0]
    (10, 4, <TypeCode.V_10: 8>)
    """

    model: Model
    firmware: Firmware | None = field(default=None, kw_only=True)
    """The firmware; None means the newest."""
    single_ended: bool = field(default=False, kw_only=True)
    """20 single-ended channels instead of 10 differential ones: 7017Z only."""
    type_codes: tuple[TypeCode, ...] = field(default=Factory(_factory_types, takes_self=True), kw_only=True)
    data_format: DataFormat = field(default=DataFormat.ENGINEERING, kw_only=True)
    checksum: bool = field(default=False, kw_only=True)
    modbus_data_format: ModbusDataFormat = field(default=ModbusDataFormat.HEX, kw_only=True)
    """The Modbus data format of M-7000 modules; its factory default is not documented."""

    channels: int = field(init=False, eq=False, repr=False)
    """The number of input channels in the connecting mode."""
    channel_digits: int = field(init=False, eq=False, repr=False)
    """The number of hex digits of a channel number in DCON commands."""
    mask_digits: int = field(init=False, eq=False, repr=False)
    """The number of hex digits of a channel mask in DCON commands."""
    units: tuple[Unit, ...] = field(init=False, eq=False, repr=False)
    """The unit of each channel, if the types are known."""
    numbers: Numbers | None = field(init=False, eq=False, repr=False)
    """The numbers of a report in engineering units; None for another data format, or unknown types."""
    legacy_sentinels: bool = field(init=False, eq=False, repr=False)
    """Whether out-of-range readings are ``+9999`` and ``-0000``, five characters instead of seven (E49)."""
    refused: frozenset[Availability] = field(init=False, eq=False, repr=False)
    """The members of `Availability` that the module does not have."""

    def __attrs_post_init__(self) -> None:
        self._check_kinds()
        derive = object.__setattr__
        channels, channel_digits, mask_digits, _ = _places(self.model, single_ended=self.single_ended)
        derive(self, "channels", channels)
        derive(self, "channel_digits", channel_digits)
        derive(self, "mask_digits", mask_digits)
        legacy, refused = _gated(self.model, self.firmware)
        derive(self, "legacy_sentinels", legacy)
        derive(self, "refused", refused)
        if not {TypeCode}.issuperset(map(type, self.type_codes)):
            raise self._unknown_type()
        units, numbers = _types(self.type_codes, channels, self.model, self.firmware)
        derive(self, "units", units)
        derive(self, "numbers", numbers if self.data_format is DataFormat.ENGINEERING else None)

    @property
    def name(self) -> str:
        """The model, and its firmware if known: for messages."""
        return self.model.value if self.firmware is None else f"{self.model.value} with firmware {self.firmware}"

    def has(self, gates: Gates) -> bool:
        """Return whether `gates` are open for this model and firmware."""
        if gates.__class__ is not dict:
            check_type("gates", gates, Mapping)
        return self.model in gates and self.runs(gates[self.model])

    def runs(self, firmware: Firmware | None) -> bool:
        """Return whether the firmware is `firmware` or later."""
        check_type("firmware", firmware, Firmware, optional=True)
        return _runs(self.firmware, firmware)

    def supports(self, type_code: int) -> bool:
        """Return whether the module can be set to `type_code`."""
        code = TypeCode.of(type_code)
        return isinstance(code, TypeCode) and _supports(code, self.model, self.firmware)

    @property
    def individually_configurable(self) -> bool:
        """Whether the channels can have different types."""
        return self.has(CONFIGURABLE)

    def supported_types(self) -> str:
        """Return the names of the types that the module can be set to: for messages."""
        return _supported_types(self.model, self.firmware)

    def _check_kinds(self) -> None:
        for name, value, kind in (
            ("model", self.model, Model),
            ("checksum", self.checksum, bool),
            ("single_ended", self.single_ended, bool),
            ("data_format", self.data_format, DataFormat),
            ("modbus_data_format", self.modbus_data_format, ModbusDataFormat),
            ("type_codes", self.type_codes, tuple),
        ):
            if not isinstance(value, kind):
                raise EncodeError(name, value, kind_words(kind), "")
        if self.firmware is not None and not isinstance(self.firmware, Firmware):
            raise EncodeError("firmware", self.firmware, "a Firmware, or None for the newest", "")
        if self.single_ended and self.model not in Availability.SERIES_7017Z.gates:
            allowed = f"7017Z only, {self.model.value} has no such mode"
            raise EncodeError("single_ended", True, allowed, "2.43")
        if self.modbus_data_format and Protocol.MODBUS_RTU not in self.model.protocols:
            allowed = f"M-7000 series only, {self.model.value} has no Modbus"
            raise EncodeError("modbus_data_format", self.modbus_data_format, allowed, "1.12")

    def _unknown_type(self) -> EncodeError:
        unknown = next(code for code in self.type_codes if not isinstance(code, TypeCode))
        return EncodeError("type_codes", unknown, "members of TypeCode", "1.11")

    # --- supported settings -------------------------------------------------------------------------------------------

    @property
    def has_filter(self) -> bool:
        """Whether the mains filter can be selected."""
        return self.runs(self.model.filter_from)

    @property
    def has_character_formats(self) -> bool:
        """Whether the character format can be other than N81."""
        return self.runs(self.model.character_formats_from)

    def check_channel(self, channel: int, section: str) -> None:
        """Raise `EncodeError` for a channel that the module does not have in its connecting mode.

        Errors: `EncodeError`, with the section of the manual that the caller passes, as in all these checks.
        """
        if channel.__class__ is not int:
            check_int("channel", channel)
        if not 0 <= channel < self.channels:
            raise EncodeError("channel", channel, f"0..{self.channels - 1} on {self.model.value}", section)

    def check_mask(self, mask: int, section: str) -> None:
        """Raise `EncodeError` for a mask with bits of channels that the module does not have.

        Errors: `EncodeError`.
        """
        if mask.__class__ is not int:
            check_int("mask", mask)
        beyond = mask >> self.channels
        if beyond:
            lowest = self.channels - 1 + (beyond & -beyond).bit_length()
            reason = f"{self.model.value} has no channel {lowest}"
            raise EncodeError("mask", f"{mask:X}", f"0..{self.channels - 1}", section, reason)

    def check_type_code(self, type_code: int, section: str, *, field: str = "type_code") -> None:
        """Raise `EncodeError` for a type code that the module cannot be set to.

        Errors: `EncodeError` for `field`.
        """
        if not self.supports(type_code):
            allowed = f"{self.supported_types()} on {self.model.value}"
            raise EncodeError(field, TypeCode.name_of(type_code), allowed, section)

    def check_line(self, line: LineSettings, section: str) -> None:
        """Raise `EncodeError` for line settings that the module cannot be set to.

        Errors: `EncodeError`.
        """
        check_type("line", line, LineSettings)
        if not isinstance(BaudRate.of(line.baud_rate), BaudRate):
            raise EncodeError("baud_rate", f"{line.baud_rate:02X}", "03..0A", section)
        if line.character_format is not CharacterFormat.N81 and not self.has_character_formats:
            allowed = f"N81 with firmware before {self.model.character_formats_from} on {self.model.value}"
            raise EncodeError("character_format", line.character_format.name, allowed, section)

    def check_report(self, report: ReportSettings, section: str) -> None:
        """Raise `EncodeError` for report settings that the module cannot be set to.

        Errors: `EncodeError`.
        """
        check_type("report", report, ReportSettings)
        if not isinstance(DataFormat.of(report.data_format), DataFormat):
            raise EncodeError("data_format", report.data_format, "0..2", section)
        if report.reserved:
            raise EncodeError("reserved", report.reserved, "0", section)
        if report.fast_mode and not self.model.fast_mode:
            raise EncodeError("fast_mode", True, f"{self.model.value} has no fast mode", section)
        if report.filter is not Filter.REJECT_60_HZ and not self.has_filter:
            since = self.model.filter_from
            allowed = f"REJECT_60_HZ; the bit is reserved with firmware before {since} on {self.model.value}"
            raise EncodeError("filter", report.filter.name, allowed, section)

    @staticmethod
    def check_cjc_offset(offset: int, section: str) -> None:
        """Raise `EncodeError` for a CJC offset, in counts of 0.01 degC, that no module can be set to.

        Errors: `EncodeError`.
        """
        if offset.__class__ is not int:
            check_int("offset", offset)
        low, high = CJC_OFFSETS
        if not low <= offset <= high:
            raise EncodeError("offset", offset, f"{low}..+{high} counts of 0.01 degC", section)

    @staticmethod
    def check_name(name: str, section: str) -> None:
        """Raise `EncodeError` for a name that no module can have, or that is the text of another response (E122).

        Errors: `EncodeError`.
        """
        if not isinstance(name, str) or not is_name(name):
            allowed = "not the text of another response (2, 4 or 6 hex digits, a version, ...)"
            raise EncodeError("name", name, f"1 to {LONGEST_NAME} characters, {allowed}", section)


# --- cached properties ------------------------------------------------------------------------------------------------


class _Places(NamedTuple):
    """The properties that follow from model and connecting mode."""

    channels: int
    channel_digits: int
    mask_digits: int
    types: tuple[TypeCode, ...]
    """The factory types."""


@lru_cache(maxsize=2 * len(Model))
def _places(model: Model, *, single_ended: bool) -> _Places:
    channels = (single_ended and model.single_ended_channels) or model.channels
    default = model.default_type
    types = () if default is None else (default,) * channels
    return _Places(channels, 2 if single_ended else 1, (channels + 7) // 8 * 2, types)


@lru_cache(maxsize=256)
def _gated(model: Model, firmware: Firmware | None) -> tuple[bool, frozenset[Availability]]:
    """Return whether the module has legacy sentinels, and the members of `Availability` that it does not have."""
    legacy = firmware is not None and firmware <= LAST_LEGACY and model.value.startswith("I-7018")
    closed = (it for it in Availability if model not in it.gates or not _runs(firmware, it.gates[model]))
    return legacy, frozenset(closed)


@lru_cache(maxsize=256)
def _types(
    codes: tuple[TypeCode, ...], channels: int, model: Model, firmware: Firmware | None
) -> tuple[tuple[Unit, ...], Numbers | None]:
    """Return the units of types, and the form of their numbers if all have one type.

    Errors: `EncodeError` for types that the module cannot have.
    """
    if len(codes) not in (0, channels):
        raise EncodeError("type_codes", codes, f"{channels} type codes, or none, on {model.value}", "1.3")
    kinds = set(codes)
    for code in kinds:
        if not _supports(code, model, firmware):
            allowed = f"{_supported_types(model, firmware)} on {model.value}"
            raise EncodeError("type_codes", code.name, allowed, "1.11")
    if len(kinds) > 1 and not (model in CONFIGURABLE and _runs(firmware, CONFIGURABLE[model])):
        raise EncodeError("type_codes", codes, f"one type for all channels on {model.value}", "2.15")
    return tuple(code.unit for code in codes), _numbers(codes) if codes else None


def _runs(firmware: Firmware | None, since: Firmware | None) -> bool:
    return since is None or firmware is None or firmware >= since


def _supports(code: TypeCode, model: Model, firmware: Firmware | None) -> bool:
    return code in model.type_codes and _runs(firmware, model.type_codes[code])


def _supported_types(model: Model, firmware: Firmware | None) -> str:
    return " ".join(code.name for code in model.type_codes if _supports(code, model, firmware))


def _numbers(codes: tuple[TypeCode, ...]) -> Numbers:
    width = TEXT_WIDTH * len(codes)
    lowest, highest = tuple(code.lowest for code in codes), tuple(code.highest for code in codes)
    if len(set(codes)) == 1:
        at = TEXT_WIDTH - 1 - codes[0].decimals
        return Numbers(width, slice(at, None, TEXT_WIDTH), "." * len(codes), lowest, highest)
    places = [TEXT_WIDTH * (channel + 1) - 1 - code.decimals for channel, code in enumerate(codes)]
    return Numbers(width, itemgetter(*places), (".",) * len(codes), lowest, highest)
