"""Simulated modules that stay between calls of the command line, as they do at a real port."""

import io
from collections.abc import Callable
from typing import Any

import pytest

from i7000 import LineSettings
from i7000.device import Eeprom
from i7000.link import VirtualPort
from i7000.simulator.simulator import Simulated
from tests.terminal import Run, Told

__all__ = ["PORT", "Terminal", "Workbench"]

PORT = "PORT"
"""The target of the modules on the bench."""


class Port(VirtualPort):
    """A port that is opened again by every call."""

    lost_after: int | None = None
    """After so many writes the port is lost, or with `dead` the modules have no power."""
    dead = False
    on_write: Callable[[bytes], object] | None = None

    def write(self, data: Any) -> int:
        """Send bytes, unless the port is lost."""
        if self.on_write:
            self.on_write(bytes(data))
        return super().write(data)


class Workbench:
    """Modules on a bench, and a command line that finds them at `PORT`."""

    def __init__(self, run: Run, monkeypatch: pytest.MonkeyPatch, *modules: Simulated) -> None:
        self._run = run
        self.port = Port(modules)
        monkeypatch.setattr("i7000.link.open_target", self._open)

    def _open(self, _: str, line: LineSettings) -> VirtualPort:
        if not self.port.is_open:
            self.port.open()
        self.line = line
        return self.port

    def __call__(self, command: str, *arguments: str, **others: Any) -> Told:
        """Call a command with the port as its target, and then the arguments."""
        return self._run(command, PORT, *arguments, **others)

    @property
    def eeprom(self) -> Eeprom:
        """What the first module remembers."""
        return self.port.modules[0].eeprom


class Terminal(io.StringIO):
    """A standard input at which somebody answers questions."""

    def isatty(self) -> bool:
        """Whether it is a terminal: it is."""
        return True
