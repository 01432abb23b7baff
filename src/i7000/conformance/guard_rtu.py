"""What bytes on the line can do to modules, by the worst reading of a lenient firmware (Modbus RTU, manual 3).

A lenient firmware ignores the CRC of a frame that begins with a write of the host, bit 7 of the function code, and how
many bytes a request should have. It may find a request with the right CRC anywhere on the line. It may also have the
other functions of the Modbus specification that change something: 08, 15, 16 and 17.

Laws: what a request can do is known from its function code and the addresses of its items, not from its values. A
request that changes something is dangerous before it is complete, as soon as its first address is known.
"""

import re
from collections.abc import Callable
from functools import cache

from i7000 import modbus
from i7000.conformance.hazard import Hazard, hazard_of, hazards_of_writes, items_that_end_when_read
from i7000.frozen import frozen
from i7000.modbus import BROADCAST, SHORTEST_FRAME, Area
from i7000.modbus.frame import crc_of
from i7000.modbus.request import MODULE_SETTINGS

__all__ = ["begins_nothing", "hazards_at", "hazards_of_modules", "hazards_with_crc", "is_frame"]

Hazards = frozenset[Hazard]

HARMLESS: Hazards = frozenset({Hazard.OBSERVE})
_CRC = 2
_LONGEST = 0x100 + 12
"""The length of the longest request: function 17 with 255 counted bytes."""
_MASK_BYTES = (1, 2, 3)
_ITEMS = 0x10000
_TEXT = bytes((*range(0x20, 0x7F), 0x0D))
_OF_READS = frozenset({Hazard.OBSERVE, Hazard.MEMORY})


@frozen
class Function:
    """How to read a request of one function, or sub-function: counted in bytes from its address on."""

    known: int
    """The length from which its hazards are known."""
    body: int
    """The length of the shortest complete request, without CRC."""
    hazards: Callable[[bytes], Hazards]
    count_at: int = 0
    """The place of the byte that counts what follows it; 0 if there is none."""
    more: tuple[int, ...] = (0,)
    """How many bytes the body can have after the shortest."""

    def lengths(self, frame: bytes) -> tuple[int, ...]:
        """Return the possible lengths of the complete request, CRC included."""
        if self.count_at:
            return (self.count_at + 1 + frame[self.count_at] + _CRC,) if len(frame) > self.count_at else ()
        return tuple([self.body + more + _CRC for more in self.more])


def _word(frame: bytes, at: int) -> int:
    return int.from_bytes(frame[at : at + 2], "big")


def _among(places: "frozenset[int] | tuple[int, ...]", start: int, count: int) -> bool:
    """Return whether a range of items, which may go beyond the last one and around, has one of some places."""
    return any((place - start) % _ITEMS < count for place in places)


def _reading(area: Area) -> Callable[[bytes], Hazards]:
    ending = frozenset(address for found, address in items_that_end_when_read() if found is area)

    def hazards(frame: bytes) -> Hazards:
        return frozenset({Hazard.MEMORY}) if _among(ending, _word(frame, 2), _word(frame, 4)) else HARMLESS

    return hazards


def _writing(area: Area, start_at: int, items_a_byte: float = 0) -> Callable[[bytes], Hazards]:
    """Return the hazards of writing items; with `items_a_byte`, the start is followed by a count and a byte count.

    Special: as many items are written as the count has, or as the bytes need that are counted: the larger number.
    """
    of_items = {address: hazard for (found, address), hazard in hazards_of_writes().items() if found is area}

    def hazards(frame: bytes) -> Hazards:
        start, count = _word(frame, start_at), 1
        if items_a_byte:
            counted = frame[start_at + 4] if len(frame) > start_at + 4 else 0
            count = max(1, _word(frame, start_at + 2), int((counted - 1) * items_a_byte) + 1)
        worse = [it for place, it in of_items.items() if (place - start) % _ITEMS < count]
        return frozenset(worse if len(worse) == count else (*worse, Hazard.WRITE))

    return hazards


def _always(hazard: Hazard) -> Callable[[bytes], Hazards]:
    return lambda _: frozenset({hazard})


def _diagnosing(frame: bytes) -> Hazards:
    """Return the hazards of function 08: only the echo, sub-function 0000, changes nothing."""
    return frozenset({Hazard.COMM}) if _word(frame, 2) else HARMLESS


