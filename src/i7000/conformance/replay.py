"""A run once more: the frames of a report sent again, and their answers compared with those of the report.

Laws: what was sent without an answer between has the pauses of the report. What a module measures may differ: the
answers to reads of readings are compared by their length only.
"""

from collections.abc import Sequence
from itertools import pairwise

from i7000.conformance.report import Frame, Report
from i7000.frozen import frozen
from i7000.host.procedures import BytesHeard, Procedure, SendBytes, Tell
from i7000.settings import Protocol

__all__ = ["Replayed", "replay"]

_LISTEN = 0.5
_QUIET = 0.05
_BITS = 10
"""The bits of a character on the line, at least."""
_LONGEST_PAUSE = 5.0


@frozen
class Replayed:
    """What came of a check of a report, sent again.

    Shape: `sent` are the frames of one exchange, `recorded` and `received` what was heard then and now.
    """

    check: str
    sent: tuple[bytes, ...]
    recorded: bytes
    received: bytes

    @property
    def is_same(self) -> bool:
        """Whether the module answered as in the report, apart from the values of readings."""
        return self.recorded == self.received or _alike(self.recorded, self.received)


def replay(report: Report, *, timeout_scale: float = 1.0) -> Procedure[tuple[Replayed, ...]]:
    """Make the procedure that sends the frames of a report again, check by check; it tells each `Replayed`."""
    dcon_ends = b"\r" if report.module.get("protocol") == Protocol.DCON.name.lower() else b""
    baud = report.module.get("baud_rate")
    character = _BITS / baud if isinstance(baud, int) and baud > 0 else 0.0
    results = []
    for check in report.checks:
        for sent, recorded in _exchanges(check.frames):
            step = SendBytes(_pieces(sent, character), _LISTEN * timeout_scale, _QUIET * timeout_scale, dcon_ends)
            heard: BytesHeard = yield step
            result = Replayed(check.id, tuple(frame.wire for frame in sent), recorded, heard.wire)
            yield Tell(result)
            results.append(result)
    return tuple(results)


def _pieces(sent: Sequence[Frame], character: float) -> tuple[tuple[float, bytes], ...]:
    """Return frames, each with the pause before it, which is over when the last one is sent."""
    pieces = [(0.0, sent[0].wire)]
    for before, frame in pairwise(sent):
        pause = frame.seconds - before.seconds - len(before.wire) * character
        pieces.append((min(max(0.0, pause), _LONGEST_PAUSE), frame.wire))
    return tuple(pieces)


def _exchanges(frames: Sequence[Frame]) -> list[tuple[tuple[Frame, ...], bytes]]:
    """Return what was sent until something was heard, with what was heard."""
    found: list[tuple[tuple[Frame, ...], bytes]] = []
    sent: list[Frame] = []
    for frame in frames:
        if frame.sent:
            sent.append(frame)
        elif sent:
            found.append((tuple(sent), frame.wire))
            sent = []
    if sent:
        found.append((tuple(sent), b""))
    return found


def _alike(one: bytes, other: bytes) -> bool:
    """Return whether two answers have readings, and the same length."""
    if len(one) != len(other) or not one or one[:1] != other[:1]:
        return False
    return one[:1] == b">" or (one[1:2] in (b"\x03", b"\x04") and one[:3] == other[:3])
