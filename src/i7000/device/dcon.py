"""The DCON side of a module (manual 2): its responses, actions, refusals and silences.

Laws: a module does not answer a damaged frame, a frame for another address, or a command that it does not have. It
answers ``?AA`` to a well-formed command that it cannot carry out, and changes nothing (E27). It also refuses a name
that could be the text of another response (E122, assumption). Only ``~**`` restarts the host watchdog (E106,
assumption).
"""

from collections.abc import Callable

from i7000 import dcon
from i7000.device.call import Call
from i7000.device.changes import (
    enable_channels,
    set_address,
    set_cjc_update,
    set_host_watchdog,
    set_types,
    type_code,
)
from i7000.device.measurement import cold_junction, faults, fields, sample, sampled_fields
from i7000.device.signals import Signals
from i7000.device.state import State
from i7000.errors import DecodeError, EncodeError
from i7000.settings import DataFormat
from i7000.type_codes import MIXED

__all__ = ["step"]


class _RefusedError(Exception):
    """Raised for a command that the module cannot carry out."""


def step(state: State, frame: bytes, signals: Signals, now: float) -> tuple[State, bytes | None]:
    """Process a frame for this module or for all; return the state after it, and the response or None for silence."""
    try:
        command = dcon.decode_command(frame, state.profile)
    except DecodeError:
        return state, None
    call = Call(state, command, signals, now)
    if isinstance(command, dcon.Broadcast):
        return _BROADCASTS[type(command)](call), None
    try:
        after, response = _carry_out(call)
    except _RefusedError:
        return state, dcon.encode(dcon.Refused(state.ram.address), state.profile)
    if state.ram.soft_init_until is not None and not isinstance(command, dcon.SoftInit):
        after = after.keep(soft_init_until=None)
    return after, dcon.encode(response, state.profile)


def _carry_out(call: Call) -> tuple[State, dcon.Response]:
    try:
        call.message.check(call.state.profile)
    except EncodeError:
        raise _RefusedError from None
    kind = type(call.message)
    if kind in _TOLD:
        return call.state, _TOLD[kind](call)
    if kind is dcon.ReadSynchronizedData:
        return _tell_sampled(call)
    return _DONE[kind](call), dcon.Acknowledged(call.message.answering_address)


# --- responses --------------------------------------------------------------------------------------------------------


def _configuration(call: Call) -> dcon.Configuration:
    """Return the stored configuration; in INIT mode with the stored address too (E18, assumption)."""
    address = call.eeprom.address if call.state.ram.init_mode else call.address
    return dcon.Configuration(address, type_code(call.state), call.eeprom.line_settings, call.eeprom.report_settings)


def _watchdog_status(call: Call) -> dcon.HostWatchdogStatus:
    status = call.eeprom.host_watchdog_enabled << 7 | call.eeprom.host_watchdog_timed_out << 2
    return dcon.HostWatchdogStatus(call.address, status)


def _diagnostics(call: Call) -> dcon.Diagnostics:
    bits = faults(call.state, call.signals, call.state.profile.channels)
    return dcon.Diagnostics(call.address, dcon.mask_of(channel for channel, bit in enumerate(bits) if bit))


def _one_input(call: Call) -> dcon.AnalogInput:
    return dcon.AnalogInput(fields(call.state, call.signals)[call.message.channel])


_TOLD: dict[type, Callable[[Call], dcon.Response]] = {
    dcon.ReadAnalogInputs: lambda it: dcon.AnalogInputs(fields(it.state, it.signals)),
    dcon.ReadAnalogInput: _one_input,
    dcon.ReadAnalogInputsHex: lambda it: dcon.AnalogInputsHex(fields(it.state, it.signals, DataFormat.HEX)),
    dcon.ReadConfiguration: _configuration,
    dcon.ReadCjcTemperature: lambda it: dcon.CjcTemperature(round(cold_junction(it.state, it.signals), 1)),
    dcon.ReadChannelMask: lambda it: dcon.ChannelMask(it.address, it.state.enabled),
    dcon.ReadChannelTypeCode: lambda it: dcon.ChannelTypeCode(
        it.address, it.message.channel, it.eeprom.type_codes[it.message.channel]
    ),
    dcon.ReadCjcOffset: lambda it: dcon.CjcOffset(it.address, it.eeprom.cjc_offset),
    dcon.ReadCjcUpdate: lambda it: dcon.CjcUpdateSetting(it.address, it.state.ram.cjc_update),
    dcon.ReadDiagnostics: _diagnostics,
    dcon.ReadFirmwareVersion: lambda it: dcon.FirmwareVersion(it.address, str(it.eeprom.firmware)),
    dcon.ReadModuleName: lambda it: dcon.ModuleName(it.address, it.eeprom.name),
    dcon.ReadProtocol: lambda it: dcon.ProtocolSetting(it.address, modbus_supported=True, protocol=it.eeprom.protocol),
    dcon.ReadCjcEnabled: lambda it: dcon.CjcEnabled(it.address, enabled=it.eeprom.cjc_enabled),
    dcon.ReadHostWatchdogStatus: _watchdog_status,
    dcon.ReadHostWatchdogTimeout: lambda it: dcon.HostWatchdogTimeout(
        it.address, enabled=it.eeprom.host_watchdog_enabled, timeout=it.eeprom.host_watchdog_timeout
    ),
    dcon.ReadOpenWireDetection: lambda it: dcon.OpenWireDetection(it.address, enabled=it.eeprom.open_wire_detection),
    dcon.ReadConnectingMode: lambda it: dcon.ConnectingMode(it.address, single_ended=it.eeprom.single_ended),
}


