"""The JSON Schemas of ``i7000 vectors``: of the messages of the protocol, and of the records of a run."""

import json
from typing import Any

from i7000 import Fault, spec
from i7000.cli.vector_records import SCHEMA_VERSION
from i7000.conformance.vector_verdicts import PROTOCOL, Reason, Verdict
from i7000.conformance.vectors import OPERATIONS, Operation

__all__ = ["protocol_schema", "report_schema"]

_Schema = dict[str, Any]
_DRAFT = "https://json-schema.org/draft/2020-12/schema"


def _object(properties: _Schema, *optional: str) -> _Schema:
    """Return the schema of an object that has all of these keys but the optional ones, and no other."""
    required = [name for name in properties if name not in optional]
    return {"type": "object", "properties": properties, "required": required, "additionalProperties": False}


def _list(items: _Schema, **more: Any) -> _Schema:  # noqa: ANN401 - of any keyword
    return {"type": "array", "items": items, **more}


def _ref(name: str) -> _Schema:
    return {"$ref": f"#/$defs/{name}"}


def _or_null(schema: _Schema) -> _Schema:
    return {"anyOf": [schema, {"type": "null"}]}


_TEXT: _Schema = {"type": "string"}
_TRUTH: _Schema = {"type": "boolean"}
_NUMBER: _Schema = {"type": "integer", "minimum": 0}
_STATUS: _Schema = {"enum": ["ok", "over_range", "under_range", "disabled"]}

# --- messages ---------------------------------------------------------------------------------------------------------

_KEYS: dict[str, _Schema] = {
    "wire": _ref("bytes") | {"description": "The whole frame, CR or CRC included."},
    "body": _ref("bytes"),
    "crc": _ref("bytes") | {"description": "The two bytes as they are sent, low byte first."},
    "rest": _ref("bytes"),
    "answered": _TRUTH,
    "text": _TEXT,
    "type_code": {"type": "string", "pattern": "^[01][0-9A-F]$"},
    "format": {"enum": ["engineering", "percent", "hex"]},
    "value": {"type": ["number", "null"]},
    "status": _STATUS,
    "units": _list({"enum": ["mV", "V", "mA", "degC"]}),
    "statuses": _or_null(_list(_STATUS)),
    "line": _TEXT,
    "items": _list(_NUMBER),
    "name": _TEXT | {"description": "The row of the map of the model."},
    "first": _NUMBER,
    "big_endian": _TRUTH,
    "values": _list({"type": ["number", "boolean", "string", "null"]}),
    "checksum": {"anyOf": [{"type": "string", "pattern": "^[0-9A-F]{2}$"}, _TRUTH]},
    "pieces": _list(_ref("bytes")) | {"description": "The stream, in pieces as they arrive."},
    "side": {"enum": ["requests", "responses", "both"]},
    "events": _list(_ref("event")),
    "flushed": _list(_ref("event")),
}
"""The keys of inputs and results; the messages of a protocol are not among them."""
_MESSAGES = {"dcon": ("command", "response"), "modbus": ("request", "response")}


def _operation(name: str, keys: tuple[str, ...]) -> _Schema:
    """Return the schema of the input or the result of an operation."""
    group = name.partition(".")[0]
    protocol = "modbus" if group == "modbus" else "dcon"
    kinds = {key: _ref(f"{protocol}_{key}") for key in _MESSAGES[protocol]}
    return _object({key: kinds.get(key) or _KEYS[key] for key in keys})


def _case(name: str, operation: Operation) -> _Schema:
    return _object(
        {
            "id": _TEXT | {"description": "The id of the vector."},
            "operation": {"const": name, "description": operation.title},
            "profile": _or_null(_ref("profile")),
            "input": _operation(name, operation.given),
        }
    )


def _definitions() -> _Schema:
    """Return what messages consist of: commands, responses and requests as the vectors have them."""
    profile: _Schema = {}
    found: _Schema = {}
    for protocol, kinds in _MESSAGES.items():
        text = spec.files().joinpath("schema", f"{protocol}_vectors.json").read_text("utf-8")
        own = json.loads(text.replace("#/$defs/", f"#/$defs/{protocol}_"))["$defs"]
        found |= {f"{protocol}_{kind}": own[kind] for kind in kinds}
        profile = profile or own["profile"] | {"description": "What is known of the module, see spec/README.md."}
        found |= {f"{protocol}_{key}": own[key] for key in ("model", "firmware", "hex") if protocol == "dcon"}
    profile["properties"]["modbus_data_format"] = {"enum": ["hex", "engineering"]}
    faults = {"enum": [fault.value for fault in Fault]}
    event = [_object({"frame": _ref("bytes")}), _object({"noise": _ref("bytes"), "fault": faults})]
    return {
        "bytes": {"type": "string", "pattern": "^([0-9a-fA-F]{2})*$", "description": "Two hex digits a byte."},
        "event": {"oneOf": event},
        "fault": faults,
        "profile": profile,
        **found,
    }


