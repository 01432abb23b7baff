"""The two transcriptions of the manual, ``spec/`` and ``src/``, say the same: both ways, row by row."""

import re
from itertools import product
from pathlib import Path
from typing import Any

import pytest
from attrs import fields

from i7000 import (
    BaudRate,
    CharacterFormat,
    CjcUpdate,
    DataFormat,
    DecodeError,
    EncodeError,
    Fault,
    Filter,
    Firmware,
    Model,
    Profile,
    Protocol,
    Reading,
    Status,
    TypeCode,
    dcon,
)
from i7000.availability import Availability
from i7000.dcon.codec import COMMANDS
from i7000.dcon.parts import Part
from i7000.models import CONFIGURABLE
from i7000.readings import decode_engineering_word, decode_field, encode_engineering_word, encode_field
from tests.each import each
from tests.spec.lint import Record, rows
from tests.vectors import parameters, profile_of

MODEL_ROWS = {row["name"]: row for row in rows("models")}
COMMAND_ROWS = {row["name"]: row for row in rows("dcon_commands")}
TYPE_ROWS = {row["code"]: row for row in rows("type_codes")}


SRC = Path(__file__).parents[1] / "src" / "i7000"


def as_text(firmware: Firmware | None) -> str | None:
    return None if firmware is None else str(firmware)


# --- errata -----------------------------------------------------------------------------------------------------------


def cited(folder: Path) -> set[str]:
    """The errata that docstrings name: E5 is E05."""
    texts = "".join(path.read_text(encoding="utf-8") for path in folder.rglob("*.py"))
    return {f"E{int(number):02d}" for number in re.findall(r"(?<!noqa: )\bE(\d{1,3})\b", texts)}


def test_every_erratum_that_the_code_cites_is_one() -> None:
    assert cited(SRC) - {row["id"] for row in rows("errata")} == set()


def test_the_model_of_a_module_cites_the_errata_that_it_relies_on() -> None:
    assert {row["id"] for row in rows("errata") if "device" in row["used_by"]} - cited(SRC / "device") == set()


# --- models -----------------------------------------------------------------------------------------------------------


def test_the_models_are_those_of_the_table() -> None:
    assert list(MODEL_ROWS) == [model.value for model in Model]


@pytest.mark.parametrize("model", Model, ids=lambda model: model.value)
def test_a_model_is_what_its_row_says(model: Model) -> None:
    row = MODEL_ROWS[model.value]
    by_command = Availability.SERIES_7017Z not in Profile(model).refused
    individually: str | None = None
    if model in CONFIGURABLE:
        individually = as_text(CONFIGURABLE[model]) or "always"

    assert {key: value for key, value in row.items() if key != "errata"} == {
        "name": model.value,
        "key": model.name,
        "series": model.series,
        "protocols": [{"DCON": "dcon", "MODBUS_RTU": "modbus"}[it.name] for it in Protocol if it in model.protocols],
        "channels": model.channels,
        "single_ended_channels": model.single_ended_channels,
        "single_ended_by_command": by_command,
        "default_type": None if model.default_type is None else f"{model.default_type:02X}",
        "types": {f"{code:02X}": as_text(firmware) for code, firmware in sorted(model.type_codes.items())},
        "individually_configurable": individually,
        "uses_tt": model.type_by_configuration,
        "mixed_types": individually if model.type_by_configuration else "ignored",
        "fast_mode": model.fast_mode,
        "fast_mode_default": model.fast_mode_default,
        "sampling_rate": model.sampling_rate,
        "fast_sampling_rate": model.fast_sampling_rate,
        "thermocouples": [code.thermocouple for code in TypeCode if code.thermocouple in model.thermocouples],
        "cjc": model.cjc,
        "open_wire_detection": model.open_wire_detection,
        "mask_digits": Profile(model).mask_digits,
        "mask_digits_single_ended": Profile(model, single_ended=True).mask_digits if by_command else None,
        "filter": as_text(model.filter_from) or True,
        "character_formats_from": str(model.character_formats_from),
    }


# --- commands ---------------------------------------------------------------------------------------------------------


def test_the_commands_are_those_of_the_table() -> None:
    assert list(COMMAND_ROWS) == [command.__name__ for command in COMMANDS]


