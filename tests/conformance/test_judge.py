"""The judgement of a line: scenes that break one rule each, and good conversations that break none."""

from itertools import accumulate
from math import inf
from random import Random
from typing import Any

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from i7000 import ArgumentError, InvalidValueError, Model, Profile, Protocol, dcon, modbus
from i7000.conformance.judge import EEPROM_WRITES, Judge, Level, Rule, Side, judge, verdict
from i7000.conformance.judge_frames import STORING
from i7000.device import factory, power_on
from i7000.dissect import Knowledge, Known, Line, hear_frame
from i7000.dissect.timing import Times
from i7000.host.procedures import identify, snapshot
from i7000.link import Line as HostLine
from i7000.link import VirtualPort
from i7000.link.observed import Observed, Received, Written
from i7000.simulator.simulator import Simulated
from tests.conformance.overheard import CHARACTER, Piece, conversation, judged, judged_frames, rules
from tests.spec.lint import Record, stories, vectors
from tests.vectors import profile_of
from tests.workbench import EVERY_MODULE

SOON, LONG = 0.05, 1.0
PROFILE = Profile(Model.M_7019R)
READ = modbus.encode(modbus.ReadInputRegisters(1, 0, 2), PROFILE)
INPUTS = modbus.encode(modbus.InputRegisters(1, (5, 6)), PROFILE)
NAME = modbus.encode(modbus.ReadModuleName(1), PROFILE)
COIL = modbus.encode(modbus.WriteSingleCoil(1, 255, value=True), PROFILE)
BROADCAST = modbus.encode(modbus.WriteSingleCoil(0, 255, value=True), PROFILE)
CALIBRATION = modbus.encode(modbus.WriteSingleCoil(1, 271, value=True), PROFILE)
SEALED = dcon.seal(b"!01050640", checksum=True)
OFFSET = b"$019+0001\r"


def sealed(text: str) -> bytes:
    return modbus.seal(bytes.fromhex(text))


