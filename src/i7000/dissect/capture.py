"""Capture files -> what was on a serial line: pcap and pcapng, as Wireshark and its tools write them.

Link types: 147 and 148 (USER0 and USER1), whose packets are only the bytes of the line, and 250 (RTAC_SERIAL), which
puts a header before them. Directions come from the packet flags of pcapng, or from that header.

Laws: whatever bytes are given, nothing is raised; what cannot be read is a `Damage`. No more than one block is kept.
"""

import struct
from collections.abc import Iterable, Iterator
from typing import NamedTuple

__all__ = ["LINK_TYPES", "LONGEST_BLOCK", "Damage", "Packet", "is_capture", "packets"]

LONGEST_BLOCK = 1 << 20
"""The longest packet or block in bytes; reading stops at a longer one."""
_RTAC_SERIAL = 250
LINK_TYPES = (147, 148, _RTAC_SERIAL)


class Packet(NamedTuple):
    """Bytes that were on the line at one time."""

    number: int
    """The number of the packet in the file, as Wireshark counts."""
    time: float | None
    """Seconds since 1970; None if the file does not say."""
    outbound: bool | None
    """Whether the capturing computer sent it; None if the file does not say."""
    wire: bytes
    missing: int = 0
    """How many bytes the snap length cut off."""
    note: str = ""
    """Events of the interface other than bytes, such as a parity error."""


class Damage(NamedTuple):
    """Something in the file that cannot be read."""

    offset: int
    """The position in the file, in bytes, where the damage was noticed."""
    reason: str


class _DamagedFileError(Exception):
    """Damage after which nothing can be read."""


_SECTION = 0x0A0D0D0A
_SECTION_MARK = _SECTION.to_bytes(4, "big")
_BYTE_ORDERS = {b"\x1a\x2b\x3c\x4d": ">", b"\x4d\x3c\x2b\x1a": "<"}
_PCAP_MARKS = {
    b"\xa1\xb2\xc3\xd4": (">", 10**6), b"\xd4\xc3\xb2\xa1": ("<", 10**6),
    b"\xa1\xb2\x3c\x4d": (">", 10**9), b"\x4d\x3c\xb2\xa1": ("<", 10**9),
}  # fmt: skip
"""Byte order, and fractions of a second."""


def is_capture(beginning: bytes) -> bool:
    """Return whether a file that begins with these bytes, four at least, is a capture file."""
    return beginning[:4] == _SECTION_MARK or beginning[:4] in _PCAP_MARKS


def packets(chunks: Iterable[bytes]) -> Iterator[Packet | Damage]:
    """Read a capture file, given in pieces of any length.

    Special: packets of other link types are passed over, each kind with one `Damage`. A `Damage` of the file itself is
        the last that is yielded.

    >>> list(packets([b"GIF89a"]))
    [Damage(offset=4, reason='not a capture file: it begins with 47 49 46 38')]
    """
    file = _File(chunks)
    try:
        yield from _packets(file)
    except _DamagedFileError as error:
        yield Damage(file.offset, str(error))


def _packets(file: "_File") -> Iterator[Packet | Damage]:
    mark = file.read(4)
    if mark == _SECTION_MARK:
        return _pcapng(file)
    if mark in _PCAP_MARKS:
        return _pcap(file, *_PCAP_MARKS[mark])
    raise _DamagedFileError(f"not a capture file: it begins with {mark.hex(' ') or 'nothing'}")


