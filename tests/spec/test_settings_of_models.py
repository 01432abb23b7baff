"""The columns of ``settings.json`` that say for which models, firmware and types a row is, held against the code."""

from __future__ import annotations

from itertools import chain
from typing import TYPE_CHECKING

import pytest

from i7000 import DataFormat, EncodeError, Firmware, Model, Profile, Protocol, Reading, Status, TypeCode
from i7000.device import factory, power_on
from i7000.models import CONFIGURABLE
from i7000.readings import decode_engineering_word, decode_field, decode_word, encode_word
from tests.spec import lint
from tests.spec.cells import Cell, row_id, wrong

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.spec.lint import Record

FILE = "tables/settings.json"
ROWS = lint.rows("settings")
SENTINELS = [row for row in ROWS if row["setting"] == "sentinel"]
TEXTS = ("engineering", "percent", "hex")
THERMOCOUPLES = [f"{code:02X}" for code in TypeCode if code.thermocouple]


def cell(row: Record, column: str, expected: object) -> Cell:
    return Cell(FILE, row_id(row), column, row[column], expected)


# For whom it is


def limit_of(limits: Record, model: Model) -> str | None:
    """The firmware of the longest name that the model has."""
    names = [name for name in limits if stands_for(name, model)]
    return limits[max(names, key=len)] if names else None


def stands_for(name: str, model: Model) -> bool:
    name = name.removesuffix(" series")
    return model.value == name or model.value[2:] == name or model.series == name or model.value[:6] == name


def text(firmware: Firmware | None) -> str | None:
    return None if firmware is None else str(firmware)


def firmware_of(row: Record, model: Model) -> str | None:
    """The firmware from which on the row holds for a model, by the code; None where it is any or never."""
    if row["setting"] == "character_format" and row["code"]:
        return str(model.character_formats_from)
    if row["setting"] == "filter" and row["code"]:
        return text(model.filter_from)
    if row["setting"] == "type_code" and model.type_by_configuration:
        return text(CONFIGURABLE.get(model))
    if (
        row["setting"] == "sentinel"
        and row["until"] is None
        and (row["types"] or [""])[0] == "0E"
        and row["format"] in TEXTS
    ):
        return "B1.5" if is_old(model, "B1.4") and not is_old(model, "B1.5") else None
    return None


def is_old(model: Model, firmware: str) -> bool:
    return Profile(model, firmware=Firmware(firmware), type_codes=()).legacy_sentinels


def test_a_row_holds_from_the_firmware_that_the_package_knows() -> None:
    cells = [
        Cell(
            FILE,
            row_id(row),
            f"firmware, {model.value}",
            limit_of(row["firmware"] or {}, model),
            firmware_of(row, model),
        )
        for row in ROWS
        for model in Model
    ]

    assert wrong(cells) == []


def test_a_row_holds_until_the_firmware_that_the_package_knows() -> None:
    cells = []
    for row in ROWS:
        five = row["setting"] == "sentinel" and len(str(row["value"])) == 5 and row["format"] in TEXTS
        for model in Model:
            expected = "B1.4" if five and is_old(model, "B1.4") and not is_old(model, "B1.5") else None
            cells.append(
                Cell(FILE, row_id(row), f"until, {model.value}", limit_of(row["until"] or {}, model), expected)
            )

    assert wrong(cells) == []


def models_where(condition: Callable[[Model], object]) -> str:
    return ", ".join(model.value for model in Model if condition(model))


def series_where(condition: Callable[[Model], object]) -> list[str]:
    """The series of which every model, and no other, meets a condition."""
    found = sorted({model.series for model in Model if condition(model)})
    assert all(condition(model) for model in Model if model.series in found)
    return found


def applies_of(row: Record) -> str | None:
    """For whom a row is, in the words of the table with the models that the code knows."""
    match row["setting"], row["code"]:
        case "mode", 1:
            return "models with fast_mode in models.json; on the others the bit is reserved and zero"
        case "type_code", _:
            gated = models_where(lambda model: model.type_by_configuration and CONFIGURABLE.get(model))
            always = models_where(lambda model: model.type_by_configuration and CONFIGURABLE.get(model, 0) is None)
            return f"{gated} from the firmware named, and {always}"
        case "cjc_update", int(code) if power_on(factory(Model.I_7019R), now=0.0).ram.cjc_update == code:
            return "the default"
        case "default", _:
            return default_applies(row["name"])
        case "sentinel", _:
            return sentinel_applies(row)
    return None


def default_applies(name: str) -> str | None:
    if name == "filter":
        late = models_where(lambda model: model.filter_from).replace(", ", " and ")
        return f"not used by {late} up to B2.6"
    if name == "protocol":
        assert {model.value[0] for model in Model if Protocol.MODBUS_RTU not in model.protocols} == {"I"}
        return "M-7000 models; I-7000 models speak DCON only"
    if name == "mode":
        fast = models_where(lambda model: model.fast_mode_default).replace(", ", " and ")
        return f"{fast}; normal mode on every other model"
    return "at every power-on" if name == "soft INIT time-out" else None


