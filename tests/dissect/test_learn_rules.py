"""How long what was learned stays: one odd response, another module in its place, writes to all modules at once."""

from typing import Any

import pytest

from i7000 import DataFormat, Firmware, ModbusDataFormat, Model, Profile, TypeCode, dcon, modbus
from i7000.dissect import Known, Origin
from tests.dissect.hearing import contradictions, hear_all, last_heard, line_of

J, K, T, V_10 = TypeCode.J, TypeCode.K, TypeCode.T, TypeCode.V_10
M_7019R = Known(Model.M_7019R)
ODD, GOOD = ">+0152.4", ">+02.510"
ASKED_TYPE = ["$012", "!01080600"]


def sealed(body: str) -> str:
    return dcon.seal(body.encode(), checksum=True)[:-1].decode()


def exchange(request: modbus.Request[Any], response: modbus.Response) -> tuple[bytes, bytes]:
    profile = Profile(Model.M_7019R)
    return modbus.encode(request, profile), modbus.encode(response, profile)


def named(series: str) -> tuple[bytes, bytes]:
    name = bytes.fromhex(f"00{series}00")
    return exchange(modbus.ReadModuleName(1), modbus.ModuleName(1, name))


def row(address: int, *words: int) -> tuple[bytes, bytes]:
    return exchange(modbus.ReadHoldingRegisters(1, address, len(words)), modbus.HoldingRegisters(1, words))


def typed(channel: int, code: int) -> tuple[bytes, bytes]:
    return exchange(modbus.ReadTypeCode(1, channel), modbus.TypeCodeSetting(1, code))


def facts(*frames: str | bytes, known: Known | None = None, address: int = 0x01) -> dict[str, Any]:
    line, _ = hear_all(line_of(known), frames)
    return {name: fact.value for name, fact in line.knowledge.of(address).facts.items()}


# --- one odd response -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("model", "learned", "odd", "good", "name"),
    [
        (Model.I_7017, ASKED_TYPE, ["#010", ODD], ["#010", GOOD], "types"),
        (Model.I_7017, ["$012", "!01080602"], ["#01", ">" + "+02.510" * 8], ["#01", ">" + "7FFF" * 8], "data_format"),
        (Model.I_7019R, ["$018C0", "!01C0R0F"], ["#010", ">+02.510"], ["#010", ">+0025.1"], "types"),
        (None, ["$01M", "!017018"], ["#01", ">" + "+0025.1" * 10], ["#01", ">" + "+0025.1" * 8], "models"),
    ],
)
def test_one_odd_response_is_a_contradiction_and_what_was_learned_stays(
    model: Model | None, learned: list[str], odd: list[str], good: list[str], name: str
) -> None:
    known = Known(model)
    before = facts(*learned, known=known)

    assert name in before
    assert facts(*learned, *odd, known=known) == before
    assert len(last_heard(*learned, *odd, known=known).contradictions) == 1
    assert last_heard(*learned, *odd, *good, known=known).contradictions == ()


def test_what_two_responses_in_a_row_contradict_is_no_longer_known() -> None:
    frames = [*ASKED_TYPE, "#010", ODD, "#010", ODD]
    said = ("not type 08 (V_10), which frame 2 said",)

    assert contradictions(*frames, "#010", ODD, known=Known(Model.I_7017)) == [(), (), (), said, (), said, (), ()]
    assert "types" not in facts(*frames, known=Known(Model.I_7017))


def test_a_report_says_which_learned_facts_it_was_read_without() -> None:
    (meaning,) = last_heard(*ASKED_TYPE, "#010", ODD, known=Known(Model.I_7017)).meanings

    assert [(fact.name, fact.where) for fact in meaning.refuted] == [("types", "frame 2")]


def test_a_response_of_the_same_kind_that_fits_takes_the_doubt_away() -> None:
    frames = [*ASKED_TYPE, *["#010", ODD, "#010", GOOD] * 3]

    assert [len(said) for said in contradictions(*frames, known=Known(Model.I_7017))[3::2]] == [1, 0] * 3
    assert facts(*frames, known=Known(Model.I_7017))["types"] == (V_10,)


def test_a_response_of_another_kind_does_not_take_the_doubt_away() -> None:
    frames = [*ASKED_TYPE, "#010", ODD, "$01F", "!01B3.7", "#010", ODD]

    assert "types" not in facts(*frames, known=Known(Model.I_7017))


def test_a_setting_that_is_shown_again_takes_the_doubt_away() -> None:
    frames = [*ASKED_TYPE, "#010", ODD, *ASKED_TYPE, "#010", ODD]

    assert facts(*frames, known=Known(Model.I_7017))["types"] == (V_10,)


