"""What is known of modules: every profile that fits, and which fact beats which."""

from typing import Any

import pytest
from hypothesis import given

from i7000 import (
    DataFormat,
    EncodeError,
    Firmware,
    InvalidValueError,
    LineSettings,
    ModbusDataFormat,
    Model,
    Profile,
    Protocol,
    TypeCode,
)
from i7000.dissect import Fact, Knowledge, Known, Module, Origin
from i7000.dissect.known import fact_words, lacking_type
from tests.dissect.strategies import knowns

J, K, V_10 = TypeCode.J, TypeCode.K, TypeCode.V_10


# --- profiles ---------------------------------------------------------------------------------------------------------


def test_a_profile_is_known_as_a_whole() -> None:
    profile = Profile(Model.M_7019R, data_format=DataFormat.HEX, checksum=True)

    assert Known.of(profile).all == (profile,)
    assert Known.of(profile).default == profile


def test_a_profile_without_types_leaves_them_unknown() -> None:
    assert Known.of(Profile(Model.I_7018BL)).types is None


def test_of_an_unknown_model_there_is_no_default() -> None:
    assert Known().default is None


def test_what_is_unknown_of_a_known_model_has_the_factory_default() -> None:
    known = Known(Model.I_7018, types=(K,))

    assert known.default == Profile(Model.I_7018, type_codes=(K,) * 8)


def test_every_model_fits_where_none_is_known() -> None:
    assert {profile.model for profile in Known().all} == set(Model)
    assert {profile.model for profile in Known(models=(Model.I_7017, Model.M_7017)).all} == {
        Model.I_7017, Model.M_7017,
    }  # fmt: skip


def test_formats_checksums_modes_and_old_firmware_that_are_unknown_are_all_tried() -> None:
    profiles = Known(Model.I_7017Z).all

    assert {profile.data_format for profile in profiles} == set(DataFormat)
    assert {profile.checksum for profile in profiles} == {False, True}
    assert {profile.single_ended for profile in profiles} == {False, True}
    assert {profile.legacy_sentinels for profile in Known(Model.I_7018P).all} == {False, True}


def test_a_type_leaves_the_models_that_have_it() -> None:
    assert {profile.model for profile in Known(types=(TypeCode.V_150,)).all} == {Model.I_7017R_A5, Model.M_7017R_A5}


@pytest.mark.parametrize(
    "known",
    [
        Known(Model.I_7018, types=(V_10,)),
        Known(Model.I_7018, types=(K, J)),
        Known(Model.I_7018, single_ended=True),
        Known(Model.I_7019R, types=(*[None] * 8, K)),
        Known(models=(Model.I_7018, Model.M_7018), types=(V_10,)),
    ],
)
def test_a_combination_that_no_module_has_fits_nothing(known: Known) -> None:
    with pytest.raises(EncodeError):
        _ = known.all


def test_types_of_some_channels_leave_the_default_to_the_others() -> None:
    known = Known(Model.M_7019R, types=(None, K))

    assert known.partial
    assert known.default is not None
    first, second, *others = known.default.type_codes
    assert (second, others) == (K, [first] * 6)


def test_types_of_some_channels_of_a_model_without_default_types_are_left_open() -> None:
    assert {profile.type_codes for profile in Known(Model.I_7018BL, types=(None, K)).all} == {()}


# --- Modbus -----------------------------------------------------------------------------------------------------------


def test_by_modbus_the_models_that_speak_it_fit() -> None:
    profiles = Known().modbus

    assert {profile.model for profile in profiles} == {it for it in Model if Protocol.MODBUS_RTU in it.protocols}
    assert {profile.modbus_data_format for profile in profiles} == {ModbusDataFormat.HEX}
    assert {it.modbus_data_format for it in Known(modbus_data_format=ModbusDataFormat.ENGINEERING).modbus} == {
        ModbusDataFormat.ENGINEERING
    }


def test_types_leave_the_models_that_have_them_by_modbus_too() -> None:
    assert {profile.model for profile in Known(types=(TypeCode.V_150,)).modbus} == {Model.M_7017R_A5}


