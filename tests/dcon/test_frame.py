"""The envelope and the splitter, beyond the vectors."""

from collections.abc import Callable
from typing import Any

import pytest

from i7000 import ArgumentError, DecodeError, Fault, Noise
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


@pytest.mark.parametrize("checked", [False, True])
def test_the_longest_frame_has_a_body_and_one_byte_more_has_none(checked: bool) -> None:  # noqa: FBT001
    body = b"!" + b"0" * (LONGEST_FRAME - (4 if checked else 2))
    longest = seal(body, checksum=checked)

    assert len(longest) == LONGEST_FRAME
    assert body == unseal(longest, checksum=checked)
    with pytest.raises(DecodeError, match=f"1 to {LONGEST_FRAME} bytes"):
        unseal(seal(body + b"0", checksum=checked), checksum=checked)


def test_the_fault_of_the_longest_frame_is_not_its_length() -> None:
    with pytest.raises(DecodeError) as caught:
        unseal(b"!" + b"0" * (LONGEST_FRAME - 1), checksum=False)

    assert Fault.TERMINATOR is caught.value.fault


def test_the_fault_of_noise_is_the_first_byte_that_no_frame_has() -> None:
    (noise,), _ = split(b"$0\xff" + b"0" * LONGEST_FRAME + b"\xff\r")

    assert isinstance(noise, Noise)
    assert Fault.CHARACTER is noise.fault


def test_less_than_a_frame_is_kept_whatever_comes() -> None:
    for junk in (b"$", b"x", b"\xff", b"$0", b"\r", b"!" + b"0" * 300):
        _, rest = split(junk * 10_000)

        assert len(rest) < LONGEST_FRAME


@pytest.mark.parametrize(
    ("frame", "checksum", "offset", "field", "message"),
    [
        (b"", False, 0, "", "length at byte 0 of an empty frame; allowed: 1 to 256 bytes (manual 2)"),
        (b"!01", False, 3, "", "terminator at byte 3 of !01; allowed: one carriage return, at the end (manual 2)"),
        (
            b"!01\r\r", False, 3, "",
            r"terminator at byte 3 of !01\r\r; allowed: one carriage return, at the end (manual 2)",
        ),
        (
            b"!\x010\x01\r", False, 1, "",
            r"character at byte 1 of !\x010\x01\r; allowed: characters 20h..7Eh (manual 2)",
        ),
        (
            b"\r01\r", False, 0, "",
            r"terminator at byte 0 of \r01\r; allowed: one carriage return, at the end (manual 2)",
        ),
        (b"x01\r", False, 0, "", r"leading at byte 0 of x01\r; allowed: % # $ ~ @ ! > ? (manual 2)"),
        (
            b"!0\r", True, 2, "",
            r"length at byte 2 of !0\r; allowed: at least a leading character and a checksum (manual 2)",
        ),
        (b"!00\r", True, 1, "checksum", r"checksum at byte 1 of !00\r; allowed: 21 (manual 2)"),
        (b"!0100\r", True, 3, "checksum", r"checksum at byte 3 of !0100\r; allowed: 82 (manual 2)"),
    ],
)  # fmt: skip
def test_an_error_has_every_fact_of_the_damage(
    frame: bytes, checksum: bool, offset: int, field: str, message: str  # noqa: FBT001
) -> None:  # fmt: skip
    with pytest.raises(DecodeError) as caught:
        unseal(frame, checksum=checksum)

    assert (frame, offset, field, message) == (
        caught.value.wire, caught.value.offset, caught.value.field, str(caught.value),
    )  # fmt: skip


def test_a_frame_one_byte_too_long_is_damaged_at_its_end() -> None:
    with pytest.raises(DecodeError, match=r"length at byte 256 of .* \(257 bytes\); allowed: 1 to 256 bytes") as caught:
        unseal(b"!" + b"0" * (LONGEST_FRAME - 1) + b"\r", checksum=False)

    assert caught.value.section == "2"


def test_only_the_leading_characters_that_are_asked_for_are_taken() -> None:
    assert unseal(b"!01\r", checksum=False, leads=b"!>") == b"!01"
    with pytest.raises(DecodeError, match=r"leading at byte 0 of \$01\\r; allowed: ! > \(manual 2\)"):
        unseal(b"$01\r", checksum=False, leads=b"!>")


@pytest.mark.parametrize(
    ("name", "call"),
    [
        ("body", lambda: checksum(1)),  # type: ignore[arg-type]
        ("body", lambda: seal(1, checksum=False)),  # type: ignore[arg-type]
        ("checksum", lambda: seal(b"$012", checksum=1)),  # type: ignore[arg-type]
        ("frame", lambda: unseal(1, checksum=False)),  # type: ignore[arg-type]
        ("leads", lambda: unseal(b"!01\r", checksum=False, leads=1)),  # type: ignore[arg-type]
        ("checksum", lambda: unseal(b"!01\r", checksum=1)),  # type: ignore[arg-type]
        ("buffer", lambda: split(1)),  # type: ignore[arg-type]
        ("checksum", lambda: split(b"", checksum=1)),  # type: ignore[arg-type]
    ],
)
def test_an_argument_of_the_wrong_type_is_named(name: str, call: Callable[[], object]) -> None:
    kinds = "bool" if name == "checksum" else "bytes, bytearray or memoryview"

    with pytest.raises(ArgumentError) as caught:
        call()

    assert str(caught.value) == f"{name} must be {kinds}, not 1 (int)"


def test_whatever_holds_bytes_is_taken() -> None:
    body: Any = bytearray(b"$012")

    assert checksum(body) == 0xB7
    assert seal(body, checksum=True) == b"$012B7\r"
    assert unseal(body + b"B7\r", checksum=True) == b"$012"
    assert split(body + b"B7\r$0", checksum=True) == ((b"$012B7\r",), b"$0")
