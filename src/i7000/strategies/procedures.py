"""Strategies for procedures: the steps that they yield, and the results that they are sent."""

from collections.abc import Callable, Mapping
from typing import Any

from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from i7000 import Model, Profile
from i7000.host.procedures import Ask, BytesHeard, Result, SendBytes, Tell, Tune, Wait
from i7000.strategies import host
from i7000.strategies.vocabulary import line_settings

__all__ = ["asks"]

_SECONDS = st.floats(0, 60)


def asks() -> SearchStrategy[Ask[Any]]:
    """Make requests of either protocol, most often with the policy of the line."""
    policies = st.none() | host.policies()
    return st.builds(lambda exchange, policy: Ask(exchange[1], exchange[0], policy), host.exchanges(), policies)


def _pieces(times: SearchStrategy[float]) -> SearchStrategy[tuple[tuple[float, bytes], ...]]:
    return st.lists(st.tuples(times, st.binary(max_size=40)), max_size=4).map(tuple)


BY_KIND: Mapping[type, Callable[[], SearchStrategy[Any]]] = {
    Ask: asks,
    BytesHeard: lambda: st.builds(BytesHeard, _pieces(st.floats(-1, 60)), st.floats(0, 1e6)),
    Result: lambda: st.builds(Result, host.outcomes(), st.lists(host.others(), max_size=3).map(tuple)),
    SendBytes: lambda: st.builds(
        SendBytes, _pieces(_SECONDS), _SECONDS, _SECONDS, st.sampled_from([b"", b"\r"]) | st.binary(max_size=4)
    ),
    Tell: lambda: st.builds(Tell, st.text()),
    Tune: lambda: st.builds(Tune, line_settings(Profile(Model.M_7017))),
    Wait: lambda: st.builds(Wait, _SECONDS),
}
"""The strategies of the public classes."""