Frames = list[tuple[float | None, bytes]]
_LOOP: Frames = [frame for _ in range(EEPROM_WRITES + 1) for frame in [(LONG, OFFSET), (SOON, b"!01\r")]]
SCENES: dict[Rule, Frames] = {
    Rule.ASK_AFTER_BROADCAST: [(0, b"#**\r"), (0.0015, b"$012\r")],
    Rule.ASK_AFTER_MODBUS_BROADCAST: [(0, BROADCAST), (0.0019, b"$012\r")],
    Rule.ASK_IN_CALIBRATION: [(0, CALIBRATION), (SOON, CALIBRATION), (SOON, READ)],
    Rule.ASK_BEFORE_ANSWER: [(0, b"$012\r"), (SOON, b"$01M\r"), (SOON, b"!017018\r")],
    Rule.TAKES_LATE_ANSWER: [(0, b"$022\r"), (0.3, b"$012\r"), (0.01, b"!02050600\r"), (0.01, b"$01M\r")],
    Rule.DRIVER_CHECKSUM_MISSING: [(0, b"$012B7\r"), (SOON, SEALED), (SOON, b"$01M\r")],
    Rule.DRIVER_CHECKSUM_UNEXPECTED: [(0, b"$012\r"), (SOON, b"!01050600\r"), (SOON, b"$01MD2\r")],
    Rule.DRIVER_CHECKSUM_WRONG: [(0, b"$012B8\r")],
    Rule.DRIVER_LOWER_CASE: [(0, b"$0a2\r")],
    Rule.DRIVER_TERMINATOR: [(0, b"$012\n")],
    Rule.NO_COMMAND: [(0, b"$01X\r")],
    Rule.LACKS_COMMAND: [(0, b"@01S\r")],
    Rule.DRIVER_CRC: [(0, READ[:-1] + b"\0")],
    Rule.DRIVER_ADDRESS: [(0, sealed("000400000008"))],
    Rule.BOUNDS: [(0, sealed("010400000BB8")), (SOON, sealed("018403"))],
    Rule.DRIVER_GAP_BEFORE: [(0, READ), (SOON, INPUTS), (0.003, READ)],
    Rule.EEPROM_LOOP: _LOOP,
    Rule.LENGTH: [(0, b"$012\r"), (SOON, b"!0105060\r")],
    Rule.ALPHABET: [(0, b"$012\r"), (SOON, b"!01050G00\r")],
    Rule.MODULE_LOWER_CASE: [(0, b"$012\r"), (SOON, b"!010f0600\r")],
    Rule.LEADING: [(0, b"$012\r"), (SOON, b">01050600\r")],
    Rule.MODULE_TERMINATOR: [(0, b"$012\r"), (SOON, b"!01050600\n")],
    Rule.MODULE_ADDRESS: [(0, b"$012\r"), (SOON, b"!02050600\r")],
    Rule.FUNCTION: [(0, READ), (SOON, sealed("01030400050006"))],
    Rule.SETTINGS_LENGTH: [(0, NAME), (SOON, sealed("0146000070"))],
    Rule.ECHO: [(0, COIL), (SOON, sealed("010500FF0000"))],
    Rule.ORDER: [(None, b"$022\r"), (None, b"$012\r"), (None, b"!02050600\r")],
    Rule.MODULE_CHECKSUM_MISSING: [(0, b"$012B7\r"), (SOON, SEALED), (SOON, b"$012B7\r"), (SOON, b"!01050640\r")],
    Rule.MODULE_CHECKSUM_UNEXPECTED: [(0, b"$012\r"), (SOON, dcon.seal(b"!01050600", checksum=True))],
    Rule.MODULE_CHECKSUM_WRONG: [(0, b"$012B7\r"), (SOON, b"!01050640AA\r")],
    Rule.MODULE_CRC: [(0, READ), (SOON, INPUTS[:-1] + b"\0")],
    Rule.READING: [(0, b"#01\r"), (SOON, b">" + b"+001.00" * 8 + b"\r")],
    Rule.VALUE: [(0, b"~012\r"), (SOON, b"!01205\r")],
    Rule.CONTRADICTION: [
        (0, b"$012\r"), (SOON, b"!010F0600\r"), (SOON, b"#01\r"), (SOON, b">" + b"+1.0000" * 8 + b"\r"),
    ],
    Rule.LATE: [(0, b"$012\r"), (0.3, b"!01050600\r")],
    Rule.UNASKED: [(0, b"$012\r"), (SOON, b"!01050600\r"), (SOON, b"!02\r")],
    Rule.SECOND_ANSWER: [(0, b"$012\r"), (SOON, b"!01050600\r"), (SOON, b"!01050600\r")],
    Rule.ANSWERS_BROADCAST: [(0, b"#**\r"), (SOON, b"!01\r")],
    Rule.ANSWERS_MODBUS_BROADCAST: [(0, BROADCAST), (SOON, sealed("018502"))],
    Rule.ANSWERS_INVALID: [(0, b"$01X\r"), (SOON, b"?01\r")],
    Rule.EXCEPTION_BIT: [(0, READ), (SOON, sealed("010402"))],
    Rule.EXCEPTION_CODE: [(0, READ), (SOON, sealed("018477"))],
    Rule.MODULE_GAP_BEFORE: [(0, READ), (0.003, INPUTS)],
}  # fmt: skip
"""Frames, each so long after the one before, of which the last, or one of them, breaks a rule first."""

KNOWN = {Rule.READING: Known.of(Profile(Model.I_7018)), Rule.LACKS_COMMAND: Known(model=Model.I_7018)}
"""What is known of the module in a scene; nothing in the others."""
BEFORE = {Rule.TAKES_LATE_ANSWER: [Rule.LATE], Rule.ANSWERS_INVALID: [Rule.NO_COMMAND]}
"""What has to be broken before a rule can be."""
HALVES = {
    Rule.DRIVER_GAP_WITHIN: [(1.0, READ[:4]), (1.005, READ[4:]), (1.1, INPUTS)],
    Rule.MODULE_GAP_WITHIN: [(1.0, READ), (1.1, INPUTS[:4]), (1.105, INPUTS[4:])],
}
"""Pieces of frames with a silence between."""