_SEQ = _NUMBER | {"description": "The number of the request; its answer has the same."}


def _requests() -> list[_Schema]:
    cases = [_case(name, operation) for name, operation in OPERATIONS.items()]
    return [
        _object({"cmd": {"const": "start"}, "seq": _SEQ, "protocol": {"const": PROTOCOL}}),
        _object({"cmd": {"const": "run"}, "seq": _SEQ, "case": {"oneOf": cases}}),
        _object({"cmd": {"const": "stop"}, "seq": _SEQ})
        | {"description": "There is no answer: the program ends, with exit code 0."},
    ]


def _answers() -> list[_Schema]:
    about = _object({key: {"type": "string", "minLength": 1} for key in ("name", "version", "language")})
    operations = _list({"enum": list(OPERATIONS)}) | {"description": "What it implements; the rest is not asked."}
    results = [_operation(name, operation.result) for name, operation in OPERATIONS.items()]
    distinct = list({json.dumps(result): result for result in results}.values())
    fault = _or_null(_ref("fault")) | {"description": "Null: there is no name for it, as for what is not encoded."}
    return [
        _object({"seq": _SEQ, "protocol": {"const": PROTOCOL}, "implementation": about, "operations": operations}),
        _object({"seq": _SEQ, "result": {"anyOf": distinct}}),
        _object({"seq": _SEQ, "error": _object({"fault": fault, "message": _TEXT}, "message")})
        | {"description": "The codec refuses the input."},
        _object({"seq": _SEQ, "skipped": _TEXT | {"description": "Why this case is not implemented."}}),
        _object({"seq": _SEQ, "crashed": _TEXT | {"description": "What failed in an unforeseen way."}}),
    ]


def protocol_schema() -> str:
    """Return the schema of a line of the protocol, in either direction."""
    definitions = _definitions()
    definitions["request"] = {"oneOf": _requests(), "description": "What the implementation reads."}
    definitions["answer"] = {"oneOf": _answers(), "description": "What the implementation writes."}
    schema = {
        "$schema": _DRAFT,
        "title": "A line of the protocol between i7000 vectors and an implementation",
        "oneOf": [_ref("request"), _ref("answer")],
        "$defs": definitions,
    }
    return json.dumps(schema, indent=2)


# --- records of a run -------------------------------------------------------------------------------------------------

_VERDICT: _Schema = {"enum": [verdict.value for verdict in Verdict]}
_REASON: _Schema = {"enum": [*(reason.value for reason in Reason), None]}
_COUNTS: _Schema = {verdict.value: _NUMBER for verdict in Verdict}
_JUDGED: _Schema = {
    "operation": {"enum": list(OPERATIONS)},
    "verdict": {"enum": [Verdict.PASS.value, Verdict.SKIP.value]},
    "reason": _REASON,
    "text": _TEXT,
}
_WRONG: _Schema = _JUDGED | {
    "verdict": {"enum": [Verdict.FAIL.value, Verdict.ERROR.value]},
    "profile": {"type": ["object", "null"]},
    "input": {"type": "object"},
    "expected": {"type": "object"},
    "answer": {"type": ["object", "null"]},
    "stderr": _TEXT | {"description": "The end of the standard error of an implementation that failed."},
}


def report_schema() -> str:
    """Return the schema of a record of a run."""
    about = {"name": _TEXT, "version": _TEXT, "language": _TEXT}
    start = {
        "record": {"const": "run-start"},
        "schema_version": {"const": SCHEMA_VERSION},
        "program": _TEXT,
        "version": _TEXT,
        "spec": {"type": "string", "pattern": "^[0-9a-f]{64}$", "description": "The SHA-256 of all files of spec."},
        "protocol": {"const": PROTOCOL},
        "time": {"type": "string", "format": "date-time"},
        "implementation": _object(about | {"operations": _list({"enum": list(OPERATIONS)})}),
        "command": _list(_TEXT),
    }
    vector = {
        "record": {"const": "vector"},
        "id": _TEXT,
        "file": _TEXT,
        "verdict": _VERDICT,
        "reason": _REASON,
        "cases": _list({"oneOf": [_object(_JUDGED), _object(_WRONG)]}, minItems=1),
    }
    by_name = {"type": "object", "additionalProperties": _object(_COUNTS)}
    end = {
        "record": {"const": "run-end"},
        "seconds": {"type": "number", "minimum": 0},
        "vectors": _object(_COUNTS | {"partial": _NUMBER}),
        "files": by_name,
        "operations": by_name,
        "restarts": _NUMBER,
        "note": _TEXT | {"description": "What was wrong with how the implementation ended."},
        "code": {"enum": [0, 1, 3, 5], "description": "The exit code."},
    }
    schema = {
        "$schema": _DRAFT,
        "title": "A record of a run of i7000 vectors",
        "description": "The first record is a run-start. The last is a run-end; without it, the run is incomplete.",
        "oneOf": [_object(start), _object(vector), _object(end)],
    }
    return json.dumps(schema, indent=2)
