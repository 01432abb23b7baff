"""The state of a line and the four functions that drive it, with all timing (manual 2, 3).

A driver moves bytes and sleeps. It writes the bytes of `send` and `Transmit`, passes what it reads to `receive`, and
calls `wake` at the time of `next_deadline`. Times are seconds of one clock that never goes back.

Laws: one request is open at a time, and it ends in exactly one outcome, by `receive` or by `wake`. Only frames that
arrive while the request waits can answer it. After a deadline the line stays silent for a while: a late response that
arrives then cannot be mistaken for the response to the next request (``>`` responses have no address). For this, pass
all received bytes to `receive` before the next `send`.
"""

from collections.abc import Iterable
from math import inf
from types import NoneType
from typing import Any, Generic, Never, TypeVar, overload

from attrs import evolve, field

from i7000 import dcon, modbus
from i7000.arguments import LARGEST_FLOAT, as_bytes, check_clock, check_fields, check_seconds, check_type, is_number
from i7000.errors import DecodeError, InvalidValueError, Noise, StateError
from i7000.frozen import frozen
from i7000.host.events import AnyCommand, Event, Late, Rejected, Sent, TimedOut, Transmit
from i7000.host.exchange import Exchange, answers, finish, split
from i7000.profile import Profile
from i7000.settings import BaudRate, LineSettings

__all__ = ["Bus", "Policy", "next_deadline", "receive", "send", "wake"]

R = TypeVar("R")
RD = TypeVar("RD", bound=dcon.Response)
RM = TypeVar("RM", bound=modbus.Response)

_SILENT_CHARACTERS = 3.5
_SHORTEST_SILENCE = 0.00175
"""The shortest silence in seconds: the value of the Modbus specification for lines faster than 19200."""


@frozen(kw_only=True)
class Policy:
    """The timeouts and retries of a host.

    Shape: `retries` is how often a request without a response is sent again; the module may then carry it out again.
        `turnaround` is the longest time from the last character of a request to the first of its response. It includes
        the time of the module (not in the manual), its response delay (40488), and the delays of adapters, operating
        system and network. `grace` is how long the line stays silent after a deadline; a response that arrives even
        later can be mistaken for another one.
    Unit: seconds.
    Range: 0 or more.
    Errors: `InvalidValueError` beyond the range.

    >>> Policy()
    Policy(retries=2, turnaround=0.2, grace=0.2)
    """

    retries: int = 2
    turnaround: float = 0.2
    grace: float = 0.2

    def __attrs_post_init__(self) -> None:
        if not isinstance(self.retries, int) or isinstance(self.retries, bool) or self.retries < 0:
            raise InvalidValueError("retries", self.retries, "0 or more", "")
        for name, value in (("turnaround", self.turnaround), ("grace", self.grace)):
            if not is_number(value) or value < 0:
                raise InvalidValueError(name, value, "seconds, 0 or more", "")


@frozen
class Pending(Generic[R]):
    """A request without an outcome yet."""

    exchange: Exchange[R]
    retries: int
    """The number of retries left."""
    due: float
    """The time to send the request; after that, its deadline."""
    latest: float = inf
    """The time to send the request even if the line is not silent."""
    sent: bool = False
    echoed: bool = False
    """Whether the echo was received, or none is expected."""


@frozen
class Bus(Generic[R]):
    """A line with modules; R is the type of the expected response. A new one is ``Bus[Any]()``.

    Shape: `line`, `policy` and `echo` may be changed with `attrs.evolve` between requests; the other fields are the
        state.
    Errors: `InvalidValueError` for a field of another type, an undefined baud rate, and a time that is not finite.
    """

    line: LineSettings = field(factory=LineSettings)
    policy: Policy = field(factory=Policy)
    echo: bool = False
    """Whether the adapter echoes sent bytes, as some 2-wire adapters do. The echo is dropped, and no frame before it is
    accepted as the response. Without this setting, the echo of a Modbus write is accepted as its response, and so is
    that of `i7000.modbus.ReadChannelMask` if a 00 follows: the echo is a valid response to them.
    """

    pending: Pending[R] | None = None
    last: Exchange[Any] | None = None
    """The last request sent: its response may still arrive."""
    rest: bytes = b""
    """The received bytes that may still become a frame."""
    heard_at: float = -LARGEST_FLOAT
    """The end of the last character on the line, sent or received."""
    quiet_until: float = -LARGEST_FLOAT
    """The end of the pause before the next request."""
    clock: float = field(default=-LARGEST_FLOAT, eq=False, repr=False)
    """The time of the last call; it is not part of equality."""

    def __attrs_post_init__(self) -> None:
        check_fields(self, _KINDS)
        for name in _TIMES:
            check_seconds(name, getattr(self, name))
        if not isinstance(self.line.baud_rate, BaudRate):
            raise InvalidValueError("baud_rate", f"{self.line.baud_rate:02X}", "03..0A", "1.11")

    @property
    def character_time(self) -> float:
        """The length of a character on the line in seconds."""
        return self.line.character_format.bits / BaudRate(self.line.baud_rate).bits_per_second

    @property
    def silence(self) -> float:
        """The silence between Modbus frames in seconds: 3.5 characters."""
        return max(_SILENT_CHARACTERS * self.character_time, _SHORTEST_SILENCE)


