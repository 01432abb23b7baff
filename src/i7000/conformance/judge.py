"""The judgement of a line in operation: what driver and modules owe each other, from what was heard of them.

`judge` takes frames one after the other, as `i7000.dissect` hears them, and returns findings. `verdict` counts them.
Nothing is sent. The rules are in `i7000.conformance.judge_rules`, what a frame breaks by itself in `judge_frames`.

Laws: frozen state in, frozen state out; the times are arguments. What cannot be judged is counted, never passed. A
finding about times is certain as far as the times are right. If the traffic shows that an adapter collects bytes,
findings about times that are shorter than it can deliver are withdrawn.
"""

from typing import Any

from attrs import evolve

from i7000.arguments import check_type
from i7000.conformance.judge_frames import (
    Broken,
    answers,
    driver_broken,
    duty_after,
    module_broken,
    writes_eeprom,
)
from i7000.conformance.judge_rules import Rule, Side
from i7000.conformance.judge_sides import LUMP, side_of, since_of
from i7000.conformance.judge_state import Asked, Count, Finding, Judge, Pause, Tally, Verdict, verdict
from i7000.conformance.statement import Level
from i7000.dissect import Heard, Knowledge, Known
from i7000.dissect.timing import Times
from i7000.settings import Protocol

__all__ = ["EEPROM_WRITES", "Finding", "Judge", "Level", "Rule", "Side", "Tally", "Verdict", "judge", "verdict"]

EEPROM_WRITES = 10
"""More writes than these within a minute, to one module, are a loop."""
_LOOP = 60.0
_ROUNDING = 1e-9
"""The seconds by which the sum of times can be wrong."""
_RTU = Protocol.MODBUS_RTU


def judge(
    state: Judge, heard: Heard, knowledge: Knowledge, times: Times | None = None, *, sent: bool | None = None
) -> tuple[Judge, tuple[Finding, ...]]:
    r"""Judge what was heard next, a frame or not.

    Shape: `knowledge` of the modules after it was heard: `Line.knowledge`. `sent`: whether the host sent it, None if
        that is unknown.
    Errors: `ArgumentError`.

    >>> from i7000.dissect import Line, hear_frame
    >>> line, heard = hear_frame(Line(), b"$01m\r", Protocol.DCON)
    >>> state, (finding,) = judge(Judge(), heard, line.knowledge)
    >>> finding.rule.id, finding.what
    ('listen/driver/lower-case', 'lower case: in upper case it is ReadModuleName')
    """
    check_type("state", state, Judge)
    check_type("heard", heard, Heard)
    check_type("knowledge", knowledge, Knowledge)
    check_type("times", times, Times, optional=True)
    side = side_of(state, heard, times, sent)
    if side is None:
        noise = heard.same_as is None
        return evolve(state, last=times, damaged=noise, unjudged=state.unjudged + noise), ()
    step = _Step(state, heard, times)
    (step.of_driver if side is Side.DRIVER else step.of_module)(knowledge)
    return step.judged(), tuple(step.findings)


# --- a frame ----------------------------------------------------------------------------------------------------------

_ANSWERABLE = (Rule.LACKS_COMMAND, Rule.BOUNDS)
"""What may be wrong with a frame that a module answers all the same, with ``?AA`` or an exception."""


_CHECKSUMS = (Rule.DRIVER_CHECKSUM_MISSING, Rule.DRIVER_CHECKSUM_UNEXPECTED)
_NOTHING_KNOWN = Known()


