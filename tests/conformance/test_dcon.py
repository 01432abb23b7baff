"""The checks of the DCON commands: every model passes them, and each of them finds a firmware at fault."""

import json
from typing import NamedTuple

import pytest
from attrs import evolve

from i7000 import Model, spec
from i7000.conformance.run import selected
from i7000.conformance.statement import Level, statements
from i7000.conformance.verdict import Verdict
from i7000.device import Eeprom, Signals, State, step
from tests.conformance.bench import (
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
    undone,
)
from tests.each import each

GROUP = [it for it in statements().values() if it.group == "dcon"]
COMMANDS = json.loads(spec.files().joinpath("tables/dcon_commands.json").read_text("utf-8"))["rows"]


def test_every_command_has_a_check_and_every_section_too() -> None:
    sections = {section for it in GROUP for section in it.sections}

    assert not {f"2.{number}" for number in range(1, 44)} - sections
    assert not {row["name"] for row in COMMANDS} - {it.command for it in GROUP}


def test_every_command_is_tested_for_what_it_should_not_do() -> None:
    halves = {it.command for it in GROUP if it.positive is not None}

    assert not {row["name"] for row in COMMANDS} - halves


@each("model", Model)
def test_every_model_passes(model: Model) -> None:
    assert not undone(checked(["dcon"], memory(model)))


@each("model", [Model.I_7017, Model.M_7017Z, Model.M_7018R, Model.M_7019R])
def test_a_module_with_a_checksum_passes(model: Model) -> None:
    made = memory(model)

    assert not undone(checked(["dcon"], evolve(made, report_settings=evolve(made.report_settings, checksum=True))))


@each("firmware", ["B1.4", "B2.6", "B3.6", "B4.1", "B4.4"])
@each("model", [Model.I_7017R, Model.I_7018, Model.M_7017R, Model.M_7018R, Model.M_7019R])
def test_old_firmware_passes(model: Model, firmware: str) -> None:
    assert not undone(checked(["dcon"], memory(model, firmware)))


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


def answers_all(frame: bytes, wire: bytes | None) -> bytes | None:
    return b"!01\r" if wire is None else wire


class Case(NamedTuple):
    """A firmware, and the checks that find it, as patterns."""

    firmware: Step
    model: Model
    found: str
    changes: dict[str, object] = {}
    """Settings of the module."""
    sampled: bool = False


