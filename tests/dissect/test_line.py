"""The listener: what each frame means after those before it, of either protocol and of both on one line."""

import gc
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import ArgumentError, DataFormat, Fault, Model, Protocol, TypeCode, dcon, modbus
from i7000.dissect import Direction, Heard, Knowledge, Known, Line, Place, flush, hear, hear_frame, line_dcon
from tests.dissect.frames import REQUEST, RESPONSE
from tests.dissect.hearing import hear_all, last_heard, line_of
from tests.dissect.strategies import frames, knowns, protocol_of, protocols

REPORT = ">" + "+0025.1" * 8
WRITE = modbus.encode(modbus.WriteSingleRegister(1, 488, 5))
OTHER = modbus.encode(modbus.ReadInputRegisters(1, 0, 2))


def names(heard: Heard) -> list[str]:
    return [type(meaning.message).__name__ for meaning in heard.meanings]


def directions(*sent: str | bytes, known: Known | None = None) -> list[str | None]:
    return [heard.direction for heard in hear_all(line_of(known), sent)[1]]


# --- places -----------------------------------------------------------------------------------------------------------


def test_frames_are_counted_where_no_place_is_given() -> None:
    _, heard = hear_all(Line(), ["$012", "!01050600"])

    assert [it.place for it in heard] == [Place(1, "frame 1"), Place(2, "frame 2")]
    assert heard[1].answers == heard[0].place


def test_a_place_that_is_given_goes_on_from_there() -> None:
    line, heard = hear_frame(Line(), b"$012\r", Protocol.DCON, Place(7, "line 40"))

    assert heard.place == Place(7, "line 40")
    assert hear_frame(line, b"!01050600\r", Protocol.DCON)[1].place == Place(8, "frame 8")


def test_bytes_of_a_stream_stand_where_the_caller_says() -> None:
    line, (command,) = hear(Line(protocol=Protocol.DCON), b"$012\r!0", "packet 1")
    line, (response,) = hear(line, b"1050600\r?", "packet 2")
    _, (rest,) = flush(line, "packet 2")

    assert [it.place for it in (command, response, rest)] == [(1, "packet 1"), (2, "packet 2"), (3, "packet 2")]
    assert response.answers == (1, "packet 1")


def test_no_bytes_are_no_frame() -> None:
    _, heard = hear_frame(Line(), b"", Protocol.DCON)

    assert heard.error is not None
    assert (heard.error.fault, heard.understood) == (Fault.LENGTH, False)


def test_bytes_that_are_no_frame_have_their_fault() -> None:
    _, found = hear(Line(protocol=Protocol.DCON), b"xx$012\r")

    assert [(it.wire, it.error and it.error.fault) for it in found] == [(b"xx", Fault.LEADING), (b"$012\r", None)]


# --- DCON -------------------------------------------------------------------------------------------------------------


def test_a_command_and_its_response_belong_together() -> None:
    _, (command, response) = hear_all(Line(), ["$012", "!010F0600"])

    assert (command.direction, response.direction) == (Direction.COMMAND, Direction.RESPONSE)
    assert response.answers == command.place
    assert (command.address, response.address) == (0x01, 0x01)


def test_a_report_has_the_address_of_its_command() -> None:
    assert last_heard("#010", ">+0025.1").address == 0x01
    assert last_heard(">+0025.1").address is None
    assert last_heard("#**", known=Known(Model.I_7018)).address is None


def test_what_is_the_same_as_the_command_before_is_an_echo_or_asked_again() -> None:
    _, (first, second, response) = hear_all(Line(), ["$012", "$012", "!010F0600"])

    assert second.same_as == first.place
    assert second.notes == ("the same as frame 1: an echo, or asked again",)
    assert response.answers == second.place


def test_the_same_command_after_its_response_is_a_new_one() -> None:
    assert last_heard("$012", "!010F0600", "$012").notes == ()


def test_a_late_response_belongs_to_the_command_before_the_last() -> None:
    _, heard = hear_all(line_of(Known(Model.I_7018)), ["$012", "$01M", "!010F0600"])

    assert heard[2].answers == heard[0].place
    assert heard[2].notes == ("a late answer: frame 1 asked for it, before the last command",)
    assert names(heard[2]) == ["Configuration"]


