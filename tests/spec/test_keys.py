"""The identifiers of rows: one for each row of every table, as the members of enumerations and constants in C need."""

from __future__ import annotations

import re
from collections import Counter
from typing import TYPE_CHECKING

import pytest

from i7000 import BaudRate, CharacterFormat, CjcUpdate, DataFormat, Filter, Model, Protocol, TypeCode
from tests.spec import lint
from tests.spec.cells import Cell, row_id, wrong

if TYPE_CHECKING:
    from enum import Enum
    from pathlib import Path

    from tests.spec.lint import Record

KEYS = {"dcon_commands": "name", "module_settings": "name"}
"""The column with the identifier, where it is not ``key``."""
TABLES = lint.table_files()
IDENTIFIER = re.compile("[A-Z][A-Za-z0-9_]{0,47}")
ENUMS: dict[str, type[Enum]] = {
    "baud_rate": BaudRate,
    "character_format": CharacterFormat,
    "data_format": DataFormat,
    "filter": Filter,
    "protocol": Protocol,
    "cjc_update": CjcUpdate,
}
"""The settings whose codes are an enumeration of the package."""
LIMITS = {"NNNN": "CJC_OFFSET", "nn": "SOFT_INIT_TIMEOUT", "VV": "HOST_WATCHDOG_TIMEOUT", "(Name)": "MODULE_NAME"}
FUNCTIONS = {"46": "ModuleSettings", "+80": "ExceptionResponse"}
"""The functions without one request, and so without a name."""


def repeated(names: list[str]) -> list[str]:
    """The names that stand twice, in upper or lower case."""
    return [name for name, count in Counter(map(str.casefold, names)).items() if count > 1]


@pytest.mark.parametrize("path", TABLES, ids=lint.name)
def test_every_row_has_an_identifier_of_its_own(path: Path) -> None:
    keys = [row[KEYS.get(path.stem, "key")] for row in lint.load(path)["rows"]]

    assert [key for key in keys if not IDENTIFIER.fullmatch(key)] == []
    assert repeated(keys) == []


@pytest.mark.parametrize("side", ["fields", "response_fields"])
@pytest.mark.parametrize("table", ["dcon_commands", "module_settings"])
def test_a_field_has_a_name_of_its_own_in_its_message(table: str, side: str) -> None:
    assert [row["name"] for row in lint.rows(table) if repeated([field["name"] for field in row[side]])] == []


IDS = {
    "vectors": [vector["id"] for _, vector in lint.vectors()],
    "stories": [story["id"] for story in lint.stories()],
    "checks": [row["id"] for path in lint.check_files() for row in lint.records(lint.load(path))],
}


@pytest.mark.parametrize("kind", IDS)
def test_ids_of_one_kind_stay_unique_as_identifiers(kind: str) -> None:
    assert len(IDS[kind]) > 200
    assert repeated([re.sub("[^A-Za-z0-9]", "_", it) for it in IDS[kind]]) == []


def group_of(types: list[str]) -> str:
    """The types that a special text is for: thermocouples, 4-20 mA, or all other voltages and currents."""
    codes = [TypeCode(int(it, 16)) for it in types]
    if codes == [TypeCode.MA_4_20]:
        return "MA_4_20"
    return "THERMOCOUPLE" if all(code.thermocouple for code in codes) else "VOLTAGE_CURRENT"


def key_of_setting(row: Record) -> str:
    setting, value = row["setting"], row["value"]
    if setting in ENUMS:
        return ENUMS[setting](row["code"]).name
    match setting:
        case "sentinel":
            group = None if row["types"] is None else "LEGACY" if row["until"] else group_of(row["types"])
            words = [row["name"], row["format"], *filter(None, [group])]
        case "limit":
            words = [setting, LIMITS[row["where"]]]
        case "reserved":
            words = [setting, "report_settings"]
        case "default" | "init_mode":
            words = [setting, row["name"].replace("time-out", "timeout")]
        case _:
            words = [setting, {True: "enabled", False: "disabled"}[value] if isinstance(value, bool) else value]
    return "_".join(words).upper().replace(" ", "_")


def key_of(table: str, row: Record) -> str:
    """The identifier by the rule of its table, which is the name of the member where the package has one."""
    match table:
        case "type_codes":
            return TypeCode(int(row["code"], 16)).name
        case "full_scale":
            return f"{TypeCode(int(row['code'], 16)).name}_{DataFormat[row['format'].upper()].name}"
        case "settings":
            return key_of_setting(row)
        case "models":
            return Model(row["name"]).name
        case "modbus_functions":
            return row["name"] or FUNCTIONS[row["function"]]
        case _:
            return f"{row['area']}_{row['name']}".upper()


@pytest.mark.parametrize("path", [path for path in TABLES if path.stem not in KEYS], ids=lint.name)
def test_a_key_follows_the_rule_of_its_table(path: Path) -> None:
    cells = [
        Cell(lint.name(path), row_id(row), "key", row["key"], key_of(path.stem, row)) for row in lint.load(path)["rows"]
    ]

    assert wrong(cells) == []
