"""``i7000 send``: one command, and what came of it."""

from signal import SIGINT
from typing import TYPE_CHECKING, Annotated, Any

from attrs import evolve
from attrs import fields as attrs_fields
from cyclopts import Parameter

from i7000 import InvalidValueError, Model, Profile, Protocol, dcon, modbus
from i7000.cli.asked import LEFT_CHANGED, Asked, OneModule, Yes, asked_of
from i7000.cli.frame_text import frame_lines
from i7000.cli.message import make, refusal_words
from i7000.cli.module import named
from i7000.cli.numbers import integer
from i7000.cli.options import PROTOCOLS, UNKNOWN, Json, Module
from i7000.cli.port import DEFAULT_ASKING, DEFAULT_LINE, AskOptions, LineOptions, Target
from i7000.cli.readers import of_lines
from i7000.cli.records import json_of
from i7000.cli.text import Printer
from i7000.cli.wanted import ProtocolChoice
from i7000.cli.words import LineError, UsageError, near, plain
from i7000.dissect import Knowledge
from i7000.host import Declined, TimedOut
from i7000.host.dangers import Danger, danger_of
from i7000.message import Query

if TYPE_CHECKING:
    from i7000.cli.reached import OpenLine
    from i7000.cli.sending import Traffic

__all__ = ["send"]

_DANGERS = {
    Danger.LOSES: "could lose the module: its address, line settings, protocol, checksum or response delay can change",
    Danger.CALIBRATION: "can change the calibration of the module",
    Danger.BROADCAST: "changes a setting of every module on the line",
}
_COMMANDS: dict[Protocol, tuple[type[Query[Any]], ...]] = {
    Protocol.DCON: dcon.COMMANDS,
    Protocol.MODBUS_RTU: modbus.REQUESTS,
}


def send(  # noqa: PLR0913 - each of them is an option
    target: Target,
    name: Annotated[str, Parameter(help="Name of a command or request. i7000 commands lists them.")],
    /,
    *fields: Annotated[str, Parameter(help="The fields, each as field=value. Example: address=1.")],
    protocol: Annotated[
        ProtocolChoice, Parameter(help="DCON or Modbus RTU. auto: the one that the module speaks.")
    ] = "auto",
    yes: Yes = False,
    json: Json = False,
    line: LineOptions = DEFAULT_LINE,
    asking: AskOptions = DEFAULT_ASKING,
    module: Module = UNKNOWN,
) -> int:
    """Send one command to a module, and decode what is sent and heard.

    Commands and fields are those of `i7000 encode`; its help explains them. The module is asked what it is first,
    unless you give `--model`. Then only the command is sent. Commands that could lose the module, change its
    calibration or change every module on the line ask you first.

    `--json` prints the records of `i7000 decode --json`.

    Example: `i7000 send /dev/ttyUSB0 ReadConfiguration address=1`

    Example: `i7000 send sim:M-7019R WriteSingleRegister address=1 register=host_watchdog_timeout value=2.5`

    Exit code: 0 if the module carried it out or a broadcast was sent, 1 if the module refused it or you said no; 2 for
    wrong usage, 3 if the port cannot be opened or the module does not answer; 6 if you broke off a command that may
    have changed the module; 130 after Ctrl-C.
    """
    from i7000.cli.reached import run  # noqa: PLC0415 - it takes time
    from i7000.cli.sending import Traffic  # noqa: PLC0415 - it takes time

    printer = Printer(json=json)
    kinds = _kinds(name, protocol)
    address = _address(kinds, fields)
    asked = asked_of(target, line, asking, OneModule(address, protocol), module)
    traffic = Traffic()

    def ask(open_line: "OpenLine") -> int:
        profile, spoken = _profile(open_line, asked, kinds, address, printer)
        command = _command(kinds[spoken], fields, profile)
        danger = danger_of(command)
        if danger is not None:
            words = f"{type(command).__name__} {_DANGERS[danger]}"
            if not open_line.consents(words, "Send it?", printer, yes=yes):
                printer.error("nothing was sent")
                return 1
        traffic.begin(getattr(command, "address", None), profile, spoken)
        return _ask(open_line, command, profile, traffic, printer)

    return run(asked, ask, traffic.observe)


# --- what is sent -----------------------------------------------------------------------------------------------------


def _kinds(name: str, protocol: ProtocolChoice) -> dict[Protocol, type[Query[Any]]]:
    """Return the command of a name in each protocol that has it.

    Errors: `UsageError`.
    """
    found = {
        spoken: kind
        for spoken, kinds in _COMMANDS.items()
        if PROTOCOLS[protocol] in (None, spoken)
        for kind in kinds
        if plain(kind.__name__) == plain(name)
    }
    if not found:
        names = [kind.__name__ for kinds in _COMMANDS.values() for kind in kinds]
        said = "" if protocol == "auto" else f" with --protocol {protocol}"
        hint = near(name, names) or ": i7000 commands lists them"
        if not name.isidentifier():
            hint = f": give {_named(name)}"
        raise UsageError(f"there is no command {name!r}{said}{hint}")
    return found


