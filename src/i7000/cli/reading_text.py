"""Readings as text: a table, lines, CSV and JSON.

Laws: a line is complete when it is written, and written when it is complete: Ctrl-C loses none and cuts none.
"""

import json
import sys
from collections.abc import Callable, Iterator
from datetime import datetime
from io import FileIO
from pathlib import Path
from typing import Any

from attrs import frozen

from i7000 import Profile, Reading, Status, TypeCode, describe
from i7000.cli.choices import SPOKEN
from i7000.cli.station import Polled, Station
from i7000.cli.text import Line, Printer
from i7000.cli.words import LineError, UsageError

__all__ = ["Csv", "Json", "Lines", "Row", "Table", "file_writer", "new_file", "printed", "rows"]

Writer = Callable[[str], None]
"""What writes a line."""

_STATUS_STYLES = {Status.OK.value: "", Status.DISABLED.value: "dim"}
NOT_UNDERSTOOD = "not_understood"
"""The status of a reading that is not a number of the type."""


@frozen
class Row:
    """A channel in words; one of the whole module has no channel."""

    channel: str
    value: str = ""
    unit: str = ""
    status: str = ""
    type: str = ""

    @property
    def style(self) -> str:
        """The style in which the row is shown."""
        return _STATUS_STYLES.get(self.status, "yellow")


def rows(polled: Polled) -> Iterator[Row]:
    """Yield the channels of a module, or one row that says why there are none."""
    readings = None if polled.report is None else polled.report.readings
    if readings is None or polled.profile is None:
        yield Row("all", status="not read" if polled.answered else "no answer")
        return
    for channel, reading in enumerate(readings):
        yield _row(channel, reading, polled.profile)


def _row(channel: int, reading: Reading | None, profile: Profile) -> Row:
    code = profile.type_codes[channel]
    if reading is None:
        return Row(f"{channel}", "", "", NOT_UNDERSTOOD, _type_words(code))
    value = "" if reading.value is None else describe.value(reading.value)
    return Row(f"{channel}", value, str(reading.unit), reading.status.value, _type_words(code))


def _type_words(code: TypeCode) -> str:
    """Return a type in a few words.

    >>> _type_words(TypeCode.K), _type_words(TypeCode.V_10)
    ('0F thermocouple K', '08 -10..10 V')
    """
    words = (
        f"thermocouple {code.thermocouple}" if code.thermocouple else f"{code.minimum:g}..{code.maximum:g} {code.unit}"
    )
    return f"{code:02X} {words}"


# --- where lines go ---------------------------------------------------------------------------------------------------


def printed(line: str) -> None:
    """Print a line, at once."""
    if sys.stdout:
        sys.stdout.write(f"{line}\n")
        sys.stdout.flush()


def new_file(path: Path) -> FileIO:
    """Create a file for lines.

    Errors: `UsageError` if it exists; `OSError` if it cannot be created.
    """
    try:
        return FileIO(path, "x")
    except FileExistsError:
        raise UsageError(f"--output {path}: the file exists; give the name of a new one") from None


def file_writer(file: FileIO, path: Path) -> Writer:
    """Return what writes lines to a file, each at once.

    Errors: of the returned function: `OSError` with the name of the file.
    """

    def write(line: str) -> None:
        data = f"{line}\n".encode()
        try:
            while data:
                data = data[file.write(data) :]
        except OSError as error:
            raise OSError(error.errno, error.strerror, str(path)) from None

    return write


# --- forms ------------------------------------------------------------------------------------------------------------


def _table(polled: tuple[Polled, ...]) -> Iterator[Line]:
    """Yield a table of all channels, with the addresses of several modules."""
    several = len(polled) > 1
    titles = (*(("address",) if several else ()), "channel", "value", "unit", "status", "type")
    texts = [
        ((describe.address(it.address),) if several else ()) + (row.channel, row.value, row.unit, row.status, row.type)
        for it in polled
        for row in rows(it)
    ]
    styles = [row.style for it in polled for row in rows(it)]
    widths = [max(map(len, column)) for column in zip(titles, *texts, strict=True)]
    yield [("  ".join(map(str.ljust, titles, widths)).rstrip(), "bold")]
    for cells, style in zip(texts, styles, strict=True):
        yield [("  ".join(map(str.ljust, cells, widths)).rstrip(), style)]


