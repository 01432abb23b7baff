"""The tables of ``i7000.h``, printed by a C program field by field, against the rows of ``spec/tables``."""

import re
from collections.abc import Iterator
from itertools import groupby
from pathlib import Path

import pytest

from i7000 import Firmware
from tests.c import compile_c, output_of
from tests.spec.lint import SPEC, Record, load, rows

FIRMWARES = ("A9.9", "B2.6", "B2.10", "B3.5", "B3.9", "B4.1", "B4.5", None)
NO_MINIMUM, NO_MAXIMUM = -(2**31), 2**31 - 1
MODELS = [row["name"] for row in rows("models")]
FORMATS = ("engineering", "percent", "hex", "modbus_engineering", "modbus_hex")
AREAS = ("coil", "discrete_input", "input_register", "holding_register")
TYPES = ("bool", "reading", "uint16", "int16", "int8", "uint32", "code", "bits", "record")
NEVER = "FFFFFFFF"

Printed = dict[str, list[list[str]]]


@pytest.fixture(scope="module")
def printed(tmp_path_factory: pytest.TempPathFactory) -> Printed:
    program = tmp_path_factory.mktemp("tables") / "tables"
    compile_c("gcc", Path(__file__).with_name("tables.c"), "-o", program)
    lines = [line.split("\t") for line in output_of(program).splitlines()]
    return {kind: [line[1:] for line in found] for kind, found in groupby(lines, key=lambda line: line[0])}


def number(version: str | None) -> str:
    """A firmware as the program prints it."""
    letter, major, minor = re.fullmatch(r"(.)(\d+)\.(\d+)", version).groups() if version else ("\0", "0", "0")  # type: ignore[union-attr] # as the schema has it
    return f"{ord(letter):02X}{int(major):02X}{int(minor):02X}"


def bits(codes: Iterator[str] | list[str]) -> str:
    return f"{sum(1 << int(code, 16) for code in codes):08X}"


def gates(models: Record) -> str:
    """For each model, whether it has something with each firmware."""
    return " ".join("".join(str(int(has(models, model, firmware))) for firmware in FIRMWARES) for model in MODELS)


def has(models: Record, model: str, firmware: str | None) -> bool:
    if model not in models:
        return False
    return models[model] is None or firmware is None or Firmware(firmware) >= Firmware(models[model])


def texts(*values: object) -> list[str]:
    return ["" if value is None else str(int(value)) if isinstance(value, bool) else str(value) for value in values]


def test_types_have_their_ends_in_every_format(printed: Printed) -> None:
    assert printed["type"] == [
        texts(
            it["name"], it["unit"], it["engineering_decimals"], it["hex_signed"], it["thermocouple"] is not None,
            *(round(it[end] * 10 ** it["engineering_decimals"]) for end in ("minimum", "maximum", "max")),
            it["hex_min"], it["hex_max"], it["modbus_min"], it["modbus_max"], it["modbus_counts_per_unit"],
            it["percent_min"], it["percent_max"],
        )
        for it in rows("type_codes")
    ]  # fmt: skip


def test_models_have_their_columns(printed: Printed) -> None:
    expected = [
        texts(
            it["name"], it["series"], "modbus" in it["protocols"], it["channels"],
            it["single_ended_channels"] or it["channels"], it["single_ended_by_command"], it["mask_digits"],
            it["mask_digits_single_ended"] or it["mask_digits"],
            it["default_type"] or "FF", it["uses_tt"], it["cjc"], it["open_wire_detection"], it["fast_mode"],
            bits(it["types"]), bits(code for code, first in it["types"].items() if first),
            number(next(filter(None, it["types"].values()), None)), first_of(it["individually_configurable"]),
            first_of(it["filter"]), number(it["character_formats_from"]),
        )
        for it in rows("models")
    ]  # fmt: skip

    assert printed["model"] == expected


def first_of(value: str | bool | None) -> str:  # noqa: FBT001 - as the column has it
    if value in ("always", True):
        return number(None)
    return number(str(value)) if value else NEVER


def test_commands_have_their_syntax_their_parts_and_their_models(printed: Printed) -> None:
    expected = [
        [*texts(
            it["name"], it["section"], it["syntax"], it["response_syntax"], it["response"],
            round(1000 * (it["pause"] or {"seconds": 0})["seconds"]),
        ), gates(it["models"])]
        for it in rows("dcon_commands")
    ]  # fmt: skip

    assert [[*line[:6], line[8]] for line in printed["command"]] == expected
    assert [[part.replace(" ", "") for part in line[6:8]] for line in printed["command"]] == [
        texts(it["syntax"], it["response_syntax"]) for it in rows("dcon_commands")
    ]


@pytest.mark.parametrize(
    ("syntax", "parts"),
    [
        ("@AASN", "@ AA S N"),
        ("$AA7CiRrr", "$ AA 7C i R rr"),
        ("~AA3EVV", "~ AA 3 E VV"),
        ("%AANNTTCCFF", "% AA NN TT CC FF"),
        ("~AAEON", "~ AA EO N"),
    ],
)
def test_a_syntax_is_cut_where_the_manual_means_it(printed: Printed, syntax: str, parts: str) -> None:
    (line,) = (line for line in printed["command"] if line[2] == syntax)

    assert line[6] == parts


def test_functions_and_sub_functions_have_their_pdus_and_their_models(printed: Printed) -> None:
    functions = [
        [*texts(
            it["name"], it["section"], it["function"], "FF", it["broadcast"], it["minimum_count"] or 0,
            it["maximum_count"] or 0, it["response_name"], it["request"], it["response"],
        ), gates(it["models"])]
        for it in rows("modbus_functions") if it["name"]
    ]  # fmt: skip
    settings = [
        [*texts(it["name"], it["section"], "46", it["sub_function"], 0, 0, 0, it["response_name"], it["request"],
                it["response"]), gates(it["models"])]
        for it in rows("module_settings")
    ]  # fmt: skip

    assert printed["request"] == functions + settings


def test_the_nine_maps_have_every_register_with_its_limits_and_its_models(printed: Printed) -> None:
    expected = []
    for file in sorted(SPEC.glob("tables/modbus_registers/*.json")):
        table = load(file)
        for it in table["rows"]:
            access = {"R": 1, "W": 2, "R/W": 3}[it["access"]]
            ends = (
                NO_MINIMUM if it["minimum"] is None else it["minimum"],
                NO_MAXIMUM if it["maximum"] is None else it["maximum"],
            )
            expected.append(texts(
                table["section"], it["name"], it["unit"], round(1 / it["scale"]) if it["scale"] else 0, it["first"],
                it["address"], it["count"], AREAS.index(it["area"]), access, TYPES.index(it["type"]), *ends,
                len(it["values"] or ()), number(it["firmware"]),
                *sorted(it["models"] or table["models"], key=MODELS.index),
            ))  # fmt: skip

    assert printed["register"] == expected
    assert len({line[0] for line in printed["register"]}) == 9


def test_sentinels_have_their_texts_words_and_types(printed: Printed) -> None:
    all_types = [it["code"] for it in rows("type_codes")]
    expected = [
        texts(
            it["name"], FORMATS.index(it["format"]), it["until"] is not None, bits(it["types"] or all_types),
            "" if isinstance(it["value"], int) else it["value"],
            f"{it['value'] & 0xFFFF if isinstance(it['value'], int) else 0:04X}",
        )
        for it in rows("settings") if it["setting"] == "sentinel"
    ]  # fmt: skip

    assert printed["sentinel"] == expected
