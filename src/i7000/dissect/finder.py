r"""A line of text -> the frames in it, of both protocols, in any spelling.

Validity decides: a Modbus frame has a good CRC, a DCON frame the shape of a command or response. Ways of spelling are
tried in this order: hex, strings with escapes, plain text, hex without leading zeros, decimal numbers; the last two are
believed for good frames only.

Laws: no line raises. What is found does not overlap, and is in the order of the line. Bytes beside a good frame in the
same spelling are found too, as damaged; numbers beside it in another spelling are not, nor a number that is its length.
"""

import re
from collections.abc import Iterator
from operator import attrgetter
from typing import NamedTuple

from i7000.arguments import check_type
from i7000.dissect.found import Found, Kind
from i7000.dissect.in_bytes import SHORTEST_RUN, good_in_run, in_run
from i7000.dissect.in_text import in_text
from i7000.dissect.patterns import pattern
from i7000.dissect.plain import find_plain
from i7000.dissect.spelling import (
    Run,
    decimal_runs,
    hex_runs,
    literal_runs,
    loose_hex_runs,
    wire_of,
    without_numbers,
)

__all__ = ["Line", "find", "read_line", "without_end"]

_TWICE_WITHIN = 4096
"""Characters of the longest line in which a frame is looked for in hex and as text beside it."""


class Line(NamedTuple):
    """What a line holds."""

    found: tuple[Found, ...]
    part: bytes
    """Where no frame is good, the bytes that the line spells in hex: a part of a frame that is cut over several lines,
    perhaps."""
    start: int
    """Where they begin."""


_NOTHING = Line((), b"", 0)


def find(text: str) -> tuple[Found, ...]:
    r"""Find the frames in a line.

    Special: what is written twice, in hex and as text, is found once.

    >>> [found.wire for found in find("Command: $012    Response: !01050600")]
    [b'$012\r', b'!01050600\r']
    >>> [found.wire.hex() for found in find("12:00:01 TX 01:04:00:00:00:01:31:CA -> ok")]
    ['01040000000131ca']
    """
    check_type("text", text, str)
    text = without_end(text)
    plain = find_plain(text)
    return (Found(*plain),) if plain else read_line(text).found


def without_end(text: str) -> str:
    """Return a line without LF or CR LF at its end; a CR alone belongs to a frame."""
    return text[:-1].removesuffix("\r") if text.endswith("\n") else text


_SIGNS = pattern(r"[0-9%#$~@!>?\\&]|[A-Fa-f](?<![0-9A-Za-z].)[A-Fa-f](?:[A-Fa-f]{2})*(?![0-9A-Za-z])", re.DOTALL)
"""One of these is in every line that has a frame or bytes."""
_LEFT_OVER = pattern(r"\b(?:old_|extra |unexpected )data:")
"""Words of pymodbus, after which it repeats what it had received before."""


def read_line(text: str) -> Line:
    """Find the frames in a line, with the whole search, or the bytes that can be a part of one.

    >>> read_line("recv: 0x1 0x4 0x2").part.hex()
    '010402'
    """
    if not _SIGNS.search(text):
        return _NOTHING
    left_over = _LEFT_OVER.search(text) if "data:" in text else None
    if left_over:
        text = text[: left_over.start()]
    crossed = without_numbers(text)
    counted = _COUNTER.match(text)
    if counted:
        number = len(counted[0].rstrip())
        crossed = "z" * number + crossed[number:]
    runs = [_without_column(text, run) for run in hex_runs(crossed)]
    wires = [wire_of(run) for run in runs]
    candidates = [found for run in runs for found in in_run(text, run)]
    columns = [run for run in runs if len(run) >= SHORTEST_RUN] if len(text) <= _TWICE_WITHIN else []
    taken = bytearray(len(text))
    for found in _in_strings(text):
        if _repeats(found, text, columns):
            _take(taken, found)
        else:
            candidates.append(found)
    damaged = [found for found in candidates if found.kind is Kind.DAMAGED and _is_free(taken, found)]
    good = [found for found in candidates if found.kind is not Kind.DAMAGED]
    counter = next((found for found in good if counted and found.end <= counted.end()), None)
    if good == [counter] and any(len(found.wire) > SHORTEST_RUN for found in damaged):
        good = []
    if not good or good == [counter]:
        crossed = _without_hex(crossed, runs)
        known = set(wires)
        for numbers in (loose_hex_runs, decimal_runs):
            fresh = (run for run in numbers(crossed) if wire_of(run) not in known)
            good += [found for run in fresh for found in good_in_run(text, run)]
    good = [found for found in good if found is not counter] or good
    longest = [] if good else max(runs, key=len, default=[])
    part, start = wire_of(longest), longest[0].start if longest else 0
    damaged = [found for found in damaged if not _is_number(text, found, beside=good)]
    return Line(_chosen(text, (*_longest_first(good), *_longest_first(damaged))), part, start)


