"""The JSON Schema of what ``i7000 decode --json`` writes."""

import json
from typing import Any

from i7000 import Fault, Model, Status, Unit
from i7000.dissect import Direction

__all__ = ["SCHEMA"]

_Schema = dict[str, Any]


def _or_null(kind: str, **more: Any) -> _Schema:  # noqa: ANN401 - of any keyword
    return {"type": [kind, "null"], **more}


def _list(items: _Schema) -> _Schema:
    return {"type": "array", "items": items}


def _choice(*values: str | None) -> _Schema:
    return {"enum": [*values, None]}


def _object(properties: _Schema) -> _Schema:
    """Return the schema of an object that has all of these keys, and no other."""
    return {"type": "object", "properties": properties, "required": list(properties), "additionalProperties": False}


_TEXT: _Schema = {"type": "string"}
_NUMBER: _Schema = {"type": "integer", "minimum": 0}
_ANYTHING: _Schema = {"type": ["string", "number", "boolean", "array", "null"]}

_READING = _object(
    {
        "channel": _or_null("integer", minimum=0),
        "text": {"type": "string", "description": "The field as it was sent; of a register its word in hex."},
        "status": _choice(*(status.value for status in Status)),
        "type_code": _or_null("integer"),
        "value": _or_null("number"),
        "unit": _choice(*(unit.value for unit in Unit)),
    }
)
_REGISTER = _object(
    {
        "number": {"type": "string", "pattern": "^[0-9]{5,6}$", "description": "The number of the manual."},
        "name": _or_null("string", description="Null: the map does not have it, or the model is unknown."),
        "channel": _or_null("integer", minimum=0),
        "value": _ANYTHING | {"description": "In units; null: the message has no values."},
        "unit": _or_null("string"),
        "status": _choice(*(status.value for status in Status)),
        "text": _or_null("string", description="The value in words."),
    }
)
_MEANING: _Schema = {
    "name": _or_null("string", description="The message; null: unknown, or one of `candidates`."),
    "title": _or_null("string"),
    "section": _or_null("string", description="Of the manual."),
    "syntax": _or_null("string"),
    "command": _or_null("string", description="The command or request that it answers."),
    "fields": {"type": "object", "additionalProperties": _ANYTHING, "description": "As in the vectors of spec."},
    "explained": {"type": "object", "additionalProperties": _TEXT, "description": "The fields in words, with units."},
    "readings": _list(_READING),
    "registers": _list(_REGISTER),
    "errata": _list({"type": "string", "pattern": "^E[0-9]{2,}$"}),
    "pause": {"type": "number", "description": "Seconds to leave the module alone after it."},
    "models": _list({"enum": [model.value for model in Model]}),
    "checksum": _or_null("boolean", description="Null: it fits with and without, or it is not DCON."),
    "data_formats": _list(_TEXT),
    "assumed": _list({"enum": ["type", "format", "modbus_format"]}),
}
_NOTES = {"notes": _list(_TEXT)}
_RECORD = {
    "schema_version": {"const": 1},
    "record": _NUMBER | {"description": "Records are counted from 1."},
    "line": _NUMBER | {"description": "The line, the packet of a capture file, or the frame of a stream."},
    "last_line": _NUMBER,
    "time": _or_null("string", description="As it is written in the log; of a capture file in UTC."),
    "text": _TEXT,
    "protocol": _choice("dcon", "rtu"),
    "direction": _choice(*(direction.value for direction in Direction)),
    "address": _or_null("integer", minimum=0, maximum=255),
    "frame": _or_null("string", description="The frame as people write it."),
    "wire": _or_null("string", pattern="^([0-9a-f]{2})*$"),
    "answers": _or_null("integer", description="The `record` of the command or request that it answers."),
    **_MEANING,
    **_NOTES,
    "note": _or_null("string", description="All notes in one text."),
    "contradictions": _list(_TEXT | {"description": "What does not fit what is known; a note too."}),
    "candidates": _list(_object({**_MEANING, **_NOTES})),
    "error": _or_null("string"),
    "fault": _choice(*(fault.value for fault in Fault)),
}

SCHEMA = json.dumps(
    {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A frame or line as i7000 decode --json writes it",
        **_object(_RECORD),
    },
    indent=2,
)
