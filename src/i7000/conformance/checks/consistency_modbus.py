"""One fact asked in two ways by Modbus: by function 46h and in a register, by functions 03 and 04, by 01 and 02."""

from collections.abc import Callable
from functools import partial
from typing import Any

from i7000 import modbus
from i7000.conformance.checks.modbus_steps import agree, distance, items, read_row, row_of, row_with
from i7000.conformance.checks.steps import Steps
from i7000.conformance.subject import Subject
from i7000.host.procedures import Procedure
from i7000.modbus import Area, Register
from i7000.modbus.channel_settings import FAST_MODE_BIT, FILTER_BIT
from i7000.modbus.cold_junction import FIRST_CHANNEL
from i7000.readings import Status

__all__ = ["STEPS"]

_NOISE = 0x800
"""The counts by which a reading may differ from itself a moment later: 3 % of the whole range."""
_DEGREES = 100
"""The counts, 1 degC, by which the CJC temperature may differ from itself a moment later."""
_HOLDING = Area.HOLDING_REGISTER


def _compare(module: Subject, what: str, sent: modbus.Request[Any], one: object, other: object) -> None:
    if one != other:
        raise module.wrong(f"{what}: {one} by function 46h, {other} in the map", *module.exchange(sent), "the same")


def _in_register(
    name: str, request: Callable[[int], modbus.Request[Any]], path: str, module: Subject
) -> Procedure[None]:
    """Compare the answer of a sub-function of 46h with a register."""
    sent = request(module.address)
    response = yield from module.expect(sent)
    row = row_of(module, _HOLDING, name)
    (word,) = yield from items(module, _HOLDING, row.address)
    _compare(module, name, sent, int(getattr(response, path)) & 0xFFFF, word)


def _in_coil(name: str, request: Callable[[int], modbus.Request[Any]], path: str, module: Subject) -> Procedure[None]:
    """Compare the answer of a sub-function of 46h with a coil."""
    sent = request(module.address)
    response = yield from module.expect(sent)
    (bit,) = yield from read_row(module, row_of(module, Area.COIL, name))
    _compare(module, name, sent, int(getattr(response, path)), bit)


# --- the module -------------------------------------------------------------------------------------------------------


def _firmware(module: Subject) -> Procedure[None]:
    """Compare the registers of the firmware with 46h/20: three bytes in two words, the low word first."""
    sent = modbus.ReadFirmwareVersion(module.address)
    response = yield from module.expect(sent)
    words = yield from read_row(module, row_of(module, _HOLDING, "firmware_version"))
    told = response.major << 16 | response.minor << 8 | response.build
    _compare(module, "firmware version", sent, f"{told:06X}", f"{words[1] << 16 | words[0]:06X}")


def _name(module: Subject, *, ordered: bool) -> Procedure[None]:
    """Compare the registers of the name with 46h/00; which word comes first, is open (E75)."""
    sent = modbus.ReadModuleName(module.address)
    response = yield from module.expect(sent)
    words = yield from read_row(module, row_of(module, _HOLDING, "module_name"))
    told = (int.from_bytes(response.name[2:], "big"), int.from_bytes(response.name[:2], "big"))
    if ordered:
        _compare(module, "module name", sent, told, words)
    else:
        _compare(module, "module name", sent, sorted(told), sorted(words))


def _address(module: Subject) -> Procedure[None]:
    """Compare the register of the address with the address that the module answers at."""
    (word,) = yield from read_row(module, row_of(module, _HOLDING, "module_address"))
    _compare(module, "address", modbus.ReadModuleName(module.address), module.address, word)


def _line(module: Subject) -> Procedure[None]:
    sent = modbus.ReadCommunicationSettings(module.address)
    response = yield from module.expect(sent)
    (byte,) = yield from read_row(module, row_of(module, _HOLDING, "line_settings"))
    (protocol,) = yield from read_row(module, row_of(module, Area.COIL, "protocol"))
    _compare(module, "line settings", sent, response.line_settings.byte, byte)
    _compare(module, "protocol", sent, int(response.protocol), protocol)


# --- the channels -----------------------------------------------------------------------------------------------------


def _types(module: Subject) -> Procedure[None]:
    row = row_of(module, _HOLDING, "type_code")
    words = yield from read_row(module, row)
    for channel in module.channels:
        sent = modbus.ReadTypeCode(module.address, channel)
        response = yield from module.expect(sent)
        _compare(module, f"type of channel {channel}", sent, int(response.type_code), words[channel])


def _mask(module: Subject) -> Procedure[None]:
    """Compare the mask of 46h/25, in either order of its bytes (E61), with the registers."""
    sent = modbus.ReadChannelMask(module.address)
    response = yield from module.expect(sent)
    (mask,) = yield from read_row(module, row_of(module, _HOLDING, "channel_mask"))
    high = row_with(module, _HOLDING, "channel_mask_high")
    if high is not None:
        (above,) = yield from read_row(module, high)
        mask |= above << 16
    size = module.profile.mask_digits // 2
    mask &= (1 << len(module.channels)) - 1
    orders = {response.mask, int.from_bytes(response.mask.to_bytes(size, "big"), "little")}
    if mask not in orders:
        _compare(module, "channel mask", sent, f"{response.mask:X}", f"{mask:X}")


