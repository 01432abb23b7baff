"""What we refuse, and which of the peers take it all the same: each row of the tables is a difference, with its reason.

Laws: a row says of every peer whether it takes the nonsense; a peer that changes its mind makes its row fail.
"""

from collections.abc import Callable
from typing import Any

import pytest
from attrs import frozen

from i7000 import DecodeError, EncodeError, Fault
from i7000.modbus import (
    Coils,
    ReadCoils,
    ReadHoldingRegisters,
    Request,
    WriteMultipleCoils,
    WriteMultipleRegisters,
    WriteSingleCoil,
    WriteSingleRegister,
    decode_request,
    decode_response,
    encode,
    seal,
)
from tests.interop.peers import HOSTS, MODULES, Call, ModbusTkModule, PymodbusModule, Told
from tests.interop.samples import PROFILE
from tests.interop.test_peers import call_of

PYMODBUS, MODBUS_TK, MINIMALMODBUS = "pymodbus", "modbus-tk", "minimalmodbus"
NONE: set[str] = set()

TWO_REGISTERS = ReadHoldingRegisters(0x01, 0, 2)
TEN_COILS = ReadCoils(0x01, 0, 10)
A_COIL = WriteSingleCoil(0x01, 3, True)
A_REGISTER = WriteSingleRegister(0x01, 3, 5)
COILS = WriteMultipleCoils(0x01, 3, (True, False))
REGISTERS = WriteMultipleRegisters(0x01, 3, (5, 6))


def sealed(body: str) -> bytes:
    return seal(bytes.fromhex(body))


@frozen
class Response:
    """Bytes that are no answer to a request."""

    request: Request[Any]
    frame: bytes
    fault: Fault
    taken_by: set[str]
    why: str
    """Why it is refused here."""


RESPONSES = (
    Response(TWO_REGISTERS, bytes.fromhex("010304000a000b0000"), Fault.CRC, NONE, "the CRC is wrong"),
    Response(TWO_REGISTERS, sealed("020304000a000b"), Fault.ADDRESS, NONE, "another module answers"),
    Response(TWO_REGISTERS, sealed("000304000a000b"), Fault.ADDRESS, NONE, "no module has address 0"),
    Response(TWO_REGISTERS, sealed("010404000a000b"), Fault.FUNCTION, {PYMODBUS, MODBUS_TK}, "other registers"),
    Response(
        TWO_REGISTERS, sealed("018402"), Fault.FUNCTION, {PYMODBUS, MODBUS_TK, MINIMALMODBUS},
        "the exception is that of another request",
    ),
    Response(
        TWO_REGISTERS, sealed("01830200"), Fault.LENGTH, {MODBUS_TK, MINIMALMODBUS}, "an exception has five bytes"
    ),
    Response(TWO_REGISTERS, sealed("0183"), Fault.LENGTH, {MINIMALMODBUS}, "it has no exception code"),
    Response(TWO_REGISTERS, sealed("0103"), Fault.LENGTH, NONE, "there is no byte count"),
    Response(TWO_REGISTERS, sealed("010300"), Fault.COUNT, {PYMODBUS}, "two registers were asked for"),
    Response(TWO_REGISTERS, sealed("010302000a"), Fault.COUNT, {PYMODBUS}, "two registers were asked for"),
    Response(TWO_REGISTERS, sealed("010306000a000b000c"), Fault.COUNT, {PYMODBUS}, "two registers were asked for"),
    Response(TWO_REGISTERS, sealed("010303000a00"), Fault.COUNT, {PYMODBUS}, "half a register is none"),
    Response(TWO_REGISTERS, sealed("010302000a000b"), Fault.LENGTH, NONE, "more bytes than the byte count says"),
    Response(TWO_REGISTERS, sealed("010306000a000b"), Fault.LENGTH, NONE, "fewer bytes than the byte count says"),
    Response(
        TWO_REGISTERS, sealed("010304000a000b") + b"\0", Fault.LENGTH, {PYMODBUS, MODBUS_TK, MINIMALMODBUS},
        "a decoder gets one frame; what finds it in a stream is the splitter",
    ),
    Response(TWO_REGISTERS, b"\0" + sealed("010304000a000b"), Fault.CRC, NONE, "as before, but in front"),
    Response(TEN_COILS, sealed("010101ff"), Fault.COUNT, {PYMODBUS}, "ten coils have two bytes"),
    Response(TEN_COILS, sealed("010103ff0300"), Fault.COUNT, {PYMODBUS}, "ten coils have two bytes"),
    Response(A_COIL, sealed("010500030001"), Fault.ECHO, {PYMODBUS, MODBUS_TK}, "0001 is no coil, nor what was sent"),
    Response(A_COIL, sealed("010500030000"), Fault.ECHO, {PYMODBUS, MODBUS_TK}, "the coil was to be set"),
    Response(A_COIL, sealed("01050004ff00"), Fault.ECHO, {PYMODBUS, MODBUS_TK}, "another coil was written"),
    Response(A_REGISTER, sealed("010600030006"), Fault.ECHO, {PYMODBUS, MODBUS_TK}, "another value was written"),
    Response(A_REGISTER, sealed("010600040005"), Fault.ECHO, {PYMODBUS, MODBUS_TK}, "another register was written"),
    Response(A_REGISTER, sealed("0106000300050000"), Fault.LENGTH, NONE, "one register was written"),
    Response(COILS, sealed("010f00040002"), Fault.ECHO, {PYMODBUS, MODBUS_TK}, "other coils were written"),
    Response(COILS, sealed("010f00030001"), Fault.ECHO, {PYMODBUS, MODBUS_TK}, "fewer coils were written"),
    Response(REGISTERS, sealed("011000040002"), Fault.ECHO, {PYMODBUS, MODBUS_TK}, "other registers were written"),
    Response(REGISTERS, sealed("011000030001"), Fault.ECHO, {PYMODBUS, MODBUS_TK}, "fewer registers were written"),
)  # fmt: skip