def test_every_rule_has_a_scene() -> None:
    assert {*SCENES, *HALVES} == set(Rule)


@pytest.mark.parametrize("rule", SCENES, ids=lambda rule: rule.id)
def test_a_scene_breaks_its_rule_and_no_other(rule: Rule) -> None:
    _, findings = judged_frames(*SCENES[rule], known=KNOWN.get(rule))

    assert rules(findings) == [*BEFORE.get(rule, []), rule]
    assert findings[-1].what


@pytest.mark.parametrize("rule", [rule for rule in SCENES if rule is not Rule.ORDER], ids=lambda rule: rule.id)
def test_the_same_is_found_in_a_stream_of_both_protocols(rule: Rule) -> None:
    scene = [(wait or 0.0, wire) for wait, wire in SCENES[rule]]
    pieces = list(
        zip(accumulate((wait for wait, _ in scene), initial=100.0), [b"", *(wire for _, wire in scene)], strict=True)
    )

    _, findings = judged(pieces, known=KNOWN.get(rule))

    assert rules(findings) == [*BEFORE.get(rule, []), rule]


@pytest.mark.parametrize("rule", HALVES, ids=lambda rule: rule.id)
def test_a_silence_inside_a_frame_is_found(rule: Rule) -> None:
    _, findings = judged(HALVES[rule])

    assert rules(findings) == [rule]


@pytest.mark.parametrize("rule", Rule, ids=lambda rule: rule.id)
def test_a_rule_states_what_it_requires(rule: Rule) -> None:
    assert rule.id == f"listen/{rule.side}/{rule.value.name}"
    assert rule.sentence.endswith(".")
    assert rule.sections
    assert all(it.startswith("E") for it in rule.errata)


def test_ids_are_unique() -> None:
    assert len({rule.id for rule in Rule}) == len(Rule)


# --- good conversations -----------------------------------------------------------------------------------------------


def bus(*models: Model, **options: Any) -> VirtualPort:
    modules = [
        power_on(evolve(factory(model), address=at), now=0.0, init_switch=False) for at, model in enumerate(models, 1)
    ]
    return VirtualPort(modules, **options)


AT_PORT = Judge(character_time=CHARACTER, collecting=True)
GOOD = ((0.01, b"$012\r"), (0.01, b"$01M\r"), (0.01, b"#01\r"), (0.01, b"#**\r"), (0.01, b"$022\r"), (0.01, b"#02\r"),
        (0.01, b"$01F\r"), (0.01, b"$016\r"), (0.01, b"~**\r"), (0.01, b"~010\r"), (0.2, b"$032\r"),
        (0.2, b"#01\r"))  # fmt: skip


@pytest.mark.parametrize("collecting", [False, True])
def test_a_good_driver_and_good_modules_break_nothing(*, collecting: bool) -> None:
    pieces = conversation(bus(Model.I_7018, Model.I_7017), *GOOD)

    state, findings = judged(pieces, evolve(AT_PORT, collecting=collecting), protocol=Protocol.DCON)

    assert findings == []
    tallies = {(it.side, it.address): it.frames for it in verdict(state).tallies}
    assert tallies == {
        (Side.DRIVER, None): 2, (Side.DRIVER, 1): 7, (Side.DRIVER, 2): 2, (Side.DRIVER, 3): 1,
        (Side.MODULE, 1): 7, (Side.MODULE, 2): 2,
    }  # fmt: skip


