"""The host side of both protocols, without I/O and without a clock.

`send` opens a request on a `Bus` and returns the bytes to write. `receive` and `wake` return events. `next_deadline`
returns the time to call `wake`. Your driver writes and reads the bytes, and sleeps.

`receive` and `wake` return a tuple of `Event`: `Transmit` (bytes to write), an `Outcome`, or other traffic: `Rejected`,
`Late`, or `i7000.Noise` (bytes that belong to no frame, including frames with a wrong checksum).

Every request ends in exactly one `Outcome`: `Answered`, `Declined`, `TimedOut`, or `Sent` for a broadcast. All of them
are subclasses of `Ended`, with the request in `command`.
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
