"""What `encode` and the decoders of Modbus refuse, and how they say it."""

from collections.abc import Callable
from typing import Any

import pytest

from i7000 import (
    ArgumentError,
    BaudRate,
    CharacterFormat,
    CjcUpdate,
    DecodeError,
    EncodeError,
    Fault,
    Filter,
    Firmware,
    LineSettings,
    Model,
    Profile,
    Protocol,
    TypeCode,
    modbus,
)
from i7000.modbus import seal

M_7017 = Profile(Model.M_7017)
M_7018 = Profile(Model.M_7018)
M_7019R = Profile(Model.M_7019R)
WIDE = Profile(Model.M_7017Z, single_ended=True)


def frame(body: str) -> bytes:
    return seal(bytes.fromhex(body))


# --- encode -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("message", "profile", "said"),
    [
        (
            modbus.ReadCoils(0x01, 256, 1),
            Profile(Model.M_7018, firmware=Firmware("B3.4")),
            r"M-7018 with firmware B3\.4 has no coils by Modbus: .*M-7018R from B3\.5, manual 3\.4",
        ),
        (modbus.ReadModuleName(0x01), Profile(Model.I_7017), "I-7017 has no module name by Modbus: M-7000 series only"),
        (modbus.ReadDiscreteInputs(0x01, 128, 8), M_7018, "M-7018 has no discrete inputs by Modbus"),
        (modbus.CjcEnabled(0x01, enabled=True), M_7017, "M-7017 has no CJC switch by Modbus: M-7018 and M-7019"),
        (modbus.ReadCjcUpdate(0x01), M_7018, r"M-7018 has no CJC update setting by Modbus: M-7019 .*, manual 3\.3\.16"),
        (modbus.SetModuleAddress(0x01, 0), M_7017, r"new_address cannot be 0: 1\.\.247, manual 3\.3\.2"),
        (modbus.SetModuleAddress(0x01, 248), M_7017, r"new_address cannot be 248: 1\.\.247"),
        (
            modbus.SetCommunicationSettings(0x01, LineSettings(0x0B), Protocol.DCON),
            M_7017,
            r"baud_rate cannot be '0B': 03\.\.0A, manual 3\.3\.4",
        ),
        (
            modbus.SetCommunicationSettings(
                0x01, LineSettings(BaudRate.BAUD_9600, CharacterFormat.O81), Protocol.MODBUS_RTU
            ),
            Profile(Model.M_7018, firmware=Firmware("B2.8")),
            r"character_format cannot be 'O81': N81 with firmware before B2\.9 on M-7018",
        ),
        (modbus.ReadTypeCode(0x01, 8), M_7019R, r"channel cannot be 8: 0\.\.7 on M-7019R, manual 3\.3\.5"),
        (modbus.ReadTypeCode(0x01, 1), M_7017, r"channel cannot be 1: 0, which means all channels, on M-7017"),
        (
            modbus.SetTypeCode(0x01, 1, TypeCode.V_10),
            M_7017,
            r"channel cannot be 1: 0, which means all channels, on M-7017, manual 3\.3\.6",
        ),
        (modbus.SetTypeCode(0x01, 0, TypeCode.K), M_7017, "type_code cannot be 'K': V_10 V_5 V_1_0A .* on M-7017"),
        (modbus.SetTypeCode(0x01, 0, 0x30), M_7019R, "type_code cannot be '30'"),
        (modbus.SetMiscellaneousSettings(0x01, 0x20), M_7018, "settings cannot be '20': only bits of 80h on M-7018"),
        (
            modbus.SetMiscellaneousSettings(0x01, 0x80),
            Profile(Model.M_7019R, firmware=Firmware("B2.6"), type_codes=()),
            "settings cannot be '80': only bits of 00h on M-7019R",
        ),
        (modbus.ReadCjcOffset(0x01, 0x01), M_7018, r"channel cannot be '01': 00, 80\.\.87 on M-7018, manual 3\.3\.12"),
        (
            modbus.SetCjcOffset(0x01, 0x88, 0),
            M_7018,
            r"channel cannot be '88': 00, 80\.\.87 on M-7018, manual 3\.3\.13",
        ),
        (modbus.SetCjcOffset(0x01, 0x00, 0x1001), M_7018, r"offset cannot be 4097: -4096\.\.\+4096"),
        (modbus.SetCjcOffset(0x01, 0x80, -1), M_7018, r"offset cannot be -1: 0\.\.255"),
        (modbus.SetChannelMask(0x01, 0x400), Profile(Model.M_7019Z), r"M-7019Z has no channel 10: 0\.\.9"),
        (modbus.ChannelMask(0x01, 0x400), Profile(Model.M_7019Z), r"M-7019Z has no channel 10: 0\.\.9"),
        (
            modbus.WriteMultipleRegisters(0x01, 256, (8,) * 12),
            M_7019R,
            r"count cannot be 12: 1\.\.11 registers in one write on M-7019R",
        ),
    ],
    ids=lambda value: type(value).__name__ if isinstance(value, modbus.Message) else "",
)
def test_what_a_module_does_not_take_is_refused_with_the_reason(message: Any, profile: Profile, said: str) -> None:
    with pytest.raises(EncodeError, match=said):
        modbus.encode(message, profile)

    assert modbus.unseal(modbus.encode(message, profile, force=True))[0] == message.address


