"""The readings of a module asked in two ways, and whether they agree although they were not taken at one moment.

Laws: what is asked in the second way lies between two readings asked in the first, before and after it, give or take
the steps of both formats and a little noise. Signals that move too fast for that decide nothing.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Difference, Unclear
from i7000.host.procedures import Procedure
from i7000.readings import Reading, Status
from i7000.type_codes import TypeCode

__all__ = ["Asked", "agree"]

_TRIES = 3
_NOISE = 0.0005
"""The noise of a reading, as a part of full scale."""
_STEPS = 2
"""The steps of the coarsest format that two readings of one signal may differ by."""
_FAST = 0.01
"""The change between two readings, as a part of full scale, from which a signal moves too fast."""


class Asked(NamedTuple):
    """The readings of some channels: channel, reading, and the bytes that had them."""

    readings: tuple[tuple[int, Reading], ...]
    sent: bytes
    received: bytes


Ask = Callable[[], Procedure[Asked]]


def agree(module: Subject, one: Ask, other: Ask) -> Procedure[None]:
    """Compare readings that are read in two ways, which must agree.

    Special: what differs is read again, twice at most.
    Errors: `Difference`; `Unclear` if the signals move too fast.
    """
    left = _TRIES
    while True:
        left -= 1
        before = yield from one()
        between = yield from other()
        after = yield from one()
        found = _difference(module.profile.type_codes, before, between, after)
        if found is None:
            return
        if left:
            continue
        if isinstance(found, Difference):
            raise module.wrong(found.text, found.sent, found.received, found.expected)
        raise found


def _difference(types: Sequence[TypeCode], before: Asked, between: Asked, after: Asked) -> Difference | Unclear | None:
    found: Unclear | None = None
    for (channel, low), (_, middle), (_, high) in zip(before.readings, between.readings, after.readings, strict=True):
        code = types[channel]
        if Status.DISABLED in (low.status, middle.status):
            if low.status is not middle.status:
                return _wrong(channel, low, middle, between)
            continue
        ends = sorted((_position(low, code), _position(high, code)))
        room = code.full_scale * (_NOISE + _STEPS * 1e-4) + _STEPS * 10.0**-code.decimals + ends[1] - ends[0]
        if ends[0] - room <= _position(middle, code) <= ends[1] + room:
            continue
        if ends[1] - ends[0] < _FAST * code.full_scale:
            return _wrong(channel, low, middle, between)
        found = Unclear(f"the signal of channel {channel} moves too fast", sent=between.sent, received=between.received)
    return found


def _wrong(channel: int, right: Reading, wrong: Reading, asked: Asked) -> Difference:
    text = f"channel {channel} reads {_words(wrong)} in one way and {_words(right)} in the other"
    return Difference(text, sent=asked.sent, received=asked.received, expected=f"about {_words(right)}")


def _position(reading: Reading, code: TypeCode) -> float:
    """Return where a reading is in the span of its type; what is out of range is at the end of it."""
    if reading.value is None:
        return code.maximum if reading.status is Status.OVER_RANGE else code.minimum
    return min(max(reading.value, code.minimum), code.maximum)


def _words(reading: Reading) -> str:
    return reading.status.value.replace("_", " ") if reading.value is None else f"{reading.value:g} {reading.unit}"
