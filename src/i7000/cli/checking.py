"""A run of checks at a port: what it asks for first, what it shows, and how it leaves the module.

Laws: everything that can be wrong with the options is said before the port is opened. Before the first frame that
changes something, the settings of the module are in a file. Whatever ends the run, the module is restored, and what
became of it is said.
"""

import json
import signal
from collections import Counter
from collections.abc import Callable, Iterable
from contextlib import ExitStack
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import IO, Any

from attrs import define, frozen

from i7000 import InvalidValueError, Protocol
from i7000.cli.asked import LEFT_CHANGED, Asked
from i7000.cli.durations import seconds
from i7000.cli.module import named
from i7000.cli.reached import OpenLine, Reached, reach
from i7000.cli.reached import run as at_port
from i7000.cli.records import frame_words
from i7000.cli.snapshot_file import check_new, write_new
from i7000.cli.text import Line, Printer
from i7000.cli.words import LineError, UsageError
from i7000.conformance.hazard import Hazard, allowing
from i7000.conformance.oracle import eeprom_of
from i7000.conformance.records import Digest, check_record, end_record, start_record, wire_record
from i7000.conformance.run import Begun, CheckResult, Options, Planned, Run, exit_code, plan, selected
from i7000.conformance.settle import Settled, settle
from i7000.conformance.statement import Statement, statements
from i7000.conformance.verdict import SkipReason, Verdict
from i7000.device import Eeprom, power_on
from i7000.host.procedures import Snapshot, snapshot
from i7000.link import LinkError, Observed, Received, VirtualPort, Written
from i7000.link.guarded import GuardedPort

__all__ = ["Wishes", "explained", "listed", "run"]

_INTERRUPTED = 128 + signal.SIGINT
_LARGEST_BASELINE = 1 << 20
_SCALES = 0.1, 100.0
_MOST_WRITES = 10_000
_ASKED_FOR = {
    "write": Hazard.WRITE,
    "broadcast": Hazard.BROADCAST,
    "comm": Hazard.COMM,
    "calibration": Hazard.CALIBRATION,
}
_STORED = frozenset({Hazard.WRITE, Hazard.COMM, Hazard.CALIBRATION})
_SIMULATED = "sim:"
"""The targets whose time is virtual: they take none."""
_KINDS = ("json", "html", "junit", "pytest", "pcap")


@frozen(kw_only=True)
class Wishes:
    """The options of a run."""

    select: tuple[str, ...]
    allow: tuple[str, ...]
    confirm: str | None
    can_power_cycle: bool
    strict: bool
    certify: bool
    baseline: str | None
    baseline_update: bool
    reports: tuple[str, ...]
    snapshot: str | None
    seed: int
    max_time: str | None
    timeout_scale: float
    eeprom_writes: int
    quiet: bool


@frozen
class Settings:
    """What the options mean."""

    ids: frozenset[str]
    options: Options
    reports: tuple[tuple[str, str], ...]
    known: frozenset[str]
    """The failures of the baseline."""


def _settings(wishes: Wishes) -> Settings:
    """Return what the options mean.

    Errors: `UsageError`.
    """
    if wishes.certify and (wishes.select or wishes.baseline):
        raise UsageError("--certify checks everything: leave out the selection and --baseline")
    try:
        ids = selected(wishes.select)
    except InvalidValueError as error:
        raise UsageError(error) from None
    low, high = _SCALES
    if not low <= wishes.timeout_scale <= high:
        raise UsageError(f"--timeout-scale {wishes.timeout_scale:g}: give {low:g} to {high:g}")
    if not 0 <= wishes.eeprom_writes <= _MOST_WRITES:
        raise UsageError(f"--eeprom-writes {wishes.eeprom_writes}: give 0 to {_MOST_WRITES}")
    limit = None
    if wishes.max_time is not None:
        with named(f"--max-time {wishes.max_time}"):
            limit = seconds(wishes.max_time)
    if wishes.baseline_update and wishes.baseline is None:
        raise UsageError("--baseline-update needs --baseline FILE")
    options = Options(
        allowed=_allowed(wishes),
        seed=wishes.seed,
        timeout_scale=wishes.timeout_scale,
        writes=wishes.eeprom_writes,
        seconds=limit,
    )
    return Settings(ids, options, _reports(wishes.reports), _baseline(wishes))


