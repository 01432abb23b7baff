"""One request and what the line has to know of it, the same for both protocols.

Laws: what depends on the protocol is here, what depends on time is in `i7000.host.bus`.
"""

from typing import Any, Generic, TypeVar

from i7000 import dcon, modbus
from i7000.errors import Fault, Noise
from i7000.frozen import frozen
from i7000.host.events import Answered, AnyCommand, Declined
from i7000.profile import Profile

__all__ = ["Exchange", "answers", "finish", "split"]

R = TypeVar("R")

_BROADCAST_PAUSE = 0.002
_FACTORY_CALIBRATION = 271
"""The coil 00272."""
_FACTORY_CALIBRATION_PAUSE = 3.0
_ENVELOPE = len("A") + len("CC")
_EXCEPTION = len("FE") + _ENVELOPE


@frozen
class Exchange(Generic[R]):
    """A command and the profile of the module it is for, R being the response of the command."""

    command: AnyCommand
    profile: Profile
    wire: bytes
    """The frame of the command."""

    @classmethod
    def of(cls, command: AnyCommand, profile: Profile) -> "Exchange[R]":
        """Write the frame.

        Errors: `EncodeError` of the codec.
        """
        if isinstance(command, modbus.Request):
            return cls(command, profile, modbus.encode(command, profile))
        return cls(command, profile, dcon.encode(command, profile))

    @property
    def rtu(self) -> bool:
        """Whether silence is what separates its frames."""
        return isinstance(self.command, modbus.Request)

    @property
    def answered(self) -> bool:
        """Whether it is for one module."""
        if isinstance(self.command, modbus.Request):
            return modbus.is_answered(self.command)
        return isinstance(self.command, dcon.Command)

    @property
    def longest_response(self) -> int:
        """Bytes of the longest answer, a refusal or exception included; 0 if there is none."""
        if isinstance(self.command, modbus.Request):
            return _longest_response(self.command, self.profile) if self.answered else 0
        return dcon.longest_response(self.command, self.profile)

    @property
    def pause(self) -> float:
        """Seconds that the module is to be left alone after the request.

        Time: 2 ms after a broadcast; 3 s for the calibration of the factory; 16 s for old calibrations.
        Manual: 2.2, 2.8, 2.9, 2.28, 2.35, 3.4.8, 3.4.9; E103.
        """
        if not isinstance(self.command, modbus.Request):
            return dcon.pause_after(self.command, self.profile)
        if _loads_factory_calibration(self.command):
            return _FACTORY_CALIBRATION_PAUSE
        return 0.0 if self.answered else _BROADCAST_PAUSE

    def read(self, frame: bytes) -> Answered[R] | Declined:
        """Read a frame as the answer.

        Errors: `DecodeError` if it is none.
        """
        command: Any = self.command
        response: Any = (modbus if self.rtu else dcon).decode_response(frame, command, self.profile)
        if isinstance(response, dcon.Refused | modbus.ExceptionResponse):
            return Declined(self.command, response)
        return Answered(self.command, response)


def _longest_response(request: modbus.Request[Any], profile: Profile) -> int:
    layout = request.response.layout
    tail = {
        "mask": profile.mask_digits // 2,
        "words": 2 * getattr(request, "count", 0),
        "bits": getattr(request, "count", 0) + 7 >> 3,
    }.get(layout.tail, 0)
    return max(layout.fixed + tail + len("CC"), _EXCEPTION)


def _loads_factory_calibration(request: modbus.Request[Any]) -> bool:
    if isinstance(request, modbus.WriteSingleCoil):
        return request.coil == _FACTORY_CALIBRATION and request.value
    if isinstance(request, modbus.WriteMultipleCoils):
        at = _FACTORY_CALIBRATION - request.start
        return 0 <= at < len(request.values) and request.values[at]
    return False


Found = tuple[bytes | Noise, ...]
"""Frames and noise."""


def split(last: Exchange[Any] | None, heard: bytes, *, echo: bool) -> tuple[Found, bytes]:
    """Split what was heard into whole frames, noise and the rest that may still become a frame.

    Shape: in the protocol of the last request, since only a module that was asked says something.
    """
    if last is not None and last.rtu:
        return modbus.split(heard, _side(echo=echo), last.profile)
    return dcon.split(heard, checksum=last is not None and last.profile.checksum)


def answers(pending: Exchange[Any], rest: bytes) -> tuple[Found, bytes]:
    """Find whole answers to an open request in a rest; if there are none, all of it is still the rest."""
    if not pending.rtu or not pending.answered:
        return (), rest
    command: Any = pending.command
    found, after = modbus.split(rest, modbus.Side.RESPONSES, pending.profile, request=command)
    return ((), rest) if all(isinstance(part, Noise) for part in found) else (found, after)


def finish(last: Exchange[Any], rest: bytes, *, echo: bool) -> Found:
    """Split a rest that is waited for no longer: what is not finished is noise."""
    if last.rtu:
        return modbus.flush(rest, _side(echo=echo), last.profile)
    return (Noise(rest, Fault.TERMINATOR),) if rest else ()


def _side(*, echo: bool) -> modbus.Side:
    return modbus.Side.BOTH if echo else modbus.Side.RESPONSES