OUT = ("dcon/2.3/reply", "dcon/2.4/reply", "dcon/2.11/reply", "dcon/2.19/reply")
"""Answers without an address."""
READS = " ".join(it.id for it in GROUP if it.id.endswith("/reply") and it.command not in (None, "SoftInit"))
SETS = "dcon/2.1/set dcon/2.13/set dcon/2.15/set dcon/2.18/set dcon/2.21/set dcon/2.30/set dcon/2.33/set dcon/2.41/set"
HALVES = " ".join(f"{it}-n1" for it in SETS.split())
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
        answering(lambda _, wire: wire and wire.lower()), R, "dcon/2.10/reply dcon/2.14/reply dcon/2.16/reply",
        {"channel_mask": 0xFA},
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
    "all is acknowledged": Case(
        answering(answers_all), R, "dcon/2/unknown-command dcon/2.35/silent dcon/2.35/silent-n1 dcon/2.2/sampling "
        "dcon/2.26/refused-n1 dcon/2.32/reply-n1 dcon/2.34/set-n1"),
    "#** is answered": Case(answering(answers_all), S, "dcon/2.2/ignored"),
    "the status of the first reading is 0": Case(saying(b">011", b">010"), R, "dcon/2.2/sampling"),
    "the status is always 1": Case(saying(b">010", b">011"), R, "dcon/2.2/sampling dcon/2.12/reply", sampled=True),
    "$AA4 samples anew": Case(samples_each_time, R, "dcon/2.2/sampling dcon/2.12/reply", sampled=True),
    "$AA4 is carried out once": Case(forgets_samples, R, "dcon/2.2/sampling dcon/2.12/reply", sampled=True),
    "$AA4 has letters": Case(saying(b">011.", b">011A"), R, "dcon/2.12/reply", sampled=True),
    "settings are not stored": Case(
        acknowledging(rb"%01|\$01[579].|\$01A.|~01[CO3].|~01EO."), R, f"{SETS} dcon/2.39/set dcon/2.39/timeout"
    ),
    "the mode is not stored": Case(acknowledging(rb"@01S."), Z, "dcon/2.43/set"),
    "settings are refused": Case(refusing(rb"%01|\$01[579].|\$01A.|~01[CO3].|~01EO."), R, f"{SETS} dcon/2.39/set"),
    "the mask begins with the last channel": Case(
        saying(b"!01(..)\r", rb"!01\1\r", to=rb"\$016").__class__ and replaced(rb"^\$0157F\r", rb"$015FE\r"), R,
        "dcon/2.13/set"),
    "the mask has no channel 9 but 10": Case(replaced(rb"^\$0150(.)FF\r", rb"$01503FF\r"), Model.M_7019Z, "dcon/2.13/set-n1"),
    "a type is that of all channels": Case(sets_all_types, R, "dcon/2.15/set"),
    "an undefined type is taken for 08": Case(replaced(b"R30", b"R08"), R, "dcon/2.15/set-n1"),
    "the sign of the offset is lost": Case(replaced(rb"^\$019-", rb"$019+"), R, "dcon/2.18/set"),
    "an offset beyond 1000h is cut": Case(replaced(rb"1001\r", rb"1000\r"), R, "dcon/2.18/set-n1"),
    "an update of 3 is taken": Case(replaced(rb"^\$01A3\r", rb"$01A2\r"), R, "dcon/2.21/set-n1"),
    "2 is taken for 1": Case(replaced(rb"^(~01C|~01EO|~013)2", rb"\g<1>1"), R, "dcon/2.30/set-n1 dcon/2.41/set-n1"),
    "a long name is cut": Case(replaced(rb"^(~01O......).\r", rb"\1\r"), R, "dcon/2.33/set-n1"),
    "the status cannot be reset": Case(
        acknowledging(b"~011"), R, "dcon/2.37/reset dcon/2.39/timeout", {"host_watchdog_timed_out": True}),
    "the reserved data format is taken for hex": Case(replaced(rb"3\r", rb"2\r"), R, "dcon/2.1/set-n1"),
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
    "faults of channels that are off": Case(
        saying(b"!01..", b"!0101", to=rb"\$01B"), R, "dcon/2.22/reply", {"channel_mask": 0xFE}),
}  # fmt: skip


def found_by(case: Case) -> dict[str, Verdict]:
    eeprom = memory(case.model, **case.changes)
    ids = [id_ for text in case.found.split() for id_ in selected([text]) if text_matches(text, id_)]
    return verdicts(case, eeprom, ids)


def text_matches(text: str, id_: str) -> bool:
    return id_ == text or ("?" in text and id_ != "link/alive" and not id_.endswith("/reply"))


def verdicts(case: Case, eeprom: Eeprom, ids: list[str]) -> dict[str, Verdict]:
    from i7000.device import power_on  # noqa: PLC0415

    state = power_on(eeprom, now=0.0)
    if case.sampled:
        state, _ = step(state, b"#**\r", Signals(), 0.0)
    bench = Bench(state, case.firmware, line=state.ram.line_settings)
    results = checked(ids, eeprom, bench=bench)
    return {id_: results[id_].verdict for id_ in ids if results[id_].verdict is not Verdict.SKIP}


@pytest.mark.parametrize("name", CASES)
def test_a_firmware_at_fault_is_found(name: str) -> None:
    found = found_by(CASES[name])

    assert found
    assert set(found.values()) == {Verdict.FAIL}
