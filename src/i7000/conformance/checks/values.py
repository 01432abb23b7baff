"""The readings of the channels: their shape in each type and format (manual 1.11, 3.5)."""

from i7000.conformance.checks.steps import Steps

__all__ = ["STEPS"]

STEPS: dict[str, Steps] = {}
