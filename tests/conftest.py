"""Fixtures, and how hard Hypothesis searches.

Profiles: `dev`; `ci` where ``CI`` is set; `fast` for ``python -m tests --fast``; `mutation` for mutants, whose failures
nobody reads; `fuzz`, asked for by name, for hours.
``I7000_EXAMPLES`` names a folder of examples that several machines share: see ``docs/fuzzing.md``.
"""

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, Phase, settings
from hypothesis.database import (
    DirectoryBasedExampleDatabase,
    ExampleDatabase,
    MultiplexedDatabase,
    ReadOnlyDatabase,
)

from tests.terminal import plain, run
from tests.workbench import answered, workbench

pytest_plugins = ["pytester"]

__all__ = ["answered", "examples", "plain", "run", "workbench"]


def examples(own: Path, shared: Path | None, *, write: bool = False) -> ExampleDatabase:
    """The examples of this machine, and those that machines share, which only some of them may write."""
    mine = DirectoryBasedExampleDatabase(own)
    if shared is None:
        return mine
    others = DirectoryBasedExampleDatabase(shared)
    return MultiplexedDatabase(mine, others if write else ReadOnlyDatabase(others))


OWN = Path(".hypothesis", "examples")
SHARED = Path(os.environ["I7000_EXAMPLES"]) if os.environ.get("I7000_EXAMPLES") else None

settings.register_profile(
    "dev",
    max_examples=60,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow],
    database=examples(OWN, SHARED),
)
settings.register_profile(
    "ci", settings.get_profile("dev"), max_examples=40, derandomize=True, print_blob=True, database=None
)
settings.register_profile("fast", settings.get_profile("ci"), max_examples=6)
settings.register_profile("mutation", settings.get_profile("ci"), phases=(Phase.explicit, Phase.generate))
settings.register_profile(
    "fuzz",
    settings.get_profile("dev"),
    max_examples=20_000,
    print_blob=True,
    database=examples(OWN, SHARED, write=True),
)
settings.load_profile("ci" if os.environ.get("CI") else "dev")

# A shell that runs the tests in the background ignores SIGINT, `nohup` ignores SIGHUP, and whatever the tests start
# would inherit that. A function is not inherited; with it the tests themselves go on when they are hung up.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
if signal.getsignal(signal.SIGHUP) is signal.SIG_IGN:
    signal.signal(signal.SIGHUP, lambda *_: None)


@pytest.fixture(autouse=True)
def ctrl_c() -> Iterator[None]:
    """Ctrl-C as it was, whatever a test has made of it: a program that has ended leaves it ignored."""
    before = signal.getsignal(signal.SIGINT)
    yield
    signal.signal(signal.SIGINT, before)
