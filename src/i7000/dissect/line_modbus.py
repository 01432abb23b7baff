"""The listener's half by Modbus RTU: a frame -> what it means after those that were heard before it."""

from functools import lru_cache
from typing import Any

from attrs import evolve

from i7000 import modbus
from i7000.dissect.causes import address_notes, modbus_causes, register_notes
from i7000.dissect.heard import Asked, Direction, Heard, Line, Place
from i7000.dissect.known import Known
from i7000.dissect.learn import learn, with_facts
from i7000.dissect.meaning import Meaning
from i7000.dissect.modbus import ModbusRead, ModbusReader
from i7000.errors import DecodeError, EncodeError, Fault
from i7000.settings import Protocol

__all__ = ["hear_modbus"]

_READERS = 64
"""Combinations of what is known of a module, of which the readers are kept."""
_ANOTHER = (Fault.ADDRESS, Fault.FUNCTION, Fault.SUB_FUNCTION)
"""Faults of a response to another request."""


@lru_cache(maxsize=_READERS)
def _modbus_reader(known: Known) -> tuple[ModbusReader, tuple[str, ...]]:
    """Return the reader for a module; and what it contradicts that the module speaks Modbus at all."""
    try:
        return ModbusReader(known), ()
    except EncodeError:
        model = "the module" if known.model is None else f"an {known.model.value}"
        return ModbusReader(Known()), (f"a Modbus RTU frame, which {model} does not speak",)


def hear_modbus(line: Line, wire: bytes, place: Place) -> tuple[Line, Heard]:
    """Decode a frame after those before it, as a request, a response or an echo.

    Special: what is the same as the request before it is its response where it can be, unless the line is known to
        echo; a line is known to echo when a request came twice that cannot be its own response.
    """
    address = wire[0]
    module = line.knowledge.of(address or None)
    reader, contradictions = _modbus_reader(module.known)
    asked = line.requested
    response = ModbusRead(None)
    if asked is not None and asked.meaning is not None and asked.address != modbus.BROADCAST:
        asked_reader, _ = _modbus_reader(line.knowledge.of(asked.address).known)
        response = asked_reader.response(wire, asked.meaning)

    def heard(direction: Direction | None, meaning: Meaning | None = None, **others: Any) -> Heard:  # noqa: ANN401
        meanings = () if meaning is None else (with_facts(meaning, module),)
        notes = (*(meaning.notes if meaning else ()), *others.pop("notes", ()))
        wrong = (*contradictions, *others.pop("contradictions", ()))
        return Heard(
            place, wire, Protocol.MODBUS_RTU, direction, address, meanings, notes=notes, contradictions=wrong, **others
        )

    if asked and wire == asked.wire and not asked.echoed and (response.meaning is None or line.echoes):
        line = evolve(line, requested=evolve(asked, echoed=True), echoes=True)
        same = f"the same as {asked.place.where}: a 2-wire adapter's echo, or asked again"
        return line, heard(Direction.ECHO, asked.meaning, same_as=asked.place, notes=(same,))
    if asked and response.meaning:
        line = evolve(line, requested=None, in_step=True, echoes=asked.echoed)
        line, wrong = learn(line, address, response.meaning, place.where)
        return line, heard(Direction.RESPONSE, response.meaning, answers=asked.place, contradictions=wrong)
    request, alone = reader.request(wire), reader.alone(wire)
    if request.meaning:
        note = _doubt(alone.meaning, response.error, asked, in_step=line.in_step)
        notes = (*((note,) if note else ()), *register_notes(request.meaning), *address_notes(address, line.knowledge))
        answered = address != modbus.BROADCAST
        line = evolve(line, requested=Asked(place, wire, address, request.meaning), in_step=not answered)
        return line, heard(Direction.REQUEST, request.meaning, notes=notes)
    if alone.meaning and not response.error:
        return line, heard(Direction.RESPONSE, alone.meaning, notes=("read without its request",))
    if not alone.meaning and len(wire) >= modbus.SHORTEST_FRAME:
        line = evolve(line, requested=None, in_step=False)
    candidates = (alone.meaning,) if alone.meaning else ()
    direction = Direction.RESPONSE if alone.meaning else None
    causes = tuple(modbus_causes(wire, reader))
    return line, heard(direction, error=response.error or request.error, candidates=candidates, notes=causes)


def _doubt(alone: Meaning | None, fault: DecodeError | None, asked: Asked | None, *, in_step: bool) -> str | None:
    """Return what else a request could be."""
    if alone and asked and fault and fault.fault not in _ANOTHER:
        return f"or a wrong response to {asked.place.where}: {fault}"
    if alone and not asked and not in_step:
        return f"or a response, {type(alone.message).__name__}, of which the request is not there"
    return None
