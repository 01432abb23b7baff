"""The short words of the terminal for a few settings, beside the names of their enumerations."""

from collections.abc import Mapping
from enum import Enum
from typing import Any

from i7000 import Filter, Protocol
from i7000.cli.words import UsageError, member, near

__all__ = ["FILTERS", "PROTOCOLS", "SPOKEN", "chosen", "protocol_word"]

PROTOCOLS = {"dcon": Protocol.DCON, "rtu": Protocol.MODBUS_RTU}
SPOKEN = {protocol: word for word, protocol in PROTOCOLS.items()}
"""The words of the protocols, as every command prints them."""
_WHOLE = Protocol.MODBUS_RTU.name.lower()
"""What Modbus RTU is called by its enumeration; the terminal reads it, and writes ``rtu``."""
FILTERS = {"50hz": Filter.REJECT_50_HZ, "60hz": Filter.REJECT_60_HZ} | {one.name.lower(): one for one in Filter}
_SHORT: Mapping[type[Enum], Mapping[str, Enum]] = {Protocol: PROTOCOLS, Filter: FILTERS}


def protocol_word(text: str) -> str:
    """Return the short word of a protocol for its name; any other text as it is.

    >>> protocol_word("modbus_rtu"), protocol_word("auto")
    ('rtu', 'auto')
    """
    return "rtu" if text.strip().lower().replace("-", "_") == _WHOLE else text


def chosen(text: str, kind: type[Enum]) -> Any:  # noqa: ANN401 - a member of it
    """Read a member of an enumeration: its short word, its name, or its number.

    >>> chosen("rtu", Protocol).name, chosen("modbus_rtu", Protocol).name, chosen("50hz", Filter).name
    ('MODBUS_RTU', 'MODBUS_RTU', 'REJECT_50_HZ')
    """
    short = _SHORT.get(kind, {})
    if text.lower() in short:
        return short[text.lower()]
    try:
        return member(text, kind)
    except UsageError:
        if not short:
            raise
        raise UsageError(f"{text!r} is not one of {', '.join(short)}{near(text, short)}") from None
