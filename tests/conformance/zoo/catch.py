"""What the kit says about firmware."""

from __future__ import annotations

from attrs import evolve, frozen

from i7000 import spec
from i7000.conformance.hazard import Hazard, allowing
from i7000.conformance.oracle import eeprom_of
from i7000.conformance.run import CheckResult, Options, Run, plan, selected
from i7000.conformance.settle import Settled, settle
from i7000.conformance.verdict import Verdict
from i7000.device import Eeprom, power_on
from i7000.host.procedures import snapshot
from i7000.link import Line
from i7000.link.guarded import GuardedPort
from tests.conformance.zoo.animal import Animal, AnimalPort
from tests.conformance.zoo.species import Species

BAD = frozenset({Verdict.FAIL, Verdict.FLAKY, Verdict.WARN, Verdict.PASS_GOOD_ONLY, Verdict.ERROR})


@frozen
class Caught:
    """The results of a run."""

    results: tuple[CheckResult, ...]
    settled: Settled

    @property
    def ids(self) -> list[str]:
        """The checks that did not pass."""
        return [it.id for it in self.results if it.verdict in BAD]


def examined(animal: Animal, eeprom: Eeprom, *allow: Hazard, select: tuple[str, ...] = ()) -> Caught:
    """What a run says about firmware that should have these settings."""
    allowed = allowing(allow)
    port = AnimalPort(animal)
    profile = evolve(power_on(eeprom, now=0.0).profile, type_codes=())
    with Line(GuardedPort(port, allowed), eeprom.line_settings) as line:
        taken = line.run(snapshot(eeprom.address, profile, eeprom.protocol))
        held = eeprom_of(taken)
        ids = selected(spec.statements(), select)
        chosen = [it for it in spec.statements().values() if it.id in ids]
        planned = plan(chosen, power_on(held, now=0.0).profile, eeprom.protocol, allowed)
        options = Options(allowed=allowed)
        one = Run(planned, held, options, line=line.line, checksum=profile.checksum)
        line.run(one.procedure())
        settled = line.run(settle(taken, one.place, one.line))
    return Caught(tuple(one.results), settled)


def caught_of(species: Species) -> Caught:
    """What a run says about a species."""
    return examined(species.born(), species.eeprom, *species.allow, select=species.select)
