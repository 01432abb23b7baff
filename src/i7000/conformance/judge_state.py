"""The state and the results of the judgement of a line: `Judge`, `Finding`, `Verdict`.

Laws: the state is bounded: it has a few frames, and numbers by address and rule.
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from attrs import field

from i7000.arguments import check_seconds, check_type
from i7000.conformance.judge_rules import Rule, Side
from i7000.conformance.statement import Level
from i7000.dissect import Place
from i7000.dissect.timing import Times
from i7000.errors import InvalidValueError
from i7000.frozen import frozen
from i7000.settings import Protocol

__all__ = ["Asked", "Count", "Finding", "Judge", "Pause", "Tally", "Verdict", "verdict"]

_SILENT_CHARACTERS = 3.5
_SHORTEST_SILENCE = 0.00175
"""The silence between Modbus frames in characters, and the shortest one in seconds."""


@frozen
class Finding:
    """A frame that breaks a rule."""

    rule: Rule
    place: Place
    address: int | None
    """The module that it is about; None for all of them, or if it is unknown."""
    protocol: Protocol
    wire: bytes
    what: str
    """How it breaks the rule, in words."""
    times: Times | None = None


class Asked(NamedTuple):
    """A command or request."""

    place: Place
    wire: bytes
    protocol: Protocol
    address: int | None
    times: Times | None
    pause: float = 0.0
    """The seconds that the module works after it."""
    faulty: bool = False
    """Whether it has a wrong form, which a module may answer with an exception."""
    broken: Rule | None = None
    """The rule that it breaks by itself."""
    silent: Rule | None = None
    """The rule that an answer to it breaks; None if it has an answer."""


class Pause(NamedTuple):
    """Time to leave a module alone."""

    rule: Rule
    asked: Asked
    seconds: float
    name: str


class Count(NamedTuple):
    """What was judged of one side at one address."""

    frames: int = 0
    findings: Mapping[Rule, int] = MappingProxyType({})


_Places = Mapping[tuple[Side, int | None], Count]


@frozen
class Judge:
    """A line that is judged.

    Shape: `bound` is the time in which an answer has to begin; a driver has to wait for half of it, as times differ
        from driver to driver and the manual has none. `character_time` is the length of a character on the
        line; without it, the silences between Modbus frames are not judged. `collecting`: the times are those at which
        an adapter delivered the bytes, so that bytes which arrived together have no time between them. The other fields
        are the state.
    Unit: seconds.
    Errors: `InvalidValueError` for a time that is negative or not finite.
    """

    bound: float = 0.2
    character_time: float | None = None
    collecting: bool = False
    asked: Asked | None = field(default=None, kw_only=True)
    """The command that has no answer yet."""
    earlier: Asked | None = field(default=None, kw_only=True)
    """The command before that, if it has none either."""
    answered: Asked | None = field(default=None, kw_only=True)
    """The command that was answered last, or that has no answer; until the next one."""
    late: bool = field(default=False, kw_only=True)
    """Whether the answer to `earlier` came after the command in `asked`."""
    pauses: tuple[Pause, ...] = field(default=(), kw_only=True)
    writes: Mapping[int | None, tuple[float, ...]] = field(factory=dict, kw_only=True)
    """The times of the last writes to the EEPROM, by address."""
    last: Times | None = field(default=None, kw_only=True)
    """The times of the last frame or noise."""
    damaged: bool = field(default=False, kw_only=True)
    """Whether that was damaged."""
    lumps: bool = field(default=False, kw_only=True)
    """Whether the traffic shows that an adapter collects bytes."""
    counts: _Places = field(factory=dict, kw_only=True)
    untimed: Mapping[Rule, int] = field(factory=dict, kw_only=True)
    """How often a rule could not be judged, because the times cannot tell."""
    withdrawn: int = field(default=0, kw_only=True)
    """Findings that what came later has explained."""
    unjudged: int = field(default=0, kw_only=True)
    """Pieces that are not like a frame of either side, and answers to what was asked before the listener came."""

    def __attrs_post_init__(self) -> None:
        for name, seconds in (("bound", self.bound), ("character_time", self.character_time or 0.0)):
            check_seconds(name, seconds)
            if seconds < 0:
                raise InvalidValueError(name, seconds, "seconds, 0 or more", "")

    @property
    def silence(self) -> float | None:
        """The silence between Modbus frames in seconds; None if the baud rate is unknown."""
        if self.character_time is None:
            return None
        return max(_SILENT_CHARACTERS * self.character_time, _SHORTEST_SILENCE)


# --- the verdict ------------------------------------------------------------------------------------------------------


class Tally(NamedTuple):
    """What was judged of one side at one address."""

    side: Side
    address: int | None
    """None for all modules, or if it is unknown."""
    frames: int
    findings: tuple[tuple[Rule, int], ...]
    """The rules that were broken, and how often."""


class Verdict(NamedTuple):
    """The judgement of all that was heard."""

    tallies: tuple[Tally, ...]
    untimed: tuple[tuple[Rule, int], ...]
    """The rules that could not be judged for some frames, because the times cannot tell; and for how many."""
    withdrawn: int
    """The number of findings that do not count. An adapter collects bytes, and they are about short times; or a module
    answered a command in spite of its checksum, so that its setting had changed."""
    unjudged: int
    """The number of pieces that were not judged: noise, and answers before the first command."""

    @property
    def frames(self) -> int:
        """The number of frames that were judged."""
        return sum(tally.frames for tally in self.tallies)

    def findings(self, *levels: Level) -> int:
        """Return the number of findings of these levels; of all without any."""
        found = (pair for tally in self.tallies for pair in tally.findings)
        return sum(count for rule, count in found if rule.level in (levels or Level))


def verdict(state: Judge) -> Verdict:
    """Return the judgement of all that was heard, by side and address."""
    check_type("state", state, Judge)
    withdrawn = state.withdrawn
    tallies = []
    for (side, address), (frames, findings) in sorted(state.counts.items(), key=_order):
        kept = tuple((rule, findings[rule]) for rule in Rule if findings.get(rule) and not (rule.brief and state.lumps))
        withdrawn += sum(findings.values()) - sum(count for _, count in kept)
        tallies.append(Tally(side, address, frames, kept))
    return Verdict(tuple(tallies), _by_rule(state.untimed), withdrawn, state.unjudged)


def _order(item: tuple[tuple[Side, int | None], Count]) -> tuple[Side, int]:
    (side, address), _ = item
    return side, -1 if address is None else address


def _by_rule(counts: Mapping[Rule, int]) -> tuple[tuple[Rule, int], ...]:
    return tuple((rule, counts[rule]) for rule in Rule if rule in counts)
