"""DCON frames that a line writes as text, with any spelling of the carriage return, or with none."""

from collections.abc import Iterator

from i7000.dcon import LONGEST_FRAME
from i7000.dissect.found import Found, Kind
from i7000.dissect.patterns import pattern
from i7000.dissect.shapes import is_shaped, report
from i7000.dissect.spelling import text_of

__all__ = ["in_text"]

_LEADING = pattern(r"[%#$~@!>?]")
_MAY_LEAD = pattern(r"[%#$~@!>?\\]|&gt;")
_UP_TO_END = pattern(r".[ \"&-=A-}]*(?=[\r\n])")
_WORD = pattern(rf".(?:(?!</)[!-~]){{0,{LONGEST_FRAME}}}")
_CLOSING = "\"'`)]}>,;.|"
_CUT = pattern(r"[\"'`<,;|)\]}]|[-=]+>")
"""What ends a frame in the middle of a word, where the word as a whole has no shape."""
_ADDRESSED = pattern(r".(?:\*\*|[0-9A-F]{2}|[0-9][0-9a-f]|[0-9a-f][0-9])")
_NUMBERED = pattern(r">[+-]\d")


def in_text(text: str) -> Iterator[Found]:
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
    if written and is_shaped(written[0]):
        return Kind.DCON, written.end()
    if not written and start and characters[start - 1].isalnum():
        return None, start
    word = _WORD.match(characters, start)
    longest = word.end() if word else start + 1
    shortest = start + len(characters[start:longest].rstrip(_CLOSING))
    cut = _CUT.search(characters, start, longest)
    ends = () if written else range(shortest, longest + 1)
    for end in (*ends, *([cut.start()] if cut else [])):
        if is_shaped(characters[start:end]):
            return Kind.DCON, end
    return _kind_of_damage(characters, start), written.end() if written else shortest


def _kind_of_damage(characters: str, start: int) -> Kind | None:
    return Kind.DAMAGED if _ADDRESSED.match(characters, start) or _NUMBERED.match(characters, start) else None