@pytest.mark.parametrize(("model", "most"), [(Model.M_7019R, 11), (Model.M_7019Z, 11), (Model.M_7017, 123)])
def test_the_7019_series_takes_11_registers_at_once_and_the_others_what_a_frame_holds(model: Model, most: int) -> None:
    request = modbus.WriteMultipleRegisters(0x01, 0, (0,) * most)

    assert len(modbus.encode(request, Profile(model))) == 9 + 2 * most


@pytest.mark.parametrize(
    ("profile", "mask", "body"),
    [
        (M_7017, 0x81, "01462681"),
        (Profile(Model.M_7019Z), 0x281, "0146260281"),
        (Profile(Model.M_7018_16), 0x8001, "0146268001"),
        (WIDE, 0x80001, "014626080001"),
    ],
    ids=["8 channels", "10", "16", "20"],
)
def test_a_mask_has_as_many_bytes_as_the_channels_need(profile: Profile, mask: int, body: str) -> None:
    request = modbus.SetChannelMask(0x01, mask)

    assert frame(body) == modbus.encode(request, profile)
    assert request == modbus.decode_request(frame(body), profile)


@pytest.mark.parametrize("force", [False, True])
def test_a_mask_needs_a_profile(force: bool) -> None:  # noqa: FBT001 - a case
    with pytest.raises(EncodeError, match=r"profile cannot be None: .*determines the length of a mask, manual 3\.3\.9"):
        modbus.encode(modbus.SetChannelMask(0x01, 0x01), force=force)


@pytest.mark.parametrize("kind", [modbus.SetChannelMask, modbus.ChannelMask])
def test_a_mask_that_its_bytes_do_not_hold_cannot_be_forced(kind: Any) -> None:
    with pytest.raises(EncodeError, match=r"mask cannot be '100': 1 byte\(s\) on M-7017, manual 3\.3\.9"):
        modbus.encode(kind(0x01, 0x100), M_7017, force=True)


BROADCASTS = [
    modbus.WriteSingleCoil,
    modbus.WriteSingleRegister,
    modbus.WriteMultipleCoils,
    modbus.WriteMultipleRegisters,
]


@pytest.mark.parametrize("request_class", modbus.REQUESTS, ids=lambda kind: kind.__name__)
def test_only_standard_writes_can_be_for_all_modules(request_class: Any) -> None:
    assert (request_class in BROADCASTS) == request_class.broadcast


@pytest.mark.parametrize(
    "message",
    [
        modbus.ReadCoils(0, 0, 1),
        modbus.ReadModuleName(0),
        modbus.SetModuleAddress(0, 1),
        modbus.SingleCoilWritten(0, 0, True),
        modbus.ExceptionResponse(0, 5, 1),
    ],
    ids=lambda message: type(message).__name__,
)
def test_what_is_not_for_all_modules_needs_an_address(message: Any) -> None:
    with pytest.raises(EncodeError, match=r"address cannot be 0: 1\.\.247; 0 is for functions 05, 06, 0F, 10"):
        modbus.encode(message, force=True)


