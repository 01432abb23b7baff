"""The vectors of ``spec/vectors`` as cases: what a codec is given, and what it has to answer.

A vector makes one case for each function of a codec that it shows. The functions, here called operations, and what each
has to do with a vector are those of ``spec/runner.md``.

Laws: every vector of a known file makes at least one case. A case has no object of this package in it, only what JSON
can express.
"""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from fnmatch import fnmatchcase
from typing import Any

from attrs import field

from i7000.frozen import frozen

__all__ = ["OPERATIONS", "Case", "Expected", "Operation", "Record", "Vector", "selected", "vectors_of"]

Record = Mapping[str, Any]
"""An object of JSON."""


@frozen
class Operation:
    """One function of a codec: the keys of what it is given, and of its result."""

    title: str
    given: tuple[str, ...]
    result: tuple[str, ...]


OPERATIONS = {
    "dcon.encode_command": Operation("Encode a command as a frame", ("command",), ("wire",)),
    "dcon.decode_command": Operation("Decode the frame of a command", ("wire",), ("command",)),
    "dcon.encode_response": Operation("Encode a response as a frame", ("response",), ("wire",)),
    "dcon.decode_response": Operation("Decode the response to a command", ("wire", "command"), ("response",)),
    "dcon.is_answered": Operation("Return whether a module answers a command", ("command",), ("answered",)),
    "modbus.encode_request": Operation("Encode a request as a frame", ("request",), ("wire",)),
    "modbus.decode_request": Operation("Decode the frame of a request", ("wire",), ("request",)),
    "modbus.encode_response": Operation("Encode a response as a frame", ("response",), ("wire",)),
    "modbus.decode_response": Operation("Decode the response to a request", ("wire", "request"), ("response",)),
    "modbus.is_answered": Operation("Return whether a module answers a request", ("request",), ("answered",)),
    "readings.read": Operation("Read one channel's field", ("text", "type_code", "format"), ("value", "status")),
    "readings.read_leniently": Operation(
        "Read one channel's field, also beyond the range of its type (E121)",
        ("text", "type_code", "format"),
        ("value", "status"),
    ),
    "readings.write": Operation("Write one channel's field", ("value", "status", "type_code", "format"), ("text",)),
    "readings.read_response": Operation(
        "Read all fields of a response", ("response", "command"), ("values", "units", "statuses")
    ),
    "readings.split_line": Operation("Split a line of old I-7018 firmware into fields", ("line",), ("values",)),
    "registers.read_items": Operation(
        "Read registers or bits as values", ("items", "name", "first", "big_endian"), ("values", "statuses")
    ),
    "registers.write_values": Operation(
        "Write values as registers or bits", ("values", "statuses", "name", "first", "big_endian"), ("items",)
    ),
    "frames.checksum": Operation("Compute the checksum of a DCON body", ("body",), ("checksum",)),
    "frames.crc": Operation("Compute the CRC of a Modbus body", ("body",), ("crc",)),
    "frames.split": Operation("Split a stream into DCON frames", ("pieces", "checksum"), ("events", "rest")),
    "frames.rtu_split": Operation(
        "Split a stream into Modbus frames, and flush the rest", ("pieces", "side"), ("events", "rest", "flushed")
    ),
}
"""The operations by their names, which begin with the folder of their vectors."""


@frozen
class Expected:
    """What a codec has to answer."""

    result: Record | None
    """The result; None if only an error is right."""
    fault: str | None = None
    """The fault of the error; None: any."""
    may_fail: bool = field(default=False, kw_only=True)
    """Whether an error is right in place of the result."""
    partial: bool = field(default=False, kw_only=True)
    """Whether the result may have more keys."""

    @property
    def record(self) -> Record:
        """The same as JSON, for people."""
        if self.result is None:
            return {"error": {"fault": self.fault}}
        return {"result": self.result} | ({"or": "an error"} if self.may_fail else {})