def test_a_driver_that_does_not_wait_after_a_broadcast_is_found_in_virtual_time() -> None:
    pieces = conversation(bus(Model.I_7019R), (0.01, b"$012\r"), (0.01, b"#**\r"), (-0.0015, b"$012\r"))

    _, findings = judged(pieces, AT_PORT, protocol=Protocol.DCON)

    assert rules(findings) == [Rule.ASK_AFTER_BROADCAST]


def test_a_driver_that_asks_without_reading_is_found_in_virtual_time() -> None:
    port = bus(Model.I_7018, Model.I_7017)
    pieces = conversation(port, (0.01, b"$032\r"), (-0.05, b"$012\r"), (0.01, b"$022\r"))

    _, findings = judged(pieces, protocol=Protocol.DCON)

    assert rules(findings) == [Rule.ASK_BEFORE_ANSWER]


def exchanges(folder: str) -> list[Any]:
    return [
        pytest.param(vector, id=vector["id"])
        for _, vector in vectors(folder)
        if vector["outcome"] in ("response", "refused", "exception")
    ]


@pytest.mark.parametrize("folder", ["dcon", "modbus"])
def test_the_good_exchanges_of_the_vectors_break_no_must(folder: str) -> None:
    found = {}
    for case in exchanges(folder):
        vector: Record = case.values[0]
        asked = vector["command_wire"] if folder == "dcon" else vector["request_wire"]
        frames = [(SOON, bytes.fromhex(wire)) for wire in (asked, vector["response_wire"])]
        _, findings = judged_frames(*frames, known=Known.of(profile_of(vector["profile"])))
        found[vector["id"]] = [it.rule.id for it in findings if it.rule.level is Level.MUST]

    assert len(found) > 50
    assert {id_: ids for id_, ids in found.items() if ids} == {}


def test_the_answered_exchanges_of_the_stories_break_no_must_but_the_forms_that_they_are_about() -> None:
    wrong = {}
    for story in stories():
        line, state = Line(), Judge()
        for step in story["steps"]:
            for late, part in enumerate(("send", "expect") if step.get("expect") else ()):
                wire, at = bytes.fromhex(step[part]["wire"]), step["at"] + late * 0.01
                protocol = Protocol.DCON if step[part]["text"] else Protocol.MODBUS_RTU
                line, heard = hear_frame(line, wire, protocol, sent=not late)
                state, _ = judge(state, heard, line.knowledge, Times(at, at), sent=not late)
        found = {rule for it in verdict(state).tallies for rule, _ in it.findings if rule.level is Level.MUST}
        wrong[story["id"]] = found - {Rule.BOUNDS, Rule.NO_COMMAND}

    assert len(wrong) > 50
    assert {name: found for name, found in wrong.items() if found} == {}


@pytest.mark.parametrize("case", EVERY_MODULE)
def test_our_own_driver_breaks_nothing_on_any_model(case: Simulated) -> None:
    pieces: list[Piece] = []

    def observe(it: Observed) -> None:
        if isinstance(it, Written):
            pieces.extend((it.at + (at + 1) * CHARACTER, it.data[at : at + 1]) for at in range(len(it.data)))
        elif isinstance(it, Received):
            pieces.append((it.at, it.data))

    with HostLine(VirtualPort([case]), observe=observe) as line:
        found = line.run(identify(case.eeprom.address))
        assert found.profile
        line.run(snapshot(case.eeprom.address, found.profile))

    _, findings = judged(sorted(pieces, key=lambda piece: piece[0]), AT_PORT)

    assert findings == []


# --- what times can tell ----------------------------------------------------------------------------------------------


def test_without_times_what_needs_them_is_counted_and_not_found() -> None:
    frames = [b"#**\r", b"$012\r", b"!01050600\r", b"$012\r", b"$01M\r", OFFSET, READ]

    state, findings = judged_frames(*((None, frame) for frame in frames))

    assert findings == []
    assert dict(verdict(state).untimed) == {
        Rule.ASK_AFTER_BROADCAST: 1,
        Rule.ASK_BEFORE_ANSWER: 3,
        Rule.EEPROM_LOOP: 1,
        Rule.LATE: 1,
        Rule.DRIVER_GAP_BEFORE: 1,
    }