class _Step:
    """A frame that is being judged: its findings, and the changes of the state."""

    def __init__(self, state: Judge, heard: Heard, times: Times | None) -> None:
        self.state = state
        self.heard = heard
        self.times = times
        self.findings: list[Finding] = []
        self.changes: dict[str, Any] = {}
        self._place: tuple[Side, int | None] | None = None
        self._untimed: list[Rule] = []
        self._withdrawn: tuple[Rule, int | None] | None = None
        self._pause: Pause | None = None

    def judged(self) -> Judge:
        """Return the state after the frame."""
        counts = dict(self.state.counts)
        if self._place is not None:
            frames, findings = counts.get(self._place, Count())
            counts[self._place] = Count(frames + 1, findings)
        changes = [(finding.rule, finding.address, 1) for finding in self.findings]
        changes += [] if self._withdrawn is None else [(*self._withdrawn, -1)]
        for rule, address, change in changes:
            frames, findings = counts.get((rule.side, address), Count())
            counts[rule.side, address] = Count(frames, {**findings, rule: findings.get(rule, 0) + change})
        untimed = self.state.untimed
        for rule in self._untimed:
            untimed = {**untimed, rule: untimed.get(rule, 0) + 1}
        return evolve(
            self.state,
            last=self.times,
            damaged=self.heard.error is not None,
            counts=counts,
            untimed=untimed,
            withdrawn=self.state.withdrawn + (self._withdrawn is not None),
            **self.changes,
        )

    def _find(self, rule: Rule, what: str, address: int | None) -> None:
        heard = self.heard
        self.findings.append(Finding(rule, heard.place, address, heard.protocol, heard.wire, what, self.times))

    def _since(self, earlier: Times | None) -> float | None:
        return since_of(earlier, self.times)

    def _below(self, since: float, limit: float) -> bool:
        """Return whether a time is certainly below a limit, as fine as the times are written.

        Special: a port delivers a byte at its end at the earliest; its beginning was a character before.
        """
        since -= (self.state.character_time or 0.0) if self.state.collecting else 0.0
        resolution = self.times.resolution if self.times else 0.0
        return since + resolution <= limit if resolution else since < limit - _ROUNDING

    def _above(self, since: float, limit: float) -> bool:
        return since - (self.times.resolution if self.times else 0.0) > limit

    # --- the driver ---------------------------------------------------------------------------------------------------

    def of_driver(self, knowledge: Knowledge) -> None:
        """Judge a frame of the driver."""
        heard, state = self.heard, self.state
        address = _meant_address(heard) if heard.address is None else heard.address
        self._place = Side.DRIVER, address
        broken = driver_broken(heard, knowledge.of(address).known)
        if broken is not None:
            self._find(broken.rule, broken.what, address)
        asked = self._asked(address, broken)
        self._judge_pauses(address)
        self._judge_turn(address)
        self._judge_gaps(Rule.DRIVER_GAP_BEFORE, Rule.DRIVER_GAP_WITHIN, address)
        self._judge_writes(address)
        self.changes |= {
            "asked": asked if asked.silent is None else None,
            "earlier": None if state.asked is not None and state.asked.wire == heard.wire else state.asked,
            "answered": None if asked.silent is None else asked,
            "late": False,
        }

    def _asked(self, address: int | None, broken: Broken | None) -> Asked:
        """Return the frame as a command, and begin the pause after it."""
        heard = self.heard
        faulty = broken is not None and broken.rule in (*_ANSWERABLE, Rule.NO_COMMAND)
        silent = None if broken is None or broken.rule in _ANSWERABLE else Rule.ANSWERS_INVALID
        if silent and broken is not None and broken.rule is Rule.NO_COMMAND and heard.protocol is _RTU:
            silent = None  # A module answers with exception 01, or 03.
        seconds, name = 0.0, ""
        rule = Rule.ASK_IN_CALIBRATION
        if silent is None and len(heard.meanings) == 1:
            (meaning,) = heard.meanings
            seconds, is_answered = duty_after(meaning)
            name = type(meaning.message).__name__
            if not is_answered:
                to_all = heard.protocol is _RTU
                silent = Rule.ANSWERS_MODBUS_BROADCAST if to_all else Rule.ANSWERS_BROADCAST
                rule = Rule.ASK_AFTER_MODBUS_BROADCAST if to_all else Rule.ASK_AFTER_BROADCAST
        broken_rule = broken and broken.rule
        asked = Asked(
            heard.place, heard.wire, heard.protocol, address, self.times, seconds, faulty, broken_rule, silent
        )
        if seconds:
            self._pause = Pause(rule, asked, seconds, name)
        return asked

    def _judge_pauses(self, address: int | None) -> None:
        left = []
        for pause in self.state.pauses:
            rule, asked, seconds, name = pause
            since = self._since(asked.times)
            concerned = rule is not Rule.ASK_IN_CALIBRATION or asked.address in (address, None)
            if not concerned:
                left.append(pause)
            elif since is None:
                self._untimed.append(rule)
            elif self._below(since, seconds):
                what = f"{_time(since)} after {name}, {asked.place.where}: {_time(seconds)} needed"
                self._brief(rule, since, what, address)
                left += [pause] if rule is Rule.ASK_IN_CALIBRATION else []
        left = [pause for pause in left if self._pause is None or pause.asked.address != self._pause.asked.address]
        self.changes["pauses"] = (*left, *([self._pause] if self._pause else []))

    def _brief(self, rule: Rule, since: float, what: str, address: int | None) -> None:
        """Find a breach of a rule about times, unless the adapter explains it."""
        hidden = self.state.lumps or (self.state.collecting and since == 0.0)
        if rule.brief and hidden:
            self._untimed.append(rule)
        else:
            self._find(rule, what, address)

    def _judge_turn(self, address: int | None) -> None:
        asked = self.state.asked
        if asked is None:
            return
        since = self._since(asked.times)
        if since is None:
            self._untimed.append(Rule.ASK_BEFORE_ANSWER)
        elif self._below(since, self.state.bound / 2):
            rule = Rule.TAKES_LATE_ANSWER if self.state.late else Rule.ASK_BEFORE_ANSWER
            what = f"{_time(since)} after {asked.place.where}, which has no answer yet"
            if self.state.late:
                what += ", only that to an earlier frame has come"
            self._find(rule, what, address)

    def _judge_writes(self, address: int | None) -> None:
        heard, times = self.heard, self.times
        if heard.error is not None or len(heard.meanings) != 1 or not writes_eeprom(heard.meanings[0]):
            return
        if times is None:
            self._untimed.append(Rule.EEPROM_LOOP)
            return
        recent = [it for it in self.state.writes.get(address, ()) if 0 <= times.began - it < _LOOP]
        recent.append(times.began)
        if len(recent) > EEPROM_WRITES:
            name = type(heard.meanings[0].message).__name__
            self._find(Rule.EEPROM_LOOP, f"{name} is write {len(recent)} within {_LOOP:g} s", address)
            recent.clear()
        self.changes["writes"] = {**self.state.writes, address: tuple(recent)}

    # --- a module -----------------------------------------------------------------------------------------------------

    def of_module(self, knowledge: Knowledge) -> None:
        """Judge a frame of a module; those before the first command are not judged."""
        state, heard = self.state, self.heard
        asked = state.asked
        if asked is None:
            self._judge_unasked()
            return
        if heard.protocol is not asked.protocol:
            self.changes["unjudged"] = state.unjudged + 1
            return
        self._place = Side.MODULE, asked.address
        if self._judge_late(asked, knowledge):
            self.changes["late"] = True
            return
        since = self._since(asked.times)
        if since == 0.0 and state.collecting:
            self.changes["lumps"] = True
        bound = max(state.bound, asked.pause)
        if since is None:
            self._untimed.append(Rule.LATE)
        elif self._above(since, bound):
            self._find(Rule.LATE, f"{_time(since)} after {asked.place.where}: {_time(bound)} allowed", asked.address)
        if not (asked.faulty and heard.error is None):
            broken = module_broken(heard, asked.place, asked.wire, knowledge.of(asked.address).known)
            if broken is not None:
                self._find(broken.rule, broken.what, asked.address)
        self._judge_gaps(Rule.MODULE_GAP_BEFORE, Rule.MODULE_GAP_WITHIN, asked.address)
        self.changes |= {"asked": None, "earlier": None, "answered": asked}

    def _judge_unasked(self) -> None:
        """Judge a frame of a module while no command waits for one."""
        before, heard = self.state.answered, self.heard
        if before is None or heard.error is not None:
            self.changes["unjudged"] = self.state.unjudged + 1
            return
        address = heard.address if heard.address is not None else before.address
        self._place = Side.MODULE, address
        where = before.place.where
        if (
            before.broken is not None
            and before.broken in _CHECKSUMS
            and not module_broken(heard, before.place, before.wire, _NOTHING_KNOWN)
        ):
            self._withdrawn = before.broken, before.address
            self.changes |= {"answered": before._replace(broken=None, silent=None)}
        elif before.silent is not None:
            self._find(before.silent, f"an answer to {where}", address)
        elif address == before.address:
            self._find(Rule.SECOND_ANSWER, f"{where} was answered before", address)
        else:
            self._find(Rule.UNASKED, f"the last command, {where}, was answered before, and of another module", address)

    def _judge_late(self, asked: Asked, knowledge: Knowledge) -> bool:
        """Judge an answer to the command before the last; return whether it is one."""
        heard, earlier = self.heard, self.state.earlier
        if earlier is None or self.state.late or asked.faulty:
            return False
        known = knowledge.of(earlier.address).known
        is_late = heard.answers == earlier.place
        if heard.protocol is _RTU and heard.answers is None and earlier.protocol is _RTU:
            is_late = answers(earlier.wire, heard.wire, known)
        if not is_late:
            return False
        self._place = Side.MODULE, earlier.address
        since, where = self._since(earlier.times), earlier.place.where
        if since is None:
            self._find(Rule.ORDER, f"the answer to {where}, after {asked.place.where} was asked", earlier.address)
        elif self._above(since, self.state.bound):
            what = f"{_time(since)} after {where}, when {asked.place.where} was asked"
            self._find(Rule.LATE, what, earlier.address)
        return True

    # --- silences -----------------------------------------------------------------------------------------------------

    def _judge_gaps(self, before: Rule, within: Rule, address: int | None) -> None:
        """Judge the silence before a Modbus frame, and inside it."""
        state, times, silence = self.state, self.times, self.state.silence
        if self.heard.protocol is not _RTU:
            return
        since = self._since(state.last)
        if silence is None or times is None:
            self._untimed.append(before)
            return
        if since == 0.0 and before is Rule.MODULE_GAP_BEFORE:
            self._untimed.append(before)  # No module answers in no time: both have the time of the exchange.
        elif since is not None and self._below(since, silence):
            self._brief(before, since, f"{_time(since)} after the frame before: {_time(silence)} needed", address)
        longest = silence + (LUMP if state.collecting else 0.0)
        if times.gap > longest:
            self._brief(within, times.gap, f"a silence of {_time(times.gap)}: {_time(silence)} ends a frame", address)


def _meant_address(heard: Heard) -> int | None:
    """Return the address of a DCON command whose digits may be in lower case; None if it has none."""
    digits = heard.wire[1:3]
    return int(digits, 16) if len(digits) == len("AA") and _HEX.issuperset(digits) else None


_HEX = frozenset(b"0123456789ABCDEFabcdef")


def _time(seconds: float) -> str:
    """Write a time with three digits."""
    return f"{seconds:.3g} s" if seconds >= 1 else f"{seconds * 1000:.3g} ms"
