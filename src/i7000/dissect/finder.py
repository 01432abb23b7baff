r"""A line of text -> the frames in it, of both protocols, in any spelling.

Validity decides: a Modbus frame has a good CRC, a DCON frame the shape of a command or response. Ways of spelling are
tried in this order: hex, strings with escapes, plain text, hex without leading zeros, decimal numbers; the last two are
believed for good frames only.

Laws: no line raises. What is found does not overlap, and is in the order of the line. Bytes beside a good frame in the
same spelling are found too, as damaged; numbers beside it in another spelling are not.
"""

import re
from collections.abc import Iterable, Iterator
from enum import StrEnum
from itertools import groupby
from typing import NamedTuple

from attrs import frozen

from i7000 import dcon, modbus
from i7000.dissect.shapes import is_shaped, report
from i7000.dissect.spelling import Run, decimal_runs, hex_runs, literal_runs, loose_hex_runs, text_of
from i7000.errors import Noise

__all__ = ["Found", "Kind", "bytes_of", "find", "frames_of"]


class Kind(StrEnum):
    """What a piece of a line is."""

    DCON = "dcon"
    MODBUS = "modbus"
    DAMAGED = "damaged"
    """It stands where a frame could, and is none of either protocol."""


@frozen
class Found:
    """A frame, or what is left of one, and where in the line it stands."""

    kind: Kind
    wire: bytes
    """All of it, with CRC or carriage return; plain text without a carriage return is given one."""
    start: int
    end: int

    def overlaps(self, other: "Found") -> bool:
        """Return whether both take characters from the same place."""
        return self.start < other.end and other.start < self.end


def find(text: str) -> tuple[Found, ...]:
    r"""Find the frames in a line.

    Special: what is written twice, in hex and as text, is found once.

    >>> [found.wire for found in find("Command: $012    Response: !01050600")]
    [b'$012\r', b'!01050600\r']
    >>> [found.wire.hex() for found in find("12:00:01 TX 01:04:00:00:00:01:31:CA -> ok")]
    ['01040000000131ca']
    """
    runs = list(hex_runs(text))
    columns = [_wire(run) for run in runs if len(run) >= _SHORTEST_COLUMN]
    candidates = list(_in_runs(text, runs))
    repeated: list[Found] = []
    for found in _in_strings(text):
        (repeated if _repeats(found, text, columns) else candidates).append(found)
    if all(found.kind is Kind.DAMAGED for found in candidates) and not repeated:
        for numbers in (loose_hex_runs, decimal_runs):
            candidates += [it for it in _in_runs(text, numbers(text)) if it.kind is not Kind.DAMAGED]
    taken: list[Found] = []
    for found in sorted(candidates, key=_worth, reverse=True):
        if found.kind is Kind.DAMAGED and any(map(found.overlaps, repeated)):
            continue
        if not any(map(found.overlaps, taken)):
            taken.append(found)
    return tuple(sorted(taken, key=lambda found: found.start))


def bytes_of(text: str) -> bytes:
    """Return the bytes that a line spells in hex, for a frame that is cut over several lines; empty if there are none.

    >>> bytes_of("recv: 0x1 0x4 0x2").hex()
    '010402'
    """
    return _wire(max(hex_runs(text), key=len, default=[]))


def _worth(found: Found) -> tuple[bool, int]:
    """Good before damaged, then the longer; of as long ones the first that was read stays first."""
    return found.kind is not Kind.DAMAGED, len(found.wire)


def _in_strings(text: str) -> Iterator[Found]:
    """Find frames in strings with escapes, and those that are written as text."""
    for run, usual in literal_runs(text):
        if not _is_text(_wire(run)):
            yield from (found for found in _in_run(text, run) if usual or found.kind is not Kind.DAMAGED)
    yield from _in_text(text)


_SHORTEST_COLUMN = len("#01")
_DOTS = bytes(byte if 0x20 <= byte < 0x7F else ord(".") for byte in range(256))


