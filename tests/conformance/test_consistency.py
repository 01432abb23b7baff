"""The checks of one fact asked in two ways: each of them finds a firmware at fault."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

import pytest

from i7000 import Model, Protocol
from i7000.conformance.verdict import Verdict
from i7000.device import power_on, step
from i7000.simulator import Sources
from i7000.type_codes import TypeCode
from tests.conformance.bench import (
    STATEMENTS,
    Bench,
    Step,
    by_turns,
    checked,
    memory,
    refusing,
    replaced,
    saying,
    silent,
)

GROUP = [it for it in STATEMENTS.values() if it.group == "consistency" and it.protocol is Protocol.DCON]


class Case(NamedTuple):
    """A firmware, the check that finds it, and what it says."""

    firmware: Step
    model: Model
    found: str
    text: str
    changes: Mapping[str, Any] = MappingProxyType({})
    verdict: Verdict = Verdict.FAIL
    sources: Sources | None = None


R = Model.M_7019R
OPEN = Sources(())
K = {"type_codes": (TypeCode.K,) * 8}
CASES = {
    "the firmware changes": Case(
        by_turns(rb"\$01F", step, saying(b"B4.5", b"B4.6")), R, "firmware-version", "another answer than before"),
    "the configuration changes": Case(
        by_turns(rb"\$012", step, step, saying(b"00\r", b"80\r")), R, "configuration", "another answer than before"),
    "#AAN reads the next channel": Case(
        replaced(rb"^#010", b"#011"), Model.I_7017, "channels",
        "channel 0 reads 2.222 V in one way and 1.111 V in the other"),
    "a channel is off in one way": Case(
        saying(rb">.{7}", b">" + b" " * 7, to=b"#017"), R, "channels",
        "channel 7 reads disabled in one way and 8.889 V in the other"),
    "a channel of another form": Case(
        saying(rb">.{7}", b">+1.0000", to=b"#017"), R, "channels",
        ""),
    "nothing is answered": Case(silent(b"#01\r"), R, "channels", "length"),
    "what others read is refused": Case(refusing(b"#01\r"), R, "channels", "refused"),
    "the name changes": Case(
        by_turns(rb"\$01M", step, step, saying(b"7019R", b"7019Z", to=b"")), R, "module-name",
        "another answer than before"),
    "another type in $AA2": Case(
        saying(b"!01..", b"!010A", to=rb"\$012"), Model.I_7017R, "type-codes", "type code 0A"),
    "a mask that is not that of the blanks": Case(
        saying(b"FE", b"7E", to=rb"\$016"), R, "blanks", "blanks in the channels of 1", {"channel_mask": 0xFE}),
    "no faults": Case(saying(b"!01..", b"!0100", to=rb"\$01B"), R, "diagnostics", "bits 0", K, sources=OPEN),
    "a watchdog that is enabled in one way": Case(
        saying(b"!01..", b"!0180", to=b"~010"), R, "watchdog", "bit 7 is 1"),
    "only DCON": Case(saying(b"!01.", b"!010", to=rb"\$01P"), R, "protocol", "DCON only"),
    "a stored protocol that is not in use": Case(
        saying(b"!01..", b"!0111", to=rb"\$01P"), R, "protocol",
        "the module speaks DCON; Modbus RTU is stored, and begins at the next power-on", verdict=Verdict.WARN),
    "a stored baud rate that is not in use": Case(
        saying(b"0600\r", b"0700\r", to=rb"\$012"), R, "line",
        "$AA2 has another checksum or line setting than is in use: a change waits for the next power-on",
        verdict=Verdict.WARN),
    "samples of another time": Case(
        saying(rb"(?<=>01.).{7}", b"+09.999", to=rb"\$014"), R, "sampled", "channel 0 reads 9.999 V in one way"),
    "samples of another form": Case(
        saying(rb"(?<=>01.).{7}", b"+12.345", to=rb"\$014"), R, "sampled", ""),
}  # fmt: skip


def verdict(case: Case) -> tuple[Verdict, str]:
    eeprom = memory(case.model, **case.changes)
    bench = Bench(power_on(eeprom, now=0.0), case.firmware, sources=case.sources)
    id_ = f"consistency/{case.found}"
    result = checked([id_], eeprom, bench=bench)[id_]
    return result.verdict, result.text


@pytest.mark.parametrize("name", CASES)
def test_a_firmware_at_fault_is_found(name: str) -> None:
    case = CASES[name]
    found, text = verdict(case)

    assert found in (case.verdict, Verdict.FLAKY)
    assert case.text in text


def test_mixed_types_are_told_in_some_way() -> None:
    changes: Mapping[str, Any] = {"type_codes": (TypeCode.K, *(TypeCode.J,) * 7)}
    case = Case(saying(b"!01FF", b"!010F", to=rb"\$012"), R, "type-codes", "", changes)

    assert verdict(case) == (Verdict.INFO, "$AA2 has the type code 0F, where FF is expected")
    assert verdict(case._replace(firmware=step)) == (Verdict.PASS, "")


def test_a_watchdog_that_times_out_meanwhile_passes() -> None:
    case = Case(
        saying(b"!01..", b"!0104", to=b"~010"),
        R,
        "watchdog",
        "",
        {"host_watchdog_enabled": True, "host_watchdog_timeout": 255},
    )

    assert verdict(case)[0] is Verdict.PASS


def test_readings_that_go_in_and_out_of_range_decide_nothing() -> None:
    over = saying(rb">.{7}", b">+9999.9", to=b"#01\r")

    assert verdict(Case(by_turns(b"#01\r", step, over), R, "diagnostics", ""))[0] is Verdict.INCONCLUSIVE


def test_every_check_finds_some_firmware() -> None:
    assert {f"consistency/{case.found}" for case in CASES.values()} == {it.id for it in GROUP}
