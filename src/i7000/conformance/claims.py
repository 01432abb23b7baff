"""What a module has, as a statement that a program can read: found by asking it, and held against it later.

Laws: a statement is never filled up with defaults: what is not in it is not claimed. Only reads are sent, so that
making one changes nothing.
"""

import json
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from typing import Any, Self

from attrs import field, fields_dict

from i7000 import dcon, modbus
from i7000.conformance.statement import Statement
from i7000.conformance.subject import Subject
from i7000.errors import DecodeError, InvalidValueError, shown
from i7000.frozen import frozen
from i7000.host.procedures import Procedure
from i7000.host.procedures.values import PROTOCOLS
from i7000.message import Query
from i7000.modbus import Access, Area, Kind, Register, RegisterMap
from i7000.models import Model
from i7000.profile import Profile
from i7000.settings import Protocol

__all__ = ["SCHEMA_VERSION", "Claims", "asked", "has"]

SCHEMA_VERSION = 1
"""The version of the JSON form of a statement."""
_WORDS = {protocol: word for word, protocol in PROTOCOLS.items()}


@frozen
class Claims:
    """What is claimed of a module.

    Shape: `commands` are sections of DCON reads, `functions` the codes of Modbus reads such as ``04`` and ``46/20``,
        `registers` the rows of the address maps as ``AREA/NAME``, `types` the type of each channel. `readings` are
        pairs of the id of an open check and what the module does.
    """

    model: str
    firmware: str | None
    name: str | None
    protocol: Protocol
    commands: tuple[str, ...] = ()
    functions: tuple[str, ...] = ()
    registers: tuple[str, ...] = ()
    types: tuple[str, ...] = ()
    readings: tuple[tuple[str, str], ...] = field(default=())

    def covers(self, statement: Statement) -> bool:
        """Return whether what a check is about is claimed; what only changes something is not part of a statement."""
        if statement.command is not None and statement.command.startswith("Read"):
            kind: Any = getattr(dcon, statement.command)
            return kind.section in self.commands or kind is dcon.ReadSynchronizedData
        if statement.function is not None and statement.function.startswith("Read"):
            kind = getattr(modbus, statement.function)
            if kind.sub_function is not None:
                return f"{kind.function:02X}/{kind.sub_function:02X}" in self.functions
            area = next(area for area, read in _READS.items() if read is kind)
            if not any(name.startswith(f"{area.name.lower()}/") for name in self.registers):
                return False
        rows = _numbers().get(statement.register or "", frozenset())
        return not rows or not rows.isdisjoint(self.registers)

    def to_json(self) -> str:
        """Return the statement as JSON."""
        document: dict[str, Any] = {
            "schema_version": SCHEMA_VERSION,
            "model": self.model,
            "firmware": self.firmware,
            "name": self.name,
            "protocol": _WORDS[self.protocol],
            "commands": list(self.commands),
            "functions": list(self.functions),
            "registers": list(self.registers),
            "types": list(self.types),
            "readings": dict(self.readings),
        }
        return json.dumps(document, indent=2) + "\n"

    @classmethod
    def from_json(cls, text: str | bytes) -> Self:
        """Return the statement of a JSON text.

        Errors: `InvalidValueError` for text that is not a statement, or not a whole one.
        """
        try:
            document = json.loads(text)
        except (ValueError, RecursionError) as error:
            raise _damaged(str(error)) from None
        if not isinstance(document, dict):
            raise _damaged("it is not an object")
        names = {"schema_version", *fields_dict(cls)}
        odd = sorted(set(document) ^ names)
        if odd:
            raise _damaged(f"{shown(odd[0])} is {'unknown' if odd[0] in document else 'missing'}")
        if document["schema_version"] != SCHEMA_VERSION:
            raise _damaged(f"schema_version is {shown(document['schema_version'])}, not {SCHEMA_VERSION}")
        protocol = document["protocol"]
        if not isinstance(protocol, str) or protocol not in PROTOCOLS:
            raise _damaged(f"protocol is {shown(protocol)}, not {' or '.join(PROTOCOLS)}")
        readings = document["readings"]
        if not isinstance(readings, dict) or not all(isinstance(value, str) for value in readings.values()):
            raise _damaged("readings is not an object of texts")
        if not isinstance(document["model"], str):
            raise _damaged("model is not a text")
        if not any(document[name] for name in ("commands", "functions", "registers")):
            raise _damaged("it claims no command, no function and no register")
        return cls(
            document["model"],
            _text_or_null("firmware", document["firmware"]),
            _text_or_null("name", document["name"]),
            PROTOCOLS[protocol],
            _texts("commands", document["commands"]),
            _texts("functions", document["functions"]),
            _texts("registers", document["registers"]),
            _texts("types", document["types"]),
            tuple(readings.items()),
        )


