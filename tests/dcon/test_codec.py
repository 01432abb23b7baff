"""What `encode` and the decoders refuse, and how they say it; helpers for drivers."""

from collections.abc import Callable
from typing import Any

import pytest
from attrs import evolve

from i7000 import (
    ArgumentError,
    BaudRate,
    CharacterFormat,
    CjcUpdate,
    DataFormat,
    DecodeError,
    EncodeError,
    Fault,
    Filter,
    Firmware,
    LineSettings,
    Model,
    Profile,
    Protocol,
    ReportSettings,
    TypeCode,
    dcon,
)

I_7017 = Profile(Model.I_7017)
M_7018 = Profile(Model.M_7018)
M_7019R = Profile(Model.M_7019R)


def configuration(
    line: LineSettings | None = None, report: ReportSettings | None = None, **values: Any
) -> dcon.SetConfiguration:
    command = dcon.SetConfiguration(0x01, 0x01, TypeCode.V_10, line or LineSettings(), report or ReportSettings())
    return evolve(command, **values)


@pytest.mark.parametrize(
    ("message", "profile", "said"),
    [
        (
            dcon.SetCjcUpdate(0x01, CjcUpdate.STOPPED),
            M_7018,
            "M-7018 has no CJC update setting: 7019 series only, manual 2.21",
        ),
        (
            dcon.SetChannelTypeCode(0x01, 0, TypeCode.V_10),
            Profile(Model.M_7017R, firmware=Firmware("B3.8")),
            r"M-7017R with firmware B3\.8 has no type code of a channel: .*M-7017R from B3\.9.*, manual 2\.15",
        ),
        (dcon.ReadAnalogInput(0x01, 8), I_7017, r"channel cannot be 8: 0\.\.7 on I-7017, manual 2\.4"),
        (
            dcon.SetChannelTypeCode(0x01, 0, 0x30),
            M_7019R,
            "type_code cannot be '30': MV_15 MV_50 .* on M-7019R, manual 2.15",
        ),
        (dcon.ReadChannelTypeCode(0x01, 8), M_7019R, "channel cannot be 8"),
        (dcon.CalibrateChannelZero(0x01, 8), M_7019R, "channel cannot be 8"),
        (dcon.CalibrateChannelSpan(0x01, 8), M_7019R, "channel cannot be 8"),
        (dcon.SetChannelMask(0x01, 0x100), I_7017, r"I-7017 has no channel 8: 0\.\.7"),
        (dcon.ChannelMask(0x01, 0x400), Profile(Model.M_7019Z), r"M-7019Z has no channel 10: 0\.\.9"),
        (dcon.Diagnostics(0x01, 0x100), M_7019R, "M-7019R has no channel 8"),
        (dcon.SetCjcOffset(0x01, 0x1001), M_7018, r"offset cannot be 4097: -4096\.\.\+4096 counts"),
        (dcon.CjcOffset(0x01, -0x1001), M_7018, "offset cannot be -4097"),
        (dcon.SetSoftInitTimeout(0x01, 61), M_7019R, r"timeout cannot be 61: 0\.\.60 s"),
        (configuration(type_code=0x00), I_7017, "type_code cannot be 'MV_15'"),
        (configuration(type_code=0xFF), I_7017, "type_code cannot be 'FF'"),
        (configuration(LineSettings(0x0B)), I_7017, r"baud_rate cannot be '0B': 03\.\.0A"),
        (
            configuration(LineSettings(BaudRate.BAUD_9600, CharacterFormat.E81)),
            Profile(Model.I_7017, firmware=Firmware("B2.5")),
            "character_format cannot be 'E81': N81 with firmware before B2.6",
        ),
        (configuration(None, ReportSettings(3)), I_7017, r"data_format cannot be 3: 0\.\.2"),
        (configuration(None, ReportSettings(reserved=1)), I_7017, "reserved cannot be 1: 0"),
        (
            configuration(None, ReportSettings(fast_mode=True)),
            I_7017,
            "fast_mode cannot be True: I-7017 has no fast mode",
        ),
        (
            configuration(None, ReportSettings(filter=Filter.REJECT_50_HZ)),
            Profile(Model.M_7019R, firmware=Firmware("B2.6"), type_codes=()),
            "filter cannot be 'REJECT_50_HZ'",
        ),
        (dcon.AnalogInputs(("+00.000",) * 7), I_7017, "values cannot be .*: 8 engineering fields on I-7017"),
        (dcon.AnalogInputs(("4C53",) * 8), I_7017, "values cannot be"),
        (dcon.AnalogInputsHex(("+00.000",) * 8), I_7017, "8 hex fields"),
        (dcon.SynchronizedData(0x01, ("4C53",) * 8, first_reading=True), M_7019R, "values cannot be"),
        (dcon.AnalogInput("4C53"), I_7017, "value cannot be '4C53': one engineering field"),
    ],
    ids=lambda value: type(value).__name__ if isinstance(value, dcon.Message) else "",
)
def test_what_a_module_does_not_take_is_refused_with_the_reason(message: Any, profile: Profile, said: str) -> None:
    with pytest.raises(EncodeError, match=said):
        dcon.encode(message, profile)


