"""Arguments of the wrong type are refused in one way everywhere, and bytes-like ones are taken as bytes."""

from collections.abc import Callable, Generator, Iterator
from inspect import signature
from typing import Any

import attrs
import pytest

from i7000 import (
    ArgumentError,
    DecodeError,
    EncodeError,
    I7000Error,
    InvalidValueError,
    Model,
    Profile,
    Reading,
    StateError,
    Unit,
    dcon,
    device,
    dissect,
    host,
    modbus,
)
from i7000.arguments import as_bytes
from i7000.dissect import meanings
from tests.calls import BASES, CALLS, LEFT_OUT, Call, surface
from tests.each import each

NUMBERS = (None, True, -1, 300, 10**400, 1.5, float("nan"), float("inf"))
OTHERS: tuple[Any, ...] = (
    "text", "", (), (None,), ([],), ((1, b"$012"),), ("$012",), [], {}, {1: 2}, set(), frozenset(), Model, Profile,
    Profile.has,
    Model.I_7018, Unit.VOLT, dcon.ReadConfiguration, dcon.ReadConfiguration(0x01), modbus.ReadCoils(0x01, 0, 1),
    Reading(1.0, Unit.VOLT), range(3), range(0), dcon,
)  # fmt: skip
LIKE_BYTES = (b"", b"$012\r", bytearray(b"$012\r"), memoryview(b"$012\r"), memoryview(b"1234")[::2])
CHECKED_BY_TYPE = (
    bytes, bool, float, Profile, dcon.Message, modbus.Message, modbus.Side, host.Bus, device.State, device.Signals,
    device.Eeprom, device.Ear, device.Uart, dissect.Fact, dissect.Known, dissect.Knowledge, dissect.Line,
    dissect.Module,
)  # fmt: skip

each_call = each("call", [pytest.param(call, id=call.name) for call in CALLS])


def test_every_public_function_method_and_constructor_is_called_or_left_out_with_a_reason() -> None:
    called = [call.name for call in CALLS]

    assert sorted([*called, *LEFT_OUT]) == sorted(set(surface()))


@each_call
def test_a_sound_call_is_carried_out(call: Call) -> None:
    first, second = (call.function(*call.args, **call.kwargs) for _ in range(2))

    assert alike(first, second)


def alike(one: Any, other: Any) -> bool:
    """Whether two calls gave the same; what is compared by identity is compared by all that it has."""
    if isinstance(one, Generator):  # a procedure, which needs to be sent something after its first step
        return bool(next(one) == next(other))
    if isinstance(one, Iterator):
        return list(one) == list(other)
    return bool(one == other) or repr(one) == repr(other)


def outcome(function: Any, value: object, *, driven: bool) -> object:
    """What a call gives, if it can be hashed, or the error that refuses its argument; `driven`: it is a procedure."""
    try:
        found = function(value)
        if isinstance(found, Iterator) and not driven:
            return tuple(found)
    except I7000Error as error:
        return str(error)
    return tuple(found.items()) if isinstance(found, dict) else found


@each_call
def test_an_argument_of_any_type_is_taken_or_refused_with_an_error_of_ours(call: Call) -> None:
    for _, function in call.arguments():
        for value in (*NUMBERS, *OTHERS, *LIKE_BYTES, object(), [None], iter(())):
            found = outcome(function, value, driven=call.name.startswith("procedures."))
            assert isinstance(hash(found), int), value


@each_call
def test_what_a_function_works_on_is_checked_by_its_type(call: Call) -> None:
    for argument, function in call.arguments():
        if isinstance(argument, CHECKED_BY_TYPE):
            with pytest.raises(InvalidValueError if call.constructs else ArgumentError):
                function(object())


@each_call
def test_bytes_like_arguments_are_taken_as_bytes_and_not_kept(call: Call) -> None:
    for argument, function in call.arguments():
        if isinstance(argument, bytes) and not call.constructs:
            buffer = bytearray(argument)
            found = function(buffer)
            buffer[:] = bytes(len(buffer))

            assert alike(function(argument), found)
            assert alike(found, function(memoryview(argument)))
            hash(found)