def field_records(message: Any) -> list[tuple[str, str]]:
    return [(field.name, field.type.__metadata__[0].notation) for field in fields(message)]


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command.__name__)
def test_a_command_is_what_its_row_says(command: Any) -> None:
    row = COMMAND_ROWS[command.__name__]
    response = getattr(command, "response", None)

    assert (row["section"], row["syntax"]) == (command.section, command.syntax)
    assert [(it["name"], it["notation"]) for it in row["fields"]] == field_records(command)
    assert row["response"] == (None if response is None else response.__name__)
    assert row["response_syntax"] == (None if response is None else response.syntax)
    assert [(it["name"], it["notation"]) for it in row["response_fields"]] == (
        [] if response is None else field_records(response)
    )


@pytest.mark.parametrize(("command", "side"), list(product(COMMANDS, ("fields", "response_fields"))))
def test_a_field_has_the_digits_of_its_row(command: Any, side: str) -> None:
    message = command if side == "fields" else getattr(command, "response", None)
    if message is None:
        assert COMMAND_ROWS[command.__name__][side] == []
        return
    profiles = [Profile(model) for model in Model] + [Profile(Model.M_7017Z, single_ended=True)]
    profiles = [profile for profile in profiles if command.availability not in profile.refused]
    parts: dict[str, Part] = {field.name: field.type.__metadata__[0] for field in fields(message)}

    for it in COMMAND_ROWS[command.__name__][side]:
        part = parts[it["name"]]
        if part.width == "rest" or it["digits"] is None:
            assert part.width in ("rest", 5, 7)
            continue
        width = len(part.notation) if part.width is None else part.width
        widths = {getattr(profile, width) if isinstance(width, str) else width for profile in profiles}
        told = it["digits"] if isinstance(it["digits"], list) else [it["digits"]]
        assert set(told) == widths


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command.__name__)
def test_the_models_that_have_a_command_are_those_of_its_row(command: Any) -> None:
    gates = command.availability.gates

    assert COMMAND_ROWS[command.__name__]["models"] == {
        model.value: as_text(gates[model]) for model in Model if model in gates
    }


@pytest.mark.parametrize("model", Model, ids=lambda model: model.value)
def test_a_profile_allows_what_the_rows_say_for_every_firmware_that_matters(model: Model) -> None:
    limits = {Firmware(it) for row in COMMAND_ROWS.values() for it in row["models"].values() if it}
    versions = sorted(
        limits | {Firmware("A1.0"), Firmware("B2.9"), Firmware("B3.8"), Firmware("B4.1"), Firmware("B9.9")}
    )

    for firmware in versions:
        profile = Profile(model, firmware=firmware, type_codes=())
        told = {
            row["section"]
            for row in COMMAND_ROWS.values()
            if model.value in row["models"]
            and (row["models"][model.value] is None or firmware >= Firmware(row["models"][model.value]))
        }
        assert told == {command.section for command in COMMANDS if command.availability not in profile.refused}


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command.__name__)
def test_the_pause_owed_after_a_command_is_that_of_its_row(command: Any) -> None:
    pause = COMMAND_ROWS[command.__name__]["pause"]
    message = command() if issubclass(command, dcon.Broadcast) else object.__new__(command)

    for firmware in (None, Firmware("B2.6"), Firmware("B2.7")):
        told = 0 if pause is None else pause["seconds"]
        if pause is not None and pause["firmware_to"] is not None:
            told = told if firmware is not None and firmware <= Firmware(pause["firmware_to"]) else 0
        profile = Profile(Model.M_7019R, firmware=firmware, type_codes=())
        assert told == dcon.pause_after(message, profile)


# --- type codes and settings ------------------------------------------------------------------------------------------


def test_the_type_codes_are_those_of_the_table() -> None:
    assert list(TYPE_ROWS) == [f"{code:02X}" for code in TypeCode]


@pytest.mark.parametrize("code", TypeCode, ids=lambda code: f"{code:02X}")
def test_a_type_code_is_what_its_row_says(code: TypeCode) -> None:
    row = TYPE_ROWS[f"{code:02X}"]

    assert row["unit"] == code.unit
    assert (row["minimum"], row["maximum"], row["max"]) == (code.minimum, code.maximum, code.full_scale)
    assert row["thermocouple"] == (code.thermocouple or None)
    assert row["engineering_decimals"] == code.decimals
    assert row["hex_signed"] == code.signed_hex
    assert row["modbus_counts_per_unit"] == 10**code.modbus_decimals
    for end, value in (("min", code.minimum), ("max", code.maximum)):
        reading = Reading(value, code.unit)
        assert row[f"percent_{end}"] == encode_field(reading, code, DataFormat.PERCENT)
        assert row[f"modbus_{end}"] & 0xFFFF == encode_engineering_word(reading, code)
        assert reading == decode_engineering_word(row[f"modbus_{end}"] & 0xFFFF, code)


