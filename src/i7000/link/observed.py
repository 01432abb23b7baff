"""What an observer of a line hears, for recorders and live views."""

from attrs import frozen

from i7000.host import Event
from i7000.message import Query, Response
from i7000.profile import Profile
from i7000.settings import LineSettings

__all__ = ["Abandoned", "Asked", "Happened", "Observed", "PowerCycled", "Received", "Tuned", "Written"]


@frozen
class Asked:
    """A request was opened; it is sent when it is its time."""

    at: float
    command: Query[Response]
    profile: Profile


@frozen
class Received:
    """Bytes were read from the port."""

    at: float
    data: bytes


@frozen
class Written:
    """Bytes were written to the port."""

    at: float
    data: bytes


@frozen
class Happened:
    """An event of the host: an outcome, or other traffic; each byte of these was in a `Received` or `Written`."""

    at: float
    event: Event[Response]


@frozen
class Abandoned:
    """The open request ended without an outcome: Ctrl-C, a cancelled task, or a lost port."""

    at: float


@frozen
class Tuned:
    """The port got other line settings."""

    at: float
    line: LineSettings


@frozen
class PowerCycled:
    """The port switched the power of the modules off and on, with the INIT switch set or not."""

    at: float
    init_switch: bool


Observed = Asked | Received | Written | Happened | Abandoned | Tuned | PowerCycled
"""What an observer is called with; `at` is the time of the clock of the line."""
