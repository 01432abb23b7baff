"""Characters between ends that may not be set alike."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import BaudRate, CharacterFormat, InvalidValueError, LineSettings
from i7000.device import Uart
from i7000.device.uart import _levels, _sampled, hear_at
from i7000.strategies.device import uarts
from tests.each import each

UARTS = uarts()


def through_levels(data: bytes, sent: Uart, heard: Uart) -> bytes:
    levels = _levels(data, sent)
    return _sampled(
        levels, [at for (level, at), (before, _) in zip(levels[1:], levels, strict=False) if level < before], heard
    )


@given(st.binary(max_size=40), UARTS)
def test_an_end_with_the_same_settings_hears_what_was_sent(data: bytes, uart: Uart) -> None:
    assert bytes(byte & (1 << uart.data_bits) - 1 for byte in data) == through_levels(data, uart, uart)
    assert data == hear_at(data, uart, uart)


@given(st.binary(max_size=40), UARTS)
def test_more_stop_bits_are_but_silence(data: bytes, uart: Uart) -> None:
    other = Uart(uart.rate, parity=uart.parity, stop_bits=1, data_bits=uart.data_bits)

    assert data == hear_at(data, uart, other) == hear_at(data, other, uart)


@given(st.binary(max_size=40), UARTS, UARTS)
def test_no_settings_make_more_characters_than_there_is_time_for(data: bytes, sent: Uart, heard: Uart) -> None:
    time = len(data) * sent.character_time

    assert len(hear_at(data, sent, heard)) <= max(len(data), time / heard.character_time * 1.2 + 1)


@each("byte", range(256))
def test_a_parity_bit_is_a_stop_bit_to_an_end_without_parity(byte: int) -> None:
    odd = byte.bit_count() & 1

    assert bytes((byte,) * odd) == hear_at(bytes((byte,)), Uart(9600, parity="E"), Uart(9600))


def test_a_spike_that_is_shorter_than_half_a_bit_is_no_character() -> None:
    assert hear_at(b"\xff", Uart(115200), Uart(9600)) == b""


def test_a_line_has_the_settings_of_its_byte() -> None:
    line = LineSettings(BaudRate.BAUD_115200, CharacterFormat.O81)

    assert Uart(115200, parity="O") == Uart.of(line)
    assert Uart.of(line).character_time == pytest.approx(11 / 115200)


@pytest.mark.parametrize(
    ("field", "wrong"),
    [
        ("rate", lambda: Uart(0)),
        ("parity", lambda: Uart(9600, parity="X")),
        ("stop_bits", lambda: Uart(9600, stop_bits=3)),
        ("data_bits", lambda: Uart(9600, data_bits=9)),
        ("baud_rate", lambda: Uart.of(LineSettings(0x3F))),
    ],
)
def test_what_no_port_can_be_set_to_is_refused(field: str, wrong: object) -> None:
    with pytest.raises(InvalidValueError) as refused:
        wrong()  # type: ignore[operator] # each is a function

    assert field == refused.value.field
