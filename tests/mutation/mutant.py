"""What a mutant is: a file of the checkout with one change."""

from __future__ import annotations

import difflib
import hashlib
from abc import ABC, abstractmethod
from functools import cached_property


class Mutant(ABC):
    """A file with one change. The changed text is made when it is asked for."""

    def __init__(self, file: str, before: str) -> None:
        self.file = file
        self.before = before

    @cached_property
    @abstractmethod
    def after(self) -> str:
        """The whole text of the file with the change."""

    @cached_property
    def changes(self) -> tuple[str, ...]:
        """The lines that go, each behind a minus, and those that come, each behind a plus."""
        lines = difflib.unified_diff(self.before.splitlines(), self.after.splitlines(), n=0, lineterm="")
        return tuple(line for line in lines if not line.startswith(("---", "+++", "@@")))

    @cached_property
    def line(self) -> int:
        """The first line that differs, from 1."""
        pairs = zip(self.before.splitlines(), [*self.after.splitlines(), ""], strict=False)
        return next(number for number, (old, new) in enumerate(pairs, 1) if old != new)

    @cached_property
    def key(self) -> str:
        """A name that depends on the file and on its whole text, before and after."""
        return hashlib.sha256(f"{self.file}\0{self.before}\0{self.after}".encode()).hexdigest()[:20]
