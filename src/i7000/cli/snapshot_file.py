"""Files with snapshots: written whole or not at all, and read with a limit.

Laws: a file is created, never overwritten.
"""

import os
import sys
from io import BufferedReader
from pathlib import Path
from secrets import token_hex

from i7000 import InvalidValueError
from i7000.cli.words import UsageError
from i7000.host.procedures import Snapshot

__all__ = ["check_new", "read_snapshot", "write_new"]

_LONGEST = 1 << 20
"""The bytes of the largest file that is read: more than ten times what a snapshot can have."""


def read_snapshot(path: str) -> Snapshot:
    """Read a snapshot from a file, or from standard input for ``-``.

    Errors: `UsageError` for a file that is not a snapshot, `OSError` for a file that cannot be read.
    """
    if path == "-":
        if sys.stdin is None:
            raise UsageError("-: there is no standard input")
        data = _limited(sys.stdin.buffer)  # type: ignore[arg-type] # it is a reader
    else:
        with Path(path).open("rb") as file:
            data = _limited(file)
    if len(data) > _LONGEST:
        raise UsageError(f"{path}: more than {_LONGEST} bytes: this is not a snapshot")
    try:
        return Snapshot.from_json(data)
    except InvalidValueError as error:
        words = f"{error.reason}; give a file of i7000 backup" if error.field == "json" else error
        raise UsageError(f"{path}: {words}") from None


def _limited(file: BufferedReader) -> bytes:
    return file.read(_LONGEST + 1)


def check_new(path: str) -> None:
    """Raise `UsageError` if a file cannot be created because it exists, or its folder does not."""
    if os.path.lexists(path):
        raise UsageError(_EXISTS.format(path))
    if not Path(path).parent.is_dir():
        raise UsageError(f"{path}: there is no folder {Path(path).parent}")


def write_new(path: str, text: str) -> None:
    """Create a file with a text; a file that exists is left as it is.

    Special: the text is written to a file beside it first, so that a file of this name is always whole.
    Errors: `UsageError` if the file exists, `OSError` if it cannot be written.
    """
    target = Path(path)
    temporary = target.with_name(f".{target.name}.{token_hex(4)}")
    try:
        with temporary.open("x", encoding="ascii") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        _give_name(temporary, target)
    except FileExistsError:
        raise UsageError(_EXISTS.format(path)) from None
    finally:
        temporary.unlink(missing_ok=True)


def _give_name(temporary: Path, target: Path) -> None:
    """Give a complete file its name, unless there is a file of this name."""
    try:
        os.link(temporary, target)
    except FileExistsError:
        raise
    except OSError:  # a file system without hard links
        target.open("xb").close()
        temporary.replace(target)


_EXISTS = "{} exists: give the name of a new file"