@pytest.mark.parametrize(
    ("known", "said"),
    [
        (Known(Model.I_7018), "model cannot be 'I-7018': the M-7000 series"),
        (Known(Model.M_7018, types=(V_10,)), "type_codes cannot be"),
    ],
)
def test_what_cannot_speak_modbus_fits_nothing_by_modbus(known: Known, said: str) -> None:
    with pytest.raises(EncodeError, match=said):
        _ = known.modbus


@given(knowns)
def test_every_profile_that_fits_has_what_is_known(known: Known) -> None:
    assert known.all
    for profile in (*known.all, *filter(None, (known.default,))):
        for name in ("model", "firmware", "data_format", "checksum", "single_ended"):
            if getattr(known, name) is not None:
                assert getattr(known, name) == getattr(profile, name)
        if profile.type_codes:
            padded = (*(known.types or ()), *[None] * 20)
            types = known.types * 20 if known.types and len(known.types) == 1 else padded
            assert all(one in (None, other) for one, other in zip(types, profile.type_codes, strict=False))


# --- facts of a module ------------------------------------------------------------------------------------------------


def test_what_is_given_beats_what_was_learned_and_that_the_factory_default() -> None:
    learned = Module().learn(Fact("types", (K,)))
    given_too = Module(Known(types=(J,))).learn(Fact("types", (K,)))

    assert Module().known.types is None
    assert learned.known.types == (K,)
    assert given_too.known.types == (J,)


def test_a_change_beats_what_is_given() -> None:
    module = Module(Known(types=(J,))).learn(Fact("types", (K,), changed=True))

    assert module.known.types == (K,)
    assert [fact.name for fact in module.learned] == ["types"]


def test_the_models_of_a_name_do_not_matter_where_the_model_is_known() -> None:
    fact = Fact("models", (Model.I_7018, Model.M_7018))

    assert Module().learn(fact).known.models == (Model.I_7018, Model.M_7018)
    assert Module(Known(Model.I_7017)).learn(fact).known.models == ()


def test_what_makes_a_combination_that_no_module_has_is_not_learned() -> None:
    module = Module(Known(Model.I_7018))

    assert module.learn(Fact("types", (V_10,))) is module


def test_what_says_nothing_of_how_frames_are_read_is_learned_and_changes_nothing() -> None:
    module = Module().learn(Fact("name", "Tank 1"))

    assert module.known == Known()
    assert module.facts["name"].value == "Tank 1"
    assert module.learned == ()


def test_facts_can_be_dropped() -> None:
    module = Module().learn(Fact("types", (K,))).learn(Fact("checksum", value=True))

    assert module.without(["types", "nothing"]).known == Known(checksum=True)


def test_types_of_more_channels_go_with_the_connecting_mode_that_has_them() -> None:
    types = (None,) * 19 + (TypeCode.V_10,)
    facts = {
        "single_ended": Fact("single_ended", True, Origin.LEARNED, "frame 2"),
        "types": Fact("types", types, Origin.LEARNED, "frame 4"),
    }
    module = Module(Known(Model.I_7017Z), facts)

    assert module.known.types == types
    assert module.without(["single_ended"]).known == Known(Model.I_7017Z)


def test_no_module_is_given_that_cannot_be() -> None:
    with pytest.raises(EncodeError):
        Module(Known(Model.I_7018, types=(V_10,)))
    with pytest.raises(EncodeError):
        Knowledge.given(Known(), {0x01: Known(Model.I_7018, types=(V_10,))})


def test_what_is_known_cannot_be_changed_from_outside() -> None:
    facts = {"checksum": Fact("checksum", value=True)}
    module = Module(facts=facts)
    facts.clear()

    assert module.known.checksum is True
    with pytest.raises(TypeError):
        module.facts["types"] = Fact("types", (K,))  # type: ignore[index]


# --- a line -----------------------------------------------------------------------------------------------------------


