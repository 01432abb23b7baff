"""The listener: bytes or frames of a line, one after the other -> their meanings.

A `Line` is the state: what was heard so far, and what is known about each module from it. `hear` takes bytes in any
pieces, `hear_frame` a single frame, as in a log.

Laws: every byte is in exactly one `Heard`, or in `Line.rest`. A frame never changes the result of an earlier one. No
bytes raise. Noise changes nothing that is known, nor which command waits for an answer.
"""

from attrs import evolve

from i7000.arguments import as_bytes, check_type
from i7000.dissect.dcon import LEADS
from i7000.dissect.heard import Heard, Line, Place, updated
from i7000.dissect.line_dcon import hear_dcon
from i7000.dissect.line_modbus import hear_broadcast, hear_modbus
from i7000.dissect.stream import split
from i7000.errors import ArgumentError, DecodeError, Fault
from i7000.settings import Protocol

__all__ = ["flush", "hear", "hear_frame"]


def hear(
    line: Line, data: bytes, where: str | None = None, *, sent: bool | None = None
) -> tuple[Line, tuple[Heard, ...]]:
    r"""Read the next bytes of a stream, in any pieces; what can still become a frame is kept in `Line.rest`.

    Shape: `where` the bytes stand, for notes on later frames, which count them unless it is given; `sent`: whether the
        host sent them, None if that is unknown. Flush where the direction changes.

    >>> line, heard = hear(Line(protocol=Protocol.DCON), b"$012\r!01")
    >>> line, more = hear(line, b"0F0600\r")
    >>> [type(it.meanings[0].message).__name__ for it in (*heard, *more)]
    ['ReadConfiguration', 'Configuration']
    """
    check_type("line", line, Line)
    return _hear_split(line, line.rest + as_bytes("data", data), where, sent=sent, last=False)


def flush(line: Line, where: str | None = None, *, sent: bool | None = None) -> tuple[Line, tuple[Heard, ...]]:
    """Read what is in `Line.rest`, a frame or not, because nothing more comes for now."""
    check_type("line", line, Line)
    return _hear_split(line, line.rest, where, sent=sent, last=True)


def _hear_split(
    line: Line, data: bytes, where: str | None, *, sent: bool | None, last: bool
) -> tuple[Line, tuple[Heard, ...]]:
    check_type("where", where, str, optional=True)
    check_type("sent", sent, bool, optional=True)
    spans, rest = split(data, line.protocol, last=last)
    found = []
    for protocol, wire, is_frame in spans:
        heard_line, heard = _hear(line, wire, protocol, _next(line, where), sent=sent)
        if is_frame:
            line = heard_line
        else:
            line = updated(line, count=heard.place.number)
            if protocol is Protocol.DCON and wire[0] not in LEADS:
                heard = evolve(heard, error=DecodeError(Fault.LEADING, wire))
        found.append(heard)
    return updated(line, rest=rest), tuple(found)


def hear_frame(
    line: Line, wire: bytes, protocol: Protocol, place: Place | None = None, *, sent: bool | None = None
) -> tuple[Line, Heard]:
    r"""Read a frame, or bytes that stand where one should.

    Shape: `place` of the frame; it has the next number if that is not given. `sent`: whether the host sent it, None if
        that is unknown.

    >>> line, heard = hear_frame(Line(), b"$012\r", Protocol.DCON)
    >>> line, heard = hear_frame(line, b"!010F0600\r", Protocol.DCON)
    >>> heard.answers.where, heard.meanings[0].fields[1].text, line.knowledge.of(0x01).known.types
    ('frame 1', '0F, thermocouple K, -270..1372 degC', (<TypeCode.K: 15>,))
    """
    if line.__class__ is not Line:  # in place, as this is done for every frame
        raise ArgumentError("line", line, "Line")
    if protocol.__class__ is not Protocol:
        raise ArgumentError("protocol", protocol, "Protocol")
    if place is None:
        place = _next(line)
    elif place.__class__ is not Place or place.number.__class__ is not int:
        raise ArgumentError("place", place, "Place, with a number")
    if sent is not None:
        check_type("sent", sent, bool)
    return _hear(line, wire if wire.__class__ is bytes else as_bytes("wire", wire), protocol, place, sent=sent)


def _hear(line: Line, wire: bytes, protocol: Protocol, place: Place, *, sent: bool | None) -> tuple[Line, Heard]:
    if not wire:
        error = DecodeError(Fault.LENGTH, wire, allowed="a frame")
        return updated(line, count=place.number), Heard(place, wire, protocol, error=error)
    if protocol is Protocol.DCON:
        return hear_dcon(line, wire, place, sent)
    return (hear_modbus if wire[0] else hear_broadcast)(line, wire, place, sent)


def _next(line: Line, where: str | None = None) -> Place:
    return Place(line.count + 1, where or f"frame {line.count + 1}")
