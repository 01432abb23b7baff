"""A change of settings at a port: one after the other, each with its result, and honest about an end in the middle.

Laws: the first signal lets the setting at hand end, with its verification, and stops before the next one. A second one
breaks it off, and then that setting is in doubt.
"""

from signal import SIGINT
from typing import Any

from i7000 import describe
from i7000.cli.asked import LEFT_CHANGED
from i7000.cli.reached import Reached
from i7000.cli.setting_text import names_words, restored_lines, restored_record
from i7000.cli.stored import line_words
from i7000.cli.text import Printer
from i7000.cli.words import LineError
from i7000.host.procedures import Procedure, Restoration, Restored, Status, Writing
from i7000.host.procedures.inquiry import GONE

__all__ = ["Changes", "code_of"]

_HELD = (Status.DONE, Status.ALREADY, Status.PENDING)
_CHANGED = (Status.DONE, Status.PENDING, Status.NOT_VERIFIED)


def code_of(results: list[Restored]) -> int:
    """Return the exit code for the results of settings."""
    statuses = [result.status for result in results]
    if Status.IN_DOUBT in statuses:
        return LEFT_CHANGED
    if any(result.status is Status.UNREAD and result.reason == GONE for result in results):
        return LEFT_CHANGED if any(status in _CHANGED for status in statuses) else LineError.code
    return 0 if all(status in _HELD for status in statuses) else 1


class Changes:
    """The changes of one module, with what became of them so far.

    Shape: of the settings that were as wanted before, only those in `expected` are shown.
    """

    def __init__(self, there: Reached, printer: Printer, expected: frozenset[str]) -> None:
        self.there = there
        self._expected = expected
        self.results: list[Restored] = []
        self._printer = printer
        self._writing: tuple[str, ...] = ()
        """The settings that are in doubt at this moment."""

    def carry_out(self, procedure: Procedure[Restoration], names: frozenset[str]) -> int | None:
        """Change settings, and show what becomes of them; `names` are those that are to be changed.

        Shape: None if the procedure came to its end; or else the exit code.
        Errors: `OSError` if the port is lost, or the output cannot be written, before anything was changed.
        """
        there, ending = self.there, self.there.open.ending
        try:
            restoration = there.open.line.run(procedure, self._tell)
        except KeyboardInterrupt:
            return self._stopped("stopped", 128 + (ending.number or SIGINT))
        except OSError as error:  # the port is lost, or nobody reads the output
            if not self._writing and not self._changed:
                raise
            return self._stopped(str(error), LEFT_CHANGED)
        shown = {result.name for result in self.results}
        for result in restoration.results:
            if result.name in names and result.name not in shown:
                self._show(result)
        self._move(restoration)
        return None

    @property
    def _changed(self) -> list[Restored]:
        return [result for result in self.results if result.status in _CHANGED]

    def _tell(self, value: Any) -> None:  # noqa: ANN401 - `Writing` or `Restored`
        if isinstance(value, Writing):
            self._writing = value.names
            return
        self._writing = tuple(name for name in self._writing if name != value.name)
        self._show(value)
        if self.there.open.ending.number and not self._writing:
            raise KeyboardInterrupt

    def _show(self, result: Restored) -> None:
        self.results.append(result)
        if result.status is Status.ALREADY and result.name not in self._expected:
            return
        self._printer.record(restored_record(result), restored_lines(result, self.there.profile.model))
        self._printer.flush()

    def _stopped(self, why: str, code: int) -> int:
        """Report an end in the middle, and return the exit code."""
        changed = names_words(result.name for result in self._changed) or "nothing"
        self._printer.error(f"{why}: {changed} was changed before")
        if not self._writing:
            return code
        self._printer.error(f"in doubt: {names_words(self._writing)} may have the old value or the new one")
        return LEFT_CHANGED

    def _move(self, after: Restoration) -> None:
        """Remember where the module is now, and report that if it moved."""
        there, profile = self.there, after.profile
        words = []
        if after.address != there.address:
            words.append(f"address {describe.address(after.address)}")
        if after.line is not None:
            words.append(line_words(after.line))
        if profile.checksum is not there.profile.checksum:
            words.append(f"{'a' if profile.checksum else 'no'} checksum")
        if words:
            self._printer.note(f"the module now has {', '.join(words)}")
        there.address, there.profile = after.address, profile
