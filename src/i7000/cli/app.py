"""The commands of ``i7000`` and their options."""

import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Annotated, Any, Literal

from attrs import frozen
from cyclopts import App, CycloptsError, Parameter

from i7000 import DataFormat, EncodeError, Firmware, InvalidValueError, ModbusDataFormat, Model, Profile, dcon, modbus
from i7000.cli import rtu, rtu_records
from i7000.cli.dcon import Known
from i7000.cli.hex_lines import numbered_hex_pieces
from i7000.cli.log import numbered_pieces
from i7000.cli.message import DCON, MODBUS, frame_text, make
from i7000.cli.message import encode as encode_message
from i7000.cli.records import Record, command_record, line_records
from i7000.cli.registers import register_record
from i7000.cli.source import LONGEST_LINE, Counted, Lines
from i7000.cli.text import Line, Printer, command_lines, frame_lines, register_lines, request_lines
from i7000.cli.words import UsageError, type_codes
from i7000_cli import CLOSED, INTERRUPTED

__all__ = ["app", "run"]

app = App(
    name="i7000",
    help="The protocols of the ICP DAS I-7000 / M-7000 analog input modules: what frames mean, how they are written."
    "\n\nExit codes besides those of each command: 130 after Ctrl-C, 141 if nobody reads the output to its end.",
    help_format="markdown",
    suppress_keyboard_interrupt=False,
)

_Protocol = Annotated[Literal["dcon", "rtu"], Parameter(help="DCON, or Modbus RTU.")]


@Parameter(name="*")
@frozen
class Module:
    """What is known about the module; what is not given is not known."""

    model: str | None = None
    """Its printed name: I-7018R."""
    firmware: str | None = None
    """Its firmware: B3.9; the newest if it is not given."""
    types: Annotated[str | None, Parameter(name="--type")] = None
    """Its type, or the types of all channels with commas between: hex codes (0F) or names (K, V_10, MA_4_20)."""
    data_format: Annotated[DataFormat | None, Parameter(name="--format")] = None
    """How its readings are written."""
    checksum: bool | None = None
    """Whether its frames have a checksum."""
    single_ended: Annotated[bool | None, Parameter(negative="--differential")] = None
    """Whether its inputs are single-ended: 7017Z only."""
    modbus_format: ModbusDataFormat | None = None
    """How its analog registers are written."""

    def known(self, protocol: _Protocol = "dcon") -> Known:
        """The options as values.

        Errors: `UsageError`.
        """
        if protocol == "rtu" and (self.data_format is not None or self.checksum is not None):
            raise UsageError("--format and --checksum are of DCON; the registers have --modbus-format")
        if protocol == "dcon" and self.modbus_format is not None:
            raise UsageError("--modbus-format is of --protocol rtu; DCON has --format")
        try:
            known = Known(
                None if self.model is None else Model.find(self.model),
                None if self.firmware is None else Firmware(self.firmware),
                None if self.types is None else type_codes(self.types),
                self.data_format,
                self.checksum,
                self.single_ended,
                self.modbus_format,
            )
            _ = known.default, known.all
        except InvalidValueError as error:
            raise UsageError(error) from None
        return known


_UNKNOWN = Module()
_Json = Annotated[bool, Parameter(help="Write JSON, an object a line.", negative="")]


# --- decode -----------------------------------------------------------------------------------------------------------


