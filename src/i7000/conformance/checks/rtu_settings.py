"""Function 46h of Modbus RTU: each sub-function, what is refused, and settings changed and restored (manual 3.3).

Laws: a setting that is refused has exception 03, or a result that is not 0 (E90).
"""

from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

from i7000 import modbus
from i7000.conformance.checks.modbus_steps import (
    ADDRESS,
    VALUE,
    address_changed,
    changed_and_restored,
    refused,
)
from i7000.conformance.checks.steps import Steps
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Skipped, SkipReason
from i7000.errors import DecodeError
from i7000.host.procedures import Procedure
from i7000.modbus.channel_settings import FAST_MODE_BIT, FILTER_BIT
from i7000.modbus.cold_junction import FIRST_CHANNEL
from i7000.settings import BaudRate, CjcUpdate, LineSettings
from i7000.type_codes import TypeCode

__all__ = ["STEPS"]

Request = modbus.Request[Any]

_MODULE = 0
"""The channel byte of the offset of the module."""
_READS: dict[type[Request], tuple[int, ...]] = {
    modbus.ReadModuleName: (),
    modbus.ReadCommunicationSettings: (),
    modbus.ReadTypeCode: (0,),
    modbus.ReadFirmwareVersion: (),
    modbus.ReadChannelMask: (),
    modbus.ReadMiscellaneousSettings: (),
    modbus.ReadCjcOffset: (_MODULE,),
    modbus.ReadCjcEnabled: (),
    modbus.ReadCjcUpdate: (),
}
"""The sub-functions that read, and their channel."""
_WITH_RESERVED = {modbus.ReadCommunicationSettings: 3, modbus.ReadTypeCode: 3, modbus.ReadCjcEnabled: 3}
"""The place of the reserved byte in requests that have one."""
_SHORTEST = 2
"""The length of a function and a sub-function."""
_NO_SUB_FUNCTIONS = (0x01, 0x02, 0x03, 0x0A, 0x1F, 0x21, 0x28, 0x31, 0x7F, 0xFF)


def _body(module: Subject, request: Request) -> bytes:
    """Return a request without address and CRC."""
    return module.wire(request)[1:-2]


# --- what is read -----------------------------------------------------------------------------------------------------


def _reply(kind: type[Request], module: Subject) -> Procedure[None]:
    yield from module.expect(kind(module.address, *_READS[kind]))


def _wrong_lengths(kind: type[Request], module: Subject) -> Procedure[None]:
    body = _body(module, kind(module.address, *_READS[kind]))
    shorter = () if len(body) == _SHORTEST else (body[:-1],)
    for wrong in (*shorter, body + b"\0"):
        yield from refused(module, wrong)


def _reserved(kind: type[Request], module: Subject) -> Procedure[None]:
    frame = bytearray(module.wire(kind(module.address, *_READS[kind])))
    frame[_WITH_RESERVED[kind]] = 1
    yield from refused(module, bytes(frame[1:-2]))


def _types(module: Subject) -> Procedure[None]:
    for channel in module.channels:
        yield from module.expect(modbus.ReadTypeCode(module.address, channel))


def _wrong_type_channels(module: Subject) -> Procedure[None]:
    for channel in (len(module.channels), 0xFF):
        yield from refused(module, _body(module, modbus.ReadTypeCode(module.address, channel)))


def _offsets(module: Subject) -> Procedure[None]:
    """Read the offset of each channel: in which byte of two it is, is open (E62)."""
    for channel, offset in zip(module.channels, module.twin.state.eeprom.channel_offsets, strict=False):
        request = modbus.ReadCjcOffset(module.address, FIRST_CHANNEL + channel)
        low, both = offset & 0xFF, offset & 0xFFFF
        fields = {low.to_bytes(2, "big"), low.to_bytes(2, "little"), both.to_bytes(2, "big")}
        start = bytes((module.address, request.function, request.sub_function or 0))
        yield from module.expect_one_of(module.wire(request), [module.seal(start + it) for it in sorted(fields)])


