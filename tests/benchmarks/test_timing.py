"""What the benchmarks say of a comparison."""

from math import nan

import pytest

from tests.benchmarks.timing import Result, at_least, at_most, not_compared, shown, summary


@pytest.mark.parametrize(
    ("result", "verdict"),
    [
        (at_least("it", ours=1.0, theirs=2.0, target=1.2), "ok"),
        (at_least("it", ours=2.0, theirs=1.0, target=1.2), "MISSED"),
        (at_most("it", ours=1.0, theirs=4.0, target=0.5), "ok"),
        (at_most("it", ours=3.0, theirs=4.0, target=0.5), "MISSED"),
        (not_compared("it"), "not compared"),
        (Result("it", nan, "<= 2", met=True), "not compared"),
        (shown("it", 5.0), "shown"),
    ],
)
def test_a_result_is_ok_only_if_it_was_compared(result: Result, verdict: str) -> None:
    assert verdict == result.verdict
    assert str(result).startswith(verdict)
    assert "nan" not in str(result)


def test_the_summary_counts_what_was_not_compared() -> None:
    assert summary(["ok", "not compared", "ok", "shown"]) == "2 ok, 0 MISSED, 1 not compared, 1 shown"
