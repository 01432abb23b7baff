"""A driver of procedures over modelled modules, in virtual time, with the faults of a real line."""

from collections.abc import Sequence
from random import Random
from typing import Any, TypeVar

from attrs import define, evolve, field

from i7000 import LineSettings
from i7000.device import Bus as Modules
from i7000.device import Ear, Eeprom, Signals, Uart, power_on
from i7000.host import Bus, Ended, Event, Policy, Transmit, next_deadline, receive, send
from i7000.host.procedures import Ask, Procedure, Result, Tell, Tune, Wait
from i7000.message import Response
from i7000.simulator.faults import Faults

T = TypeVar("T")

TURNAROUND = 0.005
"""How long a module thinks."""


@define
class Runner:
    """What a procedure runs on: a line with modules, a clock that jumps, and what happened."""

    modules: Modules
    signals: Sequence[Signals] = ()
    bus: Bus[Response] = field(factory=Bus[Response])
    faults: Faults = field(factory=Faults)
    twice: float = 0.0
    """The probability that a response arrives twice, the second one right behind the first."""
    chance: Random = field(factory=lambda: Random(0))
    now: float = 0.0
    asked: list[Ask[Any]] = field(factory=list)
    told: list[object] = field(factory=list)
    sent: list[bytes] = field(factory=list)
    """The frames that the host sent."""
    coming: list[tuple[float, bytes]] = field(factory=list)
    """What is on its way to the host, the earliest first."""

    @classmethod
    def on(cls, *eeproms: Eeprom, init_switch: bool = False, **how: Any) -> "Runner":
        """A line with modules just powered on."""
        modules = Modules(tuple(power_on(eeprom, init_switch=init_switch, now=0.0) for eeprom in eeproms))
        how.setdefault("signals", (Signals(),) * len(eeproms))
        return cls(modules, **how)

    def run(self, procedure: Procedure[T]) -> T:
        """Do the steps of a procedure until it returns."""
        reply: Any = None
        while True:
            try:
                step = procedure.send(reply)
            except StopIteration as end:
                value: T = end.value
                return value
            reply = None
            match step:
                case Ask():
                    self.asked.append(step)
                    reply = self.ask(step)
                case Tune(line):
                    self.bus = evolve(self.bus, line=line)
                case Wait(seconds):
                    self.now += seconds
                case Tell(value=told):
                    self.told.append(told)

    def ask(self, step: Ask[Any]) -> Result[Any]:
        policy = self.bus.policy
        bus = self.bus if step.policy is None else evolve(self.bus, policy=step.policy)
        bus = send(bus, step.command, step.profile, self.now)
        others: list[Any] = []
        while True:
            deadline = next_deadline(bus)
            assert deadline is not None
            heard = b""
            if self.coming and self.coming[0][0] <= deadline:
                at, heard = self.coming.pop(0)
                self.now = max(self.now, at)
            else:
                self.now = max(self.now, deadline)
            bus, events = receive(bus, heard, self.now)
            ended = self._happened(events, others)
            if ended is not None:
                self.bus = evolve(bus, policy=policy)
                return Result(ended, tuple(others))  # type: ignore[arg-type] # every outcome is one

    def _happened(self, events: tuple[Event[Any], ...], others: list[Any]) -> Ended | None:
        ended = None
        for event in events:
            if isinstance(event, Transmit):
                self._carry(event.wire)
            elif isinstance(event, Ended):
                ended = event
            else:
                others.append(event)
        return ended

    def _carry(self, wire: bytes) -> None:
        """Take a request to the modules, and their responses back."""
        self.sent.append(wire)
        character = self.bus.character_time
        end = self.now + len(wire) * character
        if self.faults.echo:
            self.coming.append((end, wire))
        carried, _ = self.faults.carried(wire, self.chance)
        ear = Ear(Uart.of(self.bus.line))
        self.modules, ear, heard = self.modules.hear(ear, carried, self.signals, self.now)
        self.modules, _, silent = self.modules.silence(ear, self.signals, self.now)
        for it in (*heard, *silent):
            if it.answer is not None:
                answer = it.answer * (2 if self.chance.random() < self.twice else 1)
                there = end + it.delay + TURNAROUND + len(answer) * character
                pieces = self.faults.delivered(answer, character, self.chance).pieces
                self.coming += [(there + piece.after, piece.wire) for piece in pieces if piece.wire]
        self.coming.sort(key=lambda it: it[0])


SHORT = Policy(retries=2, turnaround=0.2, grace=0.4)
"""Longer than what is late by the default of `Faults`."""
__all__ = ["SHORT", "LineSettings", "Runner"]
