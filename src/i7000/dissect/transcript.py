"""The lines of a log, in their order -> the frames in them, those that are cut over several lines put together.

Laws: every line that is not blank is in exactly one piece, or, with several frames, in one piece a frame. A frame is
put together only where nothing else can be made of its parts. The rows of a dump are a stream: `i7000.dissect.dump`.
"""

import re
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from i7000 import dcon, modbus
from i7000.arguments import check_type
from i7000.dissect.damage import in_place_of_a_frame, is_direction
from i7000.dissect.dump import Dump, Row, read_row
from i7000.dissect.finder import read_line, without_end
from i7000.dissect.found import Found, Kind
from i7000.dissect.in_bytes import frames_of
from i7000.dissect.plain import find_plain
from i7000.dissect.repeats import is_repeat
from i7000.dissect.spelling import without_numbers
from i7000.errors import ArgumentError
from i7000.settings import Protocol

__all__ = ["Piece", "pieces"]


_COLOUR = re.compile(r"\x1b\[[0-9;]*m")
"""What terminals take for a colour; many loggers write it around a line."""
_CLOSING = re.compile(r"[\])}>\"'`,;hH]*")
"""What closes the spelling of a byte or of a frame."""


_NUMBERED = (int, str)
_WORD = re.compile(r"[^\W\d_]+")
_FEWEST_BESIDE_WORDS = 3
"""Bytes of a part of a frame that can stand beside words which the other parts do not have."""


class Piece(NamedTuple):
    """A frame, or a line in which there is none."""

    number: int
    """The line, or the first of them."""
    last: int
    text: str
    """What was written: a part of a line, a line, or several."""
    kind: Kind | None
    """None if there is no frame."""
    wire: bytes
    same_as: int | None = None
    """The line before, if it has the same frame and a logger printed that twice; see `i7000.dissect.repeats`."""


_new = tuple.__new__
"""What a `Piece` is made with where most are made: its own ``__new__`` takes twice as long."""


class _Part(NamedTuple):
    """A line that spells bytes which are not a frame yet."""

    number: int
    text: str
    found: tuple[Found, ...]
    wire: bytes
    start: int
    """Where the bytes begin."""


def pieces(lines: Iterable[tuple[int, str]], protocol: Protocol | None = None) -> Iterator[Piece]:
    r"""Find the frames in numbered lines.

    Special: `protocol` is the one that is expected, if it is known: a line that can be meant for a frame of it is
        damaged, and not a line without a frame.
    Errors: `ArgumentError`, where the iterator comes to it, for what is not a tuple of an int and a str.

    >>> [(piece.number, piece.last, piece.wire.hex()) for piece in pieces([(1, "01 04 00 00"), (2, "00 01 31 ca")])]
    [(1, 2, '01040000000131ca')]
    """
    check_type("protocol", protocol, Protocol, optional=True)
    try:
        numbered = iter(lines)
    except TypeError:
        raise ArgumentError("lines", lines, "an iterable") from None
    return _pieces(numbered, protocol)


def _pieces(lines: Iterator[tuple[int, str]], protocol: Protocol | None) -> Iterator[Piece]:
    marked = _Repeats().marked
    parts: list[_Part] = []
    row: Row | None = None
    dump: Dump | None = None
    for numbered in lines:
        _check_numbered(numbered)
        number, line = numbered
        text = without_end(line) if line[-1:] == "\n" else line
        clean = _COLOUR.sub(_blanks, text) if "\x1b" in text else text
        if row is not None:
            before, row = row, _next_row(number, clean, row)
            if row is not None:
                if dump is None:
                    yield from map(marked, _apart(parts, protocol))
                    parts.clear()
                    dump = _begun(before, protocol)
                dump.add(row)
                yield from map(marked, _dumped(dump, last=False))
                continue
            yield from map(marked, _ended(before, dump, parts, protocol))
            dump = None
        plain = find_plain(clean)
        if plain is None:
            row = read_row(number, clean)
            if row is None:
                yield from map(marked, _of_search(number, text, clean, parts, protocol))
            continue
        if parts:
            yield from map(marked, _apart(parts, protocol))
            parts.clear()
        yield marked(_new(Piece, (number, number, text, plain[0], plain[1], None)))
    if row is not None:
        yield from map(marked, _ended(row, dump, parts, protocol))
    yield from map(marked, _apart(parts, protocol))


def _ended(row: Row, dump: Dump | None, parts: list[_Part], protocol: Protocol | None) -> Iterator[Piece]:
    """Yield what is left of a dump; or what is in its only row, which is a line like any other then."""
    if dump is not None:
        return _dumped(dump, last=True)
    return _of_search(row.number, row.text, row.text, parts, protocol)


def _check_numbered(numbered: object) -> None:
    if not isinstance(numbered, tuple) or tuple(map(type, numbered)) != _NUMBERED:
        raise ArgumentError("lines", numbered, "tuples of a number and a line (int and str)")