_KINDS: dict[str, tuple[type, ...]] = {
    "line": (LineSettings,),
    "policy": (Policy,),
    "echo": (bool,),
    "pending": (Pending, NoneType),
    "last": (Exchange, NoneType),
    "rest": (bytes,),
}
"""The types of the fields of `Bus` that are not times."""
_TIMES = ("heard_at", "quiet_until", "clock")
_FIELDS = (*_KINDS, *_TIMES)


def _changed(bus: Bus[Any], **changes: Any) -> Bus[Any]:  # noqa: ANN401 - fields of `Bus`
    """Return a changed copy without the checks of `evolve`."""
    copy = object.__new__(Bus)
    for name in _FIELDS:
        object.__setattr__(copy, name, changes[name] if name in changes else getattr(bus, name))
    return copy


@overload
def send(bus: Bus[Any], command: dcon.Command[RD], profile: Profile, now: float) -> tuple[Bus[RD], bytes]: ...
@overload
def send(bus: Bus[Any], command: modbus.Request[RM], profile: Profile, now: float) -> tuple[Bus[RM], bytes]: ...
@overload
def send(bus: Bus[Any], command: dcon.Broadcast, profile: Profile, now: float) -> tuple[Bus[Never], bytes]: ...
def send(bus: Bus[Any], command: AnyCommand, profile: Profile, now: float) -> tuple[Bus[Any], bytes]:
    r"""Open a request and return the bytes to write now; empty during a pause, then `wake` returns them later.

    Special: for a broadcast, only the checksum setting of `profile` is used. An incomplete frame received so far is
        dropped.
    Errors: `EncodeError` if the module does not have the command; `InvalidValueError` for a time that is not finite;
        `StateError` if the previous request has no outcome yet, and for a time before the last call.
    Manual: 2, 3.

    >>> from i7000 import Model
    >>> bus, wire = send(Bus[Any](), dcon.ReadConfiguration(0x01), Profile(Model.I_7018), 0.0)
    >>> wire
    b'$012\r'
    >>> receive(bus, b"!01050600\r", 0.1)[1][0].response.type_code
    <TypeCode.V_2_5: 5>
    """
    check_type("bus", bus, Bus)
    check_type("command", command, dcon.Command, dcon.Broadcast, modbus.Request)
    check_type("profile", profile, Profile)
    check_clock(now, bus.clock)
    if bus.pending:
        raise _still_open(bus.pending, now)
    exchange = Exchange[Any].of(command, profile)
    due = max(now, bus.quiet_until, bus.heard_at + _silence(bus, exchange))
    pending = Pending(exchange, bus.policy.retries, due, due + _allowance(bus, exchange))
    bus, events = _transmit(_changed(bus, pending=pending, clock=now), now)
    return bus, b"".join(event.wire for event in events)


def _still_open(request: Pending[Any], now: float) -> StateError:
    command = request.exchange.command
    to = "all" if isinstance(command, dcon.Broadcast) else f"{command.address:02X}"
    what = f"{type(command).__name__} to {to}, due in {max(0.0, request.due - now):.2f} s"
    return StateError(f"a request is still open ({what}): call receive() or wake() until it ends")


def receive(bus: Bus[R], data: bytes, now: float) -> tuple[Bus[R], tuple[Event[R], ...]]:
    """Process received bytes, in any pieces, and return the events.

    Shape: the events are in the order in which things happened.
    Errors: `InvalidValueError` for a time that is not finite; `StateError` for a time before the last call.
    Manual: 2, 3.
    """
    check_type("bus", bus, Bus)
    data = as_bytes("data", data)
    check_clock(now, bus.clock)
    events: tuple[Event[R], ...] = ()
    if data:
        if bus.pending and bus.pending.due < now:
            bus, events = _expire(bus, bus.pending)
        bus, heard = _hear(bus, data, now)
        events += heard
    elif now != bus.clock:
        bus = _changed(bus, clock=now)
    if bus.pending and bus.pending.due <= now:
        bus, over = _expire(bus, bus.pending)
        events += over
    bus, sent = _transmit(bus, now)
    return bus, (*events, *sent)