def test_without_a_baud_rate_no_silence_is_judged() -> None:
    state, findings = judged_frames((0, READ), (0.001, INPUTS), state=Judge())

    assert findings == []
    assert dict(verdict(state).untimed) == {Rule.DRIVER_GAP_BEFORE: 1, Rule.MODULE_GAP_BEFORE: 1}


def test_times_that_go_back_tell_nothing() -> None:
    state, findings = judged_frames((0, b"#**\r"), (-5, b"$012\r"))

    assert findings == []
    assert dict(verdict(state).untimed) == {Rule.ASK_AFTER_BROADCAST: 1}


def at(seconds: float, resolution: float = 0.0) -> Times:
    return Times(seconds, seconds, resolution=resolution)


@pytest.mark.parametrize(
    ("resolution", "wait", "found"),
    [(0.001, 0.001, True), (0.001, 0.002, False), (1.0, 0.0, False), (0.0, 0.001, True)],
)
def test_a_log_shows_what_the_digits_of_its_times_can_show(resolution: float, wait: float, *, found: bool) -> None:
    line, first = hear_frame(Line(), b"#**\r", Protocol.DCON)
    line, second = hear_frame(line, b"$012\r", Protocol.DCON)
    state, _ = judge(Judge(), first, line.knowledge, at(8.0, resolution))
    state, findings = judge(state, second, line.knowledge, at(8.0 + wait, resolution))

    assert rules(findings) == [Rule.ASK_AFTER_BROADCAST] * found


def test_frames_that_an_adapter_delivers_together_have_no_time_between_them() -> None:
    state, findings = judged([(1.0, b"#**\r$012\r"), (1.1, READ + INPUTS)], AT_PORT)

    assert rules(findings) == [Rule.ASK_BEFORE_ANSWER]
    assert dict(verdict(state).untimed) == {
        Rule.ASK_AFTER_BROADCAST: 1, Rule.MODULE_GAP_BEFORE: 1,
    }  # fmt: skip


def test_findings_about_short_times_are_withdrawn_if_an_answer_arrives_with_its_command() -> None:
    early = [(1.0, b"#**\r"), (1.001, b"$012\r"), (1.1, b"!01050600\r")]
    shown, findings = judged(early, AT_PORT)
    lumped, more = judged([*early, (1.5, b"$012\r!01050600\r"), (2.0, b"#**\r"), (2.001, b"$012\r")], AT_PORT)

    assert rules(findings) == rules(more) == [Rule.ASK_AFTER_BROADCAST]
    assert (verdict(shown).findings(), verdict(shown).withdrawn) == (1, 0)
    assert (verdict(lumped).findings(), verdict(lumped).withdrawn) == (0, 1)
    assert dict(verdict(lumped).untimed) == {Rule.ASK_AFTER_BROADCAST: 1}


def test_a_silence_inside_a_frame_that_an_adapter_explains_is_not_found() -> None:
    _, findings = judged([(1.0, READ[:4]), (1.016, READ[4:]), (1.1, INPUTS)], AT_PORT)
    _, long = judged([(1.0, READ[:4]), (1.03, READ[4:]), (1.1, INPUTS)], AT_PORT)

    assert (rules(findings), rules(long)) == ([], [Rule.DRIVER_GAP_WITHIN])


# --- turns, echoes and noise ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("wire", [b"$012\r", READ, b"#**\r"])
def test_an_echo_is_not_judged(wire: bytes) -> None:
    state, findings = judged_frames((0, wire), (0.01, wire))

    assert findings == []
    assert (verdict(state).frames, verdict(state).unjudged) == (1, 0)


