"""Dialogues with modules that speak DCON: what the manual shows, step by step, and what follows from it."""

import pytest
from attrs import evolve

from i7000 import (
    BaudRate,
    CharacterFormat,
    LineSettings,
    Model,
    Protocol,
    ReportSettings,
    TypeCode,
    Unit,
    dcon,
)
from i7000.device import Signals
from tests.device.driver import Bench, bench
from tests.each import each
from tests.vectors import AVAILABILITY

M_MODELS = sorted((model for model in Model if model.value.startswith("M")), key=lambda model: model.value)

Dialogue = list[tuple[str, str | None]]

VOLTS = Signals.of(Unit.VOLT, 1.0, -1.0)


def held(module: Bench, dialogue: Dialogue) -> Dialogue:
    return [(command, module.say(command)) for command, _ in dialogue]


DIALOGUES: dict[str, tuple[Model, str, Dialogue]] = {
    "2.1 a new address answers at once": (
        Model.I_7018, "", [("%0102050600", "!02"), ("%0202050602", "!02"), ("$022", "!02050602"), ("$012", None)],
    ),
    "2.1 no baud rate without INIT": (Model.I_7018, "", [("%0101050A00", "?01"), ("$012", "!01050600")]),
    "2.1 no character format without INIT": (Model.I_7018, "", [("%0101054600", "?01"), ("$012", "!01050600")]),
    "2.1 no checksum without INIT": (Model.I_7018, "", [("%0101050640", "?01"), ("$012", "!01050600")]),
    "2.1 a refusal comes from the old address": (Model.I_7018, "", [("%0102050A00", "?01"), ("$012", "!01050600")]),
    "2.1 the type of all channels": (Model.I_7018, "", [("%01010F0600", "!01"), ("$012", "!010F0600")]),
    "2.1 no type of other models": (Model.I_7018, "", [("%0101080600", "?01"), ("$012", "!01050600")]),
    "2.1 filter and data format": (Model.I_7018, "", [("%0101050682", "!01"), ("$012", "!01050682")]),
    "2.1 TT is not used": (Model.I_7019R, "", [("%0101550601", "!01"), ("$012", "!01080601")]),
    "2.1 FF keeps different types": (
        Model.I_7017R, "B3.9",
        [("$017C1R0D", "!01"), ("$012", "!01FF0600"), ("%0101FF0601", "!01"), ("$018C1", "!01C1R0D"),
         ("%0101090601", "!01"), ("$018C1", "!01C1R09"), ("$012", "!01090601")],
    ),
    "2.1 FF is no type of a module with one": (Model.I_7017, "", [("%0101FF0600", "?01")]),
    "2.2 and 2.12 synchronized sampling": (
        Model.M_7019R, "",
        [("$014", "?01"), ("#**", None), ("$014", ">011+01.000-01.000" + "+00.000" * 6),
         ("$014", ">010+01.000-01.000" + "+00.000" * 6), ("#**", None),
         ("$014", ">011+01.000-01.000" + "+00.000" * 6)],
    ),
    "2.3 and 2.4 readings": (
        Model.I_7017, "",
        [("#01", ">+01.000-01.000" + "+00.000" * 6), ("#011", ">-01.000"), ("#019", "?01"), ("#018", "?01")],
    ),
    "2.4 one hex digit": (Model.M_7017mC_16, "", [("#01F", ">+00.000"), ("#0110", None)]),
    "2.4 two digits in single-ended mode": (
        Model.I_7017Z, "", [("@01S1", "!01"), ("#0113", ">+00.000"), ("#0114", "?01"), ("#011", None)],
    ),
    "2.7 calibration of a current input": (
        Model.M_7017mC_16, "",
        [("$010C1", "?01"), ("~01E1", "!01"), ("$010C0", "!01"), ("$010CF", "!01"), ("$011C0", None)],
    ),
    "2.8 and 2.9 calibration of a channel": (
        Model.I_7019R, "",
        [("$010C1", "?01"), ("~01E1", "!01"), ("$010C1", "!01"), ("$011C1", "!01"), ("$010C8", "?01"),
         ("~01E0", "!01"), ("$011C1", "?01"), ("$010", None)],
    ),
    "2.11 the temperature of the cold junction": (Model.I_7018, "", [("$013", ">+0025.0")]),
    "2.13 and 2.14 channels off and on": (Model.I_7017, "", [("$0153A", "!01"), ("$016", "!013A")]),
    "2.13 no channel that is not there": (Model.I_7017Z, "", [("$0150400", "?01"), ("$016", "!0103FF")]),
    "2.15 and 2.16 the type of a channel": (
        Model.I_7019R, "",
        [("$017C0R03", "!01"), ("$017C5R16", "!01"), ("$017C1R30", "?01"), ("$018C0", "!01C0R03"),
         ("$018C5", "!01C5R16"), ("$018C1", "!01C1R08"), ("$018C8", "?01"), ("$012", "!01FF0600")],
    ),
    "2.17 and 2.18 the CJC offset": (
        Model.I_7018, "",
        [("$019+0010", "!01"), ("$019", "!01+0010"), ("$019-1000", "!01"), ("$019+1001", "?01"),
         ("$019", "!01-1000")],
    ),
    "2.19 readings in hex": (Model.I_7017, "", [("$01A", ">0CCDF333" + "0000" * 6)]),
    "2.20 and 2.21 the CJC update": (
        Model.I_7019R, "", [("$01A", "!011"), ("$01A0", "!01"), ("$01A", "!010"), ("$01A2", "!01"), ("$01A", "!012")],
    ),
    "2.22 diagnostics": (Model.I_7019R, "", [("$01B", "!0100")]),
    "2.22 diagnostics of ten channels": (Model.M_7019Z, "", [("$01B", "!010000")]),
    "2.23 firmware": (Model.I_7018, "A2.0", [("$01F", "!01A2.0")]),
    "2.24 and 2.33 the name": (
        Model.I_7018, "", [("$01M", "!017018"), ("~01O7019A", "!01"), ("$01M", "!017019A"), ("~01O7019ABC", None)],
    ),
    "2.25 and 2.26 the protocol takes INIT": (
        Model.M_7018, "", [("$01P", "!0110"), ("$01P1", "?01"), ("$01P", "!0110")],
    ),
    "2.27 and 2.28 calibration by itself": (Model.I_7019R, "", [("$01S0", "!01"), ("$01S1", "!01")]),
    "2.29 and 2.30 the CJC switch": (Model.I_7018, "", [("~01C", "!011"), ("~01C0", "!01"), ("~01C", "!010")]),
    "2.31 calibration is enabled first": (
        Model.I_7018, "",
        [("$010", "?01"), ("$011", "?01"), ("~01E1", "!01"), ("$010", "!01"), ("$011", "!01"), ("$010", "!01"),
         ("~01E0", "!01"), ("$010", "?01")],
    ),
    "2.34 soft INIT": (
        Model.I_7019R, "",
        [("~01I", "!01"), ("%0101000700", "?01"), ("~01T10", "!01"), ("~01I", "!01"), ("%0101000700", "!01"),
         ("$012", "!01080700"), ("%0101000600", "?01"), ("~01T3D", "?01"), ("~01T3C", "!01")],
    ),
    "2.35 to 2.39 the host watchdog": (
        Model.I_7018, "",
        [("~010", "!0100"), ("~012", "!01000"), ("~013164", "!01"), ("~012", "!01164"), ("~010", "!0180"),
         ("~**", None), ("~0130FF", "!01"), ("~012", "!010FF"), ("~010", "!0100"), ("~011", "!01")],
    ),
    "2.40 and 2.41 open wires": (
        Model.I_7018R, "B4.2", [("~01EO", "!011"), ("~01EO0", "!01"), ("~01EO", "!010"), ("~01E0", "!01")],
    ),
    "2.42 and 2.43 the connecting mode": (
        Model.I_7017Z, "",
        [("@01S", "!010"), ("$016", "!0103FF"), ("@01S1", "!01"), ("@01S", "!011"), ("$016", "!010FFFFF"),
         ("$015080001", "!01"), ("@01S0", "!01"), ("$016", "!010001"), ("$0150003", "!01"), ("@01S1", "!01"),
         ("$016", "!01080003")],
    ),
}  # fmt: skip


