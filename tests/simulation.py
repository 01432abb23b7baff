"""``i7000 simulate`` in the process of a test or in one of its own, and hosts that talk to it."""

import socket
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from queue import Queue
from threading import Thread
from time import monotonic, sleep
from typing import Any

import pytest
import serial

from i7000.simulator.simulator import Simulator
from tests.terminal import Run, Told
from tests.waiting import ENOUGH

MAIN = "import sys; from i7000.cli import main; sys.exit(main())"
KELVIN = "M-7019R@B3.7,type=K,protocol=dcon"
INPUTS = ("--signal", "all=25.1degC")
SAID = b">" + b"+0025.1" * 8 + b"\r"


def free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as server:
        port: int = server.getsockname()[1]
        return port


def talk(url: str, *frames: bytes) -> list[bytes]:
    """Send DCON frames as soon as the simulator listens, and return the responses."""
    deadline = monotonic() + ENOUGH
    while True:
        try:
            opened: Any = serial.serial_for_url(url, timeout=ENOUGH)
            break
        except serial.SerialException:
            assert monotonic() < deadline
            sleep(0.02)
    with opened:
        answers = []
        for frame in frames:
            opened.write(frame)
            answers.append(opened.read_until(b"\r"))
        return answers


def unanswered(port: int, frame: bytes) -> bytes:
    """Send a DCON frame, and return the bytes until the simulator closes the connection: normally none."""
    with socket.create_connection(("127.0.0.1", port), timeout=ENOUGH) as opened:
        opened.sendall(frame)
        return opened.recv(100)


def simulated(run: Run, *arguments: str, meanwhile: Callable[[], object] = lambda: None) -> Told:
    """Call the command, and end the simulation when it has begun and something has been done meanwhile."""
    begun: Queue[Simulator] = Queue()

    class Begun(Simulator):
        async def run(self) -> None:
            begun.put(self)
            await super().run()

    def do() -> None:
        simulator = begun.get(timeout=ENOUGH)
        try:
            meanwhile()
        finally:
            simulator.loop.call_soon_threadsafe(simulator.end)

    doing = Thread(target=do)
    doing.start()
    try:
        with pytest.MonkeyPatch.context() as patched:
            patched.setattr("i7000.cli.simulation.Simulator", Begun)
            return run("simulate", *arguments)
    finally:
        doing.join()


@contextmanager
def process(*arguments: str, main: str = MAIN, **others: Any) -> Iterator["subprocess.Popen[Any]"]:
    """A process that simulates, until the test is done with it."""
    command = [sys.executable, "-c", main, "simulate", *arguments]
    with subprocess.Popen(command, **others) as started:  # noqa: S603 - ourselves
        try:
            yield started
        finally:
            started.kill()
