"""Files that a recording goes to. What is recorded never waits for them to be read, and never fails with them.

Laws: a file is created, never overwritten. If it cannot be written any more, as on a full disk, that is reported once,
and what follows is not recorded. Each record is written when it comes, so that a killed program loses none.
"""

import os
from collections.abc import Callable
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Self

from i7000 import __version__
from i7000.dissect.stream import looks_like
from i7000.recording import pcapng
from i7000.recording.records import Carried, End, Record, Start, text

__all__ = ["Capture", "Recorder"]


class _File:
    """A new file that is written until it fails."""

    def __init__(self, path: str | os.PathLike[str], report: Callable[[str], object]) -> None:
        self._path = os.fspath(path)
        self._report = report
        self._file = Path(self._path).open("xb", buffering=0)  # noqa: SIM115 - `close` closes it
        self.failed = False

    def write(self, data: bytes) -> None:
        """Write data whole, or report why that is not possible."""
        if self.failed or self._file.closed:
            return
        try:
            while data:
                data = data[self._file.write(data) :]
        except OSError as error:
            self.failed = True
            self._report(f"{self._path}: {error.strerror}: nothing more is recorded")

    def close(self) -> None:
        """Close the file."""
        with suppress(OSError):
            self._file.close()


class Recorder:
    """A recording as JSON lines. Use it as a context manager, so that it gets its end."""

    def __init__(
        self,
        path: str | os.PathLike[str],
        *,
        program: str,
        target: str,
        began: float,
        report: Callable[[str], object],
    ) -> None:
        """Create the file, and write its first line.

        Shape: `began` is the date and time of second 0, in seconds since 1970; `report` is called with what makes the
            recording fail.
        Errors: `OSError` if the file cannot be created, and `FileExistsError` if it exists.
        """
        self._file = _File(path, report)
        self._last = 0.0
        time = datetime.fromtimestamp(began, UTC).isoformat(timespec="microseconds")
        self.write(Start(time, program, __version__, target))

    def write(self, record: Record) -> None:
        """Write a record."""
        if not isinstance(record, Start):
            self._last = record.seconds
        self._file.write(f"{text(record)}\n".encode())

    def __enter__(self) -> Self:
        """Return the recorder."""
        return self

    def __exit__(self, *_: object) -> None:
        """Write the last line, and close the file."""
        self.write(End(self._last))
        self._file.close()


class Capture:
    """A recording as a capture file (pcapng)."""

    def __init__(self, path: str | os.PathLike[str], *, began: float, report: Callable[[str], object]) -> None:
        """Create the file; as for `Recorder`."""
        self._file = _File(path, report)
        self._began = began
        self._file.write(pcapng.header(f"i7000 {__version__}"))

    def write(self, carried: Carried) -> None:
        """Write bytes; those of an unknown protocol go to the interface of the protocol that they resemble."""
        protocol = looks_like(carried.wire) if carried.protocol is None else carried.protocol
        time = self._began + carried.seconds
        self._file.write(pcapng.packet(time, carried.wire, protocol, sent=carried.sent, notes=carried.notes))

    def __enter__(self) -> Self:
        """Return the capture."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close the file."""
        self._file.close()