def _chosen(text: str, candidates: tuple[Found, ...]) -> tuple[Found, ...]:
    """Choose those that no other one before them overlaps."""
    if not candidates:
        return ()
    taken = bytearray(len(text))
    chosen = []
    for found in candidates:
        if _is_free(taken, found):
            _take(taken, found)
            chosen.append(found)
    return tuple(sorted(chosen, key=attrgetter("start")))


_DECIMAL_AFTER = pattern(r"(?:[ ,;\-]{1,2})\d{3}(?![0-9A-Za-z])")
_DECIMAL_BEFORE = pattern(r"(?<![0-9A-Za-z])\d{3}[ ,;\-]{1,2}$")
_DIGITS_APART = pattern(r"\d\d(?:[ ,;\-]{1,2}\d\d)*")


def _is_number(text: str, found: Found, beside: list[Found]) -> bool:
    """Return whether bytes in hex are a number beside a good frame, or a part of numbers in decimal.

    Special: what shows numbers in decimal is one of three digits among them: ``1-104-10-16``.
    """
    if beside and text[found.start : found.end].isdecimal():
        return len(found.wire) > 1
    if not _DIGITS_APART.fullmatch(text, found.start, found.end):
        return False
    before = text[max(0, found.start - len("z123, ")) : found.start]
    return bool(_DECIMAL_AFTER.match(text, found.end) or _DECIMAL_BEFORE.search(before))


_COUNTER = pattern(r"\s*#\d\d\s+(?![-=>|:,;!?]|<[-=]|[A-Za-z]*:)")
"""The number of a line: nothing stands before it, and no response behind it."""


_LETTER = pattern("[A-Fa-f]")
_DIGIT_ALONE = pattern(r"[0-9A-Fa-f](?<![0-9A-Za-z].)(?![0-9A-Za-z])", re.DOTALL)
_SHORTEST_HEX = 4
"""Bytes of a run that is hex beyond doubt if there is a letter in it."""


def _without_hex(text: str, runs: list[Run]) -> str:
    """Cross out the runs that can be nothing but hex, where all bytes have two digits."""
    if _DIGIT_ALONE.search(text):
        return text
    kept: list[str] = []
    at = 0
    for run in runs:
        start, end = run[0].start, run[-1].end
        if len(run) >= _SHORTEST_HEX and _LETTER.search(text, run[1].start, end):
            kept += (text[at:start], "z" * (end - start))
            at = end
    return "".join((*kept, text[at:])) if kept else text


_COLUMNS = pattern(r"\s\s|\t|\|")
"""What stands between the columns of a dump."""


def _without_column(text: str, run: Run) -> Run:
    """Take off the column that shows the bytes of a row as text, and has digits that could be bytes themselves."""
    if run[-1].word == 1 or len(text) > _TWICE_WITHIN:
        return run
    for at in range(len(run) - 1, 0, -1):
        end = run[at - 1].end
        if _COLUMNS.search(text, end, run[at].start) and text.find(_shown(wire_of(run[:at])), end) >= 0:
            return run[:at]
    return run


def _longest_first(found: list[Found]) -> list[Found]:
    """Sort frames by length, the longest first; those of one length stay in the order in which they were read."""
    return sorted(found, key=lambda found: len(found.wire), reverse=True)


def _is_free(taken: bytearray, found: Found) -> bool:
    return taken.find(1, found.start, found.end) < 0


def _take(taken: bytearray, found: Found) -> None:
    taken[found.start : found.end] = b"\1" * (found.end - found.start)


def _in_strings(text: str) -> Iterator[Found]:
    """Find frames in strings with escapes, and those that are written as text."""
    for run, usual in literal_runs(text):
        if not _is_text(wire_of(run)):
            yield from in_run(text, run, is_string=True) if usual else good_in_run(text, run)
    yield from in_text(text)


_PRINTABLE = bytes((*b"\r\n", *range(0x20, 0x7F)))
_DOTS = bytes(byte if 0x20 <= byte < 0x7F else ord(".") for byte in range(256))


def _is_text(wire: bytes) -> bool:
    return not wire.translate(None, _PRINTABLE)


def _repeats(found: Found, text: str, columns: list[Run]) -> bool:
    """Return whether hex elsewhere in the line has the same bytes, or those that are shown as the same text."""
    written = text[found.start : found.end]
    for run in columns:
        others = run
        if run[0].start < found.end and found.start < run[-1].end:
            others = [byte for byte in run if byte.end <= found.start or found.end <= byte.start]
        column = wire_of(others)
        if found.wire in column or written in _shown(column):
            return True
    return False


def _shown(wire: bytes) -> str:
    """Return bytes as dumps show them."""
    return wire.translate(_DOTS).decode()
