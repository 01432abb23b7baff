"""Functions that convert the bits and words of a register to values in units and back (manual 3.4, 3.5).

Laws: `counts_of` is the inverse of `values_of`, and raises `EncodeError` for values that the row cannot contain.
`DecodeError.wire` is empty here, because the functions take items and not bytes.
"""

from collections.abc import Callable, Iterable
from enum import Enum
from typing import Any

from i7000.arguments import as_tuple, check_int, check_type
from i7000.errors import DecodeError, EncodeError, Fault, shown
from i7000.frozen import frozen
from i7000.modbus.registers import Kind, Register, WordOrder
from i7000.models import Firmware, Model
from i7000.profile import Profile
from i7000.readings import (
    Reading,
    decode_engineering_word,
    decode_word,
    encode_engineering_word,
    encode_word,
    signed,
)
from i7000.settings import CjcUpdate, Filter, LineSettings, LogCommand, ModbusDataFormat, Protocol
from i7000.type_codes import TypeCode

__all__ = ["LogRecord", "RegisterValue", "readings", "words"]

_RECORD_READINGS = 16
_NEARLY = 1e-6
"""The rounding error that a value in a unit may have, in counts."""


@frozen
class LogRecord:
    """A record of the data logger: the readings of the 16 channels, and their time.

    Unit: `time` in seconds, as the clock of the module counts them (E73).
    Manual: 3.4.3.
    """

    readings: tuple[Reading, ...]
    time: int


Setting = CjcUpdate | Filter | Firmware | LineSettings | LogCommand | ModbusDataFormat | Protocol | TypeCode
"""The values of coded registers."""
RegisterValue = bool | int | float | str | Reading | LogRecord | Setting
"""The value of one item of a row: a state, a number, a quantity in the unit of the row, a name, a reading, a record of
the log, or a setting.
"""


def readings(words: Iterable[int], profile: Profile, *, channel: int = 0) -> tuple[Reading, ...]:
    """Return the readings in the words of analog inputs, in the Modbus data format of the profile.

    Shape: the first word belongs to `channel`.
    Errors: `DecodeError` with `Fault.NUMBER` for a channel of unknown type, or a word that is not an int of 16 bits.
    Manual: 3.5, 1.11, A.5; E83.

    >>> from i7000 import Model
    >>> readings([0x7FFF, 0x8000], Profile(Model.M_7017))[1].value
    -10.0
    """
    check_type("profile", profile, Profile)
    check_int("channel", channel)
    values = as_tuple("words", words)
    _check_items("words", values, 0xFFFF)
    return _readings(values, channel, profile)


def words(values: Iterable[Reading], profile: Profile, *, channel: int = 0) -> tuple[int, ...]:
    """Encode the words of analog inputs: the inverse of `readings`.

    Shape: the first reading belongs to `channel`.
    Errors: `EncodeError` for a reading that its channel cannot have, and for a channel of unknown type.
    Manual: 3.5, 1.11, A.5; E83.

    >>> from i7000 import Model, Unit
    >>> words([Reading(-10.0, Unit.VOLT)], Profile(Model.M_7017))
    (32768,)
    """
    check_type("profile", profile, Profile)
    check_int("channel", channel)
    found = as_tuple("values", values)
    for value in found:
        check_type("values", value, Reading)
    types = profile.type_codes[channel : channel + len(found)] if channel >= 0 else ()
    if len(types) != len(found):
        allowed = f"channels of known type; the profile has {len(profile.type_codes)} type codes"
        raise EncodeError("channel", channel, allowed, "3.5")
    engineering = profile.modbus_data_format is ModbusDataFormat.ENGINEERING
    encode = encode_engineering_word if engineering else encode_word
    return tuple(encode(value, type_code) for value, type_code in zip(found, types, strict=True))


def _readings(values: tuple[int, ...], channel: int, profile: Profile) -> tuple[Reading, ...]:
    types = profile.type_codes[channel : channel + len(values)] if channel >= 0 else ()
    if len(types) != len(values):
        last = len(profile.type_codes) - 1
        allowed = f"channels 0..{last} of the profile" if last >= 0 else "a profile with type codes; this one has none"
        raise DecodeError(Fault.NUMBER, b"", field="type_codes", allowed=allowed, section="3.5")
    engineering = profile.modbus_data_format is ModbusDataFormat.ENGINEERING
    decode = decode_engineering_word if engineering else decode_word
    return tuple(decode(word, type_code) for word, type_code in zip(values, types, strict=True))


def values_of(  # noqa: PLR0913 - the row, and which values of it
    row: Register, items: tuple[int, ...], first: int, count: int, profile: Profile, *, big_endian: bool
) -> tuple[RegisterValue, ...]:
    """Return `count` values of a row, beginning with value `first`."""
    width = row.kind.width
    if len(items) != count * width:
        allowed = f"{count * width} items, not {len(items)}"
        raise DecodeError(Fault.COUNT, b"", field=row.name, allowed=allowed, section="3.4")
    _check_items(row.name, items, 1 if row.area.bits else 0xFFFF)
    if row.kind is Kind.READING:
        return _readings(items, first, profile)
    if row.kind is Kind.RECORD:
        return tuple(
            LogRecord(
                _readings(items[at : at + _RECORD_READINGS], 0, profile),
                _long(items[at + _RECORD_READINGS : at + width], big_endian=_is_big_endian(row, big_endian=big_endian)),
            )
            for at in range(0, len(items), width)
        )
    if row.kind is Kind.UINT32:
        return (_typed(row, _long(items, big_endian=_is_big_endian(row, big_endian=big_endian))),)
    return tuple(_single(row, item) for item in items)


