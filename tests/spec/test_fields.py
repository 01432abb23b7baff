"""The limits and units of the fields of DCON commands and of function 46h, held against what the code does."""

from __future__ import annotations

from itertools import chain
from typing import TYPE_CHECKING, Any

import pytest
from attrs import fields

from i7000 import Model, Profile, Protocol, Unit, dcon, modbus
from i7000.device import Signals, advance, factory, power_on, step
from i7000.modbus.cold_junction import FIRST_CHANNEL, offset_in_celsius
from tests.spec import lint
from tests.spec.cells import Cell, row_id, wrong
from tests.vectors import AVAILABILITY, MESSAGES, MODBUS_MESSAGES, message_of, modbus_message_of

if TYPE_CHECKING:
    from tests.spec.lint import Record

PROFILES = [*map(Profile, Model), Profile(Model.M_7017Z, single_ended=True)]
M_PROFILES = [profile for profile in PROFILES if Protocol.MODBUS_RTU in profile.model.protocols]
COMMANDS = {row["section"]: row for row in lint.rows("dcon_commands")}
SETTINGS = {row["sub_function"]: row for row in lint.rows("module_settings")}
DCON_FILE, SETTINGS_FILE = "tables/dcon_commands.json", "tables/module_settings.json"
SIDES = {"fields": "name", "response_fields": "response"}

READ_BACK = {
    "2.10": "2.1", "2.14": "2.13", "2.16": "2.15", "2.17": "2.18", "2.20": "2.21", "2.25": "2.26", "2.29": "2.30",
    "2.38": "2.39", "2.40": "2.41", "2.42": "2.43",
}  # fmt: skip
"""Which command sets what the response of another tells."""
SETTINGS_READ_BACK = {"05": "06", "07": "08", "25": "26", "29": "2A", "2B": "2C", "2D": "2E", "2F": "30"}
"""The same of sub-functions."""
TRUTHS = {"enabled", "first_reading", "modbus_supported", "single_ended"}


def by_name(found: list[Record]) -> dict[str, Record]:
    return {field["name"]: field for field in found}


def limits(field: Record) -> tuple[Any, ...]:
    return field["minimum"], field["maximum"], field["unit"]


# Limits


def ordinary(name: str, profile: Profile) -> Record:
    """Values that a module takes, for the fields that are not tried."""
    type_code = profile.type_codes[0] if profile.type_codes else min(profile.model.type_codes)
    values: Record = {field.name: 0 for field in fields(MESSAGES[name])}
    values |= dict.fromkeys(TRUTHS & values.keys(), False)
    values |= {"line_settings": 6, "type_code": type_code, "values": ["+00.000"] * 8, "name": "A"}
    return values


def is_taken(name: str, field: str, value: Any, profile: Profile) -> bool:
    values = ordinary(name, profile) | {field: bool(value) if field in TRUTHS and value in (0, 1) else value}
    try:
        message = message_of({"type": name, "fields": {it.name: values[it.name] for it in fields(MESSAGES[name])}})
        dcon.encode(message, profile)
    except ValueError:
        return False
    return True


def taken(name: str, field: Record, profiles: list[Profile]) -> list[bool]:
    """Whether any module takes what is one step below, at and one step above the limits."""
    least = 0.1 if field["name"] == "temperature" else 1
    low, high = field["minimum"], field["maximum"]
    tried = [round(value, 1) for value in (low - least, low, high, high + least)]
    return [any(is_taken(name, field["name"], value, profile) for profile in profiles) for value in tried]


def having(section: str) -> list[Profile]:
    return [profile for profile in PROFILES if AVAILABILITY[section] not in profile.refused]


LIMITED = [
    pytest.param(row, field, id=f"{row['name']}-{field['name']}")
    for row in COMMANDS.values()
    for field in row["fields"]
    if field["minimum"] is not None
]


@pytest.mark.parametrize(("row", "field"), LIMITED)
def test_a_host_can_send_a_field_up_to_its_limits_and_not_beyond(row: Record, field: Record) -> None:
    found = taken(row["name"], field, having(row["section"]))

    assert wrong([Cell(DCON_FILE, row_id(row), f"fields.{field['name']}", found, [False, True, True, False])]) == []


@pytest.mark.parametrize("section", READ_BACK)
def test_a_field_that_is_read_back_has_the_limits_with_which_it_is_set(section: str) -> None:
    row, setter = COMMANDS[section], COMMANDS[READ_BACK[section]]
    settable = by_name(setter["fields"])
    cells = [
        Cell(DCON_FILE, row_id(row), f"response_fields.{field['name']}", limits(field), limits(settable[field["name"]]))
        for field in row["response_fields"]
        if field["name"] in settable
    ]

    assert len(cells) > 1
    assert wrong(cells) == []


@pytest.mark.parametrize("section", COMMANDS)
def test_a_field_that_repeats_the_command_has_its_limits(section: str) -> None:
    row = COMMANDS[section]
    sent = by_name(row["fields"])
    cells = [
        Cell(DCON_FILE, row_id(row), f"response_fields.{field['name']}", limits(field), limits(sent[field["name"]]))
        for field in row["response_fields"]
        if field["name"] in sent
    ]

    assert wrong(cells) == []


def most_of_diagnostics() -> int:
    return (1 << max(profile.channels for profile in having("2.22"))) - 1


TOLD_ONLY = [
    pytest.param(row, field, id=f"{row['response']}-{field['name']}")
    for row in COMMANDS.values()
    for field in row["response_fields"]
    if field["name"] in ("first_reading", "modbus_supported", "status", "temperature")
]


