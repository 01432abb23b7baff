"""What a driver has met on a line."""

from random import Random
from typing import Any

import pytest

from i7000 import Firmware, Model, dcon, modbus
from i7000.conformance.coverage import Coverage, Kind, Row, Seen, cover, kinds_of
from i7000.dissect import Direction, Heard, Knowledge, Known, Line, Place, hear_frame
from i7000.dissect.meaning import errata
from i7000.settings import Protocol
from i7000.simulator.deliveries import LOST
from i7000.simulator.faults import Exchange, Faults
from i7000.type_codes import TypeCode

DCON, RTU = Protocol.DCON, Protocol.MODBUS_RTU
READ = modbus.encode(modbus.ReadInputRegisters(1, 0, 2))
VALUES = modbus.encode(modbus.InputRegisters(1, (0x7FFF, 0x1000)))


def seen(*frames: bytes | tuple[bytes, str], model: Model = Model.I_7018, protocol: Protocol = DCON) -> list[Seen]:
    """Frames one after the other, the first from the host, each with a note."""
    known = Known(model, types=(TypeCode.K,) * 8)
    line = Line(Knowledge.given(known), protocol)
    found = []
    for number, frame in enumerate(frames):
        wire, note = frame if isinstance(frame, tuple) else (frame, "")
        line, heard = hear_frame(line, wire, protocol)
        found.append(Seen(heard, (note,) if note else (), None, float(number)))
    return found


def row(coverage: Coverage, kind: Any) -> Row:
    return next(it for it in coverage.rows if it.kind is kind)


def counts(coverage: Coverage, kind: Any) -> tuple[int, int, int, int]:
    found = row(coverage, kind)
    return found.asked, found.answered, found.refused, found.silent


def test_every_command_and_request_has_a_row() -> None:
    coverage = cover([])

    assert [len(coverage.group(name)) for name in ("commands", "functions", "sub-functions")] == [43, 8, 17]
    assert len({it.key for it in coverage.rows}) == len(coverage.rows)
    assert coverage.never == tuple(Kind)


def test_a_model_has_fewer() -> None:
    i_7018, m_7019 = cover([], [Model.I_7018]), cover([], [Model.I_7018, Model.M_7019R])

    assert {len(i_7018.group(name)) for name in ("functions", "sub-functions")} == {0}
    assert len(i_7018.group("commands")) < len(m_7019.group("commands")) < 43
    assert len(m_7019.group("functions")) == 8


def test_commands_are_counted_with_what_came_of_them() -> None:
    coverage = cover(seen(b"$012\r", b"!010F0600\r", b"$012\r", b"?01\r", b"$012\r", b"$01M\r", b"!017018\r"))

    assert counts(coverage, dcon.ReadConfiguration) == (3, 1, 1, 1)
    assert counts(coverage, dcon.ReadModuleName) == (1, 1, 0, 0)
    assert (coverage.kinds[Kind.REFUSED], coverage.kinds[Kind.SILENCE]) == (1, 1)
    assert Kind.REFUSED not in coverage.never
    assert set(errata(dcon.ReadConfiguration)) <= set(coverage.errata)


def test_the_last_command_without_an_answer_is_silent() -> None:
    assert counts(cover(seen(b"$012\r")), dcon.ReadConfiguration) == (1, 0, 0, 1)


def test_a_broadcast_has_no_answer_to_miss() -> None:
    coverage = cover(seen(b"~**\r", b"$01M\r", b"!017018\r"))

    assert counts(coverage, dcon.HostOk) == (1, 0, 0, 0)
    assert not coverage.kinds.get(Kind.SILENCE)


def test_sentinels_are_kinds_of_answers() -> None:
    coverage = cover(seen(b"#01\r", b">+9999.9-9999.9       " + b"+0025.1" * 5 + b"\r"))

    assert {Kind.OVER_RANGE, Kind.UNDER_RANGE, Kind.DISABLED}.isdisjoint(coverage.never)


def test_the_short_sentinels_of_old_firmware_are_another_kind() -> None:
    line = Line(Knowledge.given(Known(Model.I_7018, types=(TypeCode.K,) * 8, firmware=Firmware("B1.4"))), DCON)
    line, asked = hear_frame(line, b"#01\r", DCON)
    _, answer = hear_frame(line, b">+9999-0000" + b"+0025.1" * 6 + b"\r", DCON)

    coverage = cover([Seen(asked), Seen(answer)])

    assert {Kind.SHORT, Kind.OVER_RANGE, Kind.UNDER_RANGE}.isdisjoint(coverage.never)


def test_requests_are_counted_by_function_and_exceptions_by_code() -> None:
    exception = modbus.seal(b"\x01\x84\x02")
    coverage = cover(seen(READ, VALUES, READ, exception, model=Model.M_7018, protocol=RTU))

    assert counts(coverage, modbus.ReadInputRegisters) == (2, 1, 1, 0)
    assert coverage.exceptions == {2: 1}
    assert {Kind.EXCEPTION, Kind.OVER_RANGE}.isdisjoint(coverage.never)
    assert row(coverage, modbus.ReadInputRegisters).key == "04"
    assert row(coverage, modbus.ReadModuleName).key == "46/00"


