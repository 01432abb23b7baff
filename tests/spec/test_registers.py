"""What the vectors of registers promise: that they fit the maps, and leave out no row that can be read."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.spec import lint
from tests.spec.test_modbus import MAPS, has

if TYPE_CHECKING:
    from tests.spec.lint import Record

VECTORS = [vector for _, vector in lint.vectors("registers")]
TYPES = {row["code"]: row for row in lint.rows("type_codes")}
WIDTHS = {"uint32": (2, 1), "record": (18, 17)}
"""Items and values of one, where they are not one and one."""


def row_of(vector: Record) -> Record:
    """The row that a vector is about: the first of its name in the map of the model."""
    profile = vector["profile"]
    (chart,) = (chart for chart in MAPS.values() if profile["model"] in chart["models"])
    found: Record = next(
        row
        for row in chart["rows"]
        if row["name"] == vector["name"]
        and has(dict.fromkeys(row["models"] or chart["models"], row["firmware"]), profile)
    )
    return found


def test_every_row_that_can_be_read_has_a_vector_of_its_type() -> None:
    rows = {(row["name"], row["type"]) for chart in MAPS.values() for row in chart["rows"] if "R" in row["access"]}

    assert rows == {(vector["name"], row_of(vector)["type"]) for vector in VECTORS}


def test_a_vector_has_as_many_values_as_its_items_are() -> None:
    for vector in VECTORS:
        items, values = WIDTHS.get(row_of(vector)["type"], (1, 1))
        if vector["fault"] is None:
            assert len(vector["items"]) * values == len(vector["values"]) * items, vector["id"]
            assert vector["statuses"] is None or len(vector["statuses"]) == len(vector["values"]), vector["id"]
        else:
            assert (vector["values"], vector["statuses"]) == (None, None), vector["id"]


def test_a_reading_has_a_value_where_its_status_is_ok() -> None:
    for vector in VECTORS:
        for value, status in zip(vector["values"] or (), vector["statuses"] or (), strict=False):
            assert (value is None) == (status != "ok"), vector["id"]


def test_truth_values_are_those_of_bits() -> None:
    for vector in VECTORS:
        bits = row_of(vector)["type"] == "bool"
        assert all(isinstance(value, bool) == bits for value in vector["values"] or ()), vector["id"]


def test_every_type_of_a_module_with_modbus_is_read_in_both_formats() -> None:
    wanted = {code for row in lint.rows("models") if "modbus" in row["protocols"] for code in row["types"]}
    found = {
        (f"{code:02X}", vector["profile"]["modbus_data_format"])
        for vector in VECTORS
        if vector["name"] == "analog_input"
        for code in vector["profile"]["type_codes"][vector["first"] : vector["first"] + len(vector["items"])]
    }

    assert {(code, form) for code in wanted for form in ("engineering", "hex")} <= found


def test_the_unit_of_a_reading_is_that_of_its_type_and_of_another_row_its_own() -> None:
    for vector in VECTORS:
        row = row_of(vector)
        code = f"{vector['profile']['type_codes'][vector['first']]:02X}"
        assert vector["unit"] == (TYPES[code]["unit"] if row["type"] == "reading" else row["unit"]), vector["id"]
