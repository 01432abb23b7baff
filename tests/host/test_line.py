"""What holds on any line: one outcome for each request, in bounded time, and no value that was not sent for it.

What a DCON checksum does not see, two changes that make up for each other such as digits that change places, is left
out by construction: the line does one thing to a frame, and nothing where chance would make the sum right again.
"""

from collections.abc import Callable
from typing import Any

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from i7000 import BaudRate, LineSettings, Model, Profile, dcon, modbus
from i7000.host import (
    Answered,
    Bus,
    Declined,
    Late,
    Policy,
    Query,
    Sent,
    TimedOut,
    next_deadline,
    receive,
    send,
)
from i7000.strategies import profiles
from i7000.strategies.dcon import exchanges
from tests.host.line import Asked, Line

RTU = Profile(Model.M_7019R)
SEALED = evolve(RTU, checksum=True)


def inputs(address: int, profile: Profile) -> Asked:
    """A request whose response does not say whose it is, and which is another each time."""
    channels = profile.channels
    return Asked(
        dcon.ReadAnalogInputs(address), profile, lambda number: dcon.AnalogInputs((f"+{number:05.1f}0",) * channels)
    )


def words(address: int) -> Asked:
    return Asked(
        modbus.ReadInputRegisters(address, 0, 3), RTU, lambda number: modbus.InputRegisters(address, (number, 2, 3))
    )


def answered(command: Query[Any], response: Any, profile: Profile = RTU) -> Asked:
    return Asked(command, profile, lambda _: response)


ADDRESSES = st.sampled_from((0x01, 0x02))
MODBUS: tuple[Callable[[int], Asked], ...] = (
    words,
    lambda at: answered(modbus.WriteSingleCoil(at, 2, value=True), modbus.SingleCoilWritten(at, 2, value=True)),
    lambda at: answered(modbus.ReadCoils(at, 256, 9), modbus.ExceptionResponse(at, 1, 2)),
    lambda at: answered(modbus.ReadChannelMask(at), modbus.ChannelMask(at, 0xFF)),
    lambda _: Asked(modbus.WriteSingleRegister(0, 488, 100), RTU, None),
)


@st.composite
def exchanged(draw: st.DrawFn) -> Asked:
    """Whole exchanges of any module, with checksum."""
    profile = evolve(draw(profiles(known_types=True)), checksum=True)
    exchange = draw(exchanges(profile=profile))
    return Asked(exchange.command, profile, lambda _: exchange.response)


PLAIN = ADDRESSES.map(lambda address: inputs(address, SEALED))
RTU_REQUESTS = st.builds(lambda make, address: make(address), st.sampled_from(MODBUS), ADDRESSES)
BROADCASTS = st.sampled_from((dcon.SynchronizedSampling(), dcon.HostOk())).map(lambda it: Asked(it, SEALED, None))
SIMILAR = (PLAIN, PLAIN, ADDRESSES.map(words))
"""Requests whose answers fit each other."""
EVERY = (PLAIN, RTU_REQUESTS, BROADCASTS, exchanged())


def dialogues(*kinds: st.SearchStrategy[Asked]) -> st.SearchStrategy[list[Asked]]:
    return st.lists(st.one_of(*kinds), min_size=1, max_size=5)


def buses() -> st.SearchStrategy[Bus[Any]]:
    policies = st.builds(
        Policy, retries=st.integers(0, 2), turnaround=st.sampled_from((0.1, 0.01)), grace=st.sampled_from((0.1, 1.0))
    )
    lines = st.sampled_from((BaudRate.BAUD_9600, BaudRate.BAUD_1200, BaudRate.BAUD_115200)).map(LineSettings)
    return st.builds(Bus[Any], lines, policies, st.booleans())


@given(st.data(), buses(), dialogues(*SIMILAR) | dialogues(*EVERY))
def test_every_request_has_one_outcome_and_no_value_but_one_that_was_sent_for_it(
    data: st.DataObject, bus: Bus[Any], dialogue: list[Asked]
) -> None:
    line = Line(data.draw, bus)

    for asked in dialogue:
        ended = line.ask(asked)

        outcome = ended.outcome
        assert isinstance(outcome, Answered | Declined | Sent | TimedOut)
        assert asked.command == outcome.command
        assert (asked.answer is None) == isinstance(outcome, Sent)
        if isinstance(outcome, Answered | Declined):
            assert outcome.response in ended.sent
        else:
            assert not ended.intact


@given(st.data(), buses(), dialogues(*EVERY))
def test_on_a_line_without_faults_every_request_is_answered_at_once(
    data: st.DataObject, bus: Bus[Any], dialogue: list[Asked]
) -> None:
    line = Line(data.draw, bus, faults=False)

    for number, asked in enumerate(dialogue, 1):
        ended = line.ask(asked)

        assert number == line.transmissions
        assert ended.intact == (asked.answer is not None)
        if isinstance(ended.outcome, Answered | Declined):
            assert (ended.outcome.response,) == ended.sent


@given(st.data(), buses(), dialogues(*SIMILAR))
def test_a_module_that_is_always_late_is_never_taken_for_another(
    data: st.DataObject, bus: Bus[Any], dialogue: list[Asked]
) -> None:
    line = Line(data.draw, evolve(bus, echo=False), faults=False, late=True)

    for asked in dialogue:
        ended = line.ask(asked)

        assert TimedOut(asked.command) == ended.outcome
    line.wait(line.bus.policy.grace)
    assert line.transmissions == sum(isinstance(event, Late) for event in line.events)


@pytest.mark.no_cover
@pytest.mark.parametrize("asked", [inputs(0x01, SEALED), words(0x01)], ids=["DCON", "Modbus"])
@pytest.mark.parametrize("echo", [False, True])
@pytest.mark.parametrize("babble", [b"\xff", b">", b"\r", b"\x01\x04\x40", b"!01FF\r", b"\x01"])
def test_a_line_that_is_never_silent_ends_every_request_all_the_same(
    asked: Asked, babble: bytes, *, echo: bool
) -> None:
    policy = Policy()
    bus, now = Bus[Any](policy=policy, echo=echo), 0.0

    for _ in range(3):
        began = now
        bus = send(bus, asked.command, asked.profile, now)
        while next_deadline(bus) is not None:
            now += 0.001
            bus, _events = receive(bus, babble, now)

        tries = 1 + policy.retries
        assert now - began < tries * 2 * (policy.turnaround + policy.grace + 0.1)
