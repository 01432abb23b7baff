"""The listener by Modbus RTU: what each frame means after those before it."""

import pytest

from i7000 import Fault, Model, Protocol, modbus
from i7000.dissect import Direction, Heard, Known, Line, hear_frame
from tests.dissect.frames import REQUEST, RESPONSE
from tests.dissect.hearing import hear_all, last_heard, line_of

WRITE = modbus.encode(modbus.WriteSingleRegister(1, 488, 5))
OTHER = modbus.encode(modbus.ReadInputRegisters(1, 0, 2))


def names(heard: Heard) -> list[str]:
    return [type(meaning.message).__name__ for meaning in heard.meanings]


def directions(*sent: str | bytes, known: Known | None = None) -> list[str | None]:
    return [heard.direction for heard in hear_all(line_of(known), sent)[1]]


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