def _named(frame: str) -> str:
    """Return what to give in place of a frame."""
    reads = of_lines([(1, frame)], Knowledge(), None)
    messages = [it.message for read in reads if read.heard for it in read.heard.meanings]
    for message in messages:
        if isinstance(message, Query):
            kind: Any = type(message)
            fields = [it.name for it in attrs_fields(kind)]
            words = " ".join(f"{it}={getattr(message, it)}" if it == "address" else f"{it}=..." for it in fields)
            return f"its name and fields: {kind.__name__} {words}"
    return "its name; i7000 decode shows that of a frame"


def _address(kinds: dict[Protocol, type[Query[Any]]], fields: tuple[str, ...]) -> str | None:
    """Return the address of the module that a command goes to, as it is written; None for a broadcast.

    Errors: `UsageError` if it is missing or no number.
    """
    if _is_broadcast(kinds):
        return None
    address = dict(field.partition("=")[::2] for field in fields).get("address")
    if address is None:
        raise UsageError(f"{next(iter(kinds.values())).__name__} needs address=..., such as address=1")
    with named(f"address={address}"):
        number = integer(address)
    return None if number == modbus.BROADCAST and Protocol.DCON not in kinds else address


def _is_broadcast(kinds: dict[Protocol, type[Query[Any]]]) -> bool:
    return any(issubclass(kind, dcon.Broadcast) for kind in kinds.values())


def _profile(
    open_line: "OpenLine", asked: Asked, kinds: dict[Protocol, type[Query[Any]]], address: str | None, printer: Printer
) -> tuple[Profile, Protocol]:
    """Return the profile of the module, and the protocol that it speaks: as given, or else the module is asked.

    Errors: `UsageError` for what is given and does not fit, `LineError` if the module does not answer.
    """
    from i7000.cli.reached import given_profile, reach  # noqa: PLC0415 - it takes time

    wanted = asked.wanted
    if wanted.given.model is not None:
        profile = given_profile(wanted)
        return profile, _spoken(kinds, wanted.protocols, profile)
    if _is_broadcast(kinds):
        availability = kinds[Protocol.DCON].availability
        profile = next(it for it in map(Profile, Model) if availability not in it.refused)
        return evolve(profile, checksum=bool(wanted.given.checksum)), Protocol.DCON
    if address is None:
        raise UsageError("address 0 is a broadcast to all modules: give --model, of which the registers are")
    there = reach(open_line, asked, printer.note)
    return there.profile, _spoken(kinds, (there.protocol,), there.profile)


def _spoken(kinds: dict[Protocol, type[Query[Any]]], protocols: tuple[Protocol, ...], profile: Profile) -> Protocol:
    """Return the first protocol that has the command."""
    for protocol in protocols:
        if protocol in kinds:
            return protocol
    name, words = next(iter(kinds.values())).__name__, " or ".join(_WORDS[it] for it in protocols)
    raise UsageError(f"{name} is not a command of {words}, which the {profile.model.value} speaks")


_WORDS = {Protocol.DCON: "DCON", Protocol.MODBUS_RTU: "Modbus RTU"}


def _command(kind: type[Query[Any]], fields: tuple[str, ...], profile: Profile) -> Query[Any]:
    """Return the command that fields describe.

    Errors: `UsageError` for what cannot be understood, and for what the module does not have or take.
    """
    registers = modbus.RegisterMap(profile) if issubclass(kind, modbus.Request) else None
    try:
        command: Any = make(kind, fields, registers)
        (dcon if registers is None else modbus).encode(command, profile)
    except InvalidValueError as refusal:
        raise UsageError(refusal_words(refusal, kind, fields)) from None
    return command  # type: ignore[no-any-return] # of this kind


# --- what comes of it -------------------------------------------------------------------------------------------------


def _ask(open_line: "OpenLine", command: Query[Any], profile: Profile, traffic: "Traffic", printer: Printer) -> int:
    """Send a command, show what was sent and heard, and return the exit code."""
    line, ending = open_line.line, open_line.ending
    outcome = None
    try:
        outcome = line.ask(command, profile)
    except KeyboardInterrupt:
        pass
    finally:
        traffic.end()
        _show(traffic, printer)
    if isinstance(outcome, TimedOut):
        times = "once" if traffic.sent == 1 else f"{traffic.sent} times"
        printer.error(f"no answer; it was sent {times}{'' if _only_reads(command) else _PERHAPS}")
        return LineError.code
    if isinstance(outcome, Declined):
        printer.error("the module refused it")
        return 1
    if outcome is None and traffic.sent and not _only_reads(command):
        printer.error(f"broken off after it was sent{_PERHAPS}")
        return LEFT_CHANGED
    return 128 + (ending.number or SIGINT) if ending.number or outcome is None else 0


_PERHAPS = "; the module may have carried it out"


def _only_reads(command: Query[Any]) -> bool:
    return type(command).__name__.startswith("Read") and danger_of(command) is None


def _show(traffic: "Traffic", printer: Printer) -> None:
    for read in traffic.reads:
        if printer.json:
            printer.write(json_of(read))
        else:
            printer.lines(frame_lines(read, models=False))
    printer.flush()
    for note in traffic.notes:
        printer.note(note)