def _check_items(name: str, items: tuple[int, ...], most: int) -> None:
    """Raise `DecodeError` for an invalid item: an int beyond its range; a bit may be a bool."""
    for at, item in enumerate(items):
        if not isinstance(item, int) or (isinstance(item, bool) and most > 1) or not 0 <= item <= most:
            allowed = f"0..{most}; item {at} is {shown(item)}"
            raise DecodeError(Fault.NUMBER, b"", field=name, allowed=allowed, section="3.4")


def _long(words: tuple[int, ...], *, big_endian: bool) -> int:
    high, low = words if big_endian else words[::-1]
    return high << 16 | low


def _is_big_endian(row: Register, *, big_endian: bool) -> bool:
    return big_endian and row.word_order is WordOrder.SELECTED


def _single(row: Register, item: int) -> RegisterValue:
    if row.kind is Kind.INT8:
        if item > 0xFF:
            allowed = f"00 in the high byte, not {item >> 8:02X}"
            raise DecodeError(Fault.RESERVED, b"", field=row.name, allowed=allowed, section="3.4")
        item -= (item & 0x80) << 1
    if row.kind is Kind.INT16:
        item = signed(item)
    if row.values:
        return _typed(row, item)
    if row.kind is Kind.BOOL:
        return bool(item)
    return item if row.scale in (None, 1) else item / _counts_per_unit(row)


def _typed(row: Register, number: int) -> RegisterValue:
    """Return the typed value of a number; undefined numbers stay ints, except where an enumeration has few codes."""
    if row.values is None:
        return number
    read: Callable[[int], RegisterValue | None] = _TYPED.get(row.values, row.values)
    try:
        value = read(number)
    except ValueError:
        allowed = f"{row.minimum}..{row.maximum}, not {number}"
        raise DecodeError(Fault.VALUE, b"", field=row.name, allowed=allowed, section="3.4") from None
    return number if value is None else value


_TYPED: dict[type, Callable[[int], RegisterValue | None]] = {
    TypeCode: TypeCode.of,
    LineSettings: lambda number: LineSettings.from_byte(number) if number <= 0xFF else None,
    Firmware: lambda number: None if number >> 24 else Firmware.from_bytes(number.to_bytes(3, "big")),
    str: lambda number: Model.series_of(number.to_bytes(4, "big")),
}
"""How numbers become values of the types that are not enumerations of few codes."""


def _counts_per_unit(row: Register) -> int:
    return round(1 / (row.scale or 1))


def counts_of(row: Register, value: Any, profile: Profile, *, big_endian: bool) -> tuple[int, ...]:  # noqa: ANN401
    """Return the items of a value: one, or the two of a 32-bit number."""
    number = _number_of(row, value)
    scale = _counts_per_unit(row)
    counts = round(number * scale)
    low = 0 if row.minimum is None else row.minimum
    high = (0xFFFFFFFF if row.kind is Kind.UINT32 else 0xFFFF) if row.maximum is None else row.maximum
    if row.cleared_by is not None:
        low = high = row.cleared_by
    if abs(counts - number * scale) > _NEARLY or not low <= counts <= high:
        unit = f" {row.unit}" if row.unit else ""
        allowed = f"{low / scale:g}..{high / scale:g}{unit} in steps of {1 / scale:g}" if low < high else f"{low}"
        raise EncodeError(row.name, value, allowed, "3.4")
    if row.values is TypeCode:
        profile.check_type_code(counts, "1.11", field=row.name)
    if row.values is LineSettings:
        profile.check_line(LineSettings.from_byte(counts), "3.4")
    if row.kind is Kind.UINT32:
        words = (counts & 0xFFFF, counts >> 16)
        return words[::-1] if _is_big_endian(row, big_endian=big_endian) else words
    return (counts & (0xFF if row.kind is Kind.INT8 else 0xFFFF),)


def _number_of(row: Register, value: Any) -> int | float:  # noqa: ANN401
    """Return the number of a value; coils take bools, rows with an enumeration take its members."""
    if isinstance(value, LineSettings | Firmware) and isinstance(value, row.values or ()):
        return value.byte if isinstance(value, LineSettings) else int.from_bytes(bytes(value), "big")
    own = isinstance(value, Enum) and isinstance(value, row.values or ())
    number = value.value if own else value
    if (
        not isinstance(number, int | float)
        or isinstance(number, Enum)
        or (isinstance(number, bool) and row.kind is not Kind.BOOL)
        or number != number  # noqa: PLR0124 - NaN
        or abs(number) > 1 << 32
    ):
        raise EncodeError(row.name, value, "a number or a value of the row's type", "3.4")
    return number
