"""pymodbus over TCP with its RTU framer, waiting and in an event loop: every function that modules have."""

import asyncio
from calendar import timegm
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from typing import Any

import pytest
from pymodbus import FramerType
from pymodbus.client import AsyncModbusTcpClient, ModbusTcpClient
from pymodbus.exceptions import ModbusIOException
from pymodbus.pdu import ModbusPDU

from i7000.simulator.tcp import listen
from tests.interop.scenes import (
    LOGGER,
    MANY_DEGREES,
    MIXED,
    NOBODY,
    ONE_BUS,
    SCENES,
    SINGLE_ENDED,
    VOLTAGES,
    counts,
)
from tests.simulator.running import Running, running

Call = Callable[..., Any]
"""Have a client do something: the name of its method, and what the method takes."""
Open = Callable[..., AbstractContextManager[Call]]


class ModuleSettings(ModbusPDU):
    """Function 46h, request and answer, as pymodbus wants to be told of functions that it does not know."""

    function_code = 0x46

    def __init__(self, payload: bytes = b"", device_id: int = 0) -> None:
        super().__init__(dev_id=device_id)
        self.payload = payload

    def encode(self) -> bytes:
        return self.payload

    def decode(self, data: bytes) -> None:
        self.payload = data

    @classmethod
    def calculateRtuFrameSize(cls, data: bytes) -> int:  # noqa: N802 - it is called so there
        """Length of an answer of a module of 8 channels, address and CRC included (3.3)."""
        bytes_of = {0x00: 5, 0x04: 5, 0x05: 9, 0x06: 9, 0x20: 4, 0x2B: 3}
        return 0 if len(data) < 3 else 4 + bytes_of.get(data[2], 2)


@contextmanager
def waiting(here: Running, timeout: float = 2) -> Iterator[Call]:
    host, _, port = here.place.partition(":")
    client: Any = ModbusTcpClient(host, framer=FramerType.RTU, port=int(port), timeout=timeout, retries=0)
    client.register(ModuleSettings)
    assert client.connect()

    def call(name: str, *what: Any, **more: Any) -> Any:
        return getattr(client, name)(*what, **more)

    try:
        yield call
    finally:
        client.close()


@contextmanager
def in_a_loop(here: Running, timeout: float = 2) -> Iterator[Call]:
    host, _, port = here.place.partition(":")
    with asyncio.Runner() as runner:

        async def connect() -> AsyncModbusTcpClient:
            client = AsyncModbusTcpClient(host, framer=FramerType.RTU, port=int(port), timeout=timeout, retries=0)
            client.register(ModuleSettings)
            assert await client.connect()
            return client

        client = runner.run(connect())

        async def called(name: str, *what: Any, **more: Any) -> Any:
            return await getattr(client, name)(*what, **more)

        async def close() -> None:
            client.close()

        try:
            yield lambda name, *what, **more: runner.run(called(name, *what, **more))
        finally:
            runner.run(close())


either = pytest.mark.parametrize("client", [waiting, in_a_loop])


def settings(call: Call, address: int, *payload: int) -> bytes:
    answer = call("execute", False, ModuleSettings(bytes(payload), address))
    assert not answer.isError()
    return bytes(answer.payload)


@either
def test_it_reads_all_channels_of_a_bus_of_many_modules(client: Open) -> None:
    with running(listen, *ONE_BUS) as here, client(here) as call:
        for scene in SCENES:
            what = {"count": len(scene.words), "device_id": scene.address}

            assert list(scene.words) == call("read_input_registers", 0, **what).registers
            assert list(scene.words) == call("read_holding_registers", 0, **what).registers


@either
def test_it_reads_temperatures(client: Open) -> None:
    with running(listen, *ONE_BUS) as here, client(here) as call:
        junctions = [call("read_input_registers", 128, device_id=address).registers for address in (2, 3, 5)]
        degrees = call("read_input_registers", 32, count=16, device_id=5).registers

    assert [[counts(degrees, 100)] for degrees in (23.45, -3.21, 31.2)] == junctions
    assert [counts(round(value), 1) for value in MANY_DEGREES] == degrees


@either
def test_it_reads_bits(client: Open) -> None:
    with running(listen, *ONE_BUS) as here, client(here) as call:
        inputs = call("read_discrete_inputs", 128, count=10, device_id=4).bits
        coils = call("read_coils", 128, count=8, device_id=3).bits
        protocol = call("read_coils", 256, device_id=1).bits

    assert inputs == [False, False, True, False, True] + [False] * 11  # to the next whole byte
    assert coils == [False, False, True, True] + [False] * 4
    assert protocol == [True] + [False] * 7


