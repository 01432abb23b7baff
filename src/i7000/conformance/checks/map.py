"""The rows of the address maps: what is read (manual 3.1, 3.2, 3.4). `map_writes` has what is written.

Laws: each row of each of the nine maps has a check of its own, named by its area and its name. A read never changes the
module, except that of the reset status.
"""

from functools import partial

from i7000.conformance.checks import map_writes
from i7000.conformance.checks.modbus_steps import (
    ADDRESS,
    ADDRESS_OR_VALUE,
    MOST,
    VALUE,
    agree,
    distance,
    gaps,
    items,
    of_area,
    read_row,
    refused,
    row_of,
    runs,
)
from i7000.conformance.checks.steps import Steps
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Skipped, SkipReason
from i7000.host.procedures import Procedure
from i7000.host.procedures.access import registers_of
from i7000.modbus import Access, Area, Kind, Register
from i7000.modbus.register_map import READERS
from i7000.models import Model
from i7000.profile import Profile

__all__ = ["STEPS"]

_PRINTED = (Area.DISCRETE_INPUT, Area.INPUT_REGISTER)
"""The areas for which the manual prints the exceptions; those of the others are an assumption (E94)."""
_NOISE = 0x800
"""The words by which a reading may differ from itself a moment later: 3 % of the whole range."""


# --- one row ----------------------------------------------------------------------------------------------------------


def _row(area: Area, name: str, module: Subject) -> Procedure[None]:
    row = row_of(module, area, name)
    if row.access is Access.WRITE:
        yield from refused(module, _request(area, row.address, 1), ADDRESS_OR_VALUE)
        return
    yield from read_row(module, row)
    if row.ends_when_read:
        yield from _ended(module, row)
    elif row.kind is Kind.READING:
        yield from agree(partial(_single_readings, module, row), module)
    elif row.kind is Kind.RECORD:
        yield from _records(module, row)
    elif row.kind is not Kind.UINT32:
        for at in _sample(module, row):
            yield from items(module, area, row.address + at)


def _request(area: Area, start: int, count: int) -> bytes:
    """Return a read without its address and CRC: any start and count, also those that no message has."""
    return bytes((READERS[area].function,)) + start.to_bytes(2, "big") + count.to_bytes(2, "big")


def _sample(module: Subject, row: Register) -> list[int]:
    """Return some items of a row: the first, the last and another one; none if there is only one."""
    if row.count == 1:
        return []
    return sorted({0, row.count - 1, module.chance.randrange(row.count)})


def _ended(module: Subject, row: Register) -> Procedure[None]:
    """Read the reset status once more: the first read has ended it."""
    (again,) = yield from read_row(module, row)
    if again:
        raise module.wrong(
            f"{row.name} is still 1 when it is read again", *module.exchange(), "0: the first read ends it"
        )


def _single_readings(module: Subject, row: Register) -> Procedure[str | None]:
    """Compare readings that are read alone with those that are read together, before and after."""
    channels = [channel for channel in _sample(module, row) if channel in module.enabled]
    before = yield from read_row(module, row)
    alone = {}
    for channel in channels:
        (alone[channel],) = yield from items(module, row.area, row.address + channel)
    after = yield from read_row(module, row)
    for channel, word in alone.items():
        near = min(distance(word, before[channel]), distance(word, after[channel]))
        if near > _NOISE:
            return f"channel {channel} is {word:04X} alone, {before[channel]:04X} and {after[channel]:04X} with others"
    return None


def _records(module: Subject, row: Register) -> Procedure[None]:
    """Read one log record, the first and the last; a part of one is refused."""
    width = row.kind.width
    for start in (row.address, row.address + row.count - width):
        yield from items(module, row.area, start, width)
    yield from refused(module, _request(row.area, row.address, width - 1), ADDRESS_OR_VALUE)


# --- several rows -----------------------------------------------------------------------------------------------------


def _across(area: Area, module: Subject) -> Procedure[None]:
    for rows in _runs(module, area):
        yield from items(module, area, rows[0].address, rows[-1].address + rows[-1].count - rows[0].address)


def _runs(module: Subject, area: Area) -> list[list[Register]]:
    """Return the rows of an area that can be read together.

    Errors: `Skipped` if the module does not have the area, with its firmware.
    """
    found = runs(module, area)
    if not found:
        raise Skipped(SkipReason.NOT_APPLICABLE, f"{module.profile.name} has no {area.name.lower()} rows")
    return found


def _not_across(area: Area, module: Subject) -> Procedure[None]:
    """Read beyond the end of what can be read together."""
    codes = VALUE if area in _PRINTED else ADDRESS_OR_VALUE
    ending = {row.address for row in of_area(module, area) if row.ends_when_read}
    followed = {row.address for row in of_area(module, area) if row.access is not Access.WRITE}
    for rows in _runs(module, area):
        end = rows[-1].address + rows[-1].count
        if end not in ending | followed:
            yield from refused(module, _request(area, end - 1, 2), codes)


def _gaps(area: Area, module: Subject) -> Procedure[None]:
    _runs(module, area)
    for address in gaps(module, area):
        yield from refused(module, _request(area, address, 1), ADDRESS if area in _PRINTED else ADDRESS_OR_VALUE)


# --- open points ------------------------------------------------------------------------------------------------------


def _halves(area: Area, module: Subject) -> Procedure[None]:
    """Read the halves of 32-bit numbers alone (E139)."""
    for row in of_area(module, area):
        if row.kind is Kind.UINT32:
            both = yield from read_row(module, row)
            for at in range(2):
                (half,) = yield from items(module, area, row.address + at)
                if half != both[at] and row.access is Access.READ:
                    raise module.wrong(f"half of {row.name} is {half:04X} alone", *module.exchange(), f"{both[at]:04X}")


def _codes(area: Area, module: Subject) -> Procedure[None]:
    """Request what is not there: the exceptions are those of functions 02 and 04 (E94)."""
    first, last = _runs(module, area)[0], gaps(module, area)[-1]
    address, end = first[0].address, first[-1].address + first[-1].count
    for start, count in ((last, 1), (end - 1, 2), (address, 0), (address, MOST[area] + 1)):
        yield from module.expect_frame(module.seal(bytes((module.address,)) + _request(area, start, count)))


_ROWS = {(row.area, row.name): None for model in Model for row in registers_of(Profile(model, type_codes=()))}
"""The rows of all maps."""

STEPS: dict[str, Steps] = {
    **{f"map/{area.name.lower()}/{name}": partial(_row, area, name) for area, name in _ROWS},
    **{f"map/across/{area.name.lower()}": partial(_across, area) for area in Area},
    **{f"map/across/{area.name.lower()}-n1": partial(_not_across, area) for area in Area},
    **{f"map/gaps/{area.name.lower()}": partial(_gaps, area) for area in Area},
    "map/halves/holding_register": partial(_halves, Area.HOLDING_REGISTER),
    **{f"map/codes/{area.name.lower()}": partial(_codes, area) for area in (Area.COIL, Area.HOLDING_REGISTER)},
    **map_writes.STEPS,
}