@pytest.mark.parametrize(
    ("kind", "values", "field"),
    [
        (modbus.ReadModuleName, (248,), "address"),
        (modbus.ReadModuleName, (-1,), "address"),
        (modbus.ReadModuleName, (True,), "address"),
        (modbus.ReadModuleName, ("1",), "address"),
        (modbus.ReadCoils, (1, 0x10000, 1), "start"),
        (modbus.ReadCoils, (1, 0, 0), "count"),
        (modbus.ReadCoils, (1, 0, 2001), "count"),
        (modbus.ReadCoils, (1, 0xFFFF, 2), "count"),
        (modbus.ReadDiscreteInputs, (1, 0, 2001), "count"),
        (modbus.ReadHoldingRegisters, (1, 0, 126), "count"),
        (modbus.ReadInputRegisters, (1, 0, 126), "count"),
        (modbus.ReadInputRegisters, (1, 0, 1.0), "count"),
        (modbus.WriteSingleCoil, (1, 0, 1), "value"),
        (modbus.WriteSingleRegister, (1, 0, 0x10000), "value"),
        (modbus.WriteSingleRegister, (1, 0, -1), "value"),
        (modbus.WriteMultipleCoils, (1, 0, ()), "values"),
        (modbus.WriteMultipleCoils, (1, 0, (1,)), "values"),
        (modbus.WriteMultipleCoils, (1, 0, (True,) * 1969), "values"),
        (modbus.WriteMultipleCoils, (1, 0xFFFF, (True, True)), "count"),
        (modbus.WriteMultipleRegisters, (1, 0, [1]), "values"),
        (modbus.WriteMultipleRegisters, (1, 0, (True,)), "values"),
        (modbus.WriteMultipleRegisters, (1, 0, (0x10000,)), "values"),
        (modbus.WriteMultipleRegisters, (1, 0, (0,) * 124), "values"),
        (modbus.WriteMultipleRegisters, (1, 0xFFFF, (0, 0)), "count"),
        (modbus.Coils, (1, (True,) * 2001), "values"),
        (modbus.InputRegisters, (1, (0,) * 126), "values"),
        (modbus.MultipleCoilsWritten, (1, 0, 1969), "count"),
        (modbus.MultipleRegistersWritten, (1, 0, 124), "count"),
        (modbus.MultipleRegistersWritten, (1, 0xFFFF, 2), "count"),
        (modbus.ModuleName, (1, b"\x00\x70\x17"), "name"),
        (modbus.ModuleName, (1, "00701700"), "name"),
        (modbus.SetCommunicationSettings, (1, 6, Protocol.DCON), "line_settings"),
        (modbus.SetCommunicationSettings, (1, LineSettings(), 0), "protocol"),
        (modbus.SetTypeCode, (1, 0, 256), "type_code"),
        (modbus.SetChannelMask, (1, 1 << 24), "mask"),
        (modbus.SetCjcOffset, (1, 0, 0x8000), "offset"),
        (modbus.SetCjcOffset, (1, 0, -0x8001), "offset"),
        (modbus.SetCjcUpdate, (1, 1), "update"),
        (modbus.ExceptionResponse, (1, 0x80, 1), "function"),
        (modbus.ExceptionResponse, (1, 0, 1), "function"),
        (modbus.ExceptionResponse, (1, 1, 256), "exception_code"),
    ],
)
def test_a_message_that_has_no_wire_form_cannot_be_made(kind: Any, values: Any, field: str) -> None:
    with pytest.raises(EncodeError) as caught:
        kind(*values)

    assert (field, kind.section) == (caught.value.field, caught.value.section)


def test_a_flag_is_true_or_false() -> None:
    with pytest.raises(EncodeError, match="enabled cannot be 1: 0 1"):
        modbus.SetCjcEnabled(0x01, enabled=1)  # type: ignore[arg-type]


def test_a_number_may_be_a_member_of_an_enumeration() -> None:
    code = modbus.ExceptionCode.ILLEGAL_DATA_VALUE

    assert frame("018403") == modbus.encode(modbus.ExceptionResponse(0x01, 4, code))


