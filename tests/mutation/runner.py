"""Running mutants: which, in which order, and what becomes of each."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING

from tests.mutation.cells import cell_mutants
from tests.mutation.code import code_mutants, is_different
from tests.mutation.covering import Row, Stage, row_of
from tests.mutation.results import Result

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from pathlib import Path

    from tests.mutation.mutant import Mutant
    from tests.mutation.scratch import Scratch

AT_LEAST = 20.0
"""Seconds that a stage may take, whatever it takes without a mutant."""

SLOWER = 10
"""How many times longer than without a mutant a stage may take."""


class BrokenTestsError(Exception):
    """The tests fail without any mutant."""


def files(root: Path) -> list[str]:
    """Return every file that has mutants, in order."""
    found = [*(root / "src").rglob("*.py"), *(root / "spec").rglob("*.json")]
    return sorted(name for path in found if row_of(name := path.relative_to(root).as_posix()))


def chosen(names: Iterable[str], only: Sequence[str]) -> list[str]:
    """Return the files that one of the words in `only` asks for: a target, the start of a path, or nothing for all."""
    return [name for name in names if not only or any(_is_meant(name, word) for word in only)]


def _is_meant(name: str, word: str) -> bool:
    row = row_of(name)
    return row is not None and (row.target == word or f"{name}/".startswith(f"{word.rstrip('/')}/"))


def mutants_of(file: str, text: str) -> Sequence[Mutant]:
    """Return every mutant of one file."""
    return cell_mutants(file, text) if file.endswith(".json") else code_mutants(file, text)


def is_mutant(mutant: Mutant) -> bool:
    """Return whether a change makes another program, or other data."""
    return is_different(mutant) if mutant.file.endswith(".py") else mutant.after != mutant.before


def sampled(mutants: Sequence[Mutant], seed: int, sample: int | None) -> Iterator[Mutant]:
    """Yield `sample` mutants drawn by `seed`, or all of them in order."""
    order = list(mutants)
    if sample is not None:
        random.Random(seed).shuffle(order)
    left = len(order) if sample is None else sample
    for mutant in order:
        if not left:
            return
        if is_mutant(mutant):
            left -= 1
            yield mutant


class Runner:
    """Runs mutants in a scratch copy."""

    def __init__(self, scratch: Scratch, timeout: float, most: int | None = None) -> None:
        self._scratch, self._timeout, self._most = scratch, timeout, most
        self._usual: dict[Stage, float] = {}

    def usual(self, stage: Stage) -> float:
        """Return the seconds that a stage takes without a mutant; it has to pass."""
        if stage not in self._usual:
            run = self._scratch.run(stage, self._timeout)
            if run.outcome != "passed":
                raise BrokenTestsError(f"{' '.join(stage)}: {run.outcome} without a mutant\n{run.output}")
            self._usual[stage] = run.seconds
        return self._usual[stage]

    def _stages(self, row: Row) -> list[Stage]:
        return [stage for stage in row.stages if self._scratch.tests(stage)][: self._most]

    def stages(self, row: Row) -> int:
        """Return how many stages a mutant that survives goes through."""
        return len(self._stages(row))

    def run(self, mutant: Mutant, row: Row) -> Result:
        """Run the stages of a row on a mutant, at most `most`, until one notices it."""
        spent = 0.0
        for number, stage in enumerate(self._stages(row), 1):
            allowed = min(self._timeout - spent, AT_LEAST + SLOWER * self.usual(stage))
            with self._scratch.changed(mutant.file, mutant.after):
                run = self._scratch.run(stage, allowed)
            spent += run.seconds
            if run.outcome != "passed":
                return Result("killed" if run.outcome == "failed" else "timeout", number, round(spent, 2))
        return Result("survived", self.stages(row), round(spent, 2))
