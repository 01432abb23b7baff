r"""Lines of one frame alone, or after words and times, which most lines of a log are.

Law: what is found here is what the whole search finds, in a small part of its time.
"""

import re
from functools import cache

from i7000 import modbus
from i7000.dissect.found import Kind
from i7000.dissect.in_bytes import frames_of
from i7000.dissect.shapes import plain_shapes
from i7000.dissect.spelling import in_url

__all__ = ["find_plain"]

_CR = 0x0D
_SHORTEST = 5
"""Bytes of the shortest frame that no other reading of the same characters contests: ``01:04:00:00`` is a time."""


@cache
def _plain() -> re.Pattern[str]:
    return re.compile(
        rf"""
        (?> (?:
            [ \t:;,|\[\](){{}}<=/_"'.-]
          | \d (?<![\w:.\-/].) (?:
                (?: \d{{3}}-\d\d-\d\d [ T] \d )? \d:\d\d:\d\d (?: [.,]\d{{1,6}} )? Z? | \d*\.\d+
            ) (?! \w | [:.\-/]\w )
          | [G-Zg-z][0-9A-Za-z]* | [A-Fa-f](?=[A-Fa-f]*[G-Zg-z])[0-9A-Za-z]*              # a word that is not hex
          | [0-9A-Fa-f] (?<![0-9A-Za-z].) (?:[0-9A-Fa-f]{{2}})* (?![0-9A-Za-z]|[:./-]\w)  # or no bytes in hex
        )* )
        (?: >{{1,3}} [ ] )? ["']?
        (?:
            (?<! [0-9A-Za-z] ) (?<! [0-9A-Z]["'] ) ({plain_shapes()}) (\\r | <CR> | \r)? ["'\])}}]*
          | ([0-9A-Fa-f]{{2}} ([ :,-]?) [-0-9A-Fa-f :,]* [0-9A-Fa-f]) ["'\])}}> ]*
        )
        """,
        re.VERBOSE | re.ASCII,
    )


_HEX = 3
_GAP = 4
"""Groups of the pattern."""


def find_plain(text: str) -> tuple[Kind, bytes, int, int] | None:
    r"""Find the frame of a line that has nothing but words and times before it; None if the line is not like that.

    Shape: the fields of a `Found`, in a tuple for speed.

    >>> find_plain(r"12:00:01.250 TX: $012\r")
    (<Kind.DCON: 'dcon'>, b'$012\r', 17, 23)
    """
    line = None if "data:" in text else _plain().fullmatch(text)
    if line is None:
        return None
    last = line.lastindex
    if last != _HEX:
        found = Kind.DCON, line[1].encode() + b"\r", line.start(1), line.end(last or 1)
        return None if line[1][0] == "%" and in_url(text) else found
    start, end = line.span(_HEX)
    wire = _bytes_of(text[start:end], line[_GAP])
    if len(wire) < _SHORTEST:
        return None
    if wire[-1] != _CR and modbus.split(wire)[0] == (wire,):  # sooner than `frames_of` does
        return Kind.MODBUS, wire, start, end
    frames = frames_of(wire)
    if len(frames) == 1 and frames[0][1:] == (0, len(wire)):
        return frames[0][0], wire, start, end
    return None


def _bytes_of(digits: str, gap: str) -> bytes:
    """Read bytes with the same between all of them, as dates and times have not; no bytes if it is not the same."""
    if gap == " ":  # which fromhex passes over
        apart = digits
    elif gap:
        count = digits.count(gap)
        is_same = digits[2::3] == gap * count and len(digits) == 3 * count + 2
        apart = digits.replace(gap, " ") if is_same else ""
    else:
        apart = digits if digits.isalnum() else ""
    try:
        return bytes.fromhex(apart)
    except ValueError:  # a digit alone, or another gap
        return b""
