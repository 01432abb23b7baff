"""The listener's half by DCON: a frame -> what it means after those that were heard before it."""

from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

from i7000 import describe
from i7000.dissect.causes import address_notes, dcon_causes
from i7000.dissect.dcon import DconReader, is_command
from i7000.dissect.dcon import reader as reader_of
from i7000.dissect.heard import Asked, Commands, Direction, Heard, Line, Place
from i7000.dissect.known import Fact, Known, Module, fact_words
from i7000.dissect.learn import learn, with_facts
from i7000.dissect.meaning import Meaning
from i7000.errors import DecodeError
from i7000.profile import Profile
from i7000.settings import Protocol
from i7000.type_codes import MIXED

__all__ = ["hear_dcon"]

_REMEMBERED = 512
"""Exchanges that are not read again when they come again: a host that polls hears the same again and again."""


def hear_dcon(line: Line, wire: bytes, place: Place) -> tuple[Line, Heard]:
    """Hear a frame, which is a command or a response by its leading character."""
    return (_hear_command if is_command(wire) else _hear_response)(line, wire, place)


def _hear_command(line: Line, wire: bytes, place: Place) -> tuple[Line, Heard]:
    knowledge, (before, unanswered, _, answer) = line.knowledge, line.commands
    address = _dcon_address(wire)
    read = _read_dcon(knowledge.of(address), wire, None)
    notes = read.notes
    if knowledge.modules:
        notes = (*notes, *address_notes(address, knowledge))
    same_as = None
    if before is None or before.wire != wire:
        unanswered = before
    else:
        same_as = before.place
        notes = (*notes, f"the same as {same_as.where}: an echo, or asked again")
    asked = Asked(place, wire, address) if read.error is None else None
    commands = Commands(asked, unanswered, None, answer)
    return Line(knowledge, line.protocol, line.rest, place.number, commands, line.requests), Heard(
        place, wire, Protocol.DCON, Direction.COMMAND, address, read.meanings, None, same_as, notes, read.error, (),
        read.contradictions,
    )  # fmt: skip


def _hear_response(line: Line, wire: bytes, place: Place) -> tuple[Line, Heard]:
    knowledge, commands = line.knowledge, line.commands
    asked, _, before, answer = commands
    address = _dcon_address(wire)
    if address is None and asked is not None:
        address = asked.address
    module = knowledge.of(address)
    read = _read_dcon(module, wire, None if asked is None else asked.wire)
    notes, contradictions = read.notes, read.contradictions
    late = commands.unanswered
    if asked is not None and late is not None and read.error is not None and _answers(module, wire, late):
        read, asked = _read_dcon(module, wire, late.wire), late
        notes, contradictions = read.notes, read.contradictions
        notes = (*notes, f"a late answer: {late.place.where} asked for it, before the last command")
    elif asked is None and before is not None and _answers(module, wire, before):
        if wire == answer:
            notes = (*notes, f"the same again: an answer to {before.place.where} that was printed twice?")
        else:
            second = f"a second answer to {before.place.where}: two modules on one address?"
            contradictions = (*contradictions, second)
    answers = None
    if asked is not None and read.answers:
        answers, commands = asked.place, Commands(None, None, asked, wire)
    elif read.error is None:
        commands = Commands(None, None, before, wire)
    if address is not None and read.error is None and len(read.meanings) == 1:
        knowledge, wrong = learn(knowledge, address, read.meanings[0], place.where, read.shown)
        contradictions += wrong
    return Line(knowledge, line.protocol, line.rest, place.number, commands, line.requests), Heard(
        place, wire, Protocol.DCON, Direction.RESPONSE, address, read.meanings, answers, None, notes, read.error,
        read.candidates, contradictions,
    )  # fmt: skip


def _answers(module: Module, wire: bytes, asked: Asked) -> bool:
    read = _read_dcon(module, wire, asked.wire)
    return read.answers and read.error is None


class _Read(NamedTuple):
    """What a frame is by DCON, wherever it stands."""

    meanings: tuple[Meaning, ...] = ()
    error: DecodeError | None = None
    candidates: tuple[Meaning, ...] = ()
    notes: tuple[str, ...] = ()
    contradictions: tuple[str, ...] = ()
    shown: tuple[str, ...] = ()
    """What the frame shows by itself: names of facts whose factory default it does not fit."""

    @property
    def answers(self) -> bool:
        return any(meaning.command for meaning in self.meanings)


