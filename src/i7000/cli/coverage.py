"""``i7000 coverage``: what a driver has met in a recorded run."""

import json as json_module
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Annotated, Any, Literal

from cyclopts import Parameter

from i7000.cli.options import PROTOCOLS, UNKNOWN, Json, Module
from i7000.cli.readers import Missing, of_recording
from i7000.cli.source import Counted, Lines
from i7000.cli.text import Line, Printer
from i7000.cli.words import UsageError
from i7000.conformance.coverage import Coverage, Kind, Row, Seen, cover
from i7000.dissect import Heard, Knowledge
from i7000.recording import Carried, is_recording, read
from i7000.settings import Protocol

__all__ = ["SCHEMA", "coverage"]

SCHEMA_VERSION = 1
_NOTHING = 5
"""The exit code for a recording without a command."""
_GROUPS = ("commands", "functions", "sub-functions")


def coverage(
    recording: Annotated[Path | None, Parameter(help="A recording of --record. Example: run.jsonl.")] = None,
    /,
    *,
    protocol: Annotated[
        Literal["auto", "dcon", "rtu"], Parameter(help="The protocol on the line; auto recognizes both, even mixed.")
    ] = "auto",
    json: Json = False,
    schema: Annotated[bool, Parameter(help="Print the JSON Schema of --json and exit.", negative="")] = False,
    module: Module = UNKNOWN,
) -> int:
    """Show what a driver has met in a recorded run, and what it has never met.

    Record a run by `i7000 simulate --record run.jsonl`, `i7000 proxy --record` or `i7000 listen --record`. The result
    names the commands, functions and sub-functions that the driver sent, and the kinds of answers that it got: refused,
    late, damaged, over range and others, by the traffic and by the faults that are noted in the recording.

    Without `--model`, all commands count; with it, those that the model has. `i7000 provoke` plays what was never met.

    Example: `i7000 coverage run.jsonl --model M-7019R`

    Exit code: 0 if the recording is whole; 1 if it is damaged or has no end; 2 for wrong usage and for what is not a
    recording; 5 if it has no command.
    """
    if schema:
        sys.stdout.write(f"{SCHEMA}\n")
        return 0
    if recording is None:
        raise UsageError("give a recording, such as i7000 coverage run.jsonl")
    printer = Printer(json=json)
    reading = _Reading(recording, module.knowledge(protocol), PROTOCOLS[protocol])
    models = {known.model for known in _given(module, protocol) if known.model is not None}
    found = cover(reading.seen(), sorted(models, key=lambda it: it.value))
    printer.record(_record(found), _lines(found))
    if reading.damaged.count:
        printer.error(f"{reading.damaged.count} lines are damaged or missing: line {reading.damaged}")
        return 1
    if not any(row.asked for row in found.rows) and not found.ambiguous:
        printer.error("the recording has no command")
        return _NOTHING
    return 0


def _given(module: Module, protocol: str) -> Iterable[Any]:
    knowledge = module.knowledge(protocol)
    return [knowledge.others.given, *(it.given for it in knowledge.modules.values())]


class _Reading:
    """A recording that is read once."""

    def __init__(self, path: Path, knowledge: Knowledge, protocol: Protocol | None) -> None:
        self._path, self._knowledge, self._protocol = path, knowledge, protocol
        self._carried: dict[int, Carried] = {}
        """The bytes of which the frames are not yielded yet, by line."""
        self._last = Carried(0.0, b"")
        """The bytes in which the last frame was."""
        self.damaged = Counted()

    def seen(self) -> Iterator[Seen]:
        """Yield what was on the line.

        Errors: `OSError`; `UsageError` for what is not a recording.
        """
        with self._path.open("rb") as stream:
            beginning = stream.peek(32)
            if not beginning:
                return
            if not is_recording(beginning):
                raise UsageError(
                    f"{self._path} is not a recording: record one with --record; see i7000 coverage --help"
                )
            lines = ((number, line.decode("utf-8", "replace")) for number, line in Lines(stream, lambda: None))
            for one in of_recording(self._noted(lines), self._knowledge, self._protocol):
                if one.missing is Missing.DAMAGE:
                    self.damaged.add(one.line)
                yield from self._before(one.line)
                if one.heard is not None:
                    yield self._seen(one.heard, one.line)
            yield from self._before(None)

    def _seen(self, heard: Heard, line: int) -> Seen:
        """Return a frame with the notes of its line, unless another frame of that line had them."""
        carried = self._carried.pop(line, None)
        if carried is None:
            return Seen(heard, (), self._last.sent, self._last.seconds)
        self._last = carried
        return Seen(heard, carried.notes, carried.sent, carried.seconds)

    def _noted(self, lines: Iterable[tuple[int, str]]) -> Iterator[tuple[int, str]]:
        """Yield lines, and keep what each of them carries."""
        for number, text in lines:
            record = read(text)
            if isinstance(record, Carried):
                self._carried[number] = record
            yield number, text

    def _before(self, line: int | None) -> Iterator[Seen]:
        """Yield the bytes of earlier lines in which no frame ends: their notes count."""
        for number in [it for it in self._carried if line is None or it < line]:
            carried = self._carried.pop(number)
            yield Seen(None, carried.notes, carried.sent, carried.seconds)


