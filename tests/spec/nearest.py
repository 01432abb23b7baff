"""Which command a DCON body is, and its fault if it is none: an implementation of ``spec/dcon.md`` from its tables.

Laws: nothing of `i7000` is imported; every rule here is a sentence of the chapter "Which command a body is".
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, TypeAlias

from tests.spec import lint

if TYPE_CHECKING:
    from tests.spec.lint import Record

__all__ = ["COMMANDS", "command_of", "field_fault", "pieces", "response_fault", "width"]

COMMANDS = lint.rows("dcon_commands")
MODELS = {row["name"]: row for row in lint.rows("models")}
CHOICES = dict.fromkeys(("enabled", "first_reading", "modbus_supported", "single_ended", "protocol"), "01") | {
    "update": "012"
}
READINGS = {
    "engineering": r"[+-](?=.{6}$)\d{1,4}\.\d{1,4}| {7}",
    "percent": r"[+-]\d{3}\.\d\d|[+-]9999\.9| {7}",
    "hex": r"[0-9A-F]{4}| {4}",
}
VERSION = r"[A-Z]\d\.\d\d?"
OTHER_ANSWERS = (
    rf"(?!701[789])([0-9A-F]{{4}}|[0-9A-F]{{6}})|[0-9A-F]{{2}}|[01][0-9A-F]{{2}}|[012]|[+-][0-9A-F]{{4}}"
    rf"|C[0-9A-F]{{1,2}}R[0-9A-F]{{2}}|{VERSION}"
)
OLD_SENTINELS = ("+9999", "-0000")
OLD_FIELDS = {
    "engineering": r" {1,7}|[+-]?[^+ -]+|[+-]",
    "percent": r" {1,7}|[+-]?[^+ -]+|[+-]",
    "hex": r"[+-].{0,4}|.{1,4}",
}
Piece: TypeAlias = "str | Record"
Misfit: TypeAlias = tuple[int, str]
"""A place in the body, and the fault there."""


def pieces(syntax: str, fields: list[Record]) -> list[Piece]:
    """The characters that stand for themselves, and the fields, from the left."""
    found: list[Piece] = []
    for field in fields:
        literal, _, syntax = syntax.partition(field["notation"])
        found += [*literal, field]
    return [*found, *syntax]


def width(piece: Piece, profile: Record) -> tuple[int, int]:
    """The fewest and the most characters of a piece."""
    if isinstance(piece, str):
        return 1, 1
    if piece["name"] in ("name", "version"):
        return (1, 6) if piece["name"] == "name" else (4, 5)
    size = digits(piece, profile)
    if piece["name"] in ("values", "value") and is_old(profile):
        fields = size // (4 if profile["data_format"] == "hex" else 7)
        return 1, fields * (5 if profile["data_format"] == "hex" else 7)
    return size, size


def version(text: str | None) -> tuple[int, ...] | None:
    """A firmware as numbers that can be compared."""
    return None if text is None else tuple(map(int, text[1:].split(".")))


def is_old(profile: Record) -> bool:
    """Whether readings out of range have five characters."""
    firmware = version(profile["firmware"])
    return profile["model"].startswith("I-7018") and firmware is not None and firmware <= (1, 4)


def digits(field: Record, profile: Record) -> int:
    """The characters of a field that is no text."""
    model = MODELS[profile["model"]]
    single_ended = profile["single_ended"] and model["single_ended_by_command"]
    match field["name"], field["digits"]:
        case "mask", _ if field["notation"] == "NN":
            size = 4 if model["name"] == "M-7019Z" else 2
        case "mask", _:
            size = (single_ended and model["mask_digits_single_ended"]) or model["mask_digits"]
        case "channel", [*_]:
            size = 2 if single_ended else 1
        case "values" | "value" as name, told:
            channels = model["single_ended_channels"] if single_ended else model["channels"]
            one = 4 if told == 4 or profile["data_format"] == "hex" else 7
            size = one * channels if name == "values" else one
        case _, told:
            size = told
    return int(size)


def field_fault(field: Record, text: str, profile: Record) -> Misfit | None:
    """The first thing from the left that is wrong with the characters of a field."""
    name = field["name"]
    if name in CHOICES:
        return None if text in CHOICES[name] else (0, "value")
    if name in ("name", "version"):
        return next(((at, "character") for at, letter in enumerate(text) if letter in "%#$~@!>?"), None)
    if name == "temperature":
        return None if re.fullmatch(r"[+-]\d{4}\.\d", text, re.ASCII) else (0, "number")
    if name in ("values", "value"):
        return readings_fault(field, text, profile)
    signed = name == "offset"
    if signed and text[0] not in "+-":
        return 0, "number"
    wrong = (at for at, digit in enumerate(text[signed:], signed) if digit not in "0123456789ABCDEF")
    return next(((at, "character") for at in wrong), None)


def readings_fault(field: Record, text: str, profile: Record) -> Misfit | None:
    """The first reading that is none, or another number of them than channels."""
    form = "hex" if field["digits"] == 4 else profile["data_format"]
    size = 4 if form == "hex" else 7
    old = is_old(profile)
    fields = re.findall(OLD_FIELDS[form], text) if old else re.findall(f".{{1,{size}}}", text)
    if len(fields) != digits(field, profile) // size:
        return -1, "length"
    fault = "character" if form == "hex" else "number"
    for one in fields:
        if not re.fullmatch(READINGS[form], one, re.ASCII) and not (old and one in OLD_SENTINELS):
            return 0, fault
    return None


def misfit(syntax: str, fields: list[Record], body: str, profile: Record) -> Misfit | None:
    """Why a body is not what a syntax describes: its length, or the first thing from the left; None if it is."""
    parts = pieces(syntax, fields)
    widths = [width(part, profile) for part in parts]
    shortest, longest = (sum(sizes) for sizes in zip(*widths, strict=True))
    if not shortest <= len(body) <= longest:
        return -1, "length"
    at = 0
    for part, (_, most) in zip(parts, widths, strict=True):
        text = body[at : at + most]
        if isinstance(part, str):
            wrong = None if text == part else (0, "character")
        else:
            wrong = field_fault(part, text, profile)
        if wrong:
            return at + wrong[0], wrong[1]
        at += len(text)
    return None


def candidates(body: str) -> list[Record]:
    """The commands that a body could be meant for, by section."""
    lead = [row for row in COMMANDS if row["syntax"][0] == body[0]]
    if body[0] in "%#":
        return lead
    if len(body) <= len("~**"):
        return [row for row in lead if row["syntax"] == "~**" and body[1:2] == "*"]
    return [row for row in lead if row["syntax"][3:4] == body[3]]


def has(row: Record, profile: Record) -> bool:
    """Whether the module has a command."""
    if profile["model"] not in row["models"]:
        return False
    since, firmware = version(row["models"][profile["model"]]), version(profile["firmware"])
    return since is None or firmware is None or firmware >= since


def command_of(body: str, profile: Record) -> tuple[str, str]:
    """The section of the command that a body is, or its fault; one of the two is empty."""
    meant = candidates(body)
    misfits = {row["section"]: misfit(row["syntax"], row["fields"], body, profile) for row in meant}
    fitting = [row for row in meant if misfits[row["section"]] is None]
    for row in fitting:
        if has(row, profile):
            return row["section"], ""
    if fitting:
        return "", "unsupported"
    if not meant:
        return "", "command" if len(body) > len("~**") else "length"
    judged = [row for row in meant if has(row, profile)] or meant
    found = [wrong for row in judged if (wrong := misfits[row["section"]])]
    return "", max(found, key=lambda wrong: wrong[0])[1]


def is_other_text(response: str, text: str) -> bool:
    """Whether a name is what another command is answered, or a version has not the form of one."""
    if response == "ModuleName":
        return re.fullmatch(OTHER_ANSWERS, text, re.ASCII) is not None
    return response == "FirmwareVersion" and re.fullmatch(VERSION, text, re.ASCII) is None


def response_fault(row: Record, sent: Record, body: str, profile: Record) -> str:
    """The fault of a response to a command with these fields, or an empty text."""
    syntax, fields = row["response_syntax"], row["response_fields"]
    if body[0] == "?":
        syntax, fields = "?AA", fields and [{"name": "address", "notation": "AA", "digits": 2}]
    wrong = misfit(syntax, fields, body, profile)
    if wrong:
        return wrong[1]
    if "AA" not in syntax:
        return ""
    if body[0] != "?" and is_other_text(row["response"], body[3:]):
        return "value"
    expected = sent["new_address"] if "new_address" in sent and body[0] == "!" else sent["address"]
    if int(body[1:3], 16) != expected and not (row["section"] == "2.10" and expected == 0):
        return "address"
    return "value" if row["section"] == "2.16" and body[0] == "!" and _channel(body) != sent["channel"] else ""


def _channel(body: str) -> int:
    return int(body[4 : body.index("R")], 16)
