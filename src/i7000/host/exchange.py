"""A request with all that the line needs for it; the same for both protocols.

Laws: protocol differences are here, timing is in `i7000.host.bus`.
"""

from typing import Any, Generic, TypeVar

from i7000 import dcon, modbus
from i7000.errors import Fault, Noise
from i7000.frozen import frozen
from i7000.host.events import Answered, Declined
from i7000.message import Query, Response
from i7000.profile import Profile

__all__ = ["Exchange", "answers", "finish", "prepare", "split"]

R = TypeVar("R", bound=Response)
R_co = TypeVar("R_co", bound=Response, covariant=True)


@frozen
class Exchange(Generic[R_co]):
    """A command and the profile of its module; R_co is the class of the response."""

    command: Query[R_co]
    profile: Profile
    wire: bytes
    """The frame of the command."""

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

    def read(self, frame: bytes) -> Answered[R_co] | Declined:
        """Decode a frame as the response.

        Errors: `DecodeError` for any other frame.
        """
        response: Any = _codec(self.command).decode_response(frame, self.command, self.profile)
        if isinstance(response, dcon.Refused | modbus.ExceptionResponse):
            return Declined(self.command, response)
        return Answered(self.command, response)


def prepare(command: Query[R], profile: Profile) -> Exchange[R]:
    """Encode a command for the module of `profile`.

    Errors: `EncodeError` of the codec.
    """
    return Exchange(command, profile, _codec(command).encode(command, profile))


def _codec(command: Query[Response]) -> Any:  # noqa: ANN401 - a module
    """Return the protocol module of a command; both have functions of the same names."""
    return modbus if isinstance(command, modbus.Request) else dcon


Found = tuple[bytes | Noise, ...]
"""Frames and noise."""


def split(last: Exchange[Response] | None, heard: bytes, *, echo: bool) -> tuple[Found, bytes]:
    """Split received bytes into complete frames, noise and the rest that may still become a frame.

    Shape: uses the protocol of the last request, because modules only answer.
    """
    if last is not None and last.rtu:
        return modbus.split(heard, _side(echo=echo), last.profile)
    return dcon.split(heard, checksum=last is not None and last.profile.checksum)


def answers(pending: Exchange[Response], rest: bytes) -> tuple[Found, bytes]:
    """Return the complete responses to an open request in a rest, and the new rest."""
    if not pending.rtu or not pending.answered:
        return (), rest
    command: Any = pending.command
    found, after = modbus.split(rest, modbus.Side.RESPONSES, pending.profile, request=command)
    return ((), rest) if all(isinstance(part, Noise) for part in found) else (found, after)


def finish(last: Exchange[Response], rest: bytes, *, echo: bool) -> Found:
    """Split a rest without waiting for more bytes: an incomplete frame is noise."""
    if last.rtu:
        return modbus.flush(rest, _side(echo=echo), last.profile)
    return (Noise(rest, Fault.TERMINATOR),) if rest else ()


def _side(*, echo: bool) -> modbus.Side:
    return modbus.Side.BOTH if echo else modbus.Side.RESPONSES
