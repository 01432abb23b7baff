"""The EEPROMs of the modules of a bus, in a file: JSON that people can read, compare and edit.

Shape: ``format``, ``version``, ``crc`` and ``modules``, one object for each `Eeprom`, with the names of its fields.
Values are written as in the manual: a model by its printed name; type codes, address, mask and logged words in hex; the
baud rate in bits per second; all other codes by name; numbers in counts of the module. A log with factory settings is
``null``.
Laws: a file is read exactly or not at all: no value is dropped, added, converted or guessed. `crc` detects changed
digits; it depends on the values, not on the layout of the file. To change a value, delete the ``crc`` line; the next
`save` writes it again. A rejected file is not changed. While a file is written it is the old or the new one, never a
part. `load` reads everything that `save` writes. Only one simulator uses a file at a time: `held`.
"""

import errno
import glob
import json
import os
import secrets
import stat
from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any
from zlib import crc32

from filelock import FileLock, Timeout

from i7000 import I7000Error
from i7000.device import Eeprom
from i7000.simulator.files import UnsuitableFileError, check_regular, open_regular
from i7000.simulator.memory_values import (
    FAULTS,
    Odd,
    WrongError,
    check_names,
    error_words,
    short,
    structured,
    unstructured,
)

__all__ = ["FORMAT", "VERSION", "MemoryFileError", "held", "load", "save"]

FORMAT = "i7000 modules"
VERSION = 1

_DIGITS = 20
"""More digits than any number in a file has."""
_MOST = 40_000_000
"""The maximum size of a file in bytes: 256 modules with full logs need less."""
_TOKEN = 8
"""The number of random bytes in the name of a temporary file."""


class MemoryFileError(I7000Error, ValueError):
    """The error for a file that does not contain the EEPROMs of modules, or is damaged.

    Shape: `path`; `place` in the file (``modules[0].address``, or a line and column); `reason`; `allowed`.
    """

    def __init__(self, path: str, place: str, reason: str, allowed: str) -> None:
        super().__init__(path, place, reason, allowed)
        self.path = path
        self.place = place
        self.reason = reason
        self.allowed = allowed

    def __str__(self) -> str:
        where = self.path if self.place == _FILE else f"{self.path}: {self.place}:"
        return f"{where} {self.reason}; allowed: {self.allowed}"


_FILE = "the file"
"""The place of a fault of the whole file."""


# --- read and write ---------------------------------------------------------------------------------------------------


@contextmanager
def held(path: str | os.PathLike[str]) -> Iterator[None]:
    """Lock a file against other simulators while this one uses it.

    Special: a hidden file beside it has the lock and stays there; the lock itself ends with the process. For a symbolic
        link, it is beside the target. A hard link is not locked: its first `save` makes it a separate file. Temporary
        files of an interrupted `save` are removed.
    Errors: `MemoryFileError` if another simulator uses the file; that or `OSError` if `save` could not replace it, and
        `OSError` if it cannot be locked.
    """
    target = Path(os.path.realpath(path))
    with ExitStack() as locked:
        with _named(path):
            _mode(path)
            target.parent.stat()  # A lock would make a directory that is not there.
            lock = target.with_name(f".{target.name}.lock")
            try:
                locked.enter_context(FileLock(lock, timeout=0))
            except Timeout:
                raise _unsuitable(path, "is used by another simulator", "one simulator for each file") from None
            except OSError as error:
                raise OSError(error.errno, f"cannot be locked by {lock.name} beside it: {error.strerror}") from None
            for left in target.parent.glob(f".{glob.escape(target.name)}.{'[0-9a-f]' * 2 * _TOKEN}.tmp"):
                left.unlink()
        yield


def load(path: str | os.PathLike[str]) -> tuple[Eeprom, ...]:
    """Read the EEPROMs of modules.

    Errors: `MemoryFileError` for a file that differs from what `save` writes; `OSError` if it cannot be read.
    """
    try:
        with open_regular(path, _MOST) as file:
            data = file.read(_MOST)
    except UnsuitableFileError as error:
        raise _unsuitable(path, error.reason, error.allowed) from None
    try:
        return _modules(_parsed(data))
    except FAULTS as error:
        raise MemoryFileError(os.fspath(path), *error_words(error)) from None


def save(path: str | os.PathLike[str], eeproms: Iterable[Eeprom]) -> None:
    """Write the EEPROMs of modules in one step: readers of the file find the old ones or the new ones.

    Special: for a symbolic link, the target is replaced. An existing file keeps its mode.
    Errors: `MemoryFileError` for values that `load` would refuse, and for a path that is not a file; `OSError` with
        `path`, also for a read-only file. The old file is then unchanged.
    """
    modules = unstructured(eeproms)
    try:
        structured(modules)
    except FAULTS as error:
        raise MemoryFileError(os.fspath(path), *error_words(error)) from None
    data = _text(modules).encode("ascii")
    if len(data) > _MOST:
        raise _unsuitable(path, f"would have {len(data)} bytes", f"{_MOST} bytes")
    with _named(path):
        _replace(Path(os.path.realpath(path)), data)