@frozen
class Case:
    """One call of an operation."""

    id: str
    """The id of its vector."""
    operation: str
    profile: Record | None
    given: Record
    """The input."""
    expected: Expected

    @property
    def record(self) -> Record:
        """What the implementation is given."""
        return {"id": self.id, "operation": self.operation, "profile": self.profile, "input": self.given}


@frozen
class Vector:
    """A vector with its cases."""

    id: str
    file: str
    """Its file under ``spec/vectors/``."""
    comment: str
    cases: tuple[Case, ...]


_Call = tuple[str, Record, Expected]
"""An operation, its input, and what is expected of it."""


def vectors_of(file: str, data: Record) -> tuple[Vector, ...]:
    """Return the vectors of a file under ``spec/vectors/``, with their cases.

    Errors: `ValueError` for a file whose operations are unknown.
    """
    folder, _, name = file.partition("/")
    calls = _FILES.get(file) or _FOLDERS.get(folder)
    if not calls or not name:
        raise ValueError(f"{file}: the operations of its vectors are unknown")
    return tuple(
        Vector(
            vector["id"],
            file,
            vector["comment"],
            tuple(
                Case(vector["id"], f"{folder}.{operation}", vector.get("profile"), given, expected)
                for operation, given, expected in calls(vector)
            ),
        )
        for vector in data["vectors"]
    )


_MAY_FAIL = "host-may-refuse"


def _exchange(asked: str) -> Callable[[Record], Iterator[_Call]]:
    """Return how the vectors of a protocol make cases; `asked` is what a host sends in it."""

    def calls(vector: Record) -> Iterator[_Call]:
        question, response, outcome = vector[asked], vector["response"], vector["outcome"]
        sent = {"wire": vector[f"{asked}_wire"]}
        came = {"wire": vector["response_wire"]}
        is_reject = outcome == "reject"
        if question is not None:
            if "host-refuses" in vector["flags"]:
                yield f"encode_{asked}", {asked: question}, Expected(None)
            elif asked not in _unwritten(vector, asked):
                may_fail = _MAY_FAIL in vector["flags"]
                yield f"encode_{asked}", {asked: question}, Expected(sent, may_fail=may_fail)
            if not is_reject or vector["response_wire"] is not None:
                yield f"decode_{asked}", sent, Expected({asked: question})
                yield "is_answered", {asked: question}, Expected({"answered": outcome != "silence"})
        if response is not None:
            if "response" not in _unwritten(vector, asked):
                yield "encode_response", {"response": response}, Expected(came)
            yield "decode_response", came | {asked: question}, Expected({"response": response})
        if is_reject and vector["response_wire"] is None:
            yield f"decode_{asked}", sent, Expected(None, vector["fault"])
        elif is_reject:
            yield "decode_response", came | {asked: question}, Expected(None, vector["fault"])

    return calls


def _unwritten(vector: Record, asked: str) -> tuple[str, ...]:
    """Return which messages of a vector an encoder writes with other bytes."""
    if "decode-only" not in vector["flags"]:
        return ()
    if asked == "command":
        return ("command", "response")
    return ("request",) if vector["request"]["type"] == "WriteMultipleCoils" else ("response",)


def _reading(vector: Record) -> Iterator[_Call]:
    type_code = {"type_code": vector["type_code"], "format": vector["format"]}
    field = {"text": vector["text"]}
    reading = {"value": vector["value"], "status": vector["status"]}
    if vector["direction"] != "encode":
        if "lenient" in vector["flags"]:
            yield "read", field | type_code, Expected(None, "number")
            yield "read_leniently", field | type_code, Expected(reading)
        else:
            yield "read", field | type_code, Expected(reading)
    if vector["direction"] != "decode":
        yield "write", reading | type_code, Expected(field)


def _rejected_field(vector: Record) -> Iterator[_Call]:
    given = {key: vector[key] for key in OPERATIONS["readings.read"].given}
    yield "read", given, Expected(None, vector["fault"])


def _channels(vector: Record) -> Iterator[_Call]:
    operation = OPERATIONS["readings.read_response"]
    given = {key: vector[key] for key in operation.given}
    yield "read_response", given, Expected({key: vector[key] for key in operation.result})


