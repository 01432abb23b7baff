"""The live view: the modules as they are now, and below them what was last on the line.

Laws: `View.show` only remembers; a thread of its own draws. Leaving the view writes to the terminal too: where that may
be stopped, the console has an `Outlet`. On a terminal it uses the alternate screen; elsewhere it writes nothing.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from types import TracebackType
from typing import Self

from rich.console import Console, ConsoleOptions, RenderResult
from rich.live import Live
from rich.segment import Segment
from rich.table import Table
from rich.text import Text

from i7000 import BaudRate, LineSettings, Protocol
from i7000.cli.text import printable
from i7000.cli.traffic import INDENT, lines, readings_text
from i7000.device import Signals, State
from i7000.device.measurement import readings
from i7000.simulator.observed import Observed

__all__ = ["View"]

_REMEMBERED = 200
_A_SECOND = 4
_WIDE = 110
"""Columns from which on every setting has its own."""
_NARROW = 40
"""Columns below which no line is indented."""

_Modules = Sequence[tuple[State, Signals]]
"""Modules, and what is on their inputs."""
_Drawn = list[list[Segment]]


class View:
    """A view to be shown while the simulator runs: ``with View(modules) as view: ... view.show(observed)``.

    Time: it is drawn four times a second, by another thread, which is the one that calls `modules`.
    """

    def __init__(
        self,
        modules: Callable[[], _Modules],
        console: Console | None = None,
        places: Sequence[str] = (),
        notices: Mapping[str, int] | None = None,
    ) -> None:
        """Make one that shows what the alternate screen would hide.

        Shape: `places` are where hosts find the bus, `notices` what else there is to be known, and how often.
        """
        self._modules = modules
        self._places = places
        self._notices = {} if notices is None else notices
        self._seen: tuple[Observed, ...] = ()
        self._live = Live(
            self,
            console=console,
            screen=True,
            refresh_per_second=_A_SECOND,
            redirect_stdout=False,
            redirect_stderr=False,
        )

    def __enter__(self) -> Self:
        self._live.start(refresh=True)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._live.stop()

    def show(self, observed: Observed) -> None:
        """Show what was on the line, when the view is next drawn."""
        self._seen = (*self._seen[1 - _REMEMBERED :], observed)

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Draw the view in the room there is: modules first, but a third of it for what was on the line."""
        height = options.height or options.max_height
        options = options.update(height=None)
        traffic = self._traffic(console, options, height)
        notices = [_notice(text, times) for text, times in list(self._notices.items())]
        room = height - min(len(traffic), height // 3) - 1 - len(notices)
        above = _table(self._modules(), console, options, room)
        title = Text("on the line", "bold")
        for words in (*self._places, *(() if traffic else ("nothing yet",))):
            title.append(f"  {words}", "not bold")
        drawn = [*above, *([*_cut(text, options.max_width).render(console)] for text in (title, *notices))]
        drawn += traffic[max(0, len(traffic) - max(0, height - len(drawn))) :]
        for line in drawn[:height]:
            yield from line
            yield Segment.line()

    def _traffic(self, console: Console, options: ConsoleOptions, height: int) -> _Drawn:
        """Draw what was last on the line, as many lines as there could be room for."""
        drawn: _Drawn = []
        for observed in reversed(self._seen):
            texts = [printable(text, console.encoding) for text in lines(observed)]
            folded = [line for text in texts for line in _folded(text, console, options.max_width)]
            drawn = [[*line.render(console)] for line in folded] + drawn
            if len(drawn) >= height:
                break
        return drawn


def _notice(text: str, times: int) -> Text:
    return Text().append(text if times == 1 else f"{text} ({times} times)", "yellow")


def _folded(text: Text, console: Console, width: int) -> Iterator[Text]:
    """Fold a line, the time by itself on the left if there is room for that."""
    if width < _NARROW:
        blanks = len(text) - len(text.plain.lstrip())
        yield from text[blanks:].wrap(console, width, overflow="fold")
        return
    time = text[:INDENT]
    for line in text[INDENT:].wrap(console, width - INDENT, overflow="fold"):
        yield time.append_text(line)
        time = Text(" " * INDENT)


# --- the modules ------------------------------------------------------------------------------------------------------


def _table(modules: _Modules, console: Console, options: ConsoleOptions, room: int) -> _Drawn:
    """Draw the modules: with all their readings if there is room, else in a line each, as many as there is room for."""
    width = options.max_width
    if len(modules) < room:
        drawn = console.render_lines(_rows(modules, wide=width >= _WIDE), options, pad=False)
        if len(drawn) <= room:
            return drawn
    shown = len(modules) if len(modules) <= room else max(0, room - 1)
    texts = list(_in_a_line(modules[:shown], width))
    if shown < len(modules):
        texts.append(_cut(Text(f"and {len(modules) - shown} more modules", "dim"), width))
    return [[*text.render(console)] for text in texts]


def _rows(modules: _Modules, *, wide: bool) -> Table:
    """Make a table; where there is little room the settings stand below the name."""
    table = Table(box=None, pad_edge=False, header_style="bold", padding=(0, 2, 0, 0))
    for title in ("", "module", "protocol", "line", "check") if wide else ("", "module"):
        table.add_column(title, no_wrap=True, overflow="crop")
    table.add_column("readings", overflow="fold")
    for state, signals in modules:
        address, name, settings = _address(state), _name(state), _settings(state)
        first = [name, *map(Text, settings)] if wide else [Text("\n").join((name, Text(" ".join(settings))))]
        table.add_row(address, *first, _now(state, signals))
    return table


def _in_a_line(modules: _Modules, width: int) -> Iterator[Text]:
    names = [Text("  ").join((_address(state), _name(state))) for state, _ in modules]
    longest = max(map(len, names), default=0)
    for name, (state, signals) in zip(names, modules, strict=True):
        name.pad_right(longest - len(name) + 2)
        yield _cut(name.append_text(_now(state, signals)), width)


def _cut(text: Text, width: int) -> Text:
    """Cut a text to the width, and show that it was."""
    if len(text) <= width:
        return text
    text.right_crop(len(text) - max(0, width - len(_CUT)))
    return text.append(_CUT[:width], "dim")


_CUT = "..."


def _address(state: State) -> Text:
    return Text(f"{state.ram.address:02X}", "bold")


def _name(state: State) -> Text:
    return Text(f"{state.eeprom.model.value}@{state.eeprom.firmware}", "cyan")


def _settings(state: State) -> tuple[str, str, str]:
    """Return the protocol, line settings and checksum that are in use, not those after the next power-on."""
    ram = state.ram
    line = _line(ram.line_settings)
    return (
        ("RTU", line, "CRC")
        if ram.protocol is Protocol.MODBUS_RTU
        else ("DCON", line, "sum" if ram.checksum else "none")
    )


def _now(state: State, signals: Signals) -> Text:
    """Return what a module is doing, and what its channels read."""
    told = Text()
    if state.eeprom.host_watchdog_timed_out:
        told.append("WATCHDOG TIMED OUT  ", "bold red")
    if state.ram.init_mode:
        told.append("INIT  ", "bold magenta")
    return told.append_text(_readings(state, signals))


def _line(settings: LineSettings) -> str:
    rate = settings.baud_rate
    told = rate.bits_per_second if isinstance(rate, BaudRate) else f"code {rate:02X}"
    return f"{told} {settings.character_format.name}"


def _readings(state: State, signals: Signals) -> Text:
    """Return the readings of the channels of the connecting mode, with the digits that the module would send."""
    types = state.eeprom.type_codes
    now = readings(state, signals)[: state.profile.channels]
    return readings_text(now, lambda channel, value: f"{value:.{types[channel].decimals}f}")
