"""The JSON Schema of a line of what ``i7000 listen --judge --json`` writes."""

import json
from typing import Any

from i7000.conformance.judge import Level, Rule, Side

__all__ = ["SCHEMA", "SCHEMA_VERSION"]

SCHEMA_VERSION = 1
"""The version of the format. It changes when a reader of the old one would misread the new one."""

_Schema = dict[str, Any]
_TEXT: _Schema = {"type": "string"}
_COUNT: _Schema = {"type": "integer", "minimum": 0}
_ADDRESS: _Schema = {"type": ["integer", "null"], "minimum": 0, "maximum": 255}
_ID: _Schema = {"enum": [rule.id for rule in Rule]}
_SIDE: _Schema = {"enum": list(Side)}
_LEVEL: _Schema = {"enum": [level.value for level in Level]}


def _object(properties: _Schema) -> _Schema:
    """Return the schema of an object that has all of these keys, and no other."""
    return {"type": "object", "properties": properties, "required": list(properties), "additionalProperties": False}


def _list(items: _Schema, **more: Any) -> _Schema:  # noqa: ANN401 - of any keyword
    return {"type": "array", "items": items, **more}


_START = _object(
    {
        "record": {"const": "run-start"},
        "schema_version": {"const": SCHEMA_VERSION},
        "program": {"const": "i7000 listen --judge"},
        "version": _TEXT | {"description": "The version of i7000."},
        "spec_sha256": _TEXT | {"pattern": "^[0-9a-f]{64}$", "description": "Of the files of spec, in order of names."},
        "target": _TEXT,
        "timeout": {"type": "number", "description": "Seconds in which an answer has to begin."},
    }
)
_FINDING = _object(
    {
        "record": {"const": "finding"},
        "id": _ID,
        "side": _SIDE,
        "address": _ADDRESS | {"description": "Null: of all modules, or unknown."},
        "level": _LEVEL,
        "sections": _list(_TEXT, description="Of the manual."),
        "errata": _list({"type": "string", "pattern": "^E[0-9]{2,}$"}),
        "requirement": _TEXT | {"description": "The rule."},
        "what": _TEXT | {"description": "How the frame breaks it."},
        "number": _COUNT | {"description": "The number of the frame, from 1."},
        "line": _COUNT | {"description": "The line of a file, the packet of a capture file, or the frame of a stream."},
        "time": {"type": ["string", "null"], "description": "As in a log, or in UTC; null: unknown."},
        "protocol": {"enum": ["dcon", "rtu"]},
        "frame": _TEXT | {"description": "The frame as people write it."},
        "wire": {"type": "string", "pattern": "^([0-9a-f]{2})*$"},
    }
)
_BROKEN = _object({"id": _ID, "level": _LEVEL, "count": _COUNT})
_END = _object(
    {
        "record": {"const": "run-end"},
        "verdict": {"enum": ["kept", "broken", "nothing"], "description": "Nothing: there was nothing to judge."},
        "frames": _COUNT | {"description": "Frames that were judged."},
        "sides": _list(_object({"side": _SIDE, "address": _ADDRESS, "frames": _COUNT, "findings": _list(_BROKEN)})),
        "untimed": _list(
            _object({"id": _ID, "count": _COUNT}), description="Not judged, because the times cannot tell."
        ),
        "withdrawn": _COUNT | {"description": "Findings that do not count: what came later has explained them."},
        "unjudged": _COUNT | {"description": "Noise, and answers before the first command."},
        "damaged": _COUNT | {"description": "Places of the file that cannot be read."},
        "exit_code": _COUNT,
    }
)

SCHEMA = json.dumps(
    {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A line of what i7000 listen --judge --json writes",
        "description": "The first line is a run-start. The last is a run-end; without it, the judgement is incomplete.",
        "oneOf": [_START, _FINDING, _END],
    },
    indent=2,
)
