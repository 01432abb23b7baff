"""Steps that many checks of Modbus share: rows of the map, reads of items, requests that are refused, settings undone.

Laws: a setting is changed only if enough writes are left to restore it, and it is restored whatever comes of the check.
"""

from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from functools import partial
from itertools import pairwise
from typing import Any

from attrs import evolve

from i7000 import modbus
from i7000.conformance.checks.others import others_known, others_unchanged
from i7000.conformance.oracle import Twin, difference
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Note, Reason, Unclear
from i7000.host.procedures import Procedure
from i7000.host.procedures.access import registers_of
from i7000.modbus import Access, Area, ExceptionCode, Register
from i7000.modbus.items import MOST_BITS, MOST_WORDS
from i7000.modbus.register_map import READERS

__all__ = [
    "ADDRESS",
    "ADDRESS_OR_VALUE",
    "FUNCTION",
    "MOST",
    "VALUE",
    "address_changed",
    "agree",
    "changed_and_restored",
    "distance",
    "gaps",
    "items",
    "of_area",
    "read_row",
    "refused",
    "row_of",
    "row_with",
    "rows_of",
    "runs",
    "write_of",
]

FUNCTION = (ExceptionCode.ILLEGAL_FUNCTION,)
ADDRESS, VALUE = (ExceptionCode.ILLEGAL_DATA_ADDRESS,), (ExceptionCode.ILLEGAL_DATA_VALUE,)
ADDRESS_OR_VALUE = ADDRESS + VALUE
LOOK = 0.2
"""How long a module is looked for, in seconds."""
_TRIES = 3
"""How often two reads of what the module measures are compared before they are found to differ."""

MOST = {area: MOST_BITS if area.bits else MOST_WORDS for area in Area}
"""The most items that one request reads."""


# --- the map ----------------------------------------------------------------------------------------------------------


def rows_of(module: Subject) -> tuple[Register, ...]:
    """Return the rows of the map of the module."""
    return registers_of(evolve(module.profile, type_codes=())).rows


def of_area(module: Subject, area: Area) -> list[Register]:
    """Return the rows of one area, by address."""
    return [row for row in rows_of(module) if row.area is area]


def row_with(module: Subject, area: Area, name: str) -> Register | None:
    """Return a row by its name; None if the module does not have it."""
    return next((row for row in of_area(module, area) if row.name == name), None)


def row_of(module: Subject, area: Area, name: str) -> Register:
    """Return a row by its name, which the module has: the statement of the check says so."""
    return next(row for row in of_area(module, area) if row.name == name)


def runs(module: Subject, area: Area) -> list[list[Register]]:
    """Return the rows of an area that can be read together: neighbours, as many as one request can read.

    Special: rows that change when they are read are left out.
    """
    found: list[list[Register]] = []
    for row in of_area(module, area):
        if row.access is Access.WRITE or row.ends_when_read:
            continue
        last = found[-1] if found else None
        if last and row.address == _end(last[-1]) and _end(row) - last[0].address <= MOST[area]:
            last.append(row)
        else:
            found.append([row])
    return found


def gaps(module: Subject, area: Area) -> list[int]:
    """Return addresses that no row has: those next to the rows of an area, and the last one of all."""
    rows = of_area(module, area)
    if not rows:
        return [0, 0xFFFF]
    found = {0xFFFF, _end(rows[-1])}
    if rows[0].address:
        found |= {0, rows[0].address - 1}
    for before, after in pairwise(rows):
        if _end(before) < after.address:
            found |= {_end(before), after.address - 1}
    return sorted(found)


def _end(row: Register) -> int:
    return row.address + row.count


# --- reads ------------------------------------------------------------------------------------------------------------


def items(module: Subject, area: Area, start: int, count: int = 1) -> Procedure[tuple[int, ...]]:
    """Read items, which must be those that the twin allows; return them."""
    response = yield from module.expect(READERS[area](module.address, start, count))
    return tuple(map(int, response.values))


def read_row(module: Subject, row: Register) -> Procedure[tuple[int, ...]]:
    """Read all items of a row."""
    return (yield from items(module, row.area, row.address, row.count))


def agree(compare: Callable[[], Procedure[str | None]], module: Subject) -> Procedure[None]:
    """Compare what the module measures, a few times: what is measured may change between two reads.

    Shape: `compare` returns the difference in words, None if there is none.
    Errors: `Difference` if all of them differ.
    """
    found = None
    for _ in range(_TRIES):
        found = yield from compare()
        if found is None:
            return
    raise module.wrong(found or "", *module.exchange(), "the same in both")


