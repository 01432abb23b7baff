"""The times of frames on a line: when each began and ended, and which of them break a rule.

Pass bytes as they arrive, with the time of a clock: `hear_at` and `flush_at` do what `hear` and `flush` do, and add the
times.

Laws: a byte has the time of the piece in which it arrived, which is later than it was on the line: adapters and
operating systems collect bytes, often for 16 ms. What that can explain is not noted.
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from attrs import field

from i7000.arguments import LARGEST_FLOAT, as_bytes, check_clock, check_fields, check_seconds, check_type
from i7000.dissect.heard import Direction, Heard, Line
from i7000.dissect.line import flush, hear
from i7000.errors import InvalidValueError
from i7000.frozen import frozen
from i7000.settings import Protocol

__all__ = ["TimedHeard", "TimedLine", "Times", "flush_at", "hear_at", "taken"]

_LUMP = 0.02
"""The seconds that adapters can hold bytes back."""
_PATIENCE = 0.2
"""The seconds that hosts usually wait for the beginning of a response: the default of `i7000.host.Policy`."""


class Times(NamedTuple):
    """The times of a frame, in seconds."""

    began: float
    """The time of its first byte."""
    ended: float
    """The time of its last byte."""
    gap: float = 0.0
    """The longest time without a byte inside it."""
    resolution: float = 0.0
    """How far a time is from the next that could have been written; 0 for a clock that is fine enough."""

    @classmethod
    def of(cls, pieces: Sequence[float]) -> "Times":
        """Return the times of a frame from those of its pieces."""
        return cls(pieces[0], pieces[-1], max((later - earlier for earlier, later in pairwise(pieces)), default=0.0))


@frozen
class TimedHeard:
    """A frame, or bytes that are not one, with its times.

    Unit: seconds.
    """

    heard: Heard
    began: float
    """The time of its first byte."""
    ended: float
    """The time of its last byte."""
    after: float | None
    """The time from the end of the previous frame to its beginning; None for the first frame."""
    gap: float
    """The longest time without a byte inside it."""
    notes: tuple[str, ...] = ()
    """The rules that it breaks, in words."""


@frozen
class TimedLine:
    """A line with times: what was heard, and when.

    Errors: `InvalidValueError` for fields of other types.
    """

    line: Line = field(factory=Line)
    arrivals: tuple[tuple[float, int], ...] = field(default=(), kw_only=True)
    """The time and the number of bytes of each piece that is still in `line.rest`."""
    last: TimedHeard | None = field(default=None, kw_only=True)
    clock: float = field(default=-LARGEST_FLOAT, kw_only=True)
    """The time of the last call."""

    def __attrs_post_init__(self) -> None:
        check_fields(self, {"line": (Line,), "arrivals": (tuple,), "last": (TimedHeard, type(None))})
        check_seconds("clock", self.clock)
        if sum(count for _, count in self.arrivals) != len(self.line.rest):
            raise InvalidValueError("arrivals", self.arrivals, "the pieces of the rest of the line", "")


def hear_at(
    timed: TimedLine, data: bytes, now: float, *, sent: bool | None = None
) -> tuple[TimedLine, tuple[TimedHeard, ...]]:
    r"""Read the next bytes of a stream, which arrived at `now`.

    Shape: as for `hear`.
    Errors: `InvalidValueError` for a time that is not finite; `StateError` for a time before the last call.

    >>> timed, heard = hear_at(TimedLine(Line(protocol=Protocol.DCON)), b"#**\r", 5.0)
    >>> timed, heard = hear_at(timed, b"$014\r", 5.0005)
    >>> heard[0].notes
    ('0.5 ms after SynchronizedSampling, frame 1: modules need 2 ms',)
    """
    check_type("timed", timed, TimedLine)
    data = as_bytes("data", data)
    check_clock(now, timed.clock)
    line, found = hear(timed.line, data, sent=sent)
    arrivals = (*timed.arrivals, (now, len(data))) if data else timed.arrivals
    return _timed(line, arrivals, timed.last, found, now)


def flush_at(timed: TimedLine, now: float, *, sent: bool | None = None) -> tuple[TimedLine, tuple[TimedHeard, ...]]:
    """Read what is left in the line, a frame or not, because nothing more comes for now.

    Errors: as for `hear_at`.
    """
    check_type("timed", timed, TimedLine)
    check_clock(now, timed.clock)
    line, found = flush(timed.line, sent=sent)
    return _timed(line, timed.arrivals, timed.last, found, now)


def _timed(
    line: Line, arrivals: tuple[tuple[float, int], ...], last: TimedHeard | None, found: tuple[Heard, ...], now: float
) -> tuple[TimedLine, tuple[TimedHeard, ...]]:
    left = list(arrivals)
    told = []
    for heard in found:
        began, ended, gap, _ = Times.of(taken(left, len(heard.wire)))
        after = None if last is None else began - last.ended
        notes = (*_pause_notes(heard, last, after), *_gap_notes(heard, gap), *_late_notes(heard, last, after))
        last = TimedHeard(heard, began, ended, after, gap, notes)
        told.append(last)
    return TimedLine(line, arrivals=tuple(left), last=last, clock=now), tuple(told)


def taken(arrivals: list[tuple[float, int]], count: int) -> list[float]:
    """Remove so many bytes from the first pieces, and return the times of those pieces."""
    times = []
    while count:
        time, size = arrivals[0]
        times.append(time)
        if size > count:
            arrivals[0] = (time, size - count)
            break
        del arrivals[0]
        count -= size
    return times


_HOST = (Direction.COMMAND, Direction.REQUEST)


def _pause_notes(heard: Heard, last: TimedHeard | None, after: float | None) -> tuple[str, ...]:
    """Return a note on a frame that the host sends before the pause of its last one is over."""
    if last is None or after is None or heard.direction not in _HOST or len(last.heard.meanings) != 1:
        return ()
    (meaning,) = last.heard.meanings
    if after >= meaning.pause:
        return ()
    name, where = type(meaning.message).__name__, last.heard.place.where
    return (f"{after * 1000:.3g} ms after {name}, {where}: modules need {meaning.pause * 1000:.5g} ms",)


def _gap_notes(heard: Heard, gap: float) -> tuple[str, ...]:
    """Return a note on a gap that Modbus RTU does not allow."""
    if heard.protocol is not Protocol.MODBUS_RTU or gap <= _LUMP:
        return ()
    return (f"a gap of {gap * 1000:.3g} ms inside the frame: Modbus RTU allows 1.5 characters",)


def _late_notes(heard: Heard, last: TimedHeard | None, after: float | None) -> tuple[str, ...]:
    """Return a note on a response that many hosts no longer wait for."""
    if heard.direction is not Direction.RESPONSE or last is None or after is None or after <= _PATIENCE:
        return ()
    if last.heard.direction not in _HOST:
        return ()
    return (f"late: it began {after:.3g} s after the frame that it answers; hosts usually wait {_PATIENCE} s",)
