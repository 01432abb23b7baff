"""One fact asked in two ways: both answers agree."""

from functools import partial
from typing import Any

from i7000 import dcon
from i7000.conformance.checks import consistency_modbus
from i7000.conformance.checks.readings import Asked, agree
from i7000.conformance.checks.steps import Steps, one_digit, text_of, told
from i7000.conformance.checks.values import asked_at_once
from i7000.conformance.oracle import readings_of
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Note, Strange, Unclear
from i7000.errors import DecodeError
from i7000.host.procedures import Procedure
from i7000.readings import Reading, Status
from i7000.settings import Protocol
from i7000.type_codes import MIXED

__all__ = ["STEPS"]


# --- DCON -------------------------------------------------------------------------------------------------------------


def _twice(command: type[dcon.Command[Any]], module: Subject) -> Procedure[None]:
    """Read twice what does not change, with another read between."""
    _, first = yield from told(module, command(module.address))
    yield from told(module, dcon.ReadConfiguration(module.address))
    _, again = yield from told(module, command(module.address))
    if again != first:
        raise module.wrong("another answer than before", module.wire(command(module.address)), again, text_of(first))


def _one_by_one(module: Subject) -> Procedure[Asked]:
    found: list[tuple[int, Reading]] = []
    wires, heards = [], []
    for channel in one_digit(module):
        command = dcon.ReadAnalogInput(module.address, channel)
        response, heard = yield from told(module, command)
        try:
            (reading,) = readings_of(response, module.profile, channel)
        except DecodeError as error:
            raise module.wrong(str(error), module.wire(command), heard, "a reading of its type") from None
        found.append((channel, reading))
        wires.append(module.wire(command))
        heards.append(heard)
    return Asked(tuple(found), b"".join(wires), b"".join(heards))


def _channels(module: Subject) -> Procedure[None]:
    yield from agree(module, partial(_at_once, module), partial(_one_by_one, module))


def _at_once(module: Subject) -> Procedure[Asked]:
    asked = yield from asked_at_once(module, dcon.ReadAnalogInputs(module.address))
    return asked._replace(readings=asked.readings[: one_digit(module).stop])


def _type_codes(module: Subject) -> Procedure[None]:
    """Compare the type of $AA2 with those of $AA8Ci; the code for mixed types is open."""
    types = []
    for channel in module.channels:
        response, _ = yield from told(module, dcon.ReadChannelTypeCode(module.address, channel))
        types.append(response.type_code)
    command = dcon.ReadConfiguration(module.address)
    configuration, heard = yield from told(module, command)
    told_code = configuration.type_code
    if len(set(types)) > 1 or not module.model.type_by_configuration:
        right = types[0] if len(set(types)) == 1 else MIXED
        if told_code != right:
            raise Note(f"$AA2 has the type code {told_code:02X}, where {right:02X} is expected", erratum="E81")
    elif told_code != types[0]:
        raise module.wrong(f"type code {told_code:02X}", module.wire(command), heard, f"{types[0]:02X}, as $AA8Ci")


def _blanks(module: Subject) -> Procedure[None]:
    """Compare the mask of $AA6 with the blanks of #AA."""
    mask, _ = yield from told(module, dcon.ReadChannelMask(module.address))
    command = dcon.ReadAnalogInputs(module.address)
    response, heard = yield from told(module, command)
    blank = dcon.mask_of(channel for channel, field in enumerate(response.values) if field.isspace())
    all_channels = (1 << module.channels.stop) - 1
    if blank != all_channels & ~mask.mask:
        text = f"blanks in the channels of {blank:X}"
        raise module.wrong(
            text, module.wire(command), heard, f"blanks in those that $AA6 has off: {mask.mask:X} are on"
        )


def _diagnostics(module: Subject) -> Procedure[None]:
    """Compare the bits of $AAB with the readings that are out of range before and after it."""
    command = dcon.ReadDiagnostics(module.address)
    for _ in range(3):
        before = yield from _faults(module)
        response, heard = yield from told(module, command)
        if (yield from _faults(module)) == before:
            break
    else:
        raise Unclear("the readings go in and out of range", sent=module.wire(command), received=heard)
    if response.mask != before:
        raise module.wrong(
            f"bits {response.mask:X}", module.wire(command), heard, f"{before:X}, the readings out of range"
        )


def _faults(module: Subject) -> Procedure[int]:
    asked = yield from asked_at_once(module, dcon.ReadAnalogInputs(module.address))
    out = (Status.OVER_RANGE, Status.UNDER_RANGE)
    return dcon.mask_of(channel for channel, reading in asked.readings if reading.status in out)


def _watchdog(module: Subject) -> Procedure[None]:
    """Compare bit 7 of ~AA0 with the setting of ~AA2, unless the watchdog times out meanwhile."""
    command = dcon.ReadHostWatchdogStatus(module.address)
    status, heard = yield from told(module, command)
    setting, _ = yield from told(module, dcon.ReadHostWatchdogTimeout(module.address))
    timed_out = setting.enabled and not status.status & 0x80 and status.status & 0x04
    if bool(status.status & 0x80) is not setting.enabled and not timed_out:
        text = f"bit 7 is {status.status >> 7}"
        raise module.wrong(text, module.wire(command), heard, f"{setting.enabled:d}, as ~AA2")


def _protocol(module: Subject) -> Procedure[None]:
    response, heard = yield from told(module, dcon.ReadProtocol(module.address))
    if not response.modbus_supported:
        wire = module.wire(dcon.ReadProtocol(module.address))
        raise module.wrong("DCON only", wire, heard, "1: this model has Modbus RTU too")
    if response.protocol is not Protocol.DCON:
        raise Strange("the module speaks DCON; Modbus RTU is stored, and begins at the next power-on")


def _line(module: Subject) -> Procedure[None]:
    """Compare checksum and line settings of $AA2 with those that are in use."""
    response, heard = yield from told(module, dcon.ReadConfiguration(module.address))
    if response.report_settings.checksum is not module.profile.checksum or response.line_settings != module.line:
        raise Strange(
            "$AA2 has another checksum or line setting than is in use: a change waits for the next power-on",
            sent=module.wire(dcon.ReadConfiguration(module.address)),
            received=heard,
        )


def _sampled(module: Subject) -> Procedure[None]:
    """Compare what #** samples with the readings before and after it."""

    def sampled() -> Procedure[Asked]:
        wire = module.wire(dcon.SynchronizedSampling())
        yield from module.send(wire, seconds=0.05)
        return (yield from asked_at_once(module, dcon.ReadSynchronizedData(module.address)))

    yield from agree(module, partial(asked_at_once, module, dcon.ReadAnalogInputs(module.address)), sampled)


STEPS: dict[str, Steps] = {
    "consistency/firmware-version": partial(_twice, dcon.ReadFirmwareVersion),
    "consistency/module-name": partial(_twice, dcon.ReadModuleName),
    "consistency/configuration": partial(_twice, dcon.ReadConfiguration),
    "consistency/channels": _channels,
    "consistency/type-codes": _type_codes,
    "consistency/blanks": _blanks,
    "consistency/diagnostics": _diagnostics,
    "consistency/watchdog": _watchdog,
    "consistency/protocol": _protocol,
    "consistency/line": _line,
    "consistency/sampled": _sampled,
    **consistency_modbus.STEPS,
}
