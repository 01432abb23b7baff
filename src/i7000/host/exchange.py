"""A request with all that the line needs for it; the same for both protocols.

Laws: protocol differences are here, timing is in `i7000.host.bus`.
"""

from typing import Any, Generic, TypeVar

from i7000 import dcon, modbus
from i7000.errors import Fault, Noise
from i7000.frozen import frozen
from i7000.host.events import Answered, AnyCommand, Declined
from i7000.profile import Profile

__all__ = ["Exchange", "answers", "finish", "split"]

R = TypeVar("R")


@frozen
class Exchange(Generic[R]):
    """A command and the profile of its module; R is the type of the response."""

    command: AnyCommand
    profile: Profile
    wire: bytes
    """The frame of the command."""

    @classmethod
    def of(cls, command: AnyCommand, profile: Profile) -> "Exchange[R]":
        """Encode the command.

        Errors: `EncodeError` of the codec.
        """
        return cls(command, profile, _codec(command).encode(command, profile))

    @property
    def rtu(self) -> bool:
        """Whether silence separates the frames of its protocol."""
        return isinstance(self.command, modbus.Request)

    @property
    def answered(self) -> bool:
        """Whether a module answers it."""
        answered: bool = _codec(self.command).is_answered(self.command)
        return answered

    @property
    def longest_response(self) -> int:
        """The length in bytes of the longest response, a refusal or exception included; 0 for a broadcast."""
        longest: int = _codec(self.command).longest_response(self.command, self.profile)
        return longest

    @property
    def pause(self) -> float:
        """The seconds to wait after the request."""
        pause: float = _codec(self.command).pause_after(self.command, self.profile)
        return pause

    def read(self, frame: bytes) -> Answered[R] | Declined:
        """Decode a frame as the response.

        Errors: `DecodeError` for any other frame.
        """
        response: Any = _codec(self.command).decode_response(frame, self.command, self.profile)
        if isinstance(response, dcon.Refused | modbus.ExceptionResponse):
            return Declined(self.command, response)
        return Answered(self.command, response)


def _codec(command: AnyCommand) -> Any:  # noqa: ANN401 - a module
    """Return the protocol module of a command; both have functions of the same names."""
    return modbus if isinstance(command, modbus.Request) else dcon


Found = tuple[bytes | Noise, ...]
"""Frames and noise."""


def split(last: Exchange[Any] | None, heard: bytes, *, echo: bool) -> tuple[Found, bytes]:
    """Split received bytes into complete frames, noise and the rest that may still become a frame.

    Shape: uses the protocol of the last request, because modules only answer.
    """
    if last is not None and last.rtu:
        return modbus.split(heard, _side(echo=echo), last.profile)
    return dcon.split(heard, checksum=last is not None and last.profile.checksum)


def answers(pending: Exchange[Any], rest: bytes) -> tuple[Found, bytes]:
    """Return the complete responses to an open request in a rest, and the new rest."""
    if not pending.rtu or not pending.answered:
        return (), rest
    command: Any = pending.command
    found, after = modbus.split(rest, modbus.Side.RESPONSES, pending.profile, request=command)
    return ((), rest) if all(isinstance(part, Noise) for part in found) else (found, after)


def finish(last: Exchange[Any], rest: bytes, *, echo: bool) -> Found:
    """Split a rest without waiting for more bytes: an incomplete frame is noise."""
    if last.rtu:
        return modbus.flush(rest, _side(echo=echo), last.profile)
    return (Noise(rest, Fault.TERMINATOR),) if rest else ()


def _side(*, echo: bool) -> modbus.Side:
    return modbus.Side.BOTH if echo else modbus.Side.RESPONSES