@pytest.mark.parametrize(("model", "firmware", "dialogue"), DIALOGUES.values(), ids=DIALOGUES)
def test_a_dialogue_goes_as_the_manual_says(model: Model, firmware: str, dialogue: Dialogue) -> None:
    module = bench(model, firmware or None, signals=VOLTS)

    assert dialogue == held(module, dialogue)


COMMANDS = {
    "2.1": "%0101{type}0600", "2.3": "#01", "2.4": "#01{channel}", "2.5": "$010", "2.6": "$011", "2.7": "$010C{i}",
    "2.8": "$010C{i}", "2.9": "$011C{i}", "2.10": "$012", "2.11": "$013", "2.12": "$014", "2.13": "$015{mask}",
    "2.14": "$016", "2.15": "$017C{channel}R{type}", "2.16": "$018C{channel}", "2.17": "$019", "2.18": "$019-0FFF",
    "2.19": "$01A", "2.20": "$01A", "2.21": "$01A1", "2.22": "$01B", "2.23": "$01F", "2.24": "$01M", "2.25": "$01P",
    "2.26": "$01P0", "2.27": "$01S0", "2.28": "$01S1", "2.29": "~01C", "2.30": "~01C1", "2.31": "~01E1",
    "2.32": "~01I", "2.33": "~01ONAME", "2.34": "~01T01", "2.36": "~010", "2.37": "~011", "2.38": "~012",
    "2.39": "~0130FF", "2.40": "~01EO", "2.41": "~01EO1", "2.42": "@01S", "2.43": "@01S0",
}  # fmt: skip


