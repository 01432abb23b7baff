"""Functions that convert messages to RTU frames and back (manual 3).

Laws: `encode` raises only `EncodeError`; the decoders raise only `DecodeError`. Decoding an encoded message returns an
equal message. Every request that some module accepts decodes, even if this module would answer with an exception.
"""

from typing import Any, TypeVar

from attrs import evolve

from i7000.arguments import as_bytes, check_type
from i7000.errors import DecodeError, EncodeError, Fault
from i7000.modbus import channel_settings, cold_junction, module_settings, standard
from i7000.modbus.channel_settings import ReadChannelMask, ReadMiscellaneousSettings
from i7000.modbus.cold_junction import ReadCjcOffset
from i7000.modbus.frame import SHORTEST_FRAME, sealed, unseal
from i7000.modbus.request import (
    BROADCAST,
    EXCEPTION_BIT,
    LAST_ADDRESS,
    MODULE_SETTINGS,
    ExceptionResponse,
    Message,
    Request,
    Response,
)
from i7000.modbus.standard import (
    ReadCoils,
    ReadDiscreteInputs,
    ReadHoldingRegisters,
    ReadInputRegisters,
    WriteMultipleCoils,
    WriteSingleCoil,
)
from i7000.profile import Profile

__all__ = [
    "REQUESTS",
    "decode_request",
    "decode_response",
    "encode",
    "is_answered",
    "longest_response",
    "pause_after",
]

_FAMILIES = (standard, module_settings, channel_settings, cold_junction)
_FOUND: list[type[Request[Any]]] = [request for family in _FAMILIES for request in family.REQUESTS]
REQUESTS: tuple[type[Request[Any]], ...] = tuple(
    sorted(_FOUND, key=lambda request: (request.function, request.sub_function or 0))
)
"""Every request, by function and sub-function."""

R = TypeVar("R", bound=Response)

_BY_FUNCTION = {request.function: request for request in REQUESTS if request.sub_function is None}
_BY_SUB_FUNCTION = {request.sub_function: request for request in REQUESTS if request.sub_function is not None}


def encode(message: Message, profile: Profile | None = None, *, force: bool = False) -> bytes:
    """Encode a request or a response as an RTU frame.

    Special: with a profile, messages that the module does not have are refused unless `force` is set. Masks need a
        profile for their length, which even `force` cannot exceed.
    Errors: `EncodeError` with the reason.
    Manual: 3.

    >>> encode(ReadInputRegisters(0x01, 0, 8)).hex()
    '010400000008f1cc'
    """
    if not isinstance(message, Message):
        check_type("message", message, Message)  # type: ignore[unreachable] # with types
    if force is not False:
        check_type("force", force, bool)
    if message.address == BROADCAST and not (isinstance(message, Request) and message.broadcast):
        raise EncodeError("address", BROADCAST, "1..247; 0 is for functions 05, 06, 0F, 10", message.section)
    if profile is not None:
        if profile.__class__ is not Profile:
            check_type("profile", profile, Profile)
        if not force:
            if message.availability in profile.refused:
                raise EncodeError(
                    "model", profile.model.value, message.availability.scope, message.section,
                    f"{profile.name} has no {message.title} by Modbus",
                )  # fmt: skip
            message.check(profile)
    return sealed(message.layout.encode(message, profile))


def is_answered(request: Request[Any]) -> bool:
    """Return whether a module answers `request`: False for a broadcast."""
    if not isinstance(request, Request):
        check_type("request", request, Request)  # type: ignore[unreachable] # with types
    return request.address != BROADCAST


