"""Strategies for Modbus messages and for whole exchanges.

Laws: strategies are made from the fields of a message class, so new requests need no code here. The message's own
`check` decides what a module accepts.
"""

from collections.abc import Sequence
from struct import unpack
from typing import Any, TypeVar, cast

from attrs import Attribute, fields, frozen
from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from i7000 import LineSettings, Model, Profile, Protocol, TypeCode
from i7000.modbus import (
    BROADCAST,
    REQUESTS,
    ExceptionCode,
    ExceptionResponse,
    Message,
    ReadCjcOffset,
    ReadCoils,
    ReadDiscreteInputs,
    ReadHoldingRegisters,
    ReadInputRegisters,
    Request,
    Response,
    SetCjcOffset,
    WriteMultipleCoils,
    WriteMultipleRegisters,
    encode,
    is_answered,
    items,
)
from i7000.modbus.cold_junction import FIRST_CHANNEL
from i7000.profile import CJC_OFFSETS
from i7000.strategies import vocabulary
from i7000.strategies.vocabulary import is_accepted, line_settings, supported_types

__all__ = [
    "Exchange",
    "any_requests",
    "exception_responses",
    "exchanges",
    "messages",
    "profiles",
    "profiles_with",
    "requests",
    "responses",
]

MessageT = TypeVar("MessageT", bound=Message)
R = TypeVar("R", bound=Response)

_REQUESTS = sorted(REQUESTS, key=lambda request: len(request.pdu))
"""The requests, the shortest first: `ReadModuleName`."""
_MESSAGES: tuple[type[Message], ...] = (*_REQUESTS, ExceptionResponse, *(kind.response for kind in _REQUESTS))
_MODELS = [model for model in Model if Protocol.MODBUS_RTU in model.protocols]
_ADDRESSES = range(1, 248)
_ALL_ADDRESSES = 0x10000

# --- profiles ---------------------------------------------------------------------------------------------------------


def profiles(*, known_types: bool = False) -> SearchStrategy[Profile]:
    """Make profiles of modules that support Modbus, M-7017 first; `known_types` as in `i7000.strategies.profiles`."""
    return vocabulary.profiles(*_MODELS, known_types=known_types)


def profiles_with(kind: type[Request[Any]]) -> SearchStrategy[Profile]:
    """Make profiles of modules that have a request."""
    models = [model for model in _MODELS if model in kind.availability.gates]
    return vocabulary.profiles(*models).filter(lambda profile: kind.availability not in profile.refused)


# --- messages ---------------------------------------------------------------------------------------------------------


@st.composite
def messages(draw: st.DrawFn, kind: type[MessageT], profile: Profile | None = None) -> MessageT:
    """Make messages of a class, abstract or not, that some module can send or receive.

    Shape: every value that fits in the bytes of the message with `profile`, or with some profile.
    """
    kinds = [each for each in _MESSAGES if issubclass(each, kind)]
    return draw(_any_of(kinds, profile or draw(profiles()), accepted=False))


def requests(profile: Profile, *kinds: type[Request[Any]]) -> SearchStrategy[Request[Any]]:
    """Make requests that `i7000.modbus.encode` accepts for `profile`, of all `kinds` that the module has."""
    had = [kind for kind in kinds or _REQUESTS if kind.availability not in profile.refused]
    return _any_of(had, profile, accepted=True)


def any_requests(profile: Profile) -> SearchStrategy[Request[Any]]:
    """Make requests for a module, including those that it does not have or refuses."""
    return _any_of(_REQUESTS, profile, accepted=False)


def responses(request: Request[R], profile: Profile) -> SearchStrategy[R | ExceptionResponse]:
    """Make responses to `request`, which is not a broadcast, that `i7000.modbus.encode` accepts for `profile`.

    Shape: as many items as requested; write responses repeat the request; no reserved bits.
    """
    known: dict[str, Any] = {"address": request.address}
    if isinstance(request, ReadCoils | ReadDiscreteInputs | ReadHoldingRegisters | ReadInputRegisters):
        known["count"] = request.count
    elif isinstance(request, WriteMultipleCoils | WriteMultipleRegisters):
        known |= {"start": request.start, "count": len(request.values)}
    elif isinstance(request, ReadCjcOffset):
        known["channel"] = request.channel
    elif request.broadcast:
        known |= {it.name: getattr(request, it.name) for it in fields(type(request))}
    valid = _messages(request.response, profile, accepted=True, known=known)
    return cast("SearchStrategy[R | ExceptionResponse]", valid | exception_responses(request))


def exception_responses(request: Request[Any]) -> SearchStrategy[ExceptionResponse]:
    """Make exceptions that answer `request`, with defined codes."""
    codes = st.sampled_from([code.value for code in ExceptionCode])
    return st.builds(ExceptionResponse, st.just(request.address), st.just(request.function), codes)


def _any_of(kinds: Sequence[type[MessageT]], profile: Profile, *, accepted: bool) -> SearchStrategy[MessageT]:
    """Make messages of one of `kinds`."""
    made = st.sampled_from(kinds).flatmap(lambda kind: _messages(kind, profile, accepted=accepted, known={}))
    return cast("SearchStrategy[MessageT]", made)


