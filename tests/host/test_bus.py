"""What a host sends when, and what it takes for the answer, rule by rule; times are those of a line at 9600 N81."""

from typing import Any

import pytest
from attrs import evolve

from i7000 import (
    BaudRate,
    CharacterFormat,
    EncodeError,
    Fault,
    Firmware,
    InvalidValueError,
    LineSettings,
    Model,
    Noise,
    Profile,
    Protocol,
    StateError,
    dcon,
    modbus,
)
from i7000.host import (
    Answered,
    Bus,
    Declined,
    Event,
    Late,
    Policy,
    Query,
    Rejected,
    Sent,
    TimedOut,
    Transmit,
    next_deadline,
    receive,
    send,
)

CHARACTER = 10 / 9600
SILENCE = 3.5 * CHARACTER
ONCE = Policy(retries=0, turnaround=0.1, grace=0.05)
M7019 = Profile(Model.M_7019R)
SEALED = evolve(M7019, checksum=True)
OLD = Profile(Model.I_7019R, firmware=Firmware("B2.6"))

READ = dcon.ReadChannelMask(0x01)
READ_WIRE, MASK_WIRE = b"$016\r", b"!01FF\r"
MASK = Answered(READ, dcon.ChannelMask(0x01, 0xFF))
INPUTS = dcon.ReadAnalogInputs(0x01)
INPUTS_WIRE = b">" + b"+0025.1" * 8 + b"\r"
COIL = modbus.WriteSingleCoil(0x01, 2, value=True)
COIL_WIRE = modbus.encode(COIL)
COIL_ANSWER = Answered(COIL, modbus.SingleCoilWritten(0x01, 2, value=True))
WORDS = modbus.ReadInputRegisters(0x01, 0, 2)
WORD = modbus.ReadInputRegisters(0x01, 0, 1)
WORDS_WIRE = modbus.encode(modbus.InputRegisters(0x01, (1, 2)))


def idle(**changes: Any) -> Bus[Any]:
    return Bus[Any](policy=ONCE, **changes)


def ask(bus: Bus[Any], command: Query[Any], profile: Profile = M7019, now: float = 0.0) -> Bus[Any]:
    """Open a request so that it goes out now, after its short silence."""
    bus = send(bus, command, profile, max(bus.clock, now - bus.silence))
    bus, events = go(bus, due(bus))

    assert [Transmit] == [type(event) for event in events]
    return bus


def go(bus: Bus[Any], now: float) -> tuple[Bus[Any], tuple[Event[Any], ...]]:
    """Move the time on, on a silent line."""
    return receive(bus, b"", now)


def hear(bus: Bus[Any], *pieces: bytes, now: float = 0.05) -> tuple[Bus[Any], tuple[Event[Any], ...]]:
    """Receive bytes one piece after another, and tell all the events."""
    events: tuple[Event[Any], ...] = ()
    for piece in pieces:
        bus, found = receive(bus, piece, now)
        events += found
    return bus, events


def due(bus: Bus[Any]) -> float:
    deadline = next_deadline(bus)

    assert deadline is not None
    return deadline


# --- sending ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("command", "profile", "wire"),
    [
        (READ, M7019, READ_WIRE),
        (READ, SEALED, b"$016BB\r"),
        (dcon.HostOk(), SEALED, b"~**D2\r"),
        (COIL, M7019, COIL_WIRE),
    ],
)
def test_a_request_goes_out_after_a_short_silence_on_an_idle_line(command: Any, profile: Profile, wire: bytes) -> None:
    bus = send(idle(), command, profile, 0.0)

    assert pytest.approx(SILENCE) == next_deadline(bus)
    assert go(bus, 0.0)[1] == ()
    assert (Transmit(wire),) == go(bus, due(bus))[1]


def test_a_request_that_the_module_does_not_have_is_refused_and_changes_nothing() -> None:
    with pytest.raises(EncodeError, match="M-7018 has no CJC update setting"):
        send(idle(), dcon.ReadCjcUpdate(0x01), Profile(Model.M_7018), 0.0)


@pytest.mark.parametrize("name", ["line", "policy", "echo", "pending", "last", "rest"])
def test_a_line_has_no_field_of_another_type(name: str) -> None:
    with pytest.raises(InvalidValueError, match=rf"{name} cannot be 'text': (an instance of \w+|True or False)"):
        Bus(**{name: "text"})  # type: ignore[arg-type]


