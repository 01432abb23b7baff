"""The live view: the modules as they are now, and below them what was last on the line.

Laws: `View.show` and `View.change` only remember; a thread of its own draws. Leaving the view writes to the terminal
too: where that may be stopped, the console has an `Outlet`. On a terminal it uses the alternate screen; elsewhere it
writes nothing.
"""

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from types import TracebackType
from typing import Self

from rich.console import Console, ConsoleOptions, RenderResult
from rich.live import Live
from rich.segment import Segment
from rich.text import Text

from i7000 import Noise
from i7000.cli.module_text import Modules, modules_text
from i7000.cli.text import printable
from i7000.cli.traffic import INDENT, change_line, lines
from i7000.simulator.observed import Change, Observed

__all__ = ["View"]

_REMEMBERED = 200
_A_SECOND = 4
_NARROW = 40
"""Columns below which no line is indented."""

_Drawn = list[list[Segment]]


class View:
    """A view to be shown while the simulator runs: ``with View(modules) as view: ... view.show(observed)``.

    Time: it is drawn four times a second, by another thread, which is the one that calls `modules`.
    """

    def __init__(
        self,
        modules: Callable[[], Modules],
        console: Console | None = None,
        places: Sequence[str] = (),
        notices: Mapping[str, int] | None = None,
        prompt: Callable[[], Text] | None = None,
    ) -> None:
        """Make one that shows what the alternate screen would hide.

        Shape: `places` are where hosts find the bus, `notices` what else there is to be known, and how often; `prompt`
            returns the last line of the screen.
        """
        self._modules = modules
        self._places = places
        self._notices = {} if notices is None else notices
        self._prompt = prompt
        self._seen: tuple[Observed | Change, ...] = ()
        self._counts: Counter[str] = Counter()
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

    def refresh(self) -> None:
        """Draw the view now."""
        self._live.refresh()

    def show(self, observed: Observed) -> None:
        """Show what was on the line, when the view is next drawn."""
        counts = self._counts
        counts["noise" if isinstance(observed.heard, Noise) else "requests"] += 1
        counts["answers"] += observed.answer is not None
        counts["faults"] += len(observed.faults)
        self._seen = (*self._seen[1 - _REMEMBERED :], observed)

    def change(self, change: Change) -> None:
        """Show a change of a module, when the view is next drawn."""
        self._seen = (*self._seen[1 - _REMEMBERED :], change)

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Draw the view in the room there is: modules first, but a third of it for what was on the line."""
        height = options.height or options.max_height
        width = options.max_width
        traffic = self._traffic(console, width, height)
        notices = [_notice(text, times) for text, times in list(self._notices.items())]
        prompt = [] if self._prompt is None else [printable(self._prompt(), console.encoding)]
        height -= len(prompt)
        room = height - min(len(traffic), height // 3) - 1 - len(notices)
        above = [*modules_text(self._modules(), width, room), self._title(), *notices]
        drawn = [[*_cut(text, width).render(console)] for text in above]
        drawn += traffic[max(0, len(traffic) - max(0, height - len(drawn))) :]
        if prompt:
            drawn = [*drawn[:height], *[[] for _ in range(height - len(drawn))]]
            drawn += [[*_cut(text, width).render(console)] for text in prompt]
        for line in drawn[: height + len(prompt)]:
            yield from line
            yield Segment.line()

    def _title(self) -> Text:
        """Return where hosts find the bus, and how much was on it."""
        title = Text("on the line", "bold")
        counted = [f"{name} {count}" for name in _COUNTED if (count := self._counts[name])]
        for words in (*self._places, "  ".join(counted) or ("" if self._seen else "nothing yet")):
            title.append(f"  {words}" if words else "", "not bold")
        return title

    def _traffic(self, console: Console, width: int, height: int) -> _Drawn:
        """Draw what was last on the line, as many lines as there could be room for."""
        drawn: _Drawn = []
        for seen in reversed(self._seen):
            texts = [change_line(seen)] if isinstance(seen, Change) else lines(seen)
            folded = [line for text in texts for line in _folded(printable(text, console.encoding), console, width)]
            drawn = [[*line.render(console)] for line in folded] + drawn
            if len(drawn) >= height:
                break
        return drawn


_COUNTED = "requests", "answers", "faults", "noise"


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


def _cut(text: Text, width: int) -> Text:
    """Cut a text to the width, and show that it was."""
    if len(text) <= width:
        return text
    text.right_crop(len(text) - max(0, width - len(_CUT)))
    return text.append(_CUT[:width], "dim")


_CUT = "..."
