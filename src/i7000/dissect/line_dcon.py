"""The listener's half by DCON: a frame -> what it means after those that were heard before it."""

from functools import lru_cache
from typing import NamedTuple

from attrs import evolve

from i7000 import dcon
from i7000.dcon.frame import LONGEST_FRAME
from i7000.dissect.causes import address_notes, dcon_causes
from i7000.dissect.dcon import DconReader, is_command
from i7000.dissect.dcon import reader as reader_of
from i7000.dissect.heard import Asked, Commands, Direction, Heard, Line, Place, updated
from i7000.dissect.known import Fact, Known, Module, fact_words, lacking_type
from i7000.dissect.learn import doubt, learn, trust, with_facts
from i7000.dissect.meaning import Meaning
from i7000.errors import DecodeError
from i7000.settings import Protocol

__all__ = ["hear_dcon"]

_REMEMBERED = 512
"""Exchanges that are not read again when they come again: a host that polls hears the same again and again."""


def hear_dcon(line: Line, wire: bytes, place: Place, sent: bool | None) -> tuple[Line, Heard]:  # noqa: FBT001
    """Read a frame, which is a command or a response by its leading character; `sent`: whether the host sent it."""
    command = is_command(wire)
    line, heard = (_hear_command if command else _hear_response)(line, wire, place)
    if sent is None or sent is command:
        return line, heard
    note = "a command that the host received: an echo, or another host?" if command else "a response that the host sent"
    return line, evolve(heard, notes=(*heard.notes, note))


def _hear_command(line: Line, wire: bytes, place: Place) -> tuple[Line, Heard]:
    knowledge, (before, unanswered, _, answer) = line.knowledge, line.commands
    address = _dcon_address(wire)
    read = _read_dcon(knowledge.of(address), wire, None)
    notes = read.notes
    if knowledge.modules and address not in knowledge.modules:
        notes = (*notes, *address_notes(address, knowledge))
    same_as = None
    if before is None or before.wire != wire:
        unanswered = before
    else:
        same_as = before.place
        notes = (*notes, f"the same as {same_as.where}: an echo, or asked again")
    asked = Asked(place, wire, address) if read.error is None else None
    commands = Commands(asked, unanswered, None, answer)
    return updated(line, count=place.number, commands=commands), Heard(
        place, wire, Protocol.DCON, Direction.COMMAND, address, read.meanings, None, same_as, notes, read.error, (),
        read.contradictions,
    )  # fmt: skip


def _hear_response(line: Line, wire: bytes, place: Place) -> tuple[Line, Heard]:
    knowledge, commands = line.knowledge, line.commands
    asked, _, before, answer = commands
    address = _dcon_address(wire)
    if address is None and asked is not None:
        address = asked.address
    module = knowledge.of(_sender(wire, address, asked))
    read = _read_dcon(module, wire, None if asked is None else asked.wire)
    notes, contradictions = read.notes, read.contradictions
    late = _late(line, wire, read)
    if late is not None:
        asked, address, module = late
        read = _read_dcon(module, wire, asked.wire)
        notes = (*read.notes, f"a late answer: {asked.place.where} asked for it, before the last command")
        contradictions = read.contradictions
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
    sender = _sender(wire, address, asked)
    if sender is not None and (read.dropped or module.in_doubt) and read.meanings:
        kind = type(read.meanings[0].message).__name__
        doubted = doubt(module, read.dropped, kind) if read.dropped else module if read.error else trust(module, kind)
        knowledge = knowledge.put(sender, doubted)
    if sender is not None and read.error is None and len(read.meanings) == 1:
        knowledge, wrong = learn(knowledge, sender, read.meanings[0], place.where, read.shown)
        if wrong:
            contradictions = tuple(dict.fromkeys((*contradictions, *wrong)))
    return updated(line, knowledge=knowledge, count=place.number, commands=commands), Heard(
        place, wire, Protocol.DCON, Direction.RESPONSE, address, read.meanings, answers, None, notes, read.error,
        read.candidates, contradictions,
    )  # fmt: skip


def _late(line: Line, wire: bytes, read: "_Read") -> tuple[Asked, int | None, Module] | None:
    """Return the command before the last that a response answers, its address and module; None if it does not."""
    asked, late, _, _ = line.commands
    if asked is None or late is None or (read.error is None and not read.dropped):
        return None
    own = _dcon_address(wire)
    address = late.address if own is None else own
    module = line.knowledge.of(_sender(wire, address, late))
    return (late, address, module) if _answers(module, wire, late) else None


def _sender(wire: bytes, address: int | None, asked: Asked | None) -> int | None:
    """Return the address that a module had when it was asked: what accepts a new address answers with that (2.1)."""
    if asked is not None and asked.wire[:1] == b"%" and asked.wire[3:5] == wire[1:3]:
        return asked.address
    return address


def _answers(module: Module, wire: bytes, asked: Asked) -> bool:
    read = _read_dcon(module, wire, asked.wire)
    return read.answers and read.error is None and not read.dropped