@pytest.mark.parametrize("row", RESPONSES, ids=lambda row: f"{row.frame.hex()}-{row.fault.value}")
def test_a_response_is_refused_here_whoever_takes_it(row: Response) -> None:
    with pytest.raises(DecodeError) as caught:
        decode_response(row.frame, row.request, PROFILE)

    assert row.fault is caught.value.fault, row.why
    assert row.taken_by == {host.name for host in HOSTS if host.ask(call_of(row.request), row.frame).told is not None}


def test_padding_bits_of_an_answer_are_ignored_here_as_by_every_peer() -> None:
    frame, coils = sealed("010102fffe"), (True,) * 8 + (False, True)

    assert Coils(0x01, coils) == decode_response(frame, TEN_COILS, PROFILE)
    assert [Told(coils)] * len(HOSTS) == [host.ask(call_of(TEN_COILS), frame).told for host in HOSTS]


@frozen
class Sent:
    """What cannot be asked for, but can be put into bytes."""

    call: Call
    make: Callable[[], bytes]
    sent_by: set[str]
    why: str
    fault: Fault | None = None
    """How the bytes are refused, if they are; None where they are those of a sound request."""


SENT = (
    Sent(
        Call(0x01, 0x03, 0), lambda: encode(ReadHoldingRegisters(0x01, 0, 0)), {MODBUS_TK},
        "nothing is asked for", Fault.RANGE,
    ),
    Sent(
        Call(0x01, 0x03, 0, 126), lambda: encode(ReadHoldingRegisters(0x01, 0, 126)), {MODBUS_TK},
        "the answer would not fit into a frame", Fault.RANGE,
    ),
    Sent(
        Call(0x01, 0x01, 0, 2001), lambda: encode(ReadCoils(0x01, 0, 2001)), {MODBUS_TK},
        "the answer would not fit into a frame", Fault.RANGE,
    ),
    Sent(
        Call(0x01, 0x03, 0xFFFF, 2), lambda: encode(ReadHoldingRegisters(0x01, 0xFFFF, 2)),
        {PYMODBUS, MODBUS_TK, MINIMALMODBUS}, "there is no register 65536", Fault.RANGE,
    ),
    Sent(Call(0x01, 0x03, 0x10000, 1), lambda: encode(ReadHoldingRegisters(0x01, 0x10000, 1)), NONE, "nor here"),
    Sent(Call(0x01, 0x03, -1, 1), lambda: encode(ReadHoldingRegisters(0x01, -1, 1)), NONE, "nor a register -1"),
    Sent(
        Call(248, 0x03, 0, 1), lambda: encode(ReadHoldingRegisters(248, 0, 1)), {PYMODBUS, MODBUS_TK, MINIMALMODBUS},
        "addresses end at 247", Fault.ADDRESS,
    ),
    Sent(Call(256, 0x03, 0, 1), lambda: encode(ReadHoldingRegisters(256, 0, 1)), NONE, "an address is a byte"),
    Sent(
        Call(0, 0x03, 0, 1), lambda: encode(ReadHoldingRegisters(0, 0, 1)), {PYMODBUS, MODBUS_TK},
        "all modules cannot answer at once", Fault.ADDRESS,
    ),
    Sent(Call(0x01, 0x06, 0, items=(0x10000,)), lambda: encode(WriteSingleRegister(0x01, 0, 0x10000)), NONE, "no word"),
    Sent(
        Call(0x01, 0x06, 0, items=(-1,)), lambda: encode(WriteSingleRegister(0x01, 0, -1)), {MODBUS_TK},
        "a register is a word; what it means by its sign is for the map to say",
    ),
    Sent(
        Call(0x01, 0x10, 0, items=(-1,)), lambda: encode(WriteMultipleRegisters(0x01, 0, (-1,))), {MODBUS_TK},
        "the same",
    ),
    Sent(
        Call(0x01, 0x05, 0, items=(2,)), lambda: encode(WriteSingleCoil(0x01, 0, 2)),  # type: ignore[arg-type]
        {PYMODBUS, MODBUS_TK}, "a coil is on or off",
    ),
    Sent(
        Call(0x01, 0x0F, 0, items=(True,) * 1969), lambda: encode(WriteMultipleCoils(0x01, 0, (True,) * 1969)),
        {PYMODBUS, MODBUS_TK}, "1968 coils are the most", Fault.RANGE,
    ),
    Sent(
        Call(0x01, 0x0F, 0), lambda: encode(WriteMultipleCoils(0x01, 0, ())), {MODBUS_TK},
        "nothing is written", Fault.RANGE,
    ),
    Sent(
        Call(0x01, 0x10, 0, items=(1,) * 124), lambda: encode(WriteMultipleRegisters(0x01, 0, (1,) * 124)),
        {PYMODBUS, MODBUS_TK}, "the frame has 257 bytes", Fault.LENGTH,
    ),
    Sent(
        Call(0x01, 0x10, 0), lambda: encode(WriteMultipleRegisters(0x01, 0, ())), {PYMODBUS, MODBUS_TK},
        "nothing is written", Fault.RANGE,
    ),
    Sent(
        Call(0x01, 0x10, 0xFFFF, items=(1, 2)), lambda: encode(WriteMultipleRegisters(0x01, 0xFFFF, (1, 2))),
        {PYMODBUS, MODBUS_TK, MINIMALMODBUS}, "there is no register 65536", Fault.RANGE,
    ),
)  # fmt: skip


