"""The EEPROMs of the modules of a bus, in a file: JSON that people can read, compare and edit.

Shape: ``format``, ``version``, ``crc`` and ``modules``, one object an `Eeprom`, with the names of its fields. Values
are those that a person finds elsewhere: a model by its printed name; type codes, address, mask and logged words in hex,
as the manual and the frames have them; the baud rate in bits per second; all other codes by name; numbers as the module
counts them. A log that is as it comes from the factory is ``null``.
Laws: a file is read as it is meant or not at all: nothing is left out, added, converted or guessed. `crc` finds a digit
that turned into another; it goes by the values, not by how they are laid out. Who changes a value on purpose deletes
that line, and the next `save` writes it anew. A file that is refused is not touched, and one that is written is the old
one or the new one at any moment, never a part. What `save` writes, `load` reads. Simulators
take turns with a file: `held`.
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
from i7000.simulator.memory_values import FAULTS, Odd, WrongError, check_names, short, structured, told, unstructured

__all__ = ["FORMAT", "VERSION", "MemoryFileError", "held", "load", "save"]

FORMAT = "i7000 modules"
VERSION = 1

_DIGITS = 20
"""More than any number in a file has."""
_MOST = 40_000_000
"""Bytes of a file: 256 modules with full logs have less."""
_TOKEN = 8
"""Random bytes in the name of a temporary file."""


class MemoryFileError(I7000Error, ValueError):
    """A file that does not hold the EEPROMs of modules, or is damaged.

    Shape: `path`; `place` in the file (``modules[0].address``, or a line and column); `reason`; `allowed`.
    """

    def __init__(self, path: str, place: str, reason: str, allowed: str) -> None:
        super().__init__(path, place, reason, allowed)
        self.path = path
        self.place = place
        self.reason = reason
        self.allowed = allowed

    def __str__(self) -> str:
        return f"{self.path}: {self.place}: {self.reason}; allowed: {self.allowed}"


# --- read and write ---------------------------------------------------------------------------------------------------


@contextmanager
def held(path: str | os.PathLike[str]) -> Iterator[None]:
    """Keep other simulators from a file for as long as this one uses it.

    Special: a hidden file beside it carries the lock and stays there; the lock itself ends with the process. It is
        beside the file that a symbolic link names. A hard link is not locked: its first `save` makes it a file of its
        own. Temporary files that an interrupted `save` has left are removed.
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
                raise _unsuitable(path, "is used by another simulator", "one simulator a file") from None
            except OSError as error:
                raise OSError(error.errno, f"cannot be locked by {lock.name} beside it: {error.strerror}") from None
            for left in target.parent.glob(f".{glob.escape(target.name)}.{'[0-9a-f]' * 2 * _TOKEN}.tmp"):
                left.unlink()
        yield


def load(path: str | os.PathLike[str]) -> tuple[Eeprom, ...]:
    """Read the EEPROMs of modules.

    Errors: `MemoryFileError` for a file that is not as `save` writes them; `OSError` if it cannot be read.
    """
    try:
        with open_regular(path, _MOST) as file:
            data = file.read(_MOST)
    except UnsuitableFileError as error:
        raise _unsuitable(path, error.reason, error.allowed) from None
    try:
        return _modules(_parsed(data))
    except FAULTS as error:
        raise MemoryFileError(os.fspath(path), *told(error)) from None


def save(path: str | os.PathLike[str], eeproms: Iterable[Eeprom]) -> None:
    """Write the EEPROMs of modules, all at once: whoever reads the file finds the old ones or the new ones.

    Special: what a symbolic link names is replaced, not the link. The mode of a file that exists is kept.
    Errors: `MemoryFileError` for what `load` would refuse, and for what is no file; `OSError` that names `path`, also
        for a read-only file. The old file stays as it was then.
    """
    modules = unstructured(eeproms)
    try:
        structured(modules)
    except FAULTS as error:
        raise MemoryFileError(os.fspath(path), *told(error)) from None
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
    """Raise errors of the system with the path that was given, not with that of a temporary file."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror, os.fspath(path)) from None


def _unsuitable(path: str | os.PathLike[str], reason: str, allowed: str) -> MemoryFileError:
    return MemoryFileError(os.fspath(path), "the file itself", reason, allowed)


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
    """Write what has containers in it on several lines, and all else on one."""
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
    """Compute the CRC-32 of what the modules hold, as JSON without blanks and with sorted names."""
    return f"{crc32(json.dumps(modules, sort_keys=True, separators=(',', ':')).encode()):08X}"


def _parsed(data: bytes) -> Any:  # noqa: ANN401 - any JSON
    try:
        return json.loads(data.decode("utf-8"), object_pairs_hook=_object, parse_int=_integer, parse_constant=Odd)
    except UnicodeDecodeError as error:
        raise WrongError(f"is byte {data[error.start]:02X}", "UTF-8", f"byte {error.start}") from None
    except json.JSONDecodeError as error:
        raise WrongError(
            f"is no JSON ({error.msg})", "a whole file", f"line {error.lineno} column {error.colno}"
        ) from None
    except RecursionError:
        raise WrongError("is nested too deep", "four levels") from None


def _object(pairs: list[tuple[str, Any]]) -> Any:  # noqa: ANN401 - a dict, or what stands for none
    found = dict(pairs)
    if len(found) < len(pairs):
        (name, _), *_ = Counter(name for name, _ in pairs).most_common(1)
        return Odd(f"an object that has {short(name)} twice")
    return found


def _integer(digits: str) -> Any:  # noqa: ANN401 - an int, or what stands for none
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
