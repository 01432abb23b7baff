"""The listener's half by DCON: a frame -> what it means after those that were heard before it."""

from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

from attrs import evolve

from i7000 import describe
from i7000.dissect.causes import address_notes, dcon_causes
from i7000.dissect.dcon import DconReader, is_command
from i7000.dissect.dcon import reader as reader_of
from i7000.dissect.heard import Asked, Direction, Heard, Line, Place
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
    """Decode a frame after those before it; its leading character makes it a command or a response."""
    return (_hear_command if is_command(wire) else _hear_response)(line, wire, place)


def _hear_command(line: Line, wire: bytes, place: Place) -> tuple[Line, Heard]:
    address = _dcon_address(wire)
    read = _read_dcon(line.knowledge.of(address), wire, None)
    before, notes = line.asked, (*read.notes, *address_notes(address, line.knowledge))
    same = before is not None and before.wire == wire
    if before is not None and same:
        notes = (*notes, f"the same as {before.place.where}: an echo, or asked again")
    asked = Asked(place, wire, address) if read.error is None else None
    unanswered = line.unanswered if same else before
    heard = Heard(
        place, wire, Protocol.DCON, Direction.COMMAND, address, read.meanings,
        same_as=before.place if before is not None and same else None,
        notes=notes, error=read.error, contradictions=read.contradictions,
    )  # fmt: skip
    return evolve(line, asked=asked, unanswered=unanswered, answered=None), heard


def _hear_response(line: Line, wire: bytes, place: Place) -> tuple[Line, Heard]:
    asked = line.asked
    address = _dcon_address(wire)
    if address is None and asked is not None:
        address = asked.address
    module = line.knowledge.of(address)
    read = _read_dcon(module, wire, None if asked is None else asked.wire)
    asked, read, more = _out_of_turn(line, module, wire, asked, read)
    notes, contradictions = (*read.notes, *more), read.contradictions
    if asked is None and line.answered is not None and _answers(module, wire, line.answered):
        if wire == line.answer:
            notes = (*notes, f"the same again: an answer to {line.answered.place.where} that was printed twice?")
        else:
            second = f"a second answer to {line.answered.place.where}: two modules on one address?"
            contradictions = (*contradictions, second)
    answered = asked is not None and read.answers
    if answered or read.error is None:
        line = evolve(line, asked=None, unanswered=None, answered=asked if answered else line.answered, answer=wire)
    if address is not None and read.error is None and len(read.meanings) == 1:
        line, wrong = learn(line, address, read.meanings[0], place.where, read.shown)
        contradictions = (*contradictions, *wrong)
    return line, Heard(
        place, wire, Protocol.DCON, Direction.RESPONSE, address, read.meanings,
        answers=asked.place if asked is not None and answered else None,
        notes=notes, error=read.error, candidates=read.candidates, contradictions=contradictions,
    )  # fmt: skip


def _out_of_turn(
    line: Line, module: Module, wire: bytes, asked: Asked | None, read: "_Read"
) -> tuple[Asked | None, "_Read", tuple[str, ...]]:
    """Return what a response answers: if it cannot be the last command, the one before that, which has no answer."""
    late = line.unanswered
    if asked is None or late is None or read.error is None or not _answers(module, wire, late):
        return asked, read, ()
    note = f"a late answer: {late.place.where} asked for it, before the last command"
    return late, _read_dcon(module, wire, late.wire), (note,)


def _answers(module: Module, wire: bytes, asked: Asked) -> bool:
    read = _read_dcon(module, wire, asked.wire)
    return read.answers and read.error is None


class _Read(NamedTuple):
    """A DCON frame, wherever it stands."""

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
    """Return a note if a message has a type that the model lacks."""
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
