"""The coded settings of a module: line (CC), reports (FF), protocol, cold-junction update (manual 1.11, 2).

Laws: every byte survives a round trip: an undefined code is kept as an int, and reserved bits are kept. The encoder,
which has the model, checks if a module accepts it.
"""

from collections.abc import Iterable
from enum import Enum, IntEnum
from typing import Self

from attrs import field

from i7000.arguments import as_tuple, check_int
from i7000.errors import EncodeError
from i7000.frozen import frozen

__all__ = [
    "BaudRate",
    "CharacterFormat",
    "CjcUpdate",
    "DataFormat",
    "Filter",
    "LineSettings",
    "LogCommand",
    "ModbusDataFormat",
    "Protocol",
    "ReportSettings",
    "channels_of",
    "mask_of",
]

_BYTE = 0xFF


class BaudRate(IntEnum):
    """The baud-rate codes, bits 5:0 of CC."""

    BAUD_1200 = 0x03
    BAUD_2400 = 0x04
    BAUD_4800 = 0x05
    BAUD_9600 = 0x06
    BAUD_19200 = 0x07
    BAUD_38400 = 0x08
    BAUD_57600 = 0x09
    BAUD_115200 = 0x0A

    @property
    def bits_per_second(self) -> int:
        """The baud rate in bits per second."""
        return int(self.name.removeprefix("BAUD_"))

    @classmethod
    def of(cls, code: int) -> "BaudRate | int":
        """Return the member of `code`; an undefined code is kept as an int."""
        if code.__class__ is not int:
            check_int("code", code)
        return _BAUD_RATES.get(code, code)


_BAUD_RATES: dict[int, BaudRate] = {member.value: member for member in BaudRate}


class CharacterFormat(IntEnum):
    """Parity and stop bits of the line, bits 7:6 of CC; eight data bits always (E44)."""

    N81 = 0
    N82 = 1
    E81 = 2
    O81 = 3

    @property
    def parity(self) -> str:
        """The parity: ``N``, ``E`` or ``O``."""
        return self.name[0]

    @property
    def stop_bits(self) -> int:
        """The number of stop bits: 1 or 2."""
        return int(self.name[2])

    @property
    def bits(self) -> int:
        """The length of one character in bits, start bit included."""
        return 9 + (self.parity != "N") + self.stop_bits


class DataFormat(IntEnum):
    """The data format of DCON readings, bits 1:0 of FF."""

    ENGINEERING = 0
    PERCENT = 1
    HEX = 2

    @classmethod
    def of(cls, code: int) -> "DataFormat | int":
        """Return the member of `code`; the undefined code 3 is kept as an int."""
        if code.__class__ is not int:
            check_int("code", code)
        return _DATA_FORMATS.get(code, code)


_DATA_FORMATS: dict[int, DataFormat] = {member.value: member for member in DataFormat}


class ModbusDataFormat(IntEnum):
    """The data format of Modbus readings, coil 00269 (manual 3.4); the factory default is not documented (E83)."""

    HEX = 0
    ENGINEERING = 1


class Filter(Enum):
    """The mains frequency that the filter rejects, bit 7 of FF."""

    REJECT_60_HZ = False
    REJECT_50_HZ = True


class Protocol(IntEnum):
    """The protocol of a module after its next power-on."""

    DCON = 0
    MODBUS_RTU = 1


class CjcUpdate(IntEnum):
    """The update of the cold-junction temperature."""

    STOPPED = 0
    STARTED = 1
    ONCE = 2


class LogCommand(IntEnum):
    """The command to the data logger of the M-7017mC-16 (40876)."""

    STOP = 0
    CONTINUOUS = 1
    PERIOD = 2


def is_int(value: object, low: int, high: int) -> bool:
    """Return whether a value is an int in a range, and not a bool."""
    return isinstance(value, int) and not isinstance(value, bool) and low <= value <= high


def _byte(name: str, value: int) -> int:
    if not is_int(value, 0, _BYTE):
        raise EncodeError(name, value, "00..FF", "1.11")
    return value