def test_a_late_response_after_a_command_was_repeated_belongs_to_the_one_before() -> None:
    _, heard = hear_all(line_of(Known(Model.I_7018)), ["$012", "$01M", "$01M", "!010F0600"])

    assert heard[3].answers == heard[0].place


def test_a_response_that_is_wrong_for_both_commands_answers_none() -> None:
    heard = last_heard("$012", "$01M", ">+0025.1", known=Known(Model.I_7018))

    assert heard.answers is None
    assert heard.error is not None
    assert [type(meaning.message).__name__ for meaning in heard.candidates] == ["CjcTemperature"]


def test_a_response_that_is_printed_twice_is_noticed() -> None:
    heard = last_heard("$012", "!010F0600", "!010F0600")

    assert heard.notes == ("the same again: an answer to frame 1 that was printed twice?",)
    assert heard.understood


def test_two_responses_to_one_command_are_of_two_modules() -> None:
    heard = last_heard("$012", "!010F0600", "!010E0600", known=Known(Model.I_7018))

    assert heard.contradictions == ("a second answer to frame 1: two modules on one address?",)
    assert not heard.understood


def test_a_response_that_cannot_be_the_second_answer_is_read_alone() -> None:
    heard = last_heard("$012", "!010F0600", "!017018", known=Known(Model.I_7018))

    assert heard.contradictions == ()
    assert names(heard) == ["ModuleName"]


def test_a_damaged_response_leaves_its_command_without_an_answer() -> None:
    _, heard = hear_all(line_of(Known(Model.I_7018)), ["$012", "!010F", "!010F0600"])

    assert heard[1].error is not None
    assert heard[2].answers == heard[0].place


def test_a_change_of_the_checksum_holds_from_its_answer_on() -> None:
    known = Known(Model.I_7018)
    on = dcon.seal(b"!01", checksum=True)[:-1].decode()
    line, heard = hear_all(line_of(known), ["$012", "!010F0600", "%01010F0640", on, "$012B7", "$012"])

    assert [it.understood for it in heard] == [True] * 5 + [False]
    assert line.knowledge.of(0x01).known.checksum is True


def test_the_checksum_of_a_module_that_is_given_without_one_can_be_switched_on() -> None:
    on = dcon.seal(b"!01", checksum=True)[:-1].decode()
    line, heard = hear_all(line_of(Known(Model.I_7018, checksum=False)), ["%01010F0640", on, "$012B7"])

    assert all(it.understood for it in heard)
    assert line.knowledge.of(0x01).known.checksum is True


def test_a_checksum_that_changes_with_the_next_power_on_is_open_until_a_frame_shows_it() -> None:
    line, heard = hear_all(line_of(Known(Model.I_7018)), ["%01010F0640", "!01", "$012"])

    assert all(it.understood for it in heard)
    assert line.knowledge.of(0x01).known.checksum is None


# --- what was assumed, learned or given, and does not fit ------------------------------------------------------------


@pytest.mark.parametrize(
    ("known", "report", "note"),
    [
        (Known(Model.I_7017), ">+0152.4", "another type"),
        (Known(Model.I_7017), ">+025.10", "another type or another data format"),
        (Known(Model.I_7018, types=(TypeCode.K,)), ">+025.10", "another data format"),
        (Known(Model.I_7018, types=(TypeCode.K,)), ">+0025.1" + "4E", ""),
    ],
)
def test_an_assumption_that_does_not_fit_is_dropped_with_a_note(known: Known, report: str, note: str) -> None:
    heard = last_heard("#010", report, known=known)

    assert [it for it in heard.notes if it.startswith("not as from")] == (
        [f"not as from the factory: {note}"] if note else []
    )
    assert heard.understood is bool(note)


@pytest.mark.parametrize(
    ("frame", "note"),
    [
        (dcon.seal(b"$012", checksum=True)[:-1].decode(), "with a checksum"),
        ("@01S", ""),
        ("#0113", "single-ended"),
    ],
)
def test_a_setting_that_a_frame_shows_by_itself_is_noticed(frame: str, note: str) -> None:
    heard = last_heard(frame, known=Known(Model.I_7017Z))

    assert heard.notes == ((f"not as from the factory: {note}",) if note else ())
    assert heard.understood


