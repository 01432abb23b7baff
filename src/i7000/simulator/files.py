"""Functions that open the files that a user names: only regular files, of limited size.

Laws: no function waits for a pipe, or reads an endless device.
"""

import errno
import os
import stat
from contextlib import ExitStack
from pathlib import Path
from typing import BinaryIO

from i7000.errors import I7000Error

__all__ = ["UnsuitableFileError", "check_regular", "open_regular"]

_MEGABYTE = 1_000_000
_OPENING = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0)
"""Flags that make opening a pipe or terminal harmless, if one replaced the file; Windows has no such flags."""


class UnsuitableFileError(I7000Error, ValueError):
    """A path that does not lead to a regular file of a suitable size.

    Shape: `path`; `reason`; `allowed`.
    """

    def __init__(self, path: str, reason: str, allowed: str) -> None:
        super().__init__(path, reason, allowed)
        self.path = path
        self.reason = reason
        self.allowed = allowed

    def __str__(self) -> str:
        return f"{self.path} {self.reason}; allowed: {self.allowed}"


def check_regular(path: str | os.PathLike[str], status: os.stat_result) -> None:
    """Raise an error unless `status`, the status of the file at `path`, is that of a regular file.

    Errors: `UnsuitableFileError`; `IsADirectoryError`.
    """
    if stat.S_ISDIR(status.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), os.fspath(path))
    if not stat.S_ISREG(status.st_mode):
        raise UnsuitableFileError(os.fspath(path), "is a device or pipe", "a regular file")


def open_regular(path: str | os.PathLike[str], most: int) -> BinaryIO:
    """Open a regular file of 1 to `most` bytes.

    Errors: `UnsuitableFileError`, before anything is read; `OSError`.
    """
    _check(path, Path(path).stat(), most)  # before it is opened: opening a device can already have an effect
    with ExitStack() as opened:
        file = opened.enter_context(open(path, "rb", opener=lambda name, flags: os.open(name, flags | _OPENING)))
        _check(path, os.fstat(file.fileno()), most)
        opened.pop_all()
    return file


def _check(path: str | os.PathLike[str], status: os.stat_result, most: int) -> None:
    check_regular(path, status)
    if not status.st_size:
        raise UnsuitableFileError(os.fspath(path), "is empty", "a file with contents")
    if status.st_size > most:
        reason = f"has {status.st_size / _MEGABYTE:.0f} MB"
        raise UnsuitableFileError(os.fspath(path), reason, f"{most / _MEGABYTE:g} MB")
