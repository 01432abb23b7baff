"""A wrapper of this codec for ``i7000 vectors``: it answers cases of vectors, JSON on standard input and output.

``i7000 vectors -- python -m i7000.examples.vector_runner`` runs all vectors. A wrapper in another language has the same
parts: `OPERATIONS`, which convert JSON to values and back, and `answered`, the loop around them. The protocol is in
``docs/port_the_codec.md``.
"""

if __name__ == "__main__":  # before the imports, which take longer than all else
    from i7000_cli import end_at_ctrl_c

    end_at_ctrl_c()

import json
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from enum import Enum
from functools import partial
from typing import IO, Any, get_args

from attrs import fields

from i7000 import (
    DataFormat,
    DecodeError,
    EncodeError,
    Firmware,
    LineSettings,
    ModbusDataFormat,
    Model,
    Noise,
    Profile,
    Reading,
    ReportSettings,
    Status,
    TypeCode,
    __version__,
    dcon,
    modbus,
)
from i7000.message import Message
from i7000.modbus.register_values import counts_of
from i7000.readings import decode_field, encode_field
from i7000_cli import program

__all__ = ["OPERATIONS", "answered", "main"]

Record = dict[str, Any]
Operation = Callable[[Record, Profile], Record]
"""What converts the input of a case to its result, for a profile."""
Kinds = Mapping[str, Any]
"""The messages of a protocol by their names."""

DCON: Kinds = {
    kind.__name__: kind
    for command in dcon.COMMANDS
    for kind in (command, getattr(command, "response", command), dcon.Refused)
}
MODBUS: Kinds = {
    kind.__name__: kind for request in modbus.REQUESTS for kind in (request, request.response, modbus.ExceptionResponse)
}

# --- values of JSON ---------------------------------------------------------------------------------------------------


def profile_of(record: Record | None) -> Profile | None:
    """Return the profile of a case."""
    if record is None:
        return None
    return Profile(
        Model.find(record["model"]),
        firmware=None if record["firmware"] is None else Firmware(record["firmware"]),
        single_ended=record["single_ended"],
        type_codes=tuple(map(TypeCode, record["type_codes"])),
        data_format=DataFormat[record["data_format"].upper()],
        checksum=record["checksum"],
        modbus_data_format=ModbusDataFormat[record.get("modbus_data_format", "hex").upper()],
    )


def message_of(record: Record, kinds: Kinds) -> Any:  # noqa: ANN401 - of any class
    """Return the message of ``{"type": ..., "fields": ...}``."""
    kind = kinds[record["type"]]
    return kind(**{it.name: _value(get_args(it.type)[0], record["fields"][it.name]) for it in fields(kind)})


def _value(kind: Any, value: Any) -> Any:  # noqa: ANN401 - a type, and what JSON has for it
    if kind is bytes:
        return bytes.fromhex(value)
    if kind == tuple[bool, ...]:
        return tuple(bit == "1" for bit in value)
    if value.__class__ is list:
        return tuple(value)
    if kind in (LineSettings, ReportSettings):
        return kind.from_byte(value)
    return kind(value) if isinstance(kind, type) and issubclass(kind, Enum | float) else value


def record_of(message: Message) -> Record:
    """Return the JSON of a message."""
    kind: Any = type(message)
    return {"type": kind.__name__, "fields": {it.name: _plain(getattr(message, it.name)) for it in fields(kind)}}


def _plain(value: Any) -> Any:  # noqa: ANN401 - of any field
    if isinstance(value, bytes):
        return value.hex()
    if isinstance(value, LineSettings | ReportSettings):
        return value.byte
    if value.__class__ is tuple and value[0].__class__ is bool:
        return "".join(f"{bit:d}" for bit in value)
    return value.value if isinstance(value, Enum) else value


def _reading_of(value: float | None, status: str, type_code: TypeCode) -> Reading:
    return Reading(None if value is None else float(value), type_code.unit, Status(status))


def _events(found: Iterable[bytes | Noise]) -> list[Record]:
    return [
        {"noise": it.wire.hex(), "fault": it.fault.value} if isinstance(it, Noise) else {"frame": it.hex()}
        for it in found
    ]


# --- operations -------------------------------------------------------------------------------------------------------


