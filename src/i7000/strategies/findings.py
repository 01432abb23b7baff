"""Strategies for what procedures return: places, findings, identities and reports."""

from collections.abc import Callable, Mapping
from typing import Any

from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from i7000 import DecodeError, Model, Profile, Protocol, dcon
from i7000.dissect import Known
from i7000.host import Answered
from i7000.host.procedures import (
    Candidate,
    ChannelFault,
    Finding,
    FindingKind,
    Identified,
    Place,
    Progress,
    Report,
    Scanned,
    Unknown,
)
from i7000.strategies import dcon as dcon_strategies
from i7000.strategies import host
from i7000.strategies.vocabulary import addresses, errors, line_settings, profiles

__all__ = ["identities", "places", "reports"]

_WORDS = st.text(max_size=20)
_MODELS = st.sampled_from(Model)


def places() -> SearchStrategy[Place]:
    """Make places of either protocol, most often those of a module from the factory."""
    lines = line_settings(Profile(Model.M_7017))
    by_dcon = st.builds(Place, lines, addresses(), checksum=st.booleans())
    return by_dcon | st.builds(Place, lines, st.integers(1, 247), st.just(Protocol.MODBUS_RTU))


def _unknowns() -> SearchStrategy[Unknown]:
    names = st.sampled_from(("protocol", "name", "mask", "model", "types", "data_format", "checksum"))
    return st.builds(Unknown, names, _WORDS, st.none() | host.outcomes())


def _candidates() -> SearchStrategy[Candidate]:
    return st.builds(Candidate, _MODELS, st.lists(_WORDS, max_size=2).map(tuple))


@st.composite
def identities(draw: st.DrawFn) -> Identified:
    """Make identities: of modules whose profile is known, or of nothing."""
    if draw(st.booleans()):
        return Identified(draw(addresses()), unknown=(draw(_unknowns()),))
    profile = draw(profiles())
    return Identified(
        draw(addresses()),
        draw(st.sampled_from(sorted(profile.model.protocols))),
        name=profile.model.factory_name,
        version=None if profile.firmware is None else str(profile.firmware),
        known=Known.of(profile),
        candidates=(Candidate(profile.model), *draw(st.lists(_candidates(), max_size=2))),
        reasons=tuple(draw(st.lists(_WORDS, max_size=2))),
        unknown=tuple(draw(st.lists(_unknowns(), max_size=2))),
    )


def _findings() -> SearchStrategy[Finding]:
    names = st.none() | _MODELS.map(lambda model: model.factory_name)
    heard = st.sampled_from([heard for heard in FindingKind if heard is not FindingKind.NOTHING])
    return st.builds(Finding, places(), heard, host.outcomes(), name=names, reason=_WORDS)


def _progress() -> SearchStrategy[Progress]:
    counts = st.integers(0, 1000)
    return st.builds(lambda done, left, place, seconds: Progress(done, done + left, place, seconds),
                     counts, counts, places(), st.floats(0, 1000))  # fmt: skip


def _faults() -> SearchStrategy[ChannelFault]:
    decode_errors = errors().filter(lambda error: isinstance(error, DecodeError))
    return st.builds(ChannelFault, st.none() | st.integers(0, 19), decode_errors)


@st.composite
def reports(draw: st.DrawFn) -> Report:
    """Make reports: the readings of a module, or an outcome without any."""
    exchange = draw(dcon_strategies.exchanges(dcon.ReadAnalogInputs))
    profile = exchange.profile
    response: Any = exchange.response
    if not profile.type_codes or isinstance(response, dcon.Refused):
        return Report(draw(host.outcomes()), reason=draw(_WORDS))
    mask = draw(st.none() | st.integers(0, (1 << profile.channels) - 1))
    return Report(Answered(exchange.command, response), dcon.readings(response, profile, lenient=True), mask=mask)


BY_KIND: Mapping[type, Callable[[], SearchStrategy[Any]]] = {
    Candidate: _candidates,
    ChannelFault: _faults,
    Finding: _findings,
    Identified: identities,
    Place: places,
    Progress: _progress,
    Report: reports,
    Scanned: lambda: st.builds(Scanned, st.lists(_findings(), max_size=2).map(tuple), st.integers(2, 1000)),
    Unknown: _unknowns,
}
"""The strategies of the public classes."""
