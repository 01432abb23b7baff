"""Frames of both protocols in a run of bytes that a line spells, and what stands beside them in the same spelling."""

from collections.abc import Iterator
from functools import cache
from itertools import groupby
from typing import NamedTuple

from i7000 import dcon, modbus
from i7000.dissect.found import Found, Kind
from i7000.dissect.patterns import pattern
from i7000.dissect.shapes import is_shaped
from i7000.dissect.spelling import Byte, Run, wire_of
from i7000.errors import Noise
from i7000.modbus.request import LAST_ADDRESS

__all__ = ["SHORTEST_RUN", "begins_like_a_frame", "frames_of", "good_in_run", "in_run"]

SHORTEST_RUN = len("#01")
"""Bytes of a run that can hold a frame, or be the column of hex beside one."""
_SHORTEST_DAMAGED = modbus.SHORTEST_FRAME
"""Bytes, each a word of its own, from which on they are a damaged frame if nothing else can be made of them."""
_SHORTEST_DAMAGED_WORD = 5
"""The same for bytes in one word, which is a number more often than not."""
_CR = 0x0D
_SHORTEST_COUNTING = 8
"""Bytes 00 01 02 ... from which on they are the head of a table."""

Span = tuple[Kind, int, int]
"""A frame in bytes, and where it begins and ends."""


def frames_of(wire: bytes) -> list[Span]:
    """Find the good frames in bytes: where they are, in order, none overlapping.

    >>> frames_of(bytes.fromhex("00 01040000000131ca 2430310d"))[0]
    (<Kind.MODBUS: 'modbus'>, 1, 9)
    """
    ends = b"\r" in wire
    if ends and wire[-1] == _CR and dcon.split(wire)[0] == (wire,) and is_shaped(wire[:-1].decode()):
        return [(Kind.DCON, 0, len(wire))]
    found = _modbus_frames(wire)
    if not ends or found == [(Kind.MODBUS, 0, len(wire))]:
        return found
    taken = bytearray(len(wire))
    for _, start, end in found:
        taken[start:end] = bytes([1]) * (end - start)
    found += [span for span in _dcon_frames(wire) if taken.find(1, span[1], span[2]) < 0]
    return sorted(found, key=lambda span: span[1])


def _modbus_frames(wire: bytes) -> list[Span]:
    pieces, rest = modbus.split(wire)
    return _spans(Kind.MODBUS, (*pieces, *modbus.flush(rest)) if rest else pieces)


def _dcon_frames(wire: bytes) -> list[Span]:
    spans = _spans(Kind.DCON, dcon.split(wire)[0])
    return [span for span in spans if is_shaped(wire[span[1] : span[2] - 1].decode("ascii"))]


def _spans(kind: Kind, pieces: tuple[bytes | Noise, ...]) -> list[Span]:
    spans = []
    at = 0
    for piece in pieces:
        if isinstance(piece, Noise):
            at += len(piece.wire)
        else:
            spans.append((kind, at, at + len(piece)))
            at += len(piece)
    return spans


def good_in_run(text: str, run: Run) -> Iterator[Found]:
    """Find the good frames in a run whose bytes have all the same between them, but for blanks."""
    if len(run) >= SHORTEST_RUN:
        for kind, start, end in frames_of(wire_of(run)):
            gaps = {"".join(text[run[at].end : run[at + 1].start].split()) for at in range(start, end - 1)}
            if len(gaps) == 1:
                yield _found(kind, run, start, end)


def in_run(text: str, run: Run, *, is_string: bool = False) -> Iterator[Found]:
    """Find the frames in a run, and what stands beside them in the same spelling; a string has one spelling only."""
    if len(run) < SHORTEST_RUN:
        return
    frames = frames_of(wire_of(run))
    if sum(end - start for _, start, end in frames) == len(run):
        yield from (_found(*frame[:1], run, *frame[1:]) for frame in frames)
        return
    styles = [_Style("", 1, "")] * (len(run) - 1) if is_string else _styles(text, run)
    at = 0
    beside: set[_Style] = set()
    size = 0
    for kind, start, end in (*frames, (Kind.DAMAGED, len(run), len(run))):
        after = set(styles[start : end - 1])
        sizes = {size, end - start} - {0}
        for left in _left(run, styles, at, start, (beside, after)):
            if not _is_length(text, left, sizes):
                yield left
        if start < end:
            yield _found(kind, run, start, end)
        at, beside, size = end, after, end - start


def _found(kind: Kind, run: Run, start: int, end: int) -> Found:
    return Found(kind, wire_of(run[start:end]), run[start].start, run[end - 1].end)


