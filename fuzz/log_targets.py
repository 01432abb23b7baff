"""What people and programs write down: logs, dumps, streams, captures, recordings, snapshots.

Laws: nothing that a file holds raises, but `InvalidValueError` for a snapshot; every line and every byte is somewhere.
"""

import io
from collections.abc import Iterator

from fuzz.inputs import HEADER, pieces, profile_of
from i7000 import InvalidValueError, Protocol, dcon, modbus
from i7000.cli import readers
from i7000.dissect import Heard, Kind, Knowledge, Known, Line, find, flush, hear
from i7000.dissect import pieces as log_pieces
from i7000.dissect.capture import Damage, packets
from i7000.host.procedures import Snapshot
from i7000.recording import Carried, Damaged, Start, read, text

__all__ = ["capture", "log_find", "log_pieces_of", "recording", "snapshot", "stream_hear"]

_PROTOCOLS = (None, Protocol.DCON, Protocol.MODBUS_RTU)
_LONGEST_REST = 600
"""More bytes than a frame and a row of a dump, or than two frames."""


def _text(data: bytes) -> str:
    """Return a text as the terminal reads files: bytes that are not UTF-8 are kept as surrogates."""
    return data.decode("utf-8", "surrogateescape")


def log_find(data: bytes) -> None:
    """Find the frames in a line: they are good, do not overlap, and stand in their order."""
    line = _text(data)
    end = 0
    for found in find(line):
        assert end <= found.start < found.end <= len(line)
        assert found.wire
        end = found.end
        if found.kind is Kind.MODBUS:
            modbus.unseal(found.wire)
        elif found.kind is Kind.DCON:
            dcon.unseal(found.wire, checksum=False)


def _lines(data: bytes) -> list[tuple[int, str]]:
    """Return numbered lines, cut as files are."""
    return list(enumerate(io.StringIO(_text(data), newline="\n"), 1))


def log_pieces_of(data: bytes) -> None:
    """Find the frames of a log: every line that is not blank is in a piece, and pieces are in order."""
    if not data:
        return
    protocol, lines = _PROTOCOLS[data[0] % 3], _lines(data[1:])
    held: set[int] = set()
    first = 1
    for piece in log_pieces(lines, protocol):
        assert first <= piece.number <= piece.last <= len(lines)
        assert (piece.kind is None) == (piece.wire == b"")
        first = piece.number
        held.update(range(piece.number, piece.last + 1))
    assert all(number in held for number, line in lines if line.strip())
    for one in readers.hinted(readers.of_lines(lines, Knowledge(), protocol), protocol):
        _check_heard(one.heard)


def _check_heard(heard: Heard | None) -> None:
    if heard is None:
        return
    assert all(isinstance(note, str) for note in (*heard.notes, *heard.contradictions))
    if heard.error is not None:
        assert heard.error.wire in heard.wire
        assert str(heard.error)
    for meaning in heard.meanings:
        for field in meaning.fields:
            assert isinstance(field.text, str)


def _line(data: bytes) -> Line:
    """Return the listener that the bytes of a profile and one more select."""
    options = data[HEADER]
    profile = profile_of(data)
    known = Known.of(profile) if options & 4 else Known()
    return Line(Knowledge.given(known), _PROTOCOLS[(options & 3) % 3])


def stream_hear(data: bytes) -> None:
    """Hear a stream whole and in pieces: the same frames, and every byte once.

    Shape: the profile, options, the size of the pieces, then the stream.
    """
    if len(data) < HEADER + 2:
        return
    stream, cut = data[HEADER + 2 :], data[HEADER + 1]
    whole = _heard(_line(data), iter((stream,)))
    found = _heard(_line(data), pieces(stream, cut))
    for every in (whole, found):
        assert b"".join(it.wire for it in every) == stream
        assert [it.place.number for it in every] == list(range(1, len(every) + 1))
    for it in whole:
        _check_heard(it)
    assert [it.wire for it in whole if not it.error] == [it.wire for it in found if not it.error]


def _heard(line: Line, data: Iterator[bytes]) -> list[Heard]:
    found: list[Heard] = []
    for piece in data:
        line, heard = hear(line, piece)
        assert len(line.rest) <= _LONGEST_REST
        found += heard
    line, heard = flush(line)
    assert not line.rest
    return [*found, *heard]


def capture(data: bytes) -> None:
    """Read a capture file whole and in pieces, and decode what was on its line.

    Shape: the size of the pieces, then the file.
    """
    if not data:
        return
    file = data[1:]
    whole = list(packets([file]))
    assert whole == list(packets(pieces(file, data[0])))
    assert all(packet.reason for packet in whole if isinstance(packet, Damage))
    for one in readers.of_capture([file], Knowledge(), None):
        _check_heard(one.heard)


def recording(data: bytes) -> None:
    """Read the lines of a recording; each record is written as a line that is read as the same."""
    lines = _lines(data)
    for _, line in lines:
        record = read(line)
        if isinstance(record, Damaged):
            assert record.reason
            continue
        again = read(text(record))
        assert not isinstance(again, Damaged)
        assert text(again) == text(record)
        if isinstance(record, Carried):
            assert isinstance(again, Carried)
            assert again.wire == record.wire
        elif isinstance(record, Start):
            assert again == record
    for one in readers.of_recording(lines, Knowledge(), None):
        _check_heard(one.heard)


def snapshot(data: bytes) -> None:
    """Read a snapshot; what is read is written as JSON that is read as the same."""
    try:
        found = Snapshot.from_json(data)
    except InvalidValueError as error:
        assert str(error)
        return
    written = found.to_json()
    assert written.isascii()
    assert Snapshot.from_json(written) == found
    assert Snapshot.from_json(written).to_json() == written
