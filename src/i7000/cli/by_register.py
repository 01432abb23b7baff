"""Requests of coils and registers for a model: addresses by name, values in units, both checked against its map.

Laws: what a map has at an address decides how a value there is written: as ``i7000 decode`` prints it. The manual's
numbers (40489) are refused, since frames have addresses (488), and the address that is meant is named.
"""

import re
from collections.abc import Iterable, Mapping
from typing import Any

from i7000 import InvalidValueError, LineSettings, TypeCode, modbus
from i7000.cli.choices import chosen
from i7000.cli.numbers import hex_byte, integer, is_hex
from i7000.cli.records import parts_of
from i7000.cli.refusals import as_written
from i7000.cli.units import Scale, counts
from i7000.cli.words import UsageError, near, truth, type_code
from i7000.message import Message
from i7000.modbus import Access, Area, Kind, Register, RegisterMap
from i7000.modbus.items import MOST_BITS
from i7000.modbus.request import FIRST_ITEMS

__all__ = ["AREAS", "NUMBER", "area_words", "is_of_registers", "is_reading", "number_note", "take_fields"]

AREAS: Mapping[type[Any], Area] = {kind: kind.area for kind in modbus.REQUESTS if kind.area is not None}
_SEVERAL: Mapping[type[Message], type[Message]] = {
    modbus.WriteSingleCoil: modbus.WriteMultipleCoils,
    modbus.WriteSingleRegister: modbus.WriteMultipleRegisters,
}
NUMBER = re.compile("[0134][0-9]{4}|[134][0-9]{5}")
"""A number of the manual; in other programs it may have six digits."""
_PRINTED = 9999
"""Addresses below this one have a number of five digits in the manual."""


def is_of_registers(kind: type[Message]) -> bool:
    """Return whether a message is a request for coils, inputs or registers by address."""
    return kind in AREAS


def is_reading(kind: type[Message]) -> bool:
    """Return whether such a request reads; else it writes."""
    return "count" in parts_of(kind)


def take_fields(
    kind: type[Message], given: dict[str, str], registers: RegisterMap | None, *, force: bool
) -> dict[str, Any]:
    """Take the fields for registers out of `given`, and return their values.

    Special: with `force` only names are replaced by addresses; values stay in `given`, to be read as plain numbers.
        Without a map, nothing is taken.
    Errors: `UsageError` for what cannot be understood, `InvalidValueError` for what the module does not have or take.
    """
    field = next(name for name in parts_of(kind) if name in FIRST_ITEMS)
    if registers is None:
        if not _is_number(given.get(field, "")):
            raise UsageError(f"{field}: {given[field]!r} is not a number, and names of registers need --model")
        return {}
    text = given.pop(field, None)
    if text is None:
        return {}
    row = None if _is_number(text) else _find(kind, field, text, registers)
    found: dict[str, Any] = {field: integer(text) if row is None else row.address}
    if row and is_reading(kind) and "count" not in given:
        found["count"] = registers.read(1, row.name).count
    if force:
        return found
    _check_address(kind, field, text, found[field], registers)
    if "count" in given:
        found["count"] = integer(given.pop("count"))
    for value in given.keys() & {"value", "values"}:
        texts = given.pop(value).split(",")
        found[value] = _written(kind, found[field], texts, registers)
    for address in range(found[field], found[field] + min(found.get("count", 0), MOST_BITS)):
        _row(kind, address, registers)
    return found


def number_note(kind: type[Message], assignments: Iterable[str]) -> str | None:
    """Return a note if an address looks like a number of the manual; None otherwise.

    >>> number_note(modbus.ReadHoldingRegisters, ["address=1", "start=40489"])
    'start=40489: 40489 looks like a number of the manual; its address in frames is 488'
    """
    for assignment in assignments if is_of_registers(kind) else ():
        field, _, text = assignment.partition("=")
        if field in FIRST_ITEMS and NUMBER.fullmatch(text) and int(text[1:]):
            return (
                f"{assignment}: {text} looks like a number of the manual; its address in frames is {int(text[1:]) - 1}"
            )
    return None


def _is_number(text: str) -> bool:
    return is_hex(text) or not text[:1].isalpha()


# --- addresses --------------------------------------------------------------------------------------------------------


def area_words(area: Area) -> str:
    """Return the name of what an area has, such as ``holding register``."""
    return area.name.lower().replace("_", " ")


def _check_address(kind: type[Message], field: str, text: str, address: int, registers: RegisterMap) -> None:
    """Refuse a number of the manual in place of an address, and what no frame can have."""
    if NUMBER.fullmatch(text):
        raise UsageError(f"{field}: {_manual(kind, field, text, registers)}")
    if not 0 <= address <= 0xFFFF:
        raise InvalidValueError(field, address, "0..65535", kind.section)


