"""What a frame could be, where nothing is known of the module: all readings of it.

Laws: what any module could have sent or been sent is among its candidates; nothing is, that no module could.
"""

from functools import cache
from itertools import product

from attrs import evolve

from i7000.arguments import as_bytes
from i7000.dcon.codec import COMMANDS, AnyCommand, decode_command, deepest
from i7000.dcon.command import Command, Refused, Response
from i7000.dcon.frame import RESPONSE_LEADS, unseal
from i7000.errors import DecodeError, Fault
from i7000.models import Model, series
from i7000.profile import LAST_LEGACY, Profile
from i7000.settings import DataFormat

__all__ = ["candidates", "response_candidates"]


@cache
def _profiles() -> tuple[Profile, ...]:
    """Every profile whose messages could have a form of their own."""
    differential = [Profile(model) for model in Model]
    single_ended = [Profile(model, single_ended=True) for model in series("7017Z")]
    return (*differential, *single_ended)


@cache
def _response_profiles() -> tuple[Profile, ...]:
    kinds = {(profile.channels, profile.mask_digits): profile for profile in _profiles()}
    old = Profile(Model.I_7018, firmware=LAST_LEGACY)
    return tuple(
        evolve(profile, data_format=data_format) for profile, data_format in product((*kinds.values(), old), DataFormat)
    )


def candidates(frame: bytes) -> tuple[AnyCommand, ...]:
    r"""Read a frame that a host sent to an unknown module: every command that it could be, by section.

    Shape: frames with and without checksum are thought of; `availability` of a command tells which models have it.
    Errors: `DecodeError` if it is no command of any model.
    Manual: 2; E7, E8, E93.

    >>> candidates(b"#0184\r")
    (ReadAnalogInputs(address=0x01), ReadAnalogInput(address=0x01, channel=132))
    """
    frame = as_bytes("frame", frame)
    found: dict[AnyCommand, None] = {}
    faults = []
    for checksum, profile in product((False, True), _profiles()):
        try:
            found[decode_command(frame, evolve(profile, checksum=checksum))] = None
        except DecodeError as fault:
            faults += [] if checksum else [fault]
    if not found:
        raise deepest(faults)
    return tuple(sorted(found, key=lambda command: COMMANDS.index(type(command))))


def response_candidates(frame: bytes) -> tuple[Response, ...]:
    r"""Read a frame that an unknown module sent in answer to an unknown command: every response that it could be.

    Shape: frames with and without checksum, all data formats and numbers of channels are thought of.
    Errors: `DecodeError` if it is no response of any model.
    Manual: 2; E93.

    >>> response_candidates(b"?01\r")
    (Refused(address=0x01),)
    """
    frame = as_bytes("frame", frame)
    found: dict[Response, None] = {}
    unseal(frame, checksum=False, leads=RESPONSE_LEADS)
    for checksum in (False, True):
        try:
            body = unseal(frame, checksum=checksum, leads=RESPONSE_LEADS).decode("ascii")
        except DecodeError:
            continue
        for kind, profile in product(_RESPONSES, _response_profiles()):
            try:
                found[kind.layout.decode(body, profile)] = None
            except (KeyError, DecodeError):
                continue
    if not found:
        raise DecodeError(Fault.COMMAND, frame, 1, allowed="a response of chapter 2", section="2")
    return tuple(found)


_RESPONSES: tuple[type[Response], ...] = (
    Refused,
    *dict.fromkeys(command.response for command in COMMANDS if issubclass(command, Command)),
)
"""Every response, once."""
