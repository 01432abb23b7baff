"""What the data under ``spec/`` promise, checked over every file."""

from __future__ import annotations

import re
from itertools import chain
from typing import TYPE_CHECKING, Any

import pytest
from jsonschema import Draft202012Validator

from tests.spec import lint

if TYPE_CHECKING:
    from pathlib import Path

    from tests.spec.lint import Record

DATA_FILES = [pytest.param(path, id=lint.name(path)) for path in lint.data_files()]
SCHEMA_FILES = [pytest.param(path, id=lint.name(path)) for path in lint.schema_files()]
VECTOR_FILES = [pytest.param(path, id=lint.name(path)) for path in lint.vector_files()]
FORMATS = ("engineering", "percent", "hex")
CR = b"\r"

pytestmark = pytest.mark.no_cover

MODELS = {row["name"]: row for row in lint.rows("models")}
TYPES = {row["code"]: row for row in lint.rows("type_codes")}
COMMANDS = {row["section"]: row for row in lint.rows("dcon_commands")}
SECTIONS = list(COMMANDS)
COMMAND_NAMES = {row["name"]: row for row in COMMANDS.values()}
PREFIXES = {
    "dcon_vectors": r"dcon-2(\.\d+)?",
    "reading_vectors": "reading",
    "legacy_vectors": "legacy",
    "reading_reject_vectors": "rejected",
    "channel_vectors": "channel",
    "checksum_vectors": "checksum",
    "split_vectors": "split",
    "rtu_split_vectors": "rtu-split",
    "modbus_vectors": r"modbus-([0-9A-F]{2}|46-[0-9A-F]{2}|3\.4\.\d|frame)",
    "crc_vectors": "crc",
    "register_vectors": "register",
}


def checksum(body: bytes) -> str:
    return f"{sum(body) & 0xFF:02X}"


def eyes(wire: str | None) -> str | None:
    """The text beside a wire: without its final CR, and bytes outside 20h-7Eh as \\xNN."""
    if wire is None:
        return None
    body = bytes.fromhex(wire).removesuffix(CR)
    return "".join(chr(byte) if 0x20 <= byte <= 0x7E else f"\\x{byte:02x}" for byte in body)


def firmware(text: str) -> tuple[str, int, int]:
    major, minor = text[1:].split(".")
    return text[0], int(major), int(minor)


def has(since: str | None, profile: Record) -> bool:
    """Whether something that is there from a firmware on is there on the profile's."""
    return since is None or profile["firmware"] is None or firmware(profile["firmware"]) >= firmware(since)


def objects(schema: Any) -> list[Record]:
    """Every part of a schema that describes an object."""
    if isinstance(schema, list):
        return list(chain.from_iterable(map(objects, schema)))
    if not isinstance(schema, dict):
        return []
    inner = list(chain.from_iterable(map(objects, schema.values())))
    return [schema, *inner] if schema.get("type") in ("object", ["object", "null"]) else inner


# Every file


@pytest.mark.parametrize("path", DATA_FILES + SCHEMA_FILES)
def test_a_file_fits_its_schema_and_is_canonical(path: Path) -> None:
    assert lint.faults(path) == []


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        (
            ('"ReadConfiguration",', '"ReadConfiguration"'),
            "line .*: expecting ',' delimiter between .*ReadConfiguration",
        ),
        (('"section": "2.10"', '"section": "2.1O"'), "rows: .*: section: '2.1O' does not match"),
        (('"name": "ReadConfiguration"', '"name": 7'), "rows: 7: name: 7 is not of type 'string'"),
        (('  "rows": [', '  "rows":  ['), "not canonical: run python -m tests.spec.lint --fix"),
        (('"title"', '"title": "", "title"'), "a key twice in"),
    ],
    ids=["syntax", "value", "type", "form", "twice"],
)
def test_what_is_wrong_with_a_file_is_said_in_one_line_with_its_place(
    change: tuple[str, str], fault: str, tmp_path: Path
) -> None:
    path = tmp_path / "dcon_commands.json"
    text = (lint.SPEC / "tables" / "dcon_commands.json").read_text(encoding="utf-8")
    assert change[0] in text
    path.write_text(text.replace(*change, 1), encoding="utf-8")

    found = lint.faults(path)

    assert re.match(f"dcon_commands.json: {fault}", found[0])
    assert all("\n" not in line for line in found)


@pytest.mark.parametrize("path", DATA_FILES)
def test_every_column_and_flag_is_explained_and_nothing_else(path: Path) -> None:
    data = lint.load(path)
    columns = set(chain.from_iterable(lint.records(data)))
    flags = set(chain.from_iterable(record.get("flags", []) for record in lint.records(data)))

    assert set(data["notes"]) == columns | flags


