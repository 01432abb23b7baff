"""The listener's half by Modbus RTU: a frame -> what it means after those that were heard before it."""

from collections.abc import Iterator
from functools import lru_cache

from attrs import evolve

from i7000 import modbus
from i7000.dissect.causes import address_notes, modbus_causes, register_notes
from i7000.dissect.exchanges import TEACHING
from i7000.dissect.heard import Asked, Direction, Heard, Line, Place, Requests, updated
from i7000.dissect.known import Known
from i7000.dissect.learn import learn, learn_from_broadcast, with_facts
from i7000.dissect.meaning import Meaning
from i7000.dissect.modbus import ModbusRead, ModbusReader
from i7000.errors import DecodeError, EncodeError, Fault
from i7000.settings import Protocol

__all__ = ["hear_broadcast", "hear_modbus"]

_NOTHING = ModbusRead(None)
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


def hear_modbus(line: Line, wire: bytes, place: Place, sent: bool | None) -> tuple[Line, Heard]:  # noqa: FBT001
    """Read a frame, which can be a request, a response or an echo; `sent`: whether the host sent it.

    Special: what is the same as the request before it is its response where it can be, unless the line is known to
        echo; a line is known to echo when a request came twice that cannot be its own response.
    """
    address, knowledge = wire[0], line.knowledge
    module = knowledge.of(address or None)
    reader, contradictions = _modbus_reader(module.known)
    asked, in_step, echoes = line.requests
    if len(wire) > modbus.LONGEST_FRAME:
        error: DecodeError | None = reader.request.__wrapped__(wire).error  # it is too long to be remembered
        causes = tuple(modbus_causes(wire, reader))
        line = updated(line, count=place.number, requests=Requests(None, in_step=False, echoes=echoes))
        return line, Heard(place, wire, Protocol.MODBUS_RTU, address=address, error=error, notes=causes)
    response = _NOTHING
    if asked is not None and asked.meaning is not None and asked.address != modbus.BROADCAST and not sent:
        asked_reader, _ = _modbus_reader(knowledge.of(asked.address).known)
        response = asked_reader.response(wire, asked.meaning)
    direction: Direction | None = Direction.RESPONSE
    meaning = response.meaning
    error = None
    notes: tuple[str, ...] = ()
    answers = same_as = None
    candidates: tuple[Meaning, ...] = ()
    requests = line.requests
    if asked and wire == asked.wire and not asked.echoed and not sent and (meaning is None or echoes):
        requests = Requests(evolve(asked, echoed=True), in_step, echoes=True)
        direction, meaning, same_as = Direction.ECHO, asked.meaning, asked.place
        notes = (f"the same as {asked.place.where}: a 2-wire adapter's echo, or asked again",)
    elif asked and meaning:
        requests, answers = Requests(None, in_step=True, echoes=asked.echoed), asked.place
        knowledge, wrong = learn(knowledge, address, meaning, place.where)
        contradictions += wrong
    else:
        request = _NOTHING if sent is False else reader.request(wire)
        alone = _NOTHING if sent else reader.alone(wire)
        if request.meaning:
            direction, meaning = Direction.REQUEST, request.meaning
            notes = tuple(_request_notes(request.meaning, alone.meaning, response.error, line))
            requests = Requests(Asked(place, wire, address, meaning), address == modbus.BROADCAST, echoes)
        elif alone.meaning and not response.error:
            meaning, notes = alone.meaning, ("read without its request",)
        else:
            error, notes = response.error or request.error or alone.error, tuple(modbus_causes(wire, reader))
            if alone.meaning:
                candidates = (alone.meaning,)
            else:
                direction = None
                if len(wire) >= modbus.SHORTEST_FRAME:
                    requests = Requests(None, in_step=False, echoes=echoes)
    meanings: tuple[Meaning, ...] = ()
    if meaning is not None:
        meanings, notes = (with_facts(meaning, module),), meaning.notes + notes
    return updated(line, knowledge=knowledge, count=place.number, requests=requests), Heard(
        place, wire, Protocol.MODBUS_RTU, direction, address, meanings, answers, same_as, notes, error, candidates,
        contradictions,
    )  # fmt: skip


def hear_broadcast(line: Line, wire: bytes, place: Place, sent: bool | None) -> tuple[Line, Heard]:  # noqa: FBT001
    """Read a frame of address 0, which can be a request to all modules: all of them are taken to follow it (E94)."""
    line, heard = hear_modbus(line, wire, place, sent)
    if heard.direction is Direction.REQUEST:
        line = updated(line, knowledge=learn_from_broadcast(line.knowledge, heard.meanings[0], place.where))
    return line, heard


def _request_notes(request: Meaning, alone: Meaning | None, fault: DecodeError | None, line: Line) -> Iterator[str]:
    """Yield what has to be known of a request: what else it could be, and what is likely to be meant."""
    asked, in_step, _ = line.requests
    if alone and asked and fault and fault.fault not in _ANOTHER:
        yield f"or a wrong response to {asked.place.where}: {fault}"
    elif alone and not asked and not in_step:
        yield f"or a response, {type(alone.message).__name__}, of which the request is not there"
    if getattr(request.message, "address", None) == modbus.BROADCAST and type(request.message) in TEACHING:
        yield "a broadcast, which no module confirms: taken to hold from here on for all that have the register (E94)"
    yield from register_notes(request)
    yield from address_notes(getattr(request.message, "address", None), line.knowledge)
