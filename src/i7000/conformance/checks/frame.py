"""The frames of both protocols: their ends, checksums and addresses, and what is no frame (manual 2, 3)."""

from i7000.conformance.checks.steps import Steps

__all__ = ["STEPS"]

STEPS: dict[str, Steps] = {}
