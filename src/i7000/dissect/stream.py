"""A stream of bytes -> the frames in it, of one protocol or of both mixed.

Laws: the spans, put together, are the data but for the rest; a good frame is in one span. Noise at the end is kept in
the rest while it is shorter than a frame: it can be the beginning of what comes next.
"""

import re
from collections.abc import Iterator
from typing import NamedTuple

from i7000 import dcon, modbus
from i7000.dissect.shapes import is_shaped
from i7000.errors import Noise
from i7000.settings import Protocol

__all__ = ["Span", "looks_like", "split"]


class Span(NamedTuple):
    """A frame, or noise."""

    protocol: Protocol
    """Of noise, the protocol that it resembles."""
    wire: bytes
    is_frame: bool = True


_TEXT = frozenset(b"\t\r\n") | frozenset(range(0x20, 0x7F))


def looks_like(wire: bytes) -> Protocol:
    """Return the protocol that bytes resemble: DCON is text."""
    return Protocol.DCON if _TEXT.issuperset(wire) else Protocol.MODBUS_RTU


def split(data: bytes, protocol: Protocol | None = None, *, last: bool = False) -> tuple[tuple[Span, ...], bytes]:
    """Split a stream into frames and noise, and what can still become a frame.

    Shape: `protocol` None is both; `last`: nothing more comes, so that there is no rest.
    """
    frames: list[tuple[int, int, Protocol]] = []
    taken = bytearray(len(data))
    end = len(data)
    for kind in (Protocol.MODBUS_RTU, Protocol.DCON) if protocol is None else (protocol,):
        pieces, rest = _pieces(kind, data, last=last)
        end = min(end, len(data) - len(rest))
        at = 0
        for piece in pieces:
            start, at = at, at + len(piece.wire if isinstance(piece, Noise) else piece)
            if isinstance(piece, Noise) or (protocol is None and kind is Protocol.DCON and not _is_shaped(piece)):
                continue
            if taken.find(1, start, at) < 0:
                taken[start:at] = bytes([1]) * (at - start)
                frames.append((start, at, kind))
    frames.sort()
    end = min([end, *(start for start, stop, _ in frames if start < end < stop)])
    frames = [frame for frame in frames if frame[1] <= end]
    noise = frames[-1][1] if frames else 0
    if end < len(data) and end - noise <= modbus.LONGEST_FRAME:
        end = noise
    return tuple(_spans(data, frames, end, protocol)), data[end:]


def _is_shaped(frame: bytes) -> bool:
    return is_shaped(frame[:-1].decode("ascii"))


def _pieces(protocol: Protocol, data: bytes, *, last: bool) -> tuple[tuple[bytes | Noise, ...], bytes]:
    pieces, rest = dcon.split(data) if protocol is Protocol.DCON else modbus.split(data)
    if not last or not rest:
        return tuple(pieces), rest
    return (pieces if protocol is Protocol.DCON else (*pieces, *modbus.flush(rest))), b""


def _spans(data: bytes, frames: list[tuple[int, int, Protocol]], end: int, protocol: Protocol | None) -> Iterator[Span]:
    at = 0
    for start, stop, kind in (*frames, (end, end, Protocol.DCON)):
        for noise in _parts(data[at:start]):
            yield Span(looks_like(noise) if protocol is None else protocol, noise, is_frame=False)
        if start < stop:
            yield Span(kind, data[start:stop])
        at = stop


_LINE = re.compile(rb"[^\r\n]*+[\r\n]|[^\r\n]++")
_FRAME = re.compile(rb"(?:[%#$~@!?]|>(?=[+-]))[ -~]{2,255}[\r\n]")
"""A line among other bytes that is likely to be meant for a DCON frame."""


def _parts(noise: bytes) -> Iterator[bytes]:
    """Cut noise where lines end, and behind messages of Modbus TCP."""
    is_text = looks_like(noise) is Protocol.DCON
    at = 0
    for line in (_LINE if is_text else _FRAME).finditer(noise):
        yield from _messages(noise[at : line.start()])
        yield line[0]
        at = line.end()
    yield from _messages(noise[at:])


def _messages(noise: bytes) -> Iterator[bytes]:
    """Cut bytes behind each message that its header of Modbus TCP gives the length of."""
    while len(noise) > _HEADER and noise[2:4] == b"\0\0" and 1 < (count := int.from_bytes(noise[4:6])) < len(noise):
        yield noise[: _HEADER + count]
        noise = noise[_HEADER + count :]
    if noise:
        yield noise


_HEADER = 6
"""Bytes before those that the header of Modbus TCP counts."""