@each("section", COMMANDS)
@pytest.mark.parametrize("model", Model, ids=lambda model: model.value)
def test_every_module_answers_every_command_that_it_has_and_no_other(model: Model, section: str) -> None:
    module = bench(model)
    module.state = module.state.switched(init_switch=True).keep(calibration_enabled=True)
    if model.series == "7019":
        module.say("#**")
    profile = module.state.profile
    text = COMMANDS[section].format(
        type=f"{profile.type_codes[0]:02X}", channel="0", i="0", mask="0" * profile.mask_digits
    )
    twin = {"2.7": "2.8", "2.8": "2.7", "2.19": "2.20", "2.20": "2.19"}.get(section, section)

    answer = module.say(text)

    if {AVAILABILITY[section], AVAILABILITY[twin]} <= profile.refused:
        assert answer is None
    else:
        assert answer is not None
        assert answer[0] in "!>"


def test_there_is_a_command_for_every_section() -> None:
    broadcasts = {kind.section for kind in dcon.COMMANDS if issubclass(kind, dcon.Broadcast)}

    assert {kind.section for kind in dcon.COMMANDS} == set(COMMANDS) | broadcasts


@pytest.mark.parametrize(
    "frame",
    [
        b"", b"\r", b"$\r", b"$01\r", b"$012", b"$012\r\n", b"$022\r", b"$0a2\r", b"$01Q\r", b"$0122\r", b"$012B7\r",
        b"!01\r", b"?01\r", b">+1.0000\r", b"\xff$012\r", b"~01E2\r", b"$01A3\r", b"$**2\r", b"#**\r", b"%0101g50600\r",
        b"$012" + b"2" * 300 + b"\r", b"\x01\x04\x00\x00\x00\x08\xf1\xcc",
    ],
)  # fmt: skip
def test_what_is_no_command_to_the_module_is_not_answered_and_changes_nothing(frame: bytes) -> None:
    module = bench(Model.I_7018)
    before = module.state

    assert module.send(frame) is None
    assert module.state == before


@pytest.mark.parametrize("frame", [b"$012B8\r", b"$012\r", b"$012b7\r"])
def test_a_wrong_checksum_is_not_answered(frame: bytes) -> None:
    module = bench(Model.I_7018, report_settings=ReportSettings(checksum=True))

    assert module.send(frame) is None
    assert module.send(b"$012B7\r") == b"!01050640B1\r"


def test_broadcasts_are_not_answered_and_refusals_carry_checksums() -> None:
    module = bench(Model.I_7019R, report_settings=ReportSettings(checksum=True))

    assert module.say("#**") is None
    assert module.say("~**") is None
    assert module.send(b"$014B9\r") is not None
    assert bench(Model.I_7019R, report_settings=ReportSettings(checksum=True)).send(b"$014B9\r") == b"?01A0\r"


