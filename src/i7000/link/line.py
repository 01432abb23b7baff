"""A line for a program without an event loop: requests and procedures on a port, one after the other."""

from collections.abc import Callable
from threading import Lock
from types import TracebackType
from typing import Self, TypeVar, Unpack

from i7000.errors import I7000Error, StateError
from i7000.host import Bus, Outcome, Policy
from i7000.host.procedures import PowerCycle, Procedure, Tune, Wait
from i7000.link.conversation import SWITCHED, Act, Acts, Conversation, Read, Write
from i7000.link.errors import LinkError
from i7000.link.observed import Observed
from i7000.link.port import Port, clock_of, close, power_cycle, read, tune, write
from i7000.link.target import TargetOptions, open_target
from i7000.message import Query, Response
from i7000.profile import Profile
from i7000.settings import LineSettings

__all__ = ["Line"]

R = TypeVar("R", bound=Response)
T = TypeVar("T")


class Line:
    """A port with modules; a context manager that closes the port at its end.

    Shape: `port` is a `serial.Serial`, a `VirtualPort`, or anything with the methods of `i7000.link.Port`; it gets the
        settings of `line`. `policy` has timeouts and retries. `echo` is whether the adapter echoes sent bytes. `clock`
        is that of the port if it has one (`VirtualPort.now`), or else `time.monotonic`.
        `observe` is called with every byte in and out and every event, see `i7000.link.Observed`.
    Time: every call ends: a request by its timeout and its retries, a procedure by its own law.
    Special: `observe` is called in the thread of the line, between two reads: one that is slow makes responses look
        late, never wrong. If it raises an exception, that is logged, and it is not called again.
        Ctrl-C and other exceptions during a request end it without an outcome, and leave the line usable. A lost port
        closes the line. A line is for one thread at a time.
    Errors: `LinkError` (an `OSError`) for a port that is lost or closed, once and for all later calls; `EncodeError`
        for a command that the module does not have; `StateError` for a call during another one.

    >>> from i7000 import Model, Unit, dcon
    >>> from i7000.device import Signals, factory, power_on
    >>> from i7000.link import VirtualPort
    >>> module = power_on(factory(Model.I_7018), now=0.0)
    >>> with Line(VirtualPort([module], [Signals.of(Unit.VOLT, 1.5)])) as line:
    ...     line.ask(dcon.ReadAnalogInput(0x01, 0), Profile(Model.I_7018)).response
    AnalogInput(value='+1.5000')
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
        self._in_use = Lock()
        self._failure = ""
        """Why the line is closed."""
        tune(port, line)

    @classmethod
    def open(
        cls,
        target: str,
        line: LineSettings = LineSettings(),  # noqa: B008 - frozen
        policy: Policy = Policy(),  # noqa: B008 - frozen
        *,
        echo: bool = False,
        observe: Callable[[Observed], object] | None = None,
        **options: Unpack[TargetOptions],
    ) -> Self:
        """Open what a text names, see `i7000.link.open_target`.

        Errors: `LinkError`, `InvalidValueError`.
        """
        port = open_target(target, line, **options)
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

    def ask(self, command: Query[R], profile: Profile, policy: Policy | None = None) -> Outcome[R]:
        """Send a command or request, and return its outcome; `policy` is for this one.

        Special: ``run(i7000.host.procedures.ask(command, profile))`` returns the other traffic too.
        """
        return self._drive(self._conversation.ask(command, profile, policy)).outcome

    def run(self, procedure: Procedure[T], tell: Callable[[object], object] | None = None) -> T:
        """Carry out a procedure of `i7000.host.procedures`, and return its result.

        Shape: `tell` is called with the value of each step `Tell`: findings and progress.
        Special: line settings that a procedure changed stay, unless it did not get to its end.
        """
        return self._drive(self._conversation.run(procedure, tell))

    def tune(self, line: LineSettings) -> None:
        """Change the line settings of the host."""
        self._drive(self._conversation.tune(Tune(line)))

    def wait(self, seconds: float) -> None:
        """Wait for so many seconds without a request; what arrives meanwhile is late."""
        self._drive(self._conversation.wait(Wait(seconds)))

    def close(self) -> None:
        """Close the port."""
        self._close("the line is closed")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.close()

    def _drive(self, acts: Acts[T]) -> T:
        if self._failure:
            raise LinkError(self._failure)
        if not self._in_use.acquire(blocking=False):
            raise StateError("the line is in use, by another thread or by the caller: wait until its request has ended")
        acts = self._conversation.start(acts)
        try:
            act = next(acts)
            while True:
                try:
                    done = self._do(act)
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
            self._close(str(error))
            raise
        finally:
            acts.close()
            self._in_use.release()

    def _do(self, act: Act) -> bytes:
        if isinstance(act, Read):
            return read(self.port, max(0.0, act.until - self._conversation.clock()))
        if isinstance(act, Write):
            write(self.port, act.wire)
        elif isinstance(act, PowerCycle):
            return SWITCHED if power_cycle(self.port, init_switch=act.init_switch) else b""
        else:
            tune(self.port, act.line)
        return b""

    def _close(self, failure: str) -> None:
        self._failure = self._failure or failure
        close(self.port)
