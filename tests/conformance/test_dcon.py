"""The checks of the DCON commands: every model passes them, and each of them finds a firmware at fault."""

import json
from collections.abc import Callable, Mapping
from fnmatch import fnmatchcase
from types import MappingProxyType
from typing import Any, NamedTuple

import pytest
from attrs import evolve

from i7000 import Model, spec
from i7000.conformance.statement import Level
from i7000.conformance.verdict import SkipReason, Verdict
from i7000.device import Signals, State, power_on, step
from i7000.settings import DataFormat, Filter, Protocol
from i7000.type_codes import TypeCode
from tests.conformance.bench import (
    STATEMENTS,
    Bench,
    Step,
    acknowledging,
    answering,
    checked,
    hearing,
    memory,
    refusing,
    replaced,
    saying,
    silent,
    undone,
)
from tests.each import each

GROUP = [it for it in STATEMENTS.values() if it.group == "dcon"]
MOST_WRITES = 52
"""What the four groups may use of the 64 of a run."""
COMMANDS = json.loads(spec.files().joinpath("tables/dcon_commands.json").read_text("utf-8"))["rows"]


def test_every_command_has_a_check_and_every_section_too() -> None:
    sections = {section for it in GROUP for section in it.sections}

    assert not {f"2.{number}" for number in range(1, 44)} - sections
    assert not {row["name"] for row in COMMANDS} - {it.command for it in GROUP}


def test_every_command_is_tested_for_what_it_should_not_do() -> None:
    halves = {it.command for it in GROUP if it.positive is not None}

    assert not {row["name"] for row in COMMANDS} - halves


# --- modules at which there is no fault -------------------------------------------------------------------------------

GROUPS = ("dcon", "values", "consistency", "init")


@each("model", Model)
def test_every_model_passes(model: Model) -> None:
    results = checked(GROUPS, memory(model))

    assert not undone(results)
    assert sum(it.writes for it in results.values()) <= MOST_WRITES


@each("model", [Model.I_7017, Model.M_7017Z, Model.M_7018R, Model.M_7019R])
def test_a_module_with_a_checksum_passes(model: Model) -> None:
    made = memory(model)

    assert not undone(checked(GROUPS, evolve(made, report_settings=evolve(made.report_settings, checksum=True))))


OLD = {
    Model.I_7017R: ("B3.8",),
    Model.I_7018: ("B1.4",),
    Model.M_7017: ("B2.9",),
    Model.M_7017R: ("B3.8",),
    Model.M_7018R: ("B4.1", "B4.4"),
    Model.M_7019R: ("B2.6", "B3.6"),
}
"""Firmware that lacks something, or has another form of it."""


@each(("model", "firmware"), [pytest.param(model, it, id=f"{model} {it}") for model, its in OLD.items() for it in its])
def test_old_firmware_passes(model: Model, firmware: str) -> None:
    assert not undone(checked(GROUPS, memory(model, firmware)))


def test_channels_that_are_off_pass() -> None:
    for model in (Model.I_7017, Model.M_7018R, Model.M_7019Z):
        assert not undone(checked(GROUPS, memory(model, channel_mask=0x5B)))


def test_a_module_with_single_ended_inputs_and_a_hex_format_passes() -> None:
    made = memory(Model.M_7017Z, single_ended=True)
    in_hex = evolve(made, report_settings=evolve(made.report_settings, data_format=DataFormat.HEX))

    assert not undone(checked(GROUPS, in_hex))


def test_no_check_leaves_a_setting_changed() -> None:
    for model in (Model.I_7017, Model.M_7017Z, Model.M_7019R):
        bench = Bench(power_on(memory(model), now=0.0))
        checked(GROUPS, memory(model), bench=bench)

        assert evolve(bench.state.eeprom, host_watchdog_timeouts=0) == memory(model)


def test_without_a_switch_for_the_power_nothing_is_changed_for_it() -> None:
    bench = Bench(power_on(memory(Model.M_7019R), now=0.0), power=False)
    results = checked(["init/kept-settings", "init/switch-line"], memory(Model.M_7019R), bench=bench)

    assert {it.reason for it in results.values() if it.id != "link/alive"} == {SkipReason.NEEDS_HARDWARE}
    assert all(b"M" in wire for wire in bench.sent)


# --- firmwares at fault -----------------------------------------------------------------------------------------------


def no_tail(frame: bytes) -> bytes:
    return frame.replace(b"F3\r", b"\r").replace(b"E5\r", b"\r")


