"""What importing costs above attrs alone, in fresh interpreters."""

import os
import subprocess
import sys
from collections.abc import Iterator

from tests.benchmarks.timing import Result

TURNS = 25


def import_seconds(module: str) -> float:
    """Seconds of the processor that importing a module takes after attrs: the best of several fresh interpreters."""
    script = f"import attrs, time; start = time.process_time(); import {module}; print(time.process_time() - start)"
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    command = [sys.executable, "-c", script]
    runs = [
        subprocess.run(command, check=True, capture_output=True, text=True, env=environment)  # noqa: S603 - our own script
        for _ in range(TURNS)
    ]
    return min(float(run.stdout) for run in runs)


def import_results() -> Iterator[Result]:
    """Import the public modules."""
    for module in ("i7000", "i7000.dcon", "i7000.modbus"):
        milliseconds = import_seconds(module) * 1000
        yield Result(f"import {module}, ms above attrs", milliseconds, "<= 20", milliseconds <= 20)
