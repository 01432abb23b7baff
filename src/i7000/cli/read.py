"""``i7000 read``: the readings of modules, once or steadily."""

from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from i7000.cli.durations import seconds
from i7000.cli.module import named
from i7000.cli.options import UNKNOWN, Module, Texts
from i7000.cli.port import DEFAULT_ASKING, DEFAULT_LINE, AskOptions, LineOptions, Target
from i7000.cli.text import Printer
from i7000.cli.wanted import ProtocolChoice, wanted
from i7000.cli.words import UsageError

if TYPE_CHECKING:
    from i7000.cli.reading import Output, Plan
    from i7000.cli.reading_text import Writer

__all__ = ["read"]

_SHORTEST_PERIOD = 0.05
_LONGEST_PERIOD = 86400.0


def read(  # noqa: PLR0913 - each of them is an option
    target: Target,
    /,
    *,
    address: Annotated[
        Texts, Parameter(help="Address of a module; repeat it for each. Default: 1. Example: --address 2.")
    ] = (),
    every: Annotated[
        str | None,
        Parameter(help="Read again and again: every 500ms, 1s, 2 (seconds), 1min or 1h. At least 50ms, at most 24h."),
    ] = None,
    count: Annotated[
        int | None, Parameter(help="With --every, stop after so many times; without it, at Ctrl-C.")
    ] = None,
    csv: Annotated[
        bool, Parameter(help="Print CSV: a line for each time, a column for each channel.", negative="")
    ] = False,
    json: Annotated[
        bool, Parameter(help="Print JSON, one object a line for each module and time.", negative="")
    ] = False,
    output: Annotated[Path | None, Parameter(help="Write to a new file in place of standard output.")] = None,
    protocol: Annotated[ProtocolChoice, Parameter(help="Protocol of the modules; auto asks them by both.")] = "auto",
    line: LineOptions = DEFAULT_LINE,
    asking: AskOptions = DEFAULT_ASKING,
    module: Module = UNKNOWN,
) -> int:
    """Read all channels of modules, once or with `--every` steadily.

    The command first identifies each module and reads its types and settings. Standard error gets a line with the model
    and the reasons. What you give with `--model` and other options replaces what the module says; a contradiction is
    reported. Modules of both protocols can share a line: `--model 1=M-7019R --model 2=I-7018`.

    With `--every`, a terminal shows a live view: values, their age, minimum and maximum, and counters of what happened
    on the line. Elsewhere there is a line for each module and time. A period that is over before the last reading ended
    is counted as missed; times do not drift. A module that does not answer is a line that says so. If the port is lost,
    it is opened again as soon as it is back.

    CSV has the time in UTC as ISO 8601 and the units in its first line. A cell without a number has the status:
    `over_range`, `under_range`, `disabled` or `not_understood`; it is empty if the module did not answer. All modules
    must answer the first time.

    JSON keys: `record` (`readings`), `time`, `address`, `model`, `protocol`, `answered`, `reason` (why there are no
    readings) and `channels`, each with `channel`, `value`, `unit`, `status` and `type`.

    Example: `i7000 read /dev/ttyUSB0 --every 10s --csv --output log.csv`

    Example: `i7000 read sim:M-7019R,type=K+I-7018 --address 1 --address 2`

    Exit code: 0 if everything was read, 1 if a module refused or sent what is not understood, 2 for wrong usage, 3 if
    the port cannot be opened or a module did not answer, 130 after Ctrl-C. With `--every`, what modules do does not
    matter.
    """
    from i7000.cli.reading import Counts, Plan, run  # noqa: PLC0415 - it takes time

    printer = Printer()
    if csv and json:
        raise UsageError("give --csv or --json, not both")
    plan = Plan(
        target,
        line.settings(),
        asking.policy(),
        asking.echo,
        wanted(address, module, protocol),
        _period(every),
        _checked_count(count, every),
    )
    with ExitStack() as stack:
        write = _writer(output, stack)
        outputs = [_form(write, printer, plan, csv=csv, json=json)]
        note: Callable[[str], None] = printer.note
        counts = Counts()
        if plan.every is not None and printer.out.is_terminal and (output or not (csv or json)):
            from i7000.cli.reading_view import LiveView  # noqa: PLC0415 - it takes time

            view = LiveView(printer.out, target, counts)
            stack.callback(view.end)
            outputs = [*(outputs if output else ()), view]
            note = view.note
        return run(plan, tuple(outputs), counts, note)


def _form(write: "Writer | None", printer: Printer, plan: "Plan", *, csv: bool, json: bool) -> "Output":
    from i7000.cli.reading_text import Csv, Json, Lines, Table, printed  # noqa: PLC0415 - it takes time

    if csv:
        return Csv(write or printed)
    if json:
        return Json(write or printed)
    return Table(write, printer) if plan.every is None else Lines(write or printed)


def _writer(path: Path | None, stack: ExitStack) -> "Writer | None":
    from i7000.cli.reading_text import file_writer, new_file  # noqa: PLC0415 - it takes time

    return None if path is None else file_writer(stack.enter_context(new_file(path)), path)


def _period(every: str | None) -> float | None:
    if every is None:
        return None
    with named(f"--every {every}"):
        period = seconds(every)
    if not _SHORTEST_PERIOD <= period <= _LONGEST_PERIOD:
        raise UsageError(f"--every {every}: give 50ms to 24h")
    return period


def _checked_count(count: int | None, every: str | None) -> int | None:
    if count is not None and every is None:
        raise UsageError("--count is for --every, such as --every 1s --count 10")
    if count is not None and count < 1:
        raise UsageError(f"--count {count}: give 1 or more")
    return count
