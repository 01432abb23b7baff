"""The pages of ``spec/``: links that lead somewhere, and examples that are what the package makes of the bytes."""

from __future__ import annotations

import json
import re
from itertools import chain
from typing import Any

import pytest

from i7000 import (
    DataFormat,
    DecodeError,
    ModbusDataFormat,
    Model,
    Profile,
    Reading,
    TypeCode,
    dcon,
    modbus,
)
from i7000.readings import decode_engineering_word, decode_field, decode_word
from tests.crc import crc
from tests.device.driver import bench
from tests.spec import lint
from tests.spec.pages import PAGES, anchors, page, section, tables

START = "README.md"
NAMES = [path.name for path in PAGES]
WITH_EXAMPLES = [name for name in NAMES if name not in (START, "CHANGELOG.md")]


@pytest.mark.parametrize("name", NAMES)
def test_every_link_leads_to_a_page_and_a_heading(name: str) -> None:
    links = re.findall(r"\]\(([^)#]*)#?([^)]*)\)", page(name))

    assert [target for target, _ in links if target not in NAMES or target == name] == []
    assert [part for target, part in links if part and part not in anchors(page(target))] == []


def test_every_page_is_linked_from_the_first() -> None:
    linked = set(re.findall(r"\]\((\w+\.md)", page(START)))

    assert linked == set(WITH_EXAMPLES)


def test_the_numbers_of_rows_are_those_of_the_index() -> None:
    files = json.loads((lint.SPEC / "index.json").read_text("utf-8"))["files"]
    stated = re.findall(r"^\| `([a-z_/]+)(?:<.*)?\.json` \| (\d+) \|", page(START), re.MULTILINE)

    assert len(stated) == 8
    for start, rows in stated:
        assert int(rows) == sum(file["records"] for file in files if file["name"].startswith(start)), start


@pytest.mark.parametrize("name", WITH_EXAMPLES)
def test_every_page_has_an_example(name: str) -> None:
    assert section(name, "## Example")


def described(found: list[list[str]]) -> dict[str, str]:
    """The fields that an example names, in words."""
    return {row[-2]: row[-1] for row in found if row[-2]}


def wire_of(found: list[list[str]]) -> bytes:
    return bytes.fromhex("".join(row[0] for row in found))


def test_the_example_of_dcon_is_what_the_codec_reads_and_writes() -> None:
    sent, answered, *_ = tables(section("dcon.md", "## Example"))
    profile = Profile(Model.I_7018, type_codes=(TypeCode.K,) * 8, checksum=True)

    command = dcon.decode_command(wire_of(sent), profile)
    response = dcon.decode_response(wire_of(answered), dcon.ReadConfiguration(1), profile)

    assert command == dcon.ReadConfiguration(1)
    assert described(sent) == command.describe()
    assert described(answered) == response.describe()
    for row in (*sent, *answered):
        assert row[1].encode() == bytes.fromhex(row[0]).strip(b"\r")


def test_the_bits_of_the_example_of_dcon_are_those_of_the_settings() -> None:
    text = section("dcon.md", "## Example").rpartition("|\n")[2]
    rows = {row["key"]: row for row in lint.rows("settings")}
    named = {key: rows[key]["code"] << rows[key]["low_bit"] for key in re.findall(r"`([A-Z][A-Z0-9_]{2,})`", text)}

    assert sum(value for key, value in named.items() if rows[key]["where"].startswith("CC")) == 0x06
    assert sum(value for key, value in named.items() if rows[key]["where"].startswith("FF")) == 0x40
    assert len(named) == 6


def test_the_example_of_modbus_is_what_the_codec_reads_and_writes() -> None:
    sent, answered = tables(section("modbus.md", "## Example"))
    profile = Profile(Model.M_7019R)

    request = modbus.decode_request(wire_of(sent), profile)
    response = modbus.decode_response(wire_of(answered), modbus.ReadInputRegisters(1, 0, 3), profile)

    assert request == modbus.ReadInputRegisters(1, 0, 3)
    assert described(sent) == request.describe()
    assert described(answered) == response.describe()


