"""``i7000 commands``: what a model can do."""

from collections.abc import Iterable
from typing import Annotated, Literal

from cyclopts import Parameter

from i7000 import Model, Profile, modbus
from i7000.cli.explain import KINDS, AnyCommand, command_explained, commands_named
from i7000.cli.explain_text import command_text
from i7000.cli.options import Json, Module
from i7000.cli.records import Record, command_record
from i7000.cli.text import Line, Printer, command_lines, request_lines
from i7000.cli.words import UsageError

__all__ = ["commands"]

_MOST_EXPLAINED = 4
"""If a NAME fits more commands, they are listed."""


def commands(
    name: Annotated[
        str | None, Parameter(help="A name, syntax, function or section to explain. Example: 2.10.")
    ] = None,
    /,
    *,
    model: Annotated[str | None, Parameter(help="List only what this model has. Example: I-7018R.")] = None,
    firmware: Annotated[
        str | None, Parameter(help="Firmware of the model, such as B3.9; the newest unless given.")
    ] = None,
    protocol: Annotated[
        Literal["auto", "dcon", "rtu"],
        Parameter(help="DCON or Modbus RTU. auto: both for a NAME, else DCON."),
    ] = "auto",
    json: Json = False,
) -> int:
    """List the commands of a model, or of all models; or explain one command in full.

    A NAME is the name of a command or of its response, a syntax (`'$AA2'`, quoted), a section of the manual (`2.10`),
    or a Modbus function with its sub-function (`03`, `"46 2A"`). A NAME that fits many commands lists them.

    Columns of the list: section of the manual, command, response, name, subject, models. For Modbus: the PDU of the
    request, which begins with function and sub-function, and no response.

    Examples: `i7000 commands --model M-7019R`, `i7000 commands SetCjcOffset`, `i7000 commands "46 2A"`

    JSON keys: `section`, `name`, `title`, `syntax`, `fields` (and their values), `response`, `response_syntax`,
    `models` (with their first firmware that has it, or null), `errata`. An explained command also has `protocol`,
    `description`, `parameters` and `response_parameters` (`name`, `notation`, `allowed`, `values` (of bytes of
    settings), `minimum`, `maximum`, `unit`, `scale`, `meaning`), `pause` (as in spec), `broadcast`, `exceptions`,
    `examples` and `refused` (vectors of spec), `errata_explained`.
    """
    known = Module(model=() if model is None else (model,), firmware=firmware).known(
        "rtu" if protocol == "rtu" else "dcon"
    )
    profiles = [known.default] if known.default else [Profile(one, firmware=known.firmware) for one in Model]
    listed = KINDS["dcon" if protocol == "auto" else protocol]
    chosen = listed if name is None else commands_named(name, protocol)
    having = {kind: [it.model.value for it in profiles if kind.availability not in it.refused] for kind in chosen}
    if not any(having.values()):
        names = sorted({kind.__name__ for kind in chosen})
        raise UsageError(f"{model} has no {' or '.join(names)}: {_scopes(chosen)}")
    shown: set[str] = set()
    printer = Printer(json=json)
    for kind, models in having.items():
        if name and models and len(chosen) <= _MOST_EXPLAINED:
            record = command_explained(kind, models)
            printer.record(record, command_text(record, shown))
        elif models:
            printer.record(*_listed(kind, models))
    return 0


def _scopes(kinds: Iterable[AnyCommand]) -> str:
    """Return which models have commands; of Modbus with that word, if there are others."""
    scopes: dict[bool, dict[str, None]] = {}
    for kind in kinds:
        scopes.setdefault(issubclass(kind, modbus.Request), {})[kind.availability.scope] = None
    return ", in Modbus ".join(", ".join(found) for found in scopes.values())


def _listed(command: AnyCommand, models: list[str]) -> tuple[Record, Iterable[Line]]:
    record = command_record(command, models)
    return record, request_lines(record) if issubclass(command, modbus.Request) else command_lines(record)
