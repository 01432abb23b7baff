"""The compiler of syntax statements."""

from inspect import signature

import pytest
from attrs import fields, frozen

from i7000 import (
    BaudRate,
    CharacterFormat,
    CjcUpdate,
    DataFormat,
    DecodeError,
    EncodeError,
    Fault,
    LineSettings,
    Model,
    Profile,
    Protocol,
    ReportSettings,
    TypeCode,
    dcon,
)
from i7000.dcon import parts


def test_a_field_without_its_notation_in_the_syntax_is_a_slip_of_ours() -> None:
    @frozen
    class Slip(dcon.Command[dcon.Acknowledged]):
        syntax = "$AA9"
        section = "2.18"

        offset: parts.Offset

    with pytest.raises(TypeError, match=r"Slip: '\$AA9' has no 'SNNNN'"):
        _ = Slip.layout


@pytest.mark.parametrize("data", ["0031.2+", "+0031,2", "+003a.2", "*0031.2"])
def test_a_temperature_is_a_sign_and_five_digits_with_a_point(data: str) -> None:
    with pytest.raises(DecodeError) as caught:
        dcon.decode_response(f">{data}\r".encode(), dcon.ReadCjcTemperature(0x01), Profile(Model.I_7018))

    assert (caught.value.fault, caught.value.offset) == (Fault.NUMBER, 1)


def test_a_name_with_a_leading_character_is_refused() -> None:
    with pytest.raises(DecodeError) as caught:
        dcon.decode_response(b"!0170#18\r", dcon.ReadModuleName(0x01), Profile(Model.I_7018))

    assert caught.value.fault is Fault.CHARACTER


@pytest.mark.parametrize(
    ("digits", "fault", "offset"),
    [
        ("+-000", Fault.CHARACTER, 1),
        ("+000+", Fault.CHARACTER, 4),
        ("-0_10", Fault.CHARACTER, 2),
        ("+ 010", Fault.CHARACTER, 1),
        ("+00g0", Fault.CHARACTER, 3),
        ("00+10", Fault.NUMBER, 0),
    ],
)
def test_an_offset_is_a_sign_and_four_digits(digits: str, fault: Fault, offset: int) -> None:
    profile = Profile(Model.I_7018)
    with pytest.raises(DecodeError) as in_command:
        dcon.decode_command(f"$019{digits}\r".encode(), profile)
    with pytest.raises(DecodeError) as in_response:
        dcon.decode_response(f"!01{digits}\r".encode(), dcon.ReadCjcOffset(0x01), profile)

    assert (fault, len("$019") + offset) == (in_command.value.fault, in_command.value.offset)
    assert (fault, len("!01") + offset) == (in_response.value.fault, in_response.value.offset)


def test_a_calibrated_channel_has_one_digit_in_every_mode() -> None:
    profile = Profile(Model.M_7017Z, single_ended=True)

    assert dcon.encode(dcon.CalibrateChannelZero(0x01, 5), profile, force=True) == b"$010C5\r"


def test_a_calibrated_channel_of_two_digits_is_refused() -> None:
    with pytest.raises(EncodeError, match=r"channel cannot be 16: 0\.\.F"):
        dcon.CalibrateCurrentChannelSpan(0x01, 16)


LINE, REPORT = LineSettings(BaudRate.BAUD_9600, CharacterFormat.E81), ReportSettings(DataFormat.HEX, checksum=True)


@pytest.mark.parametrize(
    ("message", "words"),
    [
        (
            dcon.SetConfiguration(0x01, 0x1A, TypeCode.K, LINE, REPORT),
            {
                "new_address": "1Ah (26)",
                "type_code": "0F, thermocouple K, -270..1372 degC",
                "line_settings": "86, 9600 baud, E81",
                "report_settings": "42, hex, checksum, normal mode, 60 Hz rejected",
            },
        ),
        (
            dcon.SetConfiguration(0x01, 0x01, 0x20, LineSettings(0x3F), ReportSettings(3, reserved=5)),
            {
                "new_address": "01",
                "type_code": "20, not defined",
                "line_settings": "3F, baud rate code 3F not defined, N81",
                "report_settings": "17, data format 3 not defined, no checksum, normal mode, 60 Hz rejected, "
                "reserved bits 101",
            },
        ),
        (dcon.ReadAnalogInput(0x01, 12), {"channel": "12"}),
        (dcon.SetChannelMask(0x01, 0x0A), {"mask": "0A, channels 1, 3"}),
        (dcon.Diagnostics(0x01, 0x04), {"mask": "04, channel 2"}),
        (dcon.SetCjcOffset(0x01, -50), {"offset": "-0.50 degC"}),
        (dcon.CjcOffset(0x01, 0x1000), {"offset": "+40.96 degC"}),
        (dcon.CjcTemperature(25.4), {"temperature": "+25.4 degC"}),
        (dcon.SetCjcUpdate(0x01, CjcUpdate.ONCE), {"update": "once"}),
        (
            dcon.ProtocolSetting(0x01, Protocol.MODBUS_RTU, modbus_supported=True),
            {"protocol": "modbus_rtu", "modbus_supported": "yes"},
        ),
        (dcon.SetSoftInitTimeout(0x01, 16), {"timeout": "16 s"}),
        (dcon.SetHostWatchdogTimeout(0x01, 3, enabled=False), {"timeout": "0.3 s", "enabled": "no"}),
        (dcon.HostWatchdogStatus(0x01, 0x84), {"status": "84, enabled, timed out"}),
        (dcon.HostWatchdogStatus(0x01, 0x00), {"status": "00, disabled, not timed out"}),
        (dcon.FirmwareVersion(0x01, "B3.7"), {"version": "'B3.7'"}),
        (dcon.ModuleName(0x01, "7018 "), {"name": "'7018 '"}),
        (dcon.HostOk(), {}),
    ],
    ids=lambda it: type(it).__name__ if isinstance(it, dcon.Message) else "",
)
def test_a_message_describes_its_fields(message: dcon.Message, words: dict[str, str]) -> None:
    described = message.describe()

    assert {"address": "01"} | words == {"address": "01"} | described


@pytest.mark.parametrize(
    ("kind", "name", "unit", "scale"),
    [
        (dcon.SetCjcOffset, "offset", "degC", 0.01),
        (dcon.CjcOffset, "offset", "degC", 0.01),
        (dcon.CjcTemperature, "temperature", "degC", 1),
        (dcon.SetHostWatchdogTimeout, "timeout", "s", 0.1),
        (dcon.HostWatchdogTimeout, "timeout", "s", 0.1),
        (dcon.SetSoftInitTimeout, "timeout", "s", 1),
        (dcon.SetChannelMask, "mask", None, 1),
    ],
)
def test_a_quantity_has_a_unit_and_the_size_of_a_count(
    kind: type[dcon.Message], name: str, unit: str | None, scale: float
) -> None:
    part = getattr(fields(kind), name).type.__metadata__[0]  # type: ignore[arg-type] # an attrs class

    assert (unit, scale) == (part.unit, part.scale)


def test_help_shows_the_notation_and_the_values_of_a_field() -> None:
    shown = str(signature(dcon.SetHostWatchdogTimeout)).replace("typing.", "")  # which Python 3.12 does not show

    assert "address: Annotated[int, <AA: 00..FF>]" in shown
    assert "enabled: Annotated[bool, <E: bool: 0 (False) 1 (True)>]" in shown
