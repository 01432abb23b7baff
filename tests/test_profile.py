"""Profiles: what is possible, what the module can be set to, and that anything else is refused with the reason."""

import sys
from collections.abc import Callable
from typing import Any

import pytest
from attrs import evolve

from i7000 import (
    BaudRate,
    CharacterFormat,
    DataFormat,
    EncodeError,
    Filter,
    Firmware,
    LineSettings,
    ModbusDataFormat,
    Model,
    Profile,
    ReportSettings,
    TypeCode,
)


@pytest.mark.parametrize("model", Model, ids=lambda model: model.value)
def test_every_model_has_a_factory_profile(model: Model) -> None:
    profile = Profile(model)

    assert profile == evolve(profile)
    assert len(profile.type_codes) == (0 if model is Model.I_7018BL else model.channels)
    assert len(profile.units) == len(profile.type_codes)
    assert profile.individually_configurable == model.individually_configurable


def test_single_ended_inputs_are_twenty() -> None:
    profile = Profile(Model.I_7017Z, single_ended=True)

    assert (profile.channels, profile.channel_digits, profile.mask_digits) == (20, 2, 6)


@pytest.mark.parametrize(
    ("model", "values", "field", "reason"),
    [
        (Model.I_7018, {"type_codes": (TypeCode.V_10,) * 8}, "type_codes", "I-7018"),
        (
            Model.I_7017,
            {"type_codes": (TypeCode.V_10,) * 7},
            "type_codes",
            "8 type codes, or none, on I-7017",
        ),
        (Model.I_7017, {"type_codes": [TypeCode.V_10] * 8}, "type_codes", "an instance of tuple"),
        (Model.I_7017, {"type_codes": (0x08,) * 8}, "type_codes", "cannot be 8: members of TypeCode"),
        (Model.I_7017, {"type_codes": ([],) * 8}, "type_codes", "members of TypeCode"),
        (
            Model.I_7017,
            {"type_codes": (TypeCode.V_10,) * 7 + (TypeCode.V_5,)},
            "type_codes",
            "one type for all channels",
        ),
        (
            Model.I_7017,
            {"type_codes": (TypeCode.MA_4_20,) * 8, "firmware": Firmware("B2.1")},
            "type_codes",
            "V_10 V_5 V_1_0A",
        ),
        (Model.M_7017, {"single_ended": True}, "single_ended", "7017Z only"),
        (Model.M_7017Z, {"single_ended": 1}, "single_ended", "True or False"),
        (Model.M_7017Z, {"checksum": None}, "checksum", "True or False"),
        (Model.M_7017Z, {"data_format": 2}, "data_format", "a member of DataFormat"),
        (Model.M_7017Z, {"modbus_data_format": 0}, "modbus_data_format", "a member of ModbusDataFormat"),
        (Model.I_7017, {"modbus_data_format": ModbusDataFormat.ENGINEERING}, "modbus_data_format", "no Modbus"),
        (Model.I_7017, {"firmware": "B2.2"}, "firmware", "a Firmware, or None"),
        ("I-7017", {}, "model", "a member of Model"),
        ("I-7017", {"type_codes": ()}, "model", "a member of Model"),
    ],
)
def test_an_impossible_profile_is_refused_with_the_reason(model: Any, values: Any, field: str, reason: str) -> None:
    with pytest.raises(EncodeError, match=reason) as caught:
        Profile(model, **values)

    assert field == caught.value.field


def test_mixed_types_are_possible_from_the_firmware_that_has_them() -> None:
    mixed = (TypeCode.V_10,) * 7 + (TypeCode.V_5,)

    assert mixed == Profile(Model.M_7017R, firmware=Firmware("B3.9"), type_codes=mixed).type_codes
    with pytest.raises(EncodeError, match="one type for all"):
        Profile(Model.M_7017R, firmware=Firmware("B3.8"), type_codes=mixed)


@pytest.mark.parametrize(
    ("model", "firmware", "legacy"),
    [
        (Model.I_7018, "B1.4", True),
        (Model.I_7018P, "A3.0", True),
        (Model.I_7018, "B1.5", False),
        (Model.I_7018, None, False),
        (Model.M_7018, "B1.4", False),
        (Model.I_7017, "B1.4", False),
    ],
)
def test_five_character_sentinels_are_those_of_old_7018s_only(model: Model, firmware: str | None, legacy: bool) -> None:  # noqa: FBT001
    version = None if firmware is None else Firmware(firmware)

    assert legacy is Profile(model, firmware=version).legacy_sentinels


def test_a_changed_copy_derives_anew() -> None:
    profile = evolve(Profile(Model.I_7018, firmware=Firmware("B1.4")), firmware=None, data_format=DataFormat.HEX)

    assert not profile.legacy_sentinels