def sentinel_applies(row: Record) -> str:  # noqa: PLR0911 - a line a kind of row
    first, second = series_where(lambda model: model.thermocouples)
    types = row["types"]
    if row["name"] == "disabled":
        return f"{second} series, in the responses of #AA, #AAN and $AA4"
    if row["format"] == "modbus_engineering":
        if row["name"] == "over_range":
            return "M-7000 models; the manual does not say for which types"
        return "M-7000 models; stated for type 07 in 1.11, for no type by name in 3.5"
    if types == THERMOCOUPLES and row["format"] == "modbus_hex":
        return f"M-{first} and M-{second} series with Modbus RTU"
    if types == THERMOCOUPLES and row["until"]:
        return f"I-{first} series only, up to the firmware named"
    if types == THERMOCOUPLES:
        return f"{first} series and {second} series; I-{first} series only from the firmware named"
    if types == ["07"]:
        return f"every {'M-7000 ' if row['format'] == 'modbus_hex' else ''}model that has type 07"
    return "assumed for voltages and currents"


def test_a_row_is_for_the_models_that_the_package_knows() -> None:
    assert wrong([cell(row, "applies", applies_of(row)) for row in ROWS]) == []


# Sentinels


def status_of(row: Record, code: TypeCode) -> Status:
    """What the package reads where the text or word of a sentinel stands."""
    if row["format"] == "modbus_engineering":
        return decode_engineering_word(row["value"] & 0xFFFF, code).status
    if row["format"] == "modbus_hex":
        return decode_word(row["value"], code).status
    return decode_field(row["value"], code, DataFormat[row["format"].upper()], legacy=row["until"] is not None).status


def has_a_word(status: Status, code: TypeCode) -> bool:
    """Whether the manual states the status for a type: only then it has a word in hex."""
    try:
        encode_word(Reading(None, code.unit, status), code)
    except EncodeError:
        return False
    return True


def types_of(row: Record) -> list[str] | None:
    """The types whose readings a row is in place of: thermocouples, others that are stated, or the assumed rest."""
    status = Status(row["name"])
    if status is Status.DISABLED or row["format"] == "modbus_engineering":
        return None
    if "E50" in row["errata"]:
        return [f"{code:02X}" for code in TypeCode if not code.thermocouple and not has_a_word(status, code)]
    hot = (row["types"] or [""])[0] in THERMOCOUPLES
    return [f"{code:02X}" for code in TypeCode if bool(code.thermocouple) == hot and has_a_word(status, code)]


def test_a_sentinel_is_for_the_types_that_the_package_knows() -> None:
    assert wrong([cell(row, "types", types_of(row)) for row in SENTINELS]) == []


@pytest.mark.parametrize("row", SENTINELS, ids=row_id)
def test_a_sentinel_is_read_as_such_for_its_types_and_for_no_other_that_has_no_row(row: Record) -> None:
    same = [it for it in SENTINELS if all(it[key] == row[key] for key in ("format", "name", "value", "until"))]
    listed = set(chain.from_iterable(it["types"] or [f"{code:02X}" for code in TypeCode] for it in same))
    found = {f"{code:02X}" for code in TypeCode if status_of(row, code) is Status(row["name"])}
    if row["until"] is not None:
        found &= set(THERMOCOUPLES)

    assert listed == found


@pytest.mark.parametrize("row", SENTINELS, ids=row_id)
def test_a_sentinel_stands_in_the_section_that_prints_it(row: Record) -> None:
    section = {"disabled": "2.3"}.get(row["name"], "3.5" if row["format"] == "modbus_engineering" else "1.11")

    assert wrong([cell(row, "section", section), cell(row, "where", None), cell(row, "code", None)]) == []


# Errata

ERRATA: dict[tuple[str, object], list[str]] = {
    ("data_format", 2): ["E45"],
    ("mode", 0): ["E43", "E96"],
    ("mode", 1): ["E43", "E95", "E96"],
    ("filter", 1): ["E88"],
    ("channel_mask", 1): ["E11", "E12"],
    ("diagnostics", 1): ["E13", "E14"],
    ("host_watchdog", 1): ["E100"],
    ("limit", 60): ["E32"],
    ("limit", 6): ["E102", "E122"],
    ("default", "fast"): ["E95"],
}
OF_A_WHOLE_SETTING = {
    "baud_rate": ["E89"],
    "character_format": ["E44"],
    "reserved": ["E89"],
    "type_code": ["E81"],
    "calibration": ["E33"],
    "protocols_supported": ["E92"],
    "host_watchdog_status": ["E31"],
}
"""What the errata are about: one code or value of a setting, or all of it."""


def errata_of(row: Record) -> list[str]:
    setting = row["setting"]
    if setting == "sentinel":
        return sentinel_errata(row)
    if setting == "init_mode":
        return ["E17", "E18"] if row["name"] == "module address" else ["E101"]
    found = ERRATA.get((setting, row["value"] if setting == "default" else row["code"]))
    return found or OF_A_WHOLE_SETTING.get(setting, [])


def sentinel_errata(row: Record) -> list[str]:
    """E25 blanks, E49 old firmware, E46 and E47 words that are readings too, E48 texts, E50 types that are assumed."""
    if row["name"] == "disabled":
        return ["E25"]
    if row["until"]:
        return ["E49"]
    if row["format"] == "modbus_engineering":
        return ["E48", "E50"]
    if row["format"] in ("hex", "modbus_hex"):
        return ["E46"] if row["types"] == THERMOCOUPLES else ["E47"]
    return ["E48"] if row["types"] in (THERMOCOUPLES, ["07"]) else ["E50"]


def test_a_row_names_the_errata_that_are_about_its_code() -> None:
    assert wrong([cell(row, "errata", errata_of(row)) for row in ROWS]) == []
