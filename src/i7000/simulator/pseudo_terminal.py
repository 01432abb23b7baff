"""A pseudo-terminal that connects a host to a simulated bus (POSIX).

Laws: a host that does not read loses bytes, as on a real line; the simulator never waits for it.
"""

import asyncio
import os
import pty
import tty
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from i7000.simulator.served import Served
from i7000.simulator.simulator import UNREAD

__all__ = ["open_pty"]

_AT_ONCE = 4096


@asynccontextmanager
async def open_pty(simulator: Served) -> AsyncIterator[str]:
    """Open a pseudo-terminal connected to the bus; the value is its path.

    Special: it has neither baud rate nor parity, so all modules receive every host.
    """
    end, near = pty.openpty()
    try:
        for descriptor in (end, near):
            tty.setraw(descriptor)
        os.set_blocking(end, False)
        path = os.ttyname(near)

        def write(data: bytes) -> None:
            try:
                written = os.write(end, data)
            except BlockingIOError:
                written = 0
            if written < len(data):
                simulator.notice(UNREAD)

        host = simulator.host(path, write)
        loop = asyncio.get_running_loop()
        loop.add_reader(end, lambda: host.receive(os.read(end, _AT_ONCE)))
        try:
            yield path
        finally:
            loop.remove_reader(end)
            host.close()
    finally:
        os.close(end)
        os.close(near)  # It was kept open: without it, reading fails once a host has closed its own.
