"""What exchanges show of a module, and what of it contradicts what was known."""

from typing import Any

import pytest

from i7000 import (
    CharacterFormat,
    DataFormat,
    Firmware,
    LineSettings,
    ModbusDataFormat,
    Model,
    Profile,
    TypeCode,
    modbus,
)
from i7000.dissect import Known, Origin
from tests.dissect.hearing import contradictions, hear_all, last_heard, line_of

J, K, T, V_10 = TypeCode.J, TypeCode.K, TypeCode.T, TypeCode.V_10
SEVENTEEN = (Model.I_7017R, Model.M_7017R)
M_7019 = (Model.M_7019R, Model.M_7019Z)


def learned(*frames: str | bytes, known: Known | None = None, address: int = 0x01) -> dict[str, Any]:
    """The facts that were learned of a module."""
    line, _ = hear_all(line_of(known), frames)
    return {name: fact.value for name, fact in line.knowledge.of(address).facts.items()}


def exchange(request: modbus.Request[Any], response: modbus.Response) -> tuple[bytes, bytes]:
    profile = Profile(Model.M_7019R)
    return modbus.encode(request, profile), modbus.encode(response, profile)


VERSION = exchange(modbus.ReadFirmwareVersion(1), modbus.FirmwareVersion(1, 0x0B, 3, 7))


def read_register(address: int, *words: int) -> tuple[bytes, bytes]:
    return exchange(modbus.ReadHoldingRegisters(1, address, len(words)), modbus.HoldingRegisters(1, words))


def written(address: int, *words: int) -> tuple[bytes, bytes]:
    return exchange(
        modbus.WriteMultipleRegisters(1, address, words), modbus.MultipleRegistersWritten(1, address, len(words))
    )


# --- rows of the tables -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("frames", "facts"),
    [
        (
            ["$012", "!010F0640"],
            {
                "types": (K,), "data_format": DataFormat.ENGINEERING, "line_settings": LineSettings(), "checksum": True,
            },
        ),
        (["$012", "!01200643"], {"line_settings": LineSettings(), "checksum": True}),
        (["$018C2", "!01C2R0F"], {"types": (None, None, K, None)}),
        (["$018C2", "!01C2R20"], {}),
        (["$01M", "!017017R"], {"name": "7017R", "models": SEVENTEEN}),
        (["$01M", "!01Tank 1"], {"name": "Tank 1"}),
        (["$01F", "!01B3.7"], {"firmware": Firmware("B3.7")}),
        (["$016", "!01FE"], {"mask": 0xFE}),
        (["@01S", "!011"], {"single_ended": True}),
        (["~01OTank 1", "!01"], {"name": "Tank 1"}),
        (["~01OTank 1", "?01"], {}),
        (["$015FE", "!01"], {"mask": 0xFE}),
        (["@01S1", "!01"], {"single_ended": True}),
        (["$017C1R0E", "!01"], {"types": (None, J, None)}),
        (
            ["%01010F0700", "!01"],
            {
                "types": (K,), "data_format": DataFormat.ENGINEERING, "checksum": False,
                "line_settings": LineSettings(7, CharacterFormat.N81),
            },
        ),
        (exchange(modbus.ReadModuleName(1), modbus.ModuleName(1, bytes.fromhex("00701900"))), {"models": M_7019}),
        (VERSION, {"firmware": Firmware("B3.7")}),
        (exchange(modbus.ReadFirmwareVersion(1), modbus.FirmwareVersion(1, 0, 0, 0)), {}),
        (exchange(modbus.ReadTypeCode(1, 2), modbus.TypeCodeSetting(1, 0x0F)), {"types": (None, None, K, None)}),
        (exchange(modbus.SetTypeCode(1, 2, 0x0F), modbus.TypeCodeResult(1, 0)), {"types": (None, None, K, None)}),
        (exchange(modbus.SetTypeCode(1, 2, 0x0F), modbus.TypeCodeResult(1, 1)), {}),
        (exchange(modbus.ReadChannelMask(1), modbus.ChannelMask(1, 0x0F)), {"mask": 0x0F}),
        (exchange(modbus.SetChannelMask(1, 0x0F), modbus.ChannelMaskResult(1, 0)), {"mask": 0x0F}),
    ],
)  # fmt: skip
def test_an_exchange_shows_settings(frames: list[str | bytes], facts: dict[str, Any]) -> None:
    assert facts == learned(*frames)


