"""What is found in a line: a frame of either protocol, or what is left of one."""

from enum import StrEnum
from typing import NamedTuple

__all__ = ["Found", "Kind"]


class Kind(StrEnum):
    """What a piece of a line is."""

    DCON = "dcon"
    MODBUS = "modbus"
    DAMAGED = "damaged"
    """It stands where a frame could, and is none of either protocol."""


class Found(NamedTuple):
    """A frame, or what is left of one, and where in the line it stands."""

    kind: Kind
    wire: bytes
    """All of it, with CRC or carriage return; plain text without a carriage return is given one."""
    start: int
    end: int