def _is_length(text: str, left: Found, sizes: set[int]) -> bool:
    """Return whether a byte beside a frame is a number that says how long the frame is."""
    digits = text[left.start : left.end]
    return len(left.wire) == 1 and digits.isdecimal() and int(digits) in sizes


class _Style(NamedTuple):
    """How a byte is set off from the one before it."""

    between: str
    """The characters between the two; all blanks are the same."""
    word: int
    """How many bytes are written in a word."""
    decoration: str
    """What marks it as hex, if it is the same for both."""


_DECORATION = pattern(r"[$%=&]|0[xX]|[hH]\b")


def _styles(text: str, run: Run) -> list[_Style]:
    """Return how each byte is set off from the one before it, from the second byte on."""
    decorations = [""] * len(run)
    if _DECORATION.search(text, max(0, run[0].start - 1), run[-1].end):
        decorations = [_decoration(text, byte) for byte in run]
    return [
        _Style("".join(gap.split()) or gap[:1], max(before.word, byte.word), other.lower() if one == other else "")
        for before, byte, one, other in zip(run, run[1:], decorations, decorations[1:], strict=False)
        for gap in [text[before.end : byte.start]]
    ]


def _decoration(text: str, byte: Byte) -> str:
    """Return what marks a byte as hex: a part of its word, or else the character before it."""
    mark = _DECORATION.search(text, byte.start, byte.end) or _DECORATION.match(text, max(0, byte.start - 1))
    return mark[0] if mark else ""


def _left(
    run: Run, styles: list[_Style], start: int, end: int, beside: tuple[set[_Style], set[_Style]]
) -> Iterator[Found]:
    """Find damaged frames in the bytes from `start` to `end`, which are in no good one.

    Special: bytes that touch a good frame in one of its own styles are always found, however few. Behind another
        separator they are, if they are several in a style of the frame, and not in decimal.
    """
    before, after = beside
    while start < end and before:
        stop = start + 1
        while stop < end and styles[stop - 1] in before:
            stop += 1
        if styles[start - 1] not in before and not _is_a_part(run[start:stop], styles[start - 1]):
            break
        yield _found(Kind.DAMAGED, run, start, stop)
        start = stop
    first = end
    while first > start and after:
        head = first - 1
        while head > start and styles[head - 1] in after:
            head -= 1
        if styles[first - 1] not in after and not _is_a_part(run[head:first], styles[first - 1]):
            break
        first = head
    yield from _damaged(run, styles, start, first)
    if first < end:
        yield _found(Kind.DAMAGED, run, first, end)


def _is_a_part(run: Run, apart: _Style) -> bool:
    """Return whether bytes behind another separator are a part of a frame, and not numbers."""
    letters = any(max(divmod(byte.value, 16)) > _LAST_DECIMAL for byte in run)
    return len(run) > 1 and letters and not apart.between.strip(_SEPARATORS)


_SEPARATORS = " ,;|/:-"
_LAST_DECIMAL = 9
"""The last digit that hex and decimal have in common."""


def _damaged(run: Run, styles: list[_Style], start: int, end: int) -> Iterator[Found]:
    """Cut bytes where their style changes; the longer piece has the byte between two."""
    if end - start < _SHORTEST_DAMAGED:
        return
    pieces = [list(places) for _, places in groupby(range(start + 1, end), key=lambda at: _grouped(styles[at - 1]))]
    taken: set[int] = set()
    for places in sorted(pieces, key=len, reverse=True):
        piece = [at for at in range(places[0] - 1, places[-1] + 1) if at not in taken]
        taken.update(piece)
        if piece and _may_be_a_frame(run[piece[0] : piece[-1] + 1]):
            yield _found(Kind.DAMAGED, run, piece[0], piece[-1] + 1)


def _grouped(style: _Style) -> _Style:
    """Words of several bytes with blanks between are one style: ``0104 0000``."""
    return style._replace(between=style.between.strip(" "))


@cache
def _functions() -> frozenset[int]:
    """Return all function codes, of requests and of exceptions."""
    return frozenset(request.function | bit for request in modbus.REQUESTS for bit in (0, 0x80))


def begins_like_a_frame(run: Run) -> bool:
    """Return whether a run begins with the address of a module and a function code."""
    return 0 < run[0].value <= LAST_ADDRESS and run[1].value in _functions()


def _may_be_a_frame(run: Run) -> bool:
    if len(run) >= _SHORTEST_COUNTING and wire_of(run) == bytes(range(min(len(run), 256))):
        return False
    if max(byte.word for byte in run) == 1:
        return len(run) >= _SHORTEST_DAMAGED
    return len(run) >= _SHORTEST_DAMAGED_WORD and begins_like_a_frame(run)
