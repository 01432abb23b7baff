"""The envelope and the splitter, beyond the vectors."""

import pytest

from i7000 import DecodeError, Fault, Noise
from i7000.dcon.frame import LONGEST_FRAME, checksum, seal, split, unseal


def test_the_sum_does_not_see_digits_change_places() -> None:
    assert checksum(b">+025.12") == checksum(b">+052.12")


@pytest.mark.parametrize("frame", [b"$012b7\r", b"$012B8\r", b"$012\r", b"$00\r"])
def test_a_wrong_missing_or_lower_case_checksum_is_refused(frame: bytes) -> None:
    with pytest.raises(DecodeError) as caught:
        unseal(frame, checksum=True)

    assert Fault.CHECKSUM is caught.value.fault


@pytest.mark.parametrize("frame", [b"$\r", b"$0\r"])
def test_a_frame_too_short_for_a_checksum_is_refused(frame: bytes) -> None:
    with pytest.raises(DecodeError) as caught:
        unseal(frame, checksum=True)

    assert Fault.LENGTH is caught.value.fault


def test_the_longest_frame_is_found_and_one_byte_more_is_noise() -> None:
    longest = seal(b"!" + b"0" * (LONGEST_FRAME - 2), checksum=False)

    assert ((longest,), b"") == split(longest)
    assert ((Noise(b"!0" + longest[1:], Fault.LENGTH),), b"") == split(b"!0" + longest[1:])


def test_less_than_a_frame_is_kept_whatever_comes() -> None:
    for junk in (b"$", b"x", b"\xff", b"$0", b"\r", b"!" + b"0" * 300):
        _, rest = split(junk * 10_000)

        assert len(rest) < LONGEST_FRAME
