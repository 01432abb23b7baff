"""DCON frames that a line writes as text, with any spelling of the carriage return, or with none."""

from collections.abc import Iterator, Sequence

from i7000.dcon import LONGEST_FRAME
from i7000.dissect.damage import is_direction
from i7000.dissect.found import Found, Kind
from i7000.dissect.patterns import pattern
from i7000.dissect.shapes import is_shaped, report
from i7000.dissect.spelling import DIRECTIONS, UNITS, in_url, text_of, without_numbers

__all__ = ["in_text"]

_NO_TEXT = "\0-\x08\x0e-\x1a\x1c-\x1f\x7f\udc80-\udcff"
"""Characters that sentences do not contain: control characters, and bytes that are not UTF-8, as `surrogateescape`
decodes them; without those that format text or begin a command of a terminal."""
_LEADING = pattern(r"[%#$~@!>?]")
_MAY_LEAD = pattern(r"[%#$~@!>?\\]|&gt;")
_UP_TO_END = pattern(rf".[ \"&-=A-}}{_NO_TEXT}]*(?=[\r\n])")
_WORD = pattern(rf".(?:(?!</)[!-~{_NO_TEXT}]){{0,{LONGEST_FRAME}}}")
_CLOSING = "\"'`)]}>,;.|"
_CUT = pattern(rf"[\"'`<,;|&)\]}}{_NO_TEXT}]|[-=]+>")
"""What ends a frame in the middle of a word, where the word as a whole has no shape."""
_ADDRESSED = pattern(r".(?:\*\*|[0-9A-F]{2}|[0-9][0-9a-f]|[0-9a-f][0-9])")
_BARE = len("$01")
_NEAR = 40
"""Characters beside something that show whether it stands in a sentence."""
_INTRODUCED = pattern(rf"(?i)(?:^|[\"'`]$|[(\[{{<>|=:;,\t&]|<-+|(?<![^\W_])(?:z+|(?:{DIRECTIONS})[\W_]*))[ ]*$")
"""What stands before a frame: nothing, a time or a number, a word for the direction, or a sign."""
_MEASURED = pattern(rf"[~@#$]\d+(?:(?:\.\d+)?\s?(?:{UNITS})\b|:\d\d(?!\d))")
"""``~100 ms``, ``@12:00``."""
_NUMBERED = pattern(r">[+-]\d")
_CLOSED = pattern(
    rf"(?:[%#$~@!?]|>(?=[+\-{_NO_TEXT}]))(?:[{_NO_TEXT}]|[!-~](?<![%#$~@!>?])){{1,{LONGEST_FRAME}}}(?=\r)"
)
"""A word that is closed by a carriage return as a frame is, whatever its address is."""
_ALONE = pattern(
    rf"(?:[%#$~@!?](?=.?[0-9*{_NO_TEXT}])[0-9A-Za-z*{_NO_TEXT}]{{2}}|>[+-](?=[0-9A-Za-z.+-]{{4}})[A-Za-z.+-]{{0,7}}\d)"
    rf"[!-~{_NO_TEXT}]{{0,{LONGEST_FRAME}}}$"
)
"""A word at the end of a line that has a digit where a frame has its address or value."""
_NOISES = "".join(map(chr, (*range(0x09), *range(0x0E, 0x1B), *range(0x1C, 0x20), 0x7F, *range(0xDC80, 0xDD00))))
_NOISE = pattern(rf"(?:\n?[{_NO_TEXT}]++|[ ][{_NO_TEXT}]++(?![^\W_]))\r?")
"""Bytes that touch a frame, or are set off by a blank and not a part of a word."""


def in_text(text: str) -> Iterator[Found]:
    """Find frames from a leading character to a carriage return, a blank, a quotation mark or a bracket."""
    if not _MAY_LEAD.search(text):
        return
    frames = list(_frames(*text_of(text)))
    if not in_url(text):
        yield from frames
        return
    others = _frames(*text_of(text, url=True))
    encoded = [it for it in others if not text.startswith(it.wire[:-1].decode(), it.start)]
    taken = bytearray(len(text))
    for found in sorted((*encoded, *frames), key=lambda it: it.kind is Kind.DAMAGED):
        if taken.find(1, found.start, found.end) < 0:
            taken[found.start : found.end] = bytes([1]) * (found.end - found.start)
            yield found


