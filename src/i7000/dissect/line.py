"""The listener: bytes or frames of a line, one after the other -> their meanings.

A `Line` is the state: what was heard so far, and what is known about each module from it. `hear` takes bytes in any
pieces, `hear_frame` a single frame, as in a log.

Laws: every byte is in exactly one `Heard`, or in `Line.rest`. A frame never changes the result of an earlier one. No
bytes raise.
"""

from attrs import evolve

from i7000.arguments import as_bytes
from i7000.dissect.heard import Heard, Line, Place
from i7000.dissect.line_dcon import hear_dcon
from i7000.dissect.line_modbus import hear_modbus
from i7000.dissect.stream import split
from i7000.errors import DecodeError, Fault
from i7000.settings import Protocol

__all__ = ["flush", "hear", "hear_frame"]


def hear(line: Line, data: bytes, where: str | None = None) -> tuple[Line, tuple[Heard, ...]]:
    r"""Decode the next bytes of a stream; those that can still become a frame are kept in `Line.rest`.

    Shape: bytes in any pieces; `where` is their place in words, for notes on later frames: ``frame 3`` unless given.

    >>> line, heard = hear(Line(protocol=Protocol.DCON), b"$012\r!01")
    >>> line, more = hear(line, b"0F0600\r")
    >>> [type(it.meanings[0].message).__name__ for it in (*heard, *more)]
    ['ReadConfiguration', 'Configuration']
    """
    return _hear_split(line, line.rest + as_bytes("data", data), where, last=False)


def flush(line: Line, where: str | None = None) -> tuple[Line, tuple[Heard, ...]]:
    """Decode `Line.rest` at the end of the stream, or in a pause: nothing more belongs to it."""
    return _hear_split(line, line.rest, where, last=True)


def _hear_split(line: Line, data: bytes, where: str | None, *, last: bool) -> tuple[Line, tuple[Heard, ...]]:
    spans, rest = split(data, line.protocol, last=last)
    found = []
    for protocol, wire, fault in spans:
        if fault is None:
            line, heard = hear_frame(line, wire, protocol, _next(line, where))
        else:
            place = _next(line, where)
            line = evolve(line, count=place.number)
            heard = Heard(place, wire, protocol, error=DecodeError(fault, wire))
        found.append(heard)
    return evolve(line, rest=rest), tuple(found)


def hear_frame(line: Line, wire: bytes, protocol: Protocol, place: Place | None = None) -> tuple[Line, Heard]:
    r"""Decode a single frame, or bytes in the place of one.

    Shape: `place` of the frame; the next number unless given.

    >>> line, heard = hear_frame(Line(), b"$012\r", Protocol.DCON)
    >>> line, heard = hear_frame(line, b"!010F0600\r", Protocol.DCON)
    >>> heard.answers.where, heard.meanings[0].fields[1].text, line.knowledge.of(0x01).known.types
    ('frame 1', '0F, thermocouple K, -270..1372 degC', (<TypeCode.K: 15>,))
    """
    wire = as_bytes("wire", wire)
    place = place or _next(line)
    line = evolve(line, count=place.number)
    if not wire:
        return line, Heard(place, wire, protocol, error=DecodeError(Fault.LENGTH, wire, allowed="a frame"))
    return (hear_dcon if protocol is Protocol.DCON else hear_modbus)(line, wire, place)


def _next(line: Line, where: str | None = None) -> Place:
    return Place(line.count + 1, where or f"frame {line.count + 1}")
