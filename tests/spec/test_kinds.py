"""The forms of fields on the wire: their kinds, widths and places, held against the layouts of the codecs."""

from __future__ import annotations

from itertools import chain, product
from typing import TYPE_CHECKING, Any

import pytest
from attrs import fields

from i7000 import CjcUpdate, Fault, Protocol, modbus
from i7000.dcon.codec import COMMANDS
from i7000.dcon.parts import Part
from i7000.modbus.items import Item
from i7000.names import LONGEST_NAME
from tests.spec import lint
from tests.spec.cells import Cell, wrong
from tests.spec.test_fields import PROFILES, having
from tests.vectors import MESSAGES, MODBUS_MESSAGES

if TYPE_CHECKING:
    from i7000.modbus.layout import Token
    from tests.spec.lint import Record

DCON_ROWS = {row["name"]: row for row in lint.rows("dcon_commands")}
MODBUS_ROWS = {
    table: {row["key" if table == "modbus_functions" else "name"]: row for row in lint.rows(table)}
    for table in ("modbus_functions", "module_settings")
}
REST = ("name", "version", "reading", "readings")
"""The kinds that take what is left of a body."""
WIDTHS = {"channel_digits": "channel_digits", "mask_digits": "mask_digits"}
"""The attribute of a profile behind each rule of a width."""


def kind_of(part: Part) -> str:
    """The kind of a part of a syntax, by what the codec writes and reads there."""
    if part.width == "rest":
        texts = ("readings" if "join" in part.arguments else "reading") if part.contextual else "version"
        return "name" if part.longest is not None and not part.contextual and is_name_length(part) else texts
    if part.values in (bool, CjcUpdate, Protocol):
        assert part.fault is Fault.VALUE
        return "bool" if part.values is bool else "code"
    if part.signed:
        return "signed_hex"
    return "hex" if part.format.endswith("X") else "decimal"


def is_name_length(part: Part) -> bool:
    assert part.longest is not None
    return part.longest(PROFILES[0]) == LONGEST_NAME


def parts_of(message: Any) -> dict[str, Part]:
    return {field.name: field.type.__metadata__[0] for field in fields(message)}


def rule_of(part: Part, digits: Any) -> str | None:
    """The rule that chooses the digits of a part, by the codec."""
    if not isinstance(digits, list):
        return None
    if part.width == "rest":
        return "reading_digits" if part.contextual else "length"
    return str(part.width)


DCON_SIDES = [
    pytest.param(row, side, id=f"{row['name']}-{side}")
    for row, side in product(DCON_ROWS.values(), ("fields", "response_fields"))
    if row[side]
]


def message_of_side(row: Record, side: str) -> Any:
    return MESSAGES[row["name"] if side == "fields" else row["response"]]


@pytest.mark.parametrize(("row", "side"), DCON_SIDES)
def test_a_field_of_dcon_has_the_kind_and_the_width_of_its_part(row: Record, side: str) -> None:
    parts = parts_of(message_of_side(row, side))
    cells = []
    for field in row[side]:
        part = parts[field["name"]]
        place = ("tables/dcon_commands.json", row["section"])
        cells.append(Cell(*place, f"{side}.{field['name']}.kind", field["kind"], kind_of(part)))
        cells.append(
            Cell(*place, f"{side}.{field['name']}.digits_by", field["digits_by"], rule_of(part, field["digits"]))
        )

    assert wrong(cells) == []


@pytest.mark.parametrize(("row", "side"), DCON_SIDES)
def test_the_parts_of_a_syntax_stand_where_the_codec_writes_them(row: Record, side: str) -> None:
    message = message_of_side(row, side)
    told = row["parts" if side == "fields" else "response_parts"]
    pieces = [
        (name or None, None if name else piece, kind_of(piece) if isinstance(piece, Part) else "literal")
        for name, piece in message.layout.pieces
    ]

    assert pieces == [(part["field"], part["literal"], part["kind"]) for part in told]
    widths = [widths_of(piece, having(row["section"])) for _, piece in message.layout.pieces]
    offsets = list(zip(*[places(choice, widths) for choice in range(max(map(len, widths)))], strict=True))
    assert [one(width) if width[0] else None for width in widths] == [part["width"] for part in told]
    assert [one(sorted(set(at), key=at.index)) for at in offsets] == [part["offset"] for part in told]


def widths_of(piece: Any, profiles: list[Any]) -> list[int]:
    """The possible widths of a piece over the modules that have the command; 0 for the rest of a body."""
    if isinstance(piece, str):
        return [len(piece)]
    if piece.width == "rest":
        return [0]
    if isinstance(piece.width, str):
        return sorted({getattr(profile, WIDTHS[piece.width]) for profile in profiles})
    return [len(piece.notation) if piece.width is None else piece.width]


