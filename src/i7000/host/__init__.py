"""The host's half of the conversation, for both protocols, without I/O and without a clock.

`send` opens a request on a `Bus` and tells the bytes to write; `receive` and `wake` tell what came of it as events,
exactly one of them its outcome; `next_deadline` tells when to wake. A driver moves the bytes and sleeps.
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
