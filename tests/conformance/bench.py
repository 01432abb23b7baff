"""A firmware under test in virtual time: the model of a module, and what a faulty one does otherwise."""

import re
from collections.abc import Callable, Generator, Iterable
from itertools import cycle
from typing import Any

from attrs import define, evolve, field

from i7000 import Model, Protocol, dcon, spec
from i7000.conformance.hazard import Hazard
from i7000.conformance.run import CheckResult, Options, Run, plan, selected
from i7000.conformance.verdict import Verdict
from i7000.device import Eeprom, Signals, State, factory, power_on, step
from i7000.host.procedures import BytesHeard, PowerCycle, SendBytes, Tune, Wait
from i7000.models import Firmware
from i7000.settings import LineSettings
from i7000.simulator import Sources, default_sources

ALL = frozenset(Hazard)
STATEMENTS = spec.statements()
Answer = Callable[[bytes, bytes | None], bytes | None]
"""What a firmware answers to a frame in place of the right answer."""
Step = Callable[[State, bytes, Signals, float], tuple[State, bytes | None]]


@define
class Bench:
    """A module on a line of its own; it drives procedures as `i7000.link.Line` does, without a port."""

    state: State
    firmware: Step = step
    power: bool = True
    """Whether its power can be switched."""
    line: LineSettings = field(factory=LineSettings)
    sources: Sources | None = None
    connected: Sources = field(init=False)
    stored: Callable[[Eeprom], Eeprom] = lambda eeprom: eeprom
    """What is left of the settings without power."""
    now: float = 0.0
    sent: list[bytes] = field(factory=list)
    text: bytes = b""

    def __attrs_post_init__(self) -> None:
        self.connected = self.sources or default_sources(self.state.eeprom)

    def drive(self, procedure: Generator[Any, Any, Any]) -> Any:
        """Carry out a procedure, and return what it returns."""
        answer: Any = None
        while True:
            try:
                act = procedure.send(answer)
            except StopIteration as stop:
                return stop.value
            answer = None
            if isinstance(act, SendBytes):
                answer = self._listen(act)
            elif isinstance(act, Wait):
                self.now += act.seconds
            elif isinstance(act, Tune):
                self.line = act.line
            elif isinstance(act, PowerCycle):
                answer = self.power
                if self.power:
                    self.state = power_on(self.stored(self.state.eeprom), init_switch=act.init_switch, now=self.now)

    def _listen(self, act: SendBytes) -> BytesHeard:
        heard = b""
        pieces = list(act.pieces)
        if self.state.ram.protocol is Protocol.MODBUS_RTU:  # silence ends a request
            for at in range(len(pieces) - 1, 0, -1):
                if not pieces[at][0]:
                    pieces[at - 1 : at + 1] = [(pieces[at - 1][0], pieces[at - 1][1] + pieces[at][1])]
        for pause, wire in pieces:
            self.sent.append(wire)
            self.now += pause + 0.001 * len(wire)
            if self.line == self.state.ram.line_settings:
                heard += b"".join(self._answer(frame) or b"" for frame in self._frames(wire))
        self.now += 0.05 if heard else act.seconds
        return BytesHeard(((0.01, heard),) if heard else (), self.now)

    def _frames(self, wire: bytes) -> Iterable[bytes]:
        if self.state.ram.protocol is Protocol.MODBUS_RTU:
            return [wire] if wire else []
        frames, self.text = dcon.split(self.text + wire)
        return [frame for frame in frames if isinstance(frame, bytes)]

    def _answer(self, frame: bytes) -> bytes | None:
        self.state, wire = self.firmware(self.state, frame, self.connected.at(self.now), self.now)
        return wire


def memory(model: Model, firmware: str | None = None, **changes: Any) -> Eeprom:
    """Return the memory of a module that speaks DCON, with changes."""
    made = factory(model, None if firmware is None else Firmware(firmware))
    return evolve(made, **{"protocol": Protocol.DCON, **changes})


def checked(
    select: Iterable[str],
    eeprom: Eeprom,
    firmware: Step = step,
    *,
    allowed: frozenset[Hazard] = ALL,
    bench: Bench | None = None,
) -> dict[str, CheckResult]:
    """Return what became of the selected checks of a module, by their ids."""
    state = power_on(eeprom, now=0.0)
    bench = bench or Bench(state, firmware, line=state.ram.line_settings)
    wanted = selected(STATEMENTS, select)
    statements = [it for it in STATEMENTS.values() if it.id in wanted]
    planned = plan(statements, state.profile, eeprom.protocol, allowed)
    found = Run(planned, eeprom, Options(allowed=allowed), line=state.ram.line_settings, checksum=state.ram.checksum)
    bench.drive(found.procedure())
    return {result.id: result for result in found.results}


def undone(results: dict[str, CheckResult]) -> dict[str, tuple[Verdict, str]]:
    """Return what neither passed, nor is open, nor does not concern the module."""
    good = (Verdict.PASS, Verdict.INFO)
    return {
        it.id: (it.verdict, it.text)
        for it in results.values()
        if it.verdict not in good and not (it.reason and it.reason.value == "not-applicable")
    }


def failing(results: dict[str, CheckResult]) -> set[str]:
    """Return the ids of what failed."""
    return {it.id for it in results.values() if it.verdict is Verdict.FAIL}


# --- faulty firmwares -------------------------------------------------------------------------------------------------


def answering(answer: Answer) -> Step:
    """Return a firmware that does what the model does, but answers otherwise."""

    def altered(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
        after, wire = step(state, frame, signals, now)
        return after, answer(frame, wire)

    return altered


def hearing(heard: Callable[[bytes], bytes]) -> Step:
    """Return a firmware that takes a frame for another one."""
    return lambda state, frame, signals, now: step(state, heard(frame), signals, now)


def replaced(pattern: bytes, by: bytes) -> Step:
    """Return a firmware that takes what matches a pattern for something else."""
    return hearing(lambda frame: re.sub(pattern, by, frame))


def refusing(pattern: bytes) -> Step:
    """Return a firmware that refuses, and does not carry out, frames that a pattern begins."""

    def altered(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
        if re.match(pattern, frame):
            return state, b"?%02X\r" % state.ram.address
        return step(state, frame, signals, now)

    return altered


def acknowledging(pattern: bytes) -> Step:
    """Return a firmware that acknowledges frames that a pattern begins, and does nothing."""

    def altered(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
        if re.match(pattern, frame):
            return state, b"!%02X\r" % state.ram.address
        return step(state, frame, signals, now)

    return altered


def saying(pattern: bytes, by: bytes, *, to: bytes = rb"(?!\$..M)") -> Step:
    """Return a firmware whose answers to frames that `to` begins have something else in place of a pattern.

    Without `to`, these are all answers but that with the name, without which nothing else is tested.
    """
    return answering(lambda frame, wire: re.sub(pattern, by, wire) if wire and re.match(to, frame) else wire)


def silent(pattern: bytes) -> Step:
    """Return a firmware that does not answer frames that a pattern begins."""
    return answering(lambda frame, wire: None if re.match(pattern, frame) else wire)


def by_turns(begins: bytes, *steps: Step) -> Step:
    """Return a firmware that is another one each time that it hears a frame that a pattern begins."""
    turns = cycle(steps)

    def turning(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
        return (next(turns) if re.match(begins, frame) else step)(state, frame, signals, now)

    return turning
