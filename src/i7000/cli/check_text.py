"""Checks and what became of them, in lines for people."""

from collections.abc import Iterator, Sequence

from i7000 import InvalidValueError, Protocol, spec
from i7000.cli.baseline import FAILURES
from i7000.cli.text import Line, Printer
from i7000.cli.words import UsageError
from i7000.conformance.hazard import Hazard
from i7000.conformance.run import CheckResult, selected
from i7000.conformance.statement import Statement
from i7000.conformance.verdict import Verdict

__all__ = ["STYLES", "details", "explained", "listed", "sections_words"]


def listed(select: tuple[str, ...]) -> int:
    """List the checks, one a line; return the exit code."""
    try:
        ids = selected(spec.statements(), select)
    except InvalidValueError as error:
        raise UsageError(error) from None
    printer = Printer()
    width = max(map(len, ids))
    for statement in spec.statements().values():
        if statement.id in ids:
            hazards = ",".join(hazard.value for hazard in Hazard if hazard in statement.hazards)
            printer.lines(
                [
                    [
                        (f"{statement.id:{width}}", "cyan"),
                        (f"  {statement.level.value:8} {hazards:9} ", ""),
                        (statement.title, ""),
                    ]
                ]
            )
    return 0


def explained(text: str) -> int:
    """Explain a check; return the exit code."""
    try:
        ids = selected(spec.statements(), [text])
    except InvalidValueError as error:
        raise UsageError(error) from None
    if text not in ids:
        raise UsageError(f"--explain {text}: give one id; see i7000 check --list {text}")
    printer, statement = Printer(), spec.statements()[text]
    printer.lines(_explanation(statement))
    return 0


_PROTOCOLS = {None: "", Protocol.DCON: "DCON", Protocol.MODBUS_RTU: "Modbus RTU"}


def _explanation(statement: Statement) -> list[Line]:
    rows = [
        ("requirement", statement.requirement),
        ("sections", ", ".join(statement.sections)),
        ("level", statement.level.value),
        ("sends", ", ".join(hazard.value for hazard in Hazard if hazard in statement.hazards) or "plain reads"),
        (
            "protocol",
            _PROTOCOLS[statement.protocol],
        ),
        ("command", statement.command or ""),
        ("function", statement.function or ""),
        ("register", statement.register or ""),
        ("models", ", ".join(model.value for model in statement.models or ())),
        ("needs", ", ".join(statement.needs)),
        ("errata", ", ".join(statement.errata)),
    ]
    lines: list[Line] = [[(statement.id, "cyan"), (f"  {statement.title}", "bold")]]
    return [*lines, *([(f"  {name:12}", ""), (value, "")] for name, value in rows if value)]


STYLES = {
    Verdict.PASS: "green",
    Verdict.PASS_GOOD_ONLY: "yellow",
    Verdict.INCONCLUSIVE: "yellow",
    Verdict.WARN: "yellow",
    Verdict.INFO: "blue",
    Verdict.FAIL: "red",
    Verdict.SKIP: "dim",
    Verdict.ERROR: "red",
    Verdict.FLAKY: "red",
}


_MOST_SECTIONS = 3


def sections_words(sections: Sequence[str]) -> str:
    """Return sections of the manual for a row: the first ones.

    >>> sections_words(["2", "2.1"]), sections_words(["3.4.1", "3.4.2", "3.4.3", "3.4.4"])
    ('2, 2.1', '3.4.1 ... 3.4.4')
    """
    return ", ".join(sections) if len(sections) <= _MOST_SECTIONS else f"{sections[0]} ... {sections[-1]}"


def details(result: CheckResult, command: str) -> list[Line]:
    """Return why a check did not pass; `command` repeats it."""
    if result.verdict is Verdict.PASS:
        return []
    lines = [_row("", result.text)] if result.text else []
    if result.wrote:
        lines += _dump("wrote", result.wrote)
        lines += _dump("answered", result.answered)
    if result.sent or result.received:
        lines += _dump("sent", result.sent)
        lines += _dump("received", result.received, result.right)
    if result.expected:
        lines.append(_row("expected", result.expected))
    if result.repeats:
        lines.append(_row("repeated", ", ".join(verdict.value for verdict in result.repeats)))
    if result.verdict in FAILURES or result.verdict is Verdict.ERROR:
        lines.append(_row("required", result.statement.requirement))
        lines.append(_row("repeat", command))
    return lines


def _row(name: str, text: str) -> Line:
    return [(f"    {name:9} " if name else "    ", "dim"), (text, "")]


_BYTES = 16
"""The bytes of a row: with their characters they fit in 80 columns."""
_MOST_ROWS = 8


def _dump(name: str, wire: bytes, right: bytes = b"") -> Iterator[Line]:
    """Yield bytes in hex and as text, with a caret below the first one that is not right."""
    if not wire:
        yield _row(name, "nothing")
    fault = _fault(wire, right) if wire and right else None
    for start in range(0, min(len(wire), _MOST_ROWS * _BYTES), _BYTES):
        piece = wire[start : start + _BYTES]
        text = "".join(chr(byte) if 0x20 <= byte < 0x7F else "." for byte in piece)
        yield _row("" if start else name, f"{' ' * 10 if start else ''}{piece.hex(' ').upper():48}  {text}".rstrip())
        if fault is not None and start <= fault <= start + _BYTES and (fault < start + _BYTES or fault == len(wire)):
            yield _row("", f"{' ' * (10 + 3 * (fault - start))}^^ {_fault_words(wire, right, fault)}")
    if len(wire) > _MOST_ROWS * _BYTES:
        yield _row("", f"{' ' * 10}and {len(wire) - _MOST_ROWS * _BYTES} more bytes")


def _fault(wire: bytes, right: bytes) -> int | None:
    """Return the place of the first byte that is not right; None if there is none."""
    if wire == right:
        return None
    both = min(len(wire), len(right))
    return next((at for at in range(both) if wire[at] != right[at]), both)


def _fault_words(wire: bytes, right: bytes, at: int) -> str:
    if at == len(wire):
        return f"{right[at]:02X} is missing"
    return f"{right[at]:02X} is right" if at < len(right) else "too many bytes"
