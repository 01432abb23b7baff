"""The proof: what a module would carry out has hazards that the guard finds, whatever else is drawn.

`python -m tests.conformance.guard_campaign` does the same for as many strings as there is time for.
"""

from collections import Counter
from random import Random

import pytest

from i7000.conformance import DEFAULT_ALLOWED, Hazard, allowing
from tests.conformance.acting import COMBINATIONS, acted_after, combination_of, drawn, outcome_of
from tests.conformance.guard_campaign import strings_up_to

DRAWN = 100_000
CHUNK = 5_000
EACH = 2_000
SHORT = tuple(strings_up_to(2))


def test_every_combination_is_drawn() -> None:
    counts = Counter(map(combination_of, range(DRAWN)))

    assert set(COMBINATIONS) == set(counts)
    assert min(counts.values()) == DRAWN // len(COMBINATIONS)


@pytest.mark.no_cover
@pytest.mark.parametrize("first", range(0, DRAWN, CHUNK))
def test_whatever_a_module_acts_on_has_its_hazard(first: int) -> None:
    chance, acted = Random(first), Counter[Hazard]()
    for number in range(first, first + CHUNK):
        case = drawn(chance, number)
        outcome = outcome_of(case)
        acted.update(outcome.acted)

        assert outcome.is_covered, (case, outcome)
    assert set(Hazard) - {Hazard.OBSERVE} == set(acted), "the strings are not near enough"


@pytest.mark.no_cover
@pytest.mark.parametrize("first", range(0, len(SHORT), CHUNK))
def test_whatever_a_module_acts_on_in_two_bytes_has_its_hazard(first: int) -> None:
    chance = Random(first)
    for number, wire in enumerate(SHORT[first : first + CHUNK], first):
        case = drawn(chance, number, wire)
        outcome = outcome_of(case)

        assert outcome.is_covered, (case, outcome)


ALLOWANCES = (
    DEFAULT_ALLOWED,
    allowing([Hazard.BROADCAST]),
    allowing([Hazard.WRITE]),
    allowing([Hazard.COMM]),
    allowing([Hazard.CALIBRATION]),
)


@pytest.mark.no_cover
@pytest.mark.parametrize("allowed", ALLOWANCES)
def test_what_gets_out_does_nothing_beyond_what_is_allowed(allowed: frozenset[Hazard]) -> None:
    chance, let_out, kept_back = Random(len(allowed)), 0, 0
    for number in range(DRAWN, DRAWN + EACH):
        case = drawn(chance, number)
        acted = acted_after(case, allowed)
        if acted is None:
            kept_back += 1
            continue
        let_out += 1

        assert acted <= allowed, case
    assert min(let_out, kept_back) > EACH // 20
