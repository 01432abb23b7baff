"""``i7000 simulate``: modules that are not there, for drivers to be tried against."""

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from i7000.cli.text import Printer

__all__ = ["simulate"]


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
      INIT switch set. Channels are switched on by `channels=0-3/5`, or by a mask: `mask=2Fh`.
    * Numbers are decimal, or hex as `0x1A` or `1Ah`; type codes are the manual's two hex digits, or names.
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

    Exit code: 0 after Ctrl-C, SIGTERM or SIGHUP; 2 for wrong usage, a file that is damaged or cannot be written, or
    output that could not be written while the simulation went on; 130 for Ctrl-C before the simulation has begun.
    """
    from i7000.cli import simulation as simulating  # noqa: PLC0415 - what it needs may not be there

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