def _of_search(number: int, text: str, clean: str, parts: list[_Part], protocol: Protocol | None) -> Iterator[Piece]:
    """Search a line, `clean` without colours, and yield what is complete; a part of a frame is kept in `parts`."""
    found, wire, start = read_line(clean)
    if wire and (parts or _begins(wire)):
        part = _Part(number, text, found, wire, start)
        if parts and not _goes_on(parts[-1], part):
            yield from _apart(parts, protocol)
            parts.clear()
        parts.append(part)
        yield from _complete(parts, protocol)
        return
    if parts:
        yield from _apart(parts, protocol)
        parts.clear()
    yield from _of_line(number, text, found, protocol)


def _next_row(number: int, text: str, before: Row) -> Row | None:
    """Return the row of a dump that goes on where the one before ends; None if the line is not that."""
    row = read_row(number, text)
    return row if row is not None and row.goes_on(before) else None


def _begun(row: Row, protocol: Protocol | None) -> Dump:
    dump = Dump(protocol)
    dump.add(row)
    return dump


def _dumped(dump: Dump, *, last: bool) -> Iterator[Piece]:
    for rows, kind, wire in dump.frames(last=last):
        yield Piece(rows[0].number, rows[-1].number, "\n".join(row.text for row in rows), kind, wire)


def _blanks(found: re.Match[str]) -> str:
    return " " * len(found[0])


class _Repeats:
    """The last frame that was on the wire, which a logger may print again."""

    def __init__(self) -> None:
        self._first = Piece(0, 0, "", None, b"")
        self._last = 0

    def marked(self, piece: Piece) -> Piece:
        """Return the piece, marked if it is a repeat."""
        number, last, _, _, wire, _ = piece
        if wire in self._first[4] and wire and number == self._last + 1 and _repeats(self._first, piece):
            piece = piece._replace(same_as=self._first.number)
        else:
            self._first = piece
        self._last = last
        return piece


def _repeats(first: Piece, piece: Piece) -> bool:
    """Return whether a frame, or bytes from the middle of one, are those of a line before."""
    is_same = piece.wire == first.wire or piece.kind is Kind.DAMAGED
    return is_same and piece.text != first.text and is_repeat(first.text, piece.text)


def _complete(parts: list[_Part], protocol: Protocol | None) -> Iterator[Piece]:
    """Remove from the list, and yield, whole frames and what is too long for one."""
    while sum(len(part.wire) for part in parts) > modbus.LONGEST_FRAME:
        yield from _apart(parts[:1], protocol)
        del parts[0]
    whole = _whole(parts)
    if whole is not None:
        yield from _apart(parts[:whole], protocol)
        yield from _joined(parts[whole:])
        parts.clear()


def _goes_on(part: _Part, other: _Part) -> bool:
    """Return whether the frame that begins in a line can go on in the next: not where a few bytes are but a number."""
    words = _words(part), _words(other)
    fewest = min((len(it.wire) for it, before in zip((part, other), words, strict=True) if before), default=0)
    return words[0] == words[1] or fewest >= _FEWEST_BESIDE_WORDS


def _words(part: _Part) -> str:
    """Return the words before the bytes of a part; nothing if they are those for a direction."""
    before = without_numbers(part.text)[: part.start]
    return "" if is_direction(before) else " ".join(word for word in _WORD.findall(before) if word.strip("z"))


def _begins(wire: bytes) -> bool:
    """Return whether bytes are a frame of which the end is missing."""
    return wire in (modbus.split(wire)[1], dcon.split(wire)[1])


def _whole(parts: list[_Part]) -> int | None:
    """Return the index of the part from which on the parts are whole frames; None if there is no such part."""
    begins = {0: 0}
    for number, part in enumerate(parts):
        begins[max(begins) + len(part.wire)] = number + 1
    end = max(begins)
    first = None
    for _, start, stop in reversed(frames_of(b"".join(part.wire for part in parts))):
        if stop != end:
            break
        end = start
        first = begins.get(start, first)
    return first if first is not None and first < len(parts) - 1 else None


def _joined(parts: list[_Part]) -> Iterator[Piece]:
    text = "\n".join(part.text for part in parts)
    wire = b"".join(part.wire for part in parts)
    for kind, start, end in frames_of(wire):
        yield Piece(parts[0].number, parts[-1].number, text, kind, wire[start:end])


def _apart(parts: Iterable[_Part], protocol: Protocol | None) -> Iterator[Piece]:
    for part in parts:
        yield from _of_line(part.number, part.text, part.found, protocol)


def _of_line(number: int, text: str, found: tuple[Found, ...], protocol: Protocol | None) -> Iterator[Piece]:
    nothing_else = protocol is not None and all(it.kind is Kind.DAMAGED for it in found)
    damaged = in_place_of_a_frame(text, protocol) if nothing_else or not found else None
    if damaged is not None:
        yield Piece(number, number, text, Kind.DAMAGED, damaged)
        return
    if not found and text.strip():
        yield Piece(number, number, text, None, b"")
    at = 0
    for it in found:
        end = len(text) if it is found[-1] else _CLOSING.match(text, it.end).end()  # type: ignore[union-attr] # of any
        yield Piece(number, number, text[at:end], it.kind, it.wire)
        at = end
