"""What people see of a run: a heading for each group, a row for each check, a summary; a progress bar on a terminal."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager

from i7000.cli.baseline import known_failures
from i7000.cli.check_stream import ReportStream
from i7000.cli.check_text import STYLES, details, sections_words
from i7000.cli.progress import Draw, progress
from i7000.cli.text import Line, Printer
from i7000.conformance.exports import reproduction
from i7000.conformance.hazard import DEFAULT_ALLOWED, Hazard
from i7000.conformance.run import Begun, CheckResult, Options, Planned, Run
from i7000.conformance.settle import Settled
from i7000.conformance.verdict import SkipReason, Verdict

__all__ = ["Screen"]

_WORDS = {0: "PASSED", 1: "FAILED", 5: "UNDECIDED"}
_COUNTED = frozenset({SkipReason.NOT_APPLICABLE, SkipReason.HAZARD})
"""Why a check was not carried out that is only counted."""
_SETTLED = frozenset({Verdict.PASS, Verdict.SKIP, Verdict.INFO})
"""What is not shown if only failures are wanted."""
_ROOM = 40
"""The characters of an id, in most rows."""


class Screen:
    """The output of a run."""

    def __init__(
        self, printer: Printer, stream: ReportStream, baseline: Mapping[str, Verdict], *, quiet: bool = False
    ) -> None:
        self._printer, self._stream, self._baseline, self._quiet = printer, stream, baseline, quiet
        self._group = ""
        self._draw: Draw = lambda _steps, _words: None
        self._words = ""
        """What is carried out."""

    @contextmanager
    def progress(self, planned: Sequence[Planned]) -> Iterator[None]:
        """Draw a progress bar until the end, on a terminal."""
        with progress(self._printer, sum(it.skip is None for it in planned)) as self._draw:
            yield

    def begin(self, begun: Begun) -> None:
        """Draw what is carried out."""
        self._words = begun.statement.id
        self._draw(0, self._words)

    def show(self, result: CheckResult) -> None:
        """Print what became of a check."""
        if result.verdict is not Verdict.SKIP:
            self._draw(1, self._words)
        known = result.id in known_failures([result], self._baseline)
        if result.reason in _COUNTED or (self._quiet and (result.verdict in _SETTLED or known)):
            return
        if result.statement.group != self._group:
            self._group = result.statement.group
            self._printer.lines([[(self._group, "bold")]])
        spans: Line = [
            (f"  {result.id:{_ROOM}} ", "cyan"),
            (f"{result.verdict.value:14}", STYLES[result.verdict]),
            (f" {result.seconds * 1000:5.0f} ms  ", "dim"),
            (sections_words(result.statement.sections), "dim"),
            (" (in the baseline)" if known else "", ""),
        ]
        self._printer.lines([spans, *details(result, reproduction(self._stream.head, result.id))])
        self._printer.flush()

    def summary(self, one: Run, settled: Settled | None) -> None:
        """Print what became of all checks."""
        counts = Counter(result.verdict for result in one.results)
        words = ", ".join(f"{counts[verdict]} {verdict.value}" for verdict in Verdict if counts[verdict])
        lines: list[Line] = [[(words or "no check was carried out", "bold")]]
        lines += [[(f"  {text}", "")] for text in _not_carried_out(one)]
        mended = sorted(set(self._baseline) & {it.id for it in one.results if it.verdict is Verdict.PASS})
        if mended:
            lines.append([(f"in the baseline, but passed: {', '.join(mended)}", "")])
        if one.may_have_changed:
            lines.append([(f"{one.writes} of at most {one.options.writes} writes to the EEPROM", "")])
        restored = dict.fromkeys((*one.restored, *(settled.restored if settled else ())))
        if restored:
            lines.append([(f"restored: {', '.join(restored)}", "")])
        self._printer.lines(lines)
        self._printer.flush()

    def word(self, code: int, options: Options) -> None:
        """Print the outcome in one word, and what it is for: the hazards that were allowed, and the statement."""
        allowed, missing = (
            ", ".join(hazard.value for hazard in Hazard if (hazard in options.allowed) is wanted)
            for wanted in (True, False)
        )
        scope = [f" for {allowed}"]
        if missing:
            scope.append(f"not allowed: {missing}")
        if options.claims is None:
            scope.append("without a statement")
        self._printer.lines([[(_WORDS.get(code, "FAILED"), "bold"), ("; ".join(scope), "")]])


def _not_carried_out(one: Run) -> Iterator[str]:
    """Yield how many checks were not carried out, and what to allow for them."""
    foreign = sum(it.reason is SkipReason.NOT_APPLICABLE for it in one.results)
    if foreign:
        yield f"{foreign} not applicable: {one.twin.state.profile.model.value} does not have what they test"
    missing = Counter(
        tuple(_options(it.statement.hazards - one.options.allowed - DEFAULT_ALLOWED))
        for it in one.results
        if it.reason is SkipReason.HAZARD
    )
    if missing:
        yield f"{sum(missing.values())} not allowed:"
        for options, count in missing.most_common():
            yield f"  {count} need {' '.join(options)}" if options else f"  {count} refused by the guard"


def _options(hazards: frozenset[Hazard]) -> Iterator[str]:
    for hazard in Hazard:
        if hazard in hazards and not (hazard is Hazard.WRITE and Hazard.COMM in hazards):
            yield f"--allow {hazard.value}"
