"""Numbers as people write them: decimal, unless they are written ``0x1A`` or ``1Ah``.

Laws: no text has two readings. A text of hex digits without such a mark is refused with the way to write it, and so is
a byte of settings, which manuals print in hex, in plain digits unless both readings are the same.
"""

import re

from i7000 import BaudRate
from i7000.cli.words import UsageError

__all__ = ["baud_rate", "hex_byte", "integer", "is_hex"]

_HEX = re.compile(r"([-+]?)(?:0[xX]([0-9A-Fa-f]{1,8})|([0-9A-Fa-f]{1,8})[hH])")
_DECIMAL = re.compile(r"[-+]?[0-9]{1,10}")
_BARE = re.compile(r"[0-9A-Fa-f]{1,8}")


def is_hex(text: str) -> bool:
    """Return whether a text is a number that is written as hex.

    >>> is_hex("1Ah"), is_hex("0x1A"), is_hex("26")
    (True, True, False)
    """
    return _HEX.fullmatch(text) is not None


def integer(text: str) -> int:
    """Read a whole number.

    Errors: `UsageError`.

    >>> integer("26"), integer("0x1A"), integer("1Ah"), integer("-10h")
    (26, 26, 26, -16)
    """
    found = _HEX.fullmatch(text)
    if found:
        sign, *digits = found.groups("")
        return int(sign + "".join(digits), 16)
    if _DECIMAL.fullmatch(text):
        return int(text)
    if _BARE.fullmatch(text):
        raise UsageError(f"{text!r} has hex digits: write 0x{text} or {text}h")
    if re.fullmatch("[-+]?[0-9]+", text):
        raise UsageError(f"{text!r} is too large: a number has at most ten digits")
    raise UsageError(f"{text!r} is not a whole number: write it in decimal, or in hex as 0x1A or 1Ah")


def hex_byte(text: str) -> int:
    """Read a byte that is printed in hex everywhere, and has to be marked as hex here.

    Errors: `UsageError`.

    >>> hex_byte("0x86"), hex_byte("86h"), hex_byte("06")
    (134, 134, 6)
    """
    if re.fullmatch("[0-9A-Fa-f]{1,2}", text) and int(text, 16) > 9:
        raise UsageError(f"{text!r} can be hex or decimal: write 0x{text} or {text}h")
    byte = integer(text)
    if not 0 <= byte <= 0xFF:
        raise UsageError(f"{text!r} is not a byte: 00h..FFh")
    return byte


def baud_rate(text: str) -> BaudRate | int:
    """Read bits per second, or a code.

    >>> baud_rate("9600"), baud_rate("06h")
    (<BaudRate.BAUD_9600: 6>, <BaudRate.BAUD_9600: 6>)
    """
    number = integer(text)
    rates = {rate.bits_per_second: rate for rate in BaudRate}
    if number > max(BaudRate) and number not in rates:
        raise UsageError(f"{text} is not a baud rate: give one of {', '.join(map(str, rates))}")
    return rates.get(number, BaudRate.of(number))
