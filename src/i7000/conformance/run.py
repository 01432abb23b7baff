"""A run: a plan of checks carried out one after the other, as one procedure for any line.

Laws: a run ends on every line. A check that does not pass never prevents the others, but those that need it. `PASS` is
given only where bytes of the module were received in that very check, and where what the module should not do was
tested too.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from random import Random
from typing import Any

from attrs import evolve

from i7000.conformance.checks import STEPS
from i7000.conformance.claims import Claims
from i7000.conformance.guard import Guard, GuardError
from i7000.conformance.hazard import STORED, Hazard
from i7000.conformance.oracle import Twin
from i7000.conformance.selection import asked_for, by_positive, selected
from i7000.conformance.settle import settle
from i7000.conformance.statement import Level, Statement
from i7000.conformance.subject import Sentinel, Subject
from i7000.conformance.verdict import Difference, Lost, Reason, Skipped, SkipReason, Verdict
from i7000.device import Eeprom, State
from i7000.errors import I7000Error
from i7000.frozen import frozen
from i7000.host.events import Answered, Declined
from i7000.host.procedures import BytesHeard, Procedure, Result, SendBytes, Snapshot, Tell, Tune
from i7000.message import Query
from i7000.profile import Profile
from i7000.settings import LineSettings, Protocol

__all__ = ["Begun", "CheckResult", "Options", "Planned", "Run", "asked_for", "exit_code", "plan", "selected", "worst"]

_MOST_REPEATS = 2
"""How often a check that only reads is repeated when it does not pass."""


@frozen(kw_only=True)
class Options:
    """How a run is carried out.

    Shape: `writes` is the most frames that may change the EEPROM, `seconds` the longest time after which no check is
        begun; None means any time.
    """

    allowed: frozenset[Hazard]
    seed: int = 0
    timeout_scale: float = 1.0
    writes: int = 64
    seconds: float | None = None
    claims: Claims | None = None
    """The statement of the module; without one, that is not checked."""


@frozen
class Planned:
    """A check of a run, and why it will be skipped, if it will."""

    statement: Statement
    skip: Skipped | None = None


@frozen
class Begun:
    """What a run tells when it begins a check."""

    statement: Statement


@frozen
class CheckResult:
    """What became of a check."""

    statement: Statement
    verdict: Verdict
    seconds: float = 0.0
    text: str = ""
    """Why, in words; for `PASS`, what there is to say besides, if anything."""
    reason: SkipReason | None = None
    sent: bytes = b""
    received: bytes = b""
    expected: str = ""
    repeats: tuple[Verdict, ...] = ()
    """The verdicts of the repetitions."""
    writes: int = 0
    """The frames of it that may have changed the EEPROM."""
    right: bytes = b""
    """The only bytes that were allowed, if there are such."""
    wrote: bytes = b""
    """The last write before what was sent, if it may have changed settings."""
    answered: bytes = b""
    """The answer to it."""

    @property
    def id(self) -> str:
        """The id of the check."""
        return self.statement.id


# --- the plan ---------------------------------------------------------------------------------------------------------


def plan(
    statements: Iterable[Statement],
    profile: Profile,
    protocol: Protocol,
    allowed: frozenset[Hazard],
    claims: Claims | None = None,
) -> tuple[Planned, ...]:
    """Return the checks of a run in their order, for a module of a profile.

    Special: what `claims` does not claim is not checked. Without claims, the group ``statement`` is left out.
    """
    return tuple(
        Planned(it, _skip(it, profile, protocol, allowed) or _unclaimed(it, claims))
        for it in statements
        if claims is not None or it.group != "statement"
    )


def _unclaimed(statement: Statement, claims: Claims | None) -> Skipped | None:
    """Return why a check is skipped because the statement of the module does not claim what it is about."""
    if claims is None or claims.covers(statement):
        return None
    return Skipped(SkipReason.NOT_APPLICABLE, "the statement of the module does not claim it")


def _skip(statement: Statement, profile: Profile, protocol: Protocol, allowed: frozenset[Hazard]) -> Skipped | None:
    if not statement.applies(profile, protocol):
        what = f"{profile.model.value} does not have it"
        if statement.protocol not in (None, protocol):
            what = "the module uses the other protocol"
        return Skipped(SkipReason.NOT_APPLICABLE, what)
    if missing := statement.hazards - allowed:
        words = ", ".join(hazard.value for hazard in Hazard if hazard in missing)
        return Skipped(SkipReason.HAZARD, f"not allowed: {words}")
    return None


# --- the run ----------------------------------------------------------------------------------------------------------


def _halves(planned: Sequence[Planned]) -> Iterator[list[Planned]]:
    """Yield each check with its negative halves after it."""
    by_id = {it.statement.id: it for it in planned}
    halves = by_positive(it.statement for it in planned)
    for one in planned:
        if one.statement.positive not in by_id:
            yield [one, *(by_id[it.id] for it in halves.get(one.statement.id, ()))]


class Run:
    """A run of a plan on a module with these settings; `line` and `checksum` are those that it answers with now.

    Shape: `before` are the settings that are restored if a check does not restore what it changed; None leaves that to
        the caller. `init_mode` is whether the module is in INIT mode.
    """

    def __init__(  # noqa: PLR0913 - each of them is a fact
        self,
        planned: Sequence[Planned],
        eeprom: Eeprom,
        options: Options,
        *,
        line: LineSettings,
        checksum: bool,
        before: Snapshot | None = None,
        init_mode: bool = False,
    ) -> None:
        self.planned, self.options, self.line, self.before = tuple(planned), options, line, before
        twin = Twin.of(eeprom, 0.0, init_switch=init_mode)
        self.twin = Twin(twin.state.keep(checksum=checksum, line_settings=line))
        self.results: list[CheckResult] = []
        self.now = self.began = 0.0
        self.writes = 0
        """The frames so far that may have changed the EEPROM."""
        self.guard = Guard(options.allowed)
        """What was sent so far; as strict as the guard of the port."""
        self.may_have_changed = False
        """Whether a check was begun that changes settings."""
        self.restored: list[str] = []
        """The settings that had to be restored between checks."""
        self.place = self.twin
        """Where the module is now, and how it is spoken to."""
        self._stopped: Skipped | None = None
        self._sentinel: Sentinel | None = None
        self._sound: dict[Query[Any], bool] = {}
        self._answering = False
        """Whether the module answered what was sent last."""
        self._lost = 0
        """How often a request after the frame of a check was lost."""
        self._applicable = {it.statement.id for it in planned if it.skip is None}
        self._verdicts: dict[str, Verdict] = {}

    def procedure(self) -> Procedure[None]:
        """Return the procedure that carries out the plan.

        Shape: it tells a `Begun` and a `CheckResult` for each check, in their order.
        """
        yield from self.open()
        for group in _halves(self.planned):
            yield from self.checks(group)

    def open(self) -> Procedure[None]:
        """End what is unfinished on the line, and choose the sentinel: the first plain read that is answered right."""
        first: BytesHeard = yield SendBytes((), 0.0)
        self.now = first.now
        opening = self._subject(Random(self.options.seed))  # noqa: S311 - repeatable
        yield from opening.end_line()
        yield from opening.find_sentinel()
        self.guard, self._sentinel = opening.guard, opening.known
        self.now = self.began = opening.now

    def _subject(self, chance: Random) -> Subject:
        scale, writes = self.options.timeout_scale, self.options.writes - self.writes
        now, state = self.now or 0.0, self.twin.state
        twin = Twin(state.keep(fed_at=now)) if state.ram.protocol is Protocol.MODBUS_RTU else self.twin  # E106
        claims = self.options.claims
        return Subject(
            twin, self.line, scale, chance, now, self.guard, writes, claims, sound=self._sound, known=self._sentinel
        )

    def checks(self, group: Sequence[Planned]) -> Procedure[None]:
        """Carry out a check and its negative halves, and tell what became of them."""
        found = []
        for one in group:
            yield Tell(Begun(one.statement))
            result = yield from self._check(one)
            self._verdicts[result.id] = result.verdict
            found.append(result)
        if found[0].verdict is Verdict.PASS and any(map(_untested, found[1:])):
            missing = next(it for it in found[1:] if _untested(it))
            text = f"{missing.id} was not decided: {missing.text}"
            found[0] = evolve(found[0], verdict=Verdict.PASS_GOOD_ONLY, text=text)
            self._verdicts[found[0].id] = Verdict.PASS_GOOD_ONLY
        for result in found:
            self.results.append(result)
            yield Tell(result)

    def _check(self, one: Planned) -> Procedure[CheckResult]:
        skip = one.skip or self._stopped or self._prerequisite(one.statement) or self._over()
        if skip:
            return CheckResult(one.statement, Verdict.SKIP, text=skip.text, reason=skip.reason)
        answering, lost = self._answering, self._lost
        result = yield from self._once(one.statement, answering=answering)
        if result.verdict not in _REPEATED or not one.statement.hazards <= _READS:
            return result
        again: tuple[Verdict, ...] = ()
        while len(again) < _MOST_REPEATS:
            again += ((yield from self._once(one.statement, answering=answering)).verdict,)
        if set(again) != {result.verdict}:
            return evolve(result, verdict=Verdict.FLAKY, repeats=again)
        if self._lost - lost == 1 + len(again) and answering and self._answering:
            text = f"{result.text}, each of {1 + len(again)} times, though it answers before and later"
            return evolve(result, verdict=Verdict.FAIL, text=text, repeats=again)
        return evolve(result, repeats=again)

    def _prerequisite(self, statement: Statement) -> Skipped | None:
        for needed in statement.needs:
            verdict = self._verdicts.get(needed)
            if needed in self._applicable and verdict not in _GOOD:
                what = "did not pass" if verdict else "was not run"
                return Skipped(SkipReason.PREREQUISITE, f"{needed} {what}")
        return None

    def _over(self) -> Skipped | None:
        limit = self.options.seconds
        if limit is not None and self.now - self.began > limit:
            return Skipped(SkipReason.BUDGET, f"the {limit:g} s of the run are over")
        return None

    def _once(self, statement: Statement, *, answering: bool) -> Procedure[CheckResult]:
        subject = self._subject(Random(f"{self.options.seed} {statement.id}"))  # noqa: S311 - repeatable
        subject.answering = answering
        budget = subject.writes_left
        self.may_have_changed |= bool(statement.hazards & STORED)
        started = self.now
        heard: list[object] = []
        verdict = Verdict.PASS
        reason: Reason | None = None
        steps = STEPS[statement.id](subject)
        try:
            yield from self._steps(steps, subject, heard)
            if not any(map(_is_evidence, heard)):
                verdict, reason = Verdict.INCONCLUSIVE, Reason("nothing was received")
        except GuardError as error:
            verdict, reason = Verdict.SKIP, Skipped(SkipReason.HAZARD, str(error))
        except Difference as difference:
            verdict, reason = Verdict.INFO if statement.level is Level.OPEN else Verdict.FAIL, difference
        except Reason as other:
            self._lost += isinstance(other, Lost)
            verdict, reason = other.verdict, other
        except Exception as error:  # noqa: BLE001 - a fault of this program must not keep the module from being restored
            verdict, reason = Verdict.ERROR, Reason(_internal(error))
        finally:
            steps.close()
            self.guard = subject.guard
            writes = budget - subject.writes_left
            self.writes += writes
        seconds = self.now - started
        yield from self._back(statement, subject, verdict)
        if reason is None:
            return CheckResult(statement, verdict, seconds, subject.remark, writes=writes)
        return _result(statement, verdict, reason, seconds, writes)

    def _steps(self, steps: Procedure[None], subject: Subject, heard: list[object]) -> Procedure[None]:
        """Carry out the steps of a check, and collect what they receive; what the port refuses is raised in them."""
        answer: object = None
        refusal: I7000Error | None = None
        while True:
            try:
                step = steps.throw(refusal) if refusal else steps.send(answer)
            except StopIteration:
                return
            answer = refusal = None
            self.place = subject.twin
            try:
                answer = yield step
            except I7000Error as error:
                refusal = error
            heard.append(answer)
            if isinstance(answer, BytesHeard):
                self.now = answer.now
                self._answering = bool(answer.wire)

    def _back(self, statement: Statement, subject: Subject, verdict: Verdict) -> Procedure[None]:
        """Bring the host, and a module that a check left elsewhere, back to where the next check expects them."""
        failed = verdict in (Verdict.ERROR, Verdict.FAIL) and bool(statement.hazards & STORED)
        elsewhere = _whereabouts(subject.twin.state) != _whereabouts(self.twin.state)
        if self.before is not None and (failed or elsewhere):
            try:
                settled = yield from settle(self.before, subject.twin, self.line, home=self.twin)
            except I7000Error as error:
                self._stopped = Skipped(SkipReason.PREREQUISITE, f"{statement.id} left the module changed: {error}")
                return
            self.writes += len(settled.restored)
            self.restored += settled.restored
            if not settled.is_as_before:
                what = ", ".join(settled.left) or "it does not answer"
                self._stopped = Skipped(SkipReason.PREREQUISITE, f"{statement.id} left the module changed: {what}")
                return
        elif subject.line != self.line:
            yield Tune(self.line)
        self.place = self.twin


def _whereabouts(state: State) -> tuple[object, ...]:
    """Return the settings of a module, and how it is spoken to."""
    ram = state.ram
    return state.eeprom, ram.address, ram.line_settings, ram.checksum, ram.protocol, ram.init_mode


def _internal(error: Exception) -> str:
    """Return what went wrong in this program, and where."""
    place = error.__traceback__
    while place is not None and place.tb_next is not None:
        place = place.tb_next
    where = "" if place is None else f" ({place.tb_frame.f_code.co_name}, line {place.tb_lineno})"
    return f"internal error: {type(error).__name__}: {error}{where}"


_READS = frozenset({Hazard.OBSERVE, Hazard.MEMORY})
_REPEATED = frozenset({Verdict.FAIL, Verdict.INCONCLUSIVE, Verdict.WARN})
_GOOD = frozenset({Verdict.PASS, Verdict.PASS_GOOD_ONLY, Verdict.INFO, Verdict.WARN})
"""The verdicts of a check that others need."""


def _untested(result: CheckResult) -> bool:
    """Return whether a negative half was not decided, though the module has what it is about."""
    skipped = result.verdict is Verdict.SKIP and result.reason is not SkipReason.NOT_APPLICABLE
    return skipped or result.verdict in (Verdict.INCONCLUSIVE, Verdict.ERROR)


def _is_evidence(answer: object) -> bool:
    """Return whether a step received bytes of the module."""
    if isinstance(answer, BytesHeard):
        return bool(answer.wire)
    return isinstance(answer, Result) and isinstance(answer.outcome, Answered | Declined)


def _result(statement: Statement, verdict: Verdict, reason: Reason, seconds: float, writes: int) -> CheckResult:
    return CheckResult(
        statement,
        verdict,
        seconds,
        reason.text,
        reason.reason if isinstance(reason, Skipped) else None,
        reason.sent,
        reason.received,
        reason.expected,
        writes=writes,
        right=reason.right,
        wrote=reason.wrote,
        answered=reason.answered,
    )


# --- the end ----------------------------------------------------------------------------------------------------------


def exit_code(
    results: Iterable[CheckResult],
    *,
    strict: bool = False,
    known: Iterable[str] = (),
    asked: Iterable[str] | None = None,
) -> int:
    """Return the exit code of results: 0; 1 for what failed or stayed open beside others; 5 if nothing was decided.

    Shape: `known` are the ids whose failure a baseline has. `asked` are those that the user selected: what they need
        does not count as decided; None means all.

    >>> exit_code([])
    5
    """
    baseline, wanted = frozenset(known), None if asked is None else frozenset(asked)
    bad = {Verdict.FAIL, Verdict.FLAKY, Verdict.PASS_GOOD_ONLY, *((Verdict.WARN,) if strict else ())}
    counted = Counter[str]()
    for result in results:
        if result.verdict in bad and result.id not in baseline:
            counted["bad"] += 1
        elif result.verdict is Verdict.ERROR:
            counted["error"] += 1
        elif result.verdict is Verdict.INCONCLUSIVE:
            counted["open"] += 1
        elif result.verdict is not Verdict.SKIP and (wanted is None or result.id in wanted):
            counted["decided"] += 1
    if counted["error"]:
        return 4
    if counted["bad"]:
        return 1
    if not counted["decided"]:
        return 5
    return 1 if counted["open"] else 0


_WORST_FIRST = (6, 4, 3, 2, 1, 5, 0)


def worst(*codes: int) -> int:
    """Return the exit code of a run for which there are several.

    >>> worst(5, 1), worst(1, 3, 6), worst(0)
    (1, 6, 0)
    """
    return min(codes, key=_WORST_FIRST.index)
