"""The readings of the channels: their shape in each type and format (manual 1.11, 3.5)."""

from collections.abc import Callable
from functools import partial
from typing import Any

from attrs import evolve

from i7000 import dcon, modbus
from i7000.conformance.checks.dcon_line import configuration
from i7000.conformance.checks.dcon_settings import SETTLING
from i7000.conformance.checks.readings import Asked, agree
from i7000.conformance.checks.steps import Steps, put_back, told
from i7000.conformance.oracle import readings_of
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Difference, Note, Reason, Skipped, SkipReason
from i7000.errors import DecodeError
from i7000.host.procedures import Procedure
from i7000.message import Query
from i7000.models import Model
from i7000.readings import Status
from i7000.settings import DataFormat, ModbusDataFormat, Protocol
from i7000.type_codes import TypeCode

__all__ = ["STEPS", "asked_at_once"]

_MOST_TYPES = 7
"""The types that one run sets a channel to: each of them is a write."""


# --- asking -----------------------------------------------------------------------------------------------------------


def asked_at_once(module: Subject, command: dcon.Command[Any]) -> Procedure[Asked]:
    """Read all channels by one DCON command, and decode them with their types.

    Errors: `Difference` for readings that are not of their types, and those of `told`.
    """
    response, heard = yield from told(module, command)
    wire = module.wire(command)
    try:
        readings = readings_of(response, module.profile)
    except DecodeError as error:
        raise module.wrong(str(error), wire, heard, "readings of the types that are set") from None
    return Asked(tuple(enumerate(readings)), wire, heard)


def _asked(module: Subject) -> Procedure[Asked]:
    """Read all channels by the protocol of the module, in the format that is set."""
    if module.protocol is Protocol.DCON:
        return (yield from asked_at_once(module, dcon.ReadAnalogInputs(module.address)))
    request = modbus.ReadInputRegisters(module.address, 0, module.channels.stop)
    response = yield from module.expect(request)
    readings = modbus.readings(response.values, module.profile)
    enabled = [(channel, readings[channel]) for channel in module.enabled]
    return Asked(tuple(enabled), module.wire(request), modbus.encode(response, module.profile))


# --- their shape ------------------------------------------------------------------------------------------------------


def _shape(module: Subject) -> Procedure[None]:
    yield from _asked(module)


def _sentinels(module: Subject) -> Procedure[None]:
    """Compare what is sent out of range with what the format has for thermocouples, and for 4 to 20 mA below 4."""
    command = dcon.ReadAnalogInputs(module.address)
    response, heard = yield from told(module, command)
    readings = dcon.readings(response, module.profile, lenient=True)
    seen = 0
    for channel, (field, reading) in enumerate(zip(response.values, readings, strict=True)):
        code = module.profile.type_codes[channel]
        under = reading.status is Status.UNDER_RANGE
        if not under and reading.status is not Status.OVER_RANGE:
            continue
        if not code.thermocouple and not (under and code is TypeCode.MA_4_20):
            continue  # open (E50)
        seen += 1
        right = dcon.field(reading, channel, module.profile)
        if field != right:
            text = f"channel {channel} is {reading.status.value.replace('_', ' ')} as {field}"
            raise module.wrong(text, module.wire(command), heard, right)
    if not seen:
        raise Note("no channel is out of range: the special fields were not seen")


def _zero(module: Subject) -> Procedure[None]:
    response, _ = yield from told(module, dcon.ReadAnalogInputs(module.address))
    for channel, field in enumerate(response.values):
        if field.startswith("-") and not field.strip("-0."):
            raise Note(f"channel {channel} has a zero with a minus: {field}", erratum="E140")


# --- formats ----------------------------------------------------------------------------------------------------------


def _hex(module: Subject) -> Procedure[None]:
    """Compare the readings in hex with those in the format that is set."""
    in_hex = dcon.ReadAnalogInputsHex(module.address)
    yield from agree(
        module,
        partial(asked_at_once, module, dcon.ReadAnalogInputs(module.address)),
        partial(asked_at_once, module, in_hex),
    )


def _in_format(data_format: DataFormat, module: Subject) -> Procedure[None]:
    """Set a data format, and compare the readings in it with those in the format that was set."""
    old = configuration(module)
    new = evolve(old, report_settings=evolve(old.report_settings, data_format=data_format))
    yield from _between_formats(module, new, old)


