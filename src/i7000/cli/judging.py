"""``--judge`` of ``i7000 listen``: the findings and the verdict as text or JSON.

Laws: what is printed is complete only with its last record; nothing that was judged is never a success.
"""

import json
from collections.abc import Iterator, Mapping
from typing import Any

from i7000 import __version__, describe, spec
from i7000.cli.choices import SPOKEN
from i7000.cli.judge_schema import SCHEMA_VERSION
from i7000.cli.readers import Missing, Read, stamped
from i7000.cli.records import frame_words
from i7000.cli.text import Line, Printer
from i7000.conformance.judge import Finding, Judge, Level, Rule, Tally, Verdict, judge, verdict

__all__ = ["Judging"]


class Judging:
    """A judgement under way: it is given what was read, and prints findings at once and the verdict at the end."""

    def __init__(self, state: Judge, addresses: frozenset[int], printer: Printer, *, strict: bool) -> None:
        """Judge; `addresses` are those to show, all if there are none."""
        self._state = state
        self._addresses = addresses
        self._printer = printer
        self._levels = tuple(Level) if strict else (Level.MUST,)
        self._damaged = 0

    def begin(self, target: str) -> None:
        """Print the first record, for programs."""
        if self._printer.json:
            self._write(
                {
                    "record": "run-start",
                    "schema_version": SCHEMA_VERSION,
                    "program": "i7000 listen --judge",
                    "version": __version__,
                    "spec_sha256": spec.digest(),
                    "target": target,
                    "timeout": self._state.bound,
                }
            )

    def take(self, read: Read) -> None:
        """Judge what was read, and print the findings."""
        if read.missing is Missing.DAMAGE:
            self._damaged += 1
            if self._damaged <= _MOST_NAMED:
                self._printer.error(f"{read.text or f'packet {read.line}'}: {read.note}")
        if read.heard is None or read.knowledge is None:
            return
        times = read.times or (stamped(read.time) if read.time else None)
        self._state, found = judge(self._state, read.heard, read.knowledge, times, sent=read.sent)
        for finding in found:
            if self._shows(finding.address):
                if self._printer.json:
                    self._write(_record(finding, read))
                else:
                    self._printer.lines(_lines(finding, read))

    def end(self, code: int) -> int:
        """Print the verdict, and return the exit code: `code`, or that of the verdict if it is 0."""
        found = verdict(self._state)
        found = found._replace(tallies=tuple(it for it in found.tallies if self._shows(it.address)))
        broken = found.findings(*self._levels)
        if not code:
            code = 5 if not found.frames else int(bool(broken or self._damaged))
        if self._printer.json:
            self._write(_end_record(found, broken, self._damaged, code))
        else:
            self._printer.lines(_end_lines(found, broken, self._damaged))
        return code

    def _shows(self, address: int | None) -> bool:
        return not self._addresses or address in self._addresses

    def _write(self, record: Mapping[str, Any]) -> None:
        self._printer.write(json.dumps(record))


def _record(finding: Finding, read: Read) -> dict[str, Any]:
    rule = finding.rule
    return {
        "record": "finding",
        "id": rule.id,
        "side": rule.side,
        "address": finding.address,
        "level": rule.level.value,
        "sections": rule.sections,
        "errata": rule.errata,
        "requirement": rule.sentence,
        "what": finding.what,
        "number": finding.place.number,
        "line": read.line,
        "time": read.time,
        "protocol": SPOKEN[finding.protocol],
        "frame": frame_words(finding.wire, finding.protocol),
        "wire": finding.wire.hex(),
    }


_INDENT = "     "
_MOST_NAMED = 20
"""The places of a damaged file that are named."""


def _lines(finding: Finding, read: Read) -> Iterator[Line]:
    rule = finding.rule
    time = f"{read.time}  " if read.time else ""
    yield [(f"{read.line:<4} ", ""), (time, "dim"), (frame_words(finding.wire, finding.protocol), "bold")]
    source = "; ".join((f"manual {', '.join(rule.sections)}", *rule.errata))
    yield [
        (_INDENT, ""),
        (rule.id, "red" if rule.level is Level.MUST else "yellow"),
        (f"  {_place(rule.side, finding.address)}  ({rule.level.value}; {source})", ""),
    ]
    yield [(f"{_INDENT}{rule.sentence}", "")]
    yield [(f"{_INDENT}{finding.what}", "")]


def _place(side: str, address: int | None) -> str:
    return f"{side}, {'no single address' if address is None else f'address {describe.address(address)}'}"


def _end_record(found: Verdict, broken: int, damaged: int, code: int) -> dict[str, Any]:
    return {
        "record": "run-end",
        "verdict": "nothing" if not found.frames else "broken" if broken else "kept",
        "frames": found.frames,
        "sides": [
            {
                "side": side,
                "address": address,
                "frames": frames,
                "findings": [{"id": rule.id, "level": rule.level.value, "count": count} for rule, count in findings],
            }
            for side, address, frames, findings in found.tallies
        ],
        "untimed": [{"id": rule.id, "count": count} for rule, count in found.untimed],
        "withdrawn": found.withdrawn,
        "unjudged": found.unjudged,
        "damaged": damaged,
        "exit_code": code,
    }


def _end_lines(found: Verdict, broken: int, damaged: int) -> Iterator[Line]:
    for tally in found.tallies:
        yield from _tally_lines(tally)
    if found.untimed:
        yield [("not judged, because the times cannot tell:", "yellow")]
        yield from ([(f"{_INDENT}{rule.id}  {count}", "")] for rule, count in found.untimed)
    if found.withdrawn:
        why = "the adapter collects bytes, so short times show nothing; or a module's checksum setting had changed"
        yield [(f"withdrawn: {_counted(found.withdrawn, 'finding')}: {why}", "yellow")]
    if found.unjudged:
        yield [(f"not judged: {_counted(found.unjudged, 'piece')} of noise, or answers before the first command", "")]
    if damaged:
        yield [(f"damaged: {_counted(damaged, 'place')} of the file", "red")]
    if not found.frames:
        yield [("verdict: nothing was heard that could be judged", "yellow")]
    elif broken:
        yield [(f"verdict: broken, {_counted(broken, 'finding')} that count", "red")]
    else:
        others = found.findings()
        yield [
            (f"verdict: kept, {_counted(others, 'finding')} of other levels" if others else "verdict: kept", "green")
        ]


def _tally_lines(tally: Tally) -> Iterator[Line]:
    total = sum(count for _, count in tally.findings)
    words = _counted(total, "finding") if total else "no finding"
    yield [(f"{_place(tally.side, tally.address)}: {_counted(tally.frames, 'frame')}, {words}", "bold")]
    yield from ([(f"{_INDENT}{_id(rule)}  {count}", "")] for rule, count in tally.findings)


def _id(rule: Rule) -> str:
    return f"{rule.id} ({rule.level.value})"


def _counted(count: int, noun: str) -> str:
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
