"""``i7000 set``: settings of a module, by their names."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from i7000 import InvalidValueError, Profile, Protocol
from i7000.cli.asked import DEFAULT_ONE, LEFT_CHANGED, OneModule, Yes, asked_of
from i7000.cli.options import UNKNOWN, Json, Module
from i7000.cli.port import DEFAULT_ASKING, DEFAULT_LINE, AskOptions, LineOptions, Target
from i7000.cli.setting_text import LOSES, listed_lines, listed_record
from i7000.cli.text import Printer
from i7000.cli.words import LineError, UsageError, near
from i7000.host.procedures import Hazard, Setting, hazard_of, set_one, settings_of, snapshot
from i7000.host.procedures.settings import why_not

if TYPE_CHECKING:
    from i7000.cli.reached import OpenLine, Reached

__all__ = ["set_setting"]


def set_setting(  # noqa: PLR0913 - each of them is an option
    target: Target,
    /,
    *assignments: Annotated[
        str, Parameter(help="Settings with their new values, each as NAME=VALUE. Example: host_watchdog_timeout=2.5.")
    ],
    listed: Annotated[
        bool,
        Parameter(name="--list", help="List all settings with their values and what is allowed.", negative=""),
    ] = False,
    yes: Yes = False,
    json: Json = False,
    line: LineOptions = DEFAULT_LINE,
    asking: AskOptions = DEFAULT_ASKING,
    one: OneModule = DEFAULT_ONE,
    module: Module = UNKNOWN,
) -> int:
    """Change settings of a module: each is read, changed, written and read back. Nothing else changes.

    * `--list` has the names, the values now, and what is allowed.
    * Values are written as they are listed: `type_code.3=K`, `host_watchdog_timeout=2.5`, `cjc_enabled=no`,
      `channel_mask=0-3,5`. `type_code=K` is for all channels. A number in hex, `0x19` or `19h`, is in counts.
    * Several settings are changed in the order in which you write them, after all of them were checked.
    * What could lose the module asks you first: `address`, `baud_rate`, `character_format`, `protocol`, `checksum`.

    `i7000 restore --help` explains what can become of a setting, and the JSON keys. With `--list`, these are `record`
    (`setting`), `name`, `value`, `unit`, `allowed`, `hazard`, `next_power_on`, `reason` (why there is no value).

    Example: `i7000 set /dev/ttyUSB0 --list`

    Example: `i7000 set /dev/ttyUSB0 type_code.0=K filter=reject_50_hz --address 2`

    Exit code: 0 if all settings are as wanted, 1 if one was refused, not verified or not read, or you said no; 2 for
    wrong usage, 3 if the port cannot be opened or the module does not answer; 6 if the module was left changed, since a
    setting is in doubt or the module stopped answering in the middle; 130 after Ctrl-C.
    """
    from i7000.cli.reached import reach, run  # noqa: PLC0415 - it takes time

    printer = Printer(json=json)
    pairs = tuple(map(_pair, assignments))
    if listed == bool(pairs):
        raise UsageError("give either NAME=VALUE, or --list for the names and values")
    risky = [name for name, _ in pairs if hazard_of(name) is Hazard.LOSES]
    asked = asked_of(target, line, asking, one, module)

    def change(open_line: "OpenLine") -> int:
        there = reach(open_line, asked, printer.note)
        if listed:
            return _list(there, printer)
        wanted = [one for name, text in pairs for one in _wanted(there.profile, there.protocol, name, text)]
        _check_once(wanted)
        if risky and not open_line.consents(_risk(pairs, risky), f"Change it on {there.words}?", printer, yes=yes):
            printer.error("nothing was changed")
            return 1
        return _change(there, wanted, printer)

    return run(asked, change)


def _pair(assignment: str) -> tuple[str, str]:
    name, equals, text = assignment.partition("=")
    if not equals:
        raise UsageError(f"{assignment!r} is not NAME=VALUE; i7000 set TARGET --list has the names")
    return name.strip(), text.strip()


def _risk(pairs: tuple[tuple[str, str], ...], risky: list[str]) -> str:
    return f"{', '.join(f'{name}={text}' for name, text in pairs if name in risky)} {LOSES}"


# --- what is wanted ---------------------------------------------------------------------------------------------------


def _wanted(profile: Profile, protocol: Protocol, name: str, text: str) -> Iterator[tuple[Setting, str]]:
    """Yield the settings that a name stands for, with the text of the value, which is checked.

    Errors: `UsageError`.
    """
    settings = settings_of(profile, protocol)
    found = [it for it in settings if name in (it.name, it.name.partition(".")[0])]
    if not found:
        hint = near(name, [it.name.partition(".")[0] for it in settings])
        raise UsageError(f"{why_not(name, profile, protocol)}{hint or '; i7000 set TARGET --list has the names'}")
    for setting in found:
        try:
            setting.values.typed(setting.name, text)
        except InvalidValueError as error:
            raise UsageError(error) from None
        yield setting, text


def _check_once(wanted: list[tuple[Setting, str]]) -> None:
    names = [setting.name for setting, _ in wanted]
    twice = [name for name in names if names.count(name) > 1]
    if twice:
        raise UsageError(f"{twice[0]} is given twice")


# --- what is done -----------------------------------------------------------------------------------------------------


def _list(there: "Reached", printer: Printer) -> int:
    taken = there.open.run(snapshot(there.address, there.profile, there.protocol))
    if not taken.settings:
        raise LineError(f"{there.words} stopped answering")
    values, unread = dict(taken.settings), dict(taken.unread)
    settings = [it for it in settings_of(there.profile, there.protocol) if it.name in values or it.name in unread]
    if printer.json:
        for setting in settings:
            printer.record(listed_record(setting, values, unread), ())
    else:
        printer.lines(listed_lines(settings, values, unread))
    return 1 if any(it.name in unread for it in settings) else 0


def _change(there: "Reached", wanted: list[tuple[Setting, str]], printer: Printer) -> int:
    from i7000.cli.changing import Changes, code_of  # noqa: PLC0415 - it takes time

    doing = Changes(there, printer, frozenset(setting.name for setting, _ in wanted))
    for setting, text in wanted:
        procedure = set_one(
            there.address, there.profile, setting.name, text, protocol=there.protocol, line=there.open.line.line
        )
        code = doing.carry_out(procedure, frozenset((setting.name,)))
        if code is None and code_of(doing.results) in (LineError.code, LEFT_CHANGED):
            code = code_of(doing.results)
        if code is not None:
            return code
    return code_of(doing.results)
