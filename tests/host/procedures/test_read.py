"""Reading all channels: of every model in every format by both protocols, and what prevents it."""

from itertools import product
from typing import Any

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from i7000 import (
    ArgumentError,
    DataFormat,
    EncodeError,
    Fault,
    ModbusDataFormat,
    Model,
    Profile,
    Protocol,
    Reading,
    ReportSettings,
    Status,
    TypeCode,
    Unit,
    dcon,
    modbus,
)
from i7000.device import Eeprom, Signal, Signals, factory, power_on
from i7000.host import Answered, Declined, Late, Policy, Rejected, TimedOut
from i7000.host.procedures import Report, Result, read
from i7000.simulator.faults import Faults
from tests.host.procedures.lines import faults
from tests.host.procedures.runner import Runner
from tests.host.procedures.scripted import commands, refused, run, unanswered

PATIENT = Policy(retries=2, turnaround=0.2, grace=0.4)
ENABLED = 0b10101
"""Channels 0, 2 and 4: the others are disabled."""

MODULES = [
    evolve(
        factory(model),
        protocol=Protocol.DCON,
        report_settings=ReportSettings(data_format, checksum=checksum),
        channel_mask=ENABLED,
    )
    for model, data_format, checksum in product(Model, DataFormat, (False, True))
] + [
    evolve(factory(model), modbus_data_format=modbus_format, channel_mask=ENABLED)
    for model, modbus_format in product(Model, ModbusDataFormat)
    if Protocol.MODBUS_RTU in model.protocols
]


def signals_of(eeprom: Eeprom) -> Signals:
    """Return a signal for each channel: another part of its span, above 0 for a model that has no sign."""
    first = 0.5 if eeprom.model is Model.M_7017RMS else 0.1
    parts = [first + 0.04 * channel for channel in range(len(eeprom.type_codes))]
    return Signals(
        tuple(
            Signal(code.minimum + (code.maximum - code.minimum) * part, code.unit)
            for code, part in zip(eeprom.type_codes, parts, strict=True)
        )
    )


def is_true(report: Report, eeprom: Eeprom) -> bool:
    """Return whether readings are those of the signals, as far as their formats are exact."""
    assert report.readings is not None
    profile = power_on(eeprom, now=0.0).profile
    true = signals_of(eeprom).channels[: profile.channels]
    for channel, (reading, signal, code) in enumerate(zip(report.readings, true, profile.type_codes, strict=True)):
        assert signal is not None
        if not eeprom.channel_mask >> channel & 1:
            if reading != Reading(None, code.unit, Status.DISABLED):
                return False
        elif reading is None or reading.value is None or abs(reading.value - signal.value) > code.full_scale / 1000:
            return False
    return True


def name_of(eeprom: Eeprom) -> str:
    if eeprom.protocol is Protocol.MODBUS_RTU:
        return f"{eeprom.model.value}-modbus-{eeprom.modbus_data_format.name.lower()}"
    return f"{eeprom.model.value}-dcon-{eeprom.report_settings.byte:02X}"


@pytest.mark.parametrize("eeprom", MODULES, ids=name_of)
def test_every_model_is_read_in_every_format_and_disabled_channels_are_no_numbers(eeprom: Eeprom) -> None:
    runner = Runner.on(eeprom, signals=(signals_of(eeprom),))

    report = runner.run(read(0x01, runner.modules[0].profile, protocol=eeprom.protocol))

    assert is_true(report, eeprom)
    assert (report.faults, report.unknown) == ((), ())
    assert len(runner.asked) <= 2


def test_twenty_single_ended_channels_are_read() -> None:
    eeprom = evolve(factory(Model.M_7017Z), single_ended=True, channel_mask=ENABLED)
    runner = Runner.on(eeprom, signals=(signals_of(eeprom),))

    report = runner.run(read(0x01, runner.modules[0].profile, protocol=Protocol.MODBUS_RTU))

    assert report.readings is not None
    assert (len(report.readings), report.mask) == (20, ENABLED)
    assert is_true(report, eeprom)


