"""Hazard classes: what bytes on the line can do to modules, and which of them a user has allowed.

Laws: a command is classified by the worst that it can do to any model, whatever its values are. What could lose or
miscalibrate a module is stated in `i7000.host.dangers`; the host watchdog is added, because it changes the line of
modules that nobody polls.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from enum import Enum
from functools import cache
from types import MappingProxyType
from typing import Any

from i7000 import dcon
from i7000.arguments import as_tuple, check_type
from i7000.host.dangers import BY_CLASS, Danger, dangers_of_rows
from i7000.host.procedures.access import registers_of
from i7000.message import Query
from i7000.modbus.registers import Area, Register
from i7000.models import Model
from i7000.profile import Profile

__all__ = ["DEFAULT_ALLOWED", "STORED", "Hazard", "allowing", "worst_of"]


class Hazard(Enum):
    """What bytes can do to the modules that hear them, in rising order of harm."""

    OBSERVE = "observe"
    """Reads that change nothing."""
    MEMORY = "memory"
    """Reads that change what the next read returns: ``$AA4``, coil 00273."""
    BROADCAST = "broadcast"
    """Frames to every module of the line: ``#**``, ``~**``, Modbus address 0."""
    WRITE = "write"
    """Settings that can be restored."""
    COMM = "comm"
    """Settings that can lose the module or change its line, and the host watchdog."""
    CALIBRATION = "calibration"
    """The calibration, which cannot be restored, and what permits to change it."""

    @property
    def words(self) -> str:
        """What it means, for people."""
        return _WORDS[self]


_WORDS = {
    Hazard.OBSERVE: "only reads",
    Hazard.MEMORY: "changes what the next read returns",
    Hazard.BROADCAST: "goes to every module of the line",
    Hazard.WRITE: "changes a setting",
    Hazard.COMM: "can make the module unreachable",
    Hazard.CALIBRATION: "can change the calibration",
}
_RANKS = {hazard: rank for rank, hazard in enumerate(Hazard)}

DEFAULT_ALLOWED = frozenset({Hazard.OBSERVE, Hazard.MEMORY})
"""The hazards that need no permission."""
STORED = frozenset({Hazard.WRITE, Hazard.COMM, Hazard.CALIBRATION})
"""The hazards of what a module may keep in its EEPROM."""


def allowing(hazards: Iterable[Hazard] = ()) -> frozenset[Hazard]:
    """Return the allowed hazards for the permissions of a user: `DEFAULT_ALLOWED`, those given, and what they imply.

    Special: `Hazard.COMM` implies `Hazard.WRITE`. Nothing implies `Hazard.CALIBRATION`, and it implies nothing.
    Errors: `ArgumentError`.

    >>> sorted(hazard.value for hazard in allowing([Hazard.COMM]))
    ['comm', 'memory', 'observe', 'write']
    """
    given = as_tuple("hazards", hazards)
    for hazard in given:
        check_type("hazards", hazard, Hazard)
    implied = {Hazard.WRITE} if Hazard.COMM in given else set()
    return DEFAULT_ALLOWED.union(given, implied)


def worst_of(hazards: Iterable[Hazard]) -> Hazard:
    """Return the most harmful of several hazards; `Hazard.OBSERVE` if there are none.

    >>> worst_of([Hazard.WRITE, Hazard.CALIBRATION, Hazard.BROADCAST])
    <Hazard.CALIBRATION: 'calibration'>
    """
    return max((Hazard.OBSERVE, *hazards), key=_RANKS.__getitem__)


_OF_DANGERS = {Danger.LOSES: Hazard.COMM, Danger.CALIBRATION: Hazard.CALIBRATION}
_WATCHDOG_ROWS = frozenset({"host_watchdog_timeout", "host_watchdog_enabled"})


def hazard_of(kind: type[Query[Any]]) -> Hazard:
    """Return the hazard of a class of commands or requests, apart from the items that it reads or writes."""
    if kind in BY_CLASS:
        return _OF_DANGERS[BY_CLASS[kind]]
    if issubclass(kind, dcon.Broadcast):
        return Hazard.BROADCAST
    if kind is dcon.SetHostWatchdogTimeout:
        return Hazard.COMM
    if kind is dcon.ReadSynchronizedData:
        return Hazard.MEMORY
    return Hazard.OBSERVE if kind.__name__.startswith("Read") else Hazard.WRITE


@cache
def hazards_of_writes() -> Mapping[tuple[Area, int], Hazard]:
    """Return the items whose write is worse than `Hazard.WRITE` on any model."""
    found = {place: _OF_DANGERS[danger] for place, danger in dangers_of_rows().items()}
    return MappingProxyType(found | dict.fromkeys(_items(lambda row: row.name in _WATCHDOG_ROWS), Hazard.COMM))


@cache
def items_that_end_when_read() -> frozenset[tuple[Area, int]]:
    """Return the items whose value changes when they are read, on any model."""
    return frozenset(_items(lambda row: row.ends_when_read))


def _items(wanted: Callable[[Register], bool]) -> Iterator[tuple[Area, int]]:
    """Yield the items of all rows of a kind, of every model."""
    for model in Model:
        for row in filter(wanted, registers_of(Profile(model, type_codes=()))):
            yield from ((row.area, row.address + at) for at in range(row.count))
