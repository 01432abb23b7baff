"""The functions of Modbus RTU, and what is refused (manual 3)."""

from i7000.conformance.checks.steps import Steps

__all__ = ["STEPS"]

STEPS: dict[str, Steps] = {}