def test_a_message_that_answers_nothing_shows_nothing() -> None:
    assert learned("!010F0600") == {}


def test_a_refusal_or_an_exception_shows_nothing() -> None:
    request = modbus.encode(modbus.WriteSingleRegister(1, 489, 7))

    assert learned("$012", "?01") == {}
    assert learned(request, modbus.encode(modbus.ExceptionResponse(1, 6, 3))) == {}


@pytest.mark.parametrize(
    ("model", "frames", "facts"),
    [
        (Model.M_7019R, read_register(489, 0x0F), {"mask": 0x0F}),
        (Model.M_7019R, read_register(257, 0x0F, 0x0E), {"types": (None, K, J, None)}),
        (Model.M_7019R, read_register(257, 0x0F, 0x20), {"types": (None, K, None)}),
        (Model.M_7019R, written(256, *[0x0F] * 8), {"types": (K,) * 8 + (None,)}),
        (Model.M_7017, read_register(486, 0x08), {"types": (V_10,)}),
        (Model.M_7019R, read_register(480, 0x0003, 0x0B07), {}),
        (Model.M_7019R, read_register(488, 100), {}),
        (None, read_register(489, 0x0F), {}),
        (Model.M_7019R, written(489, 0x03), {"mask": 0x03}),
        (
            Model.M_7019R,
            exchange(modbus.WriteSingleCoil(1, 268, True), modbus.SingleCoilWritten(1, 268, True)),
            {"modbus_data_format": ModbusDataFormat.ENGINEERING},
        ),
        (
            Model.M_7017Z,
            exchange(modbus.ReadCoils(1, 276, 1), modbus.Coils(1, (True, *[False] * 7))),
            {"single_ended": True},
        ),
    ],
)
def test_registers_show_settings(model: Model | None, frames: tuple[bytes, bytes], facts: dict[str, Any]) -> None:
    known = Known(model) if model else Known()

    assert facts == learned(*frames, known=known)


# --- changes ----------------------------------------------------------------------------------------------------------


def test_an_accepted_change_beats_what_was_given_and_holds() -> None:
    frames = ["%01010F0600", "!01", "$012", "!010F0600", "$012", "!01100600"]
    line, heard = hear_all(line_of(Known(Model.I_7018, types=(J,))), frames)

    assert [it.contradictions for it in heard[:4]] == [()] * 4
    assert heard[-1].contradictions == ("type 10 (T), but frame 2 said type 0F (K)",)
    assert line.knowledge.of(0x01).known.types == (T,)


def test_a_change_to_what_was_shown_already_beats_what_was_given_too() -> None:
    frames = ["$012", "!010F0600", "%01010F0600", "!01", "$012", "!010F0600"]

    assert contradictions(*frames, known=Known(Model.I_7018, types=(J,))) == [
        (), ("type 0F (K), but type 0E (J) was given",), (), (), (), (),
    ]  # fmt: skip


def test_the_change_of_one_channel_leaves_the_types_of_the_others() -> None:
    known = Known(Model.I_7019R, types=(K,))
    line, _ = hear_all(line_of(known), ["$017C1R0E", "!01"])

    assert line.knowledge.of(0x01).known.types == (K, J, *[K] * 6)


def test_where_the_model_is_unknown_the_types_of_later_channels_are_left_open() -> None:
    assert learned("$012", "!010F0600", "$017C1R0E", "!01")["types"] == (K, J, None)


def test_types_are_learned_a_channel_at_a_time() -> None:
    frames = [frame for at in range(8) for frame in (f"$018C{at}", f"!01C{at}R{0x0E + at % 2:02X}")]
    line, _ = hear_all(line_of(Known(Model.I_7019R)), frames)

    default = line.knowledge.of(0x01).known.default
    assert default is not None
    assert default.type_codes == (J, K) * 4


