"""Strategies for DCON messages and for whole exchanges.

Laws: strategies are made from the syntax of a message, part by part, so new commands need no code here. The message's
own `check` decides what a module accepts.
"""

from collections.abc import Callable, Mapping, Sequence
from enum import Enum
from functools import cache
from string import ascii_uppercase
from typing import Any, TypeVar, cast, get_args

from attrs import Attribute, fields, frozen
from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from i7000 import MIXED, DataFormat, LineSettings, Model, Profile, ReportSettings, TypeCode
from i7000.dcon import (
    COMMANDS,
    AnyCommand,
    Broadcast,
    Command,
    FirmwareVersion,
    Message,
    ModuleName,
    ReadAnalogInput,
    ReadConfiguration,
    Refused,
    Response,
    encode,
    parts,
)
from i7000.dcon.identity import LONGEST_TIMEOUT
from i7000.dcon.parts import Part
from i7000.fields import FIELD_WIDTHS
from i7000.names import CHARACTERS, is_name
from i7000.profile import CJC_OFFSETS
from i7000.readings import encode_field
from i7000.strategies.vocabulary import (
    addresses,
    is_accepted,
    line_settings,
    profiles,
    readings,
    report_settings,
    supported_types,
)

__all__ = [
    "Exchange",
    "any_commands",
    "channel_fields",
    "commands",
    "exchanges",
    "messages",
    "names",
    "profiles_with",
    "responses",
]

MessageT = TypeVar("MessageT", bound=Message)
R = TypeVar("R", bound=Response)

_COMMANDS = sorted(COMMANDS, key=lambda command: (issubclass(command, Broadcast), len(command.syntax)))
"""The commands, the simplest first: `ReadAnalogInputs`."""
_MESSAGES: tuple[type[Message], ...] = tuple(
    dict.fromkeys((*_COMMANDS, Refused, *(kind.response for kind in _COMMANDS if issubclass(kind, Command))))
)

# --- messages ---------------------------------------------------------------------------------------------------------


@st.composite
def messages(draw: st.DrawFn, kind: type[MessageT], profile: Profile | None = None) -> MessageT:
    """Make messages of a class, abstract or not, that some module can send or receive.

    Shape: every value that fits in the digits of the message with `profile`, or with some profile.
    """
    kinds = [each for each in _MESSAGES if issubclass(each, kind)]
    return cast("MessageT", draw(_any_of(kinds, profile or draw(profiles()), accepted=False)))


def commands(profile: Profile, *kinds: type[AnyCommand]) -> SearchStrategy[AnyCommand]:
    """Make commands and broadcasts that `i7000.dcon.encode` accepts for `profile`, of the `kinds` it has."""
    kinds = tuple(kind for kind in kinds or _COMMANDS if kind.availability not in profile.refused)
    return _any_of(kinds, profile, accepted=True)


def any_commands(profile: Profile) -> SearchStrategy[AnyCommand]:
    """Make commands and broadcasts for a module, including those that it does not have or refuses."""
    return _any_of(_COMMANDS, profile, accepted=False)


def profiles_with(kind: type[AnyCommand]) -> SearchStrategy[Profile]:
    """Make profiles of modules that have a command."""
    models = [model for model in Model if model in kind.availability.gates]
    return profiles(*models).filter(lambda profile: kind.availability not in profile.refused)


@st.composite
def _any_of(draw: st.DrawFn, kinds: Sequence[type[Message]], profile: Profile, *, accepted: bool) -> Any:  # noqa: ANN401
    """Make messages of one of `kinds`."""
    # The address comes first, also for a broadcast: what takes more choices is never the smallest example.
    address = st.just(draw(addresses()))
    return draw(_messages(draw(st.sampled_from(kinds)), profile, accepted=accepted, fixed={"address": address}))


def responses(command: Command[R], profile: Profile) -> SearchStrategy[R | Refused]:
    """Make responses to `command` that `i7000.dcon.encode` accepts for `profile`."""
    repeated: dict[str, SearchStrategy[Any]] = {"address": st.just(command.answering_address)}
    if isinstance(command, ReadConfiguration) and command.address == 0:
        repeated["address"] = addresses()  # in INIT mode the response has the stored address
    if hasattr(command, "channel"):
        repeated["channel"] = st.just(command.channel)
    if isinstance(command, ReadAnalogInput):
        types = profile.type_codes[command.channel : command.channel + 1] or (None,)
        repeated["value"] = channel_fields(profile.data_format, types[0], legacy=profile.legacy_sentinels)
    valid = _messages(command.response, profile, accepted=True, fixed=repeated)
    return cast("SearchStrategy[R | Refused]", valid | st.builds(Refused, st.just(command.address)))


def _messages(
    kind: type[Message],
    profile: Profile,
    *,
    accepted: bool,
    fixed: Mapping[str, SearchStrategy[Any]],
) -> SearchStrategy[Message]:
    """Make messages of a concrete class; with `accepted`, only those that the module accepts or sends."""
    parts = {}
    for attribute in fields(kind):  # type: ignore[arg-type] # all concrete messages are attrs classes
        parts[attribute.name] = _part(attribute, kind, profile, accepted=accepted)
    parts |= {name: strategy for name, strategy in fixed.items() if name in parts}
    built = st.builds(kind, **parts)
    return built.filter(lambda message: is_accepted(message, profile)) if accepted else built