def _damaged(reason: str) -> InvalidValueError:
    return InvalidValueError("json", None, "the JSON of i7000 statement", "", f"this is not a statement: {reason}")


def _texts(name: str, value: object) -> tuple[str, ...]:
    if not isinstance(value, list) or not all(isinstance(it, str) for it in value):
        raise _damaged(f"{name} is not a list of texts")
    return tuple(value)


def _text_or_null(name: str, value: object) -> str | None:
    if value is not None and not isinstance(value, str):
        raise _damaged(f"{name} is not a text or null")
    return value


# --- what a module is asked for ---------------------------------------------------------------------------------------


def asked(module: Subject) -> Mapping[str, Query[Any]]:
    """Return the reads that show what a module has, by their names in a statement: those of all models."""
    if module.protocol is Protocol.DCON:
        return dict(_commands(module.address))
    return {**dict(_functions(module.address)), **dict(_registers(module.address))}


def _commands(address: int) -> Iterator[tuple[str, Query[Any]]]:
    """Yield every DCON command that only reads; channel 0 stands for all."""
    for kind in dcon.COMMANDS:
        if kind.__name__.startswith("Read") and kind is not dcon.ReadSynchronizedData:
            make: Any = kind
            yield kind.section, make(address, 0) if "channel" in fields_dict(make) else make(address)


def _functions(address: int) -> Iterator[tuple[str, Query[Any]]]:
    """Yield every sub-function that only reads."""
    for kind in modbus.REQUESTS:
        if kind.__name__.startswith("Read") and kind.sub_function is not None:
            make: Any = kind
            query = make(address, 0) if "channel" in fields_dict(make) else make(address)
            yield f"{kind.function:02X}/{kind.sub_function:02X}", query


_READS: dict[Area, Any] = {
    Area.COIL: modbus.ReadCoils,
    Area.DISCRETE_INPUT: modbus.ReadDiscreteInputs,
    Area.INPUT_REGISTER: modbus.ReadInputRegisters,
    Area.HOLDING_REGISTER: modbus.ReadHoldingRegisters,
}


def _registers(address: int) -> Iterator[tuple[str, Query[Any]]]:
    """Yield a read of the first value of every row of any map; rows of one name may stand in several places."""
    seen: set[tuple[Area, int]] = set()
    for row in _rows_of_all():
        if (row.area, row.address) in seen or not _is_asked(row):
            continue
        seen.add((row.area, row.address))
        count = row.kind.width if row.kind is Kind.RECORD else min(row.kind.width, row.count)
        yield f"{row.area.name.lower()}/{row.number}", _READS[row.area](address, row.address, count)


@cache
def _numbers() -> Mapping[str, frozenset[str]]:
    """Return the numbers of the rows that a statement can claim, by the name that checks have for them."""
    found: dict[str, set[str]] = {}
    for row in _rows_of_all():
        if _is_asked(row):
            area = row.area.name.lower()
            found.setdefault(f"{area}/{row.name}", set()).add(f"{area}/{row.number}")
    return {name: frozenset(numbers) for name, numbers in found.items()}


def _is_asked(row: Register) -> bool:
    return row.access is not Access.WRITE and not row.ends_when_read


def _rows_of_all() -> Iterable[Register]:
    for model in Model:
        if Protocol.MODBUS_RTU in model.protocols:
            yield from RegisterMap(Profile(model, type_codes=()))


def has(module: Subject, query: Query[Any]) -> Procedure[bool]:
    """Request something, and return whether the module has it; a refusal, an exception and silence say that not."""
    wire = module.wire(query)
    heard = (yield from module.send(wire, seconds=0.2)).wire
    decode: Any = modbus.decode_response if isinstance(query, modbus.Request) else dcon.decode_response
    try:
        response = decode(heard, query, module.profile)
    except DecodeError:
        if not heard:
            yield from module.alive(wire)
        return False
    return not isinstance(response, dcon.Refused | modbus.ExceptionResponse)
