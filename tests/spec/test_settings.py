"""The columns of ``settings.json``, held against the code: what a code means, where it stands and for whom it is."""

from __future__ import annotations

import re
from itertools import chain
from typing import TYPE_CHECKING, Any

from i7000 import (
    MIXED,
    BaudRate,
    CharacterFormat,
    CjcUpdate,
    DataFormat,
    Filter,
    LineSettings,
    Model,
    Protocol,
    ReportSettings,
    Unit,
    dcon,
)
from i7000.device import factory, power_on
from tests.spec import lint
from tests.spec.cells import Cell, row_id, wrong

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.spec.lint import Record

FILE = "tables/settings.json"
ROWS = lint.rows("settings")
COMMANDS = {row["section"]: row for row in lint.rows("dcon_commands")}
CODED = [row for row in ROWS if row["setting"] != "sentinel"]


def cell(row: Record, column: str, expected: object) -> Cell:
    return Cell(FILE, row_id(row), column, row[column], expected)


# What a code means


def truth(code: int) -> bool:
    return bool(code)


SPELT: dict[str, Callable[[int], Any]] = {
    "baud_rate": lambda code: BaudRate(code).bits_per_second,
    "character_format": lambda code: CharacterFormat(code).name,
    "data_format": lambda code: DataFormat(code).name.lower(),
    "mode": lambda code: "fast" if ReportSettings.from_byte(code << 5).fast_mode else "normal",
    "checksum": lambda code: ReportSettings.from_byte(code << 6).checksum,
    "filter": lambda code: re.sub(r"REJECT_(\d+)_HZ", r"\1Hz", Filter(bool(code)).name),
    "type_code": lambda code: "mixed" if code == MIXED else None,
    "channel_mask": truth,
    "diagnostics": lambda code: ("normal", "fault")[code],
    "synchronized_data": lambda code: ("repeated", "first")[code],
    "cjc_update": lambda code: {"STARTED": "running"}.get(CjcUpdate(code).name, CjcUpdate(code).name.lower()),
    "cjc": truth,
    "calibration": truth,
    "open_wire_detection": truth,
    "connecting_mode": lambda code: ("differential", "single_ended")[code],
    "protocols_supported": lambda code: ("dcon", "dcon and modbus")[code],
    "protocol": lambda code: {Protocol.DCON: "dcon", Protocol.MODBUS_RTU: "modbus"}[Protocol(code)],
    "host_watchdog": truth,
    "host_watchdog_status": lambda code: next(
        name for name in ("timed_out", "enabled") if getattr(dcon.HostWatchdogStatus(0x01, code), name)
    ),
}
"""The value of each code of a setting, by the code's own names where it has them."""


def test_a_code_has_the_value_that_the_package_gives_it() -> None:
    cells = [cell(row, "value", SPELT[row["setting"]](row["code"])) for row in CODED if row["setting"] in SPELT]

    assert {row["setting"] for row in CODED} == SPELT.keys() | {"reserved", "limit", "default", "init_mode"}
    assert wrong(cells) == []


def factory_value(name: str, model: Model) -> Any:
    """What a module that comes from the factory has, in the words of the table."""
    module = factory(model)
    report = module.report_settings
    return {
        "module address": (module.address, module.address),
        "baud rate": (int(module.line_settings.baud_rate), BaudRate(module.line_settings.baud_rate).bits_per_second),
        "checksum": (int(report.checksum), "enabled" if report.checksum else "disabled"),
        "data format": (int(report.data_format), SPELT["data_format"](report.data_format)),
        "filter": (int(report.filter.value), SPELT["filter"](report.filter.value)),
        "protocol": (int(module.protocol), SPELT["protocol"](module.protocol)),
        "mode": (int(report.fast_mode), "fast" if report.fast_mode else "normal"),
        "soft INIT time-out": (power_on(module, now=0.0).ram.soft_init_timeout,) * 2,
    }[name]


DEFAULTS_OF_SOME = {"protocol": Model.M_7017, "mode": Model.I_7017F}


