"""The guarded port: what gets out, what is counted, and that there is no way around it."""

import sys
from typing import Any

import pytest
import serial
from attrs import evolve

from i7000 import BaudRate, CharacterFormat, InvalidValueError, LineSettings, Model, Profile, Protocol, dcon, modbus
from i7000.conformance import DEFAULT_ALLOWED, GuardError, Hazard, allowing
from i7000.device import factory, power_on
from i7000.host import Answered
from i7000.link import BudgetError, GuardedPort, Line, LinkError, VirtualPort
from i7000.link.port import power_cycle
from i7000.link.process import ProcessPort

PROFILE = Profile(Model.M_7019R)


def virtual(model: Model = Model.M_7019R, protocol: Protocol = Protocol.DCON) -> VirtualPort:
    return VirtualPort([power_on(evolve(factory(model), protocol=protocol), now=0.0)])


def test_a_line_reads_through_the_guard_and_stays_usable_after_a_refusal() -> None:
    port = virtual()
    with Line(GuardedPort(port)) as line:
        assert isinstance(line.ask(dcon.ReadModuleName(0x01), PROFILE), Answered)
        before = port.modules
        with pytest.raises(GuardError, match="--allow comm"):
            line.ask(dcon.SoftInit(0x01), PROFILE)
        with pytest.raises(GuardError, match="--allow calibration"):
            line.ask(dcon.SetCalibrationEnabled(0x01, enabled=True), PROFILE)
        assert port.modules == before
        assert isinstance(line.ask(dcon.ReadModuleName(0x01), PROFILE), Answered)


def test_writes_that_can_change_settings_are_counted_and_end_with_the_budget() -> None:
    guarded = GuardedPort(virtual(), allowing([Hazard.WRITE]), budget=2)
    with Line(guarded) as line:
        for name in ("A", "B"):
            line.ask(dcon.SetModuleName(0x01, name), PROFILE)
            line.ask(dcon.ReadModuleName(0x01), PROFILE)
        with pytest.raises(BudgetError, match="budget of 2 writes"):
            line.ask(dcon.SetModuleName(0x01, "C"), PROFILE)

        assert guarded.writes == 2
        outcome = line.ask(dcon.ReadModuleName(0x01), PROFILE)
        assert isinstance(outcome, Answered)
        assert outcome.response == dcon.ModuleName(0x01, "B")


def test_a_refused_write_is_not_counted_and_not_remembered() -> None:
    guarded = GuardedPort(virtual(), budget=1)
    guarded.write(b"~01")
    with pytest.raises(GuardError):
        guarded.write(b"OX\r")

    assert guarded.writes == 0
    assert guarded.write(b"\r") == 1


def test_a_silence_ends_an_unfinished_request_but_no_text() -> None:
    read = modbus.encode(modbus.ReadInputRegisters(0x05, 0, 1))
    guarded = GuardedPort(virtual(protocol=Protocol.MODBUS_RTU))
    guarded.write(b"\x05")
    with pytest.raises(GuardError):
        guarded.write(read)
    guarded.sleep(1.0)

    assert guarded.write(read) == 8
    guarded.write(b"$01")
    guarded.sleep(9.0)
    with pytest.raises(GuardError):
        guarded.write(b"0\r")


def test_a_power_cycle_empties_the_line() -> None:
    guarded = GuardedPort(virtual())
    guarded.write(b"$01")
    guarded.power_cycle()

    assert guarded.write(b"0\r") == 2


def test_a_line_switches_the_power_through_the_guard() -> None:
    port = virtual()
    guarded = GuardedPort(port)

    assert power_cycle(guarded, init_switch=True)
    assert port.init_switches == [True]


class Buffering:
    """A port that takes bytes faster than the line sends them."""

    baudrate, parity, stopbits, timeout, time = 9600, "N", 1, 0.0, 0.0

    def now(self) -> float:
        return self.time

    def write(self, data: bytes) -> int:
        return len(data)