def decode_request(frame: bytes, profile: Profile) -> Request[Any]:
    """Decode a frame that a host sent to the module of `profile`.

    Special: requests for what the module does not have are decoded; the module answers with an exception.
    Errors: `DecodeError`; `Fault.FUNCTION` and `SUB_FUNCTION` for functions that no module has.
    Manual: 3; E94, E99.

    >>> from i7000 import Model
    >>> decode_request(bytes.fromhex("010400000008f1cc"), Profile(Model.M_7017))
    ReadInputRegisters(address=0x01, start=0, count=8)
    """
    if profile.__class__ is not Profile:
        check_type("profile", profile, Profile)
    if frame.__class__ is not bytes:
        frame = as_bytes("frame", frame)
    body = unseal(frame)
    function = body[1]
    if body[0] > LAST_ADDRESS:
        raise _address_error(frame)
    if function == MODULE_SETTINGS:
        if len(body) < len("afs"):
            raise DecodeError(Fault.LENGTH, frame, 2, field="sub_function", allowed="one more byte", section="3.3")
        kind = _BY_SUB_FUNCTION.get(body[2])
        if kind is None:
            raise _sub_function_error(frame, " ".join(f"{it:02X}" for it in _BY_SUB_FUNCTION))
    else:
        kind = _BY_FUNCTION.get(function)
        if kind is None:
            allowed = " ".join(f"{it:02X}" for it in (*_BY_FUNCTION, MODULE_SETTINGS))
            raise DecodeError(Fault.FUNCTION, frame, 1, field="function", allowed=allowed, section="3")
    if body[0] == BROADCAST and not kind.broadcast:
        raise _address_error(frame)
    request: Request[Any] = _decode(kind, body, frame, profile)
    return request


def decode_response(frame: bytes, request: Request[R], profile: Profile) -> R | ExceptionResponse:
    """Decode the response to `request`, and check it against the request.

    Errors: `DecodeError`; `Fault.ADDRESS`, `FUNCTION` or `SUB_FUNCTION` for the response to another request, `COUNT`
        for a wrong number of items, `ECHO` for a write that is not repeated.
    Manual: 3.

    >>> from i7000 import Model
    >>> decode_response(bytes.fromhex("018402c2c1"), ReadInputRegisters(0x01, 200, 1), Profile(Model.M_7017))
    ExceptionResponse(address=0x01, function=4, exception_code=2)
    """
    if profile.__class__ is not Profile:
        check_type("profile", profile, Profile)
    if frame.__class__ is not bytes:
        frame = as_bytes("frame", frame)
    if not isinstance(request, Request):
        check_type("request", request, Request)  # type: ignore[unreachable] # with types
    if len(frame) == SHORTEST_FRAME:  # of a request
        raise DecodeError(Fault.LENGTH, frame, SHORTEST_FRAME - 2, allowed="at least 5 bytes", section="3")
    body = unseal(frame)
    if body[0] != request.address or body[0] == BROADCAST:
        allowed = f"{request.address:02X}" if is_answered(request) else "no response to a broadcast"
        raise DecodeError(Fault.ADDRESS, frame, 0, field="address", allowed=allowed, section=request.section)
    function = body[1]
    if function != request.function:
        if function != request.function | EXCEPTION_BIT:
            allowed = f"{request.function:02X} {request.function | EXCEPTION_BIT:02X}"
            raise DecodeError(Fault.FUNCTION, frame, 1, field="function", allowed=allowed, section=request.section)
        exception: ExceptionResponse = _decode(ExceptionResponse, body, frame, profile)
        return exception
    if function == MODULE_SETTINGS and body[2] != request.sub_function:
        raise _sub_function_error(frame, f"{request.sub_function:02X}")
    if request.broadcast:
        _check_echo(request, body, frame)
    response: R = _held_against(request, _decode(request.response, body, frame, profile), frame, profile)
    return response


def _address_error(frame: bytes) -> DecodeError:
    return DecodeError(
        Fault.ADDRESS, frame, 0, field="address", allowed="1..247, and 0 for functions 05, 06, 0F, 10", section="3"
    )


def _sub_function_error(frame: bytes, allowed: str) -> DecodeError:
    return DecodeError(Fault.SUB_FUNCTION, frame, 2, field="sub_function", allowed=allowed, section="3.3")


def _decode(kind: Any, body: bytes, frame: bytes, profile: Profile) -> Any:  # noqa: ANN401 - a message class, a message
    try:
        return kind.layout.decode(body, profile)
    except DecodeError as error:
        raise DecodeError(
            error.fault, frame, error.offset, field=error.field, allowed=error.allowed, section=kind.section
        ) from None


