"""Frames in received bytes: requests, responses, or both as on a tapped bus (manual 3).

Laws: `split` never raises and never loses a byte. It finds every valid frame amid any noise. Any chunking gives the
same frames and the same noise bytes between them. The rest is shorter than a frame. A frame has the length that its
function defines and a valid CRC. If several lengths are possible, the longest with a valid CRC is taken: a 00 after
a frame leaves the CRC valid, so a shorter frame would hide a longer one. With a profile and an open request only
one length is possible.
"""

from enum import StrEnum
from functools import cache
from typing import Any, NamedTuple

from i7000.arguments import as_bytes, check_type
from i7000.errors import DecodeError, Fault, Noise
from i7000.modbus.codec import REQUESTS
from i7000.modbus.frame import LONGEST_FRAME, SHORTEST_FRAME, crc_of
from i7000.modbus.layout import Layout
from i7000.modbus.request import BROADCAST, EXCEPTION_BIT, LAST_ADDRESS, MODULE_SETTINGS, Request
from i7000.profile import Profile

__all__ = ["Side", "drop_echo", "flush", "split"]

_CRC = 2
_EXCEPTION_LENGTH = 5
_MASK_BYTES = (1, 2, 3)
_MODULES = range(1, LAST_ADDRESS + 1)


class Side(StrEnum):
    """The sides whose frames are on the line."""

    REQUESTS = "requests"
    RESPONSES = "responses"
    BOTH = "both"

    __hash__ = str.__hash__  # That of an Enum takes as long as a byte that comes in.


class Rule(NamedTuple):
    """The rule for the length of a frame."""

    length: int
    """The length in bytes, without the counted bytes."""
    count_at: int = 0
    """The position of the byte that counts them; 0 if no bytes are counted."""
    step: int = 1
    """The step: the number of counted bytes is a multiple of it."""
    broadcast: bool = False
    """Whether the frame can be a broadcast."""


def _rules_of(layout: Layout, mask_bytes: tuple[int, ...], *, broadcast: bool) -> tuple[Rule, ...]:
    length = layout.fixed + _CRC
    if layout.tail == "mask":
        return tuple(Rule(length + extra, broadcast=broadcast) for extra in mask_bytes)
    if layout.tail:
        return (Rule(length, layout.fixed - 1, 2 if layout.tail == "words" else 1, broadcast),)
    return (Rule(length, broadcast=broadcast),)


Rules = dict[tuple[int, int | None], tuple[Rule, ...]]
"""The rules by function and sub-function."""


@cache
def _rules(side: Side, mask_bytes: tuple[int, ...]) -> Rules:
    """Return the rules of a side."""
    rules: Rules = {}
    for request in REQUESTS:
        key = (request.function, request.sub_function)
        found: tuple[Rule, ...] = ()
        if side is not Side.RESPONSES:
            found += _rules_of(request.layout, mask_bytes, broadcast=request.broadcast)
        if side is not Side.REQUESTS:
            found += _rules_of(request.response.layout, mask_bytes, broadcast=False)
            rules[request.function | EXCEPTION_BIT, None] = (Rule(_EXCEPTION_LENGTH),)
        rules[key] = tuple(dict.fromkeys(found))
    return rules


def _rules_of_answer(request: Request[Any], mask_bytes: tuple[int, ...]) -> Rules:
    """Return the rules of the responses to a request."""
    count = getattr(request, "count", None)
    rules = _rules_of(request.response.layout, mask_bytes, broadcast=False)
    if count is not None and rules[0].count_at:
        rules = (Rule(rules[0].length + (2 * count if rules[0].step > 1 else count + 7 >> 3)),)
    return {
        (request.function, request.sub_function): rules,
        (request.function | EXCEPTION_BIT, None): (Rule(_EXCEPTION_LENGTH),),
    }


_MISSING = 256
"""Stands for a byte that is not there yet."""
Starts = list[list[tuple[int, ...] | None]]
"""The lengths of a frame to one module, by function and third byte; None if more bytes are needed."""


