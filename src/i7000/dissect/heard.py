"""What was heard of a line so far, and what was made of each frame."""

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
    """Where a frame stands."""

    number: int
    """Frames are counted from 1, unless the caller has other numbers."""
    where: str
    """In words, for notes on other frames: ``frame 3``."""


class Direction(StrEnum):
    """Who sent a frame."""

    COMMAND = "command"
    """The host, by DCON."""
    REQUEST = "request"
    """The host, by Modbus."""
    RESPONSE = "response"
    """A module."""
    ECHO = "echo"
    """The adapter of the host, which hears what it sends."""


@frozen(eq=False)
class Heard:
    """What was made of a frame, or of bytes that are none."""

    place: Place
    wire: bytes
    protocol: Protocol
    direction: Direction | None = None
    address: int | None = None
    meanings: tuple[Meaning, ...] = ()
    """What it means; several if it could be any of them."""
    answers: Place | None = None
    """The command or request that it answers."""
    same_as: Place | None = None
    """The frame of which it is an echo."""
    notes: tuple[str, ...] = ()
    error: DecodeError | None = None
    """What is wrong with it."""
    candidates: tuple[Meaning, ...] = ()
    """What a frame would mean by itself that is wrong where it stands."""
    contradictions: tuple[str, ...] = ()
    """What of it does not fit what was given or learned before."""

    @property
    def understood(self) -> bool:
        """Whether it is a good frame that fits what is known."""
        return self.error is None and not self.contradictions


@frozen
class Asked:
    """The command or request before."""

    place: Place
    wire: bytes
    address: int | None
    meaning: Meaning | None = None
    """What it means by Modbus."""
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
    """The only protocol on the line; None: frames of both can come."""
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
