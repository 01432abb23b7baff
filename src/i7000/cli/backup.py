"""``i7000 backup``: all settings of a module in a file."""

from typing import Annotated

from cyclopts import Parameter

from i7000.cli.asked import DEFAULT_ONE, OneModule, asked_of
from i7000.cli.options import UNKNOWN, Module
from i7000.cli.port import DEFAULT_ASKING, DEFAULT_LINE, AskOptions, LineOptions, Target
from i7000.cli.setting_text import unread_words
from i7000.cli.snapshot_file import check_new, write_new
from i7000.cli.text import Printer
from i7000.cli.words import LineError

__all__ = ["backup"]


def backup(  # noqa: PLR0913 - each of them is an option
    target: Target,
    file: Annotated[
        str, Parameter(help="The file to create, as JSON; - is standard output.", allow_leading_hyphen=True)
    ],
    /,
    *,
    line: LineOptions = DEFAULT_LINE,
    asking: AskOptions = DEFAULT_ASKING,
    one: OneModule = DEFAULT_ONE,
    module: Module = UNKNOWN,
) -> int:
    """Save all settings of a module to a file. Nothing is changed.

    The module is asked what it is first, so `--model` is not needed. Settings are read one by one; calibration is not
    a setting. What could not be read is reported, and noted in the file with its reason. An existing file is never
    overwritten. `i7000 diff` compares the file with a module, and `i7000 restore` writes it back.

    A module can have settings that only one protocol reads, such as the response delay: those of the protocol that it
    speaks are saved.

    Example: `i7000 backup /dev/ttyUSB0 oven.json`

    Example: `i7000 backup sim:M-7019R,type=K -`

    Exit code: 0 if everything was read, 1 if something could not be read, 2 for wrong usage, 3 if the port cannot be
    opened or the module does not answer, 130 after Ctrl-C.
    """
    from i7000.cli.reached import OpenLine, reach, run  # noqa: PLC0415 - it takes time
    from i7000.host.procedures import snapshot  # noqa: PLC0415 - it takes time

    printer = Printer()
    asked = asked_of(target, line, asking, one, module)
    if file != "-":
        check_new(file)

    def save(open_line: OpenLine) -> int:
        there = reach(open_line, asked, printer.note)
        taken = open_line.run(snapshot(there.address, there.profile, there.protocol))
        if not taken.settings:
            raise LineError(f"{there.words} stopped answering: nothing is saved")
        if file == "-":
            printer.write(taken.to_json().removesuffix("\n"))
            printer.flush()
        else:
            write_new(file, taken.to_json())
            printer.note(f"{file} has {len(taken.settings)} settings of {there.words}")
        for words in unread_words(taken.unread):
            printer.error(words)
        return 1 if taken.unread else 0

    return run(asked, save)
