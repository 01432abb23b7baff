"""A simulated bus that plays the script of a scenario while a driver polls it, and notes what was asked and answered.

Laws: the faults and the inputs of a step hold from the first of its answers on. What an answer truly said is decoded
from the bytes of the module, before the faults of the line.
"""

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from math import inf
from typing import Protocol

from attrs import evolve

from i7000.conformance.provoked import Given, Session, Told
from i7000.conformance.scenarios import Belief, Inputs, Scenario, Step
from i7000.device import Eeprom, Signal
from i7000.dissect import Knowledge, Known, Meaning, hear_frame
from i7000.dissect import Line as Listener
from i7000.errors import Noise
from i7000.simulator.faults import Faults
from i7000.simulator.observed import Observed
from i7000.simulator.sources import OPEN, SAMPLES_A_SECOND, Fixed, Ramp, Source, Sources
from i7000.type_codes import TypeCode

__all__ = ["Played", "Player", "sources"]

_MOST_EXCHANGES = 10_000
"""The exchanges of a scenario that are kept; a driver that asks more has no pauses."""
_MOST_STEPS = 900
"""The values of a channel until they repeat."""
_PARTS = 10_000
"""The parts of full scale that the percent format shows."""


class Played(Protocol):
    """A line whose faults and inputs a player changes."""

    faults: Faults


class Player:
    """The script of a scenario, on a line."""

    def __init__(
        self,
        scenario: Scenario,
        line: Played,
        connect: Callable[[Sequence[Sources]], object],
        eeproms: Sequence[Eeprom],
        read_faults: Callable[[str], Faults],
    ) -> None:
        """Begin the first step.

        Shape: `connect` is called with the signals of all modules, `read_faults` with the faults of a step as text.
        """
        self._steps = scenario.steps
        self._line, self._connect, self._eeproms, self._read_faults = line, connect, eeproms, read_faults
        self._step = 0
        self._answered: Counter[int] = Counter()
        """The answers in this step, by address."""
        self.finished = False
        self.exchanges: list[Observed] = []
        self.given: list[Given] = []
        self.requests: list[float] = []
        self._begin()

    def session(self, session: Session) -> Session:
        """Add what was asked and answered to a session."""
        return evolve(
            session,
            given=tuple(self.given),
            requests=tuple(self.requests),
            steps=len(self._steps),
            finished=self.finished,
        )

    def observe(self, observed: Observed) -> None:
        """Note an exchange, and go on to the next step if the present one is over."""
        if isinstance(observed.heard, Noise) or len(self.exchanges) >= _MOST_EXCHANGES:
            return
        self.requests.append(observed.at)
        self.exchanges.append(observed)
        address, told = _told(observed)
        if address is None or not told:
            return
        step = self._steps[self._step]
        arrived = observed.at + observed.pieces[-1].after if observed.pieces else inf
        event = len(self.exchanges) - 1
        belief = step.belief_by(observed.protocol)
        self.given.append(Given(observed.at, arrived, address, self._step, belief, told, event, observed.faults))
        self._answered[address] += 1
        if not self.finished and self._is_over(step):
            self._go_on()

    def _is_over(self, step: Step) -> bool:
        if step.belief is Belief.MUST:
            return min(self._answered[given.address] for given in self.given) >= step.answers
        return self._answered.total() >= step.answers

    def _go_on(self) -> None:
        if self._step + 1 == len(self._steps):
            self.finished = True
            return
        self._step += 1
        self._answered.clear()
        self._begin()

    def _begin(self) -> None:
        step = self._steps[self._step]
        self._line.faults = self._read_faults(step.faults)
        places = len(self._eeproms)
        self._connect([sources(it, place, places, step.inputs) for place, it in enumerate(self._eeproms)])


# --- what modules say -------------------------------------------------------------------------------------------------


def _told(observed: Observed) -> tuple[int | None, tuple[Told, ...]]:
    """Return the address of an answer and what it says of channels, before the faults of the line."""
    if observed.profile is None or observed.answer is None or isinstance(observed.heard, Noise):
        return None, ()
    line = Listener(Knowledge.given(Known.of(observed.profile)), observed.protocol)
    line, asked = hear_frame(line, observed.heard, observed.protocol, sent=True)
    _, heard = hear_frame(line, observed.answer, observed.protocol, sent=False)
    return asked.address, tuple(_readings(heard.meanings[0])) if heard.meanings else ()


def _readings(meaning: Meaning) -> Iterator[Told]:
    found = [(it.channel, it.value, it.status, it.type_code) for it in meaning.readings]
    found += [(it.channel, it.reading.value, it.reading.status, it.type_code) for it in meaning.items if it.reading]
    return (
        Told(channel, value, status.value, code.unit, 10.0**-code.decimals)
        for channel, value, status, code in found
        if channel is not None and status is not None and code is not None
    )


# --- what is at their inputs ------------------------------------------------------------------------------------------


def sources(eeprom: Eeprom, place: int, places: int, inputs: Inputs) -> Sources:
    """Return the signals of a module: each channel of each module has its own values, which change at each sample.

    Shape: `place` of the module on a bus of so many `places`.
    """
    channels = len(eeprom.type_codes)
    slots = channels * places
    return Sources(
        tuple(
            _beyond(code, inputs)
            if inputs is not Inputs.VARYING and channel % 2 == 0
            else _ramp(code, place * channels + channel, slots)
            for channel, code in enumerate(eeprom.type_codes)
        )
    )


def _ramp(code: TypeCode, slot: int, slots: int) -> Source:
    """Return values of one part of the span, in steps that every data format shows."""
    low = max(0.0, code.minimum)
    step = max(10.0**-code.decimals, code.full_scale / _PARTS)
    steps = min(_MOST_STEPS, int((code.maximum - low) / step / slots) - 1)
    first = low + slot * (code.maximum - low) / slots
    return Ramp(first, first + steps * step, steps / SAMPLES_A_SECOND, code.unit)


def _beyond(code: TypeCode, inputs: Inputs) -> Source:
    if inputs is Inputs.OPEN:
        return OPEN
    span = code.maximum - code.minimum
    value = code.maximum + span if inputs is Inputs.OVER else code.minimum - span
    return Fixed(Signal(value, code.unit))