SEALED = [it for it in MODULES if it.report_settings.checksum or it.protocol is Protocol.MODBUS_RTU]


@given(st.sampled_from(SEALED), faults(), st.integers(0, 2**32))
def test_what_is_read_on_a_bad_line_is_so_or_said_to_be_unknown(eeprom: Eeprom, bad: Faults, seed: int) -> None:
    runner = Runner.on(eeprom, signals=(signals_of(eeprom),), policy=PATIENT, faults=bad, seed=seed)

    report = runner.run(read(0x01, runner.modules[0].profile, protocol=eeprom.protocol))

    assert len(runner.asked) <= 2
    if report.readings is None:
        assert report.reason
    elif not report.unknown:
        assert is_true(report, eeprom)
    else:
        assert is_true(evolve(report, readings=_masked(report.readings, eeprom)), eeprom)


def _masked(readings: tuple[Reading | None, ...], eeprom: Eeprom) -> tuple[Reading | None, ...]:
    """Return readings as they are with the mask, of which nobody knows here."""
    codes = eeprom.type_codes
    return tuple(
        it if ENABLED >> channel & 1 else Reading(None, codes[channel].unit, Status.DISABLED)
        for channel, it in enumerate(readings)
    )


# --- hand-written outcomes --------------------------------------------------------------------------------------------

I7018 = Profile(Model.I_7018, type_codes=(TypeCode.K,) * 8)
M7018 = Profile(Model.M_7018, type_codes=(TypeCode.K,) * 8)
MIXED = (TypeCode.V_10, *(TypeCode.K,) * 7)
ON = Reading(20.0, Unit.CELSIUS)
OFF = Reading(None, Unit.CELSIUS, Status.DISABLED)


def sent(*values: str) -> Any:
    return {dcon.ReadAnalogInputs: lambda _: dcon.AnalogInputs(values)}


MASK = {dcon.ReadChannelMask: lambda it: dcon.ChannelMask(it.address, 0xFE)}


def test_a_field_that_cannot_be_decoded_does_not_hide_the_others() -> None:
    values = ("+0020.0", "+020.00", *["+0020.0"] * 6)

    report, _ = run(read(0x01, I7018, mask=0xFF), sent(*values))

    assert report.readings == (ON, None, *(ON,) * 6)
    assert [(fault.channel, fault.error.fault) for fault in report.faults] == [(1, Fault.NUMBER)]
    assert "type 0F (K) sends" in str(report.faults[0].error)


def test_a_disabled_channel_has_no_fault() -> None:
    report, _ = run(read(0x01, I7018), sent("+000.00", *["+0020.0"] * 7) | MASK)

    assert (report.readings, report.faults, report.mask) == ((OFF, *(ON,) * 7), (), 0xFE)


def test_without_the_mask_the_readings_are_those_that_were_sent() -> None:
    report, _ = run(read(0x01, I7018), sent(*["+0020.0"] * 8))

    assert (report.readings, report.mask) == ((ON,) * 8, None)
    assert [(it.name, it.reason, it.outcome) for it in report.unknown] == [
        ("mask", "no answer to $016", TimedOut(dcon.ReadChannelMask(0x01)))
    ]


def test_a_mask_that_is_given_is_not_asked_for() -> None:
    report, steps = run(read(0x01, I7018, mask=0x01), sent(*["+0020.0"] * 8))

    assert report.readings == (ON, *(OFF,) * 7)
    assert commands(steps) == [dcon.ReadAnalogInputs(0x01)]


def test_the_blanks_of_the_7019_series_show_its_disabled_channels() -> None:
    profile = Profile(Model.I_7019R, type_codes=(TypeCode.K,) * 8)

    report, steps = run(read(0x01, profile), sent(" " * 7, *["+0020.0"] * 7))

    assert report.readings == (OFF, *(ON,) * 7)
    assert commands(steps) == [dcon.ReadAnalogInputs(0x01)]