def test_a_message_is_shown_with_its_addresses_in_hex() -> None:
    assert repr(modbus.SetChannelMask(0x1F, 0x3A)) == "SetChannelMask(address=0x1F, mask=0x3A)"
    assert repr(modbus.SetModuleAddress(1, 2)) == "SetModuleAddress(address=0x01, new_address=0x02)"


# --- decode -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("body", "fault", "offset", "said"),
    [
        ("f80400000008", Fault.ADDRESS, 0, r"allowed: 1\.\.247, and 0 for functions 05, 06, 0F, 10"),
        ("000400000008", Fault.ADDRESS, 0, r"allowed: 1\.\.247, and 0 for functions 05, 06, 0F, 10"),
        ("004600", Fault.ADDRESS, 0, "address"),
        ("0107", Fault.FUNCTION, 1, "allowed: 01 02 03 04 05 06 0F 10 46"),
        ("018402", Fault.FUNCTION, 1, "function"),
        ("0146", Fault.LENGTH, 2, "sub_function .*allowed: one more byte"),
        ("014601", Fault.SUB_FUNCTION, 2, "allowed: 00 04 05 06 07 08 20 25 26 29 2A 2B 2C 2D 2E 2F 30"),
        ("0104000008", Fault.LENGTH, 5, "address and PDU of 6 bytes [(]manual"),
        ("01040000000800", Fault.LENGTH, 6, "address and PDU of 6 bytes [(]manual"),
        ("01100000000102", Fault.LENGTH, 7, "bytes .*as many as follow"),
        ("0110000000010200", Fault.LENGTH, 8, "bytes .*as many as follow"),
        ("011000000001020000ff", Fault.LENGTH, 9, "bytes .*as many as follow"),
        ("010400000000", Fault.RANGE, 4, r"count .*allowed: 1\.\.125"),
        ("01040000007e", Fault.RANGE, 4, r"count .*allowed: 1\.\.125"),
        ("0101000007d1", Fault.RANGE, 4, r"count .*allowed: 1\.\.2000"),
        ("0104ffff0002", Fault.RANGE, 4, "none beyond address 65535"),
        ("0110ffff00020400000000", Fault.RANGE, 4, "none beyond address 65535"),
        ("011000000000020000", Fault.RANGE, 4, "a tuple of 1 to 123 items"),
        ("0110000000020200ff", Fault.COUNT, 6, "as many as the items have"),
        ("010f000000090101", Fault.COUNT, 6, "as many as the items have"),
        ("010f00000001010200", Fault.LENGTH, 8, "bytes"),
        ("010500000001", Fault.VALUE, 4, "value .*allowed: True False"),
        ("01460401000001", Fault.RESERVED, 6, "allowed: 00"),
        ("0146070100", Fault.RESERVED, 3, "allowed: 00"),
        ("014606000600000002" + "0000", Fault.VALUE, 8, "protocol .*allowed: 0 1"),
        ("01462e0002", Fault.VALUE, 4, "enabled .*allowed: 0 1"),
        ("01463003", Fault.VALUE, 3, "update .*allowed: 0 1 2"),
        ("0146260101", Fault.LENGTH, 3, "address and PDU of 3 bytes and more"),
    ],
)
def test_an_invalid_request_frame_raises_the_fault_and_its_place(
    body: str, fault: Fault, offset: int, said: str
) -> None:
    with pytest.raises(DecodeError, match=said) as caught:
        modbus.decode_request(frame(body), M_7019R)

    assert (fault, offset, frame(body)) == (caught.value.fault, caught.value.offset, caught.value.wire)


def test_a_response_of_four_bytes_is_too_short_whatever_its_crc() -> None:
    with pytest.raises(DecodeError) as caught:
        modbus.decode_response(bytes.fromhex("01030302"), modbus.ReadHoldingRegisters(1, 0, 1), M_7019R)

    assert caught.value.fault is Fault.LENGTH


