"""The rows of the address maps (manual 3.4)."""

from i7000.conformance.checks.steps import Steps

__all__ = ["STEPS"]

STEPS: dict[str, Steps] = {}
