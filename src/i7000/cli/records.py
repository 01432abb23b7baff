"""What was heard, and what commands there are, as records: what ``--json`` writes and `text` prints.

Laws: `fields` are those of the class, numbers as numbers, bytes of settings as one number, as in the vectors of
``spec``; `explained` has the same in words.
"""

import json
from collections.abc import Iterable
from enum import Enum
from functools import cache, lru_cache
from itertools import chain, cycle, repeat
from json.encoder import encode_basestring_ascii as _quoted
from typing import Any

from attrs import field, fields, frozen

from i7000 import DecodeError, Fault, LineSettings, ReportSettings, Status, dcon, modbus
from i7000.cli.choices import SPOKEN
from i7000.cli.readers import Read
from i7000.dissect import ChannelReading, Heard, Item, Meaning
from i7000.dissect.meaning import Fit, errata
from i7000.readings import Reading
from i7000.settings import Protocol

__all__ = [
    "OPTIONS",
    "SCHEMA_VERSION",
    "VALUES",
    "Record",
    "command_record",
    "fault_words",
    "frame_words",
    "json_of",
    "meaning_record",
    "parts_of",
    "register_record",
    "wrong_words",
]

Record = dict[str, Any]
SCHEMA_VERSION = 1

_UNKNOWN: Record = {
    "name": None, "title": None, "section": None, "syntax": None, "command": None, "fields": {}, "explained": {},
    "readings": [], "registers": [], "errata": [], "pause": 0.0, "models": [], "checksum": None, "data_formats": [],
    "assumed": [],
}  # fmt: skip
"""A meaning that is unknown: all the keys, and nothing else."""
_json = json.JSONEncoder(check_circular=False).encode
_UNKNOWN_JSON = _json(_UNKNOWN)[1:-1]


def parts_of(kind: Any) -> dict[str, Any]:  # noqa: ANN401 - a message class
    """Return the fields of a message class with their attrs, whose type has the part of the layout."""
    return {field.name: field for field in fields(kind)}


@cache
def _names(kind: Any) -> tuple[str, ...]:  # noqa: ANN401 - a message class
    return tuple(parts_of(kind))


# --- decode -----------------------------------------------------------------------------------------------------------


def json_of(read: Read) -> str:
    """Return what was read as a JSON object."""
    heard = read.heard
    meaning = heard.meanings[0] if heard is not None and len(heard.meanings) == 1 else None
    middle = _UNKNOWN_JSON
    if heard is not None and meaning is not None:
        middle = (_remembered_json if len(heard.wire) <= _SHORT else _meaning_json)(meaning)
    good = meaning is not None and heard is not None and not heard.notes and heard.understood
    return f"{_head_json(read)}, {middle}, {_NOTHING_WRONG if good else _json(_tail(read, meaning))[1:]}"


def _head_json(read: Read) -> str:
    """Return the keys of a frame in its place, as the beginning of a JSON object."""
    number, line, last, text, time, heard, *_ = read
    place = (
        f'{{"schema_version": {SCHEMA_VERSION}, "record": {number}, "line": {line}, "last_line": {last}, '
        f'"time": {_NULL if time is None else _quoted(time)}, "text": {_quoted(text)}, '
    )
    if heard is None:
        return f"{place}{_NOT_HEARD}"
    address, answers = heard.address, heard.answers
    direction = _NULL if heard.direction is None else _quoted(heard.direction)
    return (
        f'{place}"protocol": "{SPOKEN[heard.protocol]}", "direction": {direction}, '
        f'"address": {_NULL if address is None else address}, '
        f'"frame": {_quoted(frame_words(heard.wire, heard.protocol))}, '
        f'"wire": "{heard.wire.hex()}", "answers": {_NULL if answers is None else answers.number}'
    )


_NULL = "null"
_NOT_HEARD = _json(dict.fromkeys(("protocol", "direction", "address", "frame", "wire", "answers")))[1:-1]


def _tail(read: Read, meaning: Meaning | None) -> Record:
    heard = read.heard
    if heard is None:
        notes = [] if read.note is None else [read.note]
        return {
            "notes": notes, "note": read.note, "contradictions": [], "candidates": [], "error": None, "fault": None,
        }  # fmt: skip
    notes = [*heard.notes, *heard.contradictions]
    several = heard.candidates if meaning else (*heard.meanings, *heard.candidates)
    return {
        "notes": notes,
        "note": "; ".join(notes) or None,
        "contradictions": list(heard.contradictions),
        "candidates": [meaning_record(candidate) | {"notes": list(candidate.notes)} for candidate in several],
        "error": None if heard.error is None else fault_words(heard.error),
        "fault": None if heard.error is None else heard.error.fault.value,
    }