@pytest.mark.parametrize("protocol", Protocol)
@pytest.mark.parametrize("mask", [None, 0xFE])
def test_without_types_nothing_can_be_decoded(protocol: Protocol, mask: int | None) -> None:
    profile = Profile(Model.M_7018, type_codes=())
    words = {modbus.ReadInputRegisters: lambda it: modbus.InputRegisters(it.address, (200,) * it.count)}
    mask_by_modbus = {modbus.ReadChannelMask: lambda it: modbus.ChannelMask(it.address, 0xFE)}

    report, _ = run(
        read(0x01, profile, protocol=protocol, mask=mask), sent(*["+0020.0"] * 8) | words | MASK | mask_by_modbus
    )

    assert isinstance(report.outcome, Answered)
    assert (report.readings, report.mask) == (None, 0xFE)
    assert [fault.channel for fault in report.faults] == [None]
    assert report.reason == str(report.faults[0].error)
    assert "type" in report.reason


@pytest.mark.parametrize(
    ("protocol", "answer", "reason"),
    [
        (Protocol.DCON, unanswered, "no answer to #01"),
        (Protocol.DCON, refused, "#01 is refused"),
        (Protocol.MODBUS_RTU, unanswered, "no answer to function 04 of address 0"),
        (Protocol.MODBUS_RTU, refused, "function 04 of address 0 is refused: exception 01, illegal function"),
    ],
)
def test_the_outcome_that_prevents_a_reading_is_returned(protocol: Protocol, answer: Any, reason: str) -> None:
    outcomes = {dcon.ReadAnalogInputs: answer, modbus.ReadInputRegisters: answer}

    report, _ = run(read(0x01, M7018, protocol=protocol, mask=0x0F), outcomes)

    assert (report.readings, report.reason, report.mask) == (None, reason, 0x0F)
    assert isinstance(report.outcome, TimedOut if answer is unanswered else Declined)


@pytest.mark.parametrize("protocol", Protocol)
def test_an_answer_that_is_not_a_response_is_no_silence(protocol: Protocol) -> None:
    def answer(command: Any) -> Result[Any]:
        return Result(TimedOut(command), (Rejected(b">garbage\r", Fault.LENGTH, "too short"), Late(b"!01\r")))

    report, _ = run(
        read(0x01, M7018, protocol=protocol, mask=0x0F),
        {dcon.ReadAnalogInputs: answer, modbus.ReadInputRegisters: answer},
    )

    assert report.rejected
    assert report.reason.endswith(r"is not understood: >garbage\r")


def test_the_mask_is_read_by_modbus_too() -> None:
    outcomes = {
        modbus.ReadInputRegisters: lambda it: modbus.InputRegisters(it.address, (200,) * it.count),
        modbus.ReadChannelMask: lambda it: modbus.ChannelMask(it.address, 0xFE),
    }
    profile = evolve(M7018, modbus_data_format=ModbusDataFormat.ENGINEERING)

    report, _ = run(read(0x01, profile, protocol=Protocol.MODBUS_RTU), outcomes)

    assert report.readings == (OFF, *(ON,) * 7)


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        ({"address": 0x100}, EncodeError),
        ({"address": 0xF8, "profile": M7018, "protocol": Protocol.MODBUS_RTU}, EncodeError),
        ({"protocol": Protocol.MODBUS_RTU}, EncodeError),
        ({"mask": 0x100}, EncodeError),
        ({"mask": "FF"}, ArgumentError),
        ({"profile": Model.I_7018}, ArgumentError),
        ({"protocol": "dcon"}, ArgumentError),
        ({"policy": 1}, ArgumentError),
    ],
)
def test_invalid_arguments_are_refused_at_the_call(arguments: dict[str, Any], error: type[Exception]) -> None:
    sound: dict[str, Any] = {"address": 0x01, "profile": I7018}

    with pytest.raises(error):
        read(**sound | arguments)
