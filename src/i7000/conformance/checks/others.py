"""The settings that a change of one setting must leave alone: all that can be read is compared with the twin.

Laws: a read is compared only if its answer was right before the first change of the run: one that is always wrong is
found by the check of that read. Only plain reads are sent.
"""

from collections.abc import Iterator
from typing import Any

from attrs import evolve

from i7000 import dcon, modbus
from i7000.conformance.oracle import difference, rows_of
from i7000.conformance.subject import Subject
from i7000.host.procedures import Procedure
from i7000.message import Query
from i7000.modbus import Access, Area, Register
from i7000.modbus.items import MOST_BITS, MOST_WORDS
from i7000.modbus.register_map import READERS
from i7000.settings import Protocol

__all__ = ["others_known", "others_unchanged"]

_OF_DCON: tuple[Any, ...] = (
    dcon.ReadConfiguration,
    dcon.ReadChannelMask,
    dcon.ReadCjcOffset,
    dcon.ReadModuleName,
    dcon.ReadProtocol,
    dcon.ReadCjcEnabled,
    dcon.ReadHostWatchdogTimeout,
    dcon.ReadOpenWireDetection,
    dcon.ReadConnectingMode,
)
_OF_MODBUS: tuple[tuple[Any, tuple[int, ...]], ...] = (
    (modbus.ReadModuleName, ()),
    (modbus.ReadCommunicationSettings, ()),
    (modbus.ReadTypeCode, (0,)),
    (modbus.ReadChannelMask, ()),
    (modbus.ReadMiscellaneousSettings, ()),
    (modbus.ReadCjcOffset, (0,)),
    (modbus.ReadCjcEnabled, ()),
)
_OF_CHANNELS = (
    dcon.ReadConfiguration,
    dcon.ReadChannelMask,
    dcon.ReadChannelTypeCode,
    modbus.ReadTypeCode,
    modbus.ReadChannelMask,
    modbus.ReadHoldingRegisters,
)
"""The reads whose answers are unknown of channels that appear when the connecting mode changes."""


def others_known(module: Subject) -> Procedure[None]:
    """Read all settings before one of them is changed, and remember which of the answers are right."""
    for query in _reads(module):
        if _key(query) not in module.sound:
            wire = module.wire(query)
            found, _ = yield from _read(module, wire)
            module.sound[_key(query)] = found is None


def others_unchanged(module: Subject, channels: range) -> Procedure[None]:
    """Read all settings while one of them is changed: the others must be as before.

    Shape: `channels` are those of the module before the change.
    Errors: `Difference`.
    """
    appeared = _OF_CHANNELS if module.channels != channels else ()
    for query in _reads(module):
        if module.sound.get(_key(query)) and not isinstance(query, appeared):
            wire = module.wire(query)
            found, heard = yield from _read(module, wire)
            if not heard:
                yield from module.alive(wire)
            if found:
                raise module.wrong(f"the change changes something else: {found}", wire, heard, "as before the change")


def _read(module: Subject, wire: bytes) -> Procedure[tuple[str | None, bytes]]:
    """Send a read; return what is wrong with its answer, in words, and the answer."""
    answer = module.hear(wire)
    heard = (yield from module.send(wire)).wire
    return difference(answer, heard), heard


def _key(query: Query[Any]) -> Query[Any]:
    """Return a query as it is at address 01, whatever the address of the module is now."""
    anywhere: Query[Any] = evolve(query, address=1)  # type: ignore[misc] # every query has an address
    return anywhere


def _reads(module: Subject) -> Iterator[Query[Any]]:
    refused, address = module.profile.refused, module.address
    if module.protocol is Protocol.DCON:
        yield from (kind(address) for kind in _OF_DCON if kind.availability not in refused)
        if dcon.ReadChannelTypeCode.availability not in refused:
            yield from (dcon.ReadChannelTypeCode(address, channel) for channel in module.channels)
    else:
        yield from (kind(address, *more) for kind, more in _OF_MODBUS if kind.availability not in refused)
        for area in (Area.COIL, Area.HOLDING_REGISTER):
            if READERS[area].availability not in refused:
                yield from (READERS[area](address, start, count) for start, count in _blocks(module, area))


def _blocks(module: Subject, area: Area) -> Iterator[tuple[int, int]]:
    """Yield the start and the count of items that hold settings, neighbours together."""
    start = end = 0
    most = MOST_BITS if area.bits else MOST_WORDS
    for row in rows_of(module.profile):
        if row.area is area and _is_setting(row):
            if row.address != end or row.address + row.count - start > most:
                if end:
                    yield start, end - start
                start = row.address
            end = row.address + row.count
    if end:
        yield start, end - start


def _is_setting(row: Register) -> bool:
    return row.access is Access.READ_WRITE and row.cleared_by is None and not row.ends_when_read
