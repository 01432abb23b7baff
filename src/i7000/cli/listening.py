"""A listener at a port: it reads, decodes, shows and records until its end.

Laws: what is heard is recorded before it is shown; output that nobody reads is dropped and counted, so that the port is
always read.
"""

from collections.abc import Iterable, Iterator
from contextlib import ExitStack
from datetime import UTC, datetime
from time import monotonic, time
from typing import TYPE_CHECKING

from attrs import evolve, frozen

from i7000.cli.frame_text import frame_lines
from i7000.cli.outlet import shown_by
from i7000.cli.port import ended_by_signals, opened
from i7000.cli.readers import Read
from i7000.cli.recorded import RecordOptions, Write, recorded
from i7000.cli.records import frame_words, json_of
from i7000.cli.text import Printer
from i7000.cli.words import LineError
from i7000.dissect import Direction, Line
from i7000.dissect.timing import TimedHeard, TimedLine, Times, flush_at, hear_at
from i7000.recording import Carried
from i7000.settings import LineSettings
from i7000_cli import FAILED

if TYPE_CHECKING:
    from i7000.cli.judging import Judging

__all__ = ["Listener", "Listening", "run", "show"]

_SILENCE = 0.25
"""The seconds without a byte after which what was heard is complete."""
_MOST_WAITING = 1 << 22
"""Characters of output that are kept while nobody reads it."""
_SENT = {Direction.COMMAND: True, Direction.REQUEST: True, Direction.ECHO: True, Direction.RESPONSE: False, None: None}
_ARROWS: dict[bool | None, str] = {True: "->", False: "<-", None: "--"}


class Listener:
    """A line that is listened to.

    Unit: times in seconds; `began` is the date and time of second 0, in seconds since 1970.
    """

    def __init__(
        self,
        line: Line,
        began: float,
        write: Write | None,
    ) -> None:
        self.timed = TimedLine(line)
        self._began = began
        self._write = write

    def hear(self, data: bytes, now: float) -> Iterator[Read]:
        """Take bytes that came at `now`, and yield the frames that are complete."""
        self.timed, found = hear_at(self.timed, data, now)
        return self._reads(found)

    def silence(self, now: float) -> Iterator[Read]:
        """Take what was heard as complete, and yield its frames."""
        self.timed, found = flush_at(self.timed, now)
        return self._reads(found)

    def _reads(self, found: tuple[TimedHeard, ...]) -> Iterator[Read]:
        for it in found:
            heard = evolve(it.heard, notes=(*it.heard.notes, *it.notes))
            sent = _SENT[heard.direction]
            if self._write:
                self._write(Carried(it.began, heard.wire, sent, heard.protocol, None, it.notes))
            time = datetime.fromtimestamp(self._began + it.began, UTC)
            after = "" if it.after is None else f"+{it.after:.3f} s"
            frame = frame_words(heard.wire, heard.protocol)
            text = f"{time:%H:%M:%S}.{time.microsecond // 1000:03}  {after:>12}  {_ARROWS[sent]} {frame}"
            number = heard.place.number
            times = Times(it.began, it.ended, it.gap)
            knowledge = self.timed.line.knowledge
            yield Read(number, number, number, text, time.isoformat(), heard, None, None, knowledge, times)


# --- at a port --------------------------------------------------------------------------------------------------------


@frozen
class Listening:
    """What to listen to, what to show, and where to record it."""

    target: str
    settings: LineSettings
    line: Line
    addresses: frozenset[int]
    """The addresses to show; all if there are none."""
    names: frozenset[str]
    """The names of the messages to show; all if there are none."""
    seconds: float
    recording: RecordOptions
    judging: "Judging | None" = None
    """What judges the frames, and prints findings in their place."""

    def shows(self, read: Read) -> bool:
        """Return whether a frame is shown; one that cannot be decoded has no name."""
        heard = read.heard
        if heard is None or (self.addresses and heard.address not in self.addresses):
            return False
        return not self.names or not self.names.isdisjoint(type(it.message).__name__ for it in heard.meanings)


def run(listening: Listening, printer: Printer) -> int:
    """Listen until the time is over, a signal asks for the end, or the port is lost; return the exit code.

    Errors: `UsageError` for a text that is not a target, `LineError` for a port that cannot be opened or is lost,
        `OSError` for a file that cannot be created.
    """
    from i7000.link.port import read  # noqa: PLC0415 - it needs pyserial

    with ExitStack() as stack:
        port = stack.enter_context(opened(listening.target, listening.settings))
        began, start = time(), monotonic()
        write = stack.enter_context(
            recorded(
                listening.recording,
                program="i7000 listen",
                target=listening.target,
                began=began,
                report=printer.error,
            )
        )
        listener = Listener(listening.line, began, write)
        judging = listening.judging
        out = stack.enter_context(shown_by(printer, most=_MOST_WAITING))
        ending = stack.enter_context(ended_by_signals())
        now = 0.0
        code = 0
        if judging:
            judging.begin(listening.target)
        try:
            while not ending.number and now < listening.seconds:
                data = read(port, min(_SILENCE, listening.seconds - now))
                now = monotonic() - start
                show(listener.hear(data, now) if data else listener.silence(now), listening, printer)
            code = 128 + ending.number if ending.number else 0
        except OSError as error:
            code = LineError.code
            raise LineError(error) from None
        finally:
            show(listener.silence(now), listening, printer)
            if judging:
                code = judging.end(code)
    return FAILED if out.failed else code


def show(reads: Iterable[Read], listening: Listening, printer: Printer) -> None:
    """Print what was read, or judge it."""
    if listening.judging:
        for read in reads:
            listening.judging.take(read)
        return
    for read in filter(listening.shows, reads):
        if printer.json:
            printer.write(json_of(read))
        else:
            unknown = read.heard is not None and listening.line.knowledge.of(read.heard.address).known.model is None
            printer.lines(frame_lines(read, models=unknown))
