"""The events that the simulator reports: the traffic on its line, and changes of its modules."""

from attrs import frozen

from i7000.errors import Noise
from i7000.models import Model
from i7000.profile import Profile
from i7000.settings import Protocol
from i7000.simulator.faults import Piece

__all__ = ["Change", "Observed"]


@frozen
class Observed:
    """An event on the line: what modules heard, and the response."""

    at: float
    """The seconds since the start of the simulator."""
    client: str
    """The sender: the address of its end of the connection, or the path of a pseudo-terminal."""
    heard: bytes | Noise
    """A complete frame, or bytes that are not a frame."""
    protocol: Protocol
    """The protocol of the frame."""
    profile: Profile | None
    """The profile of the addressed module before the frame; None for a broadcast, or if no module has the address."""
    answer: bytes | None
    """The response of the modules; None for silence."""
    faults: tuple[str, ...] = ()
    """The faults of the line."""
    deaf: Profile | None = None
    """The profile of a module that cannot understand it because it uses the other protocol."""
    pieces: tuple[Piece, ...] = ()
    """What arrives of the response, with the delay of the module and of the line."""


@frozen
class Change:
    """A change of a module: a setting, its watchdog, its power or its INIT switch."""

    at: float
    """The seconds since the start of the simulator."""
    address: int
    """The address in the EEPROM of the module, after the change."""
    model: Model
    what: tuple[str, ...]
    """The changes in words."""
    stored: bool = False
    """Whether the EEPROM was written."""