def _wrong_offset_channels(module: Subject) -> Procedure[None]:
    for channel in (0x01, FIRST_CHANNEL - 1, FIRST_CHANNEL + len(module.channels), 0xFF):
        yield from refused(module, _body(module, modbus.ReadCjcOffset(module.address, channel)))


# --- sub-functions that are not there ---------------------------------------------------------------------------------


def _unknown(module: Subject) -> Procedure[None]:
    for sub_function in _NO_SUB_FUNCTIONS:
        yield from refused(module, bytes((modbus.ReadModuleName.function, sub_function)), ADDRESS)


def _absent(module: Subject) -> Procedure[None]:
    absent = [kind for kind in _READS if kind.availability in module.profile.refused]
    if not absent:
        raise Skipped(SkipReason.NOT_APPLICABLE, f"{module.profile.name} has all sub-functions that read")
    for kind in absent:
        yield from refused(module, _body(module, kind(module.address, *_READS[kind])), ADDRESS)


def _bare(module: Subject) -> Procedure[None]:
    yield from module.expect_frame(module.seal(bytes((module.address, modbus.ReadModuleName.function))))


# --- what is set ------------------------------------------------------------------------------------------------------


def _set(module: Subject, read: Request, write: Callable[[Any], Request], name: str, other: Any) -> Procedure[None]:  # noqa: ANN401
    """Set another value, read it back, and restore the one before.

    Shape: `name` is the field of the response with the value; `other` is another value, or a function of the one before
        that returns it.
    """
    before = getattr((yield from module.expect(read)), name)

    def put(value: Any) -> Procedure[None]:  # noqa: ANN401 - of any setting
        request = write(value)
        yield from module.expect(request)
        found = getattr((yield from module.expect(read)), name)
        if found != value:
            raise module.wrong(f"{name} reads back as {found}", *module.exchange(), str(value))

    new = other(before) if callable(other) else other
    yield from changed_and_restored(module, put(new), partial(put, before))


def _type_set(module: Subject) -> Procedure[None]:
    channel = module.chance.choice(module.channels) if module.profile.individually_configurable else 0

    def other(before: int) -> int:
        types = [code for code in TypeCode if module.profile.supports(code) and code != before]
        if not types:
            raise Skipped(SkipReason.NOT_APPLICABLE, f"{module.profile.name} has one type only")
        return module.chance.choice(types)

    address = module.address
    read = modbus.ReadTypeCode(address, channel)
    yield from _set(module, read, lambda code: modbus.SetTypeCode(address, channel, code), "type_code", other)


def _mask_set(module: Subject) -> Procedure[None]:
    address, bit = module.address, 1 << module.chance.choice(module.channels)
    read = modbus.ReadChannelMask(address)
    yield from _set(module, read, lambda mask: modbus.SetChannelMask(address, mask), "mask", lambda mask: mask ^ bit)


def _miscellaneous_set(module: Subject) -> Procedure[None]:
    bits = FILTER_BIT * module.profile.has_filter | FAST_MODE_BIT * module.model.fast_mode
    if not bits:
        raise Skipped(SkipReason.NOT_APPLICABLE, f"{module.profile.name} has neither filter nor fast mode")
    address = module.address
    read = modbus.ReadMiscellaneousSettings(address)
    yield from _set(
        module, read, lambda value: modbus.SetMiscellaneousSettings(address, value), "settings", lambda it: it ^ bits
    )


def _offset_set(channel: int, values: tuple[int, int], module: Subject) -> Procedure[None]:
    address = module.address
    read = modbus.ReadCjcOffset(address, channel)
    yield from _set(
        module,
        read,
        lambda offset: modbus.SetCjcOffset(address, channel, offset),
        "offset",
        lambda before: values[before == values[0]],
    )


def _channel_offset_set(module: Subject) -> Procedure[None]:
    yield from _offset_set(FIRST_CHANNEL + module.chance.choice(module.channels[:8]), (0xFB, 6), module)