@pytest.mark.parametrize("path", SCHEMA_FILES)
def test_a_schema_is_valid_and_every_object_in_it_is_closed(path: Path) -> None:
    schema = lint.load(path)
    Draft202012Validator.check_schema(schema)

    assert [part for part in objects(schema) if not closed(part)] == []


def closed(schema: Record) -> bool:
    """Only the keys it names; or, for a map, only keys of a stated form with values of a stated form."""
    if "propertyNames" in schema:
        return isinstance(schema["additionalProperties"], dict)
    return schema["additionalProperties"] is False


def test_every_schema_has_a_file_and_every_file_a_schema() -> None:
    files = [*lint.data_files(), lint.SPEC / lint.INDEX]

    assert {lint.schema_path(path) for path in files} == set(lint.schema_files())


def test_a_key_named_twice_is_noticed(tmp_path: Path) -> None:
    path = tmp_path / "twice.json"
    path.write_text('{"title": "a", "title": "b"}')

    with pytest.raises(ValueError, match="twice"):
        lint.load(path)


def test_the_canonical_text_has_a_record_a_line() -> None:
    data = {"title": "\u00b0", "notes": {"a": "b"}, "rows": [{"a": [1, 2.5]}, {"a": None}], "none": []}

    assert lint.canonical(data) == (
        '{\n  "title": "\u00b0",\n  "notes": {"a": "b"},\n  "rows": [\n'
        '    {"a": [1, 2.5]},\n    {"a": null}\n  ],\n  "none": []\n}\n'
    )


def test_what_is_too_long_for_a_line_has_a_line_for_each_item() -> None:
    long = "x" * (lint.LONGEST - 30)
    data = {"notes": {"a": "b"}, "rows": [{"a": [1, {"b": long}], "c": "d"}], "last": {"e": [long, long]}}

    assert lint.canonical(data).replace(long, "...") == (
        '{\n  "notes": {"a": "b"},\n  "rows": [\n    {\n      "a": [1, {"b": "..."}],\n      "c": "d"\n    }\n  ],\n'
        '  "last": {\n    "e": [\n      "...",\n      "..."\n    ]\n  }\n}\n'
    )


@pytest.mark.parametrize(("characters", "longest"), [(978, lint.LONGEST), (979, 993)])
def test_a_line_has_as_many_characters_as_may_be(characters: int, longest: int) -> None:
    found = lint.canonical({"rows": [{"a": "x" * characters, "b": 1}, {}]})

    assert max(map(len, found.splitlines())) == longest


@pytest.mark.parametrize("path", DATA_FILES + SCHEMA_FILES)
def test_no_line_is_too_long_unless_a_text_is_so_by_itself(path: Path) -> None:
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if len(line) > lint.LONGEST]

    assert [line for line in lines if not re.fullmatch(r' +("\w+": )?"[^"]{900,}",?', line)] == []


def test_keys_are_put_in_the_order_of_the_schema() -> None:
    inner = {"oneOf": [{"properties": {"type": {"const": kind}, kind: {}}} for kind in ("a", "b")]}
    schema = {"properties": {"x": {}, "y": {"items": {"$ref": "#/$defs/inner"}}}, "$defs": {"inner": inner}}

    value = lint.ordered({"y": [{"b": 1, "type": "b"}], "x": 2}, schema)

    assert str(value) == "{'x': 2, 'y': [{'type': 'b', 'b': 1}]}"


def test_a_file_out_of_form_is_rewritten_once(tmp_path: Path) -> None:
    path = tmp_path / "type_codes.json"
    path.write_text(lint.canonical(lint.load(lint.SPEC / "tables" / path.name)).replace("\n    {", "{"))

    assert [lint.fix(path), lint.fix(path)] == [True, False]
    assert path.read_bytes() == (lint.SPEC / "tables" / path.name).read_bytes()


# Tables


def test_the_full_scale_table_has_every_type_in_every_format_once() -> None:
    cells = [(row["code"], row["format"]) for row in lint.rows("full_scale")]

    assert cells == [(code, form) for code in TYPES for form in FORMATS]


