r"""Dumps of a stream: rows of bytes in hex behind their offset, as ``hexdump -C``, ``xxd`` and ``od -tx1`` write.

Two or more rows that go on where the one before ends are the bytes of a stream: a frame can begin and end anywhere in
a row. A row alone is a line like any other.

Laws: every byte of the rows is in exactly one frame or piece of noise. No more than a frame and a row are kept.
"""

import re
from collections.abc import Iterator
from typing import NamedTuple

from i7000.dissect.found import Kind
from i7000.dissect.stream import split
from i7000.settings import Protocol

__all__ = ["Dump", "Row", "read_row"]

_ROW = re.compile(r"\s*(?:0[xX])?([0-9A-Fa-f]{4,8})(?::\s?|\s{1,2})(?=[0-9A-Fa-f]{2})")
_BYTE = re.compile(r"(\s*)([0-9A-Fa-f]{2})")
_HALF = 8
"""Bytes after which many programs leave a wider gap."""
_MOST = 64
"""Bytes of the longest row."""
_TEXT_FOLLOWS = re.compile(r"\||\s{3}")
_OFFSETS = (16, 8, 10)
"""The bases in which programs write offsets."""


class Row(NamedTuple):
    """A row of a dump."""

    number: int
    """The number of the line."""
    text: str
    offset: str
    wire: bytes

    def goes_on(self, before: "Row") -> bool:
        """Return whether the row goes on where another one ends."""
        for base in _OFFSETS:
            try:
                if int(self.offset, base) == int(before.offset, base) + len(before.wire):
                    return True
            except ValueError:
                continue
        return False


def read_row(number: int, text: str) -> Row | None:
    r"""Read a line as a row of a dump; None if it is not one.

    >>> read_row(1, "00000010: 0d24 3031 4d0d                           .$01M.").wire
    b'\r$01M\r'
    """
    head = _ROW.match(text)
    if head is None:
        return None
    wire = bytearray()
    at = head.end()
    while len(wire) < _MOST and (byte := _BYTE.match(text, at)):
        gap = byte[1]
        wide = len(gap) > 1 and wire
        if wide and not (len(wire) == _HALF and len(gap) == 2 and _TEXT_FOLLOWS.search(text, byte.end())):
            break
        wire.append(int(byte[2], 16))
        at = byte.end()
    end = text[at : at + 1]
    return Row(number, text, head[1], bytes(wire)) if end in ("", " ", "\t", "|") else None


class Dump:
    """The rows of a dump so far, as far as their bytes can still become a frame."""

    def __init__(self, protocol: Protocol | None) -> None:
        self._protocol = protocol
        self._rows: list[Row] = []
        self._rest = b""
        self._skipped = 0
        """Bytes at the beginning of the first row that were yielded."""

    def add(self, row: Row) -> None:
        """Take the next row."""
        self._rows.append(row)
        self._rest += row.wire

    def frames(self, *, last: bool) -> Iterator[tuple[tuple[Row, ...], Kind, bytes]]:
        """Yield frames and noise with the rows that have their bytes; with `last`, nothing is kept."""
        spans, rest = split(self._rest, self._protocol, last=last)
        kinds = {Protocol.DCON: Kind.DCON, Protocol.MODBUS_RTU: Kind.MODBUS}
        for span in spans:
            rows = self._taken(len(span.wire))
            yield rows, kinds[span.protocol] if span.is_frame else Kind.DAMAGED, span.wire
        self._rest = rest

    def _taken(self, count: int) -> tuple[Row, ...]:
        """Return the rows of the next bytes, and forget those that are used up; the last row is kept."""
        rows = []
        end = self._skipped + count
        while True:
            row = self._rows[0]
            rows.append(row)
            if end < len(row.wire) or len(self._rows) == 1:
                break
            end -= len(row.wire)
            del self._rows[0]
            if not end:
                break
        self._skipped = end
        return tuple(rows)
