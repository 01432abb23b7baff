"""Which mutants of the code and of ``spec/`` the tests notice: ``python -m tests.mutation``.

Exit codes: 0 every goal is met; 1 one is missed; 2 wrong usage; 3 the tests fail without a mutant; 5 there was no
mutant to run; 130 stopped by Ctrl-C.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from tests.mutation import equivalent, report
from tests.mutation.covering import GOALS, row_of
from tests.mutation.report import Judged
from tests.mutation.results import Results, digest_of_tests
from tests.mutation.runner import BrokenTestsError, Runner, chosen, files, mutants_of, sampled
from tests.mutation.scratch import ROOT, Scratch, files_of_git

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

RESULTS = ROOT / ".mutation" / "results.jsonl"


def arguments(words: Sequence[str]) -> argparse.Namespace:
    """Parse the command line."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutation", description=(__doc__ or "").splitlines()[0])
    parser.add_argument(
        "--only", action="append", default=[], metavar="PATH|TARGET",
        help=f"files below this path, or of this target ({', '.join(GOALS)}); may be given several times",
    )  # fmt: skip
    parser.add_argument("--sample", type=int, metavar="N", help="run N mutants drawn at random, not all")
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="random seed of the sample (0)")
    parser.add_argument(
        "--timeout", type=float, default=600, metavar="SECONDS", help="most time for all tests of a mutant (600)"
    )
    parser.add_argument(
        "--stages", type=int, metavar="N",
        help="run only the first N stages of tests; a mutant that they do not notice counts as a survivor (all)",
    )  # fmt: skip
    parser.add_argument(
        "--report", action="append", default=[], type=Path, metavar="FILE",
        help="write the report there too, as JSON where the name ends in .json; may be given several times",
    )  # fmt: skip
    parser.add_argument("--fresh", action="store_true", help="do not use the results of earlier runs")
    found = parser.parse_args(words)
    if found.sample is not None and found.sample < 1:
        parser.error(f"argument --sample: {found.sample} is less than 1")
    if found.stages is not None and found.stages < 1:
        parser.error(f"argument --stages: {found.stages} is less than 1")
    if found.timeout <= 0:
        parser.error(f"argument --timeout: {found.timeout:g} is not above 0")
    names = files(ROOT)
    for word in found.only:
        if not chosen(names, [word]):
            parser.error(f"argument --only: no file of {word!r} has mutants; the targets are {', '.join(GOALS)}")
    for path in found.report:
        if not path.parent.is_dir():
            parser.error(f"argument --report: there is no folder {path.parent}")
    found.names = chosen(names, found.only)
    return found


def run(options: argparse.Namespace, scratch: Scratch, results: Results) -> Iterator[Judged]:
    """Yield what becomes of each mutant that the options ask for."""
    runner = Runner(scratch, options.timeout, options.stages)
    entries = equivalent.read()
    all_of_them = [mutant for name in options.names for mutant in mutants_of(name, scratch.text(name))]
    say(f"{len(all_of_them)} mutants of {len(options.names)} files")
    for number, mutant in enumerate(sampled(all_of_them, options.seed, options.sample), 1):
        row = row_of(mutant.file)
        assert row is not None
        reason = equivalent.reason_of(mutant, entries)
        if reason:
            yield Judged(row.target, mutant, "equivalent", reason)
            continue
        result = None if options.fresh else results.find(mutant, runner.stages(row))
        if result is None:
            result = runner.run(mutant, row)
            results.add(mutant, result)
            say(f"{number} {result.outcome} {mutant.file}:{mutant.line} stage {result.stages}, {result.seconds:.1f} s")
        if result.outcome == "survived":
            say("\n".join(report.described(mutant)))
        yield Judged(row.target, mutant, result.outcome)


def say(text: str) -> None:
    """Print progress."""
    print(text, file=sys.stderr, flush=True)  # noqa: T201


def write(options: argparse.Namespace, judged: Sequence[Judged], *, is_complete: bool) -> None:
    """Print the report, and write the files that were asked for."""
    text = report.as_text(judged, is_complete=is_complete)
    sys.stdout.write(text)
    settings = {
        "only": options.only,
        "seed": options.seed,
        "sample": options.sample,
        "stages": options.stages,
        "timeout": options.timeout,
    }
    for path in options.report:
        if path.suffix == ".json":
            data = report.as_json(judged, settings, is_complete=is_complete)
            text_of_file = json.dumps(data, indent=2, ensure_ascii=False) + "\n"
        else:
            text_of_file = text
        path.write_text(text_of_file, encoding="utf-8")


def main(words: Sequence[str], results: Path = RESULTS) -> int:
    """Run the mutants that the words ask for, and return the exit code."""
    options = arguments(words)
    judged: list[Judged] = []
    try:
        with tempfile.TemporaryDirectory(prefix="i7000-mutation-") as folder:
            scratch = Scratch(Path(folder), ROOT, files_of_git())
            known = Results(results, digest_of_tests(scratch.folder / "tests"))
            with contextlib.closing(scratch):
                for found in run(options, scratch, known):
                    judged.append(found)  # noqa: PERF402 - what there is when it is stopped is reported
    except BrokenTestsError as error:
        say(str(error))
        return 3
    except KeyboardInterrupt:
        write(options, judged, is_complete=False)
        return 130
    write(options, judged, is_complete=True)
    if all(found.outcome == "equivalent" for found in judged):
        return 5
    return 0 if all(score.is_met for score in report.scores(judged)) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
