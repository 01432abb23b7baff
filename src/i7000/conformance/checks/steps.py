"""What the steps of a check are, and steps that many checks share."""

from collections.abc import Callable, Iterable
from typing import Any

from i7000 import dcon
from i7000.conformance.subject import Subject
from i7000.host.procedures import Procedure
from i7000.message import Query

__all__ = ["Steps", "not_carried_out", "with_tail"]

Steps = Callable[[Subject], Procedure[None]]
"""The steps of a check: a generator function of the module under test. It passes by ending."""

_TAILS = (b"F3", b"E5")
"""Characters that no command ends with. They look like a checksum, so that the guard lets them follow a read."""


def with_tail(module: Subject, command: Query[Any]) -> bytes:
    """Return the frame of a DCON command with two characters too many, which are not its checksum either."""
    body = module.wire(command).removesuffix(b"\r")
    if module.profile.checksum:
        body = body[:-2]
    right = b"%02X" % dcon.checksum(body)
    return body + next(tail for tail in _TAILS if tail != right) + b"\r"


def not_carried_out(module: Subject, *wires: bytes) -> Procedure[None]:
    """Send frames that are no commands: each is refused or ignored.

    Special: silence is followed by a read that the module answers.
    Manual: 2; E27 (which of the two it is).
    """
    for wire in wires:
        yield from module.expect_one_of(wire, (None, module.refused))


def beyond(channels: Iterable[int], digits: int) -> list[int]:
    """Return the first channel after some, and the last that can be written in so many hex digits."""
    return sorted({max(channels) + 1, 16**digits - 1}.intersection(range(max(channels) + 1, 16**digits)))
