"""The envelope, beyond the vectors."""

import pytest

from i7000 import DecodeError, Fault
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
