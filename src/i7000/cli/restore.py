"""``i7000 restore``: the settings of a file, written to a module."""

from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from i7000 import InvalidValueError
from i7000.cli.asked import DEFAULT_ONE, OneModule, Yes, asked_of
from i7000.cli.confirm import check_can_ask
from i7000.cli.options import UNKNOWN, Json, Module
from i7000.cli.port import DEFAULT_ASKING, DEFAULT_LINE, AskOptions, LineOptions, Target
from i7000.cli.setting_text import LOSES, change_table
from i7000.cli.snapshot_file import read_snapshot
from i7000.cli.text import Printer
from i7000.cli.words import LineError, UsageError
from i7000.host.procedures import Change, Hazard, Snapshot, hazard_of
from i7000.host.procedures import diff as differences
from i7000.host.procedures import restore as restoring
from i7000.host.procedures.change import named_settings

if TYPE_CHECKING:
    from i7000.cli.reached import OpenLine, Reached

__all__ = ["restore"]


def restore(  # noqa: PLR0913 - each of them is an option
    target: Target,
    file: Annotated[str, Parameter(help="A file of i7000 backup; - is standard input.", allow_leading_hyphen=True)],
    /,
    *names: Annotated[
        str, Parameter(help="The settings to restore, such as type_code.3, or type_code for all channels.")
    ],
    yes: Yes = False,
    json: Json = False,
    line: LineOptions = DEFAULT_LINE,
    asking: AskOptions = DEFAULT_ASKING,
    one: OneModule = DEFAULT_ONE,
    module: Module = UNKNOWN,
) -> int:
    """Write the settings of a file to a module, one by one, and read each back.

    First it shows what would change, and asks you. Only what differs is written. Calibration is never touched. What
    could lose the module is left alone unless you name it: `address`, `baud_rate`, `character_format`, `protocol`,
    `checksum`. A file of another model is refused unless you name the settings.

    What can become of a setting:

    * `done`, `already so`: it is as wanted. `pending`: it is in use from the next power-on.
    * `refused`: the module did not take it. `needs INIT`: it takes it only with its INIT switch on.
    * `not verified`: it reads back as another value.
    * `in doubt`: the module stopped answering after it was written.
    * `unread`, `skipped`: nothing was written.

    Ctrl-C stops after the setting at hand; a second one stops at once.

    JSON keys: `record` (`setting`), `name`, `status`, `wanted`, `before`, `after`, `reason`.

    Example: `i7000 restore /dev/ttyUSB0 oven.json`

    Example: `i7000 restore /dev/ttyUSB0 oven.json type_code filter --yes`

    Exit code: 0 if all settings are as wanted, 1 if one was refused or not verified or you said no; 2 for wrong usage
    or a file of another model, 3 if the port cannot be opened or the module does not answer; 6 if the module was left
    changed, since a setting is in doubt or the module stopped answering in the middle; 130 after Ctrl-C.
    """
    from i7000.cli.reached import reach, run  # noqa: PLC0415 - it takes time

    printer = Printer(json=json)
    wanted = read_snapshot(file)
    chosen = _chosen(wanted, names)
    check_can_ask("restoring changes the module", yes=yes)
    asked = asked_of(target, line, asking, one, module)

    def change(open_line: "OpenLine") -> int:
        there = reach(open_line, asked, printer.note, wanted.model)
        if there.profile.model is not wanted.model and not names:
            models = f"{file} is of {wanted.model.value}, the module is {there.profile.model.value}"
            raise UsageError(f"{models}: name the settings to restore")
        return _change(there, wanted, chosen, printer, yes=yes)

    return run(asked, change)


def _chosen(wanted: Snapshot, names: tuple[str, ...]) -> frozenset[str]:
    """Return the settings that names stand for; without any, all that cannot lose the module."""
    try:
        return named_settings(wanted, names or None)
    except InvalidValueError as error:
        raise UsageError(error) from None


def _change(there: "Reached", wanted: Snapshot, chosen: frozenset[str], printer: Printer, *, yes: bool) -> int:
    from i7000.cli.changing import Changes, code_of  # noqa: PLC0415 - it takes time
    from i7000.host.procedures import snapshot  # noqa: PLC0415 - it takes time

    taken = there.open.run(snapshot(there.address, there.profile, there.protocol))
    if not taken.settings:
        raise LineError(f"{there.words} stopped answering: nothing was changed")
    changes = [it for it in differences(taken, wanted) if it.after is not None]
    _note_left(changes, chosen, printer)
    changes = [it for it in changes if it.name in chosen]
    if not changes:
        printer.note(f"nothing to change: {there.words} has all these values")
        return 0
    if not printer.json:
        printer.lines(change_table(changes, wanted.model, ("now", "restored")))
    if not there.open.consents("", f"Change these settings of {there.words}?", printer, yes=yes):
        printer.error("nothing was changed")
        return 1
    doing = Changes(there, printer, frozenset(it.name for it in changes))
    procedure = restoring(
        there.address, there.profile, wanted, chosen, protocol=there.protocol, line=there.open.line.line
    )
    code = doing.carry_out(procedure, chosen)
    return code_of(doing.results) if code is None else code


def _note_left(changes: list[Change], chosen: frozenset[str], printer: Printer) -> None:
    left = [it.name for it in changes if it.name not in chosen and hazard_of(it.name) is Hazard.LOSES]
    if left:
        printer.note(f"not restored unless you name it, as it {LOSES}: {', '.join(left)}")
