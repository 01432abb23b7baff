"""The names and errata of the tables of types follow from the range and from what is special about a type."""

from __future__ import annotations

import pytest

from i7000 import DataFormat, EncodeError, Reading, Status, TypeCode
from i7000.readings import encode_field, encode_word
from tests.spec import lint
from tests.spec.cells import Cell, row_id, wrong

TYPES = {row["code"]: row for row in lint.rows("type_codes")}
FULL_SCALE = {(row["code"], row["format"]): row for row in lint.rows("full_scale")}


def has_a_word(code: TypeCode) -> bool:
    try:
        encode_word(Reading(None, code.unit, Status.UNDER_RANGE), code)
    except EncodeError:
        return False
    return True


def is_off(code: TypeCode) -> bool:
    """Whether the formula of A.5 gives another word than the one printed for an end."""
    row = FULL_SCALE[f"{code:02X}", "hex"]
    ends = {code.maximum: row["plus_fs"], code.minimum: row["minus_fs"]}
    return any(encode_field(Reading(end, code.unit), code, DataFormat.HEX) != text for end, text in ends.items())


def errata_of(code: TypeCode, form: str) -> list[str]:
    """The errata of the ends of a type in one format."""
    relative = {"E54": code.full_scale != code.maximum}
    if form == "hex":
        relative |= {
            "E45": not code.signed_hex,
            "E46": bool(code.thermocouple),
            "E47": not code.thermocouple and has_a_word(code),
            "E51": is_off(code),
        }
    return sorted(erratum for erratum, holds in relative.items() if holds and form != "engineering")


@pytest.mark.parametrize("code", TypeCode, ids=lambda code: f"{code:02X}")
def test_the_ends_of_a_type_name_the_errata_that_they_show(code: TypeCode) -> None:
    cells = []
    for form in ("engineering", "percent", "hex"):
        row = FULL_SCALE[f"{code:02X}", form]
        cells.append(Cell("tables/full_scale.json", row_id(row), "errata", row["errata"], errata_of(code, form)))

    assert wrong(cells) == []


@pytest.mark.parametrize("code", TypeCode, ids=lambda code: f"{code:02X}")
def test_a_type_names_the_errata_of_its_ends_and_of_its_registers(code: TypeCode) -> None:
    row = TYPES[f"{code:02X}"]
    expected = {"E53", *errata_of(code, "percent"), *errata_of(code, "hex")}
    expected |= {"E50"} if not code.thermocouple else set()
    expected |= {"E52"} if code.thermocouple and code.modbus_decimals == 2 else set()
    expected |= {"E87"} if "DIN" in code.thermocouple else set()

    assert wrong([Cell("tables/type_codes.json", row_id(row), "errata", row["errata"], sorted(expected))]) == []


def test_types_are_printed_in_the_same_sections() -> None:
    cells = [
        Cell("tables/type_codes.json", row_id(row), "sections", row["sections"], ["1.11", "3.5", "A.5"])
        for row in TYPES.values()
    ]

    assert wrong(cells) == []


def name_of(code: TypeCode) -> str:
    """A range as the manual prints it, or the letter of a thermocouple."""
    if code.thermocouple:
        return f"Type {code.thermocouple} thermocouple"
    if code.minimum == -code.maximum:
        return f"+/-{code.maximum:g} {code.unit}"
    return f"{code.minimum:+g} to +{code.maximum:g} {code.unit}".replace("+0 ", "0 ")


def test_a_type_is_named_after_its_range() -> None:
    cells = [
        Cell("tables/type_codes.json", code, "name", row["name"], name_of(TypeCode(int(code, 16))))
        for code, row in TYPES.items()
    ]

    assert wrong(cells) == []
