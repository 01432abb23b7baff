"""The pages of ``spec/``: their text, and the tables of their examples, for the tests that hold them to the code."""

from __future__ import annotations

import re

from tests.spec import lint

PAGES = sorted(lint.SPEC.glob("*.md"))


def page(name: str) -> str:
    """The text of one page."""
    return (lint.SPEC / name).read_text(encoding="utf-8")


def section(name: str, heading: str) -> str:
    """The text of one page from a heading to the next of its level or above."""
    level, text = heading.count("#"), page(name)
    found = re.split(rf"^#{{1,{level}}} ", text.partition(f"\n{heading}\n")[2], maxsplit=1, flags=re.MULTILINE)[0]
    assert found, f"{name} has no {heading}"
    return found


def tables(text: str) -> list[list[list[str]]]:
    """The tables of a text as rows of cells, without their headings and code marks."""
    blocks = re.findall(r"(?:^\|.*\n?)+", text, re.MULTILINE)
    return [[cells(line) for line in block.splitlines()[2:]] for block in blocks]


def cells(line: str) -> list[str]:
    """The cells of a row; a cell that is nothing but code is the code, blanks included."""
    found = re.split(r"(?<!\\)\|", line.strip().strip("|"))
    return [re.fullmatch(r" `([^`]*)` | *(.*?) *", cell).expand(r"\1\2") if cell else "" for cell in found]  # type: ignore[union-attr]


def anchors(text: str) -> set[str]:
    """The anchors of the headings of a page, as GitHub names them."""
    headings = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading).lower().replace(" ", "-") for heading in headings}
