"""Time grows in proportion to what a function is given: eight times the bytes take eight times as long, not sixty-four.

Laws: every argument of bytes or text of every public function is tried; what it is given is a short block, repeated, so
that it is as hard at every length.
"""

from collections.abc import Callable
from contextlib import suppress
from random import Random
from time import process_time
from typing import Any

import pytest

from i7000 import I7000Error, Model, dcon, device, modbus
from i7000.device.uart import hear_at
from i7000.dissect import pieces
from tests.calls import CALLS

pytestmark = pytest.mark.no_cover

SHORT, TIMES = 64 * 1024, 8
GENEROUS = 2
"""What a byte of the long input may take, of that of the short one."""
NEGLIGIBLE = 0.005
"""Seconds of processor time for the long input that are too short to be compared."""
SLOW = 0.3
"""Seconds of processor time for the short input from which on an eighth of both shows as much: bytes that are copied
again and again take less than the rest then, at both lengths."""

BLOCKS = {
    "noise": Random(7000).randbytes(4096),
    "leads": b">",
    "frames": b"".join(
        (
            dcon.seal(b"$012", checksum=True),
            modbus.encode(modbus.ReadCoils(0x01, 0, 8)),
            Random(7000).randbytes(200),
        )
    ),
}
"""What is repeated; each of them is hard for some function."""


def of_length(block: bytes, length: int) -> bytes:
    return (block * (length // len(block) + 1))[:length]


def seconds(function: Callable[[Any], Any], value: bytes | str) -> float:
    """The processor time of one call, whether it gives a value or an error of ours."""
    start = process_time()
    with suppress(I7000Error):
        function(value)
    return process_time() - start


def grows_in_proportion(function: Callable[[Any], Any], short: bytes | str, long: bytes | str) -> bool:
    """Whether the long one takes not much longer a byte; a pause of the machine is not held against a function."""
    ratios = (seconds(function, long) / (seconds(function, short) + NEGLIGIBLE / TIMES) for _ in range(3))
    return any(ratio <= GENEROUS * TIMES for ratio in ratios)


def inputs() -> list[Any]:
    """Each argument of bytes or text of everything public, as a function of it."""
    return [
        pytest.param(function, type(argument), id=f"{call.name}-{at}")
        for call in CALLS
        for at, (argument, function) in enumerate(call.arguments())
        if type(argument) in (bytes, str)
    ]


@pytest.mark.parametrize("block", BLOCKS)
@pytest.mark.parametrize(("function", "kind"), inputs())
def test_time_grows_in_proportion_to_bytes_and_text(function: Callable[[Any], Any], kind: type, block: str) -> None:
    def made(length: int) -> Any:
        data = of_length(BLOCKS[block], length)
        return data.decode("latin-1") if kind is str else data

    length = SHORT // TIMES if seconds(function, made(SHORT)) > SLOW else SHORT
    assert grows_in_proportion(function, made(length), made(length * TIMES))


@pytest.mark.parametrize("block", BLOCKS)
@pytest.mark.parametrize("side", modbus.Side)
def test_time_grows_in_proportion_to_a_modbus_stream_of_each_side(side: modbus.Side, block: str) -> None:
    short, long = (of_length(BLOCKS[block], length) for length in (SHORT, SHORT * TIMES))

    assert grows_in_proportion(lambda data: modbus.split(data, side), short, long)
    assert grows_in_proportion(lambda data: modbus.flush(data, side), short, long)


MIXED = device.Bus((
    device.power_on(device.factory(Model.I_7018), now=0.0),
    device.power_on(device.factory(Model.M_7019R), now=0.0),
))  # fmt: skip


@pytest.mark.parametrize("block", BLOCKS)
def test_time_grows_in_proportion_to_what_modules_of_both_protocols_hear(block: str) -> None:
    def hear(data: bytes) -> object:
        return MIXED.hear(device.Ear(), data, (device.Signals(),) * 2, 0.0)

    assert grows_in_proportion(hear, *(of_length(BLOCKS[block], length) for length in (SHORT // 4, SHORT // 4 * TIMES)))


def test_time_grows_in_proportion_to_what_is_heard_at_another_speed() -> None:
    def hear(data: bytes) -> object:
        return hear_at(data, device.Uart(9600), device.Uart(19200))

    assert grows_in_proportion(
        hear, *(of_length(BLOCKS["noise"], length) for length in (SHORT // 16, SHORT // 16 * TIMES))
    )


LINES = (
    ">", "$", "!", "01 ", "\\x", "0x", "[01]", "'\\", '"\\x01" ', "$)", "#>", ">+0025.1", "0000", "1-4-0-",
    "$01 24 30 31 0d ", "12:00:01 ", "2026-11-30 ", "%0D", "FF FE ", "!01 01 04 00 ", " ", "a", "a ", "01 z 1 2 3 4 z ",
)  # fmt: skip
"""What is repeated in one line."""


@pytest.mark.parametrize("block", LINES)
def test_time_grows_in_proportion_to_a_line_in_which_frames_are_looked_for(block: str) -> None:
    def find(line: str) -> object:
        return list(pieces([(1, line)]))

    lengths = SHORT // 32, SHORT // 32 * TIMES
    assert grows_in_proportion(find, *((block * (length // len(block) + 1))[:length] for length in lengths))


def test_time_grows_in_proportion_to_the_lines_of_a_log_whose_frames_are_cut() -> None:
    def find(log: str) -> object:
        return list(pieces(enumerate(log.splitlines(), 1)))

    assert grows_in_proportion(find, *("RX 01 04\n" * (length // 256) for length in (SHORT, SHORT * TIMES)))