@pytest.mark.parametrize("name", ["heard_at", "quiet_until", "clock"])
@pytest.mark.parametrize("value", [float("nan"), float("inf"), float("-inf"), 10**400, True, "5"])
def test_a_time_of_a_bus_that_is_not_finite_is_refused(name: str, value: Any) -> None:
    with pytest.raises(InvalidValueError, match=f"{name} cannot be .*: a finite number of seconds"):
        Bus(**{name: value})


def test_an_open_broadcast_is_named_in_the_error() -> None:
    with pytest.raises(StateError, match=r"\(HostOk to all, due in 0\.\d\d s\): call receive\(\) until it ends"):
        send(ask(idle(), dcon.HostOk()), READ, M7019, 0.0)


def test_an_open_broadcast_of_modbus_is_to_all_as_well() -> None:
    with pytest.raises(StateError, match="WriteSingleCoil to all"):
        send(ask(idle(), evolve(COIL, address=0)), READ, M7019, 0.0)


@pytest.mark.parametrize("second", [READ, COIL, dcon.HostOk()])
def test_a_second_request_is_refused_while_one_is_open(second: Any) -> None:
    bus = ask(idle(), READ)

    with pytest.raises(StateError, match=r"a request is still open \(ReadChannelMask to 01, due in 0\."):
        send(bus, second, M7019, 0.1)


def test_an_idle_line_has_no_deadline() -> None:
    bus, _ = hear(ask(idle(), READ), MASK_WIRE)

    assert [next_deadline(idle()), next_deadline(bus)] == [None, None]


# --- nothing is sent before the port was read -------------------------------------------------------------------------


@pytest.mark.parametrize("command", [INPUTS, WORDS], ids=["DCON", "Modbus"])
@pytest.mark.parametrize("size", [1, 5, 100])
def test_bytes_that_lie_in_the_port_when_a_request_is_opened_are_late(command: Query[Any], size: int) -> None:
    stale = INPUTS_WIRE if command is INPUTS else WORDS_WIRE
    bus = ask(idle(), command)
    bus, _ = go(bus, due(bus))
    bus, events = send(bus, command, M7019, 9.0), list[Event[Any]]()

    for at in range(0, len(stale), size):
        bus, found = receive(bus, stale[at : at + size], 9.0)
        events += found
    bus, sent = go(bus, due(bus))

    assert [Late(stale)] == [event for event in events if not isinstance(event, Noise)]
    assert [Transmit] == [type(event) for event in sent]


# --- deadlines --------------------------------------------------------------------------------------------------------

DEADLINES: list[tuple[Query[Any], Profile, float]] = [
    (READ, M7019, (5 + 6) * CHARACTER + 0.1),
    (READ, SEALED, (7 + 8) * CHARACTER + 0.1),
    (INPUTS, M7019, (4 + 58) * CHARACTER + 0.1),
    (INPUTS, Profile(Model.M_7017Z, single_ended=True), (4 + 142) * CHARACTER + 0.1),
    (dcon.ReadModuleName(0x01), M7019, (5 + 10) * CHARACTER + 0.1),
    (dcon.ReloadDefaultCalibration(0x01), M7019, (6 + 4) * CHARACTER + 0.1 + 3),
    (dcon.CalibrateChannelZero(0x01, 0), OLD, (7 + 4) * CHARACTER + 0.1 + 16),
    (dcon.CalibrateChannelZero(0x01, 0), M7019, (7 + 4) * CHARACTER + 0.1),
    (dcon.SynchronizedSampling(), M7019, 4 * CHARACTER + 0.002),
    (dcon.HostOk(), SEALED, 6 * CHARACTER + 0.002),
    (WORDS, M7019, (8 + 9) * CHARACTER + 0.1),
    (modbus.ReadCoils(0x01, 0, 9), M7019, (8 + 7) * CHARACTER + 0.1),
    (COIL, M7019, (8 + 8) * CHARACTER + 0.1),
    (modbus.ReadChannelMask(0x01), Profile(Model.M_7017mC_16), (5 + 7) * CHARACTER + 0.1),
    (modbus.ReadCjcUpdate(0x01), M7019, (5 + 6) * CHARACTER + 0.1),
    (modbus.WriteSingleCoil(0x01, 271, value=True), M7019, (8 + 8) * CHARACTER + 0.1 + 3),
    (modbus.WriteSingleCoil(0x01, 271, value=False), M7019, (8 + 8) * CHARACTER + 0.1),
    (modbus.WriteMultipleCoils(0x01, 270, (False, True)), M7019, (10 + 8) * CHARACTER + 0.1 + 3),
    (modbus.WriteMultipleCoils(0x01, 270, (True, False)), M7019, (10 + 8) * CHARACTER + 0.1),
    (modbus.WriteMultipleCoils(0x01, 272, (True,)), M7019, (10 + 8) * CHARACTER + 0.1),
    (modbus.WriteMultipleCoils(0x01, 270, (True,)), M7019, (10 + 8) * CHARACTER + 0.1),
    (modbus.WriteSingleCoil(0x00, 2, value=True), M7019, 8 * CHARACTER + 0.1 + 0.002),
    (modbus.WriteSingleCoil(0x00, 271, value=True), M7019, 8 * CHARACTER + 0.1 + 3),
]


