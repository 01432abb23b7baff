"""What the bits and words of a register mean: counts <-> values in units (manual 3.4, 3.5).

Laws: `counts_of` is the inverse of `value_of`, and refuses what the row cannot hold.
"""

from collections.abc import Iterable
from enum import Enum
from typing import Any

from attrs import frozen

from i7000.errors import DecodeError, EncodeError, Fault
from i7000.modbus.module_settings import check_line
from i7000.modbus.registers import Kind, Register
from i7000.profile import Profile
from i7000.readings import Reading, decode_engineering_word, decode_word
from i7000.settings import CjcUpdate, Filter, LineSettings, ModbusDataFormat, Protocol
from i7000.type_codes import TypeCode

__all__ = ["LogRecord", "readings"]

_RECORD_READINGS, _RECORD_WORDS = 16, 18
_NAMED: dict[str, type[Enum]] = {
    "cjc_update": CjcUpdate,
    "protocol": Protocol,
    "modbus_data_format": ModbusDataFormat,
    "filter": Filter,
}
"""The rows whose numbers have names; those of type codes are `TypeCode`."""
_NEARLY = 1e-6
"""Of a count: what a value in a unit may be off by, being a double."""


@frozen
class LogRecord:
    """A record of the data logger: what the 16 channels read, and when.

    Unit: `time` in seconds, as the clock of the module counts them (E73).
    Manual: 3.4.3.
    """

    readings: tuple[Reading, ...]
    time: int


def readings(words: Iterable[int], profile: Profile, *, channel: int = 0) -> tuple[Reading, ...]:
    """Tell what the words of analog inputs mean, in the Modbus data format of the profile.

    Shape: the first word is that of `channel`.
    Errors: `DecodeError` with `Fault.NUMBER` for a channel whose type the profile does not have, or no 16-bit word.
    Manual: 3.5, 1.11, A.5; E83.

    >>> from i7000 import Model
    >>> readings([0x7FFF, 0x8000], Profile(Model.M_7017))[1].value
    -10.0
    """
    values = tuple(words)
    types = profile.type_codes[channel : channel + len(values)] if channel >= 0 else ()
    if len(types) != len(values):
        allowed = f"channels 0..{len(profile.type_codes) - 1} of the profile"
        raise DecodeError(Fault.NUMBER, str(values).encode(), field="type_codes", allowed=allowed, section="3.5")
    engineering = profile.modbus_data_format is ModbusDataFormat.ENGINEERING
    decode = decode_engineering_word if engineering else decode_word
    return tuple(decode(word, type_code) for word, type_code in zip(values, types, strict=True))


def value_of(  # noqa: PLR0913 - the row, and which items of it
    row: Register, items: tuple[int, ...], first: int, count: int, profile: Profile, *, big_endian: bool
) -> Any:  # noqa: ANN401 - what the row holds
    """Tell the value of a row, or of `count` items of it from `first` on."""
    if len(items) != count:
        wire = str(items).encode()
        raise DecodeError(Fault.COUNT, wire, field=row.name, allowed=f"{count} items", section="3.4")
    if row.kind is Kind.READING:
        return readings(items, profile, channel=first)
    if row.kind is Kind.RECORD:
        return tuple(
            LogRecord(
                readings(items[at : at + _RECORD_READINGS], profile),
                _long(items[at + _RECORD_READINGS : at + _RECORD_WORDS], big_endian=big_endian),
            )
            for at in range(0, count, _RECORD_WORDS)
        )
    if row.kind is Kind.UINT32:
        number = _long(items, big_endian=big_endian)
        return number.to_bytes(4, "big") if row.name == "module_name" else number
    values = tuple(_single(row, item) for item in items)
    return values[0] if row.count == 1 else values


def _long(words: tuple[int, ...], *, big_endian: bool) -> int:
    high, low = words if big_endian else words[::-1]
    return high << 16 | low


def _single(row: Register, item: int) -> Any:  # noqa: ANN401
    if row.name in ("type_code", "module_type_code"):
        return TypeCode.of(item)
    if row.name == "line_settings" and item <= 0xFF:
        return LineSettings.from_byte(item)
    if row.name in _NAMED:
        try:
            return _NAMED[row.name](item)
        except ValueError:
            allowed = f"{row.minimum}..{row.maximum}"
            raise DecodeError(Fault.VALUE, str(item).encode(), field=row.name, allowed=allowed, section="3.4") from None
    if row.kind is Kind.BOOL:
        return bool(item)
    if row.kind is Kind.INT8:
        item = (item & 0xFF) - ((item & 0x80) << 1)
    if row.kind is Kind.INT16:
        item -= (item & 0x8000) << 1
    return item if row.scale in (None, 1) else item / _counts_per_unit(row)


def _counts_per_unit(row: Register) -> int:
    return round(1 / (row.scale or 1))


def counts_of(row: Register, value: Any, profile: Profile, *, big_endian: bool) -> tuple[int, ...]:  # noqa: ANN401
    """Tell the items that hold a value: one, or the two of a 32-bit number."""
    number = value.byte if isinstance(value, LineSettings) and row.name == "line_settings" else value
    if isinstance(number, Enum) and isinstance(number, _NAMED.get(row.name, ())):
        number = number.value
    scale = _counts_per_unit(row)
    if not isinstance(number, int | float) or number != number or abs(number) > 1 << 32:  # noqa: PLR0124 - NaN
        raise EncodeError(row.name, value, "a number, or what stands for it", "3.4")
    counts = round(number * scale)
    low = 0 if row.minimum is None else row.minimum
    high = (0xFFFFFFFF if row.kind is Kind.UINT32 else 0xFFFF) if row.maximum is None else row.maximum
    if abs(counts - number * scale) > _NEARLY or not low <= counts <= high:
        unit = f" {row.unit}" if row.unit else ""
        allowed = f"{low / scale:g}..{high / scale:g}{unit} in steps of {1 / scale:g}"
        raise EncodeError(row.name, value, allowed, "3.4")
    if row.name in ("type_code", "module_type_code") and not profile.supports(counts):
        allowed = f"{profile.supported_types()}: {profile.model.value}"
        raise EncodeError(row.name, f"{counts:02X}", allowed, "1.11")
    if row.name == "line_settings":
        check_line(LineSettings.from_byte(counts), profile, "3.4")
    if row.kind is Kind.UINT32:
        words = (counts & 0xFFFF, counts >> 16)
        return words[::-1] if big_endian else words
    return (counts & (0xFF if row.kind is Kind.INT8 else 0xFFFF),)
