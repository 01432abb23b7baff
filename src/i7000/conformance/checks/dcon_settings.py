"""The DCON commands that change settings of the inputs and the name (manual 2.13 to 2.43), and change them back.

Laws: each setting is changed once and restored. What is out of its limits, or has characters too many, changes nothing.
"""

from functools import partial
from typing import Any

from attrs import evolve

from i7000 import dcon
from i7000.conformance.checks.others import others_known, others_unchanged
from i7000.conformance.checks.steps import (
    Steps,
    beyond,
    body_of,
    changed,
    not_carried_out,
    put_back,
    told,
    unchanged,
    with_tail,
)
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Reason
from i7000.device import Eeprom
from i7000.host.procedures import Procedure
from i7000.settings import CjcUpdate
from i7000.type_codes import TypeCode

__all__ = ["SETTLING", "STEPS", "other_mask", "other_name", "other_type"]

SETTLING = 1.0
"""The seconds after which a channel has readings of its new type."""
_INVALID_TYPE = 0x30
_LARGEST_OFFSET = 0x1000


def _memory(module: Subject) -> Eeprom:
    return module.twin.state.eeprom


# --- the channel mask -------------------------------------------------------------------------------------------------


def other_mask(module: Subject) -> int:
    """Return the mask with the last channel switched, but never an empty one."""
    return module.twin.state.enabled ^ 1 << module.channels.stop - 1 or 1


def _set_mask(module: Subject) -> Procedure[None]:
    new, old = (dcon.SetChannelMask(module.address, mask) for mask in (other_mask(module), module.twin.state.enabled))
    reads = (dcon.ReadChannelMask(module.address), dcon.ReadAnalogInputs(module.address))
    yield from changed(module, new, old, *reads)


def _no_other_mask(module: Subject) -> Procedure[None]:
    old = dcon.SetChannelMask(module.address, module.twin.state.enabled)
    other = dcon.SetChannelMask(module.address, other_mask(module))
    tries = _mask_tries(module, other)
    yield from unchanged(module, tries, old, dcon.ReadChannelMask(module.address))


def _mask_tries(module: Subject, other: dcon.SetChannelMask) -> Procedure[None]:
    if module.channels.stop < 4 * module.profile.mask_digits:
        yield from module.expect(evolve(other, mask=other.mask | 1 << module.channels.stop))
    body = body_of(module, other)
    yield from not_carried_out(module, with_tail(module, other), module.seal(body[:-1]))


# --- type codes -------------------------------------------------------------------------------------------------------


def other_type(module: Subject, now: TypeCode) -> TypeCode:
    """Return a type that the module supports and that has another number of decimals, if there is one."""
    types = [code for code in module.model.type_codes if module.profile.supports(code) and code is not now]
    return next((code for code in types if code.decimals != now.decimals), types[0])


def _set_type(module: Subject) -> Procedure[None]:
    channel = module.channels[-1]
    now = _memory(module).type_codes[channel]
    new, old = (dcon.SetChannelTypeCode(module.address, channel, code) for code in (other_type(module, now), now))
    reads = [dcon.ReadChannelTypeCode(module.address, each) for each in (channel, *module.channels[:-1])]
    module.reserve(2)
    yield from others_known(module)
    try:
        yield from module.expect(new)
        yield from module.wait(SETTLING)
        for read in reads:
            yield from module.expect(read)
        yield from module.expect(dcon.ReadAnalogInputs(module.address))
        yield from others_unchanged(module, module.channels)
    except Reason:
        yield from put_back(module, old)
        raise
    yield from module.expect(old)
    yield from module.expect(reads[0])


def _no_other_type(module: Subject) -> Procedure[None]:
    now = _memory(module).type_codes[0]
    old = dcon.SetChannelTypeCode(module.address, 0, now)
    reads = [dcon.ReadChannelTypeCode(module.address, channel) for channel in module.channels]
    yield from unchanged(module, _type_tries(module, other_type(module, now)), old, *reads)


def _type_tries(module: Subject, other: TypeCode) -> Procedure[None]:
    right = dcon.SetChannelTypeCode(module.address, 0, other)
    yield from module.expect(evolve(right, type_code=_INVALID_TYPE))
    for channel in beyond(module.channels, module.profile.channel_digits):
        yield from not_carried_out(module, module.wire(evolve(right, channel=channel)))
    yield from not_carried_out(module, with_tail(module, right))


