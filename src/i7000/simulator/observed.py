"""What the simulator tells of the line to those who watch it."""

from attrs import frozen

from i7000 import Noise, Profile, Protocol

__all__ = ["Observed"]


@frozen
class Observed:
    """Something that was on the line: what modules heard, and what came back."""

    at: float
    """Seconds since the simulator began."""
    client: str
    """Who sent it: ``127.0.0.1:51234``, or the path of a pseudo-terminal."""
    heard: bytes | Noise
    """A whole frame, or bytes that are none."""
    protocol: Protocol
    """Whose splitter found it."""
    profile: Profile | None
    """Of the module that it is for, as it was before; None: of none on this bus, or of all."""
    answer: bytes | None
    """What the modules answered; None: silence."""
    faults: tuple[str, ...] = ()
    """What the line did to the answer: ``dropped a byte``, ``late by 0.25 s``."""
