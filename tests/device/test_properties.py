"""What holds for every module, whatever it hears and whatever is on its inputs."""

from collections.abc import Callable
from typing import Any

import pytest
from attrs import asdict, evolve
from hypothesis import given, settings
from hypothesis import strategies as st

from i7000 import DataFormat, DecodeError, Protocol, Status, dcon, modbus
from i7000.device import Bus, Eeprom, LogCommand, Ram, Signals, State, advance, power_on, step
from i7000.device.measurement import fields, words
from i7000.strategies import device
from i7000.strategies.dcon import damaged

pytestmark = pytest.mark.no_cover

NOW = 1000.0
FREQUENT = settings(max_examples=settings().max_examples * 3)

# --- frames ----------------------------------------------------------------------------------------------------------


NUMBERS = st.one_of(st.integers(0, 30), st.integers(240, 520), st.integers(860, 1110), st.integers(0, 0xFFFF))


@st.composite
def requests(draw: st.DrawFn, state: State) -> bytes:
    """Modbus requests of every kind: the bytes of each field are mostly such as mean something."""
    kind = draw(st.sampled_from(modbus.REQUESTS))
    small = st.sampled_from((0, 0, 0, 1, 2, 3, 7, 8, 0x80, 0x81, 0xFF)) | st.integers(0, 0xFF)
    words = st.lists(st.integers(0, 300) | st.integers(0, 0xFFFF), min_size=1, max_size=12)
    bits = st.lists(st.booleans(), min_size=1, max_size=12)
    address = draw(st.sampled_from((state.ram.address, state.ram.address, modbus.BROADCAST)))
    match kind.function:
        case 0x01 | 0x02 | 0x03 | 0x04:
            body = draw(NUMBERS).to_bytes(2) + draw(st.integers(0, 130)).to_bytes(2)
        case 0x05:
            body = draw(NUMBERS).to_bytes(2) + draw(st.sampled_from((b"\xff\x00", b"\x00\x00", b"\x00\x01")))
        case 0x06:
            body = draw(NUMBERS).to_bytes(2) + draw(words)[0].to_bytes(2)
        case 0x0F:
            it = modbus.WriteMultipleCoils(address, min(draw(NUMBERS), 0xFF00), tuple(draw(bits)))
            body = it.layout.encode(it, None)[2:]
        case 0x10:
            many = modbus.WriteMultipleRegisters(address, min(draw(NUMBERS), 0xFF00), tuple(draw(words)))
            body = many.layout.encode(many, None)[2:]
        case _:
            length = kind.layout.fixed - 3 + (kind.layout.tail == "mask") * state.profile.mask_digits // 2
            body = bytes((kind.sub_function or 0, *draw(st.tuples(*[small] * length))))
    return modbus.seal(bytes((address, kind.function)) + body)


def frames(state: State) -> st.SearchStrategy[bytes]:
    return requests(state) if state.ram.protocol is Protocol.MODBUS_RTU else device.frames(state)


def any_frames(state: State) -> st.SearchStrategy[bytes]:
    """Good frames, damaged ones, those of the other protocol, and noise."""
    good = frames(state)
    sealed = st.binary(max_size=20).map(lambda body: modbus.seal(bytes((state.ram.address,)) + body))
    other = device.frames(state.keep(protocol=Protocol.DCON))
    return st.one_of(good, good.flatmap(damaged).map(lambda damage: damage.wire), other, sealed, st.binary())


def _pairs(source: Callable[[State], st.SearchStrategy[Any]]) -> st.SearchStrategy[tuple[State, Any]]:
    return device.states(now=NOW).flatmap(lambda state: st.tuples(st.just(state), source(state)))


def talked_to(state: State, dialogue: list[bytes], on: Signals) -> State:
    """Give frames to a module, one per second."""
    for at, frame in enumerate(dialogue):
        state, _ = step(state, frame, on, NOW + at)
    return state


# --- properties -------------------------------------------------------------------------------------------------------


@FREQUENT
@given(_pairs(any_frames), device.signals())
def test_no_frame_raises_and_what_is_not_carried_out_changes_nothing(case: tuple[State, bytes], on: Signals) -> None:
    state, frame = case

    after, answer = step(state, frame, on, NOW)

    unheard = advance(state, on, NOW)
    if answer is None:
        heard = frame[:1] == b"\x00" or frame[1:3] == b"**"
        assert after == unheard or heard
    elif answer.startswith(b"?") or (state.ram.protocol is Protocol.MODBUS_RTU and answer[1] & 0x80):
        assert after == unheard


