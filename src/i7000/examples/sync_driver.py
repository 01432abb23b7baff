"""A blocking driver: pyserial and `i7000.host`, nothing else."""

if __name__ == "__main__":  # before the imports, which take longer than all else
    from i7000_cli import end_at_ctrl_c

    end_at_ctrl_c()

from collections.abc import Sequence
from time import monotonic
from typing import Any, overload

import serial

from i7000 import Noise, Profile, dcon, modbus
from i7000.examples.task import RD, RM, open_port, program, read_task
from i7000.host import Bus, Ended, Outcome, Rejected, Sent, Transmit, next_deadline, receive, send

__all__ = ["Driver", "main"]


class Driver:
    """A port and the state of its line."""

    def __init__(self, port: serial.Serial, bus: Bus[Any]) -> None:
        self.port = port
        self.bus = bus
        self.refused: Rejected | Noise | None = None

    @overload
    def ask(self, command: dcon.Command[RD], profile: Profile) -> Outcome[RD]: ...
    @overload
    def ask(self, command: modbus.Request[RM], profile: Profile) -> Outcome[RM]: ...
    @overload
    def ask(self, command: dcon.Broadcast, profile: Profile) -> Sent: ...
    def ask(self, command: Any, profile: Profile) -> Any:
        """Send a command and return its outcome."""
        self.bus, _ = receive(self.bus, self.port.read(self.port.in_waiting), monotonic())
        self.bus, wire = send(self.bus, command, profile, monotonic())
        self.port.write(wire)
        outcome = None
        while (deadline := next_deadline(self.bus)) is not None:
            self.port.timeout = max(0.0, deadline - monotonic())
            data = self.port.read()
            data += self.port.read(self.port.in_waiting)
            self.bus, events = receive(self.bus, data, monotonic())
            for event in events:
                if isinstance(event, Transmit):
                    self.port.write(event.wire)
                elif isinstance(event, Ended):
                    outcome = event
                elif isinstance(event, Rejected | Noise):
                    self.refused = event
        return outcome


def main(arguments: Sequence[str] | None = None) -> int:
    """Read the inputs of a module."""
    task = read_task(arguments)
    with open_port(task) as port:
        driver = Driver(port, task.bus)
        return task.show(driver.ask(task.command, task.profile), driver.refused)


if __name__ == "__main__":
    raise SystemExit(program(main))