def places(choice: int, widths: list[list[int]]) -> list[int]:
    """The index of the first character of each piece, for one of the widths that vary."""
    found, at = [], 0
    for width in widths:
        found.append(at)
        at += width[choice if len(width) > 1 else 0]
    return found


def one(numbers: Any) -> Any:
    """A list of one number as the number."""
    return list(numbers) if len(numbers) > 1 else numbers[0]


def test_a_command_without_a_response_has_no_parts_of_one() -> None:
    assert [row["name"] for row in DCON_ROWS.values() if bool(row["response"]) != bool(row["response_parts"])] == []


def test_broadcasts_are_literal() -> None:
    found = {row["name"]: row["parts"] for row in DCON_ROWS.values() if not row["fields"]}

    assert found == {
        name: [{"kind": "literal", "literal": MESSAGES[name].syntax, "field": None, "offset": 0, "width": 3}]
        for name in ("SynchronizedSampling", "HostOk")
    }


# Modbus


def modbus_kind(item: Item, token: Token) -> str:
    if token.form in ("bits", "words"):
        return token.form
    if token.form == "4s":
        return "digits"
    if item.values is bool:
        return "bool" if token.form == "B" else "coil"
    if item.values in (CjcUpdate, Protocol):
        return "code"
    return "signed" if item.bounds is not None and item.bounds[0] < 0 else "unsigned"


MODBUS_SIDES = [
    pytest.param(table, row, side, id=f"{key}-{side}")
    for table, rows in MODBUS_ROWS.items()
    for (key, row), side in product(rows.items(), ("fields", "response_fields"))
    if row["request" if side == "fields" else "response"]
]


@pytest.mark.parametrize(("table", "row", "side"), MODBUS_SIDES)
def test_a_field_of_modbus_has_the_form_of_its_item(table: str, row: Record, side: str) -> None:
    message = MODBUS_MESSAGES[row["name"] if side == "fields" else row["response_name"]]
    items = {field.name: field.type.__metadata__[0] for field in fields(message)}
    expected, at = [], 0
    for token in message.layout.tokens:
        if token.name in items and token.name != "address":
            rule = "mask_digits" if token.form == "mask" else None
            expected.append((token.name, modbus_kind(items[token.name], token), at, token.width, rule))
        at += max(token.width, token.name == "bytes")

    told = [
        (field["name"], field["kind"], field["offset"], fixed(field["bytes"]), field["bytes_by"]) for field in row[side]
    ]
    assert told == expected, table


def fixed(count: Any) -> int:
    return count if isinstance(count, int) else 0


@pytest.mark.parametrize("key", MODBUS_ROWS["modbus_functions"])
@pytest.mark.parametrize("side", ["fields", "response_fields"])
def test_a_field_of_a_function_has_the_limits_of_its_item(key: str, side: str) -> None:
    row = MODBUS_ROWS["modbus_functions"][key]
    name = row["name"] if side == "fields" else row["response_name"]
    items = {field.name: field.type.__metadata__[0] for field in fields(MODBUS_MESSAGES[name])} if name else {}
    told = {field["name"]: (field["minimum"], field["maximum"]) for field in row[side]}

    assert told == {name: item.bounds or (None, None) for name, item in items.items() if name != "address"}


# Both protocols


def test_names_of_both_protocols_are_those_that_the_readme_lists() -> None:
    names: dict[str, set[str]] = {}
    for protocol, messages in (("dcon", MESSAGES), ("modbus", MODBUS_MESSAGES)):
        for name in messages:
            names.setdefault(name, set()).add(protocol)
    text = (lint.SPEC / "README.md").read_text(encoding="utf-8")
    listed = text.partition("**Names of both protocols.**")[2].partition("\n\n")[2].partition("\n\n")[0]

    assert [name for name, protocols in names.items() if len(protocols) > 1] == listed.replace("`", "").split()


def test_a_name_stands_for_one_message_in_its_protocol() -> None:
    requests = [[command.__name__ for command in COMMANDS], [request.__name__ for request in modbus.REQUESTS]]
    responses = [
        {row["response"] for row in DCON_ROWS.values()},
        {row["response_name"] for row in chain(*(rows.values() for rows in MODBUS_ROWS.values()))},
    ]

    for sent, answered in zip(requests, responses, strict=True):
        assert len(set(sent)) == len(sent)
        assert set(sent) & answered == set()
