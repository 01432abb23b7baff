"""Registers and coils by name: those that a message touches, and those of a model.

Laws: every item that a message touches is told, by the manual's number, if it has a name or not.
"""

from collections.abc import Callable, Iterator
from enum import Enum
from functools import lru_cache
from typing import Any

from attrs import evolve, frozen

from i7000 import DecodeError, LineSettings, Profile, Reading, TypeCode, modbus
from i7000.cli.words import line_settings_words, mask_words, module_name_words, type_code_words
from i7000.modbus import Area, Kind, Register, RegisterMap

__all__ = ["Cell", "cells", "register_record"]

_AREAS: dict[str, Area] = {
    "01": Area.COIL,
    "02": Area.DISCRETE_INPUT,
    "03": Area.HOLDING_REGISTER,
    "04": Area.INPUT_REGISTER,
    "05": Area.COIL,
    "06": Area.HOLDING_REGISTER,
    "0F": Area.COIL,
    "10": Area.HOLDING_REGISTER,
}
"""What a function is about."""
_LONG = (Kind.UINT32, Kind.RECORD)
"""Kinds of more than one word."""


@frozen
class Cell:
    """One thing that a message touches: an item, or the two of a 32-bit number."""

    number: str
    """The manual's: 40489."""
    name: str | None
    """None: the map does not have it, or the model is not known."""
    channel: int | None
    value: Any
    """In units; what was sent, where it has no name; None if nothing was."""
    unit: str | None
    text: str | None
    """The value in words; the word of a reading in hex."""
    reading: Reading | None = None
    type_code: TypeCode | None = None


def cells(message: modbus.Message, request: modbus.Request[Any] | None, profile: Profile | None) -> Iterator[Cell]:
    """Tell the registers that a message touches, by name if the profile is known.

    Special: a response without its request does not tell which they are.
    """
    area = _AREAS.get(message.pdu[:2])
    place = request if isinstance(message, modbus.Items) else message
    starts = [getattr(place, name) for name in ("start", "coil", "register") if hasattr(place, name)]
    if area is None or not starts:
        return
    values = _values(message)
    count = len(values) or getattr(message, "count", 1)
    known = _map(profile) if profile else None
    at, end = starts[0], starts[0] + count
    while at < end:
        row = _row_at(known, area, at)
        used = _used(row, at, end)
        sent = values[at - starts[0] :][:used]
        yield from _told(known, row or Register("", area, at), at, sent, whole=used > 1)
        at += used


@lru_cache(maxsize=8)
def _map(profile: Profile) -> RegisterMap:
    return RegisterMap(profile)


def _values(message: modbus.Message) -> tuple[int, ...]:
    """What a message sends to registers, or of them."""
    if hasattr(message, "value"):
        return (message.value,)
    return getattr(message, "values", ())


def _row_at(known: RegisterMap | None, area: Area, at: int) -> Register | None:
    rows = (row for row in known or () if row.area is area and row.address <= at < row.address + row.count)
    return next(rows, None)


def _used(row: Register | None, at: int, end: int) -> int:
    """How many items are one thing: all of a row that is more than a word, if all are there."""
    return row.count if row and row.kind in _LONG and at == row.address and at + row.count <= end else 1


def _told(known: RegisterMap | None, row: Register, at: int, sent: tuple[int, ...], *, whole: bool) -> Iterator[Cell]:
    channel = at - row.address if row.count > 1 and row.kind not in _LONG else None
    number = evolve(row, address=at).number
    empty = Cell(number, row.name or None, channel, None, row.unit, None if row.name or not known else "not in the map")
    if not sent:
        yield empty
        return
    raw = evolve(empty, value=sent[0], unit=None, text=_raw(row, sent[0]))
    if not known or not row.name:
        yield evolve(raw, text=f"{raw.text}, {empty.text}" if empty.text else raw.text)
        return
    if row.kind in _LONG and not whole:
        yield evolve(raw, text=f"{raw.text}, word {at - row.address + 1} of {row.count}")
        return
    channels = None if channel is None else range(channel, channel + 1)
    try:
        value = known.decode(row.name, sent, channels=channels)
    except DecodeError:
        yield evolve(raw, text=raw.text if row.kind is Kind.READING else f"{raw.text}, not defined")
        return
    value = value if channel is None else value[0]
    if row.kind is Kind.RECORD:
        yield from _log(empty, value)
    elif isinstance(value, Reading):
        type_code = known.profile.type_codes[channel or 0]
        yield evolve(raw, value=value.value, unit=value.unit, reading=value, type_code=type_code)
    else:
        yield evolve(empty, value=_plain(value), text=_words(row, value))


def _raw(row: Register, item: int) -> str:
    return f"{item:d}" if row.area.bits else f"{item:04X}"


def _log(empty: Cell, records: tuple[modbus.LogRecord, ...]) -> Iterator[Cell]:
    """Tell the records of the data logger."""
    for index, record in enumerate(records):
        texts = (f"{it.value:.7g}" if it.value is not None else it.status.value for it in record.readings)
        text = f"record {index}, {record.time} s: {' '.join(texts)} {record.readings[0].unit}"
        yield evolve(empty, value=record.time, text=text)


def _plain(value: Any) -> Any:  # noqa: ANN401 - of any register
    if isinstance(value, LineSettings):
        return value.byte
    if isinstance(value, bytes):
        return value.hex()
    return value.value if isinstance(value, Enum) else value


def _words(row: Register, value: Any) -> str:  # noqa: ANN401 - of any register
    if row.name in _WORDS and not (row.name == "line_settings" and isinstance(value, int)):
        return _WORDS[row.name](value)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, Enum):
        return value.name.lower()
    return f"{value:.7g} {row.unit}" if row.unit else f"{value}"


_WORDS: dict[str, Callable[[Any], str]] = {
    "type_code": type_code_words,
    "module_type_code": type_code_words,
    "channel_mask": mask_words,
    "line_settings": line_settings_words,
    "module_name": module_name_words,
    "firmware_version": "{:08X}".format,
}


# --- the map of a model -----------------------------------------------------------------------------------------------


def register_record(row: Register) -> dict[str, Any]:
    """A row of the map as ``i7000 registers`` lists it."""
    return {
        "number": row.number,
        "last_number": row.last_number,
        "name": row.name,
        "address": row.address,
        "count": row.count,
        "access": row.access.value,
        "kind": row.kind.value,
        "unit": row.unit,
        "scale": row.scale,
        "minimum": row.minimum,
        "maximum": row.maximum,
    }