def test_an_address_that_is_unknown_has_what_is_known_of_the_others() -> None:
    knowledge = Knowledge.given(Known(checksum=True), {0x01: Known(Model.I_7018)})

    assert knowledge.of(0x01).known == Known(Model.I_7018)
    assert knowledge.of(0x02).known == knowledge.of(None).known == Known(checksum=True)


def test_a_module_can_be_put_at_an_address_and_moved_to_another() -> None:
    module = Module(Known(Model.I_7018))
    knowledge = Knowledge().put(0x01, module)
    moved = knowledge.move(0x01, 0x02)

    assert knowledge.of(0x01) is module
    assert (moved.of(0x02), moved.of(0x01)) == (module, moved.others)
    assert list(moved.move(0x02, 0x02).modules) == [0x02]


# --- in words ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("types", (K,), "type 0F (K)"),
        ("types", (K, None, J, K), "type 0F (K) 0E (J)"),
        ("checksum", True, "with a checksum"),
        ("checksum", False, "without a checksum"),
        ("single_ended", True, "single-ended"),
        ("single_ended", False, "differential"),
        ("model", Model.I_7018, "an I-7018"),
        ("models", (Model.I_7018, Model.M_7018), "an I-7018 or M-7018"),
        ("firmware", Firmware("B3.7"), "firmware B3.7"),
        ("data_format", DataFormat.HEX, "data format hex"),
        ("modbus_data_format", ModbusDataFormat.ENGINEERING, "modbus data format engineering"),
        ("line_settings", LineSettings(), "line settings 06, 9600 baud, N81"),
        ("mask", 0x03, "mask 03, channels 0, 1"),
        ("name", "Tank 1", "name Tank 1"),
    ],
)
def test_facts_have_words(name: str, value: Any, words: str) -> None:
    assert fact_words(Fact(name, value)) == words


@pytest.mark.parametrize(
    ("known", "code", "said"),
    [
        (Known(Model.I_7018), 0x08, "an I-7018 has no type 08, -10..10 V"),
        (
            Known(models=(Model.I_7018, Model.M_7018)),
            0x99,
            "an I-7018 or M-7018 has no type 99, not defined",
        ),
        (Known(Model.I_7018), 0x0F, None),
        (Known(Model.I_7018), 0xFF, None),
        (Known(Model.I_7018), None, None),
        (Known(), 0x99, None),
    ],
)
def test_a_type_that_a_model_lacks_is_said(known: Known, code: int | None, said: str | None) -> None:
    assert said == lacking_type(known, code)


def test_a_fact_says_where_it_comes_from() -> None:
    assert Fact("types", (K,)).origin is Origin.LEARNED
    assert str(Origin.ASSUMED) == "assumed"


@pytest.mark.parametrize(
    ("make", "arguments"),
    [
        (Known, {"model": "I-7018"}),
        (Known, {"types": K}),
        (Known, {"types": (15,)}),
        (Known, {"types": ()}),
        (Known, {"checksum": 1}),
        (Known, {"models": [Model.I_7018]}),
        (Known, {"models": (None,)}),
        (Known.of, {"profile": Model.I_7018}),
        (Fact, {"name": "types", "value": []}),
        (Fact, {"name": "types", "value": (K,), "origin": "learned"}),
        (Module, {"given": Model.I_7018}),
        (Module, {"facts": {"types": (K,)}}),
        (Module, {"facts": {"checksum": Fact("types", (K,))}}),
        (Module, {"facts": {"types": Fact("types", (15,))}}),
        (Knowledge, {"others": Known()}),
        (Knowledge, {"modules": {0x01: Known()}}),
        (Knowledge, {"modules": {256: Module()}}),
        (Knowledge, {"modules": {True: Module()}}),
        (Knowledge.given, {"others": Known(), "by_address": {"1": Known()}}),
    ],
)
def test_values_of_another_kind_are_refused(make: Any, arguments: dict[str, Any]) -> None:
    with pytest.raises(InvalidValueError):
        make(**arguments)
