"""What a driver is provoked with: scripts of good and bad answers, as data.

A scenario is a list of steps. In each step, the answers with readings get the faults of the step, and the step says
what a right driver makes of such an answer. The first and the last step are always undisturbed: the driver works at
all, and it recovers.

Laws: pure data. Faults are written as for ``i7000 simulate --fault``.
"""

from enum import StrEnum

from attrs import frozen

from i7000.settings import Protocol

__all__ = ["SCENARIOS", "Belief", "Bus", "Inputs", "Scenario", "Step", "refusal"]


class Belief(StrEnum):
    """What a right driver makes of the answers of a step."""

    MUST = "must"
    """It reports their readings."""
    MAY = "may"
    """It reports their readings or rejects them; both are right."""
    NEVER = "never"
    """It reports no value of them."""


class Inputs(StrEnum):
    """The signals at the inputs during a step."""

    VARYING = "varying"
    """Each channel of each module has its own values, which change at each sample."""
    OVER = "over range"
    """Every other channel is over its range."""
    UNDER = "under range"
    """Every other channel is under its range."""
    OPEN = "open wire"
    """Every other channel has an open wire."""


@frozen
class Step:
    """Some answers with the same faults."""

    answers: int
    """How many: of each module if they must be believed, else of all modules together."""
    faults: str = ""
    belief: Belief = Belief.MUST
    inputs: Inputs = Inputs.VARYING
    by_rtu: Belief | None = None
    """What a right driver makes of the answers by Modbus RTU, if that differs."""

    def belief_by(self, protocol: Protocol) -> Belief:
        """Return what a right driver makes of the answers by a protocol."""
        return self.by_rtu or self.belief if protocol is Protocol.MODBUS_RTU else self.belief


@frozen
class Bus:
    """The modules that a driver is provoked with, as far as it matters for what applies to them."""

    protocols: frozenset[Protocol]
    checksum: bool
    """Whether each DCON module has a checksum."""
    models: tuple[str, ...]
    """The names of the models."""


@frozen
class Scenario:
    """A script of answers, and what a right driver does with them."""

    name: str
    title: str
    line: str
    """What goes on the line."""
    right: str
    """What a right driver does."""
    sections: tuple[str, ...]
    """Sections of the manual, and errata."""
    steps: tuple[Step, ...]
    protocols: frozenset[Protocol] = frozenset(Protocol)
    sealed: bool = False
    """Whether only a checksum or CRC can show what is wrong."""
    blank: tuple[int, ...] = ()
    """The channels that are disabled."""
    firmware: str | None = None
    """The firmware of the modules in place of their own."""
    series: str = ""
    """A part of the names of the models that it is about; all if empty."""
    model: str = ""
    """A model that has it, if the default one has not."""


_BEFORE = Step(3)
_BETWEEN = Step(1, "", Belief.MAY)
_AFTER = Step(2)
_DCON = frozenset({Protocol.DCON})
_RTU = frozenset({Protocol.MODBUS_RTU})


def _disturbed(faults: str, belief: Belief = Belief.NEVER, *, first: int = 1, second: int = 2) -> tuple[Step, ...]:
    """Return the usual steps: the fault for one answer, and later for several."""
    return _BEFORE, Step(first, faults, belief), _BETWEEN, Step(second, faults, belief), _AFTER


def _sensed(*inputs: Inputs, belief: Belief = Belief.MUST) -> tuple[Step, ...]:
    """Return steps with several inputs, one after the other."""
    return _BEFORE, *(Step(3, "", belief, it) for it in inputs), _AFTER


