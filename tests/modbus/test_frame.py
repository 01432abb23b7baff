"""The envelope, beyond the vectors."""

from collections.abc import Callable
from typing import Any

import pytest

from i7000 import ArgumentError, DecodeError, Fault
from i7000.modbus import LONGEST_FRAME, SHORTEST_FRAME, crc16, seal, unseal
from tests.crc import crc


def bit_by_bit(data: bytes) -> int:
    return int.from_bytes(crc(data), "little")


def test_the_tables_give_what_the_bits_give_for_every_length_and_byte() -> None:
    every_byte = bytes(range(256))

    for length in range(LONGEST_FRAME + 1):
        assert bit_by_bit(every_byte[:length]) == crc16(every_byte[:length])
    for byte in every_byte:
        assert bit_by_bit(bytes((byte,))) == crc16(bytes((byte,)))
        assert bit_by_bit(bytes((0, byte))) == crc16(bytes((0, byte)))


@pytest.mark.parametrize("length", [SHORTEST_FRAME, 5, LONGEST_FRAME])
def test_a_frame_of_any_allowed_length_is_unsealed(length: int) -> None:
    body = bytes(range(length - 2))

    assert body == unseal(seal(body))


@pytest.mark.parametrize("length", [0, 1, SHORTEST_FRAME - 1, LONGEST_FRAME + 1, 1_000_000])
def test_a_frame_of_any_other_length_is_refused(length: int) -> None:
    with pytest.raises(DecodeError, match="allowed: 4 to 256 bytes") as caught:
        unseal(bytes(length))

    assert (Fault.LENGTH, min(length, LONGEST_FRAME)) == (caught.value.fault, caught.value.offset)


def test_the_error_for_a_wrong_crc_has_the_right_one() -> None:
    with pytest.raises(DecodeError, match=r"crc at byte 6 of .*; allowed: F1 CC \(manual 3\)") as caught:
        unseal(bytes.fromhex("010400000008f1cd"))

    assert Fault.CRC is caught.value.fault


def test_one_or_two_wrong_bits_are_always_noticed() -> None:
    frame = seal(bytes.fromhex("0104020123"))
    bits = [1 << at for at in range(8 * len(frame))]
    sent = int.from_bytes(frame, "big")

    for first in bits:
        for second in bits:
            damaged = sent ^ (first | second)
            assert crc16(damaged.to_bytes(len(frame), "big")) != 0


@pytest.mark.parametrize(
    ("frame", "offset", "field", "message"),
    [
        (b"\1\2\3", 3, "", "length at byte 3 of 01 02 03; allowed: 4 to 256 bytes (manual 3)"),
        (b"\1\3\2\0", 2, "crc", "crc at byte 2 of 01 03 02 00; allowed: 40 21 (manual 3)"),
        (
            b"\1" * 257, 256, "",
            f"length at byte 256 of {'01 ' * 19}01... (257 bytes); allowed: 4 to 256 bytes (manual 3)",
        ),
    ],
)  # fmt: skip
def test_an_error_has_every_fact_of_the_damage(frame: bytes, offset: int, field: str, message: str) -> None:
    with pytest.raises(DecodeError) as caught:
        unseal(frame)

    assert (frame, offset, field, message) == (
        caught.value.wire, caught.value.offset, caught.value.field, str(caught.value),
    )  # fmt: skip


@pytest.mark.parametrize(("name", "call"), [("data", crc16), ("body", seal), ("frame", unseal)])
def test_an_argument_of_the_wrong_type_is_named(name: str, call: Callable[[object], object]) -> None:
    with pytest.raises(ArgumentError) as caught:
        call(1)

    assert str(caught.value) == f"{name} must be bytes, bytearray or memoryview, not 1 (int)"


def test_whatever_holds_bytes_is_taken() -> None:
    digits: Any = bytearray(b"123456789")

    assert crc16(memoryview(digits)) == 0x4B37  # type: ignore[arg-type]
    assert seal(digits) == b"123456789\x37\x4b"
    assert unseal(digits + b"\x37\x4b") == b"123456789"
