"""The data of ``spec/`` as values of the package: what the tests that hold one against the other share."""

from enum import Enum
from typing import Any

from attrs import fields

from i7000 import (
    DataFormat,
    Firmware,
    LineSettings,
    ModbusDataFormat,
    Model,
    Profile,
    ReportSettings,
    TypeCode,
    dcon,
    modbus,
)
from i7000.dcon.codec import COMMANDS
from tests.spec.lint import Record, vectors

MESSAGES: dict[str, Any] = {command.__name__: command for command in COMMANDS}
MESSAGES |= {command.response.__name__: command.response for command in COMMANDS if issubclass(command, dcon.Command)}
MESSAGES["Refused"] = dcon.Refused
MODBUS_MESSAGES: dict[str, Any] = {request.__name__: request for request in modbus.REQUESTS}
MODBUS_MESSAGES |= {request.response.__name__: request.response for request in modbus.REQUESTS}
MODBUS_MESSAGES["ExceptionResponse"] = modbus.ExceptionResponse


def dcon_vectors(*outcomes: str) -> list[Any]:
    """The vectors of DCON exchanges with one of `outcomes`, as pytest parameters with their ids."""
    return parameters("vectors/dcon", lambda vector: vector["outcome"] in outcomes)


def modbus_vectors(*outcomes: str) -> list[Any]:
    """The same of Modbus exchanges."""
    return parameters("vectors/modbus", lambda vector: vector["outcome"] in outcomes)


def written_modbus_vectors(*outcomes: str) -> list[Any]:
    """Those whose messages are written as they are read."""
    return [case for case in modbus_vectors(*outcomes) if "decode-only" not in case.values[0]["flags"]]


def parameters(folder: str, choose: Any = lambda _: True) -> list[Any]:
    """The chosen vectors of a folder or file, as pytest parameters with their ids."""
    import pytest  # noqa: PLC0415

    found = [vector for _, vector in vectors(folder.removeprefix("vectors/")) if choose(vector)]
    assert found
    return [pytest.param(vector, id=vector["id"]) for vector in found]


def profile_of(record: Record) -> Profile:
    """The profile that a vector names."""
    return Profile(
        Model.find(record["model"]),
        firmware=None if record["firmware"] is None else Firmware(record["firmware"]),
        single_ended=record["single_ended"],
        type_codes=tuple(TypeCode(code) for code in record["type_codes"]),
        data_format=DataFormat[record["data_format"].upper()],
        checksum=record["checksum"],
        modbus_data_format=ModbusDataFormat[record.get("modbus_data_format", "hex").upper()],
    )


def message_of(record: Record, messages: dict[str, Any] = MESSAGES) -> Any:
    """The message that a vector names."""
    values = dict(record["fields"])
    kinds = {"line_settings": LineSettings.from_byte, "report_settings": ReportSettings.from_byte}
    kind = messages[record["type"]]
    for field in fields(kind):
        value = values[field.name]
        if field.name in kinds:
            values[field.name] = kinds[field.name](value)
        elif field.type.__origin__ == tuple[bool, ...]:
            values[field.name] = tuple(bit == "1" for bit in value)
        elif isinstance(value, list):
            values[field.name] = tuple(value)
        elif field.name == "temperature":
            values[field.name] = float(value)
        elif field.type.__origin__ is bytes:
            values[field.name] = bytes.fromhex(value)
        else:
            enum = field.type.__origin__
            if isinstance(enum, type) and issubclass(enum, Enum):
                values[field.name] = enum(value)
    return kind(**values)


def modbus_message_of(record: Record) -> Any:
    """The Modbus message that a vector names."""
    return message_of(record, MODBUS_MESSAGES)


AVAILABILITY = {kind.section: kind.availability for kinds in (dcon.COMMANDS, modbus.REQUESTS) for kind in kinds}
"""Who has the commands and requests of a section."""