def _part(  # noqa: PLR0911 - a table
    attribute: "Attribute[Any]", kind: type[Message], profile: Profile, *, accepted: bool
) -> SearchStrategy[Any]:
    """Make values of one part of a syntax: all that fit; with `accepted`, mostly valid ones."""
    part, origin = _part_of(attribute.type), cast("Any", attribute.type).__origin__
    if origin is bool or (isinstance(origin, type) and issubclass(origin, Enum)):
        return st.sampled_from((False, True) if origin is bool else origin)
    if origin is LineSettings:
        return line_settings(profile if accepted else None)
    if origin is ReportSettings:
        return report_settings(profile if accepted else None)
    if origin is float:
        return st.integers(-99999, 99999).map(lambda tenths: tenths / 10) | st.just(-0.0)
    if TypeCode in get_args(origin):
        free = not accepted or (part.notation == "TT" and not profile.model.type_by_configuration)
        known = st.sampled_from((*supported_types(profile), MIXED))
        return known | st.integers(0, 0xFF).map(TypeCode.of) if free else known
    if part.longest and not part.contextual:
        return _versions() if kind is FirmwareVersion else names() if kind is ModuleName else _texts()
    if part.longest:
        width = part.longest(profile) // (1 if origin is str else profile.channels)
        data_format = DataFormat.HEX if width == FIELD_WIDTHS[DataFormat.HEX] else profile.data_format
        types = (accepted and profile.type_codes) or (None,) * profile.channels
        values = tuple(channel_fields(data_format, code, legacy=profile.legacy_sentinels) for code in types)
        return st.one_of(tuple(dict.fromkeys(values))) if origin is str else st.tuples(*values)
    return addresses() if attribute.name in ("address", "new_address") else _number(part, profile, accepted=accepted)


def _versions() -> SearchStrategy[str]:
    return st.builds("{}{}.{}".format, st.sampled_from(ascii_uppercase), st.integers(0, 9), st.integers(0, 99))


def _texts() -> SearchStrategy[str]:
    letters_first = sorted(CHARACTERS, key=lambda character: (not character.isalpha(), character))
    return st.text(st.sampled_from(letters_first), min_size=1, max_size=6)


def names() -> SearchStrategy[str]:
    """Make names that a module can have."""
    return _texts().filter(is_name)


def _number(part: Part, profile: Profile, *, accepted: bool) -> SearchStrategy[int]:
    if part.signed:
        return st.integers(*(CJC_OFFSETS if accepted else part.bounds or ()))
    if accepted and part in _LIMITS:
        return st.integers(0, _LIMITS[part](profile))
    digits = len(part.notation) if part.width is None else int(getattr(profile, str(part.width)))
    return st.integers(0, 16**digits - 1)


def _part_of(annotation: Any) -> Part:  # noqa: ANN401 - an Annotated type
    part: Part = annotation.__metadata__[0]
    return part


_LIMITS: dict[Part, Callable[[Profile], int]] = {
    _part_of(parts.ChannelN): lambda profile: profile.channels - 1,
    _part_of(parts.ChannelI): lambda profile: profile.channels - 1,
    _part_of(parts.CalibratedChannel): lambda profile: profile.channels - 1,
    _part_of(parts.Mask): lambda profile: (1 << profile.channels) - 1,
    _part_of(parts.DiagnosticMask): lambda profile: (1 << profile.channels) - 1,
    _part_of(parts.Seconds): lambda _: LONGEST_TIMEOUT,
}
"""Parts with much narrower limits than their digits allow; `check` alone would reject most values."""


@cache
def channel_fields(
    data_format: DataFormat, type_code: TypeCode | None = None, *, legacy: bool = False
) -> SearchStrategy[str]:
    """Make fields of one channel: sentinels, and the readings of a type, or any number."""
    special = [" " * FIELD_WIDTHS[data_format], *(("+9999", "-0000") if legacy else ())]
    if data_format is not DataFormat.HEX:
        special += ["+9999.9", "-9999.9", "+999.99", "-999.99"]
    if type_code is not None:
        numbers = readings(type_code, data_format).map(lambda it: encode_field(it, type_code, data_format))
    elif data_format is DataFormat.HEX:
        numbers = st.integers(0, 0xFFFF).map("{:04X}".format)
    else:
        points = (3, 2, 4, 5) if data_format is DataFormat.ENGINEERING else (4,)
        forms = [(sign, point) for point in points for sign in "+-"]
        numbers = st.integers(0, len(forms) * 10**5 - 1).map(
            lambda n: _with_point(n // len(forms), *forms[n % len(forms)])
        )
    return numbers | st.sampled_from(special)


def _with_point(digits: int, sign: str, point: int) -> str:
    text = f"{sign}{digits:05d}"
    return f"{text[:point]}.{text[point:]}"


# --- exchanges --------------------------------------------------------------------------------------------------------


@frozen
class Exchange:
    """A command, its response, and the frames of both."""

    profile: Profile
    command: Command[Any]
    command_wire: bytes
    response: Response
    response_wire: bytes


@st.composite
def exchanges(draw: st.DrawFn, *kinds: type[Command[Any]], profile: Profile | None = None) -> Exchange:
    """Make exchanges of `kinds`, or of all, with the module of `profile`, or with any module that has the command."""
    asked = [kind for kind in kinds or _COMMANDS if issubclass(kind, Command)]
    had = [kind for kind in asked if profile is None or kind.availability not in profile.refused]
    kind = draw(st.sampled_from(had))
    profile = profile or draw(profiles_with(kind))
    command = cast("Command[Any]", draw(commands(profile, kind)))
    response: Response = draw(responses(command, profile))
    return Exchange(profile, command, encode(command, profile), response, encode(response, profile))