@pytest.mark.parametrize("code", TYPES)
def test_the_two_tables_of_types_print_the_same_ends(code: str) -> None:
    row = TYPES[code]
    engineering, percent, hexadecimal = (cell for cell in lint.rows("full_scale") if cell["code"] == code)

    assert (row["percent_max"], row["percent_min"]) == (percent["plus_fs"], percent["minus_fs"])
    assert (row["hex_max"], row["hex_min"]) == (hexadecimal["plus_fs"], hexadecimal["minus_fs"])
    for end, limit in ((engineering["plus_fs"], row["maximum"]), (engineering["minus_fs"], row["minimum"])):
        assert (float(end), len(end), len(end.partition(".")[2])) == (limit, 7, row["engineering_decimals"])


@pytest.mark.parametrize("code", TYPES)
def test_a_type_has_consistent_limits(code: str) -> None:
    row = TYPES[code]
    counts = row["modbus_counts_per_unit"]

    assert row["max"] == max(abs(row["minimum"]), abs(row["maximum"]))
    assert (row["modbus_min"], row["modbus_max"]) == (row["minimum"] * counts, row["maximum"] * counts)
    assert (row["unit"] == "degC") == (row["thermocouple"] is not None)


def test_the_type_codes_are_all_there_in_order() -> None:
    assert list(TYPES) == [f"{code:02X}" for code in range(0x1D)]


@pytest.mark.parametrize("model", MODELS)
def test_a_model_agrees_with_itself(model: str) -> None:
    row = MODELS[model]
    letters = [TYPES[code]["thermocouple"] for code in row["types"]]

    assert row["thermocouples"] == [letter for letter in letters if letter is not None]
    assert (row["fast_sampling_rate"] is not None) == row["fast_mode"]
    assert row["fast_mode"] or not row["fast_mode_default"]
    assert row["series"] in model
    assert ("modbus" in row["protocols"]) == model.startswith("M-")
    assert row["default_type"] is None or row["types"].get(row["default_type"], "no") is None
    assert row["mask_digits"] == (2 if row["channels"] == 8 else 4)
    assert list(row["types"]) == sorted(row["types"])


@pytest.mark.parametrize("table", ["dcon_commands", "modbus_functions", "module_settings"])
def test_a_row_for_all_models_does_not_list_them(table: str) -> None:
    rows = lint.load(lint.SPEC / "tables" / f"{table}.json")["rows"]
    every = lint.all_models("dcon" if table == "dcon_commands" else "modbus")

    assert [row["name"] for row in rows if row["models"] == every] == []
    assert [row["name"] for row in rows if row["models"] == "all"] != []


def test_the_commands_are_one_a_section_in_order() -> None:
    sections = [row["section"] for row in lint.rows("dcon_commands")]

    assert sections == [f"2.{number}" for number, _ in enumerate(sections, 1)]
    assert len(COMMAND_NAMES) == len(sections)


def stands_once(field: Record, syntax: str) -> bool:
    """Whether the notation can mean one place only: the address behind the leading character, the others after it."""
    notation: str = field["notation"]
    addressed = syntax[1:3] == "AA"
    if field["name"] == "address":
        return addressed and notation == "AA"
    return syntax[3 if addressed else 1 :].count(notation) == 1


@pytest.mark.parametrize("section", SECTIONS)
def test_a_command_agrees_with_itself(section: str) -> None:
    row = COMMANDS[section]

    assert list(row["models"]) == [model for model in MODELS if model in row["models"]]
    assert (row["response"] is None) == (row["response_syntax"] is None) == (row["response_fields"] == [])
    assert [field for field in row["fields"] if not stands_once(field, row["syntax"])] == []
    assert [field for field in row["response_fields"] if not stands_once(field, row["response_syntax"])] == []


def test_a_response_has_one_shape_wherever_it_stands() -> None:
    shapes = {
        (row["response"], row["response_syntax"], tuple(field["name"] for field in row["response_fields"]))
        for row in COMMANDS.values()
    }

    assert len(shapes) == len({response for response, _, _ in shapes})


def test_commands_with_one_syntax_are_distinguished_by_the_model() -> None:
    by_syntax: dict[str, list[set[str]]] = {}
    for row in COMMANDS.values():
        by_syntax.setdefault(row["syntax"], []).append(set(row["models"]))
    shared = {syntax: groups for syntax, groups in by_syntax.items() if len(groups) > 1}

    assert sorted(shared) == ["$AA0Ci", "$AAA"]
    assert [first & second for first, second in shared.values()] == [set(), set()]


def test_channel_types_of_their_own_are_where_the_command_for_them_is() -> None:
    settable = COMMANDS["2.15"]["models"]
    expected = {model: row["individually_configurable"] for model, row in MODELS.items()}

    assert {model: settable[model] or "always" for model in settable} == {
        model: since for model, since in expected.items() if since is not None
    }


# Every vector


