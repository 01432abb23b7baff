"""The checks of Modbus RTU find faults: each fails at a firmware that is wrong, and named faults have named checks."""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

import pytest

from i7000 import Model, Protocol, modbus
from i7000.conformance.checks.map_writes import WRITTEN
from i7000.conformance.verdict import Verdict
from i7000.device import Signals, State, power_on, step
from i7000.type_codes import TypeCode
from tests.conformance.bench import STATEMENTS, Bench, Step, answering, checked, hearing, memory
from tests.each import each

R = Model.M_7019R
SENTINEL = bytes.fromhex("01 46 00")
WRITES = (0x05, 0x06, 0x0F, 0x10)
SETS = (0x04, 0x06, 0x08, 0x26, 0x2A, 0x2C, 0x2E, 0x30)
CHECKS = [
    it
    for it in STATEMENTS.values()
    if it.group in ("rtu", "map") or (it.group == "consistency" and it.protocol is Protocol.MODBUS_RTU)
]


def found(ids: list[str], firmware: Step, model: Model = R, **changes: Any) -> dict[str, Verdict]:
    results = checked(ids, memory(model, protocol=Protocol.MODBUS_RTU, **changes), firmware)
    return {name: results[name].verdict for name in results if results[name].reason is None}


# --- firmwares that are wrong everywhere ------------------------------------------------------------------------------


