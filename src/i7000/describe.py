"""Values in words: descriptions of codes, masks and settings for people.

Each part of a layout, and each row of an address map, names the function here that describes its values.

Laws: an undefined code is described as its number.
"""

from collections.abc import Callable
from enum import Enum
from typing import Any

from i7000.models import Firmware, Model
from i7000.settings import BaudRate, DataFormat, Filter, LineSettings, ReportSettings, channels_of
from i7000.type_codes import MIXED, TypeCode

__all__ = [
    "address",
    "firmware",
    "hex_byte",
    "line_settings",
    "mask",
    "module_name",
    "quantity",
    "report_settings",
    "series",
    "type_code",
    "value",
]


def value(it: Any) -> str:  # noqa: ANN401 - of any field
    """Describe a value that needs no context.

    >>> value(True), value(Filter.REJECT_50_HZ), value(0.1 + 0.2), value(488)
    ('yes', 'reject_50_hz', '0.3', '488')
    """
    if isinstance(it, bool):
        return "yes" if it else "no"
    if isinstance(it, Enum):
        return it.name.lower()
    return f"{it:.7g}" if isinstance(it, float) else str(it)


def address(number: int) -> str:
    """Describe an address unambiguously: in hex, and in decimal if that differs.

    >>> address(0x01), address(0x0A), address(0x10)
    ('01', '0Ah (10)', '10h (16)')
    """
    return f"{number:02X}" if number <= 9 else f"{number:02X}h ({number})"


def hex_byte(byte: int) -> str:
    """Return two hex digits.

    >>> hex_byte(10)
    '0A'
    """
    return f"{byte:02X}"


def quantity(unit: str, scale: float, form: str) -> Callable[[float], str]:
    """Return a function that describes counts of `scale` of a unit, as numbers of the format `form`.

    >>> quantity("degC", 0.01, "+.2f")(-50)
    '-0.50 degC'
    """
    return lambda counts: f"{counts * scale:{form}} {unit}"


def type_code(code: int) -> str:
    """Describe a type code, TT.

    >>> type_code(0x0F), type_code(0xFF)
    ('0F, thermocouple K, -270..1372 degC', 'FF, the channels have different types')
    """
    known = TypeCode.of(code)
    if not isinstance(known, TypeCode):
        return f"{code:02X}, {'the channels have different types' if code == MIXED else 'not defined'}"
    kind = f"thermocouple {known.thermocouple}, " if known.thermocouple else ""
    return f"{code:02X}, {kind}{known.minimum:g}..{known.maximum:g} {known.unit}"


def line_settings(line: LineSettings | int) -> str:
    """Describe CC, or the number of an undefined CC.

    >>> line_settings(LineSettings.from_byte(0x86)), line_settings(0x186)
    ('86, 9600 baud, E81', '186, not defined')
    """
    if isinstance(line, int):
        return f"{line:02X}, not defined"
    rate = line.baud_rate
    baud = f"{rate.bits_per_second} baud" if isinstance(rate, BaudRate) else f"baud rate code {rate:02X} not defined"
    return f"{line.byte:02X}, {baud}, {line.character_format.name}"


def mask(channels: int, first: int = 0) -> str:
    """Describe a mask of channels, channel `first` the lowest bit.

    >>> mask(0x0A), mask(0), mask(0x01, 16)
    ('0A, channels 1, 3', '00, no channel', '01, channel 16')
    """
    numbers = [first + channel for channel in sorted(channels_of(channels))]
    word = "no channel" if not numbers else "channel" if len(numbers) == 1 else "channels"
    return f"{channels:02X}, {word} {', '.join(map(str, numbers))}".rstrip()


def module_name(name: bytes) -> str:
    """Describe a module name read by Modbus: the name of the series (E77).

    >>> module_name(bytes.fromhex("00701900")), module_name(bytes(4))
    ('00701900, M-7019 series', '00000000')
    """
    series = Model.series_of(name)
    return f"{name.hex()}, M-{series} series" if series else name.hex()


def series(name: str | int) -> str:
    """Describe the series of a module, or the number of an unknown series.

    >>> series("7019"), series(0x12345678)
    ('M-7019 series', '12345678, not defined')
    """
    return f"M-{name} series" if isinstance(name, str) else f"{name:08X}, not defined"


def firmware(version: Firmware | int) -> str:
    """Describe a firmware version, or the number of an invalid version.

    >>> firmware(Firmware("B405")), firmware(0x12345678)
    ('B4.5', '12345678, not defined')
    """
    return str(version) if isinstance(version, Firmware) else f"{version:08X}, not defined"


def report_settings(report: ReportSettings) -> str:
    """Describe FF.

    >>> report_settings(ReportSettings.from_byte(0x42))
    '42, hex, checksum, normal mode, 60 Hz rejected'
    """
    form = report.data_format
    words = [
        f"{report.byte:02X}",
        form.name.lower() if isinstance(form, DataFormat) else f"data format {form} not defined",
        "checksum" if report.checksum else "no checksum",
        "fast mode" if report.fast_mode else "normal mode",
        "50 Hz rejected" if report.filter is Filter.REJECT_50_HZ else "60 Hz rejected",
    ]
    if report.reserved:
        words.append(f"reserved bits {report.reserved:03b}")
    return ", ".join(words)