@pytest.mark.parametrize(("command", "profile", "seconds"), DEADLINES)
def test_the_deadline_allows_for_the_line_the_longest_answer_and_the_module(
    command: Query[Any], profile: Profile, seconds: float
) -> None:
    bus = ask(idle(), command, profile, now=100.0)

    assert pytest.approx(100 + seconds, abs=1e-9) == next_deadline(bus)


@pytest.mark.parametrize(
    ("line", "character"),
    [
        (LineSettings(BaudRate.BAUD_1200), 10 / 1200),
        (LineSettings(BaudRate.BAUD_9600, CharacterFormat.N82), 11 / 9600),
        (LineSettings(BaudRate.BAUD_115200, CharacterFormat.E81), 11 / 115200),
    ],
)
def test_a_character_takes_what_speed_and_format_of_the_line_say(line: LineSettings, character: float) -> None:
    bus = ask(idle(line=line), READ)

    assert pytest.approx(11 * character + 0.1) == next_deadline(bus)


def test_a_line_whose_speed_is_not_defined_is_refused() -> None:
    with pytest.raises(InvalidValueError, match=r"baud_rate cannot be '2A': 03\.\.0A"):
        Bus[Any](line=LineSettings(0x2A))


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("retries", -1),
        ("retries", 1.0),
        ("retries", True),
        ("turnaround", -0.1),
        ("grace", float("inf")),
        ("grace", float("nan")),
        ("turnaround", "1"),
        ("turnaround", True),
        ("grace", 10**400),
    ],
)
def test_a_policy_that_is_none_is_refused(name: str, value: object) -> None:
    with pytest.raises(InvalidValueError, match=f"{name} cannot be") as caught:
        Policy(**{name: value})  # type: ignore[arg-type] # the subject

    assert (name, value) == (caught.value.field, caught.value.value)


# --- answers ----------------------------------------------------------------------------------------------------------

ANSWERS: list[tuple[str, Query[Any], Profile, bytes, tuple[Event[Any], ...]]] = [
    ("a response", READ, M7019, MASK_WIRE, (MASK,)),
    ("a refusal", READ, M7019, b"?01\r", (Declined(READ, dcon.Refused(0x01)),)),
    ("registers", WORDS, M7019, WORDS_WIRE, (Answered(WORDS, modbus.InputRegisters(0x01, (1, 2))),)),
    ("a repeated write", COIL, M7019, COIL_WIRE, (COIL_ANSWER,)),
    (
        "an exception",
        WORDS,
        M7019,
        modbus.seal(b"\x01\x84\x02"),
        (Declined(WORDS, modbus.ExceptionResponse(0x01, 4, 2)),),
    ),
    ("noise before", READ, M7019, b"\xff\x00" + MASK_WIRE, (Noise(b"\xff\x00", Fault.LEADING), MASK)),
    (
        "noise before registers",
        WORDS,
        M7019,
        b"\xff" + WORDS_WIRE,
        (Noise(b"\xff", Fault.ADDRESS), Answered(WORDS, modbus.InputRegisters(0x01, (1, 2)))),
    ),
    ("one too many", READ, M7019, MASK_WIRE + b"!0100\r", (MASK, Late(b"!0100\r"))),
    ("a wrong checksum", READ, SEALED, b"!01FF00\r", (Noise(b"!01FF00\r", Fault.CHECKSUM),)),
    ("a wrong CRC", COIL, M7019, COIL_WIRE[:-1] + b"\xff", (Noise(COIL_WIRE[:-1] + b"\xff", Fault.CRC),)),
]


