"""``i7000 set``: settings by their names, one after the other."""

import os
import re
import signal
from typing import Any

import pytest
from attrs import evolve

from i7000 import BaudRate, Filter, LineSettings, Model, Protocol, ReportSettings, TypeCode
from i7000.cli.changing import code_of
from i7000.cli.setting_text import restored_lines
from i7000.host.procedures import Restored, Status, settings_of
from i7000.simulator.faults import Faults
from i7000.simulator.simulator import Simulated
from tests.each import each
from tests.simulator.running import module
from tests.terminal import Run
from tests.workbench import DEAD, EVERY_MODULE, Bench

KELVIN = module(Model.M_7019R, type_codes=(TypeCode.K,) * 8)


def rows(out: str) -> list[list[str]]:
    return [re.split("  +", line.strip(), maxsplit=2) for line in out.splitlines()]


# --- the list ---------------------------------------------------------------------------------------------------------


@each("simulated", EVERY_MODULE)
def test_every_setting_of_every_module_is_listed(simulated: Simulated, workbench: Bench) -> None:
    bench = workbench(simulated)

    told = bench("set", "--list", "--model", simulated.eeprom.model.value)
    state = bench.port.modules[0]

    assert rows(told.out)[0] == ["setting", "value", "allowed"]
    assert [row[0] for row in rows(told.out)[1:]] == [
        it.name for it in settings_of(state.profile, simulated.eeprom.protocol)
    ]
    assert (told.code, bench.eeprom) == (0, simulated.eeprom)


def test_the_list_has_values_units_what_is_allowed_and_what_could_lose_the_module(workbench: Bench) -> None:
    listed = {row[0]: row[1:] for row in rows(workbench(KELVIN)("set", "--list").out)}

    assert listed["host_watchdog_timeout"] == ["0 s", "0..25.5 s in steps of 0.1"]
    assert listed["module_cjc_offset"] == ["0 degC", "-40.96..40.96 degC in steps of 0.01"]
    assert listed["channel_mask"] == ["0-7", "channels of 0..7 such as 0-3,5, or all, or none"]
    assert listed["type_code.0"][0] == "K"
    assert listed["type_code.1"] == ["K"]
    assert listed["address"] == ["1", "0..255  (could lose the module)"]


def test_the_list_is_json(workbench: Bench) -> None:
    records = {it["name"]: it for it in workbench(KELVIN)("set", "--list", "--json").records}

    assert records["host_watchdog_timeout"] == {
        "record": "setting", "name": "host_watchdog_timeout", "value": 0.0, "unit": "s",
        "allowed": "0..25.5 s in steps of 0.1", "hazard": "plain", "next_power_on": False, "reason": None,
    }  # fmt: skip
    assert records["channel_mask"]["value"] == [*range(8)]
    assert (records["baud_rate"]["hazard"], records["baud_rate"]["next_power_on"]) == ("loses", True)


def test_what_could_not_be_read_is_listed_with_the_reason(workbench: Bench) -> None:
    bench = workbench(KELVIN)
    bench.port.before_write = lambda wire: silence(bench.port, wire.startswith(b"$016"))

    told = bench("set", "--list")

    listed = {row[0]: row[1:] for row in rows(told.out)}
    assert listed["channel_mask"][0] == "unknown: no answer, although the module answers other commands"
    assert told.code == 1


def silence(port: Any, silent: bool) -> None:  # noqa: FBT001
    port.faults = Faults(silent=1.0) if silent else Faults()


# --- changes ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("assignment", "changes", "words"),
    [
        ("type_code.3=J", {"type_codes": (*(TypeCode.K,) * 3, TypeCode.J, *(TypeCode.K,) * 4)}, "K -> J"),
        ("type_code=0E", {"type_codes": (TypeCode.J,) * 8}, "K -> J"),
        ("host_watchdog_timeout=2.5 s", {"host_watchdog_timeout": 25}, "0 s -> 2.5 s"),
        ("channel_mask=0-2,7", {"channel_mask": 0x87}, "0-7 -> 0-2,7"),
        ("cjc_enabled=off", {"cjc_enabled": False}, "yes -> no"),
        ("name=OVEN", {"name": "OVEN"}, "7019R -> OVEN"),
        ("module_cjc_offset = -1.25", {"cjc_offset": -125}, "0 degC -> -1.25 degC"),
        ("filter=reject_50_hz", {"report_settings": ReportSettings(filter=Filter.REJECT_50_HZ)},
         "reject_60_hz -> reject_50_hz"),
    ],
)  # fmt: skip
def test_one_setting_changes_and_nothing_else(
    assignment: str, changes: dict[str, Any], words: str, workbench: Bench
) -> None:
    bench = workbench(KELVIN)

    told = bench("set", assignment)

    assert bench.eeprom == evolve(KELVIN.eeprom, **changes)
    assert {line.partition(" ")[2].strip() for line in told.out.splitlines()} == {f"{words:<24} done"}
    assert told.code == 0


