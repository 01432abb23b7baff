"""The functions of Modbus RTU, and what is refused (manual 3). `rtu_settings` has function 46h, `map` the items.

Laws: a request is refused by the bytes of an exception, never by silence, unless its CRC or its address is wrong. The
manual prints the exceptions of functions 02, 04 and 46h; those of the others are an assumption (E94).
"""

from collections.abc import Iterable
from functools import partial
from typing import Any

from i7000 import modbus
from i7000.conformance.checks import rtu_settings
from i7000.conformance.checks.modbus_steps import (
    ADDRESS,
    ADDRESS_OR_VALUE,
    FUNCTION,
    MOST,
    VALUE,
    gaps,
    items,
    refused,
    row_of,
    runs,
)
from i7000.conformance.checks.steps import Steps
from i7000.conformance.oracle import difference
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Skipped, SkipReason, Strange
from i7000.host.procedures import Procedure
from i7000.modbus import Area
from i7000.modbus.register_map import READERS

__all__ = ["STEPS"]

Writer = type[modbus.Request[Any]]

_PRINTED = (Area.DISCRETE_INPUT, Area.INPUT_REGISTER)
_NO_FUNCTION = {0x19: b"", 0x30: b"", 0x4F: b"", 0x5C: b"", 0x70: b""}
"""Function codes that no specification has, and what follows them; 41h to 48h and 64h to 6Eh are for vendors."""
_OTHER_FUNCTIONS = {0x07: b"", 0x08: b"\0\0\x12\x34", 0x0B: b"", 0x11: b"", 0x2B: b"\x0e\x01\x00"}
"""Functions of the Modbus specification that only read, and what follows them."""
_RESERVED_ADDRESSES = (248, 255)


# --- CRC and addresses ------------------------------------------------------------------------------------------------


def _read(module: Subject) -> bytes:
    """Return a read that every module answers."""
    return module.wire(modbus.ReadInputRegisters(module.address, 0, 1))


def _wrong_crc(module: Subject) -> Procedure[None]:
    wire = _read(module)
    body, low, high = wire[:-2], wire[-2], wire[-1]
    for crc in (bytes((high, low)), bytes((low ^ 0x01, high)), bytes((low, high ^ 0x80)), b"\0\0"):
        yield from module.silent(body + crc)
    yield from module.silent(body[:-1] + bytes((body[-1] ^ 0x02, low, high)))


def _no_crc(module: Subject) -> Procedure[None]:
    yield from module.silent(_read(module)[:-2])
    yield from module.silent(_read(module)[:-1])


def _other_addresses(addresses: Iterable[int], module: Subject) -> Procedure[None]:
    for address in addresses:
        for wire in (_read(module), module.wire(module.sentinel)):
            yield from module.silent(module.seal(bytes((address,)) + wire[1:-2]))


def _broadcast_write(module: Subject) -> Procedure[None]:
    """Write a coil that no module of the line can have, at address 0."""
    yield from module.silent(module.wire(modbus.WriteSingleCoil(modbus.BROADCAST, 0xFFFF, value=True)))


# --- functions --------------------------------------------------------------------------------------------------------


def _unknown_functions(module: Subject) -> Procedure[None]:
    for function, rest in _NO_FUNCTION.items():
        yield from refused(module, bytes((function,)) + rest, FUNCTION)


def _other_functions(module: Subject) -> Procedure[None]:
    for function, rest in _OTHER_FUNCTIONS.items():
        yield from refused(module, bytes((function,)) + rest, FUNCTION)


def _functions_with_bit_7(module: Subject) -> Procedure[None]:
    """Send a read whose function has the bit of an exception: it is not carried out."""
    for function in (modbus.ReadInputRegisters.function, modbus.ReadModuleName.function):
        wire = module.seal(bytes((module.address, function | 0x80, 0, 0, 0, 1)))
        yield from module.expect_one_of(wire, (None, module.exception(function, FUNCTION[0])))


def _absent_functions(module: Subject) -> Procedure[None]:
    """Send reads that this model, or its firmware, does not have."""
    absent = [reader for reader in READERS.values() if reader.availability in module.profile.refused]
    if not absent:
        raise Skipped(SkipReason.NOT_APPLICABLE, f"{module.profile.name} has all functions that read")
    for reader in absent:
        yield from refused(module, _body(reader.area, 0, 1), FUNCTION)


def _body(area: Area, start: int, count: int) -> bytes:
    return bytes((READERS[area].function,)) + start.to_bytes(2, "big") + count.to_bytes(2, "big")


# --- reads ------------------------------------------------------------------------------------------------------------


def _counts(area: Area, module: Subject) -> Procedure[None]:
    """Read some numbers of items: the number of bytes is right, and whole."""
    rows = max(runs(module, area), key=lambda run: sum(row.count for row in run))
    most = sum(row.count for row in rows)
    for count in sorted({count for count in (1, 2, 7, 8, 9, most) if count <= most}):
        if area.bits or _is_boundary(rows, count):
            yield from items(module, area, rows[0].address, count)


def _is_boundary(rows: list[modbus.Register], count: int) -> bool:
    """Return whether so many registers end neither within a 32-bit number nor within a log record."""
    for row in rows:
        if count <= row.count:
            return count % row.kind.width == 0
        count -= row.count
    return False


def _wrong_counts(area: Area, module: Subject) -> Procedure[None]:
    row = runs(module, area)[-1][0]
    codes = VALUE if area in _PRINTED else ADDRESS_OR_VALUE
    for count in (0, MOST[area] + 1, 0xFFFF):
        yield from refused(module, _body(area, row.address, count), codes)


def _wrong_starts(area: Area, module: Subject) -> Procedure[None]:
    *_, behind, last = gaps(module, area)
    for start in (behind, last):
        yield from refused(module, _body(area, start, 1), ADDRESS if area in _PRINTED else ADDRESS_OR_VALUE)


