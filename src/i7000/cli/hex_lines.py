r"""Lines of a log -> Modbus frames, which are written in hex.

Bytes are pairs of hex digits, in any of the usual ways: ``01 04``, ``0104``, ``0x01, 0x04``, ``01:04``, ``01-04``,
``01h 04h``, ``\x01\x04``, ``b'\x01F'``. What loggers put around them is passed over: dates, times, words, brackets.

Laws: no line raises, and none is lost: the pieces of a line, put together, are the line but for blanks.
"""

import re
from collections.abc import Iterable, Iterator

from i7000 import DecodeError, Noise, modbus
from i7000.cli.log import Line, shown

__all__ = ["hex_pieces", "numbered_hex_pieces"]

_Bytes = list[tuple[int, int, int]]
"""Bytes of a line: the value of each, and where in the line it begins and ends."""

_DATE = r"\d{4}([-/.])\d\d\1\d\d"
_TIME = r"\d\d?:\d\d(?::\d\d(?:[.,]\d+)?)?(?:Z|[-+]\d\d:?\d\d)?"
_WHEN = rf"(?:{_DATE}(?:[T_ ]{_TIME})?|{_TIME})"
_DATES = re.compile(rf"(?<![\w:.-]){_WHEN}(?!\w|[:-]\w)")
_PLAIN = re.compile(
    rf"""
    (?: [\[(]? {_WHEN} [\])]? [\s|,;]+ )?
    (?: [TR][Xx] (?: :[ ]* | [ ]+ ) | (?: [-=]{{0,2}}> | <[-=]{{0,2}} | >> | << ) [ ]* )?
    (?P<frame> [0-9A-Fa-f]{{2}} (?P<gap> [ :-] | ,[ ]? | ) (?: [0-9A-Fa-f]{{2}} (?P=gap) )* [0-9A-Fa-f]{{2}} )
    [ ]* \r?\n?
    """,
    re.VERBOSE | re.ASCII,
)
"""A line of nothing but the time, the direction and one run of bytes, as most are."""
_WORD = re.compile(r"[0-9A-Za-z\\]+")
_HEX_WORD = re.compile(r"(?:0[xX])?((?:[0-9A-Fa-f]{2})+)[hH]?")
_ESCAPED_WORD = re.compile(r"(?:\\x[0-9A-Fa-f]{2})+")
_PAIR = re.compile(r"..")
_ESCAPED = re.compile(r"\\x..")
_BETWEEN = re.compile(r"(?P<blank>\s+)|(?P<comma>\s*[,;]\s*)|(?P<colon>:)|(?P<dash>-)")
_LITERAL = re.compile(r"""\bb'((?:[^'\\]|\\.)*)'|\bb"((?:[^"\\]|\\.)*)\"""")
_CHARACTER = re.compile(r"(?s)\\x([0-9A-Fa-f]{2})|\\?(.)")
_ESCAPES = {r"\n": 10, r"\r": 13, r"\t": 9}
_CLOSING = " \t\r\n'\")]}>;,."


def hex_pieces(lines: Iterable[bytes]) -> Iterator[Line]:
    r"""Find the frames in each line; a line with several, one behind the other, is as many pieces.

    >>> [line.frame.hex() for line in hex_pieces([b"12:00:01 TX: 01 46 00 12 60\n"])]
    ['0146001260']
    """
    return numbered_hex_pieces(enumerate(lines, 1))


def numbered_hex_pieces(lines: Iterable[tuple[int, bytes]]) -> Iterator[Line]:
    """Find the frames in lines whose numbers are known."""
    for number, line in lines:
        text = line.decode("utf-8", "surrogateescape")
        plain = _PLAIN.fullmatch(text)
        if plain:
            frame = bytes.fromhex(plain["frame"].replace(plain["gap"] or " ", ""))
            if _is_frame(frame):
                yield Line(number, shown(text).rstrip(), frame)
                continue
        yield from _pieces(number, text)


def _pieces(number: int, text: str) -> Iterator[Line]:
    if not text.strip():
        return
    found = _best(text)
    if found is None:
        yield Line(number, shown(text), None)
        return
    at = cut = 0
    for frame in _frames(_wire(found)):
        at += len(frame)
        end = found[at][1] if at < len(found) else len(text)
        yield Line(number, shown(text[cut:end]).rstrip(), frame)
        cut = end


def _best(text: str) -> _Bytes | None:
    """Choose the bytes that are good frames, or hold one; or else the most, where they are enough or end the line."""
    end = len(text.rstrip(_CLOSING))
    found = [one for one in (*_runs(text), *_literals(text)) if len(one) >= modbus.SHORTEST_FRAME or one[-1][2] >= end]
    return max(found, key=lambda one: (*_goodness(_wire(one)), len(one)), default=None)


def _wire(found: _Bytes) -> bytes:
    return bytes(value for value, _, _ in found)


def _goodness(wire: bytes) -> tuple[bool, bool]:
    good = [_is_frame(frame) for frame in _frames(wire)]
    return all(good), any(good)


def _is_frame(wire: bytes) -> bool:
    try:
        modbus.unseal(wire)
    except DecodeError:
        return False
    return True


def _frames(wire: bytes) -> list[bytes]:
    """Split what is not one frame into those it is put together of, and what is between them."""
    if _is_frame(wire):
        return [wire]
    found, rest = modbus.split(wire)
    pieces: list[bytes] = []
    after_noise = False
    for piece in (*found, *modbus.flush(rest)):
        if not isinstance(piece, Noise):
            pieces.append(piece)
        elif after_noise:
            pieces[-1] += piece.wire
        else:
            pieces.append(piece.wire)
        after_noise = isinstance(piece, Noise)
    return pieces


def _runs(text: str) -> Iterator[_Bytes]:
    """Find pairs of hex digits with the same between all of them."""
    text = _DATES.sub(lambda date: "|" * len(date[0]), text)
    run: _Bytes = []
    kind = None
    end = 0
    for word in _WORD.finditer(text):
        found = _bytes_of(word[0], word.start())
        between = _BETWEEN.fullmatch(text[end : word.start()].translate(_NO_QUOTES))
        if run and (not found or between is None or kind not in (None, between.lastgroup)):
            yield run
            run, kind = [], None
        elif run and between:
            kind = between.lastgroup
        run += found
        end = word.end()
    if run:
        yield run


_NO_QUOTES = dict.fromkeys(map(ord, "'\""))


def _bytes_of(word: str, start: int) -> _Bytes:
    plain = _HEX_WORD.fullmatch(word)
    if not plain and not _ESCAPED_WORD.fullmatch(word):
        return []
    pairs = _PAIR.finditer(word, *plain.span(1)) if plain else _ESCAPED.finditer(word)
    return [(int(pair[0][-2:], 16), start + pair.start(), start + pair.end()) for pair in pairs]


def _literals(text: str) -> Iterator[_Bytes]:
    r"""Find bytes as Python writes them, ``b'\x01F'``, or what is left of that."""
    spans = [literal.span(literal.lastindex or 0) for literal in _LITERAL.finditer(text)]
    if "\\x" in text:
        spans.append((text.index("\\x"), len(text.rstrip(_CLOSING))))
    for start, end in spans:
        found = [(_character(one), *one.span()) for one in _CHARACTER.finditer(text, start, end)]
        if found and all(value <= 0xFF for value, _, _ in found):
            yield found


def _character(one: re.Match[str]) -> int:
    return int(one[1], 16) if one[1] else _ESCAPES.get(one[0], ord(one[2]))
