"""The registers of a model for other programs: CSV, and the configuration of Telegraf."""

import csv
from collections.abc import Iterable, Iterator
from io import StringIO

from i7000 import ModbusDataFormat, modbus
from i7000.cli.records import register_record
from i7000.dissect import Known
from i7000.modbus import Access, Area, Kind

__all__ = ["csv_lines", "telegraf_lines"]


def csv_lines(rows: Iterable[modbus.Register]) -> Iterator[str]:
    """Yield a line with the names of the columns, then one for each row; what a row does not have is empty."""
    records = [register_record(row) for row in rows]
    written = StringIO()
    writer = csv.DictWriter(written, records[0], lineterminator="\n")
    writer.writeheader()
    writer.writerows(records)
    yield from written.getvalue().splitlines()


# --- Telegraf ---------------------------------------------------------------------------------------------------------

_AREAS = {
    Area.DISCRETE_INPUT: "discrete",
    Area.INPUT_REGISTER: "input",
    Area.COIL: "coil",
    Area.HOLDING_REGISTER: "holding",
}
"""The names that Telegraf has for them; those of the functions that more firmware has come first."""
_TYPES = {Kind.READING: "INT16", Kind.INT16: "INT16", Kind.INT8: "INT8L", Kind.UINT32: "UINT32"}
"""The types of words; those of all others are UINT16."""


def telegraf_lines(rows: Iterable[modbus.Register], known: Known) -> Iterator[str]:
    """Yield a configuration of the plugin ``inputs.modbus`` that reads every row once, in its unit.

    Special: log records, rows that can only be written, and rows whose name another area has already are left out.
        Readings are numbers as sent, unless the types and the engineering format are known.
    """
    yield from (
        "[[inputs.modbus]]",
        f'  name = "{known.model.value if known.model else ""}"',
        '  controller = "file:///dev/ttyUSB0"',
        "  baud_rate = 9600",
        "  data_bits = 8",
        '  parity = "N"',
        "  stop_bits = 1",
        '  transmission_mode = "RTU"',
        '  configuration_type = "request"',
    )
    read = [row for row in rows if row.access is not Access.WRITE and row.kind is not Kind.RECORD]
    named: set[str] = set()
    for area, register in _AREAS.items():
        listed = [row for row in read if row.area is area and row.name not in named]
        named.update(row.name for row in listed)
        if listed:
            yield from ("", "  [[inputs.modbus.request]]", "    slave_id = 1", '    byte_order = "CDAB"')
            yield from (f'    register = "{register}"', "    fields = [")
            yield from (f"      {{ {field} }}," for row in listed for field in _fields(row, known))
            yield "    ]"


def _fields(row: modbus.Register, known: Known) -> Iterator[str]:
    """Yield a field for each value of a row."""
    count = row.count // row.kind.width
    for at in range(count):
        name = row.name if count == 1 else f"{row.name}_{at}"
        field = f'address = {row.address + at * row.kind.width}, name = "{name}"'
        if row.kind is not Kind.BOOL:
            field += f', type = "{_TYPES.get(row.kind, "UINT16")}"'
        scale = _scale(row, at, known)
        yield field if scale is None else f"{field}, scale = {scale}"


def _scale(row: modbus.Register, at: int, known: Known) -> float | None:
    """Return what one count of a value is, or None for numbers that are taken as they are."""
    if row.kind is not Kind.READING:
        return None if row.scale in (None, 1) else row.scale
    types = known.types or ()
    one = types[0] if len(types) == 1 else types[at] if at < len(types) else None
    if one is None or known.modbus_data_format is not ModbusDataFormat.ENGINEERING:
        return None
    return float(f"1e-{one.modbus_decimals}")
