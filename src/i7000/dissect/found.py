"""The result of a search in a line: a frame of either protocol, or a damaged one."""

from enum import StrEnum
from typing import NamedTuple

__all__ = ["Found", "Kind"]


class Kind(StrEnum):
    """The kind of a piece of a line."""

    DCON = "dcon"
    MODBUS = "modbus"
    DAMAGED = "damaged"
    """Bytes in the place of a frame that are not a valid frame of either protocol."""


class Found(NamedTuple):
    """A frame, or a damaged one, and its place in the line."""

    kind: Kind
    wire: bytes
    """The whole frame with CRC or carriage return; text without a carriage return gets one."""
    start: int
    end: int
