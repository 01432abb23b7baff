"""The checks of Modbus RTU: every model passes them, and each of them finds a firmware at fault."""

import json
from typing import Any

import pytest
from attrs import evolve

from i7000 import Model, Protocol, modbus, spec
from i7000.conformance.checks.map_writes import WRITTEN
from i7000.conformance.hazard import DEFAULT_ALLOWED, Hazard
from i7000.conformance.verdict import SkipReason, Verdict
from i7000.device import Eeprom
from i7000.settings import ModbusDataFormat
from tests.conformance.bench import STATEMENTS, checked, memory, undone
from tests.each import each

GROUPS = ("rtu", "map", "consistency")
WRITES = DEFAULT_ALLOWED | {Hazard.WRITE}
MOST_WRITES = 64
MODELS = [model for model in Model if Protocol.MODBUS_RTU in model.protocols]
TABLES = spec.files().joinpath("tables")
MAPS = [
    json.loads(file.read_text("utf-8"))
    for file in sorted(TABLES.joinpath("modbus_registers").iterdir(), key=lambda it: it.name)
]
ROWS = {(row["area"], row["name"]): row for table in MAPS for row in table["rows"]}


def rtu(model: Model, firmware: str | None = None, **changes: Any) -> Eeprom:
    """Return the memory of a module that speaks Modbus RTU, with changes."""
    return memory(model, firmware, protocol=Protocol.MODBUS_RTU, **changes)


# --- what there is a check of -----------------------------------------------------------------------------------------


def test_every_row_of_the_nine_maps_has_a_check_of_its_name() -> None:
    named = {it.register for it in STATEMENTS.values() if it.id == f"map/{it.register}"}

    assert len(MAPS) == 9
    assert named == {f"{area}/{name}" for area, name in ROWS}


def test_every_row_that_can_be_written_is_written_by_one_check_and_no_other_row_is() -> None:
    written = [(area.name.lower(), name) for rows in WRITTEN.values() for area, name in rows]
    again = {("coil", "filter"), ("coil", "host_watchdog_mode")}

    assert set(written) == {key for key, row in ROWS.items() if "W" in row["access"]}
    assert {key for key in written if written.count(key) > 1} == again
    assert set(WRITTEN) <= set(STATEMENTS)


def test_every_row_that_cannot_be_written_has_a_check_that_it_is_not() -> None:
    refused = {it.register for it in STATEMENTS.values() if it.id == f"map/read-only/{it.register}"}
    writable = ("coil", "holding_register")

    assert refused == {
        f"{area}/{name}" for (area, name), row in ROWS.items() if row["access"] == "R" and area in writable
    }


def test_the_row_of_a_check_is_in_the_maps() -> None:
    rows = {f"{area}/{name}" for area, name in ROWS}

    assert {it.register for it in STATEMENTS.values() if it.register is not None} <= rows


def test_every_function_and_sub_function_has_a_check() -> None:
    tables = ("modbus_functions", "module_settings")
    rows = [row for name in tables for row in json.loads(TABLES.joinpath(f"{name}.json").read_text("utf-8"))["rows"]]
    functions = {row["name"] for row in rows if row["name"]}

    assert functions == {kind.__name__ for kind in modbus.REQUESTS}
    assert functions == {it.function for it in STATEMENTS.values() if it.function is not None}


def test_every_section_of_modbus_has_a_check() -> None:
    sections = {section for it in STATEMENTS.values() for section in it.sections}
    settings = {
        row["section"] for row in json.loads(TABLES.joinpath("module_settings.json").read_text("utf-8"))["rows"]
    }

    assert {"3", "3.1", "3.2", "3.3", "3.4", *settings, *(table["section"] for table in MAPS)} <= sections


# --- modules at which there is no fault -------------------------------------------------------------------------------


