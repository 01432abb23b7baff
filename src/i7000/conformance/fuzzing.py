"""Frames that nearly read, for a module to ignore or refuse; and the fewest of them after which it fails.

Laws: chance is an argument, a function that returns a number below another; the same numbers give the same frames. The
guard has the last word on what is sent: a near miss of a read can be a write.
"""

from collections.abc import Callable, Generator, Iterator, Sequence
from itertools import product
from typing import Any

from attrs import fields_dict

from i7000 import dcon, modbus
from i7000.conformance.hazard import DEFAULT_ALLOWED, hazard_of
from i7000.errors import EncodeError
from i7000.message import Query
from i7000.modbus import Access, RegisterMap, crc16
from i7000.modbus.register_map import READERS
from i7000.profile import Profile
from i7000.settings import Protocol

__all__ = ["Chance", "fewest", "near_miss", "reads", "sentinel"]

Chance = Callable[[int], int]
"""Returns a number from 0 to below the argument."""

_CHANNELS = (0, 1, 7, 9)
_LONGEST = 300
_ALPHABET = b"%#$~@!>?*0123456789ABCDEFabcdef+-.CEOPS \r\n\x00\x7f\xff"
_CRC = 2


def sentinel(protocol: Protocol, address: int) -> Query[Any]:
    """Return the read that every module answers, and whose answer shows the settings of the line."""
    if protocol is Protocol.DCON:
        return dcon.ReadConfiguration(address)
    return modbus.ReadCommunicationSettings(address)


def reads(profile: Profile, protocol: Protocol, address: int) -> tuple[bytes, ...]:
    """Return the frames that only read, of every command or request that a module has."""
    found = dict.fromkeys(_messages(profile, protocol, address))
    encode: Any = dcon.encode if protocol is Protocol.DCON else modbus.encode
    frames = []
    for message in found:
        try:
            frames.append(encode(message, profile))
        except EncodeError:  # the module does not have it, or not this channel
            continue
    return tuple(frames)


def _messages(profile: Profile, protocol: Protocol, address: int) -> Iterator[Query[Any]]:
    kinds: tuple[Any, ...] = dcon.COMMANDS if protocol is Protocol.DCON else modbus.REQUESTS
    for kind in kinds:
        names = fields_dict(kind).keys()
        if hazard_of(kind) in DEFAULT_ALLOWED and "start" not in names:
            first = 0x80 if kind is modbus.ReadCjcOffset else 0
            channels = [{"channel": first + channel} for channel in _CHANNELS] if "channel" in names else [{}]
            yield from (kind(address, **channel) for channel in channels)
    if protocol is Protocol.MODBUS_RTU:
        yield from (kind(address, 0, 1) for kind in READERS.values())
        for row in RegisterMap(profile):
            if row.access is not Access.WRITE:
                yield READERS[row.area](address, row.address, row.count)


def near_miss(frames: Sequence[bytes], protocol: Protocol, chance: Chance) -> bytes:
    """Return a frame with one to three mutations, half of them with the right CRC or a carriage return again."""
    wire = frames[chance(len(frames))]
    for _ in range(1 + chance(3)):
        wire = _MUTATIONS[chance(len(_MUTATIONS))](wire, frames, chance)
    if chance(2):
        body = wire.rstrip(b"\r")
        wire = body + b"\r" if protocol is Protocol.DCON else _sealed(wire[:-_CRC])
    return wire[:_LONGEST] or b"\r"


def _sealed(body: bytes) -> bytes:
    return body + crc16(body).to_bytes(_CRC, "little")


Mutation = Callable[[bytes, Sequence[bytes], Chance], bytes]


def _replaced(wire: bytes, _: Sequence[bytes], chance: Chance) -> bytes:
    at = chance(len(wire) + 1)
    return wire[:at] + _byte(chance) + wire[at + 1 :]


def _inserted(wire: bytes, _: Sequence[bytes], chance: Chance) -> bytes:
    at = chance(len(wire) + 1)
    return wire[:at] + _byte(chance) + wire[at:]


def _deleted(wire: bytes, _: Sequence[bytes], chance: Chance) -> bytes:
    at = chance(len(wire) + 1)
    return wire[:at] + wire[at + 1 :]


def _truncated(wire: bytes, _: Sequence[bytes], chance: Chance) -> bytes:
    return wire[: chance(len(wire) + 1)]


def _glued(wire: bytes, frames: Sequence[bytes], chance: Chance) -> bytes:
    return wire + frames[chance(len(frames))]


def _spliced(wire: bytes, frames: Sequence[bytes], chance: Chance) -> bytes:
    other = frames[chance(len(frames))]
    return wire[: chance(len(wire) + 1)] + other[chance(len(other)) :]


def _swapped(wire: bytes, _: Sequence[bytes], __: Chance) -> bytes:
    return wire.swapcase()


def _with_bit_7(wire: bytes, _: Sequence[bytes], chance: Chance) -> bytes:
    at = chance(len(wire) + 1)
    return wire[:at] + bytes([byte | 0x80 for byte in wire[at : at + 1]]) + wire[at + 1 :]


def _padded(wire: bytes, _: Sequence[bytes], chance: Chance) -> bytes:
    return wire[:-1] + _byte(chance) * chance(_LONGEST) + wire[-1:]


_MUTATIONS: tuple[Mutation, ...] = (
    _replaced, _inserted, _deleted, _truncated, _glued, _spliced, _swapped, _with_bit_7, _padded,
)  # fmt: skip


def _byte(chance: Chance) -> bytes:
    return bytes((_ALPHABET[chance(len(_ALPHABET))] if chance(4) else chance(0x100),))


def fewest(
    frames: tuple[bytes, ...], most_tries: int
) -> Generator[tuple[bytes, ...], bool, tuple[tuple[bytes, ...], int]]:
    """Make the search for the fewest frames after which a module fails; it yields frames to try.

    Shape: send whether the module fails after them. The result is the frames and the number of tries. Halves are left
        out first, then smaller parts, and at last single bytes from the end of the frames.
    Time: it ends after `most_tries`.
    """
    tries, size = 0, len(frames) // 2
    while size:
        start = 0
        while start < len(frames) and tries < most_tries:
            less = frames[:start] + frames[start + size :]
            tries += 1
            if less and (yield less):
                frames = less
            else:
                start += size
        size //= 2
    for place, parts in product(range(len(frames)), range(1, 4)):
        cut = len(frames[place]) // 2**parts
        while cut and len(frames[place]) > cut and tries < most_tries:
            less = (*frames[:place], frames[place][:-cut], *frames[place + 1 :])
            tries += 1
            if not (yield less):
                break
            frames = less
    return frames, tries
