"""One fact asked in two ways: both answers agree."""

from i7000.conformance.checks.steps import Steps

__all__ = ["STEPS"]

STEPS: dict[str, Steps] = {}
