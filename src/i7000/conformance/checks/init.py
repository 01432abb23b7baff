"""The INIT switch, soft INIT, and what can change the line (manual 2.32 to 2.34, A.1)."""

from i7000.conformance.checks.steps import Steps

__all__ = ["STEPS"]

STEPS: dict[str, Steps] = {}
