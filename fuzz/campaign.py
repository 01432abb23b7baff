"""Fuzz the targets one after the other, and keep the ledger: ``python -m fuzz.campaign --minutes N``.

New inputs go to ``fuzz/corpus``, inputs that fail to ``fuzz/crashes``; neither is in the repository. A line for each
run goes to ``fuzz/ledger.jsonl``, which is.
"""

import argparse
import json
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from datetime import UTC, datetime
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

from fuzz.engine import INSTALL
from fuzz.seeds import write
from fuzz.targets import FOLDER, TARGETS

__all__ = ["Run", "executions", "fuzz", "main", "totals"]

LEDGER = FOLDER / "ledger.jsonl"
SECONDS_FOR_ONE = 10
"""Seconds after which an input counts as one that never ends."""
MEGABYTES = 1024
"""The memory that a target may use."""
_TO_END = 60
"""Seconds that a fuzzer has to end after its time."""
_LAST_LINES = 40


class Run(NamedTuple):
    """One run of a target."""

    target: str
    executions: int
    seconds: float
    crashes: tuple[str, ...]
    """The names of the inputs that failed."""
    output: str = ""
    """What the fuzzer printed last, if it did not end as it should."""


def executions(output: str) -> int:
    """Return how many inputs a fuzzer has run, as it printed that; 0 if it did not come so far."""
    final = re.findall(r"^stat::number_of_executed_units:\s*(\d+)", output, re.MULTILINE)
    return int((final or re.findall(r"^#(\d+)\s", output, re.MULTILINE) or ["0"])[-1])


def fuzz(target: str, seconds: int, most: int | None) -> Run:
    """Fuzz a target with libFuzzer for some seconds, or until so many executions."""
    corpus, crashes = FOLDER / "corpus" / target, FOLDER / "crashes" / target
    for folder in (corpus, crashes):
        folder.mkdir(parents=True, exist_ok=True)
    before = set(crashes.iterdir())
    began = time.monotonic()
    with tempfile.TemporaryDirectory() as temporary:
        folder, log = Path(temporary, "seeds"), Path(temporary, "log")
        write(target, folder)
        with log.open("wb") as file:
            command = _command(target, seconds, most, [corpus, folder, FOLDER / "regressions" / target], crashes)
            code = _code_of(command, file.fileno(), seconds + _TO_END)
        output = log.read_text(encoding="utf-8", errors="replace")
    failed = tuple(sorted(path.name for path in set(crashes.iterdir()) - before))
    last = "" if code == 0 else "\n".join(output.splitlines()[-_LAST_LINES:])
    return Run(target, executions(output), time.monotonic() - began, failed or ("",) * bool(code), last)


def _command(target: str, seconds: int, most: int | None, folders: list[Path], crashes: Path) -> list[str]:
    return [
        sys.executable,
        "-m",
        f"fuzz.fuzzers.{target}_fuzzer",
        *(str(folder) for folder in folders if folder.is_dir()),
        f"-dict={FOLDER / 'dictionaries' / TARGETS[target].dictionary}.dict",
        f"-max_len={TARGETS[target].longest}",
        f"-max_total_time={seconds}",
        *([f"-runs={most}"] if most else []),
        f"-timeout={SECONDS_FOR_ONE}",
        f"-rss_limit_mb={MEGABYTES}",
        f"-artifact_prefix={crashes}/",
        "-print_final_stats=1",
        "-verbosity=1",
    ]


def _code_of(command: list[str], output: int, seconds: int) -> int:
    try:
        done = subprocess.run(  # noqa: S603
            command, cwd=FOLDER.parent, check=False, stdin=subprocess.DEVNULL, stdout=output, stderr=output,
            timeout=seconds,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return 1
    return done.returncode


def _commit() -> str:
    """Return the commit of the checkout, with ``-dirty`` if files differ from it."""
    git = ["git", "describe", "--always", "--dirty", "--abbrev=12", "--exclude=*"]
    done = subprocess.run(git, cwd=FOLDER, check=False, capture_output=True, text=True)  # noqa: S603
    return done.stdout.strip() or "unknown"


def _entry(run: Run, commit: str) -> str:
    return json.dumps(
        {
            "target": run.target,
            "executions": run.executions,
            "seconds": round(run.seconds),
            "commit": commit,
            "date": datetime.now(UTC).isoformat(timespec="seconds"),
            "crashes": len(run.crashes),
        }
    )


def totals(ledger: Path) -> dict[str, int]:
    """Return the executions of each target in a ledger."""
    found = dict.fromkeys(TARGETS, 0)
    for entry in map(json.loads, ledger.read_text(encoding="utf-8").splitlines() if ledger.exists() else ()):
        found[entry["target"]] = found.get(entry["target"], 0) + entry["executions"]
    return found


def _shares(minutes: float, names: Sequence[str]) -> Iterator[tuple[str, int]]:
    """Yield each target with its seconds; all have the same time."""
    for name in names:
        yield name, max(1, round(minutes * 60 / len(names)))


def main(
    arguments: Sequence[str], *, engine: Callable[[str, int, int | None], Run] = fuzz, ledger: Path = LEDGER
) -> int:
    """Run a campaign; return 1 if an input failed, 2 if there is no engine or an option is wrong."""
    parser = argparse.ArgumentParser("python -m fuzz.campaign", description="Fuzz the targets, and keep the ledger.")
    parser.add_argument("--minutes", type=float, required=True, help="Minutes in all, shared by the targets.")
    parser.add_argument("--target", action="append", choices=list(TARGETS), help="A target; all without this option.")
    parser.add_argument("--executions", type=int, help="Stop a target after so many executions.")
    chosen = parser.parse_args(arguments)
    if not 0 < chosen.minutes <= 60 * 24 * 30:
        parser.error("--minutes must be more than 0, and 30 days at most")
    if chosen.executions is not None and chosen.executions < 1:
        parser.error("--executions must be 1 or more")
    if engine is fuzz and find_spec("atheris") is None:
        print(INSTALL, file=sys.stderr)  # noqa: T201
        return 2
    failed = False
    commit = _commit()
    for target, seconds in _shares(chosen.minutes, chosen.target or list(TARGETS)):
        run = engine(target, seconds, chosen.executions)
        with ledger.open("a", encoding="utf-8") as file:
            file.write(_entry(run, commit) + "\n")
        print(f"{target}: {run.executions:,} executions in {run.seconds:.0f} s", flush=True)  # noqa: T201
        if run.crashes:
            failed = True
            named = ", ".join(name or "the fuzzer itself" for name in run.crashes)
            print(f"{run.output}\n{target}: failed: {named}; see fuzz/crashes/{target}", flush=True)  # noqa: T201
    for target, count in totals(ledger).items():
        print(f"{target}: {count:,} executions in the ledger")  # noqa: T201
    return int(failed)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
