"""The output of a driver: one JSON object a line for each reading that it believes.

``{"address": 1, "channel": 0, "value": 25.1, "unit": "degC", "status": "ok"}``. A line without a channel is about all
channels of the module: ``{"address": 1, "status": "missing"}``.

Laws: whatever a line holds, `read` raises nothing: what is wrong is `Unreadable`. Lines that do not begin with ``{``
are not for us.
"""

import json
from math import isfinite
from typing import Any

from attrs import frozen

__all__ = ["ERROR", "MISSING", "OK", "SCHEMA", "STATUSES", "Believed", "Unreadable", "read"]

OK, MISSING, ERROR = "ok", "missing", "error"
_SENSED = (OK, "over_range", "under_range", "disabled")
STATUSES = (*_SENSED, MISSING, ERROR)
"""The states of a reading. A driver may write a blank for an underscore."""
_KEYS = ("address", "channel", "value", "unit", "status")
_MOST_CHANNELS = 255
_SHOWN = 60


@frozen
class Believed:
    """What a driver believes of a channel, or of all channels of a module."""

    address: int
    channel: int | None
    """None for all channels."""
    value: float | None
    """None unless the status is ``ok``."""
    status: str
    unit: str | None = None


@frozen
class Unreadable:
    """A line that does not fit the schema, and why."""

    reason: str


def read(line: str) -> Believed | Unreadable | None:
    """Read a line; None for one that is not a JSON object, such as a message for people.

    >>> read('{"address": 1, "channel": 0, "value": 25.5, "status": "ok"}')
    Believed(address=1, channel=0, value=25.5, status='ok', unit=None)
    >>> read('{"address": 1, "channel": 0, "value": 25.5, "status": "over range"}')
    Unreadable(reason='value cannot be 25.5; allowed: null, since status is over_range')
    >>> read("connected")
    """
    if not line.lstrip().startswith("{"):
        return None
    try:
        found = json.loads(line)
    except (ValueError, RecursionError):
        return Unreadable("no JSON object")
    try:
        return _believed(found)
    except _UnreadableError as error:
        return Unreadable(str(error))


class _UnreadableError(Exception):
    """What is wrong with a line."""


def _wrong(found: dict[str, Any], name: str, allowed: str) -> _UnreadableError:
    if name not in found:
        return _UnreadableError(f"no {name}; allowed: {allowed}")
    return _UnreadableError(f"{name} cannot be {json.dumps(found[name])[:_SHOWN]}; allowed: {allowed}")


def _believed(found: dict[str, Any]) -> Believed:
    for name in found:
        if name not in _KEYS:
            raise _UnreadableError(f"{name[:_SHOWN]!r} is not a key; allowed: {', '.join(_KEYS)}")
    status = found.get("status", OK)
    status = status.replace(" ", "_") if isinstance(status, str) else status
    if status not in STATUSES:
        raise _wrong(found, "status", ", ".join(STATUSES))
    unit = found.get("unit")
    if not isinstance(unit, str | None):
        raise _wrong(found, "unit", "a text or null")
    address = _number(found, "address")
    channel = None if found.get("channel") is None else _number(found, "channel")
    if channel is None and status in _SENSED:
        raise _wrong(found, "channel", f"0..{_MOST_CHANNELS}, since status is {status}")
    return Believed(address, channel, _value(found, status), status, unit)


def _number(found: dict[str, Any], name: str) -> int:
    number = found.get(name)
    if not isinstance(number, int) or isinstance(number, bool) or not 0 <= number <= _MOST_CHANNELS:
        raise _wrong(found, name, f"0..{_MOST_CHANNELS}")
    return number


def _value(found: dict[str, Any], status: str) -> float | None:
    value = found.get("value")
    if status != OK:
        if value is not None:
            raise _wrong(found, "value", f"null, since status is {status}")
        return None
    try:
        if isinstance(value, int | float) and not isinstance(value, bool) and isfinite(value):
            return float(value)
    except OverflowError:
        pass
    raise _wrong(found, "value", "a finite number, since status is ok")


SCHEMA = json.dumps(
    {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A line of a driver's output for i7000 provoke: a reading that it believes",
        "description": "One line for each reading of each answer, when the driver has it. Lines that do not begin with"
        " { are ignored.",
        "type": "object",
        "properties": {
            "address": {"type": "integer", "minimum": 0, "maximum": _MOST_CHANNELS},
            "channel": {
                "type": ["integer", "null"],
                "minimum": 0,
                "maximum": _MOST_CHANNELS,
                "description": "Null or absent: all channels of the module, if there is no reading.",
            },
            "value": {"type": ["number", "null"], "description": "In the unit of the type; null unless status is ok."},
            "unit": {"type": ["string", "null"], "description": "V, mV, mA or degC; not judged if absent or null."},
            "status": {
                "enum": [*STATUSES, "over range", "under range"],
                "default": OK,
                "description": "missing: no answer; error: an answer that the driver rejects.",
            },
        },
        "required": ["address"],
        "additionalProperties": False,
    },
    indent=2,
)
