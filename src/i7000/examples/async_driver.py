"""A driver for an event loop: asyncio, the file descriptor of a pyserial port (POSIX) and `i7000.host`."""

if __name__ == "__main__":  # before the imports, which take longer than all else
    from i7000_cli import end_at_ctrl_c

    end_at_ctrl_c()

import asyncio
from collections.abc import Sequence
from typing import Any, overload

import serial

from i7000 import Noise, Profile, dcon, modbus
from i7000.examples.task import RD, RM, open_port, program, read_task
from i7000.host import AnyCommand, Bus, Ended, Outcome, Rejected, Sent, Transmit, next_deadline, receive, send

__all__ = ["Driver", "main"]


class Driver:
    """A port and the state of its line; any number of tasks may send requests."""

    def __init__(self, port: serial.Serial, bus: Bus[Any]) -> None:
        self.port, self.bus = port, bus
        self.loop, self.turn = asyncio.get_running_loop(), asyncio.Lock()
        self.outcome: asyncio.Future[Outcome[Any]] = self.loop.create_future()
        self.timer: asyncio.TimerHandle | None = None
        self.refused: Rejected | Noise | None = None
        self.loop.add_reader(port.fileno(), self._called)

    @overload
    async def ask(self, command: dcon.Command[RD], profile: Profile) -> Outcome[RD]: ...
    @overload
    async def ask(self, command: modbus.Request[RM], profile: Profile) -> Outcome[RM]: ...
    @overload
    async def ask(self, command: dcon.Broadcast, profile: Profile) -> Sent: ...
    async def ask(self, command: Any, profile: Profile) -> Any:
        """Send a command when it is its turn, and return its outcome; a cancelled task does not end the request."""
        return await asyncio.shield(self._ask(command, profile))

    async def _ask(self, command: AnyCommand, profile: Profile) -> Outcome[Any]:
        async with self.turn:
            self._advance()
            self.bus, wire = send(self.bus, command, profile, self.loop.time())
            self.outcome = self.loop.create_future()
            self.port.write(wire)
            self._advance()
            return await self.outcome

    def _called(self) -> None:
        try:
            self._advance()
        except OSError as error:  # the port is gone
            self.loop.remove_reader(self.port.fileno())
            if self.turn.locked() and not self.outcome.done():
                self.outcome.set_exception(error)

    def _advance(self) -> None:
        """Process received bytes or the time, and schedule the next call."""
        self.bus, events = receive(self.bus, self.port.read(self.port.in_waiting), self.loop.time())
        for event in events:
            if isinstance(event, Transmit):
                self.port.write(event.wire)
            elif isinstance(event, Ended):
                self.outcome.set_result(event)
            elif isinstance(event, Rejected | Noise):
                self.refused = event
        if self.timer:
            self.timer.cancel()
        deadline = next_deadline(self.bus)
        self.timer = None if deadline is None else self.loop.call_at(deadline, self._called)


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