@app.command
def decode(
    *frames: Annotated[str, Parameter(help="Frames; without any, the lines of --file or of standard input.")],
    file: Annotated[Path | None, Parameter(help="A log; - is standard input.", allow_leading_hyphen=True)] = None,
    protocol: _Protocol = "dcon",
    json: _Json = False,
    module: Module = _UNKNOWN,
) -> int:
    r"""Decode frames: those given, or those of a log.

    A DCON frame is text (`$012`, with or without `\r` or `(CR)` at its end), or pairs of hex digits up to the final
    `0d`. Quote it: the shell knows `$`, `#` and `>` too; and put `--` before frames of which one begins with `->`. A
    Modbus frame is in hex: `010400000008F1CC`, `01 04 ...`, `0x01,0x04,...`, `\x01\x04...`; one argument a frame, or
    more that follow one another. Lines of a log can have dates, words (`TX:`), brackets and arrows before the frame;
    what cannot be understood is printed too, and named at the end.

    A response is read together with the command before it. Without `--model` all that it could be is told. With
    `--model`, what is not given has its factory default if the frame fits that, and is left open if not. By Modbus the
    model gives registers their names, and readings their values.

    Exit code: 0 if all was understood (also if in more ways than one), 1 if not, 2 for wrong usage.

    JSON has the same keys always, null or empty where there is nothing to tell:

    * the frame: `line`, `direction` (command or response; request, response or echo), `text` (the line), `frame`,
      `wire` (hex), `answers` (line of the command), `error`, `fault`;
    * its meaning, if it has one: `name`, `title`, `section`, `syntax`, `command` (that it answers), `fields` (numbers,
      as in the vectors of spec), `explained` (the same in words), `readings` (`channel`, `text`, `status`, `type_code`,
      `value`, `unit`), `registers` (`number`, `name`, `channel`, `value`, `unit`, `status`, `text`), `errata`, `pause`
      (seconds to leave the module alone), `models`, `checksum` (null: fits both), `data_formats`, `assumed` (what has
      its factory default), `note` (what else is to be known);
    * if it has more: `candidates`, objects with the keys of a meaning.
    """
    known = module.known(protocol)
    count = 0
    wrong = Counted()
    with Printer(json=json) as printer, _source(frames, file, printer) as lines:
        records = (
            rtu_records.line_records(numbered_hex_pieces(lines), known)
            if protocol == "rtu"
            else line_records(numbered_pieces(lines), known)
        )
        for record in records:
            count += 1
            if record["error"]:
                wrong.add(record["line"])
            printer.record(record, frame_lines(record, models=known.model is None))
    long = lines.long if isinstance(lines, Lines) else Counted()
    if not count:
        printer.error("there was nothing to decode")
    if long.count:
        printer.error(f"{long.count} too long, read in pieces of {LONGEST_LINE} bytes that may cut frames: line {long}")
    if wrong.count:
        printer.error(f"{wrong.count} not understood: line {wrong}")
    return 1 if wrong.count or long.count else 0


@contextmanager
def _source(frames: tuple[str, ...], file: Path | None, printer: Printer) -> Iterator[Iterable[tuple[int, bytes]]]:
    """The numbered lines to decode; what was decoded is printed before waiting for more."""
    if frames and file:
        raise UsageError("frames are given, and a file too: give one of them")
    if frames:
        yield enumerate(map(_argument, frames), 1)
    elif file and file != Path("-"):
        with file.open("rb") as log:
            yield Lines(log, printer.flush)
    elif sys.stdin is None or (file is None and sys.stdin.isatty()):
        raise UsageError("no frames: give some, or --file, or a log on standard input; see i7000 decode --help")
    else:
        yield Lines(sys.stdin.buffer, printer.flush)  # type: ignore[arg-type] # it is buffered


def _argument(text: str) -> bytes:
    """The bytes that an argument was made of, UTF-8 or not."""
    try:
        return os.fsencode(text)
    except UnicodeEncodeError:
        return text.encode("utf-8", "surrogatepass")


# --- encode, commands -------------------------------------------------------------------------------------------------


@app.command
def encode(
    name: Annotated[str, Parameter(help="A command, as i7000 commands lists it, or a response.")],
    /,
    *fields: Annotated[str, Parameter(help="field=value for each field.")],
    protocol: _Protocol = "dcon",
    force: Annotated[bool, Parameter(help="Write it even if the module would refuse it.", negative="")] = False,
    json: _Json = False,
    module: Module = _UNKNOWN,
) -> int:
    """Write a frame: as text, then in hex; by Modbus in hex.

    * Numbers are decimal, or hex as `0x3A`; truth values `true` or `false`; choices a name or a number: `update=once`.
    * Types are hex codes or names: `type_code=0F`, `type_code=K`, `type_code=mixed`.
    * A mask is a number or a list of channels: `mask=0x3A` or `channels=1,3,4,5`.
    * `line_settings` is a byte in hex, `line_settings=86`, or its parts: `baud_rate=9600 character_format=E81`.
    * `report_settings` is a byte in hex, `report_settings=40`, or its parts: `data_format=hex checksum=true
      fast_mode=false filter=reject_50_hz`. Parts that are not given are those of the byte, or the factory default.
    * Lists have commas between: `values=+01.500,-01.500`, by Modbus `values=1,0x1F` or `values=true,false`.

    Examples: `i7000 encode SetChannelMask address=1 channels=1,3,4,5 --model I-7018`,
    `i7000 encode ReadInputRegisters address=1 start=0 count=8 --protocol rtu`

    Exit code: 0; 1 if the model, or every model, refuses it; 2 for wrong usage.

    JSON keys: `name`, `section`, `frame`, `wire` (hex).
    """
    known = module.known(protocol)
    printer = Printer(json=json)
    try:
        message = make(name, fields, MODBUS if protocol == "rtu" else DCON)
    except EncodeError as refusal:
        printer.error(str(refusal))
        return 1
    try:
        frame = encode_message(message, known, force=force)
    except EncodeError as refusal:
        printer.error(refusal if known.model else f"no model takes it; the first says: {refusal}")
        return 1
    text = frame_text(message, frame)
    record = {"name": type(message).__name__, "section": message.section, "frame": text, "wire": frame.hex()}
    in_hex: list[Line] = [] if protocol == "rtu" else [[(frame.hex(" "), "")]]
    printer.record(record, [[(text, "bold")], *in_hex])
    printer.flush()
    return 0


