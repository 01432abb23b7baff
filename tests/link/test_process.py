"""The port of ``exec:``: a process that plays a module, and processes that do not."""

import asyncio
import shlex
import sys
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path

import pytest
import serial

from i7000 import Model, Profile, dcon
from i7000.host import Answered, Outcome, Policy
from i7000.link import AsyncLine, Line, LinkError, ProcessPort, open_target
from i7000.link.process import BUFFER
from i7000.message import Response
from tests.waiting import ENOUGH, until

PROFILE = Profile(Model.I_7018)
PLAYED = [sys.executable, str(Path(__file__).with_name("played.py"))]
READ = dcon.ReadAnalogInput(0x01, 0)
ANSWERED = Answered(READ, dcon.AnalogInput("+1.5000"))
PATIENT = Policy(retries=0, turnaround=ENOUGH)


def script(text: str) -> ProcessPort:
    return ProcessPort([sys.executable, "-c", text], timeout=ENOUGH)


@pytest.fixture
def played() -> Iterator[ProcessPort]:
    """A process that plays a module with address 05."""
    with closing(ProcessPort([*PLAYED, "05"], timeout=ENOUGH)) as port:
        yield port


def said(port: ProcessPort, command: bytes) -> bytes:
    port.write(command)
    return port.read_until(b"\r")


def test_a_line_asks_a_process() -> None:
    with Line.open(f"exec:{shlex.join(PLAYED)}", policy=PATIENT) as line:
        assert line.ask(READ, PROFILE) == ANSWERED


def test_an_asynchronous_line_asks_a_process() -> None:
    async def asked() -> Outcome[Response]:
        async with await AsyncLine.open(f"exec:{shlex.join(PLAYED)}", policy=PATIENT) as line:
            return await line.ask(READ, PROFILE)

    assert asyncio.run(asked()) == ANSWERED


def test_a_power_cycle_starts_the_process_again_with_the_init_switch_as_it_is_then(played: ProcessPort) -> None:
    assert said(played, b"$052\r") == b"!05050600\r"

    played.init_switch = True
    played.power_cycle()
    assert said(played, b"$002\r") == b"!05050600\r"

    played.init_switch = False
    played.power_cycle()
    assert said(played, b"$052\r") == b"!05050600\r"


def test_closing_ends_the_process(played: ProcessPort) -> None:
    running = played._running  # noqa: SLF001
    played.close()
    played.close()

    assert running.process.returncode is not None
    assert not any(thread.is_alive() for thread in running.threads)


def test_closing_ends_the_children_of_the_process() -> None:
    port = script("import subprocess, sys; subprocess.run([sys.executable, '-c', 'print(1, flush=True); input()'])")
    assert port.read(1) == b"1"
    threads = port._running.threads  # noqa: SLF001
    port.close()

    assert not any(thread.is_alive() for thread in threads)


def test_a_process_that_ends_is_one_error_after_its_last_bytes() -> None:
    with closing(script("print(end='>+1.5000')")) as port:
        assert port.read(100) == b">+1.5000"
        with pytest.raises(LinkError, match="the process has ended"):
            port.read(1)
        assert port.read(0) == b""


def test_a_line_to_a_process_that_ends_is_closed_with_one_error() -> None:
    with Line(script(""), policy=PATIENT) as line, pytest.raises(LinkError, match="the process has ended"):
        line.ask(READ, PROFILE)


def test_a_process_that_does_not_read_holds_up_nothing() -> None:
    with closing(script("import time; print(1, flush=True); time.sleep(1000)")) as port:
        assert port.read(1) == b"1"
        for _ in range(2000):
            assert port.write(bytes(1000)) == 1000
        port.flush()


def test_a_process_that_writes_more_than_the_host_reads_is_not_held_up() -> None:
    with closing(script(f"import sys; sys.stdout.buffer.write(bytes({3 * BUFFER}))")) as port:
        until(lambda: port._running.process.poll() == 0)  # noqa: SLF001
        until(lambda: port.in_waiting == BUFFER)
        port.reset_input_buffer()

        assert port.in_waiting == 0


def test_a_process_that_is_silent_times_out() -> None:
    with closing(script("input()")) as port:
        port.timeout = 0.01

        assert port.read(1) == b""


def test_standard_error_is_that_of_this_program(capfd: pytest.CaptureFixture[str]) -> None:
    with closing(script("import sys; print('reset', file=sys.stderr, flush=True); print(1)")) as port:
        port.read(1)

    assert capfd.readouterr().err == "reset\n"


def test_a_closed_port_raises_as_one_of_pyserial_does() -> None:
    port = script("")
    port.close()
    uses: list[Callable[[], object]] = [
        port.read, port.power_cycle, port.reset_input_buffer, lambda: port.write(b""), lambda: port.in_waiting,
    ]  # fmt: skip

    for use in uses:
        with pytest.raises(serial.PortNotOpenError):
            use()


def test_settings_of_a_serial_port_have_no_effect(played: ProcessPort) -> None:
    played.baudrate, played.parity, played.rts = 1200, "E", False

    assert said(played, b"$052\r") == b"!05050600\r"


def test_a_program_that_is_gone_after_a_power_cycle_is_an_error_and_closes_the_port(tmp_path: Path) -> None:
    program = tmp_path / "module"
    program.write_text(f"#!{sys.executable}\ninput()\n")
    program.chmod(0o755)
    port = open_target(f"exec:{program}")
    assert isinstance(port, ProcessPort)
    program.unlink()

    with pytest.raises(LinkError, match=r"module: No such file or directory"):
        port.power_cycle()
    assert not port.is_open