def _allowed(wishes: Wishes) -> frozenset[Hazard]:
    hazards = []
    for text in wishes.allow:
        if text not in _ASKED_FOR:
            raise UsageError(f"--allow {text}: give {', '.join(_ASKED_FOR)}")
        hazards.append(_ASKED_FOR[text])
    if Hazard.COMM in hazards and not wishes.can_power_cycle:
        raise UsageError("--allow comm can lose the module: add --i-can-power-cycle if you can switch its power")
    if Hazard.CALIBRATION in hazards and wishes.confirm is None:
        raise UsageError("--allow calibration can destroy the calibration: add --confirm NAME, the name of the module")
    return allowing(hazards)


def _reports(texts: Iterable[str]) -> tuple[tuple[str, str], ...]:
    """Return the kinds and files of reports, which can be written: that is tried.

    Errors: `UsageError`; `OSError` for a file that cannot be written.
    """
    found = []
    for text in texts:
        kind, equals, file = text.partition("=")
        if kind not in _KINDS or not equals or not file:
            raise UsageError(f"--report {text}: give KIND=FILE; kinds are {', '.join(_KINDS)}")
        with Path(file).open("a", encoding="utf-8"):
            pass
        found.append((kind, file))
    return tuple(found)


# --- the baseline -----------------------------------------------------------------------------------------------------


def _baseline(wishes: Wishes) -> frozenset[str]:
    """Return the ids of the failures that are known.

    Errors: `UsageError` for a file that is not a baseline, `OSError` for one that cannot be read.
    """
    if wishes.baseline is None:
        return frozenset()
    file = Path(wishes.baseline)
    if wishes.baseline_update and not file.exists():
        with file.open("a", encoding="utf-8"):
            return frozenset()
    with file.open("rb") as opened:
        data = opened.read(_LARGEST_BASELINE + 1)
    if wishes.baseline_update and not data:
        return frozenset()
    try:
        document = json.loads(data) if len(data) <= _LARGEST_BASELINE else None
    except (ValueError, RecursionError):
        document = None
    document = document if isinstance(document, dict) and document.get("schema_version") == 1 else {}
    failures = document.get("failures")
    if not isinstance(failures, dict):
        raise UsageError(f"{file}: this is not a baseline: write one with --baseline-update")
    unknown = sorted(set(failures) - set(statements()))
    if unknown:
        raise UsageError(f"{file}: there is no check {unknown[0]}")
    return frozenset(failures)


_FAILURES = frozenset({Verdict.FAIL, Verdict.FLAKY, Verdict.PASS_GOOD_ONLY, Verdict.WARN})


def _write_baseline(path: str, results: Iterable[CheckResult]) -> None:
    failures = {it.id: it.verdict.value for it in results if it.verdict in _FAILURES}
    text = json.dumps({"schema_version": 1, "failures": dict(sorted(failures.items()))}, indent=2)
    Path(path).write_text(text + "\n", encoding="ascii")


# --- without a port ---------------------------------------------------------------------------------------------------


def listed(select: tuple[str, ...]) -> int:
    """List the checks, one a line; return the exit code."""
    try:
        ids = selected(select)
    except InvalidValueError as error:
        raise UsageError(error) from None
    printer = Printer()
    width = max(map(len, ids))
    for statement in statements().values():
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
        ids = selected([text])
    except InvalidValueError as error:
        raise UsageError(error) from None
    if text not in ids:
        raise UsageError(f"--explain {text}: give one id; see i7000 check --list {text}")
    printer, statement = Printer(), statements()[text]
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


# --- with a port ------------------------------------------------------------------------------------------------------


def run(asked: Asked, wishes: Wishes) -> int:
    """Carry out a run; return the exit code."""
    settings = _settings(wishes)
    if wishes.snapshot is not None:
        check_new(wishes.snapshot)
    printer = Printer()
    wire = _Wire()

    def body(open_line: OpenLine) -> int:
        return _Checking(asked, wishes, settings, printer, wire).examine(open_line)

    return at_port(asked, body, wire.observe, allowed=settings.options.allowed)


@define
class _Wire:
    """Where the bytes on the line go: nowhere until the report begins."""

    record: Callable[[Observed], None] | None = None

    def observe(self, observed: Observed) -> None:
        if self.record:
            self.record(observed)


