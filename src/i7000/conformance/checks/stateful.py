"""Random sequences of commands and requests, shrunk where the module differs."""

from i7000.conformance.checks.steps import Steps

__all__ = ["STEPS"]

STEPS: dict[str, Steps] = {}
