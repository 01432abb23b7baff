"""Names and firmware versions as text, and how to distinguish them from other responses (2.23, 2.24, 2.33).

Laws: a version is never a name. A name is never the text of a response to another command with the same address, for
any model. The exception is the number of a series, which may be a mask of four digits (E122, an assumption).
"""

import re

__all__ = ["CHARACTERS", "LONGEST_NAME", "is_name", "is_version"]

LONGEST_NAME = 6

CHARACTERS = frozenset(map(chr, range(0x20, 0x7F))) - frozenset("%#$~@!>?")
"""Printable ASCII without the leading characters of messages (E102)."""

_VERSION = r"[A-Z][0-9]\.[0-9]{1,2}"
_OTHER_ANSWER = rf"""(?x)
    (?!701[789]) (?:[0-9A-F]{{4}} | [0-9A-F]{{6}})  # VV of 2.14, NN of 2.22, TTCCFF of 2.10
  | [0-9A-F]{{2}}                                   # the same of 8 channels, SC of 2.25, SS of 2.36
  | [01][0-9A-F]{{2}}                               # EVV of 2.38
  | [0-2]                                           # i of 2.20, N of 2.29, 2.40 and 2.42
  | [+-][0-9A-F]{{4}}                               # SNNNN of 2.17
  | C[0-9A-F]{{1,2}}R[0-9A-F]{{2}}                  # CiRrr of 2.16
  | {_VERSION}                                      # 2.23
"""


def is_version(text: str) -> bool:
    """Return whether a module can have this firmware version: a letter, a digit, a point, one or two digits.

    >>> is_version("A2.0"), is_version("B305")
    (True, False)
    """
    return re.fullmatch(_VERSION, text) is not None


def is_name(text: str) -> bool:
    """Return whether a module can have this name: 1 to 6 characters that are not the text of another response.

    >>> is_name("7018"), is_name("OVEN 2"), is_name("0506"), is_name("A2.0"), is_name("OVEN 21")
    (True, True, False, False, False)
    """
    short = 1 <= len(text) <= LONGEST_NAME and CHARACTERS.issuperset(text)
    return short and re.fullmatch(_OTHER_ANSWER, text) is None
