"""Messages <-> frames, for a profile: the functions that `i7000.dcon` is about.

Laws: `encode` raises nothing but `EncodeError`, the decoders nothing but `DecodeError`; decoding what was encoded gives
the message back. A frame that any module could have sent or been sent decodes, even if this module would refuse it:
`encode` is where a channel, type or limit is held against the model.
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
"""What a host sends."""

_FAMILIES = (calibration, cold_junction, configuration, identity, inputs, open_wire, sampling, watchdog)
_FOUND: list[type[AnyCommand]] = [command for family in _FAMILIES for command in family.COMMANDS]
COMMANDS: tuple[type[AnyCommand], ...] = tuple(
    sorted(_FOUND, key=lambda command: [int(number) for number in command.section.split(".")])
)
"""Every command, in the order of the manual's sections 2.1 to 2.43."""

R = TypeVar("R", bound=Response)


_LETTERED = "$~@"
"""The leading characters of the commands that are told apart by what follows the address."""


def _key(text: str) -> str:
    """What commands are sorted by: the leading character, and the one after the address where that tells them apart."""
    return text[0] + text[3:4] if text[0] in _LETTERED else text[0]


_BY_KEY: dict[str, tuple[type[AnyCommand], ...]] = {}
for _command in COMMANDS:
    _BY_KEY[_key(_command.syntax)] = (*_BY_KEY.get(_key(_command.syntax), ()), _command)


def encode(message: Message, profile: Profile, *, force: bool = False) -> bytes:
    r"""Write a command, broadcast or response as a frame.

    Special: with `force` it is written even if the module does not have it or would refuse it, as long as it has a
        wire form there: for those who test modules.
    Errors: `EncodeError` that tells the reason.
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
    r"""Read a frame that a host sent to the module of `profile`.

    Special: a channel, type or limit that the module does not have is read all the same: the module answers ``?AA``.
    Errors: `DecodeError`; with `Fault.UNSUPPORTED` for a command that the module does not have. A body that is no
        command has the fault of the command that it comes nearest to.
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
        allowed = f"{refused.title} is there on {refused.availability.scope}"
        raise DecodeError(Fault.UNSUPPORTED, frame, at, allowed=allowed, section=refused.section)
    if not known or (body[0] in _LETTERED and len(body) <= 3 and body[1:2] != "*"):
        fault = Fault.COMMAND if len(body) > 3 else Fault.LENGTH
        raise DecodeError(fault, frame, min(len(body), 3), allowed="a command of chapter 2", section="2")
    there = [command for command in known if command.availability not in profile.refused] or known
    raise deepest(command.layout.explain(body, profile, frame, command.section) for command in there)


def deepest(faults: Iterable[DecodeError]) -> DecodeError:
    """The fault of the command that a frame comes nearest to: it fits the furthest, and has the right length."""
    misfits = (Fault.COMMAND, Fault.UNSUPPORTED)
    return max(faults, key=lambda it: (it.fault not in misfits, it.fault is not Fault.LENGTH, it.offset))


def decode_response(frame: bytes, command: Command[R], profile: Profile) -> R | Refused:
    r"""Read the frame that answers `command`.

    Special: ``$002``, asked in INIT mode, is answered from the stored address (assumption), so any is accepted.
    Errors: `DecodeError`; with `Fault.ADDRESS` for the answer of another module, where the answer tells.
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
    """Hold what a response repeats of its command against the command."""
    expected = command.address if isinstance(response, Refused) else command.answering_address
    told_in_init_mode = isinstance(command, ReadConfiguration) and command.address == 0
    if response.address != expected and not told_in_init_mode:
        allowed = f"{expected:02X}"
        raise DecodeError(Fault.ADDRESS, frame, 1, field="address", allowed=allowed, section=command.section)
    if isinstance(response, ChannelTypeCode) and response.channel != getattr(command, "channel", None):
        raise DecodeError(Fault.VALUE, frame, 4, field="channel", allowed="the one asked for", section=command.section)


# --- what a driver has to plan for ------------------------------------------------------------------------------------


def is_answered(command: AnyCommand) -> bool:
    """Return whether a module answers: not if the command is a broadcast.

    >>> is_answered(ReadConfiguration(0x01))
    True
    """
    check_type("command", command, Command, Broadcast)
    return isinstance(command, Command)


def longest_response(command: AnyCommand, profile: Profile) -> int:
    """Tell the bytes of the longest answer to `command`, carriage return included; 0 for a broadcast.

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
    """Tell how many seconds to leave the module alone after `command`.

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
