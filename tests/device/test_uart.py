"""Characters between ends that may not be set alike."""

from bisect import bisect_right
from fractions import Fraction
from itertools import pairwise, product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import BaudRate, CharacterFormat, InvalidValueError, LineSettings
from i7000.device import Uart
from i7000.device.uart import hear_at, levels_of, receiver
from i7000.strategies.device import uarts
from tests.each import each

UARTS = uarts()


def sampled(data: bytes, sent: Uart, heard: Uart) -> bytes:
    """What is received, by the definition: each bit in its middle, counted from the edge of the start bit."""
    edges = [(Fraction(0), 1)]
    at = Fraction(1, sent.rate)
    for byte in data:
        value = byte & (1 << sent.data_bits) - 1
        parity = [sent.parity_bit(value)] if sent.parity != "N" else []
        for bit in [0, *(value >> place & 1 for place in range(sent.data_bits)), *parity]:
            edges.append((at, bit))
            at += Fraction(1, sent.rate)
        edges.append((at, 1))
        at += Fraction(sent.stop_bits) / sent.rate
    times = [time for time, _ in edges]
    found, free = bytearray(), Fraction(0)
    for (_, before), (fall, level) in pairwise(edges):
        if level < before and fall >= free:
            count = heard.data_bits + 2 + (heard.parity != "N")
            moments = [fall + Fraction(2 * place + 1, 2 * heard.rate) for place in range(count)]
            start, *bits = [edges[bisect_right(times, moment) - 1][1] for moment in moments]
            if not start:
                free = moments[-1]
                value = sum(bit << place for place, bit in enumerate(bits[: heard.data_bits]))
                if bits[-1] and (heard.parity == "N" or bits[-2] == heard.parity_bit(value)):
                    found.append(value)
    return bytes(found)


@given(st.binary(max_size=12), UARTS, UARTS)
def test_an_end_receives_the_levels_in_the_middle_of_its_bits(data: bytes, sent: Uart, heard: Uart) -> None:
    assert sampled(data, sent, heard) == receiver(sent, heard)(levels_of(data, sent))


@each("rate", [rate.bits_per_second for rate in BaudRate])
def test_modules_with_other_settings_receive_the_levels_in_the_middle_of_their_bits(rate: int) -> None:
    data = b"$01M\r\xff\x00\x55"
    for parity, other in product("NEO", (Uart(it.bits_per_second, parity=form) for it in BaudRate for form in "NEO")):
        sent = Uart(rate, parity=parity)

        assert sampled(data, sent, other) == receiver(sent, other)(levels_of(data, sent))


def test_a_spike_does_not_shift_what_is_sampled_after_it() -> None:
    assert hear_at(b"\xff\x00", Uart(115200), Uart(9600)) == b"\xff"


@given(st.binary(max_size=40), UARTS)
def test_an_end_with_the_same_settings_hears_what_was_sent(data: bytes, uart: Uart) -> None:
    assert bytes(byte & (1 << uart.data_bits) - 1 for byte in data) == receiver(uart, uart)(levels_of(data, uart))
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
