"""A run of checks at a port: what it asks for first, what it shows, and how it leaves the module.

Laws: before the first frame that changes something, the settings of the module are in a file. Whatever ends the run,
the module is restored, and what became of it is said.
"""

import json
import signal
from collections import Counter
from collections.abc import Callable, Iterable
from contextlib import ExitStack
from datetime import UTC, datetime
from importlib.metadata import version
from typing import IO, Any

from attrs import define

from i7000 import spec
from i7000.cli.asked import LEFT_CHANGED, Asked
from i7000.cli.check_options import Settings, Wishes, settings_of, write_baseline
from i7000.cli.check_text import STYLES, details
from i7000.cli.reached import OpenLine, Reached, reach
from i7000.cli.reached import run as at_port
from i7000.cli.report_files import MADE, write_report
from i7000.cli.snapshot_file import check_new, write_new
from i7000.cli.text import Line, Printer
from i7000.cli.words import LineError, UsageError
from i7000.conformance.guard import GuardError
from i7000.conformance.hazard import Hazard
from i7000.conformance.oracle import eeprom_of
from i7000.conformance.records import Digest, as_line, check_record, end_record, start_record, wire_record
from i7000.conformance.run import Begun, CheckResult, Planned, Run, exit_code, plan
from i7000.conformance.settle import Settled, settle
from i7000.conformance.verdict import SkipReason, Verdict
from i7000.device import Eeprom, power_on
from i7000.host.procedures import Snapshot, snapshot
from i7000.link import LinkError, Observed, Received, VirtualPort, Written
from i7000.link.guarded import GuardedPort

__all__ = ["run"]

_STORED = frozenset({Hazard.WRITE, Hazard.COMM, Hazard.CALIBRATION})
_SIMULATED = "sim:"
"""The targets whose time is virtual: they take none."""


def run(asked: Asked, wishes: Wishes) -> int:
    """Carry out a run; return the exit code."""
    settings = settings_of(wishes)
    if wishes.snapshot is not None:
        check_new(wishes.snapshot)
    printer = Printer()
    wire = _Wire()

    def body(open_line: OpenLine) -> int:
        return _Checking(asked, wishes, settings, printer, wire).examine(open_line)

    try:
        return at_port(asked, body, wire.observe, guard=lambda port: GuardedPort(port, settings.options.allowed))
    except GuardError as error:  # while the cause of a silence is looked for
        raise UsageError(error) from None


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
        """Check the module: ask what it is, carry out the plan, and restore it."""
        there = reach(open_line, self._asked, self._printer.note)
        before = open_line.run(snapshot(there.address, there.profile, there.protocol))
        if not before.settings:
            raise LineError(f"{there.words} stopped answering: nothing was checked")
        options = self._settings.options
        self._check_name(before)
        eeprom = eeprom_of(before)
        profile = power_on(eeprom, now=0.0).profile
        chosen = [it for it in spec.statements().values() if it.id in self._settings.ids]
        planned = plan(chosen, profile, there.protocol, options.allowed, options.claims)
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
        """Report how long the run will take: as long as on a simulated module, in virtual time."""
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
                spec_sha256=spec.digest(),
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
            sent, seconds = isinstance(observed, Written), observed.at - self._began
            self._record(wire_record(self._check, seconds, observed.data, sent=sent))

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
        made = [(kind, path) for kind, path in self._settings.reports if kind in MADE]
        if made:
            lines = [*map(as_line, self._records[:-1]), text]
            for kind, path in made:
                write_report(lines, kind, path)

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
            write_baseline(self._wishes.baseline, one.results)
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
            return open_line.finish(settle(before, one.place, one.line))
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
            (f"{result.verdict.value:14}", STYLES[result.verdict]),
            (f" {result.seconds * 1000:6.0f} ms  ", "dim"),
            (", ".join(result.statement.sections), "dim"),
            (known, ""),
        ]
        self._printer.lines([spans, *details(result)])
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