@pytest.mark.parametrize("row", SENT, ids=lambda row: f"{row.call.function:02X} {row.why}")
def test_what_cannot_be_asked_for_is_not_sent_here_whoever_sends_it(row: Sent) -> None:
    sent = {host.name: asked.sent for host in HOSTS if (asked := host.ask(row.call, b"")).sent is not None}

    with pytest.raises(EncodeError):
        row.make()
    assert row.sent_by == set(sent), row.why
    for frame in sent.values():
        if row.fault is None:
            assert frame == encode(decode_request(frame, PROFILE))
        else:
            with pytest.raises(DecodeError) as caught:
                decode_request(frame, PROFILE)
            assert row.fault is caught.value.fault


@frozen
class Received:
    """Bytes that are no request."""

    frame: bytes
    fault: Fault
    done_by: set[str]
    why: str


RECEIVED = (
    Received(bytes.fromhex("0103000000010000"), Fault.CRC, NONE, "the CRC is wrong"),
    Received(sealed("010300000000"), Fault.RANGE, NONE, "nothing is asked for"),
    Received(sealed("01030000007e"), Fault.RANGE, NONE, "the answer would not fit into a frame"),
    Received(sealed("0101000007d1"), Fault.RANGE, NONE, "the answer would not fit into a frame"),
    Received(sealed("01030000000100"), Fault.LENGTH, {MODBUS_TK}, "a read has eight bytes"),
    Received(sealed("0103000000"), Fault.LENGTH, NONE, "a read has eight bytes"),
    Received(sealed("000300000001"), Fault.ADDRESS, NONE, "all modules cannot answer at once"),
    Received(sealed("010500000001"), Fault.VALUE, {PYMODBUS}, "0001 is no coil"),
    Received(sealed("01050000ff01"), Fault.VALUE, {PYMODBUS}, "FF01 is no coil"),
    Received(sealed("0106000000010000"), Fault.LENGTH, {MODBUS_TK}, "one register is written"),
    Received(sealed("010f000007b1f7" + "00" * 247), Fault.RANGE, {PYMODBUS}, "1968 coils are the most"),
    Received(sealed("010f00000001020100"), Fault.COUNT, NONE, "one coil has one byte"),
    Received(sealed("010f0000000000"), Fault.RANGE, NONE, "nothing is written"),
    Received(sealed("0110000000010400010002"), Fault.COUNT, NONE, "one register has two bytes"),
    Received(sealed("01100000000204000100"), Fault.LENGTH, NONE, "two registers have four bytes"),
    Received(sealed("01100000000000"), Fault.RANGE, NONE, "nothing is written"),
)


def carries_out(module: type[PymodbusModule | ModbusTkModule], frame: bytes) -> bool:
    """Whether the module answers, and not with an exception."""
    answer = module(0x01).answer(frame)
    return answer[:2] == frame[:2]


@pytest.mark.parametrize("row", RECEIVED, ids=lambda row: f"{row.frame[:12].hex()}-{row.fault.value}")
def test_a_request_is_refused_here_whoever_carries_it_out(row: Received) -> None:
    with pytest.raises(DecodeError) as caught:
        decode_request(row.frame, PROFILE)

    assert row.fault is caught.value.fault, row.why
    assert row.done_by == {module.name for module in MODULES if carries_out(module, row.frame)}


def test_padding_bits_of_a_request_are_ignored_here_as_by_every_peer() -> None:
    frame = sealed("010f0000000101ff")

    assert WriteMultipleCoils(0x01, 0, (True,)) == decode_request(frame, PROFILE)
    assert [True] * len(MODULES) == [carries_out(module, frame) for module in MODULES]
