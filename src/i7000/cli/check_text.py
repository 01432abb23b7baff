"""Checks and what became of them, in lines for people."""

from i7000 import InvalidValueError, Protocol, spec
from i7000.cli.check_options import FAILURES
from i7000.cli.records import frame_words
from i7000.cli.text import Line, Printer
from i7000.cli.words import UsageError
from i7000.conformance.hazard import Hazard
from i7000.conformance.run import CheckResult, selected
from i7000.conformance.statement import Statement
from i7000.conformance.verdict import Verdict

__all__ = ["STYLES", "details", "explained", "listed"]


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


def details(result: CheckResult) -> list[Line]:
    """Return why a check did not pass."""
    if result.verdict is Verdict.PASS:
        return []
    rows = [("", result.text)]
    if result.sent or result.received:
        rows.append(("sent", _bytes(result.sent)))
        rows.append(("received", _bytes(result.received) or "nothing"))
    if result.expected:
        rows.append(("expected", result.expected))
    if result.verdict in FAILURES:
        rows.append(("required", result.statement.requirement))
    return [[(f"    {name:9}" if name else "    ", "dim"), (text, "")] for name, text in rows if text]


def _bytes(wire: bytes) -> str:
    return frame_words(wire, Protocol.DCON) if wire.endswith(b"\r") else wire.hex(" ").upper()
