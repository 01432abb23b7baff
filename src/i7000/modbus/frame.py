"""The frame around every Modbus RTU message: address, PDU, CRC-16 (manual 3).

Laws: `unseal` is the inverse of `seal`.
"""

import struct

from i7000.arguments import as_bytes
from i7000.errors import DecodeError, Fault

__all__ = ["LONGEST_FRAME", "SHORTEST_FRAME", "crc16", "seal", "unseal"]

LONGEST_FRAME = 256
SHORTEST_FRAME = 4
"""The length of address, function and CRC in bytes; the shortest response of a module, an exception, has one more."""

_POLYNOMIAL = 0xA001
_START = 0xFFFF


def _table_of_bytes() -> list[int]:
    table = []
    for byte in range(256):
        crc = byte
        for _ in range(8):
            crc = crc >> 1 ^ (_POLYNOMIAL if crc & 1 else 0)
        table.append(crc)
    return table


_ONE = _table_of_bytes()
"""The effect of one byte on the CRC."""
_TWO: list[int] = []
"""The effect of two bytes on the CRC; computed at the first use and assigned in one step, because threads may race."""


class WordStructs(dict[int, struct.Struct]):
    """Structs for a number of words in one byte order, ``<`` or ``>``; made at the first use."""

    def __init__(self, order: str) -> None:
        super().__init__()
        self._order = order

    def __missing__(self, count: int) -> struct.Struct:
        return self.setdefault(count, struct.Struct(f"{self._order}{count}H"))


_WORDS = WordStructs("<")
_PACK = struct.Struct("<H").pack


def crc16(data: bytes) -> int:
    """Compute the CRC-16 of Modbus; that of a whole frame, CRC included, is 0.

    >>> f"{crc16(bytes.fromhex('010400000008')):04X}"
    'CCF1'
    """
    return crc_of(data if data.__class__ is bytes else as_bytes("data", data))


def crc_of(data: bytes) -> int:
    """Compute the CRC-16, as `crc16` does, without checking the argument."""
    if not _TWO:
        pairs = [_ONE[low] ^ high for high in range(256) for low in range(256)]
        _TWO[:] = [crc >> 8 ^ _ONE[crc & 0xFF] for crc in pairs]
    two = _TWO
    crc = _START
    length = len(data)
    odd = length & 1
    if odd:
        crc = crc >> 8 ^ _ONE[(crc ^ data[0]) & 0xFF]
    for word in _WORDS[length >> 1].unpack_from(data, odd):
        crc = two[crc ^ word]
    return crc


def seal(body: bytes) -> bytes:
    """Make a frame from address and PDU: append the CRC, low byte first.

    >>> seal(bytes.fromhex("010400000008")).hex()
    '010400000008f1cc'
    """
    return sealed(body if body.__class__ is bytes else as_bytes("body", body))


def sealed(body: bytes) -> bytes:
    """Make a frame from address and PDU, as `seal` does, without checking the argument."""
    return body + _PACK(crc_of(body))


def unseal(frame: bytes) -> bytes:
    """Return address and PDU of exactly one frame; verify and remove the CRC.

    Errors: `DecodeError` with `Fault.LENGTH` or `CRC`.
    """
    if frame.__class__ is not bytes:
        frame = as_bytes("frame", frame)
    if not SHORTEST_FRAME <= len(frame) <= LONGEST_FRAME:
        allowed = f"{SHORTEST_FRAME} to {LONGEST_FRAME} bytes"
        raise DecodeError(Fault.LENGTH, frame, min(len(frame), LONGEST_FRAME), allowed=allowed, section="3")
    if crc_of(frame):
        crc = crc_of(frame[:-2]).to_bytes(2, "little").hex(" ").upper()
        raise DecodeError(Fault.CRC, frame, len(frame) - 2, field="crc", allowed=crc, section="3")
    return frame[:-2]