def _wrong_lengths(area: Area, module: Subject) -> Procedure[None]:
    body = _body(area, runs(module, area)[0][0].address, 1)
    for wrong in (body[:-1], body[:1], body + b"\0"):
        yield from refused(module, wrong, VALUE, silence=area not in _PRINTED)


def _padding(area: Area, module: Subject) -> Procedure[None]:
    """Read a few bits: those of the last byte that are beyond them are 0, but nobody checks them (E120)."""
    rows = max(runs(module, area), key=lambda run: sum(row.count for row in run))
    for count in sorted({1, min(7, sum(row.count for row in rows))}):
        wire = module.wire(READERS[area](module.address, rows[0].address, count))
        answer = module.hear(wire)
        heard = (yield from module.send(wire)).wire
        if not heard:
            yield from module.alive(wire)
        if found := difference(answer, heard):
            raise module.wrong(found, wire, heard, (answer.wire or b"").hex(" "))
        if heard[_BITS] >> count:
            raise Strange(
                "bits beyond those that were asked for are not 0",
                sent=wire,
                received=heard,
                expected=f"{count} bits, then zeros",
                erratum="E120",
            )


_BITS = 3
"""The place of the first eight bits of an answer."""


def _around(area: Area, module: Subject) -> Procedure[None]:
    """Read from the last address on, to beyond it."""
    for start, count in ((0xFFFF, 2), (0xFFF0, 0x18)):
        yield from refused(module, _body(area, start, count), ADDRESS_OR_VALUE)


# --- writes -----------------------------------------------------------------------------------------------------------


_NO_ITEM = b"\xff\xfe"
"""An address that no map has; two items from it on do not go beyond the last one."""
_WRONG_STARTS: dict[Writer, bytes] = {
    modbus.WriteSingleCoil: b"\xff\0",
    modbus.WriteSingleRegister: b"\0\0",
    modbus.WriteMultipleCoils: b"\0\2\1\3",
    modbus.WriteMultipleRegisters: b"\0\1\2\0\0",
}
"""The functions that write, and what follows the start of a request that would be right but for it."""
_WRONG_WRITES: dict[Writer, tuple[bytes, ...]] = {
    modbus.WriteSingleCoil: (b"\0\1",),
    modbus.WriteMultipleCoils: (b"\0\1\0", b"\0\0\0"),
    modbus.WriteMultipleRegisters: (b"\0\1\4\0\0\0\0", b"\0\0\0"),
}
"""What is wrong behind the start: a coil of 0001, fewer or more bytes than the count needs, no item at all."""


def _not_written_there(writer: Writer, module: Subject) -> Procedure[None]:
    yield from refused(module, bytes((writer.function,)) + _NO_ITEM + _WRONG_STARTS[writer], ADDRESS_OR_VALUE)


_AROUND: dict[Writer, bytes] = {
    modbus.WriteMultipleCoils: b"\xff\xff\0\2\1\0",
    modbus.WriteMultipleRegisters: b"\xff\xff\0\2\4\0\0\0\0",
}
"""The functions that write several items, and a start, a count and values that go beyond the last address."""


def _not_written_around(writer: Writer, module: Subject) -> Procedure[None]:
    yield from refused(module, bytes((writer.function,)) + _AROUND[writer], ADDRESS_OR_VALUE)


def _not_written_so(writer: Writer, module: Subject) -> Procedure[None]:
    """Send damaged writes to an item that they could only clear."""
    coils = writer.area is Area.COIL
    area, name = (
        (Area.COIL, "host_watchdog_timed_out") if coils else (Area.HOLDING_REGISTER, "host_watchdog_timeout_count")
    )
    row = row_of(module, area, name)
    start = bytes((writer.function,)) + row.address.to_bytes(2, "big")
    for wrong in _WRONG_WRITES[writer]:
        yield from refused(module, start + wrong, ADDRESS_OR_VALUE)


# --- the checks -------------------------------------------------------------------------------------------------------

_CODES = {area: f"{READERS[area].function:02X}" for area in Area}

STEPS: dict[str, Steps] = {
    "rtu/crc/wrong": _wrong_crc,
    "rtu/crc/missing": _no_crc,
    "rtu/address/reserved": partial(_other_addresses, _RESERVED_ADDRESSES),
    "rtu/address/broadcast-read": partial(_other_addresses, (modbus.BROADCAST,)),
    "rtu/address/broadcast-write": _broadcast_write,
    "rtu/function/unknown": _unknown_functions,
    "rtu/function/not-of-the-module": _other_functions,
    "rtu/function/bit-7": _functions_with_bit_7,
    "rtu/function/absent": _absent_functions,
    **{f"rtu/{_CODES[area]}/counts": partial(_counts, area) for area in Area},
    **{f"rtu/{_CODES[area]}/counts-n1": partial(_wrong_counts, area) for area in Area},
    **{f"rtu/{_CODES[area]}/counts-n2": partial(_wrong_starts, area) for area in Area},
    **{f"rtu/{_CODES[area]}/around": partial(_around, area) for area in Area},
    **{f"rtu/{_CODES[area]}/padding": partial(_padding, area) for area in Area if area.bits},
    **{f"rtu/{writer.function:02X}/around": partial(_not_written_around, writer) for writer in _AROUND},
    **{f"rtu/{_CODES[area]}/length": partial(_wrong_lengths, area) for area in Area},
    **{f"rtu/{writer.function:02X}/start": partial(_not_written_there, writer) for writer in _WRONG_STARTS},
    **{f"rtu/{writer.function:02X}/values": partial(_not_written_so, writer) for writer in _WRONG_WRITES},
    **rtu_settings.STEPS,
}