def test_a_code_that_is_no_type_is_not_supported() -> None:
    assert not Profile(Model.M_7019R).supports(0xFF)
    assert Profile(Model.M_7019R).supports(0x0F)


@pytest.mark.parametrize(
    "value", [Firmware("B3.9"), True, (TypeCode.V_10,) * 8, DataFormat.HEX, ModbusDataFormat.HEX], ids=repr
)
def test_only_the_model_of_a_profile_can_go_without_its_name(value: Any) -> None:
    with pytest.raises(TypeError, match="positional argument"):
        Profile(Model.M_7017, value)  # type: ignore[call-arg]


I_7018, M_7017Z = Profile(Model.I_7018), Profile(Model.M_7017Z, single_ended=True)
OLD = Profile(Model.M_7019R, firmware=Firmware("B2.6"))


@pytest.mark.parametrize(
    ("check", "taken", "refused", "reason"),
    [
        (I_7018.check_channel, (0, 7), (8, -1), "0..7 on I-7018"),
        (M_7017Z.check_channel, (19,), (20,), "0..19 on M-7017Z"),
        (I_7018.check_mask, (0, 0xFF), (0x100, -1), "I-7018 has no channel 8: 0..7"),
        (M_7017Z.check_mask, (0xFFFFF,), (0x100000,), "M-7017Z has no channel 20: 0..19"),
        (I_7018.check_type_code, (0x05, TypeCode.K), (0x08, 0xFF), "MV_15 MV_50 .* on I-7018"),
        (
            I_7018.check_line,
            (LineSettings(BaudRate.BAUD_115200), LineSettings(character_format=CharacterFormat.O81)),
            (LineSettings(0x02), LineSettings(0x0B)),
            "03..0A",
        ),
        (
            OLD.check_line,
            (LineSettings(),),
            (LineSettings(character_format=CharacterFormat.N82),),
            r"N81 with firmware before B3\.1 on M-7019R",
        ),
        (I_7018.check_report, (ReportSettings(DataFormat.HEX),), (ReportSettings(3),), r"0\.\.2"),
        (I_7018.check_report, (ReportSettings(),), (ReportSettings(reserved=1),), "reserved cannot be 1: 0"),
        (M_7017Z.check_report, (ReportSettings(fast_mode=True),), (), ""),
        (I_7018.check_report, (), (ReportSettings(fast_mode=True),), "I-7018 has no fast mode"),
        (I_7018.check_report, (ReportSettings(filter=Filter.REJECT_50_HZ),), (), ""),
        (OLD.check_report, (), (ReportSettings(filter=Filter.REJECT_50_HZ),), r"reserved with firmware before B2\.7"),
        (I_7018.check_cjc_offset, (-0x1000, 0x1000), (-0x1001, 0x1001), r"-4096\.\.\+4096 counts of 0\.01 degC"),
        (I_7018.check_name, ("7018", "OVEN 2"), ("", "SEVEN 7", "0506", "A2.0", "A#"), "1 to 6 characters"),
    ],
)
def test_what_the_module_cannot_be_set_to_is_refused_with_the_reason(
    check: Callable[[Any, str], None], taken: tuple[Any, ...], refused: tuple[Any, ...], reason: str
) -> None:
    for value in taken:
        check(value, "2.1")
    for value in refused:
        with pytest.raises(EncodeError, match=f"{reason}.*, manual 2.1"):
            check(value, "2.1")


def calls_of(function: Callable[[], object]) -> int:
    """The calls of functions, in Python and in C, that a call takes when it is made again."""
    function()
    count = 0

    def count_call(_: object, event: str, __: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    before = sys.getprofile()
    sys.setprofile(count_call)
    try:
        function()
    finally:
        sys.setprofile(before)
    return count


@pytest.mark.parametrize("model", [Model.M_7017, Model.I_7018BL, Model.M_7017Z], ids=lambda model: model.value)
def test_a_profile_is_made_and_changed_in_few_calls(model: Model) -> None:
    profile = Profile(model)

    assert calls_of(lambda: Profile(model)) <= 20
    assert calls_of(lambda: evolve(profile, checksum=True)) <= 30


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"model": "M-7017"}, "model cannot be 'M-7017': a member of Model"),
        ({"checksum": 1}, "checksum cannot be 1: True or False"),
        ({"firmware": "B2.9"}, "firmware cannot be 'B2.9': a Firmware, or None for the newest"),
    ],
)
def test_a_field_of_another_type_is_refused_in_words(fields: Any, message: str) -> None:
    with pytest.raises(EncodeError) as refused:
        Profile(**{"model": Model.I_7018} | fields)

    assert str(refused.value) == message
