"""The example drivers against a simulated bus on a pseudo-terminal, with and without faults of the line."""

import asyncio
import os
import pty
import runpy
import sys
from collections.abc import Callable, Iterator, Sequence
from inspect import getsource
from random import Random
from time import sleep
from types import ModuleType
from typing import Any

import pytest
import serial
from attrs import frozen

from i7000 import (
    BaudRate,
    Fault,
    LineSettings,
    Model,
    Noise,
    Profile,
    Protocol,
    ReportSettings,
    TypeCode,
    Unit,
    dcon,
    modbus,
)
from i7000.device import OPEN_WIRE, Signal
from i7000.examples import async_driver, sync_driver
from i7000.examples.task import Task
from i7000.host import Answered, Bus, Declined, Outcome, Policy, Query, Rejected, Sent, TimedOut
from i7000.simulator.faults import Faults
from i7000.simulator.pseudo_terminal import open_pty
from i7000.simulator.sources import Fixed, Sources
from tests.simulator.running import Running, module, running

Request = tuple[Query[Any], Profile]
NO_SUCH_MODULE = dcon.ReadAnalogInputs(0x0F)


def sources(unit: Unit, *values: float | None) -> Sources:
    return Sources(tuple(Fixed(OPEN_WIRE if value is None else Signal(value, unit)) for value in values))


# --- a bus on which no two channels read the same ---------------------------------------------------------------------

SEALED = ReportSettings(checksum=True)
DEGREES = (25.1, 26.4, 0.0, 2000.0, 20.0, 20.1, 20.2, 20.3)
DEGREES_SAID = "+0025.1+0026.4       +9999.9+0020.0+0020.1+0020.2+0020.3"
VOLTS = (1.5, -1.0, 0.25, 2.0, -2.5, 0.125, 2.5, -0.75)
MORE_VOLTS = (9.0, -8.0, 7.0, -6.0, 5.0, -4.0, 3.0, -2.0)

MODULES = (
    module(
        Model.M_7019R,
        sources=sources(Unit.CELSIUS, *DEGREES),
        type_codes=(TypeCode.K,) * 8,
        channel_mask=0xFB,
        report_settings=SEALED,
    ),
    module(Model.I_7018, sources=sources(Unit.VOLT, *VOLTS), address=0x02, report_settings=SEALED),
    module(Model.M_7017, sources=sources(Unit.VOLT, *MORE_VOLTS), address=0x03, protocol=Protocol.MODBUS_RTU),
    module(Model.M_7018, sources=sources(Unit.VOLT, *VOLTS[::-1]), address=0x04, protocol=Protocol.MODBUS_RTU),
)
PROFILE = Profile(Model.M_7019R, type_codes=(TypeCode.K,) * 8, checksum=True)
FIELDS = {
    0x01: tuple(DEGREES_SAID[at : at + 7] for at in range(0, 56, 7)),
    0x02: tuple(f"{value:+07.4f}" for value in VOLTS),
}
WORDS = {
    0x03: tuple(round(value / 10 * (32767 if value > 0 else 32768)) % 65536 for value in MORE_VOLTS),
    0x04: tuple(round(value / 2.5 * (32767 if value > 0 else 32768)) % 65536 for value in VOLTS[::-1]),
}
PROFILES = {
    0x01: PROFILE,
    0x02: Profile(Model.I_7018, checksum=True),
    0x03: Profile(Model.M_7017),
    0x04: Profile(Model.M_7018),
}


def requests(count: int) -> Iterator[Request]:
    """All kinds of readings, of any module and channel."""
    chance = Random(7000)
    for _ in range(count):
        address, channel = chance.choice(sorted(PROFILES)), chance.randrange(8)
        command: Query[Any] = modbus.ReadInputRegisters(address, channel, chance.randint(1, 8 - channel))
        if address in FIELDS:
            command = dcon.ReadAnalogInput(address, channel)
            if chance.random() < 0.2:
                command = dcon.ReadAnalogInputs(address)
        yield command, PROFILES[address]