@pytest.mark.parametrize(
    ("command", "profile", "heard", "events"), [row[1:] for row in ANSWERS], ids=[row[0] for row in ANSWERS]
)
def test_received_bytes_give_the_same_events_in_any_pieces(
    command: Query[Any], profile: Profile, heard: bytes, events: tuple[Event[Any], ...]
) -> None:
    whole, found = hear(ask(idle(), command, profile), heard)
    piecewise, found_piecewise = hear(ask(idle(), command, profile), *(bytes((byte,)) for byte in heard))

    assert events == found
    assert whole == piecewise
    assert [event for event in events if not isinstance(event, Noise)] == [
        event for event in found_piecewise if not isinstance(event, Noise)
    ]


@pytest.mark.parametrize(
    ("command", "heard", "fault"),
    [
        (READ, b"!02FF\r", Fault.ADDRESS),
        (READ, b"?02\r", Fault.ADDRESS),
        (READ, b"!01\r", Fault.LENGTH),
        (READ, READ_WIRE, Fault.LEADING),
        (INPUTS, b">+0025.1\r", Fault.LENGTH),
        (INPUTS, MASK_WIRE, Fault.LEADING),
        (WORDS, modbus.encode(modbus.InputRegisters(0x02, (1, 2))), Fault.ADDRESS),
        (WORDS, modbus.encode(modbus.InputRegisters(0x01, (1,))), Fault.COUNT),
        (COIL, modbus.encode(modbus.SingleCoilWritten(0x01, 3, value=True)), Fault.ECHO),
    ],
)
def test_a_frame_that_is_not_the_answer_is_rejected_and_the_answer_waited_for(
    command: Query[Any], heard: bytes, fault: Fault
) -> None:
    sent = ask(idle(), command)

    bus, (event,) = hear(sent, heard)

    assert isinstance(event, Rejected)
    assert (heard, fault) == (event.wire, event.fault)
    assert event.reason.startswith(fault.value)
    assert next_deadline(sent) == next_deadline(bus)


def test_digits_that_change_places_are_not_seen_by_the_checksum_of_dcon() -> None:
    sent = dcon.seal(b">" + b"+0025.1" * 8, checksum=True)
    heard = sent.replace(b"25", b"52", 1)

    _, events = hear(ask(idle(), INPUTS, SEALED), heard)

    assert (Answered(INPUTS, dcon.AnalogInputs(("+0052.1", *("+0025.1",) * 7))),) == events


@pytest.mark.parametrize("after", [0.0, 1e-6, 10.0])
def test_an_answer_that_is_read_when_the_deadline_is_noticed_counts(after: float) -> None:
    """A driver that only wakes up at deadlines reads after them; the bytes may have come in time."""
    sent = ask(idle(), READ)

    assert receive(sent, MASK_WIRE, due(sent) + after)[1] == (MASK,)


def test_an_answer_after_the_call_that_noticed_the_deadline_is_late() -> None:
    bus = ask(idle(), READ)

    bus, over = receive(bus, b"", due(bus))

    assert (TimedOut(READ),) == over
    assert (Late(MASK_WIRE),) == receive(bus, MASK_WIRE, bus.clock)[1]


def test_a_part_of_an_answer_at_the_deadline_does_not_extend_it() -> None:
    bus = ask(idle(), READ)

    bus, over = receive(bus, MASK_WIRE[:3], due(bus) + 1e-6)

    assert (Noise(MASK_WIRE[:3], Fault.TERMINATOR), TimedOut(READ)) == over


def test_nothing_happens_before_the_deadline() -> None:
    sent = ask(idle(), READ)

    assert (sent, ()) == receive(sent, b"", due(sent) - 1e-6)


