"""What lines do to bytes."""

from random import Random

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from i7000 import InvalidValueError
from i7000.simulator.faults import Faults, Piece, Transfer

CHARACTER = 10 / 9600
ANSWER = b">" + b"+025.12" * 8 + b"\r"


@given(st.binary(max_size=300), st.integers(0, 1000))
def test_a_line_without_faults_delivers_what_was_sent_at_once(data: bytes, seed: int) -> None:
    assert Faults().delivered(data, CHARACTER, Random(seed)) == Transfer((Piece(data),))
    assert Faults().carried(data, Random(seed)) == (data, ())


@given(st.binary(min_size=1, max_size=100), st.integers(0, 1000))
def test_every_byte_can_be_lost_and_every_bit_flipped(data: bytes, seed: int) -> None:
    lost, told = Faults(drop=1.0).carried(data, Random(seed))
    flipped, others = Faults(flip=1.0).carried(data, Random(seed))

    assert lost == b""
    assert all((one ^ other).bit_count() == 1 for one, other in zip(data, flipped, strict=True))
    assert len(told) == len(others) == len(data)


@given(st.binary(max_size=100), st.integers(0, 1000))
def test_noise_comes_before_what_was_sent(data: bytes, seed: int) -> None:
    carried, told = Faults(noise=1.0).carried(data, Random(seed))

    assert carried.endswith(data)
    assert 1 <= len(carried) - len(data) <= 16
    assert told == (f"{len(carried) - len(data)} bytes of noise before",)


def test_faults_are_as_frequent_as_they_are_probable() -> None:
    data = bytes(100_000)

    carried, _ = Faults(drop=0.1).carried(data, Random(1))
    flipped, _ = Faults(flip=0.1).carried(data, Random(1))

    assert len(carried) == pytest.approx(90_000, rel=0.01)
    assert sum(map(bool, flipped)) == pytest.approx(10_000, rel=0.05)


def test_lumps_are_what_comes_in_within_16_ms() -> None:
    transfer = Faults(lumps=True).delivered(ANSWER, CHARACTER, Random(0))

    assert b"".join(piece.wire for piece in transfer.pieces) == ANSWER
    assert [len(piece.wire) for piece in transfer.pieces] == [15, 15, 15, 13]
    assert [piece.after for piece in transfer.pieces] == pytest.approx([0.016, 0.032, 0.048, 0.064])
    assert transfer.faults == ("in 4 lumps",)


@pytest.mark.parametrize("lumps", [False, True])
def test_a_late_answer_is_late_as_a_whole(*, lumps: bool) -> None:
    punctual = Faults(lumps=lumps).delivered(ANSWER, CHARACTER, Random(0))

    late = Faults(lumps=lumps, late=1.0, late_by=0.5).delivered(ANSWER, CHARACTER, Random(0))

    assert tuple(evolve(piece, after=piece.after + 0.5) for piece in punctual.pieces) == late.pieces
    assert "late by 0.5 s" in late.faults


@given(st.integers(0, 1000))
def test_the_same_chance_has_the_same_faults(seed: int) -> None:
    faults = Faults(drop=0.1, flip=0.1, noise=0.3, late=0.3)

    one, other = (faults.delivered(ANSWER, CHARACTER, Random(seed)) for _ in range(2))

    assert one == other


@pytest.mark.parametrize(("name", "value"), [("drop", 1.1), ("flip", -0.1), ("late", float("nan")), ("late_by", 61.0)])
def test_what_is_no_probability_and_no_time_is_refused(name: str, value: float) -> None:
    with pytest.raises(InvalidValueError) as refused:
        Faults(**{name: value})  # type: ignore[arg-type]

    assert name == refused.value.field