def _replace(target: Path, data: bytes) -> None:
    mode = _mode(target)
    temporary = target.with_name(f".{target.name}.{secrets.token_hex(_TOKEN)}.tmp")
    try:
        with temporary.open("xb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        if mode is not None:
            temporary.chmod(mode)
        temporary.replace(target)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
    with suppress(OSError):  # There are systems on which a directory cannot be opened.
        _sync(target.parent)


def _mode(path: str | os.PathLike[str]) -> int | None:
    """Return the mode of a file that may be replaced, or None if there is no file.

    Errors: `MemoryFileError` for devices and pipes; `OSError`, also for a file that is read-only.
    """
    try:
        status = Path(path).stat()
    except FileNotFoundError:
        return None
    try:
        check_regular(path, status)
    except UnsuitableFileError as error:
        raise _unsuitable(path, error.reason, error.allowed) from None
    mode = stat.S_IMODE(status.st_mode)
    if not mode & _WRITABLE or not os.access(path, os.W_OK):  # The superuser may write what nobody may.
        raise PermissionError(errno.EACCES, "the file is read-only", os.fspath(path))
    return mode


_WRITABLE = stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH


@contextmanager
def _named(path: str | os.PathLike[str]) -> Iterator[None]:
    """Raise system errors with the given path, not with that of a temporary file."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror, os.fspath(path)) from None


def _unsuitable(path: str | os.PathLike[str], reason: str, allowed: str) -> MemoryFileError:
    return MemoryFileError(os.fspath(path), _FILE, reason, allowed)


def _sync(directory: Path) -> None:
    descriptor = os.open(directory, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


# --- the text ---------------------------------------------------------------------------------------------------------

_ENCODER = json.JSONEncoder()


def _text(modules: list[Any]) -> str:
    return _laid_out({"format": FORMAT, "version": VERSION, "crc": _crc(modules), "modules": modules}, "\n") + "\n"


def _laid_out(value: Any, line: str) -> str:  # noqa: ANN401 - of any JSON
    """Return JSON with nested containers on several lines, and other values on one."""
    named = isinstance(value, dict)
    inner = value.values() if named else value if isinstance(value, list | tuple) else ()
    if not any(isinstance(one, dict | list | tuple) for one in inner):
        return _ENCODER.encode(value)
    deeper = line + "  "
    names = [f"{_ENCODER.encode(name)}: " for name in value] if named else [""] * len(value)
    parts = [name + _laid_out(one, deeper) for name, one in zip(names, inner, strict=True)]
    first, last = "{}" if named else "[]"
    return f"{first}{deeper}{f',{deeper}'.join(parts)}{line}{last}"


def _crc(modules: list[Any]) -> str:
    """Compute the CRC-32 of the modules, as JSON without blanks and with sorted names."""
    return f"{crc32(json.dumps(modules, sort_keys=True, separators=(',', ':')).encode()):08X}"


def _parsed(data: bytes) -> Any:  # noqa: ANN401 - any JSON
    try:
        return json.loads(data.decode("utf-8"), object_pairs_hook=_object, parse_int=_integer, parse_constant=Odd)
    except UnicodeDecodeError as error:
        raise WrongError(f"is {data[error.start]:02X}", "UTF-8", f"byte {error.start}") from None
    except json.JSONDecodeError as error:
        raise WrongError(
            f"is not JSON ({error.msg})", "a whole file", f"line {error.lineno} column {error.colno}"
        ) from None
    except RecursionError:
        raise WrongError("is nested too deep", "four levels") from None


def _object(pairs: list[tuple[str, Any]]) -> Any:  # noqa: ANN401 - a dict, or `Odd` for an invalid one
    found = dict(pairs)
    if len(found) < len(pairs):
        (name, _), *_ = Counter(name for name, _ in pairs).most_common(1)
        return Odd(f"an object that has {short(name)} twice")
    return found


def _integer(digits: str) -> Any:  # noqa: ANN401 - an int, or `Odd` for an invalid one
    return int(digits) if len(digits) <= _DIGITS else Odd(f"a number of {len(digits)} digits")


# --- the document -----------------------------------------------------------------------------------------------------


def _modules(document: Any) -> tuple[Eeprom, ...]:  # noqa: ANN401 - any JSON
    if not isinstance(document, dict):
        raise WrongError(f"cannot be {short(document)}", "an object")
    for name, value in (("format", FORMAT), ("version", VERSION)):
        if document.get(name) != value or isinstance(document[name], float | bool):
            raise WrongError(f"cannot be {short(document.get(name))}", f"{json.dumps(value)}, of this release", name)
    check_names(document, ("format", "version", "modules"), optional=("crc",))
    modules = structured(document["modules"])
    if "crc" in document:
        expected = _crc(document["modules"])
        if document["crc"] != expected:
            allowed = f"{expected}, which is that of the modules; or none, if they were changed on purpose"
            raise WrongError(f"cannot be {short(document['crc'])}", allowed, "crc")
    return modules
