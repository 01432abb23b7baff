"""A blocking driver: pyserial and `i7000.host`, nothing else."""

if __name__ == "__main__":  # before the imports, which take longer than all else
    from i7000_cli import end_at_ctrl_c

    end_at_ctrl_c()

from collections.abc import Sequence
from time import monotonic

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
    """A port and the state of its line."""

    def __init__(self, port: serial.Serial, bus: Bus[Response]) -> None:
        self.port, self.bus = port, bus
        self.refused: Rejected | Noise | None = None

    def ask(self, command: Query[R], profile: Profile) -> Outcome[R]:
        """Send a command and return its outcome; Ctrl-C and errors of the port end it without one."""
        bus = send(self.bus, command, profile, monotonic())
        try:
            while True:
                bus, events = receive(bus, self._read(bus), monotonic())
                for event in events:
                    if isinstance(event, Transmit):
                        self.port.write(event.wire)
                    elif isinstance(event, Ended):
                        return event
                    elif isinstance(event, Rejected | Noise):
                        self.refused = event
        finally:
            self.bus = abandon(bus, monotonic())

    def _read(self, bus: Bus[Response]) -> bytes:
        """Read what the port has; wait for it until the deadline."""
        deadline = next_deadline(bus)
        self.port.timeout = deadline and max(0.0, deadline - monotonic())
        return self.port.read(1) + self.port.read(self.port.in_waiting)


def main(arguments: Sequence[str] | None = None) -> int:
    """Read the inputs of a module."""
    task = read_task(arguments)
    with open_port(task) as port:
        driver = Driver(port, task.bus)
        return task.show(driver.ask(task.command, task.profile), driver.refused)


if __name__ == "__main__":
    raise SystemExit(program(main))
