"""How numbers are written at the terminal."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000.cli.numbers import hex_byte, integer
from i7000.cli.words import UsageError
from i7000.describe import address as address_words


@given(st.integers(-0xFFFFFFFF, 0xFFFFFFFF))
def test_a_number_reads_the_same_in_each_spelling(number: int) -> None:
    sign = "-" if number < 0 else ""
    spellings = (f"{number}", f"{number:#x}", f"{sign}0X{abs(number):X}", f"{sign}{abs(number):02X}h", f"{number:x}H")

    assert [number] * 5 == [integer(spelling) for spelling in spellings]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1A", "'1A' has hex digits: write 0x1A or 1Ah"),
        ("ff", "'ff' has hex digits: write 0xff or ffh"),
        ("", "'' is not a whole number: write it in decimal, or in hex as 0x1A or 1Ah"),
        ("h", "'h' is not a whole number"),
        ("0x", "'0x' is not a whole number"),
        ("0x1Ah", "'0x1Ah' is not a whole number"),
        ("1.5", "'1.5' is not a whole number"),
        ("12345678901", "'12345678901' is too large: a number has at most ten digits"),
    ],
)
def test_a_text_with_no_or_two_readings_is_refused(text: str, message: str) -> None:
    with pytest.raises(UsageError) as refused:
        integer(text)

    assert str(refused.value).startswith(message)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("86", "'86' can be hex or decimal: write 0x86 or 86h"),
        ("C0", "'C0' can be hex or decimal: write 0xC0 or C0h"),
        ("106h", "'106h' is not a byte: 00h..FFh"),
        ("-1h", "'-1h' is not a byte"),
        ("256", "'256' is not a byte"),
        ("x", "'x' is not a whole number"),
    ],
)
def test_a_byte_of_settings_is_marked_as_hex(text: str, message: str) -> None:
    with pytest.raises(UsageError) as refused:
        hex_byte(text)

    assert str(refused.value).startswith(message)


@given(st.integers(0, 255))
def test_an_address_in_words_has_one_reading(address: int) -> None:
    words = address_words(address).split(" ")

    assert [integer(words[0]), *(integer(word.strip("()")) for word in words[1:])] == [address] * len(words)
    assert (address > 9) == (len(words) == 2)