_READS_OF_WORDS = (ReadHoldingRegisters, ReadInputRegisters)
_READS_OF_BITS = (ReadCoils, ReadDiscreteInputs)


def _held_against(request: Any, response: Any, frame: bytes, profile: Profile) -> Any:  # noqa: ANN401 - of any class
    """Check the number of items and the reserved bits against the request; drop padding bits (E120)."""
    if isinstance(request, _READS_OF_WORDS):
        if len(response.values) != request.count:
            raise _count_error(frame, 2 * request.count, request.section)
    elif isinstance(request, _READS_OF_BITS):
        if len(response.values) != request.count + 7 >> 3 << 3:
            raise _count_error(frame, request.count + 7 >> 3, request.section)
        return evolve(response, values=response.values[: request.count])
    elif request.sub_function in _WITH_RESERVED_BITS and response.reserved_bits(request, profile):
        allowed = "reserved bits zero"
        raise DecodeError(Fault.RESERVED, frame, 3, allowed=allowed, section=request.section)
    return response


_WITH_RESERVED_BITS = (ReadChannelMask.sub_function, ReadMiscellaneousSettings.sub_function, ReadCjcOffset.sub_function)


def _count_error(frame: bytes, count: int, section: str) -> DecodeError:
    return DecodeError(Fault.COUNT, frame, 2, field="bytes", allowed=f"{count}, as requested", section=section)


def _check_echo(request: Request[Any], body: bytes, frame: bytes) -> None:
    """Check what a write response repeats: the beginning of the request."""
    said = request.layout.encode(request, None)[: request.response.layout.fixed]
    if len(body) != len(said):
        allowed = f"{len(said)} bytes of address and PDU"
        raise DecodeError(Fault.LENGTH, frame, min(len(body), len(said)), allowed=allowed, section=request.section)
    for at, (byte, expected) in enumerate(zip(body, said, strict=True)):
        if byte != expected:
            raise DecodeError(Fault.ECHO, frame, at, allowed=said.hex(" "), section=request.section)


# --- timing and lengths -----------------------------------------------------------------------------------------------

_EXCEPTION = len("AFE")
_CRC = len("CC")
_BROADCAST_PAUSE = 0.002
_FACTORY_CALIBRATION = 271
"""The address of coil 00272."""
_FACTORY_CALIBRATION_PAUSE = 3.0


def longest_response(request: Request[Any], profile: Profile) -> int:
    """Return the length in bytes of the longest response to `request`, CRC included; 0 for a broadcast.

    >>> from i7000 import Model
    >>> longest_response(ReadInputRegisters(0x01, 0, 8), Profile(Model.M_7017))
    21
    """
    check_type("profile", profile, Profile)
    if not is_answered(request):
        return 0
    layout = request.response.layout
    items: int = getattr(request, "count", 0)
    tails = {"mask": profile.mask_digits // 2, "words": 2 * items, "bits": items + 7 >> 3}
    return max(layout.fixed + tails.get(layout.tail, 0), _EXCEPTION) + _CRC


def pause_after(request: Request[Any], profile: Profile) -> float:
    """Return how many seconds to wait after `request` before the next one.

    Time: 2 ms after broadcasts; 3 s after loading the factory calibration.
    Manual: 3.4.8, 3.4.9; E103.

    >>> from i7000 import Model
    >>> pause_after(WriteSingleCoil(0x01, 271, value=True), Profile(Model.M_7019R))
    3.0
    """
    check_type("profile", profile, Profile)
    if _loads_factory_calibration(request):
        return _FACTORY_CALIBRATION_PAUSE
    return 0.0 if is_answered(request) else _BROADCAST_PAUSE


def _loads_factory_calibration(request: Request[Any]) -> bool:
    if isinstance(request, WriteSingleCoil):
        return request.coil == _FACTORY_CALIBRATION and request.value
    if isinstance(request, WriteMultipleCoils):
        at = _FACTORY_CALIBRATION - request.start
        return 0 <= at < len(request.values) and request.values[at]
    return False
