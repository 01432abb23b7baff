"""minimalmodbus on a pseudo-terminal: registers, bits, long numbers, signed decimals, and function 46h."""

from calendar import timegm
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import minimalmodbus
import pytest
import serial

from i7000.simulator.pseudo_terminal import open_pty
from tests.interop.scenes import (
    LOGGER,
    MANY_DEGREES,
    MANY_THERMOCOUPLES,
    MIXED,
    NOBODY,
    ONE_BUS,
    SCENES,
    SINGLE_ENDED,
    THERMOCOUPLES,
    VOLTAGES,
    Scene,
)
from tests.simulator.running import Running, running

MODULE_SETTINGS = 0x46
LOW_WORD_FIRST = minimalmodbus.BYTEORDER_LITTLE_SWAP


@contextmanager
def port(here: Running) -> Iterator[serial.Serial]:
    with serial.Serial(here.place, 9600, timeout=1) as opened:
        yield opened


def instrument(opened: serial.Serial, address: int) -> Any:
    return minimalmodbus.Instrument(opened, address)


def settings(asked: Any, *payload: int) -> bytes:
    """Send function 46h; silence ends the response, because minimalmodbus does not know its length."""
    asked.serial.timeout = 0.1
    answer: bytes = asked._perform_command(MODULE_SETTINGS, bytes(payload))  # noqa: SLF001 - it offers no other way
    asked.serial.timeout = 1
    return answer


def test_it_reads_all_channels_of_a_bus_of_many_modules() -> None:
    with running(open_pty, *ONE_BUS) as here, port(here) as opened:
        for scene in SCENES:
            asked = instrument(opened, scene.address)

            assert list(scene.words) == asked.read_registers(0, len(scene.words), functioncode=4)
            assert list(scene.words) == asked.read_registers(0, len(scene.words), functioncode=3)


def test_it_reads_signed_numbers_with_decimals() -> None:
    with running(open_pty, MIXED.simulated, MANY_THERMOCOUPLES.simulated) as here, port(here) as opened:
        mixed, many = instrument(opened, 3), instrument(opened, 5)

        assert [mixed.read_register(at, at + 1, functioncode=4, signed=True) for at in range(2)] == [25.1, -12.34]
        assert [
            mixed.read_register(at, decimals, functioncode=4, signed=True) for at, decimals in ((4, 4), (5, 3), (6, 3))
        ] == [1.5, -9.999, 12.345]
        assert mixed.read_register(128, 2, functioncode=4, signed=True) == -3.21
        assert [round(value) for value in MANY_DEGREES] == [
            many.read_register(32 + at, functioncode=4, signed=True) for at in range(16)
        ]


def test_it_reads_long_numbers() -> None:
    """Firmware B4.5, and module name 00701700."""
    with running(open_pty, VOLTAGES.simulated) as here, port(here) as opened:
        asked = instrument(opened, 1)

        assert asked.read_long(480, byteorder=LOW_WORD_FIRST) == 0x000B0405
        assert asked.read_long(482, byteorder=LOW_WORD_FIRST) == 0x00701700


@pytest.mark.parametrize(("big_endian", "order"), [(0, LOW_WORD_FIRST), (1, minimalmodbus.BYTEORDER_BIG)])
def test_it_sets_a_clock_in_either_order_of_words(big_endian: int, order: int) -> None:
    moment = (2026, 2, 28, 23, 59, 0)
    with running(open_pty, LOGGER.simulated) as here, port(here) as opened:
        asked = instrument(opened, 6)
        asked.write_bit(282, big_endian)
        asked.write_long(16, timegm(moment), byteorder=order)
        date = asked.read_registers(864, 5)
        seconds = asked.read_long(16, byteorder=order)

    assert list(moment[:5]) == date
    assert seconds - timegm(moment) in range(3)


def test_it_sets_registers() -> None:
    with running(open_pty, MIXED.simulated) as here, port(here) as opened:
        asked = instrument(opened, 3)
        asked.write_register(488, 12.3, 1, functioncode=6)
        asked.write_registers(352, [1, 2, 3, 4, 5, 6, 7, 65535])
        asked.write_register(490, -0.16, 2, signed=True)

        assert asked.read_register(488, 1) == 12.3
        assert asked.read_registers(352, 8) == [1, 2, 3, 4, 5, 6, 7, 65535]
        assert asked.read_register(490) == 65520


def test_it_reads_and_sets_bits() -> None:
    with running(open_pty, MIXED.simulated, SINGLE_ENDED.simulated) as here, port(here) as opened:
        asked, many = instrument(opened, 3), instrument(opened, 4)

        assert asked.read_bits(128, 8, functioncode=2) == [0, 0, 1, 1, 0, 0, 0, 0]
        assert many.read_bits(128, 10, functioncode=2) == [0, 0, 1, 0, 1, 0, 0, 0, 0, 0]
        asked.write_bit(260, 1)
        asked.write_bits(267, [0, 0])
        assert asked.read_bits(259, 2, functioncode=1) == [0, 1]
        assert asked.read_bits(267, 2, functioncode=1) == [0, 0]
        assert asked.read_bit(272, functioncode=1) == 1
        assert asked.read_bit(272, functioncode=1) == 0


