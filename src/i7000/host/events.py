"""The events that a host returns to its driver: bytes to write, the outcome of a request, and other traffic.

Laws: a request has exactly one outcome: `Answered`, `Declined`, `TimedOut` or `Sent`. Every received byte is in an
outcome, in another event, in the dropped echo, or in an incomplete frame that was dropped when a request was sent.
"""

from typing import Generic, TypeVar

from i7000 import dcon, modbus
from i7000.errors import Fault, Noise
from i7000.frozen import frozen
from i7000.message import Query, Response

__all__ = [
    "Answered",
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

R = TypeVar("R", bound=Response)
R_co = TypeVar("R_co", bound=Response, covariant=True)
"""The class of the response."""


@frozen
class Transmit:
    """The bytes to write to the line now: `wire`."""

    wire: bytes


@frozen
class Ended:
    """The base class of outcomes: the end of a request, `command`."""

    command: Query[Response]


@frozen
class Answered(Ended, Generic[R_co]):
    """The outcome of a request that was carried out: `command` and its `response`."""

    response: R_co


@frozen
class Declined(Ended):
    """The outcome of a request that the module understood but did not carry out.

    Shape: `command` and `response`: a `i7000.dcon.Refused` or a `i7000.modbus.ExceptionResponse`.
    Manual: 2, 3.
    """

    response: dcon.Refused | modbus.ExceptionResponse


@frozen
class TimedOut(Ended):
    """The outcome of a request, `command`, without a response, after all retries."""


@frozen
class Sent(Ended):
    """The outcome of a broadcast, `command`: it was sent, and its pause is over."""


@frozen
class Rejected:
    """A complete frame that arrived in time but is not the response: from another module, or to another command.

    Shape: `wire` is the frame, `fault` the reason why it is not the response, `reason` the same in words.
    """

    wire: bytes
    fault: Fault
    reason: str


@frozen
class Late:
    """A complete frame, `wire`, that arrived when no response was due and is dropped: late or duplicate."""

    wire: bytes


Outcome = Answered[R] | Declined | TimedOut | Sent
"""The outcomes of a request."""

Event = Transmit | Answered[R] | Declined | TimedOut | Sent | Rejected | Late | Noise
"""The events; `Noise` is bytes that belong to no frame, including frames with a wrong checksum or CRC."""
