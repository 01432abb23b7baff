"""The baseline of a run: a file with the failures that are known, which do not count.

Laws: a check that fails worse than the baseline says is not known. An update keeps what the run did not decide.
"""

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from types import MappingProxyType

from i7000 import spec
from i7000.cli.words import UsageError, near
from i7000.conformance.run import CheckResult
from i7000.conformance.verdict import Verdict

__all__ = ["FAILURES", "known_failures", "read_baseline", "write_baseline"]

_LARGEST = 1 << 20
SCHEMA_VERSION = 1
"""The version of the format. It changes when a reader of the old one would misread the new one."""
_RANKS = {Verdict.WARN: 1, Verdict.PASS_GOOD_ONLY: 1, Verdict.FLAKY: 2, Verdict.FAIL: 3}
FAILURES = frozenset(_RANKS)
"""The verdicts that a baseline can have."""
_BY_NAME = {verdict.value: verdict for verdict in FAILURES}
_UNDECIDED = frozenset({Verdict.SKIP, Verdict.INCONCLUSIVE, Verdict.ERROR})


def read_baseline(path: str, *, update: bool) -> Mapping[str, Verdict]:
    """Return the failures that are known.

    Shape: with `update`, a file that does not exist, or is empty, has none, and can be written: that is tried.
    Errors: `UsageError` for a file that is not a baseline, `OSError` for one that cannot be read.
    """
    file = Path(path)
    if update:
        with file.open("a", encoding="utf-8"):
            pass
    with file.open("rb") as opened:
        data = opened.read(_LARGEST + 1)
    if update and not data:
        return MappingProxyType({})
    failures = _failures(data)
    if failures is None:
        raise UsageError(f"{path}: this is not a baseline: write one with --baseline-update")
    known = spec.statements()
    for name in failures:
        if name not in known:
            raise UsageError(f"{path}: there is no check {name}{near(name, known)}")
    return MappingProxyType({name: _BY_NAME[verdict] for name, verdict in failures.items()})


def _failures(data: bytes) -> dict[str, str] | None:
    if len(data) > _LARGEST:
        return None
    try:
        document = json.loads(data)
    except (ValueError, RecursionError):
        return None
    if not isinstance(document, dict) or document.get("schema_version") != SCHEMA_VERSION:
        return None
    failures = document.get("failures")
    if not isinstance(failures, dict) or not all(isinstance(it, str) and it in _BY_NAME for it in failures.values()):
        return None
    return failures


def known_failures(results: Iterable[CheckResult], baseline: Mapping[str, Verdict]) -> frozenset[str]:
    """Return the ids of the checks that fail as the baseline says, and no worse."""
    return frozenset(
        it.id
        for it in results
        if it.verdict in _RANKS and it.id in baseline and _RANKS[it.verdict] <= _RANKS[baseline[it.id]]
    )


def write_baseline(path: str, results: Iterable[CheckResult], baseline: Mapping[str, Verdict]) -> None:
    """Write the failures of a run to a file, with those of the baseline that the run did not decide.

    Errors: `OSError`.
    """
    found = dict(baseline)
    for result in results:
        if result.verdict in FAILURES:
            found[result.id] = result.verdict
        elif result.verdict not in _UNDECIDED:
            found.pop(result.id, None)
    failures = {name: found[name].value for name in sorted(found)}
    text = json.dumps({"schema_version": SCHEMA_VERSION, "failures": failures}, indent=2)
    Path(path).write_text(text + "\n", encoding="ascii")
