"""Mutants of the files of ``spec/``: one cell of one row, vector or story.

A number is one more or less, a truth value the other one, a name or a null another value of the same column, a wire has
another digit or two neighbours swapped (and its text in characters goes with it), two items of a list are swapped, or
one is dropped; an erratum is dropped from ``errata.json``.

Laws: a mutant is as canonical as the file, so that nothing notices it by its layout alone. Left out is what no test can
hold against anything: prose, the ids of vectors and stories, and the profile of a vector or the time of a step, because
most exchanges are as true under another profile or at another time.
"""

from __future__ import annotations

import copy
import json
import re
from collections import defaultdict
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any, TypeAlias

from tests.mutation.mutant import Mutant
from tests.spec.lint import canonical, records
from tests.spec.test_lint import eyes

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

Step: TypeAlias = str | int
Place: TypeAlias = tuple[Step, ...]
"""How to reach a cell: keys of objects and indices of lists, from the whole file."""

PROSE = frozenset({"comment", "description", "meaning", "what", "reading", "evidence"})
FREE = frozenset({"id", "profile", "at"})
"""Not in tables: of a vector or story."""

UNORDERED = frozenset({"used_by"})
"""Lists whose order says nothing."""

SETS = frozenset({"models", "types"})
"""Objects whose keys are data: a key can be dropped."""

WIRE = re.compile(r"(?:[0-9a-f]{2})+")
DROPPED = object()
"""In place of the new value of a cell: it goes."""


class CellMutant(Mutant):
    """A file of ``spec/`` with some cells replaced."""

    def __init__(self, file: str, text: str, data: Any, cells: Mapping[Place, Any]) -> None:
        super().__init__(file, text)
        self._data, self._cells = data, cells

    @cached_property
    def after(self) -> str:
        """The whole text of the file with the change."""
        data = copy.deepcopy(self._data)
        for (*way, last), value in self._cells.items():
            place = data
            for step in way:
                place = place[step]
            if value is DROPPED:
                del place[last]
            else:
                place[last] = value
        return canonical(data)


def cell_mutants(file: str, text: str) -> list[CellMutant]:
    """Every mutant of one file of ``spec/``, in the order of the text."""
    data = json.loads(text)
    assert canonical(data) == text, f"{file} is not canonical"
    key = next(name for name in ("vectors", "stories", "rows") if name in data)
    skipped = PROSE | {"notes"} if key == "rows" else PROSE | FREE
    columns: dict[Place, list[Any]] = defaultdict(list)
    for place, value in _leaves(data[key], (key,)):
        column = columns[_column(place)]
        if value not in column:
            column.append(value)
    found: list[CellMutant] = []
    for index, record in enumerate(records(data)):
        if file.endswith("errata.json"):
            found.append(CellMutant(file, text, data, {(key, index): DROPPED}))
        found += (CellMutant(file, text, data, cells) for cells in _changes(record, (key, index), columns, skipped))
    return found


def _column(place: Place) -> Place:
    return tuple("*" if isinstance(step, int) else step for step in place)


def _leaves(value: Any, place: Place) -> Iterator[tuple[Place, Any]]:
    match value:
        case dict():
            for key, item in value.items():
                yield from _leaves(item, (*place, key))
        case list():
            for index, item in enumerate(value):
                yield from _leaves(item, (*place, index))
        case _:
            yield place, value


def _changes(
    value: Any, place: Place, columns: Mapping[Place, Sequence[Any]], skipped: frozenset[str]
) -> Iterator[dict[Place, Any]]:
    match value:
        case dict():
            for key, item in value.items():
                if key not in skipped:
                    yield from _changes_of_a_column(value, key, item, place, columns, skipped)
        case list():
            yield from ({(*place, index): DROPPED} for index in range(len(value)))
            for index, (left, right) in enumerate(pairwise(value)):
                if left != right and place[-1] not in UNORDERED:
                    yield {(*place, index): right, (*place, index + 1): left}
            for index, item in enumerate(value):
                yield from _changes(item, (*place, index), columns, skipped)
        case _:
            yield from ({place: new} for new in other_values(value, columns[_column(place)]))


def _changes_of_a_column(  # noqa: PLR0913, PLR0917 - what `_changes` has, and a column
    record: Mapping[str, Any],
    key: str,
    item: Any,
    place: Place,
    columns: Mapping[Place, Sequence[Any]],
    skipped: frozenset[str],
) -> Iterator[dict[Place, Any]]:
    if key in SETS and isinstance(item, dict):
        yield from ({(*place, key, name): DROPPED} for name in item)
    text = _text_key(key, record)
    if text and isinstance(item, str):
        for wire in other_wires(item):
            yield {(*place, key): wire, (*place, text): eyes(wire)}
    elif not _is_text_of_a_wire(key, record):
        yield from _changes(item, (*place, key), columns, skipped)


def _text_key(key: str, record: Mapping[str, Any]) -> str | None:
    """The column with the characters of a wire."""
    text = "text" if key == "wire" else key.removesuffix("_wire") + "_text" if key.endswith("_wire") else None
    return text if text in record else None


def _is_text_of_a_wire(key: str, record: Mapping[str, Any]) -> bool:
    wire = "wire" if key == "text" else key.removesuffix("_text") + "_wire" if key.endswith("_text") else None
    return wire in record


def other_wires(wire: str) -> Iterator[str]:
    """Yield a wire with its middle digit changed, with its last one changed, and with two bytes swapped."""
    if not wire:
        yield "00"
        return
    for at in dict.fromkeys((len(wire) // 2, len(wire) - 1)):
        yield f"{wire[:at]}{(int(wire[at], 16) + 1) % 16:x}{wire[at + 1 :]}"
    pairs = [wire[at : at + 2] for at in range(0, len(wire), 2)]
    for at in range(len(pairs) // 2, len(pairs) - 1):
        if pairs[at] != pairs[at + 1]:
            yield "".join((*pairs[:at], pairs[at + 1], pairs[at], *pairs[at + 2 :]))
            return


def other_values(value: Any, column: Sequence[Any]) -> Iterator[Any]:
    """Yield what stands in place of a single value: one more and one less, the opposite, another of its column."""
    match value:
        case bool():
            yield not value
        case int() | float():
            yield value + 1
            yield value - 1
        case str() if len(value) > 2 and WIRE.fullmatch(value):
            yield from other_wires(value)
        case _:
            others = [other for other in column if other != value]
            if others:
                yield others[len(str(value)) % len(others)]
            elif isinstance(value, str) and any(map(str.isdigit, value)):
                yield re.sub(r"\d(?=\D*$)", lambda digit: str((int(digit[0]) + 1) % 10), value)
