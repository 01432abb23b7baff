"""What a type checker knows of lines: type-checked, never run; a user needs no `Any`."""

from typing import Never, assert_type

import serial

from i7000 import Profile, dcon, host, link, modbus
from i7000.host import procedures


def check_line(port: serial.Serial, virtual: link.VirtualPort, profile: Profile) -> None:
    with link.Line(port) as line:
        match line.ask(dcon.ReadConfiguration(0x01), profile):
            case host.Answered(response=response):
                assert_type(response, dcon.Configuration)
            case other:
                assert_type(other, host.Declined | host.TimedOut | host.Sent)
        assert_type(line.ask(modbus.ReadCoils(0x01, 0, 8), profile), host.Outcome[modbus.Coils])
        assert_type(line.ask(dcon.HostOk(), profile), host.Outcome[Never])
        coils = line.run(procedures.ask(modbus.ReadCoils(0x01, 0, 8), profile))
        assert_type(coils, procedures.Result[modbus.Coils])

        line.ask(dcon.Configuration, profile)  # type: ignore[arg-type] # a response is not sent by a host
    assert_type(link.Line(virtual), link.Line)
    assert_type(link.Line.open("sim:I-7018", seed=7), link.Line)
    assert_type(link.open_target("loop://"), link.Port)

    link.Line.open("sim:I-7018", speed=7)  # type: ignore[call-arg] # no option of any target
    link.Line(object())  # type: ignore[arg-type] # not a port


async def check_async_line(port: serial.Serial, profile: Profile) -> None:
    async with link.AsyncLine(port) as line:
        assert_type(await line.ask(dcon.ReadConfiguration(0x01), profile), host.Outcome[dcon.Configuration])
        result = await line.run(procedures.ask(dcon.ReadModuleName(0x01), profile))
        assert_type(result, procedures.Result[dcon.ModuleName])
    async with await link.AsyncLine.open("exec:./module", init_switch=True) as opened:
        assert_type(opened, link.AsyncLine)


def check_observer(observed: link.Observed) -> None:
    match observed:
        case link.Received() | link.Written():
            assert_type(observed.data, bytes)
        case link.Happened():
            assert_type(observed.event, host.Event[host.Response])
        case link.Asked():
            assert_type(observed.command, host.Query[host.Response])
        case _:
            assert_type(observed, link.Abandoned | link.Tuned | link.PowerCycled)
