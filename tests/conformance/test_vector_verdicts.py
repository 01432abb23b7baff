"""What an implementation answers: read, compared by value, judged."""

import json
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from i7000.conformance.vector_verdicts import (
    Judged,
    MessageError,
    Reason,
    Verdict,
    difference,
    error,
    judged,
    read_answer,
    read_started,
    skipped,
    verdict_of,
)
from i7000.conformance.vectors import Case, Expected

CASE = Case("checksum-1", "frames.checksum", None, {"body": "24"}, Expected({"checksum": "24"}))
REJECTED = evolve(CASE, expected=Expected(None, "length"))
REFUSED = evolve(CASE, expected=Expected(None))
EITHER = evolve(CASE, expected=Expected({"checksum": "24"}, may_fail=True))
STARTED: dict[str, Any] = {
    "seq": 0,
    "protocol": 1,
    "implementation": {"name": "mine", "version": "1", "language": "C"},
    "operations": ["frames.crc"],
}

# --- messages ---------------------------------------------------------------------------------------------------------


def reason(line: bytes) -> tuple[Reason, str]:
    with pytest.raises(MessageError) as caught:
        read_answer(line, 7)
    assert str(caught.value) == f"{caught.value.reason.value}: {caught.value.text}"
    return caught.value.reason, caught.value.text


def dumped(value: object) -> bytes:
    return json.dumps(value).encode()


def test_an_implementation_says_what_it_is() -> None:
    found = read_started(dumped(STARTED), 0)

    assert (found.name, found.version, found.language) == ("mine", "1", "C")
    assert found.operations == {"frames.crc"}


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"protocol": 2}, "protocol 2: this is protocol 1"),
        ({"protocol": True}, "protocol true: this is protocol 1"),
        ({"implementation": "mine"}, 'implementation is not an object: "mine"'),
        ({"implementation": {"name": "mine", "version": "1"}}, "language is missing; the keys are name, version, lang"),
        ({"implementation": STARTED["implementation"] | {"os": "x"}}, 'unknown key "os"; the keys are name, version'),
        ({"implementation": STARTED["implementation"] | {"version": 1}}, "version of the implementation is not a text"),
        ({"implementation": STARTED["implementation"] | {"name": ""}}, 'name of the implementation is not a text: ""'),
        ({"operations": "frames.crc"}, 'operations is not an array: "frames.crc"'),
        (
            {"operations": ["frames.crc", "crc"]},
            'there is no operation "crc": dcon.encode_command, dcon.decode_command',
        ),
        ({"operations": [1]}, "there is no operation 1: dcon.encode_command"),
        ({"extra": 1}, 'unknown key "extra"; the keys are seq, protocol, implementation, operations'),
    ],
)
def test_an_invalid_start_is_refused_with_what_is_wrong(change: dict[str, Any], text: str) -> None:
    with pytest.raises(MessageError) as caught:
        read_started(dumped(STARTED | change), 0)

    assert caught.value.reason is Reason.BAD_MESSAGE
    assert caught.value.text.startswith(text)


@pytest.mark.parametrize(
    "answer",
    [
        {"result": {}},
        {"error": {"fault": None}},
        {"error": {"fault": "length", "message": "too short"}},
        {"skipped": ""},
        {"crashed": "x"},
    ],
)
def test_an_answer_is_read_without_its_number(answer: dict[str, Any]) -> None:
    assert answer == read_answer(dumped({"seq": 7} | answer) + b"\r", 7)


@pytest.mark.parametrize(
    "line",
    [
        b"", b"hello", b"{", b'{"seq":7,"result":{"value":NaN}}', b'{"seq":7,"seq":7,"result":{}}', b"[]", b"7",
        b'{"seq":7,"result":{"text":"\xff"}}', b"[" * 60_000, b'{"seq":7,"result":' + b"[" * 40 + b"]" * 40 + b"}",
        b'{"seq":' + b"7" * 5000 + b"}", b'{"a":' * 900 + b"1" + b"}" * 900,
    ],
)  # fmt: skip
def test_a_line_that_is_not_one_object_of_json_is_refused(line: bytes) -> None:
    found, text = reason(line)

    assert found is Reason.NOT_JSON
    assert len(text) < 400


