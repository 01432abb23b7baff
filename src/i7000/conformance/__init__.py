"""Conformance: what is required of a module or a driver, and whether it does it; without I/O and without a clock.

A check is a statement of ``spec/checks`` and the steps of `checks` that test it. `Subject` is the module under test
with its twin, the device model that has the same settings: it defines which answers are allowed. `run` carries out a
plan of checks; `settle` restores the module. Nothing is sent but through the guard, which refuses what is not allowed.
Parts: `hazard` classifies what a command can do, `guard` what bytes can do. `statement` has the requirements, `checks`
the steps, `oracle` and `subject` what they see of a module. `verdict` is what becomes of a check, `records` a report.
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