def test_one_exchange_without_a_checksum_is_a_contradiction_and_the_second_shows_that_there_is_none() -> None:
    frames = [sealed("$012"), sealed("!01080640"), *["$01M", "!017017"] * 3]
    said = ("no checksum, but frame 2 had one",)

    assert contradictions(*frames, known=Known(Model.I_7017)) == [(), (), said, said, said, said, (), ()]


def test_one_exchange_with_a_checksum_is_a_contradiction_and_the_second_shows_that_there_is_one() -> None:
    frames = [*ASKED_TYPE, *[sealed("$016"), sealed("!01FF")] * 3]
    said = ("a checksum, but frame 2 had none",)

    assert contradictions(*frames, known=Known(Model.I_7017)) == [(), (), said, said, said, said, (), ()]


def test_of_an_unknown_model_a_response_shows_by_itself_that_there_is_a_checksum() -> None:
    frames = [sealed("#010"), sealed(">+0025.1"), "#010", ">+0025.1"]

    assert facts(*frames[:2]) == {"checksum": True}
    assert contradictions(*frames)[2:] == [("no checksum, but frame 2 had one",)] * 2


# --- another module in its place --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("known", "first", "second"),
    [
        (None, named("7019"), named("7017")),
        (None, ("$01M", "!017019R"), named("7017")),
        (None, ("$01M", "!017019R"), ("$01M", "!017017R")),
        (None, named("7019"), row(482, 0x1700, 0x0070)),
        (M_7019R, row(482, 0x1900, 0x0070), row(482, 0x1700, 0x0070)),
        (None, ("$01F", "!01B3.7"), ("$01F", "!01B3.6")),
        (
            None,
            exchange(modbus.ReadFirmwareVersion(1), modbus.FirmwareVersion(1, 0x0B, 3, 7)),
            exchange(modbus.ReadFirmwareVersion(1), modbus.FirmwareVersion(1, 0x0B, 3, 6)),
        ),
        (M_7019R, row(480, 0x0307, 0x000B), row(480, 0x0306, 0x000B)),
    ],
)
def test_nothing_learned_of_a_module_holds_for_another_that_takes_its_place(
    known: Known | None, first: tuple[str | bytes, ...], second: tuple[str | bytes, ...]
) -> None:
    frames = [*first, *typed(0, 0x0F), *second]

    assert "types" in facts(*frames[:4], known=known)
    assert "types" not in facts(*frames, known=known)
    assert len(last_heard(*frames, known=known).contradictions) > 0


def test_types_of_other_channels_than_those_that_a_map_row_shows_are_kept() -> None:
    assert facts(*row(256, K, K), *row(257, J), known=M_7019R)["types"] == (K, J, None)


def test_where_only_the_series_is_known_the_rows_that_all_its_models_have_show_settings() -> None:
    frames = [*named("7019"), *row(256, K, J)]

    assert facts(*frames)["types"] == (K, J, None)
    assert contradictions(*frames, *row(256, K, K))[-1] == ("type 0F (K), but frame 4 said type 0F (K) 0E (J)",)


def test_a_type_of_one_channel_that_no_model_of_a_series_has_is_noticed() -> None:
    assert (
        last_heard(*named("7018"), *typed(0, V_10))
        .contradictions[-1]
        .endswith("has no type 08, -10..10 V; another model?")
    )


# --- writes to all modules --------------------------------------------------------------------------------------------


def all_modules(address: int, *words: int) -> bytes:
    return modbus.encode(modbus.WriteMultipleRegisters(0, address, words))


COIL = modbus.encode(modbus.WriteSingleCoil(0, 268, True))


def test_a_write_to_all_modules_holds_for_each_that_is_known_and_for_the_others() -> None:
    by_address = {1: Known(Model.M_7019R, types=(K,)), 2: Known(Model.M_7018), 3: Known(Model.I_7018)}
    line, (heard,) = hear_all(line_of(Known(Model.M_7017), by_address), [COIL])

    formats = [line.knowledge.of(address).known.modbus_data_format for address in (1, 2, 3, 9)]
    assert formats == [ModbusDataFormat.ENGINEERING, ModbusDataFormat.ENGINEERING, None, ModbusDataFormat.ENGINEERING]
    assert heard.notes == (
        "a broadcast, which no module confirms: taken to hold from here on for all that have the register (E94)",
    )
    assert line.knowledge.of(1).known.types == (K,)


