"""Lines as they arrive, from files, memory and pipes."""

import io
import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000.cli import source
from i7000.cli.source import LONGEST_LINE, Counted, Lines
from i7000.recording import End, Start, text
from tests.dissect.test_capture import pcap, record
from tests.simulation import MAIN
from tests.terminal import Run

PEAK = """
import resource, sys
from i7000.cli import main

code = main()
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, file=sys.stderr)
"""


def in_memory(log: bytes) -> list[tuple[int, bytes]]:
    return list(Lines(io.BytesIO(log), lambda: None))


class Pieces(io.BytesIO):
    """A stream that gives what it has in pieces."""

    def __init__(self, pieces: list[bytes]) -> None:
        super().__init__()
        self._pieces = iter(pieces)

    def read1(self, size: int | None = -1, /) -> bytes:  # noqa: ARG002 - of the protocol
        return next(self._pieces, b"")


@pytest.fixture
def pipe() -> Iterator[tuple[io.BufferedReader, int]]:
    """A pipe: a stream to read from, and where to write."""
    theirs, ours = os.pipe()
    with os.fdopen(theirs, "rb") as stream:
        yield stream, ours


# --- lines ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("log", "lines"),
    [
        (b"", []),
        (b"a", [(1, b"a")]),
        (b"a\nb\n", [(1, b"a\n"), (2, b"b\n")]),
        (b"a\r\n\r\nb", [(1, b"a\r\n"), (2, b"\r\n"), (3, b"b")]),
        (b"a\rb\r\n\rc\r", [(1, b"a\r"), (2, b"b\r\n"), (3, b"\r"), (4, b"c\r")]),
        (b"a\x0b\x0c\x1c\x85b\n", [(1, b"a\x0b\x0c\x1c\x85b\n")]),
    ],
)
def test_a_line_ends_in_lf_crlf_or_cr(log: bytes, lines: list[tuple[int, bytes]]) -> None:
    assert lines == in_memory(log)


@given(st.lists(st.binary(min_size=1) | st.sampled_from([b"\r", b"\n", b"\r\n", b"\r\r\n"])))
def test_it_does_not_matter_in_which_pieces_a_file_is_read(pieces: list[bytes]) -> None:
    log = b"".join(pieces)
    lines = list(Lines(Pieces(pieces), lambda: None))

    assert in_memory(log) == lines
    assert log == b"".join(line for _, line in lines)
    assert list(range(1, len(lines) + 1)) == [number for number, _ in lines]


@pytest.mark.parametrize("ended", [b"", b"\n", b"\r\n"])
def test_a_long_line_is_read_in_pieces_of_one_number(ended: bytes) -> None:
    for size in (LONGEST_LINE, LONGEST_LINE + 1, 3 * LONGEST_LINE, 3 * LONGEST_LINE + 5):
        lines = Lines(io.BytesIO(b"first\n" + b"x" * size + ended + b"\nlast"), lambda: None)
        found = list(lines)

        assert b"x" * size == b"".join(line for number, line in found if number == 2).rstrip()
        assert max(len(line) for _, line in found) <= LONGEST_LINE
        assert (found[0], found[-1][1]) == ((1, b"first\n"), b"last")
        assert (lines.long.count, str(lines.long)) == (1, "2")


def test_a_line_of_the_longest_length_is_whole() -> None:
    lines = Lines(io.BytesIO(b"x" * LONGEST_LINE), lambda: None)

    assert list(lines) == [(1, b"x" * LONGEST_LINE)]
    assert lines.long.count == 0


def test_what_is_there_is_given_before_waiting_for_more(pipe: tuple[io.BufferedReader, int]) -> None:
    stream, writer = pipe
    waits = 0

    def wait() -> None:
        nonlocal waits
        waits += 1

    lines = iter(Lines(stream, wait))
    os.write(writer, b"$012\r")
    assert next(lines) == (1, b"$012\r")
    os.write(writer, b"!01050600\rrest")
    assert next(lines) == (2, b"!01050600\r")
    os.write(writer, b" of it\nmore")
    assert next(lines) == (3, b"rest of it\n")
    os.close(writer)

    assert list(lines) == [(4, b"more")]
    assert waits == 5  # before each of four chunks, and for the LF after a CR that came last


def test_the_lf_of_a_crlf_may_come_later(pipe: tuple[io.BufferedReader, int]) -> None:
    stream, writer = pipe
    lines = iter(Lines(stream, lambda: None))
    os.write(writer, b"a\r")
    assert next(lines) == (1, b"a\r")
    os.write(writer, b"\nb\n")
    assert next(lines) == (2, b"b\n")
    os.write(writer, b"\nc\r")
    later = threading.Timer(0.005, os.write, (writer, b"\nd"))
    later.start()
    assert [next(lines), next(lines)] == [(3, b"\n"), (4, b"c\r\n")]
    later.join()
    os.close(writer)

    assert list(lines) == [(5, b"d")]


@pytest.mark.parametrize("error", [OSError, ValueError])
def test_where_nobody_knows_whether_more_comes_a_cr_is_an_end(
    pipe: tuple[io.BufferedReader, int], monkeypatch: pytest.MonkeyPatch, error: type[Exception]
) -> None:
    def refuse(*_: object) -> None:
        raise error

    monkeypatch.setattr(source, "select", refuse)
    stream, writer = pipe
    os.write(writer, b"a\r")
    lines = iter(Lines(stream, lambda: None))

    assert next(lines) == (1, b"a\r")
    os.close(writer)


