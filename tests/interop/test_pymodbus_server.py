"""The host against a Modbus server of pymodbus that plays a module, by RTU frames over TCP."""

from collections.abc import Iterator

import pytest
from pymodbus.simulator import DataType, SimData, SimDevice

from i7000 import ModbusDataFormat, Model, Profile, Protocol, TypeCode, modbus
from i7000.host import Answered, Policy, TimedOut
from i7000.host.procedures import identify, read
from i7000.link import Line
from tests.interop.foreign import pymodbus_server

WORDS = [0x4000, 0x2000, 0x0000, 0x7FFF, 0x8000, 0x1000, 0x0800, 0x0400]
QUICK = Policy(retries=1, turnaround=1.0, grace=0.05)


@pytest.fixture
def server() -> Iterator[str]:
    """A device at address 1 with eight input registers from 30001 on, and nothing else."""
    device = SimDevice(id=1, simdata=[SimData(0, values=WORDS, datatype=DataType.REGISTERS)])
    with pymodbus_server(device) as url:
        yield url


def test_what_a_server_without_46h_does_not_say_is_told(server: str) -> None:
    with Line.open(server, policy=QUICK) as line:
        found = line.run(identify(1, protocols=(Protocol.MODBUS_RTU,)))

    assert found.protocol is Protocol.MODBUS_RTU
    assert (found.name, found.known.types) == (None, None)
    unknown = {it.name: it for it in found.unknown}
    assert {"name", "firmware", "types"} <= set(unknown)
    assert isinstance(unknown["name"].outcome, TimedOut)  # pymodbus is silent where a module has an exception


def test_its_registers_are_read_by_a_profile_that_is_given(server: str) -> None:
    profile = Profile(Model.M_7017, type_codes=(TypeCode.V_10,) * 8, modbus_data_format=ModbusDataFormat.HEX)

    with Line.open(server, policy=QUICK) as line:
        outcome = line.ask(modbus.ReadInputRegisters(1, 0, 8), profile)
        report = line.run(read(1, profile, protocol=Protocol.MODBUS_RTU))

    assert isinstance(outcome, Answered)
    assert outcome.response.values == tuple(WORDS)
    values = [it and it.value for it in report.readings or ()]
    assert values == pytest.approx([5.0, 2.5, 0.0, 10.0, -10.0, 1.25, 0.625, 0.3125], abs=1e-3)