@pytest.mark.parametrize(
    ("answer", "text"),
    [
        ({"result": {}}, "seq is missing or not an integer"),
        ({"seq": 7.0, "result": {}}, "seq is missing or not an integer"),
        ({"seq": True, "result": {}}, "seq is missing or not an integer"),
        ({"seq": 7}, "beside seq, exactly one of crashed, error, result, skipped, not []"),
        ({"seq": 7, "result": {}, "skipped": ""}, "beside seq, exactly one of"),
        ({"seq": 7, "answer": {}}, "beside seq, exactly one of"),
        ({"seq": 7, "result": 1}, "result is not an object: 1"),
        ({"seq": 7, "skipped": True}, "skipped is not a text: true"),
        ({"seq": 7, "error": "length"}, 'error is not an object: "length"'),
        ({"seq": 7, "error": {}}, "fault is missing; the keys are fault, message"),
        ({"seq": 7, "error": {"fault": 1}}, "fault of the error is not a text: 1"),
        ({"seq": 7, "error": {"fault": None, "message": None}}, "message of the error is not a text: null"),
        ({"seq": 7, "error": {"fault": None, "at": 1}}, 'unknown key "at"'),
        ({"seq": 7, "result": "x" * 1000}, f'result is not an object: "{"x" * 159}...'),
    ],
)
def test_an_invalid_answer_is_refused_with_what_is_wrong(answer: dict[str, Any], text: str) -> None:
    found, said = reason(dumped(answer))

    assert found is Reason.BAD_MESSAGE
    assert said.startswith(text)


def test_the_answer_to_another_request_is_refused() -> None:
    assert reason(dumped({"seq": 8, "result": {}})) == (Reason.WRONG_SEQUENCE, "seq 8 instead of 7")


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
    max_leaves=20,
)


@given(st.binary() | JSON.map(dumped) | st.dictionaries(st.sampled_from(["seq", "result", "error"]), JSON).map(dumped))
def test_any_line_is_an_answer_or_a_message_error(line: bytes) -> None:
    readers: list[Callable[[bytes, int], object]] = [read_answer, read_started]
    for read in readers:
        with suppress(MessageError):
            assert read(line, 0)


# --- comparison -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("expected", "found", "text"),
    [
        (1, 1.0, ""),
        (1, True, ": true instead of 1"),
        (True, 1, ": 1 instead of true"),
        (False, False, ""),
        (None, None, ""),
        (None, 0, ": 0 instead of null"),
        (0, None, ": null instead of 0"),
        ("a", "A", ': "A" instead of "a"'),
        ("1", 1, ': 1 instead of "1"'),
        ({"wire": "0d"}, {"wire": "0D"}, ""),
        ({"wire": "0d"}, {"wire": 13}, 'wire: 13 instead of "0d"'),
        ({"a": {"wire": "0d"}}, {"a": {"wire": "0D"}}, ""),
        ({"text": "7fff"}, {"text": "7FFF"}, 'text: "7FFF" instead of "7fff"'),
        ({"a": 1}, {}, "result: a is missing"),
        ({"a": {"b": 1}}, {"a": {}}, "a: b is missing"),
        ({}, {"a": 1}, 'result: unknown key "a"'),
        ({"a": [1, 2]}, {"a": [1]}, "a: 1 items instead of 2"),
        ({"a": [1, [2]]}, {"a": [1, [3]]}, "a[1][0]: 3 instead of 2"),
        ([], {}, ": {} instead of []"),
        ({}, [], ": [] instead of {}"),
        (0.5, 0.5000000000000001, ": 0.5000000000000001 instead of 0.5"),
    ],
)
def test_values_are_compared_by_value(expected: object, found: object, text: str) -> None:
    assert text == difference(expected, found)


def test_near_numbers_are_equal_where_they_are_computed() -> None:
    assert difference([14.99954222235786], [14.999542222357861 * (1 + 5e-13)], near=True) == ""
    assert difference([14.99954222235786], [14.999542222357861 * (1 + 5e-12)], near=True) != ""
    assert difference([1.5], [10**400], near=True).startswith("[0]: 1000")
    assert difference([1.5], [float("inf")], near=True) == "[0]: Infinity instead of 1.5"


@given(JSON)
def test_a_value_that_went_through_json_is_equal_to_itself(value: object) -> None:
    if "NaN" not in json.dumps(value):
        assert difference(value, json.loads(json.dumps(value))) == ""


