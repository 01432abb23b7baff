"""A run of ``i7000 fuzz``: frames, sentinels, and the search for the fewest frames that make the module fail.

Laws: nothing is sent but through the guard, the identification included. The same seed sends the same frames to the
same module.
"""

import json
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

from attrs import define, evolve, field, frozen

from i7000 import Protocol
from i7000.cli.asked import LEFT_CHANGED, Asked
from i7000.cli.choices import SPOKEN
from i7000.cli.keeping import home_of
from i7000.cli.progress import Draw, note_estimate, progress
from i7000.cli.reached import OpenLine, Reached, reach
from i7000.cli.reached import run as run_at_port
from i7000.cli.text import Printer
from i7000.conformance import GuardError
from i7000.conformance.fuzzing import fewest, near_miss, reads, sentinel
from i7000.errors import written
from i7000.host import Answered
from i7000.host.procedures import Snapshot, ask, diff, snapshot
from i7000.link import GuardedPort, Line, VirtualPort
from i7000.link.port import clock_of, read, write
from i7000.message import Query, Response

__all__ = ["Plan", "run"]

_EVERY = 20
"""The number of frames between two sentinels."""
_MOST_TRIES = 200
_FIRST = 200
"""The frames whose time is estimated; the others take as long."""
_QUIET = 0.02
"""The seconds without a byte after which an answer is over."""
_MOST_HEARD = 4096
_NOTHING_SENT = 5


@frozen
class Plan:
    """What to do."""

    asked: Asked
    seed: int
    frames: int
    max_time: float | None
    report: Path | None


def run(plan: Plan) -> int:
    """Carry out a plan, and return the exit code.

    Errors: `UsageError`, `LineError`.
    """
    printer = Printer()
    return run_at_port(plan.asked, lambda open_line: _fuzz(open_line, plan, printer), guard=GuardedPort)


@define
class _Run:
    """A run on an open line."""

    module: Reached
    sentinel: Query[Response]
    wait: float
    """The seconds in which an answer to a frame begins."""
    first: Response | None = None
    sent: int = 0
    refused: int = 0
    since: list[bytes] = field(factory=list)
    """The frames since the last sentinel that was answered."""

    @property
    def port(self) -> Any:  # noqa: ANN401 - a guarded port
        """The port of the line."""
        return self.module.open.line.port

    def answer(self) -> Response | None:
        """Return the answer to the sentinel; None if it is not carried out."""
        outcome = self.module.open.finish(ask(self.sentinel, self.module.profile)).outcome
        return outcome.response if isinstance(outcome, Answered) else None

    def settings(self) -> Snapshot:
        """Read all settings; what the guard refuses is not read."""
        module = self.module
        return module.open.run(snapshot(module.address, module.profile, module.protocol))

    def settings_again(self) -> Snapshot:
        """Read all settings again, after a restart if the port can do that."""
        if hasattr(self.port, "power_cycle"):
            self.port.power_cycle()
        return self.settings()

    def send(self, wire: bytes) -> bool:
        """Send a frame and drop what comes; return False if the guard refuses it."""
        try:
            write(self.port, wire)
        except GuardError:
            return False
        clock = clock_of(self.port)
        end, heard = clock() + self.wait + len(wire) * 11 / self.port.baudrate, 0
        while heard < _MOST_HEARD and (left := end - clock()) > 0:
            got = read(self.port, left)
            heard += len(got)
            end = clock() + _QUIET if got else end
        return True

    def is_lost(self) -> str:
        """Return how the sentinel fails: ``silent``, ``changed``, or an empty text."""
        if self.module.protocol is Protocol.DCON:
            self.send(b"\r")  # what is unfinished would make the sentinel a part of it
        answer = self.answer()
        return "" if answer == self.first else "silent" if answer is None else "changed"


