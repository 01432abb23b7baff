"""A command, a register or an erratum in full: a record of all that ``spec/`` and the classes say about it."""

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from i7000 import (
    BaudRate,
    CharacterFormat,
    DataFormat,
    LineSettings,
    Model,
    Profile,
    ReportSettings,
    dcon,
    modbus,
)
from i7000.cli import facts
from i7000.cli.by_register import AREAS, is_reading
from i7000.cli.numbers import integer, is_hex
from i7000.cli.records import Record, command_record, parts_of, register_record
from i7000.cli.words import UsageError, near
from i7000.message import Message

__all__ = ["AnyCommand", "command_explained", "commands_named", "errata_named", "registers_explained"]

_EXAMPLES = 2
"""The number of examples shown for accepted frames."""


def _plain(name: str) -> str:
    """Return a name in lower case, without separators."""
    return re.sub(r"[-_\s]", "", name).lower()


# --- commands ---------------------------------------------------------------------------------------------------------

AnyCommand = type[dcon.AnyCommand] | type[modbus.Request[Any]]


def commands_named(name: str, kinds: Sequence[AnyCommand]) -> list[AnyCommand]:
    """Find commands by name, by the name of their response, by syntax, by function and sub-function, or by section.

    Errors: `UsageError` with suggestions, if no command fits.

    >>> [found] = commands_named("$AA2", dcon.COMMANDS)
    >>> found.__name__
    'ReadConfiguration'
    """
    syntax = re.sub(r"^([%#$~@])[0-9A-F]{2}", r"\1AA", name)
    ways = (
        [kind for kind in kinds if name == kind.section or name in _syntax(kind) or syntax in _syntax(kind)],
        [kind for kind in kinds if _plain(kind.__name__) == _plain(name)],
        [kind for kind in kinds if kind.section.startswith(f"{name}.")],
        [kind for kind in kinds if _is_function(name, kind)],
        [kind for kind in kinds if _plain(_response_name(kind)) == _plain(name)],
    )
    found = next(filter(None, ways), None)
    if found:
        return found
    names = [kind.__name__ for kind in kinds] if name[:1].isalpha() else [it for kind in kinds for it in _syntax(kind)]
    close = [it for it in names if len(name) > 2 and _plain(name) in it.lower()]
    hint = f"; did you mean {' or '.join(close)}?" if 0 < len(close) <= 6 else near(name, names)
    raise UsageError(
        f"there is no command {name!r}: give a name, a syntax such as $AA2, a function such as 46 2A, or a section such"
        f" as 2.10{hint}"
    )


def _syntax(kind: AnyCommand) -> tuple[str, ...]:
    """Return the syntax of a command of DCON, and nothing for a request by Modbus."""
    return () if issubclass(kind, modbus.Request) else (kind.syntax,)


def _response_name(kind: AnyCommand) -> str:
    response: type[Message] | None = getattr(kind, "response", None)
    return response.__name__ if response else ""


def _is_function(text: str, kind: AnyCommand) -> bool:
    """Return whether a text begins with the function of a request, and its sub-function if it has more."""
    if not issubclass(kind, modbus.Request):
        return False
    tokens = re.findall(r"\b([0-9A-F]{2})H?\b", text.upper().replace("0X", ""))
    own = [token for token in (kind.function, kind.sub_function) if token is not None]
    return bool(tokens) and [f"{token:02X}" for token in own][: len(tokens)] == tokens[: len(own)]


def command_explained(kind: AnyCommand, models: list[str]) -> Record:
    """Return a command or request in full: the keys of a listed one, and more."""
    row = facts.command_row(kind)
    if issubclass(kind, modbus.Request):
        listed, protocol, side = command_record(kind, models), "rtu", "request"
    else:
        listed, protocol, side = command_record(kind, models), "dcon", "command"
    response = getattr(kind, "response", None)
    found = facts.vectors_of(kind)
    accepted = [vector for vector in found if vector["outcome"] in ("response", "silence")]
    accepted.sort(key=lambda vector: (vector["source"] != "manual", "needs-state" in vector["flags"]))
    refused = [vector for vector in found if vector["outcome"] == "refused" and vector["source"] == "manual"]
    return listed | {
        "protocol": protocol,
        "description": row["description"],
        "parameters": _parameters(kind, row.get("fields", [])),
        "response_parameters": _parameters(response, row.get("response_fields", [])) if response else [],
        "pause": row.get("pause"),
        "broadcast": row.get("broadcast", response is None),
        "exceptions": row.get("exceptions", []),
        "examples": [_example(vector, side) for vector in accepted[:_EXAMPLES]],
        "refused": [_example(vector, side) for vector in refused],
        "errata": row["errata"],
        "errata_explained": facts.errata_about(row["errata"]),
    }


