"""The results of provoked drivers: as lines for people, and as records of a file."""

import json
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import IO, Any, Self

from attrs import frozen

from i7000 import __version__
from i7000.cli.text import Line
from i7000.cli.traffic import lines as traffic_lines
from i7000.conformance.provoked import Finding, Judgement, Kind, Verdict
from i7000.conformance.scenarios import Scenario
from i7000.errors import Noise
from i7000.simulator.observed import Observed

__all__ = ["SCHEMA", "Report", "Result", "result_lines", "summary"]

SCHEMA_VERSION = 1
_STYLES = {Verdict.PASS: "green", Verdict.FAIL: "red", Verdict.ERROR: "red", Verdict.INCONCLUSIVE: "yellow"}
_AROUND = 1
"""The exchanges that are shown before and after that of a finding."""


@frozen
class Result:
    """The result of a scenario, and the traffic that it was found in."""

    scenario: Scenario
    judgement: Judgement
    seconds: float = 0.0
    exchanges: tuple[Observed, ...] = ()
    complaints: str = ""
    """The end of the error output of the driver."""

    def around(self, finding: Finding) -> tuple[Observed, ...]:
        """Return the exchanges around that of a finding."""
        if finding.event is None:
            return ()
        return self.exchanges[max(0, finding.event - _AROUND) : finding.event + _AROUND + 1]


# --- for people -------------------------------------------------------------------------------------------------------


def result_lines(result: Result, again: str) -> Iterator[Line]:
    """Yield the lines of a result; `again` is the command that plays its scenario again."""
    scenario, judgement = result.scenario, result.judgement
    verdict = judgement.verdict
    line: Line = [(f"{verdict.value:<13}", _STYLES.get(verdict, "dim")), (f"{scenario.name:<19} ", "bold")]
    if verdict is Verdict.SKIP:
        yield [*line, (f"not applicable: {judgement.reason}", "dim")]
        return
    yield [*line, (f"{scenario.title}; {judgement.values} right values in {result.seconds:.1f} s", "")]
    if judgement.reason:
        yield [(f"  {judgement.reason}", "yellow")]
    shown = list({it.kind: it for it in reversed(judgement.findings)}.values())[::-1]
    for finding in shown:
        where = "" if finding.line is None else f", line {finding.line} of its output"
        yield [(f"  {finding.kind.value}", "red"), (f" at {finding.at:.3f} s{where}: {finding.text}", "")]
        for observed in result.around(finding):
            yield from _exchange_lines(observed)
    if len(judgement.findings) > len(shown):
        yield [(f"  and {len(judgement.findings) - len(shown)} more", "")]
    if verdict in (Verdict.FAIL, Verdict.ERROR):
        yield from _advice(result, again)


def _exchange_lines(observed: Observed) -> Iterator[Line]:
    for text in traffic_lines(observed):
        yield [(f"    {text.plain}", "")]
    if observed.answer is not None and _arrived(observed) != observed.answer:
        pieces = [f"{piece.wire!r} at {observed.at + piece.after:.3f} s" for piece in observed.pieces]
        yield [(f"    {'':>10}  arrives: {', then '.join(pieces) or 'nothing'}", "magenta")]


def _arrived(observed: Observed) -> bytes:
    return b"".join(piece.wire for piece in observed.pieces)


def _advice(result: Result, again: str) -> Iterator[Line]:
    scenario = result.scenario
    if result.complaints and any(it.kind in (Kind.ENDED, Kind.DEADLOCK) for it in result.judgement.findings):
        *_, last = result.complaints.strip().splitlines() or [""]
        yield [(f"  its last words: {last}", "")]
    yield [(f"  a right driver: {scenario.right} (manual {', '.join(scenario.sections)})", "")]
    yield [(f"  again: {again}", "dim")]


def summary(results: Sequence[Result]) -> Iterator[Line]:
    """Yield the line at the end: how many of each verdict."""
    counted = Counter(it.judgement.verdict for it in results)
    words = ", ".join(f"{counted[verdict]} {verdict.value}" for verdict in Verdict if counted[verdict])
    yield [(f"{words or 'nothing ran'}", "bold")]


# --- for programs -----------------------------------------------------------------------------------------------------