def _encode(protocol: Any, kinds: Kinds, key: str, given: Record, profile: Profile) -> Record:  # noqa: ANN401
    return {"wire": protocol.encode(message_of(given[key], kinds), profile).hex()}


def _decode(decode: Callable[[bytes, Profile], Message], key: str, given: Record, profile: Profile) -> Record:
    return {key: record_of(decode(bytes.fromhex(given["wire"]), profile))}


def _decode_response(protocol: Any, kinds: Kinds, key: str, given: Record, profile: Profile) -> Record:  # noqa: ANN401
    response = protocol.decode_response(bytes.fromhex(given["wire"]), message_of(given[key], kinds), profile)
    return {"response": record_of(response)}


def _is_answered(protocol: Any, kinds: Kinds, key: str, given: Record, _: Profile) -> Record:  # noqa: ANN401
    return {"answered": protocol.is_answered(message_of(given[key], kinds))}


def _type_of(given: Record) -> tuple[TypeCode, DataFormat]:
    return TypeCode(int(given["type_code"], 16)), DataFormat[given["format"].upper()]


def _read(given: Record, profile: Profile | None, *, lenient: bool) -> Record:
    legacy = profile is not None and profile.legacy_sentinels
    found = decode_field(given["text"], *_type_of(given), legacy=legacy, lenient=lenient)
    return {"value": found.value, "status": found.status.value}


def _write(given: Record, _: Profile | None) -> Record:
    type_code, data_format = _type_of(given)
    return {"text": encode_field(_reading_of(given["value"], given["status"], type_code), type_code, data_format)}


def _read_response(given: Record, profile: Profile) -> Record:
    command, response = message_of(given["command"], DCON), message_of(given["response"], DCON)
    if isinstance(command, dcon.ReadAnalogInput):
        found: tuple[Reading, ...] = (dcon.reading(response, command.channel, profile),)
    else:
        found = dcon.readings(response, profile)
    return {
        "values": [it.value for it in found],
        "units": [it.unit for it in found],
        "statuses": [it.status.value for it in found],
    }


def _split_line(given: Record, profile: Profile) -> Record:
    frame = dcon.seal(b">" + given["line"].encode(), checksum=profile.checksum)
    response = dcon.decode_response(frame, dcon.ReadAnalogInputs(0x01), profile)
    return {"values": list(response.values)} if isinstance(response, dcon.AnalogInputs) else {}


def _row_of(given: Record, profile: Profile) -> tuple[modbus.RegisterMap, modbus.Register]:
    registers = modbus.RegisterMap(profile)
    return registers, registers.find(given["name"])


