"""``i7000 listen``: the traffic on a line, decoded as it arrives."""

import sys
from typing import Annotated, Literal

from cyclopts import Parameter

from i7000.cli.listening import Listening, run
from i7000.cli.message import DCON, MODBUS
from i7000.cli.options import PROTOCOLS, UNKNOWN, Json, Module, Texts, address_of
from i7000.cli.port import DEFAULT_LINE, LineOptions, Target
from i7000.cli.recorded import NOWHERE, RecordOptions
from i7000.cli.text import Printer
from i7000.cli.words import UsageError, near
from i7000.dissect import Line
from i7000.recording.schema import SCHEMA

__all__ = ["listen"]


def listen(  # noqa: PLR0913 - each of them is an option
    target: Target | None = None,
    /,
    *,
    address: Annotated[Texts, Parameter(help="Show only the module at this address. Example: --address 2.")] = (),
    only: Annotated[Texts, Parameter(help="Show only messages of this name. Example: --only AnalogInputs.")] = (),
    protocol: Annotated[
        Literal["auto", "dcon", "rtu"], Parameter(help="The protocol on the line; auto recognizes both, even mixed.")
    ] = "auto",
    seconds: Annotated[float | None, Parameter(help="Stop after so many seconds; without it, at Ctrl-C.")] = None,
    json: Json = False,
    schema: Annotated[bool, Parameter(help="Print the JSON Schema of --record and exit.", negative="")] = False,
    recording: RecordOptions = NOWHERE,
    line: LineOptions = DEFAULT_LINE,
    module: Module = UNKNOWN,
) -> int:
    """Listen to a line, and decode the traffic as it arrives. Nothing is sent.

    Connect a second adapter to the pair of wires, beside that of the host. Each frame has its time, the time since the
    end of the frame before it, and an arrow: `->` is from a host, `<-` from a module. What breaks a rule of time is
    noted: a command within 2 ms of a broadcast, a gap inside a Modbus frame, a late response. Times are those at which
    the system delivers the bytes; USB adapters often collect them for 16 ms.

    What the traffic shows of a module is used from then on, as in `i7000 decode`. `--json` writes the same objects.
    `i7000 decode --file` reads a file that is recorded; if its disk is full, the recording stops, not the listening.
    Output that nobody reads is dropped and counted. For several modules, give each with its address: `--model
    1=M-7019R --model 2=I-7018`.

    Example: `i7000 listen /dev/ttyUSB0 --baud 9600 --record bus.jsonl --pcap bus.pcapng`

    Exit code: 0 after `--seconds`, 2 for wrong usage, 3 if the port cannot be opened or is lost, 130 after Ctrl-C.
    """
    if schema:
        sys.stdout.write(f"{SCHEMA}\n")
        return 0
    if target is None:
        raise UsageError("give a port, such as i7000 listen /dev/ttyUSB0")
    if seconds is not None and not 0 <= seconds <= _LONGEST:
        raise UsageError(f"--seconds {seconds:g}: give 0 to {_LONGEST:.0f}")
    for name in only:
        _check_name(name)
    listening = Listening(
        target,
        line.settings(),
        Line(module.knowledge(protocol), PROTOCOLS[protocol]),
        frozenset(map(address_of, address)),
        frozenset(only),
        _LONGEST if seconds is None else seconds,
        recording,
    )
    return run(listening, Printer(json=json))


_LONGEST = 1e9
"""The seconds after which a listener stops anyway: 31 years."""


def _check_name(name: str) -> None:
    names = [kind.__name__ for kind in (*DCON, *MODBUS)]
    if name not in names:
        raise UsageError(f"--only {name}: there is no message of this name{near(name, names)}")
