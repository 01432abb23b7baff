"""The four decoders: any bytes are a message or a `DecodeError` with true facts, and a message is written as it was.

Shape: three bytes select the profile, the next the command and whether the rest is a body to be sealed: a fuzzer does
not find checksums by chance. Everything after that is the frame or its body.
"""

from functools import cache
from typing import Any
from zlib import crc32

from attrs import evolve

from fuzz.inputs import HEADER, profile_of
from i7000 import DecodeError, EncodeError, Model, Profile, dcon, modbus
from i7000.errors import Fault

__all__ = ["COMMANDS", "REQUESTS", "SEALED", "check_error", "dcon_command", "dcon_response", "modbus_request"]
__all__ += ["modbus_response"]

SEALED = 0x80
"""The bit of the byte after the profile that has the body sealed; the others select a command."""

_COMMANDS = (
    "%0102000600", "#01", "#032", "$010", "$011", "$010C0", "$011C0", "$012", "$013", "$014", "$0153A", "$016",
    "$017C0R03", "$018C0", "$019", "$019+0010", "$01A", "$01A1", "$01B", "$01F", "$01M", "$01P", "$01P1", "$01S0",
    "$01S1", "~01C", "~01C0", "~01E1", "~01I", "~01O7019A", "~01T10", "~010", "~011", "~012", "~013164", "~01EO",
    "~01EO0", "@01S", "@01S1", "$002", "$018C9", "#0113",
)  # fmt: skip
_REQUESTS = (
    "010101000001", "010200800008", "010301e40001", "010400000008", "0105010cff00", "010601e7000a",
    "010f010b00020103", "011001e7000204000a0064", "014600", "01460402000000", "01460500", "0146060006000000000000",
    "0146070000", "014608000009", "014620", "014625", "0146263a", "014629", "01462a80", "01462b00", "01462c000064",
    "01462d00", "01462e0001", "01462f", "01463001", "01040000007d", "0101000007d0", "010300000014", "01020000000d",
    "0005010cff00", "010403e80012",
)  # fmt: skip


def _commands() -> tuple[tuple[dcon.Command[Any], ...], ...]:
    """Return the commands as each kind of model reads them: a host of another kind asks the same bytes otherwise."""
    found: list[tuple[dcon.Command[Any], ...]] = []
    kinds = [profile_of(bytes((model, 0, 0))) for model in range(256)]
    for text in _COMMANDS:
        read: dict[type, dcon.Command[Any]] = {}
        for profile in kinds:
            try:
                command = dcon.decode_command(f"{text}\r".encode(), profile)
            except DecodeError:
                continue
            if isinstance(command, dcon.Command):
                read.setdefault(type(command), command)
        found.append(tuple(read.values()))
    return tuple(found)


COMMANDS: tuple[dcon.Command[Any], ...] = tuple(command for read in _commands() for command in read)
"""A command of every class, for the decoder of responses."""
REQUESTS: tuple[modbus.Request[Any], ...] = tuple(
    modbus.decode_request(modbus.seal(bytes.fromhex(body)), Profile(Model.M_7017)) for body in _REQUESTS
)
"""A request of every class, and reads of several lengths."""


def check_error(error: DecodeError, wire: bytes) -> None:
    """Check the facts of an error against the bytes that it is about."""
    assert error.wire == wire
    assert 0 <= error.offset <= len(wire)
    assert isinstance(error.fault, Fault)
    if not crc32(wire) & 0xF:  # the text takes longer than all the rest, so that of some must do
        assert str(error).startswith(error.fault.value)


def _dcon_frame(data: bytes, profile: Profile) -> bytes:
    body = data[HEADER + 1 :]
    return dcon.seal(body, checksum=profile.checksum) if data[HEADER] & SEALED else body


def dcon_command(data: bytes) -> None:
    """Decode a command, and encode it as it was."""
    if len(data) <= HEADER:
        return
    profile = profile_of(data)
    frame = _dcon_frame(data, profile)
    try:
        command = dcon.decode_command(frame, profile)
    except DecodeError as error:
        check_error(error, frame)
        return
    again = dcon.encode(command, profile, force=True)
    if again != frame:  # the minus of a zero
        assert isinstance(command, dcon.SetCjcOffset)
        assert not command.offset
        assert dcon.decode_command(again, profile) == command
    if dcon.is_answered(command):
        assert 0 < dcon.longest_response(command, profile) <= dcon.LONGEST_FRAME


