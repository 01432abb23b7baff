"""The fields of Modbus messages: in words, and as `help` shows them."""

from inspect import signature

import pytest

from i7000 import CjcUpdate, Firmware, LineSettings, Protocol, TypeCode, modbus


@pytest.mark.parametrize(
    ("message", "words"),
    [
        (modbus.ReadCoils(1, 256, 3), {"start": "256", "count": "3"}),
        (modbus.WriteSingleCoil(1, 256, value=True), {"coil": "256", "value": "yes"}),
        (modbus.Coils(1, (True, False)), {"values": "1 0"}),
        (modbus.InputRegisters(1, (0x1234, 5)), {"values": "1234 0005"}),
        (modbus.ExceptionResponse(1, 0x46, 2), {"function": "46", "exception_code": "02, illegal data address"}),
        (modbus.ExceptionResponse(1, 0x03, 7), {"function": "03", "exception_code": "07, not defined"}),
        (modbus.ModuleName(1, bytes.fromhex("00701900")), {"name": "00701900, M-7019 series"}),
        (modbus.ModuleName(1, bytes.fromhex("00701952")), {"name": "00701952"}),
        (modbus.SetModuleAddress(1, 26), {"new_address": "1Ah (26)"}),
        (modbus.ModuleAddressResult(1, 0), {"result": "00, done"}),
        (modbus.CommunicationSettingsResult(1, 0, 1), {"line_result": "00, done", "protocol_result": "01, not done"}),
        (
            modbus.SetCommunicationSettings(1, LineSettings(), Protocol.DCON),
            {"line_settings": "06, 9600 baud, N81", "protocol": "dcon"},
        ),
        (modbus.SetTypeCode(1, 7, TypeCode.V_10), {"channel": "7", "type_code": "08, -10..10 V"}),
        (modbus.FirmwareVersion(1, 0x0B, 3, 7), {"major": "11", "minor": "3", "build": "7"}),
        (modbus.ChannelMask(1, 0x05), {"mask": "05, channels 0, 2"}),
        (modbus.MiscellaneousSettings(1, 0xA0), {"settings": "A0, 50 Hz rejected, fast mode"}),
        (modbus.MiscellaneousSettings(1, 0x41), {"settings": "41, 60 Hz rejected, normal mode, reserved bits 41"}),
        (modbus.ReadCjcOffset(1, 0), {"channel": "00, the module"}),
        (modbus.ReadCjcOffset(1, 0x83), {"channel": "83, channel 3"}),
        (modbus.SetCjcOffset(1, 0x7F, 0xFF), {"channel": "7F, not defined", "offset": "-0.1 degC"}),
        (modbus.SetCjcOffset(1, 0, -50), {"channel": "00, the module", "offset": "-0.50 degC"}),
        (modbus.CjcOffset(1, -50), {"offset": "-50, -0.50 degC if it is the module's"}),
        (modbus.CjcEnabled(1, enabled=True), {"enabled": "yes"}),
        (modbus.SetCjcUpdate(1, CjcUpdate.STARTED), {"update": "started"}),
    ],
    ids=lambda it: type(it).__name__ if isinstance(it, modbus.Message) else "",
)
def test_a_message_describes_its_fields(message: modbus.Message, words: dict[str, str]) -> None:
    assert {"address": "01"} | words == message.describe()


@pytest.mark.parametrize(("channel", "words"), [(0, "+0.10 degC"), (0x81, "+1.0 degC")])
def test_an_offset_is_described_in_the_unit_of_what_was_asked_for(channel: int, words: str) -> None:
    assert modbus.CjcOffset(1, 10).describe(modbus.ReadCjcOffset(1, channel))["offset"] == words


@pytest.mark.parametrize(
    ("version", "firmware"),
    [
        ((0x0B, 4, 5), Firmware("B4.5")),
        ((0x23, 9, 99), Firmware("Z9.99")),
        ((0x0A, 0, 0), Firmware("A0.0")),
        ((0x09, 4, 5), None),
        ((0x24, 4, 5), None),
        ((0x0B, 10, 5), None),
        ((0x0B, 4, 100), None),
    ],
)
def test_three_bytes_are_a_firmware_version_or_invalid(
    version: tuple[int, int, int], firmware: Firmware | None
) -> None:
    told = modbus.FirmwareVersion(1, *version).firmware

    assert firmware == told
    assert told is None or bytes(told) == bytes(version)


@pytest.mark.parametrize(("name", "series"), [("00701700", "7017"), ("00701900", "7019"), ("00701952", None)])
def test_four_bytes_are_the_name_of_a_series_or_unknown(name: str, series: str | None) -> None:
    assert modbus.ModuleName(1, bytes.fromhex(name)).series == series


def test_help_shows_the_values_of_a_field() -> None:
    shown = str(signature(modbus.SetCjcUpdate)).replace("typing.", "")  # which Python 3.12 does not show

    assert "address: Annotated[int, <0..247>]" in shown