def test_vector_ids_are_unique() -> None:
    ids = [vector["id"] for _, vector in lint.vectors()]

    assert sorted(identifier for identifier in set(ids) if ids.count(identifier) > 1) == []


@pytest.mark.parametrize("path", VECTOR_FILES)
def test_a_vector_id_is_a_name_and_not_a_position(path: Path) -> None:
    prefix = PREFIXES[lint.schema_path(path).stem]
    shape = re.compile(rf"{prefix}-(?!\d{{1,3}}$)[A-Za-z0-9.+-]+")

    assert [vector["id"] for vector in lint.records(lint.load(path)) if not shape.fullmatch(vector["id"])] == []


def test_every_kind_of_vector_has_a_file() -> None:
    assert {lint.schema_path(path).stem for path in lint.vector_files()} == set(PREFIXES)


# DCON vectors


@pytest.mark.parametrize("section", SECTIONS)
def test_a_section_has_its_file_with_an_answer_and_a_fault(section: str) -> None:
    row = COMMANDS[section]
    paths = [path for path in lint.vector_files("dcon") if path.name.startswith(f"{section}-")]
    found = [lint.load(path) for path in paths]
    wanted = "silence" if row["response"] is None else "response"
    answered = [
        vector
        for data in found
        for vector in data["vectors"]
        if vector["outcome"] == wanted and vector["command"]["type"] == row["name"]
    ]
    outcomes = {vector["outcome"] for data in found for vector in data["vectors"]}

    assert [data["section"] for data in found] == [section]
    assert answered != []
    assert outcomes & {"refused", "reject"} != set()


def present(vector: Record) -> tuple[bool, ...]:
    return tuple(vector[key] is not None for key in ("command", "response", "response_wire", "fault"))


@pytest.mark.parametrize("path", lint.vector_files("dcon"), ids=lint.name)
def test_a_vector_has_what_its_outcome_needs(path: Path) -> None:
    shapes = {
        "response": {(True, True, True, False)},
        "refused": {(True, True, True, False)},
        "silence": {(True, False, False, False)},
        "reject": {(False, False, False, True), (True, False, True, True)},
    }
    records = lint.records(lint.load(path))

    assert [vector["id"] for vector in records if present(vector) not in shapes[vector["outcome"]]] == []
    assert [
        vector["id"]
        for vector in records
        if vector["response"] is not None
        and (vector["response"]["type"] == "Refused") != (vector["outcome"] == "refused")
    ] == []


@pytest.mark.parametrize("path", lint.vector_files("dcon"), ids=lint.name)
def test_a_text_says_what_its_wire_says(path: Path) -> None:
    records = lint.records(lint.load(path))

    for side in ("command", "response"):
        assert [vector["id"] for vector in records if eyes(vector[f"{side}_wire"]) != vector[f"{side}_text"]] == []


def sealed(wire: str | None, profile: Record) -> bool:
    """Whether a frame ends in one CR, and its checksum is right where the profile has checksums."""
    if wire is None:
        return True
    frame = bytes.fromhex(wire)
    whole = frame.count(CR) == 1 and frame.endswith(CR)
    return whole and (not profile["checksum"] or checksum(frame[:-3]).encode() == frame[-3:-1])


@pytest.mark.parametrize("path", lint.vector_files("dcon"), ids=lint.name)
def test_a_frame_that_is_accepted_has_a_right_checksum(path: Path) -> None:
    records = lint.records(lint.load(path))
    commands = [vector for vector in records if vector["command"] is not None]
    responses = [vector for vector in records if vector["response"] is not None]

    assert [vector["id"] for vector in commands if not sealed(vector["command_wire"], vector["profile"])] == []
    assert [vector["id"] for vector in responses if not sealed(vector["response_wire"], vector["profile"])] == []


def rejected(vector: Record) -> str | None:
    wire: str | None = vector["command_wire" if vector["response_wire"] is None else "response_wire"]
    return wire


@pytest.mark.parametrize("path", lint.vector_files("dcon"), ids=lint.name)
def test_a_checksum_is_at_fault_where_and_only_where_it_is_wrong(path: Path) -> None:
    before = {"length", "terminator", "character", "leading"}
    records = [vector for vector in lint.records(lint.load(path)) if vector["outcome"] == "reject"]
    wrong = [vector for vector in records if not sealed(rejected(vector), vector["profile"])]

    assert [vector["id"] for vector in records if vector["fault"] == "checksum" and vector not in wrong] == []
    assert [vector["id"] for vector in wrong if vector["fault"] not in {"checksum", *before}] == []


