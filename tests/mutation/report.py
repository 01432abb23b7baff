"""The report of a run, as text and as JSON."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any, NamedTuple

from tests.mutation.covering import GOALS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tests.mutation.mutant import Mutant

SHOWN = 400
"""Characters of a changed line in the text; a row of ``spec/`` may have thousands."""


class Judged(NamedTuple):
    """A mutant and what became of it: ``killed``, ``timeout``, ``survived``, or ``equivalent`` with a reason."""

    target: str
    mutant: Mutant
    outcome: str
    reason: str = ""


class Score(NamedTuple):
    """How many mutants of a target there were, and what became of them."""

    target: str
    killed: int
    timeouts: int
    survived: int
    equivalent: int

    @property
    def rate(self) -> float:
        """The part of the mutants that are not equivalent that was noticed."""
        counted = self.killed + self.timeouts + self.survived
        return 1.0 if not counted else (self.killed + self.timeouts) / counted

    @property
    def is_met(self) -> bool:
        """Whether the target's goal is reached."""
        return self.rate >= GOALS[self.target]


def scores(judged: Sequence[Judged]) -> list[Score]:
    """Return the score of every target that has a mutant here."""
    counted = Counter((found.target, found.outcome) for found in judged)
    outcomes = ("killed", "timeout", "survived", "equivalent")
    targets = dict.fromkeys(found.target for found in judged)
    return [Score(target, *(counted[target, outcome] for outcome in outcomes)) for target in targets]


def as_text(judged: Sequence[Judged], *, is_complete: bool) -> str:
    """Return a table of the targets, then every survivor with its change."""
    lines = [
        f"{'target':10} {'mutants':>8} {'killed':>8} {'timeout':>8} {'survived':>8} {'equiv.':>8} {'noticed':>8}  goal"
    ]
    for score in scores(judged):
        total = score.killed + score.timeouts + score.survived + score.equivalent
        columns = (total, score.killed, score.timeouts, score.survived, score.equivalent)
        goal = f"{GOALS[score.target]:.0%} {'met' if score.is_met else 'MISSED'}"
        lines.append(f"{score.target:10} {' '.join(f'{column:8}' for column in columns)} {score.rate:8.1%}  {goal}")
    for found in judged:
        if found.outcome == "survived":
            lines += ["", *described(found.mutant)]
    if not is_complete:
        lines += ["", "INCOMPLETE: the run was stopped"]
    return "\n".join(lines) + "\n"


def described(mutant: Mutant) -> list[str]:
    """Return the place of a mutant and its changed lines, cut around the change where they are long."""
    shown = [f"{mutant.file}:{mutant.line}"]
    same = _first_difference(mutant.changes)
    for change in mutant.changes:
        cut = max(0, same - SHOWN // 2)
        shown.append(f"  {change[0]}{'...' if cut else ''}{change[1:][cut : cut + SHOWN]}")
    return shown


def _first_difference(changes: Sequence[str]) -> int:
    bodies = [change[1:] for change in changes]
    return next((at for at, characters in enumerate(zip(*bodies, strict=False)) if len(set(characters)) > 1), 0)


def as_json(judged: Sequence[Judged], run: dict[str, Any], *, is_complete: bool) -> dict[str, Any]:
    """Return the same as a value of JSON, with the equivalent mutants and their reasons."""
    return {
        "run": run,
        "complete": is_complete,
        "targets": [
            score._asdict() | {"noticed": score.rate, "goal": GOALS[score.target], "met": score.is_met}
            for score in scores(judged)
        ],
        "survivors": [_record(found) for found in judged if found.outcome == "survived"],
        "equivalent": [_record(found) | {"reason": found.reason} for found in judged if found.reason],
    }


def _record(found: Judged) -> dict[str, Any]:
    mutant = found.mutant
    return {"target": found.target, "file": mutant.file, "line": mutant.line, "diff": list(mutant.changes)}