def _read_items(given: Record, profile: Profile) -> Record:
    registers, row = _row_of(given, profile)
    width, first, items = row.kind.width, given["first"], given["items"]
    several = row.count > width
    channels = range(first, first + max(1, len(items) // width)) if several else None
    found: Any = registers.decode(row.name, items, channels=channels, big_endian=given["big_endian"])
    pairs = [pair for value in (found if several else (found,)) for pair in _pairs(value)]
    statuses = [status for _, status in pairs]
    numbers = [bool(number) if row.kind is modbus.Kind.BOOL else number for number, _ in pairs]
    return {"values": numbers, "statuses": None if None in statuses else statuses}


def _pairs(value: Any) -> Iterator[tuple[Any, str | None]]:  # noqa: ANN401 - of any row
    """Yield the numbers of a value, with their statuses if they are readings."""
    if isinstance(value, modbus.LogRecord):
        for reading in value.readings:
            yield from _pairs(reading)
        yield value.time, "ok"
    elif isinstance(value, Reading):
        yield value.value, value.status.value
    elif isinstance(value, Firmware):
        yield int.from_bytes(bytes(value), "big"), None
    elif isinstance(value, str):  # the series of a model, as its name has it
        yield int(f"00{value}00", 16), None
    else:
        yield _plain(value), None


def _write_values(given: Record, profile: Profile) -> Record:
    _, row = _row_of(given, profile)
    first, values = given["first"], given["values"]
    if given["statuses"] is not None:
        types = profile.type_codes[first : first + len(values)]
        readings = [_reading_of(*it) for it in zip(values, given["statuses"], types, strict=True)]
        return {"items": list(modbus.words(readings, profile, channel=first))}
    big_endian = given["big_endian"]
    return {"items": [item for it in values for item in counts_of(row, it, profile, big_endian=big_endian)]}


def _checksum(given: Record, _: Profile | None) -> Record:
    return {"checksum": f"{dcon.checksum(bytes.fromhex(given['body'])):02X}"}


def _crc(given: Record, _: Profile | None) -> Record:
    return {"crc": modbus.crc16(bytes.fromhex(given["body"])).to_bytes(2, "little").hex()}


def _split(given: Record, _: Profile | None) -> Record:
    found, rest = _in_pieces(partial(dcon.split, checksum=given["checksum"]), given["pieces"])
    return {"events": _events(found), "rest": rest.hex()}


def _rtu_split(given: Record, profile: Profile | None) -> Record:
    side = modbus.Side[given["side"].upper()]
    found, rest = _in_pieces(partial(modbus.split, side=side, profile=profile), given["pieces"])
    flushed = modbus.flush(rest, side, profile)
    return {"events": _events(found), "rest": rest.hex(), "flushed": _events(flushed)}


def _in_pieces(split: Callable[[bytes], tuple[Any, bytes]], pieces: list[str]) -> tuple[list[bytes | Noise], bytes]:
    found: list[bytes | Noise] = []
    rest = b""
    for piece in pieces:
        events, rest = split(rest + bytes.fromhex(piece))
        found.extend(events)
    return found, rest


def _exchange(name: str, protocol: Any, kinds: Kinds, key: str) -> dict[str, Any]:  # noqa: ANN401 - a module
    """Return the operations of a protocol; `key` is what a host sends in it."""
    return {
        f"{name}.encode_{key}": partial(_encode, protocol, kinds, key),
        f"{name}.decode_{key}": partial(_decode, getattr(protocol, f"decode_{key}"), key),
        f"{name}.encode_response": partial(_encode, protocol, kinds, "response"),
        f"{name}.decode_response": partial(_decode_response, protocol, kinds, key),
        f"{name}.is_answered": partial(_is_answered, protocol, kinds, key),
    }


OPERATIONS: dict[str, Any] = {
    **_exchange("dcon", dcon, DCON, "command"),
    **_exchange("modbus", modbus, MODBUS, "request"),
    "readings.read": partial(_read, lenient=False),
    "readings.read_leniently": partial(_read, lenient=True),
    "readings.write": _write,
    "readings.read_response": _read_response,
    "readings.split_line": _split_line,
    "registers.read_items": _read_items,
    "registers.write_values": _write_values,
    "frames.checksum": _checksum,
    "frames.crc": _crc,
    "frames.split": _split,
    "frames.rtu_split": _rtu_split,
}
"""The operations by their names."""

# --- the loop ---------------------------------------------------------------------------------------------------------


def answered(message: Record, operations: Mapping[str, Any] = OPERATIONS) -> Record | None:
    """Return the answer to a message, or None to ``stop``."""
    if message["cmd"] == "stop":
        return None
    if message["cmd"] == "start":
        about = {"name": "i7000", "version": __version__, "language": "Python"}
        answer: Record = {"protocol": 1, "implementation": about, "operations": list(operations)}
    else:
        answer = _run(message["case"], operations)
    return {"seq": message["seq"], **answer}


def _run(case: Record, operations: Mapping[str, Operation]) -> Record:
    try:
        return {"result": operations[case["operation"]](case["input"], profile_of(case["profile"]))}  # type: ignore[arg-type] # None where the operation needs none
    except DecodeError as error:
        return {"error": {"fault": error.fault.value, "message": str(error)}}
    except EncodeError as error:
        return {"error": {"fault": None, "message": str(error)}}
    except Exception as error:  # noqa: BLE001 - whatever it is, it is not an answer of the codec
        return {"crashed": repr(error)}


def main(operations: Mapping[str, Any] = OPERATIONS, source: IO[str] | None = None) -> int:
    """Answer messages from standard input until ``stop``, or until the input ends."""
    for line in source or sys.stdin:
        answer = answered(json.loads(line), operations)
        if answer is None:
            break
        sys.stdout.write(json.dumps(answer) + "\n")
        sys.stdout.flush()
    return 0


if __name__ == "__main__":
    raise SystemExit(program(main))