_NOTHING_WRONG = _json(_tail(Read(0, 0, 0, "", None, None), None))[1:]
"""The keys of a frame without a note, an error or another meaning."""


def wrong_words(heard: Heard) -> str:
    """Return what is wrong with a frame that cannot be decoded; its notes have the cause."""
    assert heard.error is not None  # noqa: S101 - only such a frame has it
    if heard.error.fault is Fault.CHECKSUM and any("checksum" in note for note in heard.notes):
        return "the checksum is missing or wrong"
    return fault_words(heard.error)


def fault_words(error: DecodeError) -> str:
    """Return what is wrong with a frame that is shown beside it."""
    field = f" in {error.field}" if error.field not in ("", error.fault.value) else ""
    allowed = f"; allowed: {error.allowed}" if error.allowed else ""
    section = f" (manual {error.section})" if "." in error.section else ""
    return f"{error.fault.value}{field} at byte {error.offset}{allowed}{section}"


def frame_words(wire: bytes, protocol: Protocol) -> str:
    """Return a frame as people write it."""
    if protocol is Protocol.MODBUS_RTU:
        return wire.hex(" ").upper()
    return wire.removesuffix(b"\r").decode("ascii", "backslashreplace")


_REMEMBERED = 256
"""Meanings of which the records are kept."""
_SHORT = 128
"""Bytes of a frame up to which its record is kept: those of a frame full of coils are large."""


def meaning_record(meaning: Meaning) -> Record:
    """Return the record of a meaning."""
    message, command = meaning.message, meaning.command
    items = [_item(item) for item in meaning.items]
    shown_elsewhere = VALUES if items or isinstance(message, dcon.Message) else ()
    return {
        "name": type(message).__name__,
        "title": message.title,
        "section": meaning.section,
        "syntax": message.syntax if isinstance(message, dcon.Message) else message.pdu,  # type: ignore[attr-defined]
        "command": None if command is None else type(command).__name__,
        "fields": {field.name: _plain(field.value) for field in meaning.fields},
        "explained": {field.name: field.text for field in meaning.fields if field.name not in shown_elsewhere},
        "readings": [_reading(reading) for reading in meaning.readings],
        "registers": items,
        "errata": list(meaning.errata),
        "pause": meaning.pause,
        "models": [model.value for model in meaning.models],
        "checksum": meaning.checksum,
        "data_formats": [data_format.name.lower() for data_format in meaning.data_formats],
        "assumed": [OPTIONS[name] for name in meaning.assumed],
    }


def _meaning_json(meaning: Meaning) -> str:
    """Return the keys of a meaning as a part of a JSON object.

    Special: of readings, of which a log has most, only what differs is encoded each time.
    """
    readings, message = meaning.readings, meaning.message
    if not readings:
        return _json(meaning_record(meaning))[1:-1]
    kind: Any = type(message)
    names = _names(kind)
    values = tuple([getattr(message, name) for name in names])
    others = tuple([value for name, value in zip(names, values, strict=True) if name not in VALUES])
    before, words, after = _around(_Report(kind, type(meaning.command), meaning.fit, meaning.assumed, others, meaning))
    written = ", ".join([f'"{name}": {_value_json(value)}' for name, value in zip(names, values, strict=True)])
    found, items = _readings_json(readings, meaning.items)
    return (
        f'{before}, "fields": {{{written}}}, "explained": {words}, '
        f'"readings": [{found}], "registers": [{items}], {after}'
    )


@frozen
class _Report:
    """What the reports of a module share; they are equal if they differ in nothing but their readings."""

    kind: type
    command: type
    fit: Fit
    assumed: tuple[str, ...]
    others: tuple[Any, ...]
    """The fields without readings."""
    meaning: Meaning = field(eq=False)
    """One of them."""


@lru_cache(maxsize=_REMEMBERED)
def _around(report: _Report) -> tuple[str, str, str]:
    """Return the keys before the fields, the fields in words, and the keys after the readings."""
    record = meaning_record(report.meaning)
    names = list(record)
    parts = (names[: names.index("fields")], names[names.index("errata") :])
    before, after = (_json({name: record[name] for name in part})[1:-1] for part in parts)
    words = {name: text for name, text in record["explained"].items() if name not in VALUES}
    return before, _json(words), after