def truth(command: Any) -> Answered[Any]:
    """The answer that the signals give."""
    match command:
        case dcon.ReadAnalogInputs(address=address):
            return Answered(command, dcon.AnalogInputs(FIELDS[address]))
        case dcon.ReadAnalogInput(address=address, channel=channel):
            return Answered(command, dcon.AnalogInput(FIELDS[address][channel]))
        case _:
            words = WORDS[command.address][command.start : command.start + command.count]
            return Answered(command, modbus.InputRegisters(command.address, words))


# --- the two ways to ask ----------------------------------------------------------------------------------------------


def ask_and_wait(path: str, bus: Bus[Any], asked: Sequence[Request]) -> list[Outcome[Any]]:
    with serial.Serial(path) as port:
        driver: Any = sync_driver.Driver(port, bus)
        return [driver.ask(command, profile) for command, profile in asked]


def ask_at_once(path: str, bus: Bus[Any], asked: Sequence[Request]) -> list[Outcome[Any]]:
    wrong: list[Any] = []

    async def ask() -> list[Outcome[Any]]:
        asyncio.get_running_loop().set_exception_handler(lambda _, context: wrong.append(context))
        with serial.Serial(path) as port:
            driver: Any = async_driver.Driver(port, bus)
            return list(await asyncio.gather(*(driver.ask(command, profile) for command, profile in asked)))

    outcomes: list[Outcome[Any]] = asyncio.run(ask())
    assert wrong == []
    return outcomes


Ask = Callable[[str, Bus[Any], Sequence[Request]], list[Outcome[Any]]]
either = pytest.mark.parametrize("ask", [ask_and_wait, ask_at_once])
FAST = LineSettings(BaudRate.BAUD_115200)
HASTY = Bus[Any](FAST, Policy(retries=1, turnaround=0.1, grace=0.1))


# --- what comes of requests -------------------------------------------------------------------------------------------


@either
def test_what_is_read_is_what_is_on_the_inputs(ask: Ask) -> None:
    asked = list(requests(100))

    with running(open_pty, *MODULES) as here:
        outcomes = ask(here.place, Bus[Any](FAST), asked)

    assert [truth(command) for command, _ in asked] == outcomes


PATIENT = Policy(retries=3, turnaround=0.1, grace=0.05)


@frozen
class Case:
    """How a line fails, and what a host has to allow for."""

    faults: Faults
    policy: Policy = PATIENT
    echo: bool = False
    """Whether the host expects to hear itself."""
    count: int = 100
    """How many requests it makes: fewer where they take long."""


CASES = {
    "echo": Case(Faults(echo=True), echo=True, count=300),
    "echo that is not expected": Case(Faults(echo=True), count=300),
    "lumps": Case(Faults(lumps=True), count=60),
    "drop": Case(Faults(drop=0.002)),
    "flip": Case(Faults(flip=0.002)),
    "noise": Case(Faults(noise=0.3), count=300),
    "late": Case(Faults(late=0.1, late_by=0.1), Policy(retries=3, turnaround=0.03, grace=0.2), count=60),
}


@either
@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_whatever_the_line_does_nothing_wrong_is_read(ask: Ask, case: Case) -> None:
    asked = list(requests(case.count))

    with running(open_pty, *MODULES, faults=case.faults, seed=7) as here:
        outcomes = ask(here.place, Bus[Any](FAST, case.policy, echo=case.echo), asked)
        faults = [it.faults for it in here.observed if it.faults]

    answered = [outcome for outcome in outcomes if isinstance(outcome, Answered)]
    assert [command for command, _ in asked] == [outcome.command for outcome in outcomes]
    assert [truth(outcome.command) for outcome in answered] == answered
    assert len(answered) >= 0.97 * case.count
    assert len(faults) > 3 or case.faults == Faults(echo=True)


