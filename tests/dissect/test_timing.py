"""The times of frames, and the rules of time that they break."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import ArgumentError, InvalidValueError, Model, Profile, Protocol, StateError, modbus
from i7000.dissect import Line
from i7000.dissect.timing import TimedHeard, TimedLine, flush_at, hear_at

PROFILE = Profile(Model.M_7019R)
REQUEST = modbus.encode(modbus.ReadInputRegisters(1, 0, 1), PROFILE)
RESPONSE = modbus.encode(modbus.InputRegisters(1, (5,)), PROFILE)


def heard(*pieces: tuple[float, bytes], protocol: Protocol | None = None) -> list[TimedHeard]:
    timed, told = TimedLine(Line(protocol=protocol)), list[TimedHeard]()
    for now, data in pieces:
        timed, found = hear_at(timed, data, now)
        told += found
    return told + list(flush_at(timed, timed.clock)[1])


def test_a_frame_in_pieces_has_the_times_of_its_first_and_last_byte_and_its_longest_gap() -> None:
    frame, other = heard((1.0, b"$0"), (1.5, b"1"), (1.625, b"2\r$0"), (1.75, b"12\r"), protocol=Protocol.DCON)

    assert (frame.began, frame.ended, frame.gap, frame.after) == (1.0, 1.625, 0.5, None)
    assert (other.began, other.ended, other.gap, other.after) == (1.625, 1.75, 0.125, 0.0)


@pytest.mark.parametrize(("after", "noted"), [(0.0, True), (0.0015, True), (0.25, False)])
def test_a_command_within_the_pause_after_a_broadcast_is_noted(after: float, *, noted: bool) -> None:
    _, command = heard((8.0, b"#**\r"), (8.0 + after, b"$014\r"), protocol=Protocol.DCON)

    assert [note.partition(" after ")[2] for note in command.notes] == (
        ["SynchronizedSampling, frame 1: modules need 2 ms"] if noted else []
    )


def test_a_frame_of_a_module_may_come_at_once() -> None:
    _, response = heard((8.0, b"$012\r"), (8.0, b"!01080600\r"), protocol=Protocol.DCON)

    assert response.notes == ()


def test_what_follows_noise_has_no_pause_to_keep() -> None:
    _, command = heard((8.0, b"\xff\r"), (8.0, b"$012\r"), protocol=Protocol.DCON)

    assert command.notes == ()


def test_a_gap_inside_a_modbus_frame_is_noted() -> None:
    (frame,) = heard((1.0, REQUEST[:3]), (1.03125, REQUEST[3:]), protocol=Protocol.MODBUS_RTU)

    assert frame.notes == ("a gap of 31.2 ms inside the frame: Modbus RTU allows 1.5 characters",)


@pytest.mark.parametrize("protocol", [Protocol.MODBUS_RTU, None])
def test_what_an_adapter_explains_is_not_noted(protocol: Protocol | None) -> None:
    told = heard((1.0, REQUEST[:3]), (1.016, REQUEST[3:] + RESPONSE[:2]), (1.032, RESPONSE[2:]), protocol=protocol)

    assert [it.notes for it in told] == [(), ()]


def test_a_response_that_begins_late_is_noted() -> None:
    _, response = heard((1.0, REQUEST), (1.75, RESPONSE), protocol=Protocol.MODBUS_RTU)

    assert response.notes == ("late: it began 0.75 s after the frame that it answers; hosts usually wait 0.2 s",)


def test_a_second_response_is_not_called_late() -> None:
    told = heard((1.0, b"$012\r"), (1.1, b"!01080600\r"), (1.75, b"!01080600\r"), protocol=Protocol.DCON)

    assert [note for it in told for note in it.notes if note.startswith("late")] == []


@given(st.lists(st.tuples(st.floats(0, 0.1), st.binary(max_size=8) | st.sampled_from((REQUEST, b"$012\r", RESPONSE)))))
def test_every_byte_has_one_time_and_times_do_not_go_back(pieces: list[tuple[float, bytes]]) -> None:
    now, timed, told = 0.0, TimedLine(), list[TimedHeard]()
    for wait, data in pieces:
        now += wait
        timed, found = hear_at(timed, data, now)
        told += found
    timed, found = flush_at(timed, now)
    told += found

    assert b"".join(it.heard.wire for it in told) == b"".join(data for _, data in pieces)
    assert timed.arrivals == ()
    times = [time for it in told for time in (it.began, it.ended)]
    assert times == sorted(times)


@pytest.mark.parametrize(
    ("fields", "name"),
    [
        ({"line": 1}, "line"),
        ({"last": 1}, "last"),
        ({"clock": "x"}, "clock"),
        ({"arrivals": [1]}, "arrivals"),
        ({"arrivals": ((1.0, 1),)}, "arrivals"),
    ],
)
def test_a_line_of_other_fields_is_refused(fields: dict[str, Any], name: str) -> None:
    with pytest.raises(InvalidValueError) as refused:
        TimedLine(**fields)

    assert refused.value.field == name


def test_a_clock_that_goes_back_is_refused() -> None:
    timed, _ = hear_at(TimedLine(), b"", 1.0)

    with pytest.raises(StateError):
        flush_at(timed, 0.5)
    with pytest.raises(ArgumentError):
        hear_at(timed, "x", 2.0)  # type: ignore[arg-type]
    with pytest.raises(ArgumentError):
        hear_at(Line(), b"", 2.0)  # type: ignore[arg-type]
