"""Procedures run against the model of the modules, in virtual time and over a line that may have faults."""

from collections.abc import Callable, Generator
from typing import Any, TypeVar

from attrs import define, evolve, field

from i7000 import LineSettings, device, host
from i7000.device import Ear, Eeprom, Signals, Uart
from i7000.host import Transmit, next_deadline, receive, send
from i7000.host.procedures.step import Ask, Result, Tell, Tune, Wait

T = TypeVar("T")
Spoil = Callable[[bytes, bool], list[tuple[float, bytes]]]
"""What becomes of bytes on their way (to the module, or from it): pieces, and how late they are."""
LIMIT = 3000
"""Steps that a procedure may take."""


def intact(wire: bytes, _: bool) -> list[tuple[float, bytes]]:  # noqa: FBT001 - the direction
    return [(0.0, wire)]


@define
class Bench:
    """One host, modules, and the line between them."""

    modules: device.Bus
    line: LineSettings = field(factory=LineSettings)
    spoil: Spoil = intact
    policy: host.Policy = field(factory=host.Policy)
    now: float = 0.0
    asked: list[Any] = field(factory=list)
    """The commands that procedures sent, without retries."""
    told: list[Any] = field(factory=list)
    coming: list[tuple[float, bytes]] = field(factory=list)

    @classmethod
    def of(cls, *eeproms: Eeprom, init_switch: bool = False, **facts: Any) -> "Bench":
        modules = [device.power_on(it, init_switch=init_switch, now=0.0) for it in eeproms]
        line = facts.pop("line", modules[0].ram.line_settings)
        return cls(device.Bus(tuple(modules)), line=line, **facts)

    @property
    def eeprom(self) -> Eeprom:
        return self.modules.modules[0].eeprom

    def run(self, procedure: Generator[Any, Any, T]) -> T:
        """Run a procedure to its end, and return what it returns."""
        bus: host.Bus[Any] = host.Bus(self.line, self.policy, clock=self.now)
        answer: Any = None
        for _ in range(LIMIT):
            try:
                step = procedure.send(answer)
            except StopIteration as end:
                return end.value  # type: ignore[no-any-return] # of the procedure
            answer = None
            if isinstance(step, Ask):
                self.asked.append(step.command)
                bus, answer = self._ask(bus, step)
            elif isinstance(step, Tune):
                self.line = step.line
                bus = evolve(bus, line=step.line)
            elif isinstance(step, Wait):
                self.now += step.seconds
            elif isinstance(step, Tell):
                self.told.append(step.value)
        raise AssertionError("the procedure does not end")

    def _ask(self, bus: Any, step: Ask[Any]) -> tuple[Any, Result[Any]]:
        bus = send(bus, step.command, step.profile, self.now)
        others: list[Any] = []
        while True:
            bus, events = self._next(bus)
            for event in events:
                if isinstance(event, Transmit):
                    self._transmit(bus, event.wire)
                elif isinstance(event, host.Ended):
                    return bus, Result(event, tuple(others))  # type: ignore[arg-type] # an outcome
                else:
                    others.append(event)

    def _next(self, bus: Any) -> tuple[Any, tuple[Any, ...]]:
        deadline = next_deadline(bus)
        assert deadline is not None
        if self.coming and self.coming[0][0] <= deadline:
            at, data = self.coming.pop(0)
            self.now = max(at, self.now)
            return receive(bus, data, self.now)
        self.now = max(deadline, self.now)
        return receive(bus, b"", self.now)

    def _transmit(self, bus: Any, wire: bytes) -> None:
        """Take bytes to the modules, and what they answer back."""
        took = bus.character_time
        signals = [Signals()] * len(self.modules.modules)
        ear = Ear(Uart.of(self.line))
        for late, data in self.spoil(wire, True):
            at = max(self.now + len(wire) * took + late, self.modules.clock)
            self.modules, ear, heard = self.modules.hear(ear, data, signals, at)
            self.modules, ear, more = self.modules.silence(ear, signals, at + bus.silence)
            for it in (*heard, *more):
                if it.answer is not None:
                    self._answer(it.answer, at + it.delay, took)
        self.coming.sort(key=lambda piece: piece[0])

    def _answer(self, wire: bytes, at: float, took: float) -> None:
        for late, data in self.spoil(wire, False):
            self.coming.append((at + 0.005 + len(data) * took + late, data))
