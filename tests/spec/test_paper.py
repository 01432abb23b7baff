"""What chapter 2 of the manual prints, typed from the paper once more, against the tables and vectors made from it."""

from __future__ import annotations

import re
from itertools import chain
from typing import TYPE_CHECKING, NamedTuple

import pytest

from tests.spec import lint
from tests.spec.cells import Cell, row_id, wrong

if TYPE_CHECKING:
    from pathlib import Path

COMMANDS = {row["section"]: row for row in lint.rows("dcon_commands")}
FILE = "tables/dcon_commands.json"


class Printed(NamedTuple):
    """A section: its title, its syntax line, its valid response, its line of the summary, and its example commands."""

    title: str
    syntax: str
    response: str | None
    summary_syntax: str
    summary_response: str | None
    examples: tuple[str, ...]


def _alike(syntax: str, response: str | None, examples: tuple[str, ...]) -> Printed:
    """A section that prints its syntax and response alike in all three places."""
    return Printed(syntax, syntax, response, syntax, response, examples)


PAPER = {
    "2.1": _alike("%AANNTTCCFF", "!AA", ("%0102000600", "%0202000602", "%0101000A00", "%0101000A00")),
    "2.2": _alike("#**", None, ("#**", "$014", "$014")),
    "2.3": _alike("#AA", ">(Data)", ("#01", "#02", "#03")),
    "2.4": Printed("#AAN, #AANN", "#AAN", ">(Data)", "#AAN", ">(Data)", ("#032", "#0511", "#029")),
    "2.5": _alike("$AA0", "!AA", ("$010", "$020")),
    "2.6": _alike("$AA1", "!AA", ("$011", "$021")),
    "2.7": _alike("$AA0Ci", "!AA", ("$010C0", "$020C5", "$030C1")),
    "2.8": _alike("$AA0Ci", "!AA", ("$010C0", "$020C5", "$030C1")),
    "2.9": _alike("$AA1Ci", "!AA", ("$011C0", "$021C5", "$031C1")),
    "2.10": Printed("$AA2", "$AA2", "!AATTCCFF", "$AA2", "!AANNTTCCFF", ("$012", "$022")),
    "2.11": _alike("$AA3", ">(Data)", ("$013",)),
    "2.12": _alike("$AA4", ">AAS(Data)", ("$014", "#**", "$014", "$014")),
    "2.13": Printed("$AA5VV, $AA5VVVV", "$AA5VV(VV)", "!AA", "$AA5VV", "!AA", ("$0153A", "$016")),
    "2.14": Printed("$AA6", "$AA6", "!AAVV(VV)", "$AA6", "!AAVV", ("$0153A", "$016")),
    "2.15": Printed("$AA7CiRrr", "$AA7CiRrr", "!AA ", "$AA7CiRrr", "!AA", ("$017C0R03", "$027C5R16", "$037C1R30")),
    "2.16": _alike("$AA8Ci", "!AACiRrr", ("$018C0",)),
    "2.17": _alike("$AA9", "!AA(Data)", ("$019",)),
    "2.18": _alike("$AA9SNNNN", "!AA", ("$019+0010",)),
    "2.19": Printed("$AAA", "$AAA", ">(Data)", "$AAA", ">(data)", ("$01A",)),
    "2.20": _alike("$AAA", "!AAi", ("$01A",)),
    "2.21": _alike("$AAAi", "!AA", ("$01A1",)),
    "2.22": _alike("$AAB", "!AANN", ("$01B",)),
    "2.23": _alike("$AAF", "!AA(Data)", ("$01F",)),
    "2.24": Printed("$AAM", "$AAM", "!AA(Name)", "$AAM", "!AA(Data)", ("$01M",)),
    "2.25": _alike("$AAP", "!AASC", ("$01P",)),
    "2.26": _alike("$AAPN", "!AA", ("$01P1", "$01P1")),
    "2.27": _alike("$AAS0", "!AA", ("$01S0",)),
    "2.28": _alike("$AAS1", "!AA", ("$01S1",)),
    "2.29": _alike("~AAC", "!AAN", ("~01C",)),
    "2.30": _alike("~AACN", "!AA", ("~01C0",)),
    "2.31": _alike("~AAEV", "!AA", ("$010", "~01E1", "$010")),
    "2.32": _alike("~AAI", "!AA", ("~01I",)),
    "2.33": _alike("~AAO(Name)", "!AA", ("~01O7019A", "$01M")),
    "2.34": _alike("~AATnn", "!AA", ("~01I", "%0101000700", "~01T10", "~01I", "%0101000700")),
    "2.35": _alike("~**", None, ("~**",)),
    "2.36": _alike("~AA0", "!AASS", ("~010", "~020")),
    "2.37": _alike("~AA1", "!AA", ("~010", "~011", "~010")),
    "2.38": Printed("~AA2", "~AA2", "!AAEVV", "~AA2", "!AAETT", ("~012",)),
    "2.39": Printed("~AA3EVV", "~AA3EVV", "!AA", "~AA3ETT", "!AA", ("~013164", "~012")),
    "2.40": Printed("~AAEO", "~AAEE", "!AAN", "~AAEO", "!AAN", ("~01EO",)),
    "2.41": Printed("~AAEON", "~AAEEN", "!AA", "~AAEON", "!AA", ("~01EO0",)),
    "2.42": _alike("@AAS", "!AAN", ("@01S",)),
    "2.43": Printed("@AASN", "@AAPN", "!AA", "@AASN", "!AA", ("@01S1",)),
}
OF_CHAPTER_2 = {"2.10": ("$012B7",)}
"""The command whose checksum the head of the chapter computes."""