def test_a_silence_begins_when_all_bytes_are_on_the_line() -> None:
    port: Any = Buffering()
    guarded = GuardedPort(port)
    for wire in (b"\x63" * 300, b"\x63" * 300, b"\x05"):
        guarded.write(wire)
    read = modbus.encode(modbus.ReadInputRegisters(0x05, 0, 1))

    port.time = 0.7
    with pytest.raises(GuardError):
        guarded.write(read)
    port.time = 0.9
    assert guarded.write(read) == 8


@pytest.mark.parametrize(("options", "expected"), [({"init_switch": True}, True), ({"init_switch": False}, False)])
def test_the_init_switch_at_a_power_cycle_is_that_of_the_port(options: Any, expected: Any) -> None:
    port = virtual()
    GuardedPort(port).power_cycle(**options)

    assert port.modules[0].ram.init_mode is expected


def test_a_power_cycle_that_fails_leaves_the_line_as_it_is() -> None:
    guarded = GuardedPort(virtual())
    guarded.write(b"$01")
    with pytest.raises(TypeError):
        guarded.power_cycle(True)

    with pytest.raises(GuardError):
        guarded.write(b"0\r")


def test_the_settings_of_the_port_are_those_of_the_guard() -> None:
    port = virtual()
    guarded = GuardedPort(port, DEFAULT_ALLOWED)
    line = LineSettings(BaudRate.BAUD_19200, CharacterFormat.E81)
    with Line(guarded, line):
        assert (guarded.baudrate, guarded.parity, guarded.stopbits) == (port.baudrate, port.parity, port.stopbits)
        assert (guarded.baudrate, guarded.parity, guarded.stopbits) == (19200, "E", 1)
    guarded.stopbits = 2
    assert port.stopbits == 2
    guarded.timeout = 2.0

    assert port.timeout == guarded.timeout == 2.0
    assert guarded.allowed == DEFAULT_ALLOWED
    assert not guarded.is_open


@pytest.mark.parametrize(("name", "value"), [("baudrate", 14400), ("parity", "M"), ("stopbits", 1.5), ("bytesize", 7)])
def test_line_settings_that_no_module_can_have_are_refused(name: str, value: Any) -> None:
    port = virtual()
    guarded = GuardedPort(port)
    setattr(port, name, value)

    with pytest.raises(InvalidValueError, match="1200 to 115200 baud"):
        guarded.write(b"$012\r")


def test_there_is_no_public_way_around_the_guard() -> None:
    port = virtual()
    guarded: Any = GuardedPort(port)
    public = {name for name in dir(guarded) if not name.startswith("_")}

    assert public == {
        "allowed", "baudrate", "close", "in_waiting", "is_open", "name", "parity", "read", "stopbits", "timeout",
        "write", "writes",
    }  # fmt: skip
    assert all(getattr(guarded, name) is not port for name in public)
    with pytest.raises(AttributeError):
        guarded.writelines([b"~01I\r"])
    with pytest.raises(AttributeError):
        guarded.bytesize = 7


def test_what_a_port_does_not_have_the_guarded_one_does_not_have() -> None:
    port = serial.serial_for_url("loop://", timeout=0.0)
    guarded = GuardedPort(port)

    assert not hasattr(guarded, "power_cycle")
    assert not hasattr(guarded, "now")
    assert guarded.write(b"$012\r") == 5
    assert guarded.in_waiting == 5
    assert guarded.read(2) == b"$0"
    guarded.reset_input_buffer()
    assert guarded.in_waiting == 0
    guarded.close()
    with Line(guarded) as line, pytest.raises(LinkError):
        line.ask(dcon.ReadModuleName(0x01), PROFILE)


def test_a_process_is_guarded_too() -> None:
    port = ProcessPort([sys.executable, "-c", "import sys; sys.stdin.buffer.read()"])
    guarded = GuardedPort(port)
    try:
        assert guarded.name == f"exec:{sys.executable}"
        with pytest.raises(GuardError):
            guarded.write(b"%0102080600\r")
        assert guarded.write(b"$012\r") == 5
        guarded.power_cycle()
        assert guarded.is_open
    finally:
        guarded.close()


@pytest.mark.parametrize("budget", [-1, 1.5, True])
def test_a_budget_is_a_number_of_writes(budget: Any) -> None:
    with pytest.raises(InvalidValueError, match="budget"):
        GuardedPort(virtual(), budget=budget)
