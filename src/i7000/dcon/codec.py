"""Functions that convert messages to frames and back, for a profile.

Laws: `encode` raises only `EncodeError`; the decoders raise only `DecodeError`. Decoding an encoded message returns an
equal message. Every frame that some module can send or receive decodes, even if this module would refuse it. Only
`encode` checks channels, types and limits against the model.
"""

from collections.abc import Iterable
from typing import Any, TypeVar

from i7000.arguments import as_bytes, check_type
from i7000.dcon import (
    calibration,
    cold_junction,
    configuration,
    identity,
    inputs,
    open_wire,
    sampling,
    watchdog,
)
from i7000.dcon.calibration import CalibrateChannelSpan, CalibrateChannelZero, ReloadDefaultCalibration
from i7000.dcon.command import Broadcast, Command, Message, Refused, Response
from i7000.dcon.configuration import ChannelTypeCode, ReadConfiguration
from i7000.dcon.frame import COMMAND_LEADS, sealed, unseal
from i7000.errors import DecodeError, EncodeError, Fault
from i7000.models import Firmware
from i7000.profile import Profile

__all__ = [
    "COMMANDS",
    "AnyCommand",
    "decode_command",
    "decode_response",
    "encode",
    "is_answered",
    "longest_response",
    "pause_after",
]

AnyCommand = Command[Any] | Broadcast
"""The messages that a host sends."""

_FAMILIES = (calibration, cold_junction, configuration, identity, inputs, open_wire, sampling, watchdog)
_FOUND: list[type[AnyCommand]] = [command for family in _FAMILIES for command in family.COMMANDS]
COMMANDS: tuple[type[AnyCommand], ...] = tuple(
    sorted(_FOUND, key=lambda command: [int(number) for number in command.section.split(".")])
)
"""Every command, in the order of the manual's sections 2.1 to 2.43."""

R = TypeVar("R", bound=Response)


_LETTERED = "$~@"
"""The leading characters of the commands that are distinguished by the character after the address."""


def _key(text: str) -> str:
    """Return the key of a command: the leading character, and the one after the address for `_LETTERED`."""
    return text[0] + text[3:4] if text[0] in _LETTERED else text[0]


_BY_KEY: dict[str, tuple[type[AnyCommand], ...]] = {}
for _command in COMMANDS:
    _BY_KEY[_key(_command.syntax)] = (*_BY_KEY.get(_key(_command.syntax), ()), _command)


def encode(message: Message, profile: Profile, *, force: bool = False) -> bytes:
    r"""Encode a command, broadcast or response as a frame.

    Special: with `force`, messages that the module does not have or would refuse are encoded too, as long as they have
        a wire form. Use it to test modules.
    Errors: `EncodeError` with the reason.
    Manual: 2.

    >>> from i7000 import Model
    >>> encode(ReadConfiguration(0x01), Profile(Model.I_7018, checksum=True))
    b'$012B7\r'
    """
    if profile.__class__ is not Profile:
        check_type("profile", profile, Profile)
    if not isinstance(message, Message):
        check_type("message", message, Message)  # type: ignore[unreachable] # with types
    if force is not False:
        check_type("force", force, bool)
        message.layout.check_digits(message, profile)
    else:
        if message.availability in profile.refused:
            raise EncodeError(
                "model", profile.model.value, message.availability.scope, message.section,
                f"{profile.name} has no {message.title}",
            )  # fmt: skip
        message.check(profile)
    return sealed(message.layout.encode(message, profile), profile.checksum)


def decode_command(frame: bytes, profile: Profile) -> AnyCommand:
    r"""Decode a frame that a host sent to the module of `profile`.

    Special: a command with a channel, type or limit that the module does not have is decoded; the module answers
        ``?AA``.
    Errors: `DecodeError`; with `Fault.UNSUPPORTED` for a command that the module does not have. For an unknown body,
        the error is that of the most similar command.
    Manual: 2; E7, E8, E10, E27, E93.

    >>> from i7000 import Model
    >>> decode_command(b"$01A\r", Profile(Model.M_7019R)), decode_command(b"$01A\r", Profile(Model.M_7017))
    (ReadCjcUpdate(address=0x01), ReadAnalogInputsHex(address=0x01))
    """
    if profile.__class__ is not Profile:
        check_type("profile", profile, Profile)
    if frame.__class__ is not bytes:
        frame = as_bytes("frame", frame)
    body = unseal(frame, checksum=profile.checksum, leads=COMMAND_LEADS).decode("ascii")
    known = _BY_KEY.get(_key(body), ())
    refused = None
    for command in known:
        try:
            message: AnyCommand = command.layout.decode(body, profile)
        except (KeyError, DecodeError):
            continue
        if command.availability not in profile.refused:
            return message
        refused = command
    if refused is not None:
        at = 3 if body[0] in _LETTERED else 1
        allowed = f"{refused.title} exists on {refused.availability.scope}"
        raise DecodeError(Fault.UNSUPPORTED, frame, at, allowed=allowed, section=refused.section)
    if not known or (body[0] in _LETTERED and len(body) <= 3 and body[1:2] != "*"):
        fault = Fault.COMMAND if len(body) > 3 else Fault.LENGTH
        raise DecodeError(fault, frame, min(len(body), 3), allowed="a command of chapter 2", section="2")
    there = [command for command in known if command.availability not in profile.refused] or known
    raise deepest(command.layout.explain(body, profile, frame, command.section) for command in there)


