"""A bus on which no two channels read the same, requests to it and the answers that the signals give."""

from collections.abc import Iterator
from random import Random
from typing import Any

from i7000 import BaudRate, LineSettings, Model, Profile, Protocol, ReportSettings, TypeCode, Unit, dcon, modbus
from i7000.device import OPEN_WIRE, Signal
from i7000.host import Answered, Policy
from i7000.message import Query, Response
from i7000.simulator.sources import Fixed, Sources
from tests.simulator.running import module

Asked = tuple[Query[Response], Profile]

SEALED = ReportSettings(checksum=True)
FAST = LineSettings(BaudRate.BAUD_115200)
HASTY = Policy(retries=1, turnaround=0.1, grace=0.1)
DEGREES = (25.1, 26.4, 0.0, 2000.0, 20.0, 20.1, 20.2, 20.3)
DEGREES_SAID = "+0025.1+0026.4       +9999.9+0020.0+0020.1+0020.2+0020.3"
VOLTS = (1.5, -1.0, 0.25, 2.0, -2.5, 0.125, 2.5, -0.75)
MORE_VOLTS = (9.0, -8.0, 7.0, -6.0, 5.0, -4.0, 3.0, -2.0)
NO_SUCH_MODULE = dcon.ReadAnalogInputs(0x0F)


def sources(unit: Unit, *values: float | None) -> Sources:
    return Sources(tuple(Fixed(OPEN_WIRE if value is None else Signal(value, unit)) for value in values))


MODULES = (
    module(
        Model.M_7019R,
        sources=sources(Unit.CELSIUS, *DEGREES),
        type_codes=(TypeCode.K,) * 8,
        channel_mask=0xFB,
        report_settings=SEALED,
        line_settings=FAST,
    ),
    module(Model.I_7018, sources=sources(Unit.VOLT, *VOLTS), address=0x02, report_settings=SEALED, line_settings=FAST),
    module(
        Model.M_7017,
        sources=sources(Unit.VOLT, *MORE_VOLTS),
        address=0x03,
        protocol=Protocol.MODBUS_RTU,
        line_settings=FAST,
    ),
    module(
        Model.M_7018,
        sources=sources(Unit.VOLT, *VOLTS[::-1]),
        address=0x04,
        protocol=Protocol.MODBUS_RTU,
        line_settings=FAST,
    ),
)
PROFILE = Profile(Model.M_7019R, type_codes=(TypeCode.K,) * 8, checksum=True)
FIELDS = {
    0x01: tuple(DEGREES_SAID[at : at + 7] for at in range(0, 56, 7)),
    0x02: tuple(f"{value:+07.4f}" for value in VOLTS),
}
WORDS = {
    0x03: tuple(round(value / 10 * (32767 if value > 0 else 32768)) % 65536 for value in MORE_VOLTS),
    0x04: tuple(round(value / 2.5 * (32767 if value > 0 else 32768)) % 65536 for value in VOLTS[::-1]),
}
PROFILES = {
    0x01: PROFILE,
    0x02: Profile(Model.I_7018, checksum=True),
    0x03: Profile(Model.M_7017),
    0x04: Profile(Model.M_7018),
}


def requests(count: int) -> Iterator[Asked]:
    """All kinds of readings, of any module and channel."""
    chance = Random(7000)
    for _ in range(count):
        address, channel = chance.choice(sorted(PROFILES)), chance.randrange(8)
        command: Query[Response] = modbus.ReadInputRegisters(address, channel, chance.randint(1, 8 - channel))
        if address in FIELDS:
            command = dcon.ReadAnalogInput(address, channel)
            if chance.random() < 0.2:
                command = dcon.ReadAnalogInputs(address)
        yield command, PROFILES[address]


def truth(command: Any) -> Answered[Any]:
    """The answer that the signals give."""
    match command:
        case dcon.ReadAnalogInputs(address=address):
            return Answered(command, dcon.AnalogInputs(FIELDS[address]))
        case dcon.ReadAnalogInput(address=address, channel=channel):
            return Answered(command, dcon.AnalogInput(FIELDS[address][channel]))
        case _:
            words = WORDS[command.address][command.start : command.start + command.count]
            return Answered(command, modbus.InputRegisters(command.address, words))