def test_numbers_are_counted_once_and_the_first_are_named() -> None:
    counted = Counted()
    for number in (3, 3, *range(5, 30)):
        counted.add(number)

    assert counted.count == 26
    assert str(counted) == ", ".join(map(str, (3, *range(5, 24)))) + ", ..."


def test_a_number_of_zero_is_counted() -> None:
    counted = Counted()
    counted.add(0)

    assert (counted.count, str(counted)) == (1, "0")


# --- decode -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "data",
    [
        pcap() + bytes(8) + b"\xff" * 8,
        pcap()[:10],
        pcap(link_type=1),
        f'{text(Start("", "i7000 listen", "1", "COM3"))}\n{{"record": \n{text(End(0.5))}\n'.encode(),
    ],
    ids=["a packet of 4 GiB", "a header that is cut", "no serial line", "a recording with a damaged line"],
)
def test_damage_before_the_first_frame_is_not_understood(run: Run, tmp_path: Path, data: bytes) -> None:
    file = tmp_path / "damaged"
    file.write_bytes(data)
    result = run("decode", "--file", str(file))

    assert result.code == 1
    assert "not understood: " in result.err


def test_the_packets_and_frames_that_are_not_understood_are_counted_as_such(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "bus.pcap"
    file.write_bytes(pcap(record(b"$012\r"), record(b"$01m\r")))
    capture = run("decode", "--file", str(file), "--protocol", "dcon")
    stream = run("decode", "--raw", "--protocol", "dcon", stdin=b"$012\r$01m\r")

    assert (capture.err, stream.err) == ("i7000: 1 not understood: packet 2\n", "i7000: 1 not understood: frame 2\n")


def test_a_log_is_decoded_as_it_arrives() -> None:
    with subprocess.Popen(  # noqa: S603
        [sys.executable, "-c", MAIN, "decode"], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        os.write(process.stdin.fileno(), b"$012\r")
        shown = b""
        while b"\n       models " not in shown:
            shown += os.read(process.stdout.fileno(), 1 << 16)
        assert shown.startswith(b"1    $012\n     ReadConfiguration: ")

        os.write(process.stdin.fileno(), b"!01050600\r")
        shown = b""
        while b"\n       models " not in shown:
            shown += os.read(process.stdout.fileno(), 1 << 16)
        assert shown.startswith(b"2    !01050600\n     Configuration: ")
        process.stdin.close()
        assert process.wait() == 0


def test_a_long_line_is_reported_as_read_in_pieces(run: Run) -> None:
    result = run("decode", stdin=b"$012\n" + b"\0" * 200_000 + b"\n$012\n")

    assert result.err.splitlines() == [
        "i7000: 1 too long, read in pieces of 65536 bytes that may cut frames: line 2",
    ]
    assert result.out.count("\\x00") == 200_000
    assert result.code == 1


def test_a_long_line_may_cut_frames_so_it_is_not_all_understood(run: Run) -> None:
    result = run("decode", stdin=b" " * 70_000 + b"$012\n")

    assert "ReadConfiguration" in result.out
    assert "too long" in result.err
    assert result.code == 1


LOGS = {
    "zeros": b"\0" * (1 << 19),
    "no line ends": b"01 04 00 00 00 08 F1 CC " * (1 << 13),
    "bad lines": b"foo\n" * 50_000,
    "carriage returns": b"\r" * (1 << 18),
    "good lines": b"$012\n!01050600\n01 04 00 00 00 08 F1 CC\n" * 5_000,
}


@pytest.mark.parametrize("protocol", ["dcon", "rtu"])
@pytest.mark.parametrize("log", LOGS.values(), ids=LOGS)
def test_memory_does_not_grow_with_a_log(log: bytes, protocol: str, tmp_path: Path) -> None:
    def peak(log: bytes) -> int:
        path = tmp_path / "some.log"
        path.write_bytes(log)
        result = subprocess.run(  # noqa: S603
            [sys.executable, "-c", PEAK, "decode", "--protocol", protocol, "--file", str(path)],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            check=False,
        )
        return int(result.stderr.splitlines()[-1])

    small, large = peak(log[: len(log) // 4]), peak(log)
    assert (
        large < small + 2_000
    )  # kB; before, a line that was not understood took 75 bytes, and a long one 80 times its length


def test_a_log_in_utf_16_is_read_in_utf_8_wherever_its_pieces_end() -> None:
    log = "TX: $012\r\nRX: !010F0600\r\n".encode("utf-16")
    pieces = [log[:2], *(log[at : at + 3] for at in range(2, len(log), 3))]

    lines = list(Lines(Pieces(pieces), lambda: None))

    assert [line for _, line in lines] == [b"TX: $012\r\n", b"RX: !010F0600\r\n"]


def test_a_stream_has_an_empty_piece_for_each_silence(pipe: tuple[io.BufferedReader, int]) -> None:
    stream, ours = pipe
    found = source.chunks(stream, lambda: None)
    os.write(ours, b"$012\r")
    first, silence = next(found), next(found)
    os.write(ours, b"!01\r")
    os.close(ours)

    assert (first, silence, *found) == (b"$012\r", b"", b"!01\r")
