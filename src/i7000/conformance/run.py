"""A run: a plan of checks carried out one after the other, as one procedure for any line.

Laws: a run ends on every line. A check that does not pass never prevents the others, but those that need it. `PASS` is
given only where bytes of the module were received in that very check, and where what the module should not do was
tested too.
"""

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from difflib import get_close_matches
from fnmatch import fnmatchcase
from random import Random

from attrs import evolve

from i7000.conformance.checks import STEPS
from i7000.conformance.claims import Claims
from i7000.conformance.guard import Guard, GuardError
from i7000.conformance.hazard import Hazard
from i7000.conformance.oracle import Twin
from i7000.conformance.statement import Level, Statement
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Difference, Reason, Skipped, SkipReason, Verdict
from i7000.device import Eeprom
from i7000.errors import I7000Error, InvalidValueError
from i7000.frozen import frozen
from i7000.host.events import Answered, Declined
from i7000.host.procedures import BytesHeard, Procedure, Result, Tell
from i7000.profile import Profile
from i7000.settings import LineSettings, Protocol

__all__ = ["Begun", "CheckResult", "Options", "Planned", "Run", "exit_code", "plan", "selected"]

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
    """Why, in words; empty for `PASS`."""
    reason: SkipReason | None = None
    sent: bytes = b""
    received: bytes = b""
    expected: str = ""
    repeats: tuple[Verdict, ...] = ()
    """The verdicts of the repetitions."""
    writes: int = 0
    """The frames of it that may have changed the EEPROM."""

    @property
    def id(self) -> str:
        """The id of the check."""
        return self.statement.id


# --- the plan ---------------------------------------------------------------------------------------------------------


def selected(known: Mapping[str, Statement], selection: Iterable[str] = ()) -> frozenset[str]:
    """Return the ids that texts select: ids, beginnings of them, patterns with ``*``, and sections of the manual.

    Special: no text selects everything. What a selected check needs, and its negative half, are selected too.
    Errors: `InvalidValueError` for a text that selects nothing; it names the nearest id.

    >>> from i7000 import spec
    >>> sorted(selected(spec.statements(), ["link"]))[0]
    'link/alive'
    """
    texts = tuple(selection)
    found = set() if texts else set(known)
    for text in texts:
        matching = {it.id for it in known.values() if _matches(it, text)}
        if not matching:
            near = ", ".join(get_close_matches(text, known, n=3, cutoff=0.4))
            allowed = "the id of a check, a group, a pattern such as dcon/2.1*, or a section of the manual"
            raise InvalidValueError("select", text, f"{allowed}; near it: {near}" if near else allowed, "")
        found |= matching
    return frozenset(_completed(found, known))


def _matches(statement: Statement, text: str) -> bool:
    return (
        statement.id == text
        or statement.id.startswith(text.rstrip("/") + "/")
        or statement.id.startswith(text + "-n")
        or fnmatchcase(statement.id, text)
        or (re.fullmatch(r"[1-3A](\.\d+)*", text) is not None and text in statement.sections)
    )


def _completed(found: set[str], known: Mapping[str, Statement]) -> set[str]:
    """Add what is needed, and the negative halves."""
    left = list(found)
    halves = _by_positive(known.values())
    while left:
        one = left.pop()
        for other in (*known[one].needs, *(it.id for it in halves.get(one, ()))):
            if other not in found:
                found.add(other)
                left.append(other)
    return found


def _by_positive(statements: Iterable[Statement]) -> dict[str | None, list[Statement]]:
    """Return the negative halves of checks, by the ids of those."""
    found: dict[str | None, list[Statement]] = {}
    for one in statements:
        found.setdefault(one.positive, []).append(one)
    return found


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
    halves = _by_positive(it.statement for it in planned)
    for one in planned:
        if one.statement.positive not in by_id:
            yield [one, *(by_id[it.id] for it in halves.get(one.statement.id, ()))]


