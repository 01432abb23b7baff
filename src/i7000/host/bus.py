"""The state of a line and the functions that drive it, with all timing (manual 2, 3).

A driver moves bytes and sleeps. It opens a request with `send`. It calls `receive` with the bytes that it reads, and at
the time of `next_deadline` with what it has read by then. It writes the bytes of `Transmit`. Times are seconds of one
clock that never goes back.

Laws: one request is open at a time, and it ends in exactly one outcome, or by `abandon`. Only bytes that arrive after
the request was sent can answer it. A request is sent by a call of `receive` that heard nothing: a driver that passes
all that it reads has emptied its port by then. After a deadline the line stays silent for a while: a late response that
arrives then cannot be mistaken for the response to the next request (``>`` responses have no address).
"""

from collections.abc import Iterable
from math import inf
from types import NoneType
from typing import Any, Generic, TypeVar

from attrs import evolve, field

from i7000.arguments import LARGEST_FLOAT, as_bytes, check_clock, check_fields, check_seconds, check_type, is_number
from i7000.errors import DecodeError, InvalidValueError, Noise, StateError
from i7000.frozen import frozen
from i7000.host.events import Event, Late, Rejected, Sent, TimedOut, Transmit
from i7000.host.exchange import Exchange, answers, finish, prepare, split
from i7000.message import Query, Response
from i7000.profile import Profile
from i7000.settings import BaudRate, LineSettings

__all__ = ["Bus", "Policy", "abandon", "next_deadline", "receive", "send"]

R = TypeVar("R", bound=Response)
R_co = TypeVar("R_co", bound=Response, covariant=True)

_SILENT_CHARACTERS = 3.5
_SHORTEST_SILENCE = 0.00175
"""The shortest silence in seconds: the value of the Modbus specification for lines faster than 19200."""


@frozen(kw_only=True)
class Policy:
    """The timeouts and retries of a host.

    Shape: `retries` is how often a request without a response is sent again; the module may then carry it out again.
        `turnaround` is the longest time from the last character of a request to the first of its response. It includes
        the time of the module (not in the manual), its response delay (40488), and the delays of adapters, operating
        system and network. `grace` is how long the line stays silent after a deadline. A response that arrives even
        later can be mistaken for the response to another request; make it longer if your adapter can delay more.
    Unit: seconds.
    Range: 0 or more.
    Errors: `InvalidValueError` beyond the range.

    >>> Policy()
    Policy(retries=2, turnaround=0.2, grace=1.0)
    """

    retries: int = 2
    turnaround: float = 0.2
    grace: float = 1.0

    def __attrs_post_init__(self) -> None:
        if not isinstance(self.retries, int) or isinstance(self.retries, bool) or self.retries < 0:
            raise InvalidValueError("retries", self.retries, "0 or more", "")
        for name, value in (("turnaround", self.turnaround), ("grace", self.grace)):
            if not is_number(value) or value < 0:
                raise InvalidValueError(name, value, "seconds, 0 or more", "")


