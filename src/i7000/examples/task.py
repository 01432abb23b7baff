"""The arguments and the output of the example programs; the same for both."""

import json
import sys
from argparse import ArgumentParser, ArgumentTypeError
from collections.abc import Generator, Iterator, Sequence
from contextlib import contextmanager

from attrs import evolve, field, frozen

from i7000 import BaudRate, DecodeError, LineSettings, Model, Noise, Profile, Protocol, Reading, TypeCode, dcon, modbus
from i7000.cli.numbers import integer
from i7000.cli.words import UsageError
from i7000.errors import InvalidValueError, written
from i7000.host import Answered, Query, Rejected, TimedOut
from i7000.host.procedures import Result
from i7000.link import LinkError
from i7000_cli import program

__all__ = ["Task", "failures_reported", "program", "read_task"]

Inputs = dcon.AnalogInputs | modbus.InputRegisters
"""The response of the command of a task."""


@frozen
class Task:
    """The task of an example program: read the inputs of modules."""

    target: str
    line: LineSettings
    profile: Profile
    commands: tuple[Query[Inputs], ...]
    echo: bool = field(kw_only=True)
    polls: int = field(default=1, kw_only=True)
    """How often each module is read."""
    json: bool = field(default=False, kw_only=True)
    """Whether the output is for ``i7000 provoke``."""

    def requests(self) -> Iterator[Query[Inputs]]:
        """Yield the commands, one after the other."""
        for _ in range(self.polls):
            yield from self.commands

    def show(self, command: Query[Inputs], result: Result[Inputs]) -> int:
        """Print the result, and return the exit code of the program: 0 for a response.

        Special: without a response, the last rejected frame is printed too: it often explains a timeout.
        """
        if self.json:
            return self._show_json(command, result)
        if not isinstance(result.outcome, Answered):
            print(result.outcome)  # noqa: T201 - what a program prints
            for refused in [it for it in result.others if isinstance(it, Rejected | Noise)][-1:]:
                reason = refused.reason if isinstance(refused, Rejected) else refused.fault.value
                print(f"last rejected frame: {written(refused.wire)}: {reason}")  # noqa: T201
            if isinstance(command, dcon.Command) and Protocol.MODBUS_RTU in self.profile.model.protocols:
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

    def _show_json(self, command: Query[Inputs], result: Result[Inputs]) -> int:
        """Print a line for each reading, as ``i7000 provoke --schema`` describes it."""
        address = getattr(command, "address")  # noqa: B009 - of a command of either protocol
        try:
            readings = self._readings(result.outcome.response) if isinstance(result.outcome, Answered) else ()
        except DecodeError:
            readings = ()
        for channel, (value, unit, status) in enumerate(readings):
            said = {"address": address, "channel": channel, "value": value, "unit": unit, "status": status.value}
            print(json.dumps(said), flush=True)  # noqa: T201
        if not readings:
            status_ = "missing" if isinstance(result.outcome, TimedOut) else "error"
            print(json.dumps({"address": address, "status": status_}), flush=True)  # noqa: T201
        return int(not readings)

    def _readings(self, response: Inputs) -> tuple[Reading, ...]:
        if isinstance(response, modbus.InputRegisters):
            return modbus.readings(response.values, self.profile)
        return dcon.readings(response, self.profile)


def read_task(arguments: Sequence[str] | None = None) -> Task:
    """Parse the arguments of the command line."""
    parser = ArgumentParser(description="Read the analog inputs of modules.")
    parser.add_argument("target", help="a serial port, a URL of pyserial, sim:M-7019R,type=K or exec:COMMAND")
    parser.add_argument("--model", type=Model.find, required=True)
    address = "decimal, or hex as 0x1A or 1Ah; 1 unless given; repeat it for each module"
    parser.add_argument("--address", type=_address, action="append", help=address)
    types, rates = TypeCode.__members__, {str(rate.bits_per_second): rate for rate in BaudRate}
    parser.add_argument("--type", choices=types, metavar="TYPE", help="of all channels: K, V_10, MA_4_20 ...")
    parser.add_argument("--baud", choices=rates, default="9600")
    parser.add_argument("--checksum", action="store_true", help="DCON frames carry a checksum")
    parser.add_argument("--modbus", action="store_true", help="ask by Modbus RTU instead of DCON")
    parser.add_argument("--echo", action="store_true", help="the adapter hears what it sends")
    parser.add_argument("--polls", type=int, default=1, help="how often each module is read; 1 unless given")
    parser.add_argument("--json", action="store_true", help="print JSON lines for i7000 provoke")
    given = parser.parse_args(arguments)
    if given.polls < 1:
        parser.error(f"--polls {given.polls}: give 1 or more")
    try:
        profile = Profile(given.model, checksum=given.checksum)
        if given.type is not None:
            profile = evolve(profile, type_codes=(types[given.type],) * profile.channels)
        commands = tuple(_command(address, profile, rtu=given.modbus) for address in given.address or (0x01,))
    except InvalidValueError as error:
        parser.error(str(error))
    line = LineSettings(rates[given.baud])
    return Task(given.target, line, profile, commands, echo=given.echo, polls=given.polls, json=given.json)


def _command(address: int, profile: Profile, *, rtu: bool) -> Query[Inputs]:
    return modbus.ReadInputRegisters(address, 0, profile.channels) if rtu else dcon.ReadAnalogInputs(address)


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