def _fuzz(open_line: OpenLine, plan: Plan, printer: Printer) -> int:
    module = reach(open_line, plan.asked, printer.note)
    this = _Run(module, sentinel(module.protocol, module.address), plan.asked.policy.turnaround)
    before = this.settings()
    with open_line.ending.breakable():
        this.first = this.answer()
        if this.first is None:
            printer.error(f"{module.words} does not answer {type(this.sentinel).__name__}")
            return 3
        limit = plan.max_time
        note_estimate(printer, plan.asked.target, lambda: _estimated(this, plan, before), limit)
        with progress(printer, plan.frames) as draw:
            outcome = _send_all(this, plan, draw)
    text = f"{this.sent} frames sent, {this.refused} left out by the guard"
    if not outcome and (changes := _changes(before, this.settings())):
        printer.error(f"{module.words} has other settings after {text}: {', '.join(changes)}")
        return LEFT_CHANGED if _changes(before, this.settings_again()) else 1
    if not outcome:
        printer.record({"sent": this.sent, "refused": this.refused}, [[(f"{module.words}: {text}, all answered", "")]])
        return 0 if this.sent else _NOTHING_SENT
    printer.error(f"{module.words} is {outcome} after {text}")
    with open_line.ending.breakable():
        case = _case(this, plan, outcome, printer)
    words = json.dumps(case, indent=1)
    printer.write(words)
    printer.flush()
    if plan.report is not None:
        with plan.report.open("x", encoding="utf-8") as file:
            file.write(f"{words}\n")
    changes = _changes(before, this.settings())
    if changes:
        printer.error(f"{module.words} has other settings now: {', '.join(changes)}")
    return LEFT_CHANGED if outcome == "changed" or changes else 1


def _changes(before: Snapshot, after: Snapshot) -> list[str]:
    """Return the settings that were read both times and differ, in words."""
    return [
        f"{it.name} was {it.before}, is {it.after}"
        for it in diff(before, after)
        if it.before is not None and it.after is not None
    ]


def _estimated(this: _Run, plan: Plan, before: Snapshot) -> float:
    """Return how long a plan takes: in proportion to its first frames on a simulated module, in virtual time."""
    module = this.module
    settings, policy = module.open.line.line, module.open.line.policy
    port = VirtualPort([home_of(before, module).state], line=settings)
    frames = min(plan.frames, _FIRST)
    with Line(GuardedPort(port), settings, policy) as line:
        there = Reached(evolve(module.open, line=line), module.address, module.protocol, module.profile)
        dry = _Run(there, this.sentinel, this.wait)
        dry.first = dry.answer()
        _send_all(dry, evolve(plan, frames=frames, max_time=None), lambda _steps, _words: None)
    return port.now() * plan.frames / frames


def _send_all(this: _Run, plan: Plan, draw: Draw) -> str:
    """Send the frames of a plan; return how the sentinel failed, or an empty text."""
    chance = Random(plan.seed).randrange  # noqa: S311 - repeatable
    module, clock = this.module, clock_of(this.port)
    frames = reads(module.profile, module.protocol, module.address)
    until = None if plan.max_time is None else clock() + plan.max_time
    for _ in range(plan.frames):
        if until is not None and clock() >= until:
            break
        wire = near_miss(frames, module.protocol, chance)
        draw(1, f"{this.refused} left out by the guard")
        if not this.send(wire):
            this.refused += 1
            continue
        this.sent += 1
        this.since.append(wire)
        if len(this.since) == _EVERY:
            if outcome := this.is_lost():
                return outcome
            this.since.clear()
    return this.is_lost() if this.since else ""


def _case(this: _Run, plan: Plan, outcome: str, printer: Printer) -> dict[str, object]:
    frames, tries, reproduced = tuple(this.since), 0, False
    if hasattr(this.port, "power_cycle"):
        fails: Callable[[tuple[bytes, ...]], bool] = lambda tried: _fails(this, tried)  # noqa: E731
        reproduced = _restarts(this) and fails(frames)
        if reproduced:
            printer.note(f"looking for the fewest frames that make it fail: at most {_MOST_TRIES} tries")
            search = fewest(frames, _MOST_TRIES)
            with progress(printer, _MOST_TRIES) as draw:
                try:
                    less = next(search)
                    while True:
                        draw(1, f"{len(less)} frames")
                        less = search.send(fails(less))
                except StopIteration as end:
                    frames, tries = end.value
    module = this.module
    return {
        "record": "fuzz-case",
        "schema_version": 1,
        "target": plan.asked.target,
        "address": module.address,
        "protocol": SPOKEN[module.protocol],
        "profile": module.profile.name,
        "seed": plan.seed,
        "outcome": outcome,
        "sentinel": type(this.sentinel).__name__,
        "frames": [wire.hex() for wire in frames],
        "text": [written(wire) for wire in frames],
        "reproduced": reproduced,
        "tries": tries,
    }


def _restarts(this: _Run) -> bool:
    """Restart the module, and return whether it answers as at the start."""
    this.port.power_cycle()
    return this.answer() == this.first


def _fails(this: _Run, frames: tuple[bytes, ...]) -> bool:
    """Return whether a restarted module fails after frames; False if it does not start, or the guard refuses one."""
    return _restarts(this) and all(map(this.send, frames)) and bool(this.is_lost())
