"""The options of a run of checks, and what they mean.

Laws: everything that can be wrong with the options is said before the port is opened.
"""

from collections.abc import Iterable, Mapping
from pathlib import Path

from attrs import frozen

from i7000 import InvalidValueError, spec
from i7000.cli.baseline import read_baseline
from i7000.cli.durations import seconds
from i7000.cli.module import named
from i7000.cli.report_files import KINDS
from i7000.cli.words import UsageError
from i7000.conformance.claims import Claims
from i7000.conformance.hazard import Hazard, allowing
from i7000.conformance.run import Options, asked_for, selected
from i7000.conformance.verdict import Verdict

__all__ = ["Settings", "Wishes", "allowed_of", "check_limits", "settings_of"]

_LARGEST_STATEMENT = 1 << 20
"""The bytes of the largest statement that is read."""
_SCALES = 0.1, 100.0
_MOST_WRITES = 10_000
_ASKED_FOR = {
    "write": Hazard.WRITE,
    "broadcast": Hazard.BROADCAST,
    "comm": Hazard.COMM,
    "calibration": Hazard.CALIBRATION,
}


@frozen(kw_only=True)
class Wishes:
    """The options of a run."""

    select: tuple[str, ...]
    allow: tuple[str, ...]
    confirm: str | None
    can_power_cycle: bool
    strict: bool
    certify: bool
    baseline: str | None
    baseline_update: bool
    reports: tuple[str, ...]
    statement: str | None
    snapshot: str | None
    seed: int
    max_time: str | None
    timeout_scale: float
    eeprom_writes: int
    quiet: bool


@frozen
class Settings:
    """What the options mean."""

    ids: frozenset[str]
    """The checks that were selected, and those that they need."""
    asked: frozenset[str]
    """The checks that were selected."""
    options: Options
    reports: tuple[tuple[str, str], ...]
    baseline: Mapping[str, Verdict]
    """The failures that are known."""


def settings_of(wishes: Wishes) -> Settings:
    """Return what the options mean.

    Errors: `UsageError`.
    """
    if wishes.certify and (wishes.select or wishes.baseline):
        raise UsageError("--certify checks everything: leave out the selection and --baseline")
    select = wishes.select
    if select and wishes.statement is not None:
        select = (*select, "statement")
    try:
        ids = selected(spec.statements(), select)
        asked = asked_for(spec.statements(), select)
    except InvalidValueError as error:
        raise UsageError(error) from None
    check_limits(wishes.timeout_scale, wishes.eeprom_writes)
    limit = None
    if wishes.max_time is not None:
        with named(f"--max-time {wishes.max_time}"):
            limit = seconds(wishes.max_time)
    if wishes.baseline_update and wishes.baseline is None:
        raise UsageError("--baseline-update needs --baseline FILE")
    options = Options(
        allowed=allowed_of(wishes.allow, confirm=wishes.confirm, can_power_cycle=wishes.can_power_cycle),
        seed=wishes.seed,
        timeout_scale=wishes.timeout_scale,
        writes=wishes.eeprom_writes,
        seconds=limit,
        claims=_claims(wishes),
    )
    baseline: Mapping[str, Verdict] = {}
    if wishes.baseline is not None:
        baseline = read_baseline(wishes.baseline, update=wishes.baseline_update)
    return Settings(ids, asked, options, _reports(wishes.reports), baseline)


def check_limits(timeout_scale: float, eeprom_writes: int) -> None:
    """Raise `UsageError` for numbers that --timeout-scale and --eeprom-writes cannot be."""
    low, high = _SCALES
    if not low <= timeout_scale <= high:
        raise UsageError(f"--timeout-scale {timeout_scale:g}: give {low:g} to {high:g}")
    if not 0 <= eeprom_writes <= _MOST_WRITES:
        raise UsageError(f"--eeprom-writes {eeprom_writes}: give 0 to {_MOST_WRITES}")


def _claims(wishes: Wishes) -> Claims | None:
    """Return the statement of the module.

    Errors: `UsageError` for a file that is not a statement, and for a selected group without one; `OSError`.
    """
    if wishes.statement is None:
        if any(text.startswith("statement") for text in wishes.select):
            raise UsageError("statement: give --statement FILE, made by i7000 statement")
        return None
    with Path(wishes.statement).open("rb") as file:
        data = file.read(_LARGEST_STATEMENT + 1)
    try:
        return Claims.from_json(data[:_LARGEST_STATEMENT])
    except InvalidValueError as error:
        raise UsageError(f"{wishes.statement}: {error.reason}") from None


def allowed_of(texts: Iterable[str], *, confirm: str | None, can_power_cycle: bool) -> frozenset[Hazard]:
    """Return what the options --allow, --confirm and --i-can-power-cycle allow.

    Errors: `UsageError`.
    """
    hazards = []
    for text in texts:
        if text not in _ASKED_FOR:
            raise UsageError(f"--allow {text}: give {', '.join(_ASKED_FOR)}")
        hazards.append(_ASKED_FOR[text])
    allowed = allowing(hazards)
    if Hazard.COMM in allowed and not can_power_cycle:
        raise UsageError("--allow comm can lose the module: add --i-can-power-cycle if you can switch its power")
    if Hazard.CALIBRATION in allowed and confirm is None:
        raise UsageError("--allow calibration can destroy the calibration: add --confirm NAME, the name of the module")
    return allowed


def _reports(texts: Iterable[str]) -> tuple[tuple[str, str], ...]:
    """Return the kinds and files of reports, which can be written: that is tried.

    Errors: `UsageError`; `OSError` for a file that cannot be written.
    """
    found: list[tuple[str, str]] = []
    for text in texts:
        kind, equals, file = text.partition("=")
        if kind not in KINDS or not equals or not file:
            raise UsageError(f"--report {text}: give KIND=FILE; kinds are {', '.join(KINDS)}")
        if any(Path(file).resolve() == Path(other).resolve() for _, other in found):
            raise UsageError(f"--report {text}: another report has this file")
        with Path(file).open("a", encoding="utf-8"):
            pass
        found.append((kind, file))
    return tuple(found)