def test_a_default_is_what_a_module_has_from_the_factory() -> None:
    cells = []
    for row in CODED:
        if row["setting"] == "default":
            expected = factory_value(row["name"], DEFAULTS_OF_SOME.get(row["name"], Model.I_7017))
            cells += [cell(row, "code", expected[0]), cell(row, "value", expected[1])]

    assert len(cells) == 16
    assert wrong(cells) == []


def test_init_mode_is_what_a_module_has_that_is_powered_on_in_it() -> None:
    ram = power_on(factory(Model.M_7017), init_switch=True, now=0.0).ram
    rate = BaudRate(ram.line_settings.baud_rate)
    expected = {
        "module address": (ram.address, ram.address),
        "baud rate": (int(rate), rate.bits_per_second),
        "checksum": (int(ram.checksum), "enabled" if ram.checksum else "disabled"),
        "protocol": (int(ram.protocol), SPELT["protocol"](ram.protocol)),
    }
    found = {row["name"]: (row["code"], row["value"]) for row in CODED if row["setting"] == "init_mode"}

    assert expected == found


# Where it stands

BITS = re.compile(r"(CC|FF|SS) bits? (\d)(?::(\d))?")
IN_BYTE: dict[str, Callable[[int], int]] = {
    "baud_rate": lambda byte: LineSettings.from_byte(byte).baud_rate,
    "character_format": lambda byte: LineSettings.from_byte(byte).character_format,
    "data_format": lambda byte: ReportSettings.from_byte(byte).data_format,
    "mode": lambda byte: ReportSettings.from_byte(byte).fast_mode,
    "checksum": lambda byte: ReportSettings.from_byte(byte).checksum,
    "filter": lambda byte: ReportSettings.from_byte(byte).filter.value,
    "reserved": lambda byte: ReportSettings.from_byte(byte).reserved,
}
AS_SETTING = {"baud rate": "baud_rate", "data format": "data_format"}


def in_bits(where: str) -> list[int]:
    """The bits of the byte, the highest first."""
    match = BITS.fullmatch(where)
    assert match
    high = int(match[2])
    return list(range(high, int(match[3] or high) - 1, -1))


def bits_of(setting: str) -> list[int]:
    return [bit for bit in range(7, -1, -1) if IN_BYTE[setting](1 << bit) != IN_BYTE[setting](0)]


def byte_of(setting: str) -> str:
    return "CC" if setting in ("baud_rate", "character_format") else "FF"


def test_bits_stand_where_the_package_reads_them() -> None:
    cells = []
    for row in CODED:
        setting = row["setting"] if row["setting"] in IN_BYTE else AS_SETTING.get(row["name"], row["name"])
        if setting in IN_BYTE:
            cells.append(Cell(FILE, row_id(row), "where", row["where"][:2], byte_of(setting)))
            bits = bits_of(setting)
            cells.append(Cell(FILE, row_id(row), "where", in_bits(row["where"]), bits))
            cells.append(Cell(FILE, row_id(row), "low_bit, bits", (row["low_bit"], row["bits"]), (bits[-1], len(bits))))

    assert len(cells) == 87
    assert wrong(cells) == []


def test_what_is_a_whole_field_has_no_bits_of_a_byte() -> None:
    whole = [row for row in ROWS if not re.match("CC|FF", row["where"] or "")]

    assert len(whole) > 50
    assert wrong([cell(row, column, None) for row in whole for column in ("low_bit", "bits")]) == []


def test_the_status_of_the_host_watchdog_has_one_bit_a_code() -> None:
    cells = [
        cell(row, "where", f"SS bit {row['code'].bit_length() - 1}")
        for row in CODED
        if row["setting"] == "host_watchdog_status"
    ]

    assert len(cells) == 2
    assert wrong(cells) == []


