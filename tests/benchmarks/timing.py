"""How speeds are compared: contestants take turns in one process, the best turn of each counts."""

import gc
import time
from collections import Counter
from collections.abc import Callable, Iterable
from math import isnan, nan

from attrs import frozen

Task = Callable[[], object]


NO_TARGET = "-"


@frozen
class Result:
    """One comparison: how often the first does its task in the time the second does its own once."""

    what: str
    ratio: float
    """Not a number if nothing could be compared."""
    target: str
    """`NO_TARGET` for a figure that is only shown."""
    met: bool

    @property
    def verdict(self) -> str:
        """What came of it, in a word or two."""
        if isnan(self.ratio):
            return "not compared"
        if self.target == NO_TARGET:
            return "shown"
        return "ok" if self.met else "MISSED"

    def __str__(self) -> str:
        ratio = "" if isnan(self.ratio) else f"{self.ratio:.2f}"
        return f"{self.verdict:12} {ratio:>8}  {self.target:>8}  {self.what}"


def not_compared(what: str) -> Result:
    """What could not be measured here."""
    return Result(what, nan, NO_TARGET, met=False)


def shown(what: str, figure: float) -> Result:
    """A figure without a target."""
    return Result(what, figure, NO_TARGET, met=True)


def summary(verdicts: Iterable[str]) -> str:
    """Count the verdicts, best first."""
    counts = Counter(verdicts)
    return ", ".join(f"{counts[verdict]} {verdict}" for verdict in ("ok", "MISSED", "not compared", "shown"))


def best_times(tasks: dict[str, Task], *, turns: int = 25, seconds: float = 0.02) -> dict[str, float]:
    """Seconds of one call of each task: the best of many short turns, taken by turns."""
    loops = {}
    for name, task in tasks.items():
        task()
        start, calls = time.perf_counter(), 0
        while time.perf_counter() - start < seconds:
            task()
            calls += 1
        loops[name] = calls
    best = dict.fromkeys(tasks, float("inf"))
    gc.disable()
    try:
        for _ in range(turns):
            for name, task in tasks.items():
                repeat = range(loops[name])
                start = time.perf_counter()
                for _ in repeat:
                    task()
                best[name] = min(best[name], (time.perf_counter() - start) / loops[name])
    finally:
        gc.enable()
    return best


def at_least(what: str, ours: float, theirs: float, target: float) -> Result:
    """Ours must reach `target` times the speed of theirs (both are seconds a call)."""
    ratio = theirs / ours
    return Result(what, ratio, f">= {target}", ratio >= target)


def at_most(what: str, ours: float, theirs: float, target: float) -> Result:
    """Ours may cost `target` times as much as theirs."""
    ratio = ours / theirs
    return Result(what, ratio, f"<= {target}", ratio <= target)
