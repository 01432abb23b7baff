"""``i7000 registers``: what a model has by Modbus."""

from typing import Annotated

from cyclopts import Parameter

from i7000 import modbus
from i7000.cli.explain import registers_explained
from i7000.cli.explain_text import register_text
from i7000.cli.options import Json, Module
from i7000.cli.records import register_record
from i7000.cli.text import Printer, register_lines
from i7000.cli.words import UsageError

__all__ = ["registers"]


def registers(
    name: Annotated[str | None, Parameter(help="A name, number (40489) or address (488) to explain.")] = None,
    /,
    *,
    model: Annotated[
        str | None, Parameter(help="The model. Without it, NAME is explained for every model. Example: M-7019R.")
    ] = None,
    firmware: Annotated[
        str | None, Parameter(help="Firmware of the model, such as B3.9; the newest unless given.")
    ] = None,
    json: Json = False,
) -> int:
    """List the Modbus coils, inputs and registers of a model, or explain one in full.

    Columns of the list: number in the manual, name, access, kind, unit of a count, range of counts. In a number such as
    40489, the first digit is the area; the address in frames is the rest less 1, here 488.

    Examples: `i7000 registers --model M-7019R`, `i7000 registers host_watchdog_timeout`, `i7000 registers 40353`

    JSON keys: `number`, `last_number`, `name`, `address` (as in frames), `count`, `access`, `kind`, `unit`, `scale` (of
    a count), `minimum`, `maximum` (in counts). An explained one also has `meaning`, `values`, `cleared_by` (the only
    value that can be written, if there is one), `functions`, `models`, `sections`, `errata`, `errata_explained`.
    """
    known = Module(model=() if model is None else (model,), firmware=firmware).known("rtu")
    if name is None and known.model is None:
        raise UsageError("give --model to list its registers, or a register to explain, such as i7000 registers 40489")
    profiles = {profile.model: profile for profile in reversed(known.modbus)}
    printer = Printer(json=json)
    if name is not None:
        shown: set[str] = set()
        for record in registers_explained(name, reversed(profiles.values())):
            printer.record(record, register_text(record, shown))
        return 0
    for row in modbus.RegisterMap(*profiles.values()):
        record = register_record(row)
        printer.record(record, register_lines(record))
    return 0
