"""What lines do to bytes."""

from random import Random
from typing import Any

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from i7000 import InvalidValueError, Protocol, dcon, modbus
from i7000.simulator.faults import Exchange, Faults, Piece, Transfer, Way

CHARACTER = 10 / 9600
LATE_OF_SEED_3 = [0, 5, 6, 9, 15]
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


# --- answers that are lost, cut, repeated or replaced -----------------------------------------------------------------


DCON, RTU = Protocol.DCON, Protocol.MODBUS_RTU
NAMED = Exchange(b"$01M\r", DCON, earlier=b"!01FF\r")
COILS = Exchange(modbus.encode(modbus.ReadCoils(1, 0, 8)), RTU)


def arrived(faults: Faults, answer: bytes, exchange: Exchange | None = None, seed: int = 0) -> tuple[bytes, str]:
    transfer = faults.delivered(answer, CHARACTER, Random(seed), exchange)
    return b"".join(piece.wire for piece in transfer.pieces), ", ".join(transfer.faults)


def test_a_lost_answer_arrives_in_no_piece() -> None:
    assert Faults(silent=1.0).delivered(ANSWER, CHARACTER, Random(0)) == Transfer((), ("the answer is lost",))


def test_a_duplicate_follows_at_once() -> None:
    assert arrived(Faults(duplicate=1.0), ANSWER) == (ANSWER * 2, "sent twice")


@given(st.binary(min_size=2, max_size=300), st.integers(0, 1000))
def test_a_truncated_answer_has_a_beginning_and_no_end(answer: bytes, seed: int) -> None:
    wire, told = arrived(Faults(truncate=1.0), answer, seed=seed)

    assert answer.startswith(wire)
    assert 0 < len(wire) < len(answer)
    assert told == f"cut after {len(wire)} bytes"


def test_one_byte_cannot_be_truncated() -> None:
    assert arrived(Faults(truncate=1.0), b"x") == (b"x", "")


@pytest.mark.parametrize(
    ("checksum", "refused"), [(False, b"?01\r"), (True, dcon.seal(b"?01", checksum=True))], ids=["plain", "checksum"]
)
def test_a_refusal_replaces_an_answer(*, checksum: bool, refused: bytes) -> None:
    exchange = evolve(NAMED, checksum=checksum)

    assert arrived(Faults(refuse=1.0), b"!017018\r", exchange) == (refused, "refused")


def test_an_exception_has_the_code_that_was_chosen() -> None:
    wire, told = arrived(Faults(refuse=1.0, refuse_code=6), b"", COILS)

    assert wire == modbus.seal(b"\x01\x81\x06")
    assert told == "refused with exception 06"


def test_an_earlier_answer_replaces_an_answer_if_there_is_one() -> None:
    assert arrived(Faults(replay=1.0), b"!017018\r", NAMED) == (b"!01FF\r", "an earlier answer")
    assert arrived(Faults(replay=1.0), b"!017018\r", evolve(NAMED, earlier=None)) == (b"!017018\r", "")


@pytest.mark.parametrize(
    ("answer", "exchange", "other"),
    [
        (b"!017018\r", NAMED, b"!027018\r"),
        (b"?01\r", NAMED, b"?02\r"),
        (b"!FF7018\r", Exchange(b"$FFM\r", DCON), b"!097018\r"),
        (dcon.seal(b"!017018", checksum=True), evolve(NAMED, checksum=True), dcon.seal(b"!027018", checksum=True)),
        (modbus.seal(b"\x01\x01\x01\xff"), COILS, modbus.seal(b"\x02\x01\x01\xff")),
        (modbus.seal(b"\xf7\x01\x01\xff"), Exchange(b"\xf7\x01", RTU), modbus.seal(b"\x01\x01\x01\xff")),
    ],
)
def test_a_misaddressed_answer_is_well_formed(answer: bytes, exchange: Exchange, other: bytes) -> None:
    wire, told = arrived(Faults(misaddress=1.0), answer, exchange)

    assert other == wire
    assert told.startswith("with address 0")