def _parameters(kind: type[Message], rows: list[Record]) -> list[Record]:
    """Return the fields of a message, as the tables and the class describe them."""
    stated = {row["name"]: row for row in rows}
    return [
        _parameter(name, field.type.__metadata__[0], stated.get(name, {})) for name, field in parts_of(kind).items()
    ]


def _parameter(name: str, part: Any, row: Record) -> Record:  # noqa: ANN401 - a part of a layout
    most = getattr(part, "most", None)
    return {
        "name": name,
        "notation": getattr(part, "notation", None),
        "allowed": f"1 to {most} items" if most else part.allowed,
        "values": _values(part.values),
    } | {key: row.get(key) for key in ("minimum", "maximum", "unit", "scale", "meaning")}


def _values(kind: Any) -> dict[str, str]:  # noqa: ANN401 - the type of the values of a field
    """Return what each part of a byte of settings adds to it; the meaning of other codes is in the tables."""
    if kind is LineSettings:
        rates = {f"{rate:02X}": f"{rate.bits_per_second} baud" for rate in BaudRate}
        return rates | {f"{form << 6:02X}": f"added for {form.name}" for form in CharacterFormat}
    if kind is ReportSettings:
        formats = {f"{form:02X}": form.name.lower() for form in DataFormat}
        return formats | {"20": "added for fast mode", "40": "added for a checksum", "80": "added to reject 50 Hz"}
    return {}


def _example(vector: Record, side: str) -> Record:
    return {
        "id": vector["id"],
        "comment": vector["comment"],
        "source": vector["source"],
        "model": vector["profile"]["model"],
        "checksum": vector["profile"]["checksum"] and side == "command",
        side: vector[side],
        f"{side}_wire": vector[f"{side}_wire"],
        "response": vector["response"],
        "response_wire": vector["response_wire"],
    }


# --- registers --------------------------------------------------------------------------------------------------------


def registers_explained(name: str, profiles: Iterable[Profile]) -> list[Record]:
    """Return the rows that a name, a number of the manual or an address means: one record for models that share it.

    Errors: `UsageError` with suggestions, if no model has it.
    """
    found: list[Record] = []
    names: dict[str, None] = {}
    for profile in profiles:
        for row in modbus.RegisterMap(profile):
            names[row.name] = None
            if _is_meant(name, row):
                _add(found, row, profile.model)
    if not found:
        known = sorted(names)
        close = [it for it in known if len(name) > 2 and _plain(name) in _plain(it)]
        hint = f"; did you mean {' or '.join(close)}?" if 0 < len(close) <= 6 else near(name, known)
        raise UsageError(
            f"there is no register {name!r}: give a name, a number such as 40489, or an address such as 488{hint}"
        )
    return found


def _is_meant(name: str, row: modbus.Register) -> bool:
    if re.fullmatch("[0134][0-9]{4}", name):
        return row.number <= name <= row.last_number
    if name.isdecimal() or is_hex(name):
        return row.address <= integer(name) < row.address + row.count
    return _plain(name) == _plain(row.name)


def _add(found: list[Record], row: modbus.Register, model: Model) -> None:
    """Add a row of the map of a model, or the model to the same row of another."""
    stated = facts.register_row(row, model.value)
    record = register_record(row) | {
        "meaning": stated["meaning"],
        "values": stated["values"],
        "cleared_by": row.cleared_by,
        "functions": _functions(row),
        "errata": stated["errata"],
    }
    same = next((it for it in found if {key: it[key] for key in record} == record), None)
    if same is None:
        same = record | {"models": [], "sections": [], "errata_explained": facts.errata_about(stated["errata"])}
        found.append(same)
    same["models"].append(model.value)
    if stated["section"] not in same["sections"]:
        same["sections"].append(stated["section"])


def _functions(row: modbus.Register) -> list[str]:
    """Return the functions that read or write a row."""
    able = {"R": (True,), "W": (False,), "R/W": (True, False)}[row.access.value]
    return [kind.pdu[:2] for kind, area in AREAS.items() if area is row.area and is_reading(kind) in able]


# --- errata -----------------------------------------------------------------------------------------------------------


def errata_named(name: str) -> Iterator[Record]:
    """Yield the errata with an id, or those about a section or a command.

    Errors: `UsageError` if no erratum fits.
    """
    number = re.fullmatch("E([0-9]+)", name.upper())
    wanted = f"E{int(number[1]):02}" if number else ""
    found = [
        row
        for row in facts.errata().values()
        if row["id"] == wanted or name in row["sections"] or _plain(name) in map(_plain, row["used_by"])
    ]
    if not found:
        raise UsageError(f"there is no erratum {name!r}: give an id such as E24, a section such as 2.11, or a command")
    yield from found
