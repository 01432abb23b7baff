"""A command, a register or an erratum in full: a record of all that ``spec/`` and the classes say about it."""

import re
from collections.abc import Iterable, Mapping, Sequence
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
from i7000.cli.by_register import AREAS, NUMBER, area_words, is_reading
from i7000.cli.numbers import integer, is_hex
from i7000.cli.records import Record, command_record, parts_of, register_record
from i7000.cli.words import UsageError, near, plain
from i7000.message import Message

__all__ = ["KINDS", "AnyCommand", "command_explained", "commands_named", "errata_named", "registers_explained"]

_EXAMPLES = 2
"""The number of examples shown for accepted frames."""
_SECTIONS = {"dcon": "those of DCON are 2.1 to 2.43", "rtu": "those of Modbus are 3.1 to 3.4"}
_SECTIONS["auto"] = f"{_SECTIONS['dcon']}, {_SECTIONS['rtu']}"
_SECTION = re.compile(r"[0-9]+\.[0-9]+(\.[0-9]+)*")


# --- commands ---------------------------------------------------------------------------------------------------------

AnyCommand = type[dcon.AnyCommand] | type[modbus.Request[Any]]
KINDS: Mapping[str, Sequence[AnyCommand]] = {
    "auto": (*dcon.COMMANDS, *modbus.REQUESTS),
    "dcon": dcon.COMMANDS,
    "rtu": modbus.REQUESTS,
}
"""The commands and requests of each protocol."""


def commands_named(name: str, protocol: str) -> list[AnyCommand]:
    """Find commands by name, by the name of their response, by syntax, by function and sub-function, or by section.

    Errors: `UsageError` with suggestions, if no command of the protocol fits.

    >>> [found] = commands_named("$AA2", "dcon")
    >>> found.__name__
    'ReadConfiguration'
    """
    found = _named(name, KINDS[protocol])
    if found:
        return found
    if _named(name, KINDS["auto"]):
        raise UsageError(
            f"{name} is {'a DCON' if protocol == 'rtu' else 'a Modbus'} command: use --protocol "
            f"{'dcon' if protocol == 'rtu' else 'rtu'}"
        )
    kinds = KINDS[protocol]
    if _SECTION.fullmatch(name):
        raise UsageError(f"there is no command in section {name}: {_SECTIONS[protocol]}")
    names = [kind.__name__ for kind in kinds] if name[:1].isalpha() else [it for kind in kinds for it in _syntax(kind)]
    hint = near(name, names) or (
        ": give a name, a syntax such as $AA2, a function such as 46 2A, or a section such as 2.10"
    )
    raise UsageError(f"there is no command {name!r}{hint}")


def _named(name: str, kinds: Sequence[AnyCommand]) -> list[AnyCommand]:
    """Return the commands that a name means, in the first way in which it means any."""
    syntax = re.sub(r"^([%#$~@])[0-9A-F]{2}", r"\1AA", name)
    ways = (
        [kind for kind in kinds if name == kind.section or name in _syntax(kind) or syntax in _syntax(kind)],
        [kind for kind in kinds if plain(kind.__name__) == plain(name)],
        [kind for kind in kinds if kind.section.startswith(f"{name}.")],
        [kind for kind in kinds if _is_function(name, kind)],
        [kind for kind in kinds if name and plain(_response_name(kind)) == plain(name)],
    )
    return next(filter(None, ways), [])


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
    rows: list[modbus.Register] = []
    models: list[str] = []
    for profile in profiles:
        models.append(profile.model.value)
        for row in modbus.RegisterMap(profile):
            rows.append(row)
            if _is_meant(name, row):
                _add(found, row, profile.model)
    if not found:
        of = f"{models[0]} has" if len(models) == 1 else "there is"
        raise UsageError(f"{of} no register {_no_register(name, rows)}")
    return found


def _is_meant(name: str, row: modbus.Register) -> bool:
    if NUMBER.fullmatch(name):
        return _distance(name, row) == (0, 0)
    if name.isdecimal() or is_hex(name):
        return row.address <= integer(name) < row.address + row.count
    return plain(name) == plain(row.name)


def _distance(number: str, row: modbus.Register) -> tuple[int, int]:
    """Return how far a number of the manual is from those of a row: 0 for the same area, and how many numbers."""
    item = int(number[1:])
    first, last = int(row.number[1:]), int(row.last_number[1:])
    return int(number[0] != row.number[0]), max(first - item, item - last, 0)


def _no_register(name: str, rows: Sequence[modbus.Register]) -> str:
    """Return a name that no row has, and what comes near it."""
    if NUMBER.fullmatch(name):
        nearest = min(rows, key=lambda row: _distance(name, row))
        if nearest.number[0] != name[0]:
            return f"{name}, and no other {area_words(modbus.Area(int(name[0])))}"
        return f"{name}; the nearest is {nearest.number} {nearest.name}"
    if name.isdecimal() or is_hex(name):
        last = max(row.address + row.count - 1 for row in rows)
        return f"at address {name}: the last address is {last}; numbers of the manual have five digits, such as 40489"
    known = sorted({row.name for row in rows})
    return f"{name!r}{near(name, known) or ': give a name, a number such as 40489, or an address such as 488'}"


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


def errata_named(name: str) -> list[Record]:
    """Return the errata with an id, or those about a section or a command.

    Errors: `UsageError` with suggestions, if no erratum fits.
    """
    number = re.fullmatch("E([0-9]+)", name.upper())
    wanted = f"E{int(number[1]):02}" if number else ""
    rows = facts.errata()
    found = [
        row
        for row in rows.values()
        if row["id"] == wanted or name in row["sections"] or plain(name) in map(plain, row["used_by"])
    ]
    if found:
        return found
    if number:
        first, *_, last = rows
        raise UsageError(f"there is no erratum {name}: the ids are {first} to {last}")
    if _SECTION.fullmatch(name):
        raise UsageError(f"there is no erratum about section {name}")
    hint = near(name, sorted({it for row in rows.values() for it in row["used_by"] if it.isalpha()}))
    raise UsageError(
        f"there is no erratum {name!r}{hint or ': give an id such as E24, a section such as 2.11, or a command'}"
    )