@pytest.mark.parametrize("answer", [ANSWER, b"", b"!", b"\x01\x02\x03\x04"])
@pytest.mark.parametrize(
    "exchange", [None, NAMED, Exchange(b"$1xM\r", DCON), Exchange(b"", RTU), Exchange(b"\x05", RTU)]
)
def test_an_answer_without_an_address_is_not_misaddressed(answer: bytes, exchange: Exchange | None) -> None:
    assert arrived(Faults(misaddress=1.0), answer, exchange) == (answer, "")


@pytest.mark.parametrize("request_", [b"", b"$", b"$1", b"$zz", b"$0a", b"$ 1"])
def test_an_answer_to_no_address_is_not_refused(request_: bytes) -> None:
    assert arrived(Faults(refuse=1.0), b"!01\r", Exchange(request_, DCON)) == (b"!01\r", "")


READ = Exchange(b"#01\r", DCON)
REGISTERS = modbus.seal(b"\x01\x04\x04\x00\x01\x00\x02")


@pytest.mark.parametrize(
    ("answer", "exchange", "other", "told"),
    [
        (b">+025.12\r", READ, b"!01+025.12\r", "with ! in place of >"),
        (b"!017018\r", NAMED, b">7018\r", "with > in place of !"),
        (
            dcon.seal(b">+025.12", checksum=True),
            evolve(READ, checksum=True),
            dcon.seal(b"!01+025.12", checksum=True),
            "with ! in place of >",
        ),
        (REGISTERS, COILS, modbus.seal(b"\x01\x03\x04\x00\x01\x00\x02"), "with function 03"),
        (modbus.seal(b"\x01\x84\x02"), COILS, modbus.seal(b"\x01\x47\x02"), "with function 47"),
    ],
)
def test_an_answer_to_another_command_is_well_formed(
    answer: bytes, exchange: Exchange, other: bytes, told: str
) -> None:
    assert arrived(Faults(misfunction=1.0), answer, exchange) == (other, told)


@pytest.mark.parametrize(
    ("answer", "exchange"),
    [(b"?01\r", NAMED), (b"!01\r", NAMED), (b">+1\r", Exchange(b"#x\r", DCON)), (b"\x01\x04", COILS), (b"", READ)],
)
def test_an_answer_to_no_other_command_stays_as_it_is(answer: bytes, exchange: Exchange) -> None:
    assert arrived(Faults(misfunction=1.0), answer, exchange) == (answer, "")


@given(st.binary(min_size=1, max_size=100), st.integers(0, 1000))
def test_one_bit_of_a_corrupt_answer_is_wrong(answer: bytes, seed: int) -> None:
    wire, told = arrived(Faults(corrupt=1.0), answer, seed=seed)

    assert sum((one ^ other).bit_count() for one, other in zip(answer, wire, strict=True)) == 1
    assert told.endswith("flipped")


@pytest.mark.parametrize(
    ("answer", "exchange", "before"),
    [
        (b">+025.12+1\r", READ, b">+025.12+\r"),
        (dcon.seal(b">+025.12", checksum=True), evolve(READ, checksum=True), dcon.seal(b">+025.1", checksum=True)),
        (REGISTERS, COILS, modbus.seal(b"\x01\x04\x02\x00\x01")),
    ],
)
def test_a_frame_that_looks_like_the_answer_is_good_and_shorter(
    answer: bytes, exchange: Exchange, before: bytes
) -> None:
    wire, told = arrived(Faults(lookalike=1.0), answer, exchange)

    assert wire == before + answer
    assert told == f"a frame of {len(before)} bytes that looks like it before"


@pytest.mark.parametrize(
    ("answer", "exchange"),
    [(b"!01\r", NAMED), (modbus.seal(b"\x01\x04\x02\x00\x01"), COILS), (b"", COILS), (ANSWER, None)],
)
def test_nothing_shorter_looks_like_the_shortest_answer(answer: bytes, exchange: Exchange | None) -> None:
    assert arrived(Faults(lookalike=1.0), answer, exchange) == (answer, "")