def differences(section: str) -> dict[str, str]:
    """What a section prints otherwise than the row of the table has it."""
    row, paper = COMMANDS[section], PAPER[section]
    chosen = {"title": row["syntax"], "syntax": row["syntax"], "summary_syntax": row["syntax"]}
    chosen |= {"response": row["response_syntax"], "summary_response": row["response_syntax"]}
    return {key: value for key, value in paper._asdict().items() if key in chosen and value != chosen[key]}


@pytest.mark.parametrize("section", PAPER)
def test_a_row_has_what_its_section_prints_otherwise(section: str) -> None:
    row = COMMANDS[section]

    assert wrong([Cell(FILE, row_id(row), "printed", row["printed"], differences(section))]) == []


@pytest.mark.parametrize("section", PAPER)
def test_the_vectors_of_a_section_have_its_printed_examples(section: str) -> None:
    [path] = (path for path in lint.vector_files("dcon") if path.name.startswith(f"{section}-"))
    found = [vector["command_text"] for vector in lint.records(lint.load(path)) if vector["source"] == "manual"]
    expected = [*OF_CHAPTER_2.get(section, ()), *PAPER[section].examples]

    assert wrong([Cell(lint.name(path), "of source manual", "command_text", found, expected)]) == []


PAUSES = {
    "2.2": (0.002, "before the next command", None, None),
    "2.8": (16, "until done", None, "B2.6"),
    "2.9": (16, "until done", None, "B2.6"),
    "2.28": (3, "until done", "B2.7", None),
    "2.35": (0.002, "before the next command", None, None),
}
"""How long to wait after a command, as its section says it."""


@pytest.mark.parametrize("section", COMMANDS)
def test_a_pause_is_the_one_that_the_section_prints(section: str) -> None:
    pause = COMMANDS[section]["pause"]
    found = None if pause is None else tuple(pause.values())

    assert wrong([Cell(FILE, section, "pause", found, PAUSES.get(section))]) == []


# Sources


def expand(text: str) -> list[str]:
    """The sections in the source of a file; 2.1-2.43 stands for all between."""
    found = []
    for part in re.findall(r"[\dA][\d.]*(?:-[\d.]+)?", text.partition("section")[2]):
        first, _, last = part.partition("-")
        chapter, _, number = first.rpartition(".")
        found += [f"{chapter}.{at}" for at in range(int(number), int(last.rpartition(".")[2]) + 1)] if last else [part]
    return found


def is_within(section: str, sections: list[str]) -> bool:
    return any(section == known or section.startswith(f"{known}.") for known in sections)


def sections_of(path: Path) -> list[str]:
    """The sections that the records of a file, or the file as a whole, name."""
    data = lint.load(path)
    if path.parent.name == "modbus_registers" or "section" in data:
        return [data["section"]]
    return sorted(set(chain.from_iterable(row.get("sections", [row.get("section")]) for row in lint.records(data))))


WITH_SECTIONS = [
    path
    for path in lint.data_files()
    if path.name != "errata.json"
    and ({"section", "sections"} & lint.records(lint.load(path))[0].keys() or "section" in lint.load(path))
]


@pytest.mark.parametrize("path", WITH_SECTIONS, ids=lint.name)
def test_the_source_of_a_file_names_the_sections_of_its_records_and_no_other(path: Path) -> None:
    named, used = expand(lint.load(path)["source"]), sections_of(path)
    missing = [section for section in used if not is_within(section, named)]
    idle = [section for section in named if not any(is_within(other, [section]) for other in used)]

    assert wrong([Cell(lint.name(path), "of the file", "source", (missing, idle), ([], []))]) == []


def printed_readings() -> set[tuple[str, str, str]]:
    """The fields that 1.11 prints: the ends of every type, and what stands in place of a reading where it is stated."""
    ends = {
        (row["code"], row["format"], row[end]) for row in lint.rows("full_scale") for end in ("plus_fs", "minus_fs")
    }
    special = {
        (code, row["format"], row["value"])
        for row in lint.rows("settings")
        if row["setting"] == "sentinel" and "E50" not in row["errata"]
        for code in row["types"] or []
    }
    return ends | special


@pytest.mark.parametrize("form", ["engineering", "percent", "hex"])
def test_a_reading_is_of_the_manual_where_its_field_is_printed(form: str) -> None:
    path = lint.SPEC / "vectors" / "readings" / f"{form}.json"
    printed = printed_readings()
    cells = []
    for vector in lint.records(lint.load(path)):
        expected = (vector["type_code"], form, vector["text"]) in printed
        cells.append(Cell(lint.name(path), vector["id"], "source: manual", vector["source"] == "manual", expected))

    assert wrong(cells) == []