@pytest.mark.parametrize("message", [dcon.ReadAnalogInput(0x01, 16), dcon.SetChannelMask(0x01, 0x100)], ids=repr)
def test_what_has_more_digits_than_the_module_reads_cannot_be_forced(message: Any) -> None:
    with pytest.raises(EncodeError, match="hex digit"):
        dcon.encode(message, I_7017, force=True)


def test_what_a_module_ignores_may_be_anything() -> None:
    profile = Profile(Model.M_7017Z)

    assert dcon.encode(configuration(type_code=0x00), profile)[:7] == b"%010100"


def test_mixed_types_are_announced_by_ff_where_they_are_possible() -> None:
    assert dcon.encode(configuration(type_code=0xFF), Profile(Model.M_7017R)) == b"%0101FF0600\r"


@pytest.mark.parametrize(
    ("kind", "values", "field"),
    [
        (dcon.ReadConfiguration, (256,), "address"),
        (dcon.ReadConfiguration, (-1,), "address"),
        (dcon.ReadConfiguration, (True,), "address"),
        (dcon.ReadConfiguration, ("01",), "address"),
        (dcon.ReadAnalogInput, (1, 256), "channel"),
        (dcon.SetChannelMask, (1, 1 << 24), "mask"),
        (dcon.SetCjcOffset, (1, 0x10000), "offset"),
        (dcon.SetModuleName, (1, ""), "name"),
        (dcon.SetModuleName, (1, "7019ABC"), "name"),
        (dcon.SetModuleName, (1, "é"), "name"),
        (dcon.SetModuleName, (1, "a#b"), "name"),
        (dcon.SetModuleName, (1, b"7019"), "name"),
        (dcon.ModuleName, (1, "7018ABC"), "name"),
        (dcon.ModuleName, (1, "0506"), "name"),
        (dcon.FirmwareVersion, (1, "B305"), "version"),
        (dcon.FirmwareVersion, (1, ""), "version"),
        (dcon.SetProtocol, (1, 1), "protocol"),
        (dcon.SetCjcUpdate, (1, 3), "update"),
        (dcon.CjcTemperature, (float("nan"),), "temperature"),
        (dcon.CjcTemperature, (float("inf"),), "temperature"),
        (dcon.CjcTemperature, (31.25,), "temperature"),
        (dcon.CjcTemperature, (10000.0,), "temperature"),
        (dcon.CjcTemperature, (True,), "temperature"),
        (dcon.CjcTemperature, ("31.2",), "temperature"),
        (dcon.AnalogInputs, ((),), "values"),
        (dcon.AnalogInputs, (["+00.000"],), "values"),
        (dcon.AnalogInputs, (("+00.000", "4C53"),), "values"),
        (dcon.AnalogInputs, (("nan    ",),), "values"),
        (dcon.AnalogInputs, ((1.0,),), "values"),
        (dcon.AnalogInput, ("1e5",), "value"),
        (dcon.AnalogInput, (None,), "value"),
        (dcon.SetConfiguration, (1, 1, 8, 6, ReportSettings()), "line_settings"),
    ],
)
def test_a_message_that_has_no_wire_form_cannot_be_made(kind: Any, values: Any, field: str) -> None:
    with pytest.raises(EncodeError) as caught:
        kind(*values)

    assert field == caught.value.field


