"""Whether a driver believes what modules said, and nothing else.

A `Session` is everything that happened while a scenario ran: what was asked, the answers with what they truly said, and
what the driver believed. `judge` compares them.

Laws: pure. Each reading of an answer can be believed once. An answer that arrives after the next request belongs to
neither of them.
"""

from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence
from enum import StrEnum
from math import inf
from operator import attrgetter

from attrs import define, evolve, field, frozen

from i7000.conformance.believed import ERROR, MISSING, OK, Believed, Unreadable
from i7000.conformance.scenarios import Belief

__all__ = [
    "Ended", "Finding", "Given", "Judgement", "Kind", "Line", "Session", "Told", "Verdict", "is_decided",
    "judge",
]  # fmt: skip

_MOST_HELD_UP = 0.15
"""The seconds for which a line may be held up without effect on the verdict."""
_RECENT = 100
"""The answers before a line that it can rest on."""
_MOST_WRONG = 200
"""The wrong values that are explained."""
_NO_TIME = 0.005
"""The seconds before a request in which an answer may arrive that the driver has read."""


class Verdict(StrEnum):
    """The result of a scenario."""

    PASS = "PASS"  # noqa: S105 - no password
    FAIL = "FAIL"
    INCONCLUSIVE = "INCONCLUSIVE"
    """The driver asked nothing, or not enough."""
    ERROR = "ERROR"
    """The driver could not be started, or its output does not fit the schema."""
    SKIP = "SKIP"
    """It is not applicable to the modules."""


class Kind(StrEnum):
    """What is wrong with a driver."""

    WRONG = "wrong value"
    INVENTED = "invented value"
    MISSING = "missing value"
    DEADLOCK = "deadlock"
    ENDED = "ended early"


@frozen
class Told:
    """What an answer truly said of a channel."""

    channel: int
    value: float | None
    status: str = OK
    unit: str | None = None
    resolution: float = 0.0
    """The difference of two neighbouring values."""

    def is_believed(self, line: Believed) -> bool:
        """Return whether a line says the same."""
        if line.channel != self.channel or line.status != self.status:
            return False
        if self.value is None or line.value is None:
            return True
        factor = 1.0 if line.unit is None else _FACTORS.get((_plain(line.unit), _plain(self.unit or "")), inf)
        return abs(line.value * factor - self.value) <= max(0.5 * self.resolution, _NOISE * abs(self.value))

    def __str__(self) -> str:
        return f"{self.value:g} {self.unit or ''}".rstrip() if self.value is not None else self.status


_NOISE = 1e-6
"""The relative error of a value that a driver may have rounded."""
_UNITS = ("v", "mv", "ma", "degc")
_FACTORS = {(unit, unit): 1.0 for unit in _UNITS} | {("v", "mv"): 1000.0, ("mv", "v"): 0.001}


def _plain(unit: str) -> str:
    return unit.lower().replace("°", "deg").strip() if unit.lower() != "c" else "degc"


@frozen(eq=False)
class Given:
    """An answer with readings, as its module meant it."""

    at: float
    """The time of its request."""
    arrived: float
    """The time at which its last byte arrives; infinity if none does."""
    address: int
    step: int
    """The number of the step, from 0."""
    belief: Belief
    told: tuple[Told, ...]
    event: int = 0
    """The number of the exchange on the line."""
    faults: tuple[str, ...] = ()


@frozen
class Line:
    """A line of the driver's output."""

    at: float
    number: int
    said: Believed | Unreadable


@frozen
class Ended:
    """The end of the driver before the end of the scenario."""

    at: float
    words: str


@frozen
class Session:
    """What happened while a scenario ran."""

    given: tuple[Given, ...] = ()
    requests: tuple[float, ...] = ()
    """The times of all requests, of those without an answer too."""
    lines: tuple[Line, ...] = ()
    began: float = 0.0
    now: float = 0.0
    steps: int = 1
    """How many steps the scenario has."""
    finished: bool = False
    """Whether all steps were carried out."""
    ended: Ended | None = None
    patience: float = 10.0
    """The longest time without a line of the driver."""
    held_up: float = 0.0
    """The longest time for which the machine of the line did not get to it."""


@frozen
class Finding:
    """Something that is wrong with a driver."""

    kind: Kind
    at: float
    text: str
    event: int | None = None
    """The exchange that it is about."""
    line: int | None = None
    """The line of the output that it is about."""


@frozen
class Judgement:
    """The verdict on a driver, and its reasons."""

    verdict: Verdict
    findings: tuple[Finding, ...] = ()
    reason: str = ""
    """Why it is neither passed nor failed, or what makes a failure doubtful."""
    values: int = 0
    """The number of right values that it reported."""


