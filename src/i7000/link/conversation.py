"""The driver's side of a line as generators, without I/O: the same for threads and for asyncio.

A conversation yields an `Act`, is sent the bytes that a `Read` returned, and returns its result. Who drives it closes
it: a conversation that does not get to its end calls `abandon`.

Laws: the observer is called in the order of things. The first exception of an observer is logged, and then it is not
called again: the line goes on without it.
"""

import logging
from collections.abc import Callable, Generator
from typing import Any, TypeVar

from attrs import evolve, frozen

from i7000.errors import I7000Error, Noise
from i7000.host import Bus, Ended, Late, Outcome, Policy, Rejected, Transmit, abandon, next_deadline, receive, send
from i7000.host.procedures import Ask, BytesHeard, PowerCycle, Procedure, Result, SendBytes, Tell, Tune, Wait
from i7000.link.errors import LinkError
from i7000.link.observed import Abandoned, Asked, Happened, Observed, PowerCycled, Received, Tuned, Written
from i7000.message import Query, Response
from i7000.profile import Profile

__all__ = ["SWITCHED", "Act", "Acts", "Conversation", "Read", "Write"]

R = TypeVar("R", bound=Response)
T = TypeVar("T")

_log = logging.getLogger("i7000.link")


@frozen
class Read:
    """The act of reading what the port has, as soon as there is something, at the latest at a time of the clock."""

    until: float


@frozen
class Write:
    """The act of writing bytes."""

    wire: bytes


Act = Read | Write | Tune | PowerCycle
"""What a conversation needs to be done."""

SWITCHED = b"switched"
"""What is sent for a `PowerCycle` that the port can make; otherwise nothing is."""

Acts = Generator[Act, bytes, T]
"""A conversation that returns T."""