def _filter(module: Subject) -> Procedure[None]:
    sent = modbus.ReadMiscellaneousSettings(module.address)
    response = yield from module.expect(sent)
    for name, bit in (("filter", FILTER_BIT), ("fast_mode", FAST_MODE_BIT)):
        row = row_with(module, Area.COIL, name)
        if row is not None:
            (coil,) = yield from read_row(module, row)
            _compare(module, name, sent, int(bool(response.settings & bit)), coil)


def _offsets(name: str, module: Subject) -> Procedure[None]:
    """Compare the offsets of the channels with 46h/2B: in which byte they are, is open (E62)."""
    words = yield from read_row(module, row_of(module, _HOLDING, name))
    for channel in module.channels:
        sent = modbus.ReadCjcOffset(module.address, FIRST_CHANNEL + channel)
        response = yield from module.expect(sent)
        _compare(module, f"offset of channel {channel}", sent, response.offset & 0xFF, words[channel] & 0xFF)


# --- what is measured -------------------------------------------------------------------------------------------------


def _two_areas(name: str, near: int, module: Subject) -> Procedure[None]:
    """Compare a row of input registers with the same row of holding registers."""
    yield from agree(partial(_inputs_and_holdings, name, near, module), module)


def _inputs_and_holdings(name: str, near: int, module: Subject) -> Procedure[str | None]:
    inputs = yield from _first(module, row_of(module, Area.INPUT_REGISTER, name))
    holdings = yield from _first(module, row_of(module, _HOLDING, name))
    for at, (one, other) in enumerate(zip(inputs, holdings, strict=True)):
        if (name != "analog_input" or at in module.enabled) and distance(one, other) > near:
            return f"{name} {at} is {one:04X} by function 04 and {other:04X} by 03"
    return None


def _first(module: Subject, row: Register) -> Procedure[tuple[int, ...]]:
    """Read a row as far as the channels of the connecting mode go."""
    return (yield from items(module, row.area, row.address, min(row.count, max(1, len(module.channels)))))


def _status_in_two_areas(module: Subject) -> Procedure[None]:
    yield from agree(partial(_statuses, module), module)


def _statuses(module: Subject) -> Procedure[str | None]:
    inputs = yield from read_row(module, row_of(module, Area.DISCRETE_INPUT, "range_status"))
    coils = yield from read_row(module, row_of(module, Area.COIL, "range_status"))
    return None if inputs == coils else f"range status is {inputs} by function 02 and {coils} by 01"


def _status_of_readings(module: Subject) -> Procedure[None]:
    yield from agree(partial(_faults, module), module)


def _faults(module: Subject) -> Procedure[str | None]:
    """Compare the status of the channels with their readings: both out of range, or neither."""
    bits = yield from read_row(module, row_of(module, Area.DISCRETE_INPUT, "range_status"))
    words = yield from _first(module, row_of(module, Area.INPUT_REGISTER, "analog_input"))
    for channel, reading in enumerate(modbus.readings(words, module.profile)):
        if channel in module.enabled and bits[channel] != (reading.status is not Status.OK):
            return f"channel {channel} has status {bits[channel]}, and {words[channel]:04X} is {reading.status.value}"
    return None


def _span(module: Subject) -> Procedure[None]:
    """Read the channels: none is beyond its span by more than the span."""
    request = modbus.ReadInputRegisters(module.address, 0, len(module.channels))
    response = yield from module.expect(request)
    for channel, reading in enumerate(modbus.readings(response.values, module.profile)):
        code = module.profile.type_codes[channel]
        low, high = code.minimum - code.full_scale, code.maximum + code.full_scale
        if channel in module.enabled and reading.value is not None and not low <= reading.value <= high:
            text = f"channel {channel} of type {int(code):02X} is {reading.value:g} {code.unit.value}"
            raise module.wrong(text, *module.exchange(request), f"{code.minimum:g} to {code.maximum:g}")


STEPS: dict[str, Steps] = {
    "consistency/firmware-registers": _firmware,
    "consistency/name-registers": partial(_name, ordered=False),
    "consistency/name-registers-order": partial(_name, ordered=True),
    "consistency/address-register": _address,
    "consistency/line-register": _line,
    "consistency/type-registers": _types,
    "consistency/module-type-register": partial(
        _in_register, "module_type_code", lambda address: modbus.ReadTypeCode(address, 0), "type_code"
    ),
    "consistency/mask-register": _mask,
    "consistency/filter-coil": _filter,
    "consistency/cjc-offset-register": partial(
        _in_register, "module_cjc_offset", lambda address: modbus.ReadCjcOffset(address, 0), "offset"
    ),
    "consistency/channel-offset-registers": partial(_offsets, "cjc_offset"),
    "consistency/temperature-offset-registers": partial(_offsets, "temperature_offset"),
    "consistency/cjc-coil": partial(_in_coil, "cjc_enabled", modbus.ReadCjcEnabled, "enabled"),
    "consistency/cjc-update-register": partial(_in_register, "cjc_update", modbus.ReadCjcUpdate, "update"),
    "consistency/readings-by-03-and-04": partial(_two_areas, "analog_input", _NOISE),
    "consistency/cjc-by-03-and-04": partial(_two_areas, "cjc_temperature", _DEGREES),
    "consistency/status-by-01-and-02": _status_in_two_areas,
    "consistency/status-and-readings": _status_of_readings,
    "consistency/readings-in-span": _span,
}
