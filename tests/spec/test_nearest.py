"""The rule of ``spec/dcon.md`` for which command a body is, held against its own examples and against the vectors."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest

from tests.each import each
from tests.spec import lint
from tests.spec.nearest import COMMANDS, command_of, digits, pieces, response_fault

if TYPE_CHECKING:
    from tests.spec.lint import Record

ROWS = {row["name"]: row for row in COMMANDS}
VECTORS = [vector for _, vector in lint.vectors("dcon")]
FRAME_FAULTS = {"terminator", "leading", "checksum"}
EXAMPLES = re.findall(
    r"^\| `([%#$~@]\S*)` \| (\S+) \| `(\w+)` \|", (lint.SPEC / "dcon.md").read_text(encoding="utf-8"), re.MULTILINE
)


def named(vectors: list[Record]) -> list[object]:
    return [pytest.param(vector, id=vector["id"]) for vector in vectors]


def body_of(wire: str, profile: Record) -> str | None:
    """The body of a frame, or None if the frame has a fault before its body."""
    frame = bytes.fromhex(wire)
    text = frame.decode("latin-1")
    if not re.fullmatch(r"[%#$~@!>?][ -~]{0,254}\r", text):
        return None
    if not profile["checksum"]:
        return text[:-1]
    return text[:-3] if len(frame) > 3 and f"{sum(frame[:-3]) & 0xFF:02X}" == text[-3:-1] else None


def test_the_examples_of_the_readme_are_what_its_rule_gives() -> None:
    profile = {"firmware": None, "single_ended": False, "data_format": "engineering", "checksum": False}

    assert len(EXAMPLES) == 11
    for body, model, fault in EXAMPLES:
        assert ("", fault) == command_of(body, {**profile, "model": model}), body


@each("vector", named([vector for vector in VECTORS if vector["command"] is None]))
def test_a_command_that_is_rejected_has_the_fault_of_the_rule(vector: Record) -> None:
    body = body_of(vector["command_wire"], vector["profile"])

    if body is None or body[0] in "!>?":
        assert vector["fault"] in FRAME_FAULTS | {"length", "character"}
    else:
        assert ("", vector["fault"]) == command_of(body, vector["profile"])


@each("vector", named([vector for vector in VECTORS if vector["command"] and vector["outcome"] != "silence"]))
def test_a_command_that_is_read_is_the_one_of_the_rule(vector: Record) -> None:
    body = body_of(vector["command_wire"], vector["profile"])

    assert body is not None
    assert (ROWS[vector["command"]["type"]]["section"], "") == command_of(body, vector["profile"])


@each(
    "vector",
    named([vector for vector in VECTORS if vector["outcome"] == "reject" and vector["response_wire"] is not None]),
)
def test_a_response_that_is_rejected_has_the_fault_of_the_rule(vector: Record) -> None:
    row, body = ROWS[vector["command"]["type"]], body_of(vector["response_wire"], vector["profile"])

    if body is None or body[0] not in f"{row['response_syntax'][0]}?":
        assert vector["fault"] in FRAME_FAULTS | {"length", "character"}
    else:
        assert vector["fault"] == response_fault(row, vector["command"]["fields"], body, vector["profile"])


def written(row: Record, values: Record, profile: Record) -> str:
    """The body of a command with these fields."""
    found = ""
    for piece in pieces(row["syntax"], row["fields"]):
        if isinstance(piece, str):
            found += piece
        elif piece["name"] == "name":
            found += values["name"]
        elif piece["name"] == "offset":
            found += f"{'-' if values['offset'] < 0 else '+'}{abs(values['offset']):04X}"
        else:
            found += f"{values[piece['name']]:0{digits(piece, profile)}X}"
    return found


@each("vector", named([vector for vector in VECTORS if vector["command"] and "decode-only" not in vector["flags"]]))
def test_a_command_is_its_syntax_with_its_fields(vector: Record) -> None:
    row, values = ROWS[vector["command"]["type"]], vector["command"]["fields"]

    assert [field["name"] for field in row["fields"]] == list(values)
    assert body_of(vector["command_wire"], vector["profile"]) == written(row, values, vector["profile"])
