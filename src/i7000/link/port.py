"""What a line needs of a port, and the blocking calls of it.

Laws: whatever a port raises comes out as one `LinkError`. pyserial raises many kinds for a port that is gone.
"""

from collections.abc import Callable
from contextlib import suppress
from time import monotonic
from typing import Any, Protocol

from i7000.errors import I7000Error, InvalidValueError
from i7000.link.errors import LinkError
from i7000.settings import BaudRate, LineSettings

__all__ = ["Port", "clock_of", "close", "named", "power_cycle", "read", "settings_of", "tune", "write"]

_LONGEST = 3600.0
"""The longest time in seconds of one read: systems do not take any time."""


class Port(Protocol):
    """The methods and attributes of `serial.Serial` that a line uses."""

    @property
    def timeout(self) -> float | None:
        """The seconds that a read waits; None is for ever."""

    @timeout.setter
    def timeout(self, seconds: float | None, /) -> None: ...

    @property
    def baudrate(self) -> int:
        """The bits per second."""

    @baudrate.setter
    def baudrate(self, rate: int, /) -> None: ...

    @property
    def parity(self) -> str:
        """The parity: ``N``, ``E`` or ``O``."""

    @parity.setter
    def parity(self, parity: str, /) -> None: ...

    @property
    def stopbits(self) -> float:
        """The number of stop bits: 1 or 2."""

    @stopbits.setter
    def stopbits(self, count: int, /) -> None: ...

    @property
    def in_waiting(self) -> int:
        """The number of bytes that can be read now; fewer is harmless."""

    def read(self, size: int, /) -> bytes:
        """Return `size` bytes, or fewer after `timeout`."""

    def write(self, data: bytes, /) -> int | None:
        """Send bytes."""

    def close(self) -> None:
        """Close the port."""


def named(port: Port) -> str:
    """Return the name of a port for messages."""
    return getattr(port, "name", None) or type(port).__name__


def clock_of(port: Port) -> Callable[[], float]:
    """Return the clock of a port that has its own time, or else that of this machine."""
    clock: Callable[[], float] = getattr(port, "now", monotonic)
    return clock


def settings_of(line: LineSettings) -> dict[str, Any]:
    """Return the settings of a port of pyserial.

    Errors: `InvalidValueError` for an undefined baud rate.

    >>> settings_of(LineSettings())
    {'baudrate': 9600, 'parity': 'N', 'stopbits': 1}
    """
    if not isinstance(line.baud_rate, BaudRate):
        raise InvalidValueError("baud_rate", f"{line.baud_rate:02X}", "03..0A", "1.11")
    form = line.character_format
    return {"baudrate": line.baud_rate.bits_per_second, "parity": form.parity, "stopbits": form.stop_bits}


def read(port: Port, seconds: float) -> bytes:
    """Return all bytes that a port has, as soon as there are any; none after so many seconds, or after an hour.

    Errors: `LinkError`.
    """
    seconds = min(seconds, _LONGEST)
    try:
        if port.timeout != seconds:
            port.timeout = seconds
        heard = port.read(1)
        return heard + port.read(port.in_waiting) if heard else heard
    except I7000Error:
        raise
    except Exception as error:
        raise _lost(port, error) from error


def write(port: Port, wire: bytes) -> None:
    """Send bytes.

    Errors: `LinkError`; those of this package that a port raises pass.
    """
    try:
        count = port.write(wire)
    except I7000Error:
        raise
    except Exception as error:
        raise _lost(port, error) from error
    if count is not None and count < len(wire):
        raise LinkError(f"{named(port)}: only {count} of {len(wire)} bytes could be sent")


def tune(port: Port, line: LineSettings) -> None:
    """Set the baud rate and the character format; a setting that a port has already is left alone.

    Errors: `LinkError`.
    """
    settings = settings_of(line)
    try:
        for name, value in settings.items():
            if getattr(port, name) != value:
                setattr(port, name, value)
    except Exception as error:
        raise _lost(port, error, f"cannot be set to {settings['baudrate']} {line.character_format.name}") from error


def power_cycle(port: Port, *, init_switch: bool) -> bool:
    """Switch the power of the modules at a port off and on; return False if the port cannot do that.

    Errors: `LinkError`.
    """
    switch: Callable[..., object] | None = getattr(port, "power_cycle", None)
    if switch is None:
        return False
    try:
        switch(init_switch=init_switch)
    except I7000Error:
        raise
    except Exception as error:
        raise _lost(port, error) from error
    return True


def close(port: Port) -> None:
    """Close a port, which may be lost."""
    with suppress(Exception):
        port.close()


def _lost(port: Port, error: Exception, reason: str = "is lost") -> LinkError:
    if not getattr(port, "is_open", True):
        return LinkError(f"{named(port)}: the port is closed")
    cause = _UNPLUGGED if _NO_DATA in str(error) else error
    return LinkError(f"{named(port)}: the port {reason}: {cause}")


_NO_DATA = "readiness to read but returned no data"
"""What pyserial raises for a device that is gone."""
_UNPLUGGED = "the device was unplugged or has ended, or another program reads it too"
