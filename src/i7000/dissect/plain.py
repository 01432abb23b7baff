r"""Lines of one frame alone, or after a time and a direction, which most lines of a log are.

Law: what is found here is what the whole search finds, in a small part of its time.
"""

import re
from functools import cache

from i7000 import modbus
from i7000.dissect.found import Kind
from i7000.dissect.in_bytes import frames_of
from i7000.dissect.shapes import plain_shapes

__all__ = ["find_plain"]

_SHORTEST = 5
"""Bytes of the shortest frame that no other reading of the same characters contests: ``01:04:00:00`` is a time."""


@cache
def _plain() -> re.Pattern[str]:
    return re.compile(
        rf"""
        (?: [\[(]? (?: \d{{4}}-\d\d-\d\d [ T] )? \d\d:\d\d:\d\d (?: [.,]\d{{1,6}} )? [\])]? [ \t] )?
        (?: (?: [TRtr][Xx] | [Ss]end | [Rr]ecv | SEND | RECV ) :?[ \t] | (?: [-=]{{0,2}}> | <[-=]{{0,2}} | >> | << ) [ ] )?
        (?: ({plain_shapes()}) (\\r | <CR> | \r | \n)? \n? | ([0-9A-Fa-f]{{2}} ([ :,-]?) [-0-9A-Fa-f :,]+) \r?\n? )
        """,
        re.VERBOSE | re.ASCII,
    )


_HEX = 3
_GAP = 4
"""Groups of the pattern."""


def find_plain(text: str) -> tuple[Kind, bytes, int, int] | None:
    r"""Find the frame of a line that has nothing else but a time and a direction; None if the line is not like that.

    Shape: the fields of a `Found`, in a tuple for speed.

    >>> find_plain(r"12:00:01.250 TX: $012\r")
    (<Kind.DCON: 'dcon'>, b'$012\r', 17, 23)
    """
    line = _plain().fullmatch(text)
    if line is None:
        return None
    last = line.lastindex
    if last != _HEX:
        return Kind.DCON, line[1].encode() + b"\r", line.start(1), line.end(last or 1)
    digits, gap = line.group(_HEX, _GAP)
    digits = digits.rstrip()
    end = line.start(_HEX) + len(digits)
    if gap:
        count = digits.count(gap)
        if digits[2::3] != gap * count or len(digits) != 3 * count + 2:
            return None
        digits = digits.replace(gap, "")
    if len(digits) % 2 or len(digits) < 2 * _SHORTEST or not digits.isalnum():
        return None
    wire = bytes.fromhex(digits)
    if modbus.split(wire)[0] == (wire,):
        return Kind.MODBUS, wire, line.start(_HEX), end
    frames = frames_of(wire)
    if len(frames) == 1 and frames[0][1:] == (0, len(wire)):
        return frames[0][0], wire, line.start(_HEX), end
    return None