SCENARIOS = (
    Scenario(
        "undisturbed",
        "a line without faults",
        "Each request has its answer, at once.",
        "It reports each channel of each module.",
        ("2.3", "3.2"),
        (Step(4),),
    ),
    Scenario(
        "late-reply",
        "answers that are 0.4 s late",
        "Some answers come 0.4 s late: most drivers have sent their next request by then.",
        "It drops an answer that comes after its deadline, and never takes it for that to its next request.",
        ("2.3", "3.2"),
        _disturbed("late=1:0.4", Belief.MAY, second=3),
    ),
    Scenario(
        "very-late-reply",
        "answers that are 0.9 s late",
        "Some answers come 0.9 s late.",
        "It leaves the line silent after a deadline, for longer than any answer can take, before it asks again.",
        ("2.3", "3.2"),
        _disturbed("late=1:0.9", Belief.MAY),
    ),
    Scenario(
        "echo",
        "an adapter that hears what it sends",
        "Each request comes back before its answer, as with a 2-wire adapter whose receiver stays on.",
        "It drops the echo, and reports the answer.",
        ("2", "3.2"),
        (Step(4, "echo"),),
    ),
    Scenario(
        "wrong-address",
        "answers with the address of another module",
        "Some answers have another address and a good CRC.",
        "It compares the address with that of its request, and rejects them.",
        ("3.2",),
        _disturbed("misaddress=1"),
        _RTU,
    ),
    Scenario(
        "wrong-function",
        "answers to another command",
        "Some answers are frames of another command with a good checksum or CRC: function 03 for 04, ! for >.",
        "It rejects what is not the answer to its request, however good the frame is.",
        ("2.3", "3.2"),
        _disturbed("misfunction=1"),
    ),
    Scenario(
        "damaged",
        "answers with one wrong bit",
        "One bit of some answers is flipped.",
        "It compares the checksum or CRC, and rejects them.",
        ("2", "3"),
        _disturbed("corrupt=1", second=3),
        sealed=True,
    ),
    Scenario(
        "cut-short",
        "answers without their end",
        "Some answers end early, and nothing follows.",
        "It waits no longer than its timeout, and reports no value of a part.",
        ("2.3", "3.2"),
        _disturbed("truncate=1", second=3),
    ),
    Scenario(
        "split",
        "answers in two pieces",
        "Some answers have a pause of 20 ms in their middle, as after a USB adapter or a network.",
        "It reads on until the frame is complete. By Modbus RTU it may reject it: a pause ends a frame there.",
        ("2.3", "3"),
        (_BEFORE, Step(4, "split=1:0.02", by_rtu=Belief.MAY), _AFTER),
    ),
    Scenario(
        "lumps",
        "answers in lumps every 16 ms",
        "Answers arrive in lumps every 16 ms, as from most USB adapters.",
        "It reads on until the frame is complete. By Modbus RTU it may reject it: a pause ends a frame there.",
        ("2.3", "3"),
        (_BEFORE, Step(3, "lumps", by_rtu=Belief.MAY), _AFTER),
    ),
    Scenario(
        "two-replies",
        "answers that come twice",
        "Some answers are sent twice, without a pause.",
        "It takes one, and drops the other before its next request.",
        ("2.3", "3.2"),
        (_BEFORE, Step(3, "duplicate=1", Belief.MAY), _AFTER),
    ),
    Scenario(
        "silence",
        "modules that do not answer",
        "Some requests have no answer.",
        "It reports after a timeout that there is no reading, and asks again; it never repeats an old value.",
        ("2", "3.2"),
        _disturbed("silent=1", second=4),
    ),
    Scenario(
        "refused",
        "requests that are refused",
        "Some answers are ?AA, or a Modbus exception.",
        "It reports an error and no value.",
        ("2.3", "3.2"),
        _disturbed("refuse=1"),
    ),
    Scenario(
        "blank-channels",
        "modules with disabled channels",
        "Channels 2 and 5 are disabled: their fields are blanks, as those of the 7019 series are.",
        "It keeps the place of each channel, and reports no value for a disabled one.",
        ("2.3", "2.13"),
        (Step(4),),
        _DCON,
        blank=(2, 5),
        series="7019",
        model="I-7019R",
    ),
    Scenario(
        "sentinels",
        "channels without a value",
        "Every other channel is over range, then under range, then has an open wire.",
        "It reports over range and under range as such, never as a number.",
        ("1.11", "2.3", "E48", "E50"),
        _sensed(Inputs.OVER, Inputs.UNDER, Inputs.OPEN),
    ),
    Scenario(
        "old-firmware",
        "the short sentinels of old firmware",
        "Out of range is +9999 or -0000, two characters shorter than other fields, and the first has no point.",
        "It keeps the place of each channel, and reports no number for them; an error for the whole answer is allowed.",
        ("1.11", "E49"),
        _sensed(Inputs.OVER, Inputs.UNDER, belief=Belief.MAY),
        _DCON,
        firmware="B1.4",
        series="I-7018",
    ),
    Scenario(
        "zero-after-frame",
        "a byte 00 after each answer",
        "A byte 00 follows some answers, as when the line driver is turned off; a CRC stays good with it.",
        "It takes the length of a frame from its contents, and drops the byte before its next request.",
        ("2.3", "3.2"),
        (_BEFORE, Step(3, "trailing=1", Belief.MAY), _AFTER),
    ),
    Scenario(
        "noise",
        "random bytes before answers",
        "Some random bytes precede some answers.",
        "It finds the frame after the noise, or asks again.",
        ("2.3", "3.2"),
        (_BEFORE, Step(4, "noise=1@from", Belief.MAY), _AFTER),
    ),
    Scenario(
        "noise-like-a-frame",
        "noise that looks like a frame",
        "A good frame that is too short for the answer precedes some answers.",
        "It compares the length with that of its request, and reports no value of the short frame.",
        ("2.3", "3.2"),
        (_BEFORE, Step(3, "lookalike=1", Belief.MAY), _AFTER),
    ),
)
"""All scenarios, the simplest first."""


def refusal(scenario: Scenario, bus: Bus) -> str | None:
    """Return why a scenario is not applicable to some modules; None if it is.

    >>> scenarios = {it.name: it for it in SCENARIOS}
    >>> refusal(scenarios["damaged"], Bus(frozenset({Protocol.DCON}), checksum=False, models=("I-7018",)))
    'without a checksum, a flipped bit cannot be noticed'
    """
    if not bus.protocols <= scenario.protocols:
        (only,) = scenario.protocols
        return f"only {'DCON' if only is Protocol.DCON else 'Modbus RTU'} has it"
    if scenario.sealed and Protocol.DCON in bus.protocols and not bus.checksum:
        return "without a checksum, a flipped bit cannot be noticed"
    if not all(scenario.series in model for model in bus.models):
        return f"only the {scenario.series} series has it"
    return None