READINGS = tables(section("readings.md", "## Example"))[0]


def read(field: str, code: TypeCode, form: str) -> Reading:
    if form == "modbus_engineering":
        return decode_engineering_word(int(field, 16), code)
    return (
        decode_word(int(field, 16), code)
        if form == "modbus_hex"
        else decode_field(field, code, DataFormat[form.upper()])
    )


@pytest.mark.parametrize("row", READINGS, ids=lambda row: "-".join(row[:3]))
def test_the_examples_of_readings_are_what_the_package_reads(row: list[str]) -> None:
    field, name, form, value, unit, status = row
    reading = read(field, TypeCode[name], form)

    assert (str(reading.unit), reading.status.value) == (unit, status)
    assert (reading.value is None) == (value == "")
    assert reading.value is None or reading.value == pytest.approx(float(value), rel=1e-9)


def test_the_words_of_the_example_of_modbus_are_among_those_of_readings() -> None:
    words = described(tables(section("modbus.md", "## Example"))[1])["values"].split()

    assert [row[0] for row in READINGS if row[2] == "modbus_engineering"] == words


def test_the_example_of_readings_counts_as_it_says() -> None:
    text = section("readings.md", "## Example").rpartition("|\n")[2]

    assert "16384 x 10 / 32767 is 5.00015" in text
    assert round(16384 * 10 / 32767, 5) == 5.00015
    assert "4 + 32768 x 16 / 65535 is 12.00012" in text
    assert round(4 + 32768 * 16 / 65535, 5) == 12.00012


def test_the_examples_of_maps_are_what_the_map_reads_and_writes() -> None:
    profile = Profile(Model.M_7019R, modbus_data_format=ModbusDataFormat.ENGINEERING)
    registers = modbus.RegisterMap(profile)
    written, asked, answered, coil = tables(section("maps.md", "## Example"))[0]

    def sealed(pdu: str) -> bytes:
        frame = b"\x01" + bytes.fromhex(pdu)
        return frame + crc(frame)

    assert all(registers.find(row[1]).number == row[2] for row in (written, asked, answered, coil))
    assert modbus.decode_request(sealed(written[0]), profile) == registers.write(1, written[1], 10.0)
    assert written[3] == "10 s: 100 counts of 0.1 s"
    request = modbus.decode_request(sealed(asked[0]), profile)
    assert request == registers.read(1, asked[1])
    response = modbus.decode_response(sealed(answered[0]), modbus.ReadHoldingRegisters(1, 490, 1), profile)
    assert isinstance(response, modbus.HoldingRegisters)
    assert registers.decode(answered[1], response.values) == -2.5
    assert answered[3] == "-2.5 degC: -250 counts of 0.01 degC"
    assert modbus.decode_request(sealed(coil[0]), profile) == registers.write(1, coil[1], ModbusDataFormat.ENGINEERING)


def test_the_example_of_behaviour_is_the_story_and_what_a_module_does() -> None:
    rows = tables(section("behaviour.md", "## Example"))[0]
    (name,) = re.findall(r"`(story-\S+)`", section("behaviour.md", "## Example"))
    (story,) = (story for story in lint.stories() if story["id"] == name)
    module = bench(Model(story["profile"]["model"]), address=story["profile"]["address"])

    assert [float(row[0]) for row in rows] == [step["at"] for step in story["steps"]]
    for (at, sent, answered, _), step in list(zip(rows, story["steps"], strict=True))[1:]:
        assert (sent, answered) == (step["send"]["text"], step["expect"]["text"])
        module.wait(1000 + float(at) - module.now)
        assert module.say(sent) == answered


