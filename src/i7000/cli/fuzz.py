"""``i7000 fuzz``: near misses of reads to a module, until it does not answer as before."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from i7000.cli.asked import DEFAULT_ONE, OneModule, asked_of
from i7000.cli.options import UNKNOWN, Module
from i7000.cli.port import DEFAULT_ASKING, DEFAULT_LINE, AskOptions, LineOptions, Target
from i7000.cli.words import UsageError

__all__ = ["fuzz"]

_MOST_FRAMES = 10_000_000
_LONGEST = 7 * 86400.0


def fuzz(  # noqa: PLR0913 - each of them is an option
    target: Target,
    /,
    *,
    seed: Annotated[int, Parameter(help="Random seed of the frames; the same seed repeats the run.")] = 0,
    frames: Annotated[int, Parameter(help="Stop after so many frames.")] = 1000,
    max_time: Annotated[
        float | None, Parameter(help="Stop after so many seconds. Default: no limit. Example: --max-time 60.")
    ] = None,
    report: Annotated[
        Path | None, Parameter(help="Write the case that made the module fail to a new file, as JSON.")
    ] = None,
    line: LineOptions = DEFAULT_LINE,
    asking: AskOptions = DEFAULT_ASKING,
    one: OneModule = DEFAULT_ONE,
    module: Module = UNKNOWN,
) -> int:
    """Send frames that are nearly reads, and check that the module still answers.

    The command first identifies the module. Then it changes, cuts, joins and damages the frames that read, and sends
    them. A guard looks at the bytes of each frame: one that a firmware could take for a write, or for anything that
    changes a module, is left out. It is safe to use on a module in operation, but not on a line that others poll.

    At a real port, the command first prints how long it takes.

    After every 20 frames a legal read, the sentinel, must be answered as at the start. The first time that it is not,
    the run stops. With `sim:` and `exec:` the module is restarted then, and the frames are sent again with parts left
    out, until only those remain that are needed.

    All settings are read before and after the run. Each one that differs is reported.

    The case has the keys `record` (`fuzz-case`), `schema_version`, `target`, `address`, `protocol`, `profile`, `seed`,
    `outcome` (`silent` or `changed`), `sentinel` and `frames` (in hex), `text` (the frames for people), `reproduced`
    and `tries`.

    Example: `i7000 fuzz sim:M-7019R --seed 7 --frames 5000`

    Example: `i7000 fuzz exec:./firmware --report case.json`

    Exit code: 0 if the module answered to the end, 1 if it stopped answering, or had other settings until a restart;
    2 for wrong usage, 3 if the port cannot be opened or the module does not answer at the start; 5 if no frame was
    sent, 6 if its settings are not those of the start; 130 after Ctrl-C.
    """
    from i7000.cli.fuzzing import Plan, run  # noqa: PLC0415 - it takes time

    if not 1 <= frames <= _MOST_FRAMES:
        raise UsageError(f"--frames {frames}: give 1 to {_MOST_FRAMES}")
    if max_time is not None and not 0 < max_time <= _LONGEST:
        raise UsageError(f"--max-time {max_time:g}: give more than 0, at most {_LONGEST:.0f} seconds")
    if report is not None and (report.exists() or not report.parent.is_dir()):
        why = "the file exists; give the name of a new one" if report.exists() else f"no folder {report.parent}"
        raise UsageError(f"--report {report}: {why}")
    return run(Plan(asked_of(target, line, asking, one, module), seed, frames, max_time, report))