FIELD_OF = {
    "type_code": ("2.1", "type_code"),
    "channel_mask": ("2.13", "mask"),
    "diagnostics": ("2.22", "mask"),
    "synchronized_data": ("2.12", "first_reading"),
    "cjc_update": ("2.21", "update"),
    "cjc": ("2.30", "enabled"),
    "calibration": ("2.31", "enabled"),
    "open_wire_detection": ("2.41", "enabled"),
    "connecting_mode": ("2.43", "single_ended"),
    "protocols_supported": ("2.25", "modbus_supported"),
    "protocol": ("2.26", "protocol"),
    "host_watchdog": ("2.39", "enabled"),
    "host_watchdog_status": ("2.36", "status"),
    "largest CJC offset, either sign": ("2.18", "offset"),
    "longest soft INIT time-out": ("2.34", "timeout"),
    "longest host watchdog time-out": ("2.39", "timeout"),
    "longest module name": ("2.33", "name"),
    "soft INIT time-out": ("2.34", "timeout"),
}
"""The section and field that a setting, a limit or a default is of."""


OF_CHAPTER_1 = {("default", "protocol"), ("init_mode", "protocol")}


def field_of(row: Record) -> Record | None:
    """The field of a DCON message that a row is about, with its section; None for those of a byte or of chapter 1."""
    place = FIELD_OF.get(row["name"] if row["setting"] in ("limit", "default", "init_mode") else row["setting"])
    if place is None or (row["setting"], row["name"]) in OF_CHAPTER_1:
        return None
    section, name = place
    sides = chain(COMMANDS[section]["fields"], COMMANDS[section]["response_fields"])
    field: Record = next(field for field in sides if field["name"] == name)
    return field | {"section": section}


SUFFIXES = {
    "channel_mask": ", bit n for channel n",
    "diagnostics": ", bit n for channel n",
    "protocol": "; C in the response of $AAP",
}
MAGNITUDE = {"SNNNN": "NNNN"}
"""The limit is on the digits, without the sign."""


def test_a_letter_is_the_one_of_the_field_in_the_section_of_the_row() -> None:
    cells = []
    for row in CODED:
        field = field_of(row)
        if field is not None and row["setting"] != "host_watchdog_status":
            letters = MAGNITUDE.get(field["notation"]) or field["notation"]
            cells.append(cell(row, "where", letters + SUFFIXES.get(row["setting"], "")))
        if field is not None:
            cells.append(cell(row, "section", field["section"]))
    told = next(field for field in COMMANDS["2.25"]["response_fields"] if field["name"] == "protocol")

    assert COMMANDS["2.25"]["syntax"] == "$AAP"
    assert told["notation"] == "C"
    assert wrong(cells) == []


ADDRESS = {"module address": "AA", "protocol": "C of $AAP"}


def test_settings_of_chapter_1_stand_in_their_sections() -> None:
    sections = {"default": "1.9", "init_mode": "A.1"}
    cells = []
    for row in CODED:
        if field_of(row) is None:
            cells.append(cell(row, "section", sections.get(row["setting"], "1.11")))
        if row["setting"] in sections and row["name"] in ADDRESS:
            cells.append(cell(row, "where", ADDRESS[row["name"]]))

    assert wrong(cells) == []


# Units


def unit_of(row: Record) -> str | None:
    if "baud" in row["name"]:
        return "baud"
    field = field_of(row)
    if field is None or row["setting"] not in ("limit", "default"):
        return None
    return "character" if field["name"] == "name" else str(field["unit"]).split()[-1]


def test_a_value_has_the_unit_of_its_field() -> None:
    assert wrong([cell(row, "unit", unit_of(row)) for row in ROWS]) == []


def test_a_limit_is_its_count_in_the_unit_of_its_field() -> None:
    cells = []
    for row in CODED:
        if row["setting"] == "limit":
            field = field_of(row)
            assert field is not None
            if field["name"] == "name":
                expected: tuple[float, float] = (max(field["digits"]),) * 2
            else:
                scale = field["unit"].split()[:-1]
                expected = (field["maximum"], round(field["maximum"] * float(scale[0] if scale else 1), 6))
            cells.append(Cell(FILE, row_id(row), "code, value", (row["code"], row["value"]), expected))

    assert len(cells) == 4
    assert wrong(cells) == []


def test_units_are_those_of_the_package() -> None:
    assert {row["unit"] for row in ROWS} - {None, "baud", "s", "character"} <= set(Unit)
