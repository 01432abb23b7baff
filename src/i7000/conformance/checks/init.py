"""The INIT switch, soft INIT, and what can change the line (manual 2.32 to 2.34, A.1).

Laws: the module has its own address, line settings and protocol at the end of every check. After a failure they are
written back at the settings that it has, and at those that it could have taken by mistake.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

from attrs import evolve

from i7000 import dcon
from i7000.conformance.checks.dcon_line import configuration, other_configuration, other_protocol
from i7000.conformance.checks.dcon_settings import other_mask, other_type
from i7000.conformance.checks.steps import Steps, put_back, told
from i7000.conformance.oracle import Twin
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Reason, Skipped, SkipReason
from i7000.host.procedures import Procedure
from i7000.models import Model
from i7000.settings import BaudRate

__all__ = ["STEPS"]

_CANDIDATES = 4
"""The addresses that are tried until one is free."""
_WINDOW = 30
"""The soft INIT timeout in seconds, long enough for a slow line."""
_SETTLING = 0.1
"""The seconds after which a module has taken new line settings."""

Change = tuple[dcon.Command[dcon.Acknowledged], dcon.Command[dcon.Acknowledged]]
"""A command that changes a setting, and the one that changes it back."""
Changing = Callable[[dcon.SetConfiguration], dcon.SetConfiguration]


def _baud(old: dcon.SetConfiguration) -> dcon.SetConfiguration:
    """Return the configuration with another baud rate."""
    rate = BaudRate.BAUD_9600 if old.line_settings.baud_rate is not BaudRate.BAUD_9600 else BaudRate.BAUD_19200
    return evolve(old, line_settings=evolve(old.line_settings, baud_rate=rate))


def _checksum(old: dcon.SetConfiguration) -> dcon.SetConfiguration:
    """Return the configuration with the checksum switched."""
    return evolve(old, report_settings=evolve(old.report_settings, checksum=not old.report_settings.checksum))


# --- without permission -----------------------------------------------------------------------------------------------


def _refused(change: Changing, module: Subject) -> Procedure[None]:
    old = configuration(module)
    yield from _not_taken(module, change(old), old)


def _not_taken(module: Subject, tried: dcon.SetConfiguration, old: dcon.SetConfiguration) -> Procedure[None]:
    try:
        yield from module.expect(tried)
        yield from module.expect(dcon.ReadConfiguration(module.address))
    except Reason:
        yield from _written_back(module, tried, old)
        raise


def _written_back(module: Subject, tried: dcon.SetConfiguration, old: dcon.SetConfiguration) -> Procedure[None]:
    """Write the configuration at the settings that were tried, then at its own, which the module has at the end."""
    state = module.twin.state.store(line_settings=old.line_settings, report_settings=old.report_settings)
    for taken in (tried, old):
        module.twin = Twin(state.keep(line_settings=taken.line_settings, checksum=taken.report_settings.checksum))
        yield from module.tune(taken.line_settings)
        if dcon.SoftInit.availability not in module.profile.refused:
            for command in (dcon.SetSoftInitTimeout(module.address, _WINDOW), dcon.SoftInit(module.address)):
                yield from module.send(module.wire(command))
        yield from module.send(module.wire(old))


# --- the address ------------------------------------------------------------------------------------------------------


def _free_address(module: Subject) -> Procedure[int]:
    """Return an address near that of the module at which nothing answers."""
    for step in range(1, _CANDIDATES + 1):
        address = (module.address + step - 1) % 0xF7 + 1
        wire = module.wire(dcon.ReadModuleName(address))
        if address != module.address and not (yield from module.send(wire, seconds=0.15)).wire:
            return address
    raise Skipped(SkipReason.PREREQUISITE, "the addresses after that of the module are taken")


def _new_address(module: Subject) -> Procedure[None]:
    module.reserve(2)
    own = module.address
    new = evolve(configuration(module), new_address=(yield from _free_address(module)))
    old_name = module.wire(dcon.ReadModuleName(own))
    try:
        yield from module.expect(new)
        yield from module.expect(dcon.ReadConfiguration(module.address))
        yield from module.silent(old_name)
    except Reason:
        yield from put_back(module, evolve(configuration(module), new_address=own))
        raise
    yield from module.expect(evolve(configuration(module), new_address=own))
    yield from module.alive(b"")


# --- soft INIT --------------------------------------------------------------------------------------------------------


def _permitted(module: Subject, command: dcon.SetConfiguration) -> Procedure[None]:
    """Open the soft INIT window, and set the configuration, which is used at once."""
    yield from module.expect(dcon.SetSoftInitTimeout(module.address, _WINDOW))
    yield from module.expect(dcon.SoftInit(module.address))
    yield from module.expect(command)
    yield from module.tune(command.line_settings)
    yield from module.wait(_SETTLING)
    yield from module.expect(dcon.ReadConfiguration(module.address))


def _by_soft_init(module: Subject) -> Procedure[None]:
    module.reserve(2)
    old = configuration(module)
    new = _checksum(_baud(old))
    try:
        yield from _permitted(module, new)
        yield from _permitted(module, old)
        yield from module.expect(dcon.SetSoftInitTimeout(module.address, 0))
    except Reason:
        yield from _written_back(module, new, old)
        raise


def _shut(timeout: int, wait: float, module: Subject) -> Procedure[None]:
    """Open the soft INIT window, and set another baud rate when its timeout is over."""
    yield from module.expect(dcon.SetSoftInitTimeout(module.address, timeout))
    yield from module.expect(dcon.SoftInit(module.address))
    yield from module.wait(wait)
    old = configuration(module)
    yield from _not_taken(module, _baud(old), old)
    yield from module.expect(dcon.SetSoftInitTimeout(module.address, 0))


# --- the INIT switch --------------------------------------------------------------------------------------------------


def _switched(module: Subject) -> Procedure[None]:
    """Switch the power off and on with the INIT switch set: the module is at 00, 9600 baud, without checksum."""
    yield from module.power_cycle(init_switch=True)
    yield from module.expect(dcon.ReadModuleName(module.address))
    stored = module.twin.state.eeprom
    command = dcon.ReadConfiguration(module.address)
    response, heard = yield from told(module, command)
    if (response.line_settings, response.report_settings) != (stored.line_settings, stored.report_settings):
        right = f"CC {stored.line_settings.byte:02X} and FF {stored.report_settings.byte:02X}, as stored"
        raise module.wrong("other settings than are stored", module.wire(command), heard, right)


def _and_back(module: Subject, steps: Procedure[None]) -> Procedure[None]:
    """Carry out steps in INIT mode, and switch the power off and on without the INIT switch, whatever came of them."""
    try:
        yield from steps
    except Reason:
        yield from module.power_cycle()
        raise
    yield from module.power_cycle()
    yield from module.alive(b"")


def _init(module: Subject) -> Procedure[None]:
    yield from _and_back(module, _switched(module))


def _stored(module: Subject, command: dcon.Command[dcon.Acknowledged]) -> Procedure[None]:
    yield from _switched(module)
    yield from module.expect(evolve(command, address=module.address))
    yield from module.expect(dcon.ReadModuleName(module.address))


def _by_switch(
    command: dcon.Command[dcon.Acknowledged], old: dcon.Command[dcon.Acknowledged], module: Subject
) -> Procedure[None]:
    """Set something in INIT mode, which is used after the next power-on, and set it back."""
    module.reserve(2)
    try:
        yield from _and_back(module, _stored(module, command))
    except Reason:
        yield from module.power_cycle(init_switch=True)
        yield from put_back(module, evolve(old, address=module.address))
        yield from module.power_cycle()
        raise
    yield from _and_back(module, _stored(module, old))


def _line_by_switch(module: Subject) -> Procedure[None]:
    old = configuration(module)
    yield from _by_switch(_checksum(_baud(old)), old, module)


def _protocol_by_switch(module: Subject) -> Procedure[None]:
    old = dcon.SetProtocol(module.address, module.twin.state.eeprom.protocol)
    yield from _by_switch(other_protocol(module), old, module)


# --- what survives the power ------------------------------------------------------------------------------------------


def _kept(
    module: Subject,
    changes: list[Change],
    *reads: dcon.Command[Any],
) -> Procedure[None]:
    """Change settings, switch the power off and on, read them, and change them back."""
    yield from module.power_cycle()
    module.reserve(2 * len(changes))
    try:
        for new, _ in changes:
            yield from module.expect(new)
        yield from module.power_cycle()
        for read in reads:
            yield from module.expect(read)
    except Reason:
        yield from put_back(module, *(old for _, old in changes))
        raise
    for _, old in changes:
        yield from module.expect(old)


def _settings_kept(module: Subject) -> Procedure[None]:
    memory, address = module.twin.state.eeprom, module.address
    changes: list[Change] = []
    reads: list[dcon.Command[Any]] = []
    if module.model is not Model.M_7018_16:  # how many digits it has there is open (E12)
        masks = (other_mask(module), module.twin.state.enabled)
        new_mask, old_mask = (dcon.SetChannelMask(address, mask) for mask in masks)
        changes.append((new_mask, old_mask))
        reads.append(dcon.ReadChannelMask(address))
    if dcon.SetChannelTypeCode.availability not in module.profile.refused:
        now = memory.type_codes[0]
        new, old = (dcon.SetChannelTypeCode(address, 0, code) for code in (other_type(module, now), now))
        changes.append((new, old))
        reads.append(dcon.ReadChannelTypeCode(address, 0))
    if dcon.SetCjcOffset.availability not in module.profile.refused:
        offset = 0x12A if memory.cjc_offset != 0x12A else 0
        changes.append((dcon.SetCjcOffset(address, offset), dcon.SetCjcOffset(address, memory.cjc_offset)))
        reads.append(dcon.ReadCjcOffset(address))
    yield from _kept(module, changes, *reads)


def _configuration_kept(module: Subject) -> Procedure[None]:
    new, old = other_configuration(module), configuration(module)
    yield from _kept(
        module, [(new, old)], dcon.ReadConfiguration(module.address), dcon.ReadAnalogInputs(module.address)
    )


def _no_samples(module: Subject) -> Procedure[None]:
    yield from module.power_cycle()
    yield from module.expect(dcon.ReadSynchronizedData(module.address))


STEPS: dict[str, Steps] = {
    "init/baud-refused": partial(_refused, _baud),
    "init/checksum-refused": partial(_refused, _checksum),
    "init/new-address": _new_address,
    "init/soft-init": _by_soft_init,
    "init/soft-init-n1": partial(_shut, 1, 1.5),
    "init/soft-init-n2": partial(_shut, 0, 0.0),
    "init/switch": _init,
    "init/switch-line": _line_by_switch,
    "init/switch-protocol": _protocol_by_switch,
    "init/kept-settings": _settings_kept,
    "init/kept-configuration": _configuration_kept,
    "init/no-samples": _no_samples,
}
