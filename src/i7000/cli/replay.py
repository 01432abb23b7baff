"""``i7000 replay``: the frames of a report, sent again."""

from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from i7000.cli.asked import DEFAULT_ONE, asked_of
from i7000.cli.options import UNKNOWN, Texts
from i7000.cli.port import DEFAULT_ASKING, DEFAULT_LINE, AskOptions, LineOptions
from i7000.cli.text import Printer
from i7000.cli.words import UsageError

if TYPE_CHECKING:
    from i7000.conformance.replay import Replayed

__all__ = ["replay"]

_NOTHING_RAN = 5


def replay(  # noqa: PLR0913 - each of them is an option
    run: Annotated[str, Parameter(help="A file of i7000 check --report json=FILE.")],
    target: Annotated[str | None, Parameter(help="The port; that of the report unless given.")] = None,
    /,
    *,
    allow: Annotated[
        Texts, Parameter(help="Also send what could do harm: write, broadcast, comm or calibration; repeat it.")
    ] = (),
    timeout_scale: Annotated[float, Parameter(help="Multiply all times to listen: 0.1 to 100.")] = 1.0,
    line: LineOptions = DEFAULT_LINE,
    asking: AskOptions = DEFAULT_ASKING,
) -> int:
    """Send the frames of a report of `i7000 check` again, and compare the answers.

    Every frame passes the guard: unless you allow more, a report with frames that change something is sent up to the
    first of them. The values of readings may differ; all other bytes are those of the report.

    Example: `i7000 replay run.jsonl sim:M-7019R`

    Exit code: 0 if all answers are those of the report, 1 if some are not; 2 for wrong usage or a frame that is not
    allowed; 3 if the port cannot be opened or is lost, 5 if the report has no frames, 130 after Ctrl-C.
    """
    from i7000.cli.check_options import allowed_of  # noqa: PLC0415 - it takes time
    from i7000.cli.reached import OpenLine  # noqa: PLC0415 - it takes time
    from i7000.cli.reached import run as at_port  # noqa: PLC0415 - it takes time
    from i7000.cli.report_files import read_lines  # noqa: PLC0415 - it takes time
    from i7000.conformance import GuardError  # noqa: PLC0415 - it takes time
    from i7000.conformance.replay import replay as replaying  # noqa: PLC0415 - it takes time
    from i7000.conformance.report import ReportError, read_report  # noqa: PLC0415 - it takes time
    from i7000.link.guarded import GuardedPort  # noqa: PLC0415 - it takes time

    if not 0.1 <= timeout_scale <= 100:
        raise UsageError(f"--timeout-scale {timeout_scale:g}: give 0.1 to 100")
    try:
        report = read_report(read_lines(run))
    except (ReportError, ValueError) as error:
        raise UsageError(f"{run}: {error}") from None
    printer = Printer()
    results: list[Replayed] = []

    def tell(told: object) -> None:
        result: Replayed = told  # type: ignore[assignment] # it tells nothing else
        results.append(result)
        if not result.is_same:
            printer.lines([[(result.check, "cyan")], *_lines(result)])
            printer.flush()

    def body(open_line: OpenLine) -> int:
        try:
            with open_line.ending.breakable():
                open_line.line.run(replaying(report, timeout_scale=timeout_scale), tell)
        except GuardError as error:
            raise UsageError(error) from None
        different = sum(not result.is_same for result in results)
        printer.lines([[(f"{len(results) - different} of {len(results)} answers are those of the report", "bold")]])
        if not results:
            return _NOTHING_RAN
        return 1 if different else 0

    asked = asked_of(target or str(report.start.get("target")), line, asking, DEFAULT_ONE, UNKNOWN)
    allowed = allowed_of(allow)
    return at_port(asked, body, guard=lambda port: GuardedPort(port, allowed))


def _lines(result: "Replayed") -> list[list[tuple[str, str]]]:
    rows = [*(("sent", wire) for wire in result.sent), ("recorded", result.recorded), ("received", result.received)]
    return [[(f"    {name:9}", "dim"), (wire.hex(" ") or "nothing", "")] for name, wire in rows]