class Report:
    """A report as JSON lines; one without its last line is incomplete."""

    def __init__(self, path: Path | None) -> None:
        """Create the file; without a path, nothing is written.

        Errors: `OSError`.
        """
        self._file: IO[str] | None = None if path is None else path.open("w", encoding="utf-8")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        if self._file is not None:
            self._file.close()

    def start(self, **facts: Any) -> None:  # noqa: ANN401 - of any kind
        """Write the first record: what is run."""
        self._write({"record": "run-start", "schema_version": SCHEMA_VERSION, "version": __version__, **facts})

    def scenario(self, result: Result) -> None:
        """Write the record of a scenario."""
        scenario, judgement = result.scenario, result.judgement
        self._write(
            {
                "record": "scenario",
                "name": scenario.name,
                "title": scenario.title,
                "sections": list(scenario.sections),
                "verdict": judgement.verdict.value,
                "reason": judgement.reason or None,
                "seconds": round(result.seconds, 3),
                "values": judgement.values,
                "findings": [_finding(result, it) for it in judgement.findings],
            }
        )

    def end(self, results: Sequence[Result], code: int) -> None:
        """Write the last record."""
        counted = Counter(it.judgement.verdict for it in results)
        verdicts = {verdict.value: counted[verdict] for verdict in Verdict}
        self._write({"record": "run-end", "verdicts": verdicts, "exit_code": code})

    def _write(self, record: dict[str, Any]) -> None:
        if self._file is not None:
            self._file.write(f"{json.dumps(record)}\n")
            self._file.flush()


def _finding(result: Result, finding: Finding) -> dict[str, Any]:
    return {
        "kind": finding.kind.value,
        "at": round(finding.at, 3),
        "text": finding.text,
        "line": finding.line,
        "traffic": [_exchange(observed) for observed in result.around(finding)],
    }


def _exchange(observed: Observed) -> dict[str, Any]:
    heard = observed.heard
    return {
        "at": round(observed.at, 3),
        "request": (heard.wire if isinstance(heard, Noise) else heard).hex(),
        "answer": None if observed.answer is None else observed.answer.hex(),
        "arrived": [{"after": round(it.after, 3), "wire": it.wire.hex()} for it in observed.pieces],
        "faults": list(observed.faults),
    }


_Schema = dict[str, Any]


def _object(properties: _Schema) -> _Schema:
    """Return the schema of an object that has all of these keys, and no other."""
    return {"type": "object", "properties": properties, "required": list(properties), "additionalProperties": False}


def _list(items: _Schema) -> _Schema:
    return {"type": "array", "items": items}


_TEXT: _Schema = {"type": "string"}
_NUMBER: _Schema = {"type": "number"}
_COUNT: _Schema = {"type": "integer", "minimum": 0}
_WIRE: _Schema = {"type": "string", "pattern": "^([0-9a-f]{2})*$"}
_EXCHANGE = _object(
    {
        "at": _NUMBER,
        "request": _WIRE,
        "answer": {"anyOf": [_WIRE, {"type": "null"}], "description": "As the module sent it."},
        "arrived": _list(_object({"after": _NUMBER, "wire": _WIRE})),
        "faults": _list(_TEXT),
    }
)
_FINDING = _object(
    {
        "kind": {"enum": [kind.value for kind in Kind]},
        "at": _NUMBER,
        "text": _TEXT,
        "line": {"type": ["integer", "null"], "description": "The line of the driver's output."},
        "traffic": _list(_EXCHANGE),
    }
)
_RECORDS = [
    _object(
        {
            "record": {"const": "run-start"},
            "schema_version": {"const": SCHEMA_VERSION},
            "version": _TEXT,
            "spec": {"type": "string", "description": "SHA-256 of the files of spec, each with its name."},
            "seed": {"type": "integer"},
            "modules": _list(_TEXT),
            "command": _list(_TEXT),
            "scenarios": _list(_TEXT),
        }
    ),
    _object(
        {
            "record": {"const": "scenario"},
            "name": _TEXT,
            "title": _TEXT,
            "sections": _list(_TEXT),
            "verdict": {"enum": [verdict.value for verdict in Verdict]},
            "reason": {"type": ["string", "null"]},
            "seconds": _NUMBER,
            "values": _COUNT,
            "findings": _list(_FINDING),
        }
    ),
    _object(
        {
            "record": {"const": "run-end"},
            "verdicts": _object({verdict.value: _COUNT for verdict in Verdict}),
            "exit_code": {"type": "integer"},
        }
    ),
]
SCHEMA = json.dumps(
    {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A line of a report of i7000 provoke",
        "description": "The last line is a run-end; without it, the report is incomplete.",
        "oneOf": _RECORDS,
    },
    indent=2,
)
