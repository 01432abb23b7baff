"""What the simulator tells of the traffic on its line."""

from attrs import frozen

from i7000.errors import Noise
from i7000.profile import Profile
from i7000.settings import Protocol

__all__ = ["Observed"]


@frozen
class Observed:
    """Something that was on the line: what modules heard, and what came back."""

    at: float
    """Seconds since the simulator began."""
    client: str
    """Who sent it: the address of its end of the connection, or the path of a pseudo-terminal."""
    heard: bytes | Noise
    """A whole frame, or bytes that are none."""
    protocol: Protocol
    """Whose frame it is."""
    profile: Profile | None
    """That of the module it is for, as it was before; None: it is for none of this bus, or for all."""
    answer: bytes | None
    """What the modules answered; None: silence."""
    faults: tuple[str, ...] = ()
    """What the line did to it."""
    deaf: Profile | None = None
    """That of a module that cannot understand it, since it speaks the other protocol."""