@either
def test_it_writes_registers_and_coils(client: Open) -> None:
    with running(listen, MIXED.simulated) as here, client(here) as call:
        written = [
            call("write_coil", 260, value=True, device_id=3),
            call("write_register", 488, 123, device_id=3),
            call("write_coils", 267, [False, False], device_id=3),
            call("write_registers", 352, [1, 2, 3, 4, 5, 6, 7, 65535], device_id=3),
        ]
        coils = call("read_coils", 260, count=9, device_id=3)
        both = [call("read_coils", at, count=count, device_id=3).bits[:count] for at, count in ((259, 2), (267, 2))]
        registers = [
            call("read_holding_registers", at, count=count, device_id=3).registers for at, count in ((488, 1), (352, 8))
        ]

    assert not any(answer.isError() for answer in written)
    assert coils.isError()  # 00262 to 00267 are not there
    assert both == [[False, True], [False, False]]
    assert registers == [[123], [1, 2, 3, 4, 5, 6, 7, 65535]]


@either
def test_a_broadcast_is_carried_out_by_all(client: Open) -> None:
    with running(listen, VOLTAGES.simulated, MIXED.simulated) as here, client(here) as call:
        call("write_register", 488, 77, device_id=0, no_response_expected=True)

        assert [call("read_holding_registers", 488, device_id=address).registers for address in (1, 3)] == [[77], [77]]


@either
def test_it_sets_the_logger_and_reads_records(client: Open) -> None:
    """Every second from the year 2030 on, the newest records in place of the oldest."""
    start = timegm((2030, 1, 1, 0, 0, 0))
    with running(listen, LOGGER.simulated) as here, client(here) as call:
        for at, values in ((864, (2030, 1, 1, 0, 0, 0)), (876, (1, 0, 0, 1)), (875, (1,))):
            assert not call("write_registers", at, list(values), device_id=6).isError()
        running_now = call("read_holding_registers", 874, device_id=6).registers
        record = call("read_input_registers", 1000, count=18, device_id=6).registers
        same = call("read_holding_registers", 1000, count=36, device_id=6).registers[:18]

    assert running_now == [1]
    assert list(LOGGER.words) == record[:16]
    assert record[16] + record[17] * 65536 - start in range(3)
    assert record == same


@either
def test_it_sends_function_46h(client: Open) -> None:
    with running(listen, MIXED.simulated) as here, client(here) as call:
        assert settings(call, 3, 0x00) == b"\x00\x00\x70\x19\x00"
        assert settings(call, 3, 0x20) == b"\x20\x0b\x04\x05"
        assert settings(call, 3, 0x05, 0) == b"\x05\x00\x06\x00\x00\x00\x01\x00\x00"
        assert settings(call, 3, 0x07, 0, 5) == b"\x07\x08"
        assert settings(call, 3, 0x08, 0, 5, 0x09) == b"\x08\x00"
        assert settings(call, 3, 0x07, 0, 5) == b"\x07\x09"
        assert settings(call, 3, 0x26, 0x20) == b"\x26\x00"
        assert settings(call, 3, 0x25) == b"\x25\x20"
        assert settings(call, 3, 0x04, NOBODY, 0, 0, 0) == b"\x04\x00\x00\x00\x00"
        assert settings(call, NOBODY, 0x2F) == b"\x2f\x01"


@either
@pytest.mark.parametrize(
    ("name", "what", "code"),
    [
        ("read_input_registers", {"address": 8}, 2),
        ("read_input_registers", {"address": 7, "count": 2}, 3),
        ("read_holding_registers", {"address": 0x1000}, 2),
        ("read_discrete_inputs", {"address": 0}, 2),
        ("read_coils", {"address": 0}, 2),
        ("write_coil", {"address": 272, "value": True}, 2),
        ("write_register", {"address": 0, "value": 1}, 2),
        ("write_register", {"address": 484, "value": 248}, 3),
        ("write_coils", {"address": 272, "values": [True]}, 2),
        ("write_registers", {"address": 487, "values": [31]}, 3),
        ("read_exception_status", {}, 1),
        ("mask_write_register", {"address": 488, "and_mask": 1, "or_mask": 1}, 1),
    ],
)
def test_what_a_module_does_not_have_is_an_exception(client: Open, name: str, what: dict[str, Any], code: int) -> None:
    with running(listen, VOLTAGES.simulated) as here, client(here) as call:
        answer = call(name, **what, device_id=1)

    assert answer.isError()
    assert code == answer.exception_code


@either
def test_a_wrong_sub_function_is_an_exception(client: Open) -> None:
    with running(listen, SINGLE_ENDED.simulated) as here, client(here) as call:
        unknown = call("execute", False, ModuleSettings(b"\x01", 4))
        no_cold_junction = call("execute", False, ModuleSettings(b"\x2d\x00", 4))
        beyond = call("execute", False, ModuleSettings(b"\x07\x00\x14", 4))

    assert [answer.exception_code for answer in (unknown, no_cold_junction, beyond)] == [2, 2, 3]


@either
@pytest.mark.parametrize("address", [7, NOBODY])
def test_nobody_answers_for_a_module_that_is_not_there_or_speaks_dcon(client: Open, address: int) -> None:
    with running(listen, *ONE_BUS) as here, client(here, 0.2) as call, pytest.raises(ModbusIOException):
        call("read_input_registers", 0, device_id=address)