def _in_modbus_format(module: Subject) -> Procedure[None]:
    now = module.profile.modbus_data_format
    row = next(row for row in modbus.RegisterMap(module.profile) if row.name == "modbus_data_format")
    new, old = (
        modbus.WriteSingleCoil(module.address, row.address, value=bool(value))
        for value in (ModbusDataFormat(1 - now), now)
    )
    yield from _between_formats(module, new, old)


def _between_formats(module: Subject, new: Query[Any], old: Query[Any]) -> Procedure[None]:
    """Change the format between two readings; it is as it was at the end."""

    def other() -> Procedure[Asked]:
        module.reserve(2)
        try:
            yield from module.expect(new)
            asked = yield from _asked(module)
        except Reason:
            yield from put_back(module, old)
            raise
        yield from module.expect(old)
        return asked

    yield from agree(module, partial(_asked, module), other)


# --- types ------------------------------------------------------------------------------------------------------------


def _types(module: Subject) -> list[TypeCode]:
    """Return types that a channel can be set to besides its own: each number of decimals and unit first."""
    known = [code for code in module.model.type_codes if module.profile.supports(code)]
    known.remove(module.profile.type_codes[0])
    module.chance.shuffle(known)
    first = {(code.decimals, code.unit, code.signed_hex): code for code in known}
    ordered = [*first.values(), *(code for code in known if code not in first.values())]
    return ordered[:_MOST_TYPES]


def _of_first(module: Subject, code: TypeCode) -> dcon.Command[dcon.Acknowledged]:
    return dcon.SetChannelTypeCode(module.address, 0, code)


def _of_all(module: Subject, code: TypeCode) -> dcon.Command[dcon.Acknowledged]:
    if module.profile.individually_configurable:
        raise Skipped(SkipReason.NOT_APPLICABLE, f"the channels of {module.profile.name} have types of their own")
    return evolve(configuration(module), type_code=code)


def _each_type(
    command: Callable[[Subject, TypeCode], dcon.Command[dcon.Acknowledged]], module: Subject
) -> Procedure[None]:
    """Set the first channel, or all, to one type after the other, and look at the field of the first."""
    old = command(module, module.profile.type_codes[0])
    codes = _types(module)
    module.reserve(len(codes) + 1)
    try:
        for code in codes:
            yield from module.expect(command(module, code))
            yield from module.wait(SETTLING)
            yield from _of_type(module, code)
    except Reason:
        yield from put_back(module, old)
        raise
    yield from module.expect(old)
    module.remark = f"types tried: {', '.join(f'{code:02X}' for code in codes)}"


def _of_type(module: Subject, code: TypeCode) -> Procedure[None]:
    try:
        yield from module.expect(dcon.ReadAnalogInput(module.address, 0))
    except Difference as found:
        raise found.told_as(f"type {code:02X}: {found.text}") from None


# --- disabled channels ------------------------------------------------------------------------------------------------


def _disabled(module: Subject) -> Procedure[None]:
    """Switch the first channel that is on off: its field is blank, in all readings."""
    now = module.twin.state.enabled
    first = now & -now
    channel = first.bit_length() - 1
    new, old = (dcon.SetChannelMask(module.address, mask) for mask in (now ^ first, now))
    module.reserve(2)
    try:
        yield from module.expect(new)
        yield from module.expect(dcon.ReadAnalogInputs(module.address))
        for each in module.channels:
            yield from module.expect(dcon.ReadAnalogInput(module.address, each))
        if module.model is not Model.M_7019Z:  # how many digits it has there is open (E13)
            yield from _no_fault(module, channel)
    except Reason:
        yield from put_back(module, old)
        raise
    yield from module.expect(old)
    yield from module.expect(dcon.ReadAnalogInputs(module.address))


def _no_fault(module: Subject, channel: int) -> Procedure[None]:
    response, heard = yield from told(module, dcon.ReadDiagnostics(module.address))
    if response.mask >> channel & 1:
        wire = module.wire(dcon.ReadDiagnostics(module.address))
        raise module.wrong(f"channel {channel} is off, but at fault", wire, heard, "its bit is 0")


STEPS: dict[str, Steps] = {
    "values/shape": _shape,
    "values/sentinels": _sentinels,
    "values/zero": _zero,
    "values/hex": _hex,
    "values/format-engineering": partial(_in_format, DataFormat.ENGINEERING),
    "values/format-percent": partial(_in_format, DataFormat.PERCENT),
    "values/format-hex": partial(_in_format, DataFormat.HEX),
    "values/modbus-formats": _in_modbus_format,
    "values/types": partial(_each_type, _of_first),
    "values/types-of-all": partial(_each_type, _of_all),
    "values/disabled": _disabled,
}