def test_a_type_of_one_channel_replaces_that_of_this_channel_only() -> None:
    known = Known(Model.I_7019R, types=(K, J) * 4)

    assert contradictions("$018C1", "!01C1R10", known=known)[-1] == (
        "type 0F (K) 10 (T) 0E (J), but type 0F (K) 0E (J) was given",
    )


# --- addresses --------------------------------------------------------------------------------------------------------


def test_what_is_known_of_a_module_moves_to_its_new_address() -> None:
    by_address = {0x01: Known(Model.I_7018)}
    line, heard = hear_all(line_of(by_address=by_address), ["%01020F0600", "!02", "#02", ">" + "+0025.1" * 8])

    assert list(line.knowledge.modules) == [0x02]
    assert line.knowledge.of(0x02).known.model is Model.I_7018
    assert heard[-1].meanings[0].readings[0].value == 25.1
    assert heard[1].answers == heard[0].place


def test_of_another_module_at_the_old_address_nothing_is_known() -> None:
    first, second = ["$01M", "!017018"], ["$01M", "!017019R"]

    assert contradictions(*first, "%01020F0600", "!02", *second) == [()] * 6


def test_a_new_address_that_is_refused_moves_nothing() -> None:
    line, _ = hear_all(line_of(by_address={0x01: Known(Model.I_7018)}), ["%01020F0600", "?01"])

    assert list(line.knowledge.modules) == [0x01]


@pytest.mark.parametrize(
    ("frames", "addresses"),
    [
        (exchange(modbus.SetModuleAddress(1, 2), modbus.ModuleAddressResult(1, 0)), [2]),
        (exchange(modbus.SetModuleAddress(1, 2), modbus.ModuleAddressResult(1, 1)), [1]),
        (written(484, 2), [2]),
        (written(488, 2), [1]),
        (written(484, 1), [1]),
        (exchange(modbus.WriteSingleRegister(1, 484, 2), modbus.ExceptionResponse(1, 6, 3)), [1]),
    ],
)
def test_a_module_moves_by_modbus_too(frames: tuple[bytes, bytes], addresses: list[int]) -> None:
    line, _ = hear_all(line_of(by_address={0x01: Known(Model.M_7019R)}), frames)

    assert addresses == list(line.knowledge.modules)


# --- contradictions ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("known", "frames", "said"),
    [
        (Known(types=(J,)), ["$012", "!010F0600"], "type 0F (K), but type 0E (J) was given"),
        (Known(firmware=Firmware("B1.5")), ["$01F", "!01B3.7"], "firmware B3.7, but firmware B1.5 was given"),
        (
            Known(Model.I_7018),
            ["$01M", "!017019R"],
            "an I-7019R or M-7019R by its name, but an I-7018 was given",
        ),
        (Known(types=(K,)), ["$01M", "!017017R"], "an I-7017R or M-7017R does not go with type 0F (K)"),
        (
            Known(Model.I_7018),
            ["$012", "!01080600"],
            "an I-7018 has no type 08, -10..10 V; another model?",
        ),
        (
            Known(Model.I_7018),
            ["%0101080600", "!01"],
            "an I-7018 has no type 08, -10..10 V; another model?",
        ),
        (
            Known(Model.M_7018),
            exchange(modbus.ReadTypeCode(1, 0), modbus.TypeCodeSetting(1, 0x08)),
            "an M-7018 has no type 08, -10..10 V; another model?",
        ),
        (
            Known(Model.I_7018, data_format=DataFormat.HEX),
            ["$012", "!010F0600"],
            "data format engineering, but data format hex was given",
        ),
        (
            Known(Model.I_7017Z, single_ended=True),
            ["@01S", "!010"],
            "differential, but single-ended was given",
        ),
        (
            Known(models=(Model.I_7018,)),
            ["$01M", "!017019R"],
            "an I-7019R or M-7019R, but an I-7018 was given",
        ),
    ],
)
def test_what_was_given_and_is_contradicted_is_reported_every_time(
    known: Known, frames: list[str | bytes], said: str
) -> None:
    assert contradictions(*frames, *frames, known=known) == [(), (said,), (), (said,)]