def test_an_answer_that_is_cut_off_is_noise_at_the_deadline() -> None:
    bus, nothing = hear(ask(idle(), READ), b"!01F")

    assert nothing == ()
    assert (Noise(b"!01F", Fault.TERMINATOR), TimedOut(READ)) == receive(bus, b"", due(bus))[1]


def test_an_echo_held_back_by_noise_is_found_at_the_deadline_with_the_answer_after_it() -> None:
    beginning = WORDS_WIRE[:2] + b"\x40"  # of a longer response
    bus, nothing = hear(ask(idle(echo=True), WORDS), beginning + modbus.encode(WORDS) + WORDS_WIRE)

    assert nothing == ()
    assert (Noise(beginning, Fault.CRC), Answered(WORDS, modbus.InputRegisters(0x01, (1, 2)))) == receive(
        bus, b"", due(bus)
    )[1]


def test_what_is_heard_before_anything_was_sent_is_no_answer() -> None:
    bus, events = hear(idle(), b"\xff" + MASK_WIRE + INPUTS_WIRE[:9])
    bus = ask(bus, INPUTS, now=0.1)

    assert (Noise(b"\xff", Fault.LEADING), Late(MASK_WIRE)) == events
    assert (Noise(INPUTS_WIRE[9:], Fault.LEADING),) == hear(bus, INPUTS_WIRE[9:], now=0.15)[1]


# --- retries ----------------------------------------------------------------------------------------------------------


def test_a_request_without_answer_goes_out_as_often_as_the_policy_says() -> None:
    bus = ask(Bus[Any](policy=evolve(ONCE, retries=2)), READ)
    allowance = due(bus)
    events: list[tuple[float, Event[Any]]] = []

    while (now := next_deadline(bus)) is not None:
        bus, found = receive(bus, b"", now)
        events += [(now, event) for event in found]

    later = allowance + 0.05
    assert [Transmit(READ_WIRE), Transmit(READ_WIRE), TimedOut(READ)] == [event for _, event in events]
    assert pytest.approx([later, 2 * later, 3 * later - 0.05]) == [now for now, _ in events]


def test_a_request_without_answer_goes_out_three_times_by_default() -> None:
    bus, sent = send(Bus[Any](), READ, M7019, 0.0), list[bytes]()

    while (now := next_deadline(bus)) is not None:
        bus, events = receive(bus, b"", now)
        sent += [event.wire for event in events if isinstance(event, Transmit)]

    assert sent == [READ_WIRE] * 3


def test_the_answer_to_a_repeated_request_is_its_outcome() -> None:
    bus = ask(Bus[Any](policy=evolve(ONCE, retries=1)), READ)
    bus, _ = receive(bus, b"", due(bus))
    bus, repeated = receive(bus, b"", due(bus))

    assert (Transmit(READ_WIRE),) == repeated
    assert receive(bus, MASK_WIRE, due(bus))[1] == (MASK,)


def test_a_late_answer_is_dropped_before_the_request_is_repeated() -> None:
    bus = ask(Bus[Any](policy=evolve(ONCE, retries=1)), READ)
    bus, nothing = receive(bus, b"", due(bus))
    bus, late = receive(bus, MASK_WIRE, due(bus) - 0.01)

    assert ((), (Late(MASK_WIRE),)) == (nothing, late)
    assert (Transmit(READ_WIRE),) == receive(bus, b"", due(bus))[1]


def test_a_host_that_was_away_repeats_at_once_what_it_should_have_repeated() -> None:
    bus = ask(Bus[Any](policy=evolve(ONCE, retries=1)), READ)

    bus, events = receive(bus, b"", 10.0)

    assert (Transmit(READ_WIRE),) == events
    assert due(bus) > 10


# --- late responses ---------------------------------------------------------------------------------------------------


def timed_out(command: Query[Any] = INPUTS) -> tuple[Bus[Any], float]:
    bus = ask(idle(), command)
    deadline = due(bus)
    bus, events = receive(bus, b"", deadline)

    assert (TimedOut(command),) == events
    return bus, deadline


def test_after_a_deadline_the_line_is_left_silent_for_the_grace() -> None:
    bus, deadline = timed_out()

    bus = send(bus, INPUTS, M7019, deadline)

    assert pytest.approx(deadline + 0.05) == next_deadline(bus)
    assert receive(bus, b"", deadline + 0.049)[1] == ()
    assert (Transmit(b"#01\r"),) == receive(bus, b"", due(bus))[1]