class Conversation:
    """The state of a line, its clock and its observer."""

    def __init__(
        self, bus: Bus[Response], clock: Callable[[], float], observe: Callable[[Observed], object] | None
    ) -> None:
        self.bus = bus
        self.clock = clock
        self.observe = observe
        self._left: Tune | None = None
        """The line settings to go back to."""

    def start(self, acts: Acts[T]) -> Acts[T]:
        """Begin a conversation: first undo what a procedure that did not get to its end left behind."""
        if self._left:
            yield from self.tune(self._left)
            self._left = None
        return (yield from acts)

    def ask(self, command: Query[R], profile: Profile, policy: Policy | None) -> Acts[Result[R]]:
        """Send a request, and return its outcome with all other traffic meanwhile.

        Errors: as `i7000.host.send`.
        """
        before = self.bus.policy
        bus = send(evolve(self.bus, policy=policy) if policy else self.bus, command, profile, self.clock())
        others: list[Rejected | Late | Noise] = []
        outcome: Outcome[R] | None = None
        self._show(Asked(self.clock(), command, profile))
        try:
            while outcome is None:
                heard = yield Read(next_deadline(bus) or 0.0)
                now = self._heard(heard)
                bus, events = receive(bus, heard, now)
                for event in events:
                    if isinstance(event, Transmit):
                        yield Write(event.wire)
                        self._show(Written(now, event.wire))
                    elif isinstance(event, Ended):
                        outcome = event
                    else:
                        others.append(event)
                    self._show(Happened(now, event))
        except BaseException:
            bus = abandon(bus, self.clock())
            self._show(Abandoned(self.clock()))
            raise
        finally:
            self.bus = evolve(bus, policy=before)
        return Result(outcome, tuple(others))

    def wait(self, step: Wait) -> Acts[None]:
        """Wait without a request; what arrives meanwhile is heard."""
        end = self.clock() + step.seconds
        while self.clock() < end:
            heard = yield Read(end)
            now = self._heard(heard)
            self.bus, events = receive(self.bus, heard, now)
            for event in events:
                self._show(Happened(now, event))

    def send_bytes(self, step: SendBytes) -> Acts[BytesHeard]:
        """Send bytes as they are, and return what is heard.

        Special: an echo is dropped where the line has one.
        """
        heard: list[tuple[float, bytes]] = []
        yield from self._listen(max(self.bus.quiet_until, self.bus.heard_at + self.bus.silence), [])
        end = self.clock()
        for pause, wire in step.pieces:
            yield from self._listen(max(end, self.clock()) + pause, heard)
            if wire:
                yield Write(wire)
                self._show(Written(self.clock(), wire))
            end = max(end, self.clock()) + len(wire) * self.bus.character_time
        yield from self._listen(end + step.seconds, heard, step)
        pieces = _without_echo(heard, b"".join(wire for _, wire in step.pieces)) if self.bus.echo else heard
        return BytesHeard(tuple((at - end, data) for at, data in pieces), self.clock())

    def _listen(self, until: float, heard: list[tuple[float, bytes]], step: SendBytes | None = None) -> Acts[None]:
        """Read what comes until a time; with a step, only until its answer is complete."""
        latest = until
        while (now := self.clock()) < latest:
            data = yield Read(latest)
            now = self._heard(data)
            self.bus, events = receive(self.bus, data, now)
            for event in events:
                self._show(Happened(now, event))
            if data:
                heard.append((now, data))
                if step:
                    latest = min(until, now + step.quiet) if data.endswith(step.ends) else until

    def power_cycle(self, step: PowerCycle) -> Acts[bool]:
        """Switch the power off and on, and return whether the port can do that."""
        switched = (yield step) == SWITCHED
        if switched:
            self._show(PowerCycled(self.clock(), step.init_switch))
        return switched

    def tune(self, step: Tune) -> Acts[None]:
        """Change the line settings of the host."""
        if step.line != self.bus.line:
            self.bus = evolve(self.bus, line=step.line)  # first: a cancelled task does not stop the port being changed
            self._show(Tuned(self.clock(), step.line))
            yield step

    def run(self, procedure: Procedure[T], tell: Callable[[object], object] | None) -> Acts[T]:
        """Carry out the steps of a procedure, and return its result.

        Special: a procedure that does not get to its end leaves the line settings as they were before it. What is
            wrong with a step, such as a command that the module does not have, is raised in the procedure.
        """
        before = Tune(self.bus.line)
        answer: Result[Response] | BytesHeard | bool | None = None
        refusal: I7000Error | None = None
        try:
            while True:
                try:
                    step = procedure.throw(refusal) if refusal else procedure.send(answer)
                except StopIteration as end:
                    value: T = end.value
                    return value
                answer, refusal = None, None
                if isinstance(step, Tell):
                    if tell:
                        tell(step.value)
                    continue
                try:
                    answer = yield from self._step(step)
                except LinkError:
                    raise
                except I7000Error as error:
                    refusal = error
        except BaseException:
            self._left = before
            raise
        finally:
            procedure.close()

    def _step(self, step: Ask[Response] | SendBytes | PowerCycle | Tune | Wait) -> Acts[Any]:
        """Carry out a step, and return what the procedure is sent for it."""
        if isinstance(step, Ask):
            return (yield from self.ask(step.command, step.profile, step.policy))
        if isinstance(step, SendBytes):
            return (yield from self.send_bytes(step))
        if isinstance(step, PowerCycle):
            return (yield from self.power_cycle(step))
        if isinstance(step, Tune):
            yield from self.tune(step)
        else:
            yield from self.wait(step)
        return None

    def _heard(self, heard: bytes) -> float:
        """Return the time, after showing bytes."""
        now = self.clock()
        if heard:
            self._show(Received(now, heard))
        return now

    def _show(self, observed: Observed) -> None:
        if self.observe:
            try:
                self.observe(observed)
            except Exception:  # noqa: BLE001 - another's
                self.observe = None
                _log.exception("the observer of a line failed, and is not called again")


def _without_echo(heard: list[tuple[float, bytes]], sent: bytes) -> list[tuple[float, bytes]]:
    """Return what was heard after the echo of the sent bytes, or all of it if it does not begin with them."""
    if not b"".join(data for _, data in heard).startswith(sent):
        return heard
    found, left = [], len(sent)
    for at, data in heard:
        if rest := data[left:]:
            found.append((at, rest))
        left = max(0, left - len(data))
    return found
