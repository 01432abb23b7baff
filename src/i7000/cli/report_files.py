"""The files that are made of a report when it is complete."""

from collections.abc import Callable, Mapping
from datetime import datetime
from pathlib import Path

from i7000 import __version__
from i7000.conformance.exports import junit, pytest_file
from i7000.conformance.html import page
from i7000.conformance.report import read_report
from i7000.dissect.stream import looks_like
from i7000.recording import pcapng

__all__ = ["KINDS", "LARGEST_REPORT", "MADE", "read_lines", "write_report"]

LARGEST_REPORT = 1 << 28
"""The bytes of the largest report that is read."""


def write_report(lines: list[str], kind: str, path: str) -> None:
    """Write a file of a kind, made of the lines of a report.

    Errors: `OSError`; `ReportError` for lines that are not a report.
    """
    Path(path).write_bytes(MADE[kind](lines))


def _page(lines: list[str]) -> bytes:
    return page(read_report(lines)).encode("utf-8", "backslashreplace")


def _junit(lines: list[str]) -> bytes:
    return junit(read_report(lines)).encode("utf-8", "backslashreplace")


def _pytest(lines: list[str]) -> bytes:
    return pytest_file(read_report(lines)).encode("utf-8", "backslashreplace")


def _capture(lines: list[str]) -> bytes:
    """Return a capture of all that was on the line."""
    report = read_report(lines)
    try:
        began = datetime.fromisoformat(str(report.start.get("time"))).timestamp()
    except ValueError:
        began = 0.0
    parts = [pcapng.header(f"i7000 {__version__}")]
    for check in report.checks:
        for frame in check.frames:
            time = max(0.0, began + frame.seconds)
            parts.append(pcapng.packet(time, frame.wire, looks_like(frame.wire), sent=frame.sent, notes=(check.id,)))
    return b"".join(parts)


MADE: Mapping[str, Callable[[list[str]], bytes]] = {
    "html": _page,
    "junit": _junit,
    "pytest": _pytest,
    "pcap": _capture,
}
"""The kinds that are made at the end."""
KINDS = ("json", *MADE)
"""All kinds of reports."""


def read_lines(path: str) -> list[str]:
    """Return the lines of a report file.

    Errors: `OSError`; `ValueError` for a file that is too large.
    """
    with Path(path).open("rb") as file:
        data = file.read(LARGEST_REPORT + 1)
    if len(data) > LARGEST_REPORT:
        raise ValueError(f"{path}: more than {LARGEST_REPORT} bytes: this is not a report")
    return data.decode("utf-8", "surrogateescape").splitlines()
