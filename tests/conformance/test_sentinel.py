"""The read that shows that a module is there: one that it answers; and what comes of a module that does not."""

import re
from collections import Counter

import pytest
from attrs import evolve

from i7000 import Model, Protocol, modbus
from i7000.conformance.hazard import DEFAULT_ALLOWED
from i7000.conformance.verdict import SkipReason, Verdict
from i7000.device import Eeprom, Signals, State, power_on, step
from tests.conformance.bench import STATEMENTS, Bench, Step, answering, checked, memory, silent
from tests.each import each

R = Model.M_7019R
SOME = ["link", "frame", "timing", "dcon/2.10", "dcon/2.23", "dcon/2.24", "rtu/46/00", "rtu/address", "rtu/crc"]


def rtu() -> Eeprom:
    return memory(R, protocol=Protocol.MODBUS_RTU)


def bad(eeprom: Eeprom, firmware: Step) -> dict[str, Verdict]:
    """Return the verdicts of the checks that neither pass nor are skipped because they do not apply."""
    results = checked(SOME, eeprom, firmware, allowed=DEFAULT_ALLOWED)
    good = (Verdict.PASS, Verdict.INFO)
    skipped = (SkipReason.NOT_APPLICABLE, SkipReason.HAZARD)
    return {it.id: it.verdict for it in results.values() if it.verdict not in good and it.reason not in skipped}


# --- modules without one of the plain reads ---------------------------------------------------------------------------

LACKING = {
    "$AAM": (rb"\$01M\r", {"dcon/2.24/reply"}),
    "$AA2": (rb"\$012\r", {"dcon/2.10/reply"}),
    "$AAF": (rb"\$01F\r", {"dcon/2.23/reply"}),
    "$AAM and $AA2": (rb"\$01[M2]\r", {"dcon/2.24/reply", "dcon/2.10/reply"}),
}


@each("name", LACKING)
def test_a_module_that_lacks_a_plain_read_fails_the_check_of_it_only(name: str) -> None:
    pattern, ids = LACKING[name]

    assert bad(memory(R), silent(pattern)) == dict.fromkeys(ids, Verdict.FAIL)


def test_a_module_with_another_name_fails_the_check_of_it_only() -> None:
    renamed = answering(lambda frame, wire: b"!01CLONE\r" if frame == b"$01M\r" else wire)

    assert bad(memory(R), renamed) == {"dcon/2.24/reply": Verdict.FAIL}


LACKING_OF_MODBUS = {
    "46h 00": ((modbus.seal(b"\1\x46\0"),), {"rtu/46/00/reply"}),
    "the register of the address": ((b"\1\3\1\xe4",), set[str]()),
    "both": ((modbus.seal(b"\1\x46\0"), b"\1\3\1\xe4"), {"rtu/46/00/reply"}),
}


@each("name", LACKING_OF_MODBUS)
def test_a_module_that_lacks_a_plain_request_fails_the_check_of_it_only(name: str) -> None:
    starts, ids = LACKING_OF_MODBUS[name]
    lacking = answering(lambda frame, wire: None if frame.startswith(starts) else wire)

    assert bad(rtu(), lacking) == dict.fromkeys(ids, Verdict.FAIL)


def test_old_firmware_without_a_register_of_its_address_has_a_sentinel_too() -> None:
    old = memory(Model.M_7017, "A1.0", protocol=Protocol.MODBUS_RTU)
    lacking = answering(lambda frame, wire: None if frame.startswith(b"\1\x46\0") else wire)

    assert checked(["frame/rtu"], old, lacking)["frame/rtu/address"].verdict is Verdict.PASS


@pytest.mark.parametrize("eeprom", [memory(R), rtu()], ids=["dcon", "modbus"])
def test_a_module_that_answers_nothing_passes_nothing(eeprom: Eeprom) -> None:
    results = checked(SOME, eeprom, answering(lambda _, __: None), allowed=DEFAULT_ALLOWED)

    assert {it.verdict for it in results.values()} == {Verdict.INCONCLUSIVE, Verdict.SKIP}


