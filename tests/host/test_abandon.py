"""A request that ends without an outcome: what the line still owes it."""

from typing import Any

import pytest
from attrs import evolve

from i7000 import Firmware, Model, Profile, dcon, modbus
from i7000.host import (
    Bus,
    Late,
    Policy,
    Query,
    Response,
    Transmit,
    abandon,
    next_deadline,
    receive,
    send,
)

PROFILE = Profile(Model.M_7019R)
OLD = Profile(Model.I_7019R, firmware=Firmware("B2.6"))
POLICY = Policy(retries=1, turnaround=0.1, grace=0.5)
IDLE = Bus[Response](policy=POLICY)
INPUTS = dcon.ReadAnalogInputs(0x01)
OTHER = dcon.ReadAnalogInputs(0x02)
INPUTS_WIRE = b">" + b"+0025.1" * 8 + b"\r"
WORDS = modbus.ReadInputRegisters(0x01, 0, 2)
CALIBRATE = dcon.CalibrateChannelZero(0x01, 0)
TO_ALL = modbus.WriteSingleCoil(0x00, 2, value=True)


def sent(command: Query[Any], profile: Profile = PROFILE) -> Bus[Response]:
    bus, events = receive(send(IDLE, command, profile, -IDLE.silence), b"", 0.0)

    assert [Transmit] == [type(event) for event in events]
    return bus


def due(bus: Bus[Response]) -> float:
    deadline = next_deadline(bus)

    assert deadline is not None
    return deadline


def next_is_sent_at(bus: Bus[Response]) -> float:
    """Return when the next request goes out."""
    return due(send(bus, OTHER, PROFILE, bus.clock))


def test_a_request_that_was_not_sent_owes_nothing() -> None:
    bus = abandon(send(IDLE, INPUTS, PROFILE, 1.0), 1.0)

    assert bus == IDLE
    assert next_deadline(bus) is None
    assert next_is_sent_at(bus) == 1.0 + IDLE.silence


@pytest.mark.parametrize("now", [0.0, 0.05, 0.3])
@pytest.mark.parametrize(
    ("command", "profile", "pause"),
    [(INPUTS, PROFILE, 0.0), (WORDS, PROFILE, 0.0), (CALIBRATE, OLD, 16.0)],
    ids=["DCON", "Modbus", "a calibration of 16 s"],
)
def test_a_request_that_was_sent_owes_silence_until_its_deadline_pause_and_grace_are_over(
    command: Query[Any], profile: Profile, pause: float, now: float
) -> None:
    bus = sent(command, profile)
    deadline = due(bus)

    assert deadline > pause
    assert pytest.approx(deadline + POLICY.grace) == next_is_sent_at(abandon(bus, now))


@pytest.mark.parametrize("command", [dcon.HostOk(), TO_ALL], ids=["DCON", "Modbus"])
def test_a_broadcast_owes_its_pause_only(command: Query[Any]) -> None:
    bus = sent(command)

    assert pytest.approx(max(due(bus), bus.heard_at + bus.silence)) == next_is_sent_at(abandon(bus, 0.0))


def test_between_two_tries_the_silence_of_the_first_stays_owed() -> None:
    bus = sent(INPUTS)
    deadline = due(bus)
    bus, _ = receive(bus, b"", deadline)

    assert pytest.approx(deadline + POLICY.grace) == next_is_sent_at(abandon(bus, deadline))


def test_the_answer_to_an_abandoned_request_is_late() -> None:
    bus = abandon(sent(INPUTS), 0.01)

    between = receive(bus, INPUTS_WIRE, 0.2)
    bus = send(bus, OTHER, PROFILE, 0.05)
    while_waiting = receive(bus, INPUTS_WIRE, 0.2)

    assert (Late(INPUTS_WIRE),) == between[1] == while_waiting[1]


def test_an_answer_that_was_half_read_is_late_when_the_rest_arrives() -> None:
    bus, _ = receive(sent(INPUTS), INPUTS_WIRE[:20], 0.05)

    assert (Late(INPUTS_WIRE),) == receive(abandon(bus, 0.05), INPUTS_WIRE[20:], 0.06)[1]


def test_without_an_open_request_nothing_changes_but_the_clock() -> None:
    bus = abandon(evolve(IDLE, quiet_until=5.0), 1.0)

    assert (evolve(IDLE, quiet_until=5.0), 1.0) == (bus, bus.clock)


def test_abandoning_twice_is_the_same_as_once() -> None:
    once = abandon(sent(INPUTS), 0.01)

    assert once == abandon(once, 0.02)
