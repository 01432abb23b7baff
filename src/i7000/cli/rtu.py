"""What Modbus RTU frames mean: requests, the responses to them, echoes, and responses without their request.

A frame does not tell its direction, so it is told from what came before: a `Listener` hears one after the other.

Laws: every meaning is one that a codec of `i7000.modbus` found, with each profile that fits what is known.
"""

from collections.abc import Callable
from functools import lru_cache
from operator import attrgetter
from typing import Any

from attrs import evolve, frozen

from i7000 import DecodeError, EncodeError, Fault, ModbusDataFormat, Model, Profile, Protocol, modbus
from i7000.cli.dcon import Known
from i7000.cli.words import UsageError
from i7000.modbus.request import EXCEPTION_BIT, LAST_ADDRESS

__all__ = ["MODELS", "Heard", "Listener", "Meaning", "profiles"]

MODELS = tuple(model for model in Model if Protocol.MODBUS_RTU in model.protocols)
"""Those that speak Modbus."""

_ANOTHER = (Fault.ADDRESS, Fault.FUNCTION, Fault.SUB_FUNCTION)
"""Faults that say that something else was asked for."""


def profiles(known: Known) -> tuple[Profile, ...]:
    """Every profile that what is known fits; of all models that speak Modbus if none is known, and without types then.

    Errors: `UsageError` for a model that does not speak it.
    """
    if known.model and known.model not in MODELS:
        raise UsageError(f"{known.model.value} has no Modbus: M-7000 series only")
    found = []
    for model in (known.model,) if known.model else MODELS:
        for single_ended in (False, True) if known.single_ended is None else (known.single_ended,):
            try:
                profile: Any = evolve(known, model=model, single_ended=single_ended).default
            except EncodeError:
                continue
            data_format = known.modbus_data_format or ModbusDataFormat.HEX
            found.append(evolve(profile, modbus_data_format=data_format))
    return tuple(found)


@frozen(eq=False)
class Meaning:
    """What a frame means."""

    message: modbus.Message
    request: modbus.Request[Any] | None
    """The one that it answers."""
    profiles: tuple[Profile, ...]
    """Those it was read with."""

    @property
    def is_answered(self) -> bool:
        """Whether a response to it is to be expected."""
        return self.message.address != modbus.BROADCAST


@frozen
class Heard:
    """What was made of a frame."""

    direction: str | None = None
    """``request``, ``response`` or ``echo``."""
    meaning: Meaning | None = None
    answers: int | None = None
    """The line of the request."""
    note: str | None = None
    error: DecodeError | None = None
    candidates: tuple[Meaning, ...] = ()
    """What a frame would mean by itself that is wrong where it stands."""


@frozen
class _Asked:
    """The request before."""

    line: int
    frame: bytes
    meaning: Meaning
    echoed: bool = False


_Tried = tuple[Meaning | None, DecodeError | None]
"""What came of reading a frame: a meaning, or what is wrong."""
_REMEMBERED = 256
"""Frames that are not decoded again when they come again: who polls sends the same again and again."""


class Listener:
    """Both sides of a line, as a log has them."""

    def __init__(self, fitting: tuple[Profile, ...]) -> None:
        remembered = lru_cache(maxsize=_REMEMBERED)
        self._request = remembered(lambda frame: _tried(lambda: _request(frame, fitting)))
        self._alone = remembered(lambda frame: _tried(lambda: _alone(frame, fitting)))
        self._response = remembered(lambda frame, asked: _tried(lambda: _response(frame, asked)))
        self._asked: _Asked | None = None
        self._in_step = False
        """Whether a request is what comes next."""
        self._echoes = False
        """Whether the adapter sends back what it is given."""

    def hear(self, line: int, frame: bytes) -> Heard:
        """Return what a frame means after those that were heard before it.

        Special: what is the same as the request before it is its response where it can be, unless the line is known to
            echo; a line is known to echo when a request came twice that cannot be its own response.
        """
        asked = self._asked
        response = fault = None
        if asked and asked.meaning.is_answered:
            response, fault = self._response(frame, asked.meaning)
        if asked and frame == asked.frame and not asked.echoed and (response is None or self._echoes):
            self._asked = evolve(asked, echoed=True)
            self._echoes = True
            return Heard(
                "echo", asked.meaning, note=f"the same as line {asked.line}: a 2-wire adapter's echo, or asked again"
            )
        if asked and response:
            self._echoes = asked.echoed
            self._asked, self._in_step = None, True
            return Heard("response", response, answers=asked.line)
        request, no_request = self._request(frame)
        alone, _ = self._alone(frame)
        if request:
            note = _doubt(alone, fault, asked, in_step=self._in_step)
            self._asked, self._in_step = _Asked(line, frame, request), not request.is_answered
            return Heard("request", request, note=note)
        if alone and not fault:
            return Heard("response", alone, note="read without its request")
        if not alone and len(frame) >= modbus.SHORTEST_FRAME:
            self._asked, self._in_step = None, False
        candidates = (alone,) if alone else ()
        return Heard("response" if alone else None, error=fault or no_request, candidates=candidates)


def _doubt(alone: Meaning | None, fault: DecodeError | None, asked: _Asked | None, *, in_step: bool) -> str | None:
    """What else a request could be."""
    if alone and asked and fault and fault.fault not in _ANOTHER:
        return f"or a wrong response to line {asked.line}: {fault}"
    if alone and not asked and not in_step:
        return f"or a response, {type(alone.message).__name__}: nothing before it tells"
    return None


def _tried(read: Callable[[], Meaning]) -> _Tried:
    try:
        return read(), None
    except DecodeError as fault:
        return None, fault.with_traceback(None)


_FORM = attrgetter("channels", "mask_digits")
"""What decides how a profile reads a frame."""


def _read(read: Callable[[Profile], modbus.Message], fitting: tuple[Profile, ...], request: Any) -> Meaning:  # noqa: ANN401
    """Read with each form of profiles; those that can read a frame at all read the same."""
    faults: dict[object, DecodeError] = {}
    messages: dict[object, modbus.Message] = {}
    for form, profile in {_FORM(profile): profile for profile in reversed(fitting)}.items():
        try:
            messages[form] = read(profile)
        except DecodeError as fault:
            faults[form] = fault
    if not messages:
        raise faults[_FORM(fitting[0])]
    found = tuple(profile for profile in fitting if _FORM(profile) in messages)
    return Meaning(messages[_FORM(found[0])], request, found)


def _request(frame: bytes, fitting: tuple[Profile, ...]) -> Meaning:
    return _read(lambda profile: modbus.decode_request(frame, profile), fitting, None)


def _response(frame: bytes, asked: Meaning) -> Meaning:
    request: Any = asked.message
    return _read(lambda profile: modbus.decode_response(frame, request, profile), asked.profiles, request)


def _alone(frame: bytes, fitting: tuple[Profile, ...]) -> Meaning:
    """Read a response without its request."""
    body = modbus.unseal(frame)
    function, sub_function = body[1], body[2:3]
    kind: type[modbus.Message] | None = None
    if function & EXCEPTION_BIT and len(body) == len("afe"):
        kind = modbus.ExceptionResponse
    for request in modbus.REQUESTS:
        if function == request.function and request.sub_function in (None, *sub_function):
            kind = request.response
    if kind is None or not 1 <= body[0] <= LAST_ADDRESS:
        raise DecodeError(Fault.FUNCTION, frame)
    return _read(lambda profile: kind.layout.decode(body, profile), fitting, None)