@pytest.mark.parametrize(
    ("frames", "said"),
    [
        (["$012", "!010F0600", "$012", "!01100600"], "type 10 (T), but frame 2 said type 0F (K)"),
        (["$016", "!01FF", "$016", "!010F"], "mask 0F, channels 0, 1, 2, 3, but frame 2 said mask FF, channels 0, 1"),
        (["$01F", "!01B3.7", "$01F", "!01B3.6"], "firmware B3.6, but frame 2 said firmware B3.7; two modules on one"),
        (["@01S", "!011", "@01S", "!010"], "differential, but frame 2 said single-ended"),
        (["$012", "!010F0600", "$012", "!010F0700"], "line settings 07, 19200 baud, N81, but frame 2 said line set"),
        (["$01M", "!01one", "$01M", "!01two"], "name two, but frame 2 said name one; two modules on one address?"),
    ],
)
def test_what_was_learned_and_is_contradicted_is_reported(frames: list[str], said: str) -> None:
    (contradiction,) = last_heard(*frames).contradictions

    assert contradiction.startswith(said)


def test_two_modules_with_names_from_the_factory_are_told_apart_by_name_and_model() -> None:
    assert last_heard("$01M", "!017018", "$01M", "!017019R").contradictions == (
        "name 7019R, but frame 2 said name 7018; two modules on one address?",
        "an I-7019R or M-7019R, but frame 2 said an I-7018 or M-7018; two modules on one address?",
    )


def test_a_type_that_no_module_of_the_learned_name_has_is_not_learned() -> None:
    frames = ["$01M", "!017018", "$012", "!01080600"]

    assert "types" not in learned(*frames)
    assert last_heard(*frames).contradictions == ("an I-7018 or M-7018 has no type 08, -10..10 V; another model?",)


def test_names_by_both_protocols_leave_the_models_that_have_both() -> None:
    name = exchange(modbus.ReadModuleName(1), modbus.ModuleName(1, bytes.fromhex("00701900")))

    assert learned("$01M", "!017019R", *name)["models"] == (Model.M_7019R,)


def test_types_of_all_channels_and_of_one_can_both_be_true() -> None:
    assert contradictions("$012", "!010F0600", "$018C2", "!01C2R0F")[-1] == ()
    assert learned("$012", "!010F0600", "$018C2", "!01C2R0F")["types"] == (K,)
    assert contradictions("$018C2", "!01C2R0F", "$018C3", "!01C3R0E")[-1] == ()
    assert contradictions("$018C2", "!01C2R0F", "$012", "!010E0600")[-1] == (
        "type 0E (J), but frame 2 said type 0F (K)",
    )


# --- where a fact comes from ------------------------------------------------------------------------------------------


def test_a_meaning_says_which_frame_showed_the_facts_that_it_rests_on() -> None:
    facts = last_heard("$012", "!010F0600", "#01", ">" + "+0025.1" * 8, known=Known(Model.I_7018)).meanings[0].facts

    assert [(fact.name, fact.origin, fact.where) for fact in facts] == [
        ("types", Origin.LEARNED, "frame 2"),
        ("data_format", Origin.LEARNED, "frame 2"),
    ]


@pytest.mark.parametrize(("types", "origin"), [((V_10,), Origin.GIVEN), (None, Origin.ASSUMED)])
def test_a_meaning_says_which_facts_were_given_or_assumed(types: tuple[TypeCode] | None, origin: Origin) -> None:
    (meaning,) = last_heard("#010", ">+02.500", known=Known(Model.I_7017, types=types)).meanings

    assert (meaning.facts[0].name, meaning.facts[0].origin) == ("types", origin)


def test_a_name_that_was_set_does_not_show_the_model() -> None:
    assert learned("~01O7019R", "!01", "$01M", "!017019R") == {"name": "7019R"}
