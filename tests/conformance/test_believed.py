"""The output of a driver, line by line."""

import json
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from jsonschema import Draft202012Validator

from i7000.conformance.believed import SCHEMA, STATUSES, Believed, Unreadable, read

GOOD: list[tuple[dict[str, Any], Believed]] = [
    ({"address": 1, "channel": 0, "value": 25.5}, Believed(1, 0, 25.5, "ok")),
    ({"address": 1, "channel": 0, "value": -3, "status": "ok", "unit": "V"}, Believed(1, 0, -3.0, "ok", "V")),
    ({"address": 255, "channel": 3, "status": "over range"}, Believed(255, 3, None, "over_range")),
    ({"address": 1, "channel": 3, "value": None, "status": "under_range"}, Believed(1, 3, None, "under_range")),
    ({"address": 1, "channel": 3, "status": "disabled", "unit": None}, Believed(1, 3, None, "disabled")),
    ({"address": 1, "channel": None, "status": "missing"}, Believed(1, None, None, "missing")),
    ({"address": 0, "status": "error"}, Believed(0, None, None, "error")),
]
BAD: list[tuple[Any, str]] = [
    ({}, "no address"),
    ({"address": True, "status": "error"}, "address cannot be true; allowed: 0..255"),
    ({"address": "01", "status": "error"}, 'address cannot be "01"; allowed: 0..255'),
    ({"address": 256, "status": "error"}, "address cannot be 256"),
    ({"address": 1, "channel": -1, "value": 1}, "channel cannot be -1"),
    ({"address": 1, "value": 1.5}, "no channel; allowed: 0..255, since status is ok"),
    ({"address": 1, "channel": 0}, "no value; allowed: a finite number, since status is ok"),
    ({"address": 1, "channel": 0, "value": "25.5"}, 'value cannot be "25.5"'),
    ({"address": 1, "channel": 0, "value": False}, "value cannot be false"),
    ({"address": 1, "channel": 0, "value": 10**400}, "value cannot be 1000"),
    ({"address": 1, "channel": 0, "value": 9999.9, "status": "over range"}, "value cannot be 9999.9; allowed: null"),
    ({"address": 1, "channel": 0, "status": "broken"}, 'status cannot be "broken"; allowed: ok, over_range'),
    ({"address": 1, "channel": 0, "status": 3}, "status cannot be 3"),
    ({"address": 1, "channel": 0, "value": 1, "unit": 2}, "unit cannot be 2; allowed: a text or null"),
    ({"address": 1, "chanel": 0, "value": 1}, "'chanel' is not a key; allowed: address, channel"),
]


@pytest.mark.parametrize(("line", "believed"), GOOD)
def test_a_line_by_the_schema_is_read(line: dict[str, Any], believed: Believed) -> None:
    Draft202012Validator(json.loads(SCHEMA)).validate(line)

    assert read(json.dumps(line)) == believed


@pytest.mark.parametrize(("line", "reason"), BAD)
def test_any_other_object_says_what_is_wrong(line: dict[str, Any], reason: str) -> None:
    unreadable = read(json.dumps(line))

    assert isinstance(unreadable, Unreadable)
    assert unreadable.reason.startswith(reason)


@pytest.mark.parametrize("line", ["", "connected to COM3", "25.5", "[1]", "  # {"])
def test_a_line_for_people_is_ignored(line: str) -> None:
    assert read(line) is None


@pytest.mark.parametrize("line", ["{", '{"address": 1', "{'address': 1}", "{" * 100_000, ' {"value": NaN}x'])
def test_half_an_object_is_unreadable(line: str) -> None:
    assert read(line) == Unreadable("no JSON object")


def test_a_value_that_is_no_number_is_unreadable() -> None:
    unreadable = read('{"address": 1, "channel": 0, "value": NaN}')

    assert isinstance(unreadable, Unreadable)


@given(st.text() | st.builds("{{{}".format, st.text()))
def test_no_line_raises(line: str) -> None:
    assert isinstance(read(line), Believed | Unreadable | None)


@given(
    st.fixed_dictionaries(
        {"address": st.integers(0, 255), "channel": st.integers(0, 255)},
        optional={"value": st.floats(allow_nan=False, allow_infinity=False), "status": st.sampled_from(STATUSES)},
    )
)
def test_what_is_read_fits_the_schema(line: dict[str, Any]) -> None:
    if isinstance(read(json.dumps(line)), Believed):
        assert Draft202012Validator(json.loads(SCHEMA)).is_valid(line)
