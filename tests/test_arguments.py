"""Arguments of the wrong type are refused in one way everywhere, and bytes-like ones are taken as bytes."""

from typing import Any

import pytest

from i7000 import (
    ArgumentError,
    EncodeError,
    I7000Error,
    Model,
    Profile,
    Reading,
    StateError,
    Unit,
    dcon,
    device,
    host,
    modbus,
)
from i7000.arguments import as_bytes, as_tuple, check_clock, check_type
from tests.calls import CALLS, LEFT_OUT, Call, surface

NUMBERS = (None, True, -1, 300, 10**400, 1.5, float("nan"), float("inf"))
OTHERS = (
    "text", "", (), (None,), ([],), [], {}, {1: 2}, set(), frozenset(), Model, Profile, Profile.has,
    Model.I_7018, Unit.VOLT, dcon.ReadConfiguration, dcon.ReadConfiguration(0x01), modbus.ReadCoils(0x01, 0, 1),
    Reading(1.0, Unit.VOLT), range(3), range(0), dcon,
)  # fmt: skip
LIKE_BYTES = (b"", b"$012\r", bytearray(b"$012\r"), memoryview(b"$012\r"), memoryview(b"1234")[::2])
CHECKED_BY_TYPE = (bytes, bool, float, Profile, dcon.Message, modbus.Message, modbus.Side, host.Bus)
CHECKED_BY_TYPE += (device.State, device.Signals, device.Eeprom, device.Ear, device.Uart)

each_call = pytest.mark.parametrize("call", CALLS, ids=lambda call: call.name)


def test_every_public_function_method_and_constructor_is_called_or_left_out_with_a_reason() -> None:
    called = [call.name for call in CALLS]

    assert sorted([*called, *LEFT_OUT]) == sorted(set(surface()))


@each_call
def test_a_sound_call_is_carried_out(call: Call) -> None:
    assert call.function(*call.args, **call.kwargs) == call.function(*call.args, **call.kwargs)


def outcome(function: Any, value: object) -> object:
    """What a call gives, if it can be hashed, or the error that refuses its argument."""
    try:
        found = function(value)
    except I7000Error as error:
        return str(error)
    return tuple(found.items()) if isinstance(found, dict) else found


@each_call
def test_an_argument_of_any_type_is_taken_or_refused_with_an_error_of_ours(call: Call) -> None:
    for _, function in call.arguments():
        for value in (*NUMBERS, *OTHERS, *LIKE_BYTES, object(), [None], iter(())):
            assert isinstance(hash(outcome(function, value)), int), value


@each_call
def test_what_a_function_works_on_is_checked_by_its_type(call: Call) -> None:
    for argument, function in call.arguments():
        if isinstance(argument, CHECKED_BY_TYPE):
            with pytest.raises(EncodeError if call.constructs else ArgumentError):
                function(object())


@each_call
def test_bytes_like_arguments_are_taken_as_bytes_and_not_kept(call: Call) -> None:
    for argument, function in call.arguments():
        if isinstance(argument, bytes) and not call.constructs:
            buffer = bytearray(argument)
            found = function(buffer)
            buffer[:] = bytes(len(buffer))

            assert function(argument) == found == function(memoryview(argument))
            hash(found)