def wake(bus: Bus[R], now: float) -> tuple[Bus[R], tuple[Event[R], ...]]:
    """Return the events caused by the time; call it at `next_deadline`. Calling it earlier is harmless.

    >>> from i7000 import Model
    >>> bus, wire = send(Bus[Any](policy=Policy(retries=0)), dcon.HostOk(), Profile(Model.I_7018), 0.0)
    >>> wake(bus, next_deadline(bus))[1]
    (Sent(command=HostOk()),)
    """
    return receive(bus, b"", now)


def next_deadline(bus: Bus[Any]) -> float | None:
    """Return the time to call `wake`, even if no byte arrives; None if no request is open."""
    check_type("bus", bus, Bus)
    return bus.pending.due if bus.pending else None


# --- the steps --------------------------------------------------------------------------------------------------------


def _silence(bus: Bus[Any], exchange: Exchange[Any]) -> float:
    """Return the silence that `exchange` needs before it: before and after RTU frames."""
    return bus.silence if exchange.rtu or (bus.last and bus.last.rtu) else 0.0


def _allowance(bus: Bus[Any], exchange: Exchange[Any]) -> float:
    """Return the time from sending a request to its deadline.

    Special: the Modbus specification requires time for the modules after a broadcast too.
    """
    characters = len(exchange.wire) + exchange.longest_response
    turnaround = bus.policy.turnaround if exchange.answered or exchange.rtu else 0.0
    return characters * bus.character_time + turnaround + exchange.pause


def _transmit(bus: Bus[R], now: float) -> tuple[Bus[R], tuple[Transmit, ...]]:
    """Send the open request if it is time."""
    if not bus.pending or bus.pending.sent or now < bus.pending.due:
        return bus, ()
    exchange = bus.pending.exchange
    end = now + len(exchange.wire) * bus.character_time
    sent = evolve(bus.pending, sent=True, due=now + _allowance(bus, exchange), echoed=not bus.echo)
    bus = _changed(bus, pending=sent, last=exchange, rest=b"", heard_at=end, quiet_until=end + exchange.pause)
    return bus, (Transmit(exchange.wire),)


def _hear(bus: Bus[R], data: bytes, now: float) -> tuple[Bus[R], tuple[Event[R], ...]]:
    found, rest = split(bus.last, bus.rest + data, echo=bus.echo)
    bus = _changed(bus, rest=rest, heard_at=max(bus.heard_at, now), clock=now)
    if bus.pending and not bus.pending.sent:
        silent = min(now + _silence(bus, bus.pending.exchange), bus.pending.latest)
        bus = _changed(bus, pending=evolve(bus.pending, due=max(bus.pending.due, silent)))
    bus, events = _take(bus, found)
    bus, ahead = _take_ahead(bus)
    return bus, (*events, *ahead)


def _take_ahead(bus: Bus[R]) -> tuple[Bus[R], tuple[Event[R], ...]]:
    """Accept a response that is held back because its bytes could still become a longer frame."""
    request = bus.pending
    if not (bus.rest and request and request.sent and request.echoed):
        return bus, ()
    found, rest = answers(request.exchange, bus.rest)
    return _take(_changed(bus, rest=rest), found)


def _take(bus: Bus[R], found: Iterable[bytes | Noise]) -> tuple[Bus[R], tuple[Event[R], ...]]:
    """Return the events of frames and noise, in order."""
    events: list[Event[R]] = []
    for frame in found:
        request = bus.pending
        if isinstance(frame, Noise):
            events.append(frame)
        elif not request or not request.sent:
            events.append(Late(frame))
        elif not request.echoed and frame.startswith(request.exchange.wire):
            bus = _changed(bus, pending=evolve(request, echoed=True))
            surplus = frame[len(request.exchange.wire) :]  # a CRC stays good when 00 follows
            bus, after = _take(bus, finish(request.exchange, surplus, echo=False))
            events += after
        elif not request.echoed or not request.exchange.answered:
            events.append(Late(frame))
        else:
            try:
                events.append(request.exchange.read(frame))
            except DecodeError as error:
                events.append(Rejected(frame, error.fault, str(error)))
            else:
                bus = _changed(bus, pending=None)
    return bus, tuple(events)


def _expire(bus: Bus[R], request: Pending[R]) -> tuple[Bus[R], tuple[Event[R], ...]]:
    """End an attempt at its deadline; frames that only the silence completes count."""
    if not request.sent:
        return bus, ()
    bus, events = _take(_changed(bus, rest=b""), finish(request.exchange, bus.rest, echo=bus.echo))
    if not bus.pending:
        return bus, events
    if not request.exchange.answered:
        return _changed(bus, pending=None), (*events, Sent(request.exchange.command))
    over = request.due + bus.policy.grace
    if not request.retries:
        return _changed(bus, pending=None, quiet_until=over), (*events, TimedOut(request.exchange.command))
    due = max(over, bus.heard_at + _silence(bus, request.exchange))
    again = Pending(request.exchange, request.retries - 1, due, due + _allowance(bus, request.exchange))
    return _changed(bus, pending=again), events