@FREQUENT
@given(_pairs(frames), device.signals())
def test_every_answer_is_one_that_the_host_reads(case: tuple[State, bytes], on: Signals) -> None:
    state, frame = case

    _, answer = step(state, frame, on, NOW)

    if answer is None:
        return
    if state.ram.protocol is Protocol.MODBUS_RTU:
        try:
            request = modbus.decode_request(frame, state.profile)
        except DecodeError:
            assert answer == modbus.seal(bytes((frame[0], frame[1] | 0x80, answer[2])))
            return
        response = modbus.decode_response(answer, request, state.profile)
        assert isinstance(response, modbus.ExceptionResponse | request.response)
    else:
        command = dcon.decode_command(frame, state.profile)
        assert isinstance(command, dcon.Command)
        assert isinstance(dcon.decode_response(answer, command, state.profile), dcon.Refused | command.response)


@given(_pairs(lambda state: st.lists(frames(state), max_size=12)), device.signals())
def test_after_any_dialogue_a_module_can_still_be_understood(case: tuple[State, list[bytes]], on: Signals) -> None:
    state = talked_to(*case, on)
    again = power_on(state.eeprom, init_switch=True, now=NOW)

    _, answer = step(again, b"$002\r", on, NOW)

    assert answer is not None
    told = dcon.decode_response(answer, dcon.ReadConfiguration(0x00), again.profile)
    assert isinstance(told, dcon.Configuration)
    assert (told.address, told.line_settings, told.report_settings) == (
        state.eeprom.address, state.eeprom.line_settings, state.eeprom.report_settings,
    )  # fmt: skip


@FREQUENT
@given(_pairs(lambda state: st.lists(frames(state), max_size=12)), device.signals())
def test_a_state_that_was_reached_is_as_one_that_is_made(case: tuple[State, list[bytes]], on: Signals) -> None:
    state = talked_to(*case, on)

    made = State(Eeprom(**asdict(state.eeprom, recurse=False)), Ram(**asdict(state.ram, recurse=False)))

    assert made == state
    assert made.profile == state.profile
    for data_format in DataFormat:
        assert fields(made, on, data_format) == fields(state, on, data_format)
    assert words(made, on) == words(state, on)


@given(device.states(protocol=Protocol.DCON, now=NOW), device.signals())
def test_every_channel_of_a_report_is_what_it_reads_alone(state: State, on: Signals) -> None:
    def ask(command: dcon.Command[Any]) -> Any:
        _, answer = step(state, dcon.encode(command, state.profile), on, NOW)
        assert answer is not None
        return dcon.decode_response(answer, command, state.profile)

    report = ask(dcon.ReadAnalogInputs(state.ram.address))

    alone = tuple(ask(dcon.ReadAnalogInput(state.ram.address, at)).value for at in range(state.profile.channels))
    assert report.values == alone
    disabled = [reading.status is Status.DISABLED for reading in dcon.readings(report, state.profile)]
    assert disabled == [
        state.eeprom.model.series == "7019" and not state.enabled >> at & 1 for at in range(state.profile.channels)
    ]


@given(
    device.states(now=NOW, dialogue=0).filter(lambda state: state.eeprom.log.command is LogCommand.STOP),
    device.signals(),
    st.floats(0, 1e12),
)
def test_while_nothing_is_logged_time_changes_nothing_but_the_watchdog(state: State, on: Signals, later: float) -> None:
    after = advance(state, on, NOW + later)

    watchdog = ("host_watchdog_enabled", "host_watchdog_timed_out", "host_watchdog_timeouts")
    assert after.ram == state.ram
    assert evolve(after.eeprom, **{name: getattr(state.eeprom, name) for name in watchdog}) == state.eeprom
    assert advance(after, on, NOW + later) == after


@given(st.lists(device.states(now=NOW), min_size=1, max_size=4), st.binary(max_size=30) | st.just(b"#**\r"))
def test_a_bus_is_its_modules(modules: list[State], frame: bytes) -> None:
    bus, answer = Bus(tuple(modules)).step(frame, [Signals()] * len(modules), NOW)

    alone = [step(module, frame, Signals(), NOW) for module in modules]
    assert bus.modules == tuple(state for state, _ in alone)
    assert (answer is None) == all(own is None for _, own in alone)