@frozen
class LineSettings:
    """The byte CC: baud rate and character format.

    Shape: bits 5:0 `baud_rate`, bits 7:6 `character_format`.
    Manual: 1.11; E44, E89.
    """

    baud_rate: BaudRate | int = BaudRate.BAUD_9600
    character_format: CharacterFormat = CharacterFormat.N81

    def __attrs_post_init__(self) -> None:
        if not is_int(self.baud_rate, 0, 0x3F):
            raise EncodeError("baud_rate", self.baud_rate, "a code 00..3F; defined are 03..0A", "1.11")
        if not isinstance(self.character_format, CharacterFormat):
            raise EncodeError("character_format", self.character_format, "a CharacterFormat", "1.11")

    @classmethod
    def from_byte(cls, byte: int) -> Self:
        """Decode CC.

        >>> LineSettings.from_byte(0x86)
        LineSettings(baud_rate=<BaudRate.BAUD_9600: 6>, character_format=<CharacterFormat.E81: 2>)
        """
        byte = _byte("line_settings", byte)
        return cls(BaudRate.of(byte & 0x3F), CharacterFormat(byte >> 6))

    @property
    def byte(self) -> int:
        """The byte CC."""
        return self.character_format << 6 | self.baud_rate


@frozen
class ReportSettings:
    """The byte FF: how inputs are sampled, the data format, and whether frames have a checksum.

    Shape: bits 1:0 `data_format`, 4:2 `reserved`, 5 `fast_mode`, 6 `checksum`, 7 `filter`.
    Manual: 1.11; E89, E95, E96.
    """

    data_format: DataFormat | int = DataFormat.ENGINEERING
    checksum: bool = field(default=False, kw_only=True)
    fast_mode: bool = field(default=False, kw_only=True)
    filter: Filter = field(default=Filter.REJECT_60_HZ, kw_only=True)
    reserved: int = field(default=0, kw_only=True)
    """Three bits that should be zero."""

    def __attrs_post_init__(self) -> None:
        if not is_int(self.data_format, 0, 3):
            raise EncodeError("data_format", self.data_format, "a code 0..3; defined are 0..2", "1.11")
        if not is_int(self.reserved, 0, 7):
            raise EncodeError("reserved", self.reserved, "0..7; should be 0", "1.11")
        if not isinstance(self.filter, Filter):
            raise EncodeError("filter", self.filter, "a Filter", "1.11")
        for name, value in (("checksum", self.checksum), ("fast_mode", self.fast_mode)):
            if not isinstance(value, bool):
                raise EncodeError(name, value, "True or False", "1.11")

    @classmethod
    def from_byte(cls, byte: int) -> Self:
        """Decode FF.

        >>> ReportSettings.from_byte(0xC2).checksum, ReportSettings.from_byte(0xC2).filter
        (True, <Filter.REJECT_50_HZ: True>)
        """
        byte = _byte("report_settings", byte)
        return cls(
            DataFormat.of(byte & 0b11),
            reserved=byte >> 2 & 0b111,
            fast_mode=bool(byte & 0x20),
            checksum=bool(byte & 0x40),
            filter=Filter(bool(byte & 0x80)),
        )

    @property
    def byte(self) -> int:
        """The byte FF."""
        return self.filter.value << 7 | self.checksum << 6 | self.fast_mode << 5 | self.reserved << 2 | self.data_format


def channels_of(mask: int) -> frozenset[int]:
    """Return the channels of a mask.

    Errors: `EncodeError` for a negative number, or one of more than 24 bits.

    >>> sorted(channels_of(0x3A))
    [1, 3, 4, 5]
    """
    check_int("mask", mask)
    if not 0 <= mask <= _LARGEST_MASK:
        raise EncodeError("mask", mask, f"0..{_LARGEST_MASK:X} in hex", "2.13")
    return frozenset(channel for channel in range(mask.bit_length()) if mask >> channel & 1)


def mask_of(channels: Iterable[int]) -> int:
    """Return the mask of a set of channels, channel 0 the lowest bit.

    Errors: `EncodeError` for a channel that no module has.

    >>> f"{mask_of({1, 3, 4, 5}):02X}"
    '3A'
    """
    mask = 0
    for channel in as_tuple("channels", channels):
        if not is_int(channel, 0, _MOST_CHANNELS - 1):
            raise EncodeError("channel", channel, f"0..{_MOST_CHANNELS - 1}", "2.13")
        mask |= 1 << channel
    return mask


_MOST_CHANNELS = 20
_LARGEST_MASK = 0xFFFFFF
