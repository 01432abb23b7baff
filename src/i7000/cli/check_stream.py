"""The report files of a run: the lines as they come, and what is made of all of them at the end.

Laws: a report that cannot be written never ends the run, which has to restore the module: the first error is kept.
"""

from contextlib import ExitStack
from typing import IO, Any

from i7000.cli.report_files import MADE, write_report
from i7000.conformance.records import Digest, line_record, power_record, wire_record
from i7000.conformance.report import Report
from i7000.link import Observed, PowerCycled, Received, Tuned, Written

__all__ = ["ReportStream"]


class ReportStream:
    """The lines of a report, which are written to its files.

    Shape: `check` is the check that is carried out; what is on the line belongs to it. `failure` is why a file cannot
        be written.
    """

    def __init__(self, files: tuple[tuple[str, str], ...]) -> None:
        self.check: str | None = None
        self.failure: OSError | None = None
        self.start: dict[str, Any] | None = None
        self._files = files
        self._digest = Digest()
        self._lines: list[str] = []
        self._open: list[IO[str]] = []
        self._began: float | None = None

    def open(self, stack: ExitStack) -> None:
        """Open the files that are written as the lines come.

        Errors: `OSError`.
        """
        for kind, path in self._files:
            if kind not in MADE:
                self._open.append(stack.enter_context(open(path, "w", encoding="ascii")))  # noqa: PTH123, SIM115

    def begin(self, record: dict[str, Any]) -> None:
        """Write the first line."""
        self.start = record
        self.record(record)

    @property
    def head(self) -> Report:
        """The report, of which only the first line is known."""
        return Report(self.start or {}, (), None, ())

    def observe(self, observed: Observed) -> None:
        """Write what is on the line, after the first line."""
        if self.start is None or not isinstance(observed, Received | Written | Tuned | PowerCycled):
            return
        if self._began is None:
            self._began = observed.at
        check, seconds = self.check, observed.at - self._began
        if isinstance(observed, Tuned):
            self.record(line_record(check, seconds, observed.line))
        elif isinstance(observed, PowerCycled):
            self.record(power_record(check, seconds, init_switch=observed.init_switch))
        else:
            self.record(wire_record(check, seconds, observed.data, sent=isinstance(observed, Written)))

    def record(self, record: dict[str, Any]) -> None:
        """Write a line."""
        self._write(self._digest.line(record))

    def finish(self, record: dict[str, Any]) -> None:
        """Write the last line, and the reports that are made of all of them."""
        self._write(self._digest.last(record))
        for kind, path in self._files:
            try:
                if kind in MADE:
                    write_report(self._lines, kind, path)
            except OSError as error:
                self._fail(error, path)

    def _write(self, line: str) -> None:
        self._lines.append(line)
        for file in [*self._open]:
            try:
                file.write(f"{line}\n")
                file.flush()
            except OSError as error:
                self._open.remove(file)
                self._fail(error, file.name)

    def _fail(self, error: OSError, path: str) -> None:
        error.filename = path
        self.failure = self.failure or error
