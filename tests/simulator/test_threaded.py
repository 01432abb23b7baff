"""A simulator for tests without an event loop."""

import asyncio
import subprocess
import sys
import threading
from typing import Any

import pytest
import serial

import i7000.simulator as public
from i7000 import InvalidValueError, Model, Protocol, Unit
from i7000.device import Signal
from i7000.simulator import COLD_JUNCTION, Change, Faults, Observed, Ramp, RunningSimulator, simulate
from tests.simulator.running import I_7018, SAID, module
from tests.waiting import ENOUGH


def asked(running: RunningSimulator, command: bytes) -> bytes:
    opened: Any = serial.serial_for_url(running, timeout=ENOUGH)
    with opened:
        opened.write(command)
        return bytes(opened.read_until(b"\r"))


@pytest.mark.parametrize(
    ("over", "begins"), [(None, "/dev/"), ("pty", "/dev/"), ("socket", "socket://"), ("rfc2217", "rfc2217://")]
)
def test_a_driver_opens_the_url(over: Any, begins: str) -> None:
    with simulate(I_7018, over=over) as running:
        assert running.startswith(begins)
        assert asked(running, b"#01\r") == SAID


def test_models_and_eeproms_are_modules_with_signals() -> None:
    eeprom = module(Model.I_7017, address=0x10).eeprom

    with simulate(Model.I_7018, Model.M_7019R, eeprom) as running:
        first, second, third = running.modules
        assert asked(running, b"$01M\r") == b"!017018\r"
        assert asked(running, b"#100\r") == b">+01.111\r"

    assert (first.eeprom.address, second.eeprom.address, third.eeprom) == (1, 2, eeprom)
    assert second.ram.protocol is Protocol.MODBUS_RTU


def test_nothing_is_left_after_the_context() -> None:
    with simulate(Model.I_7018, over="socket") as running:
        host, _, number = running.removeprefix("socket://").rpartition(":")
    with pytest.raises(serial.SerialException):
        serial.serial_for_url(f"socket://{host}:{number}")

    assert "i7000 simulator" not in {thread.name for thread in threading.enumerate()}


def test_it_ends_when_the_test_fails_too() -> None:
    with pytest.raises(ZeroDivisionError), simulate(Model.I_7018):
        raise ZeroDivisionError

    assert "i7000 simulator" not in {thread.name for thread in threading.enumerate()}


def test_faults_are_switched_while_it_runs() -> None:
    with simulate(Model.I_7018, faults=Faults(refuse=1.0)) as running:
        refused = asked(running, b"$01M\r")
        assert running.faults == Faults(refuse=1.0)
        running.faults = Faults()
        answered = asked(running, b"$01M\r")

    assert (refused, answered) == (b"?01\r", b"!017018\r")


def test_signals_are_changed_while_it_runs() -> None:
    with simulate(Model.I_7017, Model.I_7017, Model.I_7018) as running:
        running.connect(0, Signal(5.0, Unit.VOLT), address=2)
        running.connect(1, None)
        running.connect(2, Ramp(1, 1, 60, Unit.VOLT))
        running.connect(COLD_JUNCTION, Signal(30.0, Unit.CELSIUS), address=3)
        first, second = asked(running, b"#01\r"), asked(running, b"#02\r")
        junction = asked(running, b"$033\r")

    assert first.startswith(b">+01.111+00.000+01.000+04.444")
    assert second.startswith(b">+05.000+00.000+01.000+04.444")
    assert junction == b">+0030.0\r"


def test_power_and_init_switch_are_those_of_one_module() -> None:
    changes: list[Change] = []
    with simulate(Model.I_7018, Model.I_7017, watch=changes.append) as running:
        running.switch_init(1, on=True)
        running.power_cycle(1)
        named = asked(running, b"$00M\r"), asked(running, b"$02M\r")
        running.switch_init(1, on=False)
        running.power_cycle()
        later = asked(running, b"$01M\r")

    assert named == (b"!007018\r", b"!027017\r")
    assert later == b"!017018\r"
    assert [(it.address, it.model, it.what) for it in changes] == [
        (1, Model.I_7018, ("INIT switch on",)),
        (1, Model.I_7018, ("power cycle in INIT mode",)),
        (1, Model.I_7018, ("INIT switch off",)),
        (1, Model.I_7018, ("power cycle",)),
        (2, Model.I_7017, ("power cycle",)),
    ]


def test_traffic_is_observed() -> None:
    seen: list[Observed] = []
    with simulate(Model.I_7018, observe=seen.append) as running:
        asked(running, b"$01M\r")

    assert [(it.heard, it.answer) for it in seen] == [(b"$01M\r", b"!017018\r")]


def test_what_the_simulator_raises_is_raised_in_the_caller() -> None:
    def fail(_: object) -> None:
        raise ZeroDivisionError

    with simulate(Model.I_7018) as running, pytest.raises(ZeroDivisionError):
        running.call(fail)


@pytest.mark.parametrize(
    ("refused", "said"),
    [
        (lambda it: it.power_cycle(2), "address cannot be 2: that of a module: 01h"),
        (lambda it: it.switch_init(0, on=True), "address cannot be 0: that of a module: 01h"),
        (lambda it: it.connect(8, None), "channel cannot be 8: 0..7 or cold_junction"),
        (lambda it: it.connect("cjc", None), "channel cannot be 'cjc': 0..7 or cold_junction"),
        (lambda it: it.connect(COLD_JUNCTION, None), "cold_junction cannot be"),
    ],
)
def test_what_is_not_there_is_refused(refused: Any, said: str) -> None:
    with simulate(Model.I_7018) as running, pytest.raises(InvalidValueError, match=said):
        refused(running)


def test_an_unknown_transport_is_refused() -> None:
    with pytest.raises(InvalidValueError, match="over cannot be 'usb'"), simulate(Model.I_7018, over="usb"):  # type: ignore[arg-type]
        pass


def test_without_pseudo_terminals_it_is_rfc_2217(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "i7000.simulator.pseudo_terminal", None)

    with simulate(Model.I_7018) as running:
        assert running.startswith("rfc2217://")
    with pytest.raises(InvalidValueError, match="socket or rfc2217 on this system"), simulate(over="pty"):
        pass


def test_a_port_that_cannot_be_opened_leaves_no_thread(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> Any:
        raise OSError("no port")

    monkeypatch.setattr("i7000.simulator.threaded.listen", refuse)

    with pytest.raises(OSError, match="no port"), simulate(Model.I_7018, over="socket"):
        pass
    assert "i7000 simulator" not in {thread.name for thread in threading.enumerate()}


def test_it_runs_beside_an_event_loop_of_the_caller() -> None:
    async def converse() -> bytes:
        with simulate(Model.I_7018) as running:
            return await asyncio.to_thread(asked, running, b"$01M\r")

    assert asyncio.run(converse()) == b"!017018\r"


# --- public names -----------------------------------------------------------------------------------------------------


def test_every_public_name_is_there() -> None:
    assert all(getattr(public, name) is not None for name in public.__all__)
    assert set(public.__all__) <= set(dir(public))


def test_another_name_is_not() -> None:
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        getattr(public, "nothing")  # noqa: B009 - a type checker knows that it is not there


def test_importing_the_package_imports_no_network() -> None:
    script = "import sys, i7000.simulator; print(sorted({'asyncio', 'socket', 'serial', 'cattrs'} & set(sys.modules)))"

    found = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)  # noqa: S603

    assert found.stdout == "[]\n"