@pytest.mark.parametrize("babble", [b"!01\r", b"!017019R\r", modbus.seal(b"\1\x46\0\0")])
def test_a_module_that_babbles_passes_no_check_of_silence(babble: bytes) -> None:
    results = checked(["frame", "link/no-echo"], memory(R), answering(lambda _, __: babble), allowed=DEFAULT_ALLOWED)

    assert "frame/dcon/address" not in {it.id for it in results.values() if it.verdict is Verdict.PASS}


def test_the_sentinel_follows_a_change_of_the_configuration() -> None:
    results = checked(["dcon/2.1", "dcon/2.18"], memory(R), silent(rb"\$01M\r"))

    assert {it.verdict for it in results.values()} == {Verdict.PASS}


# --- garbage ----------------------------------------------------------------------------------------------------------


def losing_the_next(pattern: bytes) -> Step:
    """Return a firmware that does not hear the command after one that a pattern matches."""
    lost = [False]

    def altered(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
        missed, lost[0] = lost[0], re.match(pattern, frame) is not None
        return (state, None) if missed else step(state, frame, signals, now)

    return altered


@pytest.mark.parametrize("pattern", [rb"\$0\r", rb"\$01\r", rb"\$0[^1]", rb"!"])
def test_a_firmware_that_loses_the_command_after_garbage_fails(pattern: bytes) -> None:
    result = checked(["frame/recovers/dcon"], memory(R), losing_the_next(pattern))["frame/recovers/dcon"]

    assert result.verdict is Verdict.FAIL
    assert result.text.endswith("is not answered")


def test_a_firmware_that_loses_the_command_after_a_wrong_checksum_fails() -> None:
    made = memory(R)
    summed = evolve(made, report_settings=evolve(made.report_settings, checksum=True))

    def altered(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
        missed, lost[0] = lost[0], len(frame) == 7 and step(state, frame, signals, now)[1] is None
        return (state, None) if missed else step(state, frame, signals, now)

    lost = [False]
    bench = Bench(power_on(summed, now=0.0), altered)
    result = checked(["frame/recovers/dcon"], summed, bench=bench)["frame/recovers/dcon"]

    assert result.text.startswith("a request after ")
    assert result.verdict is Verdict.FAIL


# --- statements -------------------------------------------------------------------------------------------------------


def test_no_two_checks_have_the_same_requirement() -> None:
    counted = Counter(it.requirement for it in STATEMENTS.values())

    assert not {sentence for sentence, count in counted.items() if count > 1}


def test_the_types_that_were_tried_are_said() -> None:
    result = checked(["values/types"], memory(R))["values/types"]

    assert result.verdict is Verdict.PASS
    assert re.fullmatch(r"types tried: [0-9A-F]{2}(, [0-9A-F]{2}){6}", result.text)


DEFAULT = [it for it in STATEMENTS.values() if not {hazard.value for hazard in it.hazards} - {"memory"}]


@each("eeprom", [memory(R), rtu(), memory(Model.M_7017mC_16)])
def test_a_default_run_sends_no_code_that_a_vendor_may_use(eeprom: Eeprom) -> None:
    bench = Bench(power_on(eeprom, now=0.0))
    checked([it.id for it in DEFAULT], eeprom, allowed=DEFAULT_ALLOWED, bench=bench)
    codes = {wire[1] for wire in bench.sent if eeprom.protocol is Protocol.MODBUS_RTU and len(wire) > 1}

    assert not codes & {*range(0x41, 0x46), 0x47, 0x48, *range(0x64, 0x6F)}
    assert not [wire for wire in bench.sent if re.match(rb"[$~@]01Z|#01G|\x01F[\x0a\x1f\x31\x7f\xff]", wire)]
