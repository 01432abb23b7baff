"""What a driver has met on a line: which commands it sent, and which kinds of answers it got.

Laws: pure. Every command of `i7000.dcon` and request of `i7000.modbus` has one row. A kind of answer is named by what
the traffic shows, or by the faults that a simulator or proxy has noted.
"""

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from enum import StrEnum
from typing import Any, NamedTuple

from attrs import define, field, frozen

from i7000 import dcon, modbus
from i7000.dcon.codec import COMMANDS
from i7000.dissect import Direction, Heard, Meaning
from i7000.fields import LEGACY_SENTINELS, Status
from i7000.message import Message
from i7000.models import Model
from i7000.profile import Profile
from i7000.settings import Protocol

__all__ = ["Coverage", "Kind", "Row", "Seen", "cover", "kinds_of"]


class Kind(StrEnum):
    """A kind of answer, or of what stands in place of one."""

    REFUSED = "?AA"
    EXCEPTION = "exception"
    SILENCE = "silence"
    LATE = "late answer"
    DAMAGED = "damaged answer"
    DAMAGED_REQUEST = "damaged request"
    TWICE = "answer that comes twice"
    EARLIER = "earlier answer"
    OTHER_ADDRESS = "answer with another address"
    OTHER_COMMAND = "answer to another command"
    PIECES = "answer in pieces"
    NOISE = "noise"
    LOOKALIKE = "noise like a frame"
    TRAILING = "00 after an answer"
    ECHO = "echo"
    OVER_RANGE = "over range"
    UNDER_RANGE = "under range"
    DISABLED = "disabled channel"
    SHORT = "+9999 or -0000"


_BY_NOTE = {
    Kind.LATE: r"late by|a late answer|too late|after its deadline",
    Kind.SILENCE: r"the answer is lost|an answer was lost",
    Kind.DAMAGED: r"flipped|byte \d+ lost|cut after",
    Kind.TWICE: r"sent twice|the same again",
    Kind.EARLIER: r"an earlier answer",
    Kind.OTHER_ADDRESS: r"with address",
    Kind.OTHER_COMMAND: r"with function|with . in place of",
    Kind.REFUSED: r"refused$",
    Kind.EXCEPTION: r"refused with exception",
    Kind.PIECES: r"in \d+ lumps|split after",
    Kind.NOISE: r"bytes of noise",
    Kind.LOOKALIKE: r"looks like it",
    Kind.TRAILING: r"00 after it",
}
_PATTERNS = {kind: re.compile(pattern) for kind, pattern in _BY_NOTE.items()}
_BY_STATUS = {
    Status.OVER_RANGE: Kind.OVER_RANGE,
    Status.UNDER_RANGE: Kind.UNDER_RANGE,
    Status.DISABLED: Kind.DISABLED,
}
_NOT_ANSWERED = {Kind.SILENCE, Kind.DAMAGED, Kind.EARLIER, Kind.OTHER_ADDRESS, Kind.OTHER_COMMAND}
"""Faults after which the host did not get the answer that the module sent."""
_ECHO_TIME = 0.05
"""The seconds within which the same command is an echo, and later one that is sent again."""


def kinds_of(note: str) -> set[Kind]:
    """Return the kinds that a note on traffic speaks of.

    >>> kinds_of("late by 0.3 s")
    {<Kind.LATE: 'late answer'>}
    """
    return {kind for kind, pattern in _PATTERNS.items() if pattern.search(note)}


class Seen(NamedTuple):
    """A frame that was heard, or bytes of which only notes are left."""

    heard: Heard | None
    notes: tuple[str, ...] = ()
    sent: bool | None = None
    """Whether the host sent it; None if that is unknown."""
    seconds: float | None = None


@frozen
class Row:
    """How often a command was sent, and what came of it."""

    kind: Any
    """The class of the command or request."""
    asked: int = 0
    answered: int = 0
    refused: int = 0
    silent: int = 0

    @property
    def key(self) -> str:
        """The section of a DCON command; the function of a request, with its sub-function."""
        if self.protocol is Protocol.DCON:
            section: str = self.kind.section
            return section
        sub = self.kind.sub_function
        return f"{self.kind.function:02X}" + ("" if sub is None else f"/{sub:02X}")

    @property
    def syntax(self) -> str:
        """The command or request in the notation of the manual."""
        syntax: str = self.kind.syntax if self.protocol is Protocol.DCON else self.kind.pdu
        return syntax

    @property
    def protocol(self) -> Protocol:
        """The protocol of the command."""
        return Protocol.DCON if self.kind in COMMANDS else Protocol.MODBUS_RTU


@frozen
class Coverage:
    """What was met on a line."""

    rows: tuple[Row, ...]
    """A row for each command and request that the models have."""
    kinds: Mapping[Kind, int]
    exceptions: Mapping[int, int]
    """How often each exception code came."""
    errata: Mapping[str, int]
    """How often a message came that each erratum concerns."""
    ambiguous: int = 0
    """Commands of which several meanings are possible: they are in no row."""
    others: int = 0
    """Commands that the given models do not have, or that cannot be decoded."""

    def group(self, name: str) -> tuple[Row, ...]:
        """Return the rows of ``commands`` (DCON), ``functions`` or ``sub-functions`` (of 46h)."""
        return tuple(row for row in self.rows if _group(row) == name)

    @property
    def never(self) -> tuple[Kind, ...]:
        """The kinds that were never met."""
        return tuple(kind for kind in Kind if not self.kinds.get(kind))


