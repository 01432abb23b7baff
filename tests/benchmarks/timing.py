"""How speeds are compared: contestants take turns in one process, the best turn of each counts."""

import gc
import time
from collections.abc import Callable

from attrs import frozen

Task = Callable[[], object]


@frozen
class Result:
    """One comparison: how often the first does its task in the time the second does its own once."""

    what: str
    ratio: float
    target: str
    met: bool

    def __str__(self) -> str:
        return f"{'ok  ' if self.met else 'MISS'} {self.ratio:8.2f}  {self.target:>8}  {self.what}"


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