# --- what is printed --------------------------------------------------------------------------------------------------


def _lines(found: Coverage) -> Iterator[Line]:
    counts = []
    for name in _GROUPS:
        rows = found.group(name)
        if rows:
            counts.append(f"{sum(row.asked > 0 for row in rows)} of {len(rows)} {name}")
    refused = sum(row.refused > 0 for row in found.rows)
    yield [(f"{', '.join(counts)}; {refused} of them were refused", "bold")]
    yield [("never met: ", ""), (", ".join(found.never) or "nothing", "yellow")]
    met = ", ".join(f"{kind} {found.kinds[kind]}" for kind in Kind if found.kinds.get(kind))
    codes = ", ".join(f"{code:02X} {count}" for code, count in found.exceptions.items())
    for name, words in (
        ("met", met),
        ("exceptions", codes),
        ("errata", ", ".join(f"{name} {count}" for name, count in found.errata.items())),
        ("not asked", " ".join(row.key for row in found.rows if not row.asked)),
        ("several meanings", str(found.ambiguous or "")),
        ("not understood, or of other models", str(found.others or "")),
    ):
        if words:
            yield [(f"{name}: ", ""), (words, "")]
    for row in found.rows:
        if row.asked:
            yield _row_line(row)


def _row_line(row: Row) -> Line:
    counts = [("answered", row.answered), ("refused", row.refused), ("silent", row.silent)]
    words = ", ".join(f"{count} {name}" for name, count in counts if count)
    return [
        (f"{row.key:<6} ", ""),
        (f"{row.syntax:<24} ", "bold"),
        (f"{row.kind.__name__:<28} ", "cyan"),
        (f"{row.asked} asked{': ' if words else ''}{words}", ""),
    ]


def _record(found: Coverage) -> dict[str, Any]:
    return {
        "schema_version": SCHEMA_VERSION,
        "record": "coverage",
        "commands": [
            {
                "protocol": "dcon" if row.protocol is Protocol.DCON else "rtu",
                "section": row.kind.section,
                "key": row.key,
                "name": row.kind.__name__,
                "syntax": row.syntax,
                "asked": row.asked,
                "answered": row.answered,
                "refused": row.refused,
                "silent": row.silent,
            }
            for row in found.rows
        ],
        "kinds": {kind.value: found.kinds.get(kind, 0) for kind in Kind},
        "exceptions": {f"{code:02X}": count for code, count in found.exceptions.items()},
        "errata": dict(found.errata),
        "ambiguous": found.ambiguous,
        "others": found.others,
    }


_COUNT = {"type": "integer", "minimum": 0}
_TEXT = {"type": "string"}


def _object(properties: dict[str, Any]) -> dict[str, Any]:
    """Return the schema of an object that has all of these keys, and no other."""
    return {"type": "object", "properties": properties, "required": list(properties), "additionalProperties": False}


def _counts(pattern: str) -> dict[str, Any]:
    return {"type": "object", "patternProperties": {pattern: _COUNT}, "additionalProperties": False}


SCHEMA = json_module.dumps(
    {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "What i7000 coverage --json writes",
        **_object(
            {
                "schema_version": {"const": SCHEMA_VERSION},
                "record": {"const": "coverage"},
                "commands": {
                    "type": "array",
                    "items": _object(
                        {
                            "protocol": {"enum": ["dcon", "rtu"]},
                            "section": _TEXT,
                            "key": {"type": "string", "description": "The section, or the function and sub-function."},
                            "name": _TEXT,
                            "syntax": _TEXT,
                            "asked": _COUNT,
                            "answered": _COUNT,
                            "refused": _COUNT,
                            "silent": _COUNT,
                        }
                    ),
                },
                "kinds": _object({kind.value: _COUNT for kind in Kind}),
                "exceptions": _counts("^[0-9A-F]{2}$"),
                "errata": _counts("^E[0-9]{2,}$"),
                "ambiguous": {**_COUNT, "description": "Commands of which several meanings are possible."},
                "others": {**_COUNT, "description": "Commands of other models, and those that cannot be decoded."},
            }
        ),
    },
    indent=2,
)
