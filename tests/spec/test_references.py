"""Nothing under ``spec/`` needs anything outside it, and what it refers to is there."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest

from tests.spec import lint
from tests.spec.pages import PAGES

if TYPE_CHECKING:
    from pathlib import Path

TEXTS = [*PAGES, *lint.data_files(), *lint.schema_files()]
OUTSIDE = re.compile(
    r"\bsrc/\S*|\btests?[/.][a-z]\S*|\bpytest\b|\bpython\b|\S+\.py\b|\bi7000\b|\.\./\S*", re.IGNORECASE
)
"""The program, its tests and its tools: what a reader of ``spec/`` alone does not have."""
INSIDE = re.compile(r"`((?:tables|vectors|stories|schema)/[\w./-]+)`")


def references(pattern: re.Pattern[str], path: Path) -> list[str]:
    lines = path.read_text(encoding="utf-8").splitlines()
    found = ((number, reference) for number, line in enumerate(lines, 1) for reference in pattern.findall(line))
    return [f"{lint.name(path)}: line {number} refers to {reference!r}" for number, reference in found]


@pytest.mark.parametrize("path", TEXTS, ids=lint.name)
def test_a_file_refers_to_nothing_outside(path: Path) -> None:
    assert references(OUTSIDE, path) == []


def test_every_file_that_the_pages_refer_to_exists() -> None:
    text = "".join(path.read_text(encoding="utf-8") for path in PAGES)
    missing = [path for path in INSIDE.findall(text) if not (lint.SPEC / path).exists()]

    assert missing == []
