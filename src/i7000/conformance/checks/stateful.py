"""Random sequences of reads and changes; one that the module does not answer as its twin does is made shorter.

Laws: every change is undone in the reverse order, whatever the module answers. A sequence is shortened as long as the
writes of the run last.
"""

from collections.abc import Callable, Iterator
from typing import Any

from i7000 import dcon, modbus
from i7000.conformance.checks.steps import Steps
from i7000.conformance.guard import hazards_of
from i7000.conformance.hazard import Hazard
from i7000.conformance.oracle import rows_of
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Difference
from i7000.frozen import frozen
from i7000.host.procedures import Procedure
from i7000.message import Query
from i7000.modbus import Access, Area, Kind, Register
from i7000.profile import CJC_OFFSETS
from i7000.settings import Protocol
from i7000.type_codes import TypeCode

__all__ = ["STEPS"]

_READS = 24
_CHANGES = 6
_LONGEST = 16
"""The most registers of a random read."""


# --- reads ------------------------------------------------------------------------------------------------------------


def _reads(module: Subject) -> Procedure[None]:
    queries = _plain_reads(module)
    sent: list[Query[Any]] = []
    for _ in range(_READS):
        query = module.chance.choice(queries)
        sent.append(query)
        try:
            yield from module.expect(query)
        except Difference as difference:
            before = f", after {sent[-2]}" if len(sent) > 1 else ""
            raise difference.told_as(f"{difference.text}: {query}{before}") from None


def _plain_reads(module: Subject) -> list[Query[Any]]:
    """Return reads that change nothing, as the module has them."""
    address = module.address
    if module.protocol is Protocol.DCON:
        kinds = [kind for kind in _DCON_READS if kind.availability not in module.profile.refused]
        channels = [dcon.ReadAnalogInput(address, channel) for channel in module.channels]
        return [*(kind(address) for kind in kinds), *channels]
    return [*_settings_of_module(module), *_of_map(module)]


_DCON_READS: tuple[Any, ...] = (
    dcon.ReadAnalogInputs, dcon.ReadConfiguration, dcon.ReadChannelMask, dcon.ReadFirmwareVersion, dcon.ReadModuleName,
    dcon.ReadCjcOffset, dcon.ReadCjcEnabled, dcon.ReadHostWatchdogStatus, dcon.ReadHostWatchdogTimeout,
    dcon.ReadAnalogInputsHex, dcon.ReadDiagnostics, dcon.ReadOpenWireDetection,
)  # fmt: skip


def _settings_of_module(module: Subject) -> Iterator[Query[Any]]:
    for kind in (modbus.ReadModuleName, modbus.ReadFirmwareVersion, modbus.ReadCommunicationSettings):
        if kind.availability not in module.profile.refused:
            yield kind(module.address)