def test_it_sends_function_46h() -> None:
    """Every sub-function, as 3.3 prints requests and answers."""
    with running(open_pty, MIXED.simulated) as here, port(here) as opened:
        asked = instrument(opened, 3)

        assert settings(asked, 0x00) == b"\x00\x00\x70\x19\x00"
        assert settings(asked, 0x05, 0) == b"\x05\x00\x06\x00\x00\x00\x01\x00\x00"
        assert settings(asked, 0x06, 0, 0x0A, 0, 0, 0, 1, 0, 0) == b"\x06\x00\x00\x00\x00\x00\x00\x00\x00"
        assert settings(asked, 0x05, 0) == b"\x05\x00\x0a\x00\x00\x00\x01\x00\x00"
        assert settings(asked, 0x07, 0, 1) == b"\x07\x18"
        assert settings(asked, 0x08, 0, 1, 0x0F) == b"\x08\x00"
        assert settings(asked, 0x07, 0, 1) == b"\x07\x0f"
        assert settings(asked, 0x20) == b"\x20\x0b\x04\x05"
        assert settings(asked, 0x26, 0x3A) == b"\x26\x00"
        assert settings(asked, 0x25) == b"\x25\x3a"
        assert settings(asked, 0x2A, 0x80) == b"\x2a\x00"
        assert settings(asked, 0x29) == b"\x29\x80"
        assert settings(asked, 0x2C, 0x00, 0xFF, 0xF0) == b"\x2c\x00"
        assert settings(asked, 0x2B, 0x00) == b"\x2b\xff\xf0"
        assert settings(asked, 0x2E, 0, 0) == b"\x2e\x00"
        assert settings(asked, 0x2D, 0) == b"\x2d\x00"
        assert settings(asked, 0x30, 0) == b"\x30\x00"
        assert settings(asked, 0x2F) == b"\x2f\x00"
        assert settings(asked, 0x04, NOBODY, 0, 0, 0) == b"\x04\x00\x00\x00\x00"
        assert settings(instrument(opened, NOBODY), 0x00) == b"\x00\x00\x70\x19\x00"


@pytest.mark.parametrize(
    ("scene", "mask"), [(VOLTAGES, b"\xff"), (LOGGER, b"\xff\xff"), (SINGLE_ENDED, b"\x0f\xff\xff")]
)
def test_a_mask_has_as_many_bytes_as_the_channels_need(scene: Scene, mask: bytes) -> None:
    with running(open_pty, scene.simulated) as here, port(here) as opened:
        answer = settings(instrument(opened, scene.address), 0x25)

    assert b"\x25" + mask == answer


@pytest.mark.parametrize(
    ("payload", "reason"),
    [
        ((0x01,), "data address"),
        ((0x04, 0, 0, 0, 0), "data value"),
        ((0x05, 1), "data value"),
        ((0x00, 0), "data value"),
    ],
    ids=["unknown sub-function", "address 0", "reserved byte", "too long"],
)
def test_a_wrong_function_46h_is_an_exception(payload: tuple[int, ...], reason: str) -> None:
    with (
        running(open_pty, MIXED.simulated) as here,
        port(here) as opened,
        pytest.raises(minimalmodbus.IllegalRequestError, match=reason),
    ):
        settings(instrument(opened, 3), *payload)


@pytest.mark.parametrize(
    ("start", "count", "reason"), [(8, 1, "data address"), (16, 1, "data address"), (7, 2, "data value")]
)
def test_what_does_not_exist_is_an_exception(start: int, count: int, reason: str) -> None:
    with running(open_pty, THERMOCOUPLES.simulated) as here, port(here) as opened:
        opened.timeout = 0.1  # for it waits for as many bytes as were asked for
        with pytest.raises(minimalmodbus.IllegalRequestError, match=reason):
            instrument(opened, 2).read_registers(start, count, functioncode=4)


def test_a_module_that_is_not_there_does_not_answer() -> None:
    with running(open_pty, *ONE_BUS) as here, port(here) as opened:
        opened.timeout = 0.1
        with pytest.raises(minimalmodbus.NoResponseError):
            instrument(opened, NOBODY).read_registers(0, 1)


def test_all_modules_carry_out_a_broadcast_without_a_response() -> None:
    with running(open_pty, VOLTAGES.simulated, MIXED.simulated) as here, port(here) as opened:
        instrument(opened, 0).write_register(488, 77, functioncode=6)

        assert [instrument(opened, address).read_register(488) for address in (1, 3)] == [77, 77]
        assert opened.in_waiting == 0
