"""The state of the listener, and what it found out about each frame."""

from enum import StrEnum
from types import NoneType
from typing import Any, NamedTuple

from attrs import field, frozen

from i7000.arguments import check_fields
from i7000.dissect.known import Knowledge
from i7000.dissect.meaning import Meaning
from i7000.errors import DecodeError
from i7000.settings import Protocol

__all__ = ["Asked", "Commands", "Direction", "Heard", "Line", "Place", "Requests", "updated"]


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


@frozen
class Asked:
    """The last command or request."""

    place: Place
    wire: bytes
    address: int | None
    meaning: Meaning | None = None
    """Its meaning, if it is a Modbus request."""
    echoed: bool = False


class Commands(NamedTuple):
    """What was heard by DCON, as far as it matters for what comes next."""

    asked: Asked | None = None
    """The command that has no answer yet."""
    unanswered: Asked | None = None
    """The command before that, if it has none either."""
    answered: Asked | None = None
    """The command that was answered last, until the next one."""
    answer: bytes = b""
    """The response that was heard last."""


class Requests(NamedTuple):
    """What was heard by Modbus, as far as it matters for what comes next."""

    asked: Asked | None = None
    """The request that has no answer yet."""
    in_step: bool = False
    """Whether a request is what comes next."""
    echoes: bool = False
    """Whether the adapter hears what it sends."""


@frozen(slots=False)  # so that a copy is one dictionary
class Line:
    """Both sides of a line, as far as they were heard.

    Errors: `InvalidValueError` for fields of other types.
    """

    knowledge: Knowledge = field(factory=Knowledge)
    protocol: Protocol | None = None
    """The only protocol on the line; None if both are possible."""
    rest: bytes = b""
    """Bytes that can still become a frame."""
    count: int = 0
    """The number of the last frame."""
    commands: Commands = field(factory=Commands)
    requests: Requests = field(factory=Requests)

    def __attrs_post_init__(self) -> None:
        check_fields(self, _KINDS)


_KINDS: dict[str, tuple[type, ...]] = {
    "knowledge": (Knowledge,),
    "protocol": (Protocol, NoneType),
    "rest": (bytes,),
    "count": (int,),
    "commands": (Commands,),
    "requests": (Requests,),
}
"""What each field of `Line` can be."""


def updated(line: Line, **changes: Any) -> Line:  # noqa: ANN401 - fields of `Line`
    """Return a line of which more was heard; its fields are not looked at again, as `evolve` would."""
    copy = object.__new__(Line)
    object.__setattr__(copy, "__dict__", {**line.__dict__, **changes})
    return copy
