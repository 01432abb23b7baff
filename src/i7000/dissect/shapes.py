"""The shapes that DCON commands and responses have, whatever the model (manual 2).

A shape is what a syntax says of the characters: which are literal, how many there are, what each can be. It is enough
to distinguish a frame from a sentence; the codecs decide what a frame means.
"""

import re
from collections.abc import Iterable, Iterator
from functools import cache

from i7000 import dcon
from i7000.dcon.layout import pieces_of
from i7000.dcon.parts import Part

__all__ = ["is_shaped", "plain_shapes", "report"]

_SENTINEL = r"[+-](?:9999|0000)(?!\.)"
_NUMBER = r"[+-](?:\d\.\d{4}|\d\d\.\d{3}|\d{3}\.\d\d|\d{4}\.\d)"
_HEX = rf"(?:[0-9A-F]{{4}}|{_SENTINEL})"
_FIELDS = rf"(?:(?:\x20{{4}})*{_HEX}(?:{_HEX}|\x20{{4}})*|(?:{_NUMBER}|{_SENTINEL}|\x20{{7}})+)"
_WIDTHS = {"channel_digits": "{1,2}", "mask_digits": "{2,6}"}
_NAME = r"[\"&-=A-}]{1,6}"
_RESTS = {"values": _FIELDS, "value": _FIELDS, "name": _NAME, "version": r"[A-Z]\d+\.\d+"}
_SIGNED = {"offset": "[+-][0-9A-F]{4}", "temperature": r"[+-]\d{4}\.\d"}
_CHECKSUM = r"(?:[0-9A-F]{2})?"


def _pattern(kind: type[dcon.Message]) -> str:
    """Write the syntax of a message as a regular expression."""
    return "".join(_piece(name, piece) for name, piece in pieces_of(kind))


def _piece(name: str, piece: str | Part) -> str:
    if isinstance(piece, str):
        return re.escape(piece)
    if piece.width == "rest":
        return _RESTS[name]
    if name in _SIGNED:
        return _SIGNED[name]
    width = len(piece.notation) if piece.width is None else piece.width
    return "[0-9A-F]" + (_WIDTHS[width] if isinstance(width, str) else f"{{{width}}}")


def _kinds() -> Iterator[type[dcon.Message]]:
    for command in dcon.COMMANDS:
        yield command
        if issubclass(command, dcon.Command):
            yield command.response
    yield dcon.Refused


def _any(kinds: Iterable[type[dcon.Message]]) -> str:
    return rf"(?:{'|'.join(dict.fromkeys(map(_pattern, kinds)))}){_CHECKSUM}"


@cache
def _shapes() -> re.Pattern[str]:
    return re.compile(_any(_kinds()), re.ASCII)


def plain_shapes() -> str:
    """Return the pattern of all commands and responses, as text; names have letters and digits only."""
    return _any(_kinds()).replace(_NAME, "[-0-9A-Za-z]{1,6}")


@cache
def report() -> re.Pattern[str]:
    """Return the pattern of a response that holds channel fields, in which a blank does not end the frame."""
    reports = (kind for kind in _kinds() if kind.syntax[0] == ">")
    return re.compile(rf"{_any(reports)}(?=\.?(?:[\s\"'`)\]}}><,;|]|$))", re.ASCII)


def is_shaped(body: str) -> bool:
    """Return whether a body, with or without a checksum, has the shape of a command or response.

    >>> is_shaped("$012"), is_shaped("$012B7"), is_shaped("$PATH")
    (True, True, False)
    """
    return bool(_shapes().fullmatch(body))