class _Checking:
    """One run at a port."""

    def __init__(self, asked: Asked, wishes: Wishes, settings: Settings, printer: Printer, wire: _Wire) -> None:
        self._asked, self._wishes, self._settings = asked, wishes, settings
        self._printer, self._wire = printer, wire
        self._digest = Digest()
        self._records: list[dict[str, Any]] = []
        self._file: IO[str] | None = None
        self._check: str | None = None
        self._began: float | None = None
        self._width = 0

    def examine(self, open_line: OpenLine) -> int:
        """Ask the module what it is, check it, restore it, and tell the end."""
        there = reach(open_line, self._asked, self._printer.note)
        before = open_line.run(snapshot(there.address, there.profile, there.protocol))
        if not before.settings:
            raise LineError(f"{there.words} stopped answering: nothing was checked")
        options = self._settings.options
        self._check_name(before)
        eeprom = eeprom_of(before)
        profile = power_on(eeprom, now=0.0).profile
        planned = plan(self._settings.ids, profile, there.protocol, options.allowed)
        self._keep(before, there)
        one = Run(planned, eeprom, options, line=open_line.line.line, checksum=there.profile.checksum)
        with ExitStack() as stack:
            self._open_reports(stack)
            self._begin(before, there, open_line, planned)
            self._estimate(one, eeprom)
            return self._carry_out(open_line, one, before)

    def _check_name(self, before: Snapshot) -> None:
        if Hazard.CALIBRATION in self._settings.options.allowed and self._wishes.confirm != before.name:
            raise UsageError(f"--confirm {self._wishes.confirm}: the name of the module is {before.name}")

    def _keep(self, before: Snapshot, there: Reached) -> None:
        """Write the settings to a file, if any could be changed."""
        if not self._settings.options.allowed & _STORED:
            return
        path = self._wishes.snapshot
        if path is None:
            moment = datetime.now(UTC).strftime("%Y%m%dT%H%M%SZ")
            path = f"i7000-{before.model.value}-{there.address:02X}-{moment}.json"
        write_new(path, before.to_json())
        self._printer.note(f"the settings of {there.words} are in {path}")

    def _estimate(self, one: Run, eeprom: Eeprom) -> None:
        """Say how long the run will take: as long as on a simulated module, in virtual time."""
        if self._asked.target.startswith(_SIMULATED):
            return
        from i7000.link import Line as PortLine  # noqa: PLC0415 - a dry run needs a line of its own

        state = power_on(eeprom, now=0.0).keep(checksum=one.twin.state.ram.checksum, line_settings=one.line)
        dry = Run(one.planned, eeprom, one.options, line=one.line, checksum=state.ram.checksum)
        port = VirtualPort([state], line=one.line)
        with PortLine(GuardedPort(port, one.options.allowed), one.line) as line:
            line.run(dry.procedure())
        limit = one.options.seconds
        took = port.now() if limit is None else min(port.now(), limit)
        self._printer.note(f"this takes about {took:.0f} s")

    # --- the report -----------------------------------------------------------------------------------------------

    def _open_reports(self, stack: ExitStack) -> None:
        for kind, path in self._settings.reports:
            if kind == "json":
                self._file = stack.enter_context(open(path, "w", encoding="ascii"))  # noqa: PTH123, SIM115

    def _begin(self, before: Snapshot, there: Reached, open_line: OpenLine, planned: Iterable[Planned]) -> None:
        self._record(
            start_record(
                version=version("i7000"),
                time=datetime.now(UTC).isoformat(),
                target=self._asked.target,
                seed=self._wishes.seed,
                allowed=self._settings.options.allowed,
                selection=self._wishes.select,
                checks=len(tuple(planned)),
                snapshot=before,
                address=there.address,
                line=open_line.line.line,
                checksum=there.profile.checksum,
            )
        )
        self._width = max((len(it.statement.id) for it in planned), default=0)
        self._wire.record = self._observe

    def _observe(self, observed: Observed) -> None:
        if isinstance(observed, Received | Written):
            if self._began is None:
                self._began = observed.at
            sent = isinstance(observed, Written)
            self._record(wire_record(self._check, observed.at - self._began, observed.data, sent=sent))

    def _record(self, record: dict[str, Any]) -> None:
        self._records.append(record)
        text = self._digest.line(record)
        if self._file:
            self._file.write(text + "\n")

    def _finish(self, record: dict[str, Any]) -> None:
        """Write the last line, and the reports that are made of all of them."""
        text = self._digest.last(record)
        self._records.append(json.loads(text))
        if self._file:
            self._file.write(text + "\n")
            self._file.flush()

    # --- the run --------------------------------------------------------------------------------------------------

    def _carry_out(self, open_line: OpenLine, one: Run, before: Snapshot) -> int:
        ended = 0
        try:
            with open_line.ending.breakable():
                open_line.line.run(one.procedure(), self._tell)
        except KeyboardInterrupt:
            ended = 128 + (open_line.ending.number or signal.SIGINT)
        except LinkError as error:
            self._finish(end_record(one.results, None, writes=one.writes, exit_code=LineError.code, complete=False))
            left = LEFT_CHANGED if one.writes else LineError.code
            words = "; the module may be left changed" if one.writes else ""
            self._printer.error(f"{error}{words}: the report is incomplete")
            return left
        self._check = None
        settled = self._settle(open_line, one, before)
        code = exit_code(one.results, strict=self._wishes.strict, known=self._settings.known)
        code = LEFT_CHANGED if settled is None or not settled.is_as_before else ended or code
        self._finish(end_record(one.results, settled, writes=one.writes, exit_code=code, complete=not ended))
        self._summary(one, settled, code, ended)
        if self._wishes.baseline_update and self._wishes.baseline is not None and not ended:
            _write_baseline(self._wishes.baseline, one.results)
            return code if code != 1 else 0
        return code

    def _tell(self, told: object) -> None:
        if isinstance(told, Begun):
            self._check = told.statement.id
        elif isinstance(told, CheckResult):
            self._record(check_record(told))
            self._show(told)

    def _settle(self, open_line: OpenLine, one: Run, before: Snapshot) -> Settled | None:
        """Restore the module; None if that was impossible."""
        try:
            return open_line.line.run(settle(before, one.place, one.line))
        except (LinkError, KeyboardInterrupt) as error:
            self._printer.error(f"the module could not be restored: {str(error) or 'stopped'}")
            return None

    # --- what people see ------------------------------------------------------------------------------------------

    def _show(self, result: CheckResult) -> None:
        if result.verdict is Verdict.SKIP and result.reason is SkipReason.NOT_APPLICABLE:
            return
        known = " (in the baseline)" if result.id in self._settings.known else ""
        if self._wishes.quiet and (result.verdict in (Verdict.PASS, Verdict.SKIP, Verdict.INFO) or known):
            return
        spans: Line = [
            (f"{result.id:{self._width}}", "cyan"),
            ("  ", ""),
            (f"{result.verdict.value:14}", _STYLES[result.verdict]),
            (f" {result.seconds * 1000:6.0f} ms  ", "dim"),
            (", ".join(result.statement.sections), "dim"),
            (known, ""),
        ]
        self._printer.lines([spans, *_details(result)])
        self._printer.flush()

    def _summary(self, one: Run, settled: Settled | None, code: int, ended: int) -> None:
        counts = Counter(result.verdict for result in one.results)
        words = ", ".join(f"{counts[verdict]} {verdict.value}" for verdict in Verdict if counts[verdict])
        lines: list[Line] = [[(words, "bold")]]
        if one.writes:
            lines.append([(f"{one.writes} frames may have changed the EEPROM (at most {one.options.writes})", "")])
        if settled and settled.restored:
            lines.append([(f"restored: {', '.join(settled.restored)}", "")])
        self._printer.lines(lines)
        if settled and settled.silent:
            self._printer.error("the module does not answer any more")
        elif settled and settled.left:
            self._printer.error(f"left changed: {', '.join(settled.left)}")
        if ended:
            self._printer.error("INCOMPLETE: stopped before the end")
        if self._wishes.certify:
            self._printer.lines([[("PASSED" if code == 0 else "NOT PASSED", "bold")]])


_STYLES = {
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


def _details(result: CheckResult) -> list[Line]:
    """Return why a check did not pass."""
    if result.verdict is Verdict.PASS:
        return []
    rows = [("", result.text)]
    if result.sent or result.received:
        rows.append(("sent", _bytes(result.sent)))
        rows.append(("received", _bytes(result.received) or "nothing"))
    if result.expected:
        rows.append(("expected", result.expected))
    if result.verdict in _FAILURES:
        rows.append(("required", result.statement.requirement))
    return [[(f"    {name:9}" if name else "    ", "dim"), (text, "")] for name, text in rows if text]


def _bytes(wire: bytes) -> str:
    return frame_words(wire, Protocol.DCON) if wire.endswith(b"\r") else wire.hex(" ").upper()
