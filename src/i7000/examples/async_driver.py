"""A driver for an event loop: asyncio, the file descriptor of a pyserial port (POSIX) and `i7000.host`."""

if __name__ == "__main__":  # before the imports, which take longer than all else
    from i7000_cli import end_at_ctrl_c

    end_at_ctrl_c()

import asyncio
from collections.abc import Sequence
from contextlib import suppress

import serial

from i7000 import Noise, Profile
from i7000.examples.task import R, open_port, program, read_task
from i7000.host import (
    Bus,
    Ended,
    Outcome,
    Query,
    Rejected,
    Response,
    Transmit,
    abandon,
    next_deadline,
    receive,
    send,
)

__all__ = ["Driver", "main"]


class Driver:
    """A port and the state of its line; any number of tasks may send requests."""

    def __init__(self, port: serial.Serial, bus: Bus[Response]) -> None:
        self.port, self.bus = port, bus
        self.loop, self.turn = asyncio.get_running_loop(), asyncio.Lock()
        self.refused: Rejected | Noise | None = None

    async def ask(self, command: Query[R], profile: Profile) -> Outcome[R]:
        """Send a command when it is its turn, and return its outcome; a cancelled task ends it without one."""
        async with self.turn:
            bus = send(self.bus, command, profile, self.loop.time())
            try:
                while True:
                    bus, events = receive(bus, await self._read(bus), self.loop.time())
                    for event in events:
                        if isinstance(event, Transmit):
                            self.port.write(event.wire)
                        elif isinstance(event, Ended):
                            return event
                        elif isinstance(event, Rejected | Noise):
                            self.refused = event
            finally:
                self.bus = abandon(bus, self.loop.time())

    async def _read(self, bus: Bus[Response]) -> bytes:
        """Read what the port has; wait for it until the deadline."""
        readable = asyncio.Event()
        self.loop.add_reader(self.port.fileno(), readable.set)
        try:
            with suppress(TimeoutError):
                async with asyncio.timeout_at(next_deadline(bus)):
                    await readable.wait()
        finally:
            self.loop.remove_reader(self.port.fileno())
        return self.port.read(self.port.in_waiting)


async def _main(arguments: Sequence[str] | None) -> int:
    task = read_task(arguments)
    with open_port(task) as port:
        driver = Driver(port, task.bus)
        return task.show(await driver.ask(task.command, task.profile), driver.refused)


def main(arguments: Sequence[str] | None = None) -> int:
    """Read the inputs of a module."""
    return asyncio.run(_main(arguments))


if __name__ == "__main__":
    raise SystemExit(program(main))
