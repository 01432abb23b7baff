"""Values in units -> the counts that fields hold: ``-0.5``, ``-0.5degC``, ``2.5s``.

Laws: a decimal number is in the unit that ``i7000 decode`` prints, a number in hex is counts. Nothing is rounded.
"""

import re
from decimal import Decimal
from typing import NamedTuple

from i7000 import dcon, modbus
from i7000.cli.numbers import integer, is_hex
from i7000.cli.words import UsageError
from i7000.message import Message

__all__ = ["Scale", "counts", "scale_of"]


class Scale(NamedTuple):
    """How many counts are one unit."""

    unit: str
    """Empty for a plain number."""
    per_unit: int
    bits: int = 0
    """Where the field holds two's complement without a sign, how many bits of it."""


_SCALES: dict[tuple[type[Message], str], Scale] = {
    (dcon.CjcOffset, "offset"): Scale("degC", 100),
    (dcon.SetCjcOffset, "offset"): Scale("degC", 100),
    (dcon.HostWatchdogTimeout, "timeout"): Scale("s", 10),
    (dcon.SetHostWatchdogTimeout, "timeout"): Scale("s", 10),
    (dcon.SetSoftInitTimeout, "timeout"): Scale("s", 1),
    (modbus.SetCjcOffset, "offset"): Scale("degC", 100),
}
_OF_A_CHANNEL = Scale("degC", 10, bits=8)
"""The CJC offset of a channel by function 46h; that of the module, which has channel 0, is in the table above."""


def scale_of(kind: type[Message], field: str, channel: int) -> Scale | None:
    """Return the scale of a field, or None if it is a plain number; `channel` is that of the message, or 0."""
    if channel and (kind, field) == (modbus.SetCjcOffset, "offset"):
        return _OF_A_CHANNEL
    return _SCALES.get((kind, field))


def counts(text: str, scale: Scale) -> int:
    """Read a value in its unit, or counts in hex.

    Errors: `UsageError` for another unit, and for a value between two counts.

    >>> counts("-0.5", Scale("degC", 100)), counts("2.5 s", Scale("s", 10)), counts("0x32", Scale("degC", 100))
    (-50, 25, 50)
    """
    if is_hex(text):
        return integer(text)
    found = re.fullmatch(r"([-+]?[0-9]{1,10}(?:\.[0-9]{0,9})?|[-+]?\.[0-9]{1,9}) *(.*)", text.strip())
    if not found or found[2].lower() not in ("", scale.unit.lower()):
        return _refused(text, scale)
    exact = Decimal(found[1]) * scale.per_unit
    if exact != int(exact):
        raise UsageError(f"{text} is between two counts: steps of {1 / scale.per_unit:g} {scale.unit}".rstrip())
    signed, limit = int(exact), 1 << scale.bits >> 1
    return signed & (1 << scale.bits) - 1 if -limit <= signed < limit else signed


def _refused(text: str, scale: Scale) -> int:
    """Raise the reason why a text is not a number of the scale."""
    if not scale.unit:
        return integer(text)  # which says why
    raise UsageError(f"{text!r} is not a value in {scale.unit}: a decimal number as 2.5, or counts in hex as 0x19")