class _Read(NamedTuple):
    """A DCON frame, wherever it stands."""

    meanings: tuple[Meaning, ...] = ()
    error: DecodeError | None = None
    candidates: tuple[Meaning, ...] = ()
    notes: tuple[str, ...] = ()
    contradictions: tuple[str, ...] = ()
    shown: tuple[str, ...] = ()
    """What the frame shows by itself: names of facts whose factory default it does not fit."""
    dropped: tuple[str, ...] = ()
    """Names of the facts that were learned, and that it contradicts: they are in doubt, or dropped if they were."""
    answers: bool = False
    """Whether it answers the command that it was read with."""


def _dcon_address(wire: bytes) -> int | None:
    """Return the address of a frame that has one; None for those to all modules, and for reports."""
    digits = wire[1:3]
    if wire[:1] == b">" or len(digits) < len("AA") or digits.strip(b"0123456789ABCDEF"):
        return None
    return int(digits, 16)


def _read_dcon(module: Module, wire: bytes, asked: bytes | None) -> _Read:
    """Read a frame; one that is too long is not remembered."""
    return (_remembered if len(wire) <= LONGEST_FRAME else _read)(module, wire, asked)


def _read(module: Module, wire: bytes, asked: bytes | None) -> _Read:
    try:
        meanings, dropped = _dcon_meanings(module, wire, asked)
    except DecodeError as error:
        reader = reader_of(module.known)
        candidates = () if asked is None else _alone(reader, wire)
        causes = tuple(dcon_causes(wire, module, asked))
        return _Read(error=error.with_traceback(None), candidates=candidates, notes=causes)
    contradictions = tuple(map(_refuted, dropped))
    known = module.known
    shown, differing = _differences(known, meanings) if not dropped else ((), "")
    notes = (f"not as from the factory: {differing}",) if differing else ()
    for meaning in meanings:
        lacking = _lacking(meaning, known)
        if lacking and meaning.command is not None:
            contradictions = (*contradictions, lacking)
        elif lacking:
            notes = (*notes, lacking)
    meanings = tuple(with_facts(meaning, module) for meaning in meanings)
    if dropped:
        meanings = tuple(evolve(meaning, refuted=dropped) for meaning in meanings)
    names = tuple(fact.name for fact in dropped)
    answers = any(meaning.command for meaning in meanings)
    return _Read(meanings, meanings[0].misfit, (), notes, contradictions, shown, names, answers)


_remembered = lru_cache(maxsize=_REMEMBERED)(_read)


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
    dropped = module.learned
    others = _read_without(module, dropped, wire, asked) if dropped else None
    if others is None:
        if fault is not None:
            raise fault
        return found, ()
    for fact in reversed(dropped):  # what need not be dropped is kept
        fewer = tuple(it for it in dropped if it is not fact)
        read = _read_without(module, fewer, wire, asked)
        if read is not None:
            dropped, others = fewer, read
    return others, dropped


def _read_without(
    module: Module, facts: tuple[Fact, ...], wire: bytes, asked: bytes | None
) -> tuple[Meaning, ...] | None:
    """Read a frame without some of what was learned; None if that does not make it readable."""
    try:
        found = reader_of(module.without(fact.name for fact in facts).known).meanings(wire, asked)
    except DecodeError:
        return None
    return None if found[0].misfit else found


def _refuted(fact: Fact) -> str:
    """Return that a frame does not fit what was learned."""
    if fact.name == "checksum":
        return f"no checksum, but {fact.where} had one" if fact.value else f"a checksum, but {fact.where} had none"
    return f"not {fact_words(fact)}, which {fact.where} said"


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


def _differences(known: Known, meanings: tuple[Meaning, ...]) -> tuple[tuple[str, ...], str]:
    """Return what is certainly not as from the factory, which is assumed if the model is known; and that in words."""
    default = known.default
    if default is None:
        sealed = known.checksum is None and all(meaning.checksum for meaning in meanings)
        return (("checksum",) if sealed else ()), ""
    if any(default in meaning.fit.profiles for meaning in meanings):
        return (), ""
    profiles = [profile for meaning in meanings for profile in meaning.fit.profiles]
    unknown = {name: getattr(default, name) for name in _SHOWN if getattr(known, name) is None}
    certain = [name for name, value in unknown.items() if all(getattr(it, name) != value for it in profiles)]
    if certain:
        shown = tuple(name for name in certain if name != "firmware")  # There is no version to be learned.
        return shown, ", ".join(_SHOWN[name] for name in certain)
    if not all(meaning.readings for meaning in meanings):  # one of them depends on neither
        return (), ""
    formats = {"another data format" for it in profiles if it.data_format is not default.data_format}
    return (), " or ".join(("another type", *formats))


def _lacking(meaning: Meaning, known: Known) -> str | None:
    """Return a note that a message has a type that the model does not have; None otherwise."""
    lacking = lacking_type(known, getattr(meaning.message, "type_code", None))
    if lacking is None:
        return None
    return f"{lacking}; {'it answers ?AA' if isinstance(meaning.message, dcon.Command) else 'another model?'}"
