"""``i7000 diff``: what differs between a module and a file, or between two files."""

from pathlib import Path
from typing import Annotated

from attrs import frozen
from cyclopts import Parameter

from i7000 import Model
from i7000.cli.asked import DEFAULT_ONE, OneModule, asked_of
from i7000.cli.options import UNKNOWN, Json, Module
from i7000.cli.port import DEFAULT_ASKING, DEFAULT_LINE, AskOptions, LineOptions
from i7000.cli.setting_text import change_record, change_table, names_words, unread_words
from i7000.cli.snapshot_file import read_snapshot
from i7000.cli.text import Printer
from i7000.cli.words import LineError
from i7000.host.procedures import Change, Snapshot
from i7000.host.procedures import diff as differences

__all__ = ["Compared", "compare", "diff"]


def diff(  # noqa: PLR0913 - each of them is an option
    target: Annotated[
        str,
        Parameter(
            help="The port of a module, such as /dev/ttyUSB0 or sim:M-7019R (see i7000 read --help), or a file of"
            " i7000 backup."
        ),
    ],
    file: Annotated[str, Parameter(help="A file of i7000 backup; - is standard input.", allow_leading_hyphen=True)],
    /,
    *,
    json: Json = False,
    line: LineOptions = DEFAULT_LINE,
    asking: AskOptions = DEFAULT_ASKING,
    one: OneModule = DEFAULT_ONE,
    module: Module = UNKNOWN,
) -> int:
    """Compare the settings of a module with a file, or two files with each other. Nothing is changed.

    A setting that only one of them has, because the other has another model, firmware or protocol, is reported and
    does not count as a difference. One that could not be read counts.

    JSON keys: `record` (`difference`), `name`, `module` and `file` (or `first` and `second` for two files), `hazard`
    (`plain` or `loses`).

    Example: `i7000 diff /dev/ttyUSB0 oven.json`

    Exit code: 0 if they are the same, 1 if something differs or could not be read, 2 for wrong usage, 3 if the port
    cannot be opened or the module does not answer, 130 after Ctrl-C.
    """
    printer = Printer(json=json)
    other = read_snapshot(file)
    if Path(target).is_file():
        return _report(compare(read_snapshot(target), other), other.model, ("first", "second"), printer)

    from i7000.cli.reached import OpenLine, reach, run  # noqa: PLC0415 - it takes time
    from i7000.host.procedures import snapshot  # noqa: PLC0415 - it takes time

    asked = asked_of(target, line, asking, one, module)

    def show(open_line: OpenLine) -> int:
        there = reach(open_line, asked, printer.note, other.model)
        taken = open_line.run(snapshot(there.address, there.profile, there.protocol))
        if not taken.settings:
            raise LineError(f"{there.words} stopped answering")
        return _report(compare(taken, other), taken.model, ("module", "file"), printer)

    return run(asked, show)


@frozen
class Compared:
    """What differs between two snapshots, and what cannot be compared."""

    changes: tuple[Change, ...]
    unread: tuple[tuple[str, str], ...]
    """Settings that could not be read, with the reasons."""
    alone: tuple[str, ...]
    """Settings that only one of them has."""
    notes: tuple[str, ...] = ()
    """What else differs."""
    of_other_models: bool = False


def compare(one: Snapshot, other: Snapshot) -> Compared:
    """Return what differs between two snapshots.

    >>> from i7000 import Model
    >>> one, other = (Snapshot(Model.I_7018, settings={"type_code": code}) for code in "JK")
    >>> [change.name for change in compare(one, other).changes]
    ['type_code']
    """
    unread = {**dict(other.unread), **dict(one.unread)}
    changes = differences(one, other)
    both = tuple(it for it in changes if it.before is not None and it.after is not None)
    single = [it.name for it in changes if it.before is None or it.after is None]
    about = (
        ("model", one.model.value, other.model.value),
        ("firmware", one.firmware or _UNKNOWN, other.firmware or _UNKNOWN),
    )
    return Compared(
        both,
        tuple(unread.items()),
        tuple(name for name in single if name not in unread),
        tuple(f"the {name} differs: {first} and {second}" for name, first, second in about if first != second),
        one.model is not other.model,
    )


_UNKNOWN = "unknown"


def _report(compared: Compared, model: Model, heads: tuple[str, str], printer: Printer) -> int:
    for note in compared.notes:
        printer.note(note)
    if printer.json:
        for change in compared.changes:
            printer.record(change_record(change, heads), ())
    elif compared.changes:
        printer.lines(change_table(compared.changes, model, heads))
    if compared.alone:
        printer.note(f"not compared, as only one of them has it: {names_words(compared.alone)}")
    for words in unread_words(compared.unread):
        printer.error(words)
    if compared.changes or compared.unread or compared.of_other_models:
        return 1
    printer.note("no differences in what both have" if compared.alone else "no differences")
    return 0
