"""The state of the listener, and what it found out about each frame."""

from enum import StrEnum
from typing import NamedTuple

from attrs import field, frozen

from i7000.dissect.known import Knowledge
from i7000.dissect.meaning import Meaning
from i7000.errors import DecodeError
from i7000.settings import Protocol

__all__ = ["Asked", "Direction", "Heard", "Line", "Place"]


class Place(NamedTuple):
    """The place of a frame in the traffic."""

    number: int
    """The number of the frame, from 1, unless the caller numbers them differently."""
    where: str
    """The place in words, for notes on other frames: ``frame 3``."""


class Direction(StrEnum):
    """The direction of a frame: who sent it."""

    COMMAND = "command"
    """The host, by DCON."""
    REQUEST = "request"
    """The host, by Modbus."""
    RESPONSE = "response"
    """A module."""
    ECHO = "echo"
    """The host's own adapter, which receives what it sends."""


@frozen(eq=False)
class Heard:
    """A frame, or bytes that are not one, with their meanings or the error."""

    place: Place
    wire: bytes
    protocol: Protocol
    direction: Direction | None = None
    address: int | None = None
    meanings: tuple[Meaning, ...] = ()
    """Its possible meanings; more than one if the frame is ambiguous."""
    answers: Place | None = None
    """The command or request that it answers."""
    same_as: Place | None = None
    """The frame of which it is an echo."""
    notes: tuple[str, ...] = ()
    error: DecodeError | None = None
    """Why it cannot be decoded; None if it can."""
    candidates: tuple[Meaning, ...] = ()
    """What a frame that is wrong in its place would mean elsewhere."""
    contradictions: tuple[str, ...] = ()
    """How it contradicts what was given or learned before."""

    @property
    def understood(self) -> bool:
        """Whether it is a good frame that fits what is known."""
        return self.error is None and not self.contradictions


@frozen(eq=False)
class Asked:
    """The last command or request."""

    place: Place
    wire: bytes
    address: int | None
    meaning: Meaning | None = None
    """Its meaning, if it is a Modbus request."""
    echoed: bool = False


@frozen
class Line:
    """The state of the listener: what was heard on a line so far."""

    knowledge: Knowledge = field(factory=Knowledge)
    protocol: Protocol | None = None
    """The only protocol on the line; None if both are possible."""
    rest: bytes = b""
    """Bytes that can still become a frame."""
    count: int = 0
    """The number of the last frame."""
    asked: Asked | None = None
    """The last DCON command, if it has no response yet."""
    unanswered: Asked | None = None
    """The DCON command before `asked`, if it has no response either."""
    requested: Asked | None = None
    """The last Modbus request, if it has no response yet."""
    answered: Asked | None = None
    """The DCON command that was answered last, until the next command."""
    answer: bytes = b""
    """The last DCON response."""
    in_step: bool = False
    """Whether the next Modbus frame must be a request."""
    echoes: bool = False
    """Whether the host's adapter echoes what it sends."""