@each("model", MODELS)
def test_every_model_passes_what_only_reads(model: Model) -> None:
    left = undone(checked(GROUPS, rtu(model), allowed=DEFAULT_ALLOWED))

    assert {verdict for verdict, _ in left.values()} == {Verdict.SKIP}
    assert all(text.startswith("not allowed: ") for _, text in left.values())


@each("model", MODELS)
def test_every_model_passes_what_writes(model: Model) -> None:
    results = checked(GROUPS, rtu(model), allowed=WRITES)
    left = undone(results)

    assert {verdict for verdict, _ in left.values()} == {Verdict.SKIP}
    assert all(text.startswith("not allowed: ") for _, text in left.values())
    assert sum(it.writes for it in results.values()) <= MOST_WRITES


@pytest.mark.no_cover
@each("model", MODELS)
def test_every_model_passes_everything(model: Model) -> None:
    assert not undone(checked(GROUPS, rtu(model)))


FIRMWARE = {
    Model.M_7017: ("A1.0", "B2.9"),
    Model.M_7017R: ("B2.9", "B3.8"),
    Model.M_7018: ("B3.4",),
    Model.M_7018R: ("B3.4", "B4.4"),
    Model.M_7018Z: ("B4.3",),
    Model.M_7017mC_16: ("A1.0",),
    Model.M_7019R: ("B2.6", "B2.9", "B3.6"),
    Model.M_7019Z: ("B3.6",),
}


@pytest.mark.parametrize(
    ("model", "firmware"), [(model, it) for model, all_ in FIRMWARE.items() for it in all_], ids=str
)
def test_every_firmware_passes(model: Model, firmware: str) -> None:
    assert not undone(checked(GROUPS, rtu(model, firmware)))


CHANGES: dict[str, dict[str, Any]] = {
    "engineering": {"modbus_data_format": ModbusDataFormat.ENGINEERING},
    "blanks": {"channel_mask": 0x5A},
    "no channel": {"channel_mask": 0},
    "offsets": {"channel_offsets": (-5, 7, -128, 127, 0, 1, -1, 9), "cjc_offset": -4096},
    "timed out": {"host_watchdog_timed_out": True, "host_watchdog_timeouts": 3},
    "enabled watchdog": {"host_watchdog_enabled": True, "host_watchdog_timeout": 255},
    "address": {"address": 247},
    "delay": {"response_delay": 30},
}


@pytest.mark.no_cover
@each("model", [Model.M_7017, Model.M_7018, Model.M_7019R])
@each("name", CHANGES)
def test_a_module_with_other_settings_passes(model: Model, name: str) -> None:
    left = undone(checked(GROUPS, rtu(model, **CHANGES[name])))
    lost = {"map/write/host_watchdog_timed_out", "map/write/host_watchdog_timeout_count"}

    assert set(left) == (lost if name == "timed out" else set())


def test_the_m_7017z_passes_single_ended() -> None:
    assert not undone(checked(GROUPS, rtu(Model.M_7017Z, single_ended=True)))


def test_a_data_logger_that_runs_is_not_disturbed() -> None:
    made = rtu(Model.M_7017mC_16)
    log = evolve(made.log, command=type(made.log.command)(1), period=(1, 0, 0))
    left = undone(checked(GROUPS, evolve(made, log=log)))

    assert {verdict for verdict, _ in left.values()} == {Verdict.INCONCLUSIVE}
    assert set(left) == {"map/write/log", "map/write/clock", "map/write/rtc_epoch"}


def test_nothing_is_written_that_could_not_be_restored() -> None:
    results = checked(["map/write/filter"], rtu(Model.M_7017), allowed=WRITES)

    assert results["map/write/filter"].verdict is Verdict.PASS
    assert results["map/write/filter"].writes == 2


def test_what_the_module_does_not_have_is_not_checked() -> None:
    results = checked(GROUPS, rtu(Model.M_7017))

    assert results["rtu/46/2B/reply"].reason is SkipReason.NOT_APPLICABLE
    assert results["map/coil/cjc_enabled"].reason is SkipReason.NOT_APPLICABLE
