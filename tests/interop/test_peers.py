"""What peers write we read, what we write they read, and all compute the same CRC."""

from random import Random
from typing import Any

import pytest
from attrs import evolve

from i7000.modbus import (
    BROADCAST,
    ExceptionCode,
    ExceptionResponse,
    ReadCoils,
    ReadDiscreteInputs,
    ReadHoldingRegisters,
    ReadInputRegisters,
    Request,
    WriteMultipleRegisters,
    WriteSingleCoil,
    WriteSingleRegister,
    crc16,
    decode_request,
    decode_response,
    encode,
)
from tests.interop.peers import HOSTS, MODULES, READS, SIZE, Call, Host, ModbusTkModule, PymodbusModule, Told
from tests.interop.samples import PROFILE, STANDARD, exchanges

each_host = pytest.mark.parametrize("host", HOSTS, ids=lambda host: host.name)
each_module = pytest.mark.parametrize("module", MODULES, ids=lambda module: module.name)
each_request = pytest.mark.parametrize("kind", STANDARD, ids=lambda kind: kind.__name__)

FEW, MANY = 40, 150


def call_of(request: Any) -> Call:
    """What a peer has to be told so that it sends this request."""
    match request:
        case ReadCoils() | ReadDiscreteInputs() | ReadHoldingRegisters() | ReadInputRegisters():
            return Call(request.address, request.function, request.start, count=request.count)
        case WriteSingleCoil():
            return Call(request.address, request.function, request.coil, items=(request.value,))
        case WriteSingleRegister():
            return Call(request.address, request.function, request.register, items=(request.value,))
        case _:
            return Call(request.address, request.function, request.start, items=request.values)


@each_host
@each_request
def test_a_host_sends_what_we_send_and_understands_our_response(host: Host, kind: type[Request[Any]]) -> None:
    for it in exchanges(kind, MANY):
        asked = host.ask(call_of(it.request), encode(it.response))

        assert encode(it.request) == asked.sent
        assert it.request == decode_request(asked.sent, PROFILE)
        assert Told(getattr(it.response, "values", ())) == asked.told


@each_host
@each_request
def test_a_host_understands_our_exceptions(host: Host, kind: type[Request[Any]]) -> None:
    (it,) = exchanges(kind, 1)
    for code in ExceptionCode:
        if (host.name, code) == ("minimalmodbus", ExceptionCode.ACKNOWLEDGE):
            continue  # It takes this one for no exception.
        answer = encode(ExceptionResponse(it.request.address, kind.function, code))

        assert Told(exception_code=code) == host.ask(call_of(it.request), answer).told


@each_host
@pytest.mark.parametrize("kind", [kind for kind in STANDARD if kind.broadcast], ids=lambda kind: kind.__name__)
def test_a_host_sends_to_all_modules_what_we_send(host: Host, kind: Any) -> None:
    (it,) = exchanges(kind, 1)
    request = evolve(it.request, address=BROADCAST)

    assert encode(request) == host.ask(call_of(request), b"").sent


@each_module
@each_request
def test_a_module_does_what_we_ask_and_we_understand_its_answer(
    module: type[PymodbusModule | ModbusTkModule], kind: type[Request[Any]]
) -> None:
    """Items from `SIZE` on it does not have: it answers with an exception."""
    answers = set()
    for it in exchanges(kind, FEW):
        call = call_of(it.request)
        count = call.count or len(call.items)
        there = call.start + count <= SIZE
        peer = module(call.address)
        if there and call.function in READS:
            peer.store(call.function, call.start, tuple(it.response.values))

        answer = decode_response(peer.answer(encode(it.request)), it.request, PROFILE)

        missing = ExceptionResponse(call.address, call.function, ExceptionCode.ILLEGAL_DATA_ADDRESS)
        assert (it.response if there else missing) == answer
        if there and call.items:
            assert call.items == peer.stored(call.function, call.start, count)
        answers.add(type(answer))

    assert {ExceptionResponse, kind.response} == answers


@each_module
def test_a_module_carries_out_what_we_send_to_all_and_is_silent(module: type[PymodbusModule | ModbusTkModule]) -> None:
    peer = module(0x05)

    assert peer.answer(encode(WriteMultipleRegisters(BROADCAST, 300, (1, 2, 0xFFFF)))) == b""
    assert peer.stored(0x10, 300, 3) == (1, 2, 0xFFFF)


@each_host
def test_it_computes_our_crc(host: Host) -> None:
    random = Random(7000)
    for _ in range(1_000):
        data = random.randbytes(random.randrange(1, 300))

        assert crc16(data).to_bytes(2, "little") == host.crc(data)
