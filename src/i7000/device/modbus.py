"""The Modbus RTU side of a module (manual 3): functions 01 to 06, 0F, 10 and 46h.

Laws: a module does not answer a damaged frame or a frame for another address. It answers an exception to a request that
it cannot carry out, and changes nothing. It carries out broadcasts without a response (E94). Every request that it
carries out restarts the host watchdog (E106, assumption: the protocol has no other way). Padding bits of coils are
ignored (E120).
"""

from collections.abc import Callable
from typing import Any

from attrs import evolve

from i7000 import modbus
from i7000.device.call import Call
from i7000.device.changes import enable_channels, set_address, set_cjc_update, set_line, set_types
from i7000.device.registers import RequestError, read, write
from i7000.device.signals import Signals
from i7000.device.state import State
from i7000.errors import DecodeError, EncodeError, Fault
from i7000.modbus import ExceptionCode
from i7000.settings import Filter

__all__ = ["step"]


def step(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
    """Process a frame for this module or for all; return the state after it, and the response or None for silence."""
    try:
        request = modbus.decode_request(frame, state.profile)
    except DecodeError as error:
        code = _code_of(error, state)
        return state, None if code is None else _exception(frame[0], frame[1], code, state)
    try:
        after, response = _carry_out(Call(state, request, signals, now))
    except RequestError as error:
        after, response = state, modbus.ExceptionResponse(request.address, request.function, error.code)
    else:
        if state.eeprom.host_watchdog_enabled:
            after = after.keep(fed_at=now)
    if not modbus.is_answered(request):
        return after, None
    return after, modbus.encode(response, state.profile)


_UNHEARD = (Fault.CRC, Fault.ADDRESS)


def _code_of(error: DecodeError, state: State) -> ExceptionCode | None:
    """Return the exception code for a damaged request; None for a frame that is not a request to this module.

    Manual: 3, 3.1, 3.2, 3.3; E94, E99.
    """
    frame = error.wire
    whole = modbus.SHORTEST_FRAME <= len(frame) <= modbus.LONGEST_FRAME
    if error.fault in _UNHEARD or not whole or frame[0] == modbus.BROADCAST:
        return None
    if error.fault is Fault.FUNCTION:
        return ExceptionCode.ILLEGAL_FUNCTION
    if error.fault is Fault.SUB_FUNCTION:
        return ExceptionCode.ILLEGAL_DATA_ADDRESS
    return _unsupported(error.section, state) or ExceptionCode.ILLEGAL_DATA_VALUE


_AVAILABILITY = {request.section: request.availability for request in modbus.REQUESTS}
"""The availability of the requests of a section; all requests of a section have the same."""


def _unsupported(section: str, state: State) -> ExceptionCode | None:
    """Return the exception code for a function that the model does not have: 01, or 02 for a sub-function."""
    if _AVAILABILITY.get(section) not in state.profile.refused:
        return None
    return ExceptionCode.ILLEGAL_DATA_ADDRESS if section.startswith("3.3.") else ExceptionCode.ILLEGAL_FUNCTION


def _exception(address: int, function: int, code: ExceptionCode, state: State) -> bytes | None:
    """Encode an exception; function codes 00 and 80 have no exception."""
    function &= 0x7F
    return modbus.encode(modbus.ExceptionResponse(address, function, code), state.profile) if function else None


def _carry_out(call: Call) -> tuple[State, modbus.Response]:
    request, profile = call.message, call.state.profile
    code = _unsupported(request.section, call.state)
    if code is not None:
        raise RequestError(code)
    try:
        request.check(profile)
    except EncodeError:
        raise RequestError(ExceptionCode.ILLEGAL_DATA_VALUE) from None
    kind = type(request)
    area = request.area
    if kind in _WRITTEN:
        written, acknowledgement = _WRITTEN[kind](request)
        return write(call, area, request.first_item, written), acknowledgement
    if area is not None:
        asked = range(request.start, request.start + request.count)
        state, items = read(call, area, asked)
        return state, request.response(call.address, tuple(map(bool, items)) if area.bits else items)
    if kind in _TOLD:
        return call.state, _TOLD[kind](call)
    return _DONE[kind](call), _acknowledgement(call)


# --- functions 01 to 10 -----------------------------------------------------------------------------------------------

_WRITTEN: dict[type, Callable[[Any], tuple[tuple[int, ...], modbus.Response]]] = {
    modbus.WriteSingleCoil: lambda it: ((it.value,), modbus.SingleCoilWritten(it.address, it.coil, it.value)),
    modbus.WriteSingleRegister: lambda it: (
        (it.value,), modbus.SingleRegisterWritten(it.address, it.register, it.value),
    ),
    modbus.WriteMultipleCoils: lambda it: (
        it.values, modbus.MultipleCoilsWritten(it.address, it.start, len(it.values)),
    ),
    modbus.WriteMultipleRegisters: lambda it: (
        it.values, modbus.MultipleRegistersWritten(it.address, it.start, len(it.values)),
    ),
}  # fmt: skip
"""The values that each request writes, and its response."""


# --- function 46h -----------------------------------------------------------------------------------------------------


def _miscellaneous(call: Call) -> int:
    report = call.eeprom.report_settings
    return report.filter.value << 7 | report.fast_mode << 5


def _offset(call: Call) -> int:
    """Return the offset of the module, or of a channel as a byte (E62)."""
    channel = call.message.channel
    return call.eeprom.channel_offsets[channel - 0x80] & 0xFF if channel else call.eeprom.cjc_offset


_TOLD: dict[type, Callable[[Call], modbus.Response]] = {
    modbus.ReadModuleName: lambda it: modbus.ModuleName(it.address, it.eeprom.model.modbus_name),
    modbus.ReadCommunicationSettings: lambda it: modbus.CommunicationSettings(
        it.address, it.eeprom.line_settings, it.eeprom.protocol
    ),
    modbus.ReadTypeCode: lambda it: modbus.TypeCodeSetting(it.address, it.eeprom.type_codes[it.message.channel]),
    modbus.ReadFirmwareVersion: lambda it: modbus.FirmwareVersion(it.address, *bytes(it.eeprom.firmware)),
    modbus.ReadChannelMask: lambda it: modbus.ChannelMask(it.address, it.state.enabled),
    modbus.ReadMiscellaneousSettings: lambda it: modbus.MiscellaneousSettings(it.address, _miscellaneous(it)),
    modbus.ReadCjcOffset: lambda it: modbus.CjcOffset(it.address, _offset(it)),
    modbus.ReadCjcEnabled: lambda it: modbus.CjcEnabled(it.address, enabled=it.eeprom.cjc_enabled),
    modbus.ReadCjcUpdate: lambda it: modbus.CjcUpdateSetting(it.address, it.state.ram.cjc_update),
}


def _set_type_code(call: Call) -> State:
    return set_types(call.state, call.message.type_code, (call.message.channel,))


def _set_miscellaneous(call: Call) -> State:
    report, settings = call.eeprom.report_settings, call.message.settings
    fast_mode, mains = bool(settings & 0x20), Filter(bool(settings & 0x80))
    return call.state.store(report_settings=evolve(report, fast_mode=fast_mode, filter=mains))


def _set_offset(call: Call) -> State:
    """Set the offset of the module, or of a channel from its byte (E62)."""
    channel, offset = call.message.channel, call.message.offset
    if not channel:
        return call.state.store(cjc_offset=offset)
    offsets = list(call.eeprom.channel_offsets)
    offsets[channel - 0x80] = offset - (offset & 0x80) * 2
    return call.state.store(channel_offsets=tuple(offsets))


_DONE: dict[type, Callable[[Call], State]] = {
    modbus.SetModuleAddress: lambda it: set_address(it.state, it.message.new_address),
    modbus.SetCommunicationSettings: lambda it: set_line(it.state, it.message.line_settings, it.message.protocol),
    modbus.SetTypeCode: _set_type_code,
    modbus.SetChannelMask: lambda it: enable_channels(it.state, it.message.mask, (1 << it.state.profile.channels) - 1),
    modbus.SetMiscellaneousSettings: _set_miscellaneous,
    modbus.SetCjcOffset: _set_offset,
    modbus.SetCjcEnabled: lambda it: it.state.store(cjc_enabled=it.message.enabled),
    modbus.SetCjcUpdate: lambda it: set_cjc_update(it.state, it.message.update, it.signals),
}


def _acknowledgement(call: Call) -> modbus.Response:
    """Return the response that a setting was made: from the old address if the address was set (E90)."""
    if isinstance(call.message, modbus.SetCommunicationSettings):
        return modbus.CommunicationSettingsResult(call.address, 0, 0)
    response: modbus.Response = call.message.response(call.address, 0)
    return response
