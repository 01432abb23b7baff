"""The two transcriptions of chapter 3, ``spec/`` and ``src/``, say the same: both ways, row by row."""

from itertools import product
from typing import Any

import pytest
from attrs import fields

from i7000 import Firmware, Model, Profile, Protocol, modbus
from i7000.modbus.items import MOST_BITS, MOST_WORDS, MOST_WRITTEN_BITS, MOST_WRITTEN_WORDS
from i7000.modbus.registers import rows as rows_of
from tests.spec.lint import Record, load, rows, table_files
from tests.vectors import MODBUS_MESSAGES, modbus_message_of

FUNCTIONS: dict[str, Record] = {row["function"]: row for row in rows("modbus_functions")}
SUB_FUNCTIONS: dict[str, Record] = {row["sub_function"]: row for row in rows("module_settings")}
ROWS = {row["name"]: row for row in (*FUNCTIONS.values(), *SUB_FUNCTIONS.values()) if row["name"]}
MAPS = {path.stem: load(path) for path in table_files("modbus_registers")}
M_MODELS = [model for model in Model if Protocol.MODBUS_RTU in model.protocols]
PROFILES = [*map(Profile, M_MODELS), Profile(Model.M_7017Z, single_ended=True)]
each_request = pytest.mark.parametrize("request_class", modbus.REQUESTS, ids=lambda kind: kind.__name__)


def as_text(gates: Any) -> Record:
    return {model.value: firmware and str(firmware) for model, firmware in gates.items()}


# --- functions --------------------------------------------------------------------------------------------------------


def test_the_requests_are_those_of_the_tables() -> None:
    assert list(ROWS) == [request.__name__ for request in modbus.REQUESTS]
    assert [int(function, 16) for function in FUNCTIONS if function != "+80"] == sorted(
        {request.function for request in modbus.REQUESTS}
    )


@each_request
def test_a_request_is_what_its_row_says(request_class: Any) -> None:
    row, response = ROWS[request_class.__name__], request_class.response

    assert (row["section"], row["request"]) == (request_class.section, request_class.pdu)
    assert (row["section"], row["response"]) == (response.section, response.pdu)
    assert row["response_name"] == response.__name__
    assert row.get("broadcast", False) == request_class.broadcast
    assert (row.get("function", "46"), row.get("sub_function")) == (
        f"{request_class.function:02X}",
        None if request_class.sub_function is None else f"{request_class.sub_function:02X}",
    )


@each_request
def test_a_request_is_for_the_models_of_its_row(request_class: Any) -> None:
    assert ROWS[request_class.__name__]["models"] == as_text(request_class.availability.gates)


def test_an_exception_is_what_its_row_says() -> None:
    row = FUNCTIONS["+80"]

    assert row["response_name"] == modbus.ExceptionResponse.__name__
    assert row["response"] == modbus.ExceptionResponse.pdu.replace("function ", "function+80 ")
    assert row["section"] == modbus.ExceptionResponse.section


@pytest.mark.parametrize(
    ("function", "most"),
    [
        ("01", MOST_BITS),
        ("02", MOST_BITS),
        ("03", MOST_WORDS),
        ("04", MOST_WORDS),
        ("05", None),
        ("06", None),
        ("0F", MOST_WRITTEN_BITS),
        ("10", MOST_WRITTEN_WORDS),
        ("46", None),
        ("+80", None),
    ],
)
def test_a_frame_has_as_many_items_as_the_row_of_its_function_allows(function: str, most: int | None) -> None:
    row = FUNCTIONS[function]

    assert (row["minimum_count"], row["maximum_count"]) == (None if most is None else 1, most)


def offsets(message: Any) -> dict[str, tuple[int, int]]:
    """Where the fields of a message stand in a frame, and how many bytes they have; 0 for what varies."""
    found, at = {}, 0
    for token in message.layout.tokens:
        found[token.name] = (at, token.width)
        at += token.width
    return {name: place for name, place in found.items() if name not in ("", "address")}


SIDES = [
    (request.response if side == "response_fields" else request, request.__name__, side)
    for request, side in product(modbus.REQUESTS, ("fields", "response_fields"))
    if request.sub_function is not None
]


