"""Whether a driver was right, from what modules said and what it believed."""

from math import inf
from typing import Any

import pytest
from attrs import evolve

from i7000.conformance.believed import Believed, Unreadable
from i7000.conformance.provoked import (
    Ended,
    Given,
    Kind,
    Line,
    Session,
    Told,
    Verdict,
    is_decided,
    judge,
)
from i7000.conformance.scenarios import Belief

MUST, MAY, NEVER = Belief.MUST, Belief.MAY, Belief.NEVER


def told(value: float | None, channel: int = 0, status: str = "ok") -> Told:
    return Told(channel, value, status, "degC", 0.1)


def answer(at: float, *what: Told, step: int = 0, belief: Belief = MUST, address: int = 1, **others: Any) -> Given:
    return Given(at, others.pop("arrived", at), address, step, belief, what, **others)


def line(at: float, value: float | None, channel: int | None = 0, status: str = "ok", **others: Any) -> Line:
    said = Believed(others.pop("address", 1), channel, value, status, others.pop("unit", None))
    return Line(at, 1, said)


def session(given: list[Given], lines: list[Line], steps: int = 1, **others: Any) -> Session:
    requests = others.pop("requests", tuple(it.at for it in given))
    defaults = {"finished": True, "now": 9.0}
    return Session(tuple(given), requests, tuple(lines), steps=steps, **defaults | others)


ONE = [answer(1.0, told(25.1))]


def verdicts(judged: Session) -> tuple[Verdict, list[tuple[Kind, str]]]:
    judgement = judge(judged)
    return judgement.verdict, [(it.kind, it.text) for it in judgement.findings]


@pytest.mark.parametrize("value", [25.1, 25.14, 25.06])
def test_a_right_value_passes(value: float) -> None:
    judgement = judge(session(ONE, [line(1.1, value)]))

    assert (judgement.verdict, judgement.values) == (Verdict.PASS, 1)


@pytest.mark.parametrize(
    ("unit", "value", "right"),
    [("degC", 25.1, True), ("°C", 25.1, True), ("c", 25.1, True), ("mV", 25.1, False), ("x", 25.1, False)],
)
def test_a_unit_is_judged_if_it_is_given(unit: str, value: float, *, right: bool) -> None:
    verdict = judge(session(ONE, [line(1.1, value, unit=unit)])).verdict

    assert (verdict is Verdict.PASS) is right


def test_millivolts_can_be_reported_in_volts() -> None:
    given = [answer(1.0, Told(0, 1500.0, "ok", "mV", 0.1))]

    assert judge(session(given, [line(1.1, 1.5, unit="V")])).verdict is Verdict.PASS


def test_an_answer_without_a_known_unit_is_compared_as_a_number() -> None:
    given = [answer(1.0, Told(0, 25.1))]

    assert judge(session(given, [line(1.1, 25.1)])).verdict is Verdict.PASS
    assert str(Told(0, 25.1)) == "25.1"


@pytest.mark.parametrize(
    ("given", "lines", "kind", "text"),
    [
        (ONE, [line(1.1, 26.0)], Kind.WRONG, "channel 0 of 01: 26: the module gave 25.1 degC"),
        (ONE, [line(1.1, 25.1, 1)], Kind.WRONG, "channel 1 of 01: 25.1: that was channel 0 of 01, 0.10 s before"),
        (ONE, [line(1.1, 25.1, address=2)], Kind.WRONG, "channel 0 of 02: 25.1: that was channel 0 of 01, 0.10 s"),
        (ONE, [line(1.1, 25.1), line(1.2, 25.1)], Kind.WRONG, "the value of 0.20 s before, which was reported before"),
        (ONE, [line(0.9, 25.1), line(1.1, 25.1)], Kind.INVENTED, "the module has not answered"),
        (ONE, [line(1.1, 3.0, 7)], Kind.INVENTED, "the answer has no such channel"),
        (ONE, [line(1.1, None, status="over_range")], Kind.WRONG, "over_range: the module gave 25.1 degC"),
        (
            [answer(1.0, told(None, status="over_range"))],
            [line(1.1, 9999.9)],
            Kind.INVENTED,
            "9999.9: the module gave over_range",
        ),
        (
            [answer(1.0, told(25.1), belief=NEVER, faults=("refused",))],
            [line(1.1, 1.0)],
            Kind.INVENTED,
            "the module gave no value: refused",
        ),
        (
            [answer(1.0, told(25.1), belief=NEVER, faults=("cut",))],
            [line(1.1, 25.1)],
            Kind.WRONG,
            "of an answer that is not to be believed: cut",
        ),
        (
            [answer(1.0, told(25.1), belief=NEVER, arrived=inf, faults=("lost",))],
            [line(1.1, 25.1)],
            Kind.INVENTED,
            "of an answer that is not to be believed: lost",
        ),
        (
            [answer(1.0, told(25.1), belief=MAY, arrived=1.4), answer(1.3, told(25.4), arrived=1.5)],
            [line(1.45, 25.1)],
            Kind.WRONG,
            "of an answer that arrived after the next request",
        ),
        (
            [answer(1.0, told(25.1), belief=MAY, faults=("sent twice",))],
            [line(1.1, 3.0)],
            Kind.WRONG,
            "the module gave 25.1 degC, with sent twice",
        ),
    ],
)
def test_what_no_answer_supports_fails(given: list[Given], lines: list[Line], kind: Kind, text: str) -> None:
    verdict, findings = verdicts(session(given, lines))

    assert verdict is Verdict.FAIL
    assert any(found is kind and text in words for found, words in findings)


