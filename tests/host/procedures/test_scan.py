"""The search for modules: where it looks, how long it takes, and what it finds."""

from typing import Any

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from i7000 import (
    ArgumentError,
    BaudRate,
    CharacterFormat,
    EncodeError,
    InvalidValueError,
    LineSettings,
    Model,
    Noise,
    Protocol,
    ReportSettings,
    dcon,
    modbus,
)
from i7000.device import Eeprom, factory
from i7000.errors import Fault
from i7000.host import Answered, Late, Policy, Rejected, TimedOut
from i7000.host.procedures import (
    EVERY_LINE,
    SCAN_POLICY,
    Finding,
    FindingKind,
    Place,
    Progress,
    Result,
    Scanned,
    Tell,
    Tune,
    places,
    scan,
    scan_time,
)
from i7000.simulator.faults import Faults
from tests.host.procedures.lines import faults
from tests.host.procedures.runner import Runner
from tests.host.procedures.scripted import commands, refused, run

FACTORY = LineSettings()
FAST = LineSettings(BaudRate.BAUD_115200)
EVEN = LineSettings(BaudRate.BAUD_19200, CharacterFormat.E81)
LINES = (FACTORY, FAST, EVEN)

# --- where ------------------------------------------------------------------------------------------------------------


def test_the_first_places_are_those_of_a_module_from_the_factory_and_of_one_in_init_mode() -> None:
    found = places([FAST, FACTORY], [0x05, 0x01])

    assert found[:6] == (
        Place(FACTORY, 0x01),
        Place(FACTORY, 0x01, checksum=True),
        Place(FACTORY, 0x01, Protocol.MODBUS_RTU),
        Place(FACTORY, 0x00),
        Place(FAST, 0x01),
        Place(FAST, 0x01, checksum=True),
    )


def test_each_place_is_looked_at_once() -> None:
    found = places([FACTORY, FAST, FACTORY], [0x01, 0x01, 0x00, 0x02])

    assert len(found) == len(set(found)) == 2 * 3 * 3 - 2


def test_addresses_that_modbus_does_not_have_are_places_of_dcon() -> None:
    found = places([FAST], [0x00, 0xF7, 0xF8], checksums=[True])

    assert found == (
        Place(FAST, 0x00, checksum=True),
        Place(FAST, 0xF7, checksum=True),
        Place(FAST, 0xF7, Protocol.MODBUS_RTU),
        Place(FAST, 0xF8, checksum=True),
    )


@pytest.mark.parametrize(
    "arguments",
    [([FAST],), ([FACTORY], [0x02], [Protocol.MODBUS_RTU]), ([FACTORY], [0x02], [Protocol.DCON], [True])],
    ids=["another line", "no DCON", "only with checksum"],
)
def test_init_mode_is_not_looked_for_where_it_cannot_be(arguments: Any) -> None:
    assert Place(FACTORY, 0x00) not in places(*arguments)


def test_every_line_is_each_of_them_once_the_factory_setting_first() -> None:
    assert len(set(EVERY_LINE)) == len(EVERY_LINE) == len(BaudRate) * len(CharacterFormat)
    assert EVERY_LINE[0] == FACTORY


@pytest.mark.parametrize(
    ("place", "words"),
    [
        (Place(FACTORY, 0x0A), "address 0A, 06, 9600 baud, N81, DCON without checksum"),
        (Place(EVEN, 0x01, checksum=True), "address 01, 87, 19200 baud, E81, DCON with checksum"),
        (Place(FAST, 0x01, Protocol.MODBUS_RTU), "address 01, 0A, 115200 baud, N81, Modbus RTU"),
    ],
)
def test_a_place_has_words(place: Place, words: str) -> None:
    assert str(place) == words


# --- how long ---------------------------------------------------------------------------------------------------------


LONGEST_SILENCE = 0.036
"""The longest silence of 3.5 characters, which is before the first request only."""


@given(
    st.lists(st.sampled_from(EVERY_LINE), min_size=1, max_size=3, unique=True),
    st.sets(st.integers(0, 0xFF), min_size=1, max_size=5),
    st.sets(st.sampled_from(Protocol), min_size=1),
    st.sets(st.booleans(), min_size=1),
    st.builds(Policy, retries=st.integers(0, 1), turnaround=st.floats(0.05, 1), grace=st.floats(0.05, 1)),
)
def test_the_time_of_a_scan_is_the_time_that_it_takes_on_a_silent_line(
    lines: list[LineSettings],
    addresses: set[int],
    protocols: set[Protocol],
    checksums: set[bool],
    policy: Policy,
) -> None:
    arguments = (lines, sorted(addresses), sorted(protocols), sorted(checksums))
    runner = Runner.on()

    scanned = runner.run(scan(*arguments, policy=policy))

    progress = [told for told in runner.told if isinstance(told, Progress)]
    assert scanned == Scanned((), len(places(*arguments)))
    last_silence = policy.grace if scanned.total else 0.0
    assert scan_time(*arguments, policy=policy) == pytest.approx(runner.now + last_silence, abs=LONGEST_SILENCE)
    assert [told.done for told in progress] == list(range(scanned.total))
    assert {told.total for told in progress} == ({scanned.total} if progress else set())
    assert sorted((told.seconds_left for told in progress), reverse=True) == [told.seconds_left for told in progress]


