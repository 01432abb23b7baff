"""Procedures on a port with a guard: what is refused ends a question, and not the procedure."""

import pytest
from attrs import evolve

from i7000 import EncodeError, LineSettings, Model, Profile, Protocol, ReportSettings, dcon, modbus
from i7000.conformance import DEFAULT_ALLOWED, GuardError, Hazard, allowing
from i7000.conformance.allowed import as_allowed
from i7000.device import factory, power_on
from i7000.host import Answered, TimedOut
from i7000.host.procedures import BytesHeard, Procedure, SendBytes, Tell, ask, identify, snapshot
from i7000.link import GuardedPort, Line, VirtualPort

CHECKED = Profile(Model.M_7019R, checksum=True)


def line_to(
    address: int, protocol: Protocol = Protocol.DCON, allowed: frozenset[Hazard] = DEFAULT_ALLOWED, *, checksum: bool
) -> Line:
    eeprom = evolve(
        factory(Model.M_7019R), address=address, protocol=protocol, report_settings=ReportSettings(checksum=checksum)
    )
    return Line(GuardedPort(VirtualPort([power_on(eeprom, now=0.0)]), allowed))


def test_a_module_is_identified_without_the_question_that_the_guard_refuses() -> None:
    told: list[object] = []
    with line_to(0xFF, checksum=True) as line:
        found = line.run(as_allowed(identify(0xFF, protocols=[Protocol.DCON])), told.append)

    assert {it.model for it in found.candidates} == {Model.I_7019R, Model.M_7019R}
    assert [str(error) for error in told] == [
        "$FFP00\\r was not sent: it can make the module unreachable (--allow comm)"
    ]


def test_the_settings_are_read_without_the_question_that_the_guard_refuses() -> None:
    with line_to(0xFF, checksum=True) as line:
        found = line.run(as_allowed(snapshot(0xFF, CHECKED, Protocol.DCON)))

    assert found.settings
    assert [name for name, _ in found.unread] == ["protocol"]


def test_text_that_earlier_requests_left_is_ended_and_the_request_sent_again() -> None:
    read = modbus.ReadInputRegisters(0x30, 0, 1)
    with line_to(0x30, Protocol.MODBUS_RTU, checksum=False) as line:
        line.port.write(b"$01")
        line.wait(1.0)
        with pytest.raises(GuardError, match=r"after \$01"):
            line.ask(read, Profile(Model.M_7019R))
        line.wait(1.0)
        result = line.run(as_allowed(ask(read, Profile(Model.M_7019R))))

        assert isinstance(result.outcome, Answered)


def test_what_is_refused_again_counts_as_not_answered() -> None:
    write = modbus.WriteSingleRegister(0x01, 489, 0)
    told: list[object] = []
    with line_to(0x01, Protocol.MODBUS_RTU, checksum=False) as line:
        line.port.write(b"$01")
        result = line.run(as_allowed(ask(write, Profile(Model.M_7019R))), told.append)

    assert result.outcome == TimedOut(write)
    assert [type(error) for error in told] == [GuardError]


def test_other_errors_and_steps_are_those_of_the_procedure() -> None:
    def procedure() -> Procedure[bytes]:
        with pytest.raises(EncodeError):
            yield from ask(dcon.ReadCjcOffset(0x01), Profile(Model.I_7017))
        yield Tell("here")
        heard: BytesHeard = yield SendBytes(((0.0, b"$01M\r"),), 0.5, 0.02, b"\r")
        return heard.wire

    told: list[object] = []
    with line_to(0x01, checksum=False) as line:
        assert line.run(as_allowed(procedure()), told.append) == b"!017019R\r"
    assert told == ["here"]


def test_what_is_allowed_is_sent_as_it_is() -> None:
    with line_to(0x01, allowed=allowing([Hazard.WRITE]), checksum=False) as line:
        result = line.run(as_allowed(ask(dcon.SetModuleName(0x01, "X"), Profile(Model.M_7019R))))

    assert isinstance(result.outcome, Answered)
    assert line.line == LineSettings()
