"""The host's half of the conversation, for both protocols, without I/O and without a clock.

`send` opens a request on a `Bus` and returns the bytes to write; `receive` and `wake` return what came of it as events;
`next_deadline` returns when to wake. A driver moves the bytes and sleeps.

`Event` is what `receive` and `wake` return a tuple of: `Transmit`, bytes to write; an `Outcome`; or what else was on
the line: `Rejected`, `Late`, or `i7000.Noise`, bytes that belong to no frame, frames with a wrong checksum among them.

`Outcome` is how a request ends, exactly once: `Answered`, `Declined`, `TimedOut`, or `Sent` if the request is for all
modules. All of them are `Ended`, and have the request in `command`.
"""

from i7000.host.bus import Bus, Policy, next_deadline, receive, send, wake
from i7000.host.events import (
    Answered,
    AnyCommand,
    Declined,
    Ended,
    Event,
    Late,
    Outcome,
    Rejected,
    Sent,
    TimedOut,
    Transmit,
)

__all__ = [
    "Answered",
    "AnyCommand",
    "Bus",
    "Declined",
    "Ended",
    "Event",
    "Late",
    "Outcome",
    "Policy",
    "Rejected",
    "Sent",
    "TimedOut",
    "Transmit",
    "next_deadline",
    "receive",
    "send",
    "wake",
]
