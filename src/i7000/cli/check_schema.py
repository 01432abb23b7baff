"""The JSON Schema of a line of a report: what ``i7000 check --report json=FILE`` writes."""

import json
from typing import Any

from i7000 import CharacterFormat, Model
from i7000.cli.choices import PROTOCOLS
from i7000.conformance.hazard import Hazard
from i7000.conformance.records import SCHEMA_VERSION
from i7000.conformance.statement import Level
from i7000.conformance.verdict import SkipReason, Verdict

__all__ = ["SCHEMA"]

_Schema = dict[str, Any]
_TEXT: _Schema = {"type": "string"}
_COUNT: _Schema = {"type": "integer", "minimum": 0}
_FLAG: _Schema = {"type": "boolean"}
_SECONDS: _Schema = {"type": "number"}
_WIRE: _Schema = {"type": "string", "pattern": "^([0-9a-f]{2})*$"}
_SHA256: _Schema = {"type": "string", "pattern": "^[0-9a-f]{64}$"}
_ID: _Schema = {"type": "string", "pattern": "^[a-z]+/"}
_VERDICT: _Schema = {"enum": [verdict.value for verdict in Verdict]}
_HAZARDS: _Schema = {"type": "array", "items": {"enum": [hazard.value for hazard in Hazard]}}


def _object(properties: _Schema, **optional: _Schema) -> _Schema:
    """Return the schema of an object that has all of these keys, and no other but optional ones."""
    return {
        "type": "object",
        "properties": properties | optional,
        "required": list(properties),
        "additionalProperties": False,
    }


def _list(items: _Schema, **more: Any) -> _Schema:  # noqa: ANN401 - of any keyword
    return {"type": "array", "items": items, **more}


def _or_null(schema: _Schema, description: str) -> _Schema:
    return {"anyOf": [schema, {"type": "null"}], "description": description}


_BELONGS = _or_null(_ID, "The check that it belongs to; null: none.")
_SINCE = _SECONDS | {"description": "Since the first byte."}
_LINE_SETTINGS: _Schema = {
    "baud_rate": _COUNT | {"description": "Bits per second."},
    "character_format": {"enum": [form.name for form in CharacterFormat]},
}
_MODULE = _object(
    {
        "schema_version": _COUNT | {"description": "Of the settings: those of i7000 backup."},
        "address": _COUNT | {"maximum": 255},
        **_LINE_SETTINGS,
        "checksum": _FLAG | {"description": "Of DCON."},
        "model": {"enum": [model.value for model in Model]},
        "firmware": _or_null(_TEXT, "Null: unknown."),
        "name": _or_null(_TEXT, "What the module answers."),
        "protocol": {"enum": list(PROTOCOLS)},
        "settings": {
            "type": "object",
            "additionalProperties": {"type": ["string", "number", "boolean", "array"], "items": {"type": "integer"}},
        },
        "unread": {"type": "object", "additionalProperties": _TEXT, "description": "Why a setting was not read."},
    }
)
_START = _object(
    {
        "record": {"const": "run-start"},
        "schema_version": {"const": SCHEMA_VERSION},
        "version": _TEXT | {"description": "Of i7000."},
        "spec_sha256": _SHA256 | {"description": "Of the files of spec: names, sizes and contents."},
        "manual": _TEXT | {"description": "The revision of the manual."},
        "time": _TEXT | {"description": "The beginning, ISO 8601 in UTC."},
        "target": _TEXT,
        "given_model": _or_null(_TEXT, "The model, if --model says it."),
        "statement": _or_null(_TEXT, "The file of --statement."),
        "echo": _FLAG | {"description": "Whether the adapter echoes what is sent."},
        "strict": _FLAG | {"description": "Whether WARN fails."},
        "seed": {"type": "integer"},
        "timeout_scale": {"type": "number", "exclusiveMinimum": 0},
        "eeprom_writes": _COUNT | {"description": "The most frames that may change the EEPROM."},
        "max_seconds": _or_null(_SECONDS, "No check is begun after this time; null: no limit."),
        "allowed": _HAZARDS,
        "selection": _list(_TEXT, description="What the user selected; empty: everything."),
        "checks": _COUNT | {"description": "The number of checks that follow in a complete report."},
        "module": _MODULE | {"description": "The module before the run."},
    }
)
_WIRED = _object(
    {
        "record": {"const": "wire"},
        "check": _BELONGS,
        "seconds": _SINCE,
        "from": {"enum": ["host", "module"]},
        "wire": _WIRE,
    }
)
_LINE = _object(
    {
        "record": {"const": "line", "description": "The host takes other line settings."},
        "check": _BELONGS,
        "seconds": _SINCE,
        **_LINE_SETTINGS,
    }
)
_POWER = _object(
    {
        "record": {"const": "power", "description": "The power of the module is switched off and on."},
        "check": _BELONGS,
        "seconds": _SINCE,
        "init_switch": _FLAG | {"description": "Whether the INIT switch is set then."},
    }
)
_CHECK = _object(
    {
        "record": {"const": "check"},
        "id": _ID,
        "verdict": _VERDICT,
        "seconds": _SECONDS,
        "title": _TEXT,
        "requirement": _TEXT,
        "sections": _list(_TEXT, description="Of the manual."),
        "level": {"enum": [level.value for level in Level]},
        "hazards": _HAZARDS,
        "errata": _list({"type": "string", "pattern": "^E[0-9]{2,}$"}),
    },
    reason={"enum": [reason.value for reason in SkipReason], "description": "Only of SKIP."},
    text=_TEXT | {"description": "Why, in words."},
    expected=_TEXT | {"description": "What was allowed, in words."},
    sent=_WIRE,
    received=_WIRE,
    wrote=_WIRE | {"description": "The write before that, if settings may have been changed."},
    answered=_WIRE | {"description": "The answer to the write."},
    right=_WIRE | {"description": "The only bytes that were allowed, if there are such."},
    repeats=_list(_VERDICT, description="The verdicts of the repetitions."),
    writes=_COUNT | {"description": "The frames that may have changed the EEPROM."},
    known={"const": True, "description": "Only of a failure that the baseline has."},
)
_END = _object(
    {
        "record": {"const": "run-end"},
        "complete": _FLAG,
        "counts": {"type": "object", "propertyNames": _VERDICT, "additionalProperties": _COUNT},
        "writes": _COUNT,
        "restored": _list(_TEXT, description="The settings that had to be restored outside of checks."),
        "left_changed": _or_null(_list(_TEXT), "The settings that differ from before; null: unknown."),
        "silent": _or_null(_FLAG, "Whether the module does not answer any more; null: unknown."),
        "exit_code": _COUNT,
        "digest": _SHA256 | {"description": "Of all lines, each with a line feed, and of this one without its digest."},
    }
)

SCHEMA = json.dumps(
    {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A line of a report of i7000 check",
        "description": "The first line is a run-start. The last is a run-end; without it, the report is incomplete.",
        "oneOf": [_START, _WIRED, _LINE, _POWER, _CHECK, _END],
    },
    indent=2,
)
