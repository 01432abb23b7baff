"""Simulated modules that stay between calls of the command line, as they do at a real port."""

from collections.abc import Callable
from typing import Any

import pytest

from i7000 import LineSettings, Model, Protocol
from i7000.device import Eeprom
from i7000.link import VirtualPort
from i7000.simulator.faults import Faults, Way
from i7000.simulator.simulator import Simulated
from tests.simulator.running import module
from tests.terminal import Run, Told

__all__ = ["DEAD", "EVERY_MODULE", "Bench", "Workbench", "answered", "changed", "workbench"]

DEAD = Faults(silent=1.0).at(Way.TO, drop=1.0)
"""What a line is like whose modules have no power."""
EVERY_MODULE = tuple(
    pytest.param(module(model, protocol=protocol), id=f"{model.value}-{protocol.name}")
    for model in Model
    for protocol in sorted(model.protocols)
)
"""Every model from the factory, in every protocol that it speaks."""


class _Port(VirtualPort):
    """A port that calls a function before each write, and one when the host waits for what comes."""

    before_write: Callable[[bytes], object] | None = None
    before_answer: Callable[[], object] | None = None

    def write(self, data: Any) -> int:
        """Send bytes."""
        if self.before_write:
            self.before_write(bytes(data))
        self._written = True
        return super().write(data)

    def read(self, size: int = 1) -> bytes:
        """Receive bytes."""
        if self.before_answer and self._written:
            self.before_answer()
        self._written = False
        return super().read(size)

    _written = False


class Workbench:
    """Modules on a bench, and a command line whose target they are."""

    def __init__(self, run: Run, monkeypatch: pytest.MonkeyPatch, modules: tuple[Simulated, ...]) -> None:
        self._run = run
        self.port = _Port(modules)
        monkeypatch.setattr("i7000.link.open_target", self._open)

    def _open(self, _: str, __: LineSettings) -> VirtualPort:
        if not self.port.is_open:
            self.port.open()
        return self.port

    def __call__(self, command: str, *arguments: str, **others: Any) -> Told:
        """Call a command with the port as its target, and then the arguments."""
        return self._run(command, "/dev/bench", *arguments, **others)

    @property
    def eeprom(self) -> Eeprom:
        """What the first module remembers."""
        return self.port.modules[0].eeprom

    def lose_power(self, at: Callable[[bytes], bool], *, before: bool) -> None:
        """Switch the modules off when the host sends something: before they carry it out, or before they answer."""

        def look(wire: bytes) -> None:
            if at(wire):
                self.port.faults = DEAD if before else Faults(silent=1.0)
            elif self.port.faults.silent:
                self.port.faults = DEAD

        self.port.before_write = look


Bench = Callable[..., Workbench]


@pytest.fixture
def workbench(run: Run, monkeypatch: pytest.MonkeyPatch) -> Bench:
    """Put modules on a bench."""
    return lambda *modules: Workbench(run, monkeypatch, modules)


@pytest.fixture
def answered(monkeypatch: pytest.MonkeyPatch) -> None:
    """Standard input is a terminal."""
    monkeypatch.setattr("i7000.cli.confirm._is_terminal", lambda: True)


def changed(protocol: Protocol) -> str:
    """Something that every module has, with a value that it has not from the factory."""
    return "host_watchdog_timeout=2.5" if protocol is Protocol.DCON else "response_delay=7"
