"""What the steps of a check are, and steps that many checks share."""

from collections.abc import Callable, Iterable
from typing import Any, TypeVar

from i7000 import dcon
from i7000.conformance.checks.others import others_known, others_unchanged
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Reason
from i7000.errors import DecodeError
from i7000.host.procedures import Procedure
from i7000.message import Query
from i7000.profile import Profile

__all__ = [
    "Steps",
    "beyond",
    "body_of",
    "changed",
    "not_carried_out",
    "one_digit",
    "put_back",
    "text_of",
    "told",
    "unchanged",
    "with_tail",
]

R = TypeVar("R", bound=dcon.Response)

Steps = Callable[[Subject], Procedure[None]]
"""The steps of a check: a generator function of the module under test. It passes by ending."""

_TAILS = (b"F3", b"E5")
"""Characters that no command ends with. They look like a checksum, so that the guard lets them follow a read."""


def text_of(wire: bytes) -> str:
    """Return a frame of DCON as people write it."""
    return wire.removesuffix(b"\r").decode("ascii", "backslashreplace")


def body_of(module: Subject, command: Query[Any]) -> bytes:
    """Return the frame of a DCON command without checksum and carriage return."""
    return dcon.unseal(module.wire(command), checksum=module.profile.checksum)


def with_tail(module: Subject, command: Query[Any]) -> bytes:
    """Return the frame of a DCON command with two characters too many, which are not its checksum either."""
    body = body_of(module, command)
    right = b"%02X" % dcon.checksum(body)
    return body + next(tail for tail in _TAILS if tail != right) + b"\r"


def not_carried_out(module: Subject, *wires: bytes) -> Procedure[None]:
    """Send frames that the module must not carry out: each is refused or ignored.

    Special: silence is followed by a read that the module answers.
    Manual: 2; E27 (which of the two it is).
    """
    for wire in wires:
        yield from module.expect_one_of(wire, (None, module.refused))


def told(module: Subject, command: dcon.Command[R], profile: Profile | None = None) -> Procedure[tuple[R, bytes]]:
    """Send a DCON command, and return its response and the bytes of it; the twin does not compare what it says.

    Shape: `profile` decodes the response in place of that of the module.
    Errors: `Difference` for a refusal and for a response of another form, `Unclear` for silence.
    """
    wire = module.wire(command)
    heard = (yield from module.send(wire)).wire
    if not heard:
        yield from module.alive(wire)
    try:
        response = dcon.decode_response(heard, command, profile or module.profile)
    except DecodeError as error:
        raise module.wrong(str(error), wire, heard, command.response.syntax) from None
    if isinstance(response, dcon.Refused):
        raise module.wrong("refused", wire, heard, command.response.syntax)
    return response, heard


def one_digit(module: Subject) -> range:
    """Return the channels that #AAN can name for sure: what stands for channel 10 in one digit is open (E21)."""
    return module.channels[:10] if module.profile.channel_digits == 1 else module.channels


def beyond(channels: Iterable[int], digits: int) -> list[int]:
    """Return the first channel after some, and the last that can be written in so many hex digits."""
    return sorted({max(channels) + 1, 16**digits - 1}.intersection(range(max(channels) + 1, 16**digits)))


# --- settings ---------------------------------------------------------------------------------------------------------


def changed(module: Subject, new: Query[Any], old: Query[Any], *reads: Query[Any]) -> Procedure[None]:
    """Change a setting, read what depends on it and all other settings, and change it back.

    Special: it is changed back too if something is wrong.
    """
    module.reserve(2)
    yield from others_known(module)
    channels = module.channels
    try:
        yield from module.expect(new)
        for read in reads:
            yield from module.expect(read)
        yield from others_unchanged(module, channels)
    except Reason:
        yield from put_back(module, old)
        raise
    yield from module.expect(old)
    yield from module.expect(reads[0])


def unchanged(module: Subject, tries: Procedure[None], old: Query[Any], *reads: Query[Any]) -> Procedure[None]:
    """Make attempts that the module must not carry out, and read the setting; write it again if something is wrong."""
    module.reserve(1)
    try:
        yield from tries
        for read in reads:
            yield from module.expect(read)
    except Reason:
        yield from put_back(module, old)
        raise


def put_back(module: Subject, *olds: Query[Any]) -> Procedure[None]:
    """Write settings as they were, whatever the module answers."""
    for old in olds:
        wire = module.wire(old)
        module.hear(wire)
        yield from module.send(wire)
