"""Slaves that are not of this package: on pymodbus, and in C on libmodbus (``slave.c``)."""

import asyncio
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Thread
from typing import Any

from pymodbus import FramerType
from pymodbus.server import ModbusTcpServer
from pymodbus.simulator import SimDevice

from tests.interop import not_installed, program
from tests.simulation import free_port
from tests.waiting import ENOUGH

SOURCE = Path(__file__).with_name("slave.c")


@contextmanager
def pymodbus_server(device: SimDevice) -> Iterator[str]:
    """A server of pymodbus with one device, by RTU frames over TCP: the URL of its port."""
    port, started = free_port(), asyncio.new_event_loop()

    async def serve() -> ModbusTcpServer:
        served = ModbusTcpServer(device, framer=FramerType.RTU, address=("127.0.0.1", port))
        await served.serve_forever(background=True)
        return served

    thread = Thread(target=started.run_forever)
    thread.start()
    try:
        served: Any = asyncio.run_coroutine_threadsafe(serve(), started).result(ENOUGH)
        yield f"socket://127.0.0.1:{port}"
        asyncio.run_coroutine_threadsafe(served.shutdown(), started).result(ENOUGH)
    finally:
        started.call_soon_threadsafe(started.stop)
        thread.join(ENOUGH)
        started.close()


@contextmanager
def libmodbus_slave(folder: Path) -> Iterator[str]:
    """A slave on libmodbus, compiled in a folder: the name of its pseudo-terminal."""
    compiler, slave = program("gcc"), folder / "slave"
    header = [compiler, "-E", "-include", "modbus/modbus.h", "-x", "c", "/dev/null"]
    if subprocess.run(header, capture_output=True, check=False, timeout=ENOUGH).returncode:  # noqa: S603 - gcc
        not_installed("libmodbus-dev")
    build = [compiler, "-Wall", "-Wextra", "-Werror", "-o", str(slave), str(SOURCE), "-lmodbus"]
    subprocess.run(build, check=True, timeout=ENOUGH)  # noqa: S603 - gcc
    with subprocess.Popen([slave], stdout=subprocess.PIPE, text=True) as started:  # noqa: S603 - just compiled
        assert started.stdout
        try:
            yield started.stdout.readline().strip()
        finally:
            started.kill()
