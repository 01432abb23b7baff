"""The classes of what bytes on a line can do to its modules, and which of them are allowed.

Temporary until the guard is merged.
"""

from enum import Enum

__all__ = ["DEFAULT_ALLOWED", "Hazard"]


class Hazard(Enum):
    """What bytes can do, in rising order of harm."""

    OBSERVE = "observe"
    MEMORY = "memory"
    BROADCAST = "broadcast"
    WRITE = "write"
    COMM = "comm"
    CALIBRATION = "calibration"


DEFAULT_ALLOWED = frozenset({Hazard.OBSERVE, Hazard.MEMORY})
