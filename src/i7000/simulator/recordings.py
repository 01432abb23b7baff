"""Recorded input signals, read from CSV files.

Laws: a file is read once, in blocks, and stored as arrays of numbers. One regular expression reads the rows of a block;
if it does not match, the block is read row by row, with the same result. Errors name the line.
"""

import csv
import io
import os
import re
from array import array
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import islice
from math import inf, isfinite, nan
from operator import ge
from typing import TextIO

from i7000.errors import InvalidValueError
from i7000.simulator.files import open_regular
from i7000.simulator.sources import Recorded
from i7000.type_codes import Unit

__all__ = ["MOST_BYTES", "MOST_ROWS", "read_recording"]

MOST_BYTES = 200_000_000
MOST_ROWS = 2_000_000
_BLOCK = 1 << 16
"""The number of characters read at once, and so the longest line."""
_TWICE = 2
_SHOWN = 60
"""The maximum number of characters of a file shown in a message."""

_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_LIKE_A_NUMBER = r"[0-9.eE+ \t-]++"
"""Text with only the characters of numbers; it is a number if `float` accepts it."""
_QUOTED = re.compile(r"""(?:^|(?<=,))"(?:[^"\n]++|"")*+"(?=[,\n])""", re.MULTILINE)
"""A quoted cell; in a block that is read at once, only columns that are not read may have one."""


def read_recording(path: str | os.PathLike[str], units: Mapping[str, Unit]) -> dict[str, Recorded]:
    """Read the columns of a CSV file that `units` names; other columns may have any content.

    Shape: a line with the names of the columns: ``seconds``, numbers of channels, `COLD_JUNCTION`. Every further line
        is a row with one value for each column: a number with a decimal point, or ``open``; seconds rise. Empty lines
        are ignored. At most `MOST_ROWS` rows and `MOST_BYTES` bytes.
    Errors: `InvalidValueError` that names the line; `UnsuitableFileError`; `OSError`.
    """
    with (
        open_regular(path, MOST_BYTES) as file,
        io.TextIOWrapper(file, encoding="utf-8-sig", errors="surrogateescape") as text,
    ):
        return _recorded(text, units)


def _recorded(text: TextIO, units: Mapping[str, Unit]) -> dict[str, Recorded]:
    line, header = _header(text, ("seconds", *units))
    columns = _Columns(header, ("seconds", *units))
    found = {name: array("d") for name in columns.names}
    seconds = found["seconds"]
    for first, block in _blocks(text, line + 1):
        lines, numbers = columns.read(first, block)
        for name, column in zip(columns.names, numbers, strict=True):
            found[name].fromlist(column)
        _check_seconds(seconds, lines)
    if not seconds:
        raise InvalidValueError("rows", 0, "at least one", "", f"line {line}: no rows follow")
    return {name: Recorded(seconds, found[name], unit) for name, unit in units.items()}


def _header(text: TextIO, names: Collection[str]) -> tuple[int, list[str]]:
    """Read the names of the columns, and the number of their line."""
    line, header = 1, _cells(1, text.readline(_BLOCK))
    while not any(header) and (read := text.readline(_BLOCK)):
        line, header = line + 1, _cells(line + 1, read)
    for name in names:
        times = header.count(name)
        if times != 1:
            found = ", ".join(header)[:_SHOWN] or "none"
            wrong = f"{name} must be there once, not {'twice' if times == _TWICE else f'{times} times'}"
            allowed = wrong if times else f"they must include {name}"
            raise InvalidValueError("columns", header, allowed, "", f"line {line}: the columns are {found}")
    return line, header


def _blocks(text: TextIO, line: int) -> Iterator[tuple[int, str]]:
    """Yield the following lines in blocks, each with the number of its first line."""
    rest = ""
    while block := text.read(_BLOCK):
        whole, end, rest = (rest + block).rpartition("\n")
        if end:
            yield line, whole + end
            line += whole.count("\n") + 1
        if len(rest) > _BLOCK:
            raise InvalidValueError("line", line, f"{_BLOCK} characters", "", f"line {line}: it is too long")
    if rest:
        yield line, rest + "\n"