def _group(row: Row) -> str:
    if row.protocol is Protocol.DCON:
        return "commands"
    return "functions" if row.kind.sub_function is None else "sub-functions"


def cover(seen: Iterable[Seen], models: Iterable[Model] = ()) -> Coverage:
    """Return what was met in traffic; without `models`, the rows are those of all models."""
    profiles = [Profile(model) for model in models]
    kinds = [*COMMANDS, *modbus.REQUESTS]
    tally = _Tally({kind: Counter() for kind in kinds if _has(profiles, kind)})
    for one in seen:
        tally.add(one)
    tally.unanswered()
    return Coverage(
        tuple(Row(kind, **counts) for kind, counts in tally.rows.items()),
        dict(tally.kinds),
        dict(sorted(tally.exceptions.items())),
        dict(sorted(tally.errata.items())),
        tally.ambiguous,
        tally.others,
    )


def _has(profiles: list[Profile], kind: Any) -> bool:  # noqa: ANN401 - a class of either protocol
    """Return whether one of some modules has a command; all have it if there are none."""
    if not profiles:
        return True
    protocol = Protocol.DCON if kind in COMMANDS else Protocol.MODBUS_RTU
    return any(protocol in profile.model.protocols and kind.availability not in profile.refused for profile in profiles)


@define
class _Tally:
    rows: dict[Any, Counter[str]]
    kinds: Counter[Kind] = field(factory=Counter)
    exceptions: Counter[int] = field(factory=Counter)
    errata: Counter[str] = field(factory=Counter)
    ambiguous: int = 0
    others: int = 0
    _asked: Any = None
    """The class of the last command, if it still has no answer."""
    _asked_at: float | None = None

    def add(self, seen: Seen) -> None:
        noted = {kind for note in seen.notes for kind in kinds_of(note)}
        if seen.sent and Kind.DAMAGED in noted:
            noted = noted - {Kind.DAMAGED} | {Kind.DAMAGED_REQUEST}
        heard = seen.heard
        if heard is None:
            self.kinds.update(noted)
            return
        noted |= {kind for note in heard.notes for kind in kinds_of(note)}
        if heard.direction is Direction.ECHO:
            self.kinds.update(noted | {Kind.ECHO})
        elif heard.direction in (Direction.COMMAND, Direction.REQUEST) or seen.sent:
            self.kinds.update(noted)
            self._command(heard, seen.seconds)
        else:
            self._answer(heard, noted)

    def unanswered(self) -> None:
        """Count the last command as one without an answer, if it has none."""
        if self._asked is not None:
            self.rows[self._asked]["silent"] += 1
            self.kinds[Kind.SILENCE] += 1
        self._asked = None

    def _command(self, heard: Heard, seconds: float | None) -> None:
        if heard.same_as is not None and self._is_echo(seconds):
            self.kinds[Kind.ECHO] += 1
            return
        self.unanswered()
        found = {type(meaning.message) for meaning in heard.meanings}
        if len(found) > 1:
            self.ambiguous += 1
            return
        kind: Any = next(iter(found), None)
        if heard.error is not None or kind not in self.rows:
            self.others += 1
            self.kinds[Kind.DAMAGED_REQUEST] += heard.error is not None
            return
        self.rows[kind]["asked"] += 1
        self._concerned(heard.meanings[0])
        message: Any = heard.meanings[0].message
        codec: Any = dcon if kind in COMMANDS else modbus
        self._asked, self._asked_at = (kind if codec.is_answered(message) else None), seconds

    def _is_echo(self, seconds: float | None) -> bool:
        return seconds is not None and self._asked_at is not None and seconds - self._asked_at < _ECHO_TIME

    def _answer(self, heard: Heard, noted: set[Kind]) -> None:
        if heard.error is not None:
            noted |= {Kind.DAMAGED}
        for meaning in heard.meanings[:1]:
            self._concerned(meaning)
            noted |= set(_sensed(meaning))
            noted |= self._refusal(meaning.message)
        self.kinds.update(noted)
        if self._asked is None:
            return
        row = self.rows[self._asked]
        if noted & {Kind.REFUSED, Kind.EXCEPTION}:
            row["refused"] += 1
        elif noted & _NOT_ANSWERED:
            row["silent"] += 1
        else:
            row["answered"] += 1
        self._asked = None

    def _refusal(self, message: Message) -> set[Kind]:
        if isinstance(message, modbus.ExceptionResponse):
            self.exceptions[message.exception_code] += 1
            return {Kind.EXCEPTION}
        return {Kind.REFUSED} if isinstance(message, dcon.Refused) else set()

    def _concerned(self, meaning: Meaning) -> None:
        self.errata.update(meaning.errata)


def _sensed(meaning: Meaning) -> Iterator[Kind]:
    """Yield the kinds of the readings in an answer."""
    statuses = [(reading.status, reading.text) for reading in meaning.readings]
    statuses += [(item.reading.status, "") for item in meaning.items if item.reading is not None]
    for status, text in statuses:
        if text in LEGACY_SENTINELS:
            yield Kind.SHORT
        if status is not None and status in _BY_STATUS:
            yield _BY_STATUS[status]