def test_a_subclass_of_bytes_is_taken_as_plain_bytes() -> None:
    class Named(bytes):
        """Bytes with a name."""

    assert type(as_bytes("frame", Named(b"$012\r"))) is bytes


def test_a_subclass_of_bytes_cannot_say_what_its_bytes_are() -> None:
    class Odd(bytes):
        def __bytes__(self) -> bytes:
            raise RuntimeError

    assert as_bytes("frame", Odd(b"$012\r")) == b"$012\r"


def test_a_memoryview_that_was_released_is_refused() -> None:
    view = memoryview(b"$012\r")
    view.release()

    with pytest.raises(ArgumentError, match="frame is a memoryview that was released: bytes"):
        meanings(view)  # type: ignore[arg-type]


def test_an_error_names_the_argument_what_was_given_and_what_is_allowed() -> None:
    with pytest.raises(ArgumentError) as caught:
        meanings("$012\r")  # type: ignore[arg-type]

    assert str(caught.value) == r"frame must be bytes, bytearray or memoryview, not '$012\r' (str)"
    assert (caught.value.argument, caught.value.value) == ("frame", "$012\r")
    assert caught.value.allowed == "bytes, bytearray or memoryview"
    assert isinstance(caught.value, TypeError)


def test_an_optional_argument_accepts_none() -> None:
    with pytest.raises(ArgumentError, match=r"profile must be Profile or None, not 5 \(int\)"):
        modbus.flush(b"", profile=5)  # type: ignore[arg-type]

    assert modbus.flush(b"", profile=None) == ()


@pytest.mark.parametrize("base", BASES, ids=lambda base: f"{base.__module__}.{base.__name__}")
def test_a_base_class_of_messages_cannot_be_constructed(base: Any) -> None:
    arguments = [1] * len(signature(base).parameters) if attrs.has(base) else []

    with pytest.raises(ArgumentError, match=f"{base.__name__} is a base class: construct one of the ") as caught:
        base(*arguments)

    module = dcon if issubclass(base, dcon.Message) else modbus  # one of them for the bases of both
    instead = getattr(module, caught.value.allowed.rpartition(" ")[2])
    assert issubclass(instead, base)
    assert instead.section


class Unwritable:
    """A value of which no text can be made."""

    def __repr__(self) -> str:
        raise RuntimeError


def test_a_value_that_cannot_be_written_is_refused_all_the_same() -> None:
    with pytest.raises(ArgumentError, match=r"not a value of Unwritable whose repr\(\) fails"):
        meanings(Unwritable())  # type: ignore[arg-type]


def test_a_text_in_place_of_a_reading_is_named_in_the_error() -> None:
    with pytest.raises(ArgumentError, match=r"values must be Reading, not 'text' \(str\)"):
        dcon.fields(["text"] * 8, Profile(Model.I_7018))  # type: ignore[list-item]


class Marked(Reading):
    """A reading with a name of its own."""


def test_a_subclass_of_reading_is_a_reading() -> None:
    profile = Profile(Model.I_7018)

    assert dcon.fields([Marked(1.0, Unit.VOLT)] * 8, profile) == dcon.fields([Reading(1.0, Unit.VOLT)] * 8, profile)


@pytest.mark.parametrize("channel", [-1, -2, -8])
def test_a_channel_is_not_counted_from_the_end(channel: int) -> None:
    with pytest.raises(EncodeError, match="channel cannot be"):
        dcon.field(Reading(1.0, Unit.VOLT), channel, Profile(Model.I_7018))
    with pytest.raises(DecodeError, match="type_codes"):
        dcon.reading(dcon.AnalogInput("+1.0000"), channel, Profile(Model.I_7018))


# --- clocks -----------------------------------------------------------------------------------------------------------