def _frames(characters: str, places: Sequence[int]) -> Iterator[Found]:
    at = left = 0
    while leading := _LEADING.search(characters, at):
        start = leading.start()
        at = start + 1
        kind, end = _ending(characters, start, left)
        if kind is not None:
            yield from _noise_before(characters[left:start], places, start)
            closing = characters[end : end + 1]
            spelled = places[min(end + 1, len(characters))] - places[end] > 1
            feed = closing == "\n" and spelled
            closed = closing in ("\r", "\n")
            wire = _bytes_of(characters[start:end]) + (b"\n" if feed else b"\r")
            yield Found(Kind.DAMAGED if feed else kind, wire, places[start], places[end + closed])
            at = left = end + closed if _NOISE.match(characters, end + closed) else end
            if noise := _NOISE.match(characters, at):
                yield Found(Kind.DAMAGED, _bytes_of(noise[0].lstrip(" \n")), places[at], places[noise.end()])
                at = left = noise.end()


def _noise_before(before: str, places: Sequence[int], end: int) -> Iterator[Found]:
    """Yield the bytes that touch a frame from before, and are not the end of a word."""
    close = before.removesuffix(" ")
    noise = close[len(close.rstrip(_NOISES)) :]
    if noise and not close[: -len(noise)][-1:].isalnum():
        start = end - len(before) + len(close) - len(noise)
        yield Found(Kind.DAMAGED, _bytes_of(noise), places[start], places[end])


def _bytes_of(characters: str) -> bytes:
    return characters.encode("ascii", "surrogateescape")


def _ending(characters: str, start: int, left: int) -> tuple[Kind | None, int]:
    """Return the kind of the frame that starts here, and where it ends; the kind is None if no frame starts here.

    Shape: what stands before `left` is a part of a frame.
    """
    if characters[start] == ">":
        found = report().match(characters, start)
        if found:
            return Kind.DCON, found.end()
    if not (_NUMBERED if characters[start] == ">" else _ADDRESSED).match(characters, start):
        return _without_address(characters, start, left)
    written = _UP_TO_END.match(characters, start)
    if written is None and start and characters[start - 1].isalnum():
        return None, start
    ends = list(_ends(characters, start, None if written is None else written.end()))
    shaped = (end for end in ends if is_shaped(characters[start:end]))
    end = next(shaped, None)
    if written is None and _MEASURED.match(characters, start):
        return None, start
    if end is not None:
        return Kind.DCON, end
    return (Kind.DAMAGED if written is not None or _is_apart(characters, start, ends[0]) else None), ends[0]


def _is_apart(characters: str, start: int, end: int) -> bool:
    """Return whether something stands where a frame does, and not in a sentence: a bare address, if nothing follows."""
    before = without_numbers(characters[max(0, start - _NEAR) : start])
    if not _INTRODUCED.search(before):
        return False
    after = characters[end : end + _NEAR].strip(_CLOSING + " \t\r\n")
    return end - start > _BARE or not after


def _without_address(characters: str, start: int, left: int) -> tuple[Kind | None, int]:
    """Return where a frame whose first characters are damaged ends, if nothing but a frame can stand there."""
    before = without_numbers(characters[max(left, start - _NEAR) : start])
    if closed := _CLOSED.match(characters, start):
        return (Kind.DAMAGED if _INTRODUCED.search(before) else None), closed.end()
    alone = _ALONE.match(characters, start)
    if alone is None or not is_direction(before) or _MEASURED.match(characters, start):
        return None, start
    return Kind.DAMAGED, alone.end()


def _ends(characters: str, start: int, written: int | None) -> Iterator[int]:
    """Yield where a frame can end: at its carriage return, before what closes a word, and where a word can be cut."""
    word = _WORD.match(characters, start)
    longest = word.end() if word else start + 1
    if written is None:
        yield from range(start + len(characters[start:longest].rstrip(_CLOSING)), longest + 1)
    else:
        yield written
    cut = _CUT.search(characters, start, longest)
    if cut:
        yield cut.start()
