"""A module on a line that is checked one check at a time, as a test runner asks for them.

Laws: the module is identified and its settings are read first; `close` restores it. Nothing is sent but through the
guard.
"""

from collections.abc import Iterable

from i7000 import spec
from i7000.arguments import check_int, check_type
from i7000.conformance.hazard import Hazard, allowing
from i7000.conformance.oracle import eeprom_of
from i7000.conformance.run import CheckResult, Options, Planned, Run, plan
from i7000.conformance.settle import Settled, settle
from i7000.device import power_on
from i7000.errors import I7000Error
from i7000.host.procedures import identify, snapshot
from i7000.link.guarded import GuardedPort
from i7000.link.line import Line
from i7000.link.target import open_target
from i7000.models import Model
from i7000.profile import Profile
from i7000.settings import LineSettings, Protocol

__all__ = ["Bench", "BenchError"]


class BenchError(I7000Error):
    """A module that does not answer, or that is not known."""


class Bench:
    """A module at a target, ready for checks.

    Shape: `target` as for `open_target`. `model` is used in place of what the module says it is. `allow` are the
        hazards that are allowed beside reads.
    Errors: `LinkError`, `InvalidValueError` for the target; `BenchError` for a module that does not answer.
    """

    def __init__(
        self,
        target: str,
        *,
        address: int = 1,
        model: Model | None = None,
        line: LineSettings = LineSettings(),  # noqa: B008 - frozen
        allow: Iterable[Hazard] = (),
    ) -> None:
        check_int("address", address)
        check_type("model", model, Model, optional=True)
        allowed = allowing(allow)
        self._line = Line(GuardedPort(open_target(target, line), allowed), line)
        try:
            self._begin(target, address, model, allowed)
        except BaseException:
            self._line.close()
            raise

    def _begin(self, target: str, address: int, model: Model | None, allowed: frozenset[Hazard]) -> None:
        found = self._line.run(identify(address))
        if found.protocol is None:
            raise BenchError(f"{target}: no module answers at address {address:02X}")
        known = found.profile
        if model is not None and (known is None or known.model is not model):
            known = Profile(model, type_codes=(), checksum=bool(found.known.checksum))
        if known is None:
            raise BenchError(f"{target}: the module at address {address:02X} is not known: give its model")
        self.before = self._line.run(snapshot(address, known, found.protocol))
        eeprom = eeprom_of(self.before)
        profile = power_on(eeprom, now=0.0).profile
        self.model = profile.model
        self.planned = plan(spec.statements().values(), profile, found.protocol, allowed)
        """All checks, in the order of a run."""
        checksum = found.protocol is Protocol.DCON and known.checksum
        self._run = Run(self.planned, eeprom, Options(allowed=allowed), line=self._line.line, checksum=checksum)
        self._line.run(self._run.open())
        self._by_id = {it.statement.id: it for it in self.planned}
        self._results: dict[str, CheckResult] = {}

    def result(self, check: str) -> CheckResult:
        """Carry out a check, and before it those that it needs; return what became of it.

        Special: a check that was carried out before is not repeated. The negative halves of a check belong to it.
        Errors: `LinkError` if the port is lost.
        """
        if check not in self._results:
            statement = self._by_id[check].statement
            for needed in statement.needs:
                self.result(needed)
            if statement.positive in self._by_id:
                self.result(statement.positive)
            else:
                self._line.run(self._run.checks(self._group(check)), self._tell)
        return self._results[check]

    def _group(self, check: str) -> list[Planned]:
        return [self._by_id[check], *(it for it in self.planned if it.statement.positive == check)]

    def _tell(self, told: object) -> None:
        if isinstance(told, CheckResult):
            self._results[told.id] = told

    @property
    def results(self) -> tuple[CheckResult, ...]:
        """What became of the checks so far."""
        return tuple(self._results.values())

    def close(self) -> Settled:
        """Restore the module, and close the port; return what was left behind.

        Errors: `LinkError` if the port is lost.
        """
        try:
            return self._line.run(settle(self.before, self._run.place, self._run.line))
        finally:
            self._line.close()