PRINTED_ONE_COUNT_AWAY = {("0F", "E6D0"), ("15", "E56B")}
"""E51: what the rule of A.5 makes of these two printed cells is the word one below."""


@pytest.mark.parametrize("row", rows("full_scale"), ids=lambda row: f"{row['code']}-{row['format']}")
def test_a_printed_full_scale_is_what_the_rule_computes(row: Record) -> None:
    code, data_format = TypeCode(int(row["code"], 16)), DataFormat[row["format"].upper()]

    for value, printed in ((code.maximum, row["plus_fs"]), (code.minimum, row["minus_fs"])):
        computed = encode_field(Reading(value, code.unit), code, data_format)
        if (row["code"], printed) in PRINTED_ONE_COUNT_AWAY:
            assert int(printed, 16) - 1 == int(computed, 16)
            assert "E51" in row["errata"]
        else:
            assert printed == computed


def test_the_codes_of_settings_are_those_of_the_table() -> None:
    codes: dict[str, dict[int, Any]] = {}
    for row in rows("settings"):
        if row["code"] is not None:
            codes.setdefault(row["setting"], {})[row["code"]] = row["value"]

    assert codes["baud_rate"] == {int(it): it.bits_per_second for it in BaudRate}
    assert codes["character_format"] == {int(it): it.name for it in CharacterFormat}
    assert list(codes["data_format"]) == [int(it) for it in DataFormat]
    assert list(codes["filter"]) == [int(it.value) for it in Filter]
    assert list(codes["protocol"]) == [int(it) for it in Protocol]
    assert list(codes["cjc_update"]) == [int(it) for it in CjcUpdate]


def test_the_sentinels_of_the_table_are_read_as_what_they_are_called() -> None:
    seen = 0
    for row in rows("settings"):
        if row["setting"] != "sentinel" or row["format"] not in ("engineering", "percent", "hex"):
            continue
        legacy = row["until"] is not None
        for code in row["types"] or [f"{it:02X}" for it in TypeCode]:
            reading = decode_field(
                row["value"], TypeCode(int(code, 16)), DataFormat[row["format"].upper()], legacy=legacy
            )
            assert Status(row["name"]) is reading.status
            seen += 1

    assert seen > 200


# --- readings ---------------------------------------------------------------------------------------------------------


def reading_cases() -> list[Any]:
    return [case for name in ("engineering", "percent", "hex") for case in parameters(f"vectors/readings/{name}.json")]


@each("vector", reading_cases())
def test_a_reading_is_what_the_vector_says(vector: Record) -> None:
    code, data_format = TypeCode(int(vector["type_code"], 16)), DataFormat[vector["format"].upper()]
    reading = Reading(vector["value"], code.unit, Status(vector["status"]))

    assert vector["unit"] == code.unit
    if vector["direction"] != "encode":
        assert reading == decode_field(vector["text"], code, data_format, lenient=True)
    if vector["direction"] != "encode" and "lenient" in vector["flags"]:
        with pytest.raises(DecodeError) as caught:
            decode_field(vector["text"], code, data_format)
        assert caught.value.fault is Fault.NUMBER
    elif vector["direction"] != "encode":
        assert reading == decode_field(vector["text"], code, data_format)
    if vector["direction"] != "decode":
        assert vector["text"] == encode_field(reading, code, data_format)


ONLY_READ = [case for case in reading_cases() if case.values[0]["direction"] == "decode"]


@each("vector", [case for case in ONLY_READ if case.values[0]["format"] != "hex"])
def test_a_text_that_is_only_read_is_not_what_its_reading_is_written_as(vector: Record) -> None:
    code, data_format = TypeCode(int(vector["type_code"], 16)), DataFormat[vector["format"].upper()]

    try:
        written = encode_field(Reading(vector["value"], code.unit, Status(vector["status"])), code, data_format)
    except EncodeError:
        return
    assert written != vector["text"]


@each("vector", parameters("vectors/readings/legacy.json"))
def test_a_line_of_old_firmware_is_split_as_the_vector_says(vector: Record) -> None:
    profile = profile_of(vector["profile"])
    frame = dcon.seal(b">" + vector["line"].encode(), checksum=profile.checksum)

    response = dcon.decode_response(frame, dcon.ReadAnalogInputs(0x01), profile)

    assert dcon.AnalogInputs(tuple(vector["values"])) == response
    assert isinstance(response, dcon.AnalogInputs)
    assert vector["statuses"] == [reading.status.value for reading in dcon.readings(response, profile, lenient=True)]
    assert frame == dcon.encode(response, profile)
