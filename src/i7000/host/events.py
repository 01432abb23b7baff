"""What a host tells its driver: bytes to write, the outcome of a request, and what else was on the line.

Laws: a request has exactly one outcome: `Answered`, `Declined`, `TimedOut` or `Sent`. Every byte that was heard is in
an outcome, in an event of its own, in the echo that was dropped, or in what had begun to come in when a request went
out.
"""

from typing import Any, Generic, TypeVar

from i7000 import dcon, modbus
from i7000.errors import Fault, Noise
from i7000.frozen import frozen

__all__ = [
    "Answered",
    "AnyCommand",
    "Declined",
    "Ended",
    "Event",
    "Late",
    "Outcome",
    "Rejected",
    "Sent",
    "TimedOut",
    "Transmit",
]

AnyCommand = dcon.AnyCommand | modbus.Request[Any]
"""What a host sends, by either protocol."""

R = TypeVar("R")
"""The response of a command."""


@frozen
class Transmit:
    """Bytes to be written to the line now: `wire`."""

    wire: bytes


@frozen
class Ended:
    """What all outcomes are: the end of a request, `command`."""

    command: AnyCommand


@frozen
class Answered(Ended, Generic[R]):
    """The outcome of a request that was carried out: `command`, and the `response` to it."""

    response: R


@frozen
class Declined(Ended):
    """The outcome of a request that the module understood and did not carry out.

    Shape: `command`, and the `response`: a `i7000.dcon.Refused` or a `i7000.modbus.ExceptionResponse`.
    Manual: 2, 3.
    """

    response: dcon.Refused | modbus.ExceptionResponse


@frozen
class TimedOut(Ended):
    """The outcome of a request, `command`, that has no answer, however often it was sent."""


@frozen
class Sent(Ended):
    """The outcome of a request to all modules, `command`: it has gone out, and its pause is over; none answers."""


@frozen
class Rejected:
    """A whole frame that came in time and is not the answer: of another module, or to another command.

    Shape: `wire` is the frame, `fault` what is wrong with it as an answer, `reason` the same for people.
    """

    wire: bytes
    fault: Fault
    reason: str


@frozen
class Late:
    """A whole frame, `wire`, that came when no answer was due, dropped: a late response, or one too many."""

    wire: bytes


Outcome = Answered[R] | Declined | TimedOut | Sent
"""How a request ends."""

Event = Transmit | Answered[R] | Declined | TimedOut | Sent | Rejected | Late | Noise
"""What can happen; `Noise` is bytes that belong to no frame, frames with a wrong checksum or CRC among them."""
