"""Frames in what a line delivers: requests, responses, or both as a tapped bus has them (manual 3).

Laws: `split` never raises and never loses a byte; it finds every good frame whatever noise is around it, and the same
frames and noise however they arrive; what it keeps is shorter than a frame. A frame is what has the length that its
function says and a good CRC: where several lengths are possible, the shortest with a good CRC.
"""

from enum import StrEnum
from functools import cache

from attrs import frozen

from i7000.errors import DecodeError, Fault, Noise
from i7000.modbus.codec import REQUESTS
from i7000.modbus.frame import LONGEST_FRAME, crc16
from i7000.modbus.layout import Layout
from i7000.modbus.request import BROADCAST, EXCEPTION_BIT, MODULE_SETTINGS, ExceptionCode
from i7000.profile import Profile

__all__ = ["Side", "drop_echo", "flush", "split"]

_CRC = 2
_LAST_ADDRESS = 247
_EXCEPTION_LENGTH = 5
_MASK_BYTES = (1, 2, 3)


class Side(StrEnum):
    """Whose frames are on the line."""

    REQUESTS = "requests"
    RESPONSES = "responses"
    BOTH = "both"

    __hash__ = str.__hash__  # That of an Enum takes as long as a byte that comes in.


@frozen
class Rule:
    """How long a frame is."""

    length: int
    """Bytes, without those that are counted."""
    count_at: int = 0
    """Where the byte is that counts them; 0 if none are."""
    step: int = 1
    """What their number is a multiple of."""
    broadcast: bool = False
    """Whether the frame can be for all modules."""


def _rules_of(layout: Layout, mask_bytes: tuple[int, ...], *, broadcast: bool) -> tuple[Rule, ...]:
    length = layout.fixed + _CRC
    if layout.tail == "mask":
        return tuple(Rule(length + extra, broadcast=broadcast) for extra in mask_bytes)
    if layout.tail:
        return (Rule(length, layout.fixed - 1, 2 if layout.tail == "words" else 1, broadcast),)
    return (Rule(length, broadcast=broadcast),)


@cache
def _rules(side: Side, mask_bytes: tuple[int, ...]) -> dict[tuple[int, int | None], tuple[Rule, ...]]:
    """The rules of a side, by function and sub-function."""
    rules: dict[tuple[int, int | None], tuple[Rule, ...]] = {}
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


_MISSING = 256
"""In place of a byte that is not there yet."""
Starts = list[list[tuple[int, ...] | None]]
"""The lengths of a frame to one module, by function and third byte; None where it takes more to know."""


def _starts(side: Side) -> Starts:
    """Ask `_lengths` of every start; what depends on the profile takes more."""
    rules, others = _rules(side, _MASK_BYTES), _rules(side, _MASK_BYTES[:1])
    no_frame: list[tuple[int, ...] | None] = [()] * (_MISSING + 1)
    table = [no_frame] * 256 + [[_MORE_IS_NEEDED] * (_MISSING + 1)]
    for function in {function for function, _ in rules}:
        row: list[tuple[int, ...] | None] = []
        for third in range(256):
            start = bytes((1, function, third))
            lengths, _ = _lengths(start, 0, rules)
            known = lengths != _MORE_IS_NEEDED and lengths == _lengths(start, 0, others)[0]
            row.append(lengths if known else None)
        table[function] = [*row, _lengths(bytes((1, function)), 0, rules)[0]]
    return table


class _Sides(dict[Side, Starts]):
    """The starts of each side; made when first needed."""

    def __missing__(self, side: Side) -> Starts:
        return self.setdefault(side, _starts(side))


_BY_START = _Sides()


