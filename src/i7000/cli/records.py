"""What was heard, and what commands there are, as records: what ``--json`` writes and `text` prints.

Laws: `fields` are those of the class, numbers as numbers, bytes of settings as one number, as in the vectors of
``spec``; `explained` has the same in words.
"""

import json
from collections.abc import Iterable
from enum import Enum
from functools import cache, lru_cache
from typing import Any

from attrs import fields

from i7000 import DecodeError, LineSettings, ReportSettings, Status, dcon, modbus
from i7000.cli.options import PROTOCOLS
from i7000.cli.readers import Read
from i7000.dissect import ChannelReading, Heard, Item, Meaning
from i7000.dissect.meaning import errata
from i7000.settings import Protocol

__all__ = [
    "OPTIONS",
    "SCHEMA_VERSION",
    "VALUES",
    "Record",
    "command_record",
    "fault_words",
    "json_of",
    "meaning_record",
    "parts_of",
    "register_record",
]

Record = dict[str, Any]
SCHEMA_VERSION = 1
_PROTOCOLS = {protocol: name for name, protocol in PROTOCOLS.items()}

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
    return f"{_json(_head(read))[:-1]}, {middle}, {_NOTHING_WRONG if good else _json(_tail(read, meaning))[1:]}"


def _head(read: Read) -> Record:
    heard = read.heard
    return {
        "schema_version": SCHEMA_VERSION,
        "record": read.number,
        "line": read.line,
        "last_line": read.last,
        "time": read.time,
        "text": read.text,
        "protocol": None if heard is None else _PROTOCOLS[heard.protocol],
        "direction": None if heard is None or heard.direction is None else heard.direction.value,
        "address": None if heard is None else heard.address,
        "frame": None if heard is None else _frame(heard),
        "wire": None if heard is None else heard.wire.hex(),
        "answers": None if heard is None or heard.answers is None else heard.answers.number,
    }


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
"""The keys of a frame of which nothing else is to be said."""


def fault_words(error: DecodeError) -> str:
    """Return what is wrong with a frame that is shown beside it."""
    field = f" in {error.field}" if error.field not in ("", error.fault.value) else ""
    allowed = f"; allowed: {error.allowed}" if error.allowed else ""
    section = f" (manual {error.section})" if "." in error.section else ""
    return f"{error.fault.value}{field} at byte {error.offset}{allowed}{section}"


def _frame(heard: Heard) -> str:
    """Return a frame as people write it."""
    if heard.protocol is Protocol.MODBUS_RTU:
        return heard.wire.hex(" ").upper()
    return heard.wire.removesuffix(b"\r").decode("ascii", "backslashreplace")


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
    if not meaning.readings:
        return _json(meaning_record(meaning))[1:-1]
    before, after = _around_readings(meaning)
    kind: Any = type(meaning.message)
    values = {name: _plain(getattr(meaning.message, name)) for name in _names(kind)}
    words = {}
    if len(values) > 1 or not values.keys() <= VALUES:
        words = {field.name: field.text for field in meaning.fields if field.name not in VALUES}
    readings = ", ".join(map(_reading_json, meaning.readings))
    items = ", ".join(map(_item_json, meaning.items))
    return (
        f'{before}, "fields": {_json(values)}, "explained": {_json(words) if words else "{}"}, '
        f'"readings": [{readings}], "registers": [{items}], {after}'
    )


def _around_readings(meaning: Meaning) -> tuple[str, str]:
    """Return the keys before and after those of the readings, which all reports of a module share."""
    key = (type(meaning.message), type(meaning.command), meaning.fit, meaning.assumed)
    found = _AROUND.get(key)
    if found is None:
        if len(_AROUND) >= _REMEMBERED:
            _AROUND.clear()
        record = meaning_record(meaning)
        keys = list(record)
        parts = (keys[: keys.index("fields")], keys[keys.index("errata") :])
        before, after = ({name: record[name] for name in part} for part in parts)
        found = _AROUND[key] = _json(before)[1:-1], _json(after)[1:-1]
    return found


_AROUND: dict[tuple[Any, ...], tuple[str, str]] = {}


def _reading_json(reading: ChannelReading) -> str:
    channel, text, status, type_code, value, unit = reading
    if status is not Status.OK or channel is None or type_code is None:
        return _json(_reading(reading))
    return (
        f'{{"channel": {channel}, "text": "{text}", "status": "ok", "type_code": {type_code:d}, '
        f'"value": {value!r}, "unit": "{unit}"}}'
    )


def _item_json(item: Item) -> str:
    number, name, channel, value, unit, text, reading, *_ = item
    if reading is None or reading.status is not Status.OK or channel is None:
        return _json(_item(item))
    return (
        f'{{"number": "{number}", "name": "{name}", "channel": {channel}, "value": {value!r}, "unit": "{unit}", '
        f'"status": "ok", "text": "{text}"}}'
    )


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
