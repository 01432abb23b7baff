"""``i7000_selftest.c``: how many rows every array has, and the CRC-32 of their values, computed from ``spec/``."""

from collections.abc import Iterator
from zlib import crc32

from c.generate.header import filled, name_tables
from c.generate.spec import Spec
from c.generate.tables import Table
from c.generate.values import Value
from c.generate.vectors import Section

__all__ = ["selftest"]

_EXCHANGES, _READINGS = "i7000_exchange", "i7000_reading_vector"


def selftest(spec: Spec, made: list[Table], found: list[Section]) -> str:
    """Return ``i7000_selftest.c``, which checks some tables and vectors."""
    return filled("i7000_selftest.c", checks=_checks(spec, made, found), totals=_totals(found))


def _checks(spec: Spec, made: list[Table], found: list[Section]) -> Iterator[str]:
    for table in made:
        yield _check(table.name, table.kind, table.rows)
    for name, values in name_tables(spec).items():
        yield _check(name, "i7000_name", values)
    for section in found:
        yield _check(section.array, section.kind, section.vectors)


def _check(array: str, kind: str, values: list[Value]) -> str:
    digest = crc32(b"".join(value.proof for value in values))
    return f"    CHECK({array}, {kind.removeprefix('i7000_')}, {len(values)}, 0x{digest:08X}u);"


def _totals(found: list[Section]) -> Iterator[str]:
    for kind, variable in ((_EXCHANGES, "exchanges"), (_READINGS, "readings")):
        total = sum(len(section.vectors) for section in found if section.kind == kind)
        yield f"    if ({variable} != {total})"
        yield f'        failures++, printf("%lu {variable} in all, expected {total}\\n", (unsigned long){variable});'
