"""The steps of procedures, and the procedure of one request."""

from collections.abc import Callable
from typing import Any

import pytest

from i7000 import InvalidValueError, LineSettings, Model, Noise, Profile, dcon, modbus
from i7000.errors import Fault
from i7000.host import Answered, Late, Policy, TimedOut
from i7000.host.procedures import Ask, Procedure, Result, Step, Tell, Tune, Wait, ask

PROFILE = Profile(Model.M_7019R)
NAME = dcon.ReadModuleName(0x01)
READ = modbus.ReadInputRegisters(0x01, 0, 1)


def played(procedure: Procedure[Any], *results: Any) -> tuple[list[Step], Any]:
    """Send results to a procedure; return its steps and what it returned."""
    steps = [next(procedure), *(procedure.send(result) for result in results[:-1])]
    with pytest.raises(StopIteration) as ended:
        procedure.send(results[-1])
    return steps, ended.value.value


@pytest.mark.parametrize("policy", [None, Policy(retries=0)])
def test_the_procedure_of_one_request_returns_what_it_is_sent(policy: Policy | None) -> None:
    result: Result[Any] = Result(TimedOut(READ), (Late(b"!01\r"), Noise(b"\xff", Fault.LEADING)))

    assert ([Ask(READ, PROFILE, policy)], result) == played(ask(READ, PROFILE, policy), result)


def test_procedures_are_made_of_others() -> None:
    def module_name(address: int, profile: Profile) -> Procedure[str | None]:
        result = yield from ask(dcon.ReadModuleName(address), profile)
        yield Wait(0.5)
        return result.outcome.response.name if isinstance(result.outcome, Answered) else None

    answered = Result(Answered(NAME, dcon.ModuleName(0x01, "7019R")))

    assert ([Ask(NAME, PROFILE), Wait(0.5)], "7019R") == played(module_name(0x01, PROFILE), answered, None)
    assert played(module_name(0x01, PROFILE), Result(TimedOut(NAME)), None)[1] is None


def test_a_step_can_report_anything() -> None:
    assert Tell(["of any type"]).value == ["of any type"]


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: Ask(PROFILE, PROFILE), "command cannot be .*: an instance of Query"),  # type: ignore[arg-type]
        (lambda: Ask(READ, Model.M_7019R), "profile cannot be .*: an instance of Profile"),  # type: ignore[arg-type]
        (lambda: Ask(READ, PROFILE, 2), "policy cannot be 2: an instance of Policy or None"),  # type: ignore[arg-type]
        (lambda: Tune(9600), "line cannot be 9600: an instance of LineSettings"),  # type: ignore[arg-type]
        (lambda: Tune(LineSettings(0x2A)), r"baud_rate cannot be '2A': 03\.\.0A"),
        (lambda: Wait(-1), "seconds cannot be -1: seconds, 0 or more"),
        (lambda: Wait(float("nan")), "seconds cannot be nan: seconds, 0 or more"),
    ],
)
def test_an_invalid_step_is_refused(make: Callable[[], object], text: str) -> None:
    with pytest.raises(InvalidValueError, match=text):
        make()