@pytest.mark.parametrize(("message", "name", "side"), SIDES, ids=lambda value: getattr(value, "__name__", value))
def test_the_fields_of_a_sub_function_stand_where_its_row_says(message: Any, name: str, side: str) -> None:
    told = {it["name"]: (it["offset"], it["bytes"]) for it in ROWS[name][side]}
    widths = sorted({profile.mask_digits // 2 for profile in PROFILES})

    assert told == {field: (at, width or widths) for field, (at, width) in offsets(message).items()}


ORDINARY: Record = {"address": 1, "line_settings": 6, "protocol": 0, "channel": 0, "type_code": 8, "offset": 0}


def is_taken(name: str, values: Record, profile: Profile) -> bool:
    kinds = [it.name for it in fields(MODBUS_MESSAGES[name])]
    try:
        modbus.encode(modbus_message_of({"type": name, "fields": {it: values[it] for it in kinds}}), profile)
    except ValueError:
        return False
    return True


@pytest.mark.parametrize(
    ("name", "it"),
    [
        pytest.param(row["name"], it, id=f"{row['name']}-{it['name']}")
        for row in SUB_FUNCTIONS.values()
        for it in row["fields"]
    ],
)
def test_a_field_has_the_limits_of_its_row(name: str, it: Record) -> None:
    values = [it["minimum"] - 1, it["minimum"], it["maximum"], it["maximum"] + 1]
    if it["name"] == "enabled":
        values[1:3] = [False, True]

    taken = [any(is_taken(name, ORDINARY | {it["name"]: value}, profile) for profile in PROFILES) for value in values]

    assert taken == [False, True, True, False]


# --- maps -------------------------------------------------------------------------------------------------------------


def facts_of_row(row: Record) -> tuple[Any, ...]:
    keys = (
        "name",
        "area",
        "first",
        "last",
        "address",
        "count",
        "access",
        "type",
        "unit",
        "scale",
        "minimum",
        "maximum",
    )
    return tuple(row[key] for key in keys)


def facts_of_register(row: modbus.Register) -> tuple[Any, ...]:
    return (
        row.name, row.area.name.lower(), row.number, row.last_number, row.address, row.count, row.access.value,
        row.kind.value, row.unit, row.scale, row.minimum, row.maximum,
    )  # fmt: skip


def is_reached(models: Record, model: Model, firmware: Firmware | None) -> bool:
    """Whether the model has what is in a column `models` of the functions."""
    return model.value in models and is_from(models[model.value], firmware)


def is_from(limit: str | None, firmware: Firmware | None) -> bool:
    return limit is None or firmware is None or firmware >= Firmware(limit)


OLDER = {"input_register": "04", "discrete_input": "02"}
"""What can be read by firmware older than the maps, and by which function."""
MODEL_MAPS = [(stem, Model.find(name)) for stem, data in MAPS.items() for name in data["models"]]


def test_every_model_with_modbus_has_one_map() -> None:
    assert sorted(model.value for _, model in MODEL_MAPS) == sorted(model.value for model in M_MODELS)


VERSIONS = [None, *(Firmware(f"B{major}.{minor}") for major in range(1, 6) for minor in range(10))]
"""Every firmware at which something may change."""


@pytest.mark.parametrize(("stem", "model"), MODEL_MAPS, ids=lambda value: getattr(value, "value", ""))
def test_a_module_has_the_rows_of_its_map_for_every_firmware(stem: str, model: Model) -> None:
    data = MAPS[stem]

    for firmware in VERSIONS:
        told = sorted(
            facts_of_row(row)
            for row in data["rows"]
            if (row["models"] is None or model.value in row["models"])
            and is_from(row["firmware"], firmware)
            and (
                is_from(data["firmware"], firmware)
                or (row["area"] in OLDER and is_reached(FUNCTIONS[OLDER[row["area"]]]["models"], model, firmware))
            )
        )
        assert told == sorted(
            facts_of_register(row) for row in rows_of(Profile(model, firmware=firmware, type_codes=()))
        )


@pytest.mark.parametrize(("stem", "model"), MODEL_MAPS, ids=lambda value: getattr(value, "value", ""))
def test_a_row_of_few_values_names_those_of_its_map(stem: str, model: Model) -> None:
    registers = modbus.RegisterMap(Profile(model, type_codes=()))
    printed = {row["name"]: row["values"] for row in MAPS[stem]["rows"] if row["values"]}

    for row in registers:
        if row.labels:
            assert dict(enumerate(row.labels)) == {int(number): text for number, text in printed[row.name].items()}
        elif row.name in printed:
            assert row.maximum is not None
            codes = row.values or range(row.minimum or 0, row.maximum + 1)
            assert [str(int(getattr(code, "value", code))) for code in codes] == list(printed[row.name])


@pytest.mark.parametrize("model", Model, ids=lambda model: model.value)
def test_a_module_without_modbus_has_no_rows(model: Model) -> None:
    assert bool(rows_of(Profile(model))) == (Protocol.MODBUS_RTU in model.protocols)


@pytest.mark.parametrize(("stem", "model"), MODEL_MAPS, ids=lambda value: getattr(value, "value", ""))
def test_a_host_writes_as_many_registers_as_the_map_allows(stem: str, model: Model) -> None:
    most = MAPS[stem]["maximum_write_count"] or FUNCTIONS["10"]["maximum_count"]

    assert is_taken("WriteMultipleRegisters", {"address": 1, "start": 0, "values": [0] * most}, Profile(model))
    assert not is_taken(
        "WriteMultipleRegisters", {"address": 1, "start": 0, "values": [0] * (most + 1)}, Profile(model)
    )
