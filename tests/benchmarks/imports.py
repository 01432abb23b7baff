"""What imports cost, as ratios: ours to that of attrs, and what i7000 adds to an import of Hypothesis."""

import os
import subprocess
import sys
from collections.abc import Iterator
from statistics import median

from tests.benchmarks.timing import Result, at_most

TURNS = 25
MOST_ABOVE_ATTRS = 0.5
MOST_ADDED_TO_HYPOTHESIS = 0.12
"""Of an import of Hypothesis, which takes 330 ms where this is 40."""


def import_seconds(first: str, then: str, **variables: str) -> tuple[float, float]:
    """Seconds of the processor that one module takes in a fresh interpreter, and another after it."""
    script = (
        f"from time import process_time; start = process_time(); import {first}; middle = process_time(); "
        f"import {then}; print(middle - start, process_time() - middle)"
    )
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"} | variables
    command = [sys.executable, "-c", script]
    run = subprocess.run(command, check=True, capture_output=True, text=True, env=environment)  # noqa: S603 - our own
    seconds = run.stdout.split()
    return float(seconds[0]), float(seconds[1])


def import_results() -> Iterator[Result]:
    """Import the public modules after attrs, and Hypothesis with and without what i7000 gives it."""
    modules = ("i7000", "i7000.dcon", "i7000.modbus")
    ratios: dict[str, list[float]] = {module: [] for module in modules}
    plain, with_ours = [], []
    for turn in range(TURNS + 1):
        for module in modules:
            attrs, ours = import_seconds("attrs", module)
            ratios[module] += [ours / attrs] if turn else []  # the first turn may compile
        plain.append(import_seconds("hypothesis", "sys", HYPOTHESIS_NO_PLUGINS="1")[0])
        with_ours.append(import_seconds("hypothesis", "sys")[0])
    for module in modules:
        yield at_most(f"import {module} after attrs, of import attrs", median(ratios[module]), 1, MOST_ABOVE_ATTRS)
    added = min(with_ours) - min(plain)
    yield at_most("i7000 within import hypothesis, of the rest", added, min(plain), MOST_ADDED_TO_HYPOTHESIS)