# --- verdicts ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("case", "answer", "verdict", "text"),
    [
        (CASE, {"result": {"checksum": "24"}}, Verdict.PASS, ""),
        (CASE, {"result": {"checksum": "25"}}, Verdict.FAIL, 'checksum: "25" instead of "24"'),
        (CASE, {"error": {"fault": "length"}}, Verdict.FAIL, "an error (length) instead of a result"),
        (CASE, {"error": {"fault": None, "message": "no"}}, Verdict.FAIL, "an error (no) instead of a result"),
        (EITHER, {"result": {"checksum": "24"}}, Verdict.PASS, ""),
        (EITHER, {"result": {"checksum": "25"}}, Verdict.FAIL, 'checksum: "25" instead of "24"'),
        (EITHER, {"error": {"fault": None}}, Verdict.PASS, ""),
        (REJECTED, {"error": {"fault": "length"}}, Verdict.PASS, ""),
        (REJECTED, {"error": {"fault": "crc"}}, Verdict.FAIL, 'fault: "crc" instead of length'),
        (REJECTED, {"error": {"fault": None}}, Verdict.FAIL, "fault: null instead of length"),
        (REJECTED, {"result": {}}, Verdict.FAIL, "a result instead of an error with the fault length"),
        (REFUSED, {"error": {"fault": None}}, Verdict.PASS, ""),
        (REFUSED, {"result": {}}, Verdict.FAIL, "a result instead of an error"),
    ],
)
def test_an_answer_is_judged(case: Case, answer: dict[str, Any], verdict: Verdict, text: str) -> None:
    assert Judged(case, verdict, None, text, answer=answer) == judged(case, answer)


def test_a_crash_is_an_error_even_where_a_refusal_is_expected() -> None:
    found = judged(REFUSED, {"crashed": "IndexError"})

    assert (found.verdict, found.reason, found.text) == (Verdict.ERROR, Reason.CRASHED, "IndexError")


def test_a_case_can_be_skipped_by_the_implementation() -> None:
    found = judged(CASE, {"skipped": "later"})

    assert (found.verdict, found.reason, found.text) == (Verdict.SKIP, Reason.NOT_IMPLEMENTED, "later")


def test_keys_that_are_not_expected_are_ignored_where_the_vector_says_nothing_of_them() -> None:
    case = Case("legacy-1", "readings.read_leniently", None, {}, Expected({"status": "ok"}, partial=True))

    assert judged(case, {"result": {"status": "ok", "value": 1.0}}).verdict is Verdict.PASS
    assert judged(case, {"result": {"status": "disabled", "value": 1.0}}).verdict is Verdict.FAIL
    assert judged(case, {"result": {"value": 1.0}}).text == "result: status is missing"


SPLIT = Case(
    "split-1",
    "frames.split",
    None,
    {},
    Expected(
        {
            "events": [
                {"noise": "00", "fault": "leading"},
                {"noise": "2424", "fault": "terminator"},
                {"frame": "240d"},
                {"noise": "01", "fault": "leading"},
            ],
            "rest": "",
        }
    ),
)


@pytest.mark.parametrize(
    "events",
    [
        [{"noise": "002424", "fault": "leading"}, {"frame": "240D"}, {"noise": "01", "fault": "leading"}],
        [
            {"noise": "00", "fault": "leading"},
            {"noise": "24", "fault": "terminator"},
            {"noise": "24", "fault": "terminator"},
            {"frame": "240d"},
            {"noise": "01", "fault": "leading"},
        ],
    ],
)
def test_adjacent_noise_is_compared_as_one_run_with_its_first_fault(events: list[Any]) -> None:
    assert judged(SPLIT, {"result": {"events": events, "rest": ""}}).text == ""


@pytest.mark.parametrize(
    ("events", "text"),
    [
        ([{"noise": "002424", "fault": "terminator"}], "events[0].fault:"),
        ([{"noise": "00242424", "fault": "leading"}], "events[0].noise:"),
        (None, "events: null instead of"),
        ([1], "events[0]: 1 instead of"),
        ([{"noise": 1, "fault": "leading"}], "events[0].noise: 1 instead of"),
        ([{"noise": "002424"}], "events[0]: fault is missing"),
        ([{"frame": "240d"}], "events[0]: noise is missing"),
    ],
)
def test_events_that_differ_or_are_no_events_fail(events: object, text: str) -> None:
    assert judged(SPLIT, {"result": {"events": events, "rest": ""}}).text.startswith(text)


def test_the_verdict_of_a_vector_is_the_worst_of_its_cases() -> None:
    passed, failed = judged(CASE, {"result": {"checksum": "24"}}), judged(CASE, {"result": {}})
    left, broken = skipped(CASE, Reason.NOT_IMPLEMENTED), error(CASE, MessageError(Reason.DIED, "dead"), "stderr")

    assert broken.stderr == "stderr"
    assert verdict_of([passed, left]) is Verdict.PASS
    assert verdict_of([left, left]) is Verdict.SKIP
    assert verdict_of([passed, failed, left]) is Verdict.FAIL
    assert verdict_of([failed, broken, passed]) is Verdict.ERROR