@pytest.mark.parametrize(("wire", "answer"), [(b"$012\r", b"!01050600\r"), (READ, INPUTS)])
def test_a_command_that_is_sent_again_after_its_time_is_good(wire: bytes, answer: bytes) -> None:
    state, findings = judged_frames((0, wire), (0.3, wire), (SOON, answer))

    assert findings == []
    assert verdict(state).frames == 3


def test_a_request_that_is_sent_again_after_a_damaged_answer_is_not_an_echo() -> None:
    state, findings = judged_frames((None, READ), (None, INPUTS[:-1] + b"\0"), (None, READ), (None, READ))

    assert rules(findings) == [Rule.MODULE_CRC]
    assert {(it.side, it.frames) for it in verdict(state).tallies} == {(Side.DRIVER, 2), (Side.MODULE, 1)}


def test_what_is_not_like_a_frame_is_noise() -> None:
    noise = (b"\xff" * 300, b"\xff", b"\xff\x00\xfe\x01\x02", sealed("010404")[:3])
    state, findings = judged_frames(
        *((LONG, it) for it in noise), (LONG, b"$012\r"), (SOON, b"xyz!!\r"), (SOON, b"x\r")
    )

    assert rules(findings) == [Rule.LEADING]
    assert (verdict(state).frames, verdict(state).unjudged) == (2, 5)


def test_pieces_of_a_damaged_frame_are_judged_once() -> None:
    damaged = INPUTS[:-1] + b"\0"
    _, findings = judged_frames((0, READ), (SOON, damaged), (0.001, damaged), (LONG, READ), (SOON, INPUTS))

    assert rules(findings) == [Rule.MODULE_CRC]


def test_the_side_of_a_damaged_frame_is_known_if_the_recording_says_it() -> None:
    line, asked = hear_frame(Line(), READ, Protocol.MODBUS_RTU, sent=True)
    line, damaged = hear_frame(line, READ[:-1] + b"\0", Protocol.MODBUS_RTU, sent=True)
    state, _ = judge(Judge(), asked, line.knowledge, sent=True)

    assert rules(judge(state, damaged, line.knowledge, sent=True)[1]) == [Rule.DRIVER_CRC]
    assert rules(judge(state, damaged, line.knowledge, sent=False)[1]) == [Rule.MODULE_CRC]
    assert rules(judge(Judge(), damaged, line.knowledge, sent=False)[1]) == []


def test_answers_before_the_first_command_are_not_judged() -> None:
    state, findings = judged_frames((0, b"!01050600\r"), (0.1, INPUTS))

    assert findings == []
    assert (verdict(state).frames, verdict(state).unjudged) == (0, 2)


def test_a_write_after_the_time_of_an_answer_is_not_a_wrong_echo() -> None:
    other = sealed("010500FF0000")

    assert rules(judged_frames((0, COIL), (0.3, other))[1]) == []
    assert rules(judged_frames((None, COIL), (None, other))[1]) == []


def test_a_longer_write_is_not_a_wrong_echo() -> None:
    coils = modbus.encode(modbus.WriteMultipleCoils(1, 255, (True,)), PROFILE)
    others = modbus.encode(modbus.WriteMultipleCoils(1, 255, (False,)), PROFILE)

    assert rules(judged_frames((0, coils), (SOON, others))[1]) == [Rule.ASK_BEFORE_ANSWER]


def test_an_answer_by_the_other_protocol_is_not_judged() -> None:
    state, findings = judged_frames((0, READ), (SOON, b"!01050600\r"))

    assert findings == []
    assert verdict(state).unjudged == 1


def test_a_late_answer_by_modbus_is_found() -> None:
    _, findings = judged_frames((0, NAME), (0.3, READ), (SOON, sealed("01460070190000")), (SOON, INPUTS))

    assert rules(findings) == [Rule.LATE]


def test_a_driver_may_ask_again_after_half_of_the_time_of_an_answer() -> None:
    assert rules(judged_frames((0, b"$012\r"), (0.1, b"$01M\r"))[1]) == []
    assert rules(judged_frames((0, b"$012\r"), (0.1, b"$01M\r"), state=Judge(bound=0.3))[1]) == [Rule.ASK_BEFORE_ANSWER]