def never_times_out(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
    fed = state.keep(fed_at=now) if state.clock <= now else state
    return step(fed, frame, signals, now)


def always_calibrates(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
    return step(state.keep(calibration_enabled=True), frame, signals, now)


def samples_each_time(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
    if frame.startswith(b"$014") and state.ram.sampled is not None:
        state, _ = step(state, b"#**\r", signals, now)
    return step(state, frame, signals, now)


def forgets_samples(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
    after, wire = step(state, frame, signals, now)
    return (after.keep(sampled=None) if frame.startswith(b"$014") else after), wire


def sets_all_types(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
    after, wire = step(state, frame, signals, now)
    if frame.startswith(b"$017C") and wire == b"!01\r":
        code = after.eeprom.type_codes[int(frame[5:6], 16)]
        after = after.store(type_codes=(code,) * len(after.eeprom.type_codes))
    return after, wire


def changing_too(begins: bytes, change: Callable[[State], State]) -> Step:
    """Return a firmware that changes something else too when it carries out a command that some bytes begin."""

    def altered(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
        after, wire = step(state, frame, signals, now)
        return (change(after) if frame.startswith(begins) and wire == b"!01\r" else after), wire

    return altered


def no_offset(state: State) -> State:
    return state.store(cjc_offset=0)


def other_filter(state: State) -> State:
    report = state.eeprom.report_settings
    return state.store(report_settings=evolve(report, filter=Filter(not report.filter.value)))


def answers_all(_: bytes, wire: bytes | None) -> bytes | None:
    return b"!01\r" if wire is None else wire


class Case(NamedTuple):
    """A firmware, and the checks that find it, as patterns."""

    firmware: Step
    model: Model
    found: str
    changes: Mapping[str, Any] = MappingProxyType({})
    """Settings of the module."""
    sampled: bool = False


OUT = ("dcon/2.3/reply", "dcon/2.4/reply", "dcon/2.11/reply", "dcon/2.19/reply")
"""Answers without an address."""
READS = " ".join(it.id for it in GROUP if it.id.endswith("/reply") and it.command not in {"SoftInit", "ReadModuleName"})
SETS = "dcon/2.1/set dcon/2.13/set dcon/2.15/set dcon/2.18/set dcon/2.21/set dcon/2.30/set dcon/2.33/set dcon/2.41/set"
HALVES = " ".join(f"{it}-n1" for it in SETS.split() if "2.33" not in it)
CALIBRATE_19 = "dcon/2.8/calibrate dcon/2.9/calibrate"
R, Z, MC, S = Model.M_7019R, Model.M_7017Z, Model.M_7017mC_16, Model.I_7017

CASES = {
    "the last character of an answer is lost": Case(saying(rb".\r", b"\r"), R, READS, sampled=True),
    "an answer has a character more": Case(saying(b"\r", b"0\r"), Z, READS),
    "an answer has no carriage return": Case(saying(b"\r", b""), S, READS),
    "answers have another address": Case(
        saying(rb"(?<=[!>])01", b"02"), R, " ".join(it for it in READS.split() if it not in OUT), sampled=True
    ),
    "answers are in lower case": Case(
        answering(lambda frame, wire: wire and (wire if b"M" in frame else wire.lower())), R,
        "dcon/2.10/reply dcon/2.14/reply dcon/2.16/reply",
        {"channel_mask": 0xFA, "type_codes": (TypeCode.K,) * 8},
    ),
    "what follows a command is ignored": Case(
        hearing(no_tail), R, "dcon/2.?/reply-n1 dcon/2.??/reply-n1 dcon/2.2/sampling-n1 dcon/2.31/enable-n1 "
        f"dcon/2.27/calibrate-n1 dcon/2.28/reload-n1 dcon/2.37/reset-n1 dcon/2.39/set-n1 {HALVES}", sampled=True,
    ),
    "what follows a command of a 7017Z is ignored": Case(
        hearing(no_tail), Z, "dcon/2.19/reply-n1 dcon/2.42/reply-n1 dcon/2.43/set-n1 dcon/2.5/calibrate-n1 "
        "dcon/2.6/calibrate-n1"),
    "what follows a command of an mC-16 is ignored": Case(hearing(no_tail), MC, "dcon/2.7/calibrate-n1"),
    "a channel beyond the last is channel 0": Case(
        replaced(rb"^(#01|\$018C|\$01[01]C)[8-9A-Z]\r", rb"\g<1>0\r"), R,
        "dcon/2.4/reply-n2 dcon/2.16/reply-n2 dcon/2.8/calibrate-n2 dcon/2.9/calibrate-n2",
    ),
    "a letter after F is channel 0": Case(replaced(rb"CG\r", rb"C0\r"), MC, "dcon/2.7/calibrate-n2"),
    "the name has a character more": Case(saying(b"\r", b"R\r", to=rb"\$01M"), S, "dcon/2.24/reply"),
    "all is acknowledged": Case(
        answering(answers_all), R, "dcon/2/unknown-command dcon/2/bare dcon/2.35/silent dcon/2.35/silent-n1 "
        "dcon/2.2/sampling dcon/2.26/refused-n1 dcon/2.32/reply-n1 dcon/2.34/set-n1"),
    "#** is answered": Case(answering(answers_all), S, "dcon/2.2/ignored"),
    "the status of the first reading is 0": Case(saying(b">011", b">010"), R, "dcon/2.2/sampling"),
    "the status is always 1": Case(saying(b">010", b">011"), R, "dcon/2.2/sampling dcon/2.12/reply", sampled=True),
    "$AA4 samples anew": Case(samples_each_time, R, "dcon/2.2/sampling dcon/2.12/reply", sampled=True),
    "$AA4 is carried out once": Case(forgets_samples, R, "dcon/2.2/sampling dcon/2.12/reply", sampled=True),
    "$AA4 has letters": Case(saying(b">011.", b">011A"), R, "dcon/2.12/reply", sampled=True),
    "settings are not stored": Case(
        acknowledging(rb"%01|\$01[579A][^\r]|~01[CO3][^\r]|~01EO[^\r]"), R,
        f"{SETS} dcon/2.39/set dcon/2.39/timeout"
    ),
    "the mode is not stored": Case(acknowledging(rb"@01S."), Z, "dcon/2.43/set"),
    "settings are refused": Case(refusing(rb"%01|\$01[579A][^\r]|~01[CO3][^\r]|~01EO[^\r]"), R,
        f"{SETS} dcon/2.39/set"),
    "the mask begins with the last channel": Case(
        replaced(rb"^\$0157F\r", rb"$015FE\r"), R, "dcon/2.13/set"),
    "the mask has no channel 9 but 10": Case(replaced(rb"^\$0150(.)FF\r", rb"$01503FF\r"), Model.M_7019Z,
        "dcon/2.13/set-n1"),
    "a type is that of all channels": Case(sets_all_types, R, "dcon/2.15/set"),
    "an undefined type is taken for 08": Case(replaced(b"R30", b"R08"), R, "dcon/2.15/set-n1"),
    "a type toggles the filter": Case(changing_too(b"$017C", other_filter), R, "dcon/2.15/set"),
    "a name resets the offset": Case(changing_too(b"~01O", no_offset), R, "dcon/2.33/set", {"cjc_offset": 12}),
    "a mask resets the offset": Case(changing_too(b"$015", no_offset), R, "dcon/2.13/set", {"cjc_offset": 12}),
    "CJC resets the offset": Case(changing_too(b"~01C", no_offset), R, "dcon/2.30/set", {"cjc_offset": 12}),
    "the update toggles the filter": Case(changing_too(b"$01A", other_filter), R, "dcon/2.21/set"),
    "the mode toggles the protocol": Case(
        changing_too(b"@01S", lambda it: it.store(protocol=Protocol.MODBUS_RTU)), Z, "dcon/2.43/set"),
    "the sign of the offset is lost": Case(replaced(rb"^\$019-", rb"$019+"), R, "dcon/2.18/set"),
    "an offset beyond 1000h is cut": Case(replaced(rb"1001\r", rb"1000\r"), R, "dcon/2.18/set-n1"),
    "an update of 3 is taken": Case(replaced(rb"^\$01A3\r", rb"$01A2\r"), R, "dcon/2.21/set-n1"),
    "2 is taken for 1": Case(replaced(rb"^(~01C|~01EO|~013)2", rb"\g<1>1"), R, "dcon/2.30/set-n1 dcon/2.41/set-n1"),
    "a long name is cut": Case(replaced(rb"^(~01O......).\r", rb"\1\r"), R, "dcon/2.33/set-n1"),
    "the status cannot be reset": Case(
        acknowledging(b"~011"), R, "dcon/2.37/reset dcon/2.39/timeout", {"host_watchdog_timed_out": True}),
    "the protocol needs no switch": Case(acknowledging(rb"\$01P.\r"), R, "dcon/2.26/refused"),
    "soft INIT is refused": Case(refusing(b"~01I"), R, "dcon/2.32/reply"),
    "60 seconds are too many": Case(refusing(b"~01T3C"), R, "dcon/2.34/set"),
    "the watchdog never times out": Case(never_times_out, R, "dcon/2.39/timeout"),
    "~** is ignored": Case(replaced(rb"^~\*\*\r", b""), R, "dcon/2.39/timeout-n1"),
    "calibrations are refused": Case(
        refusing(rb"\$01[01S]|~01E.\r"), R, f"{CALIBRATE_19} dcon/2.27/calibrate dcon/2.28/reload dcon/2.31/enable"),
    "span and zero are refused": Case(refusing(rb"\$01[01]\r"), S, "dcon/2.5/calibrate dcon/2.6/calibrate"),
    "current inputs are not calibrated": Case(refusing(rb"\$010C"), MC, "dcon/2.7/calibrate"),
    "calibration is always enabled": Case(
        always_calibrates, R, "dcon/2.8/calibrate-n1 dcon/2.9/calibrate-n1 dcon/2.31/enable-n1"),
    "calibration of a 7017 is always enabled": Case(
        always_calibrates, S, "dcon/2.5/calibrate-n1 dcon/2.6/calibrate-n1 dcon/2.31/enable-n1"),
    "nothing is answered to $AA4": Case(silent(rb"\$014"), R, "dcon/2.12/reply dcon/2.2/sampling", sampled=True),
    "nothing is answered to a calibration": Case(silent(rb"\$010C"), R, "dcon/2.8/calibrate"),
    "~** is answered": Case(answering(answers_all), R, "dcon/2.39/timeout-n1"),
    "faults of channels that are off": Case(
        saying(b"!01..", b"!0101", to=rb"\$01B"), R, "dcon/2.22/reply", {"channel_mask": 0xFE}),
}  # fmt: skip


def verdicts(case: Case) -> dict[str, Verdict]:
    """Return what the checks that should find the firmware say about it."""
    eeprom = memory(case.model, **case.changes)
    state = power_on(eeprom, now=0.0)
    if case.sampled:
        state, _ = step(state, b"#**\r", Signals(), 0.0)
    bench = Bench(state, case.firmware, line=state.ram.line_settings)
    ids = [it.id for it in GROUP if any(fnmatchcase(it.id, text) for text in case.found.split())]
    results = checked(ids, eeprom, bench=bench)
    return {id_: results[id_].verdict for id_ in ids if results[id_].verdict is not Verdict.SKIP}


@pytest.mark.parametrize("name", CASES)
def test_a_firmware_at_fault_is_found(name: str) -> None:
    found = verdicts(CASES[name])

    assert found
    assert not {id_: verdict for id_, verdict in found.items() if verdict not in (Verdict.FAIL, Verdict.FLAKY)}


def test_every_check_finds_some_firmware() -> None:
    found = {id_ for case in CASES.values() for id_ in verdicts(case)}
    missing = {it.id for it in GROUP if it.level is not Level.OPEN} - found

    assert not missing


# --- open points ------------------------------------------------------------------------------------------------------


@each(
    ("firmware", "told"),
    [
        pytest.param(step, "silence", id="silence"),
        pytest.param(answering(lambda _, wire: wire or b"?01\r"), "?01", id="refusal"),
    ],
)
def test_the_way_of_refusal_is_told(firmware: Step, told: str) -> None:  # fmt: skip
    result = checked(["dcon/2/way-of-refusal"], memory(Model.I_7017), firmware)["dcon/2/way-of-refusal"]

    assert (result.verdict, result.text) == (Verdict.INFO, f"an unknown command is answered with {told}")


def test_commands_of_other_models_are_told() -> None:
    more = answering(lambda frame, wire: b">+0025.0\r" if frame == b"$013\r" else wire)
    result = checked(["dcon/2/of-other-models"], memory(Model.I_7017), more)["dcon/2/of-other-models"]

    assert result.text == "the module answers commands of other models: $013"


OPEN_POINTS = {
    "two digits for ten channels in $AAB": (Model.M_7019Z, saying(b"(!01..)..", rb"\1", to=rb"\$01B")),
    "two digits for sixteen channels in $AA6": (Model.M_7018_16, saying(b"(!01..)..", rb"\1", to=rb"\$016")),
    "no channel in one digit after 9": (Model.M_7017mC_16, refusing(rb"#01[A-F]\r")),
    "another type code where it is not used": (R, saying(b"!01..", b"!0100", to=rb"\$012")),
    "readings far beyond their range": (S, saying(rb">[+]\d\d\.\d{3}", b">+13.000", to=b"#010?\r")),
}


@pytest.mark.parametrize("name", OPEN_POINTS)
def test_a_firmware_that_reads_an_open_point_otherwise_does_not_fail(name: str) -> None:
    model, firmware = OPEN_POINTS[name]
    results = checked(["dcon", "values/shape", "values/disabled", "consistency/type-codes"], memory(model), firmware)

    assert not {it.id: it.text for it in results.values() if it.verdict in (Verdict.FAIL, Verdict.FLAKY)}