# --- the cold junction ------------------------------------------------------------------------------------------------


def _set_offset(module: Subject) -> Procedure[None]:
    now = _memory(module).cjc_offset
    new, old = (dcon.SetCjcOffset(module.address, offset) for offset in (0x12A if now < 0 else -0x12A, now))
    yield from changed(module, new, old, dcon.ReadCjcOffset(module.address))


def _no_other_offset(module: Subject) -> Procedure[None]:
    old = dcon.SetCjcOffset(module.address, _memory(module).cjc_offset)
    other = dcon.SetCjcOffset(module.address, 0x12A if old.offset != 0x12A else 0x12B)
    body = body_of(module, other)
    wires = (
        *(module.seal(b"%s%c%04X" % (body[:-5], sign, _LARGEST_OFFSET + 1)) for sign in b"+-"),
        module.seal(body[:-5] + body[-4:]),
        with_tail(module, other),
    )
    yield from unchanged(module, not_carried_out(module, *wires), old, dcon.ReadCjcOffset(module.address))


def _update_now(module: Subject) -> Procedure[CjcUpdate]:
    response = yield from module.expect(dcon.ReadCjcUpdate(module.address))
    update: CjcUpdate = response.update
    return update


def _is_update(module: Subject, right: CjcUpdate) -> Procedure[None]:
    update = yield from _update_now(module)
    if update is not right:
        wire = module.wire(dcon.ReadCjcUpdate(module.address))
        received = dcon.encode(dcon.CjcUpdateSetting(module.address, update), module.profile, force=True)
        raise module.wrong(f"the setting is {update:d}", wire, received, f"{right:d}")


def _set_update(module: Subject) -> Procedure[None]:
    now = yield from _update_now(module)
    old = dcon.SetCjcUpdate(module.address, now)
    yield from others_known(module)
    try:
        for update in (CjcUpdate.STOPPED, CjcUpdate.STARTED):
            yield from module.expect(dcon.SetCjcUpdate(module.address, update))
            yield from _is_update(module, update)
        yield from module.expect(dcon.SetCjcUpdate(module.address, CjcUpdate.ONCE))
        yield from others_unchanged(module, module.channels)
    except Reason:
        yield from put_back(module, old)
        raise
    yield from module.expect(old)
    yield from _is_update(module, now)


def _no_other_update(module: Subject) -> Procedure[None]:
    now = yield from _update_now(module)
    old = dcon.SetCjcUpdate(module.address, now)
    other = CjcUpdate.STOPPED if now is CjcUpdate.STARTED else CjcUpdate.STARTED
    wires = (
        module.seal(body_of(module, old)[:-1] + b"3"),
        with_tail(module, dcon.SetCjcUpdate(module.address, other)),
    )
    try:
        yield from not_carried_out(module, *wires)
        yield from _is_update(module, now)
    except Reason:
        yield from put_back(module, old)
        raise


# --- settings that are on or off --------------------------------------------------------------------------------------


def _cjc(module: Subject, *, enabled: bool) -> dcon.SetCjcEnabled:
    return dcon.SetCjcEnabled(module.address, enabled=enabled)


def _open_wire(module: Subject, *, enabled: bool) -> dcon.SetOpenWireDetection:
    return dcon.SetOpenWireDetection(module.address, enabled=enabled)


_FLAGS: dict[str, tuple[Any, type[dcon.Command[Any]], str]] = {
    "2.30": (_cjc, dcon.ReadCjcEnabled, "cjc_enabled"),
    "2.41": (_open_wire, dcon.ReadOpenWireDetection, "open_wire_detection"),
}
"""The commands that set and read something that is on or off, by section, and the field of `Eeprom`."""


def _set_flag(section: str, module: Subject) -> Procedure[None]:
    command, read, name = _FLAGS[section]
    now = getattr(_memory(module), name)
    yield from changed(module, command(module, enabled=not now), command(module, enabled=now), read(module.address))


def _no_other_flag(section: str, module: Subject) -> Procedure[None]:
    command, read, name = _FLAGS[section]
    now = getattr(_memory(module), name)
    old, other = (command(module, enabled=enabled) for enabled in (now, not now))
    wires = (module.seal(body_of(module, old)[:-1] + b"2"), with_tail(module, other))
    yield from unchanged(module, not_carried_out(module, *wires), old, read(module.address))