def _cjc_set(module: Subject) -> Procedure[None]:
    address = module.address
    read = modbus.ReadCjcEnabled(address)
    yield from _set(
        module, read, lambda on: modbus.SetCjcEnabled(address, enabled=on), "enabled", lambda enabled: not enabled
    )


def _update_set(module: Subject) -> Procedure[None]:
    address = module.address
    read = modbus.ReadCjcUpdate(address)
    other = {CjcUpdate.STOPPED: CjcUpdate.STARTED}
    yield from _set(
        module,
        read,
        lambda update: modbus.SetCjcUpdate(address, update),
        "update",
        lambda before: other.get(before, CjcUpdate.STOPPED),
    )


def _line_set(module: Subject) -> Procedure[None]:
    """Set the baud rate of the next power-on; the one in use does not change."""
    address = module.address
    read = modbus.ReadCommunicationSettings(address)
    before = yield from module.expect(read)

    def other(line: LineSettings) -> LineSettings:
        rate = BaudRate.BAUD_19200 if line.baud_rate is BaudRate.BAUD_9600 else BaudRate.BAUD_9600
        return LineSettings(rate, line.character_format)

    def write(line: LineSettings) -> Request:
        return modbus.SetCommunicationSettings(address, line, before.protocol)

    yield from _set(module, read, write, "line_settings", other)


def _address_set(module: Subject) -> Procedure[None]:
    yield from address_changed(module, modbus.SetModuleAddress)


# --- what is not set --------------------------------------------------------------------------------------------------


def _not_set(
    module: Subject, read: Request, write: Callable[[Any], Request], wrong: Iterable[bytes]
) -> Procedure[None]:
    """Send settings that are refused, and change nothing; if one is taken, restore the setting.

    Shape: `write` returns the request that sets what was read; `wrong` is what follows its sub-function instead.
    """
    before = yield from module.expect(read)
    valid = module.wire(write(before))
    for rest in wrong:
        wire = module.seal(valid[: 1 + _SHORTEST] + rest)
        heard = (yield from module.send(wire)).wire
        if not heard:
            yield from module.alive(wire)
        taken = not _is_refusal(module, write(before), heard)
        if taken:
            yield from module.send(valid)
            raise module.wrong(
                "it is not refused" if heard else "no answer", wire, heard, "exception 03, or a result that is not 0"
            )
        after = yield from module.expect(read)
        if after != before:
            raise module.wrong("refused, but changed", wire, heard, str(before))


def _is_refusal(module: Subject, request: Request, heard: bytes) -> bool:
    try:
        response = modbus.decode_response(heard, request, module.profile)
    except DecodeError:
        return False
    if isinstance(response, modbus.ExceptionResponse):
        return response.exception_code in VALUE
    if isinstance(response, modbus.CommunicationSettingsResult):
        return bool(response.line_result or response.protocol_result)
    return bool(response.result)


_UNDEFINED_TYPE = 0x7F


def _type_not_set(module: Subject) -> Procedure[None]:
    address = module.address
    wrong = next((int(code) for code in TypeCode if not module.profile.supports(code)), _UNDEFINED_TYPE)
    yield from _not_set(
        module,
        modbus.ReadTypeCode(address, 0),
        lambda before: modbus.SetTypeCode(address, 0, before.type_code),
        [bytes((0, 0, wrong))],
    )


def _mask_not_set(module: Subject) -> Procedure[None]:
    address, channels, size = module.address, len(module.channels), module.profile.mask_digits // 2
    if channels == 8 * size:
        raise Skipped(SkipReason.NOT_APPLICABLE, f"{module.profile.name} has a channel for each bit of the mask")
    yield from _not_set(
        module,
        modbus.ReadChannelMask(address),
        lambda before: modbus.SetChannelMask(address, before.mask),
        [((1 << channels) - 1 | 1 << channels).to_bytes(size, "big")],
    )