@pytest.mark.parametrize(
    ("request_", "body", "fault", "offset", "said"),
    [
        (modbus.ReadInputRegisters(1, 0, 1), "0104", Fault.LENGTH, 2, "at least 5 bytes"),
        (modbus.ReadInputRegisters(1, 0, 1), "0204020000", Fault.ADDRESS, 0, "allowed: 01"),
        (modbus.ReadInputRegisters(1, 0, 1), "0103020000", Fault.FUNCTION, 1, "allowed: 04 84"),
        (modbus.ReadInputRegisters(1, 0, 1), "018302", Fault.FUNCTION, 1, "allowed: 04 84"),
        (modbus.ReadInputRegisters(1, 0, 1), "01840200", Fault.LENGTH, 3, "address and PDU of 3 bytes [(]manual"),
        (modbus.ReadInputRegisters(1, 0, 2), "0104020000", Fault.COUNT, 2, "bytes .*allowed: 4, as requested"),
        (modbus.ReadHoldingRegisters(1, 0, 1), "01030400000000", Fault.COUNT, 2, "allowed: 2, as requested"),
        (modbus.ReadInputRegisters(1, 0, 1), "010400", Fault.COUNT, 2, "a tuple of 1 to 125 items"),
        (modbus.ReadInputRegisters(1, 0, 1), "01040100", Fault.COUNT, 2, "a tuple of 1 to 125 items"),
        (modbus.ReadInputRegisters(1, 0, 125), "0104fc" + "00" * 252, Fault.LENGTH, 256, "4 to 256 bytes"),
        (modbus.ReadCoils(1, 0, 8), "01010200ff", Fault.COUNT, 2, "allowed: 1, as requested"),
        (modbus.ReadCoils(1, 0, 9), "01010200", Fault.LENGTH, 4, "as many as follow"),
        (modbus.WriteSingleCoil(1, 2, True), "01050003ff00", Fault.ECHO, 3, "allowed: 01 05 00 02 ff 00"),
        (modbus.WriteSingleRegister(1, 2, 3), "010600020004", Fault.ECHO, 5, "allowed: 01 06 00 02 00 03"),
        (modbus.WriteMultipleCoils(1, 2, (True,)), "010f00020002", Fault.ECHO, 5, "allowed: 01 0f 00 02 00 01"),
        (
            modbus.WriteMultipleRegisters(1, 2, (3,)),
            "011000020001020003",
            Fault.LENGTH,
            6,
            "6 bytes of address and PDU",
        ),
        (modbus.WriteMultipleRegisters(1, 2, (3,)), "0110000200", Fault.LENGTH, 5, "6 bytes of address and PDU"),
        (
            modbus.ReadModuleName(1),
            "014620040000",
            Fault.SUB_FUNCTION,
            2,
            r"allowed: 00 .manual 3\.3\)",
        ),
        (modbus.ReadModuleName(1), "014600007017", Fault.LENGTH, 6, r"PDU of 7 bytes.*\(manual 3\.3\.1\)"),
        (modbus.SetModuleAddress(1, 2), "01460400000001", Fault.RESERVED, 6, "allowed: 00"),
        (modbus.ReadCjcEnabled(1), "01462d02", Fault.VALUE, 3, "enabled .*allowed: 0 1"),
        (modbus.ReadChannelMask(1), "0146250101", Fault.LENGTH, 3, "address and PDU of 3 bytes and more"),
    ],
    ids=lambda value: type(value).__name__ if isinstance(value, modbus.Message) else "",
)
def test_a_frame_that_does_not_answer_the_request_raises_the_fault_and_its_place(
    request_: Any, body: str, fault: Fault, offset: int, said: str
) -> None:
    with pytest.raises(DecodeError, match=said) as caught:
        modbus.decode_response(frame(body), request_, M_7019R)

    assert (fault, offset, frame(body)) == (caught.value.fault, caught.value.offset, caught.value.wire)


@pytest.mark.parametrize("address", [0, 1])
def test_nothing_answers_a_broadcast(address: int) -> None:
    request = modbus.WriteSingleRegister(modbus.BROADCAST, 488, 100)
    answer = seal(bytes((address,)) + modbus.unseal(modbus.encode(request))[1:])

    assert not modbus.is_answered(request)
    with pytest.raises(DecodeError, match="allowed: no response to a broadcast") as caught:
        modbus.decode_response(answer, request, M_7017)
    assert Fault.ADDRESS is caught.value.fault


