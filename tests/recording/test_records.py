"""The lines of a recording."""

import json
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from jsonschema import Draft202012Validator

from i7000 import Protocol
from i7000.recording import SCHEMA_VERSION, Carried, Damaged, End, Event, Record, Start, is_recording, read, text
from i7000.recording.schema import SCHEMA

VALID = Draft202012Validator(json.loads(SCHEMA))
SECONDS = st.floats(0, 10**6).map(lambda it: round(it, 6))
RECORDS: st.SearchStrategy[Record] = st.one_of(
    st.builds(Start, *[st.text()] * 4),
    st.builds(
        Carried,
        SECONDS,
        st.binary(),
        st.none() | st.booleans(),
        st.none() | st.sampled_from(Protocol),
        st.none() | st.text(min_size=1),
        st.lists(st.text(), max_size=3).map(tuple),
    ),
    st.builds(Event, SECONDS, st.text()),
    st.builds(End, SECONDS),
)


@given(RECORDS)
def test_a_record_that_was_written_is_read(record: Record) -> None:
    line = text(record)

    assert line.isascii()
    assert len(line.splitlines()) == 1
    assert read(line) == record
    assert VALID.is_valid(json.loads(line))


@given(st.text() | RECORDS.map(text).flatmap(lambda it: st.integers(0, len(it)).map(lambda at: it[:at])))
def test_whatever_a_line_holds_nothing_is_raised(line: str) -> None:
    assert isinstance(read(line), Start | Carried | Event | End | Damaged)


_ANY: st.SearchStrategy[Any] = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=3),
    lambda it: st.lists(it, max_size=2) | st.dictionaries(st.text(max_size=2), it, max_size=2),
    max_leaves=4,
)


@given(RECORDS, st.sampled_from(("record", "seconds", "from", "wire", "protocol", "place", "notes", "time")), _ANY)
def test_another_value_of_a_key_is_read_or_named(record: Record, key: str, value: Any) -> None:
    found = read(json.dumps(json.loads(text(record)) | {key: value}))

    assert not isinstance(found, Damaged) or key in found.reason


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("", "no JSON object"),
        ("[" * 100_000, "no JSON object"),
        ("[]", "no JSON object"),
        ("{}", "record cannot be null; allowed: start, bytes, event, end"),
        ('{"record": ["x"]}', 'record cannot be ["x"]; allowed: start, bytes, event, end'),
        ('{"record": "end", "seconds": 1e999}', "seconds cannot be Infinity; allowed: a number"),
        ('{"record": "end", "seconds": true}', "seconds cannot be true; allowed: a number"),
        ('{"record": "event", "seconds": 1, "text": 1}', "text cannot be 1; allowed: a text"),
        ('{"record": "bytes", "seconds": 1, "wire": "0"}', 'wire cannot be "0"; allowed: hex digits'),
        ('{"record": "bytes", "seconds": 1, "wire": "", "from": 1}', "from cannot be 1; allowed: host, module or null"),
        (
            '{"record": "bytes", "seconds": 1, "wire": "", "protocol": "x"}',
            'protocol cannot be "x"; allowed: dcon, rtu or null',
        ),
        ('{"record": "bytes", "seconds": 1, "wire": "", "place": 1}', "place cannot be 1; allowed: a text or null"),
        (
            '{"record": "bytes", "seconds": 1, "wire": "", "notes": [1]}',
            "notes cannot be [1]; allowed: a list of texts",
        ),
        ('{"record": "start", "schema_version": 2}', "schema_version cannot be 2; allowed: 1"),
        ('{"record": "start"}', "no schema_version"),
    ],
)
def test_what_is_wrong_with_a_line_is_named(line: str, reason: str) -> None:
    assert read(line) == Damaged(reason)


def test_a_recording_is_told_by_its_beginning() -> None:
    assert is_recording(text(Start("", "i7000 listen", "1", "")).encode())
    assert not is_recording(b'{"record": 1}')
    assert SCHEMA_VERSION == 1


@pytest.mark.parametrize("changed", [{"record": "x"}, {"seconds": "1"}, {"wire": "0"}, {"from": "me"}, {"more": 1}])
def test_the_schema_refuses_what_is_not_written(changed: dict[str, Any]) -> None:
    assert not VALID.is_valid(json.loads(text(Carried(1.0, b"$"))) | changed)