@app.command
def commands(
    *,
    model: Annotated[str | None, Parameter(help="The model.")] = None,
    firmware: Annotated[str | None, Parameter(help="Its firmware; the newest if it is not given.")] = None,
    protocol: _Protocol = "dcon",
    json: _Json = False,
) -> int:
    """List what a model can do, or all that any can, and who can.

    Columns: section of the manual, command, response, name, what it is about, models; by Modbus the PDU of the request,
    which begins with function and sub-function, and no response.

    JSON keys: `section`, `name`, `title`, `syntax`, `fields` (and their values), `response`, `response_syntax`,
    `models` (and the firmware from which on, or null), `errata`.
    """
    known = Module(model=model, firmware=firmware).known()
    profiles = [known.default] if known.default else [Profile(one, firmware=known.firmware) for one in Model]
    with Printer(json=json) as printer:
        for command in modbus.REQUESTS if protocol == "rtu" else dcon.COMMANDS:
            having = [profile.model.value for profile in profiles if command.availability not in profile.refused]
            if having:
                printer.record(*_listed(command, having))
    return 0


def _listed(command: type[dcon.AnyCommand | modbus.Request[Any]], models: list[str]) -> tuple[Record, Iterable[Line]]:
    if issubclass(command, modbus.Request):
        record = rtu_records.request_record(command, models)
        return record, request_lines(record)
    record = command_record(command, models)
    return record, command_lines(record)


@app.command
def registers(
    *,
    model: Annotated[str, Parameter(help="The model.")],
    firmware: Annotated[str | None, Parameter(help="Its firmware; the newest if it is not given.")] = None,
    json: _Json = False,
) -> int:
    """List the coils, inputs and registers that a model has by Modbus.

    Columns: the manual's numbers (the digit before is the kind; frames have the rest less 1), name, access, kind, unit
    of a count, range of counts.

    JSON keys: `number`, `last_number`, `name`, `address` (as in frames), `count`, `access`, `kind`, `unit`, `scale` (of
    a count), `minimum`, `maximum` (in counts).
    """
    known = Module(model=model, firmware=firmware).known("rtu")
    with Printer(json=json) as printer:
        for row in modbus.RegisterMap(rtu.profiles(known)[0]):
            record = register_record(row)
            printer.record(record, register_lines(record))
    return 0


# --- simulate ---------------------------------------------------------------------------------------------------------