def _legacy_line(vector: Record) -> Iterator[_Call]:
    yield "split_line", {"line": vector["line"]}, Expected({"values": vector["values"]})
    profile = vector["profile"]
    for text, code, status in zip(vector["values"], profile["type_codes"], vector["statuses"], strict=True):
        given = {"text": text, "type_code": f"{code:02X}", "format": profile["data_format"]}
        yield "read_leniently", given, Expected({"status": status}, partial=True)


def _items(vector: Record) -> Iterator[_Call]:
    place = {key: vector[key] for key in ("name", "first", "big_endian")}
    items = {"items": vector["items"]}
    values = {"values": vector["values"], "statuses": vector["statuses"]}
    if vector["fault"] is not None:
        yield "read_items", items | place, Expected(None, vector["fault"])
        return
    wanted = values if vector["statuses"] is not None else {"values": vector["values"]}
    yield "read_items", items | place, Expected(wanted, partial=vector["statuses"] is None)
    if vector["direction"] == "both":
        yield "write_values", values | place, Expected(items)


def _checksum(vector: Record) -> Iterator[_Call]:
    yield "checksum", {"body": vector["body"]}, Expected({"checksum": vector["checksum"]})


def _crc(vector: Record) -> Iterator[_Call]:
    yield "crc", {"body": vector["body"]}, Expected({"crc": vector["crc"]})


def _stream(operation: str) -> Callable[[Record], Iterator[_Call]]:
    """Return how vectors of streams make cases: the stream at once, and byte by byte."""
    keys = OPERATIONS[f"frames.{operation}"]

    def calls(vector: Record) -> Iterator[_Call]:
        stream = vector["stream"]
        given = {key: vector[key] for key in keys.given if key != "pieces"}
        wanted = Expected({key: vector[key] for key in keys.result})
        yield operation, {"pieces": [stream]} | given, wanted
        yield operation, {"pieces": [stream[at : at + 2] for at in range(0, len(stream), 2)]} | given, wanted

    return calls


_FOLDERS = {
    "dcon": _exchange("command"),
    "modbus": _exchange("request"),
    "readings": _reading,
    "registers": _items,
}
_FILES = {
    "readings/rejected.json": _rejected_field,
    "readings/channels.json": _channels,
    "readings/legacy.json": _legacy_line,
    "frames/checksums.json": _checksum,
    "frames/crc.json": _crc,
    "frames/split.json": _stream("split"),
    "frames/rtu_split.json": _stream("rtu_split"),
}

# --- selection --------------------------------------------------------------------------------------------------------


def selected(vectors: Sequence[Vector], name: str) -> dict[str, frozenset[str]]:
    """Return the operations that a name selects of each vector, by id; empty for an unknown name.

    Shape: the first of these that there is: an id; an operation; a file, with or without its ending; a folder; a file
        without its folder; a glob of ids, operations or files (``dcon-2.1?-*``); the beginning of ids.
    """
    for matches in _ways(name):
        found = {
            vector.id: frozenset(case.operation for case in vector.cases if matches(vector, case.operation))
            for vector in vectors
        }
        if any(found.values()):
            return {key: operations for key, operations in found.items() if operations}
    return {}


def _ways(name: str) -> Iterator[Callable[[Vector, str], bool]]:
    """Yield the ways in which a name can select an operation of a vector, the narrowest first."""
    file = name if name.endswith(".json") else f"{name}.json"
    yield lambda vector, _: vector.id == name
    yield lambda _, operation: operation == name
    yield lambda vector, _: vector.file == file
    yield lambda vector, _: vector.file.startswith(f"{name}/")
    yield lambda vector, _: vector.file.endswith(f"/{file}")
    if re.search(r"[*?\[]", name):
        yield lambda vector, operation: any(fnmatchcase(it, name) for it in (vector.id, operation, vector.file))
    yield lambda vector, _: vector.id.startswith(name)
