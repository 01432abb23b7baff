"""What a type checker knows of the host's half: type-checked, never run."""

from typing import Any, Never, TypeVar, assert_type

from i7000 import Noise, Profile, dcon, host, modbus
from i7000.host import procedures

R = TypeVar("R", bound=host.Response)


class Driver:
    """A driver as the README has it, with one `ask` for both protocols and without `Any`."""

    bus: host.Bus[host.Response] = host.Bus()

    def ask(self, command: host.Query[R], profile: Profile) -> host.Outcome[R]:
        bus = host.send(self.bus, command, profile, 0.0)
        assert_type(bus, host.Bus[R])
        while True:
            bus, events = host.receive(bus, b"", 0.0)
            for event in events:
                if isinstance(event, host.Transmit):
                    assert_type(event.wire, bytes)
                elif isinstance(event, host.Ended):
                    self.bus = bus
                    return event
                else:
                    assert_type(event, host.Rejected | host.Late | Noise)


def check_driver(driver: Driver, profile: Profile) -> None:
    match driver.ask(dcon.ReadConfiguration(0x01), profile):
        case host.Answered(response=response):
            assert_type(response, dcon.Configuration)
        case host.Declined() as declined:
            assert_type(declined.response, dcon.Refused | modbus.ExceptionResponse)
        case other:
            assert_type(other, host.TimedOut | host.Sent)
    registers = driver.ask(modbus.ReadInputRegisters(0x01, 0, 8), profile)
    if isinstance(registers, host.Answered):
        assert_type(registers.response, modbus.InputRegisters)
        assert_type(registers.response.values, tuple[int, ...])
    assert_type(driver.ask(dcon.HostOk(), profile), host.Outcome[Never])


def check_bus(bus: host.Bus[host.Response], profile: Profile) -> None:
    asked = host.send(bus, dcon.ReadConfiguration(0x01), profile, 0.0)
    assert_type(asked, host.Bus[dcon.Configuration])
    assert_type(host.send(bus, modbus.ReadCoils(0x01, 0, 8), profile, 0.0), host.Bus[modbus.Coils])
    assert_type(host.send(bus, dcon.HostOk(), profile, 0.0), host.Bus[Never])

    heard, events = host.receive(asked, b"", 0.0)
    assert_type(heard, host.Bus[dcon.Configuration])
    assert_type(events, tuple[host.Event[dcon.Configuration], ...])
    assert_type(host.next_deadline(heard), float | None)
    kept: host.Bus[host.Response] = host.abandon(heard, 0.0)

    kept.echo = True  # type: ignore[misc] # frozen
    host.send(kept, dcon.Configuration, profile, 0.0)  # type: ignore[arg-type] # a response is not sent by a host


def check_procedure(profile: Profile) -> procedures.Procedure[int | None]:
    configuration = yield from procedures.ask(dcon.ReadConfiguration(0x01), profile)
    assert_type(configuration, procedures.Result[dcon.Configuration])
    coils = yield from procedures.ask(modbus.ReadCoils(0x01, 0, 8), profile, host.Policy(retries=0))
    assert_type(coils, procedures.Result[modbus.Coils])
    yield procedures.Wait(1.0)
    return len(coils.outcome.response.values) if isinstance(coils.outcome, host.Answered) else None


def check_steps(procedure: procedures.Procedure[Any]) -> None:
    assert_type(next(procedure), procedures.Step)
