"""Dumps of a stream: rows behind offsets, in which frames begin and end anywhere."""

from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import Model, Profile, Protocol, modbus
from i7000.dissect import Kind, Piece, pieces
from i7000.dissect.dump import read_row

REQUEST = modbus.encode(modbus.ReadInputRegisters(1, 0, 8))
RESPONSE = modbus.encode(modbus.InputRegisters(1, tuple(range(8))), Profile(Model.M_7019R))
ASCII = b"$012\r!010F0600\r$01M\r!017019R\r#01\r>" + b"+0025.1" * 8 + b"\r"


def shown(data: bytes) -> str:
    return "".join(chr(it) if 0x20 <= it < 0x7F else "." for it in data)


def xxd(offset: int, row: bytes) -> str:
    return f"{offset:08x}: {row.hex(' ', -2):<39}  {shown(row)}"


def hexdump(offset: int, row: bytes) -> str:
    return f"{offset:08x}  {row[:8].hex(' '):<23}  {row[8:].hex(' '):<23}  |{shown(row)}|"


def od(offset: int, row: bytes) -> str:
    return f"{offset:07o} {row.hex(' ')}"


def tshark(offset: int, row: bytes) -> str:
    return f"{offset:04x}  {row.hex(' '):<47}   {shown(row)}"


Write = Callable[[int, bytes], str]
WAYS: list[Write] = [xxd, hexdump, od, tshark]


def dumped(data: bytes, write: Write, *after: str, protocol: Protocol | None = None) -> list[Piece]:
    lines = [write(at, data[at : at + 16]) for at in range(0, len(data), 16)]
    return list(pieces(enumerate((*lines, *after), 1), protocol))


@pytest.mark.parametrize("write", WAYS)
@pytest.mark.parametrize("protocol", [None, Protocol.DCON])
def test_frames_of_dcon_are_found_wherever_they_begin(write: Write, protocol: Protocol | None) -> None:
    found = dumped(ASCII, write, protocol=protocol)

    assert [it.wire for it in found] == [it + b"\r" for it in ASCII.split(b"\r")[:-1]]
    assert {it.kind for it in found} == {Kind.DCON}
    assert [(it.number, it.last) for it in found] == [(1, 1), (1, 1), (1, 2), (2, 2), (2, 3), (3, 6)]


@pytest.mark.parametrize("write", WAYS)
def test_frames_of_modbus_are_found_wherever_they_begin(write: Write) -> None:
    found = dumped((REQUEST + RESPONSE) * 3, write)

    assert [it.wire for it in found] == [REQUEST, RESPONSE] * 3
    assert {it.kind for it in found} == {Kind.MODBUS}


def test_the_text_of_a_frame_is_the_rows_that_have_it() -> None:
    lines = [xxd(at, ASCII[at : at + 16]) for at in range(0, len(ASCII), 16)]

    found = list(pieces(enumerate(lines, 1)))

    assert found[2].text == "\n".join(lines[:2])


def test_bytes_between_frames_are_damaged() -> None:
    found = dumped(b"$012\r\xff\xfe" + b"!010F0600\r$01M\r", hexdump)

    assert [(it.kind, it.wire) for it in found] == [
        (Kind.DCON, b"$012\r"),
        (Kind.DAMAGED, b"\xff\xfe"),
        (Kind.DCON, b"!010F0600\r"),
        (Kind.DCON, b"$01M\r"),
    ]


def test_what_is_unfinished_at_the_end_of_a_dump_is_damaged() -> None:
    found = dumped(ASCII[:25], xxd, "COM3 closed")

    assert [(it.kind, it.wire) for it in found[-2:]] == [(Kind.DAMAGED, b"!0170"), (None, b"")]


def test_a_row_alone_is_a_line_like_any_other() -> None:
    found = [*dumped(ASCII[:15], xxd), *pieces([(1, xxd(0, b"$012\r")), (2, xxd(0, b"$01M\r"))])]

    assert [it.wire for it in found] == [b"$012\r", b"!010F0600\r", b"$012\r", b"$01M\r"]


def test_a_dump_follows_a_part_of_a_frame() -> None:
    lines = [REQUEST[:4].hex(" "), xxd(0, ASCII[:16]), xxd(16, ASCII[16:32])]

    found = list(pieces(enumerate(lines, 1)))

    assert found[0].wire == REQUEST[:4]
    assert b"$01M\r" in [it.wire for it in found]


@pytest.mark.parametrize(
    ("line", "wire"),
    [
        ("0x0010: 24 30 31", b"$01"),
        ("0010 24 30 31 32", b"$012"),
        ("00000000  24 30 31 32 0d 21 30 31  30 46  |$012.!010F|", b"$012\r!010F"),
        ("00000000  24 30 31 32 0d 21 30 31  30 46", b"$012\r!01"),
        ("00000000: 3031 3233  0123", b"0123"),
        ("0010 2430 1", b"$0"),
    ],
)
def test_a_row_ends_where_its_text_begins(line: str, wire: bytes) -> None:
    row = read_row(1, line)

    assert row is not None
    assert row.wire == wire


@pytest.mark.parametrize("line", ["", "12:00:01 24 30", "0010", "0010 243", "port 0010 24 30", "00000025", "0010 24x"])
def test_other_lines_are_no_rows(line: str) -> None:
    assert read_row(1, line) is None


@given(st.lists(st.sampled_from((REQUEST, RESPONSE, b"$012\r", b"\xff\x00", b">+0025.1\r", b"")), max_size=12))
def test_every_byte_of_a_dump_is_in_one_piece(parts: list[bytes]) -> None:
    data = b"".join(parts)

    for write in WAYS:
        lines = [write(at, data[at : at + 16]) for at in range(0, len(data), 16)]
        if len(lines) > 1:
            assert b"".join(it.wire for it in pieces(enumerate(lines, 1))) == data