def _starts(side: Side) -> Starts:
    """Return `_lengths` for every start; starts that depend on the profile are None."""
    rules, others = _rules(side, _MASK_BYTES), _rules(side, _MASK_BYTES[:1])
    no_frame: list[tuple[int, ...] | None] = [()] * (_MISSING + 1)
    table = [no_frame] * 256 + [[_MORE_IS_NEEDED] * (_MISSING + 1)]
    for function in {function for function, _ in rules}:
        row: list[tuple[int, ...] | None] = []
        for third in range(256):
            start = bytes((1, function, third))
            lengths, _ = _lengths(start, 0, rules, _MODULES)
            known = lengths != _MORE_IS_NEEDED and lengths == _lengths(start, 0, others, _MODULES)[0]
            row.append(lengths if known else None)
        table[function] = [*row, _lengths(bytes((1, function)), 0, rules, _MODULES)[0]]
    return table


class _Sides(dict[Side, Starts]):
    """The starts of each side; computed at the first use."""

    def __missing__(self, side: Side) -> Starts:
        return self.setdefault(side, _starts(side))


_BY_START = _Sides()


def split(
    buffer: bytes, side: Side = Side.BOTH, profile: Profile | None = None, *, request: Request[Any] | None = None
) -> tuple[tuple[bytes | Noise, ...], bytes]:
    """Split received bytes into complete frames, noise, and the rest that may still become a frame.

    Shape: the rest is shorter than `LONGEST_FRAME`; call again with the rest followed by the next bytes. Any chunking
        gives the same frames and the same noise bytes between them.
    Special: with a profile, channel masks have the length of its model. With an open `request`, only its possible
        responses are frames. An incomplete frame, or one that could be longer, delays what follows it: when the line
        has been silent for 3.5 characters, `flush` the rest.
    Manual: 3; E61.
    """
    if buffer.__class__ is not bytes:
        buffer = as_bytes("buffer", buffer)
    if side.__class__ is not Side:
        check_type("side", side, Side)
    if profile is not None and profile.__class__ is not Profile:
        check_type("profile", profile, Profile)
    size = len(buffer)
    if request is None and size and 0 < buffer[0] <= LAST_ADDRESS:
        function = buffer[1] if size > 1 else _MISSING
        lengths = _BY_START[side][function][buffer[2] if size > 2 else _MISSING]
        if lengths and size < lengths[0]:  # It is still coming in, as in most calls where bytes come one by one.
            return (), buffer
        if lengths and size == lengths[0] and not crc_of(buffer):  # It is one frame, as most of a log are.
            return (buffer,), b""
    if request is not None:
        check_type("request", request, Request)
    return _scan(buffer, side, profile, request, final=False)


def flush(
    rest: bytes, side: Side = Side.BOTH, profile: Profile | None = None, *, request: Request[Any] | None = None
) -> tuple[bytes | Noise, ...]:
    """Split a rest after which no byte came: an incomplete frame is noise.

    Special: because silence marks its end, the whole rest can also be a frame of an unknown function: a module answers
        it with an exception.
    """
    check_type("side", side, Side)
    check_type("profile", profile, Profile, optional=True)
    check_type("request", request, Request, optional=True)
    return _scan(as_bytes("rest", rest), side, profile, request, final=True)[0]


def drop_echo(received: bytes, sent: bytes) -> bytes | None:
    """Remove the local echo of sent bytes that 2-wire adapters give; return None while the echo is incomplete.

    Errors: `DecodeError` with `Fault.ECHO` if other bytes were received.
    """
    received, sent = as_bytes("received", received), as_bytes("sent", sent)
    for at, (byte, expected) in enumerate(zip(received, sent, strict=False)):
        if byte != expected:
            raise DecodeError(Fault.ECHO, received, at, allowed=sent.hex(" "), section="3")
    return received[len(sent) :] if len(received) >= len(sent) else None


