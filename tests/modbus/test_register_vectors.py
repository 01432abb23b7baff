"""Every vector of ``spec/vectors/registers``: registers and bits to values, and back."""

from typing import Any

import pytest

from i7000 import DecodeError, Firmware, LineSettings, Reading, modbus
from i7000.modbus.register_values import counts_of
from tests.each import each
from tests.spec.lint import Record, load, table_files
from tests.vectors import parameters, profile_of

READ = parameters("vectors/registers", lambda vector: vector["fault"] is None)
REJECTED = parameters("vectors/registers", lambda vector: vector["fault"] is not None)
WRITTEN = parameters("vectors/registers", lambda vector: vector["direction"] == "both" and vector["fault"] is None)
WRITABLE = {
    row["name"] for path in table_files("modbus_registers") for row in load(path)["rows"] if row["access"] != "R"
}


def decoded(vector: Record) -> tuple[modbus.Register, tuple[Any, ...]]:
    """The row of a vector, and what its items mean."""
    registers = modbus.RegisterMap(profile_of(vector["profile"]))
    row = registers.find(vector["name"])
    width = row.kind.width
    channels = range(vector["first"], vector["first"] + max(1, len(vector["items"]) // width))
    several = row.count > width
    values: Any = registers.decode(
        row.name, vector["items"], channels=channels if several else None, big_endian=vector["big_endian"]
    )
    return row, values if several else (values,)


def plain(value: Any) -> list[tuple[Any, str | None]]:
    """A value as the vectors have it: numbers and statuses."""
    if isinstance(value, modbus.LogRecord):
        return [*(pair for reading in value.readings for pair in plain(reading)), (value.time, "ok")]
    if isinstance(value, Reading):
        return [(value.value, value.status.value)]
    if isinstance(value, LineSettings):
        return [(value.byte, None)]
    if isinstance(value, Firmware):
        return [(int.from_bytes(bytes(value), "big"), None)]
    if isinstance(value, str):
        return [(int(f"00{value}00", 16), None)]
    return [(getattr(value, "value", value), None)]


def expected(vector: Record) -> list[tuple[Any, str | None]]:
    statuses = vector["statuses"] or [None] * len(vector["values"])
    return list(zip(vector["values"], statuses, strict=True))


@each("vector", READ)
def test_items_are_read_as_the_vector_says(vector: Record) -> None:
    row, values = decoded(vector)

    found = [pair for value in values for pair in plain(value)]

    assert [status for _, status in expected(vector)] == [status for _, status in found]
    for (wanted, _), (number, _) in zip(expected(vector), found, strict=True):
        assert wanted == (number if number is None else pytest.approx(number, rel=1e-12))
    units: set[str | None] = {value.unit for value in values if isinstance(value, Reading)}
    assert {vector["unit"]} == (units or {row.unit})


@each("vector", WRITTEN)
def test_values_are_written_as_the_vector_says(vector: Record) -> None:
    row, values = decoded(vector)
    profile = profile_of(vector["profile"])

    if isinstance(values[0], Reading):
        items = modbus.words(values, profile, channel=vector["first"])
    else:
        items = tuple(
            item for value in values for item in counts_of(row, value, profile, big_endian=vector["big_endian"])
        )

    assert tuple(vector["items"]) == items


@each("vector", [case for case in WRITTEN if case.values[0]["name"] in WRITABLE])
def test_a_write_has_the_items_of_the_vector(vector: Record) -> None:
    row, values = decoded(vector)
    registers = modbus.RegisterMap(profile_of(vector["profile"]))
    several = row.count > row.kind.width
    channels = range(vector["first"], vector["first"] + len(values)) if several else None

    request: Any = registers.write(
        0x01, row.name, values if several else values[0], channels=channels, big_endian=vector["big_endian"]
    )

    sent = getattr(request, "values", None) or (request.value,)
    start = next(getattr(request, name) for name in ("start", "register", "coil") if hasattr(request, name))
    assert tuple(vector["items"]) == tuple(map(int, sent))
    assert row.address + vector["first"] == start


@each("vector", REJECTED)
def test_items_without_a_value_are_rejected_with_the_fault_of_the_vector(vector: Record) -> None:
    with pytest.raises(DecodeError) as caught:
        decoded(vector)

    assert vector["fault"] == caught.value.fault.value