class _File:
    """The bytes of a file, read one after the other."""

    def __init__(self, chunks: Iterable[bytes]) -> None:
        self._chunks = iter(chunks)
        self._kept = b""
        self._at = 0
        self.offset = 0

    def read(self, count: int) -> bytes:
        """Return so many bytes; fewer at the end of the file only."""
        if count > LONGEST_BLOCK:
            raise _DamagedFileError(f"a block of {count} bytes; allowed: {LONGEST_BLOCK}")
        pieces = [self._take(count)]
        missing = count - len(pieces[0])
        while missing and (chunk := next(self._chunks, None)) is not None:
            self._kept, self._at = chunk, 0
            pieces.append(self._take(missing))
            missing -= len(pieces[-1])
        self.offset += count - missing
        return b"".join(pieces)

    def _take(self, count: int) -> bytes:
        taken = self._kept[self._at : self._at + count]
        self._at += len(taken)
        return taken

    def read_whole(self, count: int, what: str) -> bytes:
        """Return so many bytes, or raise `_DamagedFileError`."""
        data = self.read(count)
        if len(data) < count:
            raise _DamagedFileError(f"the file ends in {what}: {len(data)} of {count} bytes")
        return data


def _pcap(file: _File, order: str, fractions: int) -> Iterator[Packet | Damage]:
    header = struct.unpack(f"{order}HHiIII", file.read_whole(20, "its header"))
    link_type = header[-1] & 0x0FFFFFFF  # above it stands the length of a frame check sequence
    if link_type not in LINK_TYPES:
        raise _DamagedFileError(_other_link_type(link_type))
    record = struct.Struct(f"{order}IIII")
    number = 0
    while head := file.read(record.size):
        number += 1
        if len(head) < record.size:
            raise _DamagedFileError(f"the file ends in the header of packet {number}")
        seconds, fraction, length, original = record.unpack(head)
        data = file.read_whole(length, f"packet {number}")
        found = Packet(number, seconds + fraction / fractions, None, data, max(0, original - length))
        yield from _of_line(found, link_type, file.offset)


class _Interface(NamedTuple):
    """The description of one interface in pcapng."""

    link_type: int
    snap_length: int
    ticks: int
    """Time units in a second."""
    offset: int
    """Seconds to be added to every time."""


_MOST_INTERFACES = 256
_INTERFACE, _SIMPLE_PACKET, _ENHANCED_PACKET = 1, 3, 6
_FLAGS, _TICKS, _TIME_OFFSET = 2, 9, 14
"""Options: of a packet, of an interface and of an interface."""


def _pcapng(file: _File) -> Iterator[Packet | Damage]:
    kind = _SECTION
    order = "<"
    interfaces: list[_Interface] = []
    number = 0
    while True:
        length_bytes = file.read_whole(4, "the head of a block")
        if kind == _SECTION:
            mark = file.read_whole(4, "the head of a section")
            if mark not in _BYTE_ORDERS:
                raise _DamagedFileError(f"a section without byte order: {mark.hex(' ')}")
            order = _BYTE_ORDERS[mark]
            interfaces = []
        body = _body(file, order, length_bytes, already=12 if kind == _SECTION else 8)
        if kind == _INTERFACE:
            if len(interfaces) == _MOST_INTERFACES:
                raise _DamagedFileError(f"more than {_MOST_INTERFACES} interfaces")
            interfaces.append(_interface(body, order))
            if interfaces[-1].link_type not in LINK_TYPES:
                yield Damage(file.offset, _other_link_type(interfaces[-1].link_type))
        elif kind in (_SIMPLE_PACKET, _ENHANCED_PACKET):
            number += 1
            read = _simple if kind == _SIMPLE_PACKET else _enhanced
            found, link_type = read(body, order, interfaces, number)
            yield from _of_line(found, link_type, file.offset)
        head = file.read(4)
        if not head:
            return
        if len(head) < len(length_bytes):
            raise _DamagedFileError("the file ends in the head of a block")
        (kind,) = struct.unpack(f"{order}I", head)


def _body(file: _File, order: str, length_bytes: bytes, *, already: int) -> bytes:
    """Read the rest of a block, without the length that ends it."""
    (length,) = struct.unpack(f"{order}I", length_bytes)
    if length % 4 or length < already + 4:
        raise _DamagedFileError(f"a block cannot have {length} bytes")
    body = file.read_whole(length - already, "a block")
    if body[-4:] != length_bytes:
        raise _DamagedFileError("a block does not end with the length that it begins with")
    return body[:-4]


