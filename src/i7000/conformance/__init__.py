"""What is required of a module or a driver, and what a test of it may send: the conformance kit, without I/O.

Parts: `hazard` classifies what a command can do; `guard` classifies bytes, and refuses what is not allowed.
"""

from i7000.conformance.guard import LONGEST_WRITE, Guard, GuardError, hazards_of
from i7000.conformance.hazard import DEFAULT_ALLOWED, Hazard, allowing, worst_of

__all__ = [
    "DEFAULT_ALLOWED",
    "LONGEST_WRITE",
    "Guard",
    "GuardError",
    "Hazard",
    "allowing",
    "hazards_of",
    "worst_of",
]