def test_a_flag_is_true_or_false() -> None:
    with pytest.raises(EncodeError, match=r"enabled cannot be 1: bool: 0 \(False\) 1 \(True\)"):
        dcon.SetCjcEnabled(0x01, enabled=1)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("frame", "fault", "offset"),
    [
        (b"", Fault.LENGTH, 0),
        (b"\r", Fault.LEADING, 0),
        (b"$\r", Fault.LENGTH, 1),
        (b"$01\r", Fault.LENGTH, 3),
        (b"$012", Fault.TERMINATOR, 4),
        (b"$0\r12\r", Fault.TERMINATOR, 2),
        (b"$01\xff\r", Fault.CHARACTER, 3),
        (b"$01\n\r", Fault.CHARACTER, 3),
        (b"!01\r", Fault.LEADING, 0),
        (b"x012\r", Fault.LEADING, 0),
        (b"$0a2\r", Fault.CHARACTER, 2),
        (b"$019+00a0\r", Fault.CHARACTER, 7),
        (b"$01900100\r", Fault.NUMBER, 4),
        (b"~01Oab!\r", Fault.CHARACTER, 6),
        (b"~01\r", Fault.LENGTH, 3),
        (b"#**\r", Fault.UNSUPPORTED, 1),
        (b"$012x\r", Fault.LENGTH, 4),
        (b"$01z\r", Fault.COMMAND, 3),
        (b"~01C2\r", Fault.VALUE, 4),
        (b"$01A1\r", Fault.UNSUPPORTED, 3),
        (b"$017X0R03\r", Fault.CHARACTER, 4),
        (b"#*\r", Fault.LENGTH, 2),
        (b"~*\r", Fault.LENGTH, 2),
        (b"x" * 1_000_000, Fault.LENGTH, 256),
        (b"$" * 256 + b"\r", Fault.LENGTH, 256),
        (b"~0aOABCDEFG\r", Fault.LENGTH, 10),
    ],
    ids=lambda value: repr(value)[:20],
)
def test_an_invalid_command_frame_raises_the_fault_and_its_place(frame: bytes, fault: Fault, offset: int) -> None:
    profile = Profile(Model.M_7018R)

    with pytest.raises(DecodeError) as caught:
        dcon.decode_command(frame, profile)

    assert (fault, offset, frame) == (caught.value.fault, caught.value.offset, caught.value.wire)


def test_the_error_for_a_wrong_checksum_has_the_right_one() -> None:
    with pytest.raises(DecodeError, match=r"checksum at byte 4 of .*allowed: B7") as caught:
        dcon.decode_command(b"$012B6\r", evolve(I_7017, checksum=True))

    assert Fault.CHECKSUM is caught.value.fault


def test_the_letter_o_and_the_digit_0_are_two_commands() -> None:
    assert dcon.ReadOpenWireDetection(0x01) == dcon.decode_command(b"~01EO\r", M_7019R)
    assert dcon.SetCalibrationEnabled(0x01, enabled=False) == dcon.decode_command(b"~01E0\r", M_7019R)


def test_the_channel_that_was_asked_for_must_be_answered() -> None:
    with pytest.raises(DecodeError, match="value in channel at byte 4"):
        dcon.decode_response(b"!01C1R05\r", dcon.ReadChannelTypeCode(0x01, 0), M_7019R)


def test_a_configuration_is_changed_in_one_place_and_written_back() -> None:
    told = dcon.decode_response(b"!018A46C2\r", dcon.ReadConfiguration(0x01), I_7017)
    assert isinstance(told, dcon.Configuration)

    command = told.command(report_settings=evolve(told.report_settings, data_format=DataFormat.PERCENT))

    assert dcon.encode(command, I_7017, force=True) == b"%01018A46C1\r"


def test_masks_and_channels_are_two_writings_of_one_thing() -> None:
    assert {0, 19} == dcon.channels_of(0x80001)
    assert dcon.mask_of([0, 19, 0]) == 0x80001
    for channel in (20, -1, "1", 1.0):
        with pytest.raises(EncodeError, match=r"channel cannot be .*: 0\.\.19"):
            dcon.mask_of({channel})  # type: ignore[arg-type]


def test_a_negative_mask_has_no_channels() -> None:
    with pytest.raises(EncodeError, match="mask cannot be -1"):
        dcon.channels_of(-1)


