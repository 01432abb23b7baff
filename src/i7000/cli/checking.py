"""A run of checks at a port: what it asks for first, and how it leaves the module.

Laws: whatever ends the run, the module is restored, and what became of it is said, see `i7000.cli.keeping`.
"""

import signal
from contextlib import ExitStack
from datetime import UTC, datetime
from functools import partial
from importlib.metadata import version

from i7000 import spec
from i7000.cli.asked import LEFT_CHANGED, Asked
from i7000.cli.baseline import known_failures, write_baseline
from i7000.cli.check_options import Settings, Wishes, settings_of
from i7000.cli.check_screen import Screen
from i7000.cli.check_stream import ReportStream
from i7000.cli.keeping import Keeper, broken_off, worse_of
from i7000.cli.progress import note_estimate
from i7000.cli.reached import OpenLine, Reached, reach
from i7000.cli.reached import run as at_port
from i7000.cli.text import Printer
from i7000.cli.words import LineError, UsageError
from i7000.conformance.hazard import Hazard
from i7000.conformance.oracle import eeprom_of
from i7000.conformance.records import check_record, end_record, start_record
from i7000.conformance.run import Begun, CheckResult, Planned, Run, exit_code, plan, worst
from i7000.conformance.settle import Settled
from i7000.conformance.verdict import SkipReason, Verdict
from i7000.device import Eeprom, power_on
from i7000.host.procedures import Snapshot, snapshot
from i7000.link import LinkError, VirtualPort
from i7000.link.guarded import GuardedPort
from i7000.models import Model

__all__ = ["run"]

_INTERNAL = 4
_UNWRITABLE = 2
_NOTHING = 5
_CUT_SHORT = frozenset({SkipReason.BUDGET, SkipReason.PREREQUISITE})
"""Why a check was not carried out that belongs to a whole run."""


def run(asked: Asked, wishes: Wishes) -> int:
    """Carry out a run; return the exit code."""
    settings = settings_of(wishes)
    printer, stream = Printer(), ReportStream(settings.reports)

    def body(open_line: OpenLine) -> int:
        return _Checking(asked, wishes, settings, printer, stream).examine(open_line)

    return at_port(asked, body, stream.observe, guard=lambda port: GuardedPort(port, settings.options.allowed))


