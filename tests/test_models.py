"""Models, firmware, series and profiles: what is possible, and that what is not is refused with the reason."""

from typing import Any

import pytest
from attrs import evolve

from i7000 import DataFormat, EncodeError, Firmware, ModbusDataFormat, Model, Profile, TypeCode, series


@pytest.mark.parametrize("text", ["B3.9", "B309", "A2.0", "B405", "B3.10"])
def test_a_firmware_is_read_in_both_ways_of_writing(text: str) -> None:
    assert Firmware(text) == Firmware(str(Firmware(text)))


@pytest.mark.parametrize(
    "text",
    ["", "B", "3.9", "b3.9", "B3", "B3.", "B3.9 ", "B39", "B3.123", "B3.9\n", "Б3.9", "B\u0663.\u0669", None, 39],
)
def test_what_is_no_firmware_is_refused(text: Any) -> None:
    with pytest.raises(EncodeError, match="firmware cannot be"):
        Firmware(text)


def test_firmware_is_ordered_by_numbers() -> None:
    ordered = [Firmware(text) for text in ("A1.9", "A2.0", "B1.4", "B2.9", "B2.10", "B305", "B3.6", "C1.0")]

    assert ordered == sorted(set(ordered))
    assert repr(Firmware("B405")) == "Firmware('B4.5')"
    assert len({Firmware("B405"), Firmware("B4.5")}) == 1
    assert Firmware("B4.5") != "B4.5"


@pytest.mark.parametrize(
    ("names", "models"),
    [
        (("I-7019",), {Model.I_7019R}),
        (("7019",), {Model.I_7019R, Model.M_7019R, Model.M_7019Z}),
        (("7017Z",), {Model.I_7017Z, Model.M_7017Z}),
        (("I-7018R", "M-7018R"), {Model.I_7018R, Model.M_7018R}),
        (("M-7018",), {Model.M_7018, Model.M_7018R, Model.M_7018Z, Model.M_7018_16}),
    ],
)
def test_a_series_is_all_its_variations(names: tuple[str, ...], models: set[Model]) -> None:
    assert models == series(*names)


def test_the_three_series_are_all_models() -> None:
    assert set(Model) == series("7017", "7018", "7019")
    assert not series("7017") & series("7018")


@pytest.mark.parametrize("name", ["", "7016", "I-70", "7017Q"])
def test_a_series_that_does_not_exist_is_refused(name: str) -> None:
    with pytest.raises(EncodeError, match="series cannot be"):
        series(name)


def test_a_model_is_found_by_its_name_in_any_case() -> None:
    assert Model.M_7017mC_16 is Model.find("m-7017MC-16")
    assert Model.M_7019R is Model.find("M-7019")
    assert all(model is Model.find(model.value) for model in Model)


def test_an_unknown_model_is_answered_with_the_near_ones() -> None:
    with pytest.raises(EncodeError, match="I-7019R, M-7019R, M-7019Z"):
        Model.find("7019Q")
    with pytest.raises(EncodeError, match="model cannot be 3"):
        Model.find(3)  # type: ignore[arg-type]
    with pytest.raises(EncodeError, match=r"I-7017, .* M-7019Z"):
        Model.find("Q")


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
        (Model.I_7017, {"type_codes": (TypeCode.V_10,) * 7}, "type_codes", "8 of them, or none"),
        (Model.I_7017, {"type_codes": [TypeCode.V_10] * 8}, "type_codes", "a tuple"),
        (Model.I_7017, {"type_codes": (0x08,) * 8}, "type_codes", "cannot be 8: members of TypeCode"),
        (Model.I_7017, {"type_codes": ([],) * 8}, "type_codes", "members of TypeCode"),
        (
            Model.I_7017,
            {"type_codes": (TypeCode.V_10,) * 7 + (TypeCode.V_5,)},
            "type_codes",
            "one type for all channels",
        ),
        (Model.I_7017, {"type_codes": (TypeCode.MA_4_20,) * 8, "firmware": Firmware("B2.1")}, "type_codes", "08 09 0A"),
        (Model.M_7017, {"single_ended": True}, "single_ended", "7017Z only"),
        (Model.M_7017Z, {"single_ended": 1}, "single_ended", "a bool"),
        (Model.M_7017Z, {"checksum": None}, "checksum", "a bool"),
        (Model.M_7017Z, {"data_format": 2}, "data_format", "a DataFormat"),
        (Model.M_7017Z, {"modbus_data_format": 0}, "modbus_data_format", "a ModbusDataFormat"),
        (Model.I_7017, {"modbus_data_format": ModbusDataFormat.ENGINEERING}, "modbus_data_format", "no Modbus"),
        (Model.I_7017, {"firmware": "B2.2"}, "firmware", "a Firmware, or None"),
        ("I-7017", {}, "model", "a Model"),
        ("I-7017", {"type_codes": ()}, "model", "a Model"),
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


def test_the_types_of_a_model_cannot_be_changed() -> None:
    types: Any = Model.I_7018.type_codes

    with pytest.raises(TypeError):
        types[TypeCode.V_10] = None


@pytest.mark.parametrize(
    "value", [Firmware("B3.9"), True, (TypeCode.V_10,) * 8, DataFormat.HEX, ModbusDataFormat.HEX], ids=repr
)
def test_only_the_model_of_a_profile_can_go_without_its_name(value: Any) -> None:
    with pytest.raises(TypeError, match="positional argument"):
        Profile(Model.M_7017, value)  # type: ignore[call-arg]
