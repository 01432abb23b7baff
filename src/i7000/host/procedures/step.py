"""The steps of procedures, and `ask`, the procedure of one request."""

from collections.abc import Generator
from types import NoneType
from typing import Any, Generic, TypeVar

from i7000.arguments import check_fields, check_type, is_number
from i7000.errors import InvalidValueError, Noise
from i7000.frozen import frozen
from i7000.host.bus import Policy
from i7000.host.events import Late, Outcome, Rejected
from i7000.message import Query, Response
from i7000.profile import Profile
from i7000.settings import BaudRate, LineSettings

__all__ = ["Ask", "BytesHeard", "PowerCycle", "Procedure", "Result", "SendBytes", "Step", "Tell", "Tune", "Wait", "ask"]

T = TypeVar("T")
R = TypeVar("R", bound=Response)
R_co = TypeVar("R_co", bound=Response, covariant=True)
"""The class of the response."""


@frozen
class Ask(Generic[R_co]):
    """The step to send a request and to wait for its outcome; the driver sends the `Result`.

    Shape: `command` to the module of `profile`; `policy` for this request, or None for the policy of the line.
    Errors: `InvalidValueError` for a field of another type.
    """

    command: Query[R_co]
    profile: Profile
    policy: Policy | None = None

    def __attrs_post_init__(self) -> None:
        check_fields(self, {"command": (Query,), "profile": (Profile,), "policy": (Policy, NoneType)})


@frozen
class Result(Generic[R_co]):
    """The result of `Ask`: the `outcome` of the request, and the `others`, all other traffic meanwhile."""

    outcome: Outcome[R_co]
    others: tuple[Rejected | Late | Noise, ...] = ()


@frozen
class Tune:
    """The step to change the line settings of the host to `line`, not those of a module; the driver sends None.

    Errors: `InvalidValueError` for another type, and for an undefined baud rate.
    """

    line: LineSettings

    def __attrs_post_init__(self) -> None:
        check_fields(self, {"line": (LineSettings,)})
        if not isinstance(self.line.baud_rate, BaudRate):
            raise InvalidValueError("baud_rate", f"{self.line.baud_rate:02X}", "03..0A", "1.11")


@frozen
class Wait:
    """The step to wait for `seconds`, for example while a module restarts; the driver sends None.

    Unit: seconds.
    Range: 0 or more.
    Errors: `InvalidValueError` beyond the range.
    """

    seconds: float

    def __attrs_post_init__(self) -> None:
        if not is_number(self.seconds) or self.seconds < 0:
            raise InvalidValueError("seconds", self.seconds, "seconds, 0 or more", "")


@frozen
class SendBytes:
    """The step to send bytes as they are and to listen; the driver sends the `BytesHeard`.

    Shape: `pieces` are pairs of a pause and bytes that follow it: a request in one piece is ``((0.0, wire),)``. The
        line is silent for 3.5 characters before the first piece.
        `seconds` is the longest time to listen after the last byte. `ends` is what bytes end with that are a whole
        answer, such as a CR; then, and after any bytes if it is empty, listening ends after `quiet` seconds of silence.
    Unit: seconds.
    Errors: `InvalidValueError` for a field of another type, and for times that are negative or not finite.
    """

    pieces: tuple[tuple[float, bytes], ...]
    seconds: float
    quiet: float = 0.05
    ends: bytes = b""

    def __attrs_post_init__(self) -> None:
        check_fields(self, {"pieces": (tuple,), "ends": (bytes,)})
        for piece in self.pieces:
            if not (isinstance(piece, tuple) and len(piece) == 2 and isinstance(piece[1], bytes)):
                raise InvalidValueError("pieces", piece, "pairs of a pause in seconds and bytes", "")
        times = [("pieces", pause) for pause, _ in self.pieces]
        for name, value in (*times, ("seconds", self.seconds), ("quiet", self.quiet)):
            if not is_number(value) or value < 0:
                raise InvalidValueError(name, value, "seconds, 0 or more", "")


@frozen
class BytesHeard:
    """The result of `SendBytes`.

    Shape: `pieces` are pairs of a time and the bytes that were read then; the time is in seconds after the end of the
        last byte sent, negative before it. `now` is the time of the clock of the line at the end.
    """

    pieces: tuple[tuple[float, bytes], ...]
    now: float

    @property
    def wire(self) -> bytes:
        """All bytes."""
        return b"".join(data for _, data in self.pieces)


@frozen
class PowerCycle:
    """The step to switch the power of the modules off and on; the driver sends whether the port can do that.

    Shape: `init_switch` is whether the INIT switch is set at power-on.
    """

    init_switch: bool = False


@frozen
class Tell:
    """The step to report `value`, a finding or the progress, to the user of the driver; the driver sends None."""

    value: object


Step = Ask[Response] | SendBytes | PowerCycle | Tune | Wait | Tell
"""What a procedure yields."""

Procedure = Generator[Step, Any, T]
"""A procedure that returns T."""


def ask(command: Query[R], profile: Profile, policy: Policy | None = None) -> Procedure[Result[R]]:
    """Make the procedure of one request; a type checker knows the class of its response.

    Errors: `EncodeError` of the codec when the driver sends a command that the module does not have.

    >>> from i7000 import Model, dcon
    >>> next(ask(dcon.ReadConfiguration(0x01), Profile(Model.I_7018))).command
    ReadConfiguration(address=0x01)
    """
    check_type("command", command, Query)
    check_type("profile", profile, Profile)
    check_type("policy", policy, Policy, optional=True)
    return _asked(Ask(command, profile, policy))


def _asked(step: Ask[R]) -> Procedure[Result[R]]:
    result: Result[R] = yield step
    return result