def split(
    buffer: bytes, side: Side = Side.BOTH, profile: Profile | None = None
) -> tuple[tuple[bytes | Noise, ...], bytes]:
    """Split what a line delivered into whole frames, noise and the rest that may still become a frame.

    Shape: the rest is shorter than `LONGEST_FRAME`; call again with the rest and what came next.
    Special: with a profile, channel masks have the length of its model; without, the CRC decides. A frame that is not
        finished holds back what follows it: when the line has been silent for 3.5 characters, `flush` the rest.
    Manual: 3; E61.
    """
    size = len(buffer)
    if size and 0 < buffer[0] <= _LAST_ADDRESS:
        function = buffer[1] if size > 1 else _MISSING
        lengths = _BY_START[side][function][buffer[2] if size > 2 else _MISSING]
        if lengths and size < lengths[0]:  # It is still coming in, as in most calls where bytes come one by one.
            return (), buffer
    return _scan(buffer, side, profile, final=False)


def flush(rest: bytes, side: Side = Side.BOTH, profile: Profile | None = None) -> tuple[bytes | Noise, ...]:
    """Split a rest after which nothing came: what is not finished is noise."""
    return _scan(rest, side, profile, final=True)[0]


def drop_echo(received: bytes, sent: bytes) -> bytes:
    """Take off the local echo that 2-wire adapters give of what was sent; empty while the echo is still coming in.

    Errors: `DecodeError` with `Fault.ECHO` where something else came.
    """
    for at, (byte, expected) in enumerate(zip(received, sent, strict=False)):
        if byte != expected:
            raise DecodeError(Fault.ECHO, received, at, allowed=sent.hex(" "), section="3")
    return received[len(sent) :]


def _scan(  # noqa: C901 - one loop
    buffer: bytes, side: Side, profile: Profile | None, *, final: bool
) -> tuple[tuple[bytes | Noise, ...], bytes]:
    rules = _rules(side, _MASK_BYTES if profile is None else (profile.mask_digits // 2,))
    by_start = _BY_START[side]
    found: list[bytes | Noise] = []
    size = len(buffer)
    at = noise_at = 0
    fault = Fault.LENGTH
    while at < size:
        known = None
        if at + 2 < size and 0 < buffer[at] <= _LAST_ADDRESS:
            known = by_start[buffer[at + 1]][buffer[at + 2]]
        if known == () and noise_at < at:
            at += 1
            continue
        lengths, wrong = (known, Fault.CRC) if known else _lengths(buffer, at, rules)
        end = 0
        for length in lengths:
            if at + length > size:
                if final:
                    continue
                end = -1
                break
            if not crc16(buffer[at : at + length]):
                end = at + length
                break
        if end < 0:
            break
        if noise_at == at:
            fault = wrong
        if not end:
            at += 1
            continue
        if noise_at < at:
            found.append(Noise(buffer[noise_at:at], fault))
        found.append(buffer[at:end])
        at = noise_at = end
    if noise_at < at:
        found.append(Noise(buffer[noise_at:at], fault))
    return tuple(found), buffer[at:]


_MORE_IS_NEEDED = (LONGEST_FRAME + 1,)
_EXCEPTION_CODES = frozenset(ExceptionCode)


def _lengths(  # noqa: C901, PLR0911, PLR0912 - a list of what is looked at, byte after byte
    buffer: bytes, at: int, rules: dict[tuple[int, int | None], tuple[Rule, ...]]
) -> tuple[tuple[int, ...], Fault]:
    """Tell the lengths that a frame beginning here can have, the shortest first, and what is wrong if it is none."""
    address = buffer[at]
    if address > _LAST_ADDRESS:
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
    if function & EXCEPTION_BIT:
        if left < len("afe"):
            return _MORE_IS_NEEDED, Fault.LENGTH
        if buffer[at + 2] not in _EXCEPTION_CODES:
            return (), Fault.VALUE
    lengths = []
    for rule in possible:
        if address == BROADCAST and not rule.broadcast:
            continue
        length = rule.length
        if rule.count_at:
            if left <= rule.count_at:
                return _MORE_IS_NEEDED, Fault.LENGTH
            count = buffer[at + rule.count_at]
            length += count
            if not count or count % rule.step or length > LONGEST_FRAME:
                continue
        lengths.append(length)
    return tuple(sorted(lengths)), Fault.CRC if lengths else Fault.COUNT
