"""The code against the rule of ``spec/dcon.md``: which command a body is, and which fault a body has that is none."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from i7000 import DecodeError, dcon
from tests.spec.nearest import CHOICES, COMMANDS, MODELS, command_of, has, pieces, response_fault, width
from tests.vectors import AVAILABILITY, MESSAGES, profile_of

pytestmark = pytest.mark.no_cover

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from tests.spec.lint import Record

FEW = settings(max_examples=settings().max_examples // 4)
"""For what is tried with every command."""

ALPHABET = "0123456789ABCDEFabcxGOSCRNTMIPi+-.* #$~@!>?"
"""What stands in bodies, in the wrong place too."""


def records() -> list[Record]:
    """A profile for every model, firmware that a command begins with, and connecting mode."""
    return [
        {"model": name, "firmware": firmware, "single_ended": single_ended, "type_codes": [],
         "data_format": "engineering", "checksum": False}
        for name, model in MODELS.items()
        for firmware in (None, "A1.0", *sorted({row["models"][name] for row in COMMANDS if row["models"].get(name)}))
        for single_ended in (False, True)[: 1 + model["single_ended_by_command"]]
    ]  # fmt: skip


RECORDS = records()
PROFILES = [profile_of(record) for record in RECORDS]


def texts(field: Record, sizes: tuple[int, int], profile: Record) -> st.SearchStrategy[str]:
    """Characters that a field may have, and some that it may not."""
    digits = st.text("0123456789ABCDEF", min_size=sizes[0], max_size=sizes[1])
    if field["name"] in CHOICES:
        return st.sampled_from(CHOICES[field["name"]])
    if field["name"] == "offset":
        return st.builds(str.__add__, st.sampled_from("+-"), st.text("0123456789ABCDEF", min_size=4, max_size=4))
    if field["name"] == "version":
        return st.sampled_from(("A2.0", "B2.10", "B305"))
    if field["name"] == "temperature":
        return st.sampled_from(("+0031.2", "-0000.5", "+00312."))
    if field["name"] in ("values", "value"):
        one = ("4C53", "7FFF", "    ") if profile["data_format"] == "hex" or field["digits"] == 4 else (
            "+025.12", "-9999.9", "       ", "+2.5000"
        )  # fmt: skip
        return st.lists(st.sampled_from(one), min_size=sizes[0] // len(one[0]), max_size=sizes[0] // len(one[0])).map(
            "".join
        )
    return digits


@st.composite
def near_misses(draw: st.DrawFn, syntax: str, fields: list[Record], profile: Record) -> str:
    """A body of this syntax with up to three characters changed, added, lost or swapped."""
    body = ""
    for piece in pieces(syntax, fields):
        body += piece if isinstance(piece, str) else draw(texts(piece, width(piece, profile), profile))
    for kind in draw(st.lists(st.sampled_from(("changed", "changed", "added", "lost", "swapped")), max_size=3)):
        at = draw(st.integers(1, len(body)))
        before, after = body[:at], body[at:]
        match kind:
            case "changed":
                body = before + draw(st.sampled_from(ALPHABET)) + after[1:]
            case "added":
                body = before + draw(st.sampled_from(ALPHABET)) + after
            case "lost":
                body = before + after[1:]
            case _:
                body = before + after[1:2] + after[:1] + after[2:]
    return body


def outcome(decode: Callable[..., Any], body: str, *arguments: Any) -> tuple[str, str]:
    """The section of what is decoded, or the fault."""
    try:
        return decode(body.encode() + b"\r", *arguments).section, ""
    except DecodeError as error:
        return "", error.fault.value


def single_slips(body: str) -> Iterator[str]:
    """A body with one character changed, added or lost."""
    for at in range(1, len(body) + 1):
        yield body[:at] + body[at + 1 :]
        for character in ALPHABET:
            yield body[:at] + character + body[at:]
            yield body[:at] + character + body[at + 1 :]


def valid(row: Record, profile: Record) -> str:
    """One body of a command."""
    values = {"offset": "+00A5", "name": "70"}
    found = ""
    for piece in pieces(row["syntax"], row["fields"]):
        found += piece if isinstance(piece, str) else values.get(piece["name"], "000001")[-width(piece, profile)[1] :]
    return found


@pytest.mark.parametrize("row", COMMANDS, ids=lambda row: row["name"])
@pytest.mark.parametrize("name", ["I-7018", "M-7019R"])
def test_one_slip_in_a_body_is_the_fault_that_the_rule_gives(name: str, row: Record) -> None:
    at = next(at for at, record in enumerate(RECORDS) if record["model"] == name)
    bodies = list(single_slips(valid(row, RECORDS[at])))

    expected = {body: command_of(body, RECORDS[at]) for body in bodies}

    assert expected == {body: outcome(dcon.decode_command, body, PROFILES[at]) for body in bodies}


@pytest.mark.parametrize("row", COMMANDS, ids=lambda row: row["name"])
@FEW
@given(data=st.data())
def test_a_body_is_the_command_or_has_the_fault_that_the_rule_gives(row: Record, data: st.DataObject) -> None:
    at = data.draw(st.integers(0, len(RECORDS) - 1))
    body = data.draw(near_misses(row["syntax"], row["fields"], RECORDS[at]))

    assert command_of(body, RECORDS[at]) == outcome(dcon.decode_command, body, PROFILES[at])


@pytest.mark.parametrize("name", ["I-7018", "M-7019R"])
def test_a_body_of_few_characters_is_what_the_rule_gives(name: str) -> None:
    at = next(at for at, record in enumerate(RECORDS) if record["model"] == name)
    bodies = [
        lead + address + rest
        for lead in "%#$~@"
        for address in ("", "0", "01", "0a", "**", "*1", "1*")
        for rest in ("", *ALPHABET, *(letter + last for letter in "017ACEPSO" for last in ALPHABET))
    ]
    expected = {body: command_of(body, RECORDS[at]) for body in bodies}

    assert expected == {body: outcome(dcon.decode_command, body, PROFILES[at]) for body in bodies}


def test_no_body_fits_two_commands_of_a_module() -> None:
    for at, record in enumerate(RECORDS):
        syntaxes = [row["syntax"] for row in COMMANDS if AVAILABILITY[row["section"]] not in PROFILES[at].refused]

        assert len(syntaxes) == len(set(syntaxes)) == sum(has(row, record) for row in COMMANDS)


ANSWERED = [row for row in COMMANDS if row["response"] is not None]


@pytest.mark.parametrize("row", ANSWERED, ids=lambda row: row["name"])
@FEW
@given(data=st.data())
def test_a_response_has_the_fault_that_the_rule_gives(row: Record, data: st.DataObject) -> None:
    able = [record for record in RECORDS if has(row, record)]
    record = {
        **data.draw(st.sampled_from(able)),
        "data_format": data.draw(st.sampled_from(("engineering", "percent", "hex"))),
    }
    kind = MESSAGES[row["name"]]
    known = {"address": 1, "new_address": 2, "channel": 3}
    sent = {field["name"]: known[field["name"]] for field in row["fields"] if field["name"] in known}
    command = object.__new__(kind)
    for field, value in sent.items():
        getattr(kind, field).__set__(command, value)
    body = data.draw(
        near_misses(row["response_syntax"], row["response_fields"], record)
        | near_misses("?AA", [{"name": "address", "notation": "AA", "digits": 2}], record)
    )
    if body[0] not in (row["response_syntax"][0], "?"):
        body = "?" + body[1:]

    assert (
        response_fault(row, sent, body, record) == outcome(dcon.decode_response, body, command, profile_of(record))[1]
    )


def test_the_length_of_a_version_is_a_fault_before_what_is_in_front_of_it() -> None:
    with pytest.raises(DecodeError, match="allowed: 7 to 8 characters") as caught:
        dcon.decode_response(b"!0aA20\r", dcon.ReadFirmwareVersion(0x0A), PROFILES[0])

    assert caught.value.fault.value == "length"