def _find(kind: type[Message], field: str, name: str, registers: RegisterMap) -> Register:
    """Find a row by name."""
    area = AREAS[kind]
    others = [row for row in registers if row.name == name]
    found = next((row for row in others if row.area is area), None)
    model = registers.profile.model.value
    if found is None and others:
        raise UsageError(f"{field}: {name} of {model} is {_article(others[0].area)}, not {_article(area)}")
    if found is None:
        names = sorted({row.name for row in registers if row.area is area})
        hint = near(name, names) or f": its {area_words(area)}s are {', '.join(names)}"
        raise UsageError(f"{field}: {model} has no {area_words(area)} {name!r}{hint}")
    return found


def _article(area: Area) -> str:
    return f"{'an' if area is Area.INPUT_REGISTER else 'a'} {area_words(area)}"


def _manual(kind: type[Message], field: str, text: str, registers: RegisterMap) -> str:
    """Return why a number of the manual is not an address, and which address is meant."""
    area, address = Area(int(text[0])), int(text[1:]) - 1
    row = _at(registers, area, address)
    what = f"{text} is the number of {row.name if row else _article(area)}"
    if area is not AREAS[kind]:
        kinds = f"{'reads' if is_reading(kind) else 'writes'} {area_words(AREAS[kind])}s"
        return f"{what} at address {address} of the {area_words(area)}s; {kind.__name__} {kinds}"
    return f"{what}; its address in frames is {field}={address}" + (
        f" or {field}={row.name}" if row and row.address == address and (row.count == 1 or field == "start") else ""
    )


def _at(registers: RegisterMap, area: Area, address: int) -> Register | None:
    found = (row for row in registers if row.area is area and row.address <= address < row.address + row.count)
    return next(found, None)


def _row(kind: type[Message], address: int, registers: RegisterMap) -> Register:
    """Return the row at an address that a message reads or writes.

    Errors: `InvalidValueError` if the map has none, or none that can be read or written so.
    """
    area, model = AREAS[kind], registers.profile.model.value
    row = _at(registers, area, address)
    if row is None:
        number = Register("", area, address).number
        printed = f", {number} in the manual" if address < _PRINTED else ""
        reason = f"{model} has no {area_words(area)} at address {address}{printed}"
        raise InvalidValueError("address", address, f"i7000 registers --model {model} lists what it has", "", reason)
    reads = is_reading(kind)
    if row.access is (Access.WRITE if reads else Access.READ):
        allowed = f"it can only be {'written' if reads else 'read'}"
        raise InvalidValueError(
            "address", address, allowed, "", f"{row.name} cannot be {'read' if reads else 'written'}"
        )
    return row


# --- values -----------------------------------------------------------------------------------------------------------


def _written(kind: type[Message], start: int, texts: list[str], registers: RegisterMap) -> Any:  # noqa: ANN401
    """Read what is written from an address on, each value as the row has it that stands there."""
    items: list[int] = []
    for text in texts:
        items.extend(_items(kind, start + len(items), text.strip(), registers))
    if "values" in parts_of(kind):
        return tuple(items)
    if len(items) > 1:
        raise UsageError(f"value: {kind.__name__} writes one, and this is {len(items)}: use {_SEVERAL[kind].__name__}")
    return items[0]


def _items(kind: type[Message], address: int, text: str, registers: RegisterMap) -> tuple[int, ...]:
    """Return what is written for the value at an address."""
    row = _row(kind, address, registers)
    number = Register("", row.area, address).number
    try:
        value = _value(row, text)
    except UsageError as error:
        raise UsageError(f"{row.name}: {error}") from None
    try:
        request: Any = registers.write(1, number, value)
    except InvalidValueError as refusal:
        raise as_written(refusal, row.name, text) from None
    return request.values if isinstance(request, modbus.WriteMultipleRegisters) else (request.value,)


def _value(row: Register, text: str) -> Any:  # noqa: ANN401
    """Read a value of a row, as the row describes it."""
    if text in row.labels:
        return row.labels.index(text)
    if row.values is TypeCode:
        return type_code(text)
    if row.values is LineSettings:
        return LineSettings.from_byte(hex_byte(text))
    if row.values:
        return chosen(text, row.values)
    if row.kind is Kind.BOOL:
        return truth(text)
    scale = Scale(row.unit or "", round(1 / (row.scale or 1)))
    read = counts(text, scale)
    if is_hex(text) and row.kind in (Kind.INT8, Kind.INT16):
        bits = 8 if row.kind is Kind.INT8 else 16
        read -= (read & 1 << (bits - 1)) << 1
    return read / scale.per_unit if scale.per_unit > 1 else read
