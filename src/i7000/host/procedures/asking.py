"""What procedures share: the words for a request and its outcome, and the requests that read one value."""

from collections.abc import Iterable
from typing import Any, TypeVar, cast

from attrs import evolve

from i7000 import dcon, modbus
from i7000.errors import written
from i7000.host.bus import Policy
from i7000.host.events import Answered, Declined, Rejected
from i7000.host.procedures.identified import Unknown
from i7000.host.procedures.step import Procedure, Result, ask
from i7000.message import Query, Response
from i7000.profile import Profile
from i7000.type_codes import TypeCode

__all__ = ["channel_types", "outcome_words", "request_words", "types_of", "unlearned", "value"]

R = TypeVar("R", bound=Response)


def request_words(command: Query[Any], profile: Profile) -> str:
    """Return a request in words: the text of a DCON command, the function of a Modbus request."""
    if isinstance(command, modbus.Request):
        sub = "" if command.sub_function is None else f", sub-function {command.sub_function:02X}"
        start = getattr(command, "start", None)
        return f"function {command.function:02X}{sub}" + ("" if start is None else f" of address {start}")
    frame = dcon.encode(cast(dcon.AnyCommand, command), evolve(profile, checksum=False), force=True)
    return frame.removesuffix(b"\r").decode()


def outcome_words(result: Result[Any], profile: Profile) -> str:
    """Return what came of a request in words: the answer, the refusal, or none, and what was received instead."""
    outcome = result.outcome
    request = request_words(outcome.command, profile)
    if isinstance(outcome, Answered):
        return f"{request} is answered"
    if isinstance(outcome, Declined):
        if isinstance(outcome.response, dcon.Refused):
            return f"{request} is refused"
        return f"{request} is refused: exception {outcome.response.describe()['exception_code']}"
    others = [written(other.wire) for other in result.others]
    rejected = [written(other.wire) for other in result.others if isinstance(other, Rejected)]
    if rejected:
        return f"the answer to {request} is not understood: {', '.join(dict.fromkeys(rejected))}"
    return f"no answer to {request}" + (f"; received {', '.join(others)}" if others else "")


def unlearned(name: str, result: Result[Any], profile: Profile) -> Unknown:
    """Return the property of a request that brought no answer."""
    return Unknown(name, outcome_words(result, profile), result.outcome)


def value(
    name: str, command: Query[R], profile: Profile, policy: Policy | None
) -> Procedure[tuple[R | None, tuple[Unknown, ...]]]:
    """Make the procedure of a request that reads the property `name`; without an answer, it is unknown."""
    result = yield from ask(command, profile, policy)
    if isinstance(result.outcome, Answered):
        return result.outcome.response, ()
    return None, (unlearned(name, result, profile),)


_ENOUGH = 2
"""The number of channels without an answer after which the others are not asked."""
_Types = tuple[tuple[TypeCode | None, ...] | None, tuple[Unknown, ...]]
"""The types of the channels that were learned, and what was not."""


def channel_types(commands: Iterable[Query[Any]], profile: Profile, policy: Policy | None) -> Procedure[_Types]:
    """Make the procedure that reads the type of each channel, with the request of each."""
    codes: list[int | None] = []
    missing: list[Unknown] = []
    for command in commands:
        answer, unanswered = yield from value("types", command, profile, policy)
        codes.append(None if answer is None else answer.type_code)
        missing += unanswered
        if len(missing) == len(codes) == _ENOUGH:
            break
    types, undefined = types_of(codes)
    return types, (*missing, *undefined)


def types_of(codes: Iterable[int | None]) -> _Types:
    """Return the types with these codes, None for those that are not defined or not known."""
    types: list[TypeCode | None] = []
    undefined = []
    for channel, code in enumerate(codes):
        known = None if code is None else TypeCode.of(code)
        types.append(known if isinstance(known, TypeCode) else None)
        if code is not None and types[-1] is None:
            undefined.append(Unknown("types", f"the type code {code:02X} of channel {channel} is not defined"))
    return (tuple(types) if any(code is not None for code in types) else None), tuple(undefined)
