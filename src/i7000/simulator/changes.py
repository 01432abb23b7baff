"""Changes of an EEPROM, in words.

Laws: the data logger is left out, which writes at every sample.
"""

from collections.abc import Iterator
from enum import Enum
from typing import Any

from attrs import fields_dict

from i7000 import describe
from i7000.device import Eeprom
from i7000.settings import LineSettings, ReportSettings

__all__ = ["changes"]

_WATCHDOG = {"host_watchdog_timed_out", "host_watchdog_timeouts"}
_NAMES = [name for name in fields_dict(Eeprom) if name not in {*_WATCHDOG, "model", "log", "type_codes"}]


def changes(before: Eeprom, after: Eeprom) -> tuple[str, ...]:
    """Return the changes between two states of an EEPROM; empty if only the data logger has written.

    Special: writing a value that is already there is a change of nothing.

    >>> from attrs import evolve
    >>> from i7000.device import factory
    >>> from i7000.models import Model
    >>> module = factory(Model.I_7018)
    >>> changes(module, evolve(module, name="HOT", host_watchdog_timed_out=True))
    ('watchdog tripped', 'name 7018 -> HOT')
    >>> changes(module, evolve(module))
    ('unchanged settings written',)
    """
    found = [*_watchdog(before, after), *_types(before, after)]
    for name in _NAMES:
        one, other = getattr(before, name), getattr(after, name)
        if one != other:
            found.extend(_setting(name, one, other))
    if not found and before.log is after.log:
        return ("unchanged settings written",)
    return tuple(found)


def _watchdog(before: Eeprom, after: Eeprom) -> Iterator[str]:
    if after.host_watchdog_timeouts > before.host_watchdog_timeouts or (
        after.host_watchdog_timed_out and not before.host_watchdog_timed_out
    ):
        yield "watchdog tripped"
    elif before.host_watchdog_timed_out and not after.host_watchdog_timed_out:
        yield "watchdog cleared"


def _types(before: Eeprom, after: Eeprom) -> Iterator[str]:
    return _of_channels("type", before.type_codes, after.type_codes)


def _setting(name: str, before: Any, after: Any) -> Iterator[str]:  # noqa: ANN401 - the value of any field
    if isinstance(before, tuple):
        yield from _of_channels(name, before, after)
    elif name == "channel_mask":
        yield f"channels {before:X}h -> {after:X}h"
    else:
        yield f"{name} {_word(before)} -> {_word(after)}"


def _of_channels(name: str, before: tuple[Any, ...], after: tuple[Any, ...]) -> Iterator[str]:
    """Yield the changes of channels, all of them at once if they are the same."""
    pairs = [(channel, one, other) for channel, (one, other) in enumerate(zip(before, after, strict=True))]
    changed = [(channel, one, other) for channel, one, other in pairs if one != other]
    if len(changed) == len(pairs) and len({(one, other) for _, one, other in changed}) == 1:
        yield f"{name} {_word(before[0])} -> {_word(after[0])}"
        return
    for channel, one, other in changed:
        yield f"channel {channel} {name} {_word(one)} -> {_word(other)}"


def _word(value: object) -> str:
    if isinstance(value, LineSettings):
        return describe.line_settings(value)
    if isinstance(value, ReportSettings):
        return describe.report_settings(value)
    return value.name if isinstance(value, Enum) else str(value)