def _dcon_address(wire: bytes) -> int | None:
    """Return the address of a frame that has one; None for those to all modules, and for reports."""
    digits = wire[1:3]
    if wire[:1] == b">" or len(digits) < len("AA") or digits.strip(b"0123456789ABCDEF"):
        return None
    return int(digits, 16)


@lru_cache(maxsize=_REMEMBERED)
def _read_dcon(module: Module, wire: bytes, asked: bytes | None) -> _Read:
    try:
        meanings, dropped = _dcon_meanings(module, wire, asked)
    except DecodeError as error:
        reader = reader_of(module.known)
        candidates = () if asked is None else _alone(reader, wire)
        causes = tuple(dcon_causes(wire, reader, module.known, asked))
        return _Read(error=error.with_traceback(None), candidates=candidates, notes=causes)
    contradictions = tuple(f"not {fact_words(fact)}, which {fact.where} said" for fact in dropped)
    known = module.known
    shown = _differences(known, meanings) if not dropped else ()
    notes = (f"not as from the factory: {', '.join(_SHOWN[name] for name in shown)}",) if shown else ()
    for meaning in meanings:
        lacking = _lacking(meaning)
        if lacking and meaning.command is not None:
            contradictions = (*contradictions, lacking)
        elif lacking:
            notes = (*notes, lacking)
    meanings = tuple(with_facts(meaning, module) for meaning in meanings)
    return _Read(meanings, meanings[0].misfit, (), notes, contradictions, shown)


def _dcon_meanings(module: Module, wire: bytes, asked: bytes | None) -> tuple[tuple[Meaning, ...], tuple[Fact, ...]]:
    """Read a frame with what is known; or without some of what was learned, which it contradicts then."""
    found: tuple[Meaning, ...] = ()
    fault: DecodeError | None = None
    try:
        found = reader_of(module.known).meanings(wire, asked)
    except DecodeError as error:
        fault = error
    if found and not found[0].misfit:
        return found, ()
    learned = module.learned
    for facts in (*((fact,) for fact in learned), learned if len(learned) > 1 else ()):
        known = module.without(fact.name for fact in facts).known
        try:
            others = reader_of(known).meanings(wire, asked) if facts else ()
        except DecodeError:
            continue
        if others and not others[0].misfit:
            return others, facts
    if fault is not None:
        raise fault
    return found, ()


def _alone(reader: DconReader, wire: bytes) -> tuple[Meaning, ...]:
    """Return what a frame could be that does not answer the command before it."""
    try:
        return reader.meanings(wire)
    except DecodeError:
        return ()


_SHOWN = {
    "data_format": "another data format",
    "checksum": "with a checksum",
    "single_ended": "single-ended",
    "firmware": "a firmware of before B1.5",
}
"""What a frame can show whose factory default it does not fit."""


def _differences(known: Known, meanings: tuple[Meaning, ...]) -> tuple[str, ...]:
    """Return what is not as the factory defaults have it, which are assumed if the model is known."""
    default = known.default
    if default is None or any(default in meaning.fit.profiles for meaning in meanings):
        return ()
    profiles = [profile for meaning in meanings for profile in meaning.fit.profiles]
    return tuple(
        name
        for name in _SHOWN
        if getattr(known, name) is None and all(getattr(it, name) != getattr(default, name) for it in profiles)
    )


def _lacking(meaning: Meaning) -> str | None:
    """Say that a message has a type that the model does not have."""
    code = getattr(meaning.message, "type_code", None)
    profiles = meaning.fit.profiles
    if code is None or code == MIXED or len(meaning.fit.models) != 1 or any(map(_supporting(code), profiles)):
        return None
    model = profiles[0].model.value
    words = describe.type_code(code)
    if meaning.command is None:
        return f"type {words}: none that an {model} can have; it answers ?AA"
    return f"type {words}: none that an {model} can have; another model?"


def _supporting(code: int) -> Callable[[Profile], bool]:
    return lambda profile: profile.supports(code)
