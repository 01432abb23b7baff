"""The bytes of a capture file of a serial line (pcapng), as Wireshark reads it.

DCON is an interface with link type 148 (USER1), Modbus RTU one with link type 147 (USER0); the dissector in the folder
``wireshark`` takes both. Directions are in the packet flags: outbound is what hosts send.
`i7000.dissect.capture` reads such files.
"""

import struct

from i7000.settings import Protocol

__all__ = ["LINK_TYPES", "header", "packet"]

LINK_TYPES = {Protocol.MODBUS_RTU: 147, Protocol.DCON: 148}
_INTERFACES = {protocol: number for number, protocol in enumerate(LINK_TYPES)}
_NAMES = {Protocol.MODBUS_RTU: "Modbus RTU", Protocol.DCON: "DCON"}
_SECTION, _INTERFACE, _ENHANCED_PACKET = 0x0A0D0D0A, 1, 6
_ANY_LENGTH = 0xFFFF_FFFF_FFFF_FFFF
_COMMENT, _NAME, _APPLICATION, _FLAGS = 1, 2, 4, 2
"""Options; the name is of an interface, the application of a section, the flags are of a packet."""
_INBOUND, _OUTBOUND = 1, 2
_MICROSECONDS = 1_000_000


def header(application: str) -> bytes:
    """Return the beginning of a file: a section, and an interface for each protocol."""
    section = struct.pack("<IHHQ", 0x1A2B3C4D, 1, 0, _ANY_LENGTH)
    blocks = [_block(_SECTION, section + _options((_APPLICATION, application.encode())))]
    for protocol, link_type in LINK_TYPES.items():
        name = _options((_NAME, _NAMES[protocol].encode()))
        blocks.append(_block(_INTERFACE, struct.pack("<HHI", link_type, 0, 0) + name))
    return b"".join(blocks)


def packet(time: float, wire: bytes, protocol: Protocol, *, sent: bool | None, notes: tuple[str, ...] = ()) -> bytes:
    """Return a packet.

    Shape: `time` in seconds since 1970; `sent`: whether a host sent it, None if that is unknown; `notes` become
        comments.
    """
    high, low = divmod(round(time * _MICROSECONDS), 1 << 32)
    head = struct.pack("<IIIII", _INTERFACES[protocol], high, low, len(wire), len(wire))
    flags = () if sent is None else ((_FLAGS, struct.pack("<I", _OUTBOUND if sent else _INBOUND)),)
    comments = ((_COMMENT, note.encode()) for note in notes)
    return _block(_ENHANCED_PACKET, head + _padded(wire) + _options(*flags, *comments))


def _padded(data: bytes) -> bytes:
    return data + bytes(-len(data) % 4)


def _options(*options: tuple[int, bytes]) -> bytes:
    if not options:
        return b""
    return b"".join(struct.pack("<HH", code, len(data)) + _padded(data) for code, data in options) + bytes(4)


def _block(kind: int, body: bytes) -> bytes:
    length = struct.pack("<I", len(body) + 12)
    return struct.pack("<I", kind) + length + body + length