@pytest.mark.parametrize(
    ("command", "profile", "length"),
    [
        (dcon.HostOk(), I_7017, 0),
        (dcon.ReadConfiguration(0x01), I_7017, 10),
        (dcon.ReadConfiguration(0x01), evolve(I_7017, checksum=True), 12),
        (dcon.ReadAnalogInputs(0x01), Profile(Model.M_7017Z, single_ended=True), 142),
        (dcon.ReadAnalogInputs(0x01), evolve(I_7017, data_format=DataFormat.HEX), 34),
        (dcon.ReadAnalogInput(0x01, 0), I_7017, 9),
        (dcon.ReadAnalogInputs(0x01), Profile(Model.I_7018, firmware=Firmware("B1.4"), data_format=DataFormat.HEX), 42),
        (
            dcon.ReadAnalogInput(0x01, 0),
            Profile(Model.I_7018, firmware=Firmware("B1.4"), data_format=DataFormat.HEX),
            7,
        ),
        (dcon.ReadSynchronizedData(0x01), Profile(Model.M_7019Z, checksum=True), 77),
        (dcon.ReadChannelMask(0x01), Profile(Model.M_7017Z, single_ended=True), 10),
        (dcon.ReadModuleName(0x01), I_7017, 10),
        (dcon.ReadFirmwareVersion(0x01), I_7017, 9),
    ],
    ids=repr,
)
def test_the_longest_response_is_counted_in_bytes(command: Any, profile: Profile, length: int) -> None:
    assert length == dcon.longest_response(command, profile)


@pytest.mark.parametrize(("command", "answered"), [(dcon.HostOk(), False), (dcon.ReadModuleName(0x01), True)], ids=repr)
def test_nothing_answers_a_broadcast(command: Any, answered: bool) -> None:  # noqa: FBT001 - a case
    assert answered == dcon.is_answered(command)


def test_a_status_byte_is_kept_and_read() -> None:
    told = dcon.HostWatchdogStatus(0x01, 0x84)

    assert (told.enabled, told.timed_out) == (True, True)
    assert (
        dcon.HostWatchdogStatus(0x01, 0x7B).enabled,
        dcon.HostWatchdogStatus(0x01, 0x7B).timed_out,
    ) == (False, False)


def test_an_offset_is_available_in_degrees() -> None:
    assert dcon.CjcOffset(0x01, -16).celsius == -0.16


def test_a_message_is_shown_with_its_addresses_in_hex() -> None:
    assert repr(dcon.SetChannelMask(0x1F, 0x3A)) == "SetChannelMask(address=0x1F, mask=0x3A)"
    assert repr(dcon.HostOk()) == "HostOk()"
    assert repr(dcon.ProtocolSetting(1, modbus_supported=True, protocol=Protocol.DCON)).startswith(
        "ProtocolSetting(address=0x01, "
    )


@pytest.mark.parametrize("model", Model)
def test_a_number_of_a_model_is_a_name(model: Model) -> None:
    number = (model.series + model.suffix.replace("-", "")).upper()[:6]

    for name in (number, model.series):
        told = dcon.decode_response(f"!01{name}\r".encode(), dcon.ReadModuleName(0x01), Profile(model))
        assert told == dcon.ModuleName(0x01, name)


@pytest.mark.parametrize("name", ["0506", "A2.0", "+0010"])
def test_a_name_that_could_not_be_read_back_is_not_sent_and_not_taken(name: str) -> None:
    with pytest.raises(
        EncodeError, match=r"not the text of another response \(2, 4 or 6 hex digits, a version, \.\.\.\), manual"
    ):
        dcon.encode(dcon.SetModuleName(0x01, name), I_7017)

    assert dcon.decode_command(f"~01O{name}\r".encode(), I_7017) == dcon.SetModuleName(0x01, name)


@pytest.mark.parametrize(("frame", "fault", "offset"), [(b"~*1\r", Fault.CHARACTER, 2), (b"#1*\r", Fault.CHARACTER, 2)])
def test_a_damaged_broadcast_is_held_against_the_broadcast(frame: bytes, fault: Fault, offset: int) -> None:
    with pytest.raises(DecodeError) as caught:
        dcon.decode_command(frame, M_7019R)

    assert (fault, offset) == (caught.value.fault, caught.value.offset)


def test_codes_given_as_numbers_are_taken_like_their_members() -> None:
    given = configuration(LineSettings(6), ReportSettings(0))

    assert dcon.encode(configuration(), I_7017) == dcon.encode(given, I_7017)