def test_models_without_synchronized_sampling_do_not_know_its_broadcast() -> None:
    module = bench(Model.I_7018)
    before = module.state

    assert module.say("#**") is None
    assert module.state == before


# --- INIT -------------------------------------------------------------------------------------------------------------


def test_in_init_mode_a_module_reports_its_stored_settings_at_address_00() -> None:
    module = bench(
        Model.I_7018,
        address=0x2A,
        line_settings=LineSettings(BaudRate.BAUD_115200, CharacterFormat.E81),
        report_settings=ReportSettings(checksum=True),
    )
    module.power_cycle(init_switch=True)

    assert module.state.ram.line_settings == LineSettings()
    assert module.say("$2A2") is None
    assert module.say("$002") == "!2A058A40"
    assert module.say("$00M") == "!007018"


def test_what_is_set_in_init_mode_holds_after_the_next_power_on() -> None:
    module = bench(Model.I_7018)
    module.power_cycle(init_switch=True)

    dialogue: Dialogue = [("%0007050A40", "!07"), ("$072", None), ("$002", "!07050A40"), ("#000", ">+0.0000")]

    assert dialogue == held(module, dialogue)
    module.power_cycle()
    assert module.state.ram.line_settings.baud_rate is BaudRate.BAUD_115200
    assert module.send(b"$072BD\r") == b"!07050A40C2\r"


def test_the_switch_moved_while_running_allows_changes_for_the_next_power_on() -> None:
    module = bench(Model.I_7018)
    module.state = module.state.switched(init_switch=True)

    assert module.say("%0101050A40") == "!01"
    assert module.say("$012") == "!01050A40"
    assert module.state.ram.line_settings.baud_rate is BaudRate.BAUD_9600
    module.power_cycle()
    assert module.state.ram.checksum


@pytest.mark.parametrize("model", M_MODELS)
def test_the_protocol_is_stored_in_init_mode_and_spoken_after_the_next_power_on(model: Model) -> None:
    module = bench(model)
    module.power_cycle(init_switch=True)

    dialogue: Dialogue = [("$00P", "!0010"), ("$00P1", "!00"), ("$00P", "!0011")]

    assert dialogue == held(module, dialogue)
    module.power_cycle()
    assert module.state.ram.protocol is Protocol.MODBUS_RTU
    assert module.say("$01M") is None


# --- soft INIT --------------------------------------------------------------------------------------------------------


def soft(model: Model = Model.M_7019R) -> Bench:
    module = bench(model)
    assert [module.say("~01T02"), module.say("~01I")] == ["!01", "!01"]
    return module


@pytest.mark.parametrize("model", [Model.I_7019R, Model.M_7019R, Model.M_7019Z, Model.M_7017mC_16])
def test_soft_init_changes_line_and_checksum_right_after_the_response(model: Model) -> None:
    module = soft(model)

    assert module.send(b"%0101080A40\r") == b"!01\r"
    assert module.state.ram.line_settings.baud_rate is BaudRate.BAUD_115200
    assert module.send(b"$01M\r") is None
    assert module.send(b"$012B7\r") is not None


@pytest.mark.parametrize(("seconds", "answer"), [(1.9, "!01"), (2.0, "?01"), (60.0, "?01")])
def test_soft_init_ends_with_its_time_out(seconds: float, answer: str) -> None:
    module = soft()
    module.wait(seconds)

    assert module.say("%0101080700") == answer


def test_soft_init_is_for_the_next_command_only() -> None:
    module = soft()

    dialogue: Dialogue = [("$01M", "!017019R"), ("%0101080700", "?01")]

    assert dialogue == held(module, dialogue)


def test_a_refused_command_does_not_end_soft_init() -> None:
    module = soft()

    dialogue: Dialogue = [("%0101080B00", "?01"), ("%0101080700", "!01"), ("%0101080600", "?01")]

    assert dialogue == held(module, dialogue)


def test_soft_init_once_more_begins_its_time_anew() -> None:
    module = soft()
    module.wait(1.5)
    assert module.say("~01I") == "!01"
    module.wait(1.5)

    assert module.say("%0101080700") == "!01"


def test_the_soft_init_time_out_is_0_after_power_on() -> None:
    module = soft()
    module.power_cycle()

    dialogue: Dialogue = [("~01I", "!01"), ("%0101080700", "?01")]

    assert dialogue == held(module, dialogue)


