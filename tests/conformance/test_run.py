"""Runs: verdicts, their order, and the module between checks."""

from collections.abc import Callable
from typing import Any

import pytest
from attrs import evolve

from i7000 import InvalidValueError, LineSettings, Model, Protocol, dcon, spec
from i7000.conformance.hazard import Hazard, allowing
from i7000.conformance.run import CheckResult, Options, Planned, Run, asked_for, exit_code, plan, selected, worst
from i7000.conformance.settle import settle
from i7000.conformance.statement import Level, Statement, read_statements
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Difference, Lost, Note, Skipped, SkipReason, Strange, Unclear, Verdict
from i7000.device import factory, power_on
from i7000.host.procedures import Procedure, snapshot
from i7000.link import Line, VirtualPort
from i7000.link.guarded import GuardedPort
from i7000.settings import BaudRate

FAST = LineSettings(BaudRate.BAUD_115200)
STATEMENT = spec.statements()["link/alive"]
Steps = Callable[[Subject], Procedure[None]]


def stated(name: str, **changes: Any) -> Statement:
    """A statement about every module."""
    plain = {"needs": (), "sections": ("2",), "level": Level.MUST, "hazards": frozenset(), "errata": ()}
    return evolve(STATEMENT, id=name, **{**plain, **changes})


def answered(module: Subject) -> Procedure[None]:
    yield from module.expect(module.sentinel)


def raising(reason: Exception) -> Steps:
    def steps(module: Subject) -> Procedure[None]:
        yield from module.expect(module.sentinel)
        raise reason

    return steps


def by_turns(*made: Steps) -> Steps:
    left = list(made)

    def steps(module: Subject) -> Procedure[None]:
        yield from left.pop(0)(module)

    return steps


def renamed(module: Subject) -> Procedure[None]:
    """Change the name, and leave it so."""
    yield from module.expect(dcon.SetModuleName(module.address, "MINE"))


