"""A module on a line that is checked one check at a time, as a test runner asks for them.

Laws: the module is identified and its settings are read first. Before the first check that may change a setting, they
are in a file, if one is given; `close` restores them. Nothing is sent but through the guard.
"""

import os
from collections.abc import Iterable, Sequence
from datetime import UTC, datetime
from pathlib import Path

from i7000 import spec
from i7000.arguments import check_int, check_type
from i7000.conformance.hazard import STORED, Hazard, allowing
from i7000.conformance.oracle import eeprom_of
from i7000.conformance.run import CheckResult, Options, Planned, Run, plan
from i7000.conformance.settle import Settled, settle
from i7000.device import power_on
from i7000.errors import I7000Error
from i7000.host.procedures import Snapshot, identify
from i7000.host.procedures import snapshot as read_settings
from i7000.link.guarded import GuardedPort
from i7000.link.line import Line
from i7000.link.target import open_target
from i7000.models import Model
from i7000.profile import Profile
from i7000.settings import LineSettings, Protocol

__all__ = ["Bench", "BenchError", "snapshot_name"]


class BenchError(I7000Error):
    """A module that does not answer, or that is not known; a file for its settings that exists."""


def snapshot_name(before: Snapshot, address: int) -> str:
    """Return the name of a new file for the settings of a module: its model, its address and the time."""
    moment = datetime.now(UTC).strftime("%Y%m%dT%H%M%S%fZ")
    return f"i7000-{before.model.value}-{address:02X}-{moment}.json"


class Bench:
    """A module at a target, ready for checks.

    Shape: `target` as for `open_target`. `model` is used in place of what the module says it is. `allow` are the
        hazards that are allowed beside reads. `snapshot` is a new file for the settings of before, or a folder for a
        file that is named after model, address and time; `kept` is that file as soon as it is written.
    Errors: `LinkError`, `InvalidValueError` for the target; `BenchError` for a module that does not answer, and for a
        file that exists.
    """

    def __init__(  # noqa: PLR0913 - each of them is a fact
        self,
        target: str,
        *,
        address: int = 1,
        model: Model | None = None,
        line: LineSettings = LineSettings(),  # noqa: B008 - frozen
        allow: Iterable[Hazard] = (),
        snapshot: str | os.PathLike[str] | None = None,
    ) -> None:
        check_int("address", address)
        check_type("model", model, Model, optional=True)
        allowed = allowing(allow)
        self._place = None if snapshot is None else Path(snapshot)
        self.kept: Path | None = None
        if self._place is not None and os.path.lexists(self._place) and not self._place.is_dir():
            raise BenchError(f"{self._place} exists: give the name of a new file")
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
        self.before = self._line.run(read_settings(address, known, found.protocol))
        self._address = address
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
        self._begun = False
        """Whether a check was carried out, also one that was broken off."""

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
                group = self._group(check)
                self._keep(group)
                self._begun = True
                self._line.run(self._run.checks(group), self._tell)
        return self._results[check]

    def _keep(self, group: Sequence[Planned]) -> None:
        """Write the settings of before to the file, if checks are the first ones that may change any."""
        if self._place is None or self.kept or not any(it.statement.hazards & STORED and not it.skip for it in group):
            return
        path = self._place / snapshot_name(self.before, self._address) if self._place.is_dir() else self._place
        with path.open("x", encoding="ascii") as file:
            file.write(self.before.to_json())
            file.flush()
            os.fsync(file.fileno())
        self.kept = path

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

        Special: if no check was begun, nothing is sent.
        Errors: `LinkError` if the port is lost.
        """
        try:
            if not self._begun:
                return Settled()
            return self._line.run(settle(self.before, self._run.place, self._run.line))
        finally:
            self._line.close()
