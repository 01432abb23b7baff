"""``i7000 statement``: what a module has, for programs."""

from typing import TYPE_CHECKING

from i7000.cli.asked import DEFAULT_ONE, OneModule, asked_of
from i7000.cli.options import UNKNOWN, Module
from i7000.cli.port import DEFAULT_ASKING, DEFAULT_LINE, AskOptions, LineOptions, Target
from i7000.cli.text import Printer
from i7000.cli.words import LineError

if TYPE_CHECKING:
    from i7000.cli.reached import OpenLine

__all__ = ["statement"]


def statement(
    target: Target,
    /,
    *,
    line: LineOptions = DEFAULT_LINE,
    asking: AskOptions = DEFAULT_ASKING,
    one: OneModule = DEFAULT_ONE,
    module: Module = UNKNOWN,
) -> int:
    """Write a statement of what a module has: commands, functions, registers, types, and its reading of open points.

    Everything that the manual gives to any model is tried; nothing is changed. Keep the statement with
    the firmware: `i7000 check TARGET --statement FILE` compares the module with it, both ways, and checks what it
    claims. A module of no known model is read as the nearest one: give that with `--model`. A statement is JSON on
    standard output.

    JSON keys: `schema_version`, `model`, `firmware`, `name`, `protocol`; `commands` (sections of the manual),
    `functions`, `registers` (numbers of the manual), `types` (of each channel) and `readings` (of open points, by the
    id of the check).

    Example: `i7000 statement /dev/ttyUSB0 --address 2 > module.json`

    Exit code: 0 if it was written, 2 for wrong usage, 3 if the port cannot be opened or is lost or the module does not
    answer, 130 after Ctrl-C.
    """
    from i7000.cli.reached import reach  # noqa: PLC0415 - it takes time
    from i7000.cli.reached import run as at_port  # noqa: PLC0415 - it takes time
    from i7000.conformance import DEFAULT_ALLOWED  # noqa: PLC0415 - it takes time
    from i7000.conformance.state import stated  # noqa: PLC0415 - it takes time
    from i7000.host.procedures import snapshot  # noqa: PLC0415 - it takes time
    from i7000.link.guarded import GuardedPort  # noqa: PLC0415 - it takes time
    from i7000.spec import statements  # noqa: PLC0415 - it takes time

    printer = Printer()
    asked = asked_of(target, line, asking, one, module)

    def body(open_line: "OpenLine") -> int:
        there = reach(open_line, asked, printer.note, nearest=True)
        taken = open_line.run(snapshot(there.address, there.profile, there.protocol))
        if not taken.settings:
            raise LineError(f"{there.words} stopped answering: nothing was written")
        procedure = stated(taken, statements().values(), open_line.line.line, checksum=there.profile.checksum)
        printer.write(open_line.run(procedure).to_json().removesuffix("\n"))
        printer.flush()
        return 0

    return at_port(asked, body, guard=lambda port: GuardedPort(port, DEFAULT_ALLOWED))
