"""The checks of readings: each of them finds a firmware at fault."""

import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

import pytest

from i7000 import Model, Protocol, modbus
from i7000.conformance.statement import Level
from i7000.conformance.verdict import Verdict
from i7000.device import Signal, Signals, State, power_on, step
from i7000.settings import DataFormat, ModbusDataFormat, ReportSettings
from i7000.simulator import Fixed, Ramp, Sources
from i7000.type_codes import TypeCode, Unit
from tests.conformance.bench import STATEMENTS, Bench, Step, by_turns, checked, memory, saying

GROUP = [it for it in STATEMENTS.values() if it.group == "values"]


def in_format(data_format: DataFormat, pattern: bytes, by: bytes) -> Step:
    """Return a firmware whose readings have something else in place of a pattern in one data format."""

    def altered(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
        after, wire = step(state, frame, signals, now)
        if wire and frame.startswith(b"#") and state.profile.data_format is data_format:
            wire = re.sub(pattern, by, wire)
        return after, wire

    return altered


def of_type(code: TypeCode, pattern: bytes, by: bytes) -> Step:
    """Return a firmware whose first channel has something else in place of a pattern in one type."""

    def altered(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
        after, wire = step(state, frame, signals, now)
        if wire and frame.startswith(b"#010") and state.profile.type_codes[0] is code:
            wire = re.sub(pattern, by, wire)
        return after, wire

    return altered


def swaps_engineering_bytes(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
    after, wire = step(state, frame, signals, now)
    if wire and frame[1:2] == b"\x04" and state.profile.modbus_data_format is ModbusDataFormat.ENGINEERING:
        body = wire[:-2]
        words = b"".join(body[at : at + 2][::-1] for at in range(3, len(body), 2))
        wire = modbus.seal(body[:3] + words)
    return after, wire


def loses_a_register(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
    after, wire = step(state, frame, signals, now)
    return after, modbus.seal(wire[:2] + bytes((wire[2] - 2,)) + wire[3:-4]) if wire and frame[1] == 4 else wire


class Case(NamedTuple):
    """A firmware, and the checks that find it."""

    firmware: Step
    model: Model
    found: str
    changes: Mapping[str, Any] = MappingProxyType({})
    sources: Sources | None = None


RTU = {"protocol": Protocol.MODBUS_RTU}
K = {"type_codes": (TypeCode.K,) * 8}
OPEN = Sources(())
IN_HEX = {"report_settings": ReportSettings(DataFormat.HEX)}
CASES = {
    "a decimal more": Case(saying(rb"([+-])0(\d)\.(\d{3})", rb"\1\2.\g<3>0"), Model.I_7017, "values/shape values/hex"),
    "another number of fields": Case(saying(rb">.{7}", b">", to=b"#01\r"), Model.I_7017, "values/shape"),
    "a register is lost": Case(loses_a_register, Model.M_7017, "values/shape", RTU),
    "the sentinel of another format": Case(
        saying(rb"\+9999\.9", b"+999.99"), Model.M_7019R, "values/sentinels", K, OPEN),
    "hex without a sign": Case(saying(rb"[89A-F](?=...)", b"7", to=rb"\$01A"), Model.I_7017, "values/hex",
        sources=Sources((Fixed(Signal(-5.0, Unit.VOLT)),) * 8)),
    "percent of half the range": Case(
        in_format(DataFormat.PERCENT, rb"\+0(\d)(\d)\.", rb"+00\1."), Model.M_7019R, "values/format-percent"),
    "percent with another point": Case(
        in_format(DataFormat.PERCENT, rb"\+(\d{3})\.(\d\d)", rb"+\1\2."), Model.I_7017, "values/format-percent"),
    "hex with swapped bytes": Case(
        in_format(DataFormat.HEX, rb"(\w\w)(\w\w)", rb"\2\1"), Model.I_7017, "values/format-hex"),
    "engineering with the sign of the first": Case(
        in_format(DataFormat.ENGINEERING, rb"\+", rb"-"), Model.I_7017, "values/format-engineering", IN_HEX),
    "engineering registers with swapped bytes": Case(
        swaps_engineering_bytes, Model.M_7017, "values/modbus-formats", RTU),
    "another number of decimals in one type": Case(
        of_type(TypeCode.MA_4_20, rb">.{7}", b">+1.0000"), Model.M_7019R, "values/types"),
    "the decimals of the type before": Case(
        of_type(TypeCode.V_5, rb"([+-])(\d)\.(\d{3}).", rb"\g<1>0\2.\3"), Model.I_7017, "values/types-of-all"),
    "the reading of a disabled channel": Case(
        saying(rb" {7}", b"+00.000", to=rb"#01.\r"), Model.M_7019R, "values/disabled"),
    "a fault of a disabled channel": Case(
        saying(b"!01..", b"!0101", to=rb"\$01B"), Model.M_7019R, "values/disabled"),
}  # fmt: skip


def verdicts(case: Case, *ids: str) -> dict[str, tuple[Verdict, str]]:
    eeprom = memory(case.model, **case.changes)
    bench = Bench(power_on(eeprom, now=0.0), case.firmware, sources=case.sources)
    results = checked(ids, eeprom, bench=bench)
    return {id_: (results[id_].verdict, results[id_].text) for id_ in ids}


@pytest.mark.parametrize("name", CASES)
def test_a_firmware_at_fault_is_found(name: str) -> None:
    for verdict, _ in verdicts(CASES[name], *CASES[name].found.split()).values():
        assert verdict is Verdict.FAIL


def test_every_check_finds_some_firmware() -> None:
    found = {id_ for case in CASES.values() for id_ in case.found.split()}

    assert found == {it.id for it in GROUP if it.level is not Level.OPEN}


def test_a_zero_with_a_minus_is_told() -> None:
    firmware = saying(rb"\+(?=[0.]{6})", b"-", to=b"#01\r")
    still = Sources((Fixed(Signal(0.0, Unit.VOLT)),) * 8)
    case = Case(firmware, Model.I_7017, "", sources=still)

    assert verdicts(case, "values/zero")["values/zero"] == (
        Verdict.INFO,
        "channel 0 has a zero with a minus: -00.000",
    )


def test_fields_out_of_range_of_every_type_pass() -> None:
    for sources in (OPEN, Sources((Fixed(Signal(-100.0, Unit.VOLT)),) * 8)):
        for data_format in DataFormat:
            changes = K | {"report_settings": ReportSettings(data_format)}
            case = Case(step, Model.M_7019R, "", changes, sources)

            assert verdicts(case, "values/sentinels")["values/sentinels"] == (Verdict.PASS, "")


def test_voltages_out_of_range_are_open() -> None:
    far = Sources((Fixed(Signal(100.0, Unit.VOLT)),) * 8)
    verdict, text = verdicts(Case(step, Model.I_7017, "", sources=far), "values/sentinels")["values/sentinels"]

    assert (verdict, text) == (Verdict.INFO, "no channel is out of range: the special fields were not seen")


def test_a_current_below_4_milliampere_is_under_range() -> None:
    low = Sources((Fixed(Signal(0.0, Unit.MILLIAMPERE)),) * 8)
    case = Case(step, Model.I_7017, "", {"type_codes": (TypeCode.MA_4_20,) * 8}, low)

    assert verdicts(case, "values/sentinels")["values/sentinels"] == (Verdict.PASS, "")


def test_a_signal_that_moves_too_fast_decides_nothing() -> None:
    turns = by_turns(
        rb"#|\$01A",
        step,
        saying(rb">....", b">8001", to=rb"\$01A"),
        saying(rb">.{7}", b">-02.000", to=b"#01\r"),
    )
    verdict, text = verdicts(Case(turns, Model.I_7017, ""), "values/hex")["values/hex"]

    assert verdict is Verdict.INCONCLUSIVE
    assert text == "the signal of channel 0 moves too fast"


def test_a_signal_that_moves_slowly_passes() -> None:
    slow = Sources((Ramp(-10, 10, 60, Unit.VOLT),) * 8)

    for id_ in ("values/hex", "values/format-percent", "values/format-hex"):
        assert verdicts(Case(step, Model.I_7017, "", sources=slow), id_)[id_][0] is Verdict.PASS