def _of_map(module: Subject) -> Iterator[Query[Any]]:
    """Yield reads of one row each, and of a part of it."""
    for row in rows_of(module.profile):
        if row.access is Access.WRITE or row.ends_when_read or row.kind is Kind.RECORD:
            continue
        kind = _FUNCTIONS[row.area]
        yield kind(module.address, row.address, row.count)
        width = row.kind.width
        if row.count > width:
            at = row.address + module.chance.randrange(row.count // width) * width
            yield kind(module.address, at, width)


_FUNCTIONS: dict[Area, Callable[[int, int, int], Query[Any]]] = {
    Area.COIL: modbus.ReadCoils,
    Area.DISCRETE_INPUT: modbus.ReadDiscreteInputs,
    Area.INPUT_REGISTER: modbus.ReadInputRegisters,
    Area.HOLDING_REGISTER: modbus.ReadHoldingRegisters,
}


# --- changes ----------------------------------------------------------------------------------------------------------


@frozen
class Change:
    """A change of a setting, its undoing, and the read that shows it."""

    do: Query[Any]
    undo: Query[Any]
    read: Query[Any]


def _settings(module: Subject) -> Procedure[None]:
    changes = [_drawn(module) for _ in range(_CHANGES)]
    failed = yield from _played(module, changes)
    if failed is None:
        return
    for place in reversed(range(len(changes) - 1)):
        fewer = changes[:place] + changes[place + 1 :]
        if module.writes_left < 2 * len(fewer):
            break
        again = yield from _played(module, fewer)
        if again is not None:
            changes, failed = fewer, again
    words = ", ".join(str(change.do) for change in changes)
    raise failed.told_as(f"{failed.text}, after {words}")


def _played(module: Subject, changes: list[Change]) -> Procedure[Difference | None]:
    """Make changes, read each setting back, and undo them; return what differed first."""
    before, done = module.twin, []
    failed = None
    try:
        for change in changes:
            done.append(change)
            yield from module.expect(change.do)
            yield from module.expect(change.read)
        for change in changes:
            yield from module.expect(change.read)
    except Difference as difference:
        failed = difference
    for change in reversed(done):
        try:
            yield from module.expect(change.undo)
        except Difference as difference:
            failed = failed or difference
    module.twin = before
    return failed


def _drawn(module: Subject) -> Change:
    """Return a random change of a setting, from what the twin holds now."""
    if module.protocol is Protocol.DCON:
        return module.chance.choice(list(_dcon_changes(module)))
    return next(_modbus_changes(module))


def _dcon_changes(module: Subject) -> Iterator[Change]:
    chance, address, eeprom, profile = module.chance, module.address, module.twin.state.eeprom, module.profile
    mask = module.twin.state.enabled
    yield Change(
        dcon.SetChannelMask(address, chance.randrange(1, 1 << profile.channels)),
        dcon.SetChannelMask(address, mask),
        dcon.ReadChannelMask(address),
    )
    if dcon.SetChannelTypeCode.availability not in profile.refused:
        channel = chance.choice(module.channels)
        types = [it for it in TypeCode if profile.supports(it)]
        yield Change(
            dcon.SetChannelTypeCode(address, channel, chance.choice(types)),
            dcon.SetChannelTypeCode(address, channel, eeprom.type_codes[channel]),
            dcon.ReadChannelTypeCode(address, channel),
        )
    if dcon.SetCjcOffset.availability not in profile.refused:
        low, high = CJC_OFFSETS
        yield Change(
            dcon.SetCjcOffset(address, chance.randint(low, high)),
            dcon.SetCjcOffset(address, eeprom.cjc_offset),
            dcon.ReadCjcOffset(address),
        )


def _modbus_changes(module: Subject) -> Iterator[Change]:
    """Yield changes of rows whose writes the guard calls plain, in random order."""
    rows = [
        row
        for row in rows_of(module.profile)
        if row.access is Access.READ_WRITE and row.cleared_by is None and row.kind.width == 1
    ]
    for row in module.chance.sample(rows, len(rows)):
        item = row.address + module.chance.randrange(row.count)
        read = _FUNCTIONS[row.area](module.address, item, 1)
        held = module.twin.hear(module.wire(read), module.now)[1]
        values = module.decoded(held, held.wire or b"").values
        write: Any = modbus.WriteSingleCoil if row.area is Area.COIL else modbus.WriteSingleRegister
        do = write(module.address, item, _new_value(module, row))
        if hazards_of(module.wire(do)) <= _PLAIN:
            yield Change(do, write(module.address, item, values[0]), read)


_PLAIN = frozenset({Hazard.OBSERVE, Hazard.WRITE})


def _new_value(module: Subject, row: Register) -> int:
    if row.area is Area.COIL:
        return module.chance.random() < 1 / 2
    low, high = row.minimum or 0, 0xFFFF if row.maximum is None else row.maximum
    return module.chance.randint(low, high) & 0xFFFF


STEPS: dict[str, Steps] = {"stateful/reads": _reads, "stateful/settings": _settings}
"""The steps of every check of the group."""
