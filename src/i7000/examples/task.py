"""The arguments and the output of the example programs; the same for both."""

import sys
from argparse import ArgumentParser, ArgumentTypeError
from collections.abc import Generator, Sequence
from contextlib import contextmanager

from attrs import evolve, field, frozen

from i7000 import BaudRate, DecodeError, LineSettings, Model, Noise, Profile, Protocol, Reading, TypeCode, dcon, modbus
from i7000.cli.numbers import integer
from i7000.cli.words import UsageError
from i7000.errors import InvalidValueError, written
from i7000.host import Answered, Query, Rejected
from i7000.host.procedures import Result
from i7000.link import LinkError
from i7000_cli import program

__all__ = ["Task", "failures_reported", "program", "read_task"]

Inputs = dcon.AnalogInputs | modbus.InputRegisters
"""The response of the command of a task."""


@frozen
class Task:
    """The task of an example program: read the inputs of a module."""

    target: str
    line: LineSettings
    profile: Profile
    command: Query[Inputs]
    echo: bool = field(kw_only=True)

    def show(self, result: Result[Inputs]) -> int:
        """Print the result, and return the exit code of the program: 0 for a response.

        Special: without a response, the last rejected frame is printed too: it often explains a timeout.
        """
        if not isinstance(result.outcome, Answered):
            print(result.outcome)  # noqa: T201 - what a program prints
            for refused in [it for it in result.others if isinstance(it, Rejected | Noise)][-1:]:
                reason = refused.reason if isinstance(refused, Rejected) else refused.fault.value
                print(f"last rejected frame: {written(refused.wire)}: {reason}")  # noqa: T201
            if isinstance(self.command, dcon.Command) and Protocol.MODBUS_RTU in self.profile.model.protocols:
                print("M-7000 modules speak Modbus RTU, unless they were set to DCON: try --modbus")  # noqa: T201
            return 1
        try:
            readings = self._readings(result.outcome.response)
        except DecodeError as error:  # of a module other than the given one
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
    parser.add_argument("target", help="a serial port, a URL of pyserial, sim:M-7019R,type=K or exec:COMMAND")
    parser.add_argument("--model", type=Model.find, required=True)
    parser.add_argument("--address", type=_address, default=0x01, help="decimal, or hex as 0x1A or 1Ah; 1 unless given")
    types, rates = TypeCode.__members__, {str(rate.bits_per_second): rate for rate in BaudRate}
    parser.add_argument("--type", choices=types, metavar="TYPE", help="of all channels: K, V_10, MA_4_20 ...")
    parser.add_argument("--baud", choices=rates, default="9600")
    parser.add_argument("--checksum", action="store_true", help="DCON frames carry a checksum")
    parser.add_argument("--modbus", action="store_true", help="ask by Modbus RTU instead of DCON")
    parser.add_argument("--echo", action="store_true", help="the adapter hears what it sends")
    given = parser.parse_args(arguments)
    try:
        profile = Profile(given.model, checksum=given.checksum)
        if given.type is not None:
            profile = evolve(profile, type_codes=(types[given.type],) * profile.channels)
        command: Query[Inputs] = dcon.ReadAnalogInputs(given.address)
        if given.modbus:
            command = modbus.ReadInputRegisters(given.address, 0, profile.channels)
    except InvalidValueError as error:
        parser.error(str(error))
    return Task(given.target, LineSettings(rates[given.baud]), profile, command, echo=given.echo)


def _address(text: str) -> int:
    try:
        address = integer(text)
    except UsageError as error:
        raise ArgumentTypeError(error) from None
    if not 0 <= address <= 0xFF:
        raise ArgumentTypeError("an address is 0..255 or 00h..FFh")
    return address


@contextmanager
def failures_reported() -> Generator[None, None, None]:
    """End the program with the reason if the target is invalid, or if its port cannot be opened or disappears."""
    try:
        yield
    except (InvalidValueError, LinkError) as error:
        sys.stderr.write(f"{error}\n")
        raise SystemExit(2) from None
