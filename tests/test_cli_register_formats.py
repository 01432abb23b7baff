"""``i7000 registers --format``: the map of a model for other programs, parsed as they do."""

import csv
import tomllib
from typing import Any

import pytest

from i7000 import Model, modbus
from i7000.dissect import Known
from tests.terminal import Run

MODELS = [model for model in Model if model.value.startswith("M")]
AREAS = {
    "discrete": modbus.Area.DISCRETE_INPUT,
    "input": modbus.Area.INPUT_REGISTER,
    "coil": modbus.Area.COIL,
    "holding": modbus.Area.HOLDING_REGISTER,
}
WIDTHS = {"UINT32": 2}


def rows_of(model: Model) -> list[modbus.Register]:
    return list(modbus.RegisterMap(Known(model).default))  # type: ignore[arg-type] # of a model that is known


def telegraf(run: Run, model: str) -> dict[str, dict[str, Any]]:
    """The fields of each area, by name."""
    (plugin,) = tomllib.loads(run("registers", "--model", model, "--format", "telegraf").out)["inputs"]["modbus"]
    return {request["register"]: {field["name"]: field for field in request["fields"]} for request in plugin["request"]}


@pytest.mark.parametrize("model", MODELS)
def test_csv_has_the_records_of_json(run: Run, model: Model) -> None:
    printed = csv.DictReader(run("registers", "--model", model.value, "--format", "csv").out.splitlines())
    records = run("registers", "--model", model.value, "--json").records

    assert [*printed] == [
        {key: "" if value is None else str(value) for key, value in record.items()} for record in records
    ]


@pytest.mark.parametrize("model", MODELS)
def test_telegraf_reads_each_value_of_the_map_once_where_it_is(run: Run, model: Model) -> None:
    requests = telegraf(run, model.value)
    found = {
        (AREAS[register], field["address"]): WIDTHS.get(field.get("type", ""), 1)
        for register, fields in requests.items()
        for field in fields.values()
    }
    names = [name for fields in requests.values() for name in fields]

    assert len(names) == len(set(names)) == len(found)
    readable = [
        it for it in rows_of(model) if it.access is not modbus.Access.WRITE and it.kind is not modbus.Kind.RECORD
    ]
    for row in readable:
        places = [(row.area, row.address + at) for at in range(0, row.count, row.kind.width)]
        twins = [it for it in readable if it.name == row.name]
        assert any(
            all((it.area, it.address + at) in found for at in range(0, it.count, it.kind.width)) for it in twins
        ), row
        assert {found[place] for place in places if place in found} <= {row.kind.width}


def test_telegraf_has_types_and_units_of_registers(run: Run) -> None:
    holding = telegraf(run, "M-7018R")["holding"]

    assert holding["host_watchdog_timeout"] == {
        "address": 488, "name": "host_watchdog_timeout", "type": "UINT16", "scale": 0.1
    }  # fmt: skip
    assert holding["cjc_offset_7"] == {"address": 359, "name": "cjc_offset_7", "type": "INT8L", "scale": 0.1}
    assert holding["module_cjc_offset"]["type"] == "INT16"
    assert holding["firmware_version"] == {"address": 480, "name": "firmware_version", "type": "UINT32"}
    assert "scale" not in holding["response_delay"]


def test_readings_are_words_unless_types_and_format_are_given(run: Run) -> None:
    word = {"address": 1, "name": "analog_input_1", "type": "INT16"}

    assert telegraf(run, "M-7019R")["input"]["analog_input_1"] == word
    assert telegraf(run, "M-7019R,type=K")["input"]["analog_input_1"] == word
    assert telegraf(run, "M-7019R,modbus_format=engineering")["input"]["analog_input_1"] == word
    assert telegraf(run, "M-7019R,type=K,modbus_format=hex")["input"]["analog_input_1"] == word


@pytest.mark.parametrize(("code", "scale"), [("K", 0.1), ("V_10", 0.001), ("M", 0.01), ("V_2_5", 0.0001)])
def test_readings_are_in_the_unit_of_a_known_type(run: Run, code: str, scale: float) -> None:
    fields = telegraf(run, f"M-7019R,type={code},modbus_format=engineering")["input"]

    assert [fields[f"analog_input_{channel}"]["scale"] for channel in range(8)] == [scale] * 8


def test_telegraf_starts_with_a_port_to_be_changed(run: Run) -> None:
    (plugin,) = tomllib.loads(run("registers", "--model", "M-7017", "--format", "telegraf").out)["inputs"]["modbus"]

    assert plugin["name"] == "M-7017"
    assert (plugin["configuration_type"], plugin["transmission_mode"]) == ("request", "RTU")
    assert {(request["slave_id"], request["byte_order"]) for request in plugin["request"]} == {(1, "CDAB")}


@pytest.mark.parametrize(
    ("options", "said"),
    [(["--json", "--model", "M-7017"], "without --json"), (["40489", "--model", "M-7017"], "without a register")],
)
def test_a_format_is_for_the_list_alone(run: Run, options: list[str], said: str) -> None:
    told = run("registers", "--format", "csv", *options)

    assert told.code == 2
    assert said in told.err
