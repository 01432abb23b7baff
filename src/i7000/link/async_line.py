"""A line for programs with an event loop: requests and procedures of any number of tasks on one port.

Laws: the port is read and written in a thread of its own, so that every port works: on Windows, on networks, in virtual
time. Everything else happens in the event loop: the state of the line, the observer, the procedures. At most one call
of the thread is waiting, and each ends within `SLICE` seconds, except a `write` that the port holds up.
"""

import asyncio
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from types import TracebackType
from typing import Self, TypeVar, Unpack

from i7000.errors import I7000Error
from i7000.host import Bus, Outcome, Policy
from i7000.host.procedures import PowerCycle, Procedure, Tune, Wait
from i7000.link.conversation import SWITCHED, Act, Acts, Conversation, Read, Write
from i7000.link.errors import LinkError
from i7000.link.observed import Observed
from i7000.link.port import Port, clock_of, close, power_cycle, read, tune, write
from i7000.link.target import TargetOptions, open_target
from i7000.link.worker import Worker
from i7000.message import Query, Response
from i7000.profile import Profile
from i7000.settings import LineSettings

__all__ = ["CLOSING", "SLICE", "AsyncLine"]

R = TypeVar("R", bound=Response)
T = TypeVar("T")

SLICE = 0.05
"""The longest time in seconds of one read: after a cancelled task, the next request waits so long at most."""
CLOSING = 2.0
"""The longest time in seconds that `close` waits for a port that is held up."""


class AsyncLine:
    """A port with modules, for tasks of asyncio; an asynchronous context manager that closes the port at its end.

    Shape: the arguments are those of `i7000.link.Line`. `observe` is called in the event loop.
    Time: requests of several tasks are carried out in the order of their calls. A procedure has the line for itself
        until its end.
    Special: a cancelled task ends its request without an outcome, and the line stays usable; its late response is not
        taken for another one. `close` ends the requests of other tasks with `LinkError`.
    Errors: as `i7000.link.Line`.
    """

    def __init__(  # noqa: PLR0913 - all but the port are options
        self,
        port: Port,
        line: LineSettings = LineSettings(),  # noqa: B008 - frozen
        policy: Policy = Policy(),  # noqa: B008 - frozen
        *,
        echo: bool = False,
        clock: Callable[[], float] | None = None,
        observe: Callable[[Observed], object] | None = None,
    ) -> None:
        self.port = port
        bus = Bus[Response](line, policy, echo=echo)
        self._conversation = Conversation(bus, clock or clock_of(port), observe)
        self._turn = asyncio.Lock()
        self._reading: asyncio.Future[bytes] | None = None
        """A read whose bytes nobody has heard yet."""
        self._failure = ""
        """Why the line is closed."""
        tune(port, line)
        self._worker = Worker()

    @classmethod
    async def open(
        cls,
        target: str,
        line: LineSettings = LineSettings(),  # noqa: B008 - frozen
        policy: Policy = Policy(),  # noqa: B008 - frozen
        *,
        echo: bool = False,
        observe: Callable[[Observed], object] | None = None,
        **options: Unpack[TargetOptions],
    ) -> Self:
        """Open what a text names, see `i7000.link.open_target`, without holding up the event loop.

        Errors: `LinkError`, `InvalidValueError`.
        """
        opening = Worker()
        future = opening.call(partial(open_target, target, line, **options))
        opening.end()
        try:
            await asyncio.wait((future,))
        except asyncio.CancelledError:
            future.add_done_callback(_close_unused)
            raise
        port = future.result()
        try:
            return cls(port, line, policy, echo=echo, observe=observe)
        except BaseException:
            close(port)
            raise

    @property
    def line(self) -> LineSettings:
        """The line settings of the host now."""
        return self._conversation.bus.line

    @property
    def policy(self) -> Policy:
        """The timeouts and retries of requests without their own."""
        return self._conversation.bus.policy

    async def ask(self, command: Query[R], profile: Profile, policy: Policy | None = None) -> Outcome[R]:
        """Send a command or request when it is its turn, and return its outcome; `policy` is for this one."""
        return (await self._drive(self._conversation.ask(command, profile, policy))).outcome

    async def run(self, procedure: Procedure[T], tell: Callable[[object], object] | None = None) -> T:
        """Carry out a procedure of `i7000.host.procedures`, and return its result.

        Shape: `tell` is called with the value of each step `Tell`: findings and progress.
        Special: line settings that a procedure changed stay, unless it did not get to its end.
        """
        return await self._drive(self._conversation.run(procedure, tell))

    async def tune(self, line: LineSettings) -> None:
        """Change the line settings of the host."""
        await self._drive(self._conversation.tune(Tune(line)))

    async def wait(self, seconds: float) -> None:
        """Keep the line for so many seconds without a request; what arrives meanwhile is late."""
        await self._drive(self._conversation.wait(Wait(seconds)))

    async def close(self) -> None:
        """Close the port."""
        await self._end("the line is closed")

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None
    ) -> None:
        await self.close()

    async def _drive(self, acts: Acts[T]) -> T:
        async with self._turn:
            acts = self._conversation.start(acts)
            try:
                act = next(acts)
                while True:
                    try:
                        done = await self._do(act)
                    except LinkError:
                        raise
                    except I7000Error as refusal:
                        act = acts.throw(refusal)
                    else:
                        act = acts.send(done)
            except StopIteration as end:
                value: T = end.value
                return value
            except LinkError as error:
                await self._end(str(error))
                raise
            finally:
                acts.close()

    async def _do(self, act: Act) -> bytes:
        if self._failure:
            raise LinkError(self._failure)
        if isinstance(act, Read):
            return await self._read(act.until)
        if isinstance(act, Write):
            await self._called(partial(write, self.port, act.wire))
        elif isinstance(act, PowerCycle):
            switched: list[bool] = []
            await self._called(lambda: switched.append(power_cycle(self.port, init_switch=act.init_switch)))
            return SWITCHED if switched[0] else b""
        else:
            await self._called(partial(tune, self.port, act.line))
        return b""

    async def _called(self, function: Callable[[], None]) -> None:
        """Carry out a call in the thread, to its end even if the task is cancelled."""
        calling = self._worker.call(function)
        await asyncio.wait((calling,))
        calling.result()

    async def _read(self, until: float) -> bytes:
        """Return what was read; a cancelled task leaves the read to the next request."""
        if self._reading is None:
            seconds = min(SLICE, max(0.0, until - self._conversation.clock()))
            self._reading = self._worker.call(partial(read, self.port, seconds))
        await asyncio.wait((self._reading,))
        reading, self._reading = self._reading, None
        return reading.result()

    async def _end(self, failure: str) -> None:
        """Close the port after the call that is being carried out."""
        if not self._failure:
            self._failure = failure
            self._closing = self._worker.call(partial(close, self.port))
            self._worker.end()
        await asyncio.wait((self._closing,), timeout=CLOSING)


def _close_unused(opening: "asyncio.Future[Port]") -> None:
    with suppress(Exception):
        close(opening.result())