@app.command
def simulate(  # noqa: PLR0913 - each of them is an option
    *,
    model: Annotated[
        tuple[str, ...],
        Parameter(help="MODEL[@FIRMWARE][,name=value...]; once for each module.", negative="", show_default=False),
    ] = (),
    pty: Annotated[
        bool, Parameter(help="On a pseudo-terminal; so it is if nothing is said.", negative="", show_default=False)
    ] = False,
    tcp: Annotated[str | None, Parameter(help="On TCP at [HOST:]PORT, the bytes as they are.")] = None,
    rfc2217: Annotated[str | None, Parameter(help="On TCP at [HOST:]PORT, by RFC 2217.")] = None,
    signal: Annotated[
        tuple[str, ...],
        Parameter(help="[ADDRESS:]CHANNELS=SOURCE; what is on the inputs.", negative="", show_default=False),
    ] = (),
    fault: Annotated[
        tuple[str, ...],
        Parameter(help="What the line does: echo, lumps, drop=0.01 ...", negative="", show_default=False),
    ] = (),
    seed: Annotated[int, Parameter(help="Random seed for faults and noise; the same seed repeats the run.")] = 0,
    eeprom: Annotated[Path | None, Parameter(help="A file for what the modules remember without power.")] = None,
    view: Annotated[
        Literal["live", "lines", "none"] | None,
        Parameter(help="Show modules and traffic, or traffic line by line; live on a terminal if nothing is said."),
    ] = None,
) -> int:
    """Simulate modules on a line, until Ctrl-C.

    What is printed first is where a driver finds them: the path of a pseudo-terminal, `socket://127.0.0.1:5020`,
    `rfc2217://127.0.0.1:5021`, as pyserial takes them. Without a host, only this machine gets there; `*` is every
    address of this machine.

    * Modules: `M-7019R@B3.7`, or with settings, `M-7019R,address=02,type=K/J/T/K/K/K/K/K,protocol=dcon,checksum=true`.
      Unless given, all is as from the factory, but the n-th module has the address n. `init=true` powers it on with the
      INIT switch set.
    * Signals: `0=1.5V`, `all=25degC`, `02:0-3=sine:20:5:60`, `4=ramp:4mA:20mA:10`, `5=noise:100:0.5`, `6=open`,
      `7=csv:FILE`, `cjc=31.5`; units are those of the types unless given, times seconds. Unless given, each channel has
      another value within its range.
    * A CSV file starts with a line of column names: `seconds`, the number of each channel (`0,1,2`), and
      `cold_junction` for `cjc`; others are ignored. Each further line has one value for every column, decimals with a
      point, and `open` for an open wire. The seconds rise; a row holds until the next one. At most 2,000,000 rows and
      200 MB.
    * Faults: `echo`, `lumps` (answers come every 16 ms), `drop=P`, `flip=P` (of a byte), `noise=P`, `late=P[:SECONDS]`
      (of an answer), P being a probability.
    * The file of `--eeprom` is made if it is not there; if it is, what it has stored is what the modules remember, and
      `--model` may be left out. One simulator at a time uses the file.

    Over RFC 2217, a host with another baud rate or parity than a module sends it garbage; elsewhere they do not matter.
    `--tcp` and `--rfc2217` serve 64 hosts each at a time. A host that does not read loses answers, and so does one for
    which 1024 pieces, or 65536 bytes, of late answers are on their way. Output that nobody reads is dropped, and
    counted: `n lines not shown`.

    Exit code: 0 after Ctrl-C, SIGTERM or SIGHUP; 2 for wrong usage, or a file that is damaged or cannot be written; 130
    for Ctrl-C before the simulation has begun.
    """
    from i7000.cli import simulate as simulating  # noqa: PLC0415 - what it needs may not be there

    printer = Printer()
    places = [
        simulating.read_place(scheme, text)
        for scheme, text in (("socket", tcp), ("rfc2217", rfc2217))
        if text is not None
    ]
    with simulating.held(eeprom):
        simulated = simulating.Simulation(
            simulating.read_modules(model, signal, seed=seed, memory=eeprom),
            simulating.read_faults(fault),
            seed,
            eeprom,
            pty or not places,
            tuple(places),
            view or ("live" if printer.out.is_terminal else "none"),
        )
        return simulating.run(simulated, printer)


# --- run --------------------------------------------------------------------------------------------------------------


def run(arguments: Sequence[str] | None) -> int:
    """Run the command line, and tell the exit code."""
    arguments = sys.argv[1:] if arguments is None else arguments
    try:
        code = app(arguments, exit_on_error=False, print_error=False, result_action="return_value") or 0
        if sys.stdout is not None:
            sys.stdout.flush()
    except (BrokenPipeError, SystemExit):  # rich makes the latter of the former
        return CLOSED
    except (CycloptsError, UsageError, OSError) as error:
        with suppress(OSError, SystemExit):  # The terminal may be gone.
            Printer().error(error)
        return 2
    except ModuleNotFoundError as missing:
        Printer().error(f'no module {missing.name}; this needs: pip install "i7000[simulator]"')
        return 2
    except KeyboardInterrupt:
        return INTERRUPTED
    return code
