"""The checks of INIT and of the line: each of them finds a firmware at fault, and leaves the module as it was."""

import re
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import pytest
from attrs import evolve

from i7000 import BaudRate, LineSettings, Model, Protocol
from i7000.conformance.verdict import SkipReason, Verdict
from i7000.device import Eeprom, Signals, State, factory, power_on, step
from i7000.type_codes import TypeCode
from tests.conformance.bench import (
    STATEMENTS,
    Bench,
    Step,
    acknowledging,
    answering,
    checked,
    memory,
    refusing,
    saying,
    undone,
)

GROUP = [it for it in STATEMENTS.values() if it.group == "init"]
BAUD_19200 = LineSettings(BaudRate.BAUD_19200)


def takes_all(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
    """Change the baud rate and the checksum at once, without any permission."""
    if frame.startswith(b"%"):
        state = state.keep(soft_init_until=now + 1)
    return step(state, frame, signals, now)


def window_stays_open(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
    if state.ram.soft_init_until is not None:
        state = state.keep(soft_init_until=now + 1)
    return step(state, frame, signals, now)


def at_the_next_power_on(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
    after, wire = step(state, frame, signals, now)
    ram = state.ram
    return after.keep(line_settings=ram.line_settings, checksum=ram.checksum), wire


def at_once(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
    """Use what the INIT switch allows before the next power-on."""
    after, wire = step(state, frame, signals, now)
    if frame.startswith(b"%") and wire == b"!01\r":
        after = after.keep(line_settings=after.eeprom.line_settings, checksum=after.eeprom.report_settings.checksum)
    return after, wire


def answers_at_both(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
    if state.ram.address == 0x02:
        frame = frame.replace(b"$01", b"$02")
    return step(state, frame, signals, now)


def without(**changes: Any) -> Callable[[Eeprom], Eeprom]:
    """Return a memory that forgets settings without power."""
    return lambda eeprom: evolve(eeprom, **changes)


class Case(NamedTuple):
    """A firmware, what it keeps without power, and the check that finds it."""

    firmware: Step
    model: Model
    found: str
    stored: Callable[[Eeprom], Eeprom] = without()
    protocol: Protocol = Protocol.DCON


RTU = Protocol.MODBUS_RTU
R, S = Model.M_7019R, Model.I_7017
CASES = {
    "the baud rate needs no permission": Case(takes_all, R, "baud-refused"),
    "the checksum needs no permission": Case(takes_all, R, "checksum-refused"),
    "a refusal is an acknowledgement": Case(acknowledging(rb"%0101..07"), S, "baud-refused"),
    "the checksum is stored without permission": Case(acknowledging(rb"%0101....40"), S, "checksum-refused"),
    "the old address acknowledges": Case(saying(b"!02", b"!01", to=b"%0102"), S, "new-address"),
    "a new address is not stored": Case(answering(
        lambda frame, wire: b"!02\r" if frame.startswith(b"%0102") else wire and wire.replace(b"02", b"01")),
        S, "new-address"),
    "both addresses answer": Case(answers_at_both, S, "new-address"),
    "soft INIT allows nothing": Case(refusing(b"%0101..07"), R, "soft-init"),
    "soft INIT waits for the next power-on": Case(at_the_next_power_on, R, "soft-init"),
    "soft INIT does not allow a checksum": Case(at_the_next_power_on, R, "soft-init"),
    "soft INIT never ends": Case(window_stays_open, R, "soft-init-n1"),
    "a timeout of 0 is none": Case(window_stays_open, R, "soft-init-n2"),
    "INIT with the stored address": Case(saying(b"!00", b"!01", to=rb"\$00M"), S, "switch"),
    "INIT without the stored settings": Case(saying(b"(!..)....", rb"\g<1>0008", to=rb"\$002"), S, "switch"),
    "INIT allows no baud rate": Case(acknowledging(rb"%0001"), S, "switch-line"),
    "INIT uses the baud rate at once": Case(at_once, S, "switch-line"),
    "INIT allows no checksum": Case(acknowledging(rb"%0001"), S, "switch-line"),
    "INIT uses the checksum at once": Case(at_once, S, "switch-line"),
    "INIT allows no protocol": Case(refusing(rb"\$00P[01]"), R, "switch-protocol"),
    "a type is forgotten": Case(step, R, "kept-settings", without(type_codes=factory(R).type_codes)),
    "the mask is forgotten": Case(step, S, "kept-settings", without(channel_mask=0xFF)),
    "the offset is forgotten": Case(step, R, "kept-settings", without(cjc_offset=0)),
    "the configuration is forgotten": Case(
        step, S, "kept-configuration", without(report_settings=factory(S).report_settings)),
    "samples after power-on": Case(
        answering(lambda frame, wire: b">011" + b"+00.000" * 8 + b"\r" if frame == b"$014\r" else wire),
        R, "no-samples"),
    "a type that was written is forgotten": Case(
        step, R, "kept-register", without(type_codes=factory(R).type_codes), RTU),
    "a mask that was written is forgotten": Case(
        step, Model.M_7017, "kept-register", without(channel_mask=0xFF), RTU),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_a_firmware_at_fault_is_found(name: str) -> None:
    firmware, model, found, stored, protocol = CASES[name]
    eeprom = memory(model, protocol=protocol)
    bench = Bench(power_on(eeprom, now=0.0), firmware, stored=stored)
    id_ = f"init/{found}"
    result = checked([id_], eeprom, bench=bench)[id_]

    assert result.verdict in (Verdict.FAIL, Verdict.INCONCLUSIVE)
    assert bench.state.ram.line_settings == bench.line == LineSettings()
    assert bench.state.eeprom.line_settings == LineSettings()
    assert bench.state.eeprom == eeprom


def test_every_check_finds_some_firmware() -> None:
    assert {f"init/{case.found}" for case in CASES.values()} == {it.id for it in GROUP}


def test_a_module_that_speaks_modbus_passes() -> None:
    for model in (Model.M_7017, Model.M_7019R):
        results = checked(["init"], memory(model, protocol=RTU))

        assert {it.id for it in results.values() if it.verdict is Verdict.PASS} >= {
            "init/switch", "init/switch-line", "init/switch-protocol", "init/kept-register",
        }  # fmt: skip


def test_other_line_settings_are_changed_to_9600_baud() -> None:
    results = checked(["init"], memory(Model.M_7019R, line_settings=BAUD_19200))

    assert not undone(results)


def test_an_address_that_is_taken_is_passed_over() -> None:
    taken = answering(lambda frame, wire: b"!027018\r" if frame == b"$02M\r" and wire is None else wire)
    bench = Bench(power_on(memory(S), now=0.0), taken)

    assert checked(["init/new-address"], memory(S), bench=bench)["init/new-address"].verdict is Verdict.PASS
    assert any(re.match(b"%0103", wire) for wire in bench.sent)


def test_without_a_free_address_the_module_keeps_its_own() -> None:
    full = answering(lambda frame, wire: b"!%b7018\r" % frame[1:3] if frame[3:] == b"M\r" else wire)
    bench = Bench(power_on(memory(S), now=0.0), full)
    result = checked(["init/new-address"], memory(S, name="7018"), bench=bench)["init/new-address"]

    assert (result.verdict, result.reason) == (Verdict.SKIP, SkipReason.PREREQUISITE)


def test_types_are_kept_without_power() -> None:
    types: Mapping[str, Any] = {"type_codes": (TypeCode.K,) * 8}

    assert checked(["init/kept-settings"], memory(R, **types))["init/kept-settings"].verdict is Verdict.PASS
