"""What ``errata.json`` promises: who names an erratum is named by it, and the other way round."""

from __future__ import annotations

import re
from itertools import chain
from typing import TYPE_CHECKING

import pytest

from tests.spec import lint
from tests.spec.cells import Cell, row_id, wrong
from tests.spec.index import place

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from tests.spec.lint import Record

ERRATA = {row["id"]: row for row in lint.rows("errata")}
COMMANDS = {row["name"]: row for row in lint.rows("dcon_commands")}
MAPS = {lint.name(path): lint.load(path) for path in lint.table_files("modbus_registers")}
ALL_MAPS = "3.4"
SUPPORTED_IN_PART = {
    "E16": "the response to a valid command",
    "E26": "that the command is of the 7019 series",
    "E34": "the models that 2.5 and 2.6 list",
    "E63": "the reserved byte of 2D",
}
"""Assumptions of which the manual states a part, so that a vector which rests on that part is derived."""


def number(erratum: str) -> int:
    return int(erratum[1:])


def errata_of(record: Record) -> list[str]:
    one = record.get("erratum")
    return [*record.get("errata", []), *([] if one is None else [one])]


def test_errata_are_named_once_and_stand_in_order() -> None:
    numbers = [number(erratum["id"]) for erratum in lint.rows("errata")]

    assert numbers == sorted(set(numbers))


def test_the_sections_of_an_erratum_are_named_once_and_stand_in_order() -> None:
    cells = [
        Cell("errata.json", erratum, "sections", row["sections"], sorted(set(row["sections"]), key=place))
        for erratum, row in ERRATA.items()
    ]

    assert wrong(cells) == []


@pytest.mark.parametrize("path", lint.data_files(), ids=lint.name)
def test_every_erratum_that_is_cited_exists_and_is_cited_once_in_order(path: Path) -> None:
    cells = []
    for record in lint.records(lint.load(path)):
        cited = errata_of(record)
        listed = record.get("errata", [])
        cells.append(Cell(lint.name(path), row_id(record), "errata", sorted(set(cited) - set(ERRATA)), []))
        cells.append(Cell(lint.name(path), row_id(record), "errata", listed, sorted(set(listed), key=number)))

    assert wrong(cells) == []


@pytest.mark.parametrize("erratum", ERRATA)
def test_whoever_uses_an_erratum_exists(erratum: str) -> None:
    users = [user for user in ERRATA[erratum]["used_by"] if user != "device"]

    assert [user for user in users if user not in COMMANDS and not (lint.SPEC / user).exists()] == []


@pytest.mark.parametrize("erratum", ERRATA)
def test_an_erratum_names_the_commands_and_tables_that_name_it(erratum: str) -> None:
    commands = {row["name"] for row in COMMANDS.values() if erratum in row["errata"]}
    tables = {
        lint.name(path)
        for path in lint.table_files()
        if path.stem != "dcon_commands" and any(erratum in row["errata"] for row in lint.records(lint.load(path)))
    }
    users = {user for user in ERRATA[erratum]["used_by"] if user in COMMANDS or user.startswith("tables/")}

    assert wrong([Cell("errata.json", erratum, "used_by", sorted(users), sorted(commands | tables))]) == []


@pytest.mark.parametrize(
    "path",
    [path for folder in ("frames", "readings", "registers") for path in lint.vector_files(folder)],
    ids=lint.name,
)
def test_a_file_of_vectors_that_are_no_exchanges_and_the_errata_that_they_cite_name_each_other(path: Path) -> None:
    cited = {vector["erratum"] for vector in lint.records(lint.load(path))} - {None}
    naming = {erratum for erratum, row in ERRATA.items() if lint.name(path) in row["used_by"]}

    assert wrong([Cell("errata.json", lint.name(path), "used_by", sorted(naming), sorted(cited))]) == []


@pytest.mark.parametrize("table", ["dcon_commands", "module_settings"])
def test_a_row_and_the_errata_of_its_section_name_each_other(table: str) -> None:
    cells = []
    for row in lint.rows(table):
        about = [erratum for erratum in ERRATA if row["section"] in ERRATA[erratum]["sections"]]
        cells.append(Cell(f"tables/{table}.json", row_id(row), "errata", row["errata"], about))

    assert wrong(cells) == []


@pytest.mark.parametrize("section", ["3.1", "3.2"])
def test_a_function_with_a_section_and_the_errata_of_that_section_name_each_other(section: str) -> None:
    [row] = [row for row in lint.rows("modbus_functions") if row["section"] == section]
    about = [erratum for erratum in ERRATA if section in ERRATA[erratum]["sections"]]

    assert wrong([Cell("tables/modbus_functions.json", row_id(row), "errata", row["errata"], about)]) == []


@pytest.mark.parametrize("name", MAPS)
def test_a_map_and_the_errata_of_its_section_name_each_other(name: str) -> None:
    data = MAPS[name]
    cited = set(chain.from_iterable(row["errata"] for row in data["rows"]))
    own = {erratum for erratum in ERRATA if data["section"] in ERRATA[erratum]["sections"]}
    shared = {erratum for erratum in cited if ALL_MAPS in ERRATA[erratum]["sections"]}

    assert wrong([Cell(name, "of the map", "errata", sorted(cited), sorted(own | shared))]) == []