def _repeats(found: Found, text: str, columns: Iterable[bytes]) -> bool:
    """Return whether a hex run of the line has the same bytes, or those that are shown as the same text."""
    shown = text[found.start : found.end].encode("utf-8", "surrogateescape")
    return any(found.wire in column or shown in column.translate(_DOTS) for column in columns)


# --- frames in a run of bytes -----------------------------------------------------------------------------------------

_SHORTEST_DAMAGED = modbus.SHORTEST_FRAME
"""Bytes, each a word of its own, from which on they are a damaged frame if nothing else can be made of them."""
_SHORTEST_DAMAGED_WORD = 5
"""The same for bytes in one word, which is a number more often than not."""
_FUNCTIONS = frozenset(request.function | bit for request in modbus.REQUESTS for bit in (0, 0x80))


_DECORATION = re.compile(r"[$%=&]|0[xX]|[hH]\b")


def _wire(run: Run) -> bytes:
    return bytes(byte.value for byte in run)


def _is_text(wire: bytes) -> bool:
    return all(0x20 <= byte < 0x7F or byte in b"\r\n" for byte in wire)


def _in_runs(text: str, runs: Iterable[Run]) -> Iterator[Found]:
    for run in runs:
        yield from _in_run(text, run)


def _in_run(text: str, run: Run) -> Iterator[Found]:
    """Find the frames in a run, and what stands beside them in the same spelling."""
    if len(run) < _SHORTEST_COLUMN:
        return
    styles = [_style(text, run, at) for at in range(1, len(run))]
    frames = list(frames_of(_wire(run)))
    at = 0
    beside: set[_Style] = set()
    for kind, start, end in (*frames, (Kind.DAMAGED, len(run), len(run))):
        after = set(styles[start : end - 1])
        yield from _left(run, styles, at, start, (beside, after))
        if start < end:
            yield _one(kind, run, start, end)
        at, beside = end, after


def _one(kind: Kind, run: Run, start: int, end: int) -> Found:
    return Found(kind, _wire(run[start:end]), run[start].start, run[end - 1].end)


class _Style(NamedTuple):
    """How a byte is set off from the one before it."""

    between: str
    """The characters between the two; all blanks are the same."""
    word: int
    """How many bytes are written in a word."""
    decoration: str
    """What marks it as hex, if it is the same for both."""


def _style(text: str, run: Run, at: int) -> _Style:
    before, byte = run[at - 1], run[at]
    gap = text[before.end : byte.start]
    mark = _DECORATION.search(text, max(0, byte.start - 1), byte.end)
    same = _DECORATION.search(text, max(0, before.start - 1), before.end)
    decoration = mark[0].lower() if mark and same and mark[0] == same[0] else ""
    return _Style("".join(gap.split()) or gap[:1], max(before.word, byte.word), decoration)


def frames_of(wire: bytes) -> Iterator[tuple[Kind, int, int]]:
    """Find the good frames in bytes: where they are, in order, none overlapping."""
    found = list(_spans_of(Kind.MODBUS, wire))
    for kind, start, end in _spans_of(Kind.DCON, wire):
        if all(end <= other_start or other_end <= start for _, other_start, other_end in found):
            found.append((kind, start, end))
    yield from sorted(found, key=lambda span: span[1])


def _spans_of(kind: Kind, wire: bytes) -> Iterator[tuple[Kind, int, int]]:
    split = dcon.split if kind is Kind.DCON else modbus.split
    pieces, rest = split(wire)
    at = 0
    for piece in (*pieces, *(modbus.flush(rest) if kind is Kind.MODBUS else ())):
        length = len(piece.wire if isinstance(piece, Noise) else piece)
        if not isinstance(piece, Noise) and (kind is Kind.MODBUS or is_shaped(piece[:-1].decode("ascii"))):
            yield kind, at, at + length
        at += length


