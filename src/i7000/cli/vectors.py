"""``i7000 vectors``: the vectors of spec, run against an implementation in any language."""

import json as json_text
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from datetime import UTC, datetime
from math import isfinite
from pathlib import Path
from time import monotonic
from typing import IO, Annotated, Any

from attrs import evolve, field, frozen
from cyclopts import Parameter

from i7000 import __version__, spec
from i7000.cli.codec_run import Codec
from i7000.cli.options import Json, Texts
from i7000.cli.port import broken_off_by_signals
from i7000.cli.text import Line, Printer
from i7000.cli.vector_files import all_vectors
from i7000.cli.vector_records import SCHEMA_VERSION, Record, Result, Tally, junit, result_record, start_record
from i7000.cli.vector_schema import protocol_schema, report_schema
from i7000.cli.words import UsageError, near
from i7000.conformance.vector_verdicts import PROTOCOL, Implementation, Reason, Verdict, skipped
from i7000.conformance.vectors import OPERATIONS, Case, Vector, selected

__all__ = ["DELIMITER", "vectors"]

DELIMITER = "--"
"""What stands between the selection and the command."""
_SHORTEST, _LONGEST = 0.01, 600.0
_KINDS = ("json", "junit")


def vectors(  # noqa: PLR0913 - each of them is an option
    *words: Annotated[
        str,
        Parameter(
            name="SELECT... -- COMMAND",
            help="Which vectors (ids, beginnings of ids, globs, files, operations; all without any), then -- and the"
            " program with its arguments.",
        ),
    ],
    timeout: Annotated[float, Parameter(help="Seconds that each answer may take: 0.01 to 600.")] = 10.0,
    max_failures: Annotated[
        int | None, Parameter(help="End the run after so many vectors with FAIL or ERROR. Example: --max-failures 1.")
    ] = None,
    report: Annotated[
        Texts, Parameter(help="Write reports: json=FILE (JSON lines), junit=FILE (XML), or both with a comma.")
    ] = (),
    list_: Annotated[
        bool, Parameter(name="--list", help="List the selected vectors and exit; COMMAND is not needed.", negative="")
    ] = False,
    json: Json = False,
    schema: Annotated[bool, Parameter(help="Print the JSON Schema of the messages and exit.", negative="")] = False,
    report_schema_: Annotated[
        bool, Parameter(name="--report-schema", help="Print the JSON Schema of --json and exit.", negative="")
    ] = False,
) -> int:
    """Run the vectors of spec against a codec in any language.

    COMMAND is started once, and reads and writes JSON, one object a line, on its standard input and output. It says
    which operations it has, then gets one case after the other, and answers each with a result or an error. The answers
    are compared here, by value. `docs/port_the_codec.md` has the protocol on one page; `--schema` has it in full.

    A vector is a PASS if all that was run of it is right, FAIL if an answer is wrong, SKIP if the implementation has
    none of its operations, ERROR if there is no answer to judge: it died, was too slow, or wrote something else. After
    an ERROR it is started again, up to 20 times. Of its standard error the end is shown then.

    Examples: `i7000 vectors -- python -m i7000.examples.vector_runner`,
    `i7000 vectors frames.checksum reading-hex-08 'dcon-2.1?-*' --report junit=vectors.xml -- node vectors.js`

    JSON: the records `run-start`, `vector` and `run-end`; without the last one, the run is incomplete.

    Exit code: 0 if all that ran passed, 1 for a FAIL, 2 for wrong usage, 3 for an ERROR or a program that does not
    start, 5 if nothing ran, 130 after Ctrl-C.
    """
    if schema or report_schema_:
        sys.stdout.write(f"{protocol_schema() if schema else report_schema()}\n")
        return 0
    at = words.index(DELIMITER) if DELIMITER in words else len(words)
    select, command = words[:at], words[at + 1 :]
    chosen = _chosen(select)
    printer = Printer(json=json)
    if list_:
        for vector in chosen:
            printer.record(*_listed(vector))
        return 0
    if not command:
        raise UsageError("give the command of the implementation after --, as in i7000 vectors -- node vectors.js")
    if not isfinite(timeout) or not _SHORTEST <= timeout <= _LONGEST:
        raise UsageError(f"--timeout {timeout:g}: give {_SHORTEST} to {_LONGEST:g} seconds")
    if max_failures is not None and max_failures < 1:
        raise UsageError(f"--max-failures {max_failures}: give 1 or more")
    with ExitStack() as stack:
        reports = {
            kind: stack.enter_context(path.open("w", encoding="utf-8", newline="\n"))
            for kind, path in _report_paths(report).items()
        }
        run = _Run(chosen, command, timeout, max_failures or len(chosen), printer, reports)
        with broken_off_by_signals() as ending:
            try:
                with ending.breakable():
                    return run.run()
            except KeyboardInterrupt:
                printer.note("broken off: the run is incomplete")
                return 128 + ending.number