def test_a_slow_module_is_waited_for_as_long_as_you_say() -> None:
    scene = SCENES[Rule.LATE]

    assert rules(judged_frames(*scene, state=Judge(bound=0.5))[1]) == []


def test_other_modules_may_be_asked_while_one_calibrates() -> None:
    answer = CALIBRATION
    other = modbus.encode(modbus.ReadInputRegisters(2, 0, 1), PROFILE)
    scene: Frames = [(0, CALIBRATION), (SOON, answer), (SOON, other), (0.3, CALIBRATION), (SOON, answer), (4.0, READ)]

    assert rules(judged_frames(*scene)[1]) == [Rule.ASK_IN_CALIBRATION]


@pytest.mark.parametrize("answer", [b"!01050600\r", b"!010506009F\r"])
def test_a_checksum_setting_that_has_changed_withdraws_the_finding(answer: bytes) -> None:
    state, findings = judged_frames((0, b"$012B7\r"), (SOON, SEALED), (SOON, b"$012\r"), (SOON, answer))
    changed = not answer.startswith(b"!010506009F")

    assert rules(findings)[:1] == [Rule.DRIVER_CHECKSUM_MISSING]
    assert verdict(state).withdrawn == changed


@pytest.mark.parametrize(
    ("asked", "answer", "rule"),
    [
        (b"$012B7\r", b"!01050640b1\r", Rule.MODULE_LOWER_CASE),
        (b"$012\r", b"!01050600AA\r", Rule.LENGTH),
        (b"$01M\r", b"!01\x7f\r", Rule.ALPHABET),
        (READ, sealed("01040400"), Rule.LENGTH),
        (modbus.encode(modbus.SetModuleAddress(1, 5), PROFILE), sealed("014604"), Rule.SETTINGS_LENGTH),
    ],
)
def test_what_is_wrong_with_an_answer(asked: bytes, answer: bytes, rule: Rule) -> None:
    _, findings = judged_frames((0, asked), (SOON, answer))

    assert rules(findings) == [rule]


@pytest.mark.parametrize(
    ("known", "wire", "rule"),
    [
        (Known(checksum=True), b"$012\r", Rule.DRIVER_CHECKSUM_MISSING),
        (Known(model=Model.I_7018), b"$01A\r", Rule.LACKS_COMMAND),
        (Known(model=Model.I_7018), READ, Rule.LACKS_COMMAND),
        (Known(model=Model.M_7017RMS), modbus.encode(modbus.ReadCjcOffset(1, 0), PROFILE), Rule.LACKS_COMMAND),
        (Known(model=Model.I_7018, checksum=False), b"$012B7\r", Rule.DRIVER_CHECKSUM_UNEXPECTED),
    ],
)
def test_what_is_wrong_with_a_command_for_a_module_that_is_known(known: Known, wire: bytes, rule: Rule) -> None:
    _, findings = judged_frames((0, wire), known=known)

    assert rules(findings) == [rule]


@pytest.mark.parametrize(("wire", "address"), [(b"$0a2\r", 0x0A), (b"$0x2\r", None), (b"$0\r", None)])
def test_the_address_of_a_command_in_lower_case_is_named(wire: bytes, address: int | None) -> None:
    _, (finding,) = judged_frames((0, wire))

    assert finding.address == address


# --- EEPROM -----------------------------------------------------------------------------------------------------------


def test_the_clock_and_the_logger_are_not_the_eeprom() -> None:
    index = modbus.encode(modbus.WriteSingleRegister(1, 878, 1), Profile(Model.M_7017mC_16))

    scene: Frames = [(0.3, it) for _ in range(2 * EEPROM_WRITES) for it in (index, index)]

    assert Rule.EEPROM_LOOP not in rules(judged_frames(*scene)[1])


