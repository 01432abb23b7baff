"""``i7000 listen``: the traffic on a line, decoded as it arrives."""

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from attrs import evolve, frozen
from cyclopts import Parameter

from i7000.cli.decode import Input, reads_of
from i7000.cli.listening import Listening, run, show
from i7000.cli.message import DCON, MODBUS
from i7000.cli.options import PROTOCOLS, UNKNOWN, Json, Module, Texts, address_of
from i7000.cli.port import DEFAULT_LINE, LineOptions
from i7000.cli.recorded import NOWHERE, RecordOptions
from i7000.cli.text import Printer
from i7000.cli.words import UsageError, near
from i7000.dissect import Line
from i7000.recording.schema import SCHEMA
from i7000.settings import BaudRate

if TYPE_CHECKING:
    from i7000.cli.judging import Judging

__all__ = ["listen"]

_LONGEST_TIMEOUT = 60.0


@Parameter(name="*")
@frozen
class JudgeOptions:
    """Whether the line is judged, and how."""

    judge: Annotated[bool, Parameter(negative="")] = False
    """Judge driver and modules: show what breaks a rule, and a verdict at the end."""
    timeout: float | None = None
    """With --judge: seconds in which a response has to begin. Default: 0.2. Example: --timeout 0.5."""
    strict: Annotated[bool, Parameter(negative="")] = False
    """With --judge: exit with 1 for findings of every level, not only must."""

    def check(self) -> None:
        """Raise `UsageError` for options that do not fit."""
        if not self.judge and (self.timeout is not None or self.strict):
            raise UsageError("--timeout and --strict are for --judge")
        if self.timeout is not None and not 0 < self.timeout <= _LONGEST_TIMEOUT:
            raise UsageError(f"--timeout {self.timeout:g}: give more than 0, at most {_LONGEST_TIMEOUT:g} seconds")


NO_JUDGE = JudgeOptions()


def listen(  # noqa: PLR0913 - each of them is an option
    target: Annotated[
        str | None,
        Parameter(
            help="The port: a device such as /dev/ttyUSB0 or COM3, a URL of pyserial such as rfc2217://host:port, or"
            " exec:COMMAND for a program; or a file: a recording, a capture (pcap, pcapng) or a log."
        ),
    ] = None,
    /,
    *,
    address: Annotated[Texts, Parameter(help="Show only the module at this address. Example: --address 2.")] = (),
    only: Annotated[Texts, Parameter(help="Show only messages of this name. Example: --only AnalogInputs.")] = (),
    protocol: Annotated[
        Literal["auto", "dcon", "rtu"], Parameter(help="The protocol on the line; auto recognizes both, even mixed.")
    ] = "auto",
    seconds: Annotated[float | None, Parameter(help="Stop after so many seconds; without it, at Ctrl-C.")] = None,
    json: Json = False,
    schema: Annotated[
        bool,
        Parameter(help="Print the JSON Schema of --record and exit; with --judge, that of its --json.", negative=""),
    ] = False,
    judging: JudgeOptions = NO_JUDGE,
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

    `--judge` shows what breaks a rule in place of the frames: each finding has an id, the side, the section and the
    bytes. At the end it says for each side and address how many frames were judged, and what was found. In place of a
    port, give a recording, a capture file or a log.

    Examples: `i7000 listen /dev/ttyUSB0 --baud 9600 --record bus.jsonl --pcap bus.pcapng`, `i7000 listen bus.jsonl
    --judge`

    Exit code: 0 after `--seconds` or the end of a file, 2 for wrong usage, 3 if the port cannot be opened or is lost,
    130 after Ctrl-C. With `--judge`, 0 means that frames were judged and none broke a must; 1 that one did, or that the
    file is damaged; 5 that nothing was heard that could be judged.
    """
    if schema:
        sys.stdout.write(f"{_judge_schema() if judging.judge else SCHEMA}\n")
        return 0
    if target is None:
        raise UsageError("give a port or a file, such as i7000 listen /dev/ttyUSB0")
    judging.check()
    if judging.judge and only:
        raise UsageError("--only is for frames; --judge shows findings")
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
    printer = Printer(json=json)
    is_file = os.path.isfile(target)  # noqa: PTH113 - other than pathlib, it takes any text
    if is_file and (recording != NOWHERE or seconds is not None):
        raise UsageError(f"{target} is a file: --record, --pcap and --seconds are for a port")
    if judging.judge:
        known = not is_file or line is not DEFAULT_LINE
        listening = evolve(listening, judging=_judging(listening, judging, printer, is_file=is_file, known_line=known))
    return _from_file(listening, printer) if is_file else run(listening, printer)


def _judge_schema() -> str:
    from i7000.cli.judge_schema import SCHEMA  # noqa: PLC0415 - who only listens does without

    return SCHEMA


def _judging(
    listening: Listening, options: JudgeOptions, printer: Printer, *, is_file: bool, known_line: bool
) -> "Judging":
    """Begin a judgement; the settings of the line count for a file only if they are given."""
    from i7000.cli.judging import Judging  # noqa: PLC0415 - who only listens does without
    from i7000.conformance.judge import Judge  # noqa: PLC0415

    settings = listening.settings
    character = settings.character_format.bits / BaudRate(settings.baud_rate).bits_per_second if known_line else None
    state = Judge(character_time=character, collecting=not is_file or _is_of_listener(Path(listening.target)))
    if options.timeout is not None:
        state = evolve(state, bound=options.timeout)
    return Judging(state, listening.addresses, printer, strict=options.strict)


def _is_of_listener(path: Path) -> bool:
    """Return whether a file is a recording of a listener, whose times are those at which an adapter delivers bytes."""
    with path.open("rb") as stream:
        return b'"program": "i7000 listen"' in stream.readline(_LONGEST_START)


_LONGEST_START = 4096
"""The longest first line of a recording that is looked at."""


def _from_file(listening: Listening, printer: Printer) -> int:
    """Show or judge what a file has."""
    judging = listening.judging
    given = Input((), Path(listening.target), raw=False)
    line = listening.line
    if judging:
        judging.begin(listening.target)
    with reads_of(given, line.knowledge, line.protocol, printer) as (reads, _, _):
        show(reads, listening, printer)
    return judging.end(0) if judging else 0


_LONGEST = 1e9
"""The seconds after which a listener stops anyway: 31 years."""


def _check_name(name: str) -> None:
    names = [kind.__name__ for kind in (*DCON, *MODBUS)]
    if name not in names:
        raise UsageError(f"--only {name}: there is no message of this name{near(name, names)}")