def test_an_answer_with_notes_did_not_reach_the_host_as_it_was() -> None:
    answer = b"!017018\r"
    notes = ["late by 0.3 s", "the answer is lost", "refused", "cut after 3 bytes", "refused with exception 04"]
    frames: list[bytes | tuple[bytes, str]] = []
    for note in notes:
        frames += [b"$01M\r", (answer, note)]

    assert counts(cover(seen(*frames)), dcon.ReadModuleName) == (5, 1, 2, 2)


def test_notes_count_without_a_frame_too() -> None:
    coverage = cover([Seen(None, ("the answer is lost",)), Seen(None, ("byte 3 lost",), sent=True)])

    assert {kind for kind, count in coverage.kinds.items() if count} == {Kind.SILENCE, Kind.DAMAGED_REQUEST}


def test_what_cannot_be_decoded_is_damaged() -> None:
    coverage = cover(seen(b"$01Q\r", b"$01M\r", b"!01\xff\r"))

    assert coverage.others == 1
    assert {Kind.DAMAGED, Kind.DAMAGED_REQUEST}.isdisjoint(coverage.never)


def test_a_command_of_another_model_is_in_no_row() -> None:
    frames = seen(b"$01P\r", model=Model.M_7018)

    assert cover(frames, [Model.I_7018]).others == 1


def test_a_command_with_several_meanings_is_in_no_row() -> None:
    _, heard = hear_frame(Line(protocol=DCON), b"$01A\r", DCON)

    assert cover([Seen(heard)]).ambiguous == 1


def test_the_same_command_at_once_is_an_echo_and_later_a_retry() -> None:
    def repeated(after: float) -> Coverage:
        first, second = seen(b"$01M\r", b"$01M\r")
        return cover([first._replace(seconds=1.0), second._replace(seconds=1.0 + after)])

    assert (repeated(0.01).kinds.get(Kind.ECHO), counts(repeated(0.01), dcon.ReadModuleName)[0]) == (1, 1)
    assert (repeated(0.5).kinds.get(Kind.ECHO), counts(repeated(0.5), dcon.ReadModuleName)) == (None, (2, 0, 0, 2))


def test_an_echo_of_a_request_is_an_echo() -> None:
    echo = Heard(Place(2, ""), READ, RTU, Direction.ECHO)

    assert cover([Seen(echo)]).kinds == {Kind.ECHO: 1}


def test_an_answer_to_nothing_is_in_no_row() -> None:
    coverage = cover(seen(b"!017018\r"))

    assert not any(it.answered for it in coverage.rows)


EXCHANGE = Exchange(b"#01\r", DCON, earlier=b">+1\r")
REQUEST = Exchange(READ, RTU)
ANSWER = b">" + b"+025.12" * 8 + b"\r"


@pytest.mark.parametrize(
    ("faults", "answer", "exchange", "kind"),
    [
        (Faults(late=1.0), ANSWER, EXCHANGE, Kind.LATE),
        (Faults(silent=1.0), ANSWER, EXCHANGE, Kind.SILENCE),
        (Faults(drop=1.0), ANSWER, EXCHANGE, Kind.DAMAGED),
        (Faults(flip=1.0), ANSWER, EXCHANGE, Kind.DAMAGED),
        (Faults(corrupt=1.0), ANSWER, EXCHANGE, Kind.DAMAGED),
        (Faults(truncate=1.0), ANSWER, EXCHANGE, Kind.DAMAGED),
        (Faults(noise=1.0), ANSWER, EXCHANGE, Kind.NOISE),
        (Faults(duplicate=1.0), ANSWER, EXCHANGE, Kind.TWICE),
        (Faults(replay=1.0), ANSWER, EXCHANGE, Kind.EARLIER),
        (Faults(refuse=1.0), ANSWER, EXCHANGE, Kind.REFUSED),
        (Faults(refuse=1.0), VALUES, REQUEST, Kind.EXCEPTION),
        (Faults(misaddress=1.0), VALUES, REQUEST, Kind.OTHER_ADDRESS),
        (Faults(misfunction=1.0), VALUES, REQUEST, Kind.OTHER_COMMAND),
        (Faults(misfunction=1.0), ANSWER, EXCHANGE, Kind.OTHER_COMMAND),
        (Faults(lookalike=1.0), ANSWER, EXCHANGE, Kind.LOOKALIKE),
        (Faults(trailing=1.0), ANSWER, EXCHANGE, Kind.TRAILING),
        (Faults(split=1.0), ANSWER, EXCHANGE, Kind.PIECES),
        (Faults(lumps=True), ANSWER, EXCHANGE, Kind.PIECES),
    ],
    ids=str,
)
def test_the_words_of_each_fault_are_of_its_kind(faults: Faults, answer: bytes, exchange: Exchange, kind: Kind) -> None:
    transfer = faults.delivered(answer, 0.001, Random(1), exchange)

    assert {kind} == {it for note in transfer.faults for it in kinds_of(note)}


def test_an_answer_for_which_there_is_no_room_is_silence() -> None:
    assert kinds_of(LOST) == {Kind.SILENCE}
    assert kinds_of("nobody has asked") == set()
