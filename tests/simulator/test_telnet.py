"""Telnet without I/O."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000.simulator.telnet import (
    DO,
    DONT,
    IAC,
    MOST_REPLIES,
    SB,
    SE,
    WILL,
    WONT,
    Negotiation,
    Options,
    Subnegotiation,
    Telnet,
    escaped,
    subnegotiation,
)

BINARY, SUPPRESS_GO_AHEAD, UNKNOWN = 0, 3, 99
NEGOTIATIONS = st.builds(Negotiation, st.sampled_from((WILL, WONT, DO, DONT)), st.sampled_from((0, 3, 99)))
PARTS = st.binary(min_size=1) | NEGOTIATIONS | st.binary(max_size=9).map(Subnegotiation)


def wire(part: bytes | Negotiation | Subnegotiation) -> bytes:
    if isinstance(part, Negotiation):
        return bytes((IAC, part.verb, part.option))
    return subnegotiation(part.content) if isinstance(part, Subnegotiation) else escaped(part)


def joined(parts: list[bytes | Negotiation | Subnegotiation]) -> list[bytes | Negotiation | Subnegotiation]:
    """Parts with neighbouring data put together."""
    found: list[bytes | Negotiation | Subnegotiation] = []
    for part in parts:
        if found and isinstance(part, bytes) and isinstance(found[-1], bytes):
            found[-1] += part
        else:
            found.append(part)
    return found


@given(st.lists(PARTS), st.integers(1, 7))
def test_what_one_end_sends_the_other_receives_in_whatever_pieces(
    parts: list[bytes | Negotiation | Subnegotiation], size: int
) -> None:
    sent, telnet = b"".join(map(wire, parts)), Telnet()

    received = [part for at in range(0, len(sent), size) for part in telnet.receive(sent[at : at + size])]

    assert joined(received) == joined(parts)


@pytest.mark.parametrize(
    "sent",
    [
        bytes((IAC, SB, 1, 2)) + bytes((IAC, SB, 7, IAC, SE)),
        bytes((IAC, SE, IAC, SB, 7, IAC, SE)),
        bytes((IAC, SB, 1)) + bytes(300) + bytes((IAC, SE, IAC, SB, 7, IAC, SE)),
        bytes((IAC, SB, 1, IAC, 241, IAC, SE, IAC, SB, 7, IAC, SE)),
    ],
    ids=["begun twice", "ended twice", "too long", "a command within"],
)
def test_a_subnegotiation_that_is_none_is_skipped(sent: bytes) -> None:
    assert list(Telnet().receive(sent + b"x")) == [Subnegotiation(b"\x07"), b"x"]


def test_a_negotiation_ends_a_subnegotiation() -> None:
    sent = bytes((IAC, SB, 1, IAC, DO, 3)) + b"x"

    assert list(Telnet().receive(sent)) == [Negotiation(DO, 3), b"x"]


# --- options ----------------------------------------------------------------------------------------------------------


def options() -> Options:
    return Options({BINARY, SUPPRESS_GO_AHEAD}, {BINARY})


def answers(*negotiations: tuple[int, int], offered: tuple[int, int] | None = None) -> list[tuple[int, ...]]:
    negotiated = options()
    if offered:
        negotiated.offer(*offered)
    return [tuple(negotiated.answer(Negotiation(*it))[1:]) for it in negotiations]


def test_an_option_is_turned_on_once() -> None:
    assert answers((DO, BINARY), (DO, BINARY)) == [(WILL, BINARY), ()]
    assert answers((WILL, BINARY), (WILL, BINARY)) == [(DO, BINARY), ()]


def test_an_option_is_turned_off_once() -> None:
    assert answers((DO, BINARY), (DONT, BINARY), (DONT, BINARY)) == [(WILL, BINARY), (WONT, BINARY), ()]
    assert answers((WILL, BINARY), (WONT, BINARY), (WONT, BINARY)) == [(DO, BINARY), (DONT, BINARY), ()]


def test_an_offer_that_is_taken_or_refused_is_not_answered() -> None:
    assert answers((DO, BINARY), offered=(WILL, BINARY)) == [()]
    assert answers((DONT, BINARY), (DO, BINARY), offered=(WILL, BINARY)) == [(), (WILL, BINARY)]


def test_an_unknown_option_is_refused_once() -> None:
    assert answers((DO, UNKNOWN), (DO, UNKNOWN), (WILL, UNKNOWN), (WILL, UNKNOWN)) == [
        (WONT, UNKNOWN),
        (),
        (DONT, UNKNOWN),
        (),
    ]
    assert answers((WILL, SUPPRESS_GO_AHEAD)) == [(DONT, SUPPRESS_GO_AHEAD)]


def test_an_unknown_option_that_is_not_wanted_is_not_answered() -> None:
    assert answers((DONT, UNKNOWN), (WONT, UNKNOWN)) == [(), ()]


@given(st.lists(NEGOTIATIONS))
def test_two_ends_do_not_answer_each_other_for_ever(begun: list[Negotiation]) -> None:
    ends, pending = [options(), Options({UNKNOWN}, {SUPPRESS_GO_AHEAD})], begun
    for _ in range(100):
        ends.reverse()
        replies = [ends[0].answer(one) for one in pending]
        pending = [Negotiation(reply[1], reply[2]) for reply in replies if reply]

    assert pending == []


def test_an_option_that_changes_all_the_time_is_not_answered_for_ever() -> None:
    replies = answers(*[(DO, BINARY), (DONT, BINARY)] * 100)

    assert len([reply for reply in replies if reply]) == MOST_REPLIES


def test_an_option_is_on_at_either_end() -> None:
    ours, theirs = options(), options()
    ours.answer(Negotiation(DO, BINARY))
    theirs.answer(Negotiation(WILL, BINARY))

    assert (ours.is_on(BINARY), theirs.is_on(BINARY), options().is_on(BINARY)) == (True, True, False)