def test_a_late_response_is_not_the_answer_to_the_next_request() -> None:
    bus, deadline = timed_out()
    bus = send(bus, dcon.ReadAnalogInputs(0x02), M7019, deadline)

    bus, late = receive(bus, INPUTS_WIRE, deadline + 0.04)
    bus, sent = receive(bus, b"", due(bus))
    _, answer = receive(bus, INPUTS_WIRE, due(bus))

    assert (Late(INPUTS_WIRE),) == late
    assert (Transmit(b"#02\r"),) == sent
    assert [dcon.ReadAnalogInputs(0x02)] == [event.command for event in answer if isinstance(event, Answered)]


def test_a_late_response_that_looks_like_the_request_is_late_all_the_same() -> None:
    bus, deadline = timed_out(COIL)
    bus = send(bus, COIL, M7019, deadline)

    assert (Late(COIL_WIRE),) == receive(bus, COIL_WIRE, deadline + 0.01)[1]


def test_a_late_response_whose_end_comes_after_the_next_request_is_not_its_answer() -> None:
    bus, deadline = timed_out()
    bus = send(bus, INPUTS, M7019, deadline)
    bus, nothing = receive(bus, INPUTS_WIRE[:40], deadline + 0.049)
    bus, _ = receive(bus, b"", due(bus))

    assert nothing == ()
    assert (Noise(INPUTS_WIRE[40:], Fault.LEADING),) == hear(bus, INPUTS_WIRE[40:], now=due(bus) - 0.1)[1]


def test_a_response_later_than_the_grace_can_be_mistaken() -> None:
    bus, deadline = timed_out()
    now = deadline + ONCE.grace

    _, events = receive(ask(bus, dcon.ReadAnalogInputs(0x02), now=now), INPUTS_WIRE, now)

    assert [dcon.ReadAnalogInputs(0x02)] == [event.command for event in events if isinstance(event, Answered)]


# --- pauses -----------------------------------------------------------------------------------------------------------

FACTORY = modbus.WriteSingleCoil(0x01, 271, value=True)
PAUSES: list[tuple[Query[Any], bytes, Query[Any], float]] = [
    (READ, MASK_WIRE, READ, 0.05 + SILENCE),
    (dcon.ReloadDefaultCalibration(0x01), b"!01\r", READ, 6 * CHARACTER + 3),
    (dcon.ReloadDefaultCalibration(0x01), b"?01\r", READ, 6 * CHARACTER + 3),
    (FACTORY, modbus.encode(FACTORY), WORDS, 8 * CHARACTER + 3),
    (READ, MASK_WIRE, WORDS, 0.05 + SILENCE),
    (WORDS, WORDS_WIRE, WORDS, 0.05 + SILENCE),
    (WORDS, WORDS_WIRE, READ, 0.05 + SILENCE),
]


@pytest.mark.parametrize(("first", "answer", "second", "until"), PAUSES)
def test_a_pause_that_is_owed_is_kept(first: Query[Any], answer: bytes, second: Any, until: float) -> None:
    bus, events = hear(ask(idle(), first), answer)
    bus = send(bus, second, M7019, 0.05)

    assert len(events) == 1
    assert pytest.approx(until) == due(bus)
    assert go(bus, due(bus) - 1e-6)[1] == ()
    assert [Transmit] == [type(event) for event in go(bus, due(bus))[1]]


@pytest.mark.parametrize("command", [dcon.SynchronizedSampling(), dcon.HostOk(), evolve(COIL, address=0)])
def test_a_broadcast_is_over_when_its_pause_is(command: Query[Any]) -> None:
    bus = ask(idle(), command)
    bus, strange = receive(bus, modbus.seal(b"\x01\x85\x02") if command.section == "3.4" else MASK_WIRE, 0.001)

    assert [Late] == [type(event) for event in strange]
    assert (Sent(command),) == receive(bus, b"", due(bus))[1]


def test_between_modbus_frames_there_is_silence_also_on_fast_lines() -> None:
    line = LineSettings(BaudRate.BAUD_115200)
    bus, _ = hear(ask(idle(line=line), WORDS), WORDS_WIRE)

    bus = send(bus, WORDS, M7019, 0.05)

    assert pytest.approx(0.05 + 0.00175) == next_deadline(bus)


