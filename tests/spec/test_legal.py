"""Which numbers a module takes (`legal`), and what a read may ask for, held against the encoders and the device."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Any

import pytest
from attrs import fields

from i7000 import Firmware, Model, Profile, Protocol, dcon, modbus
from tests.device.driver import bench
from tests.spec import lint
from tests.spec.cells import Cell, row_id, wrong
from tests.spec.test_fields import M_PROFILES, PROFILES, TRUTHS
from tests.spec.test_fields import ordinary as ordinary_of_all
from tests.spec.test_settings_of_models import limit_of
from tests.vectors import AVAILABILITY, MESSAGES, MODBUS_MESSAGES, message_of, modbus_message_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from tests.spec.lint import Record

MODELS = {row["name"]: row for row in lint.rows("models")}
SETTINGS = lint.rows("settings")
BYTES = {"line_settings": "CC", "report_settings": "FF"}
FIRMWARES = [None, *map(Firmware, ("A1.0", "B2.1", "B2.2", "B2.6", "B2.7", "B2.9", "B3.1", "B3.9", "B4.2", "B4.5"))]
"""Versions on both sides of every limit of a type, a setting or FF for TT."""


def reaches(firmware: Firmware | None, limit: str | None) -> bool:
    return limit is None or firmware is None or firmware >= Firmware(limit)


def types_of(profile: Profile) -> set[int]:
    types = MODELS[profile.model.value]["types"]
    return {int(code, 16) for code, limit in types.items() if reaches(profile.firmware, limit)}


def types_or_mixed(profile: Profile) -> set[int]:
    mixed = MODELS[profile.model.value]["mixed_types"]
    if mixed == "ignored":
        return set(range(256))
    accepted = mixed == "always" or (mixed is not None and reaches(profile.firmware, mixed))
    return types_of(profile) | ({0xFF} if accepted else set())


def channels_of(profile: Profile) -> int:
    row = MODELS[profile.model.value]
    return int(row["single_ended_channels"] if profile.single_ended else row["channels"])


def type_channels(profile: Profile) -> set[int]:
    since = MODELS[profile.model.value]["individually_configurable"]
    each = since == "always" or (since is not None and reaches(profile.firmware, since))
    return set(range(channels_of(profile) if each else 1))


RULES: dict[str, Callable[[Profile], set[int]]] = {
    "types": types_of,
    "types_or_mixed": types_or_mixed,
    "channels": lambda profile: set(range(channels_of(profile))),
    "type_channels": type_channels,
    "channel_bits": lambda profile: {1 << bit for bit in range(channels_of(profile))} | {0},
    "offset_channels": lambda profile: {0, *range(0x80, 0x80 + channels_of(profile))},
}
"""The rules of dcon.md, on the columns of ``models.json``; of a mask, the numbers with one bit or none."""


def byte_of(name: str, profile: Profile) -> set[int]:
    """What the rows of ``settings.json`` add up to in a byte of settings."""
    found = {0}
    rows = [
        row
        for row in SETTINGS
        if (row["where"] or "").startswith(BYTES[name]) and row["setting"] not in ("default", "init_mode")
    ]
    for setting in dict.fromkeys(row["setting"] for row in rows):
        added = {
            (row["value"] if row["code"] is None else row["code"]) << row["low_bit"]
            for row in rows
            if row["setting"] == setting
            and (row["needs"] is None or MODELS[profile.model.value][row["needs"]])
            and reaches(profile.firmware, limit_of(row["firmware"] or {}, profile.model))
        }
        found = {byte | more for byte, more in product(found, added)}
    return found


def ordinary(name: str, profile: Profile) -> Record:
    """Values that a module takes, for the fields of one command."""
    values = ordinary_of_all(name, profile)
    return {field.name: values[field.name] for field in fields(MESSAGES[name])}


def tried(field: Record) -> Iterable[int]:
    if field["legal"] == "channel_bits":
        return [0, *(1 << bit for bit in range(24))]
    return range(256)


def accepted(encode: Callable[[int], object], numbers: Iterable[int]) -> set[int]:
    found = set()
    for number in numbers:
        try:
            encode(number)
        except ValueError:
            continue
        found.add(number)
    return found


RULED = [
    pytest.param(row, field, id=f"{row['name']}-{field['name']}")
    for row in lint.rows("dcon_commands")
    for field in row["fields"]
    if field["minimum"] is not None and abs(field["minimum"]) < 256 and field["name"] not in TRUTHS
]


def expected_of(field: Record, profile: Profile) -> set[int]:
    """The numbers that a table allows for one module."""
    if field["legal"] is None:
        return set(range(field["minimum"], field["maximum"] + 1))
    return RULES[field["legal"]](profile) if isinstance(field["legal"], str) else set(field["legal"])


@pytest.mark.parametrize(("row", "field"), RULED)
def test_a_host_sends_the_legal_numbers_of_a_field_of_dcon_and_no_other(row: Record, field: Record) -> None:
    for profile in PROFILES:
        if AVAILABILITY[row["section"]] in profile.refused:
            continue
        values = ordinary(row["name"], profile)

        def encode(number: int, profile: Profile = profile, values: Record = values) -> object:
            message = message_of({"type": row["name"], "fields": values | {field["name"]: number}})
            return dcon.encode(message, profile)

        expected = expected_of(field, profile)
        if field["name"] in BYTES:
            assert byte_of(field["name"], profile) <= expected
            expected = byte_of(field["name"], profile)
        assert accepted(encode, tried(field)) == expected, profile.name


@pytest.mark.parametrize("name", BYTES)
def test_a_list_of_legal_bytes_is_that_of_all_models_together(name: str) -> None:
    together = set().union(*(byte_of(name, profile) for profile in PROFILES))
    lists = [
        field["legal"]
        for table in ("dcon_commands", "module_settings")
        for row in lint.rows(table)
        for side in ("fields", "response_fields")
        for field in row[side]
        if field["name"] == name
    ]

    assert len(lists) > 1
    assert lists == [sorted(together)] * len(lists)


@pytest.mark.parametrize("model", Model, ids=lambda model: model.value)
def test_the_types_and_bytes_of_settings_follow_the_firmware(model: Model) -> None:
    for firmware in FIRMWARES:
        profile = Profile(model, firmware=firmware, type_codes=())
        values = ordinary("SetConfiguration", profile) | {"type_code": min(types_of(profile))}
        for name, expected in (
            ("type_code", types_or_mixed(profile)),
            *((name, byte_of(name, profile)) for name in BYTES),
        ):

            def encode(number: int, name: str = name, profile: Profile = profile, values: Record = values) -> object:
                message = message_of({"type": "SetConfiguration", "fields": values | {name: number}})
                return dcon.encode(message, profile)

            assert accepted(encode, range(256)) == expected, (profile.name, name)


# Function 46h

SETTING_FIELDS = [
    pytest.param(row, field, id=f"{row['name']}-{field['name']}")
    for row in lint.rows("module_settings")
    for field in row["fields"]
    if field["kind"] != "bool"
]


@pytest.mark.parametrize(("row", "field"), SETTING_FIELDS)
def test_a_host_sends_the_legal_numbers_of_a_setting_and_no_other(row: Record, field: Record) -> None:
    for profile in M_PROFILES:
        if profile.model.value not in row["models"]:
            continue
        for channel in (0, 0x80) if field["legal"] == "offsets" else (0,):
            values: Record = dict.fromkeys((it.name for it in fields(MODBUS_MESSAGES[row["name"]])), 0)
            values |= {"address": 1, "line_settings": 6, "channel": channel, "type_code": min(profile.model.type_codes)}
            values = {name: values[name] for name in (it.name for it in fields(MODBUS_MESSAGES[row["name"]]))}

            def encode(number: int, profile: Profile = profile, values: Record = values) -> object:
                message = modbus_message_of({"type": row["name"], "fields": values | {field["name"]: number}})
                return modbus.encode(message, profile)

            if field["legal"] == "offsets":
                limits = (0, 0xFF) if channel else (field["minimum"], field["maximum"])
                assert accepted(encode, (limits[0] - 1, *limits, limits[1] + 1)) == set(limits)
                continue
            expected = expected_of(field, profile)
            if field["name"] == "line_settings":
                expected = byte_of("line_settings", profile)
            if field["name"] == "settings":
                assert byte_of("report_settings", profile) & {0, 0x20, 0x80, 0xA0} <= expected
                expected = byte_of("report_settings", profile) & {0, 0x20, 0x80, 0xA0}
            assert accepted(encode, tried(field)) == expected, profile.name


def test_the_legal_numbers_of_responses_are_those_of_what_sets_them() -> None:
    cells = []
    for table in ("dcon_commands", "module_settings"):
        legal = {
            (field["name"], field.get("notation")): field["legal"]
            for row in lint.rows(table)
            for field in row["fields"]
        }
        for row in lint.rows(table):
            for field in row["response_fields"]:
                expected = legal.get((field["name"], field.get("notation")))
                if (row["name"], field["name"]) == ("ReadDiagnostics", "mask"):
                    expected = legal["mask", "VV"]
                cells.append(Cell(f"tables/{table}.json", row["name"], field["name"], field["legal"], expected))

    assert wrong(cells) == []


# Maps

MAPS = {lint.name(path): lint.load(path) for path in lint.table_files("modbus_registers")}
WRITTEN = [
    pytest.param(file, row, id=f"{file.removeprefix('tables/modbus_registers/')}-{row['key']}")
    for file, data in MAPS.items()
    for row in data["rows"]
    if "W" in row["access"]
]
LIMITS = {"uint16": (0, 0xFFFF), "int16": (-0x8000, 0x7FFF), "uint32": (0, 0xFFFFFFFF)}
"""The numbers of a type without limits of its own."""


def candidates(row: Record) -> list[int]:
    """Numbers within, at and beyond the limits of a row, as far as its registers can hold them."""
    if row["area"] == "coil":
        return [0, 1]
    low, high = (row["minimum"], row["maximum"]) if row["minimum"] is not None else LIMITS[row["type"]]
    found = {low - 1, low, low + 1, (low + high) // 2, high - 1, high, high + 1, *range(256)}
    least, most = {"int8": (-0x8000, 0x7F)}.get(row["type"], LIMITS.get(row["type"], (0, 0xFFFF)))
    return sorted(number for number in found if least <= number <= most)


def written(row: Record, profile: Profile) -> set[int]:
    """The candidates that a module takes when they are written to the first item of a row."""
    module = bench(profile.model, protocol=Protocol.MODBUS_RTU, single_ended=profile.single_ended)
    untouched, found = module.state, set()
    for number in candidates(row):
        if row["area"] == "coil":
            request: Any = modbus.WriteSingleCoil(1, row["address"], value=bool(number))
        elif row["type"] == "uint32":
            request = modbus.WriteMultipleRegisters(1, row["address"], (number & 0xFFFF, number >> 16))
        else:
            word = number & (0xFF if row["type"] == "int8" and number >= -0x80 else 0xFFFF)
            request = modbus.WriteSingleRegister(1, row["address"], word)
        module.state = untouched
        response = module.ask(request)
        if not isinstance(response, modbus.ExceptionResponse):
            found.add(number)
        else:
            assert response.exception_code == modbus.ExceptionCode.ILLEGAL_DATA_VALUE
    return found


def legal_in_map(row: Record, profile: Profile) -> set[int]:
    """The candidates that a row of a map allows for one module."""
    numbers = set(candidates(row))
    match row["legal"]:
        case "types":
            return types_of(profile)
        case "channel_bits":
            lowest = 16 if row["name"] == "channel_mask_high" else 0
            return {number for number in numbers if 0 <= number << lowest < 1 << channels_of(profile)}
        case list(legal):
            return set(legal)
        case _ if row["minimum"] is None:
            return numbers
        case _:
            return set(range(row["minimum"], row["maximum"] + 1)) & numbers


@pytest.mark.parametrize(("file", "row"), WRITTEN)
def test_a_module_takes_the_legal_numbers_of_a_row_and_no_other(file: str, row: Record) -> None:
    for profile in M_PROFILES:
        if profile.model.value in (row["models"] or MAPS[file]["models"]):
            assert written(row, profile) == legal_in_map(row, profile), profile


def test_nothing_is_legal_where_nothing_is_written() -> None:
    cells = [
        Cell(file, row_id(row), "legal", row["legal"], None)
        for file, data in MAPS.items()
        for row in data["rows"]
        if row["access"] == "R"
    ]

    assert len(cells) > 50
    assert wrong(cells) == []


@pytest.mark.parametrize("file", MAPS)
def test_a_read_is_of_multiples_where_its_row_says_so(file: str) -> None:
    reads: dict[str, Any] = {
        "coil": modbus.ReadCoils,
        "discrete_input": modbus.ReadDiscreteInputs,
        "holding_register": modbus.ReadHoldingRegisters,
        "input_register": modbus.ReadInputRegisters,
    }
    for row in MAPS[file]["rows"]:
        if "R" not in row["access"]:
            continue
        module = bench(Model((row["models"] or MAPS[file]["models"])[-1]), protocol=Protocol.MODBUS_RTU)
        step = row["read_multiple"]
        for first, count in product(range(min(row["count"], 20)), (1, 2, 17, 18, 19, 36, 54)):
            if first + count <= row["count"]:
                answer = module.ask(reads[row["area"]](1, row["address"] + first, count))
                refused = isinstance(answer, modbus.ExceptionResponse)
                assert refused == bool(first % step or count % step), (row["key"], first)
                assert not refused or answer.exception_code == modbus.ExceptionCode.ILLEGAL_DATA_VALUE
