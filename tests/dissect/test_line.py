"""The listener: frames, streams and both protocols on one line, and what always holds of them."""

import gc
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import ArgumentError, Fault, Model, Protocol
from i7000.dissect import Heard, Knowledge, Known, Line, Place, flush, hear, hear_frame, line_dcon
from tests.dissect.frames import REQUEST, RESPONSE
from tests.dissect.hearing import hear_all, line_of
from tests.dissect.strategies import frames, knowns, protocol_of, protocols

# --- places -----------------------------------------------------------------------------------------------------------


def test_frames_are_counted_where_no_place_is_given() -> None:
    _, heard = hear_all(Line(), ["$012", "!01050600"])

    assert [it.place for it in heard] == [Place(1, "frame 1"), Place(2, "frame 2")]
    assert heard[1].answers == heard[0].place


def test_a_place_that_is_given_goes_on_from_there() -> None:
    line, heard = hear_frame(Line(), b"$012\r", Protocol.DCON, Place(7, "line 40"))

    assert heard.place == Place(7, "line 40")
    assert hear_frame(line, b"!01050600\r", Protocol.DCON)[1].place == Place(8, "frame 8")


def test_bytes_of_a_stream_stand_where_the_caller_says() -> None:
    line, (command,) = hear(Line(protocol=Protocol.DCON), b"$012\r!0", "packet 1")
    line, (response,) = hear(line, b"1050600\r?", "packet 2")
    _, (rest,) = flush(line, "packet 2")

    assert [it.place for it in (command, response, rest)] == [(1, "packet 1"), (2, "packet 2"), (3, "packet 2")]
    assert response.answers == (1, "packet 1")


def test_no_bytes_are_no_frame() -> None:
    _, heard = hear_frame(Line(), b"", Protocol.DCON)

    assert heard.error is not None
    assert (heard.error.fault, heard.understood) == (Fault.LENGTH, False)


def test_bytes_that_are_no_frame_have_their_fault() -> None:
    _, found = hear(Line(protocol=Protocol.DCON), b"xx$012\r")

    assert [(it.wire, it.error and it.error.fault) for it in found] == [(b"xx", Fault.LEADING), (b"$012\r", None)]


# --- arguments --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("frame", "sent", "notes"),
    [
        (b"$012\r", False, ("a command that the host received: an echo, or another host?",)),
        (b"!010F0600\r", True, ("a response that the host sent",)),
        (b"$012\r", True, ()),
    ],
)
def test_a_direction_that_does_not_fit_the_frame_is_noticed(
    frame: bytes,
    sent: bool,  # noqa: FBT001 - a parameter of the test
    notes: tuple[str, ...],
) -> None:
    _, heard = hear_frame(line_of(Known(Model.I_7018)), frame, Protocol.DCON, sent=sent)

    assert heard.notes == notes


@pytest.mark.parametrize(
    "arguments",
    [
        ("line", b"", Protocol.DCON),
        (Line(), b"", 0),
        (Line(), b"", Protocol.DCON, (1, "x")),
        (Line(), "$", Protocol.DCON),
    ],
)
def test_arguments_of_other_types_are_refused(arguments: tuple[Any, ...]) -> None:
    with pytest.raises(ArgumentError):
        hear_frame(*arguments)


def test_a_place_needs_a_number() -> None:
    with pytest.raises(ArgumentError, match="Place, with a number"):
        hear_frame(Line(), b"", Protocol.DCON, Place("1", "x"))  # type: ignore[arg-type]


# --- both on one line -------------------------------------------------------------------------------------------------


def test_exchanges_of_both_protocols_do_not_part_each_other() -> None:
    _, heard = hear_all(Line(), ["$022", REQUEST, "!02050600", RESPONSE])

    assert heard[2].answers == heard[0].place
    assert heard[3].answers == heard[1].place


def test_a_stream_of_both_protocols_is_heard_frame_by_frame() -> None:
    line, found = hear(Line(), b"$022\r" + REQUEST + RESPONSE + b"!02050600\r")
    _, rest = flush(line)

    assert [it.protocol for it in (*found, *rest)] == [
        Protocol.DCON, Protocol.MODBUS_RTU, Protocol.MODBUS_RTU, Protocol.DCON,
    ]  # fmt: skip