def test_a_write_to_all_modules_is_an_assumption_that_says_where_it_comes_from() -> None:
    request = modbus.encode(modbus.ReadInputRegisters(1, 0, 1))
    response = modbus.encode(modbus.InputRegisters(1, (250,)))
    (meaning,) = last_heard(COIL, request, response, known=Known(Model.M_7019R, types=(K,))).meanings

    assert [(fact.name, fact.origin, fact.where) for fact in meaning.facts] == [
        ("types", Origin.GIVEN, ""),
        ("modbus_data_format", Origin.ASSUMED, "frame 1"),
    ]
    assert meaning.readings[0].value == 250.0 / 10


def test_registers_that_a_model_does_not_have_change_nothing_of_it() -> None:
    line, _ = hear_all(line_of(Known(Model.M_7019R, types=(K,))), [all_modules(486, J)])

    assert line.knowledge.of(1).known.types == (K,)
    assert facts(all_modules(486, T), known=Known(Model.M_7018), address=7)["types"] == (T,)


def test_a_type_that_a_model_lacks_is_not_taken_over_from_a_write_to_all() -> None:
    line, _ = hear_all(line_of(Known(Model.M_7018, types=(K,))), [all_modules(486, V_10)])

    assert line.knowledge.of(1).known.types == (K,)


def test_what_a_module_does_not_follow_is_a_contradiction() -> None:
    known = Known(Model.M_7018, types=(K,))

    assert contradictions(all_modules(486, J), *row(486, K), known=known)[-1] == (
        "type 0F (K), but the broadcast of frame 1 set type 0E (J)",
    )


def test_of_modules_that_can_be_several_models_what_they_do_not_agree_on_is_unknown() -> None:
    single_ended = modbus.encode(modbus.WriteSingleCoil(0, 276, True))
    line, _ = hear_all(line_of(), ["@01S", "!011", single_ended])

    assert line.knowledge.of(1).known.single_ended is True


def test_a_broadcast_of_a_new_address_leaves_the_only_module_at_both() -> None:
    known = {1: Known(Model.M_7019R, types=(K,))}
    line, _ = hear_all(line_of(by_address=known), [all_modules(484, 5)])

    assert [line.knowledge.of(address).known.types for address in (1, 5, 6)] == [(K,), (K,), None]


def test_a_broadcast_of_a_new_address_to_several_modules_moves_none() -> None:
    known = {1: Known(Model.M_7019R), 2: Known(Model.M_7019R)}
    line, _ = hear_all(line_of(by_address=known), [all_modules(484, 5)])

    assert list(line.knowledge.modules) == [1, 2]


@pytest.mark.parametrize("frame", [all_modules(484, 300), all_modules(0, 1), all_modules(488, 10)])
def test_a_broadcast_that_decides_nothing_changes_nothing(frame: bytes) -> None:
    known = {1: Known(Model.M_7019R, types=(K,))}
    line, _ = hear_all(line_of(by_address=known), [frame])

    assert list(line.knowledge.modules) == [1]
    assert dict(line.knowledge.of(1).facts) == {}


def test_the_highest_channels_of_a_mask_are_not_its_whole() -> None:
    known = Known(Model.M_7017Z)

    assert "mask" not in facts(*row(489, 0xFFFF), known=known)
    assert facts(*row(489, 0xFF), known=Known(Model.M_7019R)) == {"mask": 0xFF}


def test_firmware_and_format_of_a_broadcast_are_settings_only() -> None:
    line, _ = hear_all(line_of(Known(Model.M_7019R, firmware=Firmware("B3.7"))), [all_modules(480, 1, 2)])

    assert dict(line.knowledge.of(1).facts) == {}
    assert line.knowledge.of(1).known.data_format is None or DataFormat.ENGINEERING


def test_of_a_series_a_broadcast_of_a_register_that_not_all_its_models_have_leaves_the_type_open() -> None:
    frames = [*named("7017"), *typed(0, V_10), all_modules(486, 0x09)]
    line, _ = hear_all(line_of(), frames)

    assert line.knowledge.of(1).known.types is None
    assert line.knowledge.of(1).facts["types"].where == "frame 5"


def test_a_broadcast_sets_nothing_in_a_module_that_does_not_speak_modbus() -> None:
    line, _ = hear_all(line_of(), ["$01M", "!017018BL", COIL, *row(489, 3)])

    assert line.knowledge.of(1).known.modbus_data_format is None
    assert "mask" not in line.knowledge.of(1).facts


def test_a_repeated_broadcast_is_learned_once() -> None:
    line, _ = hear_all(line_of(by_address={1: M_7019R}), [COIL])
    again, _ = hear_all(line, [COIL])

    assert again.knowledge is line.knowledge
