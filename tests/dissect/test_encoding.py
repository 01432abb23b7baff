"""Text is read in the encoding that its file has."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000.dissect.encoding import decoder_for, encoding_of

TEXT = "12:00:01 TX: $012\r\n12:00:01 RX: !010F0600\r\n"


@pytest.mark.parametrize(
    "encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "latin-1", "ascii"]
)
def test_a_log_is_read_in_every_encoding(encoding: str) -> None:
    data = TEXT.encode(encoding)

    assert decoder_for(data[:64]).decode(data) == TEXT


@pytest.mark.parametrize("mark", [b"\xfe\xff", b"\x00\x00\xfe\xff"])
def test_a_mark_says_that_the_high_byte_comes_first(mark: bytes) -> None:
    data = mark + TEXT.encode("utf-16-be" if len(mark) == 2 else "utf-32-be")

    assert decoder_for(data).decode(data) == TEXT


@pytest.mark.parametrize(
    "beginning",
    [b"", b"\0", b"$\0", b"\0\0\0\0", bytes.fromhex("0104000000013100"), b"01\0\0", b"\0a\0\0"],
)
def test_bytes_that_say_nothing_of_their_encoding_are_utf8(beginning: bytes) -> None:
    assert encoding_of(beginning) == "utf-8"


def test_bytes_that_are_no_utf8_are_kept() -> None:
    assert decoder_for(b"\xff$012").decode(b"\xff$012", final=True) == "\udcff$012"


@given(st.binary(max_size=80), st.integers(0, 80))
def test_no_bytes_raise_however_they_arrive(data: bytes, cut: int) -> None:
    decoder = decoder_for(data[:64])

    assert isinstance(decoder.decode(data[:cut]) + decoder.decode(data[cut:], final=True), str)
