"""A stream of bytes -> the frames in it, of one protocol or of both mixed.

Laws: the spans, put together, are the data but for the rest; a good frame is in one span.
"""

from collections.abc import Iterator
from typing import NamedTuple

from i7000 import dcon, modbus
from i7000.dissect.shapes import is_shaped
from i7000.errors import Fault, Noise
from i7000.settings import Protocol

__all__ = ["Span", "looks_like", "split"]


class Span(NamedTuple):
    """A frame, or noise."""

    protocol: Protocol
    """Of noise, the protocol that it resembles."""
    wire: bytes
    fault: Fault | None = None
    """Why it is noise; None for a frame."""


_TEXT = frozenset(b"\t\r\n") | frozenset(range(0x20, 0x7F))


def looks_like(wire: bytes) -> Protocol:
    """Return the protocol that bytes resemble: DCON is text."""
    return Protocol.DCON if _TEXT.issuperset(wire) else Protocol.MODBUS_RTU


def split(data: bytes, protocol: Protocol | None = None, *, last: bool = False) -> tuple[tuple[Span, ...], bytes]:
    """Split a stream into frames and noise, and what can still become a frame.

    Shape: `protocol` None is both; `last`: nothing more comes, so that there is no rest.
    """
    if protocol is not None:
        pieces, rest = _pieces(protocol, data, last=last)
        spans = (Span(protocol, it.wire, it.fault) if isinstance(it, Noise) else Span(protocol, it) for it in pieces)
        return tuple(spans), rest
    frames: list[tuple[int, int, Protocol]] = []
    end = len(data)
    for kind in (Protocol.MODBUS_RTU, Protocol.DCON):
        pieces, rest = _pieces(kind, data, last=last)
        end = min(end, len(data) - len(rest))
        at = 0
        for piece in pieces:
            start, at = at, at + len(piece.wire if isinstance(piece, Noise) else piece)
            if isinstance(piece, Noise) or (kind is Protocol.DCON and not is_shaped(piece[:-1].decode("ascii"))):
                continue
            if all(at <= first or last_ <= start for first, last_, _ in frames):
                frames.append((start, at, kind))
    frames.sort()
    end = min([end, *(start for start, stop, _ in frames if start < end < stop)])
    return tuple(_spans(data, [frame for frame in frames if frame[1] <= end], end)), data[end:]


def _pieces(protocol: Protocol, data: bytes, *, last: bool) -> tuple[tuple[bytes | Noise, ...], bytes]:
    pieces, rest = dcon.split(data) if protocol is Protocol.DCON else modbus.split(data)
    if not last or not rest:
        return tuple(pieces), rest
    if protocol is Protocol.DCON:
        return (*pieces, Noise(rest, Fault.TERMINATOR)), b""
    return (*pieces, *modbus.flush(rest)), b""


def _spans(data: bytes, frames: list[tuple[int, int, Protocol]], end: int) -> Iterator[Span]:
    at = 0
    for start, stop, protocol in (*frames, (end, end, Protocol.DCON)):
        if at < start:
            noise = data[at:start]
            yield Span(looks_like(noise), noise, Fault.LEADING if looks_like(noise) is Protocol.DCON else Fault.CRC)
        if start < stop:
            yield Span(protocol, data[start:stop])
        at = stop
