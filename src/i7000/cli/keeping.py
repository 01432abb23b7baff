"""The settings of a module while a command may change them: in a file before, restored and compared afterwards.

Laws: before the first frame that changes something, the settings of the module are in a file. How the module was left
is said, and so is what to do about it.
"""

import shlex
from contextlib import suppress

from i7000.cli.asked import LEFT_CHANGED
from i7000.cli.port import BreakingEnding
from i7000.cli.reached import OpenLine, Reached
from i7000.cli.snapshot_file import write_new
from i7000.cli.text import Printer
from i7000.cli.words import LineError, UsageError
from i7000.conformance.hazard import STORED, Hazard
from i7000.conformance.oracle import Twin, eeprom_of
from i7000.conformance.settle import Settled, settle
from i7000.errors import I7000Error
from i7000.host.procedures import Snapshot
from i7000.link.bench import snapshot_name
from i7000.settings import LineSettings

__all__ = ["Keeper", "broken_off", "home_of", "worse_of"]


class Keeper:
    """The settings of a module at a target, of which a command may change what is allowed.

    Shape: `path` is the new file for them; None takes a name with the model, the address and the time.
    """

    def __init__(self, target: str, allowed: frozenset[Hazard], printer: Printer, path: str | None) -> None:
        self._target, self._allowed, self._printer, self._path = target, allowed, printer, path
        self._kept: str | None = None
        """The file with the settings of before."""

    def keep(self, before: Snapshot, there: Reached) -> None:
        """Write the settings to a file, if any could be changed.

        Errors: `UsageError` for a file that exists; `OSError`.
        """
        if not self._allowed & STORED:
            return
        path = self._path or snapshot_name(before, there.address)
        write_new(path, before.to_json())
        self._kept = path
        self._printer.note(f"the settings of {there.words} are in {path}")

    def check_name(self, before: Snapshot, confirm: str | None) -> None:
        """Raise `UsageError` for another name than that of the module, if its calibration could be changed."""
        if Hazard.CALIBRATION in self._allowed and confirm != before.name:
            raise UsageError(f"--confirm {confirm}: the name of the module is {before.name}")

    def settle(
        self, open_line: OpenLine, before: Snapshot, place: Twin, line: LineSettings, home: Twin
    ) -> Settled | None:
        """Restore the module, see `i7000.conformance.settle.settle`; None if that was impossible.

        Special: the first signal meanwhile is answered with a warning, the second one breaks it off.
        """
        writing = bool(self._allowed & STORED)
        try:
            with open_line.ending.insistent(self._warn):
                return open_line.finish(settle(before, place, line, home=home, writing=writing))
        except (I7000Error, KeyboardInterrupt) as error:
            self._printer.error(f"the module could not be restored: {str(error) or 'stopped'}")
            return None

    def _warn(self) -> None:
        with suppress(RuntimeError):  # the signal came while something else was printed
            self._printer.note("the module is being restored: press Ctrl-C once more to leave it as it is")

    def left(self, settled: Settled | None, *, may_have_changed: bool) -> int:
        """Return the exit code of how the module was left; 0 if it is as before."""
        if settled is None or settled.silent:
            return LEFT_CHANGED if may_have_changed else LineError.code
        return LEFT_CHANGED if settled.left else 0

    def report(self, settled: Settled | None, left: int) -> None:
        """Report how the module was left, and what to do."""
        if settled and settled.silent:
            self._printer.error("the module does not answer any more")
        elif settled and settled.left:
            self._printer.error(f"left changed: {', '.join(settled.left)}")
        elif left == LEFT_CHANGED:
            self._printer.error("the module may be left changed")
        if left == LEFT_CHANGED and self._kept:
            words = f"i7000 restore {shlex.quote(self._target)} {shlex.quote(self._kept)}"
            self._printer.error(f"restore it with {words}")


def broken_off(ending: BreakingEnding, settled: Settled | None) -> int:
    """Return the exit code if a signal broke off the restoration; 0 if none did."""
    return 128 + ending.number if settled is None and ending.number else 0


def worse_of(left: int, ended: int) -> int:
    """Return the exit code of how the module was left, or of the signal that ended the run; 0 if there is neither."""
    return left if left == LEFT_CHANGED else ended or left


def home_of(before: Snapshot, there: Reached) -> Twin:
    """Return the model of a module with the settings of a snapshot, and how it is spoken to now."""
    eeprom = eeprom_of(before)
    home = Twin.of(eeprom, 0.0, init_switch=there.address == 0 != eeprom.address)
    return Twin(home.state.keep(checksum=there.profile.checksum, line_settings=there.open.line.line))
