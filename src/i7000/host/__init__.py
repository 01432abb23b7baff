"""The host side of both protocols, without I/O and without a clock.

`send` opens a request on a `Bus`. `receive` returns events. `next_deadline` returns the time of the next call of
`receive`, even if no byte arrives. `abandon` ends a request without an outcome. Your driver reads and writes the bytes,
and sleeps::

    bus = send(bus, command, profile, monotonic())
    while (deadline := next_deadline(bus)) is not None:
        port.timeout = max(0.0, deadline - monotonic())
        heard = port.read(1) + port.read(port.in_waiting)
        bus, events = receive(bus, heard, monotonic())
        for event in events:
            if isinstance(event, Transmit):
                port.write(event.wire)
            elif isinstance(event, Ended):
                outcome = event

`receive` returns a tuple of `Event`: `Transmit` (bytes to write), an `Outcome`, or other traffic: `Rejected`, `Late`,
or `i7000.Noise` (bytes that belong to no frame, including frames with a wrong checksum).

Every request ends in exactly one `Outcome`: `Answered`, `Declined`, `TimedOut`, or `Sent` for a broadcast. All of them
are subclasses of `Ended`, with the request in `command`.
"""

from i7000.host.bus import Bus, Policy, abandon, next_deadline, receive, send
from i7000.host.events import (
    Answered,
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
from i7000.message import Query, Response

__all__ = [
    "Answered",
    "Bus",
    "Declined",
    "Ended",
    "Event",
    "Late",
    "Outcome",
    "Policy",
    "Query",
    "Rejected",
    "Response",
    "Sent",
    "TimedOut",
    "Transmit",
    "abandon",
    "next_deadline",
    "receive",
    "send",
]
