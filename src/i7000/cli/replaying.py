"""The frames of a report sent again at a port: what is held against the report first, and how the module is left.

Laws: nothing of the report is sent to another module than that of the report. What may change settings is sent as in
`i7000 check`: with the same options, the settings in a file before, and the module restored afterwards.
"""

import signal

from attrs import frozen

from i7000.cli.asked import LEFT_CHANGED, Asked, OneModule, asked_of
from i7000.cli.choices import SPOKEN
from i7000.cli.harm import HarmOptions
from i7000.cli.keeping import Keeper, broken_off, home_of, worse_of
from i7000.cli.options import UNKNOWN, Module
from i7000.cli.port import AskOptions, LineOptions
from i7000.cli.reached import OpenLine, Reached, reach
from i7000.cli.reached import run as at_port
from i7000.cli.report_files import read_lines
from i7000.cli.text import Printer
from i7000.cli.words import LineError, UsageError
from i7000.conformance import GuardError
from i7000.conformance.hazard import Hazard
from i7000.conformance.replay import Replayed
from i7000.conformance.replay import replay as replaying
from i7000.conformance.report import Report, ReportError, read_report
from i7000.conformance.settle import Settled
from i7000.host.procedures import Snapshot, snapshot
from i7000.link import LinkError, Port
from i7000.link.guarded import BudgetError, GuardedPort
from i7000.models import Model

__all__ = ["Wishes", "run"]

_INTERNAL = 4
_NOTHING_RAN = 5


@frozen(kw_only=True)
class Wishes:
    """The options of a replay."""

    file: str
    target: str | None
    harm: HarmOptions
    edited: bool


def run(wishes: Wishes, line: LineOptions, asking: AskOptions) -> int:
    """Send the frames of a report again; return the exit code."""
    wishes.harm.check()
    allowed = wishes.harm.allowed()
    printer = Printer()
    report = _read(wishes, printer)
    given = report.start.get("given_model")
    module = Module(model=(given,)) if isinstance(given, str) else UNKNOWN
    target = wishes.target or str(report.start.get("target"))
    one_module = OneModule(str(report.module.get("address")))
    asked = asked_of(target, line, asking, one_module, module, otherwise=report.line)
    one = _Replaying(asked, wishes, report, allowed, printer)
    return at_port(asked, one.examine, guard=one.guarded)


def _read(wishes: Wishes, printer: Printer) -> Report:
    """Return the report, and print what is wrong with it.

    Errors: `UsageError` for a file that is not a report, and for one that was edited, unless that is allowed.
    """
    try:
        report = read_report(read_lines(wishes.file))
    except (ReportError, ValueError) as error:
        raise UsageError(f"{wishes.file}: {error}") from None
    if report.damage and not wishes.edited:
        raise UsageError(f"{wishes.file}: {report.damage[0]}: give --edited to send it all the same")
    for problem in report.problems:
        printer.note(f"{wishes.file}: {problem}")
    return report


class _Replaying:
    """One replay at a port."""

    def __init__(
        self, asked: Asked, wishes: Wishes, report: Report, allowed: frozenset[Hazard], printer: Printer
    ) -> None:
        self._asked, self._wishes, self._report, self._printer = asked, wishes, report, printer
        self._allowed = allowed
        self._keeper = Keeper(asked.target, allowed, printer, wishes.harm.snapshot)
        self._results: list[Replayed] = []

    def guarded(self, port: Port) -> Port:
        """Return the guarded port of a port."""
        self._port = GuardedPort(port, self._allowed, budget=self._wishes.harm.eeprom_writes)
        return self._port

    def examine(self, open_line: OpenLine) -> int:
        """Compare the module with that of the report, send the frames, and restore the module."""
        like = next((model for model in Model if model.value == self._report.module.get("model")), None)
        there = reach(open_line, self._asked, self._printer.note, like, nearest=True)
        before = open_line.run(snapshot(there.address, there.profile, there.protocol))
        if not before.settings:
            raise LineError(f"{there.words} stopped answering: nothing was sent")
        _check_same(self._report, before, there)
        self._keeper.check_name(before, self._wishes.harm.confirm)
        self._keeper.keep(before, there)
        open_line.ending.hold()
        return self._carry_out(open_line, before, there)

    def _carry_out(self, open_line: OpenLine, before: Snapshot, there: Reached) -> int:
        ended, failure, home = 0, None, home_of(before, there)
        line = open_line.line.line
        try:
            with open_line.ending.breakable():
                open_line.line.run(replaying(self._report, timeout_scale=self._wishes.harm.timeout_scale), self._tell)
        except KeyboardInterrupt:
            ended = 128 + (open_line.ending.number or signal.SIGINT)
        except LinkError as error:
            if not self._port.writes:
                raise
            self._printer.error(str(error))
            self._keeper.report(None, LEFT_CHANGED)
            return LEFT_CHANGED
        except (Exception, SystemExit) as error:  # noqa: BLE001 - first of all the module is restored
            failure = error
        self._port.budget = None
        settled = self._keeper.settle(open_line, before, home, line, home)
        ended = ended or broken_off(open_line.ending, settled)
        left = self._keeper.left(settled, may_have_changed=bool(self._port.writes))
        self._summary(settled)
        self._keeper.report(settled, left)
        if failure is not None:
            return self._failed(failure, left)
        return worse_of(left, ended) or self._code()

    def _failed(self, failure: BaseException, left: int) -> int:
        """Return the exit code of a replay that a guard, this program or its output broke off."""
        if isinstance(failure, GuardError | BudgetError | ReportError):
            self._printer.error(f"{self._wishes.file}: {failure}")
            return left or UsageError.code
        if not left and isinstance(failure, OSError | SystemExit):
            raise failure
        self._printer.error(f"internal error: {type(failure).__name__}: {failure}")
        return left or _INTERNAL

    def _code(self) -> int:
        if not self._results:
            return _NOTHING_RAN
        return 0 if all(result.is_same for result in self._results) else 1

    def _summary(self, settled: Settled | None) -> None:
        same = sum(result.is_same for result in self._results)
        self._printer.lines([[(f"{same} of {len(self._results)} answers are those of the report", "bold")]])
        if settled and settled.restored:
            self._printer.lines([[(f"restored: {', '.join(settled.restored)}", "")]])
        self._printer.flush()

    def _tell(self, told: object) -> None:
        result: Replayed = told  # type: ignore[assignment] # it tells nothing else
        self._results.append(result)
        if not result.is_same:
            self._printer.lines([[(result.check, "cyan")], *_lines(result)])
            self._printer.flush()


def _check_same(report: Report, before: Snapshot, there: Reached) -> None:
    """Raise `UsageError` for another module than that of a report."""
    found = {
        "model": before.model.value,
        "name": before.name,
        "address": there.address,
        "protocol": SPOKEN[before.protocol],
    }
    for name, value in found.items():
        if report.module.get(name) != value:
            told = report.module.get(name)
            raise UsageError(f"{there.words} is not the module of the report: its {name} is {value}, not {told}")


def _lines(result: Replayed) -> list[list[tuple[str, str]]]:
    rows = [*(("sent", wire) for wire in result.sent), ("recorded", result.recorded), ("received", result.received)]
    return [[(f"    {name:9}", "dim"), (wire.hex(" ") or "nothing", "")] for name, wire in rows]