class Table:
    """Readings as a table, on standard output or in a file."""

    def __init__(self, write: Writer | None, printer: Printer) -> None:
        self._write, self._printer = write, printer

    def begin(self, stations: tuple[Station, ...]) -> None:
        """Do nothing: a table has its own head."""

    def show(self, polled: tuple[Polled, ...]) -> None:
        """Write a table."""
        if self._write is None:
            self._printer.lines(_table(polled))
            self._printer.flush()
        else:
            for line in _table(polled):
                self._write("".join(text for text, _ in line))


class Lines:
    """A line for each module and time: values with units, and words where there is no value."""

    def __init__(self, write: Writer) -> None:
        self._write = write

    def begin(self, stations: tuple[Station, ...]) -> None:
        """Do nothing: each line says what it is."""

    def show(self, polled: tuple[Polled, ...]) -> None:
        """Write the lines of all modules."""
        for it in polled:
            cells = [f"{row.value} {row.unit}" if row.value else row.status for row in rows(it)]
            words = "  ".join(cells) if it.has_readings else it.reason
            self._write(f"{_iso(it.time)}  {describe.address(it.address)}  {words}")


class Csv:
    """A line for each time, with a column for each channel."""

    def __init__(self, write: Writer) -> None:
        self._write = write
        self._units: list[tuple[str, ...]] = []

    def begin(self, stations: tuple[Station, ...]) -> None:
        """Write the names of the columns.

        Errors: `LineError` for a module that does not answer, whose columns are unknown.
        """
        columns = ["time"]
        for station in stations:
            address, profile = station.wanted.address, station.profile
            if profile is None:
                at = f"address {describe.address(address)}"
                raise LineError(f"{at}: {station.reason}; CSV needs the channels of all modules at its start")
            prefix = f"{address:02X}:" if len(stations) > 1 else ""
            columns += [f"{prefix}{channel} ({unit})" for channel, unit in enumerate(profile.units)]
            self._units.append(profile.units)
        self._write(",".join(columns))

    def show(self, polled: tuple[Polled, ...]) -> None:
        """Write the line of a time."""
        cells = [_iso(polled[0].time)]
        for it, units in zip(polled, self._units, strict=True):
            if not it.has_readings:
                cells += [""] * len(units)
            elif it.profile is not None and it.profile.units != units:
                cells += [NOT_UNDERSTOOD] * len(units)
            else:
                cells += [row.value or row.status for row in rows(it)]
        self._write(",".join(cells))


class Json:
    """An object for each module and time."""

    def __init__(self, write: Writer) -> None:
        self._write = write

    def begin(self, stations: tuple[Station, ...]) -> None:
        """Do nothing: each object says what it is."""

    def show(self, polled: tuple[Polled, ...]) -> None:
        """Write the objects of all modules."""
        for it in polled:
            self._write(json.dumps(_record(it)))


def _record(polled: Polled) -> dict[str, Any]:
    """Return what came of reading a module, for JSON."""
    profile, report = polled.profile, polled.report
    readings = () if report is None or report.readings is None else report.readings
    return {
        "record": "readings",
        "time": _iso(polled.time),
        "address": polled.address,
        "model": None if profile is None else profile.model.value,
        "protocol": None if polled.protocol is None else SPOKEN[polled.protocol],
        "answered": polled.answered,
        "reason": polled.reason,
        "channels": [
            {
                "channel": channel,
                "value": None if reading is None else reading.value,
                "unit": str(profile.units[channel]) if profile else "",
                "status": NOT_UNDERSTOOD if reading is None else reading.status.value,
                "type": f"{profile.type_codes[channel]:02X}" if profile else "",
            }
            for channel, reading in enumerate(readings)
        ],
    }


def _iso(time: datetime) -> str:
    """Return a time as ISO 8601, with milliseconds."""
    return time.isoformat(timespec="milliseconds")
