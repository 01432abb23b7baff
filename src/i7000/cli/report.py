"""``i7000 report``: a report of ``i7000 check`` shown, verified, and made into other files."""

from typing import Annotated

from cyclopts import Parameter

from i7000.cli.text import Line, Printer
from i7000.cli.words import UsageError

__all__ = ["report"]


def report(  # noqa: PLR0913 - each of them is an option
    run: Annotated[str, Parameter(help="A file of i7000 check --report json=FILE.")],
    /,
    *,
    verify: Annotated[
        bool, Parameter(help="Fail unless the report is complete and as it was written.", negative="")
    ] = False,
    html: Annotated[str | None, Parameter(help="Write a page for a browser.")] = None,
    junit: Annotated[str | None, Parameter(help="Write XML for CI servers.")] = None,
    pytest: Annotated[str | None, Parameter(help="Write a test file that repeats what did not pass.")] = None,
    pcap: Annotated[str | None, Parameter(help="Write all traffic for Wireshark (pcapng).")] = None,
) -> int:
    """Show what a report of `i7000 check` says, and make other files of it.

    The digest at the end of a report is that of all lines before it: `--verify` says whether it is still as it was
    written.

    Example: `i7000 report run.jsonl --html module.html`

    Exit code: 0 if it could be read; with `--verify`, 1 if it is incomplete or was changed; 2 for a file that is not a
    report.
    """
    from i7000.cli.report_files import read_lines, write_report  # noqa: PLC0415 - it takes time
    from i7000.conformance.report import ReportError, read_report  # noqa: PLC0415 - it takes time

    printer = Printer()
    try:
        lines = read_lines(run)
        found = read_report(lines)
    except (ReportError, ValueError) as error:
        raise UsageError(f"{run}: {error}") from None
    for kind, path in (("html", html), ("junit", junit), ("pytest", pytest), ("pcap", pcap)):
        if path is not None:
            write_report(lines, kind, path)
    shown: list[Line] = [[(f"{found.module.get('model')} at {found.start.get('target')}", "bold")]]
    shown += [[(f"{check.verdict:14}", ""), (f" {check.id}  ", "cyan"), (str(check["text"]), "")] for check in
              found.checks if check["text"] and check["reason"] is None]  # fmt: skip
    counts = (found.end or {}).get("counts")
    words = ", ".join(f"{count} {verdict}" for verdict, count in counts.items()) if isinstance(counts, dict) else ""
    printer.lines([*shown, [(words, "bold")]] if words else shown)
    for problem in found.problems:
        printer.error(problem)
    return 1 if verify and found.problems else 0
