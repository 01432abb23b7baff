"""The example drivers against a module that answers on a pseudo-terminal."""

import asyncio
import os
import pty
import runpy
import select
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from threading import Thread
from time import sleep
from types import ModuleType
from typing import Any

import pytest
import serial
from attrs import evolve

from i7000 import Model, Profile, TypeCode, dcon, modbus
from i7000.examples import async_driver, sync_driver
from i7000.host import Answered, AnyCommand, Bus, Declined, Outcome, Policy, Sent, TimedOut

PROFILE = Profile(Model.M_7019R, type_codes=(TypeCode.K,) * 8)
SEALED = evolve(PROFILE, checksum=True)
LINE = "+0025.1+0026.4       +9999.9+0020.0+0020.1+0020.2+0020.3"
INPUTS = dcon.ReadAnalogInputs(0x01)
WORDS = modbus.ReadInputRegisters(0x01, 0, 8)
POLICY = Policy(retries=1, turnaround=0.2, grace=0.1)

Answer = Callable[[bytes], list[bytes]]
"""What a module says to what it hears, in pieces."""


class Module(Thread):
    """A module at the far end of a pseudo-terminal."""

    def __init__(self) -> None:
        super().__init__(daemon=True)
        self.end, self.near = pty.openpty()
        self.path = os.ttyname(self.near)
        self.answers: dict[bytes, list[bytes]] = {}
        """To each request its answers, one for each time, the last of them for ever."""
        self.delays: dict[bytes, float] = {}
        """Seconds that a request takes."""
        self.heard: list[bytes] = []
        self.closing, self.close = os.pipe()

    def run(self) -> None:
        while self.closing not in select.select([self.end, self.closing], [], [])[0]:
            wire = os.read(self.end, 1000)
            self.heard.append(wire)
            sleep(self.delays.get(wire, 0.0))
            answers = self.answers.get(wire, [])
            for byte in answers.pop(0) if len(answers) > 1 else b"".join(answers):
                os.write(self.end, bytes((byte,)))

    def says(self, command: AnyCommand, *answers: bytes, profile: Profile = PROFILE) -> None:
        wire = modbus.encode(command) if isinstance(command, modbus.Request) else dcon.encode(command, profile)
        self.answers[wire] = list(answers)


@pytest.fixture
def module() -> Iterator[Module]:
    module = Module()
    module.start()
    yield module
    os.write(module.close, b"\0")
    module.join()
    for descriptor in (module.end, module.near, module.closing, module.close):
        os.close(descriptor)


def ask_and_wait(path: str, *commands: Any, profile: Profile = PROFILE, policy: Policy = POLICY) -> list[Outcome[Any]]:
    with serial.Serial(path) as port:
        driver = sync_driver.Driver(port, Bus[Any](policy=policy))
        return [driver.ask(command, profile) for command in commands]


def ask_at_once(path: str, *commands: Any, profile: Profile = PROFILE, policy: Policy = POLICY) -> list[Outcome[Any]]:
    async def ask() -> list[Outcome[Any]]:
        with serial.Serial(path) as port:
            driver = async_driver.Driver(port, Bus[Any](policy=policy))
            return await asyncio.gather(*(driver.ask(command, profile) for command in commands))

    return asyncio.run(ask())


either = pytest.mark.parametrize("ask", [ask_and_wait, ask_at_once])
either_main = pytest.mark.parametrize("main", [sync_driver.main, async_driver.main])


@either
def test_requests_of_both_protocols_are_answered(module: Module, ask: Callable[..., list[Outcome[Any]]]) -> None:
    registers = modbus.InputRegisters(0x01, (1, 2, 3, 4, 5, 6, 7, 8))
    module.says(INPUTS, f">{LINE}\r".encode())
    module.says(WORDS, modbus.encode(registers))
    module.says(dcon.ReadChannelMask(0x01), b"?01\r")

    outcomes = ask(module.path, INPUTS, WORDS, dcon.ReadChannelMask(0x01), dcon.HostOk(), INPUTS)

    inputs = Answered(INPUTS, dcon.AnalogInputs(tuple(LINE[at : at + 7] for at in range(0, 56, 7))))
    refused = Declined(dcon.ReadChannelMask(0x01), dcon.Refused(0x01))
    assert [inputs, Answered(WORDS, registers), refused, Sent(dcon.HostOk()), inputs] == outcomes


@either
def test_a_module_that_is_not_there_costs_time_and_nothing_else(
    module: Module, ask: Callable[..., list[Outcome[Any]]]
) -> None:
    module.says(dcon.ReadChannelMask(0x01), b"!01FF\r")

    outcomes = ask(module.path, INPUTS, dcon.ReadChannelMask(0x01))

    assert [TimedOut(INPUTS), Answered(dcon.ReadChannelMask(0x01), dcon.ChannelMask(0x01, 0xFF))] == outcomes
    assert module.heard == [b"#01\r", b"#01\r", b"$016\r"]


@either
@pytest.mark.parametrize("first", [b"", b"!01FF00\r", b"\xff!01F", b"!02FF3A\r"])
def test_a_request_is_repeated_when_the_answer_is_lost_or_damaged(
    module: Module, ask: Callable[..., list[Outcome[Any]]], first: bytes
) -> None:
    command = dcon.ReadChannelMask(0x01)
    module.says(command, first, dcon.seal(b"!01FF", checksum=True), profile=SEALED)

    outcomes = ask(module.path, command, profile=SEALED)

    assert [Answered(command, dcon.ChannelMask(0x01, 0xFF))] == outcomes
    assert module.heard == [b"$016BB\r"] * 2


