"""The live view of a steady reading: all channels as they are now, with their extremes, and what happened on the line.

Laws: it only remembers what it is shown; a thread of its own draws. When it ends, the last view stays on the terminal.
"""

from datetime import UTC, datetime

from attrs import evolve, frozen
from rich.console import Console, ConsoleOptions, RenderResult
from rich.live import Live
from rich.table import Table
from rich.text import Text

from i7000 import Reading, describe
from i7000.cli.reading import Counts
from i7000.cli.reading_text import Row, rows
from i7000.cli.station import Polled, Station, at_words
from i7000.cli.text import printable

__all__ = ["LiveView"]

_A_SECOND = 4
_WIDE = 100
"""Columns of a terminal that has room for the types."""
_COLUMNS = {"channel": "left", "value": "right", "unit": "left", "status": "left", "age": "right", "min": "right",
            "max": "right", "type": "left"}  # fmt: skip


@frozen
class _Channel:
    """A channel as it was last read, and what it has been."""

    row: Row
    seen: datetime | None = None
    """When it last had a value."""
    lowest: float | None = None
    highest: float | None = None

    def after(self, row: Row, reading: Reading | None, time: datetime) -> "_Channel":
        """Return the channel after it was read again."""
        value = None if reading is None else reading.value
        if value is None:
            return evolve(self, row=row)
        lowest = value if self.lowest is None else min(self.lowest, value)
        highest = value if self.highest is None else max(self.highest, value)
        return _Channel(row, time, lowest, highest)


class LiveView:
    """Readings as a table that is drawn again and again on a terminal."""

    def __init__(self, console: Console, title: str, counts: Counts) -> None:
        self._console, self._title, self._counts = console, title, counts
        self._modules: dict[int, tuple[_Channel, ...]] = {}
        self._reasons: dict[int, str] = {}
        self._live = Live(self, console=console, refresh_per_second=_A_SECOND, redirect_stdout=False)

    def begin(self, stations: tuple[Station, ...]) -> None:
        """Start to draw."""
        self._modules = {station.wanted.address: () for station in stations}
        self._live.start()

    def end(self) -> None:
        """Draw for the last time."""
        self._live.stop()

    def note(self, message: str) -> None:
        """Print a message above the readings."""
        self._console.print(printable(Text(f"i7000: {message}"), self._console.encoding), soft_wrap=True)

    def show(self, polled: tuple[Polled, ...]) -> None:
        """Show readings, when the view is next drawn."""
        self._modules = {it.address: _after(self._modules.get(it.address, ()), it) for it in polled}
        for it in polled:
            if it.report is not None and it.answered and it.reason not in ("", self._reasons.get(it.address)):
                self.note(f"{at_words(it.address)}: {it.reason}")
            self._reasons[it.address] = it.reason

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Draw the counters, and below them the channels of all modules."""
        now = datetime.now(UTC)
        modules = dict(self._modules)
        yield Text(f"{self._title}  {now:%H:%M:%S} UTC  Ctrl-C ends", "bold", no_wrap=True, overflow="ellipsis")
        yield Text(self._counts.words(), no_wrap=True, overflow="ellipsis")
        table = Table(box=None, pad_edge=False, header_style="bold")
        if len(modules) > 1:
            table.add_column("address", no_wrap=True)
        shown = dict([*_COLUMNS.items()][: None if options.max_width >= _WIDE else -1])
        for name, side in shown.items():
            table.add_column(name, justify=side, no_wrap=True)  # type: ignore[arg-type] # left or right
        for address, channels in modules.items():
            at = (describe.address(address),) if len(modules) > 1 else ()
            for channel in channels:
                cells = (*at, *_cells(channel, now)[: len(shown)])
                table.add_row(*(printable(Text(it), console.encoding) for it in cells), style=channel.row.style)
        yield table


def _after(before: tuple[_Channel, ...], polled: Polled) -> tuple[_Channel, ...]:
    """Return the channels of a module after it was read; the last values stay if there are no new ones."""
    found = tuple(rows(polled))
    readings = None if polled.report is None else polled.report.readings
    if readings is None:
        known = [it for it in before if it.row.type]
        return tuple(evolve(it, row=evolve(it.row, status=found[0].status)) for it in known or map(_Channel, found))
    if len(before) != len(found):
        before = tuple(map(_Channel, found))
    return tuple(it.after(row, reading, polled.time) for it, row, reading in zip(before, found, readings, strict=True))


def _cells(channel: _Channel, now: datetime) -> tuple[str, ...]:
    row = channel.row
    age = "" if channel.seen is None else f"{max(0.0, (now - channel.seen).total_seconds()):.1f} s"
    extremes = ("" if it is None else describe.value(it) for it in (channel.lowest, channel.highest))
    return (row.channel, row.value, row.unit, row.status, age, *extremes, row.type)