def test_the_time_left_is_that_of_the_whole_scan_at_first() -> None:
    step = next(scan(LINES, range(3)))

    assert isinstance(step, Tell)
    assert isinstance(step.value, Progress)
    assert step.value.seconds_left == pytest.approx(scan_time(LINES, range(3)))


# --- what it finds ----------------------------------------------------------------------------------------------------


@st.composite
def modules(draw: st.DrawFn) -> list[Eeprom]:
    """Draw modules at different addresses, with any line settings, protocols and checksum settings."""
    found = []
    for address in draw(st.sets(st.integers(0, 3), max_size=3)):
        eeprom = factory(draw(st.sampled_from(Model)))
        protocols = [it for it in sorted(eeprom.model.protocols) if address or it is Protocol.DCON]
        found.append(
            evolve(
                eeprom,
                address=address,
                protocol=draw(st.sampled_from(protocols)),
                line_settings=draw(st.sampled_from(LINES)),
                report_settings=ReportSettings(checksum=draw(st.booleans())),
            )
        )
    return found


def place_of(eeprom: Eeprom) -> Place:
    sealed = eeprom.protocol is Protocol.DCON and eeprom.report_settings.checksum
    return Place(eeprom.line_settings, eeprom.address, eeprom.protocol, checksum=sealed)


@given(modules(), st.booleans())
def test_every_module_is_found_at_its_place_and_left_as_it_was(
    eeproms: list[Eeprom],
    echo: bool,  # noqa: FBT001
) -> None:
    runner = Runner.on(*eeproms, faults=Faults(echo=echo))
    before = runner.modules

    scanned = runner.run(scan(LINES, range(4)))

    assert {it.place for it in scanned.devices} == {place_of(eeprom) for eeprom in eeproms}
    for finding in scanned.devices:
        (eeprom,) = (it for it in eeproms if it.address == finding.place.address)
        assert eeprom.model in finding.models
        assert finding.name == (
            eeprom.name if eeprom.protocol is Protocol.DCON else eeprom.model.modbus_name.hex().upper()
        )
    assert [told for told in runner.told if isinstance(told, Finding)] == list(scanned.findings)
    assert [(it.eeprom, it.ram) for it in before] == [(it.eeprom, it.ram) for it in runner.modules]
    assert {type(step.command) for step in runner.asked} <= {
        dcon.ReadModuleName, modbus.ReadInputRegisters, modbus.ReadModuleName,
    }  # fmt: skip


@given(modules(), faults(), st.integers(0, 2**32))
def test_what_is_found_on_a_bad_line_is_there(eeproms: list[Eeprom], bad: Faults, seed: int) -> None:
    runner = Runner.on(*eeproms, faults=bad, seed=seed)
    policy = evolve(SCAN_POLICY, grace=0.4)

    scanned = runner.run(scan(LINES, range(4), checksums=[True], policy=policy))

    assert {it.place for it in scanned.devices} <= {place_of(eeprom) for eeprom in eeproms}
    assert scanned.total <= len(runner.asked) <= 2 * scanned.total


def test_a_module_in_init_mode_is_found_whatever_its_settings_are() -> None:
    eeprom = evolve(factory(Model.M_7019R), address=0x23, line_settings=FAST)
    runner = Runner.on(eeprom, init_switch=True)

    scanned = runner.run(scan([FACTORY], [0x01]))

    assert [(it.place, it.name) for it in scanned.devices] == [(Place(FACTORY, 0x00), "7019R")]


def test_where_a_module_answers_the_other_checksum_setting_is_not_tried() -> None:
    runner = Runner.on(factory(Model.I_7018))

    scanned = runner.run(scan([FACTORY], [0x01], [Protocol.DCON]))

    assert [step.command for step in runner.asked] == [dcon.ReadModuleName(0x01), dcon.ReadModuleName(0x00)]
    assert scanned.total == 3


def test_the_host_is_tuned_where_the_line_settings_change() -> None:
    _, steps = run(scan([FACTORY, FAST], [0x01, 0x02], [Protocol.DCON], [False]), {})

    tuned = [step.line for step in steps if isinstance(step, Tune)]
    assert tuned == [FACTORY, FAST, FACTORY, FAST]


# --- what was received ------------------------------------------------------------------------------------------------

NAME = dcon.ReadModuleName(0x01)
INPUT = modbus.ReadInputRegisters(0x01, 0, 1)


