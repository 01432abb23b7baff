"""A question before something is changed.

Laws: nothing is changed without an answer: where nobody can answer, the option that does without is named. A signal
breaks the wait for an answer off, also one that came just before it.
"""

import signal
import sys
from contextlib import suppress
from select import select
from socket import socketpair

from i7000.cli.text import Printer
from i7000.cli.words import UsageError

__all__ = ["check_can_ask", "confirmed"]

_YES = ("y", "yes")
_LONGEST_ANSWER = 80


def check_can_ask(why: str, *, yes: bool) -> None:
    """Raise `UsageError` if a question cannot be asked: there is no terminal, and no --yes; `why` it has to be."""
    if not yes and not _is_terminal():
        raise UsageError(f"{why}; there is no terminal to ask you at: give --yes")


def confirmed(why: str, question: str, printer: Printer, *, yes: bool) -> bool:
    """Return whether the answer to a question is yes, after the reason for it; with `yes`, nothing is asked.

    Errors: `UsageError` if there is no terminal.
    """
    if yes:
        return True
    check_can_ask(why or question, yes=yes)
    printer.flush()
    sys.stderr.write(f"{why}. {question} [y/N] " if why else f"{question} [y/N] ")
    sys.stderr.flush()
    try:
        return _answer().strip().lower() in _YES
    except KeyboardInterrupt:
        sys.stderr.write("\n")
        raise


def _answer() -> str:
    with suppress(OSError):  # Windows waits for sockets only, and no standard input at all can be there
        _wait_for_input()
    return sys.stdin.readline(_LONGEST_ANSWER)


def _wait_for_input() -> None:
    """Wait until a line can be read, or a signal has come: a read alone would miss one that comes just before it."""
    awake, waker = socketpair()
    with awake, waker:
        waker.setblocking(False)
        before = signal.set_wakeup_fd(waker.fileno())
        try:
            select([sys.stdin, awake], [], [])
        finally:
            signal.set_wakeup_fd(before)


def _is_terminal() -> bool:
    return sys.stdin is not None and sys.stderr is not None and sys.stdin.isatty()