@either
def test_each_request_has_the_outcome_that_is_its_own(ask: Ask) -> None:
    asked: list[Request] = [
        (dcon.ReadChannelMask(0x01), PROFILE),
        (dcon.SetChannelMask(0x01, 0x0F), PROFILE),
        (dcon.CalibrateSpan(0x02), PROFILES[0x02]),
        (NO_SUCH_MODULE, PROFILE),
        (dcon.HostOk(), PROFILE),
        (modbus.ReadInputRegisters(0x03, 8, 1), PROFILES[0x03]),
        (dcon.ReadChannelMask(0x01), PROFILE),
    ]

    with running(open_pty, *MODULES) as here:
        outcomes = ask(here.place, HASTY, asked)
        heard = [it.heard for it in here.observed]

    commands: list[Any] = [command for command, _ in asked]
    assert outcomes == [
        Answered(commands[0], dcon.ChannelMask(0x01, 0xFB)),
        Answered(commands[1], dcon.Acknowledged(0x01)),
        Declined(commands[2], dcon.Refused(0x02)),
        TimedOut(commands[3]),
        Sent(commands[4]),
        Declined(commands[5], modbus.ExceptionResponse(0x03, 0x04, modbus.ExceptionCode.ILLEGAL_DATA_ADDRESS)),
        Answered(commands[6], dcon.ChannelMask(0x01, 0x0F)),
    ]
    assert heard.count(b"#0F99\r") == 2


@either
def test_a_late_response_is_not_the_answer_to_the_next_request(ask: Ask) -> None:
    policy = Policy(retries=0, turnaround=0.05, grace=0.3)
    first, second = dcon.ReadAnalogInput(0x01, 0), dcon.ReadAnalogInput(0x01, 1)

    with running(open_pty, *MODULES, faults=Faults(late=1.0, late_by=0.1)) as here:
        late_once(here)
        outcomes = ask(here.place, Bus[Any](FAST, policy), [(first, PROFILE), (second, PROFILE)])

    assert [TimedOut(first), truth(second)] == outcomes


def late_once(here: Running) -> None:
    """Switch the faults off after the first late response."""

    def observe(observed: Any) -> None:
        here.simulator.faults = Faults()
        here.observed.append(observed)

    here.call(lambda: setattr(here.simulator, "observe", observe))


@either
def test_what_came_before_a_request_is_not_its_answer(ask: Ask, monkeypatch: pytest.MonkeyPatch) -> None:
    class Port(serial.Serial):
        """A port in which an answer lies that nobody has asked for."""

        def open(self) -> None:
            super().open()
            self.write(b"#010B4\r")
            while self.in_waiting < len(">+0025.1CC\r"):
                sleep(0.001)

    monkeypatch.setattr(serial, "Serial", Port)
    command = dcon.ReadAnalogInput(0x01, 1)

    with running(open_pty, *MODULES) as here:
        assert [truth(command)] == ask(here.place, HASTY, [(command, PROFILE)])


def test_a_task_that_no_longer_waits_leaves_the_line_to_the_next() -> None:
    command = dcon.ReadAnalogInput(0x01, 0)

    async def give_up_and_ask(path: str) -> Outcome[Any]:
        with serial.Serial(path) as port:
            driver = async_driver.Driver(port, HASTY)
            with pytest.raises(asyncio.TimeoutError):
                await asyncio.wait_for(driver.ask(NO_SUCH_MODULE, PROFILE), 0.01)
            return await driver.ask(command, PROFILE)

    with running(open_pty, *MODULES) as here:
        assert truth(command) == asyncio.run(give_up_and_ask(here.place))


def test_a_lost_port_raises_in_the_waiting_task() -> None:
    async def lose_the_port() -> None:
        far, near = pty.openpty()
        with serial.Serial(os.ttyname(near)) as port:
            driver = async_driver.Driver(port, HASTY)
            asyncio.get_running_loop().call_later(0.05, os.close, far)
            try:
                await driver.ask(NO_SUCH_MODULE, PROFILE)
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
DECLINED = (
    "Declined(command=ReadInputRegisters(address=0x03, start=0, count=10), "
    "response=ExceptionResponse(address=0x03, function=4, exception_code=3))\n"
)