def _miscellaneous_not_set(module: Subject) -> Procedure[None]:
    address = module.address
    yield from _not_set(
        module,
        modbus.ReadMiscellaneousSettings(address),
        lambda before: modbus.SetMiscellaneousSettings(address, before.settings),
        [b"\x01"],
    )


def _offset_not_set(module: Subject) -> Procedure[None]:
    address = module.address
    yield from _not_set(
        module,
        modbus.ReadCjcOffset(address, _MODULE),
        lambda before: modbus.SetCjcOffset(address, _MODULE, before.offset),
        [b"\0\x10\x01"],
    )


def _cjc_not_set(module: Subject) -> Procedure[None]:
    address = module.address
    yield from _not_set(
        module,
        modbus.ReadCjcEnabled(address),
        lambda before: modbus.SetCjcEnabled(address, enabled=before.enabled),
        [b"\0\2"],
    )


def _update_not_set(module: Subject) -> Procedure[None]:
    address = module.address
    yield from _not_set(
        module, modbus.ReadCjcUpdate(address), lambda before: modbus.SetCjcUpdate(address, before.update), [b"\3"]
    )


def _address_not_set(module: Subject) -> Procedure[None]:
    address = module.address
    yield from _not_set(
        module,
        modbus.ReadModuleName(address),
        lambda _: modbus.SetModuleAddress(address, address),
        (b"\0\0\0\0", b"\xf8\0\0\0"),
    )


def _line_not_set(module: Subject) -> Procedure[None]:
    address = module.address
    yield from _not_set(
        module,
        modbus.ReadCommunicationSettings(address),
        lambda before: modbus.SetCommunicationSettings(address, before.line_settings, before.protocol),
        (b"\0\x0b\0\0\0\x01\0\0", b"\0\x06\0\0\0\x02\0\0"),
    )


# --- the checks -------------------------------------------------------------------------------------------------------


def _of(kind: type[Request]) -> str:
    return f"rtu/46/{kind.sub_function:02X}"


STEPS: dict[str, Steps] = {
    **{f"{_of(kind)}/reply": partial(_reply, kind) for kind in _READS},
    **{f"{_of(kind)}/reply-n1": partial(_wrong_lengths, kind) for kind in _READS},
    **{f"{_of(kind)}/reserved": partial(_reserved, kind) for kind in _WITH_RESERVED},
    "rtu/46/25/reply-of-m-7018-16": partial(_reply, modbus.ReadChannelMask),
    "rtu/46/07/channels": _types,
    "rtu/46/07/channels-n1": _wrong_type_channels,
    "rtu/46/07/channels-of-others": _types,
    "rtu/46/2B/channels": _offsets,
    "rtu/46/2B/no-such-channel": _wrong_offset_channels,
    "rtu/46/unknown": _unknown,
    "rtu/46/absent": _absent,
    "rtu/46/bare": _bare,
    "rtu/46/08/set": _type_set,
    "rtu/46/08/set-n1": _type_not_set,
    "rtu/46/26/set": _mask_set,
    "rtu/46/26/set-of-more": _mask_set,
    "rtu/46/26/no-such-channel": _mask_not_set,
    "rtu/46/2A/set": _miscellaneous_set,
    "rtu/46/2A/set-n1": _miscellaneous_not_set,
    "rtu/46/2C/set": partial(_offset_set, _MODULE, (-300, 301)),
    "rtu/46/2C/set-n1": _offset_not_set,
    "rtu/46/2C/set-of-channel": _channel_offset_set,
    "rtu/46/2E/set": _cjc_set,
    "rtu/46/2E/set-n1": _cjc_not_set,
    "rtu/46/30/set": _update_set,
    "rtu/46/30/set-n1": _update_not_set,
    "rtu/46/04/set": _address_set,
    "rtu/46/04/set-n1": _address_not_set,
    "rtu/46/06/set": _line_set,
    "rtu/46/06/set-n1": _line_not_set,
}