def judge(session: Session) -> Judgement:
    """Return whether a driver was right in a session that is over."""
    unreadable = next((line for line in session.lines if isinstance(line.said, Unreadable)), None)
    if unreadable is not None and isinstance(unreadable.said, Unreadable):
        reason = f"line {unreadable.number} of the driver's output: {unreadable.said.reason}"
        return Judgement(Verdict.ERROR, reason=reason)
    believed, wrong = _believed(session)
    values = believed.values
    findings = [*wrong, *_deadlocks(session)]
    if session.ended is not None and not session.finished:
        findings.append(Finding(Kind.ENDED, session.ended.at, session.ended.words))
    if session.finished and len(wrong) < _MOST_WRONG:
        findings += _missing(session, believed)
    if findings:
        is_slow = session.held_up > _MOST_HELD_UP
        reason = f"doubtful: this machine held up the line for {session.held_up:.1f} s" if is_slow else ""
        return Judgement(Verdict.FAIL, tuple(sorted(findings, key=lambda it: it.at)), reason, values)
    if not session.requests:
        return Judgement(Verdict.INCONCLUSIVE, reason="the driver sent nothing")
    if not session.given:
        return Judgement(Verdict.INCONCLUSIVE, reason="the driver asked for no readings")
    if not session.finished:
        step = max(it.step for it in session.given)
        reason = f"the driver asked too little: step {step + 1} of {session.steps} was not over in time"
        return Judgement(Verdict.INCONCLUSIVE, reason=reason, values=values)
    return Judgement(Verdict.PASS, values=values)


def is_decided(session: Session) -> bool:
    """Return whether waiting changes nothing: a value was wrong, or all values of the last step were reported."""
    beliefs, wrong = _believed(session, 1)
    return bool(wrong) or not _missing(session, beliefs, session.steps - 1)


# --- what was believed ------------------------------------------------------------------------------------------------

_Use = tuple[Given, Told]


@define
class _Beliefs:
    used: set[tuple[Given, int]] = field(factory=set)
    """The readings that were believed: their answers and channels."""
    values: int = 0
    """How many of them are values."""
    excused: set[tuple[int, int]] = field(factory=set)
    """Step and address about which the driver said that there is no reading."""

    def has(self, given: Given, told: Told) -> bool:
        return (given, told.channel) in self.used


def _believed(session: Session, most: int = _MOST_WRONG) -> tuple[_Beliefs, list[Finding]]:
    """Return what was believed, and why lines are wrong: of so many at most, and nothing after the last of them."""
    beliefs = _Beliefs()
    wrong: list[Finding] = []
    readings = _readings(session)
    for line in session.lines:
        said = line.said
        if isinstance(said, Unreadable):
            continue
        if said.status in (MISSING, ERROR):
            steps = [it.step for it in _before(session, line) if it.address == said.address]
            beliefs.excused.add((steps[0] if steps else 0, said.address))
            continue
        use = next(_uses(readings.get((said.address, said.channel), []), beliefs, line, said), None)
        if use is None:
            wrong.append(_wrong(session, beliefs, line, said))
            if len(wrong) == most:
                break
        else:
            given, told = use
            beliefs.used.add((given, told.channel))
            beliefs.values += told.value is not None
    return beliefs, wrong


def _readings(session: Session) -> dict[tuple[int, int | None], list[_Use]]:
    """Return the readings that may be believed, by address and channel."""
    found: dict[tuple[int, int | None], list[_Use]] = {}
    for given in session.given:
        if given.belief is not Belief.NEVER and not _is_orphan(session, given):
            for told in given.told:
                found.setdefault((given.address, told.channel), []).append((given, told))
    return found


def _before(session: Session, line: Line) -> Iterator[Given]:
    """Return the answers before a line, the last first, as far as a line can rest on them."""
    end = bisect_right(session.given, line.at, key=attrgetter("at"))
    return reversed(session.given[max(0, end - _RECENT) : end])


def _uses(readings: Sequence[_Use], beliefs: _Beliefs, line: Line, said: Believed) -> Iterator[_Use]:
    """Yield the readings that a line may rest on, the last first."""
    end = bisect_right(readings, line.at, key=lambda it: it[0].at)
    for given, told in reversed(readings[max(0, end - _RECENT) : end]):
        if told.is_believed(said) and not beliefs.has(given, told):
            yield given, told


def _is_orphan(session: Session, given: Given) -> bool:
    """Return whether an answer arrives when the next request is out already, or never."""
    return given.arrived == inf or _asked_before(session.requests, given)