# --- what is selected -------------------------------------------------------------------------------------------------


def _chosen(select: Sequence[str]) -> tuple[Vector, ...]:
    """Return the selected vectors, with their selected cases only.

    Errors: `UsageError` for a name that selects nothing.
    """
    every = all_vectors()
    if not select:
        return every
    found: dict[str, frozenset[str]] = {}
    for name in select:
        matched = selected(every, name)
        if not matched:
            names = [*(vector.id for vector in every), *{vector.file: 0 for vector in every}, *OPERATIONS]
            raise UsageError(f"there is no vector, file or operation {name!r}{near(name, names)}")
        for key, operations in matched.items():
            found[key] = found.get(key, frozenset()) | operations
    return tuple(
        evolve(vector, cases=tuple(case for case in vector.cases if case.operation in found[vector.id]))
        for vector in every
        if vector.id in found
    )


def _listed(vector: Vector) -> tuple[Record, list[Line]]:
    operations = list(dict.fromkeys(case.operation for case in vector.cases))
    record: Record = {
        "id": vector.id,
        "file": vector.file,
        "operations": operations,
        "comment": vector.comment,
    }
    return record, [[(f"{vector.id:<44} ", "bold"), (", ".join(operations), "")]]


def _report_paths(report: Sequence[str]) -> dict[str, Path]:
    """Read ``KIND=FILE``."""
    found: dict[str, Path] = {}
    for part in ",".join(report).split(",") if report else ():
        kind, equals, name = part.partition("=")
        if kind not in _KINDS or not equals or not name:
            raise UsageError(f"--report {part}: write {' or '.join(f'{kind}=FILE' for kind in _KINDS)}")
        if kind in found:
            raise UsageError(f"--report {kind} is given twice")
        if Path(name) in found.values():
            raise UsageError(f"--report {part}: give another file than for {next(iter(found))}")
        found[kind] = Path(name)
    return found


# --- a run ------------------------------------------------------------------------------------------------------------


