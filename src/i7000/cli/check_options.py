"""The options of a run of checks, and what they mean; a baseline of failures that are known.

Laws: everything that can be wrong with the options is said before the port is opened.
"""

import json
from collections.abc import Iterable
from pathlib import Path

from attrs import frozen

from i7000 import InvalidValueError, spec
from i7000.cli.durations import seconds
from i7000.cli.module import named
from i7000.cli.report_files import KINDS
from i7000.cli.words import UsageError
from i7000.conformance.claims import Claims
from i7000.conformance.hazard import Hazard, allowing
from i7000.conformance.run import CheckResult, Options, selected
from i7000.conformance.verdict import Verdict

__all__ = ["FAILURES", "Settings", "Wishes", "allowed_of", "settings_of", "write_baseline"]

_LARGEST_BASELINE = 1 << 20
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
    options: Options
    reports: tuple[tuple[str, str], ...]
    known: frozenset[str]
    """The failures of the baseline."""


def settings_of(wishes: Wishes) -> Settings:
    """Return what the options mean.

    Errors: `UsageError`.
    """
    if wishes.certify and (wishes.select or wishes.baseline):
        raise UsageError("--certify checks everything: leave out the selection and --baseline")
    try:
        ids = selected(spec.statements(), wishes.select)
    except InvalidValueError as error:
        raise UsageError(error) from None
    low, high = _SCALES
    if not low <= wishes.timeout_scale <= high:
        raise UsageError(f"--timeout-scale {wishes.timeout_scale:g}: give {low:g} to {high:g}")
    if not 0 <= wishes.eeprom_writes <= _MOST_WRITES:
        raise UsageError(f"--eeprom-writes {wishes.eeprom_writes}: give 0 to {_MOST_WRITES}")
    limit = None
    if wishes.max_time is not None:
        with named(f"--max-time {wishes.max_time}"):
            limit = seconds(wishes.max_time)
    if wishes.baseline_update and wishes.baseline is None:
        raise UsageError("--baseline-update needs --baseline FILE")
    options = Options(
        allowed=_allowed(wishes),
        seed=wishes.seed,
        timeout_scale=wishes.timeout_scale,
        writes=wishes.eeprom_writes,
        seconds=limit,
        claims=_claims(wishes),
    )
    return Settings(ids, options, _reports(wishes.reports), _baseline(wishes))


def _claims(wishes: Wishes) -> Claims | None:
    """Return the statement of the module.

    Errors: `UsageError` for a file that is not a statement, and for a selected group without one; `OSError`.
    """
    if wishes.statement is None:
        if any(text.startswith("statement") for text in wishes.select):
            raise UsageError("statement: give --statement FILE, made by i7000 statement")
        return None
    with Path(wishes.statement).open("rb") as file:
        data = file.read(_LARGEST_BASELINE + 1)
    try:
        return Claims.from_json(data[:_LARGEST_BASELINE])
    except InvalidValueError as error:
        raise UsageError(f"{wishes.statement}: {error.reason}") from None


def allowed_of(texts: Iterable[str]) -> frozenset[Hazard]:
    """Return what the texts of --allow allow.

    Errors: `UsageError`.
    """
    hazards = []
    for text in texts:
        if text not in _ASKED_FOR:
            raise UsageError(f"--allow {text}: give {', '.join(_ASKED_FOR)}")
        hazards.append(_ASKED_FOR[text])
    return allowing(hazards)


def _allowed(wishes: Wishes) -> frozenset[Hazard]:
    allowed = allowed_of(wishes.allow)
    if Hazard.COMM in allowed and not wishes.can_power_cycle:
        raise UsageError("--allow comm can lose the module: add --i-can-power-cycle if you can switch its power")
    if Hazard.CALIBRATION in allowed and wishes.confirm is None:
        raise UsageError("--allow calibration can destroy the calibration: add --confirm NAME, the name of the module")
    return allowed


def _reports(texts: Iterable[str]) -> tuple[tuple[str, str], ...]:
    """Return the kinds and files of reports, which can be written: that is tried.

    Errors: `UsageError`; `OSError` for a file that cannot be written.
    """
    found = []
    for text in texts:
        kind, equals, file = text.partition("=")
        if kind not in KINDS or not equals or not file:
            raise UsageError(f"--report {text}: give KIND=FILE; kinds are {', '.join(KINDS)}")
        with Path(file).open("a", encoding="utf-8"):
            pass
        found.append((kind, file))
    return tuple(found)


# --- the baseline -----------------------------------------------------------------------------------------------------


def _baseline(wishes: Wishes) -> frozenset[str]:
    """Return the ids of the failures that are known.

    Errors: `UsageError` for a file that is not a baseline, `OSError` for one that cannot be read.
    """
    if wishes.baseline is None:
        return frozenset()
    file = Path(wishes.baseline)
    if wishes.baseline_update and not file.exists():
        with file.open("a", encoding="utf-8"):
            return frozenset()
    with file.open("rb") as opened:
        data = opened.read(_LARGEST_BASELINE + 1)
    if wishes.baseline_update and not data:
        return frozenset()
    try:
        document = json.loads(data) if len(data) <= _LARGEST_BASELINE else None
    except (ValueError, RecursionError):
        document = None
    document = document if isinstance(document, dict) and document.get("schema_version") == 1 else {}
    failures = document.get("failures")
    if not isinstance(failures, dict):
        raise UsageError(f"{file}: this is not a baseline: write one with --baseline-update")
    unknown = sorted(set(failures) - set(spec.statements()))
    if unknown:
        raise UsageError(f"{file}: there is no check {unknown[0]}")
    return frozenset(failures)


FAILURES = frozenset({Verdict.FAIL, Verdict.FLAKY, Verdict.PASS_GOOD_ONLY, Verdict.WARN})


def write_baseline(path: str, results: Iterable[CheckResult]) -> None:
    """Write the failures of a run to a file, as those that are known."""
    failures = {it.id: it.verdict.value for it in results if it.verdict in FAILURES}
    text = json.dumps({"schema_version": 1, "failures": dict(sorted(failures.items()))}, indent=2)
    Path(path).write_text(text + "\n", encoding="ascii")
