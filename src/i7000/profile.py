"""What a host must know about a module to read its bytes (manual 1.9, 1.11)."""

from collections.abc import Mapping
from typing import NamedTuple

from attrs import field

from i7000.arguments import check_type
from i7000.errors import EncodeError
from i7000.fields import TEXT_WIDTH
from i7000.frozen import frozen
from i7000.models import AVAILABILITY, CONFIGURABLE, Firmware, Gates, Model
from i7000.settings import DataFormat, ModbusDataFormat, Protocol
from i7000.type_codes import TypeCode, Unit

__all__ = ["Profile"]

LAST_LEGACY = Firmware("B1.4")
"""The last firmware of the I-7018 series with readings out of range in five characters (E49)."""


class Numbers(NamedTuple):
    """How all channels of a module write numbers in engineering units, if all have one type."""

    points: slice
    """Where in a line of them the points stand."""
    all_points: str
    """What stands there."""
    lowest: float
    highest: float


@frozen
class Profile:
    """What a host must know about a module to read its bytes; everything but the model has the factory default.

    Shape: `type_codes` has one entry a channel, or is empty when they are not known (the default of the I-7018BL).
    Errors: `EncodeError` for a combination that no module has. `attrs.evolve` makes a changed copy.
    Manual: 1.9, 1.11; E35, E83.

    >>> profile = Profile(Model.M_7017Z)
    >>> profile.channels, profile.mask_digits, profile.type_codes[0]
    (10, 4, <TypeCode.V_10: 8>)
    """

    model: Model
    firmware: Firmware | None = field(default=None, kw_only=True)
    """None: the newest."""
    single_ended: bool = field(default=False, kw_only=True)
    """20 single-ended channels instead of 10 differential ones: 7017Z only."""
    type_codes: tuple[TypeCode, ...] = field(kw_only=True)
    data_format: DataFormat = field(default=DataFormat.ENGINEERING, kw_only=True)
    checksum: bool = field(default=False, kw_only=True)
    modbus_data_format: ModbusDataFormat = field(default=ModbusDataFormat.HEX, kw_only=True)
    """Of M-7000 modules; which of the two is the factory default is not documented."""

    channels: int = field(init=False, eq=False, repr=False)
    """Input channels, in the connecting mode."""
    channel_digits: int = field(init=False, eq=False, repr=False)
    """Hex digits of a channel number in DCON commands."""
    mask_digits: int = field(init=False, eq=False, repr=False)
    """Hex digits of a channel mask in DCON commands."""
    units: tuple[Unit, ...] = field(init=False, eq=False, repr=False)
    """The unit of each channel, if the types are known."""
    numbers: Numbers | None = field(init=False, eq=False, repr=False)
    """What is in a report in engineering units of channels of one type; None for any other report."""
    legacy_sentinels: bool = field(init=False, eq=False, repr=False)
    """Whether readings out of range are ``+9999`` and ``-0000``, five characters instead of seven (E49)."""
    refused: frozenset[str] = field(init=False, eq=False, repr=False)
    """Sections of chapters 2 and 3 that the module does not have; `i7000.models.AVAILABILITY` tells who has them."""

    @type_codes.default
    def _factory_types(self) -> tuple[TypeCode, ...]:
        default = self.model.default_type if isinstance(self.model, Model) else None
        return () if default is None else (default,) * _channels(self)

    def __attrs_post_init__(self) -> None:
        self._check_kinds()
        derive = object.__setattr__
        channels = _channels(self)
        derive(self, "channels", channels)
        derive(self, "channel_digits", 2 if self.single_ended else 1)
        derive(self, "mask_digits", (channels + 7) // 8 * 2)
        old = self.firmware is not None and self.firmware <= LAST_LEGACY
        derive(self, "legacy_sentinels", old and self.model.value.startswith("I-7018"))
        refused = frozenset(section for section, it in AVAILABILITY.items() if not self.has(it.gates))
        derive(self, "refused", refused)
        self._check_types()
        derive(self, "units", tuple(code.unit for code in self.type_codes))
        engineering = self.data_format is DataFormat.ENGINEERING and len(set(self.type_codes)) == 1
        derive(self, "numbers", _numbers(self.type_codes[0], channels) if engineering else None)

    @property
    def name(self) -> str:
        """The model, and its firmware if that is known: for messages."""
        return self.model.value if self.firmware is None else f"{self.model.value} with firmware {self.firmware}"

    def has(self, gates: Gates) -> bool:
        """Whether `gates` are open for this model and firmware."""
        if gates.__class__ is not dict:
            check_type("gates", gates, Mapping)
        return self.model in gates and self.runs(gates[self.model])

    def runs(self, firmware: Firmware | None) -> bool:
        """Whether the firmware is `firmware` or a later one."""
        if firmware is None:
            return True
        check_type("firmware", firmware, Firmware)
        return self.firmware is None or self.firmware >= firmware

    def supports(self, type_code: int) -> bool:
        """Whether the module can be set to `type_code`."""
        code = TypeCode.of(type_code)
        types = self.model.type_codes
        return isinstance(code, TypeCode) and code in types and self.runs(types[code])

    @property
    def individually_configurable(self) -> bool:
        """Whether the channels can have different types."""
        return self.has(CONFIGURABLE)

    def supported_types(self) -> str:
        """The types that the module can be set to, as the manual writes them: for messages."""
        return " ".join(f"{code:02X}" for code in self.model.type_codes if self.supports(code))

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
                raise EncodeError(name, value, f"a {kind.__name__}", "1.11")
        model = self.model.value
        if self.firmware is not None and not isinstance(self.firmware, Firmware):
            raise EncodeError("firmware", self.firmware, "a Firmware, or None for the newest", "2.23")
        if self.single_ended and self.model not in AVAILABILITY["2.43"].gates:
            raise EncodeError("single_ended", True, f"7017Z only, {model} has no such mode", "2.43")
        if self.modbus_data_format and Protocol.MODBUS_RTU not in self.model.protocols:
            allowed = f"M-7000 series only, {model} has no Modbus"
            raise EncodeError("modbus_data_format", self.modbus_data_format, allowed, "1.12")

    def _check_types(self) -> None:
        model = self.model.value
        if len(self.type_codes) not in (0, self.channels):
            raise EncodeError("type_codes", self.type_codes, f"{self.channels} of them, or none: {model}", "1.3")
        for code in self.type_codes:
            if not isinstance(code, TypeCode):
                raise EncodeError("type_codes", code, "members of TypeCode", "1.11")
        for code in set(self.type_codes):
            if not self.supports(code):
                raise EncodeError("type_codes", f"{code:02X}", f"{self.supported_types()}: {model}", "1.11")
        if len(set(self.type_codes)) > 1 and not self.individually_configurable:
            raise EncodeError("type_codes", self.type_codes, f"one type for all channels: {model}", "2.15")


def _channels(profile: Profile) -> int:
    single_ended = profile.model.single_ended_channels
    return single_ended if profile.single_ended and single_ended else profile.model.channels


def _numbers(code: TypeCode, channels: int) -> Numbers:
    points = slice(TEXT_WIDTH - 1 - code.decimals, None, TEXT_WIDTH)
    return Numbers(points, "." * channels, code.lowest, code.highest)