@pytest.mark.parametrize(("row", "field"), TOLD_ONLY)
def test_a_field_only_of_responses_has_the_limits_of_its_form(row: Record, field: Record) -> None:
    found = taken(row["response"], field, having(row["section"]))

    assert wrong([Cell(DCON_FILE, row_id(row), field["name"], found, [False, True, True, False])]) == []


def test_diagnostics_have_a_bit_for_each_channel_of_the_widest_model() -> None:
    field = by_name(COMMANDS["2.22"]["response_fields"])["mask"]

    assert wrong([Cell(DCON_FILE, "2.22", "mask", limits(field), (0, most_of_diagnostics(), None))]) == []


def test_only_text_has_no_limits() -> None:
    texts = {"name", "version", "value", "values"}
    cells = [
        Cell(DCON_FILE, row_id(row), f"{field['name']}.{limit}", field[limit] is None, field["name"] in texts)
        for row in COMMANDS.values()
        for field in chain(row["fields"], row["response_fields"])
        for limit in ("minimum", "maximum")
    ]

    assert wrong(cells) == []


# Units


def watchdog_unit() -> str:
    """One count of VV as the model of a module waits it."""
    module = power_on(factory(Model.I_7017), now=0.0)
    module, _ = step(module, b"~013101\r", Signals(), 0.0)
    waited = next(
        tenth for tenth in range(100) if advance(module, Signals(), tenth / 10).eeprom.host_watchdog_timed_out
    )
    return f"{waited / 10:g} s"


def soft_init_unit() -> str:
    """One count of nn as the model of a module waits it."""
    module = power_on(factory(Model.I_7019R), now=0.0)
    for frame in (b"~01T01\r", b"~01I\r"):
        module, _ = step(module, frame, Signals(), 0.0)
    ends = module.ram.soft_init_until
    assert ends is not None
    return "s" if ends == 1 else f"{ends:g} s"


def offset_unit() -> str:
    return f"{dcon.CjcOffset(0x01, 1).celsius:g} {Unit.CELSIUS}"


def temperature_unit() -> str:
    """The response for a cold junction of 25 degrees Celsius."""
    module = power_on(factory(Model.I_7018), now=0.0)
    _, answer = step(module, b"$013\r", Signals(cold_junction=25.0), 0.0)
    return str(Unit.CELSIUS) if answer == b">+0025.0\r" else "?"


def unit_of(section: str, name: str) -> str | None:
    if name == "timeout":
        return soft_init_unit() if section == "2.34" else watchdog_unit()
    return {"offset": offset_unit(), "temperature": temperature_unit()}.get(name)


@pytest.mark.parametrize("section", COMMANDS)
def test_a_count_of_a_field_is_the_unit_that_a_module_makes_of_it(section: str) -> None:
    row = COMMANDS[section]
    cells = [
        Cell(DCON_FILE, row_id(row), f"{side}.{field['name']}.unit", field["unit"], unit_of(section, field["name"]))
        for side in SIDES
        for field in row[side]
    ]

    assert wrong(cells) == []


# Function 46h


def is_told(name: str, field: str, value: Any) -> bool:
    kinds = [it.name for it in fields(MODBUS_MESSAGES[name])]
    values = dict.fromkeys(kinds, 0) | {"address": 1, field: value}
    try:
        modbus.encode(modbus_message_of({"type": name, "fields": values}), Profile(Model.M_7019R))
    except ValueError:
        return False
    return True


BYTES = {"result", "line_result", "protocol_result", "major", "minor", "build"}


@pytest.mark.parametrize("sub_function", SETTINGS)
def test_a_byte_of_a_response_has_the_limits_of_what_a_module_sends(sub_function: str) -> None:
    row = SETTINGS[sub_function]
    cells = []
    for field in row["response_fields"]:
        if field["name"] in BYTES:
            low, high = field["minimum"], field["maximum"]
            found = [is_told(row["response_name"], field["name"], value) for value in (low - 1, low, high, high + 1)]
            cells.append(Cell(SETTINGS_FILE, row_id(row), field["name"], found, [False, True, True, False]))
        elif field["name"] == "name":
            cells.append(Cell(SETTINGS_FILE, row_id(row), "name", limits(field), (None, None, None)))
        else:
            setter = by_name(SETTINGS[SETTINGS_READ_BACK[sub_function]]["fields"])
            expected = (*limits(setter[field["name"]]), setter[field["name"]]["scale"])
            cells.append(Cell(SETTINGS_FILE, row_id(row), field["name"], (*limits(field), field["scale"]), expected))

    assert wrong(cells) == []


@pytest.mark.parametrize("sub_function", SETTINGS)
def test_a_count_of_a_setting_is_the_unit_that_the_code_makes_of_it(sub_function: str) -> None:
    row = SETTINGS[sub_function]
    scales = [offset_in_celsius(0, 1), offset_in_celsius(FIRST_CHANNEL, 1)]
    cells = []
    for side in SIDES:
        for field in row[side]:
            expected = (str(Unit.CELSIUS), scales) if field["name"] == "offset" else (None, None)
            there = (field["unit"], field["scale"])
            cells.append(Cell(SETTINGS_FILE, row_id(row), f"{side}.{field['name']}", there, expected))

    assert wrong(cells) == []


def test_function_46h_is_for_the_models_of_its_sub_functions() -> None:
    [row] = [row for row in lint.rows("modbus_functions") if row["function"] == "46"]
    expected: Record = {}
    for setting in SETTINGS.values():
        expected |= setting["models"]
    expected = {profile.model.value: expected[profile.model.value] for profile in M_PROFILES}

    broadcast = any(request.broadcast for request in modbus.REQUESTS if request.sub_function is not None)
    file = "tables/modbus_functions.json"
    cells = [
        Cell(file, "46", "models", row["models"], expected),
        Cell(file, "46", "broadcast", row["broadcast"], broadcast),
    ]

    assert wrong(cells) == []
