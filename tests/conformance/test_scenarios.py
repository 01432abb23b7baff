"""What a driver is provoked with."""

import pytest

from i7000.cli.faults import read_faults
from i7000.conformance.scenarios import SCENARIOS, Belief, Bus, Scenario, refusal
from i7000.settings import Protocol
from tests.spec.lint import rows

DCON, RTU = frozenset({Protocol.DCON}), frozenset({Protocol.MODBUS_RTU})
I_7018 = Bus(DCON, checksum=False, models=("I-7018",))


def test_every_name_occurs_once() -> None:
    names = [scenario.name for scenario in SCENARIOS]

    assert len(set(names)) == len(names)


@pytest.mark.parametrize("scenario", SCENARIOS, ids=lambda it: it.name)
def test_a_scenario_is_whole(scenario: Scenario) -> None:
    assert all((scenario.title, scenario.line, scenario.right, scenario.sections, scenario.steps))
    assert scenario.steps[0].belief is scenario.steps[-1].belief is Belief.MUST
    for step in scenario.steps:
        read_faults(step.faults.split())
    assert {id_ for id_ in scenario.sections if id_.startswith("E")} <= {row["id"] for row in rows("errata")}


@pytest.mark.parametrize(
    ("name", "bus", "reason"),
    [
        ("wrong-address", I_7018, "only Modbus RTU has it"),
        ("blank-channels", Bus(RTU, checksum=False, models=("M-7019R",)), "only DCON has it"),
        ("damaged", I_7018, "without a checksum, a flipped bit cannot be noticed"),
        ("damaged", Bus(DCON, checksum=True, models=("I-7018",)), None),
        ("damaged", Bus(RTU, checksum=False, models=("M-7018",)), None),
        ("blank-channels", I_7018, "only the 7019 series has it"),
        ("old-firmware", Bus(DCON, checksum=False, models=("I-7018", "I-7019R")), "only the I-7018 series has it"),
        ("old-firmware", I_7018, None),
        ("echo", Bus(DCON | RTU, checksum=False, models=("I-7018", "M-7018")), None),
    ],
)
def test_what_is_not_applicable_says_why(name: str, bus: Bus, reason: str | None) -> None:
    (scenario,) = (it for it in SCENARIOS if it.name == name)

    assert refusal(scenario, bus) == reason


def test_a_pause_in_an_answer_may_end_it_by_modbus() -> None:
    (scenario,) = (it for it in SCENARIOS if it.name == "split")

    beliefs = [[step.belief_by(protocol) for step in scenario.steps] for protocol in Protocol]

    assert sorted(beliefs) == [[Belief.MUST, Belief.MAY, Belief.MUST], [Belief.MUST] * 3]
