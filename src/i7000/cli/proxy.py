"""``i7000 proxy``: a real line with the faults of a bad one."""

from typing import Annotated, Literal

from cyclopts import Parameter

from i7000.cli.options import Texts
from i7000.cli.places import DEFAULT_PLACES, PlaceOptions
from i7000.cli.port import DEFAULT_LINE, LineOptions, Target
from i7000.cli.recorded import NOWHERE, RecordOptions
from i7000.cli.text import Printer
from i7000.cli.words import UsageError

__all__ = ["proxy"]


def proxy(  # noqa: PLR0913 - each of them is an option
    target: Target,
    /,
    *,
    fault: Annotated[
        Texts,
        Parameter(help="A fault of the line, as for `i7000 simulate`; repeat it for each. Example: late=0.25:0.9@01."),
    ] = (),
    seed: Annotated[int, Parameter(help="Random seed for faults; the same seed and traffic repeat the faults.")] = 0,
    view: Annotated[Literal["lines", "none"], Parameter(help="lines shows what arrives on either side.")] = "none",
    control: Annotated[
        str | None,
        Parameter(
            help="Take commands: - from standard input, a path at a Unix socket. Example: line.sock.",
            allow_leading_hyphen=True,
        ),
    ] = None,
    place: PlaceOptions = DEFAULT_PLACES,
    recording: RecordOptions = NOWHERE,
    line: LineOptions = DEFAULT_LINE,
) -> int:
    """Put a real line behind the faults of a bad one, until Ctrl-C.

    Your driver opens the port that is printed first, and talks through it to the modules at TARGET: a device such as
    `/dev/ttyUSB0`, or a URL such as `socket://192.168.1.5:4001`. Without `--fault`, every byte passes unchanged.

    Example: `i7000 proxy /dev/ttyUSB0 --baud 19200 --fault late=0.25:0.9@01 --view lines`

    * Faults are those of `i7000 simulate`. An answer is what the target sends until a frame is complete, or the line
      is silent for 50 ms; it goes to the driver that asked last.
    * A driver that sets baud rate or parity over RFC 2217 sets those of the target. A pseudo-terminal and TCP have
      none: give `--baud` and `--character-format`.
    * `--control` takes `fault late=0.1`, `fault off`, `fault` and `quit`, one a line, and answers each by a line that
      begins with `ok` or `error:`.
    * The lines of `--view lines` are times, `->` for requests and `<-` for answers, bytes, and faults in brackets.

    `--record` writes what arrives on either side, with the faults; `i7000 decode --file` reads it. If the disk is full,
    the recording stops, not the proxy.

    Exit code: 0 after `quit`, SIGTERM or SIGHUP; 2 for wrong usage; 3 if the target cannot be opened or is gone; 130
    after Ctrl-C.
    """
    from i7000.cli import proxying  # noqa: PLC0415 - what it needs may not be there
    from i7000.cli.faults import read_faults  # noqa: PLC0415

    if target.startswith("sim:"):
        raise UsageError("simulated modules have faults of their own: i7000 simulate --fault")
    proxied = proxying.Proxied(
        target,
        line.settings(),
        read_faults(fault),
        seed,
        place.has_pty,
        place.places(),
        view,
        control,
        recording,
    )
    return proxying.run(proxied, Printer())
