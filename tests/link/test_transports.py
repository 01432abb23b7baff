"""Both lines on real ports with a simulator behind them; ports that disappear; Ctrl-C."""

import asyncio
import os
import pty
import signal
import subprocess
import sys
from threading import Thread
from typing import Any

import pytest
import serial

from i7000 import dcon, modbus
from i7000.host import Answered, Outcome, Policy
from i7000.link import AsyncLine, Line, LinkError, open_target
from i7000.message import Response
from i7000.simulator.faults import Faults
from tests import simulation
from tests.link.scene import FAST, MODULES, NO_SUCH_MODULE, PROFILE, PROFILES, requests, truth
from tests.simulator.running import RFC_2217, TRANSPORTS, running
from tests.waiting import ENOUGH

PATIENT = Policy(retries=2, turnaround=1.0, grace=0.2)
READ = dcon.ReadAnalogInput(0x01, 0)


def target(transport: str, place: str) -> str:
    return place if transport == "pty" else f"{transport}://{place}"


@pytest.mark.parametrize("transport", TRANSPORTS)
def test_what_is_read_is_what_is_on_the_inputs(transport: str) -> None:
    asked = list(requests(20))

    with (
        running(TRANSPORTS[transport], *MODULES) as here,
        Line.open(target(transport, here.place), FAST, PATIENT) as line,
    ):
        assert [line.ask(command, profile) for command, profile in asked] == [truth(command) for command, _ in asked]


@pytest.mark.parametrize("transport", TRANSPORTS)
def test_what_tasks_read_is_what_is_on_the_inputs(transport: str) -> None:
    asked = list(requests(20))

    async def gathered(place: str) -> list[Outcome[Response]]:
        async with await AsyncLine.open(target(transport, place), FAST, PATIENT) as line:
            return list(await asyncio.gather(*(line.ask(command, profile) for command, profile in asked)))

    with running(TRANSPORTS[transport], *MODULES) as here:
        assert asyncio.run(gathered(here.place)) == [truth(command) for command, _ in asked]


@pytest.mark.parametrize("transport", TRANSPORTS)
def test_nothing_wrong_is_read_from_a_line_with_faults(transport: str) -> None:
    asked = list(requests(30))
    faults = Faults(lumps=True, drop=0.002, flip=0.002, noise=0.2, late=0.05, late_by=0.1)

    with (
        running(TRANSPORTS[transport], *MODULES, faults=faults, seed=7) as here,
        Line.open(target(transport, here.place), FAST, Policy(turnaround=0.15, grace=0.15)) as line,
    ):
        outcomes = [line.ask(command, profile) for command, profile in asked]

    answered = [outcome for outcome in outcomes if isinstance(outcome, Answered)]
    assert answered == [truth(outcome.command) for outcome in answered]
    assert len(answered) > 20


def test_a_wrong_baud_rate_over_rfc_2217_is_no_answer_and_the_line_can_be_tuned() -> None:
    with running(RFC_2217, *MODULES) as here, Line.open(f"rfc2217://{here.place}", policy=PATIENT) as line:
        hasty = Policy(retries=0, turnaround=0.2, grace=0.1)
        assert not isinstance(line.ask(READ, PROFILE, hasty), Answered)
        line.tune(FAST)
        assert line.ask(READ, PROFILE) == truth(READ)


def test_a_simulator_in_its_own_process_is_asked_on_its_pseudo_terminal() -> None:
    kelvin, volts = ("--model", "M-7019R,type=K,protocol=dcon,checksum=true"), ("--model", "M-7017,type=V_10")
    arguments = (*kelvin, *volts, "--signal", "01:all=25.1degC", "--signal", "02:all=-5V")
    with simulation.process(*arguments, stdout=subprocess.PIPE, text=True) as started:
        assert started.stdout
        path = started.stdout.readline().strip()
        with Line.open(path, policy=PATIENT) as line:
            assert line.ask(READ, PROFILE) == truth(READ)
            inputs = modbus.ReadInputRegisters(0x02, 0, 2)
            assert line.ask(inputs, PROFILES[0x03]) == Answered(inputs, modbus.InputRegisters(0x02, (0xC000, 0xC000)))


