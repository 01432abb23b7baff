"""Temporary until the guard is merged."""

from i7000.conformance.hazard import Hazard
from i7000.errors import I7000Error
from i7000.frozen import frozen
from i7000.settings import LineSettings


class GuardError(I7000Error):
    """Refused."""


@frozen
class Guard:
    """Nothing yet."""

    allowed: frozenset[Hazard]
    hazards: frozenset[Hazard] = frozenset()

    def sending(self, wire: bytes, line: LineSettings) -> "Guard":
        """Return it."""
        return self
