"""Byte strings that are nearly commands and requests: real ones of every kind, and what mutations make of them."""

from collections.abc import Callable
from functools import cache
from random import Random
from typing import Any

from attrs import evolve

from i7000 import Model, Profile, dcon, modbus
from i7000.modbus import Access, Area, crc16
from i7000.modbus.registers import rows
from tests.vectors import dcon_vectors, message_of, modbus_vectors, profile_of

LEADS = b"%#$~@"
ALPHABET = b"%#$~@*!>?0123456789ABCDEFabcdef+-.CEIOPSTM \r\n\x00\xff"


@cache
def commands() -> tuple[bytes, ...]:
    """The DCON commands of all vectors, as bodies; every class is among them."""
    found = set()
    for vector in (it.values[0] for it in dcon_vectors("response", "refused", "silence")):
        profile = evolve(profile_of(vector["profile"]), checksum=False)
        found.add(dcon.encode(message_of(vector["command"]), profile, force=True)[:-1])
    return (*sorted(found), *(b"$014",) * 8)


@cache
def requests() -> tuple[bytes, ...]:
    """The Modbus requests of all vectors, and writes and reads of every row of every map, as bodies."""
    found: set[Any] = set()
    wires = {bytes.fromhex(it.values[0]["request_wire"]) for it in modbus_vectors("response")}
    for row in {row for model in Model for row in rows(Profile(model, type_codes=()))}:
        if row.access is not Access.WRITE:
            found.add(_READERS[row.area](0x01, row.address, min(row.count, 8)))
        if row.access is not Access.READ and row.area is Area.COIL:
            found.add(modbus.WriteSingleCoil(0x01, row.address, value=True))
            found.add(modbus.WriteMultipleCoils(0x01, row.address - 1, (True, True, True)))
        elif row.access is not Access.READ:
            found.add(modbus.WriteSingleRegister(0x01, row.address, 1))
            found.add(modbus.WriteMultipleRegisters(0x01, row.address, (0,) * row.count))
    bodies = {wire[:-2] for wire in wires | {modbus.encode(it) for it in found}}
    return (*sorted(bodies), *(modbus.encode(modbus.ReadCoils(0x01, 272, 1))[:-2],) * 8)


_READERS: dict[Area, Callable[..., Any]] = {
    Area.COIL: modbus.ReadCoils,
    Area.DISCRETE_INPUT: modbus.ReadDiscreteInputs,
    Area.INPUT_REGISTER: modbus.ReadInputRegisters,
    Area.HOLDING_REGISTER: modbus.ReadHoldingRegisters,
}


def command(chance: Random, address: int, *, checksum: bool) -> bytes:
    """A DCON command to an address."""
    body = chance.choice(commands())
    if body[1:3] != b"**":
        body = b"%c%02X%b" % (body[:1], address, body[3:])
    return dcon.seal(body, checksum=checksum)


def request(chance: Random, address: int) -> bytes:
    """A Modbus request to an address, or to all."""
    if not chance.randrange(6):
        address = 0
    return sealed(bytes((address,)) + chance.choice(requests())[1:])


def sealed(body: bytes) -> bytes:
    """A body with its CRC."""
    return body + crc16(body).to_bytes(2, "little")


def half_as_fast(chance: Random, frame: bytes) -> bytes:
    """What an end with half the baud rate, N81 both, receives as `frame`, whose bytes all have bit 3 set."""
    sent = bytearray()
    for byte in frame:
        assert byte & 8, "a stop bit of the sender is bit 3 of the receiver"
        noise = chance.randrange(0x100) & 0b10101010
        sent.append(noise | (byte & 1) << 2 | (byte >> 1 & 1) << 4 | (byte >> 2 & 1) << 6)
        noise = chance.randrange(0x100) & 0b10101010
        sent.append(noise | (byte >> 4 & 1) | (byte >> 5 & 1) << 2 | (byte >> 6 & 1) << 4 | (byte >> 7 & 1) << 6)
    return bytes(sent)


SLOW_ADDRESS = 0x88
SLOW_COMMANDS = (b"~**\r", b"~88I\r", b"~88OHI\r", b"~88O8\r", b"~88OXYZ\r")
"""Commands whose bytes all have bit 3 set."""


def near_miss(chance: Random, address: int, *, checksum: bool, dcon_spoken: bool) -> bytes:
    """A command or request, as it is in half of the cases, else mutated."""
    text = dcon_spoken if chance.random() < 0.9 else not dcon_spoken
    wire = command(chance, address, checksum=checksum) if text else request(chance, address)
    if chance.random() < 0.5:
        return wire
    for _ in range(chance.randint(1, 3)):
        wire = chance.choice(_MUTATIONS)(chance, wire)
    if not text and chance.random() < 0.5:
        wire = sealed(wire[:-2])
    if text and chance.random() < 0.3:
        wire = wire.rstrip(b"\r") + b"\r"
    return wire[:300]


def _swap_case(_: Random, wire: bytes) -> bytes:
    return wire.swapcase()


def _set_bit_7(chance: Random, wire: bytes) -> bytes:
    return bytes(byte | 0x80 * (chance.random() < 0.4) for byte in wire)


def _replace(chance: Random, wire: bytes) -> bytes:
    at = chance.randrange(len(wire) + 1)
    return wire[:at] + bytes((_byte(chance),)) + wire[at + 1 :]


def _insert(chance: Random, wire: bytes) -> bytes:
    at = chance.randrange(len(wire) + 1)
    return wire[:at] + bytes((_byte(chance),)) + wire[at:]


def _delete(chance: Random, wire: bytes) -> bytes:
    at = chance.randrange(len(wire) + 1)
    return wire[:at] + wire[at + 1 :]


def _truncate(chance: Random, wire: bytes) -> bytes:
    return wire[: chance.randrange(len(wire) + 1)]


def _behead(chance: Random, wire: bytes) -> bytes:
    return wire[chance.randrange(len(wire) + 1) :]


def _glue(chance: Random, wire: bytes) -> bytes:
    other = command(chance, _number(chance), checksum=False) if chance.random() < 0.5 else request(chance, 1)
    return wire + other if chance.random() < 0.5 else other + wire


def _splice(chance: Random, wire: bytes) -> bytes:
    other = command(chance, 0x01, checksum=True) if chance.random() < 0.5 else request(chance, 1)
    return wire[: chance.randrange(len(wire) + 1)] + other[chance.randrange(len(other)) :]


def _surround(chance: Random, wire: bytes) -> bytes:
    return chance.randbytes(chance.randrange(6)) + wire + chance.randbytes(chance.randrange(3))


def _carry(chance: Random, wire: bytes) -> bytes:
    """Put it into the data of a request."""
    head = bytes((_number(chance), chance.choice((3, 4, 0x10, 0x46)), 0, 1, 0, 1, len(wire) & 0xFF))
    return sealed(head + wire)


def _repeat(_: Random, wire: bytes) -> bytes:
    return wire * 2


def _byte(chance: Random) -> int:
    return chance.choice(ALPHABET) if chance.random() < 0.7 else chance.randrange(0x100)


def _number(chance: Random) -> int:
    return chance.choice((0x01, 0x24, 0x25, 0x7E, 0x46, 0xF0))


_MUTATIONS = (
    _swap_case, _set_bit_7, _replace, _insert, _delete, _truncate, _behead, _glue, _splice, _surround, _carry, _repeat,
)  # fmt: skip