@pytest.mark.parametrize(
    ("request_", "profile", "length"),
    [
        (modbus.ReadInputRegisters(1, 0, 8), M_7017, 21),
        (modbus.ReadCoils(1, 256, 9), M_7017, 7),
        (modbus.WriteSingleRegister(1, 488, 100), M_7017, 8),
        (modbus.ReadChannelMask(1), M_7017, 6),
        (modbus.ReadChannelMask(1), Profile(Model.M_7017Z, single_ended=True), 8),
        (modbus.ReadModuleName(1), M_7017, 9),
        (modbus.ReadTypeCode(1, 0), M_7017, 6),
        (modbus.WriteSingleRegister(0, 488, 100), M_7017, 0),
    ],
    ids=str,
)
def test_the_longest_response_is_counted_in_bytes(request_: Any, profile: Profile, length: int) -> None:
    assert length == modbus.longest_response(request_, profile)


@pytest.mark.parametrize(
    ("request_", "seconds"),
    [
        (modbus.ReadInputRegisters(1, 0, 8), 0.0),
        (modbus.WriteSingleRegister(0, 488, 100), 0.002),
        (modbus.WriteSingleCoil(1, 271, value=True), 3.0),
        (modbus.WriteSingleCoil(0, 271, value=True), 3.0),
        (modbus.WriteSingleCoil(1, 271, value=False), 0.0),
        (modbus.WriteSingleCoil(1, 270, value=True), 0.0),
        (modbus.WriteMultipleCoils(1, 270, (False, True)), 3.0),
        (modbus.WriteMultipleCoils(1, 270, (True, False)), 0.0),
        (modbus.WriteMultipleCoils(1, 269, (True, True)), 0.0),
        (modbus.WriteMultipleCoils(1, 272, (True,)), 0.0),
    ],
    ids=str,
)
def test_a_pause_is_owed_after_a_broadcast_and_the_calibration_of_the_factory(request_: Any, seconds: float) -> None:
    assert seconds == modbus.pause_after(request_, M_7017)


def test_the_codes_of_exceptions_are_those_of_the_modbus_specification() -> None:
    assert list(modbus.ExceptionCode) == [0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x08, 0x0A, 0x0B]


@pytest.mark.parametrize("code", [*modbus.ExceptionCode, 0x00, 0x07, 0xFF])
@pytest.mark.parametrize("request_", [modbus.ReadInputRegisters(1, 0, 8), modbus.ReadCjcUpdate(1)], ids=["04", "46"])
def test_any_request_can_be_answered_with_any_exception(request_: Any, code: int) -> None:
    sent = modbus.ExceptionResponse(0x01, request_.function, code)

    assert sent == modbus.decode_response(modbus.encode(sent), request_, M_7017)


@pytest.mark.parametrize("count", [1, 7, 8, 9, 2000])
def test_a_response_has_as_many_bits_as_requested(count: int) -> None:
    values = tuple(at % 3 == 0 for at in range(count))
    answer = modbus.encode(modbus.Coils(0x01, values))

    response = modbus.decode_response(answer, modbus.ReadCoils(0x01, 0, count), M_7017)

    assert modbus.Coils(0x01, values) == response


def test_codes_that_nobody_defined_are_kept() -> None:
    told = modbus.decode_response(frame("0146071d"), modbus.ReadTypeCode(0x01, 0), M_7017)
    line = modbus.decode_response(frame("014605003f000000010000"), modbus.ReadCommunicationSettings(0x01), M_7017)

    assert modbus.TypeCodeSetting(0x01, 0x1D) == told
    assert modbus.CommunicationSettings(0x01, LineSettings(0x3F), Protocol.MODBUS_RTU) == line


def test_coded_settings_are_members_of_their_enumerations() -> None:
    told = modbus.decode_response(frame("01462f02"), modbus.ReadCjcUpdate(0x01), M_7019R)

    assert isinstance(told, modbus.CjcUpdateSetting)
    assert told.update is CjcUpdate.ONCE