class Run:
    """A run of a plan on a module with these settings; `line` and `checksum` are those that it answers with now."""

    def __init__(
        self, planned: Sequence[Planned], eeprom: Eeprom, options: Options, *, line: LineSettings, checksum: bool
    ) -> None:
        self.planned, self.options, self.line = tuple(planned), options, line
        twin = Twin.of(eeprom, 0.0)
        self.twin = Twin(twin.state.keep(checksum=checksum, line_settings=line))
        self.results: list[CheckResult] = []
        self.now: float | None = None
        self.began: float | None = None
        self.writes = 0
        """The frames so far that may have changed the EEPROM."""
        self.guard = Guard(options.allowed)
        """What was sent so far; as strict as the guard of the port."""
        self.place = self.twin
        """Where the module is now, and how it is spoken to."""
        self._answering = False
        """Whether the module answered what was sent last."""
        self._applicable = {it.statement.id for it in planned if it.skip is None}
        self._planned = {it.statement.id for it in planned}
        self._verdicts: dict[str, Verdict] = {}

    def procedure(self) -> Procedure[None]:
        """Return the procedure that carries out the plan.

        Shape: it tells a `Begun` and a `CheckResult` for each check, in their order.
        """
        first = self._subject(Random(self.options.seed))  # noqa: S311 - repeatable
        yield from first.end_line()
        self.guard = first.guard
        for group in _halves(self.planned):
            yield from self.checks(group)

    def _subject(self, chance: Random) -> Subject:
        scale, writes = self.options.timeout_scale, self.options.writes - self.writes
        now, state = self.now or 0.0, self.twin.state
        twin = Twin(state.keep(fed_at=now)) if state.ram.protocol is Protocol.MODBUS_RTU else self.twin  # E106
        return Subject(twin, self.line, scale, chance, now, self.guard, writes, self.options.claims)

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
        skip = one.skip or self._prerequisite(one.statement) or self._over()
        if skip:
            return CheckResult(one.statement, Verdict.SKIP, text=skip.text, reason=skip.reason)
        answering = self._answering
        result = yield from self._once(one.statement, answering=answering)
        if result.verdict not in _REPEATED or not one.statement.hazards <= _READS:
            return result
        again: tuple[Verdict, ...] = ()
        while len(again) < _MOST_REPEATS:
            again += ((yield from self._once(one.statement, answering=answering)).verdict,)
        verdict = result.verdict if set(again) == {result.verdict} else Verdict.FLAKY
        return evolve(result, verdict=verdict, repeats=again)

    def _prerequisite(self, statement: Statement) -> Skipped | None:
        for needed in statement.needs:
            verdict = self._verdicts.get(needed)
            if needed in self._applicable and verdict not in _GOOD:
                what = "did not pass" if verdict else "was not run"
                return Skipped(SkipReason.PREREQUISITE, f"{needed} {what}")
        return None

    def _over(self) -> Skipped | None:
        limit = self.options.seconds
        if limit is not None and self.now is not None and self.began is not None and self.now - self.began > limit:
            return Skipped(SkipReason.BUDGET, f"the {limit:g} s of the run are over")
        return None

    def _once(self, statement: Statement, *, answering: bool) -> Procedure[CheckResult]:
        subject = self._subject(Random(f"{self.options.seed} {statement.id}"))  # noqa: S311 - repeatable
        subject.answering = answering
        before = subject.writes_left
        heard = False
        answer: object = None
        started = self.now
        steps = STEPS[statement.id](subject)
        refusal: I7000Error | None = None
        verdict, reason = Verdict.PASS, None
        try:
            while True:
                step = steps.throw(refusal) if refusal else steps.send(answer)
                refusal = None
                self.place = subject.twin
                try:
                    answer = yield step
                except I7000Error as error:
                    answer, refusal = None, error
                heard = heard or _is_evidence(answer)
                if isinstance(answer, BytesHeard):
                    self.now = answer.now
                    self._answering = bool(answer.wire)
                    self.began = answer.now if self.began is None else self.began
                    started = answer.now if started is None else started
        except StopIteration:
            if not heard:
                verdict, reason = Verdict.INCONCLUSIVE, Reason("nothing was received")
        except GuardError as error:
            verdict, reason = Verdict.SKIP, Skipped(SkipReason.HAZARD, str(error))
        except Difference as difference:
            verdict, reason = Verdict.INFO if statement.level is Level.OPEN else Verdict.FAIL, difference
        except Reason as other:
            verdict, reason = other.verdict, other
        finally:
            steps.close()
            self.guard = subject.guard
        writes = before - subject.writes_left
        self.writes += writes
        seconds = 0.0 if started is None or self.now is None else self.now - started
        return _result(statement, verdict, reason, seconds, writes)


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


def _result(statement: Statement, verdict: Verdict, reason: Reason | None, seconds: float, writes: int) -> CheckResult:
    if reason is None:
        return CheckResult(statement, verdict, seconds, writes=writes)
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
    )


# --- the end ----------------------------------------------------------------------------------------------------------


def exit_code(results: Iterable[CheckResult], *, strict: bool = False, known: Iterable[str] = ()) -> int:
    """Return the exit code of results: 0, 1 for what failed, 5 if nothing was decided.

    Shape: `known` are the ids whose failure a baseline has.

    >>> exit_code([])
    5
    """
    baseline = frozenset(known)
    bad = {Verdict.FAIL, Verdict.FLAKY, Verdict.PASS_GOOD_ONLY, *((Verdict.WARN,) if strict else ())}
    counted = Counter[str]()
    for result in results:
        if result.verdict in bad and result.id not in baseline:
            counted["bad"] += 1
        elif result.verdict is Verdict.ERROR:
            counted["error"] += 1
        elif result.verdict not in (Verdict.SKIP, Verdict.INCONCLUSIVE):
            counted["decided"] += 1
    if counted["error"]:
        return 4
    if counted["bad"]:
        return 1
    return 0 if counted["decided"] else 5
