"""The JSON Schema of a line of a recording."""

import json
from typing import Any

from i7000.recording.records import PROTOCOLS, SCHEMA_VERSION

__all__ = ["SCHEMA"]

_Schema = dict[str, Any]
_TEXT: _Schema = {"type": "string"}
_SECONDS: _Schema = {"type": "number", "description": "Since the start."}


def _line(record: str, properties: _Schema, *optional: str) -> _Schema:
    """Return the schema of an object that has all of these keys but the optional ones, and no other."""
    properties = {"record": {"const": record}, **properties}
    required = [name for name in properties if name not in optional]
    return {"type": "object", "properties": properties, "required": required, "additionalProperties": False}


_START = _line(
    "start",
    {
        "schema_version": {"const": SCHEMA_VERSION},
        "time": {"type": "string", "format": "date-time", "description": "Of second 0, in UTC."},
        "program": _TEXT,
        "version": _TEXT,
        "target": _TEXT | {"description": "The port or modules that were recorded."},
    },
)
_BYTES = _line(
    "bytes",
    {
        "seconds": _SECONDS,
        "from": {"enum": ["host", "module", None], "description": "Null: unknown."},
        "wire": {"type": "string", "pattern": "^([0-9a-f]{2})*$", "description": "A frame, a piece of one, or noise."},
        "protocol": {"enum": list(PROTOCOLS.values())},
        "place": _TEXT | {"description": "The connection of the host, where there are several."},
        "notes": {"type": "array", "items": _TEXT, "description": "Faults of the line, and rules that it breaks."},
    },
    "protocol",
    "place",
    "notes",
)
_EVENT = _line("event", {"seconds": _SECONDS, "text": _TEXT})
_END = _line("end", {"seconds": _SECONDS})

SCHEMA = json.dumps(
    {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A line of a recording",
        "description": "The first line is a start. The last line is an end; without it, the recording is incomplete.",
        "oneOf": [_START, _BYTES, _EVENT, _END],
    },
    indent=2,
)
