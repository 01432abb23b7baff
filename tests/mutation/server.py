"""Run pytest again and again, each time in a fork of one process that has imported what all of them need.

``python -m tests.mutation.server`` reads a JSON line for each run from its input, ``{"tests", "timeout", "output"}``,
and answers with one, ``{"outcome"}``: ``passed``, ``failed`` or ``timeout``. What pytest prints goes to the file
``output``.

Laws: nothing of the package under test is imported before the fork, so each run has the sources as they are then. A run
ends within its time, and so does what it has started in its process group.
"""

from __future__ import annotations

import contextlib
import json
import os
import resource
import signal
import sys
import time
from typing import NoReturn

import attrs  # noqa: F401 - these six are what takes long to import
import cyclopts  # noqa: F401
import hypothesis.stateful  # noqa: F401
import jsonschema  # noqa: F401
import pytest
import rich.console  # noqa: F401

BYTES = 4 << 30
"""A mutant may ask for any amount of memory; the machine is not to swap for it."""

GLANCE = 0.01
"""Seconds between two looks at whether a run has ended."""

OPTIONS = (
    "-x", "--quiet", "--no-header", "--tb=short", "--hypothesis-profile=mutation", "-p", "no:cacheprovider",
    "-p", "no:xdist", "-W", "ignore::pytest.PytestAssertRewriteWarning",
)  # fmt: skip


def run(tests: list[str], timeout: float, output: str) -> str:
    """Run tests up to the first failure in a fork, and return the outcome."""
    child = os.fork()
    if not child:
        _run_here(tests, output)
    deadline = time.monotonic() + timeout
    status = None
    while status is None and time.monotonic() < deadline:
        time.sleep(GLANCE)
        ended, code = os.waitpid(child, os.WNOHANG)
        status = code if ended else None
    with contextlib.suppress(ProcessLookupError):
        os.killpg(child, signal.SIGKILL)
    if status is None:
        os.waitpid(child, 0)
        return "timeout"
    return "failed" if status else "passed"


def _run_here(tests: list[str], output: str) -> NoReturn:
    code = 3
    try:
        os.setsid()
        resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
        file = os.open(output, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
        null = os.open(os.devnull, os.O_RDONLY)
        for target, source in ((0, null), (1, file), (2, file)):
            os.dup2(source, target)
        code = int(pytest.main([*OPTIONS, *tests]))
        sys.stdout.flush()
    finally:
        os._exit(code)


if __name__ == "__main__":
    for line in sys.stdin:
        sys.stdout.write(json.dumps({"outcome": run(**json.loads(line))}) + "\n")
        sys.stdout.flush()
