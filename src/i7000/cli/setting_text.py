"""Settings in words: their values, what differs, and what became of them."""

from collections.abc import Iterable, Iterator, Mapping
from itertools import groupby
from typing import Any

from i7000 import Model
from i7000.cli.records import Record
from i7000.cli.text import Line
from i7000.host.procedures import Change, Hazard, Restored, Setting, Status
from i7000.host.procedures.settings import known_settings
from i7000.host.procedures.values import Plain

__all__ = [
    "LOSES",
    "change_record",
    "change_table",
    "listed_lines",
    "listed_record",
    "names_words",
    "restored_lines",
    "restored_record",
    "unread_words",
    "value_words",
]

LOSES = "could lose the module"
_MISSING = "-"
"""What is shown for a value that is not known."""


def value_words(value: Plain | None, unit: str | None = None) -> str:
    """Return a plain value as people write it.

    >>> value_words(2.5, "s"), value_words(True), value_words((0, 1, 2, 5)), value_words(None)
    ('2.5 s', 'yes', '0-2,5', '-')
    """
    if value is None:
        return _MISSING
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, tuple):
        return ",".join(_ranges(value)) or "none"
    text = f"{value:g}" if isinstance(value, float) else str(value)
    return f"{text} {unit}" if unit else text


def _ranges(channels: tuple[int, ...]) -> Iterator[str]:
    for _, group in groupby(enumerate(channels), lambda pair: pair[1] - pair[0]):
        first, *others = [channel for _, channel in group]
        yield f"{first}-{others[-1]}" if others else f"{first}"


def names_words(names: Iterable[str]) -> str:
    """Return names in words; those of channels once, with the channels.

    >>> names_words(["filter", "type_code.0", "type_code.1", "type_code.4"])
    'filter, type_code.0-1,4'
    """
    channels: dict[str, tuple[int, ...]] = {}
    for name in names:
        base, point, channel = name.partition(".")
        channels[base] = (*channels.get(base, ()), *((int(channel),) if point else ()))
    return ", ".join(f"{base}.{','.join(_ranges(them))}" if them else base for base, them in channels.items())


def unread_words(unread: Iterable[tuple[str, str]]) -> Iterator[str]:
    """Yield what could not be read, and why, with the settings of one reason together.

    >>> [*unread_words([("name", "refused"), ("filter", "no answer"), ("protocol", "refused")])]
    ['name, protocol could not be read: refused', 'filter could not be read: no answer']
    """
    by_reason: dict[str, list[str]] = {}
    for name, reason in unread:
        by_reason.setdefault(reason, []).append(name)
    for reason, names in by_reason.items():
        yield f"{names_words(names)} could not be read: {reason}"


def _words(model: Model, name: str, value: Plain | None) -> str:
    setting = known_settings(model).get(name)
    return value_words(value, setting.unit if setting else None)


# --- what differs -----------------------------------------------------------------------------------------------------


def change_table(changes: Iterable[Change], model: Model, heads: tuple[str, str]) -> Iterator[Line]:
    """Yield a table of what differs; `heads` are those of the values before and after."""
    rows = [(it.name, _words(model, it.name, it.before), _words(model, it.name, it.after), it.hazard) for it in changes]
    names, before, after = (
        max(map(len, column)) for column in zip(("setting", *heads), *(it[:3] for it in rows), strict=True)
    )
    yield [(f"{'setting':<{names}}  {heads[0]:<{before}}  {heads[1]}", "bold")]
    for name, old, new, hazard in rows:
        line: Line = [(f"{name:<{names}}  {old:<{before}}  {new:<{after}}".rstrip(), "")]
        if hazard is Hazard.LOSES:
            line = [(f"{name:<{names}}  {old:<{before}}  {new:<{after}}  ", ""), (LOSES, "yellow")]
        yield line


def change_record(change: Change, heads: tuple[str, str]) -> Record:
    """Return what differs as a record."""
    before, after = heads
    return {
        "record": "difference",
        "name": change.name,
        before: _json(change.before),
        after: _json(change.after),
        "hazard": change.hazard.value,
    }


def _json(value: Plain | None) -> Any:  # noqa: ANN401 - whatever JSON has
    return list(value) if isinstance(value, tuple) else value


# --- what became of settings ------------------------------------------------------------------------------------------

_STYLES = {
    Status.DONE: "green",
    Status.ALREADY: "dim",
    Status.PENDING: "green",
    Status.IN_DOUBT: "red",
    Status.NOT_VERIFIED: "red",
}
_NAME_WIDTH = 24


def restored_lines(result: Restored, model: Model) -> Iterator[Line]:
    """Yield what became of a setting."""
    status, reason = result.status, result.reason
    wanted, before, after = (
        _words(model, result.name, value) for value in (result.wanted, result.before, result.after)
    )
    words = f"{before} -> {wanted}"
    if status is Status.ALREADY:
        words = wanted
    elif status is Status.PENDING:
        reason = "in use from the next power-on"
    elif status is Status.NEEDS_INIT:
        reason = "power it on with its INIT switch on, and ask again with --address 0"
    elif status is Status.NOT_VERIFIED:
        reason = f"it reads back as {after}; {reason}"
    elif status is Status.IN_DOUBT:
        reason = f"{reason}; it may have either value"
    style = _STYLES.get(status, "yellow")
    yield [
        (f"{result.name:<{_NAME_WIDTH}} {words:<{_NAME_WIDTH}} ", ""),
        (status.value, style),
        (f": {reason}" if reason else "", ""),
    ]


def restored_record(result: Restored) -> Record:
    """Return what became of a setting as a record."""
    return {
        "record": "setting",
        "name": result.name,
        "status": result.status.value,
        "wanted": _json(result.wanted),
        "before": _json(result.before),
        "after": _json(result.after),
        "reason": result.reason,
    }


# --- what there is ----------------------------------------------------------------------------------------------------


def listed_lines(settings: Iterable[Setting], values: Mapping[str, Plain], unread: Mapping[str, str]) -> Iterator[Line]:
    """Yield a table of the settings with their values, and what is allowed; for channels, that stands once."""
    rows = [
        (it, value_words(values[it.name], it.unit) if it.name in values else f"unknown: {unread[it.name]}")
        for it in settings
    ]
    names, held = (
        max(map(len, column)) for column in zip(_HEADS[:2], *((it.name, value) for it, value in rows), strict=True)
    )
    yield [(f"{_HEADS[0]:<{names}}  {_HEADS[1]:<{held}}  {_HEADS[2]}", "bold")]
    base = ""
    for it, value in rows:
        again, base = base == it.name.partition(".")[0], it.name.partition(".")[0]
        line: Line = [(f"{it.name:<{names}}  ", "cyan"), (f"{value:<{held}}  ", "")]
        if not again:
            line.append((it.allowed, "dim"))
        if it.hazard is Hazard.LOSES:
            line.append((f"  ({LOSES})", "yellow"))
        yield line


_HEADS = "setting", "value", "allowed"


def listed_record(setting: Setting, values: Mapping[str, Plain], unread: Mapping[str, str]) -> Record:
    """Return a setting of a module as a record."""
    return {
        "record": "setting",
        "name": setting.name,
        "value": _json(values.get(setting.name)),
        "unit": setting.unit,
        "allowed": setting.allowed,
        "hazard": setting.hazard.value,
        "next_power_on": setting.deferred,
        "reason": unread.get(setting.name),
    }