def refusing_all(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
    """Answer exception 04 to everything but the read of the name."""
    if frame == modbus.seal(SENTINEL):
        return step(state, frame, signals, now)
    return state, modbus.seal(bytes((1, frame[1] | 0x80, 0x04)))


def acknowledging_all(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
    """Acknowledge every write, and carry out none."""
    if frame[1] in WRITES:
        return state, modbus.seal(bytes((1, *frame[1:6])))
    if frame[1] == 0x46 and frame[2] in SETS:
        zeros = {0x04: 4, 0x06: 8}.get(frame[2], 1)
        return state, modbus.seal(bytes((1, *frame[1:3])) + bytes(zeros))
    return step(state, frame, signals, now)


ODD = (Model.M_7017, Model.M_7017Z, Model.M_7017mC_16, Model.M_7018, Model.M_7018_16, R)
"""Models that have every row and function together."""
SELECT = ["rtu", "map", *(it.id for it in CHECKS if it.group == "consistency")]


def everywhere(firmware: Step) -> list[dict[str, Verdict]]:
    """Return the verdicts of all checks on the models that have every row and function together."""
    single_ended = found(SELECT, firmware, Model.M_7017Z, single_ended=True)
    return [*(found(SELECT, firmware, model) for model in ODD), single_ended]


def test_no_check_passes_at_a_firmware_that_refuses_everything() -> None:
    verdicts = everywhere(refusing_all)
    passed = {name for each_ in verdicts for name, it in each_.items() if it is Verdict.PASS}

    assert passed == {"link/alive", "rtu/46/00/reply"}
    assert {it.id for it in CHECKS} <= {name for each_ in verdicts for name in each_}


def test_no_check_of_what_is_written_passes_at_a_firmware_that_only_acknowledges() -> None:
    verdicts = everywhere(acknowledging_all)
    passed = {name for each_ in verdicts for name, it in each_.items() if it is Verdict.PASS}
    writing = {it.id for it in CHECKS if {"write", "comm"} & {hazard.value for hazard in it.hazards}}

    assert passed & writing == {
        "map/write/host_watchdog_timeout_count",
        "map/write/host_watchdog_timed_out",
        "rtu/46/unknown",
    }
    assert set(WRITTEN) <= {name for each_ in verdicts for name in each_}


# --- one fault, one check ---------------------------------------------------------------------------------------------


class Fault(NamedTuple):
    """A fault, and the check that finds it."""

    firmware: Step
    check: str
    model: Model = R
    verdict: Verdict = Verdict.FAIL
    changes: Mapping[str, Any] = MappingProxyType({})


def begins(frame: bytes, text: str) -> bool:
    return frame[: len(bytes.fromhex(text))] == bytes.fromhex(text)


def answered(to: str, change: Callable[[bytes], bytes]) -> Step:
    """Return a firmware whose answers to some frames are changed, with the right CRC."""
    return answering(lambda frame, wire: modbus.seal(change(wire[:-2])) if wire and begins(frame, to) else wire)


def heard(to: str, change: Callable[[bytes], bytes]) -> Step:
    """Return a firmware that takes some frames for others."""
    return hearing(lambda frame: modbus.seal(change(frame[:-2])) if begins(frame, to) else frame)


def next_item(body: bytes) -> bytes:
    return body if body[5] != 1 else body[:3] + bytes((body[3] + 1,)) + body[4:]


def without_bit_7(body: bytes) -> bytes:
    return bytes((body[0], body[1] & 0x7F)) + body[2:]


def silent(to: str) -> Step:
    return answering(lambda frame, wire: None if begins(frame, to) else wire)


def swapped(body: bytes) -> bytes:
    return body[:3] + b"".join(body[at + 1 : at + 2] + body[at : at + 1] for at in range(3, len(body), 2))


def changing_too(begun: str, **changes: Any) -> Step:
    """Return a firmware that changes something else too when it carries out a request that some bytes begin."""

    def altered(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
        after, wire = step(state, frame, signals, now)
        return (after.store(**changes) if begins(frame, begun) and after is not state else after), wire

    return altered


def losing_the_next(bad: Callable[[bytes], bool]) -> Step:
    """Return a firmware that does not hear the frame after one that it does not take."""
    lost = [False]

    def altered(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
        missed, lost[0] = lost[0], bad(frame)
        return (state, None) if missed else step(state, frame, signals, now)

    return altered


def wrong_crc(frame: bytes) -> bool:
    return len(frame) > 4 and modbus.seal(frame[:-2]) != frame and len(frame) < 256


OFFSETS = {"channel_offsets": (1, 2, 3, 4, 5, 6, 7, 8)}
FAULTS = {
    "the CRC is not compared": Fault(hearing(lambda frame: modbus.seal(frame[:-2])), "rtu/crc/wrong"),
    "address 255 is heard": Fault(heard("ff", lambda body: b"\1" + body[1:]), "rtu/address/reserved"),
    "a read at address 0 is answered": Fault(heard("00", lambda body: b"\1" + body[1:]), "rtu/address/broadcast-read"),
    "a write at address 0 is answered": Fault(
        heard("0005", lambda body: b"\1" + body[1:]), "rtu/address/broadcast-write"
    ),
    "unknown functions are ignored": Fault(silent("0130"), "rtu/function/unknown"),
    "unknown functions have code 02": Fault(answered("0119", lambda body: body[:2] + b"\2"), "rtu/function/unknown"),
    "an exception has no bit 7": Fault(
        answered("0104", lambda it: without_bit_7(it) if it[1] & 0x80 else it), "map/gaps/input_register"
    ),
    "bit 7 of a function is ignored": Fault(heard("0184", without_bit_7), "rtu/function/bit-7"),
    "the functions of others have code 02": Fault(
        answered("0102", lambda it: it[:2] + b"\2"), "rtu/function/absent", Model.M_7018
    ),
    "a sub-function of others is silent": Fault(silent("01462d"), "rtu/46/absent", Model.M_7017),
    "an unknown sub-function has code 01": Fault(answered("014631", lambda it: it[:2] + b"\1"), "rtu/46/unknown"),
    "a byte of bits too many": Fault(
        answered("0102", lambda it: it[:2] + bytes((it[2] + 1,)) + it[3:] + b"\0"), "rtu/02/counts"
    ),
    "a count of 0 is answered": Fault(
        answering(lambda frame, wire: modbus.seal(b"\1\4\0") if frame[1] == 4 and frame[4:6] == b"\0\0" else wire),
        "rtu/04/counts-n1",
    ),
    "the end of a read wraps around": Fault(
        answering(lambda frame, wire: modbus.seal(b"\1\4\4\0\0\0\0") if begins(frame, "0104ffff0002") else wire),
        "rtu/04/around",
    ),
    "the end of a write wraps around": Fault(
        answering(lambda frame, wire: modbus.seal(frame[:6]) if begins(frame, "0110ffff0002") else wire),
        "rtu/10/around",
    ),
    "padding bits are set": Fault(
        answered("0101", lambda it: it if it[1] & 0x80 or len(it) > 4 else it[:3] + bytes((it[3] | 0x80,))),
        "rtu/01/padding",
        verdict=Verdict.WARN,
    ),
    "padding bits of inputs are set": Fault(
        answered("0102", lambda it: it if it[1] & 0x80 or len(it) > 4 else it[:3] + bytes((it[3] | 0x80,))),
        "rtu/02/padding",
        verdict=Verdict.WARN,
    ),
    "a short answer of coils": Fault(answered("0101", lambda it: it[:-1]), "rtu/01/padding"),
    "no answer to a read of coils": Fault(silent("0101"), "rtu/01/padding"),
    "a wrong CRC stays in the buffer": Fault(losing_the_next(wrong_crc), "frame/recovers/rtu"),
    "a long request stays in the buffer": Fault(losing_the_next(lambda it: len(it) > 256), "frame/recovers/rtu"),
    "a start behind the map is answered": Fault(answered("0103ffff", lambda _: b"\1\3\2\0\0"), "rtu/03/counts-n2"),
    "bytes behind a request are ignored": Fault(heard("0104", lambda body: body[:6]), "rtu/04/length"),
    "bytes behind a setting are ignored": Fault(heard("014625", lambda body: body[:3]), "rtu/46/25/reply-n1"),
    "a reserved byte is ignored": Fault(heard("014605", lambda body: body[:3] + b"\0"), "rtu/46/05/reserved"),
    "a channel is taken modulo 8": Fault(
        heard("014607", lambda it: it[:4] + bytes((it[4] & 7,)) + it[5:]), "rtu/46/07/channels-n1"
    ),
    "46h answers a byte too few": Fault(answered("014605", lambda body: body[:-1]), "rtu/46/05/reply"),
    "the mask is that of 16 channels": Fault(
        answered("014625", lambda body: body[:3] + b"\0" + body[3:]), "rtu/46/25/reply"
    ),
    "the type of the next channel": Fault(
        heard("014607", lambda it: it[:4] + bytes((it[4] + 1 & 7,)) + it[5:]),
        "rtu/46/07/channels",
        changes={"type_codes": (TypeCode.K, TypeCode.J) * 4},
    ),
    "the offset of the next channel": Fault(
        heard("01462b80", lambda it: it[:3] + b"\x81"), "rtu/46/2B/channels", changes=OFFSETS
    ),
    "one register is that behind it": Fault(heard("010300", next_item), "map/holding_register/analog_input"),
    "one offset is that behind it": Fault(
        heard("010301", next_item), "map/holding_register/temperature_offset", changes=OFFSETS
    ),
    "the reset status stays": Fault(answered("01010110", lambda body: body[:3] + b"\1"), "map/coil/reset_status"),
    "a setting of another value": Fault(
        answered("010301e5", lambda body: body[:4] + b"\7"), "map/holding_register/line_settings"
    ),
    "a part of a record": Fault(
        answering(
            lambda frame, wire: modbus.seal(b"\1\4\x22" + bytes(34)) if frame[:6] == b"\1\4\3\xe8\0\x11" else wire
        ),
        "map/input_register/log_records",
        Model.M_7017mC_16,
    ),
    "a read ends at the row": Fault(
        answering(
            lambda frame, wire: modbus.seal(b"\1\x83\3") if frame[:4] == b"\1\3\1\xe0" and frame[5] > 2 else wire
        ),
        "map/across/holding_register",
    ),
    "a read goes beyond the end": Fault(
        answering(lambda frame, wire: modbus.seal(b"\1\4\4\0\0\0\0") if frame[:6] == b"\1\4\0\x07\0\2" else wire),
        "map/across/input_register-n1",
    ),
    "low bytes first": Fault(
        answered("0104", lambda it: swapped(it) if not it[1] & 0x80 else it), "consistency/readings-by-03-and-04"
    ),
    "another CJC by 03": Fault(answered("01030080", lambda it: it[:3] + b"\0\1"), "consistency/cjc-by-03-and-04"),
    "another status by 01": Fault(answered("01010080", lambda it: it[:3] + b"\xff"), "consistency/status-by-01-and-02"),
    "a status at a reading in range": Fault(
        answered("01020080", lambda it: it[:3] + b"\xff"), "consistency/status-and-readings"
    ),
    "firmware in the other order": Fault(
        answered("010301e0", lambda it: it[:3] + it[5:] + it[3:5]),
        "consistency/firmware-registers",
        verdict=Verdict.INFO,
    ),
    "name in the other order": Fault(
        answered("010301e2", lambda it: it[:3] + it[5:] + it[3:5]),
        "consistency/name-registers-order",
        verdict=Verdict.INFO,
    ),
    "another name": Fault(answered("010301e2", lambda it: it[:3] + b"\x70\x18\0\0"), "consistency/name-registers"),
    "half of a number": Fault(silent("010301e20001"), "map/halves/holding_register", verdict=Verdict.INFO),
    "a mask beyond the channels is taken": Fault(
        answered("014626", lambda _: b"\1\x46\x26\0"), "rtu/46/26/no-such-channel", Model.M_7019Z, Verdict.INFO
    ),
    "a coil of 0001 is taken": Fault(heard("0105010d0001", lambda it: it[:4] + b"\xff\0"), "rtu/05/values"),
    "a type that is not there is taken": Fault(answered("014608", lambda _: b"\1\x46\x08\0"), "rtu/46/08/set-n1"),
    "a neighbour changes too": Fault(
        heard("010601", lambda it: b"\1\x10" + it[2:4] + b"\0\2\4" + it[4:6] * 2 if it[3] < 7 and it[2] == 1 else it),
        "map/write/type_code",
    ),
    "a type resets the offset": Fault(
        changing_too("010601", cjc_offset=0), "map/write/type_code", changes={"cjc_offset": 12}
    ),
    "a mask resets the offset": Fault(
        changing_too("014626", cjc_offset=0), "rtu/46/26/set", changes={"cjc_offset": 12}
    ),
    "a coil resets the offset": Fault(
        changing_too("0105", cjc_offset=0), "map/write/cjc_enabled", changes={"cjc_offset": 12}
    ),
}


@each("name", FAULTS)
def test_a_fault_has_a_check_that_finds_it(name: str) -> None:
    fault = FAULTS[name]

    assert found([fault.check], fault.firmware, fault.model, **fault.changes)[fault.check] is fault.verdict


def test_a_setting_that_was_taken_is_restored() -> None:
    made = memory(Model.M_7017, protocol=Protocol.MODBUS_RTU)
    taking = heard("010601e901", lambda it: it[:4] + b"\0\x55")
    bench = Bench(power_on(made, now=0.0), taking, line=made.line_settings)
    results = checked(["map/write/channels"], made, bench=bench)

    assert results["map/write/channels-n1"].verdict is Verdict.FAIL
    assert bench.state.eeprom == made


@pytest.mark.parametrize("later", [False, True])
def test_an_address_may_hold_from_the_next_power_on_only(*, later: bool) -> None:
    def kept(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
        after, wire = step(state, frame, signals, now)
        return (after.keep(address=state.ram.address) if later else after), wire

    results = checked(["rtu/46/04/set"], memory(R, protocol=Protocol.MODBUS_RTU), kept)

    assert results["rtu/46/04/set"].verdict is (Verdict.INFO if later else Verdict.PASS)