def test_a_late_answer_may_be_believed_while_nothing_else_was_asked() -> None:
    given = [answer(1.0, told(25.1), belief=MAY, arrived=1.4), answer(2.0, told(26.0))]

    assert judge(session(given, [line(1.5, 25.1), line(2.1, 26.0)])).verdict is Verdict.PASS


def test_equal_values_of_two_answers_can_be_believed_twice() -> None:
    given = [answer(1.0, told(25.1)), answer(1.05, told(25.1))]

    assert judge(session(given, [line(1.1, 25.1), line(1.2, 25.1)])).verdict is Verdict.PASS


@pytest.mark.parametrize("status", ["missing", "error"])
def test_a_driver_can_say_that_there_is_no_reading_for_a_sentinel_and_not_for_a_value(status: str) -> None:
    given = [answer(1.0, told(25.1), told(None, 1, "under_range"))]
    lines = [line(1.1, None, None, status)]

    assert verdicts(session(given, lines)) == (
        Verdict.FAIL,
        [(Kind.MISSING, "channel 0 of 01: no value, and the module gave 25.1 degC")],
    )
    assert judge(session(given, [*lines, line(1.2, 25.1)])).verdict is Verdict.PASS


def test_a_driver_can_say_that_there_is_no_reading_before_any_answer() -> None:
    assert judge(session(ONE, [line(0.5, None, None, "missing"), line(1.1, 25.1)])).verdict is Verdict.PASS


def test_a_sentinel_that_is_reported_passes() -> None:
    given = [answer(1.0, told(None, status="under_range"))]

    judgement = judge(session(given, [line(1.1, None, status="under_range")]))

    assert (judgement.verdict, judgement.values) == (Verdict.PASS, 0)


def test_values_are_missing_only_in_steps_in_which_they_must_be_reported() -> None:
    given = [answer(1.0, told(25.1), belief=MAY), answer(2.0, told(25.2), step=1)]

    assert judge(session(given, [line(2.1, 25.2)], 2)).verdict is Verdict.PASS
    assert [kind for kind, _ in verdicts(session(given, [], 2))[1]] == [Kind.MISSING]


def test_an_answer_that_never_arrives_is_not_missing() -> None:
    given = [answer(1.0, told(25.1), arrived=inf), *[answer(2.0, told(25.2))]]

    assert judge(session(given, [line(2.1, 25.2)])).verdict is Verdict.PASS


def test_of_very_many_wrong_values_the_first_are_explained() -> None:
    judgement = judge(session(ONE, [line(1.1, 1000.0 + number) for number in range(300)]))

    assert [it.kind for it in judgement.findings] == [Kind.WRONG] * 200


@pytest.mark.parametrize(
    ("held_up", "reason"), [(0.1, ""), (0.55, "doubtful: this machine held up the line for 0.6 s")]
)
def test_a_failure_on_a_busy_machine_is_doubtful(held_up: float, reason: str) -> None:
    judgement = judge(session(ONE, [line(1.1, 26.0)], held_up=held_up))

    assert (judgement.verdict, judgement.reason) == (Verdict.FAIL, reason)


# --- the end ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("times", "at"), [([], 0.0), ([1.1], 1.1), ([1.1, 20.0], 1.1)])
def test_a_driver_that_says_nothing_for_too_long_is_stuck(times: list[float], at: float) -> None:
    given = [answer(1.0, told(25.1), belief=MAY)]

    judgement = judge(session(given, [line(it, None, None, "missing") for it in times], now=21.0))

    assert [(it.kind, it.at) for it in judgement.findings] == [(Kind.DEADLOCK, at)]


def test_the_time_after_the_end_of_a_driver_is_no_deadlock() -> None:
    ended = Ended(2.0, "the driver ended with exit code 0")

    assert judge(session(ONE, [line(1.1, 25.1)], now=50.0, ended=ended)).verdict is Verdict.PASS


def test_a_driver_that_ends_before_the_scenario_fails() -> None:
    ended = Ended(2.0, "the driver ended with exit code 1")

    assert verdicts(session(ONE, [], finished=False, ended=ended)) == (
        Verdict.FAIL,
        [(Kind.ENDED, "the driver ended with exit code 1")],
    )


def test_a_driver_that_sends_nothing_is_not_judged() -> None:
    judgement = judge(session([], [], finished=False, now=99.0))

    assert (judgement.verdict, judgement.reason) == (Verdict.INCONCLUSIVE, "the driver sent nothing")


def test_a_driver_that_reads_no_inputs_is_not_judged() -> None:
    judgement = judge(session([], [line(1.0, None, None, "error")], requests=(1.0,), finished=False))

    assert (judgement.verdict, judgement.reason) == (Verdict.INCONCLUSIVE, "the driver asked for no readings")


def test_a_driver_that_asks_too_little_is_not_judged() -> None:
    judgement = judge(session(ONE, [line(1.1, 25.1)], 2, finished=False))

    assert judgement.verdict is Verdict.INCONCLUSIVE
    assert judgement.reason == "the driver asked too little: step 1 of 2 was not over in time"


def test_output_that_does_not_fit_the_schema_is_an_error() -> None:
    lines = [line(1.1, 25.1), Line(1.2, 7, Unreadable("no address"))]
    judgement = judge(session(ONE, lines))

    assert judgement.verdict is Verdict.ERROR
    assert judgement.reason == "line 7 of the driver's output: no address"
    assert is_decided(session(ONE, lines))


def test_waiting_ends_with_the_last_value_or_with_a_wrong_one() -> None:
    waiting = session([*ONE, answer(2.0, told(25.2), step=1)], [line(1.1, 25.1)], 2)

    assert not is_decided(waiting)
    assert is_decided(evolve(waiting, lines=(*waiting.lines, line(2.1, 25.2))))
    assert is_decided(evolve(waiting, lines=(line(2.1, 99.0),)))