def _tell_sampled(call: Call) -> tuple[State, dcon.SynchronizedData]:
    """Return the readings of the last ``#**``, in the present data format (E108); refuse if there was none."""
    ram = call.state.ram
    if ram.sampled is None:
        raise _RefusedError
    values = sampled_fields(ram.sampled, call.state.profile.data_format)
    response = dcon.SynchronizedData(call.address, first_reading=not ram.sampled_data_read, values=values)
    return call.state.keep(sampled_data_read=True), response


# --- actions ----------------------------------------------------------------------------------------------------------


def _set_configuration(call: Call) -> State:
    """Set the configuration: everything at once, except baud rate and checksum, which need permission.

    Special: with the INIT switch they change at the next power-on, after a soft INIT at once; with both, at the next
        power-on.
    Manual: 2.1; E16, E17, E20, E81, E101, E107, E138.
    """
    state, command, ram = call.state, call.message, call.state.ram
    line, report = command.line_settings, command.report_settings
    soft_init = ram.soft_init_until is not None and call.now < ram.soft_init_until
    locked = line != call.eeprom.line_settings or report.checksum != call.eeprom.report_settings.checksum
    if locked and not ram.init_switch and not soft_init:
        raise _RefusedError
    if call.eeprom.model.type_by_configuration and command.type_code != MIXED:
        state = set_types(state, command.type_code)
    state = set_address(state.store(line_settings=line, report_settings=report), command.new_address)
    if locked and not ram.init_switch:
        state = state.keep(line_settings=line, checksum=report.checksum)
    return state


def _calibrate(call: Call) -> State:
    """Accept a calibration if enabled; the model has nothing to calibrate (E33, E86)."""
    if not call.state.ram.calibration_enabled:
        raise _RefusedError
    return call.state


def _set_protocol(call: Call) -> State:
    if not call.state.ram.init_switch:
        raise _RefusedError
    return call.state.store(protocol=call.message.protocol)


def _soft_init(call: Call) -> State:
    """Allow the next command to change baud rate and checksum, within the timeout set before (E20, E32, E107)."""
    return call.state.keep(soft_init_until=call.now + call.state.ram.soft_init_timeout)


_DONE: dict[type, Callable[[Call], State]] = {
    dcon.SetConfiguration: _set_configuration,
    dcon.CalibrateSpan: _calibrate,
    dcon.CalibrateZero: _calibrate,
    dcon.CalibrateCurrentChannelSpan: _calibrate,
    dcon.CalibrateChannelZero: _calibrate,
    dcon.CalibrateChannelSpan: _calibrate,
    dcon.CalibrateInternally: lambda it: it.state,
    dcon.ReloadDefaultCalibration: lambda it: it.state,
    dcon.SetCalibrationEnabled: lambda it: it.state.keep(calibration_enabled=it.message.enabled),
    dcon.SetChannelMask: lambda it: enable_channels(it.state, it.message.mask, (1 << it.state.profile.channels) - 1),
    dcon.SetChannelTypeCode: lambda it: set_types(it.state, it.message.type_code, (it.message.channel,)),
    dcon.SetCjcOffset: lambda it: it.state.store(cjc_offset=it.message.offset),
    dcon.SetCjcUpdate: lambda it: set_cjc_update(it.state, it.message.update, it.signals),
    dcon.SetProtocol: _set_protocol,
    dcon.SetCjcEnabled: lambda it: it.state.store(cjc_enabled=it.message.enabled),
    dcon.SoftInit: _soft_init,
    dcon.SetModuleName: lambda it: it.state.store(name=it.message.name),
    dcon.SetSoftInitTimeout: lambda it: it.state.keep(soft_init_timeout=it.message.timeout),
    dcon.ResetHostWatchdogStatus: lambda it: it.state.store(host_watchdog_timed_out=False),
    dcon.SetHostWatchdogTimeout: lambda it: set_host_watchdog(
        it.state, it.now, enabled=it.message.enabled, timeout=it.message.timeout
    ),
    dcon.SetOpenWireDetection: lambda it: it.state.store(open_wire_detection=it.message.enabled),
    dcon.SetConnectingMode: lambda it: it.state.store(single_ended=it.message.single_ended),
}

_BROADCASTS: dict[type, Callable[[Call], State]] = {
    dcon.SynchronizedSampling: lambda it: it.state.keep(sampled=sample(it.state, it.signals), sampled_data_read=False),
    dcon.HostOk: lambda it: it.state.keep(fed_at=it.now),
}