def _value_json(value: Any) -> str:  # noqa: ANN401 - of any field
    if value.__class__ is tuple:
        kinds = set(map(type, value))
        if kinds == {str}:
            return f"[{', '.join(map(_quoted, value))}]"
        if kinds == {int}:
            return repr([*value])
    return _json(_plain(value))


def _readings_json(readings: tuple[ChannelReading, ...], items: tuple[Item, ...]) -> tuple[str, str]:
    """Return readings and the registers that have them, each as the inner part of a JSON array."""
    channels, texts, statuses, types, values, units = zip(*readings, strict=True)
    if statuses.count(Status.OK) == len(readings):
        statuses = _ALL_OK
    written = [_NULL if value is None else repr(value) for value in values]
    quoted = list(map(_quoted, texts))
    found = _reading_form(channels, statuses, types, units) % tuple(
        chain.from_iterable(zip(quoted, written, strict=True))
    )
    if len(items) != len(readings):
        return found, ", ".join([_json(_item(it)) for it in items])
    numbers, names, channels, _, units, *_ = zip(*items, strict=True)
    form = _item_form(numbers, names, channels, units, statuses)
    return found, form % tuple(chain.from_iterable(zip(written, quoted, strict=True)))


_Every = tuple[Any, ...]
_ALL_OK = (Status.OK,)
"""Stands for the statuses of any number of readings, since a hash of each takes longer than the rest."""


@lru_cache(maxsize=_REMEMBERED)
def _reading_form(channels: _Every, statuses: _Every, types: _Every, units: _Every) -> str:
    """Return the JSON of readings, with gaps for the texts and the values."""
    found = map(ChannelReading, channels, repeat("%s"), cycle(statuses), types, repeat("%s"), units)
    return _with_gaps(map(_reading, found))


@lru_cache(maxsize=_REMEMBERED)
def _item_form(numbers: _Every, names: _Every, channels: _Every, units: _Every, statuses: _Every) -> str:
    """Return the JSON of registers with readings, with gaps for the values and the texts."""
    readings = map(Reading, repeat(None), units, cycle(statuses))
    return _with_gaps(map(_item, map(Item, numbers, names, channels, repeat("%s"), units, repeat("%s"), readings)))


def _with_gaps(records: Iterable[Record]) -> str:
    return ", ".join(map(_json, records)).replace('"%s"', "%s")


_remembered_json = lru_cache(maxsize=_REMEMBERED)(_meaning_json)
VALUES = frozenset(("value", "values"))
"""Fields that readings and registers show."""
OPTIONS = {"types": "type", "data_format": "format", "modbus_data_format": "modbus_format"}
"""The options that say what is assumed."""


def _plain(value: Any) -> Any:  # noqa: ANN401 - of any field
    if isinstance(value, LineSettings | ReportSettings):
        return value.byte
    if isinstance(value, bytes):
        return value.hex()
    if isinstance(value, tuple):
        return list(value)
    return value.value if isinstance(value, Enum) else value


def _reading(reading: ChannelReading) -> Record:
    channel, text, status, type_code, value, unit = reading
    return {
        "channel": channel,
        "text": text,
        "status": status and status.value,
        "type_code": None if type_code is None else int(type_code),
        "value": value,
        "unit": unit,
    }


def _item(item: Item) -> Record:
    return {
        "number": item.number,
        "name": item.name,
        "channel": item.channel,
        "value": item.value,
        "unit": item.unit,
        "status": item.reading and item.reading.status.value,
        "text": item.text,
    }


# --- commands ---------------------------------------------------------------------------------------------------------


def command_record(command: Any, models: Iterable[str]) -> Record:  # noqa: ANN401 - a class of either protocol
    """Return the record of a command or request, as ``i7000 commands`` lists it."""
    response = getattr(command, "response", None)
    since = {model.value: firmware and str(firmware) for model, firmware in command.availability.gates.items()}
    return {
        "section": command.section,
        "name": command.__name__,
        "title": command.title,
        "syntax": _syntax(command),
        "fields": {name: field.type.__metadata__[0].allowed for name, field in parts_of(command).items()},
        "response": response and response.__name__,
        "response_syntax": response and _syntax(response),
        "models": {model: since[model] for model in models},
        "errata": list(errata(command)),
    }


def _syntax(kind: Any) -> str:  # noqa: ANN401 - a class of either protocol
    return str(kind.pdu if issubclass(kind, modbus.Message) else kind.syntax)


def register_record(row: modbus.Register) -> Record:
    """Return the record of a row of an address map, as ``i7000 registers`` lists it."""
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
