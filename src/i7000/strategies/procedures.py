"""Strategies for procedures: the steps that they yield, and the results that they are sent."""

from collections.abc import Callable, Mapping
from typing import Any

from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from i7000 import Model, Profile
from i7000.host.procedures import Ask, Result, Tell, Tune, Wait
from i7000.strategies import host
from i7000.strategies.vocabulary import line_settings

__all__ = ["asks"]


def asks() -> SearchStrategy[Ask[Any]]:
    """Make requests of either protocol, most often with the policy of the line."""
    policies = st.none() | host.policies()
    return st.builds(lambda exchange, policy: Ask(exchange[1], exchange[0], policy), host.exchanges(), policies)


BY_KIND: Mapping[type, Callable[[], SearchStrategy[Any]]] = {
    Ask: asks,
    Result: lambda: st.builds(Result, host.outcomes(), st.lists(host.others(), max_size=3).map(tuple)),
    Tell: lambda: st.builds(Tell, st.text()),
    Tune: lambda: st.builds(Tune, line_settings(Profile(Model.M_7017))),
    Wait: lambda: st.builds(Wait, st.floats(0, 60)),
}
"""The strategies of the public classes."""
