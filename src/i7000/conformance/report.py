"""A report read again: its checks, each with the traffic of it, decoded.

Laws: whatever a file holds, `read_report` raises nothing but `ReportError` for one that is not a report; what is
wrong with it otherwise is in `Report.problems`.
"""

import json
import re
from collections import Counter
from collections.abc import Iterable, Iterator
from hashlib import sha256
from itertools import groupby
from typing import Any

from i7000.conformance.records import SCHEMA_VERSION
from i7000.conformance.verdict import Verdict
from i7000.dissect import ChannelReading, Heard, Knowledge, Known, Line, hear_frame
from i7000.errors import I7000Error
from i7000.frozen import frozen
from i7000.host.procedures.values import PROTOCOLS
from i7000.models import Model
from i7000.profile import Profile
from i7000.settings import BaudRate, CharacterFormat, LineSettings, Protocol
from i7000.type_codes import TypeCode

__all__ = ["Change", "Checked", "Frame", "Report", "ReportError", "line_of", "read_report", "texts"]

_DIGEST = re.compile(r', "digest": "([0-9a-f]{64})"}')
"""The end of the last line."""


def texts(record: dict[str, Any], name: str) -> list[str]:
    """Return the texts of a list that a record has under a name; none if it is not a list."""
    found = record.get(name)
    return [*map(str, found)] if isinstance(found, list) else []


class ReportError(I7000Error):
    """A file that is not a report."""


@frozen
class Frame:
    """Bytes that went one way, and what they mean."""

    seconds: float
    sent: bool
    wire: bytes
    words: str
    """What they mean, in a line; what is wrong with them, if they are not a frame."""


@frozen
class Change:
    """What a run did to the line between frames.

    Shape: `line` are the other line settings of the host; None if the power of the module was switched off and on,
        with the INIT switch set or not.
    """

    seconds: float
    line: LineSettings | None = None
    init_switch: bool = False


@frozen
class Checked:
    """A check of a report, with its traffic."""

    id: str
    verdict: str
    record: dict[str, Any]
    traffic: tuple[Frame | Change, ...]

    @property
    def frames(self) -> tuple[Frame, ...]:
        """The bytes of the traffic."""
        return tuple(it for it in self.traffic if isinstance(it, Frame))

    def __getitem__(self, name: str) -> Any:  # noqa: ANN401 - what JSON has
        """Return what the record has under a name; None without it."""
        return self.record.get(name)

    def texts(self, name: str) -> list[str]:
        """Return the list that the record has under a name; an empty one without it."""
        return texts(self.record, name)


@frozen
class Report:
    """A report: `start` and `end` are its first and last line; a report without an end is incomplete.

    Shape: `problems` are what is wrong with it, in words; `damage` are those of them that no run leaves behind: the
        file was edited, or it is damaged.
    """

    start: dict[str, Any]
    checks: tuple[Checked, ...]
    end: dict[str, Any] | None
    problems: tuple[str, ...]
    damage: tuple[str, ...] = ()

    @property
    def is_complete(self) -> bool:
        """Whether the run came to its end."""
        return self.end is not None and self.end.get("complete") is True

    @property
    def module(self) -> dict[str, Any]:
        """What the run was about."""
        module = self.start.get("module")
        return module if isinstance(module, dict) else {}

    @property
    def line(self) -> LineSettings:
        """The line settings at the beginning; those from the factory if the report is odd."""
        return line_of(self.module) or LineSettings()


def read_report(lines: Iterable[str]) -> Report:
    """Read a report from its lines.

    Errors: `ReportError` if the first line is not that of a report.
    """
    found = _Records()
    for number, line in enumerate(lines, 1):
        found.take(number, line.rstrip("\r\n"))
    if found.start is None:
        raise ReportError("this is not a report of i7000 check: it is empty")
    listener = _listener(found.start)
    checks = []
    for record in found.checks:
        listener, traffic = _traffic(listener, found.wires.get(record["id"], ()))
        checks.append(Checked(record["id"], str(record.get("verdict", Verdict.ERROR.value)), record, traffic))
    damage = (*found.problems, *found.edited())
    return Report(found.start, tuple(checks), found.end, (*damage, *found.missing()), damage)