# --- what a setting means ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("request_", "body", "profile"),
    [
        (modbus.ReadMiscellaneousSettings(0x01), "0146295f", Profile(Model.M_7017R)),
        (modbus.ReadChannelMask(0x01), "01462507ff", Profile(Model.M_7017Z)),
        (modbus.ReadCjcOffset(0x01, 0x80), "01462b0100", Profile(Model.M_7018)),
    ],
)
def test_reserved_bits_of_an_answer_are_refused(request_: Any, body: str, profile: Profile) -> None:
    with pytest.raises(DecodeError) as caught:
        modbus.decode_response(modbus.seal(bytes.fromhex(body)), request_, profile)

    assert (caught.value.fault, caught.value.offset) == (Fault.RESERVED, 3)


def test_an_offset_is_in_hundredths_for_the_module_and_in_tenths_for_a_channel() -> None:
    module, channel = modbus.ReadCjcOffset(0x01, 0), modbus.ReadCjcOffset(0x01, 0x87)

    assert (modbus.CjcOffset(0x01, -16).celsius(module), modbus.CjcOffset(0x01, 0xFF).celsius(channel)) == (-0.16, -0.1)
    assert (modbus.SetCjcOffset(0x01, 0, 255).celsius, modbus.SetCjcOffset(0x01, 0x80, 127).celsius) == (2.55, 12.7)


def test_miscellaneous_settings_are_filter_and_fast_mode() -> None:
    told = modbus.MiscellaneousSettings(0x01, 0xA0)

    assert (told.filter, told.fast_mode) == (Filter.REJECT_50_HZ, True)
    assert Filter.REJECT_60_HZ is modbus.MiscellaneousSettings(0x01, 0x20).filter


