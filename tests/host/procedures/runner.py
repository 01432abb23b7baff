"""A driver of procedures over simulated modules, in virtual time, with the faults of a real line."""

from collections.abc import Sequence
from typing import Any, Self, TypeVar

from attrs import define, field

from i7000 import LineSettings
from i7000.device import Eeprom, Signals, State, power_on
from i7000.host import Policy
from i7000.host.procedures import Ask, Procedure
from i7000.link import Line, VirtualPort
from i7000.simulator.faults import Faults

T = TypeVar("T")


@define
class Runner:
    """What a procedure runs on: a line with modules, and what happened on it."""

    port: VirtualPort
    line: Line
    asked: list[Ask[Any]] = field(factory=list)
    told: list[object] = field(factory=list)

    @classmethod
    def on(  # noqa: PLR0913 - all but the modules are options
        cls,
        *eeproms: Eeprom,
        init_switch: bool = False,
        signals: Sequence[Signals] | None = None,
        line: LineSettings = LineSettings(),  # noqa: B008 - frozen
        policy: Policy = Policy(),  # noqa: B008 - frozen
        faults: Faults = Faults(),  # noqa: B008 - frozen
        seed: int = 0,
    ) -> Self:
        """A line with modules just powered on."""
        modules = [power_on(eeprom, init_switch=init_switch, now=0.0) for eeprom in eeproms]
        port = VirtualPort(modules, signals or [Signals()] * len(modules), faults, seed=seed, line=line)
        return cls(port, Line(port, line, policy, echo=faults.echo))

    @property
    def modules(self) -> tuple[State, ...]:
        return self.port.modules

    @property
    def now(self) -> float:
        return self.port.now()

    def run(self, procedure: Procedure[T]) -> T:
        """Do the steps of a procedure until it returns."""
        return self.line.run(self._noted(procedure), self.told.append)

    def _noted(self, procedure: Procedure[T]) -> Procedure[T]:
        """Note what a procedure asks."""
        reply: Any = None
        while True:
            try:
                step = procedure.send(reply)
            except StopIteration as end:
                value: T = end.value
                return value
            if isinstance(step, Ask):
                self.asked.append(step)
            reply = yield step