def snippets(name: str) -> list[Any]:
    """The records that the example of a page shows."""
    blocks = re.findall(r"```json\n(.*?)```", section(name, "## Example"), re.DOTALL)
    decoder, found = json.JSONDecoder(), []
    for block in blocks:
        at = 0
        while at < len(block.rstrip()):
            record, at = decoder.raw_decode(block, at)
            found.append(record)
            at += len(block[at:]) - len(block[at:].lstrip())
    return found


RECORDS = {
    "stories.md": [*chain.from_iterable(story["steps"] for story in lint.stories())],
    "runner.md": [vector for _, vector in lint.vectors("dcon")],
    "checks.md": [row for path in lint.check_files() for row in lint.records(lint.load(path))],
}


@pytest.mark.parametrize("name", RECORDS)
def test_the_records_of_an_example_stand_in_the_data(name: str) -> None:
    shown = snippets(name)

    assert shown != []
    assert [record for record in shown if not any(record.items() <= it.items() for it in RECORDS[name])] == []


def test_the_bytes_of_the_other_examples_are_the_text_beside_them() -> None:
    for name in ("stories.md", "checks.md"):
        pairs = re.findall(r"`((?:[0-9a-f]{2} )+0d)`,\swhich\sis\s`(\S+)`\sand\sCR", section(name, "## Example"))
        assert pairs != []
        assert [pair for pair in pairs if bytes.fromhex(pair[0]) != pair[1].encode() + b"\r"] == []


def test_the_calls_of_the_example_of_a_runner_are_those_of_its_vector() -> None:
    [vector] = snippets("runner.md")
    [rows] = tables(section("runner.md", "## Example"))
    wires = [re.findall(r"(?:[0-9a-f]{2} )+0d", " ".join(row)) for row in rows]

    assert [[bytes.fromhex(wire).hex() for wire in found] for found in wires] == [
        [vector["command_wire"]], [vector["command_wire"]], [vector["response_wire"]], [vector["response_wire"]],
    ]  # fmt: skip
    for message, row in ((vector["command"], rows[1]), (vector["response"], rows[3])):
        fields = ", ".join(f"{name} {value}" for name, value in message["fields"].items())
        assert row[1] == f"`{message['type']}`, {fields}"


def test_the_answers_of_the_example_of_checks_prove_and_refute_it() -> None:
    good, bad = re.findall(r"`(21(?: [0-9a-f]{2})+)`", section("checks.md", "## Example"))
    profile = Profile(Model.I_7018)

    response = dcon.decode_response(bytes.fromhex(good), dcon.ReadConfiguration(1), profile)

    assert isinstance(response, dcon.Configuration)
    with pytest.raises(DecodeError):
        dcon.decode_response(bytes.fromhex(bad), dcon.ReadConfiguration(1), profile)


# Sizes


def leaves(value: Any) -> list[Any]:
    """Every number, text and list in a value."""
    if isinstance(value, dict):
        return [*chain.from_iterable(map(leaves, value.values()))]
    return [value, *chain.from_iterable(map(leaves, value))] if isinstance(value, list) else [value]


def test_the_largest_things_are_as_large_as_the_page_says() -> None:
    found = [*chain.from_iterable(leaves(vector) for _, vector in lint.vectors())]
    numbers = [abs(it) for it in found if isinstance(it, int | float)]

    assert {row[0]: int(row[1]) for row in tables(section(START, "## Questions"))[0]} == {
        "number, absolute value": max(numbers),
        "items of a list": max(len(it) for it in found if isinstance(it, list)),
        "characters of a text": max(len(it) for it in found if isinstance(it, str)),
        "characters of an id": max(len(vector["id"]) for _, vector in lint.vectors()),
    }


def test_a_runner_names_every_function_that_it_calls() -> None:
    text = page("runner.md")
    called = set(re.findall(r"\b([a-z_]+)\((?!s\))", "".join(re.findall(r"```\n(.*?)```", text, re.DOTALL))))
    listed = set(chain.from_iterable(re.findall(r"[a-z_]+", row[0]) for row in tables(text)[1]))

    assert called - {"bytes", "answer"} == listed