@cache
def _functions() -> dict[int, Function]:
    """Return the functions by code, and the sub-functions of 46h by 4600h and their code."""
    coil, register = Area.COIL, Area.HOLDING_REGISTER
    functions = {
        0x05: Function(4, 6, _writing(coil, 2)),
        0x06: Function(4, 6, _writing(register, 2)),
        0x08: Function(4, 6, _diagnosing),
        0x0F: Function(4, 8, _writing(coil, 2, 8), 6),
        0x10: Function(4, 9, _writing(register, 2, 0.5), 6),
        0x15: Function(3, 10, _always(Hazard.WRITE), 2),
        0x16: Function(4, 8, _writing(register, 2)),
        0x17: Function(8, 13, _writing(register, 6, 0.5), 10),
    }
    for request in modbus.REQUESTS:
        fixed = request.layout.fixed
        if request.sub_function is not None:
            more = _MASK_BYTES if request.layout.tail else (0,)
            hazards = _always(hazard_of(request))
            functions[MODULE_SETTINGS << 8 | request.sub_function] = Function(3, fixed, hazards, more=more)
        elif request.area is not None and request.function not in functions:
            functions[request.function] = Function(fixed, fixed, _reading(request.area))
    return functions


def _function_of(frame: bytes) -> Function | None:
    """Return the function of a frame, which has at least two bytes."""
    code = frame[1] & 0x7F
    if code == MODULE_SETTINGS:
        return _functions().get(code << 8 | frame[2]) if len(frame) > 2 else None
    return _functions().get(code)


_CODES = re.compile(rb"[\x01-\x06\x08\x0F\x10\x15-\x17\x46\x81-\x86\x88\x8F\x90\x95-\x97\xC6]")
_OF_MODULES = re.compile(rb"[\x01\x05\x06\x0F\x10\x46]")
"""The function codes of the requests of modules that change something, or can be more than an observation."""


def begins_nothing(frame: bytes) -> bool:
    """Return whether no request begins like this."""
    return len(frame) > 1 and not _CODES.match(frame, 1)


def is_frame(frame: bytes) -> bool:
    """Return whether bytes have the right CRC, and no more bytes than a request can count."""
    return SHORTEST_FRAME <= len(frame) <= _LONGEST and not crc_of(frame)


def hazards_at(frame: bytes, *, whole_body: bool) -> Hazards:
    """Return the hazards of a request that begins here, whatever its CRC is.

    Shape: with `whole_body`, only a request that is complete apart from its CRC.
    Special: text is not read as function 46h, because ``$F0`` begins like it: that needs the right CRC.
    """
    function = _function_of(frame) if len(frame) > 1 else None
    if function is None or len(frame) < (function.body if whole_body else function.known):
        return HARMLESS
    if frame[1] & 0x7F == MODULE_SETTINGS and not frame.translate(None, _TEXT):
        return HARMLESS
    found = function.hazards(frame)
    broadcast = frame[0] == BROADCAST and not found <= _OF_READS
    return found | {Hazard.BROADCAST} if broadcast else found


def hazards_with_crc(heard: bytes, new: int) -> Hazards:
    """Return the hazards of all requests with the right CRC that end after the first `new` bytes, wherever they begin.

    Shape: requests have the length that their function defines; those that begin among the new bytes and go to the end
        have any length, because silence can end them.
    """
    found = HARMLESS
    for code in _CODES.finditer(heard, 1):
        start = code.start() - 1
        frame = heard[start : start + _LONGEST]
        function = _function_of(frame)
        if function is None or len(frame) < function.known:
            continue
        lengths = function.lengths(frame)
        if start >= new and start + _LONGEST >= len(heard):
            lengths += (len(frame),)
        found |= _hazards_of_frame(frame, function, [length for length in lengths if length > new - start])
    return found


def hazards_of_modules(heard: bytes, new: int) -> Hazards:
    """Return the hazards of the requests that a module would carry out, ending after the first `new` bytes."""
    found = HARMLESS
    for code in _OF_MODULES.finditer(heard, 1):
        start = code.start() - 1
        if start + _LONGEST_SHORT <= new and heard[start + 1] not in _LONG:
            continue
        frame = heard[start : start + _LONGEST]
        function = _function_of(frame)
        if function is not None:
            lengths = function.lengths(frame)
            found |= _hazards_of_frame(frame, function, [length for length in lengths if length > new - start])
    return found


_LONG = (0x0F, 0x10)
_LONGEST_SHORT = 13
"""The length of the longest request of other functions than `_LONG`: to set the communication settings."""


def _hazards_of_frame(frame: bytes, function: Function, lengths: list[int]) -> Hazards:
    """Return the hazards of a request with the right CRC and one of some lengths."""
    for length in lengths:
        if function.known + _CRC <= length <= len(frame) and is_frame(frame[:length]):
            found = function.hazards(frame)
            return found | {Hazard.BROADCAST} if frame[0] == BROADCAST else found
    return HARMLESS