@either
def test_a_late_response_is_not_the_answer_to_the_next_request(
    module: Module, ask: Callable[..., list[Outcome[Any]]]
) -> None:
    other = dcon.ReadAnalogInputs(0x02)
    module.says(INPUTS, b">" + b"+0011.1" * 8 + b"\r")
    module.says(other, b">" + b"+0022.2" * 8 + b"\r")
    module.delays[b"#01\r"] = 0.3

    outcomes = ask(module.path, INPUTS, other, policy=Policy(retries=0, turnaround=0.1, grace=1.0))

    assert [TimedOut(INPUTS), Answered(other, dcon.AnalogInputs(("+0022.2",) * 8))] == outcomes


@either
def test_what_came_before_a_request_is_not_its_answer(
    module: Module, ask: Callable[..., list[Outcome[Any]]], monkeypatch: pytest.MonkeyPatch
) -> None:
    class Port(serial.Serial):
        """A port in which an answer lies that nobody has asked for."""

        def open(self) -> None:
            super().open()
            os.write(module.end, b"!0100\r")
            select.select([self], [], [])

    monkeypatch.setattr(serial, "Serial", Port)
    module.says(dcon.ReadChannelMask(0x01), b"!01FF\r")

    outcomes = ask(module.path, dcon.ReadChannelMask(0x01))

    assert [Answered(dcon.ReadChannelMask(0x01), dcon.ChannelMask(0x01, 0xFF))] == outcomes


def test_a_task_that_no_longer_waits_leaves_the_line_to_the_next(module: Module) -> None:
    module.says(dcon.ReadChannelMask(0x01), b"!01FF\r")

    async def give_up_and_ask() -> Outcome[Any]:
        with serial.Serial(module.path) as port:
            driver = async_driver.Driver(port, Bus[Any](policy=POLICY))
            with pytest.raises(asyncio.TimeoutError):
                await asyncio.wait_for(driver.ask(INPUTS, PROFILE), 0.01)
            return await driver.ask(dcon.ReadChannelMask(0x01), PROFILE)

    outcome = asyncio.run(give_up_and_ask())

    assert Answered(dcon.ReadChannelMask(0x01), dcon.ChannelMask(0x01, 0xFF)) == outcome


def test_a_port_that_goes_away_is_told_to_who_waits() -> None:
    async def lose_the_port() -> None:
        far, near = pty.openpty()
        with serial.Serial(os.ttyname(near)) as port:
            driver = async_driver.Driver(port, Bus[Any](policy=POLICY))
            asyncio.get_running_loop().call_later(0.05, os.close, far)
            try:
                await driver.ask(INPUTS, PROFILE)
            finally:
                await asyncio.sleep(0.3)
                os.close(near)

    with pytest.raises(OSError, match=r"."):
        asyncio.run(lose_the_port())


# --- as programs ------------------------------------------------------------------------------------------------------

PRINTED = """\
0 25.1 degC ok
1 26.4 degC ok
2 None degC disabled
3 None degC over_range
4 20.0 degC ok
5 20.1 degC ok
6 20.2 degC ok
7 20.3 degC ok
"""


@either_main
def test_the_programs_print_readings(
    module: Module, main: Callable[[list[str]], int], capsys: pytest.CaptureFixture[str]
) -> None:
    module.says(INPUTS, dcon.seal(f">{LINE}".encode(), checksum=True), profile=SEALED)

    code = main([module.path, "--model", "M-7019R", "--address", "01", "--type", "K", "--checksum"])

    assert (code, capsys.readouterr().out) == (0, PRINTED)


@either_main
def test_the_programs_print_what_else_came_of_it(
    module: Module, main: Callable[[list[str]], int], capsys: pytest.CaptureFixture[str]
) -> None:
    module.says(WORDS, modbus.seal(b"\x01\x84\x02"))

    code = main([module.path, "--model", "M-7019R", "--modbus", "--baud", "115200"])

    assert code == 1
    assert capsys.readouterr().out == (
        "Declined(command=ReadInputRegisters(address=0x01, start=0, count=8), "
        "response=ExceptionResponse(address=0x01, function=4, exception_code=2))\n"
    )


@pytest.mark.parametrize("name", ["i7000.examples.sync_driver", "i7000.examples.async_driver"])
def test_the_programs_can_be_run(
    module: Module, name: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    module.says(WORDS, modbus.encode(modbus.InputRegisters(0x01, (0,) * 8)))
    monkeypatch.setattr(sys, "argv", [name, module.path, "--model", "M-7019R", "--modbus"])
    monkeypatch.delitem(sys.modules, name)

    with pytest.raises(SystemExit) as ended:
        runpy.run_module(name, run_name="__main__")

    assert ended.value.code == 0
    assert capsys.readouterr().out == "".join(f"{channel} 0.0 V ok\n" for channel in range(8))


@pytest.mark.parametrize("driver", [sync_driver, async_driver], ids=lambda driver: driver.__name__)
def test_a_driver_is_short(driver: ModuleType) -> None:
    lines = Path(driver.__file__ or "").read_text(encoding="utf-8").splitlines()

    assert sum(line.strip() != "" for line in lines) < 80