def test_every_command_that_sets_something_for_good_counts_as_a_write() -> None:
    passing = {dcon.SetCjcUpdate, dcon.SetCalibrationEnabled, dcon.SetSoftInitTimeout, modbus.SetCjcUpdate}
    setting = {
        kind
        for kind in (*dcon.COMMANDS, *modbus.REQUESTS)
        if kind.__name__.startswith(("Set", "Calibrate", "Reload", "Reset"))
    }

    assert setting - passing == STORING


@pytest.mark.parametrize(("register", "count"), [(484, 1), (878, 0)])
def test_a_write_to_a_register_counts_if_it_is_a_setting(register: int, count: int) -> None:
    write = modbus.encode(modbus.WriteSingleRegister(1, register, 1), PROFILE)

    state, _ = judged_frames((0, write), (SOON, write))

    assert len(state.writes.get(1, ())) == count


def test_writes_that_are_minutes_apart_are_no_loop() -> None:
    scene: Frames = [it for _ in range(2 * EEPROM_WRITES) for it in [(30.0, OFFSET), (SOON, b"!01\r")]]

    assert rules(judged_frames(*scene)[1]) == []


# --- any input --------------------------------------------------------------------------------------------------------

WIRES = st.sampled_from([*{wire for scene in SCENES.values() for _, wire in scene}]) | st.binary(max_size=12)


@given(st.lists(st.tuples(st.none() | st.floats(-1, 1), WIRES.filter(bool)), max_size=30), st.booleans())
def test_nothing_raises_and_every_frame_is_counted_once(frames: Any, collecting: Any) -> None:
    state, findings = judged_frames(*frames, state=evolve(AT_PORT, collecting=collecting))

    found = verdict(state)
    assert found.frames + found.unjudged <= len(frames)
    assert found.findings() + found.withdrawn >= len(findings) - found.withdrawn
    assert all(count > 0 for tally in found.tallies for _, count in tally.findings)


def test_the_state_does_not_grow_with_the_input() -> None:
    chance = Random(7)
    wires = [wire for scene in SCENES.values() for _, wire in scene]
    settings = [b"$%02X9+0001\r" % address for address in range(256)]
    scene: Frames = [
        (chance.choice([0.0, 0.001, 0.1, 1.0]), chance.choice(chance.choice([wires, settings]))) for _ in range(6000)
    ]

    state, findings = judged_frames(*scene)

    assert findings
    assert len(state.pauses) <= 2
    assert len(state.writes) <= 257
    assert all(len(times) <= EEPROM_WRITES for times in state.writes.values())
    assert len(state.counts) <= 2 * 257
    assert len(state.untimed) <= len(Rule)


@pytest.mark.parametrize(
    ("options", "name"),
    [({"bound": -1.0}, "bound"), ({"bound": inf}, "bound"), ({"character_time": -1.0}, "character_time")],
)
def test_times_that_cannot_be_are_refused(options: dict[str, Any], name: str) -> None:
    with pytest.raises(InvalidValueError) as refused:
        Judge(**options)

    assert refused.value.field == name


def test_arguments_of_other_types_are_refused() -> None:
    line, heard = hear_frame(Line(), b"$012\r", Protocol.DCON)
    wrong: list[Any] = [(1, heard, line.knowledge), (Judge(), 1, line.knowledge), (Judge(), heard, 1)]
    for arguments in wrong:
        with pytest.raises(ArgumentError):
            judge(*arguments)
    with pytest.raises(ArgumentError):
        judge(Judge(), heard, Knowledge(), 1.0)  # type: ignore[arg-type]
    with pytest.raises(ArgumentError):
        verdict(1)  # type: ignore[arg-type]


def test_an_answer_that_the_host_sends_itself_is_not_held_against_the_module() -> None:
    line, heard = hear_frame(Line(), b"!017018\r", Protocol.DCON, sent=True)

    state, findings = judge(Judge(), heard, line.knowledge, sent=True)

    assert (findings, state.unjudged) == ((), 1)