def test_a_modbus_request_waits_for_silence_but_not_for_ever() -> None:
    bus, deadline = timed_out(WORDS)
    bus = send(bus, WORDS, M7019, deadline)
    now, sent = deadline, False

    while not sent:
        now += SILENCE / 2
        bus, events = receive(bus, b"\xff", now)
        sent = any(isinstance(event, Transmit) for event in events)
        assert sent or due(bus) > now

    assert deadline + ONCE.grace + SILENCE < now < deadline + ONCE.grace + 0.2


def test_a_modbus_request_is_repeated_after_silence() -> None:
    bus = ask(Bus[Any](policy=Policy(retries=1, grace=0)), WORDS)
    bus, _ = receive(bus, b"\xff", due(bus) - 0.001)
    deadline = due(bus)

    bus, _ = receive(bus, b"", deadline)

    assert pytest.approx(deadline - 0.001 + SILENCE) == next_deadline(bus)


def test_a_rejected_frame_is_reported_whole_if_it_arrives_in_pieces() -> None:
    other = modbus.encode(modbus.HoldingRegisters(0x01, (1, 2)))

    _, events = hear(ask(idle(), WORDS), other[:5], other[5:], WORDS_WIRE)

    assert [(Rejected, other), (Answered, None)] == [(type(event), getattr(event, "wire", None)) for event in events]


def test_a_mask_found_at_the_deadline_has_the_length_of_the_model() -> None:
    command = modbus.ReadChannelMask(0x01)
    answer = modbus.encode(modbus.ChannelMask(0x01, 0xFF), M7019)
    beginning_of_a_long_frame = b"\x01\x03\x20"

    bus, nothing = hear(
        ask(idle(echo=True), command), beginning_of_a_long_frame + modbus.encode(command) + answer + b"\0"
    )
    _, events = receive(bus, b"", due(bus))

    assert nothing == ()
    assert Answered(command, modbus.ChannelMask(0x01, 0xFF)) in events


# --- local echo -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("command", "echo", "answer", "outcome"),
    [
        (READ, READ_WIRE, MASK_WIRE, MASK),
        (COIL, COIL_WIRE, COIL_WIRE, COIL_ANSWER),
        (WORDS, modbus.encode(WORDS), WORDS_WIRE, Answered(WORDS, modbus.InputRegisters(0x01, (1, 2)))),
    ],
)
def test_the_echo_is_dropped(command: Query[Any], echo: bytes, answer: bytes, outcome: Event[Any]) -> None:
    bus, nothing = hear(ask(idle(echo=True), command), echo)

    assert nothing == ()
    assert (outcome,) == hear(bus, answer)[1]
    assert (outcome,) == hear(ask(idle(echo=True), command), *(bytes((byte,)) for byte in echo + answer))[1]


@pytest.mark.parametrize(
    ("command", "heard", "event"), [(READ, MASK_WIRE, Late(MASK_WIRE)), (COIL, WORDS_WIRE, Late(WORDS_WIRE))]
)
def test_what_comes_before_the_echo_is_late(command: Query[Any], heard: bytes, event: Event[Any]) -> None:
    bus, events = hear(ask(idle(echo=True), command), heard)

    assert (event,) == events
    assert (TimedOut(command),) == receive(bus, b"", due(bus))[1]


@pytest.mark.parametrize(
    ("request_", "profile", "response"),
    [
        (modbus.ReadChannelMask(0x01), M7019, modbus.ChannelMask(0x01, 0xFF)),
        (modbus.ReadInputRegisters(0x01, 1024, 1), Profile(Model.M_7017mC_16), modbus.InputRegisters(0x01, (7,))),
    ],
    ids=["mask", "count"],
)
@pytest.mark.parametrize("whole", [True, False])
def test_an_echo_is_known_though_a_00_behind_it_makes_a_longer_frame(
    request_: Any, profile: Profile, response: Any, *, whole: bool
) -> None:
    """A CRC stays good when a 00 follows, and so many bytes more is as long as an answer could be."""
    echo, answer = modbus.encode(request_, profile), modbus.encode(response, profile)
    pieces = (echo + b"\0" + answer,) if whole else (echo, b"\0", answer)

    _, events = hear(ask(idle(echo=True), request_, profile), *pieces)

    assert (Noise(b"\0", Fault.ADDRESS), Answered(request_, response)) == events


