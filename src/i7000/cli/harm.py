"""The options of the commands that send frames of the conformance kit: what could do harm, and its limits.

Laws: nothing here needs a port.
"""

from typing import TYPE_CHECKING, Annotated

from attrs import frozen
from cyclopts import Parameter

from i7000.cli.options import Texts
from i7000.cli.words import UsageError

if TYPE_CHECKING:
    from i7000.conformance.hazard import Hazard

__all__ = ["HARMLESS", "HarmOptions"]

_ALLOWABLE = ("write", "broadcast", "comm", "calibration")
_SCALES = 0.1, 100.0
_MOST_WRITES = 10_000


@Parameter(name="*")
@frozen
class HarmOptions:
    """What may be sent that could do harm, and how it is limited."""

    allow: Texts = ()
    """Also send what could do harm: write, broadcast, comm or calibration; repeat it."""
    confirm: str | None = None
    """The name of the module, as it answers it: --allow calibration needs it."""
    i_can_power_cycle: Annotated[bool, Parameter(negative="")] = False
    """You can switch the power of the module off and on: --allow comm needs it."""
    snapshot: str | None = None
    """The new file for the settings before a run with --allow. Default: i7000-MODEL-ADDRESS-TIME.json."""
    eeprom_writes: int = 64
    """The most frames that may change the EEPROM: 0 to 10000."""
    timeout_scale: float = 1.0
    """Multiply all times to listen, for slow adapters and networks: 0.1 to 100."""

    def check(self) -> None:
        """Raise `UsageError` for numbers beyond the range, and for a --snapshot that exists."""
        from i7000.cli.snapshot_file import check_new  # noqa: PLC0415 - it takes time

        low, high = _SCALES
        if not low <= self.timeout_scale <= high:
            raise UsageError(f"--timeout-scale {self.timeout_scale:g}: give {low:g} to {high:g}")
        if not 0 <= self.eeprom_writes <= _MOST_WRITES:
            raise UsageError(f"--eeprom-writes {self.eeprom_writes}: give 0 to {_MOST_WRITES}")
        if self.snapshot is not None:
            check_new(self.snapshot)

    def allowed(self) -> "frozenset[Hazard]":
        """Return the hazards that are allowed.

        Errors: `UsageError`.
        """
        from i7000.conformance.hazard import Hazard, allowing  # noqa: PLC0415 - it takes time

        for text in self.allow:
            if text not in _ALLOWABLE:
                raise UsageError(f"--allow {text}: give {', '.join(_ALLOWABLE)}")
        hazards = allowing(map(Hazard, self.allow))
        if Hazard.COMM in hazards and not self.i_can_power_cycle:
            raise UsageError("--allow comm can lose the module: add --i-can-power-cycle if you can switch its power")
        if Hazard.CALIBRATION in hazards and self.confirm is None:
            why = "--allow calibration can destroy the calibration"
            raise UsageError(f"{why}: add --confirm NAME, the name of the module")
        return hazards


HARMLESS = HarmOptions()