class _Checking:
    """One run at a port."""

    def __init__(
        self, asked: Asked, wishes: Wishes, settings: Settings, printer: Printer, stream: ReportStream
    ) -> None:
        self._asked, self._wishes, self._settings = asked, wishes, settings
        self._printer, self._stream = printer, stream
        self._screen = Screen(printer, stream, settings.baseline, quiet=wishes.quiet)
        self._keeper = Keeper(asked.target, settings.options.allowed, printer, wishes.harm.snapshot)

    def examine(self, open_line: OpenLine) -> int:
        """Check the module: ask what it is, carry out the plan, and restore it."""
        claims = self._settings.options.claims
        like = None if claims is None else next((model for model in Model if model.value == claims.model), None)
        there = reach(open_line, self._asked, self._printer.note, like, nearest=True)
        before = open_line.run(snapshot(there.address, there.profile, there.protocol))
        if not before.settings:
            raise LineError(f"{there.words} stopped answering: nothing was checked")
        options = self._settings.options
        self._keeper.check_name(before, self._wishes.harm.confirm)
        eeprom = eeprom_of(before)
        init_mode = there.address == 0 and eeprom.address != 0
        if init_mode and Hazard.COMM in options.allowed:
            why = "what --allow comm tests begins outside of it"
            raise UsageError(f"{there.words} is in INIT mode: {why}: switch INIT off, and the power off and on")
        profile = power_on(eeprom, now=0.0, init_switch=init_mode).profile
        chosen = [it for it in spec.statements().values() if it.id in self._settings.ids]
        planned = plan(chosen, profile, there.protocol, options.allowed, options.claims)
        line, checksum = open_line.line.line, there.profile.checksum
        one = Run(planned, eeprom, options, line=line, checksum=checksum, before=before, init_mode=init_mode)
        with ExitStack() as stack:
            self._stream.open(stack)
            self._keeper.keep(before, there)
            self._begin(before, there, one, planned)
            estimated, limit = partial(self._estimated, one, eeprom), options.seconds
            with open_line.ending.breakable():
                note_estimate(self._printer, self._asked.target, estimated, limit)
            open_line.ending.hold()
            return self._carry_out(open_line, one, before)

    def _estimated(self, one: Run, eeprom: Eeprom) -> float:
        """Return how long the run takes: as long as on a simulated module, in virtual time."""
        from i7000.link import Line as PortLine  # noqa: PLC0415 - a dry run needs a line of its own

        ram = one.twin.state.ram
        state = power_on(eeprom, now=0.0, init_switch=ram.init_mode)
        state = state.keep(checksum=ram.checksum, line_settings=one.line)
        dry = Run(one.planned, eeprom, one.options, line=one.line, checksum=ram.checksum, init_mode=ram.init_mode)
        port = VirtualPort([state], line=one.line)
        with PortLine(GuardedPort(port, one.options.allowed), one.line) as line:
            line.run(dry.procedure())
        return port.now()

    def _begin(self, before: Snapshot, there: Reached, one: Run, planned: tuple[Planned, ...]) -> None:
        given = self._asked.wanted.given.model
        self._stream.begin(
            start_record(
                version=version("i7000"),
                spec_sha256=spec.digest(),
                time=datetime.now(UTC).isoformat(),
                target=self._asked.target,
                options=self._settings.options,
                selection=self._wishes.select,
                checks=len(planned),
                snapshot=before,
                address=there.address,
                line=one.line,
                checksum=there.profile.checksum,
                echo=self._asked.echo,
                given_model=None if given is None else given.value,
                statement=self._wishes.statement,
                strict=self._wishes.strict,
            )
        )

    # --- the run --------------------------------------------------------------------------------------------------

    def _carry_out(self, open_line: OpenLine, one: Run, before: Snapshot) -> int:
        ended, failure = 0, None
        try:
            with self._screen.progress(one.planned), open_line.ending.breakable():
                open_line.line.run(one.procedure(), self._tell)
        except KeyboardInterrupt:
            ended = 128 + (open_line.ending.number or signal.SIGINT)
        except LinkError as error:
            return self._lost(one, error)
        except (Exception, SystemExit) as error:  # noqa: BLE001 - first of all the module is restored
            failure = error
        self._stream.check = None
        settled = self._settle(open_line, one, before)
        ended = ended or broken_off(open_line.ending, settled)
        left = self._keeper.left(settled, may_have_changed=one.may_have_changed)
        if failure is not None:
            return self._failed(one, settled, left, failure)
        code = worse_of(left, ended) or self._code(one, settled)
        self._stream.finish(end_record(one, settled, exit_code=code, complete=not ended))
        self._screen.summary(one, settled)
        self._keeper.report(settled, left)
        if ended:
            self._printer.error("INCOMPLETE: stopped before the end")
        elif self._wishes.certify:
            self._screen.word(code, self._settings.options)
        return self._written(code)

    def _code(self, one: Run, settled: Settled | None) -> int:
        """Return the exit code of what became of the checks, and update the baseline."""
        wishes, baseline = self._wishes, self._settings.baseline
        known = known_failures(one.results, baseline)
        code = exit_code(one.results, strict=wishes.strict, known=known, asked=self._settings.asked)
        if settled is not None and settled.restored and code == 0:
            code = 1  # the checks put back what they change
        if wishes.certify and code == 0 and not all(map(_is_decided, one.results)):
            return _NOTHING
        if wishes.baseline_update and wishes.baseline is not None and code in (0, 1):
            try:
                write_baseline(wishes.baseline, one.results, baseline)
            except OSError as error:
                self._stream.failure = self._stream.failure or error
            return 0
        return code

    def _written(self, code: int) -> int:
        """Return the exit code, worse if a report could not be written."""
        failure = self._stream.failure
        if failure is None:
            return code
        self._printer.error(f"{failure.filename}: {failure.strerror or failure}: this report is not complete")
        return worst(code, _UNWRITABLE) if code <= LEFT_CHANGED else code

    def _lost(self, one: Run, error: LinkError) -> int:
        """End a run whose port is lost."""
        code = LEFT_CHANGED if one.may_have_changed else LineError.code
        self._stream.finish(end_record(one, None, exit_code=code, complete=False))
        self._screen.summary(one, None)
        self._printer.error(f"{error}: INCOMPLETE")
        self._keeper.report(None, LEFT_CHANGED if one.may_have_changed else 0)
        return self._written(code)

    def _failed(self, one: Run, settled: Settled | None, left: int, failure: BaseException) -> int:
        """End a run that this program, or its output, broke off."""
        code = left or _INTERNAL
        self._stream.finish(end_record(one, settled, exit_code=code, complete=False))
        self._keeper.report(settled, left)
        if not left and isinstance(failure, OSError | SystemExit):
            raise failure
        self._printer.error(f"internal error: {type(failure).__name__}: {failure}: INCOMPLETE")
        return code

    def _tell(self, told: object) -> None:
        if isinstance(told, Begun):
            self._stream.check = told.statement.id
            self._screen.begin(told)
        elif isinstance(told, CheckResult):
            known = bool(known_failures([told], self._settings.baseline))
            self._stream.record(check_record(told, known=known))
            self._screen.show(told)

    # --- the module afterwards ------------------------------------------------------------------------------------

    def _settle(self, open_line: OpenLine, one: Run, before: Snapshot) -> Settled | None:
        """Restore the module; None if that was impossible."""
        settled = self._keeper.settle(open_line, before, one.place, one.line, one.twin)
        one.writes += len(settled.restored) if settled else 0
        return settled


def _is_decided(result: CheckResult) -> bool:
    """Return whether a check belongs to a whole run and ended with a verdict, or does not belong to it."""
    return result.verdict is not Verdict.INCONCLUSIVE and result.reason not in _CUT_SHORT
