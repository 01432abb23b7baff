"""Messages at random, the same in every run: what the package is held against others with."""

from collections.abc import Iterator
from enum import Enum
from random import Random
from typing import Any

from attrs import fields, frozen

from i7000 import LineSettings, Model, Profile
from i7000.errors import EncodeError
from i7000.modbus import (
    REQUESTS,
    ReadCoils,
    ReadDiscreteInputs,
    ReadHoldingRegisters,
    ReadInputRegisters,
    Request,
    WriteMultipleCoils,
    WriteMultipleRegisters,
    WriteSingleCoil,
    WriteSingleRegister,
)

PROFILE = Profile(Model.M_7017)
"""Of 8 channels: a mask has one byte."""
STANDARD = tuple(kind for kind in REQUESTS if kind.sub_function is None)


@frozen
class Exchange:
    """A request and a response that a module may give."""

    request: Request[Any]
    response: Any


def exchanges(kind: type[Request[Any]], count: int, *, seed: int = 7000) -> Iterator[Exchange]:
    """Make exchanges of one kind: any address but 0, any number of items, any values."""
    random = Random(f"{kind.__name__} {seed}")
    for _ in range(count):
        request = _message(kind, random, address=random.randint(1, 247))
        yield Exchange(request, _response(request, random))


def _response(request: Any, random: Random) -> Any:
    kind: Any = request.response
    match request:
        case ReadCoils() | ReadDiscreteInputs():
            return kind(request.address, _bits(random, request.count))
        case ReadHoldingRegisters() | ReadInputRegisters():
            return kind(request.address, _words(random, request.count))
        case WriteSingleCoil():
            return kind(request.address, request.coil, request.value)
        case WriteSingleRegister():
            return kind(request.address, request.register, request.value)
        case WriteMultipleCoils() | WriteMultipleRegisters():
            return kind(request.address, request.start, len(request.values))
    return _message(kind, random, address=request.address)


def _message(kind: Any, random: Random, *, address: int) -> Any:
    while True:
        values = {field.name: _value(field.name, field.type, random) for field in fields(kind)}
        try:
            return kind(**values | {"address": address})
        except EncodeError:  # beyond address 65535
            continue


def _value(name: str, annotation: Any, random: Random) -> Any:
    kind, item = annotation.__origin__, annotation.__metadata__[0]
    if name == "mask":
        return random.getrandbits(PROFILE.channels)
    if name == "values":
        most = random.choice((1, 8, 9, 123))
        return _bits(random, most) if kind == tuple[bool, ...] else _words(random, most)
    kinds = {LineSettings: LineSettings.from_byte(random.getrandbits(8)), bytes: random.randbytes(4)}
    if kind in kinds:
        return kinds[kind]
    if kind is bool or (isinstance(kind, type) and issubclass(kind, Enum)):
        return random.choice((False, True) if kind is bool else list(kind))
    return random.randint(*(item.bounds or (0, 0xFF)))


def _bits(random: Random, count: int) -> tuple[bool, ...]:
    return tuple(random.random() < 0.5 for _ in range(count))


def _words(random: Random, count: int) -> tuple[int, ...]:
    return tuple(random.getrandbits(16) for _ in range(count))