class _Columns:
    """The columns of a file, and the ones to read: `names`, in the order of the file."""

    def __init__(self, header: Sequence[str], names: Collection[str]) -> None:
        self.names = [name for name in header if name in names]
        self._header = header
        forms = (_form(name) if name in names else r'[^",\n]*+' for name in header)
        self._rows = re.compile(rf"(?:{','.join(forms)}\n)*+")

    def read(self, first: int, block: str) -> tuple[Sequence[int], list[list[float]]]:
        """Return the line numbers of the rows of a block, and the cells of each column to read."""
        plain = _QUOTED.sub("", block) if '"' in block else block
        if self._rows.fullmatch(plain):
            cells = plain.replace("\n", ",").split(",")
            columns = (cells[self._header.index(name) : -1 : len(self._header)] for name in self.names)
            with suppress(ValueError):
                return range(first, first + plain.count("\n")), list(map(_numbers, columns))
        rows = {}
        for line, text in enumerate(block.split("\n"), first):
            row = _cells(line, text)
            if any(row):
                rows[line] = self._row(line, row)
        return list(rows), [[row[name] for row in rows.values()] for name in self.names]

    def _row(self, line: int, cells: Sequence[str]) -> dict[str, float]:
        """Return the cells of the columns to read."""
        if len(cells) != len(self._header):
            allowed = f"one for each of {len(self._header)} columns, decimals with a point"
            raise InvalidValueError("row", cells, allowed, "", f"line {line}: there are {len(cells)} values")
        named = zip(self._header, cells, strict=True)
        return {name: _number(line, name, cell) for name, cell in named if name in self.names}


def _form(name: str) -> str:
    return _LIKE_A_NUMBER if name == "seconds" else f"(?:{_LIKE_A_NUMBER}|open)"


def _numbers(cells: Sequence[str]) -> list[float]:
    """Convert the cells of a column; an open wire is nan.

    Errors: `ValueError` without the line, also for a number too large for a float.
    """
    if "open" in cells:
        cells = ["nan" if cell == "open" else cell for cell in cells]
    numbers = list(map(float, cells))
    if not isfinite(sum(numbers)) and inf in map(abs, numbers):
        raise ValueError(inf)
    return numbers


def _number(line: int, name: str, cell: str) -> float:
    """Convert one cell; an open wire is nan."""
    if cell == "open" and name != "seconds":
        return nan
    number = float(cell) if _NUMBER.fullmatch(cell) else inf
    if not isfinite(number):
        allowed = "a number as 12.5 or -1e-3" + ("" if name == "seconds" else ", or open")
        raise InvalidValueError(name, cell, allowed, "", f"line {line}: {name} cannot be {cell!r:.{_SHOWN}}")
    return number


def _cells(line: int, text: str) -> list[str]:
    try:
        return [cell.strip() for row in csv.reader([text], strict=True) for cell in row]
    except csv.Error as error:
        raise InvalidValueError("line", line, "values with commas between", "", f"line {line}: {error}") from None


def _check_seconds(seconds: "array[float]", lines: Sequence[int]) -> None:
    """Raise an error for times that do not rise or are too many; `lines` are the lines of the last ones."""
    if len(seconds) > MOST_ROWS:
        raise InvalidValueError(
            "rows", len(seconds), f"{MOST_ROWS} rows", "", f"line {lines[-1]}: there are too many rows"
        )
    start = len(seconds) - len(lines)
    if start == 0 and lines and seconds[0] < 0:
        raise InvalidValueError(
            "seconds", seconds[0], "0 or more", "", f"line {lines[0]}: seconds cannot be {seconds[0]}"
        )
    last = seconds[max(0, start - 1) :]
    if any(map(ge, last, islice(last, 1, None))):
        at = next(at for at in range(max(1, start), len(seconds)) if seconds[at - 1] >= seconds[at])
        reason = f"line {lines[at - start]}: seconds cannot be {seconds[at]}"
        raise InvalidValueError("seconds", seconds[at], f"more than the {seconds[at - 1]:g} before", "", reason)