def dcon_response(data: bytes) -> None:
    """Decode a response and its readings, and encode them as they were."""
    if len(data) <= HEADER:
        return
    profile = profile_of(data)
    command = COMMANDS[(data[HEADER] & ~SEALED) % len(COMMANDS)]
    frame = _dcon_frame(data, profile)
    try:
        response: dcon.Response = dcon.decode_response(frame, command, profile)
    except DecodeError as error:
        check_error(error, frame)
        return
    assert isinstance(response, command.response | dcon.Refused)
    again = dcon.encode(response, profile, force=True)
    if again != frame:
        assert _is_minus_zero(response)
        assert dcon.decode_response(again, command, profile) == response
    if isinstance(response, dcon.AnalogInputs | dcon.AnalogInputsHex | dcon.SynchronizedData):
        _check_readings(response, profile)


def _is_minus_zero(response: dcon.Response) -> bool:
    if isinstance(response, dcon.CjcOffset):
        return not response.offset
    return isinstance(response, dcon.CjcTemperature) and not response.temperature


def _check_readings(response: Any, profile: Profile) -> None:  # noqa: ANN401 - a report of any kind
    try:
        readings = dcon.readings(response, profile)
    except DecodeError:
        return
    assert len(readings) == len(response.values) == len(profile.type_codes)
    assert tuple(reading.unit for reading in readings) == profile.units
    if isinstance(response, dcon.AnalogInputsHex):
        return
    try:
        fields = dcon.fields(readings, profile)
    except EncodeError:  # beyond the span, or without a sentinel in this format
        return
    assert dcon.readings(evolve(response, values=fields), profile) == readings


def _modbus_frame(data: bytes) -> bytes:
    body = data[HEADER + 1 :]
    return modbus.seal(body) if data[HEADER] & SEALED else body


def modbus_request(data: bytes) -> None:
    """Decode a request, and encode it as it was, but for padding bits."""
    if len(data) <= HEADER:
        return
    profile = profile_of(data)
    frame = _modbus_frame(data)
    try:
        request = modbus.decode_request(frame, profile)
    except DecodeError as error:
        check_error(error, frame)
        return
    again = modbus.encode(request, profile, force=True)
    if again != frame:  # padding bits, in the last byte
        assert isinstance(request, modbus.WriteMultipleCoils)
        assert again[:-3] == frame[:-3]
        assert modbus.decode_request(again, profile) == request
    assert 0 <= modbus.longest_response(request, profile) <= modbus.LONGEST_FRAME


def modbus_response(data: bytes) -> None:
    """Decode a response, and encode it as it was, but for padding bits."""
    if len(data) <= HEADER:
        return
    profile = profile_of(data)
    request = REQUESTS[(data[HEADER] & ~SEALED) % len(REQUESTS)]
    frame = _modbus_frame(data)
    try:
        response: modbus.Response = modbus.decode_response(frame, request, profile)
    except DecodeError as error:
        check_error(error, frame)
        return
    assert isinstance(response, request.response | modbus.ExceptionResponse)
    assert len(frame) <= modbus.longest_response(request, profile)
    again = modbus.encode(response, profile, force=True)
    if again != frame:
        assert isinstance(response, modbus.Coils | modbus.DiscreteInputs)
        assert again[:-3] == frame[:-3]
        assert modbus.decode_response(again, request, profile) == response


@cache
def classes_without_a_command() -> tuple[str, ...]:
    """Return the names of the message classes that no entry of the tables has; empty as long as they are complete."""
    found = {type(command) for command in (*COMMANDS, *REQUESTS)}
    answered = [kind for kind in dcon.COMMANDS if issubclass(kind, dcon.Command)]
    return tuple(kind.__name__ for kind in (*answered, *modbus.REQUESTS) if kind not in found)