def test_a_lost_echo_is_not_made_up_for_by_an_answer_that_looks_like_it() -> None:
    bus, events = hear(ask(idle(echo=True), COIL), COIL_WIRE)

    assert events == ()
    assert (TimedOut(COIL),) == receive(bus, b"", due(bus))[1]


def test_an_echo_that_is_not_expected_is_rejected_or_answers_a_modbus_write() -> None:
    _, dcon_events = hear(ask(idle(), READ), READ_WIRE + MASK_WIRE)
    _, modbus_events = hear(ask(idle(), COIL), COIL_WIRE)

    assert [Rejected, Answered] == [type(event) for event in dcon_events]
    assert modbus_events == (COIL_ANSWER,)


def test_an_echo_that_is_not_expected_answers_a_read_of_the_mask_if_a_00_follows() -> None:
    """The module could have said just this, so it cannot be told apart."""
    command = modbus.ReadChannelMask(0x01)
    echo = modbus.encode(command)

    _, events = hear(ask(idle(), command), echo + b"\0")

    assert modbus.encode(modbus.ChannelMask(0x01, 0xD3), M7019) == echo + b"\0"
    assert (Answered(command, modbus.ChannelMask(0x01, 0xD3)),) == events


def test_each_try_has_its_echo() -> None:
    bus = ask(Bus[Any](policy=evolve(ONCE, retries=1), echo=True), COIL)
    bus, _ = hear(bus, COIL_WIRE)
    bus, _ = receive(bus, b"", due(bus))
    bus, repeated = receive(bus, b"", due(bus))

    bus, nothing = hear(bus, COIL_WIRE, now=due(bus))

    assert ((Transmit(COIL_WIRE),), (TimedOut(COIL),)) == (repeated, nothing)


@pytest.mark.parametrize(
    ("echo", "before"),
    [(True, modbus.encode(WORD)), (False, modbus.encode(WORD)), (False, b"\x01\x04"), (False, b"\x01\x03\x20")],
    ids=["echo", "echo that is not expected", "noise", "noise like the start of a long frame"],
)
def test_an_answer_is_taken_when_it_is_whole_whatever_is_before_it(before: bytes, *, echo: bool) -> None:
    """Read as one of both sides, the answer of one register could become a request, which has a byte more."""
    heard = before + modbus.encode(modbus.InputRegisters(0x01, (7,)))

    at_once = hear(ask(idle(echo=echo), WORD), heard)[1]
    one_by_one = hear(ask(idle(echo=echo), WORD), *(bytes((byte,)) for byte in heard))[1]

    assert Answered(WORD, modbus.InputRegisters(0x01, (7,))) == at_once[-1] == one_by_one[-1]


def test_a_broadcast_has_an_echo_too() -> None:
    bus, nothing = hear(ask(idle(echo=True), dcon.HostOk()), b"~**\r", now=0.001)

    assert nothing == ()
    assert (Sent(dcon.HostOk()),) == receive(bus, b"", due(bus))[1]


# --- one line, two protocols ------------------------------------------------------------------------------------------


def test_modules_of_both_protocols_can_be_on_one_line() -> None:
    bus, first = hear(ask(idle(), READ), MASK_WIRE)
    bus, second = hear(ask(bus, COIL, now=1.0), COIL_WIRE, now=1.05)
    bus, third = hear(ask(bus, READ, SEALED, now=2.0), dcon.seal(b"!01FF", checksum=True), now=2.05)

    assert (first, second, third) == ((MASK,), (COIL_ANSWER,), (MASK,))


def test_settings_of_the_line_may_be_changed_between_requests() -> None:
    command = dcon.SetProtocol(0x01, Protocol.DCON)
    bus, _ = hear(ask(idle(), command, Profile(Model.M_7017)), b"!01\r")

    bus = ask(evolve(bus, line=LineSettings(BaudRate.BAUD_19200), policy=Policy()), READ, now=1.0)

    assert pytest.approx(1 + 11 * 10 / 19200 + 0.2) == next_deadline(bus)