def _interface(body: bytes, order: str) -> _Interface:
    link_type, _, snap_length = _unpack(f"{order}HHI", body, "interface")
    options = _options(body[8:], order)
    ticks = 10**6
    resolution = options.get(_TICKS, b"")[:1]
    if resolution:
        exponent = resolution[0] & 0x7F
        ticks = (2 if resolution[0] & 0x80 else 10) ** exponent
    (offset,) = struct.unpack(f"{order}q", options.get(_TIME_OFFSET, b"")[:8].ljust(8, b"\0"))
    return _Interface(link_type, snap_length, ticks, offset)


def _simple(body: bytes, order: str, interfaces: list[_Interface], number: int) -> tuple[Packet, int]:
    (original,) = _unpack(f"{order}I", body, f"packet {number}")
    interface = _of(interfaces, 0, number)
    length = min(original, interface.snap_length or original, len(body) - 4)
    return Packet(number, None, None, body[4 : 4 + length], original - length), interface.link_type


def _enhanced(body: bytes, order: str, interfaces: list[_Interface], number: int) -> tuple[Packet, int]:
    at, high, low, length, original = _unpack(f"{order}IIIII", body, f"packet {number}")
    interface = _of(interfaces, at, number)
    if length > len(body) - 20:
        raise _DamagedFileError(f"packet {number} has {length} bytes in a block of {len(body)}")
    options = _options(body[20 + length + -length % 4 :], order)
    flags = options.get(_FLAGS, b"")[:4]
    way = struct.unpack(f"{order}I", flags.ljust(4, b"\0"))[0] & 0b11
    time = interface.offset + (high << 32 | low) / interface.ticks
    outbound = {1: False, 2: True}.get(way)
    return Packet(number, time, outbound, body[20 : 20 + length], max(0, original - length)), interface.link_type


def _of(interfaces: list[_Interface], at: int, number: int) -> _Interface:
    if at >= len(interfaces):
        raise _DamagedFileError(f"packet {number} is of interface {at}, which the file does not describe")
    return interfaces[at]


def _unpack(form: str, body: bytes, what: str) -> tuple[int, ...]:
    """Read the first fields of a block."""
    if len(body) < struct.calcsize(form):
        raise _DamagedFileError(f"the block of {what} is too short: {len(body)} bytes")
    return struct.unpack_from(form, body)


def _options(data: bytes, order: str) -> dict[int, bytes]:
    """Read the options at the end of a block; the first of each kind counts."""
    found: dict[int, bytes] = {}
    at = 0
    while at + 4 <= len(data):
        code, length = struct.unpack_from(f"{order}HH", data, at)
        if not code:
            break
        found.setdefault(code, data[at + 4 : at + 4 + length])
        at += 4 + length + -length % 4
    return found


def _other_link_type(link_type: int) -> str:
    return f"link type {link_type} is not that of a serial line; allowed: {', '.join(map(str, LINK_TYPES))}"


# --- the header of RTAC_SERIAL ----------------------------------------------------------------------------------------

_RTAC_HEADER = 12
"""Bytes: seconds, microseconds, the event, control lines and a footer of two."""
_RTAC_EVENT = 8
_RTAC_SENT = {1: True, 2: False, 3: True, 4: False}
_RTAC_NOTES = {5: "data lost", 7: "framing error", 8: "parity error", 9: "break", 10: "overflow"}


def _of_line(found: Packet, link_type: int, offset: int) -> Iterator[Packet | Damage]:
    """Yield the bytes and damage of a packet, if it has any."""
    if link_type == _RTAC_SERIAL:
        if len(found.wire) < _RTAC_HEADER:
            yield Damage(offset, f"packet {found.number} is too short for an RTAC header: {len(found.wire)} bytes")
            return
        event = found.wire[_RTAC_EVENT]
        sent = _RTAC_SENT.get(event, found.outbound)
        found = found._replace(wire=found.wire[_RTAC_HEADER:], outbound=sent, note=_RTAC_NOTES.get(event, ""))
    if link_type in LINK_TYPES and (found.wire or found.note or found.missing):
        yield found