PROFILE = Profile(Model.I_7018)
READ = dcon.ReadAnalogInput(0x01, 0)
MODULE = device.power_on(device.factory(Model.I_7018), now=5.0)
BUS = device.Bus((MODULE,)).step(b"", (device.Signals(),), 5.0)[0]
OPEN = host.send(host.Bus[Any](), READ, PROFILE, 5.0)
SIGNALS = device.Signals()
CLOCKS: dict[str, Callable[[float], Any]] = {
    "host.send": lambda now: host.send(host.receive(OPEN, b"", 5.0)[0], READ, PROFILE, now),
    "host.receive": lambda now: host.receive(OPEN, b">", now),
    "host.abandon": lambda now: host.abandon(OPEN, now),
    "device.step": lambda now: device.step(MODULE, b"$012\r", SIGNALS, now),
    "device.advance": lambda now: device.advance(MODULE, SIGNALS, now),
    "device.Bus.step": lambda now: BUS.step(b"$012\r", (SIGNALS,), now),
    "device.Bus.hear": lambda now: BUS.hear(device.Ear(), b"$", (SIGNALS,), now),
    "device.Bus.silence": lambda now: BUS.silence(device.Ear(), (SIGNALS,), now),
}

each_clock = pytest.mark.parametrize("call", CLOCKS.values(), ids=CLOCKS)


def test_every_function_with_a_clock_is_tried() -> None:
    with_clock = {call.name for call in CALLS if "now" in signature(call.function).parameters}

    assert with_clock - set(CLOCKS) == {"device.power_on"}


@each_clock
@pytest.mark.parametrize("now", [float("nan"), float("inf"), float("-inf"), 10**400])
def test_a_time_that_is_not_finite_is_refused(call: Callable[[float], Any], now: float) -> None:
    with pytest.raises(InvalidValueError, match=r"now cannot be .*: a finite number of seconds"):
        call(now)


@each_clock
@pytest.mark.parametrize("now", ["5", None, True, 5j])
def test_what_is_no_time_is_refused(call: Callable[[float], Any], now: Any) -> None:
    with pytest.raises(ArgumentError, match="now must be int or float, not "):
        call(now)


@each_clock
def test_a_clock_that_goes_back_is_refused(call: Callable[[float], Any]) -> None:
    with pytest.raises(StateError, match=r"the clock went back from 5\.0 to 4\.5: use a monotonic clock"):
        call(4.5)


@pytest.mark.parametrize("now", [float("nan"), float("inf"), 10**400])
def test_no_module_gets_power_at_a_time_that_is_not_finite(now: float) -> None:
    with pytest.raises(InvalidValueError, match=r"now cannot be .*: a finite number of seconds"):
        device.power_on(device.factory(Model.I_7018), now=now)


def test_the_clock_of_a_line_goes_on_with_every_call() -> None:
    bus, _ = host.receive(host.Bus[Any](), b"", 7.0)

    with pytest.raises(StateError):
        host.send(bus, READ, PROFILE, 6.0)


def test_the_clock_of_a_module_goes_on_with_what_is_not_for_it() -> None:
    module, _ = device.step(MODULE, b"$022\r", SIGNALS, 7.0)

    with pytest.raises(StateError):
        device.step(module, b"$012\r", SIGNALS, 6.0)


def test_the_clock_of_a_bus_goes_on_with_what_is_no_frame_yet() -> None:
    bus, ear, _ = BUS.hear(device.Ear(), b"$0", (SIGNALS,), 7.0)

    with pytest.raises(StateError):
        bus.hear(ear, b"12\r", (SIGNALS,), 6.0)


def test_a_module_without_power_forgets_the_clock() -> None:
    again = device.power_on(device.step(MODULE, b"", SIGNALS, 9.0)[0].eeprom, now=1.0)

    assert device.step(again, b"$01M\r", SIGNALS, 1.0)[1] == b"!017018\r"
