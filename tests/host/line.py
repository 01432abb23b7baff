"""A line that loses, flips, repeats, delays, splits and echoes bytes, a module at its other end, and time: simulated.

What it does is drawn by Hypothesis. It keeps to what a host can cope with: what answers a request has come in when the
grace is over, the module hears only what is whole, and bytes that are repeated come with those that they repeat.
"""

from collections.abc import Callable
from typing import Any

from attrs import define, field, frozen
from hypothesis import strategies as st

from i7000 import Profile, dcon, host, modbus
from i7000.host import (
    Bus,
    Event,
    Query,
    Transmit,
    next_deadline,
    receive,
    send,
)

Draw = Callable[[st.SearchStrategy[Any]], Any]

MOST_STEPS = 200
"""Calls that one request may take; each try has no more than a dozen pieces to hear and two times to wake."""


@frozen
class Asked:
    """A request, and what the module answers to its n-th transmission; None: nothing, it is a broadcast."""

    command: Query[Any]
    profile: Profile
    answer: Callable[[int], Any] | None


@frozen
class Ended:
    """What came of a request."""

    outcome: Event[Any]
    sent: tuple[Any, ...]
    """The responses that the module sent for it."""
    intact: bool
    """Whether one of them came in time, whole and with its echo."""


def encode(message: Any, profile: Profile) -> bytes:
    return modbus.encode(message, profile) if isinstance(message, modbus.Message) else dcon.encode(message, profile)


def frames(wire: bytes, asked: Asked) -> list[bytes]:
    """What checksum or CRC take for whole."""
    if isinstance(asked.command, modbus.Message):
        found = (*modbus.split(wire, profile=asked.profile)[0], *modbus.flush(wire, profile=asked.profile))
    else:
        found = dcon.split(wire, checksum=True)[0]
    return [frame for frame in found if isinstance(frame, bytes)]


def hurt(draw: Draw, wire: bytes, asked: Asked, *, whole: bool) -> bytes:
    """Do one thing to a frame: a checksum sees it, and where two changes or chance would hide it, it is not done."""
    at = draw(st.integers(0, len(wire) - 1))
    end = draw(st.integers(at + 1, len(wire)))
    damaged: bytes = draw(
        st.sampled_from(
            (
                wire[:at] + wire[end:],
                wire[:at] + bytes((wire[at] ^ 1 << end % 8,)) + wire[at + 1 :],
                wire[:end] + wire[at:] if whole or end - at < len(wire) else wire[1:],
            )
        )
    )
    return damaged if set(frames(damaged, asked)) <= {wire} else b""


@define
class Line:
    """The line and the module, from the host's end."""

    draw: Draw
    bus: Bus[Any]
    faults: bool = True
    late: bool = False
    """Whether the module answers after every deadline."""
    now: float = 0.0
    coming: list[tuple[float, bytes]] = field(factory=list)
    """What is on its way to the host, the earliest first."""
    transmissions: int = 0
    events: list[Event[Any]] = field(factory=list)
    """All that the host told."""

    def ask(self, asked: Asked) -> Ended:
        """Drive the host until the request has its outcome, and hand over what comes until the next."""
        self.bus = send(self.bus, asked.command, asked.profile, self.now)
        sent: list[Any] = []
        intact = False
        outcomes: list[Event[Any]] = []
        for _ in range(MOST_STEPS):
            for event in self.step():
                if isinstance(event, Transmit):
                    intact |= self.carry(event.wire, asked, sent)
                elif isinstance(event, host.Ended):
                    outcomes.append(event)
            if outcomes:
                break

        (outcome,) = outcomes
        assert next_deadline(self.bus) is None
        self.wait(self.draw(st.sampled_from((0.0, 0.001, 0.05, 1.0))))
        return Ended(outcome, tuple(sent), intact)

    def wait(self, seconds: float) -> None:
        """Move the time on with no request open."""
        self.now += seconds
        while self.coming and self.coming[0][0] <= self.now:
            at, data = self.coming.pop(0)
            self.bus, events = receive(self.bus, data, at)
            assert not any(isinstance(event, host.Ended) for event in events)
            self.events += events

    def step(self) -> tuple[Event[Any], ...]:
        """Move the time on until bytes arrive or the next deadline of the host."""
        deadline = next_deadline(self.bus)
        assert deadline is not None
        assert deadline <= self.now or receive(self.bus, b"", self.now) == (self.bus, ())
        if self.coming and self.coming[0][0] <= deadline:
            self.now, data = self.coming.pop(0)
            self.bus, events = receive(self.bus, data, self.now)
        else:
            self.now = max(self.now, deadline)
            self.bus, events = receive(self.bus, b"", self.now)
        self.events += events
        return events

    def carry(self, wire: bytes, asked: Asked, sent: list[Any]) -> bool:
        """Take a request to the module and its answer back; tell whether all went well."""
        self.transmissions += 1
        deadline = next_deadline(self.bus)
        assert deadline is not None
        end = self.now + len(wire) * self.bus.character_time
        heard = self.spoil(wire, asked, whole=True)
        well = True
        if self.bus.echo:
            echo = self.spoil(wire, asked, whole=False)
            well = echo == wire
            self.deliver(echo, end, end, len(wire))
        if asked.answer and heard == wire:
            response = asked.answer(self.transmissions)
            sent.append(response)
            back = encode(response, asked.profile)
            spoilt = self.spoil(back, asked, whole=True)
            late = self.late or (self.faults and self.draw(st.booleans()))
            first = deadline + 1e-6 if self.late else end
            last = deadline + self.bus.policy.grace * 0.99 if late else deadline
            arrived = self.deliver(spoilt, first, last, len(back))
            return well and spoilt == back and arrived <= deadline
        return False

    def spoil(self, wire: bytes, asked: Asked, *, whole: bool) -> bytes:
        return hurt(self.draw, wire, asked, whole=whole) if self.faults and self.draw(st.integers(0, 3)) == 3 else wire

    def deliver(self, wire: bytes, first: float, last: float, length: int) -> float:
        """Have bytes come in between two times, in pieces, perhaps with noise before; tell when the last of them do."""
        cuts = sorted(self.draw(st.sets(st.integers(1, length - 1), max_size=3)))
        parts: list[float] = sorted(self.draw(st.floats(0, 0.999)) for _ in range(len(cuts) + 1))
        noise = self.draw(st.binary(max_size=4)) if self.faults else b""
        pieces = [wire[start:stop] for start, stop in zip((0, *cuts), (*cuts, None), strict=True)]
        times: list[float] = [first + part * (last - first) for part in parts]
        self.coming += zip(times, (noise + pieces[0], *pieces[1:]), strict=True)
        self.coming.sort(key=lambda piece: piece[0])
        return times[-1]
