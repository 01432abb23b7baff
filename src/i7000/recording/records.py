"""The lines of a recording <-> values.

A recording is a file of JSON objects, one a line: a `Start`, what was on the line and what happened, and an `End`. A
file without an end is incomplete: its program was killed, or the disk was full.

Laws: `read` of a `text` is an equal value. Whatever a line holds, `read` raises nothing: what is wrong is `Damaged`.
"""

import json
from collections.abc import Callable
from math import isfinite
from typing import Any, NamedTuple

from i7000.settings import Protocol

__all__ = ["SCHEMA_VERSION", "Carried", "Damaged", "End", "Event", "Record", "Start", "is_recording", "read", "text"]

SCHEMA_VERSION = 1
"""The version of the format. It changes when a reader of the old one would misread the new one."""


class Start(NamedTuple):
    """The first line: who recorded what."""

    time: str
    """The date and time of second 0, in UTC: ``2026-11-30T16:30:00.000000+00:00``."""
    program: str
    """The command that recorded: ``i7000 listen``."""
    version: str
    """The version of i7000."""
    target: str
    """The port or modules that it recorded."""


class Carried(NamedTuple):
    """Bytes that were on the line: a frame, a piece of one, or noise."""

    seconds: float
    """The time since the start."""
    wire: bytes
    sent: bool | None = None
    """Whether a host sent it; None if that is unknown."""
    protocol: Protocol | None = None
    """The protocol; None if that is unknown."""
    place: str | None = None
    """The connection of the host, where there are several."""
    notes: tuple[str, ...] = ()
    """What was wrong with it, in words: faults of the line, broken rules."""


class Event(NamedTuple):
    """Something that happened to the line or its modules."""

    seconds: float
    text: str


class End(NamedTuple):
    """The last line: the recording is complete."""

    seconds: float


class Damaged(NamedTuple):
    """A line that is not a record, and why."""

    reason: str


Record = Start | Carried | Event | End

PROTOCOLS = {Protocol.DCON: "dcon", Protocol.MODBUS_RTU: "rtu"}
_BY_NAME = {name: protocol for protocol, name in PROTOCOLS.items()}
_FROM = {True: "host", False: "module", None: None}
_SENT = {name: sent for sent, name in _FROM.items()}
_BEGINNING = b'{"schema_version": '
"""The first bytes of every recording."""

_json = json.JSONEncoder(ensure_ascii=True, allow_nan=False).encode


def text(record: Record) -> str:
    r"""Return a record as a line, without its end.

    >>> text(Carried(0.25, b"$012\r", sent=True))
    '{"record": "bytes", "seconds": 0.25, "from": "host", "wire": "243031320d"}'
    """
    match record:
        case Start(time, program, version, target):
            return _json(
                {
                    "schema_version": SCHEMA_VERSION,
                    "record": "start",
                    "time": time,
                    "program": program,
                    "version": version,
                    "target": target,
                }
            )
        case Carried(seconds, wire, sent, protocol, place, notes):
            found: dict[str, Any] = {
                "record": "bytes",
                "seconds": round(seconds, 6),
                "from": _FROM[sent],
                "wire": wire.hex(),
            }
            if protocol is not None:
                found["protocol"] = PROTOCOLS[protocol]
            if place is not None:
                found["place"] = place
            if notes:
                found["notes"] = list(notes)
            return _json(found)
        case Event(seconds, words):
            return _json({"record": "event", "seconds": round(seconds, 6), "text": words})
        case End(seconds):
            return _json({"record": "end", "seconds": round(seconds, 6)})


def is_recording(beginning: bytes) -> bool:
    """Return whether a file that begins with these bytes is a recording."""
    return beginning.startswith(_BEGINNING)


def read(line: str) -> Record | Damaged:
    """Read a line of a recording.

    >>> read('{"record": "event", "seconds": 1, "text": "power cycle"}')
    Event(seconds=1.0, text='power cycle')
    >>> read('{"record": "event"}')
    Damaged(reason='no seconds')
    """
    try:
        found = json.loads(line)
    except (ValueError, RecursionError):
        return Damaged("no JSON object")
    if not isinstance(found, dict):
        return Damaged("no JSON object")
    kind = found.get("record")
    reader = _READERS.get(kind) if isinstance(kind, str) else None
    if reader is None:
        return Damaged(f"record cannot be {_shown(kind)}; allowed: {', '.join(_READERS)}")
    try:
        return reader(found)
    except _DamagedError as damage:
        return Damaged(str(damage))


class _DamagedError(Exception):
    """What is wrong with a line."""


_SHOWN = 60


def _shown(value: object) -> str:
    return json.dumps(value)[:_SHOWN]


def _text(found: dict[str, Any], name: str) -> str:
    value = found.get(name)
    if not isinstance(value, str):
        raise _wrong(found, name, "a text")
    return value


def _wrong(found: dict[str, Any], name: str, allowed: str) -> _DamagedError:
    if name not in found:
        return _DamagedError(f"no {name}")
    return _DamagedError(f"{name} cannot be {_shown(found[name])}; allowed: {allowed}")


def _seconds(found: dict[str, Any]) -> float:
    value = found.get("seconds")
    if not isinstance(value, int | float) or isinstance(value, bool) or abs(value) >= _FOREVER or not isfinite(value):
        raise _wrong(found, "seconds", "a number")
    return float(value)


_FOREVER = 10**12
"""More seconds than any recording has."""


def _start(found: dict[str, Any]) -> Start:
    if found.get("schema_version") != SCHEMA_VERSION:
        raise _wrong(found, "schema_version", str(SCHEMA_VERSION))
    return Start(*[_text(found, name) for name in Start._fields])


def _carried(found: dict[str, Any]) -> Carried:
    try:
        wire = bytes.fromhex(_text(found, "wire"))
    except ValueError:
        raise _wrong(found, "wire", "hex digits") from None
    sender, protocol, place = found.get("from"), found.get("protocol"), found.get("place")
    if not isinstance(sender, str | None) or sender not in _SENT:
        raise _wrong(found, "from", "host, module or null")
    if not isinstance(protocol, str | None) or (protocol is not None and protocol not in _BY_NAME):
        raise _wrong(found, "protocol", "dcon, rtu or null")
    if not isinstance(place, str | None):
        raise _wrong(found, "place", "a text or null")
    notes = found.get("notes", [])
    if not isinstance(notes, list) or not all(isinstance(note, str) for note in notes):
        raise _wrong(found, "notes", "a list of texts")
    known = None if protocol is None else _BY_NAME[protocol]
    return Carried(_seconds(found), wire, _SENT[sender], known, place, tuple(notes))


_READERS: dict[str, Callable[[dict[str, Any]], Record]] = {
    "start": _start,
    "bytes": _carried,
    "event": lambda found: Event(_seconds(found), _text(found, "text")),
    "end": lambda found: End(_seconds(found)),
}
