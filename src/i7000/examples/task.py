"""The arguments and the output of the example drivers; the same for both."""

import sys
from argparse import ArgumentParser
from collections.abc import Sequence
from typing import TypeVar

import serial
from attrs import evolve, frozen

from i7000 import BaudRate, DecodeError, LineSettings, Model, Noise, Profile, Reading, TypeCode, dcon, modbus
from i7000.host import Answered, Bus, Outcome, Query, Rejected, Response
from i7000_cli import program

__all__ = ["R", "Task", "open_port", "program", "read_task"]

R = TypeVar("R", bound=Response)
"""The response of a command of either protocol."""
Inputs = dcon.AnalogInputs | modbus.InputRegisters
"""The response of the command of a task."""


@frozen
class Task:
    """The task of an example driver: read the inputs of a module."""

    port: str
    bus: Bus[Response]
    profile: Profile
    command: Query[Inputs]

    def show(self, outcome: Outcome[Inputs], refused: Rejected | Noise | None) -> int:
        """Print the outcome, and return the exit code of the program: 0 for a response.

        `refused` is the last rejected frame: it often explains a timeout.
        """
        if not isinstance(outcome, Answered):
            print(outcome)  # noqa: T201 - what a program prints
            if refused is not None:
                reason = refused.reason if isinstance(refused, Rejected) else refused.fault.value
                print(f"last rejected frame: {refused.wire!r}: {reason}")  # noqa: T201
            return 1
        try:
            readings = self._readings(outcome.response)
        except DecodeError as error:  # of another module than was told
            print(error)  # noqa: T201
            return 1
        for channel, reading in enumerate(readings):
            print(channel, reading.value, reading.unit, reading.status.value)  # noqa: T201
        return 0

    def _readings(self, response: Inputs) -> tuple[Reading, ...]:
        if isinstance(response, modbus.InputRegisters):
            return modbus.readings(response.values, self.profile)
        return dcon.readings(response, self.profile)


def read_task(arguments: Sequence[str] | None = None) -> Task:
    """Parse the arguments of the command line."""
    parser = ArgumentParser(description="Read the analog inputs of a module.")
    parser.add_argument("port", help="the serial port, or any URL that pyserial supports")
    parser.add_argument("--model", type=Model.find, required=True)
    parser.add_argument("--address", type=lambda text: int(text, 16), default=0x01, help="in hex; 01 unless given")
    types, rates = TypeCode.__members__, {str(rate.bits_per_second): rate for rate in BaudRate}
    parser.add_argument("--type", choices=types, metavar="TYPE", help="of all channels: K, V_10, MA_4_20 ...")
    parser.add_argument("--baud", choices=rates, default="9600")
    parser.add_argument("--checksum", action="store_true", help="DCON frames carry a checksum")
    parser.add_argument("--modbus", action="store_true", help="ask by Modbus RTU instead of DCON")
    parser.add_argument("--echo", action="store_true", help="the adapter hears what it sends")
    given = parser.parse_args(arguments)
    profile = Profile(given.model, checksum=given.checksum)
    if given.type is not None:
        profile = evolve(profile, type_codes=(types[given.type],) * profile.channels)
    command: Query[Inputs] = dcon.ReadAnalogInputs(given.address)
    if given.modbus:
        command = modbus.ReadInputRegisters(given.address, 0, profile.channels)
    line = LineSettings(rates[given.baud])
    return Task(given.port, Bus[Response](line, echo=given.echo), profile, command)


def open_port(task: Task) -> serial.Serial:
    """Open the port with the settings of the line; if that fails, end the program with the reason."""
    line = task.bus.line
    rate = BaudRate(line.baud_rate).bits_per_second
    form = line.character_format
    try:
        return serial.serial_for_url(task.port, rate, parity=form.parity, stopbits=form.stop_bits)
    except (OSError, ValueError) as error:  # the latter for a URL that pyserial does not know
        sys.stderr.write(f"{task.port}: {error}\n")
        raise SystemExit(2) from None
