"""A line as the tests of the listener hear it: frames one after the other."""

from collections.abc import Iterable, Mapping

from i7000 import Protocol
from i7000.dissect import Heard, Knowledge, Known, Line, hear_frame

__all__ = ["contradictions", "hear_all", "last_heard", "line_of"]


def line_of(known: Known | None = None, by_address: Mapping[int, Known] | None = None, **others: bool) -> Line:
    """A line of which nothing was heard, and on which this much is known."""
    return Line(Knowledge.given(known or Known(), by_address or {}), **others)  # type: ignore[arg-type]


def hear_all(line: Line, frames: Iterable[str | bytes]) -> tuple[Line, list[Heard]]:
    """Hear frames: by DCON those that are text, without their carriage return; by Modbus those that are bytes."""
    found = []
    for frame in frames:
        if isinstance(frame, str):
            line, heard = hear_frame(line, frame.encode() + b"\r", Protocol.DCON)
        else:
            line, heard = hear_frame(line, frame, Protocol.MODBUS_RTU)
        found.append(heard)
    return line, found


def last_heard(
    *frames: str | bytes, known: Known | None = None, by_address: Mapping[int, Known] | None = None
) -> Heard:
    """What was made of the last of some frames."""
    return hear_all(line_of(known, by_address), frames)[1][-1]


def contradictions(*frames: str | bytes, known: Known | None = None) -> list[tuple[str, ...]]:
    """The contradictions of every frame."""
    return [heard.contradictions for heard in hear_all(line_of(known), frames)[1]]
