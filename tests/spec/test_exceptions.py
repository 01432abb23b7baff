"""The columns of the Modbus functions that say how a module refuses, and what all of them have in common."""

from __future__ import annotations

from itertools import chain

import pytest

from tests.spec import lint
from tests.spec.cells import Cell, row_id, wrong

FUNCTIONS = {row["function"]: row for row in lint.rows("modbus_functions")}
SETTINGS = {row["sub_function"]: row for row in lint.rows("module_settings")}
OF_A_FIELD = {
    "new_address": "new address out of its limits",
    "line_settings": "baud rate or protocol out of its limits",
    "type_code": "type code that the module does not have",
    "mask": "a bit of a channel that the module does not have",
    "settings": "a reserved bit that is not zero",
    "offset": "offset out of its limits",
    "enabled": "setting that means nothing",
    "update": "setting that means nothing",
}
"""What can be wrong with a field of function 46h."""
OF_A_CHANNEL = {0x13: "channel that the module does not have", 0x8F: "channel byte that means nothing"}
"""The same of a channel, by the largest: plain numbers, or bytes from 80 on."""


@pytest.mark.parametrize("sub_function", SETTINGS)
def test_a_sub_function_is_refused_for_what_its_request_can_have_wrong(sub_function: str) -> None:
    row = SETTINGS[sub_function]
    values = {OF_A_FIELD[field["name"]] for field in row["fields"] if field["name"] in OF_A_FIELD}
    values |= {OF_A_CHANNEL[field["maximum"]] for field in row["fields"] if field["name"] == "channel"}
    if "00" in row["request"].split()[2:]:
        values.add("a reserved byte that is not zero")
    found = {exception["code"]: set(exception["when"]) for exception in row["exceptions"]}
    expected = {2: {"the module does not have the sub-function"}, 3: values | {"wrong number of bytes"}}

    assert wrong([Cell("tables/module_settings.json", row_id(row), "exceptions", found, expected)]) == []


def test_a_reason_always_has_the_same_code() -> None:
    codes: dict[str, set[int]] = {}
    for row in chain(FUNCTIONS.values(), SETTINGS.values()):
        for exception in row["exceptions"]:
            for reason in exception["when"]:
                codes.setdefault(reason, set()).add(exception["code"])

    assert {reason: found for reason, found in codes.items() if len(found) > 1} == {}


@pytest.mark.parametrize("function", FUNCTIONS)
def test_a_function_is_refused_with_the_codes_of_modbus(function: str) -> None:
    expected = {"46": [2, 3], "+80": []}.get(function, [1, 2, 3])
    found = [exception["code"] for exception in FUNCTIONS[function]["exceptions"]]

    assert wrong([Cell("tables/modbus_functions.json", function, "exceptions", found, expected)]) == []


def test_the_functions_that_the_maps_ask_for_rest_on_the_errata_that_say_so() -> None:
    cells = [
        Cell(
            "tables/modbus_functions.json", row_id(row), "errata: E55, E94", {"E55", "E94"} <= set(row["errata"]), True
        )
        for row in FUNCTIONS.values()
        if row["section"] == "3.4"
    ]

    assert len(cells) == 6
    assert wrong(cells) == []


def test_every_model_with_modbus_answers_with_exceptions() -> None:
    expected = [row["name"] for row in lint.rows("models") if "modbus" in row["protocols"]]
    found = FUNCTIONS["+80"]["models"]

    assert wrong([Cell("tables/modbus_functions.json", "+80", "models", found, dict.fromkeys(expected))]) == []
