"""How long tests wait for another process or thread."""

from collections.abc import Callable
from time import monotonic, sleep

ENOUGH = 60.0
"""Seconds in which anything happens that is going to, on a machine that has much else to do: a bound, not a measure."""


def until(holds: Callable[[], object]) -> None:
    """Wait until something holds, or fail."""
    deadline = monotonic() + ENOUGH
    while not holds():
        assert monotonic() < deadline
        sleep(0.01)