def heard(protocol: Protocol, *others: Any, checksum: bool = False) -> FindingKind:
    """Return what a scan makes of traffic at one place."""
    command: Any = INPUT if protocol is Protocol.MODBUS_RTU else NAME
    result: Result[Any] = Result(TimedOut(command), others)
    outcomes = {type(command): lambda _: result}
    scanned, _ = run(scan([FAST], [0x01], [protocol], [checksum]), outcomes)
    return scanned.findings[0].heard if scanned.findings else FindingKind.NOTHING


READ_INPUT = modbus.encode(INPUT)


@pytest.mark.parametrize(
    ("others", "expected"),
    [
        ((), FindingKind.NOTHING),
        ((Noise(b"\xf0\x00", Fault.CHARACTER),), FindingKind.NOISE),
        ((Rejected(b"$01M\r", Fault.LEADING, ""),), FindingKind.ECHO),
        ((Rejected(b"$01M\r", Fault.LEADING, ""), Noise(b"\xf0", Fault.CHARACTER)), FindingKind.NOISE),
        ((Rejected(b"$01M\r", Fault.LEADING, ""), Rejected(b"!027018\r", Fault.ADDRESS, "")), FindingKind.FRAME),
        ((Late(b">+1.000\r"),), FindingKind.FRAME),
        ((Noise(READ_INPUT, Fault.LEADING),), FindingKind.OTHER_PROTOCOL),
    ],
)
def test_what_is_received_in_place_of_a_dcon_response_has_a_name(others: Any, expected: FindingKind) -> None:
    assert heard(Protocol.DCON, *others) is expected


def test_a_frame_without_its_checksum_is_told_from_noise() -> None:
    assert heard(Protocol.DCON, Noise(b"?01\r", Fault.CHECKSUM), checksum=True) is FindingKind.WRONG_CHECKSUM


@pytest.mark.parametrize(
    ("others", "expected"),
    [
        ((), FindingKind.NOTHING),
        ((Noise(b"\xf0\x00", Fault.ADDRESS),), FindingKind.NOISE),
        ((Noise(READ_INPUT, Fault.CRC),), FindingKind.ECHO),
        ((Noise(b"\x01\x04\x02\x00", Fault.CRC),), FindingKind.WRONG_CHECKSUM),
        ((Noise(b"\x01\x84\x02\x00\x00", Fault.CRC),), FindingKind.WRONG_CHECKSUM),
        ((Noise(b"\x01\x03\x02\x00\x00", Fault.CRC),), FindingKind.NOISE),
        ((Noise(b"\x00!017018\r", Fault.ADDRESS),), FindingKind.OTHER_PROTOCOL),
        ((Rejected(b"\x02\x04\x02\x00\x00\xfd\x30", Fault.ADDRESS, ""),), FindingKind.FRAME),
    ],
)
def test_what_is_received_in_place_of_a_modbus_response_has_a_name(others: Any, expected: FindingKind) -> None:
    assert heard(Protocol.MODBUS_RTU, *others) is expected


@pytest.mark.parametrize("named", [refused, lambda _: None])
def test_a_refusal_proves_a_device_whose_name_is_not_known(named: Any) -> None:
    outcomes = {modbus.ReadInputRegisters: refused, modbus.ReadModuleName: named}

    scanned, steps = run(scan([FAST], [0x01], [Protocol.MODBUS_RTU]), outcomes)

    (finding,) = scanned.devices
    assert (finding.heard, finding.name, finding.models) == (FindingKind.REFUSAL, None, ())
    assert finding.reason == "function 04 of address 0 is refused: exception 01, illegal function"
    assert commands(steps) == [INPUT, modbus.ReadModuleName(0x01)]


def test_a_module_that_refuses_its_name_is_found() -> None:
    scanned, _ = run(scan([FAST], [0x01], [Protocol.DCON], [False]), {dcon.ReadModuleName: refused})

    (finding,) = scanned.devices
    assert (finding.heard, finding.name, finding.reason) == (FindingKind.REFUSAL, None, "$01M is refused")


def test_a_finding_that_is_no_device_is_not_among_the_devices() -> None:
    finding = Finding(Place(FAST, 0x01), FindingKind.NOISE, TimedOut(NAME))
    device = Finding(Place(FAST, 0x01), FindingKind.ANSWER, Answered(NAME, dcon.ModuleName(0x01, "7018")))

    assert Scanned((finding, device), 2).devices == (device,)


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        ({"lines": [LineSettings(0x2A)]}, InvalidValueError),
        ({"lines": [9600]}, ArgumentError),
        ({"addresses": [0x100]}, EncodeError),
        ({"addresses": ["01"]}, ArgumentError),
        ({"protocols": ["dcon"]}, ArgumentError),
        ({"checksums": [1]}, ArgumentError),
        ({"policy": 1}, ArgumentError),
    ],
)
@pytest.mark.parametrize("function", [scan, scan_time])
def test_invalid_arguments_are_refused_at_the_call(
    function: Any, arguments: dict[str, Any], error: type[Exception]
) -> None:
    with pytest.raises(error):
        function(**{"lines": [FACTORY]} | arguments)
