"""A stream of bytes -> the frames in it, of one protocol or of both mixed."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import Protocol, modbus
from i7000.dissect.stream import Span, looks_like, split
from tests.dissect.frames import REQUEST, RESPONSE
from tests.dissect.strategies import frames, protocols

DCON, MODBUS = Protocol.DCON, Protocol.MODBUS_RTU
HEADER = bytes.fromhex("000700000006")


def good(spans: tuple[Span, ...]) -> list[tuple[Protocol, bytes]]:
    return [(span.protocol, span.wire) for span in spans if span.is_frame]


@pytest.mark.parametrize(
    ("data", "protocol", "spans", "rest"),
    [
        (b"$012\r$0", DCON, [Span(DCON, b"$012\r")], b"$0"),
        (b"xx$012\r", DCON, [Span(DCON, b"xx", is_frame=False), Span(DCON, b"$012\r")], b""),
        (REQUEST + b"\x01", MODBUS, [Span(MODBUS, REQUEST)], b"\x01"),
        (b"$012\r" + REQUEST + b"$0", None, [Span(DCON, b"$012\r"), Span(MODBUS, REQUEST)], b"$0"),
        (b"", None, [], b""),
    ],
)
def test_frames_are_split_from_noise_and_from_what_can_still_become_one(
    data: bytes, protocol: Protocol | None, spans: list[Span], rest: bytes
) -> None:
    assert split(data, protocol) == (tuple(spans), rest)


@pytest.mark.parametrize(
    ("data", "protocol", "spans"),
    [
        (b"$0", DCON, [Span(DCON, b"$0", is_frame=False)]),
        (b"\x01\x04", MODBUS, [Span(MODBUS, b"\x01\x04", is_frame=False)]),
        (b"$0", None, [Span(DCON, b"$0", is_frame=False)]),
        (b"\x01\x04", None, [Span(MODBUS, b"\x01\x04", is_frame=False)]),
        (b"", None, []),
    ],
)
def test_at_the_end_nothing_is_left(data: bytes, protocol: Protocol | None, spans: list[Span]) -> None:
    found, rest = split(data, protocol, last=True)

    assert spans == [*found]
    assert rest == b""


def test_text_that_has_no_shape_of_dcon_is_noise_between_frames_of_both() -> None:
    found, _ = split(b"#z\r" + REQUEST + b"$012\r", last=True)

    assert good(found) == [(MODBUS, REQUEST), (DCON, b"$012\r")]
    assert found[0].wire == b"#z\r"


def test_text_inside_a_frame_of_modbus_is_no_frame_of_dcon() -> None:
    frame = modbus.seal(b"\x01\x10\x00\x00\x00\x03\x06$012\r\x00")
    spans, _ = split(frame, last=True)

    assert spans == (Span(MODBUS, frame),)


@pytest.mark.parametrize(("wire", "protocol"), [(b"$01z\r\n\t", DCON), (b"\x01", MODBUS), (b"$01\xff", MODBUS)])
def test_text_looks_like_dcon(wire: bytes, protocol: Protocol) -> None:
    assert looks_like(wire) is protocol


@given(sent=frames, protocol=protocols, last=st.booleans())
def test_the_spans_and_the_rest_are_the_data(sent: list[bytes], protocol: Protocol | None, *, last: bool) -> None:
    data = b"".join(sent)
    spans, rest = split(data, protocol, last=last)

    assert b"".join(span.wire for span in spans) + rest == data
    assert not (last and rest)
    assert all(span.wire for span in spans)
    assert protocol is None or all(span.protocol is protocol for span in spans)


@given(frames, protocols, st.data())
def test_in_whatever_pieces_a_stream_comes_its_frames_are_the_same(
    sent: list[bytes], protocol: Protocol | None, data: st.DataObject
) -> None:
    stream = left = b"".join(sent)
    rest, found = b"", []
    while left:
        size = data.draw(st.integers(1, 16))
        spans, rest = split(rest + left[:size], protocol)
        found += good(spans)
        left = left[size:]
    found += good(split(rest, protocol, last=True)[0])

    assert found == good(split(stream, protocol, last=True)[0])


@given(st.lists(st.sampled_from([b"$012\r", b"!01050600\r", REQUEST, RESPONSE]), max_size=8))
def test_good_frames_of_both_protocols_are_all_found(sent: list[bytes]) -> None:
    spans, _ = split(b"".join(sent), last=True)

    assert [span.wire for span in spans] == sent
    assert all(span.is_frame for span in spans)


@pytest.mark.parametrize("protocol", [None, DCON, MODBUS])
@pytest.mark.parametrize(
    "parts",
    [
        [b"$01m\r", b"!01X\r"],
        [b"$012\n", b"!010F0600\n"],
        [b"$01m\r", HEADER + REQUEST[:-2]],
        [HEADER + REQUEST[:-2], HEADER + REQUEST[:-2], b"$01m\r", b"\x01\x02\x03"],
    ],
)
def test_noise_is_cut_where_lines_and_messages_of_modbus_tcp_end(parts: list[bytes], protocol: Protocol | None) -> None:
    data = b"".join(parts)
    wires = [[span.wire for span in split(data, it, last=True)[0]] for it in (protocol, None)]

    assert parts in wires


def test_noise_waits_for_what_follows_it_while_it_is_shorter_than_a_frame() -> None:
    short = split(b"$01m\r\x01\x04", None)
    spans, rest = split(b"\xff" * 300 + b"\x01\x04", None)

    assert short == ((), b"$01m\r\x01\x04")
    assert ([span.wire for span in spans], rest) == ([b"\xff" * 300], b"\x01\x04")
