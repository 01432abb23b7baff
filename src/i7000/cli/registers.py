"""``i7000 registers``: what a model has by Modbus."""

from typing import Annotated, Literal

from cyclopts import Parameter

from i7000 import modbus
from i7000.cli.explain import registers_explained
from i7000.cli.explain_text import register_text
from i7000.cli.options import Json, Module
from i7000.cli.records import register_record
from i7000.cli.register_formats import csv_lines, telegraf_lines
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
    output_format: Annotated[
        Literal["csv", "telegraf"] | None,
        Parameter(
            name="--format", help="Print the list for another program: as CSV, or as a configuration of Telegraf."
        ),
    ] = None,
    json: Json = False,
) -> int:
    """List the Modbus coils, inputs and registers of a model, or explain one in full.

    Columns of the list: number in the manual, name, access, kind, unit of a count, range of counts. In a number such as
    40489, the first digit is the area; the address in frames is the rest less 1, here 488.

    `--format telegraf` is a configuration of the plugin inputs.modbus, for a serial port and address 1: change both in
    it. It reads each value once, in its unit. Readings are numbers as sent, unless you give types and format:
    `--model M-7019R,type=K,modbus_format=engineering`. Left out are log records and what can only be written.

    Examples: `i7000 registers --model M-7019R`, `i7000 registers host_watchdog_timeout`, `i7000 registers 40353`,
    `i7000 registers --model M-7019R --format csv`

    JSON keys: `number`, `last_number`, `name`, `address` (as in frames), `count`, `access`, `kind`, `unit`, `scale` (of
    a count), `minimum`, `maximum` (in counts). An explained one also has `meaning`, `values`, `cleared_by` (the only
    value that can be written, if there is one), `functions`, `models`, `sections`, `errata`, `errata_explained`.
    """
    known = Module(model=() if model is None else (model,), firmware=firmware).known("rtu")
    if name is None and known.model is None:
        raise UsageError("give --model to list its registers, or a register to explain, such as i7000 registers 40489")
    if output_format is not None and (json or name is not None):
        raise UsageError(f"give --format without {'--json' if json else 'a register'}: it prints the list of a model")
    profiles = {profile.model: profile for profile in reversed(known.modbus)}
    printer = Printer(json=json)
    if name is not None:
        shown: set[str] = set()
        for record in registers_explained(name, reversed(profiles.values())):
            printer.record(record, register_text(record, shown))
        return 0
    rows = modbus.RegisterMap(*profiles.values())
    if output_format is not None:
        for line in csv_lines(rows) if output_format == "csv" else telegraf_lines(rows, known):
            printer.write(line)
        return 0
    for row in rows:
        record = register_record(row)
        printer.record(record, register_lines(record))
    return 0