def test_several_settings_are_changed_in_their_order(workbench: Bench) -> None:
    bench = workbench(KELVIN)

    told = bench("set", "host_watchdog_timeout=1", "type_code.0=T", "host_watchdog_enabled=no", "--json")

    assert [(it["name"], it["status"]) for it in told.records] == [
        ("host_watchdog_timeout", "done"), ("type_code.0", "done"), ("host_watchdog_enabled", "already so"),
    ]  # fmt: skip
    assert told.records[0] == {
        "record": "setting", "name": "host_watchdog_timeout", "status": "done", "wanted": 1.0, "before": 0.0,
        "after": 1.0, "reason": "",
    }  # fmt: skip
    assert told.code == 0


@pytest.mark.parametrize(
    ("assignments", "message"),
    [
        (("typ_code=K",), "has no such setting as typ_code; did you mean type_code?"),
        (("x=1",), "has no such setting as x; i7000 set TARGET --list has the names"),
        (("response_delay=3",), "has no setting response_delay by DCON"),
        (("rtc_epoch=3",), "rtc_epoch is not a setting: it is the clock"),
        (("load_factory_calibration=1",), "is not a setting: calibration is never changed here"),
        (("type_code=Q",), "type_code.0 cannot be 'Q': MV_15, "),
        (("host_watchdog_timeout=300",), "host_watchdog_timeout cannot be '300': 0..25.5 s in steps of 0.1"),
        (("name=OVEN", "filter=no"), "filter cannot be 'no': reject_60_hz, reject_50_hz"),
        (("type_code=K", "type_code.2=J"), "type_code.2 is given twice"),
        (("filter",), "'filter' is not NAME=VALUE; i7000 set TARGET --list has the names"),
        ((), "give either NAME=VALUE, or --list"),
        (("--list", "name=OVEN"), "give either NAME=VALUE, or --list"),
    ],
)
def test_what_cannot_be_set_is_refused_before_anything_is_written(
    assignments: tuple[str, ...], message: str, workbench: Bench
) -> None:
    bench = workbench(KELVIN)

    told = bench("set", *assignments)

    assert message in told.err.splitlines()[-1]
    assert (told.code, told.out, bench.eeprom) == (2, "", KELVIN.eeprom)


def test_what_was_so_already_says_so(workbench: Bench) -> None:
    told = workbench(KELVIN)("set", "cjc_enabled=yes")

    assert told.out == f"{'cjc_enabled':<24} {'yes':<24} already so\n"
    assert told.code == 0


def test_what_reads_back_as_another_value_says_so() -> None:
    result = Restored("filter", Status.NOT_VERIFIED, "reject_50_hz", "reject_60_hz", "reject_60_hz", "acknowledged")

    (line,) = restored_lines(result, Model.M_7019R)

    assert "".join(text for text, _ in line).endswith("not verified: it reads back as reject_60_hz; acknowledged")
    assert code_of([result]) == 1


def test_a_module_that_stops_answering_is_not_listed(workbench: Bench) -> None:
    bench = workbench(module(Model.I_7018))
    seen: list[bytes] = []

    def look(wire: bytes) -> None:
        seen.append(wire)
        if seen.count(b"$01F\r") > 1:
            bench.port.faults = DEAD

    bench.port.before_write = look
    told = bench("set", "--list")

    assert (told.code, told.out) == (3, "")
    assert told.err.splitlines()[-1].endswith("stopped answering")


# --- what could lose the module ---------------------------------------------------------------------------------------


def test_a_value_is_checked_before_consent_is_needed(workbench: Bench) -> None:
    bench = workbench(KELVIN)

    told = bench("set", "address=300")

    assert told.err.splitlines()[1:] == ["i7000: address cannot be '300': 0..255"]
    assert (told.code, bench.eeprom) == (2, KELVIN.eeprom)


def test_what_could_lose_the_module_needs_consent(workbench: Bench) -> None:
    bench = workbench(KELVIN)

    told = bench("set", "address=5", "name=OVEN")

    assert told.err.splitlines()[1:] == [
        "i7000: address=5 could lose the module; there is no terminal to ask you at: give --yes"
    ]
    assert (told.code, bench.eeprom) == (2, KELVIN.eeprom)


@pytest.mark.usefixtures("answered")
@pytest.mark.parametrize(("answer", "address"), [(b"y\n", 5), (b"YES\n", 5), (b"n\n", 1), (b"\n", 1), (b"", 1)])
def test_what_could_lose_the_module_asks(answer: bytes, address: int, workbench: Bench) -> None:
    bench = workbench(KELVIN)

    told = bench("set", "address=5", stdin=answer)

    assert "address=5 could lose the module. Change it on M-7019R at address 01? [y/N] " in told.err
    assert (told.code, bench.eeprom.address) == (0 if address == 5 else 1, address)
    assert ("nothing was changed" in told.err) is (address == 1)