def test_the_crc_of_an_answer_stays_good_with_the_zero_after_it() -> None:
    wire, told = arrived(Faults(trailing=1.0), REGISTERS, COILS)

    assert (wire, told) == (REGISTERS + b"\0", "00 after it")
    assert modbus.crc16(wire) == 0


@given(st.binary(min_size=2, max_size=100), st.integers(0, 1000))
def test_a_split_answer_arrives_in_two_pieces(answer: bytes, seed: int) -> None:
    first, second = Faults(split=1.0, split_by=0.02).delivered(answer, CHARACTER, Random(seed)).pieces

    assert first.wire + second.wire == answer
    assert first.wire
    assert second.wire
    assert (first.after, second.after) == (0.0, 0.02)


def test_one_byte_cannot_be_split() -> None:
    assert Faults(split=1.0).delivered(b"x", CHARACTER, Random(0)) == Transfer((Piece(b"x"),))


@given(st.binary(max_size=80), st.binary(max_size=20), st.sampled_from(Protocol), st.integers(0, 99))
def test_any_bytes_are_delivered_with_any_fault(answer: bytes, request_: bytes, protocol: Protocol, seed: int) -> None:
    every = {
        "silent", "refuse", "replay", "misaddress", "misfunction", "corrupt", "lookalike", "trailing", "truncate",
        "duplicate", "drop", "flip", "noise", "late", "split",
    }  # fmt: skip
    faults = Faults(lumps=True, **dict.fromkeys(every, 0.5))  # type: ignore[arg-type]
    exchange = Exchange(request_, protocol, seed % 2 == 0, b"!01\r")

    one, other = (faults.delivered(answer, CHARACTER, Random(seed), exchange) for _ in range(2))

    assert one == other


def test_a_new_fault_leaves_the_others_of_a_seed_as_they_were() -> None:
    """The delays that ``late=0.25:0.9 --seed 3`` has had since the first release."""
    faults, chance = Faults(late=0.25, late_by=0.9), Random(3)

    late = [number for number in range(20) if faults.delivered(ANSWER, CHARACTER, chance, NAMED).pieces[0].after]

    assert late == LATE_OF_SEED_3


# --- in one direction, for one address --------------------------------------------------------------------------------


def test_a_fault_of_one_direction_is_not_in_the_other() -> None:
    faults = Faults().at(Way.TO, drop=1.0).at(Way.FROM, flip=1.0, late=1.0)

    assert (faults.requests.drop, faults.requests.flip, faults.requests.late) == (1.0, 0.0, 0.0)
    assert (faults.answers(1).drop, faults.answers(1).flip, faults.answers(None).late) == (0.0, 1.0, 1.0)


def test_the_closest_value_counts() -> None:
    faults = Faults(late=0.1, drop=0.1).at(Way.FROM, late=0.2).at(0x02, late=0.0)

    assert [faults.answers(address).late for address in (1, 2, None)] == [0.2, 0.0, 0.2]
    assert faults.answers(2).drop == faults.requests.drop == 0.1


def test_the_last_value_for_one_place_counts() -> None:
    assert Faults().at(1, late=0.5).at(1, late=0.7) == Faults().at(1, late=0.7)


@pytest.mark.parametrize(
    ("where", "values", "field"),
    [
        (Way.TO, {"late": 1.0}, "fault"),
        (Way.TO, {"echo": True}, "fault"),
        (1, {"echo": True}, "fault"),
        (1, {"scoped": 1}, "fault"),
        (1, {"drop": 2.0}, "drop"),
        (1, {"lumps": 1}, "lumps"),
        (1, {"refuse_code": 256}, "refuse_code"),
        (256, {"drop": 1.0}, "where"),
        ("to", {"drop": 1.0}, "where"),
    ],
)
def test_what_cannot_be_there_is_refused(where: Any, values: dict[str, Any], field: str) -> None:
    with pytest.raises(InvalidValueError) as refused:
        Faults().at(where, **values)

    assert field == refused.value.field
