"""The fuzz targets by name: each a pure function of bytes that raises if a property does not hold.

Laws: only the errors of the library that its documentation names are caught, for decoders `DecodeError` alone. Nothing
is kept between two calls but caches.
"""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from fuzz import codec_targets

__all__ = ["FOLDER", "TARGETS", "Target", "regressions"]

FOLDER = Path(__file__).parent


class Target(NamedTuple):
    """A target, and what a fuzzer needs to run it."""

    run: Callable[[bytes], None]
    dictionary: str
    """The name of a file in ``dictionaries``, without its suffix."""
    longest: int
    """The bytes of the longest input."""


TARGETS = {
    "dcon_command": Target(codec_targets.dcon_command, "dcon", 300),
    "dcon_response": Target(codec_targets.dcon_response, "dcon", 300),
    "modbus_request": Target(codec_targets.modbus_request, "modbus", 300),
    "modbus_response": Target(codec_targets.modbus_response, "modbus", 300),
}


def regressions(target: str) -> list[Path]:
    """Return the inputs that a target once failed on, and such as must never be lost."""
    return sorted(path for path in (FOLDER / "regressions" / target).glob("*") if path.is_file())