def _left(
    run: Run, styles: list[_Style], start: int, end: int, beside: tuple[set[_Style], set[_Style]]
) -> Iterator[Found]:
    """Find damaged frames in the bytes from `start` to `end`, which are in no good one.

    Special: bytes that touch a good frame in one of its own styles are always found, however few.
    """
    before, after = beside
    while start < end and before and styles[start - 1] in before:
        stop = start + 1
        while stop < end and styles[stop - 1] in before:
            stop += 1
        yield _one(Kind.DAMAGED, run, start, stop)
        start, before = stop, set()
    first = end
    while first > start and after and styles[first - 1] in after:
        first -= 1
    yield from _damaged(run, styles, start, first)
    if first < end:
        yield _one(Kind.DAMAGED, run, first, end)


def _damaged(run: Run, styles: list[_Style], start: int, end: int) -> Iterator[Found]:
    """Cut bytes where their style changes; the longer piece has the byte between two."""
    if end - start == 1:
        return
    pieces = [list(places) for _, places in groupby(range(start + 1, end), key=lambda at: _grouped(styles[at - 1]))]
    taken: set[int] = set()
    for places in sorted(pieces, key=len, reverse=True):
        piece = [at for at in range(places[0] - 1, places[-1] + 1) if at not in taken]
        taken.update(piece)
        if piece and _may_be_a_frame(run[piece[0] : piece[-1] + 1]):
            yield _one(Kind.DAMAGED, run, piece[0], piece[-1] + 1)


def _grouped(style: _Style) -> _Style:
    """Words of several bytes with blanks between are one style: ``0104 0000``."""
    return style._replace(between=style.between.strip())


def _may_be_a_frame(run: Run) -> bool:
    if max(byte.word for byte in run) == 1:
        return len(run) >= _SHORTEST_DAMAGED
    return len(run) >= _SHORTEST_DAMAGED_WORD and 0 < run[0].value < 0xF8 and run[1].value in _FUNCTIONS


# --- DCON frames that are written as text -----------------------------------------------------------------------------

_LEADING = re.compile(r"[%#$~@!>?]")
_MAY_LEAD = re.compile(r"[%#$~@!>?\\]|&gt;")
_UP_TO_END = re.compile(r".[ -\"&-=A-}]*(?=[\r\n])")
_WORD = re.compile(r".[!-~]*")
_CLOSING = "\"'`)]}>,;.|"
_ADDRESSED = re.compile(r".(?:\*\*|[0-9A-F]{2}|[0-9][0-9a-f]|[0-9a-f][0-9])")
_NUMBERED = re.compile(r">[+-]\d")


def _in_text(text: str) -> Iterator[Found]:
    """Find frames from a leading character to a carriage return, a blank, a quotation mark or a bracket."""
    if not _MAY_LEAD.search(text):
        return
    characters, places = text_of(text)
    at = 0
    while leading := _LEADING.search(characters, at):
        start = leading.start()
        at = start + 1
        kind, end = _ending(characters, start)
        if kind is not None:
            closing = characters[end : end + 1]
            spelled = places[min(end + 1, len(characters))] - places[end] > 1
            feed = closing == "\n" and spelled
            closed = closing in ("\r", "\n")
            wire = characters[start:end].encode("ascii") + (b"\n" if feed else b"\r")
            yield Found(Kind.DAMAGED if feed else kind, wire, places[start], places[end + closed])
            at = end


def _ending(characters: str, start: int) -> tuple[Kind | None, int]:
    """Where the frame that starts here ends, and what it is; None if there is none."""
    written = _UP_TO_END.match(characters, start)
    if characters[start] == ">":
        found = report().match(characters, start)
        if found:
            return Kind.DCON, found.end()
        if not _NUMBERED.match(characters, start):
            return None, start
    if written:
        return (Kind.DCON if is_shaped(written[0]) else _kind_of_damage(characters, start)), written.end()
    if start and characters[start - 1].isalnum():
        return None, start
    word = _WORD.match(characters, start)
    longest = word.end() if word else start + 1
    shortest = start + len(characters[start:longest].rstrip(_CLOSING))
    for end in range(shortest, longest + 1):
        if is_shaped(characters[start:end]):
            return Kind.DCON, end
    return _kind_of_damage(characters, start), shortest


def _kind_of_damage(characters: str, start: int) -> Kind | None:
    return Kind.DAMAGED if _ADDRESSED.match(characters, start) or _NUMBERED.match(characters, start) else None
