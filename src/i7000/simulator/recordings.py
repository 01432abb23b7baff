"""What was recorded on inputs, read from CSV files.

Laws: a file is read once, in blocks, and kept as arrays of numbers. One regular expression reads the rows of a block;
a block with rows that it does not match is read row by row, with the same outcome. Errors name the line.
"""

import csv
import io
import os
import re
from array import array
from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import islice
from math import inf
from operator import ge
from typing import TextIO

from i7000.errors import EncodeError
from i7000.simulator.files import open_regular
from i7000.simulator.sources import Recorded
from i7000.type_codes import Unit

__all__ = ["MOST_BYTES", "MOST_ROWS", "read_recording"]

MOST_BYTES = 200_000_000
MOST_ROWS = 2_000_000
_BLOCK = 1 << 16
"""Characters that are read at once; also the longest line."""
_SHOWN = 60
"""Characters of a file that a message shows."""

_NUMBER = r"[+-]?(?:[0-9]++(?:\.[0-9]*+)?+|\.[0-9]++)(?:[eE][+-]?[0-9]++)?+[ \t]*+"
_QUOTED = re.compile(r"""(?:^|(?<=,))"(?:[^"\n]++|"")*+"(?=[,\n])""", re.MULTILINE)
"""A quoted cell, which only a column that is not read may have in a block that is read at once."""


def read_recording(path: str | os.PathLike[str], units: Mapping[str, Unit]) -> dict[str, Recorded]:
    """Read columns of a CSV file, those that `units` names; the other ones may hold anything.

    Shape: a line with the names of the columns: ``seconds``, numbers of channels, `COLD_JUNCTION`. Every further line
        is a row with one value for each column: a number with a decimal point, or ``open``; seconds rise. Empty lines
        do not count. At most `MOST_ROWS` rows and `MOST_BYTES` bytes.
    Errors: `EncodeError` that names the line; `UnsuitableFileError`; `OSError`.
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
        lines, cells = columns.read(first, block)
        for name, column in zip(columns.names, cells, strict=False):
            found[name].fromlist(_numbers(name, lines, column))
        _check_seconds(seconds, lines)
    if not seconds:
        raise EncodeError("rows", 0, "one at least", "", f"line {line}: no rows follow")
    return {name: Recorded(seconds, found[name], unit) for name, unit in units.items()}


def _header(text: TextIO, names: Collection[str]) -> tuple[int, list[str]]:
    """Read the names of the columns, and the number of their line."""
    line, header = 1, _cells(1, text.readline(_BLOCK))
    while not any(header) and (read := text.readline(_BLOCK)):
        line, header = line + 1, _cells(line + 1, read)
    for name in names:
        if header.count(name) != 1:
            found = ", ".join(header)[:_SHOWN] or "none"
            raise EncodeError("columns", header, f"one of them {name}", "", f"line {line}: the columns are {found}")
    return line, header


def _blocks(text: TextIO, line: int) -> Iterator[tuple[int, str]]:
    """Yield the lines that follow, many at once, and the number of the first."""
    rest = ""
    while block := text.read(_BLOCK):
        whole, end, rest = (rest + block).rpartition("\n")
        if end:
            yield line, whole + end
            line += whole.count("\n") + 1
        if len(rest) > _BLOCK:
            raise EncodeError("line", line, f"{_BLOCK} characters", "", f"line {line}: it is too long")
    if rest:
        yield line, rest + "\n"


class _Columns:
    """The columns of a file, and those of them that are read: `names`, in the order of the file."""

    def __init__(self, header: Sequence[str], names: Collection[str]) -> None:
        self.names = [name for name in header if name in names]
        self._header = header
        forms = (rf"(?:[ \t]*+{_form(name)})" if name in names else r'[^",\n]*+' for name in header)
        self._rows = re.compile(rf"(?:{','.join(forms)}\n)*+")

    def read(self, first: int, block: str) -> tuple[Sequence[int], list[Sequence[str]]]:
        """Return the numbers of the lines of a block that are rows, and the cells of each column that is read."""
        plain = _QUOTED.sub("", block) if '"' in block else block
        if self._rows.fullmatch(plain):
            cells = plain.replace("\n", ",").split(",")
            columns: list[Sequence[str]] = [
                cells[self._header.index(name) : -1 : len(self._header)] for name in self.names
            ]
            return range(first, first + len(columns[0])), columns
        rows = {}
        for line, text in enumerate(block.split("\n"), first):
            row = _cells(line, text)
            if any(row):
                rows[line] = self._row_of(line, row)
        return list(rows), list(zip(*rows.values(), strict=True))

    def _row_of(self, line: int, cells: Sequence[str]) -> tuple[str, ...]:
        if len(cells) != len(self._header):
            allowed = f"one for each of {len(self._header)} columns, decimals with a point"
            raise EncodeError("row", cells, allowed, "", f"line {line}: there are {len(cells)} values")
        named = [(name, cell) for name, cell in zip(self._header, cells, strict=True) if name in self.names]
        for name, cell in named:
            if not re.fullmatch(_form(name), cell):
                raise _wrong(line, name, cell)
        return tuple([cell for _, cell in named])


def _form(name: str) -> str:
    return _NUMBER if name == "seconds" else f"{_NUMBER}|open"


def _cells(line: int, text: str) -> list[str]:
    try:
        return [cell.strip() for row in csv.reader([text], strict=True) for cell in row]
    except csv.Error as error:
        raise EncodeError("line", line, "values with commas between", "", f"line {line}: {error}") from None


def _numbers(name: str, lines: Sequence[int], cells: Sequence[str]) -> list[float]:
    """Convert the cells of a column; an open wire is nan."""
    numbers = list(map(float, ["nan" if cell == "open" else cell for cell in cells] if "open" in cells else cells))
    if inf in map(abs, numbers):
        at = list(map(abs, numbers)).index(inf)
        raise _wrong(lines[at], name, cells[at])
    return numbers


def _check_seconds(seconds: "array[float]", lines: Sequence[int]) -> None:
    """Refuse times, the last of which are those of `lines`, that do not rise or are too many."""
    if len(seconds) > MOST_ROWS:
        raise EncodeError("rows", len(seconds), f"{MOST_ROWS} rows", "", f"line {lines[-1]}: there are too many rows")
    start = len(seconds) - len(lines)
    if start == 0 and lines and seconds[0] < 0:
        raise EncodeError("seconds", seconds[0], "0 or more", "", f"line {lines[0]}: seconds cannot be {seconds[0]}")
    last = seconds[max(0, start - 1) :]
    if any(map(ge, last, islice(last, 1, None))):
        at = next(at for at in range(max(1, start), len(seconds)) if seconds[at - 1] >= seconds[at])
        reason = f"line {lines[at - start]}: seconds cannot be {seconds[at]}"
        raise EncodeError("seconds", seconds[at], f"more than the {seconds[at - 1]:g} before", "", reason)


def _wrong(line: int, name: str, cell: str) -> EncodeError:
    allowed = "a number as 12.5 or -1e-3" + ("" if name == "seconds" else ", or open")
    return EncodeError(name, cell, allowed, "", f"line {line}: {name} cannot be {cell!r:.{_SHOWN}}")
