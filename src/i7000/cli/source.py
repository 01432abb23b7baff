"""The lines of a stream, one after the other as they arrive.

Laws: no byte is lost, and what is kept is less than a line and a chunk, however long the line is.
"""

import os
import stat
from codecs import IncrementalDecoder
from collections.abc import Callable, Iterator
from io import BufferedIOBase
from select import select

from i7000.dissect.encoding import decoder_for, encoding_of

__all__ = ["LONGEST_LINE", "Counted", "Lines", "chunks", "is_live", "is_readable"]

LONGEST_LINE = 1 << 16
"""Bytes of a line beyond which it is read in pieces: a file without line ends is one line."""
_CHUNK = 1 << 16
_NAMED = 20
_GRACE = 0.02
"""Seconds that a CR which came last waits for the LF that may belong to it."""


class Counted:
    """Numbers of lines, which come in order: how many, and the first of them by number."""

    def __init__(self) -> None:
        self.count = 0
        self._first: list[int] = []
        self._last: int | None = None

    def add(self, number: int) -> None:
        """Count a line, once only."""
        if number == self._last:
            return
        self._last = number
        self.count += 1
        if self.count <= _NAMED:
            self._first.append(number)

    def __str__(self) -> str:
        return ", ".join(map(str, self._first)) + (", ..." if self.count > _NAMED else "")


class Lines:
    """The numbered lines of a stream, each with its end: LF, CR LF, or a CR alone, which ends DCON frames.

    Time: a line is yielded when it is there, a longer one in pieces. A CR that nothing follows for 20 ms is an end.
    """

    def __init__(self, stream: BufferedIOBase, wait: Callable[[], None]) -> None:
        """Read `stream`; `wait` is called each time before reading, which may take long."""
        self._stream = stream
        self._wait = wait
        self._live = is_live(stream)
        self._decoder: IncrementalDecoder | None = None
        self.long = Counted()
        """The lines that were read in pieces."""

    def __iter__(self) -> Iterator[tuple[int, bytes]]:
        """Yield the lines, or pieces of them, and their numbers."""
        number = 1
        rest = b""
        last = b""
        chunk = self._more(first=True)
        while chunk:
            if last.endswith(b"\r"):
                chunk = chunk.removeprefix(b"\n")  # of a line that was yielded without it
            lines = (rest + chunk).splitlines(keepends=True)
            rest = lines.pop() if lines and not self._is_whole(lines[-1]) else b""
            last = (lines or [b""])[-1] if not rest else b""
            for line in lines:
                yield from self._pieces(number, line)
                number += 1
            while len(rest) > LONGEST_LINE:
                self.long.add(number)
                yield number, rest[:LONGEST_LINE]
                rest = rest[LONGEST_LINE:]
            chunk = self._more()
        if rest:
            yield from self._pieces(number, rest)

    def _more(self, *, first: bool = False) -> bytes:
        """Return the next bytes, in UTF-8 whatever the encoding of the stream is."""
        while True:
            self._wait()
            chunk = self._stream.read1(_CHUNK)
            if first and encoding_of(chunk) != "utf-8":
                self._decoder = decoder_for(chunk)
            first = False
            if self._decoder is None or not chunk:
                return chunk
            text = self._decoder.decode(chunk)
            if text:
                return text.encode("utf-8", "surrogatepass")

    def _pieces(self, number: int, line: bytes) -> Iterator[tuple[int, bytes]]:
        if len(line) > LONGEST_LINE:
            self.long.add(number)
        for at in range(0, len(line), LONGEST_LINE):
            yield number, line[at : at + LONGEST_LINE]

    def _is_whole(self, line: bytes) -> bool:
        """Return whether the last line of a chunk is complete; a CR may be the first half of a CR LF."""
        if line.endswith(b"\r") and self._live:
            self._wait()
            return not is_readable(self._stream)
        return line.endswith(b"\n")


def is_live(stream: BufferedIOBase) -> bool:
    """Return whether more can come later: not in a file, and not in memory."""
    try:
        return not stat.S_ISREG(os.fstat(stream.fileno()).st_mode)
    except OSError:
        return False


def is_readable(stream: BufferedIOBase) -> bool:
    """Return whether more comes within 20 ms."""
    try:
        return bool(select([stream.fileno()], [], [], _GRACE)[0])
    except (OSError, ValueError):  # Windows knows that of sockets only
        return False


def chunks(stream: BufferedIOBase, wait: Callable[[], None]) -> Iterator[bytes]:
    """Yield the bytes of a stream as they arrive, and nothing where no more came for 20 ms; `wait` as for `Lines`."""
    live = is_live(stream)
    while True:
        wait()
        chunk = stream.read1(_CHUNK)
        if not chunk:
            return
        yield chunk
        if live and not is_readable(stream):
            yield b""
