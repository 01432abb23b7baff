"""Scenarios in virtual time: the example driver passes all of them, and naive drivers do not."""

import io
from collections.abc import Iterator
from contextlib import redirect_stdout

import pytest

from i7000 import Model
from i7000.conformance.provoked import Kind, Verdict
from i7000.conformance.scenarios import SCENARIOS, Belief, Inputs, Scenario, Step, refusal
from i7000.device import factory
from i7000.errors import Fault, Noise
from i7000.examples.task import read_task
from i7000.host.procedures import ask
from i7000.link import Line, VirtualPort
from i7000.settings import Protocol
from i7000.simulator import provoking
from i7000.simulator.faults import Faults
from i7000.simulator.observed import Observed
from i7000.simulator.provoking import Player, sources
from tests.drivers import fixed_length, number_finder
from tests.provoked import BY_NAME, Poll, bus_of, eeproms, provoked

FORMS = {"dcon": [], "dcon with a checksum": ["--checksum"], "rtu": ["--modbus"]}


def example(model: str, arguments: list[str]) -> Poll:
    """The example driver on a port in virtual time: what it prints."""
    task = read_task(["", "--model", model, "--type", "K", "--address", "1", "--address", "2", "--json", *arguments])
    lines: dict[int, Line] = {}

    def poll(port: VirtualPort) -> Iterator[str]:
        line = lines.setdefault(id(port), Line(port, task.line))
        for command in task.requests():
            with redirect_stdout(io.StringIO()) as out:
                task.show(command, line.run(ask(command, task.profile)))
            yield from out.getvalue().splitlines()

    return poll


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("scenario", SCENARIOS, ids=lambda it: it.name)
def test_the_example_driver_passes(scenario: Scenario, form: str) -> None:
    modules = eeproms(scenario, rtu=form == "rtu", checksum="checksum" in form)
    if refusal(scenario, bus_of(modules)) is not None:
        pytest.skip("not applicable")
    model = "M-7019R" if form == "rtu" else "I-7018"

    judgement = provoked(scenario, example(model, FORMS[form]), modules)

    assert (judgement.verdict, judgement.findings) == (Verdict.PASS, ())
    assert judgement.values >= 32


FIXED_LENGTH = {
    "late-reply": Kind.WRONG,
    "very-late-reply": Kind.WRONG,
    "wrong-function": Kind.MISSING,
    "two-replies": Kind.WRONG,
    "sentinels": Kind.INVENTED,
    "old-firmware": Kind.WRONG,
    "zero-after-frame": Kind.MISSING,
}
NUMBER_FINDER = {
    "late-reply": Kind.WRONG,
    "very-late-reply": Kind.WRONG,
    "wrong-function": Kind.WRONG,
    "cut-short": Kind.WRONG,
    "two-replies": Kind.WRONG,
    "blank-channels": Kind.WRONG,
    "sentinels": Kind.INVENTED,
    "old-firmware": Kind.INVENTED,
}


@pytest.mark.parametrize(
    ("poll", "name", "kind"),
    [
        *[pytest.param(fixed_length.poll, *it, id=f"fixed-length {it[0]}") for it in FIXED_LENGTH.items()],
        *[pytest.param(number_finder.poll, *it, id=f"number-finder {it[0]}") for it in NUMBER_FINDER.items()],
    ],
)
def test_a_naive_driver_fails(poll: Poll, name: str, kind: Kind) -> None:
    scenario = BY_NAME[name]

    judgement = provoked(scenario, lambda port: poll(port, port.sleep), eeproms(scenario))  # type: ignore[call-arg]

    assert judgement.verdict is Verdict.FAIL
    assert kind in {finding.kind for finding in judgement.findings}


@pytest.mark.parametrize("poll", [fixed_length.poll, number_finder.poll], ids=["fixed-length", "number-finder"])
def test_a_naive_driver_passes_on_an_undisturbed_line(poll: Poll) -> None:
    scenario = BY_NAME["undisturbed"]

    judgement = provoked(scenario, lambda port: poll(port, port.sleep), eeproms(scenario))  # type: ignore[call-arg]

    assert (judgement.verdict, judgement.findings) == (Verdict.PASS, ())


def test_a_driver_that_never_reports_misses_everything() -> None:
    scenario = BY_NAME["undisturbed"]

    def poll(port: VirtualPort) -> Iterator[str]:
        port.write(b"#01\r")
        port.read_until(b"\r")
        return iter(())

    judgement = provoked(scenario, poll, eeproms(scenario))

    assert [finding.kind for finding in judgement.findings] == [Kind.MISSING] * 8


def test_what_cannot_be_judged_is_not_counted_as_an_answer() -> None:
    """Noise, commands without readings, requests to nobody, and too many exchanges."""
    scenario = Scenario("", "", "", "", (), (Step(1),))
    modules = eeproms(scenario)
    port = VirtualPort([])
    player = Player(scenario, port, lambda _: None, modules, lambda _: Faults())
    port.observe = player.observe

    player.observe(Observed(0.0, "", Noise(b"x", Fault.LEADING), Protocol.DCON, None, None))
    player.observe(Observed(0.1, "", b"#05\r", Protocol.DCON, None, None))
    assert (len(player.exchanges), player.given, player.finished) == (1, [], False)


def test_exchanges_are_limited(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(provoking, "_MOST_EXCHANGES", 1)
    player = Player(Scenario("", "", "", "", (), (Step(1),)), VirtualPort([]), lambda _: None, (), lambda _: Faults())
    for at in (0.0, 0.1):
        player.observe(Observed(at, "", b"#05\r", Protocol.DCON, None, None))

    assert player.requests == [0.0]


def test_no_two_channels_ever_have_the_same_value() -> None:
    made = factory(Model.I_7018)
    places = [sources(made, place, 3, Inputs.VARYING) for place in range(3)]

    values = [
        signal.value
        for seconds in range(200)
        for it in places
        for signal in it.at(seconds).channels
        if signal is not None
    ]

    assert len(set(values[: 3 * 8])) == 3 * 8
    first, last = values[: 3 * 8], values[-3 * 8 :]
    assert all(low != high for low, high in zip(first, last, strict=True))


@pytest.mark.parametrize("inputs", [Inputs.OVER, Inputs.UNDER])
def test_every_other_channel_is_beyond_its_range(inputs: Inputs) -> None:
    made = factory(Model.I_7018)

    channels = sources(made, 0, 1, inputs).at(0.0).channels

    values = [0.0 if signal is None else signal.value for signal in channels]
    code = made.type_codes[0]
    assert [value > code.maximum for value in values] == [inputs is Inputs.OVER, False] * 4
    assert [value < code.minimum for value in values] == [inputs is Inputs.UNDER, False] * 4


def test_an_open_wire_is_no_signal() -> None:
    assert sources(factory(Model.I_7018), 0, 1, Inputs.OPEN).at(0.0).channels[0] is None


def test_a_scenario_begins_and_ends_with_answers_to_believe() -> None:
    assert {step.belief for scenario in SCENARIOS for step in (scenario.steps[0], scenario.steps[-1])} == {Belief.MUST}