def test_the_firmware_of_old_reports_is_noticed_and_not_learned() -> None:
    known = Known(Model.I_7018P, types=(TypeCode.K,))
    line, heard = hear_all(line_of(known), ["#010", ">+9999"])

    assert heard[1].notes == ("not as from the factory: a firmware of before B1.5",)
    assert dict(line.knowledge.of(0x01).facts) == {}


def test_a_report_that_shows_the_data_format_teaches_it() -> None:
    line, _ = hear_all(line_of(Known(Model.I_7018, types=(TypeCode.K,))), ["#01", ">" + "7FFF" * 8])

    assert line.knowledge.of(0x01).known.data_format is DataFormat.HEX


@pytest.mark.parametrize(
    ("configuration", "report", "said"),
    [
        ("!01080600", REPORT, ("not type 08 (V_10), which frame 2 said",)),
        ("!01080602", ">" + "+02.510" * 8, ("not data format hex, which frame 2 said",)),
        ("!01080600", ">" + "7FFF" * 8, ("not data format engineering, which frame 2 said",)),
    ],
)
def test_what_was_learned_and_does_not_fit_a_report_is_dropped_and_costs_the_exit_code(
    configuration: str, report: str, said: tuple[str, ...]
) -> None:
    _, heard = hear_all(line_of(Known(Model.I_7017)), ["$012", configuration, "#01", report, "#01", report])

    assert heard[3].contradictions == said
    assert names(heard[3]) == ["AnalogInputs"]
    assert heard[5].understood


def test_a_fact_that_a_report_contradicts_is_no_longer_known() -> None:
    line, _ = hear_all(line_of(Known(Model.I_7017)), ["$012", "!01080600", "#01", REPORT])

    assert sorted(line.knowledge.of(0x01).facts) == ["checksum", "data_format", "line_settings"]


def test_what_was_learned_and_does_not_make_a_report_unreadable_is_kept() -> None:
    heard = last_heard("$012", "!01080600", "#01", ">+0025.1", known=Known(Model.I_7017))

    assert heard.error is not None
    assert heard.contradictions == ()


def test_a_reading_that_the_given_type_cannot_have_is_a_misfit() -> None:
    heard = last_heard("#010", ">+0152.4", known=Known(Model.I_7017, types=(TypeCode.V_10,)))

    assert heard.error is not None
    assert heard.error.fault is Fault.NUMBER
    assert heard.meanings[0].readings[0].value is None


def test_a_learned_type_that_a_reading_cannot_have_gives_way_to_the_reading() -> None:
    heard = last_heard("$012", "!01080600", "#010", ">+0152.4", known=Known(Model.I_7017))

    assert heard.contradictions == ("not type 08 (V_10), which frame 2 said",)
    assert heard.meanings[0].readings[0].unit is None


def test_type_and_format_of_the_configuration_are_used_for_the_reports() -> None:
    heard = last_heard("$012", "!01080602", "#01", ">0000012301257FFF1802744F98238124", known=Known(Model.I_7017))

    assert [reading.value for reading in heard.meanings[0].readings][:2] == [0.0, pytest.approx(0.0888, abs=1e-4)]
    assert heard.meanings[0].assumed == ()


# --- Modbus -----------------------------------------------------------------------------------------------------------


def test_a_request_and_its_response_belong_together() -> None:
    _, (request, response) = hear_all(Line(), [REQUEST, RESPONSE])

    assert (request.direction, response.direction) == (Direction.REQUEST, Direction.RESPONSE)
    assert response.answers == request.place


def test_an_echo_is_told_from_the_response_and_from_the_next_request() -> None:
    assert directions(REQUEST, REQUEST, RESPONSE, OTHER, OTHER) == ["request", "echo", "response", "request", "echo"]


def test_on_a_line_that_echoes_the_first_copy_of_a_write_is_the_echo() -> None:
    assert directions(WRITE, WRITE) == ["request", "response"]
    assert directions(REQUEST, REQUEST, RESPONSE, WRITE, WRITE, WRITE)[3:] == ["request", "echo", "response"]


