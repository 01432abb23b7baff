"""A reading at a port, once or steadily: its modules, its times, and a port that can be lost.

Laws: a module that does not answer never ends a steady reading, and neither does a port that is lost. What waits can be
broken off by a signal, what writes cannot.
"""

from collections.abc import Callable
from contextlib import ExitStack
from math import ceil
from time import monotonic, sleep
from typing import Protocol

from attrs import define, field, frozen

from i7000 import LineSettings
from i7000.cli.port import BreakingEnding, broken_off_by_signals, opened
from i7000.cli.silence import LONG_TIMEOUT, silence_cause
from i7000.cli.station import Polled, Station, at_words
from i7000.cli.wanted import Wanted
from i7000.cli.words import LineError
from i7000.dissect import Known
from i7000.errors import Noise
from i7000.host import Declined, Late, Policy, Rejected, TimedOut
from i7000.link import Asked, Happened, Line, LinkError, Observed, Written

__all__ = ["Counts", "Output", "Plan", "Schedule", "run"]


@frozen
class Plan:
    """What to read, where, and how often."""

    target: str
    settings: LineSettings
    policy: Policy
    echo: bool
    wanted: tuple[Wanted, ...]
    every: float | None
    """The period in seconds; None to read once."""
    count: int | None
    """The number of times; None for no end."""


class Output(Protocol):
    """Where readings go."""

    def begin(self, stations: tuple[Station, ...]) -> None:
        """Write what stands before all readings."""

    def show(self, polled: tuple[Polled, ...]) -> None:
        """Write the readings of all modules at one time."""


# --- counters ---------------------------------------------------------------------------------------------------------


@define
class Counts:
    """What has happened on the line so far."""

    requests: int = 0
    retries: int = 0
    unanswered: int = 0
    """Requests without a response, but for those in other protocols before a module was identified."""
    late: int = 0
    """Frames that arrived when no response was due."""
    damaged: int = 0
    """Bytes that are not a frame, and frames that are not the response."""
    missed: int = 0
    """Periods in which nothing was read, since the one before took too long or the port was lost."""
    _written: int = field(default=0, init=False)
    """How often the open request was sent."""

    def observe(self, observed: Observed) -> None:
        """Count what happens on a line; this observes a `Line`."""
        if isinstance(observed, Asked):
            self._written = 0
        elif isinstance(observed, Written):
            self.requests += 1
            self.retries += self._written > 0
            self._written += 1
        elif isinstance(observed, Happened):
            self.unanswered += isinstance(observed.event, TimedOut)
            self.late += isinstance(observed.event, Late)
            self.damaged += isinstance(observed.event, Noise | Rejected)

    def words(self) -> str:
        """Return the counters in words.

        >>> Counts(requests=3, late=1).words()
        'requests 3  retries 0  no answer 0  late 1  damaged 0  missed periods 0'
        """
        return (
            f"requests {self.requests}  retries {self.retries}  no answer {self.unanswered}  late {self.late}"
            f"  damaged {self.damaged}  missed periods {self.missed}"
        )


# --- time -------------------------------------------------------------------------------------------------------------


@frozen
class Schedule:
    """The times at which periods begin, however long each reading takes.

    Unit: seconds.
    """

    start: float
    period: float

    def next(self, number: int, at: float) -> int:
        """Return the number of the first period after `number` that has not begun.

        >>> Schedule(100.0, 2.0).next(0, 101.5), Schedule(100.0, 2.0).next(0, 105.0)
        (1, 3)
        """
        return max(number + 1, ceil(round((at - self.start) / self.period, 6)))

    def begins(self, number: int) -> float:
        """Return when a period begins."""
        return self.start + number * self.period


_FIRST_PAUSE = 0.5
_LONGEST_PAUSE = 5.0
"""Seconds between two attempts to open a lost port."""


class Connection:
    """The port of a plan, which can be lost and come back.

    Special: a simulated bus has its own time. It follows that of the machine period by period.
    """

    def __init__(self, plan: Plan, counts: Counts, ending: BreakingEnding) -> None:
        self._plan, self.counts, self._ending = plan, counts, ending
        self._stack = ExitStack()
        self.line = self._open()

    def _open(self) -> Line:
        plan = self._plan
        port = self._stack.enter_context(opened(plan.target, plan.settings))
        try:
            return Line(port, plan.settings, plan.policy, echo=plan.echo, observe=self.counts.observe)
        except LinkError as error:
            self.close()
            raise LineError(error) from None

    def close(self) -> None:
        """Close the port."""
        self._stack.close()

    def reopen(self) -> None:
        """Wait until the port is back."""
        pause = _FIRST_PAUSE
        while True:
            self.close()
            with self._ending.breakable():
                sleep(pause)
                try:
                    self.line = self._open()
                except LineError:
                    pause = min(2 * pause, _LONGEST_PAUSE)
                else:
                    return

    def wait(self, until: float, passed: float) -> None:
        """Wait until a time, and let so many seconds have passed on a simulated bus since its power-on."""
        clock: Callable[[], float] | None = getattr(self.line.port, "now", None)
        with self._ending.breakable():
            if clock is None:
                self.line.wait(max(0.0, until - monotonic()))
            else:
                sleep(max(0.0, until - monotonic()))
                self.line.wait(max(0.0, passed - clock()))


