"""Lines that hold nothing but a damaged frame."""

import re

from i7000.dissect.in_bytes import begins_like_a_frame
from i7000.dissect.spelling import DIRECTIONS, decimal_runs, hex_runs, loose_hex_runs, wire_of, without_numbers
from i7000.settings import Protocol

__all__ = ["in_place_of_a_frame", "is_direction"]

_DIRECTION = re.compile(rf"[\Wz_]*(?:(?:{DIRECTIONS})[\Wz_]*){{0,2}}", re.IGNORECASE)
"""What may stand beside a frame: a time, which is crossed out, and words for its direction."""
_LEADING = re.compile(r"[%#$~@!?]|(?<![-=<>])>(?!\s*[%#$~@!?>])")
"""A leading character, and no arrow."""
_HEADING = bytes(range(256))
"""What stands above the columns of a dump."""
_FEWEST = 2
_FEWEST_IN_A_WORD = 5
_FEWEST_NUMBERS = 4
_LETTER = re.compile("[A-Fa-f]")
_NOT_HEX = re.compile(r"\d{3}|[ ,\[({]-\d")
"""What shows that numbers are in hex without leading zeros, or in decimal; of those without, it is unknown."""
"""The fewest bytes that are not a plain number, if the protocol is unknown."""


def is_direction(beside: str) -> bool:
    """Return whether what stands beside a frame is nothing but a time, which is crossed out, and a direction."""
    return bool(_DIRECTION.fullmatch(beside))


def in_place_of_a_frame(text: str, protocol: Protocol | None) -> bytes | None:
    r"""Return the bytes of a line that has nothing but a time and a direction beside them; None if there are none.

    Shape: with a protocol, whatever can be meant to be a frame of it; else what is hardly anything else.

    >>> in_place_of_a_frame("12:00:01 RX 01 04 02", None), in_place_of_a_frame("port opened", None)
    (b'\x01\x04\x02', None)
    >>> in_place_of_a_frame("-> !0", Protocol.DCON)
    b'!0\r'
    """
    crossed = without_numbers(text)
    if protocol is not Protocol.DCON:
        for run in hex_runs(crossed):
            beside = crossed[: run[0].start] + crossed[run[-1].end :]
            words = sum(byte.word for byte in run) == len(run)
            many = len(run) >= (_FEWEST if words else _FEWEST_IN_A_WORD) and not text.strip().isdecimal()
            wire = wire_of(run)
            heading = wire == _HEADING[: len(wire)]
            if (protocol is not None or (many and not heading)) and is_direction(beside):
                return wire
        for runs, shown_by in ((loose_hex_runs, _LETTER), (decimal_runs, _NOT_HEX)):
            for run in runs(crossed):
                start, end = run[0].start, run[-1].end
                enough = len(run) >= _FEWEST_NUMBERS and begins_like_a_frame(run)
                if enough and shown_by.search(crossed, start, end) and is_direction(crossed[:start] + crossed[end:]):
                    return wire_of(run)
    if protocol is Protocol.DCON:
        first = _LEADING.search(crossed)
        if first and is_direction(crossed[: first.start()]):
            body = text[first.start() :].rstrip("\r\n")
            ended = body[0] == ">" or text.endswith("\r")  # A blank before the carriage return was on the wire.
            return (body if ended else body.rstrip()).encode("utf-8", "surrogateescape") + b"\r"
    return None
