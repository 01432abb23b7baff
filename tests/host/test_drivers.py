"""Plausible drivers, good and bad: whatever they do, no outcome has a value that was not sent for its request.

The line loses, delays, repeats, splits and echoes what a module answers, and adds noise. It keeps to the bound of the
documentation: an answer has come in when the turnaround and the grace are over, and a repeated one comes at once. The
drivers keep to theirs: what they pass was read, and empty bytes mean that there was nothing to read.
"""

from collections.abc import Callable, Iterable
from typing import Any

import pytest
from attrs import define, evolve, field, frozen
from hypothesis import given
from hypothesis import strategies as st

from i7000 import Model, Profile, dcon, modbus
from i7000.host import (
    Answered,
    Bus,
    Ended,
    Event,
    Policy,
    Query,
    Response,
    TimedOut,
    Transmit,
    abandon,
    next_deadline,
    receive,
    send,
)
from i7000.simulator.faults import Piece
from tests.host.line import encode
from tests.host.port import Port

Draw = Callable[[st.SearchStrategy[Any]], Any]
PROFILE = Profile(Model.M_7019R, checksum=True)
POLICY = Policy(retries=1, turnaround=0.1, grace=0.5)
REQUESTS: tuple[Query[Response], ...] = (
    dcon.ReadAnalogInput(0x01, 0),
    dcon.ReadAnalogInput(0x02, 0),
    modbus.ReadInputRegisters(0x03, 0, 1),
    modbus.ReadInputRegisters(0x03, 1, 1),
    dcon.HostOk(),
)
MOST_CALLS = 2000


@define
class Module:
    """All modules: each answer is another value, and what it was sent for is kept."""

    draw: Draw
    echo: bool
    character_time: float
    asked: int = -1
    """The number of the request that the driver has open."""
    sent_for: dict[Any, int] = field(factory=dict)
    """The number of the request for each value."""
    command: Query[Response] = REQUESTS[0]

    def answer(self, wire: bytes, _now: float) -> Iterable[Piece]:
        end = len(wire) * self.character_time
        if self.echo:
            yield Piece(wire, 0.0)
        number = len(self.sent_for) + 1
        response: Any = dcon.AnalogInput(f"+{number:07.2f}"[:7])
        if isinstance(self.command, modbus.ReadInputRegisters):
            response = modbus.InputRegisters(0x03, (number,))
        if isinstance(self.command, dcon.HostOk) or self.draw(st.sampled_from((False, False, False, True))):
            return
        self.sent_for[response] = self.asked
        back = encode(response, PROFILE)
        noise = self.draw(st.sampled_from((b"", b"", b"\xff", b">", b"\x03\x04\x40", b"\r")))
        whole = noise + back * self.draw(st.sampled_from((1, 2)))
        most = POLICY.turnaround + POLICY.grace - end - len(whole) * self.character_time
        late = self.draw(st.sampled_from((0.0, 0.0, 0.25 * most, 0.5 * most, 0.75 * most, most)))
        cut = self.draw(st.integers(0, len(whole)))
        yield Piece(whole[:cut], end + late)
        yield Piece(whole[cut:], end + late)


@frozen
class Driver:
    """The habits of a driver."""

    read: str
    """How it reads."""
    waits: str
    """What it waits for before it reads."""
    time_first: bool
    """Whether it takes the time before it reads."""
    drops: bool
    """Whether it stops at the outcome and forgets the events after it."""
    drains: bool
    """Whether it reads, and throws away, what lies in the port before it sends."""
    gives_up: int
    """The number of the call at which it abandons the request; often it is none."""

    def ask(self, port: Port, bus: Bus[Response], command: Query[Response]) -> tuple[Bus[Response], Ended | None]:
        if self.drains:
            port.read(port.in_waiting)
        bus = send(bus, command, PROFILE, port.now())
        ended: Ended | None = None
        for call in range(MOST_CALLS):
            deadline = next_deadline(bus)
            if deadline is None:
                return bus, ended
            if call == self.gives_up:
                return abandon(bus, port.now()), None
            bus, events = self.receive(port, bus, deadline)
            for event in events:
                if isinstance(event, Transmit):
                    port.write(event.wire)
                elif isinstance(event, Ended):
                    ended = event
                    if self.drops:
                        break
        pytest.fail(f"{self} does not end")

    def receive(
        self, port: Port, bus: Bus[Response], deadline: float
    ) -> tuple[Bus[Response], tuple[Event[Response], ...]]:
        left = max(0.0, deadline - port.now())
        if self.waits == "sleep until the deadline":
            port.sleep(left)
        elif self.waits == "sleep a little":
            port.sleep(min(left, 0.001))
        elif self.waits == "select":
            port.wait(port.now() + left)
        port.timeout = left if self.waits == "block" else 0.0
        now = port.now()
        heard = self.heard(port)
        return receive(bus, heard, now if self.time_first else port.now())

    def heard(self, port: Port) -> bytes:
        match self.read:
            case "a byte":
                return port.read(1)
            case "five bytes":
                return port.read(5)
            case "a line":
                return port.read_until(b"\r")
            case _:
                return port.read(max(1, port.in_waiting))


READS = ("all", "a byte", "five bytes", "a line")
WAITS = ("block", "select", "sleep until the deadline", "sleep a little")


def drivers() -> st.SearchStrategy[Driver]:
    often_never = st.just(MOST_CALLS) | st.integers(1, 4)
    return st.builds(
        Driver, st.sampled_from(READS), st.sampled_from(WAITS), st.booleans(), st.booleans(), st.booleans(), often_never
    )


@given(
    st.data(),
    drivers(),
    st.booleans(),
    st.lists(st.tuples(st.sampled_from(REQUESTS), st.sampled_from((0.0, 0.2, 1.0))), min_size=1, max_size=6),
    st.integers(0, 2),
)
def test_no_driver_takes_a_value_that_was_not_sent_for_its_request(
    data: st.DataObject,
    driver: Driver,
    echo: bool,  # noqa: FBT001 - as Hypothesis calls it
    polls: list[tuple[Query[Response], float]],
    tries: int,
) -> None:
    bus: Bus[Response] = Bus(policy=POLICY, echo=echo)
    module = Module(data.draw, echo, bus.character_time)
    port = Port(module.answer)

    for number, (command, sleep) in enumerate(polls):
        module.asked, module.command = number, command
        for _ in range(1 + tries):  # its own retries
            bus, outcome = driver.ask(port, bus, command)
            if isinstance(outcome, Answered):
                assert module.sent_for[outcome.response] == number
            if not isinstance(outcome, TimedOut):
                break
        port.sleep(sleep)


@pytest.mark.parametrize("read", READS)
@pytest.mark.parametrize("waits", WAITS)
@pytest.mark.parametrize("command", [REQUESTS[0], REQUESTS[2]], ids=["DCON", "Modbus"])
def test_every_driver_that_reads_fast_enough_is_answered(read: str, waits: str, command: Query[Response]) -> None:
    driver = Driver(read, waits, time_first=False, drops=False, drains=False, gives_up=MOST_CALLS)
    response: Any = modbus.InputRegisters(0x03, (7,)) if command is REQUESTS[2] else dcon.AnalogInput("+0025.1")
    port = Port(lambda _wire, _now: (Piece(encode(response, PROFILE), 0.02),))

    _, outcome = driver.ask(port, Bus(policy=evolve(POLICY, retries=0)), command)

    by_bits = waits == "sleep until the deadline" and read in ("a byte", "five bytes")
    assert outcome == (TimedOut(command) if by_bits else Answered(command, response))