def test_a_line_on_which_nothing_is_echoed_any_more_does_not_echo() -> None:
    sent = [REQUEST, REQUEST, RESPONSE, REQUEST, RESPONSE, WRITE, WRITE]

    assert directions(*sent)[3:] == ["request", "response", "request", "response"]


def test_the_response_of_another_module_is_wrong_where_it_stands() -> None:
    response = modbus.seal(bytes.fromhex("0204020b61"))
    heard = last_heard(REQUEST, response)

    assert heard.error is not None
    assert (heard.error.fault, heard.answers) == (Fault.ADDRESS, None)
    assert [type(meaning.message).__name__ for meaning in heard.candidates] == ["InputRegisters"]


def test_a_response_without_its_request_is_read_as_one() -> None:
    heard = last_heard(RESPONSE)

    assert (heard.direction, heard.notes) == (Direction.RESPONSE, ("read without its request",))


def test_a_wrong_response_that_is_a_request_too_is_doubted() -> None:
    wrong = modbus.encode(modbus.WriteSingleRegister(1, 488, 6))

    assert "or a wrong response to frame 1" in last_heard(WRITE, wrong).notes[0]


def test_a_frame_of_modbus_of_a_module_without_it_is_a_contradiction() -> None:
    heard = last_heard(REQUEST, known=Known(Model.I_7018))

    assert heard.contradictions == ("a Modbus RTU frame, which an I-7018 does not speak",)
    assert names(heard) == ["ReadInputRegisters"]


def test_models_that_have_no_modbus_contradict_it_too() -> None:
    heard = last_heard("$01M", "!017018BL", REQUEST)

    assert heard.contradictions == ("a Modbus RTU frame, which the module does not speak",)


def test_what_a_model_lacks_by_modbus_is_said() -> None:
    request = modbus.encode(modbus.ReadCjcOffset(1, 0))

    assert last_heard(request, known=Known(Model.M_7017)).notes[0].startswith("M-7017 has no ")


@pytest.mark.parametrize(
    ("sent", "direction"), [(True, Direction.REQUEST), (False, Direction.RESPONSE), (None, Direction.RESPONSE)]
)
def test_a_write_that_is_the_same_as_the_one_before_has_the_direction_that_is_known(
    sent: bool | None,  # noqa: FBT001 - a parameter of the test
    direction: Direction,
) -> None:
    line, _ = hear_frame(Line(), WRITE, Protocol.MODBUS_RTU, sent=True)
    _, heard = hear_frame(line, WRITE, Protocol.MODBUS_RTU, sent=sent)

    assert heard.direction in (direction, Direction.ECHO)


@pytest.mark.parametrize(
    ("frame", "sent", "notes"),
    [
        (b"$012\r", False, ("a command that the host received: an echo, or another host?",)),
        (b"!010F0600\r", True, ("a response that the host sent",)),
        (b"$012\r", True, ()),
    ],
)
def test_a_direction_that_does_not_fit_the_frame_is_noticed(
    frame: bytes,
    sent: bool,  # noqa: FBT001 - a parameter of the test
    notes: tuple[str, ...],
) -> None:
    _, heard = hear_frame(line_of(Known(Model.I_7018)), frame, Protocol.DCON, sent=sent)

    assert heard.notes == notes


@pytest.mark.parametrize(
    "arguments",
    [
        ("line", b"", Protocol.DCON),
        (Line(), b"", 0),
        (Line(), b"", Protocol.DCON, (1, "x")),
        (Line(), "$", Protocol.DCON),
    ],
)
def test_arguments_of_other_types_are_refused(arguments: tuple[Any, ...]) -> None:
    with pytest.raises(ArgumentError):
        hear_frame(*arguments)


def test_a_place_needs_a_number() -> None:
    with pytest.raises(ArgumentError, match="Place, with a number"):
        hear_frame(Line(), b"", Protocol.DCON, Place("1", "x"))  # type: ignore[arg-type]


# --- both on one line -------------------------------------------------------------------------------------------------


def test_exchanges_of_both_protocols_do_not_part_each_other() -> None:
    _, heard = hear_all(Line(), ["$022", REQUEST, "!02050600", RESPONSE])

    assert heard[2].answers == heard[0].place
    assert heard[3].answers == heard[1].place


