from inspect import signature

import pytest

from tests.each import each


def test_every_case_that_fails_is_shown_with_its_id() -> None:
    seen = []

    @each("number", [pytest.param(number, id=f"number-{number}") for number in range(4)])
    def halves(number: int) -> None:
        seen.append(number)
        with pytest.raises(ZeroDivisionError):
            _ = 1 / (number % 2)

    with pytest.raises(BaseExceptionGroup, match="2 of 4 cases: number-1, number-3") as caught:
        halves()

    assert seen == [0, 1, 2, 3]
    assert [failure.__notes__ for failure in caught.value.exceptions] == [
        ["of the case number-1"],
        ["of the case number-3"],
    ]


def test_fixtures_are_given_to_every_case_and_are_all_that_pytest_sees() -> None:
    seen = []

    @each(("left", "right"), [pytest.param(1, "a"), pytest.param(2, "b")])
    def pairs(left: int, right: str, *, fixture: str) -> None:
        seen.append((left, right, fixture))

    pairs(fixture="f")

    assert list(signature(pairs).parameters) == ["fixture"]
    assert seen == [(1, "a", "f"), (2, "b", "f")]


def test_a_plain_value_is_a_case_of_its_own_name() -> None:
    @each("text", ["a"])
    def nothing(text: str) -> None:
        assert text == ""

    with pytest.raises(BaseExceptionGroup) as caught:
        nothing()

    assert [failure.__notes__[-1] for failure in caught.value.exceptions] == ["of the case 'a'"]


def test_no_cases_are_an_error() -> None:
    with pytest.raises(AssertionError):
        each("text", [])
