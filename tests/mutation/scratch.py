"""A copy of the checkout in which mutants live, and the tests that run there."""

from __future__ import annotations

import compileall
import contextlib
import json
import os
import py_compile
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from tests.mutation.covering import Stage

ROOT = Path(__file__).parents[2]
ENDS = 40
"""Lines of a failing run that are kept."""


class Run(NamedTuple):
    """What became of one run of pytest: ``passed``, ``failed`` or ``timeout``."""

    outcome: str
    seconds: float
    output: str


def files_of_git(root: Path = ROOT) -> list[str]:
    """Return the files that git knows or could add, as they are now."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],  # noqa: S607
        cwd=root, check=True, capture_output=True,
    ).stdout.decode()  # fmt: skip
    return [name for name in listed.split("\0") if (root / name).is_file()]


class Scratch:
    """A copy of the files `names` below `folder`. Nothing is ever written outside it."""

    def __init__(self, folder: Path, root: Path, names: Iterable[str]) -> None:
        self.folder = folder
        for name in names:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(root / name, folder / name)
        # Compiled once, and checked by content: a mutant of the same size and second is never taken for the file.
        checked = py_compile.PycInvalidationMode.CHECKED_HASH
        compileall.compile_dir(folder / "src", quiet=1, invalidation_mode=checked)
        # Whoever writes bytecode later does it only for tests, which are never changed.
        self._server = subprocess.Popen(
            [sys.executable, "-m", "tests.mutation.server"],
            cwd=folder, env={**os.environ, "PYTHONPATH": str(folder / "src"), "CI": "1"}, text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE,
        )  # fmt: skip

    def text(self, file: str) -> str:
        """Return the text of a file of the copy."""
        return (self.folder / file).read_text(encoding="utf-8")

    @contextlib.contextmanager
    def changed(self, file: str, text: str) -> Iterator[None]:
        """Give a file another text, and its own again afterwards."""
        path = self.folder / file
        before = path.read_bytes()
        path.write_text(text, encoding="utf-8", newline="")
        try:
            yield
        finally:
            path.write_bytes(before)

    def tests(self, stage: Stage) -> list[str]:
        """Return the files and folders of tests that a stage names and the copy has, in the order of the stage."""
        found = [path for pattern in stage for path in sorted(self.folder.glob(pattern))]
        return list(dict.fromkeys(path.relative_to(self.folder).as_posix() for path in found))

    def run(self, stage: Stage, timeout: float) -> Run:
        """Run the tests of a stage up to the first failure."""
        log = self.folder / ".output"
        wanted = {"tests": self.tests(stage), "timeout": timeout, "output": str(log)}
        begun = time.monotonic()
        assert self._server.stdin
        assert self._server.stdout
        self._server.stdin.write(json.dumps(wanted) + "\n")
        self._server.stdin.flush()
        outcome = json.loads(self._server.stdout.readline())["outcome"]
        output = log.read_text(encoding="utf-8", errors="replace").splitlines()[-ENDS:]
        return Run(outcome, time.monotonic() - begun, "\n".join(output))

    def close(self) -> None:
        """End the process that runs the tests."""
        self._server.communicate()
