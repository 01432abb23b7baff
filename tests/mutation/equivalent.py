"""The mutants that no test can notice, with the reason: ``equivalent.json`` lists them by file and changed lines."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable

    from tests.mutation.mutant import Mutant

PATH = Path(__file__).with_name("equivalent.json")


class Equivalent(NamedTuple):
    """One entry."""

    file: str
    changes: tuple[str, ...]
    reason: str


def read(path: Path = PATH) -> list[Equivalent]:
    """Return the entries of the list."""
    records = json.loads(path.read_text(encoding="utf-8"))
    return [Equivalent(record["file"], tuple(record["changes"]), record["reason"]) for record in records]


def bare(changes: Iterable[str]) -> tuple[str, ...]:
    """Return changed lines without their indentation."""
    return tuple(change[0] + change[1:].strip() for change in changes)


def reason_of(mutant: Mutant, entries: Iterable[Equivalent]) -> str | None:
    """Return why a mutant is equivalent, or None where the list does not have it."""
    changes = bare(mutant.changes)
    return next((entry.reason for entry in entries if entry.file == mutant.file and entry.changes == changes), None)
