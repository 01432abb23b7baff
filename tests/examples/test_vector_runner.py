"""The wrapper of this codec for ``i7000 vectors``, and the protocol that it speaks."""

import io
import json
import re
import runpy
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from i7000.cli.vector_files import all_vectors
from i7000.cli.vector_schema import protocol_schema
from i7000.conformance.vector_verdicts import (
    Verdict,
    judged,
    read_answer,
    read_started,
    run_message,
    start_message,
    stop_message,
)
from i7000.conformance.vectors import OPERATIONS, Case
from i7000.examples import vector_runner
from i7000.examples.vector_runner import answered
from tests.spec.lint import Record
from tests.terminal import Run

PAGE = (Path(__file__).parents[2] / "docs" / "port_the_codec.md").read_text(encoding="utf-8")
SCHEMA = json.loads(protocol_schema())
CASES = [case for vector in all_vectors() for case in vector.cases]
SOME = [*CASES[::300], *{case.operation: case for case in CASES}.values()]
"""Enough to have every operation and most messages; the schema takes its time."""


def validator(kind: str) -> Draft202012Validator:
    """What the schema says of a line in one direction."""
    return Draft202012Validator(SCHEMA | {"oneOf": [{"$ref": f"#/$defs/{kind}"}]})


def answer_to(case: Case, operations: dict[str, Any] = vector_runner.OPERATIONS) -> Mapping[str, Any]:
    line = json.dumps(answered(json.loads(run_message(1, case)), operations))
    return read_answer(line.encode(), 1)


def failed(operations: dict[str, Any], folder: str = "") -> set[str]:
    """The ids of what fails with these operations, in a folder or in all."""
    cases = [case for case in CASES if case.operation.startswith(folder)]
    return {case.id for case in cases if judged(case, answer_to(case, operations)).verdict is not Verdict.PASS}


def test_it_has_every_operation_and_passes_every_case() -> None:
    assert set(vector_runner.OPERATIONS) == set(OPERATIONS)
    assert failed(vector_runner.OPERATIONS) == set()


@pytest.mark.parametrize(
    ("operation", "wrong", "ids"),
    [
        (
            "frames.crc",
            lambda given, _: {"crc": bytes.fromhex(given["body"])[-2:].hex()},
            {case.id for case in CASES if case.operation == "frames.crc"},
        ),
        (
            "frames.checksum",
            lambda given, _: {"checksum": f"{sum(bytes.fromhex(given['body'])):02X}"},
            {
                case.id
                for case in CASES
                if case.operation == "frames.checksum" and sum(bytes.fromhex(case.given["body"])) > 0xFF
            },
        ),
        (
            "readings.read",
            vector_runner.OPERATIONS["readings.read_leniently"],
            {
                case.id
                for case in CASES
                if case.operation == "readings.read" and "result" in answer_to(case) and case.expected.result is None
            }
            | {
                case.id
                for case in CASES
                if case.operation == "readings.read_leniently" and case.id.startswith("reading-")
            },
        ),
    ],
)
def test_a_wrong_operation_fails_exactly_the_vectors_that_show_it(operation: str, wrong: Any, ids: set[str]) -> None:
    assert ids
    assert ids == failed(vector_runner.OPERATIONS | {operation: wrong}, operation.partition(".")[0])


def test_what_is_no_error_of_the_codec_is_a_crash() -> None:
    case = CASES[0]

    found = answer_to(case, {case.operation: lambda *_: 1 // 0})

    assert list(found) == ["crashed"]
    assert found["crashed"].startswith("ZeroDivisionError(")


def lines() -> Iterator[bytes]:
    yield start_message(0)
    yield from (run_message(at, case) for at, case in enumerate(SOME, 1))
    yield stop_message(len(SOME) + 1)


def test_requests_and_answers_are_as_the_schema_says() -> None:
    Draft202012Validator.check_schema(SCHEMA)
    requests, answers = validator("request"), validator("answer")
    for line in lines():
        message = json.loads(line)
        requests.validate(message)
        answer = json.loads(json.dumps(answered(message)))
        if answer is not None:
            answers.validate(answer)
            assert not answers.is_valid(answer | {"other": 1})
        assert not requests.is_valid(message | {"other": 1})


def test_the_schema_is_closed_within_inputs_and_results() -> None:
    message = json.loads(run_message(1, CASES[0]))
    message["case"]["input"]["other"] = 1
    answer = answered(json.loads(run_message(1, CASES[0])))
    assert answer
    answer["result"]["other"] = 1

    assert not validator("request").is_valid(message)
    assert not validator("answer").is_valid(answer)


@pytest.mark.parametrize("answer", [{"skipped": "later"}, {"crashed": "x"}, {"error": {"fault": None}}])
def test_every_kind_of_answer_is_in_the_schema(answer: Record) -> None:
    assert validator("answer").is_valid({"seq": 1} | answer)
    assert not validator("answer").is_valid({"seq": 1, "result": {}} | answer)


def test_the_schema_is_printed(run: Run) -> None:
    assert json.loads(run("vectors", "--schema").out) == SCHEMA


def test_it_answers_line_by_line_until_stop(capsys: pytest.CaptureFixture[str]) -> None:
    source = io.StringIO((start_message(0) + run_message(1, CASES[0]) + stop_message(2) + b"rubbish\n").decode())

    code = vector_runner.main(source=source)
    first, second = capsys.readouterr().out.splitlines()

    assert code == 0
    assert read_started(first.encode(), 0).operations == set(OPERATIONS)
    assert json.loads(second)["seq"] == 1


def test_it_ends_with_its_input_and_can_be_run(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.stdin", io.StringIO(start_message(0).decode()))
    monkeypatch.delitem(sys.modules, "i7000.examples.vector_runner")
    with pytest.raises(SystemExit) as ended:
        runpy.run_module("i7000.examples.vector_runner", run_name="__main__")

    assert ended.value.code == 0
    assert json.loads(capsys.readouterr().out)["implementation"]["name"] == "i7000"


# --- the page ---------------------------------------------------------------------------------------------------------


def test_the_example_of_the_page_is_what_is_sent_and_what_passes() -> None:
    (example,) = re.findall(r"```text\n(.*?)```", PAGE, re.DOTALL)
    sent = [json.loads(line[2:]) for line in example.splitlines() if line.startswith("> ")]
    said = [json.loads(line[2:]) for line in example.splitlines() if line.startswith("< ")]
    messages = [json.loads(start_message(0)), json.loads(stop_message(len(said)))]

    assert [sent[0], sent[-1]] == messages
    assert read_started(json.dumps(said[0]).encode(), 0).operations == {it["case"]["operation"] for it in sent[1:-1]}
    for message, answer in zip(sent[1:-1], said[1:], strict=True):
        seq = answer.pop("seq")
        (case,) = (it for it in CASES if it.record == message["case"])
        assert message == json.loads(run_message(seq, case))
        assert judged(case, answer).verdict is Verdict.PASS
    for message in [*sent, *({"seq": 1} | it for it in said[1:])]:
        Draft202012Validator(SCHEMA).validate(message)


def test_the_page_has_every_operation_with_its_keys() -> None:
    rows = {
        name: (re.findall(r"`(\w+)`", given), re.findall(r"`(\w+)`", result))
        for name, given, result in re.findall(r"^\| `(\w+\.\w+)` \| (.*?) \| (.*?) \|$", PAGE, re.MULTILINE)
    }

    assert rows == {name: (list(it.given), list(it.result)) for name, it in OPERATIONS.items()}
