"""What `help` shows of the host."""

import pydoc
from typing import get_args

import pytest
from attrs import fields

from i7000 import host


@pytest.mark.parametrize(
    "kind",
    [host.Policy, host.Transmit, host.Answered, host.Declined, host.TimedOut, host.Sent, host.Rejected, host.Late],
    ids=lambda kind: kind.__name__,
)
def test_help_says_what_each_attribute_is(kind: type) -> None:
    shown = pydoc.render_doc(kind).partition("Method resolution order")[0]

    assert [it.name for it in fields(kind) if f"`{it.name}`" not in shown] == []


def test_help_names_the_kinds_of_events_and_outcomes() -> None:
    shown = pydoc.render_doc(host)
    kinds = {getattr(kind, "__origin__", kind).__name__ for kind in (*get_args(host.Event), *get_args(host.Outcome))}

    assert {kind for kind in kinds if f"`{kind}`" not in shown.replace("i7000.Noise", "Noise")} == set()