@pytest.mark.parametrize("main", [sync_driver.main, async_driver.main])
def test_the_programs_print_readings_or_what_else_came_of_it(
    main: Callable[[list[str]], int], capsys: pytest.CaptureFixture[str]
) -> None:
    with running(open_pty, *MODULES) as here:
        read = main([here.place, "--model", "M-7019R", "--address", "01", "--type", "K", "--checksum"])
        printed = capsys.readouterr().out
        declined = main([here.place, "--model", "M-7019Z", "--address", "03", "--modbus", "--baud", "115200"])

    assert (read, printed) == (0, PRINTED)
    assert (declined, capsys.readouterr().out) == (1, DECLINED)


def test_readings_of_another_type_than_the_given_one_are_not_printed_as_values(
    capsys: pytest.CaptureFixture[str],
) -> None:
    with running(open_pty, *MODULES) as here:
        code = sync_driver.main([here.place, "--model", "M-7019R", "--address", "01", "--type", "V_10", "--checksum"])

    assert code == 1
    assert "number in the value of channel 0 at byte 0 of +0025.1;" in capsys.readouterr().out


@pytest.mark.parametrize("name", ["i7000.examples.sync_driver", "i7000.examples.async_driver"])
def test_the_programs_can_be_run(
    name: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with running(open_pty, *MODULES, faults=Faults(echo=True)) as here:
        arguments = [here.place, "--model", "M-7018", "--address", "04", "--modbus", "--echo"]
        monkeypatch.setattr(sys, "argv", [name, *arguments])
        monkeypatch.delitem(sys.modules, name)
        with pytest.raises(SystemExit) as ended:
            runpy.run_module(name, run_name="__main__")

    columns = zip(*(line.split() for line in capsys.readouterr().out.splitlines()), strict=True)
    channels, values, units, statuses = map(list, columns)
    assert ended.value.code == 0
    assert (channels, units, statuses) == (list("01234567"), ["V"] * 8, ["ok"] * 8)
    assert pytest.approx(VOLTS[::-1], abs=1e-4) == [float(value) for value in values]


@pytest.mark.parametrize("wrong", [["--type", "Q"], ["--baud", "9601"], ["--address", "G"], ["--model", "I-7020"]])
def test_wrong_arguments_end_a_program_with_what_is_wrong(wrong: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        sync_driver.main(["/dev/null", "--model", "M-7019R", *wrong])

    assert ended.value.code == 2
    assert f"argument {wrong[0]}: invalid" in capsys.readouterr().err


@pytest.mark.parametrize("main", [sync_driver.main, async_driver.main])
@pytest.mark.parametrize("port", ["/no/such/port", "/dev/null", "gopher://127.0.0.1"])
def test_a_port_that_cannot_be_opened_ends_a_program_with_the_reason(
    main: Callable[[list[str]], int], port: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        main([port, "--model", "M-7019R"])

    assert ended.value.code == 2
    assert capsys.readouterr().err.startswith(f"{port}: ")


@pytest.mark.parametrize("driver", [sync_driver, async_driver], ids=lambda driver: driver.__name__)
def test_a_driver_is_short(driver: ModuleType) -> None:
    lines = getsource(driver.Driver).splitlines()

    assert len(lines) < 60


@pytest.mark.parametrize(
    ("rejected", "text"),
    [
        (None, ""),
        (Rejected(b"?01\r", Fault.LENGTH, "57 characters"), "last rejected frame: b'?01\\r': 57 characters\n"),
        (Noise(b"\xff", Fault.LEADING), "last rejected frame: b'\\xff': leading\n"),
    ],
    ids=["nothing", "a frame", "noise"],
)
def test_what_was_rejected_is_printed_beside_a_timeout(
    rejected: Rejected | Noise | None, text: str, capsys: pytest.CaptureFixture[str]
) -> None:
    command = dcon.ReadAnalogInputs(0x01)
    task = Task("", Bus[Any](FAST), PROFILE, command)

    assert task.show(TimedOut(command), rejected) == 1
    assert capsys.readouterr().out == f"{TimedOut(command)}\n{text}"
