"""Values in units -> the counts that fields hold: ``-0.5``, ``-0.5degC``, ``2.5s``.

Laws: a decimal number is in the unit that ``i7000 decode`` prints, a number in hex is counts. Nothing is rounded.
"""

import re
from decimal import Decimal
from typing import NamedTuple, get_args

from i7000 import modbus
from i7000.cli.numbers import integer, is_hex
from i7000.cli.records import parts_of
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


def scale_of(kind: type[Message], field: str, *, channel: bool) -> Scale | None:
    """Return the scale of a field, or None if it is not a count; `channel` if it is of a channel, not of the module.

    >>> from i7000 import dcon
    >>> scale_of(dcon.SetHostWatchdogTimeout, "timeout", channel=False)
    Scale(unit='s', per_unit=10, bits=0)
    """
    if (kind, field) == (modbus.SetCjcOffset, "offset"):
        return Scale("degC", 10, bits=8) if channel else Scale("degC", 100)
    number, part = get_args(parts_of(kind)[field].type)
    unit = getattr(part, "unit", None)
    return Scale(unit, round(1 / part.scale)) if unit and number is int else None


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
        if not scale.unit:
            return integer(text)  # which says what is wrong
        raise UsageError(
            f"{text!r} is not a value in {scale.unit}: give a decimal number such as 2.5, or counts in hex such as 0x19"
        )
    exact = Decimal(found[1]) * scale.per_unit
    if exact != int(exact):
        raise UsageError(f"{text} is not a multiple of {1 / scale.per_unit:g} {scale.unit}".rstrip())
    if not scale.bits:
        return int(exact)
    limit = 1 << scale.bits - 1
    if not -limit <= exact < limit:
        low, high = -limit / scale.per_unit, (limit - 1) / scale.per_unit
        raise UsageError(f"{text} is not within {low:g}..{high:g} {scale.unit}")
    return int(exact) & (1 << scale.bits) - 1
