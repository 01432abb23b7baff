"""Text for a file that is perhaps not read: writing never waits.

Laws: a thread of its own writes; what it cannot write is kept up to a limit. Beyond that whole lines are dropped
and counted, until all that was kept has been written. The flags of the file are not touched, since other programs share
them.
"""

import os
import signal
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager, redirect_stdout, suppress
from functools import partial
from threading import Condition, Thread
from time import sleep
from typing import IO, cast

from i7000.cli.text import Printer

__all__ = ["MOST_WAITING", "Outlet", "missed_words", "shown_by"]

MOST_WAITING = 1 << 18
"""Characters that are kept by default."""
_PATIENCE = 0.5
"""Seconds that the end waits for a file that is not read."""
_RETRY = 0.05
"""Seconds after which a file that another program has made non-blocking is tried again."""


def missed_words(count: int) -> str:
    """Return how many lines were dropped, in words.

    >>> missed_words(1), missed_words(2)
    ('1 line not shown', '2 lines not shown')
    """
    return f"{count} {'line' if count == 1 else 'lines'} not shown"


class Outlet:
    """A text file, as far as `rich` needs one, that leads to another one, and to which writing never waits.

    Shape: `most` is how many characters are kept, 0: what is written while others wait is dropped. Text without the
        end of a line, as control sequences are, is never dropped. With `counted`, the number of lines that were dropped
        stands where they would have been.
    """

    def __init__(
        self,
        file: IO[str],
        *,
        most: int = MOST_WAITING,
        counted: bool = True,
        report: Callable[[OSError], object] | None = None,
    ) -> None:
        """Write to `file`; `report` is called, in another thread, with what makes that fail, as a full disk does.

        Special: a pipe that nobody reads and a terminal that is gone are not failures.
        """
        self.failed = False
        """Whether `report` was called."""
        self._report = report
        self._terminal = file.isatty()
        self._most = most
        self.encoding: str = getattr(file, "encoding", None) or "utf-8"
        self.isatty = file.isatty
        self._counted = counted
        self._descriptor, self._put = _opened(file, self.encoding)
        self._changed = Condition()
        self._waiting: deque[str] = deque()
        self._size = 0
        self._missed = 0
        self._ended = self._gone = False
        self._thread = Thread(target=self._run, daemon=True)
        self._thread.start()

    def write(self, text: str) -> int:
        """Take text, to be written or dropped; return its length."""
        lines = text.count("\n")
        with self._changed:
            full = self._missed or (self._waiting and self._size + len(text) > self._most)
            if not self._gone and lines and full:
                self._missed += lines
            elif not self._gone:
                self._waiting.append(text)
                self._size += len(text)
            self._changed.notify()
        return len(text)

    def skip(self, lines: int) -> bool:
        """Return whether lines would be dropped, which need not be made then; they count as dropped."""
        with self._changed:
            self._missed += lines if self._missed else 0
            return self._gone or self._missed > 0

    def flush(self) -> None:
        """Do nothing: what was taken is on its way."""

    def close(self) -> int:
        """Wait a moment for what is still to be written; return the number of lines that are never shown.

        Special: a terminal that was stopped, as by Ctrl-S, goes on, so that it can be left as it was.
        """
        with self._changed:
            self._ended = True
            self._changed.notify()
        self._thread.join(_PATIENCE)
        if self._thread.is_alive() and self._descriptor is not None and self.isatty():
            _let_go_on(self._descriptor)
            self._thread.join(_PATIENCE)
        with self._changed:
            return self._missed + sum(text.count("\n") for text in self._waiting)

    def _run(self) -> None:
        while self._next():
            pass

    def _next(self) -> bool:
        """Write what is next, and return whether there can be more."""
        with self._changed:
            self._changed.wait_for(lambda: self._waiting or self._missed or self._ended)
            missed = 0 if self._waiting else self._missed
            if not self._waiting and not missed:
                return False
            text = self._waiting[0] if self._waiting else f"{missed_words(missed)}\n" if self._counted else ""
        try:
            self._put(text)
        except ValueError:  # It was closed.
            self._gone = True
        except OSError as error:
            self._gone = True
            if not (self._terminal or isinstance(error, BrokenPipeError)):
                self.failed = True
                if self._report:
                    self._report(error)
        with self._changed:
            if missed:
                self._missed -= missed
            else:
                self._waiting.popleft()
                self._size -= len(text)
            if self._gone:
                self._waiting.clear()
                self._missed = 0
        return not self._gone


def _opened(file: IO[str], encoding: str) -> tuple[int | None, Callable[[str], object]]:
    """Return the descriptor of a file if it has one, and how text is written to it."""
    with suppress(OSError, ValueError):
        file.flush()
    try:
        descriptor = file.fileno()
    except OSError:

        def put_text(text: str) -> None:
            file.write(text)
            file.flush()

        return None, put_text

    def put(text: str) -> None:
        data = text.encode(encoding, "backslashreplace")
        while data:
            try:
                data = data[os.write(descriptor, data) :]
            except BlockingIOError:
                sleep(_RETRY)

    return descriptor, put


def _let_go_on(descriptor: int) -> None:
    """Resume a terminal that was stopped."""
    try:
        import termios  # noqa: PLC0415 - POSIX only
    except ModuleNotFoundError:
        return
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTTOU})  # This may be in the background by now.
    with suppress(termios.error):
        termios.tcflow(descriptor, termios.TCOOFF)  # Only what was stopped by this can be let go on.
        termios.tcflow(descriptor, termios.TCOON)
    signal.pthread_sigmask(signal.SIG_SETMASK, mask)


@contextmanager
def shown_by(
    printer: Printer, *, most: int = MOST_WAITING, counted: bool = True, says_missed: bool = True
) -> Iterator[Outlet]:
    """Print so that the program goes on even if nobody reads what is printed; the value is the output.

    Shape: `most` and `counted` as for `Outlet`; with `says_missed`, the end says how many lines were dropped.
    """
    out = Outlet(printer.out.file, most=most, counted=counted, report=partial(_report, printer))
    with redirect_stdout(cast(IO[str], out)):
        try:
            yield out
        finally:
            missed = out.close()
            if missed and says_missed:
                printer.error(missed_words(missed))


def _report(printer: Printer, error: OSError) -> None:
    printer.error(f"the output cannot be written: {error.strerror}")
