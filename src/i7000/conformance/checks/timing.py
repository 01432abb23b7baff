"""When the module answers, and what it takes for one frame (manual 2, 3)."""

from i7000.conformance.checks.steps import Steps

__all__ = ["STEPS"]

STEPS: dict[str, Steps] = {}
