"""The lines of a report: JSON objects from ``run-start`` to ``run-end``, with everything that a run was about.

Laws: a report without its last line is incomplete, and says so wherever it is shown. The last line ends with the
SHA-256 of all lines, itself without that digest included. Two runs that do the same differ in their times only.
"""

import json
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from hashlib import sha256
from typing import Any

from i7000.conformance.hazard import Hazard
from i7000.conformance.run import CheckResult, Options, Run
from i7000.conformance.settle import Settled
from i7000.conformance.verdict import Verdict
from i7000.host.procedures import Snapshot
from i7000.settings import BaudRate, LineSettings

__all__ = [
    "MANUAL",
    "SCHEMA_VERSION",
    "Digest",
    "as_line",
    "check_record",
    "end_record",
    "line_record",
    "power_record",
    "start_record",
    "wire_record",
]

SCHEMA_VERSION = 1
"""The version of the format. It changes when a reader of the old one would misread the new one."""
MANUAL = "B3.6"
"""The revision of the manual that ``spec/`` is about."""
Record = dict[str, Any]

_json = json.JSONEncoder(ensure_ascii=True, allow_nan=False).encode


def start_record(  # noqa: PLR0913 - each of them is a fact
    *,
    version: str,
    spec_sha256: str,
    time: str,
    target: str,
    options: Options,
    selection: Iterable[str],
    checks: int,
    snapshot: Snapshot,
    address: int,
    line: LineSettings,
    checksum: bool,
    echo: bool = False,
    given_model: str | None = None,
    statement: str | None = None,
    strict: bool = False,
) -> Record:
    """Return the first line.

    Shape: `given_model` is the model that the user says it is, instead of the module; `statement` is the file with what
        the module has.
    """
    return {
        "record": "run-start",
        "schema_version": SCHEMA_VERSION,
        "version": version,
        "spec_sha256": spec_sha256,
        "manual": MANUAL,
        "time": time,
        "target": target,
        "given_model": given_model,
        "statement": statement,
        "echo": echo,
        "strict": strict,
        "seed": options.seed,
        "timeout_scale": options.timeout_scale,
        "eeprom_writes": options.writes,
        "max_seconds": options.seconds,
        "allowed": [hazard.value for hazard in Hazard if hazard in options.allowed],
        "selection": list(selection),
        "checks": checks,
        "module": {
            "address": address,
            **_line_settings(line),
            "checksum": checksum,
            **json.loads(snapshot.to_json()),
        },
    }


def wire_record(check: str | None, seconds: float, data: bytes, *, sent: bool) -> Record:
    """Return the line of bytes on the wire; `check` is the check that they belong to, None outside of any."""
    return {
        "record": "wire",
        "check": check,
        "seconds": round(seconds, 6),
        "from": "host" if sent else "module",
        "wire": data.hex(),
    }


def line_record(check: str | None, seconds: float, line: LineSettings) -> Record:
    """Return the line that the host took other line settings."""
    return {"record": "line", "check": check, "seconds": round(seconds, 6), **_line_settings(line)}


def power_record(check: str | None, seconds: float, *, init_switch: bool) -> Record:
    """Return the line that the power of the module was switched off and on."""
    return {"record": "power", "check": check, "seconds": round(seconds, 6), "init_switch": init_switch}


def _line_settings(line: LineSettings) -> Record:
    return {
        "baud_rate": BaudRate(line.baud_rate).bits_per_second,
        "character_format": line.character_format.name,
    }


def check_record(result: CheckResult, *, known: bool = False) -> Record:
    """Return the line of a check; `known` is whether the baseline has its failure."""
    statement = result.statement
    record: Record = {
        "record": "check",
        "id": result.id,
        "verdict": result.verdict.value,
        "seconds": round(result.seconds, 6),
        "title": statement.title,
        "requirement": statement.requirement,
        "sections": list(statement.sections),
        "level": statement.level.value,
        "hazards": [hazard.value for hazard in Hazard if hazard in statement.hazards],
        "errata": list(statement.errata),
    }
    if result.reason:
        record["reason"] = result.reason.value
    for name, value in (("text", result.text), ("expected", result.expected)):
        if value:
            record[name] = value
    record |= {name: wire.hex() for name, wire in _evidence(result)}
    if result.repeats:
        record["repeats"] = [verdict.value for verdict in result.repeats]
    if result.writes:
        record["writes"] = result.writes
    if known:
        record["known"] = True
    return record


def _evidence(result: CheckResult) -> Iterator[tuple[str, bytes]]:
    """Yield the bytes that decided, by their names."""
    if result.text and (result.sent or result.received):
        yield from (("sent", result.sent), ("received", result.received))
    if result.wrote:
        yield from (("wrote", result.wrote), ("answered", result.answered))
    if result.right:
        yield "right", result.right


def end_record(run: Run, settled: Settled | None, *, exit_code: int, complete: bool) -> Record:
    """Return the last line of a run, without its digest."""
    counts = Counter(result.verdict for result in run.results)
    restored = [*run.restored, *(settled.restored if settled else ())]
    return {
        "record": "run-end",
        "complete": complete,
        "counts": {verdict.value: counts[verdict] for verdict in Verdict if counts[verdict]},
        "writes": run.writes,
        "restored": list(dict.fromkeys(restored)),
        "left_changed": list(settled.left) if settled else None,
        "silent": settled.silent if settled else None,
        "exit_code": exit_code,
    }


def as_line(record: Mapping[str, Any]) -> str:
    """Return a record as a line, without its end."""
    return _json(record)


class Digest:
    """The lines of a report with their SHA-256, as they are written."""

    def __init__(self) -> None:
        self._digest = sha256()

    def line(self, record: Mapping[str, Any]) -> str:
        """Return a record as a line, without its end."""
        text = as_line(record)
        self._digest.update(text.encode() + b"\n")
        return text

    def last(self, record: Mapping[str, Any]) -> str:
        """Return the last record as a line, with the digest of all lines, and of this one without it."""
        self.line(record)
        return as_line({**record, "digest": self._digest.hexdigest()})