@pytest.mark.parametrize(
    ("call", "facts"),
    [
        (
            lambda: modbus.decode_request(frame("f80400000001"), M_7017),
            (Fault.ADDRESS, "address", 0, "1..247, and 0 for functions 05, 06, 0F, 10", "3"),
        ),
        (
            lambda: modbus.decode_request(frame("0146"), M_7017),
            (Fault.LENGTH, "sub_function", 2, "one more byte", "3.3"),
        ),
        (
            lambda: modbus.decode_request(frame("014699"), M_7017),
            (Fault.SUB_FUNCTION, "sub_function", 2, "00 04 05 06 07 08 20 25 26 29 2A 2B 2C 2D 2E 2F 30", "3.3"),
        ),
        (
            lambda: modbus.decode_request(frame("0199"), M_7017),
            (Fault.FUNCTION, "function", 1, "01 02 03 04 05 06 0F 10 46", "3"),
        ),
        (
            lambda: modbus.decode_request(frame("000400000001"), M_7017),
            (Fault.ADDRESS, "address", 0, "1..247, and 0 for functions 05, 06, 0F, 10", "3"),
        ),
        (
            lambda: modbus.decode_request(frame("0104000000"), M_7017),
            (Fault.LENGTH, "", 5, "address and PDU of 6 bytes", "3.2"),
        ),
        (
            lambda: modbus.decode_request(frame("010400000000"), M_7017),
            (Fault.RANGE, "count", 4, "1..125", "3.2"),
        ),
        (
            lambda: modbus.decode_request(frame("0104ffff0002"), M_7017),
            (Fault.RANGE, "count", 4, "none beyond address 65535", "3.2"),
        ),
        (
            lambda: modbus.decode_request(frame("010500001234"), M_7017),
            (Fault.VALUE, "value", 4, "True False", "3.4"),
        ),
        (
            lambda: modbus.decode_request(frame("0146040001"), M_7017),
            (Fault.LENGTH, "", 5, "address and PDU of 7 bytes", "3.3.2"),
        ),
        (
            lambda: modbus.decode_response(frame("0104"), modbus.ReadInputRegisters(1, 0, 2), M_7017),
            (Fault.LENGTH, "", 2, "at least 5 bytes", "3"),
        ),
        (
            lambda: modbus.decode_response(frame("0204041234"), modbus.ReadInputRegisters(1, 0, 2), M_7017),
            (Fault.ADDRESS, "address", 0, "01", "3.2"),
        ),
        (
            lambda: modbus.decode_response(frame("0103041234"), modbus.ReadInputRegisters(1, 0, 2), M_7017),
            (Fault.FUNCTION, "function", 1, "04 84", "3.2"),
        ),
        (
            lambda: modbus.decode_response(frame("018301"), modbus.ReadInputRegisters(1, 0, 2), M_7017),
            (Fault.FUNCTION, "function", 1, "04 84", "3.2"),
        ),
        (
            lambda: modbus.decode_response(frame("01040200ff"), modbus.ReadInputRegisters(1, 0, 2), M_7017),
            (Fault.COUNT, "bytes", 2, "4, as requested", "3.2"),
        ),
        (
            lambda: modbus.decode_response(frame("0146040001"), modbus.ReadModuleName(1), M_7017),
            (Fault.SUB_FUNCTION, "sub_function", 2, "00", "3.3"),
        ),
        (
            lambda: modbus.decode_response(frame("01060005000700"), modbus.WriteSingleRegister(1, 5, 6), M_7017),
            (Fault.LENGTH, "", 6, "6 bytes of address and PDU", "3.4"),
        ),
        (
            lambda: modbus.decode_response(frame("010600050007"), modbus.WriteSingleRegister(1, 5, 6), M_7017),
            (Fault.ECHO, "", 5, "01 06 00 05 00 06", "3.4"),
        ),
        (
            lambda: modbus.decode_response(frame("01010200ff"), modbus.ReadCoils(1, 0, 3), M_7017),
            (Fault.COUNT, "bytes", 2, "1, as requested", "3.4"),
        ),
        (
            lambda: modbus.decode_response(frame("01462500ff"), modbus.ReadChannelMask(1), M_7017),
            (Fault.LENGTH, "", 3, "address and PDU of 3 bytes and more", "3.3.8"),
        ),
        (
            lambda: modbus.decode_response(frame("000600050006"), modbus.WriteSingleRegister(0, 5, 6), M_7017),
            (Fault.ADDRESS, "address", 0, "no response to a broadcast", "3.4"),
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
        (lambda: modbus.encode(1), "message must be Message"),  # type: ignore[arg-type]
        (lambda: modbus.encode(modbus.ReadModuleName(1), 1), "profile must be Profile"),  # type: ignore[arg-type]
        (lambda: modbus.encode(modbus.ReadModuleName(1), force=1), "force must be bool"),  # type: ignore[arg-type]
        (lambda: modbus.is_answered(1), "request must be Request"),  # type: ignore[arg-type]
        (lambda: modbus.decode_request(1, M_7017), "frame must be bytes, bytearray or memoryview"),  # type: ignore[arg-type]
        (lambda: modbus.decode_request(b"", 1), "profile must be Profile"),  # type: ignore[arg-type]
        (
            lambda: modbus.decode_response(1, modbus.ReadModuleName(1), M_7017),  # type: ignore[arg-type]
            "frame must be bytes, bytearray or memoryview",
        ),
        (lambda: modbus.decode_response(b"", 1, M_7017), "request must be Request"),  # type: ignore[arg-type]
        (lambda: modbus.decode_response(b"", modbus.ReadModuleName(1), 1), "profile must be Profile"),  # type: ignore[arg-type]
        (lambda: modbus.longest_response(1, M_7017), "request must be Request"),  # type: ignore[arg-type]
        (lambda: modbus.longest_response(modbus.ReadModuleName(1), 1), "profile must be Profile"),  # type: ignore[arg-type]
        (lambda: modbus.pause_after(1, M_7017), "request must be Request"),  # type: ignore[arg-type]
        (lambda: modbus.pause_after(modbus.ReadModuleName(1), 1), "profile must be Profile"),  # type: ignore[arg-type]
    ],
)
def test_an_argument_of_the_wrong_type_is_named(call: Callable[[], object], message: str) -> None:
    with pytest.raises(ArgumentError) as caught:
        call()

    assert str(caught.value) == f"{message}, not 1 (int)"
