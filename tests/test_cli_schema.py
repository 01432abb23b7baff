"""The JSON of ``i7000 decode``, held against the schema that it prints."""

import json
from itertools import islice
from pathlib import Path

import pytest
from hypothesis import given
from jsonschema import Draft202012Validator

from i7000.cli.readers import of_stream
from i7000.cli.records import json_of
from i7000.cli.schema import SCHEMA
from i7000.dissect import Knowledge, Known
from tests.dissect.strategies import frames, knowns
from tests.dissect.test_capture import OUT, interface, packet, section
from tests.spec.lint import vectors
from tests.terminal import Run

VALIDATOR = Draft202012Validator(json.loads(SCHEMA))

pytestmark = pytest.mark.usefixtures("plain")


def check(text: str) -> None:
    VALIDATOR.validate(json.loads(text))


def test_the_schema_is_printed(run: Run) -> None:
    result = run("decode", "--schema")

    Draft202012Validator.check_schema(json.loads(result.out))
    assert json.loads(result.out) == json.loads(SCHEMA)


def test_a_key_that_the_schema_does_not_have_is_refused(run: Run) -> None:
    (record,) = run("decode", "--json", "$012").records

    assert VALIDATOR.is_valid(record)
    assert not VALIDATOR.is_valid(record | {"other": 1})
    for key in record:
        assert not VALIDATOR.is_valid({name: value for name, value in record.items() if name != key}), key


@pytest.mark.parametrize("folder", ["dcon", "modbus"])
def test_the_records_of_vectors_are_as_the_schema_says(folder: str) -> None:
    wires = [
        bytes.fromhex(wire)
        for _, vector in islice(vectors(folder), 0, None, 5)
        for wire in (vector.get("command_wire") or vector.get("request_wire"), vector.get("response_wire"))
        if wire
    ]
    for known in (Known(), Known(checksum=False)):
        reads = list(of_stream((piece for wire in wires for piece in (wire, b"")), Knowledge.given(known), None))
        for read in reads:
            check(json_of(read))

        assert len(reads) >= len(wires) // 2


@given(knowns, frames)
def test_the_records_of_any_log_are_as_the_schema_says(known: Known, sent: list[bytes]) -> None:
    for read in of_stream((piece for frame in sent for piece in (frame, b"")), Knowledge.given(known), None):
        check(json_of(read))


def test_lines_without_frames_and_damaged_files_are_as_the_schema_says(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "line.pcapng"
    file.write_bytes(section() + interface() + packet(b"$012\r", OUT) + b"\x06\0\0\0")
    result = run("decode", "--json", "--file", str(file))
    for record in (*result.records, *run("decode", "--json", "COM3 opened", "$012", "$01").records):
        VALIDATOR.validate(record)

    assert result.code == 1
    assert [record["name"] for record in result.records] == ["ReadConfiguration", None]


def test_a_utf_16_file_is_read_as_it_is_meant(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "log.txt"
    file.write_bytes("TX: $012\r\nRX: !01050600\r\n".encode("utf-16"))
    result = run("decode", "--json", "--file", str(file))

    assert [(record["text"], record["answers"]) for record in result.records] == [
        ("TX: $012", None), ("RX: !01050600", 1),
    ]  # fmt: skip
    assert result.code == 0


def test_bytes_of_a_line_are_read_raw(run: Run) -> None:
    result = run("decode", "--raw", "--json", stdin=b"$012\r!01050600\r")

    assert [record["text"] for record in result.records] == ["$012", "!01050600"]
    assert [record["line"] for record in result.records] == [1, 2]
