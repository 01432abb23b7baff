"""What is known from earlier runs: a file of JSON lines, one a mutant, from which a run that was stopped goes on.

Laws: a mutant that was noticed stays noticed for as long as its file is the same; one that was not is tried again as
soon as any test is another. The file is only ever appended to, so that a run may be stopped at any time.
"""

from __future__ import annotations

import hashlib
import json
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from pathlib import Path

    from tests.mutation.mutant import Mutant


class Result(NamedTuple):
    """What became of a mutant: ``killed``, ``timeout`` or ``survived``, after how many stages."""

    outcome: str
    stages: int
    seconds: float


class Results:
    """The results in a file, and those that are added to it."""

    def __init__(self, path: Path, tests: str) -> None:
        self._path, self._tests = path, tests
        self._known: dict[str, Result] = {}
        if path.exists():
            for line in path.read_text(encoding="utf-8").splitlines():
                self._take(line)

    def _take(self, line: str) -> None:
        try:
            record = json.loads(line)
        except json.JSONDecodeError:  # the last line of a run that was killed
            return
        if record["outcome"] != "survived" or record["tests"] == self._tests:
            self._known[record["key"]] = Result(record["outcome"], record["stages"], record["seconds"])

    def find(self, mutant: Mutant, stages: int) -> Result | None:
        """Return what is known of a mutant after so many stages at least, if it survived them."""
        found = self._known.get(mutant.key)
        return None if found and found.outcome == "survived" and found.stages < stages else found

    def add(self, mutant: Mutant, result: Result) -> None:
        """Keep a result."""
        self._known[mutant.key] = result
        record = {"key": mutant.key, "file": mutant.file, "line": mutant.line, "tests": self._tests}
        self._path.parent.mkdir(parents=True, exist_ok=True)
        with self._path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(record | result._asdict()) + "\n")


def digest_of_tests(folder: Path) -> str:
    """Return a digest of every test below a folder, but not of this package."""
    digest = hashlib.sha256()
    for path in sorted(folder.rglob("*.py")):
        if "mutation" not in path.relative_to(folder).parts:
            digest.update(path.relative_to(folder).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:20]
