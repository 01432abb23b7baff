"""The judgement of a line: scenes that break one rule each, and good conversations that break none."""

from typing import Any

import pytest
from attrs import evolve

from i7000 import Model, Profile, Protocol, dcon, modbus
from i7000.conformance.judge import EEPROM_WRITES, Judge, Level, Rule, Side, verdict
from i7000.device import factory, power_on
from i7000.dissect import Known
from i7000.link import VirtualPort
from tests.conformance.overheard import CHARACTER, conversation, judged, judged_frames, rules
from tests.spec.lint import Record, vectors
from tests.vectors import profile_of

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
    Rule.ASK_BEFORE_ANSWER: [(0, b"$012\r"), (0.1, b"$01M\r"), (SOON, b"!017018\r")],
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
