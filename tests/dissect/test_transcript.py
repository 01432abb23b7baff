"""Frames that are cut over several lines of a log are put together, and no line is lost."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import ArgumentError, modbus
from i7000.dissect.found import Kind
from i7000.dissect.transcript import Piece, pieces
from tests.dissect.frames import DCON, MODBUS, REQUEST, RESPONSE
from tests.dissect.spellings import BEFORE, DUMPS, WITHOUT_FRAMES


def pieces_of(*lines: str) -> list[Piece]:
    return list(pieces(enumerate(lines, 1)))


def test_an_answer_that_came_in_three_pieces_is_one_frame() -> None:
    request, response = pieces_of(
        "send: 0x01 0x04 0x00 0x00 0x00 0x01 0x31 0xca", "recv: 0x01 0x04 0x02", "recv: 0x0b 0x61", "recv: 0x7f 0xe8"
    )

    assert (request.number, request.last, request.wire) == (1, 1, REQUEST)
    assert (response.number, response.last, response.kind, response.wire) == (2, 4, Kind.MODBUS, RESPONSE)


@pytest.mark.parametrize("name", DUMPS)
def test_a_frame_in_a_dump_of_several_lines_is_one_frame(name: str) -> None:
    found = {wire: [it.wire for it in pieces_of(*DUMPS[name](wire)) if it.kind] for wire in MODBUS + DCON}

    assert found == {wire: [wire] for wire in MODBUS + DCON}


def test_two_frames_in_dumps_are_two() -> None:
    lines = [line for wire in (REQUEST, RESPONSE) for line in DUMPS["hexdump -C"](wire)]

    assert [it.wire for it in pieces_of(*lines) if it.kind] == [REQUEST, RESPONSE]


def test_noise_before_a_cut_frame_stays_a_piece_of_its_own() -> None:
    noise, request = pieces_of("FF FE FD FC", "01 04 00 00", "00 01 31 CA")

    assert (noise.kind, noise.wire) == (Kind.DAMAGED, b"\xff\xfe\xfd\xfc")
    assert (request.number, request.last, request.wire) == (2, 3, REQUEST)


def test_parts_that_never_become_a_frame_are_pieces_of_their_own() -> None:
    first, second, words = pieces_of("01 04 00 00 00", "00 01 31 CB 00", "port closed")

    assert (first.number, first.kind, second.number, second.kind) == (1, Kind.DAMAGED, 2, Kind.DAMAGED)
    assert (words.number, words.kind, words.text) == (3, None, "port closed")


def test_a_part_too_short_for_a_frame_is_a_line_without_one() -> None:
    (piece,) = pieces_of("code 12")

    assert (piece.kind, piece.text) == (None, "code 12")


def test_two_frames_of_a_line_share_its_text() -> None:
    command, response = pieces_of("Command: $012    Response: !01050600 ok")

    assert (command.text, response.text) == ("Command: $012", "    Response: !01050600 ok")


def test_lines_of_hex_without_a_frame_do_not_pile_up() -> None:
    found = pieces_of(*["FF " * 16] * 100)

    assert [piece.number for piece in found] == list(range(1, 101))


def test_a_blank_line_is_no_piece() -> None:
    assert pieces_of("", "  \t") == []


@given(
    st.sampled_from((REQUEST, RESPONSE)), st.lists(st.integers(1, 6), max_size=3, unique=True), st.sampled_from(BEFORE)
)
def test_a_frame_is_put_together_wherever_it_is_cut(wire: bytes, cuts: list[int], before: str) -> None:
    ends = [*sorted(cut for cut in cuts if cut < len(wire)), len(wire)]
    parts = [wire[start:end] for start, end in zip([0, *ends], ends, strict=False)]

    found = pieces_of(*(before + part.hex(" ") for part in parts))

    assert [(piece.number, piece.last, piece.wire) for piece in found] == [(1, len(parts), wire)]


@pytest.mark.parametrize("text", [text for text in WITHOUT_FRAMES if text.strip()])
def test_a_line_without_a_frame_is_a_piece_without_one(text: str) -> None:
    (piece,) = pieces_of(text)

    assert (piece.kind, piece.wire, piece.text) == (None, b"", text)


def test_a_part_before_a_line_with_a_frame_stays_a_piece_of_its_own() -> None:
    part, command, other, response = pieces_of("RX 01 04 02", "$012", "RX 01 04 02", "ok 24 30 31 32 0D ok")

    assert (part.kind, command.wire, other.kind, response.wire) == (Kind.DAMAGED, b"$012\r", Kind.DAMAGED, b"$012\r")


def test_noise_behind_a_cut_frame_is_no_part_of_it() -> None:
    found = pieces_of("RX 01 04 00 00 00 01", "RX 31 CA FF", "port closed")

    assert [(it.number, it.wire) for it in found] == [(1, REQUEST[:6]), (2, b"1\xca\xff"), (3, b"")]


def test_parts_longer_than_a_frame_are_given_up_from_the_first_on() -> None:
    begun = "RX 01 10 00 00 00 7B F6 00"
    found = pieces_of(begun, *["00 " * 100] * 3, "RX 01 04 00 00", "00 01 31 CA")

    assert (found[-1].number, found[-1].last, found[-1].wire) == (5, 6, REQUEST)


@pytest.mark.parametrize(
    "lines",
    [
        ["level=01", "04 02 0B 61 7F E8"],
        ["level=01", "RX 04 02 0B 61 7F E8"],
        ["retry 01 04", "RX 02 0B 61 7F E8"],
        ["01 04 02 0B 61 7F", "temperature E8"],
        ["step 3 of 01", "12:00:01 04 02 0B 61 7F E8"],
    ],
)
def test_a_number_in_a_sentence_is_no_part_of_the_frame_in_the_next_line(lines: list[str]) -> None:
    assert Kind.MODBUS not in [piece.kind for piece in pieces_of(*lines)]
    assert all(piece.number == piece.last for piece in pieces_of(*lines))


@pytest.mark.parametrize(
    "lines",
    [
        ["uart-1: 01", "uart-1: 04", "uart-1: 02 0B 61 7F E8"],
        ["12:00:01 RX: 01", "12:00:01 RX: 04 02 0B 61 7F E8"],
        ["Data: 01 04 02", "      0B 61 7F E8"],
        ["RX: 01", "    04 02 0B 61 7F E8"],
    ],
)
def test_a_frame_in_lines_that_begin_alike_is_put_together(lines: list[str]) -> None:
    (piece,) = pieces_of(*lines)

    assert (piece.kind, piece.wire) == (Kind.MODBUS, RESPONSE)


def test_a_damaged_frame_in_decimal_is_found_whole() -> None:
    (piece,) = pieces_of("<-1-4-16-7-208-7-209-10-13-28-37-180-218")

    assert (piece.kind, piece.wire) == (Kind.DAMAGED, bytes((1, 4, 16, 7, 208, 7, 209, 10, 13, 28, 37, 180, 218)))


@pytest.mark.parametrize("line", ["total 10 16 28 37 180 in all", "of 180, 10, 16, 28, 37 in all"])
def test_numbers_in_decimal_of_which_a_part_could_be_hex_are_no_damaged_frame(line: str) -> None:
    assert [piece.kind for piece in pieces_of(line)] == [None]


@pytest.mark.parametrize("name", ["hexdump -C", "xxd", "tshark -x", "Format-Hex"])
def test_the_last_byte_of_a_long_dump_belongs_to_the_frame_whatever_its_offset(name: str) -> None:
    wire = modbus.seal(bytes((1, 4, 156, *range(156))))

    assert [it.wire for it in pieces_of(*DUMPS[name](wire)) if it.kind] == [wire]


@pytest.mark.parametrize("line", [(1, b"$012"), (None, "$012"), (True, "$012"), (1, "$012", 2), "$0", 1, [1, "$012"]])
def test_a_line_without_its_number_is_refused_when_it_is_reached(line: Any) -> None:
    found = pieces([(1, "$012"), line])

    assert next(found).wire == b"$012\r"
    with pytest.raises(ArgumentError, match="lines must be tuples of a number and a line"):
        next(found)
