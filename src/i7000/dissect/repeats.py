"""Frames that a logger printed twice: ``recv: 01 83 ..`` and then ``Processing: 01 83 ..``, or in hex and as text.

The bytes of both lines are the same. The words before them distinguish a repeat from a second frame on the wire:

* The second line has no direction and a word that the first, with a direction, has not: ``recv:``, ``Processing:``.
* Both have the same direction, and the second has a word for what is done with a frame: ``RX:``, ``RX parsed:``.
* Both have the same direction, and are spelled differently: ``TX: $012``, ``TX hex: 24 30 31 32 0D``.

A poll that is sent again has the same words, and an echo another direction: neither is a repeat.
"""

import re

from i7000.dissect.finder import find
from i7000.dissect.patterns import pattern

__all__ = ["is_repeat", "sent"]

_OUT = pattern(
    r"\b(?:tx[dw]?|send(?:ing)?|sent|writ(?:e|es|ing|ten)|wrote|request|query|command|out)\b|[-=>]>", re.IGNORECASE
)
_IN = pattern(r"\b(?:rx[dr]?|recv|receiv(?:e|ed|es|ing)|read|response|reply|answer|in|echo)\b|<[-=<]", re.IGNORECASE)
_WORD = pattern(r"[^\W\d_]{3,}")
_HANDLED = pattern(r"process|handl|pars|decod|interpret|analy|check|buffer|frame|raw|hex|ascii|text", re.IGNORECASE)


def is_repeat(first: str, second: str) -> bool:
    """Return whether the second of two lines, which have the same frame, prints again what the first did.

    >>> is_repeat("recv: 0x1 0x83 0x2 0xc0 0xf1", "Processing: 0x1 0x83 0x2 0xc0 0xf1")
    True
    >>> is_repeat("TX: $012", "TX: $012"), is_repeat("TX: $012", "RX: $012")
    (False, False)
    """
    before, spelled = _parted(first)
    before_again, spelled_again = _parted(second)
    direction, direction_again = _direction(before), _direction(before_again)
    new = set(_words(before_again)) - set(_words(before))
    if direction_again is None:
        return direction is not None and bool(new)
    if direction != direction_again:
        return False
    return any(map(_HANDLED.match, new)) or spelled.casefold() != spelled_again.casefold()


def sent(line: str) -> bool | None:
    """Return whether the words before the frame of a line show that the host sent it; None if they do not.

    >>> sent("TX: $012"), sent("RX: $012"), sent("$012")
    (True, False, None)
    """
    before, _ = _parted(line)
    return _direction(before)


def _parted(line: str) -> tuple[str, str]:
    """Return what stands before the frame of a line, and how the frame is spelled."""
    found = find(line)
    return (line[: found[0].start], line[found[0].start : found[0].end]) if found else (line, "")


def _direction(before: str) -> bool | None:
    """Return whether the words before a frame show that it was sent; None if they show neither direction, or both."""
    is_out, is_in = bool(_OUT.search(before)), bool(_IN.search(before))
    return is_out if is_out != is_in else None


def _words(text: str) -> list[str]:
    return [word[0].casefold() for word in _WORD.finditer(text)]
