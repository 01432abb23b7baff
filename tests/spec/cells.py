"""How a test of the data names what is wrong: file, row, column, what is there and what is expected."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable

    from tests.spec.lint import Record


class Cell(NamedTuple):
    """One cell of a table, and what should be there."""

    file: str
    row: str
    column: str
    there: Any
    expected: Any


def row_id(row: Record) -> str:
    """The columns that name a row in its table."""
    keys = ("id", "section", "function", "setting", "code", "format", "name", "area", "value")
    return " ".join(str(row[key]) for key in keys if row.get(key) is not None)


def wrong(cells: Iterable[Cell]) -> list[str]:
    """Describe the cells that are not as they should be."""
    return [
        f"{cell.file}: row {cell.row}, column {cell.column}: {cell.there!r}, expected {cell.expected!r}"
        for cell in cells
        if cell.there != cell.expected
    ]
