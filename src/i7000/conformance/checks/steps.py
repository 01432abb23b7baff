"""What the steps of a check are."""

from collections.abc import Callable

from i7000.conformance.subject import Subject
from i7000.host.procedures import Procedure

__all__ = ["Steps"]

Steps = Callable[[Subject], Procedure[None]]
"""The steps of a check: a generator function of the module under test. It passes by ending."""