@frozen
class Pending(Generic[R_co]):
    """A request without an outcome yet."""

    exchange: Exchange[R_co]
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
class Bus(Generic[R_co]):
    """A line with modules; R_co is the class of the expected response. A new one is ``Bus[Response]()``.

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

    pending: Pending[R_co] | None = None
    last: Exchange[Response] | None = None
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
        """The silence before each request in seconds: 3.5 characters. Modbus needs it; in DCON, it shows duplicates."""
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


def send(bus: Bus[Response], command: Query[R], profile: Profile, now: float) -> Bus[R]:
    r"""Open a request. Its bytes come later, as `Transmit` of `receive`.

    Time: `next_deadline` of the result is 3.5 characters after `now`: so long, the line has to be silent. It is later
        after a timeout and in a pause.
    Special: for a broadcast, only the checksum setting of `profile` is used.
    Errors: `EncodeError` if the module does not have the command; `InvalidValueError` for a time that is not finite;
        `StateError` if the previous request has no outcome yet, and for a time before the last call.
    Manual: 2, 3.

    >>> from i7000 import Model, dcon
    >>> bus = send(Bus[Response](), dcon.ReadConfiguration(0x01), Profile(Model.I_7018), 0.0)
    >>> bus, events = receive(bus, b"", next_deadline(bus))
    >>> events
    (Transmit(wire=b'$012\r'),)
    >>> receive(bus, b"!01050600\r", 0.1)[1][0].response.type_code
    <TypeCode.V_2_5: 5>
    """
    check_type("bus", bus, Bus)
    check_type("command", command, Query)
    check_type("profile", profile, Profile)
    check_clock(now, bus.clock)
    if bus.pending:
        raise _still_open(bus.pending, now)
    exchange = prepare(command, profile)
    due = max(bus.quiet_until, max(now, bus.heard_at) + bus.silence)
    pending = Pending(exchange, bus.policy.retries, due, due + _allowance(bus, exchange))
    return _changed(bus, pending=pending, clock=now)


def _still_open(request: Pending[Response], now: float) -> StateError:
    to = f"{address:02X}" if (address := getattr(request.exchange.command, "address", 0)) else "all"
    what = f"{type(request.exchange.command).__name__} to {to}, due in {max(0.0, request.due - now):.2f} s"
    return StateError(f"a request is still open ({what}): call receive() until it ends, or abandon()")


def receive(bus: Bus[R], heard: bytes, now: float) -> tuple[Bus[R], tuple[Event[R], ...]]:
    """Process received bytes, in any pieces, and the time; return the events in the order in which they happened.

    Call it when bytes arrived, and at `next_deadline` with the bytes read by then. Empty bytes mean that the port has
    nothing to read. Calling it more often is harmless.

    Time: a request is sent by the first call at or after its time that heard nothing. On a line that is never silent,
        it is sent anyway after the time that its response may take.
    Special: the bytes of the first call after a deadline still count: they can hold the response.
    Errors: `InvalidValueError` for a time that is not finite; `StateError` for a time before the last call.
    Manual: 2, 3.

    >>> from i7000 import Model, dcon
    >>> bus = send(Bus[Response](policy=Policy(retries=0)), dcon.HostOk(), Profile(Model.I_7018), 0.0)
    >>> bus, _ = receive(bus, b"", next_deadline(bus))
    >>> receive(bus, b"", next_deadline(bus))[1]
    (Sent(command=HostOk()),)
    """
    check_type("bus", bus, Bus)
    heard = as_bytes("heard", heard)
    check_clock(now, bus.clock)
    events: tuple[Event[R], ...] = ()
    if heard:
        bus, events = _hear(bus, heard, now)
    elif now != bus.clock:
        bus = _changed(bus, clock=now)
    if bus.pending and bus.pending.due <= now:
        bus, over = _expire(bus, bus.pending)
        events += over
    bus, sent = _transmit(bus, now, drained=not heard)
    return bus, (*events, *sent)


def next_deadline(bus: Bus[Response]) -> float | None:
    """Return the time to call `receive`, even if no byte arrives; None if no request is open."""
    check_type("bus", bus, Bus)
    return bus.pending.due if bus.pending else None


def abandon(bus: Bus[R], now: float) -> Bus[R]:
    """End the open request without an outcome: your task was cancelled, or the port failed.

    Time: if the request was sent, the line stays silent until the end of its deadline, its pause and the grace, and a
        late response is `Late`. If it was not sent, nothing is owed.
    Special: without an open request, it does nothing.
    Errors: `InvalidValueError` for a time that is not finite; `StateError` for a time before the last call.

    >>> from i7000 import Model, dcon
    >>> bus = send(Bus[Response](), dcon.ReadConfiguration(0x01), Profile(Model.I_7018), 0.0)
    >>> next_deadline(abandon(bus, 0.0)) is None
    True
    """
    check_type("bus", bus, Bus)
    check_clock(now, bus.clock)
    quiet_until = bus.quiet_until
    if bus.pending and bus.pending.sent:
        quiet_until = max(quiet_until, _over(bus, bus.pending))
    return _changed(bus, pending=None, quiet_until=quiet_until, clock=now)


# --- the steps --------------------------------------------------------------------------------------------------------


def _allowance(bus: Bus[Response], exchange: Exchange[Response]) -> float:
    """Return the time from sending a request to its deadline.

    Special: the Modbus specification requires time for the modules after a broadcast too.
    """
    characters = len(exchange.wire) + exchange.longest_response
    turnaround = bus.policy.turnaround if exchange.answered or exchange.rtu else 0.0
    return characters * bus.character_time + turnaround + exchange.pause


def _over(bus: Bus[Response], request: Pending[Response]) -> float:
    """Return the end of the silence after the deadline of a request that was sent; nothing answers a broadcast."""
    return request.due + (bus.policy.grace if request.exchange.answered else 0.0)


def _transmit(bus: Bus[R], now: float, *, drained: bool) -> tuple[Bus[R], tuple[Transmit, ...]]:
    """Send the open request if it is time; `drained` is whether the port had nothing to read."""
    if not bus.pending or bus.pending.sent or now < (bus.pending.due if drained else bus.pending.latest):
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
        silent = min(now + bus.silence, bus.pending.latest)
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
    bus = _changed(bus, quiet_until=_over(bus, request))
    if not request.retries:
        return _changed(bus, pending=None), (*events, TimedOut(request.exchange.command))
    due = max(bus.quiet_until, bus.heard_at + bus.silence)
    again = Pending(request.exchange, request.retries - 1, due, due + _allowance(bus, request.exchange))
    return _changed(bus, pending=again), events
