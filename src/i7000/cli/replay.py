"""``i7000 replay``: the frames of a report, sent again."""

from typing import Annotated

from cyclopts import Parameter

from i7000.cli.harm import HARMLESS, HarmOptions
from i7000.cli.port import DEFAULT_ASKING, DEFAULT_LINE, AskOptions, LineOptions

__all__ = ["replay"]


def replay(  # noqa: PLR0913 - each of them is an option
    run: Annotated[str, Parameter(help="A file of i7000 check --report json=FILE.")],
    target: Annotated[str | None, Parameter(help="The port; that of the report unless given.")] = None,
    /,
    *,
    edited: Annotated[
        bool, Parameter(help="Also send a report that was changed after it was written.", negative="")
    ] = False,
    harm: HarmOptions = HARMLESS,
    line: LineOptions = DEFAULT_LINE,
    asking: AskOptions = DEFAULT_ASKING,
) -> int:
    """Send the frames of a report of `i7000 check` again, and compare the answers.

    The module must be that of the report: model, name, address and protocol are compared first. Every frame passes the
    guard: unless you allow more, a report with frames that change something is sent up to the first of them. With
    `--allow`, the settings of before are in a file (`--snapshot`); they are restored and compared at the end.

    The run is repeated as it was: at its line settings unless you give others, with its pauses, and with the changes of
    the line settings and of the power that it made. If the port cannot switch the power, the run ends there.

    The bytes of all answers must be those of the report. Only digits, signs and points of readings may differ, and the
    checksum or CRC with them: in the answers to `#AA`, `#AAN`, `$AAA`, `$AA4` and `$AA3`, and in those to functions 03
    and 04 that read nothing but analog inputs and temperatures. A reading has as many characters as in the report.

    Example: `i7000 replay run.jsonl sim:M-7019R`

    Exit code: 0 if all answers are those of the report, 1 if some are not; 2 for wrong usage, another module, an edited
    report, a frame that is not allowed or power that cannot be switched; 3 if the port cannot be opened or is lost, or
    the module does not answer; 5 if the report has no frames; 6 if the module was left changed; 130 after Ctrl-C.
    """
    from i7000.cli.replaying import Wishes  # noqa: PLC0415 - it takes time
    from i7000.cli.replaying import run as carry_out  # noqa: PLC0415 - it takes time

    wishes = Wishes(file=run, target=target, harm=harm, edited=edited)
    return carry_out(wishes, line, asking)
