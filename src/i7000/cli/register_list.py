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
    name: Annotated[str | None, Parameter(help="A name, number (40489) or address (488) to explain in full.")] = None,
    /,
    *,
    model: Annotated[str | None, Parameter(help="The model; every model that has NAME if it is not given.")] = None,
    firmware: Annotated[str | None, Parameter(help="Its firmware; the newest if it is not given.")] = None,
    json: Json = False,
) -> int:
    """List the coils, inputs and registers that a model has by Modbus, or explain one in full.

    Columns of the list: the manual's numbers (the digit before is the kind; frames have the rest less 1), name, access,
    kind, unit of a count, range of counts.

    Examples: `i7000 registers --model M-7019R`, `i7000 registers host_watchdog_timeout`, `i7000 registers 40353`

    JSON keys: `number`, `last_number`, `name`, `address` (as in frames), `count`, `access`, `kind`, `unit`, `scale` (of
    a count), `minimum`, `maximum` (in counts). One that is explained also has `meaning`, `values`, `cleared_by` (what
    can be written, where nothing else can), `functions`, `models`, `sections`, `errata`, `errata_explained`.
    """
    known = Module(model=() if model is None else (model,), firmware=firmware).known("rtu")
    if name is None and known.model is None:
        raise UsageError("give --model to list its registers, or a register to be explained: i7000 registers 40489")
    profiles = {profile.model: profile for profile in reversed(known.modbus)}
    printer = Printer(json=json)
    if name:
        shown: set[str] = set()
        for record in registers_explained(name, reversed(profiles.values())):
            printer.record(record, register_text(record, shown))
        return 0
    for row in modbus.RegisterMap(*profiles.values()):
        record = register_record(row)
        printer.record(record, register_lines(record))
    return 0