class Bench:
    """A module, and runs of it."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.monkeypatch = monkeypatch
        self.eeprom = evolve(factory(Model.I_7018), protocol=Protocol.DCON)
        self.port = VirtualPort([power_on(self.eeprom, now=0.0)])

    def run(
        self, *checks: tuple[Statement, Steps], restoring: bool = True, skip: Skipped | None = None, **options: Any
    ) -> Run:
        self.monkeypatch.setattr("i7000.conformance.run.STEPS", {it.id: steps for it, steps in checks})
        chosen = Options(**{"allowed": allowing([Hazard.WRITE]), **options})
        if not self.port.is_open:
            self.port.open()
        with Line(GuardedPort(self.port, chosen.allowed)) as line:
            state = self.port.modules[0]
            before = line.run(snapshot(1, state.profile, Protocol.DCON)) if restoring else None
            planned = [Planned(it, skip if it.id.endswith("-n1") else None) for it, _ in checks]
            found = Run(planned, self.eeprom, chosen, line=line.line, checksum=False, before=before)
            line.run(found.procedure())
        return found


@pytest.fixture
def bench(monkeypatch: pytest.MonkeyPatch) -> Bench:
    return Bench(monkeypatch)


def verdicts(run: Run) -> list[str]:
    return [result.verdict.value for result in run.results]


@pytest.mark.parametrize(
    ("steps", "level", "verdict"),
    [
        (answered, Level.MUST, "PASS"),
        (raising(Difference("else")), Level.MUST, "FAIL"),
        (raising(Difference("else")), Level.OPEN, "INFO"),
        (raising(Strange("odd")), Level.MUST, "WARN"),
        (raising(Note("so")), Level.MUST, "INFO"),
        (raising(Unclear("dark")), Level.MUST, "INCONCLUSIVE"),
        (raising(Skipped(SkipReason.NEEDS_HARDWARE, "power")), Level.MUST, "SKIP"),
        (raising(ZeroDivisionError()), Level.MUST, "ERROR"),
        (lambda module: module.wait(0.1), Level.MUST, "INCONCLUSIVE"),
    ],
)
def test_what_ends_a_check_is_its_verdict(bench: Bench, steps: Steps, level: Level, verdict: str) -> None:
    assert verdicts(bench.run((stated("link/a", level=level), steps))) == [verdict]


def test_bytes_that_the_guard_refuses_are_a_hazard(bench: Bench) -> None:
    run = bench.run((stated("link/a"), renamed), allowed=allowing())

    assert (run.results[0].verdict, run.results[0].reason) == (Verdict.SKIP, SkipReason.HAZARD)


def test_a_check_that_ends_otherwise_when_repeated_is_flaky(bench: Bench) -> None:
    run = bench.run((stated("link/a"), by_turns(raising(Difference("else")), answered, answered)))

    assert (verdicts(run), run.results[0].repeats) == (["FLAKY"], (Verdict.PASS, Verdict.PASS))


def test_a_check_that_writes_is_not_repeated(bench: Bench) -> None:
    writing = frozenset({Hazard.WRITE})
    run = bench.run((stated("link/a", hazards=writing), by_turns(raising(Difference("else")))))

    assert (verdicts(run), run.results[0].repeats) == (["FAIL"], ())


@pytest.mark.parametrize(
    ("skip", "verdict"),
    [
        (None, "PASS-GOOD-ONLY"),
        (Skipped(SkipReason.HAZARD, "not allowed"), "PASS-GOOD-ONLY"),
        (Skipped(SkipReason.NOT_APPLICABLE, "not there"), "PASS"),
    ],
)
def test_a_pass_needs_its_negative_half(bench: Bench, skip: Skipped | None, verdict: str) -> None:
    run = bench.run((stated("link/a"), answered), (stated("link/a-n1"), raising(Unclear("dark"))), skip=skip)

    assert verdicts(run)[0] == verdict


def test_a_negative_half_that_fails_leaves_the_good_half_a_pass(bench: Bench) -> None:
    run = bench.run((stated("link/a"), answered), (stated("link/a-n1"), raising(Difference("else"))))

    assert verdicts(run) == ["PASS", "FAIL"]


def test_a_check_needs_the_others_to_pass(bench: Bench) -> None:
    failing, needing = stated("link/a"), stated("link/b", needs=("link/a",))
    after = bench.run((failing, raising(Difference("else"))), (needing, answered))
    first = bench.run((needing, answered), (failing, answered))

    assert (verdicts(after), after.results[1].text) == (["FAIL", "SKIP"], "link/a did not pass")
    assert (verdicts(first), first.results[0].text) == (["SKIP", "PASS"], "link/a was not run")


def test_no_check_is_begun_after_the_time(bench: Bench) -> None:
    run = bench.run((stated("link/a"), answered), (stated("link/b"), answered), seconds=0.01)

    assert verdicts(run) == ["PASS", "SKIP"]


def test_what_a_check_left_changed_is_restored_before_the_next(bench: Bench) -> None:
    run = bench.run((stated("link/a"), renamed), (stated("link/b"), answered))

    assert (verdicts(run), run.restored) == (["PASS", "PASS"], ["name"])
    assert bench.port.modules[0].eeprom.name == "7018"


def test_without_settings_to_restore_the_next_check_follows(bench: Bench) -> None:
    run = bench.run((stated("link/a"), renamed), restoring=False)

    assert (verdicts(run), run.restored) == (["PASS"], [])


def test_a_module_that_stays_changed_ends_the_run(bench: Bench) -> None:
    def lost(module: Subject) -> Procedure[None]:
        yield from renamed(module)
        bench.port.power_cycle(init_switch=True)

    run = bench.run((stated("link/a"), lost), (stated("link/b"), answered))

    assert verdicts(run) == ["PASS", "SKIP"]
    assert run.results[1].text == "link/a left the module changed: it does not answer"


def test_what_cannot_be_written_back_ends_the_run(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(*_: object, **__: object) -> Procedure[None]:
        yield from ()
        raise InvalidValueError("name", "x", "y", "")

    monkeypatch.setattr("i7000.conformance.run.settle", refused)
    run = bench.run((stated("link/a"), renamed), (stated("link/b"), answered))

    assert verdicts(run) == ["PASS", "SKIP"]
    assert run.results[1].text.startswith("link/a left the module changed: name cannot be")


def test_the_host_returns_to_its_line_settings(bench: Bench) -> None:
    run = bench.run((stated("link/a"), lambda module: module.tune(FAST)), (stated("link/b"), answered))

    assert verdicts(run) == ["INCONCLUSIVE", "PASS"]


def test_a_module_in_init_mode_is_restored_after_a_power_cycle(bench: Bench) -> None:
    def switched(module: Subject) -> Procedure[None]:
        yield from module.power_cycle(init_switch=True)
        yield from module.expect(dcon.ReadModuleName(0))

    run = bench.run((stated("link/a"), switched), (stated("link/b"), answered))

    assert (verdicts(run), bench.port.modules[0].ram.init_mode) == (["PASS", "PASS"], False)


def test_a_module_is_only_compared_if_nothing_may_be_written(bench: Bench) -> None:
    run = bench.run((stated("link/a"), renamed), restoring=False)
    before = evolve(run.twin.state, eeprom=bench.eeprom)
    port = VirtualPort([before])
    with Line(port) as line:
        kept = line.run(snapshot(1, before.profile, Protocol.DCON))
    bench.port.open()
    with Line(bench.port) as line:
        found = line.run(settle(kept, run.twin, LineSettings(), writing=False))

    assert (found.left, found.restored, found.is_as_before) == (("name",), (), False)


# --- plans and exit codes ---------------------------------------------------------------------------------------------


def test_a_plan_says_what_is_skipped_and_why() -> None:
    profile = power_on(factory(Model.I_7018), now=0.0).profile
    known = spec.statements()
    chosen = [known[name] for name in ("link/alive", "map/coil/reset_status", "stateful/settings")]
    planned = plan(chosen, profile, Protocol.DCON, allowing())

    assert [it.skip and it.skip.reason.value for it in planned] == [None, "not-applicable", "hazard"]


@pytest.mark.parametrize("text", ["link", "link/", "2.24", "link/*", "dcon/2.24/reply"])
def test_texts_select_checks_with_what_they_need(text: str) -> None:
    assert "link/alive" in selected(spec.statements(), [text])


@pytest.mark.parametrize("text", ["9.99", "zzzz"])
def test_a_text_that_selects_nothing_is_refused(text: str) -> None:
    with pytest.raises(InvalidValueError):
        selected(spec.statements(), [text])


def test_a_check_whose_negative_half_is_not_allowed_is_skipped_like_it() -> None:
    known = spec.statements()
    alone = [
        it.id for it in known.values() if it.positive and not it.hazards <= known[it.positive].hazards | allowing()
    ]

    assert alone == []


def coded(*found: Verdict, strict: bool = False, known: tuple[str, ...] = ()) -> int:
    return exit_code([CheckResult(STATEMENT, it) for it in found], strict=strict, known=known)


def test_the_worst_verdict_is_the_exit_code() -> None:
    bad = (Verdict.FAIL, Verdict.FLAKY, Verdict.PASS_GOOD_ONLY)

    assert [coded(Verdict.PASS, it) for it in bad] == [1, 1, 1]
    assert [coded(it, known=("link/alive",)) for it in bad] == [0, 0, 0]
    assert (coded(Verdict.WARN), coded(Verdict.WARN, strict=True), coded(Verdict.INFO)) == (0, 1, 0)
    assert (coded(), coded(Verdict.SKIP, Verdict.SKIP), coded(Verdict.INCONCLUSIVE)) == (5, 5, 5)
    assert (coded(Verdict.FAIL, Verdict.ERROR), coded(Verdict.SKIP, Verdict.PASS)) == (4, 0)
    assert [worst(*codes) for codes in ((6, 4), (4, 3), (3, 2), (2, 1), (1, 5), (5, 0))] == [6, 4, 3, 2, 1, 5]


def test_statements_name_what_a_module_must_have() -> None:
    row = {
        "id": "link/a-n1", "title": "t", "requirement": "r", "sections": ["2"], "level": "must", "hazards": ["write"],
        "protocol": None, "command": "ReadModuleName", "function": "ReadCoils", "register": "coil/reset_status",
        "models": ["M-7018"], "needs": [], "errata": [],
    }  # fmt: skip
    (read,) = read_statements([{"rows": [row]}]).values()
    profile = power_on(factory(Model.M_7018), now=0.0).profile
    other = power_on(factory(Model.I_7018), now=0.0).profile

    assert (read.group, read.positive, read.hazards) == ("link", "link/a", frozenset({Hazard.WRITE}))
    assert read.applies(profile, Protocol.MODBUS_RTU)
    assert not read.applies(other, Protocol.DCON)
    assert not evolve(read, register="coil/no_such_row").applies(profile, Protocol.DCON)
    assert not evolve(read, models=None).applies(other, Protocol.DCON)
    assert not evolve(read, protocol=Protocol.DCON).applies(profile, Protocol.MODBUS_RTU)


def test_the_digest_of_the_statements_is_that_of_their_files() -> None:
    assert (len(spec.digest()), spec.digest()) == (64, spec.digest())


def test_a_request_that_is_lost_each_time_is_a_failure(bench: Bench) -> None:
    run = bench.run((stated("link/a"), answered), (stated("link/b"), losing), (stated("link/c"), answered))

    assert verdicts(run) == ["PASS", "FAIL", "PASS"]
    assert run.results[1].text == "it is lost, each of 3 times, though it answers before and later"


def losing(module: Subject) -> Procedure[None]:
    yield from module.expect(module.sentinel)
    raise Lost("it is lost")


def test_what_stays_open_beside_others_is_not_a_pass(bench: Bench) -> None:
    run = bench.run((stated("link/a"), answered), (stated("link/b"), raising(Unclear("dark"))))

    assert verdicts(run) == ["PASS", "INCONCLUSIVE"]
    assert exit_code(run.results) == 1
    assert exit_code(run.results[1:]) == 5


def test_what_a_selected_check_needs_is_not_what_was_asked_for(bench: Bench) -> None:
    needed, asked = stated("link/a"), stated("link/b-n1", needs=("link/a",))
    run = bench.run((needed, answered), (asked, answered), skip=Skipped(SkipReason.NOT_APPLICABLE, "not there"))

    assert exit_code(run.results, asked=["link/b-n1"]) == 5
    assert exit_code(run.results) == 0
    assert asked_for(spec.statements(), ["link/prompt"]) == {"link/prompt"}
    assert selected(spec.statements(), ["link/prompt"]) == {"link/prompt", "link/alive"}