# --- the name ---------------------------------------------------------------------------------------------------------

_NAMES = ("Test 7", "Test 8")


def other_name(module: Subject) -> dcon.SetModuleName:
    """Return the command that sets a name of six characters, which is not that of the module."""
    return dcon.SetModuleName(module.address, next(name for name in _NAMES if name != _memory(module).name))


def _set_name(module: Subject) -> Procedure[None]:
    old = dcon.SetModuleName(module.address, _memory(module).name)
    yield from changed(module, other_name(module), old, dcon.ReadModuleName(module.address))


def _no_longer_name(module: Subject) -> Procedure[None]:
    old = dcon.SetModuleName(module.address, _memory(module).name)
    body = body_of(module, other_name(module))
    tries = not_carried_out(module, module.seal(body + b"9"))
    yield from unchanged(module, tries, old, dcon.ReadModuleName(module.address))


# --- the connecting mode ----------------------------------------------------------------------------------------------


def _mode(module: Subject, *, single_ended: bool) -> dcon.SetConnectingMode:
    return dcon.SetConnectingMode(module.address, single_ended=single_ended)


def _set_mode(module: Subject) -> Procedure[None]:
    now = _memory(module).single_ended
    old = _mode(module, single_ended=now)
    module.reserve(2)
    yield from others_known(module)
    channels = module.channels
    try:
        yield from module.expect(_mode(module, single_ended=not now))
        yield from module.expect(dcon.ReadConnectingMode(module.address))
        untyped = evolve(module.profile, type_codes=())  # those of channels that have just appeared are unknown
        yield from told(module, dcon.ReadAnalogInputs(module.address), untyped)
        yield from told(module, dcon.ReadChannelMask(module.address), untyped)
        yield from others_unchanged(module, channels)
    except Reason:
        yield from put_back(module, old)
        raise
    yield from module.expect(old)
    yield from module.expect(dcon.ReadConnectingMode(module.address))


def _no_other_mode(module: Subject) -> Procedure[None]:
    now = _memory(module).single_ended
    old, other = (_mode(module, single_ended=single_ended) for single_ended in (now, not now))
    wires = (module.seal(body_of(module, old)[:-1] + b"2"), with_tail(module, other))
    yield from unchanged(module, not_carried_out(module, *wires), old, dcon.ReadConnectingMode(module.address))


# --- the host watchdog ------------------------------------------------------------------------------------------------

_TIMED_OUT = 0x04


def _reset_status(module: Subject) -> Procedure[None]:
    yield from module.expect(dcon.ResetHostWatchdogStatus(module.address))
    response = yield from module.expect(dcon.ReadHostWatchdogStatus(module.address))
    if response.status & _TIMED_OUT:
        wire = module.wire(dcon.ReadHostWatchdogStatus(module.address))
        received = dcon.encode(response, module.profile, force=True)
        raise module.wrong("the status still has a timeout", wire, received, "bit 2 is 0")


def _no_reset(module: Subject) -> Procedure[None]:
    yield from not_carried_out(module, with_tail(module, dcon.ResetHostWatchdogStatus(module.address)))


STEPS: dict[str, Steps] = {
    "dcon/2.13/set": _set_mask,
    "dcon/2.13/set-n1": _no_other_mask,
    "dcon/2.15/set": _set_type,
    "dcon/2.15/set-n1": _no_other_type,
    "dcon/2.18/set": _set_offset,
    "dcon/2.18/set-n1": _no_other_offset,
    "dcon/2.21/set": _set_update,
    "dcon/2.21/set-n1": _no_other_update,
    **{f"dcon/{section}/set": partial(_set_flag, section) for section in _FLAGS},
    **{f"dcon/{section}/set-n1": partial(_no_other_flag, section) for section in _FLAGS},
    "dcon/2.33/set": _set_name,
    "dcon/2.33/set-n1": _no_longer_name,
    "dcon/2.37/reset": _reset_status,
    "dcon/2.37/reset-n1": _no_reset,
    "dcon/2.43/set": _set_mode,
    "dcon/2.43/set-n1": _no_other_mode,
}
