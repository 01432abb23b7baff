"""What ``spec/`` says of a command, a register or an erratum: its rows and vectors, each read when first needed."""

import json
from collections.abc import Iterator
from functools import cache
from typing import Any

from i7000 import modbus, spec
from i7000.cli.records import Record
from i7000.message import Message
from i7000.modbus import Area, Register

__all__ = ["command_row", "errata", "errata_about", "register_row", "vectors_of"]


@cache
def _read(*path: str) -> Any:  # noqa: ANN401 - a file
    return json.loads(spec.files().joinpath(*path).read_text("utf-8"))


@cache
def errata() -> dict[str, Record]:
    """Return the errata by id."""
    return {row["id"]: row for row in _read("errata.json")["rows"]}


def errata_about(ids: list[str]) -> list[Record]:
    """Return the errata with these ids."""
    return [errata()[name] for name in ids]


def command_row(kind: type[Message]) -> Record:
    """Return the row of a command or request."""
    files = ("modbus_functions", "module_settings") if issubclass(kind, modbus.Message) else ("dcon_commands",)
    rows = (row for file in files for row in _read("tables", f"{file}.json")["rows"])
    found: Record = next(row for row in rows if row["name"] == kind.__name__)
    return found


def _files(*folder: str) -> Iterator[str]:
    return (file.name for file in spec.files().joinpath(*folder).iterdir())


def vectors_of(kind: Any) -> list[Record]:  # noqa: ANN401 - a command or request
    """Return the vectors with a command or request, in the order of its file."""
    side, folder, prefix = "command", "dcon", f"{kind.section}-"
    if issubclass(kind, modbus.Message):
        sub_function = "" if kind.sub_function is None else f"{kind.sub_function:02X}-"
        side, folder, prefix = "request", "modbus", f"{kind.function:02X}-{sub_function}"
    (file,) = (name for name in _files("vectors", folder) if name.startswith(prefix))
    found = _read("vectors", folder, file)["vectors"]
    return [vector for vector in found if vector[side] and vector[side]["type"] == kind.__name__]


@cache
def _map(model: str) -> Record:
    maps = (_read("tables", "modbus_registers", name) for name in _files("tables", "modbus_registers"))
    found: Record = next(it for it in maps if model in it["models"])
    return found


def register_row(row: Register, model: str) -> Record:
    """Return the row of the map of a model for one of its registers."""
    area = Area(row.area).name.lower()
    found: Record = next(it for it in _map(model)["rows"] if (it["name"], it["area"]) == (row.name, area))
    return found | {"section": _map(model)["section"]}