def test_a_stream_of_both_protocols_is_heard_frame_by_frame() -> None:
    line, found = hear(Line(), b"$022\r" + REQUEST + RESPONSE + b"!02050600\r")
    _, rest = flush(line)

    assert [it.protocol for it in (*found, *rest)] == [
        Protocol.DCON, Protocol.MODBUS_RTU, Protocol.MODBUS_RTU, Protocol.DCON,
    ]  # fmt: skip


@pytest.mark.parametrize("protocol", Protocol)
def test_a_line_of_one_protocol_takes_the_other_for_noise(protocol: Protocol) -> None:
    line, found = hear(Line(protocol=protocol), b"$022\r" + REQUEST)
    _, rest = flush(line)

    assert [it.wire for it in (*found, *rest) if it.understood] == [b"$022\r" if protocol is Protocol.DCON else REQUEST]
    assert {it.protocol for it in (*found, *rest)} == {protocol}


# --- laws -------------------------------------------------------------------------------------------------------------


def shown(heard: Heard) -> object:
    """Everything that a frame was heard as; it is looked at, too."""
    return [
        heard.place, heard.wire, heard.protocol, heard.direction, heard.address, heard.answers, heard.same_as,
        heard.notes, str(heard.error), heard.contradictions, heard.understood,
        [
            (it.message, it.command, it.readings, it.items, it.facts, it.notes, it.fields, it.errata, it.pause,
             it.models, it.section, it.assumed, it.checksum, it.data_formats, str(it.misfit))
            for it in (*heard.meanings, *heard.candidates)
        ],
    ]  # fmt: skip


@given(knowns, protocols, frames)
def test_no_frames_raise_and_the_same_frames_are_heard_alike(
    known: Known, protocol: Protocol | None, sent: list[bytes]
) -> None:
    def heard_of(line: Line) -> list[object]:
        found = []
        for frame in sent:
            line, heard = hear_frame(line, frame, protocol_of(frame) if protocol is None else protocol)
            found.append(shown(heard))
        return found

    start = line_of(known)

    assert heard_of(start) == heard_of(start) == heard_of(line_of(known))


@given(knowns, frames)
def test_what_is_learned_never_makes_a_combination_that_no_module_has(known: Known, sent: list[bytes]) -> None:
    line = line_of(known)
    for frame in sent:
        line, _ = hear_frame(line, frame, protocol_of(frame))

    assert all(module.known.all for module in line.knowledge.modules.values())
    assert all(module.given in (known, Known()) for module in line.knowledge.modules.values())


@given(knowns, protocols, frames, st.data())
def test_every_byte_is_heard_once_in_whatever_pieces_it_comes(
    known: Known, protocol: Protocol | None, sent: list[bytes], data: st.DataObject
) -> None:
    stream = left = b"".join(sent)
    line = Line(Knowledge.given(known), protocol)
    found: list[Heard] = []
    while left:
        size = data.draw(st.integers(1, 20))
        line, heard = hear(line, left[:size])
        found += heard
        left = left[size:]

        assert b"".join(it.wire for it in found) + line.rest + left == stream
    line, heard = flush(line)
    found += heard
    whole, first = hear(Line(Knowledge.given(known), protocol), stream)
    _, last = flush(whole)

    assert b"".join(it.wire for it in found) == stream
    assert line.rest == b""
    assert [it.wire for it in found if not it.error] == [it.wire for it in (*first, *last) if not it.error]
    assert [it.place.number for it in found] == list(range(1, len(found) + 1))


@pytest.mark.no_cover
def test_what_is_remembered_does_not_grow_with_modules_and_what_changes_of_them() -> None:
    def polled(line: Line, rounds: int) -> Line:
        for turn in range(rounds):
            for address in range(256):
                body = f"!{address:02X}{(0x0E, 0x0F, 0x10)[(turn + address) % 3]:02X}0600"
                line, _ = hear_all(line, [f"${address:02X}2", body])
        return line

    line = polled(line_of(Known(Model.I_7018)), 4)
    gc.collect()
    before = len(gc.get_objects())
    line = polled(line, 4)
    gc.collect()

    assert len(line.knowledge.modules) == 256
    assert len(gc.get_objects()) - before < 2000
    assert line_dcon._remembered.cache_info().maxsize is not None  # noqa: SLF001 - what it remembers is bounded
