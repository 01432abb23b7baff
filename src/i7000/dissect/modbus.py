"""Modbus RTU frames -> their possible meanings, with complete, partial or no knowledge of the module.

A frame does not show its direction: it is read as a request, as the response to a request, and as a response by itself.

Laws: every meaning is one that a codec of `i7000.modbus` found, with each profile that fits what is known.
"""

from collections.abc import Callable, Iterator
from functools import lru_cache
from operator import attrgetter
from typing import Any, NamedTuple

from i7000 import modbus
from i7000.dissect.known import Fact, Known, Origin
from i7000.dissect.meaning import ChannelReading, Fit, Item, Meaning
from i7000.dissect.registers import items
from i7000.errors import DecodeError, Fault
from i7000.modbus.request import EXCEPTION_BIT, LAST_ADDRESS
from i7000.profile import Profile

__all__ = ["ModbusRead", "ModbusReader"]

_REMEMBERED = 256
"""Frames that are not decoded again when they come again: a host that polls sends the same again and again."""
_FORM = attrgetter("channels", "mask_digits")
"""What decides how a profile reads a frame."""


class ModbusRead(NamedTuple):
    """The result of reading a frame: a meaning, or an error."""

    meaning: Meaning | None
    error: DecodeError | None = None


class ModbusReader:
    """A reader of the frames of a module, with what is known of it; it caches what the next frame needs.

    Errors: `EncodeError` if no module that speaks Modbus is like that.
    """

    def __init__(self, known: Known) -> None:
        self._known = known
        self._profiles = known.modbus
        self._fits: dict[tuple[int, ...], Fit] = {}
        remembered = lru_cache(maxsize=_REMEMBERED)
        self._facts = remembered(lambda fit: tuple(self._facts_of(fit.profiles[0])))
        self.request = remembered(self._request)
        self.response = remembered(self._response)
        self.alone = remembered(self._alone)

    def _request(self, frame: bytes) -> ModbusRead:
        """Read a request."""
        return self._read(lambda profile: modbus.decode_request(frame, profile), self._profiles, None)

    def _response(self, frame: bytes, asked: Meaning) -> ModbusRead:
        """Read the response to a request."""
        request: Any = asked.message
        return self._read(lambda profile: modbus.decode_response(frame, request, profile), asked.fit.profiles, request)

    def _alone(self, frame: bytes) -> ModbusRead:
        """Read a response without its request."""
        try:
            body = modbus.unseal(frame)
        except DecodeError as fault:
            return ModbusRead(None, fault)
        function, sub_function = body[1], body[2:3]
        kind: type[modbus.Message] | None = None
        if function & EXCEPTION_BIT and len(body) == len("afe"):
            kind = modbus.ExceptionResponse
        for request in modbus.REQUESTS:
            if function == request.function and request.sub_function in (None, *sub_function):
                kind = request.response
        if kind is None or not 1 <= body[0] <= LAST_ADDRESS:
            return ModbusRead(None, DecodeError(Fault.FUNCTION, frame))
        return self._read(lambda profile: kind.layout.decode(body, profile), self._profiles, None)

    def _read(
        self,
        read: Callable[[Profile], modbus.Message],
        fitting: tuple[Profile, ...],
        request: Any,  # noqa: ANN401
    ) -> ModbusRead:
        """Read with each form of profiles; those that can read a frame at all read the same."""
        faults: dict[object, DecodeError] = {}
        messages: dict[object, modbus.Message] = {}
        for form, profile in {_FORM(profile): profile for profile in reversed(fitting)}.items():
            try:
                messages[form] = read(profile)
            except DecodeError as fault:
                faults[form] = fault.with_traceback(None)
        if not messages:
            return ModbusRead(None, faults[_FORM(fitting[0])])
        found = tuple(profile for profile in fitting if _FORM(profile) in messages)
        return ModbusRead(self._meaning(messages[_FORM(found[0])], request, found))

    def _meaning(self, message: modbus.Message, request: Any, found: tuple[Profile, ...]) -> Meaning:  # noqa: ANN401
        profile = found[0] if self._known.model else None
        touched = tuple(items(message, request, profile))
        readings = tuple(map(_reading, filter(_READING, touched)))
        availability = (request or message).availability
        notes: tuple[str, ...] = ()
        if profile and availability in profile.refused:
            notes = (f"{profile.name} has no {message.title} by Modbus: {availability.scope}",)
        fit = self._fits.setdefault(tuple(map(id, found)), Fit(found))
        return Meaning(message, request, fit, readings, touched, self._facts(fit) if readings else (), notes)

    def _facts_of(self, profile: Profile) -> Iterator[Fact]:
        """Yield what readings rest on: what is known, and what they have by default."""
        known = self._known
        for name, value in (("types", profile.type_codes), ("modbus_data_format", profile.modbus_data_format)):
            origin = Origin.ASSUMED if getattr(known, name) is None else Origin.GIVEN
            yield Fact(name, value, origin)


_READING = attrgetter("reading")


def _reading(item: Item) -> ChannelReading:
    assert item.reading  # noqa: S101 - only those are asked for
    return ChannelReading(
        item.channel, item.text or "", item.reading.status, item.type_code, item.value, item.reading.unit
    )
