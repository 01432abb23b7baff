"""What people see of a run that takes time: an estimate first, then a progress bar on a terminal."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from i7000.cli.durations import duration_words
from i7000.cli.text import Printer

__all__ = ["Draw", "note_estimate", "progress"]

Draw = Callable[[int, str], None]
"""Draws a number of steps that were just done, and what is done now in words."""
_SIMULATED = "sim:"
"""The targets whose time is virtual: they take none."""
_BAR = 20


def note_estimate(printer: Printer, target: str, seconds: Callable[[], float], limit: float | None) -> None:
    """Print how long a run at a target takes, at most its limit.

    Shape: `seconds` returns the estimate; it is not called for a simulated target.
    Unit: seconds.
    """
    if not target.startswith(_SIMULATED):
        took = seconds()
        printer.note(f"this takes about {duration_words(took if limit is None else min(took, limit))}")


@contextmanager
def progress(printer: Printer, total: int) -> Iterator[Draw]:
    """Draw a progress bar until the end of the block, on a terminal."""
    if not printer.is_interactive:
        yield lambda _steps, _words: None
        return
    from rich.progress import BarColumn, Progress, TextColumn  # noqa: PLC0415 - it takes time

    console = printer.out if printer.out.is_terminal else printer.err
    columns = (BarColumn(bar_width=_BAR), TextColumn("{task.completed}/{task.total} {task.description}"))
    with Progress(*columns, console=console, transient=True, redirect_stdout=False, redirect_stderr=False) as bar:
        task = bar.add_task("", total=total)
        yield lambda steps, words: bar.update(task, advance=steps, description=words)
