r"""Lines of a log -> DCON frames.

What loggers put around a frame is passed over: numbers, dates and words, brackets, quotes, arrows, and ways to write
the carriage return. ``>`` is an arrow only if it is drawn as one and a leading character comes next.

Laws: no line raises, and none is lost: the pieces of a line, put together, are the line but for blank ones.
"""

import re
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from i7000 import dcon

__all__ = ["Line", "numbered_pieces", "pieces", "shown"]


class Line(NamedTuple):
    """A line, or the piece of one up to a carriage return."""

    number: int
    text: str
    """All of it, without the line end; bytes that are no UTF-8 as ``\\xNN``."""
    frame: bytes | None
    """The frame in it, with carriage return, or what stands where a frame should."""


_ENDS = r"\r?\n|\r|\\r(?:\\n)?['\"]?|\\n['\"]?|\\x0[dD]['\"]?|[(<\[](?:CR|cr)[)>\]](?:[(<\[](?:LF|lf)[)>\]])?"
_PIECE = re.compile(rf"(?s)(.*?)({_ENDS}|\Z)")
_LINE_ENDS = ("", "\n", "\r\n")

_LEADS = "%#$~@!>?"
_ONE_END = (*_LINE_ENDS, "\r")
_PREFIXES = re.compile(
    rf"""(?>
    [\s\ufeff'"]+
    | [-=]+> (?! [-+0-9A-F] )                           # an arrow with a shaft, not a dash before a report
    | >{{2,3}} (?= \s+ [A-Za-z\[(] )
    | >{{1,3}} (?= \s* (?: b?['"] )? [{_LEADS}] )       # an arrow, and not the first character of a report
    | [-=|:;,<\u00ab\u00bb\u2190-\u21ff]+               # all other arrows, and what separates columns
    | [\[(] [^{_LEADS}\[\]()]{{0,64}} [\])]
    | [\w/] [\w./:,+-]*                                 # dates, times, words and ports
    )*""",
    re.VERBOSE,
)
_HEX = re.compile(r"(?:^|[\s:])((?:2[1345]|3[EeFf]|40|7[Ee]) ?(?:[0-9A-Fa-f]{2} ?)*0[Dd])$")
_HEX_TAIL = 4 * dcon.LONGEST_FRAME


def pieces(lines: Iterable[bytes]) -> Iterator[Line]:
    r"""Find the frame in each line; a line with several carriage returns is as many pieces.

    >>> [line.frame for line in pieces([b"12:00:01 TX: $012\\r", b"<- >+025.12", b"not open yet"])]
    [b'$012\r', b'>+025.12\r', None]
    """
    return numbered_pieces(enumerate(lines, 1))


def numbered_pieces(lines: Iterable[tuple[int, bytes]]) -> Iterator[Line]:
    """Find the frames in lines whose numbers are known."""
    for number, line in lines:
        text = line.decode("utf-8", "surrogateescape")
        body = text.rstrip("\r\n")
        end = text[len(body) :]
        if end in _ONE_END and not _may_end(body):  # nearly always
            if body and not body.isspace():
                yield Line(number, body if body.isascii() else shown(body), _frame(body, ended=end == "\r"))
            continue
        for piece in _PIECE.finditer(text):
            body, end = piece.groups()
            if (body + end).strip():
                yield Line(number, shown(body + end), _frame(body, ended=end not in _LINE_ENDS))


def _may_end(text: str) -> bool:
    """Whether a text can have an end in it: all of them have one of these."""
    return "\r" in text or "\n" in text or "\\" in text or "CR" in text or "cr" in text


def shown(text: str) -> str:
    """A piece of a line as it is told: without the line end, bytes that are no UTF-8 escaped."""
    return _raw(text).rstrip(b"\r\n").decode("utf-8", "backslashreplace")


def _raw(text: str) -> bytes:
    return text.encode("utf-8", "surrogateescape")


def _frame(text: str, *, ended: bool) -> bytes | None:
    """Find the frame that ends `text`; blanks belong to a report, or to what its carriage return comes after."""
    at = _PREFIXES.match(text).end()  # type: ignore[union-attr] # it matches no character too
    frame = text[at:]
    if frame[:1] not in _LEADS or not frame:
        return _from_hex(text)
    if at and text[at - 1] in "'\"":
        frame = frame.removesuffix(text[at - 1])
    if frame[0] != ">" and not ended:
        frame = frame.rstrip()
    return _raw(frame) + b"\r"


def _from_hex(text: str) -> bytes | None:
    r"""Read pairs of hex digits, if they begin with a leading character and end with the carriage return.

    >>> _from_hex("12:00:01 RX 24 30 31 32 0D")
    b'$012\r'
    """
    pairs = _HEX.search(text.rstrip()[-_HEX_TAIL:])
    return bytes.fromhex(pairs[1]) if pairs else None