def deepest(faults: Iterable[DecodeError]) -> DecodeError:
    """Return the error of the most similar command: the one that matches furthest and has the right length."""
    misfits = (Fault.COMMAND, Fault.UNSUPPORTED)
    return max(faults, key=lambda it: (it.fault not in misfits, it.fault is not Fault.LENGTH, it.offset))


def decode_response(frame: bytes, command: Command[R], profile: Profile) -> R | Refused:
    r"""Decode the response to `command`.

    Special: in INIT mode a module answers ``$002`` with its stored address (assumption), so every address is accepted.
    Errors: `DecodeError`; with `Fault.ADDRESS` for the response of another module, if the response contains an address.
    Manual: 2; E16, E18, E24.

    >>> from i7000 import Model
    >>> decode_response(b"?01\r", ReadConfiguration(0x01), Profile(Model.I_7018))
    Refused(address=0x01)
    """
    if profile.__class__ is not Profile:
        check_type("profile", profile, Profile)
    if frame.__class__ is not bytes:
        frame = as_bytes("frame", frame)
    if not isinstance(command, Command):
        check_type("command", command, Command)  # type: ignore[unreachable] # with types
    layout = command.response.layout
    body = unseal(frame, checksum=profile.checksum, leads=layout.leads).decode("ascii")
    if body[0] == "?":
        layout = Refused.layout
    try:
        response: R | Refused = layout.decode(body, profile)
    except (KeyError, DecodeError):
        raise layout.explain(body, profile, frame, command.section) from None
    if layout.addressed:
        _check_echo(response, command, frame)
    return response


def _check_echo(response: Any, command: Command[Any], frame: bytes) -> None:  # noqa: ANN401 - one with an address
    """Check the parts of a response that repeat the command."""
    expected = command.address if isinstance(response, Refused) else command.answering_address
    in_init_mode = isinstance(command, ReadConfiguration) and command.address == 0
    if response.address != expected and not in_init_mode:
        allowed = f"{expected:02X}"
        raise DecodeError(Fault.ADDRESS, frame, 1, field="address", allowed=allowed, section=command.section)
    if isinstance(response, ChannelTypeCode) and response.channel != getattr(command, "channel", None):
        allowed = "the requested channel"
        raise DecodeError(Fault.VALUE, frame, 4, field="channel", allowed=allowed, section=command.section)


# --- timing and lengths -----------------------------------------------------------------------------------------------


def is_answered(command: AnyCommand) -> bool:
    """Return whether a module answers `command`: False for a broadcast.

    >>> is_answered(ReadConfiguration(0x01))
    True
    """
    check_type("command", command, Command, Broadcast)
    return isinstance(command, Command)


def longest_response(command: AnyCommand, profile: Profile) -> int:
    """Return the length in bytes of the longest response to `command`, carriage return included; 0 for a broadcast.

    >>> from i7000 import Model
    >>> longest_response(ReadConfiguration(0x01), Profile(Model.I_7017))
    10
    """
    check_type("profile", profile, Profile)
    check_type("command", command, Command, Broadcast)
    if isinstance(command, Broadcast):
        return 0
    return command.response.layout.longest(profile) + 2 * profile.checksum + 1


def pause_after(command: AnyCommand, profile: Profile) -> float:
    """Return how many seconds to wait after `command` before the next one.

    Time: 2 ms after broadcasts; 3 s for `ReloadDefaultCalibration`; 16 s for the calibration of a channel of the 7019
        series with firmware up to B2.6.
    Manual: 2.2, 2.8, 2.9, 2.28, 2.35; E103.
    """
    check_type("profile", profile, Profile)
    check_type("command", command, Command, Broadcast)
    if isinstance(command, Broadcast):
        return 0.002
    if isinstance(command, ReloadDefaultCalibration):
        return 3.0
    slow = isinstance(command, CalibrateChannelZero | CalibrateChannelSpan)
    return 16.0 if slow and not profile.runs(Firmware("B2.7")) else 0.0