@pytest.mark.parametrize("protocol", Protocol)
def test_a_line_of_one_protocol_takes_the_other_for_noise(protocol: Protocol) -> None:
    line, found = hear(Line(protocol=protocol), b"$022\r" + REQUEST)
    _, rest = flush(line)

    assert [it.wire for it in (*found, *rest) if it.understood] == [b"$022\r" if protocol is Protocol.DCON else REQUEST]
    assert {it.protocol for it in (*found, *rest)} == {protocol}


# --- laws -------------------------------------------------------------------------------------------------------------


def shown(heard: Heard) -> object:
    """Everything that a frame was heard as; it is looked at, too."""
    return [
        heard.place, heard.wire, heard.protocol, heard.direction, heard.address, heard.answers, heard.same_as,
        heard.notes, str(heard.error), heard.contradictions, heard.understood,
        [
            (it.message, it.command, it.readings, it.items, it.facts, it.notes, it.fields, it.errata, it.pause,
             it.models, it.section, it.assumed, it.checksum, it.data_formats, str(it.misfit))
            for it in (*heard.meanings, *heard.candidates)
        ],
    ]  # fmt: skip


@given(knowns, protocols, frames)
def test_no_frames_raise_and_the_same_frames_are_heard_alike(
    known: Known, protocol: Protocol | None, sent: list[bytes]
) -> None:
    def heard_of(line: Line) -> list[object]:
        found = []
        for frame in sent:
            line, heard = hear_frame(line, frame, protocol_of(frame) if protocol is None else protocol)
            found.append(shown(heard))
        return found

    start = line_of(known)

    assert heard_of(start) == heard_of(start) == heard_of(line_of(known))


@given(knowns, frames)
def test_what_is_learned_never_makes_a_combination_that_no_module_has(known: Known, sent: list[bytes]) -> None:
    line = line_of(known)
    for frame in sent:
        line, _ = hear_frame(line, frame, protocol_of(frame))

    assert all(module.known.all for module in line.knowledge.modules.values())
    assert all(module.given in (known, Known()) for module in line.knowledge.modules.values())


@given(knowns, protocols, frames, st.data())
def test_every_byte_is_heard_once_in_whatever_pieces_it_comes(
    known: Known, protocol: Protocol | None, sent: list[bytes], data: st.DataObject
) -> None:
    stream = left = b"".join(sent)
    line = Line(Knowledge.given(known), protocol)
    found: list[Heard] = []
    while left:
        size = data.draw(st.integers(1, 20))
        line, heard = hear(line, left[:size])
        found += heard
        left = left[size:]

        assert b"".join(it.wire for it in found) + line.rest + left == stream
    line, heard = flush(line)
    found += heard
    whole, first = hear(Line(Knowledge.given(known), protocol), stream)
    _, last = flush(whole)

    assert b"".join(it.wire for it in found) == stream
    assert line.rest == b""
    assert [it.wire for it in found if not it.error] == [it.wire for it in (*first, *last) if not it.error]
    assert [it.place.number for it in found] == list(range(1, len(found) + 1))


@pytest.mark.no_cover
def test_what_is_remembered_does_not_grow_with_modules_and_what_changes_of_them() -> None:
    def polled(line: Line, rounds: int) -> Line:
        for turn in range(rounds):
            for address in range(256):
                body = f"!{address:02X}{(0x0E, 0x0F, 0x10)[(turn + address) % 3]:02X}0600"
                line, _ = hear_all(line, [f"${address:02X}2", body])
        return line

    line = polled(line_of(Known(Model.I_7018)), 4)
    gc.collect()
    before = len(gc.get_objects())
    line = polled(line, 4)
    gc.collect()

    assert len(line.knowledge.modules) == 256
    assert len(gc.get_objects()) - before < 2000
    assert line_dcon._remembered.cache_info().maxsize is not None  # noqa: SLF001 - what it remembers is bounded