def distance(one: int, other: int) -> int:
    """Return the distance of two words, which may be signed or not."""
    apart = abs(one - other)
    return min(apart, 0x10000 - apart)


# --- what is refused --------------------------------------------------------------------------------------------------


def refused(
    module: Subject, body: bytes, codes: Iterable[int] = VALUE, *, silence: bool = False
) -> Procedure[bytes | None]:
    """Send a request with the right CRC that must not be carried out: function, and what follows it.

    Shape: one of the exceptions is right; with `silence`, no answer is right too.
    """
    wire = module.seal(bytes((module.address,)) + body)
    exceptions = [module.exception(body[0], code) for code in codes]
    return (yield from module.expect_one_of(wire, [None, *exceptions] if silence else exceptions))


# --- settings ---------------------------------------------------------------------------------------------------------


def write_of(row: Register, at: int, values: Sequence[int]) -> Callable[[int], modbus.Request[Any]]:
    """Return the request, by address, that writes items of a row or of rows from it on: one by 05 or 06, more by 10."""
    start = row.address + at
    if row.area is Area.COIL:
        return lambda address: modbus.WriteSingleCoil(address, start, bool(values[0]))
    if len(values) == 1:
        return lambda address: modbus.WriteSingleRegister(address, start, values[0])
    return lambda address: modbus.WriteMultipleRegisters(address, start, tuple(values))


def changed_and_restored(
    module: Subject, change: Procedure[None], restore: Callable[[], Procedure[None]], frames: int = 1
) -> Procedure[None]:
    """Carry out the steps that change a setting, and then those that restore it, whatever comes of the first.

    All other settings are read between the two, and must be as before.

    Shape: `frames` is how many writes each of them sends.
    Special: what fails is restored, or restored once more.
    Errors: `Skipped` if not enough writes are left for that: nothing is sent then.
    """
    module.reserve(3 * frames)
    yield from others_known(module)
    channels = module.channels
    try:
        yield from change
        yield from others_unchanged(module, channels)
        yield from restore()
    except Reason:
        with suppress(Reason):
            yield from restore()
        raise


_FREE = range(247, 200, -1)
"""The addresses that the module may be given for a while."""


def address_changed(module: Subject, request: Callable[[int, int], modbus.Request[Any]]) -> Procedure[None]:
    """Give the module a free address, and its own again; `request` makes the request, by the two addresses.

    Special: when the new address holds is an assumption (E90): the module is looked for at both.
    Errors: `Unclear` if no address is free.
    """
    own = module.address
    for free in _FREE:
        if free != own and not (yield from _is_there(module, free)):
            break
    else:
        raise Unclear("another module answers at each address that this one could be given")
    later: list[str] = []

    def move(new: int) -> Procedure[None]:
        before = module.address
        query = request(before, new)
        wire = module.wire(query)
        answer = module.hear(wire)
        heard = (yield from module.send(wire)).wire
        if not (yield from _is_there(module, new)):
            module.twin = Twin(module.twin.state.keep(address=before))
            yield from module.alive(wire)
            yield from _stored(module, wire, new)
            later.append(f"{new:02X}")
        if found := difference(answer, heard):
            raise module.wrong(found, wire, heard, (answer.wire or b"").hex(" "))

    yield from changed_and_restored(module, move(free), partial(move, own))
    if later:
        raise Note(f"the module keeps its address until the next power-on when it is given another: {later[0]}")


def _stored(module: Subject, wire: bytes, new: int) -> Procedure[None]:
    """Read the address of a module that keeps its own for now: the register has the new one, which holds later."""
    row = row_of(module, Area.HOLDING_REGISTER, "module_address")
    read = module.wire(READERS[row.area](module.address, row.address, row.count))
    right = module.seal(bytes((module.address, 3, 2)) + new.to_bytes(2, "big"))
    heard = (yield from module.send(read)).wire
    if heard != right:
        raise module.wrong("the new address is neither used nor stored", wire + read, heard, right.hex(" "))


def _is_there(module: Subject, address: int) -> Procedure[bool]:
    """Return whether a module answers at an address."""
    body = bytes((address,)) + module.wire(module.sentinel)[1:-2]
    return bool((yield from module.send(module.seal(body), seconds=LOOK)).wire)
