"""Procedures that believe only what a module says twice."""

from collections.abc import Iterator
from typing import Any

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from i7000 import ArgumentError, Model, Profile, Protocol, ReportSettings, dcon
from i7000.device import factory
from i7000.errors import Fault
from i7000.host import Answered, Declined, Policy, Rejected, TimedOut
from i7000.host.procedures import Procedure, Result, Wait, ask, confirmed, identify
from tests.host.procedures.lines import SingleFlips
from tests.host.procedures.runner import Runner
from tests.host.procedures.scripted import run
from tests.host.procedures.test_identify import lies

NAME = dcon.ReadModuleName(0x01)
PROFILE = Profile(Model.I_7018)
ONE, OTHER = dcon.ModuleName(0x01, "7018"), dcon.ModuleName(0x01, "7019")
PATIENT = Policy(retries=2, turnaround=0.2, grace=0.4)


@pytest.mark.parametrize(
    ("said", "believed", "times"),
    [
        ([ONE, ONE], Answered(NAME, ONE), 2),
        ([ONE, OTHER, ONE], Answered(NAME, ONE), 3),
        ([ONE, OTHER, OTHER], Answered(NAME, OTHER), 3),
        ([ONE, OTHER, None], TimedOut(NAME), 3),
        ([ONE, None, ONE], Answered(NAME, ONE), 3),
        ([dcon.Refused(0x01)] * 2, Declined(NAME, dcon.Refused(0x01)), 2),
        ([None], TimedOut(NAME), 1),
    ],
)
def test_an_outcome_is_believed_if_there_are_two_of_it(said: list[Any], believed: Any, times: int) -> None:
    answers: Iterator[Any] = iter(said)

    result, steps = run(confirmed(ask(NAME, PROFILE)), {dcon.ReadModuleName: lambda _: next(answers)})

    assert result.outcome == believed
    assert len(steps) == times


def test_all_that_was_heard_is_passed_on() -> None:
    heard = Rejected(b"!02\r", Fault.ADDRESS, "")
    result: Result[Any] = Result(Answered(NAME, ONE), (heard,))

    found, _ = run(confirmed(ask(NAME, PROFILE)), {dcon.ReadModuleName: lambda _: result})

    assert found.others == (heard, heard)


def test_other_steps_are_done_once() -> None:
    def waiting() -> Procedure[str]:
        yield Wait(1.0)
        return "done"

    assert run(confirmed(waiting()), {}) == ("done", [Wait(1.0)])


def test_only_a_procedure_can_be_confirmed() -> None:
    with pytest.raises(ArgumentError):
        confirmed(identify)  # type: ignore[arg-type]


@given(st.sampled_from(Model), st.sampled_from((0.05, 0.2)), st.integers(0, 2**32))
def test_without_a_checksum_what_is_identified_twice_is_so(model: Model, often: float, seed: int) -> None:
    eeprom = evolve(factory(model), protocol=Protocol.DCON, report_settings=ReportSettings())
    runner = Runner.on(eeprom, policy=PATIENT, faults=SingleFlips(flip=often), seed=seed)

    found = runner.run(confirmed(identify(0x01, protocols=[Protocol.DCON], checksum=False)))

    assert lies(found, eeprom) == []
