"""The listener by DCON: what each frame means after those before it."""

import pytest

from i7000 import DataFormat, Fault, Model, TypeCode, dcon
from i7000.dissect import Direction, Heard, Known, Line
from tests.dissect.hearing import hear_all, last_heard, line_of

REPORT = ">" + "+0025.1" * 8


def names(heard: Heard) -> list[str]:
    return [type(meaning.message).__name__ for meaning in heard.meanings]


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
    assert [type(meaning.message).__name__ for meaning in heard.candidates] == ["AnalogInput", "CjcTemperature"]


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
def test_what_was_learned_and_does_not_fit_two_reports_is_dropped_and_costs_the_exit_code(
    configuration: str, report: str, said: tuple[str, ...]
) -> None:
    _, heard = hear_all(line_of(Known(Model.I_7017)), ["$012", configuration, *["#01", report] * 3])

    assert heard[3].contradictions == heard[5].contradictions == said
    assert names(heard[3]) == ["AnalogInputs"]
    assert heard[7].understood


def test_a_fact_that_two_reports_contradict_is_no_longer_known() -> None:
    line, _ = hear_all(line_of(Known(Model.I_7017)), ["$012", "!01080600", *["#01", REPORT] * 2])

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


def test_a_frame_that_can_be_no_reading_shows_nothing_of_types() -> None:
    heard = last_heard(">+0025.1", known=Known(Model.I_7018))

    assert len(heard.meanings) > 1
    assert heard.notes == ()
