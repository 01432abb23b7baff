"""``i7000 simulate``: simulated modules to try a driver against."""

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from i7000.cli.options import Texts
from i7000.cli.places import DEFAULT_PLACES, PlaceOptions
from i7000.cli.recorded import NOWHERE, RecordOptions
from i7000.cli.text import Printer
from i7000.cli.words import UsageError

__all__ = ["simulate"]


def simulate(  # noqa: PLR0913 - each of them is an option
    *,
    model: Annotated[
        Texts,
        Parameter(help="A module, as MODEL[@FIRMWARE][,name=value...]; repeat it for each. Example: M-7019R,type=K."),
    ] = (),
    signal: Annotated[
        Texts,
        Parameter(help="A signal at the inputs, as [ADDRESS:]CHANNELS=SIGNAL. Example: 0=1.5V."),
    ] = (),
    fault: Annotated[
        Texts,
        Parameter(
            help="A fault of the line, as NAME[=PROBABILITY][@WHERE]; repeat it for each. Example: late=0.25:0.9@01."
        ),
    ] = (),
    seed: Annotated[int, Parameter(help="Random seed for faults and noise; the same seed repeats the run.")] = 0,
    eeprom: Annotated[
        Path | None, Parameter(help="A file that keeps the settings of the modules. Example: bus.json.")
    ] = None,
    view: Annotated[
        Literal["live", "lines", "none"] | None,
        Parameter(
            help="live shows modules and traffic, lines traffic line by line. Default: live on a terminal, else none."
        ),
    ] = None,
    control: Annotated[
        str | None,
        Parameter(
            help="Take commands: - from standard input, a path at a Unix socket. Example: bus.sock.",
            allow_leading_hyphen=True,
        ),
    ] = None,
    place: PlaceOptions = DEFAULT_PLACES,
    recording: RecordOptions = NOWHERE,
) -> int:
    """Simulate modules on a line, until Ctrl-C.

    The first lines of the output are the ports for your driver, as pyserial takes them: the path of a pseudo-terminal,
    `socket://127.0.0.1:5020` or `rfc2217://127.0.0.1:5021`. Without HOST, only this machine can connect; `*` is every
    address of this machine.

    Example: `i7000 simulate --model M-7019R,type=K,protocol=dcon --signal all=25degC --tcp 5020`

    * Modules: `M-7019R@B3.7`, or with settings, `M-7019R,address=02,type=K/J/T/K/K/K/K/K,protocol=dcon,checksum=true`.
      Other settings have the factory default, but the n-th module has the address n. `init=true` powers a module on
      with the INIT switch set. `channels=0-3/5` or `mask=2Fh` says which channels are enabled.
    * Numbers are decimal, or hex as `0x1A` or `1Ah`. A type is two hex digits or a name.
    * Signals: `0=1.5V`, `all=25degC`, `02:0-3=sine:20:5:60`, `4=ramp:4mA:20mA:10`, `5=noise:100:0.5`, `6=open`,
      `7=csv:FILE`, `cjc=31.5`. Times are in seconds. A value without a unit has that of the type. Without a signal,
      each channel has another value within its range.
    * A CSV file starts with a line of column names: `seconds`, the number of each channel (`0,1,2`), and
      `cold_junction` for `cjc`; other columns are ignored. Each further line has a value for every column, with a
      decimal point, or `open` for an open wire. The seconds rise; a row holds until the next one. A file has at most
      2,000,000 rows and 200 MB.
    * Faults of bytes, each with a probability P: `drop=P`, `flip=P` of a bit, `noise=P` before them. Faults of
      responses: `late=P[:SECONDS]` (0.3 s), `silent=P`, `truncate=P`, `duplicate=P`, `misaddress=P` (the address of
      another module; responses with `>` have no address and stay as they are), `replay=P` (the response to an earlier
      request), `refuse=P[:CODE]` (`?AA`, or a Modbus exception with CODE, 4). Without a probability: `echo`, and
      `lumps` (responses arrive every 16 ms).
    * More faults of responses: `misfunction=P` (another function code; `!AA` for `>`), `corrupt=P` (one bit is
      flipped), `lookalike=P` (a shorter frame with a good checksum before it), `trailing=P` (00 after it),
      `split=P[:SECONDS]` (in two pieces, 0.05 s apart).
    * After a fault, `@to` limits it to requests, `@from` to responses, and `@01` to the responses of address 01:
      `drop=0.01@to`, `late=0.25:0.9@01`, `silent=1@02`. A fault with `@` replaces the same fault without it.
    * The file of `--eeprom` is created if it does not exist. If it does, the modules have the settings stored in it,
      and you may leave out `--model`. Only one simulator at a time can use the file.

    While it runs, the live view takes the keys that it shows. `--control` takes commands, one a line, and answers each
    by a line that begins with `ok` or `error:`. The key `:` takes the same commands. An ADDRESS is the stored one.

    * `power-cycle [ADDRESS]` switches the power of all modules or one off and on.
    * `init ADDRESS on` or `off` moves the INIT switch, which counts at the next power cycle.
    * `signal 01:0=5V` connects a signal as `--signal` does.
    * `fault late=0.1 drop=0@to` changes faults as `--fault` does, `fault off` switches all off, `fault` shows them.
    * `quit` ends the simulation, and so does the end of standard input with `--control -`.

    * `--record` writes commands, responses as the modules sent them, faults and changes of modules; `i7000 decode
      --file` reads it. If the disk is full, the recording stops, not the simulation.

    Over RFC 2217, wrong baud rates and parities turn frames into garbage; elsewhere they do not matter. `--tcp` and
    `--rfc2217` serve 64 hosts each at a time. A host that does not read loses responses, and so does one that waits for
    1024 pieces, or 65536 bytes, of late responses. Output that nobody reads is dropped and counted:
    `n lines not shown`.

    Exit code: 0 after `q`, `quit`, SIGTERM or SIGHUP; 2 for wrong usage, a file that is damaged or cannot be written,
    or output that could not be written during the simulation; 130 after Ctrl-C.
    """
    from i7000.cli import simulation as simulating  # noqa: PLC0415 - what it needs may not be there
    from i7000.cli.faults import read_faults  # noqa: PLC0415

    printer = Printer()
    if control == "-" and view == "live":
        raise UsageError("--control - and the keys of --view live both read standard input: give one of them")
    with simulating.held(eeprom):
        simulated = simulating.Simulation(
            simulating.read_modules(model, signal, seed=seed, memory=eeprom),
            read_faults(fault),
            seed,
            eeprom,
            place.has_pty,
            place.places(),
            view or ("live" if printer.out.is_terminal and control != "-" else "none"),
            control,
            recording,
        )
        return simulating.run(simulated, printer)
