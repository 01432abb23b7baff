"""Strategies for the host side: policies, lines during a request, events.

Laws: every line is in a reachable state, after sending, receiving and waiting. The smallest example is an unused line.
"""

from collections.abc import Callable, Mapping
from typing import Any

from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from i7000 import Model, Profile, dcon, modbus
from i7000.errors import Fault, Noise
from i7000.host import (
    Answered,
    Bus,
    Declined,
    Ended,
    Late,
    Policy,
    Query,
    Rejected,
    Response,
    Sent,
    TimedOut,
    Transmit,
    abandon,
    next_deadline,
    receive,
    send,
)
from i7000.strategies import dcon as dcon_strategies
from i7000.strategies import modbus as modbus_strategies
from i7000.strategies.vocabulary import line_settings

__all__ = ["buses", "exchanges", "others", "outcomes", "policies"]

_LINES = line_settings(Profile(Model.M_7017))


def policies() -> SearchStrategy[Policy]:
    """Make policies, the default first."""
    seconds = st.floats(0, 5)
    return st.builds(
        Policy,
        retries=st.sampled_from((2, 0, 1, 3)),
        turnaround=st.just(0.2) | seconds,
        grace=st.just(1.0) | seconds,
    )


def exchanges() -> SearchStrategy[tuple[Profile, Query[Response], Any, bytes]]:
    """Make exchanges of either protocol: a profile, a message, its response, and the bytes of the response."""
    by_dcon = dcon_strategies.exchanges().map(lambda it: (it.profile, it.command, it.response, it.response_wire))
    by_modbus = modbus_strategies.exchanges().map(lambda it: (it.profile, it.request, it.response, it.response_wire))
    return by_dcon | by_modbus


@st.composite
def buses(draw: st.DrawFn) -> Bus[Response]:
    """Make lines with a request that is open, over or never sent, after any received bytes."""
    bus: Bus[Response] = Bus(draw(_LINES), draw(policies()), draw(st.booleans()))
    now = 0.0
    for _ in range(draw(st.integers(0, 2))):
        profile, command, _, answer = draw(exchanges())
        if bus.pending is None:
            bus = send(bus, command, profile, now)
        for heard in draw(st.sampled_from(((b"", answer), (b"", answer[:3]), (b"",), (answer,)))):
            now = max(now, next_deadline(bus) or now) if not heard else now
            bus, _ = receive(bus, heard, now)
        bus, _ = receive(bus, draw(st.binary(max_size=8)), now)
        now += draw(st.floats(0, 2))
        bus, _ = receive(bus, b"", now)
        if draw(st.integers(0, 7)) == 7:  # rarely
            bus = abandon(bus, now)
    return bus


def _outcomes(kind: type[Ended]) -> SearchStrategy[Ended]:
    """Make outcomes of a class with only a command."""
    return exchanges().map(lambda it: kind(it[1]))


def _broadcasts() -> SearchStrategy[Sent]:
    commands = st.sampled_from((dcon.SynchronizedSampling(), dcon.HostOk()))
    return st.builds(Sent, commands | modbus_strategies.messages(modbus.WriteSingleCoil).map(_to_all))


def _to_all(request: modbus.WriteSingleCoil) -> modbus.WriteSingleCoil:
    return modbus.WriteSingleCoil(modbus.BROADCAST, request.coil, request.value)


def _answers(*, declined: bool) -> SearchStrategy[Any]:
    """Make outcomes of answered requests."""
    refusals = dcon.Refused | modbus.ExceptionResponse
    kind = Declined if declined else Answered
    return exchanges().filter(lambda it: isinstance(it[2], refusals) is declined).map(lambda it: kind(it[1], it[2]))


def outcomes() -> SearchStrategy[Any]:
    """Make outcomes of any kind."""
    return st.one_of(_answers(declined=False), _answers(declined=True), _outcomes(TimedOut), _broadcasts())


def others() -> SearchStrategy[Late | Rejected | Noise]:
    """Make events that end no request: late and rejected frames, and noise."""
    rejected = st.builds(Rejected, st.binary(min_size=1), st.sampled_from(Fault), st.text())
    noise = st.builds(Noise, st.binary(min_size=1), st.sampled_from(Fault))
    return st.builds(Late, st.binary(min_size=1)) | rejected | noise


BY_KIND: Mapping[type, Callable[[], SearchStrategy[Any]]] = {
    Answered: lambda: _answers(declined=False),
    Bus: buses,
    Declined: lambda: _answers(declined=True),
    Ended: outcomes,
    Late: lambda: st.builds(Late, st.binary(min_size=1)),
    Policy: policies,
    Query: lambda: exchanges().map(lambda it: it[1]) | _broadcasts().map(lambda it: it.command),
    Rejected: lambda: st.builds(Rejected, st.binary(min_size=1), st.sampled_from(Fault), st.text()),
    Response: lambda: exchanges().map(lambda it: it[2]),
    Sent: _broadcasts,
    TimedOut: lambda: _outcomes(TimedOut),
    Transmit: lambda: st.builds(Transmit, st.binary(min_size=1)),
}
"""The strategies of the public classes."""