def _scan(  # noqa: C901, PLR0912 - one loop
    buffer: bytes, side: Side, profile: Profile | None, request: Request[Any] | None, *, final: bool
) -> tuple[tuple[bytes | Noise, ...], bytes]:
    rules = None  # Computed only if the first three bytes are not enough.
    addresses = range(side is Side.RESPONSES, LAST_ADDRESS + 1)
    if request is not None:
        addresses = range(request.address, request.address + 1)
    by_start = _BY_START[side] if request is None else None
    found: list[bytes | Noise] = []
    size = len(buffer)
    at = noise_at = 0
    fault = Fault.LENGTH
    while at < size:
        known = None
        if by_start is not None and at + 2 < size and buffer[at] in _MODULES:
            known = by_start[buffer[at + 1]][buffer[at + 2]]
        if known == () and noise_at < at and (not final or size - at > LONGEST_FRAME):
            at += 1
            continue
        if known:
            lengths, wrong = known, Fault.CRC
        else:
            if rules is None:
                mask_bytes = _MASK_BYTES if profile is None else (profile.mask_digits // 2,)
                rules = _rules(side, mask_bytes) if request is None else _rules_of_answer(request, mask_bytes)
            lengths, wrong = _lengths(buffer, at, rules, addresses)
        end = _end(buffer, at, lengths, final=final)
        if end is None:
            break
        if lengths and at + lengths[-1] > size:
            wrong = Fault.LENGTH
        if noise_at == at:
            fault = wrong
        if end == at:
            at += 1
            continue
        if noise_at < at:
            found.append(Noise(buffer[noise_at:at], fault))
        found.append(buffer[at:end])
        at = noise_at = end
    if noise_at < at:
        found.append(Noise(buffer[noise_at:at], fault))
    return tuple(found), buffer[at:]


def _end(buffer: bytes, at: int, lengths: tuple[int, ...], *, final: bool) -> int | None:
    """Return where the frame that begins here ends: here if there is no frame; None if more bytes are needed."""
    for length in lengths:
        if at + length <= len(buffer):
            if not crc_of(buffer[at : at + length]):
                return at + length
        elif not final:
            return None
    return len(buffer) if final and _ends_as_frame(buffer, at) else at


def _ends_as_frame(buffer: bytes, at: int) -> bool:
    """Return whether all remaining bytes are one frame, of any function."""
    whole = SHORTEST_FRAME <= len(buffer) - at <= LONGEST_FRAME and buffer[at] <= LAST_ADDRESS
    return whole and not crc_of(buffer[at:])


_MORE_IS_NEEDED = (LONGEST_FRAME + 1,)


def _lengths(  # noqa: C901, PLR0911 - a list of what is looked at, byte after byte
    buffer: bytes, at: int, rules: Rules, addresses: range
) -> tuple[tuple[int, ...], Fault]:
    """Return the possible lengths of a frame that begins here, the longest first, and the fault if there is none."""
    address = buffer[at]
    if address not in addresses:
        return (), Fault.ADDRESS
    left = len(buffer) - at
    if left < len("af"):
        return _MORE_IS_NEEDED, Fault.LENGTH
    function = buffer[at + 1]
    possible = rules.get((function, None), ())
    if function == MODULE_SETTINGS:
        if left < len("afs"):
            return _MORE_IS_NEEDED, Fault.LENGTH
        possible = rules.get((function, buffer[at + 2]), ())
    if not possible:
        return (), Fault.SUB_FUNCTION if function == MODULE_SETTINGS else Fault.FUNCTION
    if address == BROADCAST:
        possible = tuple(rule for rule in possible if rule.broadcast)
        if not possible:
            return (), Fault.ADDRESS
    lengths = []
    for rule in possible:
        length = rule.length
        if rule.count_at:
            if left <= rule.count_at:
                return _MORE_IS_NEEDED, Fault.LENGTH
            count = buffer[at + rule.count_at]
            length += count
            if not count or count % rule.step or length > LONGEST_FRAME:
                continue
        lengths.append(length)
    return tuple(sorted(lengths, reverse=True)), Fault.CRC if lengths else Fault.COUNT
