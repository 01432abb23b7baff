"""``i7000 registers``: what a model has by Modbus."""

from typing import Annotated

from cyclopts import Parameter

from i7000 import modbus
from i7000.cli.options import Json, Module
from i7000.cli.records import Record
from i7000.cli.text import Printer, register_lines

__all__ = ["registers"]


def registers(
    *,
    model: Annotated[str, Parameter(help="The model.")],
    firmware: Annotated[str | None, Parameter(help="Its firmware; the newest if it is not given.")] = None,
    json: Json = False,
) -> int:
    """List the coils, inputs and registers that a model has by Modbus.

    Columns: the manual's numbers (the digit before is the kind; frames have the rest less 1), name, access, kind, unit
    of a count, range of counts.

    JSON keys: `number`, `last_number`, `name`, `address` (as in frames), `count`, `access`, `kind`, `unit`, `scale` (of
    a count), `minimum`, `maximum` (in counts).
    """
    known = Module(model=model, firmware=firmware).known("rtu")
    printer = Printer(json=json)
    for row in modbus.RegisterMap(known.modbus[0]):
        record = register_record(row)
        printer.record(record, register_lines(record))
    return 0


def register_record(row: modbus.Register) -> Record:
    """Return the record of a row of an address map."""
    return {
        "number": row.number,
        "last_number": row.last_number,
        "name": row.name,
        "address": row.address,
        "count": row.count,
        "access": row.access.value,
        "kind": row.kind.value,
        "unit": row.unit,
        "scale": row.scale,
        "minimum": row.minimum,
        "maximum": row.maximum,
    }