# --- reading ----------------------------------------------------------------------------------------------------------


def run(plan: Plan, outputs: tuple[Output, ...], counts: Counts, note: Callable[[str], None]) -> int:
    """Read what is planned, and return the exit code; `note` is called with messages beside the readings.

    Errors: `UsageError` for a text that is not a target; `LineError` for a port that cannot be opened, or is lost
        before everything was read once; `OSError` for an output that cannot be written.
    """
    with broken_off_by_signals() as ending:
        try:
            with ending.breakable():
                connection = Connection(plan, counts, ending)
            try:
                reader = _Reader(plan, connection, outputs, note, ending)
                return reader.once() if plan.every is None else reader.steadily(plan.every)
            finally:
                connection.close()
        except KeyboardInterrupt:
            return 128 + ending.number


class _Reader:
    """A plan that is carried out."""

    def __init__(
        self,
        plan: Plan,
        connection: Connection,
        outputs: tuple[Output, ...],
        note: Callable[[str], None],
        ending: BreakingEnding,
    ) -> None:
        self._plan, self._connection, self._outputs = plan, connection, outputs
        self._note, self._ending = note, ending
        self._stations = tuple(map(Station, plan.wanted))
        self._begun = False

    def once(self) -> int:
        """Read all modules once, and return the exit code."""
        try:
            self._identify()
            polled = self._poll()
            self._show(polled)
            for it, station in zip(polled, self._stations, strict=True):
                self._explain(it, station)
        except LinkError as error:
            raise LineError(error) from None
        if not all(it.answered for it in polled):
            return LineError.code
        return int(not all(it.understood for it in polled))

    def steadily(self, period: float) -> int:
        """Read all modules in each period until there is an end, and return the exit code."""
        try:
            self._identify()
        except LinkError as error:
            raise LineError(error) from None
        schedule, number, left = Schedule(monotonic(), period), 0, self._plan.count
        while left != 0:
            try:
                self._identify()
                self._connection.wait(schedule.begins(number), number * period)
                polled = self._poll()
            except LinkError as error:
                self._connection.counts.missed += 1
                self._note(f"{error}; waiting until it is back")
                self._connection.reopen()
                self._note("the port is back")
            else:
                self._show(polled)
                left = None if left is None else left - 1
            following = schedule.next(number, monotonic())
            self._connection.counts.missed += following - number - 1
            number = following
        return 0

    def _identify(self) -> None:
        for station in self._stations:
            counts = self._connection.counts
            late, unanswered = counts.late, counts.unanswered
            with self._ending.breakable():
                notes = station.identify(self._connection.line)
            if station.identified and not station.doubted:
                counts.unanswered = unanswered
            for words in notes:
                self._note(words)
            if notes and counts.late > late:
                self._note(f"{at_words(station.wanted.address)}: {_LATE}")

    def _poll(self) -> tuple[Polled, ...]:
        with self._ending.breakable():
            return tuple(station.poll(self._connection.line) for station in self._stations)

    def _show(self, polled: tuple[Polled, ...]) -> None:
        if not self._begun:
            for output in self._outputs:
                output.begin(self._stations)
        self._begun = True
        for output in self._outputs:
            output.show(polled)

    def _explain(self, polled: Polled, station: Station) -> None:
        """Write why there are no readings, if there are none."""
        at = at_words(polled.address)
        if polled.report is not None and polled.answered:
            for it in polled.report.unknown:
                self._note(f"{at}: disabled channels are unknown, and can read as 0: {it.reason}")
        if polled.answered or station.identified:
            reason = polled.reason or next((f"channel {it.channel}: {it.error}" for it in polled.faults), "")
            if polled.report is not None and reason:
                refused = isinstance(polled.report.outcome, Declined)
                hint = "" if refused or station.wanted.given == Known() else _MISFIT
                self._note(f"{at}: {reason}{hint}")
            return
        wanted = station.wanted
        with self._ending.breakable():
            cause = silence_cause(self._connection.line, polled.address, wanted.tried, wanted.given.model)
        self._note(f"{at} does not answer: {cause}")


_LATE = f"frames came after their time: if responses are late, give --timeout {LONG_TIMEOUT:g}"
_MISFIT = "; do --model, --type and --format fit the module?"
