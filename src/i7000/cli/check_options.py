"""The options of a run of checks, and what they mean.

Laws: everything that can be wrong with the options is said before the port is opened.
"""

from collections.abc import Iterable, Mapping
from pathlib import Path

from attrs import frozen

from i7000 import InvalidValueError, spec
from i7000.cli.baseline import read_baseline
from i7000.cli.durations import seconds
from i7000.cli.harm import HarmOptions
from i7000.cli.module import named
from i7000.cli.report_files import KINDS
from i7000.cli.words import UsageError
from i7000.conformance.claims import Claims
from i7000.conformance.run import Options, asked_for, selected
from i7000.conformance.verdict import Verdict

__all__ = ["Settings", "Wishes", "settings_of"]

_LARGEST_STATEMENT = 1 << 20
"""The bytes of the largest statement that is read."""


@frozen(kw_only=True)
class Wishes:
    """The options of a run."""

    select: tuple[str, ...]
    harm: HarmOptions
    strict: bool
    certify: bool
    baseline: str | None
    baseline_update: bool
    reports: tuple[str, ...]
    statement: str | None
    seed: int
    max_time: str | None
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
    wishes.harm.check()
    limit = None
    if wishes.max_time is not None:
        with named(f"--max-time {wishes.max_time}"):
            limit = seconds(wishes.max_time)
    if wishes.baseline_update and wishes.baseline is None:
        raise UsageError("--baseline-update needs --baseline FILE")
    options = Options(
        allowed=wishes.harm.allowed(),
        seed=wishes.seed,
        timeout_scale=wishes.harm.timeout_scale,
        writes=wishes.harm.eeprom_writes,
        seconds=limit,
        claims=_claims(wishes),
    )
    baseline: Mapping[str, Verdict] = {}
    if wishes.baseline is not None:
        baseline = read_baseline(wishes.baseline, update=wishes.baseline_update)
    return Settings(ids, asked, options, _reports(wishes.reports), baseline)


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