NOT_OF_THE_MODEL = {("3.4.7", "module_type_code", "E81")}
"""The M-7018-16 uses TT, and its channels cannot differ in type."""


def map_rows() -> Iterator[tuple[str, str, Record]]:
    return ((name, data["section"], row) for name, data in MAPS.items() for row in data["rows"])


def test_a_row_names_in_every_map_the_errata_that_are_about_all_maps() -> None:
    shared: dict[str, set[str]] = {}
    for _, _, row in map_rows():
        about = {erratum for erratum in row["errata"] if ALL_MAPS in ERRATA[erratum]["sections"]}
        shared.setdefault(row["name"], set()).update(about)
    cells = []
    for file, section, row in map_rows():
        there = {erratum for erratum in row["errata"] if ALL_MAPS in ERRATA[erratum]["sections"]}
        left_out = {it for it in shared[row["name"]] if (section, row["name"], it) in NOT_OF_THE_MODEL}
        cells.append(Cell(file, row_id(row), "errata", sorted(there), sorted(shared[row["name"]] - left_out)))

    assert wrong(cells) == []


def test_what_has_two_numbers_names_the_same_errata_at_both() -> None:
    """But for what function 04 alone is about."""
    cells = []
    for file, section, row in map_rows():
        for _, other_section, other in map_rows():
            if other_section == section and other["name"] == row["name"]:
                there, expected = set(row["errata"]) - {"E59"}, set(other["errata"]) - {"E59"}
                cells.append(Cell(file, row_id(row), "errata", sorted(there), sorted(expected)))

    assert wrong(cells) == []


def test_a_row_with_a_firmware_of_its_own_names_how_it_is_written() -> None:
    """E67 is about the two ways of writing a version."""
    cells = [
        Cell(file, row_id(row), "errata: E67", "E67" in row["errata"], row["firmware"] is not None)
        for file, _, row in map_rows()
    ]

    assert wrong(cells) == []


def rows_with_sections() -> Iterator[tuple[str, Record, set[str]]]:
    for table in ("settings", "modbus_functions", "type_codes"):
        for row in lint.rows(table):
            yield f"tables/{table}.json", row, set(row.get("sections", [row.get("section")]))


def test_an_erratum_of_a_row_is_about_a_section_of_the_row() -> None:
    cells = [
        Cell(file, row_id(row), f"errata, sections of {erratum}", ERRATA[erratum]["sections"], sorted(sections))
        for file, row, sections in rows_with_sections()
        for erratum in row["errata"]
        if not sections & set(ERRATA[erratum]["sections"])
    ]

    assert wrong(cells) == []


@pytest.mark.parametrize("path", lint.vector_files(), ids=lint.name)
def test_a_vector_is_assumed_where_and_only_where_its_erratum_is_an_assumption(path: Path) -> None:
    cells = []
    for vector in lint.records(lint.load(path)):
        erratum = ERRATA.get(vector["erratum"], {"assumption": False})
        if vector["source"] == "manual" or (vector["source"] == "derived" and vector["erratum"] in SUPPORTED_IN_PART):
            continue
        expected = "assumed" if erratum["assumption"] else "derived"
        cells.append(Cell(lint.name(path), vector["id"], "source", vector["source"], expected))

    assert wrong(cells) == []


# Behaviour

BEHAVIOUR = (lint.SPEC / "behaviour.md").read_text(encoding="utf-8")
NOT_SHOWN = {
    "E35": "the profile of a story names the types",
    "E37": "which types a model has is held against the package",
    "E82": "undefined",
    "E83": "the profile of a story names the Modbus data format",
    "E97": "undefined",
    "E100": "undefined",
    "E103": "a pause of the host, not an answer",
    "E104": "which channels there are is held against the package",
    "E112": "a story has one module",
    "E118": "undefined",
}
"""Assumptions that no vector and no story can show, and why."""


def test_the_page_on_behaviour_cites_the_errata_that_a_model_relies_on_and_no_other() -> None:
    cited = set(re.findall(r"\bE\d{2,3}\b", BEHAVIOUR))
    relied = {erratum for erratum, row in ERRATA.items() if "device" in row["used_by"]}

    assert wrong([Cell("behaviour.md", "the page", "errata", sorted(cited), sorted(relied))]) == []


def shown_in_stories() -> set[str]:
    return {step["erratum"] for story in lint.stories() for step in story["steps"] if "send" in step}


def test_a_step_of_a_story_rests_on_each_assumption_about_behaviour() -> None:
    assumed = {erratum for erratum, row in ERRATA.items() if "device" in row["used_by"] and row["assumption"]}

    assert assumed - shown_in_stories() <= set(NOT_SHOWN)


def test_an_assumption_is_shown_by_an_assumed_vector_or_a_story() -> None:
    assumed = {erratum for erratum, row in ERRATA.items() if row["assumption"]}
    shown = shown_in_stories() | {vector["erratum"] for _, vector in lint.vectors() if vector["source"] == "assumed"}

    assert sorted(assumed - shown, key=number) == sorted(NOT_SHOWN, key=number)
