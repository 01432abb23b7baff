"""The fuzz targets by name: each a pure function of bytes that raises if a property does not hold.

Laws: only the errors of the library that its documentation names are caught, for decoders `DecodeError` alone. Nothing
is kept between two calls but caches.
"""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from fuzz import behaviour_targets, codec_targets, log_targets, stream_targets, value_targets

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
    "reading_text": Target(value_targets.reading_text, "dcon", 20),
    "reading_words": Target(value_targets.reading_words, "modbus", 64),
    "registers": Target(value_targets.registers, "modbus", 300),
    "dcon_split": Target(stream_targets.dcon_split, "dcon", 400),
    "modbus_split": Target(stream_targets.modbus_split, "modbus", 400),
    "device_step": Target(behaviour_targets.device_step, "both", 300),
    "bus_hear": Target(behaviour_targets.bus_hear, "both", 300),
    "host_receive": Target(behaviour_targets.host_receive, "both", 300),
    "log_find": Target(log_targets.log_find, "log", 300),
    "log_pieces": Target(log_targets.log_pieces_of, "log", 400),
    "stream_hear": Target(log_targets.stream_hear, "both", 200),
    "capture": Target(log_targets.capture, "capture", 1000),
    "recording": Target(log_targets.recording, "json", 1000),
    "snapshot": Target(log_targets.snapshot, "json", 2000),
}


def regressions(target: str) -> list[Path]:
    """Return the inputs that a target once failed on, and such as must never be lost."""
    return sorted(path for path in (FOLDER / "regressions" / target).glob("*") if path.is_file())