@frozen
class _Run:
    vectors: tuple[Vector, ...]
    command: tuple[str, ...]
    timeout: float
    most_wrong: int
    printer: Printer
    reports: Mapping[str, IO[str]]
    tally: Tally = field(factory=Tally)

    def run(self) -> int:
        began = monotonic()
        codec = Codec(self.command, self.timeout)
        try:
            self._write(self._start(codec.implementation))
            results = []
            for result in self._results(codec):
                results.append(result)
                self.tally.add(result)
                self._write(result_record(result), _wrong_lines(result))
            codec.stop()
        finally:
            codec.kill()
        numbers = self.tally.record | {"restarts": codec.restarts, "note": codec.note, "code": self.tally.code}
        self._write({"record": "run-end", "seconds": round(monotonic() - began, 3)} | numbers, self._summary(codec))
        if "junit" in self.reports:
            self.reports["junit"].write(junit(results, codec.implementation).decode())
        if codec.note:
            self.printer.note(f"{codec.implementation.name}: {codec.note}")
        return self.tally.code

    def _start(self, implementation: Implementation) -> Record:
        return {
            "record": "run-start",
            "schema_version": SCHEMA_VERSION,
            "program": "i7000 vectors",
            "version": __version__,
            "spec": spec.digest(),
            "protocol": PROTOCOL,
            "time": datetime.now(UTC).isoformat(timespec="milliseconds"),
        } | start_record(implementation, self.command)

    def _results(self, codec: Codec) -> Iterator[Result]:
        """Yield what came of each vector; after too many failures the rest is skipped."""
        judged = codec.run([case for vector in self.vectors for case in vector.cases])
        for vector in self.vectors:
            if self.tally.wrong >= self.most_wrong:
                yield Result(vector, tuple(skipped(case, Reason.MAX_FAILURES) for case in vector.cases))
            else:
                yield Result(vector, tuple(next(judged) for _ in vector.cases))

    def _write(self, record: Record, lines: Sequence[Line] = ()) -> None:
        """Write a record to the output and to the report."""
        self.printer.record(record, lines)
        if "json" in self.reports:
            self.reports["json"].write(f"{_json(record)}\n")

    def _summary(self, codec: Codec) -> list[Line]:
        """Return the tables of a run, and its last line."""
        tally, about = self.tally, codec.implementation
        counts = tally.vectors
        words = [f"{counts[verdict]} {verdict.value}" for verdict in Verdict if counts[verdict]]
        partial = f" ({tally.partial[True]} of them in part)" if tally.partial[True] else ""
        reasons = [f"{count} {reason.value}" for reason, count in tally.reasons.most_common() if reason]
        return [
            *_table("file", tally.files),
            *_table("operation", tally.operations),
            *([[(f"skipped cases and errors: {', '.join(reasons)}", "")]] if reasons else []),
            [
                (f"{about.name} {about.version} ({about.language}): ", "bold"),
                (f"{counts.total()} vectors: {', '.join(words)}".replace("PASS", f"PASS{partial}"), ""),
            ],
        ]


_json: Callable[[Any], str] = json_text.JSONEncoder(check_circular=False).encode
_WIDTH = 46


def _table(title: str, rows: dict[str, Any]) -> Iterator[Line]:
    yield [(f"{title:<{_WIDTH}}" + "".join(f"{verdict.value:>7}" for verdict in Verdict), "bold")]
    for name in sorted(rows):
        yield [(f"{name:<{_WIDTH}}" + "".join(f"{rows[name][verdict] or '-':>7}" for verdict in Verdict), "")]


_STYLES = {Verdict.FAIL: "red", Verdict.ERROR: "magenta"}


def _wrong_lines(result: Result) -> list[Line]:
    """Return what failed of a vector, for people; of what was not run there is nothing to say."""
    lines: list[Line] = []
    for found in result.wrong:
        if found.reason is Reason.NOT_RUN:
            continue
        reason = f"{found.reason.value}: " if found.reason else ""
        lines.append(
            [
                (f"{found.verdict.value:<5} ", _STYLES[found.verdict]),
                (f"{result.vector.id} ", "bold"),
                (found.case.operation, ""),
            ]
        )
        lines.append([(f"      {reason}{found.text}", "")])
        lines.extend([(f"      {name:<9}{text}", "dim")] for name, text in _facts(found.case, found.answer))
        lines.extend([(f"      stderr   {text}", "dim")] for text in found.stderr.splitlines()[-_MOST_LINES:])
    return lines


_MOST_LINES = 5
"""The lines of standard error that are shown."""


def _facts(case: Case, answer: Any) -> Iterator[tuple[str, str]]:  # noqa: ANN401 - JSON
    yield "input", _short(case.given)
    if case.profile is not None:
        yield "profile", _short(case.profile)
    yield "expected", _short(case.expected.record)
    if answer is not None:
        yield "answer", _short(answer)


_MOST_SHOWN = 600


def _short(value: Any) -> str:  # noqa: ANN401 - JSON
    text = _json(value)
    return text if len(text) <= _MOST_SHOWN else f"{text[:_MOST_SHOWN]}..."
