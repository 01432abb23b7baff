"""The records of a run of vectors, as JSON and for JUnit, and what is counted in it."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from attrs import field, frozen

from i7000.cli.text import escaped
from i7000.conformance.vector_verdicts import Implementation, Judged, Reason, Verdict, verdict_of
from i7000.conformance.vectors import Vector

__all__ = ["SCHEMA_VERSION", "Record", "Result", "Tally", "junit", "result_record", "start_record"]

SCHEMA_VERSION = 1
Record = dict[str, object]


@frozen
class Result:
    """What came of a vector."""

    vector: Vector
    cases: tuple[Judged, ...]

    @property
    def verdict(self) -> Verdict:
        """The worst verdict of its cases."""
        return verdict_of(self.cases)

    @property
    def wrong(self) -> list[Judged]:
        """The cases that failed or ended in an error."""
        return [case for case in self.cases if case.verdict in (Verdict.FAIL, Verdict.ERROR)]

    @property
    def reason(self) -> Reason | None:
        """The reason of its verdict, if it has one."""
        return next((case.reason for case in self.cases if case.verdict is self.verdict), None)

    @property
    def is_partial(self) -> bool:
        """Whether a part of it passed and the rest was skipped."""
        return self.verdict is Verdict.PASS and any(case.verdict is Verdict.SKIP for case in self.cases)


@frozen
class Tally:
    """How many there are of each verdict."""

    vectors: Counter[Verdict] = field(factory=Counter)
    partial: Counter[bool] = field(factory=Counter)
    files: dict[str, Counter[Verdict]] = field(factory=dict)
    """Of vectors, by file."""
    operations: dict[str, Counter[Verdict]] = field(factory=dict)
    """Of cases, by operation."""
    reasons: Counter[Reason | None] = field(factory=Counter)
    """Of cases that were skipped or ended in an error."""

    def add(self, result: Result) -> None:
        """Count a vector."""
        self.vectors[result.verdict] += 1
        self.partial[result.is_partial] += 1
        self.files.setdefault(result.vector.file, Counter())[result.verdict] += 1
        for case in result.cases:
            self.operations.setdefault(case.case.operation, Counter())[case.verdict] += 1
            self.reasons[case.reason] += 1

    @property
    def wrong(self) -> int:
        """How many vectors failed or ended in an error."""
        return self.vectors[Verdict.FAIL] + self.vectors[Verdict.ERROR]

    @property
    def code(self) -> int:
        """The exit code: 3 for an error, 1 for a failure, 5 if nothing ran, 0 if all that ran passed."""
        if self.vectors[Verdict.ERROR]:
            return 3
        if self.vectors[Verdict.FAIL]:
            return 1
        return 0 if self.vectors[Verdict.PASS] else 5

    @property
    def record(self) -> Record:
        """The numbers as JSON."""
        return {
            "vectors": _counts(self.vectors) | {"partial": self.partial[True]},
            "files": {name: _counts(self.files[name]) for name in sorted(self.files)},
            "operations": {name: _counts(self.operations[name]) for name in sorted(self.operations)},
        }


def _counts(counter: Counter[Verdict]) -> Record:
    return {verdict.value: counter[verdict] for verdict in Verdict}


def start_record(implementation: Implementation, command: Sequence[str]) -> Record:
    """Return what a run is about: the implementation and how it is started."""
    return {
        "implementation": {
            "name": implementation.name,
            "version": implementation.version,
            "language": implementation.language,
            "operations": sorted(implementation.operations),
        },
        "command": list(command),
    }


def result_record(result: Result) -> Record:
    """Return the record of a vector; of cases that passed or were skipped, without their input and answer."""
    return {
        "record": "vector",
        "id": result.vector.id,
        "file": result.vector.file,
        "verdict": result.verdict.value,
        "reason": result.reason and result.reason.value,
        "cases": [_case_record(case) for case in result.cases],
    }


def _case_record(found: Judged) -> Record:
    record: Record = {
        "operation": found.case.operation,
        "verdict": found.verdict.value,
        "reason": found.reason and found.reason.value,
        "text": found.text,
    }
    if found.verdict in (Verdict.PASS, Verdict.SKIP):
        return record
    return record | {
        "profile": found.case.profile,
        "input": found.case.given,
        "expected": found.case.expected.record,
        "answer": found.answer,
        "stderr": found.stderr,
    }


def junit(results: Iterable[Result], implementation: Implementation) -> bytes:
    """Return a report for JUnit: a suite for each file, a test for each vector."""
    by_file: dict[str, list[Result]] = {}
    for result in results:
        by_file.setdefault(result.vector.file, []).append(result)
    root = Element("testsuites", name="i7000 vectors")
    for file, found in by_file.items():
        name = f"vectors.{file.removesuffix('.json').replace('/', '.')}"
        counts = Counter(result.verdict for result in found)
        suite = SubElement(
            root,
            "testsuite",
            name=name,
            tests=str(len(found)),
            failures=str(counts[Verdict.FAIL]),
            errors=str(counts[Verdict.ERROR]),
            skipped=str(counts[Verdict.SKIP]),
        )
        properties = SubElement(suite, "properties")
        for key in ("name", "version", "language"):
            SubElement(properties, "property", name=key, value=_xml(getattr(implementation, key)))
        for result in found:
            test = SubElement(suite, "testcase", classname=name, name=result.vector.id)
            for tag, message, text in _junit_children(result):
                SubElement(test, tag, message=_xml(message)).text = _xml(text)
    indent(root)
    xml: bytes = tostring(root, encoding="us-ascii", xml_declaration=True)
    return xml + b"\n"


def _junit_children(result: Result) -> Iterator[tuple[str, str, str]]:
    """Yield the tag, message and text of what is to be said about a vector."""
    if result.verdict is Verdict.SKIP:
        yield "skipped", result.reason.value if result.reason else "", ""
    for case in result.wrong:
        kind = "failure" if case.verdict is Verdict.FAIL else "error"
        reason = f"{case.reason.value}: " if case.reason else ""
        yield kind, f"{case.case.operation}: {reason}{case.text}", str(case.case.given)


def _xml(text: str) -> str:
    """Return a text in the characters that XML allows."""
    return escaped(text).encode("ascii", "backslashreplace").decode()