# --- ports that disappear ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("transport", ["socket", "rfc2217"])
def test_a_simulator_that_ends_is_one_error(transport: str) -> None:
    with running(TRANSPORTS[transport], *MODULES) as here:
        line = Line.open(target(transport, here.place), FAST, PATIENT)
        assert line.ask(READ, PROFILE) == truth(READ)

    with line:
        for _ in range(2):
            with pytest.raises(LinkError, match=f"{transport}://.*: the port is (lost|closed)"):
                line.ask(READ, PROFILE)


class PseudoTerminal:
    """A pseudo-terminal that the test can hang up."""

    def __init__(self) -> None:
        self.far, self.near = pty.openpty()
        self.path = os.ttyname(self.near)

    def hang_up(self) -> None:
        os.close(self.far)
        os.close(self.near)


def test_a_terminal_that_hangs_up_during_a_request_is_one_error() -> None:
    terminal = PseudoTerminal()
    with Line.open(terminal.path, policy=PATIENT) as line:

        def hang_up() -> None:
            os.read(terminal.far, 100)
            terminal.hang_up()

        thread = Thread(target=hang_up)
        thread.start()
        for _ in range(2):
            with pytest.raises(LinkError, match=f"{terminal.path}: the port is lost"):
                line.ask(NO_SUCH_MODULE, PROFILE)
        thread.join()


def test_a_terminal_that_hangs_up_is_one_error_for_every_task() -> None:
    terminal = PseudoTerminal()

    async def asked() -> list[Any]:
        async with await AsyncLine.open(terminal.path, policy=PATIENT) as line:
            tasks = [asyncio.create_task(line.ask(NO_SUCH_MODULE, PROFILE)) for _ in range(3)]
            await asyncio.to_thread(os.read, terminal.far, 100)
            terminal.hang_up()
            return list(await asyncio.gather(*tasks, return_exceptions=True))

    errors = asyncio.run(asked())

    assert {type(error) for error in errors} == {LinkError}
    assert len({str(error) for error in errors}) == 1


def test_a_port_that_another_thread_closes_during_a_request_is_one_error() -> None:
    terminal = PseudoTerminal()
    port: Any = open_target(terminal.path)
    with Line(port, policy=Policy(retries=5, turnaround=0.1, grace=0.0)) as line:

        def close() -> None:
            os.read(terminal.far, 100)
            port.close()

        thread = Thread(target=close)
        thread.start()
        with pytest.raises(LinkError, match=f"{terminal.path}: the port is (closed|lost)"):
            line.ask(NO_SUCH_MODULE, PROFILE)
        thread.join()
    terminal.hang_up()


def test_a_port_of_the_user_keeps_its_class() -> None:
    terminal = PseudoTerminal()
    with serial.Serial(terminal.path) as port:
        line = Line(port, FAST)

        assert (line.port, port.baudrate) == (port, 115200)
    terminal.hang_up()


# --- Ctrl-C -----------------------------------------------------------------------------------------------------------

INTERRUPTED = """
import sys
from i7000 import dcon, modbus
from i7000.host import Policy
from i7000.link import Line
from tests.link.scene import FAST, NO_SUCH_MODULE, PROFILE, truth

READ = dcon.ReadAnalogInput(0x01, 0)
with Line.open(sys.argv[1], FAST, Policy(retries=0, turnaround=3600.0, grace=0.1)) as line:
    print("asking", flush=True)
    try:
        line.ask(NO_SUCH_MODULE, PROFILE)
    except KeyboardInterrupt:
        pass
    line._conversation.bus = type(line._conversation.bus)(FAST)  # the silence after that is an hour
    print(line.ask(READ, PROFILE, Policy(turnaround=60.0)) == truth(READ))
"""


@pytest.mark.skipif(not hasattr(signal, "SIGINT"), reason="no Ctrl-C")
def test_ctrl_c_ends_a_request_and_the_line_can_be_used() -> None:
    with (
        running(TRANSPORTS["pty"], *MODULES) as here,
        subprocess.Popen(  # noqa: S603 - ourselves
            [sys.executable, "-c", INTERRUPTED, here.place], stdout=subprocess.PIPE, text=True
        ) as started,
    ):
        assert started.stdout is not None
        assert started.stdout.readline() == "asking\n"
        while not here.observed:
            asyncio.run(asyncio.sleep(0.01))
        started.send_signal(signal.SIGINT)

        assert started.communicate(timeout=ENOUGH)[0] == "True\n"