_Reason = tuple[Kind, str, Given | None]


def _asked_before(requests: tuple[float, ...], given: Given) -> bool:
    """Return whether there is a request between that of an answer and its arrival."""
    following = bisect_right(requests, given.at)
    return following < len(requests) and requests[following] < given.arrived - _NO_TIME


def _wrong(session: Session, beliefs: _Beliefs, line: Line, said: Believed) -> Finding:
    """Return why nothing supports a line."""
    kind, text, given = _source(session, beliefs, line, said) or _truth(session, line, said)
    what = f"channel {said.channel} of {said.address:02X}: {_words(said)}"
    return Finding(kind, line.at, f"{what}: {text}", None if given is None else given.event, line.number)


def _source(session: Session, beliefs: _Beliefs, line: Line, said: Believed) -> _Reason | None:
    """Return where a value comes from that is not right; None if no answer has it."""
    for given in _before(session, line):
        for told in given.told:
            if told.value is None or not told.is_believed(evolve(said, channel=told.channel)):
                continue
            if (given.address, told.channel) != (said.address, said.channel):
                place = f"channel {told.channel} of {given.address:02X}"
                return Kind.WRONG, f"that was {place}, {_ago(line, given)}", given
            if given.belief is Belief.NEVER:
                kind = Kind.INVENTED if given.arrived == inf else Kind.WRONG
                return kind, f"of an answer that is not to be believed: {', '.join(given.faults)}", given
            if beliefs.has(given, told):
                return Kind.WRONG, f"the value of {_ago(line, given)}, which was reported before", given
            return Kind.WRONG, "of an answer that arrived after the next request", given
    return None


def _truth(session: Session, line: Line, said: Believed) -> _Reason:
    """Return what the module said in place of a line that nothing supports."""
    last = next((it for it in _before(session, line) if it.address == said.address), None)
    if last is None:
        return Kind.INVENTED, "the module has not answered", None
    faults = ", ".join(last.faults)
    if last.belief is Belief.NEVER:
        return Kind.INVENTED, f"the module gave no value: {faults}", last
    truly = next((told for told in last.told if told.channel == said.channel), None)
    if truly is None:
        return Kind.INVENTED, "the answer has no such channel", last
    kind = Kind.INVENTED if truly.value is None and said.value is not None else Kind.WRONG
    return kind, f"the module gave {truly}{f', with {faults}' if faults else ''}", last


def _words(said: Believed) -> str:
    return said.status if said.value is None else f"{said.value:g} {said.unit or ''}".rstrip()


def _ago(line: Line, given: Given) -> str:
    return f"{max(0.0, line.at - given.at):.2f} s before"


# --- what was not -----------------------------------------------------------------------------------------------------


def _missing(session: Session, beliefs: _Beliefs, first: int = 0) -> list[Finding]:
    """Return the channels that a driver did not report in a step in which it has to, from a first step on."""
    found = []
    must = [it for it in session.given if it.belief is Belief.MUST and not _is_orphan(session, it)]
    for step in range(first, session.steps):
        given = [it for it in must if it.step == step]
        for address in dict.fromkeys(it.address for it in given):
            own = [it for it in given if it.address == address]
            for channel in sorted({told.channel for it in own for told in it.told}):
                pairs = [(it, told) for it in own for told in it.told if told.channel == channel]
                if not _is_reported(pairs, beliefs, excused=(step, address) in beliefs.excused):
                    text = f"channel {channel} of {address:02X}: no value, and the module gave {pairs[-1][1]}"
                    found.append(Finding(Kind.MISSING, pairs[-1][0].at, text, pairs[-1][0].event))
    return found


def _is_reported(pairs: Iterable[_Use], beliefs: _Beliefs, *, excused: bool) -> bool:
    """Return whether one of some readings was believed; of a sentinel, a driver may say that there is no reading."""
    return any(beliefs.has(given, told) or (excused and told.value is None) for given, told in pairs)


def _deadlocks(session: Session) -> list[Finding]:
    """Return the first time for which the driver said nothing for too long."""
    last = session.began
    end = session.ended.at if session.ended is not None else session.now
    for at in (*(line.at for line in session.lines), end):
        if at - last > session.patience:
            text = f"no line of the driver for {at - last:.1f} s; the bound is {session.patience:g} s"
            event = next((it.event for it in reversed(session.given) if it.at <= last + session.patience), None)
            return [Finding(Kind.DEADLOCK, last, text, event)] if session.requests else []
        last = at
    return []
