"""``i7000 commands``: what a model can do."""

from collections.abc import Iterable
from typing import Annotated, Any

from cyclopts import Parameter

from i7000 import Model, Profile, dcon, modbus
from i7000.cli.options import Json, Module, ProtocolName
from i7000.cli.records import Record, command_record
from i7000.cli.text import Line, Printer, command_lines, request_lines

__all__ = ["commands"]


def commands(
    *,
    model: Annotated[str | None, Parameter(help="The model.")] = None,
    firmware: Annotated[str | None, Parameter(help="Its firmware; the newest if it is not given.")] = None,
    protocol: ProtocolName = "dcon",
    json: Json = False,
) -> int:
    """List what a model can do, or all that any can, and who can.

    Columns: section of the manual, command, response, name, what it is about, models; by Modbus the PDU of the request,
    which begins with function and sub-function, and no response.

    JSON keys: `section`, `name`, `title`, `syntax`, `fields` (and their values), `response`, `response_syntax`,
    `models` (and the firmware from which on, or null), `errata`.
    """
    known = Module(model=model, firmware=firmware).known()
    profiles = [known.default] if known.default else [Profile(one, firmware=known.firmware) for one in Model]
    printer = Printer(json=json)
    for command in modbus.REQUESTS if protocol == "rtu" else dcon.COMMANDS:
        having = [profile.model.value for profile in profiles if command.availability not in profile.refused]
        if having:
            printer.record(*_listed(command, having))
    return 0


def _listed(command: type[dcon.AnyCommand | modbus.Request[Any]], models: list[str]) -> tuple[Record, Iterable[Line]]:
    record = command_record(command, models)
    return record, request_lines(record) if issubclass(command, modbus.Request) else command_lines(record)