@pytest.mark.parametrize("path", lint.vector_files("dcon"), ids=lint.name)
def test_a_profile_has_one_type_for_every_channel(path: Path) -> None:
    def channels(profile: Record) -> int:
        model = MODELS[profile["model"]]
        count: int = model["single_ended_channels"] if profile["single_ended"] else model["channels"]
        return count

    records = lint.records(lint.load(path))

    assert [
        vector["id"] for vector in records if len(vector["profile"]["type_codes"]) != channels(vector["profile"])
    ] == []


@pytest.mark.parametrize("path", lint.vector_files("dcon"), ids=lint.name)
def test_a_profile_has_only_types_that_its_model_has(path: Path) -> None:
    def supported(profile: Record) -> bool:
        types = MODELS[profile["model"]]["types"]
        codes = {f"{code:02X}" for code in profile["type_codes"]}
        return codes <= set(types) and all(has(types[code], profile) for code in codes)

    records = lint.records(lint.load(path))

    assert [vector["id"] for vector in records if not supported(vector["profile"])] == []


@pytest.mark.parametrize("path", lint.vector_files("dcon"), ids=lint.name)
def test_a_command_that_is_answered_is_one_of_the_model(path: Path) -> None:
    def offered(vector: Record) -> bool:
        models = COMMAND_NAMES[vector["command"]["type"]]["models"]
        profile = vector["profile"]
        return profile["model"] in models and has(models[profile["model"]], profile)

    answered = [vector for vector in lint.records(lint.load(path)) if vector["outcome"] in {"response", "refused"}]

    assert [vector["id"] for vector in answered if not offered(vector)] == []


@pytest.mark.parametrize("path", lint.vector_files("dcon"), ids=lint.name)
def test_a_command_is_answered_by_its_own_response(path: Path) -> None:
    records = [vector for vector in lint.records(lint.load(path)) if vector["outcome"] == "response"]

    assert [
        vector["id"]
        for vector in records
        if vector["response"]["type"] != COMMAND_NAMES[vector["command"]["type"]]["response"]
    ] == []


# Readings


def test_every_type_has_both_of_its_ends_in_every_format() -> None:
    texts = {
        (vector["type_code"], vector["format"], vector["text"])
        for path, vector in lint.vectors("readings")
        if path.stem in FORMATS
    }
    ends = {
        (row["code"], row["format"], row[end]) for row in lint.rows("full_scale") for end in ("plus_fs", "minus_fs")
    }

    assert sorted(ends - texts) == []


@pytest.mark.parametrize("form", FORMATS)
def test_a_reading_has_a_value_when_it_is_ok_and_the_unit_of_its_type(form: str) -> None:
    found = lint.records(lint.load(lint.SPEC / "vectors" / "readings" / f"{form}.json"))

    assert [vector["id"] for vector in found if vector["format"] != form] == []
    assert [vector["id"] for vector in found if (vector["value"] is None) == (vector["status"] == "ok")] == []
    assert [vector["id"] for vector in found if vector["unit"] != TYPES[vector["type_code"]]["unit"]] == []


def test_a_legacy_line_is_its_fields_one_after_the_other() -> None:
    found = [vector for _, vector in lint.vectors("readings/legacy.json")]

    assert [vector["id"] for vector in found if "".join(vector["values"]) != vector["line"]] == []
    assert [vector["id"] for vector in found if len(vector["values"]) != len(vector["statuses"])] == []


# Frames


def test_a_checksum_is_the_sum_of_the_body() -> None:
    found = [vector for _, vector in lint.vectors("frames/checksums.json")]

    assert [vector["id"] for vector in found if checksum(bytes.fromhex(vector["body"])) != vector["checksum"]] == []


def parts(vector: Record) -> list[str]:
    return [event.get("frame", event.get("noise")) for event in vector["events"]]


def test_a_stream_is_its_frames_its_noise_and_its_rest() -> None:
    found = [vector for _, vector in lint.vectors("frames/split.json")]

    assert [vector["id"] for vector in found if "".join(parts(vector)) + vector["rest"] != vector["stream"]] == []


def test_a_frame_split_from_a_stream_is_whole_and_right() -> None:
    def right(event: Record, *, checked: bool) -> bool:
        profile = {"checksum": checked}
        if event.get("fault") == "checksum":
            return checked and not sealed(event["noise"], profile)
        return "noise" in event or (sealed(event["frame"], profile) and len(event["frame"]) <= 512)

    found = [vector for _, vector in lint.vectors("frames/split.json")]

    assert [
        vector["id"]
        for vector in found
        if not all(right(event, checked=vector["checksum"]) for event in vector["events"])
    ] == []