def test_with_the_switch_set_soft_init_waits_for_the_power_too() -> None:
    module = soft()
    module.state = module.state.switched(init_switch=True)

    assert module.say("%0101080740") == "!01"
    assert not module.state.ram.checksum
    assert module.state.eeprom.report_settings.checksum


def test_soft_init_does_not_allow_another_protocol() -> None:
    assert soft().say("$01P1") == "?01"


# --- the host watchdog ------------------------------------------------------------------------------------------------


def watched(tenths: str = "0A") -> Bench:
    module = bench(Model.I_7018)
    assert module.say(f"~0131{tenths}") == "!01"
    return module


@pytest.mark.parametrize(("seconds", "status"), [(0.9, "!0180"), (0.99, "!0180"), (1.0, "!0104"), (100.0, "!0104")])
def test_the_watchdog_times_out_after_its_tenths_of_a_second_and_is_then_off(seconds: float, status: str) -> None:
    module = watched()
    module.wait(seconds)

    assert module.say("~010") == status


def test_host_ok_keeps_the_watchdog_from_timing_out_and_other_commands_do_not() -> None:
    module = watched()
    for _ in range(3):
        module.wait(0.6)
        assert module.say("~**") is None
    assert module.say("~010") == "!0180"
    module.wait(0.6)
    assert module.say("$01M") == "!017018"
    module.wait(0.6)

    dialogue: Dialogue = [("~010", "!0104"), ("~012", "!0100A"), ("~011", "!01"), ("~010", "!0100")]

    assert dialogue == held(module, dialogue)


def test_a_time_out_outlives_the_power_and_is_counted() -> None:
    module = watched()
    module.wait(1.0)
    module.power_cycle()

    assert module.say("~010") == "!0104"
    assert module.state.eeprom.host_watchdog_timeouts == 1


def test_an_enabled_watchdog_begins_to_wait_at_power_on() -> None:
    module = watched()
    module.now += 0.9
    module.power_cycle()
    module.wait(0.9)
    assert module.say("~010") == "!0180"
    module.wait(0.1)

    assert module.say("~010") == "!0104"


def test_a_time_out_of_0_never_comes() -> None:
    module = watched("00")
    module.wait(1e6)

    assert module.say("~010") == "!0180"


# --- what the power takes away ----------------------------------------------------------------------------------------


def test_sampling_calibration_and_the_update_of_the_cold_junction_end_with_the_power() -> None:
    module = bench(Model.I_7019R)
    for command in ("#**", "~01E1", "$01A0", "$015AA", "$019+0123", "~01C0", "~01OX", "$017C3R0F"):
        module.say(command)
    module.power_cycle()

    dialogue: Dialogue = [
        ("$014", "?01"), ("$010C0", "?01"), ("$01A", "!011"), ("$016", "!01AA"), ("$019", "!01+0123"),
        ("~01C", "!010"), ("$01M", "!01X"), ("$018C3", "!01C3R0F"),
    ]  # fmt: skip

    assert dialogue == held(module, dialogue)


def test_a_sample_is_reported_in_the_present_data_format() -> None:
    module = bench(Model.I_7019R, signals=VOLTS)
    module.say("#**")
    module.signals = Signals.of(Unit.VOLT, *[5.0] * 8)
    module.say("%0101080602")

    assert module.say("$014") == ">0110CCDF333" + "0000" * 6
    assert module.say("#010") == ">4000"


@pytest.mark.parametrize("command", ["$01501", "$017C0R0A", "$019+1000", "~01C0", "~01EO0", "$01A0"])
def test_what_was_sampled_stays_as_it_was_read_whatever_is_set_since(command: str) -> None:
    module = bench(Model.I_7019R, type_code=TypeCode.K, signals=Signals.of(Unit.CELSIUS, 20.0, 1400.0))
    module.say("#**")
    module.signals = Signals(cold_junction=40.0)
    assert module.say(command) == "!01"

    assert module.say("$014") == ">011+0020.0" + "+9999.9" * 7


def test_states_are_values() -> None:
    module = bench(Model.I_7018)
    before, copied = module.state, evolve(module.state)
    module.say("~01OA")

    assert before == copied
    assert module.state != before
