"""A frame that a logger printed twice counts once; a second frame of the same bytes on the wire counts."""

import pytest

from i7000.dissect.found import Kind
from i7000.dissect.transcript import pieces
from tests.dissect.frames import RESPONSE

WRITTEN = "0x01 0x06 0x01 0xe8 0x00 0x64 0x09 0xe9"


def same_as(*lines: str) -> list[int | None]:
    return [piece.same_as for piece in pieces(enumerate(lines, 1))]


@pytest.mark.parametrize(
    ("first", "second"),
    [
        (f"recv: {WRITTEN}", f"Processing: {WRITTEN}"),
        (f"DEBUG:log:recv: {WRITTEN} old_data:  addr=None", f"DEBUG:log:Processing: {WRITTEN}"),
        ("RX: !010F0600", "RX parsed: !010F0600"),
        ("TX: $012", "TX hex: 24 30 31 32 0D"),
        ("TX 24 30 31 32 0D", "TX $012\\r"),
    ],
)
def test_a_frame_that_is_printed_twice_is_marked(first: str, second: str) -> None:
    assert same_as(first, second) == [None, 1]


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("TX: $012", "TX: $012"),
        ("12:00:01 TX: $012", "12:00:02 TX: $012"),
        ("TX: $012", "RX: $012"),
        ("send: $012", "echo: $012"),
        (f"send: {WRITTEN}", f"recv: {WRITTEN}"),
        (f"-> {WRITTEN}", f"<- {WRITTEN}"),
        ("$012", "$012"),
        ("12:00:01 $012", "12:00:02 poll $012"),
        ("TX: $012", "Processing: $022"),
    ],
)
def test_a_frame_that_was_on_the_wire_twice_is_not(first: str, second: str) -> None:
    assert same_as(first, second) == [None, None]


def test_a_frame_that_is_printed_a_third_time_is_the_same_as_the_first() -> None:
    assert same_as(f"recv: {WRITTEN}", f"Processing: {WRITTEN}", f"Frame checked: {WRITTEN}") == [None, 1, 1]


def test_a_poll_that_is_repeated_after_another_line_is_not_marked() -> None:
    assert same_as("recv: !01", "nothing to do", "Processing: !01") == [None, None, None]


def test_the_inside_of_a_frame_that_is_printed_again_is_marked() -> None:
    whole, inside = pieces([(1, f"RX {RESPONSE.hex(' ')}"), (2, "Getting Frame - 0x4 0x2 0xb 0x61")])

    assert (whole.same_as, inside.kind, inside.same_as) == (None, Kind.DAMAGED, 1)


def test_a_frame_from_several_lines_is_the_same_as_its_first() -> None:
    cut = ("recv: 0x01 0x04 0x02 extra data: ", "recv: 0x0b 0x61 0x7f 0xe8 extra data: 0x01 0x04 0x02")

    assert same_as(*cut, "Processing: 0x1 0x4 0x2 0xb 0x61 0x7f 0xe8") == [None, 1]
