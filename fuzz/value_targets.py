"""What fields, words and registers mean: any text or words are a value or a `DecodeError`, and a value is written back.

Laws: `EncodeError` is right only for a value that is beyond the span of its type or the range of its register.
"""

import struct
from functools import lru_cache
from math import isfinite
from typing import Any

from fuzz.inputs import HEADER, profile_of
from i7000 import DataFormat, DecodeError, EncodeError, Profile, Reading, Status, TypeCode, modbus
from i7000.modbus.register_map import READERS
from i7000.readings import (
    decode_engineering_word,
    decode_field,
    decode_word,
    encode_engineering_word,
    encode_field,
    encode_word,
)

__all__ = ["FORMATS", "LEGACY", "TYPES", "reading_text", "reading_words", "registers"]

TYPES = tuple(TypeCode)
FORMATS = tuple(DataFormat)
LEGACY, LENIENT = 0x10, 0x20
"""Bits of the second byte of a field; below them is the data format."""
_BIG_ENDIAN, _BY_NUMBER, _EXACT = 1, 2, 4
"""Bits of the byte after the row of a register; with the last, there are as many items as the row has."""


def reading_text(data: bytes) -> None:
    """Decode the field of a channel, and encode the reading as a field that means the same.

    Shape: the type, the data format and options, then the field in Latin-1.
    """
    if len(data) < 2:
        return
    code, options = TYPES[data[0] % len(TYPES)], data[1]
    data_format = FORMATS[(options & 3) % len(FORMATS)]
    legacy, lenient = bool(options & LEGACY), bool(options & LENIENT)
    field = data[2:].decode("latin-1")
    try:
        reading = decode_field(field, code, data_format, legacy=legacy, lenient=lenient)
    except DecodeError as error:
        assert str(error)
        return
    _check_reading(reading, code)
    try:
        again = encode_field(reading, code, data_format, legacy=legacy)
    except EncodeError:
        assert _is_beyond(reading, code)
        return
    if lenient:  # with other decimals than those of the type
        decode_field(again, code, data_format, legacy=legacy, lenient=True)
        return
    assert decode_field(again, code, data_format, legacy=legacy) == reading
    if not legacy and reading.value:
        assert again in (field, field.replace("-", "+"))


def _check_reading(reading: Reading, code: TypeCode) -> None:
    assert reading.unit is code.unit
    assert (reading.value is None) == (reading.status is not Status.OK)
    assert reading.value is None or isfinite(reading.value)


def _is_beyond(reading: Reading, code: TypeCode) -> bool:
    return reading.value is not None and not code.minimum <= reading.value <= code.maximum


def reading_words(data: bytes) -> None:
    """Decode the words of analog inputs, and encode the readings as the same words.

    Shape: the profile, the first channel, then words, high byte first.
    """
    if len(data) <= HEADER:
        return
    profile, channel = profile_of(data), data[HEADER]
    words = _words(data[HEADER + 1 :])
    for word, code in zip(words[:4], TYPES[channel % len(TYPES) :], strict=False):
        _check_word(word, code)
    try:
        readings = modbus.readings(words, profile, channel=channel)
    except DecodeError as error:
        assert str(error)
        assert channel + len(words) > len(profile.type_codes)
        return
    types = profile.type_codes[channel : channel + len(words)]
    for reading, code in zip(readings, types, strict=True):
        _check_reading(reading, code)
    try:
        again = modbus.words(readings, profile, channel=channel)
    except EncodeError:
        assert any(_is_beyond(reading, code) for reading, code in zip(readings, types, strict=True))
        return
    assert again == words


def _check_word(word: int, code: TypeCode) -> None:
    reading = decode_word(word, code)
    assert encode_word(reading, code) == word
    engineering = decode_engineering_word(word, code)
    _check_reading(engineering, code)
    try:
        assert encode_engineering_word(engineering, code) == word
    except EncodeError:
        assert _is_beyond(engineering, code)


def _words(data: bytes) -> tuple[int, ...]:
    return struct.unpack(f">{len(data) // 2}H", data[: len(data) & ~1])


@lru_cache(maxsize=1 << 10)
def _map_of(profile: Profile) -> modbus.RegisterMap:
    return modbus.RegisterMap(profile)


def registers(data: bytes) -> None:
    """Decode the items of a row of an address map; what can be written is written as the same items.

    Shape: the profile, the row, options, then words, high byte first.
    """
    if len(data) < HEADER + 2:
        return
    found = _map_of(profile_of(data))
    if not found.rows:
        return
    row, options = found.rows[data[HEADER] % len(found.rows)], data[HEADER + 1]
    items = _words(data[HEADER + 2 :])
    if row.area.bits:
        items = tuple(item & 1 if item < 0xFF00 else item for item in items)
    key = row.number if options & _BY_NUMBER else row.name
    big_endian = bool(options & _BIG_ENDIAN)
    if options & _EXACT:
        items = (items + (0,) * row.count)[: _count_of(found, row, key)]
    try:
        value = found.decode(key, items, big_endian=big_endian)
    except DecodeError as error:
        assert str(error)
        return
    assert found.find(key).describe(value[0] if isinstance(value, tuple) and value else value)
    try:
        request: Any = found.write(1, key, value, big_endian=big_endian)
    except EncodeError as error:
        assert str(error)
        return
    written = request.values if hasattr(request, "values") else (int(request.value),)
    assert written == items or row.area.bits


def _count_of(found: modbus.RegisterMap, row: modbus.Register, key: str) -> int:
    """Return how many items the row has in the connecting mode; one for a row that cannot be read."""
    if row.access is modbus.Access.WRITE or row.area not in READERS:
        return 1
    try:
        return found.read(1, key).count
    except EncodeError:  # a channel beyond those of the connecting mode
        return 1
