"""The coils, inputs and registers that a Modbus message touches, by name.

Laws: every item that a message touches is there, with the number of the manual, whether it has a name or not.
"""

from collections.abc import Iterator
from enum import Enum
from functools import lru_cache
from typing import Any, NamedTuple

from i7000 import DecodeError, Firmware, LineSettings, Profile, modbus
from i7000.dissect.meaning import Item
from i7000.modbus import Access, Area, Kind, Register, RegisterMap

__all__ = ["items"]

_LONG = (Kind.UINT32, Kind.RECORD)
"""Kinds of more than one word."""


class _Place(NamedTuple):
    """What some items that a message touches are, whatever is sent of them: one thing, or the readings of channels."""

    at: int
    """The first of the items, counted from the first that is touched."""
    used: int
    """How many items they are."""
    row: Register
    """Where they are; a row without a name where the map has none."""
    channel: int | None
    """The first channel."""
    empty: tuple[Item, ...]
    """The items to show if no values are sent."""
    part: str
    """Which word of a longer number it is, if that is all there is."""


def items(message: modbus.Message, request: modbus.Request[Any] | None, profile: Profile | None) -> Iterator[Item]:
    """Yield the registers that a message touches, by name if the profile is known.

    Special: without its request, a response does not show which they are.
    """
    area = message.area
    place = request if isinstance(message, modbus.Items) else message
    start = None if place is None else place.first_item
    if area is None or start is None:
        return
    values = _values(message)
    for it in _places(profile, area, start, len(values) or getattr(message, "count", 1)):
        if values:
            yield from _valued(profile, it, values[it.at : it.at + it.used], written=request is None)
        else:
            yield from it.empty


def _values(message: modbus.Message) -> tuple[int, ...]:
    """Return the values that a message carries to or from registers."""
    if hasattr(message, "value"):
        return (message.value,)
    return getattr(message, "values", ())


@lru_cache(maxsize=8)
def _map(profile: Profile) -> RegisterMap:
    return RegisterMap(profile)


@lru_cache(maxsize=32)
def _places(profile: Profile | None, area: Area, start: int, count: int) -> tuple[_Place, ...]:
    """List what `count` items from `start` on are."""
    rows = [] if profile is None else [row for row in _map(profile) if row.area is area]
    found = []
    at = 0
    while at < count:
        row = next((row for row in rows if row.address <= start + at < row.address + row.count), None)
        place = _place(profile, row or Register("", area, start + at), start + at, at, count - at)
        found.append(place)
        at += place.used
    return tuple(found)


def _place(profile: Profile | None, row: Register, address: int, at: int, left: int) -> _Place:
    """Return what is shown together of the `left` items from `address` on."""
    offset = address - row.address
    used = told = 1
    if row.kind in _LONG and not offset and row.count <= left:
        used = row.count
    elif row.kind is Kind.READING and profile is not None:
        used = told = max(1, min(left, len(profile.type_codes) - offset))
    channel = offset if row.count > 1 and row.kind not in _LONG else None
    words = None if row.name or profile is None else "not in the map"
    empty = tuple(
        Item(
            Register("", row.area, address + more).number,
            row.name or None,
            None if channel is None else channel + more,
            None,
            row.unit,
            words,
        )
        for more in range(told)
    )
    part = f"word {offset + 1} of {row.count}" if row.kind in _LONG and used == 1 else ""
    return _Place(at, used, row, channel, empty, part)


def _valued(profile: Profile | None, place: _Place, sent: tuple[int, ...], *, written: bool) -> Iterator[Item]:
    row, channel = place.row, place.channel
    number, name, _, _, _, words, *_ = empty = place.empty[0]
    if profile is None or not name or place.part:
        raw, remark = _raw(row, sent[0]), place.part or words
        yield Item(number, name, channel, sent[0], None, f"{raw}, {remark}" if remark else raw)
    elif row.kind is Kind.READING:
        yield from _readings(profile, place, sent)
    else:
        channels = None if channel is None else range(channel, channel + 1)
        try:
            value: Any = _map(profile).decode(row.name, sent, channels=channels)
        except DecodeError:
            yield Item(number, name, channel, sent[0], None, f"{_raw(row, sent[0])}, not defined")
            return
        value = value if channel is None else value[0]
        if row.kind is Kind.RECORD:
            yield from _log(empty, value)
        else:
            fact = None
            if row.fact and not (written and row.access is Access.READ):
                fact = row.fact, value
            yield Item(number, name, channel, _plain(value), row.unit, row.describe(value), fact=fact)


def _readings(profile: Profile, place: _Place, sent: tuple[int, ...]) -> Iterator[Item]:
    """Yield the readings of channels; a channel that the connecting mode lacks has no type and no reading."""
    first = place.channel or 0
    types = profile.type_codes[first : first + len(sent)]
    if not types:
        (empty,) = place.empty
        yield Item(empty.number, empty.name, empty.channel, sent[0], None, f"{sent[0]:04X}")
        return
    found = modbus.readings(sent, profile, channel=first)
    for empty, word, reading, type_code in zip(place.empty, sent, found, types, strict=True):
        value, unit, _ = reading
        yield Item(empty.number, empty.name, empty.channel, value, unit, f"{word:04X}", reading, type_code)


def _raw(row: Register, item: int) -> str:
    return f"{item:d}" if row.area.bits else f"{item:04X}"


def _log(empty: Item, records: tuple[modbus.LogRecord, ...]) -> Iterator[Item]:
    """Yield the records of the data logger."""
    for index, record in enumerate(records):
        texts = (f"{it.value:.7g}" if it.value is not None else it.status.value for it in record.readings)
        text = f"record {index}, {record.time} s: {' '.join(texts)} {record.readings[0].unit}"
        yield empty._replace(value=record.time, text=text)


def _plain(value: Any) -> Any:  # noqa: ANN401 - of any register
    if isinstance(value, LineSettings):
        return value.byte
    if isinstance(value, Firmware):
        return str(value)
    return value.value if isinstance(value, Enum) else value
