"""What a type checker knows of the host's half: type-checked, never run."""

from typing import Any, Never, assert_type

from i7000 import Profile, dcon, host, modbus


def check(bus: host.Bus[Any], profile: Profile) -> None:
    asked, wire = host.send(bus, dcon.ReadConfiguration(0x01), profile, 0.0)
    assert_type(asked, host.Bus[dcon.Configuration])
    assert_type(wire, bytes)
    assert_type(host.send(bus, modbus.ReadCoils(0x01, 0, 8), profile, 0.0)[0], host.Bus[modbus.Coils])
    assert_type(host.send(bus, dcon.HostOk(), profile, 0.0)[0], host.Bus[Never])

    heard, events = host.receive(asked, b"", 0.0)
    assert_type(heard, host.Bus[dcon.Configuration])
    for event in (*events, *host.wake(heard, 0.0)[1]):
        match event:
            case host.Answered():
                assert_type(event.response, dcon.Configuration)
            case host.Declined():
                assert_type(event.response, dcon.Refused | modbus.ExceptionResponse)
            case _:
                pass
    assert_type(host.next_deadline(heard), float | None)

    bus.echo = True  # type: ignore[misc] # frozen