def _messages(
    kind: type[Message], profile: Profile, *, accepted: bool, known: dict[str, Any]
) -> SearchStrategy[Message]:
    """Make messages of a concrete class; with `accepted`, only those that the module accepts or sends."""
    built = _built(kind, profile, accepted, known)
    return built.filter(lambda message: is_accepted(message, profile)) if accepted else built


@st.composite
def _built(
    draw: st.DrawFn,
    kind: type[Message],
    profile: Profile,
    accepted: bool,  # noqa: FBT001 - of our own
    known: dict[str, Any],
) -> Message:
    """Make messages field by field: the values of a field depend on the fields before it."""
    values: dict[str, Any] = {}
    for attribute in fields(kind):
        name = attribute.name
        if name in known:
            values[name] = known[name]
            continue
        part = _settable(kind, name, profile, values | known) if accepted else None
        values[name] = draw(_part(kind, attribute, profile, values | known) if part is None else part)
    return kind(**values)


def _settable(  # noqa: PLR0911 - a table
    kind: type[Message], name: str, profile: Profile, values: dict[str, Any]
) -> SearchStrategy[Any] | None:
    """Make values of a field that a module accepts, if they are far fewer than its bytes allow."""
    of_offset = kind in (ReadCjcOffset, SetCjcOffset)
    match name:
        case "channel" if of_offset:
            return st.sampled_from((0, *range(FIRST_CHANNEL, FIRST_CHANNEL + profile.channels)))
        case "channel":
            return st.integers(0, profile.channels - 1 if profile.individually_configurable else 0)
        case "offset" if "channel" in values:
            return st.integers(0, 0xFF) if values["channel"] else st.integers(*CJC_OFFSETS)
        case "mask":
            return st.integers(0, (1 << profile.channels) - 1)
        case "settings":
            return st.sampled_from((0x00, 0x20, 0x80, 0xA0))
        case "type_code" if issubclass(kind, Request):
            return st.sampled_from(supported_types(profile))
        case "line_settings" if issubclass(kind, Request):
            return line_settings(profile)
        case "values" if kind is WriteMultipleRegisters and profile.model.series == "7019":
            return _words(st.integers(1, min(11, _ALL_ADDRESSES - values["start"])))
    return None


_TYPES: dict[Any, SearchStrategy[Any]] = {
    TypeCode: st.sampled_from(TypeCode) | st.integers(0, 0xFF).map(TypeCode.of),
    LineSettings: line_settings(),
}
"""The values of types whose fields have more values than the type has members."""


def _part(  # noqa: PLR0911 - a table
    kind: type[Message], attribute: "Attribute[Any]", profile: Profile, values: dict[str, Any]
) -> SearchStrategy[Any]:
    """Make values of a field that are possible with the `values` of the other fields."""
    item: items.Item = cast("Any", attribute.type).__metadata__[0]
    if attribute.type is items.Address:
        return st.sampled_from((*_ADDRESSES, *[BROADCAST] * 25)) if _can_be_broadcast(kind) else st.integers(1, 247)
    if attribute.type is items.Mask:
        return st.integers(0, 16**profile.mask_digits - 1)
    if item.values in _TYPES:
        return _TYPES[item.values]
    if item.values:
        return st.sampled_from((False, True) if item.values is bool else item.values)
    room = _ALL_ADDRESSES - values.get("start", 0)
    if item.most:
        counts = st.just(values["count"]) if "count" in values else _count(min(item.most, room))
        return _bits(counts) if item.accepts((True,)) else _words(counts)
    if item.bounds:
        low, high = item.bounds
        return _count(min(high, room)) if item.role == "count" else st.integers(low, high)
    return st.binary(min_size=4, max_size=4)  # a name


def _can_be_broadcast(kind: type[Message]) -> bool:
    return issubclass(kind, Request) and kind.broadcast


def _count(most: int) -> SearchStrategy[int]:
    """Make numbers of items, half of them small."""
    return st.integers(1, min(most, 17)) | st.integers(1, most)


def _bits(counts: SearchStrategy[int]) -> SearchStrategy[tuple[bool, ...]]:
    return counts.flatmap(
        lambda count: st.integers(0, (1 << count) - 1).map(
            lambda number: tuple(bool(number >> at & 1) for at in range(count))
        )
    )


def _words(counts: SearchStrategy[int]) -> SearchStrategy[tuple[int, ...]]:
    return counts.flatmap(
        lambda count: st.binary(min_size=2 * count, max_size=2 * count).map(lambda data: unpack(f">{count}H", data))
    )


# --- exchanges --------------------------------------------------------------------------------------------------------


@frozen
class Exchange:
    """A request, its response, and the frames of both."""

    profile: Profile
    request: Request[Any]
    request_wire: bytes
    response: Response
    response_wire: bytes


@st.composite
def exchanges(draw: st.DrawFn, *kinds: type[Request[Any]], profile: Profile | None = None) -> Exchange:
    """Make exchanges of `kinds`, or of all, with the module of `profile`, or with any module that has the request."""
    asked = kinds or _REQUESTS
    had = [kind for kind in asked if profile is None or kind.availability not in profile.refused]
    kind = draw(st.sampled_from(had))
    profile = profile or draw(profiles_with(kind))
    request = draw(requests(profile, kind).filter(is_answered))
    response: Response = draw(responses(request, profile))
    return Exchange(profile, request, encode(request, profile), response, encode(response, profile))
