"""What was heard, and what commands there are, as records: what ``--json`` writes and `text` prints.

Laws: `fields` are those of the class, numbers as numbers, bytes of settings as one number, as in the vectors of
``spec``; `explained` has the same in words.
"""

from collections.abc import Iterable
from enum import Enum
from functools import lru_cache
from typing import Any

from attrs import fields

from i7000 import LineSettings, ReportSettings, dcon, modbus
from i7000.dissect import ChannelReading, Heard, Item, Meaning, Piece
from i7000.dissect.meaning import errata
from i7000.message import Message
from i7000.settings import Protocol

__all__ = [
    "PROTOCOLS",
    "SCHEMA_VERSION",
    "Record",
    "command_record",
    "frameless_record",
    "heard_record",
    "parts_of",
    "register_record",
]

Record = dict[str, Any]
SCHEMA_VERSION = 1
PROTOCOLS = {Protocol.DCON: "dcon", Protocol.MODBUS_RTU: "rtu"}
"""The protocols as the options name them."""

_UNKNOWN: Record = {
    "name": None, "title": None, "section": None, "syntax": None, "command": None, "fields": {}, "explained": {},
    "readings": [], "registers": [], "errata": [], "pause": 0.0, "models": [], "checksum": None, "data_formats": [],
    "assumed": [], "notes": [],
}  # fmt: skip
"""A meaning that is unknown: all the keys, and nothing else."""


def parts_of(kind: type[Message]) -> dict[str, Any]:
    """Return the fields of a message class with their attrs, whose type has the part of the layout."""
    return {field.name: field for field in fields(kind)}  # type: ignore[arg-type] # all of them are attrs classes


# --- decode -----------------------------------------------------------------------------------------------------------


def heard_record(piece: Piece, heard: Heard) -> Record:
    """Return the record of a frame."""
    meaning = heard.meanings[0] if len(heard.meanings) == 1 else None
    several = heard.candidates if meaning else (*heard.meanings, *heard.candidates)
    record = _head(heard.place.number, piece) | {
        "protocol": PROTOCOLS[heard.protocol],
        "direction": heard.direction and heard.direction.value,
        "address": heard.address,
        "frame": _frame(heard),
        "wire": heard.wire.hex(),
        "answers": heard.answers and heard.answers.number,
    }
    record |= _UNKNOWN if meaning is None else _meaning_record(meaning, remember=len(heard.wire) <= _SHORT)
    notes = [*heard.notes, *heard.contradictions]
    return record | {
        "notes": notes,
        "note": "; ".join(notes) or None,
        "candidates": [meaning_record(candidate) for candidate in several],
        "contradictions": list(heard.contradictions),
        "error": None if heard.error is None else str(heard.error),
        "fault": None if heard.error is None else heard.error.fault.value,
    }


def frameless_record(number: int, piece: Piece) -> Record:
    """Return the record of a line without a frame."""
    return _head(number, piece) | {
        "protocol": None, "direction": None, "address": None, "frame": None, "wire": None, "answers": None, **_UNKNOWN,
        "notes": [_NO_FRAME], "note": _NO_FRAME, "candidates": [], "contradictions": [], "error": None, "fault": None,
    }  # fmt: skip


_NO_FRAME = "no frame in this line"


def _head(number: int, piece: Piece) -> Record:
    return {
        "schema_version": SCHEMA_VERSION,
        "record": number,
        "line": piece.number,
        "last_line": piece.last,
        "text": _shown(piece.text),
    }


def _shown(text: str) -> str:
    """Return a line without its end; bytes that are no UTF-8 are escaped."""
    return text.rstrip("\r\n").encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")


def _frame(heard: Heard) -> str:
    """Return a frame as people write it."""
    if heard.protocol is Protocol.MODBUS_RTU:
        return heard.wire.hex(" ").upper()
    return heard.wire.removesuffix(b"\r").decode("ascii", "backslashreplace")


_REMEMBERED = 256
"""Meanings of which the records are kept."""
_SHORT = 128
"""Bytes of a frame up to which its record is kept: those of a frame full of coils are large."""


def _meaning_record(meaning: Meaning, *, remember: bool) -> Record:
    return _remembered_record(meaning) if remember else meaning_record(meaning)


def meaning_record(meaning: Meaning) -> Record:
    """Return the record of a meaning."""
    message, command = meaning.message, meaning.command
    items = [_item(item) for item in meaning.items]
    shown_elsewhere = _VALUES if items or isinstance(message, dcon.Message) else ()
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
        "assumed": [_OPTIONS[name] for name in meaning.assumed],
        "notes": list(meaning.notes),
    }


_remembered_record = lru_cache(maxsize=_REMEMBERED)(meaning_record)
_VALUES = ("value", "values")
"""Fields that readings and registers show."""
_OPTIONS = {"types": "type", "data_format": "format", "modbus_data_format": "modbus_format"}
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