class _Records:
    """The records of a report, sorted by their kinds as they come."""

    def __init__(self) -> None:
        self.start: dict[str, Any] | None = None
        self.end: dict[str, Any] | None = None
        self.checks: list[dict[str, Any]] = []
        self.wires: dict[str, list[dict[str, Any]]] = {}
        self.problems: list[str] = []
        self.is_as_written = False
        """Whether the digest is that of the lines."""
        self._digest = sha256()

    def take(self, number: int, text: str) -> None:
        """Take the next line."""
        record = _object(text)
        if self.start is None:
            if record is None or record.get("record") != "run-start" or record.get("schema_version") != SCHEMA_VERSION:
                raise ReportError("this is not a report of i7000 check: it does not begin with a run-start")
            self.start = record
        elif self.end is not None:
            self.problems.append(f"line {number}: after the end")
        elif record is None:
            self.problems.append(f"line {number}: no JSON object")
        else:
            self._sort(number, record, text)
        if self.end is None:
            self._add(text)

    def _add(self, text: str) -> None:
        self._digest.update(text.encode("utf-8", "surrogatepass") + b"\n")

    def _sort(self, number: int, record: dict[str, Any], text: str) -> None:
        kind = record.get("record")
        if kind == "line" and line_of(record) is None:
            self.problems.append(f"line {number}: no line settings of a module")
        elif kind in _ON_THE_LINE and isinstance(record.get("check"), str):
            self.wires.setdefault(record["check"], []).append(record)
        elif kind == "check" and isinstance(record.get("id"), str):
            self.checks.append(record)
        elif kind == "run-end":
            self.end = record
            found = _DIGEST.search(text)
            if found is not None and found.end() == len(text):
                self._add(text[: found.start()] + "}")
                self.is_as_written = found[1] == self._digest.hexdigest()

    def edited(self) -> Iterator[str]:
        """Yield why this is not the report that was written."""
        if self.end is None:
            return
        if not self.is_as_written:
            yield "changed after it was written: the digest is that of other lines"
        if self.end.get("counts") != Counter(str(check.get("verdict")) for check in self.checks):
            yield "changed after it was written: the counts at its end are not those of its checks"

    def missing(self) -> Iterator[str]:
        """Yield what of the run is missing."""
        if self.end is None:
            yield "INCOMPLETE: the last line is missing"
        elif self.end.get("complete") is not True:
            yield "INCOMPLETE: stopped before the end"


def _object(text: str) -> dict[str, Any] | None:
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        return None
    return found if isinstance(found, dict) else None


# --- the traffic ------------------------------------------------------------------------------------------------------


def _listener(start: dict[str, Any]) -> Line:
    """Return the listener of a report, which knows the module; one that knows nothing if the report is odd."""
    module = Report(start, (), None, ()).module
    protocol = PROTOCOLS.get(str(module.get("protocol")), Protocol.DCON)
    model = next((it for it in Model if it.value == module.get("model")), None)
    settings = module.get("settings")
    types = _types(settings if isinstance(settings, dict) else {}, model)
    checksum = module.get("checksum")
    known = Known(model=model, types=types, checksum=checksum if isinstance(checksum, bool) else None)
    return Line(protocol=protocol, knowledge=Knowledge.given(known, {}))


def _types(settings: dict[str, Any], model: Model | None) -> tuple[TypeCode, ...] | None:
    if model is None:
        return None
    one = settings.get("type_code")
    names = [str(settings.get(f"type_code.{channel}", one)) for channel in range(model.channels)]
    if not all(name in TypeCode.__members__ for name in names):
        return None
    types = tuple(TypeCode[name] for name in names)
    return types if all(map(Profile(model, type_codes=()).supports, types)) else None


def line_of(record: dict[str, Any]) -> LineSettings | None:
    """Return the line settings of a record; None if no module can have them."""
    rates = {rate.bits_per_second: rate for rate in BaudRate}
    rate, form = record.get("baud_rate"), record.get("character_format")
    if isinstance(rate, int) and rate in rates and isinstance(form, str) and form in CharacterFormat.__members__:
        return LineSettings(rates[rate], CharacterFormat[form])
    return None


_ON_THE_LINE = ("wire", "line", "power")


def _traffic(line: Line, records: Iterable[dict[str, Any]]) -> tuple[Line, tuple[Frame | Change, ...]]:
    found: list[Frame | Change] = []
    for (kind, sent), group in groupby(records, key=lambda it: (it["record"], it.get("from") == "host")):
        if kind != "wire":
            found += [Change(_seconds(it), line_of(it), it.get("init_switch") is True) for it in group]
            continue
        pieces = [(_seconds(piece), _wire(piece)) for piece in group]
        if not sent:  # it comes in any pieces
            pieces = [(pieces[0][0], b"".join(wire for _, wire in pieces))]
        for at, wire in pieces:
            line, heard = hear_frame(line, wire, line.protocol or Protocol.DCON, sent=sent)
            found.append(Frame(at, sent, wire, _words(heard)))
    return line, tuple(found)


def _seconds(record: dict[str, Any]) -> float:
    seconds = record.get("seconds")
    return float(seconds) if isinstance(seconds, int | float) else 0.0


def _wire(record: dict[str, Any]) -> bytes:
    try:
        return bytes.fromhex(str(record.get("wire")))
    except ValueError:
        return b""


def _words(heard: Heard) -> str:
    if heard.error is not None or not heard.meanings:
        return str(heard.error or "no meaning")
    meaning = heard.meanings[0]
    items = [f"{item.name or item.number} {item.text or ''}".rstrip() for item in meaning.items]
    fields = [f"{field.name} {field.text}" for field in meaning.fields if field.name not in _ELSEWHERE]
    shown = [*fields, *map(_reading_words, meaning.readings), *items]
    more = [f"and {len(shown) - _MOST_SHOWN} more"] if len(shown) > _MOST_SHOWN else []
    return "; ".join([meaning.message.title, *shown[:_MOST_SHOWN], *more, *heard.notes])


_ELSEWHERE = ("address", "values", "value")
_MOST_SHOWN = 20


def _reading_words(reading: ChannelReading) -> str:
    if reading.value is None or reading.unit is None:
        return reading.status.value if reading.status else reading.text.strip()
    return f"{reading.value:g} {reading.unit.value}"