def test_a_module_that_moved_is_followed(workbench: Bench) -> None:
    bench = workbench(KELVIN)

    told = bench("set", "address=5", "name=OVEN", "baud_rate=19200", "host_watchdog_timeout=1", "checksum=yes", "--yes")

    assert told.err.splitlines()[1:] == [
        "i7000: the module now has address 05",
        "i7000: the module now has 19200 N81",
        "i7000: the module now has a checksum",
    ]
    assert (told.code, bench.eeprom.address, bench.eeprom.name) == (0, 5, "OVEN")
    assert bench.eeprom.line_settings == LineSettings(BaudRate.BAUD_19200)
    assert bench.eeprom.report_settings.checksum


def test_a_baud_rate_that_needs_init_is_explained(workbench: Bench) -> None:
    told = workbench(module(Model.I_7018))("set", "baud_rate=19200", "--yes")

    assert told.out == (
        f"{'baud_rate':<24} {'9600 -> 19200':<24} needs INIT:"
        " power it on with its INIT switch on, and ask again with --address 0\n"
    )
    assert told.code == 1


@pytest.mark.usefixtures("answered")
def test_ctrl_c_at_a_question_changes_nothing(workbench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    bench = workbench(KELVIN)

    def interrupted(*_: object) -> str:
        os.kill(os.getpid(), signal.SIGINT)
        return "yes"

    monkeypatch.setattr("i7000.cli.confirm._answer", interrupted)
    told = bench("set", "address=5")

    assert told.err.endswith(" [y/N] \n")
    assert (told.code, bench.eeprom) == (130, KELVIN.eeprom)


def test_the_protocol_has_its_name_of_the_terminal(workbench: Bench) -> None:
    bench = workbench(module(Model.M_7019R, init_switch=True))

    told = bench("set", "protocol=rtu", "--yes", "--address", "0")

    assert "dcon -> rtu" in told.out
    assert (told.code, bench.eeprom.protocol) == (0, Protocol.MODBUS_RTU)


def test_a_baud_rate_is_set_in_init_mode_and_used_after_the_next_power_on(workbench: Bench) -> None:
    bench = workbench(module(Model.I_7018, init_switch=True))

    told = bench("set", "baud_rate=19200", "--yes", "--address", "0")

    assert told.out.endswith("pending: in use from the next power-on\n")
    assert (told.code, bench.eeprom.line_settings) == (0, LineSettings(BaudRate.BAUD_19200))


def test_an_address_that_another_module_has_is_not_taken(workbench: Bench) -> None:
    bench = workbench(KELVIN, module(Model.I_7018, address=5))

    told = bench("set", "address=5", "--yes")

    assert told.out.endswith("skipped: another module answers at address 05\n")
    assert (told.code, bench.eeprom) == (1, KELVIN.eeprom)


# --- lines that break -------------------------------------------------------------------------------------------------


def test_a_module_that_loses_power_before_it_is_written_is_in_doubt(workbench: Bench) -> None:
    bench = workbench(KELVIN)
    bench.lose_power(lambda wire: wire.startswith(b"~01O"), before=True)

    told = bench("set", "name=OVEN", "host_watchdog_timeout=1", "--retries", "0")

    assert told.out == (
        f"{'name':<24} {'7019R -> OVEN':<24} in doubt: no answer to the command; it may have either value\n"
    )
    assert (told.code, bench.eeprom) == (6, KELVIN.eeprom)


def test_a_module_that_loses_power_between_two_settings_was_left_changed(workbench: Bench) -> None:
    bench = workbench(KELVIN)
    bench.lose_power(lambda wire: wire.startswith(b"~012"), before=True)

    told = bench("set", "name=OVEN", "host_watchdog_timeout=1", "--retries", "0")

    assert told.out.splitlines()[0].endswith(" done")
    assert "unread: the module does not answer" in told.out
    assert (told.code, bench.eeprom) == (6, evolve(KELVIN.eeprom, name="OVEN"))


def test_a_module_that_loses_power_before_anything_is_written_does_not_answer(workbench: Bench) -> None:
    bench = workbench(KELVIN)
    bench.lose_power(lambda wire: wire.startswith(b"~012"), before=True)

    told = bench("set", "host_watchdog_timeout=1", "name=OVEN", "--retries", "0")

    assert (told.code, bench.eeprom, len(told.out.splitlines())) == (3, KELVIN.eeprom, 1)


def test_a_change_on_a_line_with_faults_is_verified(workbench: Bench) -> None:
    bench = workbench(module(Model.M_7019R, protocol=Protocol.MODBUS_RTU))
    bench.port.faults = Faults(silent=0.1, late=0.1, duplicate=0.1, noise=0.05)

    told = bench("set", "host_watchdog_timeout=2.5", "type_code=J", "--retries", "8")

    assert (told.code, bench.eeprom.host_watchdog_timeout, set(bench.eeprom.type_codes)) == (0, 25, {TypeCode.J})


def test_the_help_has_an_example(run: Run) -> None:
    assert "i7000 set /dev/ttyUSB0 --list" in run("set", "--help").out