@pytest.mark.parametrize(
    ("message", "profile"),
    [
        (dcon.SetCjcUpdate(0x01, CjcUpdate.STOPPED), M_7018),
        (dcon.ReadAnalogInput(0x01, 8), I_7017),
        (dcon.SetCjcOffset(0x01, 0x1001), M_7018),
        (dcon.SetChannelMask(0x01, 0xFFFF), Profile(Model.M_7019Z)),
        (dcon.SetChannelTypeCode(0x01, 0, 0x30), M_7019R),
    ],
    ids=repr,
)
def test_what_a_module_does_not_take_can_be_forced(message: Any, profile: Profile) -> None:
    with pytest.raises(EncodeError):
        dcon.encode(message, profile)

    assert message.layout.encode(message, profile) + b"\r" == dcon.encode(message, profile, force=True)


@pytest.mark.parametrize(
    ("call", "facts"),
    [
        (
            lambda: dcon.decode_command(b"$01\r", Profile(Model.M_7018R)),
            (Fault.LENGTH, "", 3, "a command of chapter 2", "2"),
        ),
        (
            lambda: dcon.decode_command(b"#**\r", Profile(Model.M_7018R)),
            (Fault.UNSUPPORTED, "", 1, "synchronized sampling exists on 7019 series only", "2.2"),
        ),
        (
            lambda: dcon.decode_command(b"$012x\r", Profile(Model.M_7018R)),
            (Fault.LENGTH, "", 4, "4 characters: $AA2", "2.10"),
        ),
        (
            lambda: dcon.decode_command(b"$01z\r", Profile(Model.M_7018R)),
            (Fault.COMMAND, "", 3, "a command of chapter 2", "2"),
        ),
        (
            lambda: dcon.decode_command(b"~01C2\r", Profile(Model.M_7018R)),
            (Fault.VALUE, "enabled", 4, "bool: 0 (False) 1 (True)", "2.30"),
        ),
        (
            lambda: dcon.decode_command(b"$017X0R03\r", Profile(Model.M_7018R)),
            (Fault.CHARACTER, "", 4, "$AA7CiRrr", "2.15"),
        ),
        (
            lambda: dcon.decode_command(b"#*\r", Profile(Model.M_7018R)),
            (Fault.LENGTH, "", 2, "3 characters: #AA", "2.3"),
        ),
        (
            lambda: dcon.decode_command(b"$0a2\r", Profile(Model.M_7018R)),
            (Fault.CHARACTER, "address", 2, "0-9 A-F", "2.10"),
        ),
        (
            lambda: dcon.decode_command(b"$01900100\r", Profile(Model.M_7018R)),
            (Fault.NUMBER, "offset", 4, "+ or -", "2.18"),
        ),
        (
            lambda: dcon.decode_command(b"~01Oab!\r", Profile(Model.M_7018R)),
            (Fault.CHARACTER, "name", 6, "1 to 6 characters, printable ASCII without % # $ ~ @ ! > ?", "2.33"),
        ),
        (
            lambda: dcon.decode_command(b"~0aOABCDEFG\r", Profile(Model.M_7018R)),
            (Fault.LENGTH, "", 10, "5 to 10 characters: ~AAO(Name)", "2.33"),
        ),
        (
            lambda: dcon.decode_command(b"~*1\r", Profile(Model.M_7018R)),
            (Fault.CHARACTER, "", 2, "~**", "2.35"),
        ),
        (
            lambda: dcon.decode_response(b"!02050600\r", dcon.ReadConfiguration(1), M_7019R),
            (Fault.ADDRESS, "address", 1, "01", "2.10"),
        ),
        (
            lambda: dcon.decode_response(b"?02\r", dcon.ReadConfiguration(1), M_7019R),
            (Fault.ADDRESS, "address", 1, "01", "2.10"),
        ),
        (
            lambda: dcon.decode_response(b"!01C1R05\r", dcon.ReadChannelTypeCode(1, 0), M_7019R),
            (Fault.VALUE, "channel", 4, "the requested channel", "2.16"),
        ),
        (
            lambda: dcon.decode_response(b"!0105060\r", dcon.ReadConfiguration(1), M_7019R),
            (Fault.LENGTH, "", 8, "9 characters: !AATTCCFF", "2.10"),
        ),
        (
            lambda: dcon.decode_response(b"!01050g00\r", dcon.ReadConfiguration(1), M_7019R),
            (Fault.CHARACTER, "line_settings", 6, "0-9 A-F", "2.10"),
        ),
        (
            lambda: dcon.decode_response(b"$01050600\r", dcon.ReadConfiguration(1), M_7019R),
            (Fault.LEADING, "", 0, "! ?", "2"),
        ),
        (
            lambda: dcon.decode_response(b"?0\r", dcon.ReadConfiguration(1), M_7019R),
            (Fault.LENGTH, "", 2, "3 characters: ?AA", "2.10"),
        ),
        (
            lambda: dcon.decode_response(b">+1.2\r", dcon.ReadAnalogInputs(1), M_7019R),
            (Fault.LENGTH, "", 5, "57 characters: >(Data)", "2.3"),
        ),
        (
            lambda: dcon.decode_response(b">0031.2\r", dcon.ReadCjcTemperature(1), M_7019R),
            (Fault.LENGTH, "", 7, "8 characters: >(Data)", "2.11"),
        ),
        (
            lambda: dcon.decode_response(b">+0a31.2\r", dcon.ReadCjcTemperature(1), M_7019R),
            (Fault.NUMBER, "temperature", 1, "-9999.9..+9999.9, in tenths", "2.11"),
        ),
        (
            lambda: dcon.decode_response(b"!01zz\r", dcon.ReadFirmwareVersion(1), M_7019R),
            (Fault.LENGTH, "", 5, "7 to 8 characters: !AA(Data)", "2.23"),
        ),
        (
            lambda: dcon.decode_response(b"!01ABCDEFGH\r", dcon.ReadModuleName(1), M_7019R),
            (Fault.LENGTH, "", 9, "4 to 9 characters: !AA(Name)", "2.24"),
        ),
        (
            lambda: dcon.decode_response(b"!0100ff\r", dcon.ReadChannelMask(1), M_7019R),
            (Fault.LENGTH, "", 5, "5 characters: !AAVV", "2.14"),
        ),
    ],
)
def test_an_error_has_every_fact_of_the_fault(
    call: Callable[[], object], facts: tuple[Fault, str, int, str, str]
) -> None:
    with pytest.raises(DecodeError) as caught:
        call()

    error = caught.value
    assert facts == (error.fault, error.field, error.offset, error.allowed, error.section)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: dcon.encode(1, I_7017), "message must be Message"),  # type: ignore[arg-type]
        (lambda: dcon.encode(dcon.HostOk(), 1), "profile must be Profile"),  # type: ignore[arg-type]
        (lambda: dcon.encode(dcon.HostOk(), I_7017, force=1), "force must be bool"),  # type: ignore[arg-type]
        (lambda: dcon.decode_command(1, I_7017), "frame must be bytes, bytearray or memoryview"),  # type: ignore[arg-type]
        (lambda: dcon.decode_command(b"", 1), "profile must be Profile"),  # type: ignore[arg-type]
        (
            lambda: dcon.decode_response(1, dcon.ReadConfiguration(1), I_7017),  # type: ignore[arg-type]
            "frame must be bytes, bytearray or memoryview",
        ),
        (lambda: dcon.decode_response(b"", 1, I_7017), "command must be Command"),  # type: ignore[arg-type]
        (lambda: dcon.decode_response(b"", dcon.ReadConfiguration(1), 1), "profile must be Profile"),  # type: ignore[arg-type]
        (lambda: dcon.is_answered(1), "command must be Command or Broadcast"),  # type: ignore[arg-type]
        (lambda: dcon.longest_response(1, I_7017), "command must be Command or Broadcast"),  # type: ignore[arg-type]
        (lambda: dcon.longest_response(dcon.HostOk(), 1), "profile must be Profile"),  # type: ignore[arg-type]
        (lambda: dcon.pause_after(1, I_7017), "command must be Command or Broadcast"),  # type: ignore[arg-type]
        (lambda: dcon.pause_after(dcon.HostOk(), 1), "profile must be Profile"),  # type: ignore[arg-type]
    ],
)
def test_an_argument_of_the_wrong_type_is_named(call: Callable[[], object], message: str) -> None:
    with pytest.raises(ArgumentError) as caught:
        call()

    assert str(caught.value) == f"{message}, not 1 (int)"
