"""The DCON commands that can lose a module or change its line (manual 2.1, 2.26, 2.32, 2.34, 2.39), with their results.

Laws: what is changed is changed back. The address and the line stay as they are; `init` changes those.
"""

from functools import partial

from attrs import evolve

from i7000 import dcon
from i7000.conformance.checks.dcon_settings import other_type
from i7000.conformance.checks.steps import Steps, body_of, changed, not_carried_out, put_back, unchanged, with_tail
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Reason
from i7000.host.procedures import Procedure
from i7000.settings import DataFormat, Filter, Protocol
from i7000.type_codes import MIXED

__all__ = ["STEPS", "configuration", "other_configuration", "other_protocol"]


# --- the configuration ------------------------------------------------------------------------------------------------


def configuration(module: Subject) -> dcon.SetConfiguration:
    """Return the command that sets the configuration that the module has."""
    memory = module.twin.state.eeprom
    types = set(module.profile.type_codes)
    code = types.pop() if len(types) == 1 else MIXED
    return dcon.SetConfiguration(module.address, module.address, code, memory.line_settings, memory.report_settings)


def other_configuration(module: Subject) -> dcon.SetConfiguration:
    """Return another data format, and where they can be set, another filter and type."""
    old = configuration(module)
    report = old.report_settings
    data_format = DataFormat.HEX if report.data_format is not DataFormat.HEX else DataFormat.ENGINEERING
    report = evolve(report, data_format=data_format)
    if module.profile.has_filter:
        report = evolve(report, filter=Filter(not report.filter.value))
    code = old.type_code
    if module.model.type_by_configuration and not module.profile.individually_configurable:
        code = other_type(module, module.profile.type_codes[0])
    return evolve(old, type_code=code, report_settings=report)


def _set_configuration(module: Subject) -> Procedure[None]:
    reads = (dcon.ReadConfiguration(module.address), dcon.ReadAnalogInputs(module.address))
    yield from changed(module, other_configuration(module), configuration(module), *reads)


def _no_configuration(module: Subject) -> Procedure[None]:
    old, other = configuration(module), other_configuration(module)
    body = body_of(module, other)
    wires = (
        module.seal(body[:-1]),
        with_tail(module, other),
    )
    yield from unchanged(module, not_carried_out(module, *wires), old, dcon.ReadConfiguration(module.address))


# --- the protocol -----------------------------------------------------------------------------------------------------


def other_protocol(module: Subject) -> dcon.SetProtocol:
    """Return the command that sets the protocol that is not stored."""
    stored = module.twin.state.eeprom.protocol
    return dcon.SetProtocol(module.address, Protocol.DCON if stored is Protocol.MODBUS_RTU else Protocol.MODBUS_RTU)


def _protocol_refused(module: Subject) -> Procedure[None]:
    old = dcon.SetProtocol(module.address, module.twin.state.eeprom.protocol)
    tries = _refused(module, other_protocol(module))
    yield from unchanged(module, tries, old, dcon.ReadProtocol(module.address))


def _refused(module: Subject, command: dcon.SetProtocol) -> Procedure[None]:
    yield from module.expect(command)


def _no_protocol(module: Subject) -> Procedure[None]:
    old = dcon.SetProtocol(module.address, module.twin.state.eeprom.protocol)
    tries = not_carried_out(
        module,
        module.seal(body_of(module, old)[:-1] + b"2"),
        with_tail(module, other_protocol(module)),
    )
    yield from unchanged(module, tries, old, dcon.ReadProtocol(module.address))


# --- soft INIT --------------------------------------------------------------------------------------------------------


def _soft_init(module: Subject) -> Procedure[None]:
    """Set a timeout of 0, which keeps the window shut, before."""
    yield from module.expect(dcon.SetSoftInitTimeout(module.address, 0))
    yield from module.expect(dcon.SoftInit(module.address))


def _no_soft_init(module: Subject) -> Procedure[None]:
    yield from not_carried_out(module, with_tail(module, dcon.SoftInit(module.address)))


def _set_soft_init_timeout(module: Subject) -> Procedure[None]:
    for seconds in (1, 60, 0):
        yield from module.expect(dcon.SetSoftInitTimeout(module.address, seconds))


def _no_soft_init_timeout(module: Subject) -> Procedure[None]:
    one = dcon.SetSoftInitTimeout(module.address, 61)
    wires = (module.wire(one), module.seal(body_of(module, one)[:-1]), with_tail(module, one))
    shut = dcon.SetSoftInitTimeout(module.address, 0)
    try:
        yield from not_carried_out(module, *wires)
    except Reason:
        yield from put_back(module, shut)
        raise
    yield from module.expect(shut)


# --- the host watchdog ------------------------------------------------------------------------------------------------

_TIMED_OUT = 0x04
_ENABLED = 0x80
_TENTHS = 10
"""The timeout of the watchdog that is made to time out, in tenths of a second."""


def _watchdog(module: Subject) -> dcon.SetHostWatchdogTimeout:
    memory = module.twin.state.eeprom
    return dcon.SetHostWatchdogTimeout(
        module.address, enabled=memory.host_watchdog_enabled, timeout=memory.host_watchdog_timeout
    )


def _set_watchdog(module: Subject) -> Procedure[None]:
    """Set another timeout: the longest, or nearly, and disabled, so that it does nothing."""
    old = _watchdog(module)
    new = evolve(old, enabled=False, timeout=0xFE if old.timeout != 0xFE else 0xEF)
    yield from changed(module, new, old, dcon.ReadHostWatchdogTimeout(module.address))


def _no_watchdog(module: Subject) -> Procedure[None]:
    old = _watchdog(module)
    other = evolve(old, timeout=0xFE if old.timeout != 0xFE else 0xEF)
    body = body_of(module, other)
    wires = (
        module.seal(body[:4] + b"2" + body[5:]),
        module.seal(body[:-1]),
        with_tail(module, other),
    )
    yield from unchanged(module, not_carried_out(module, *wires), old, dcon.ReadHostWatchdogTimeout(module.address))


def _time_out(module: Subject, *, fed: bool) -> Procedure[None]:
    """Enable the watchdog, with or without ``~**`` in time, and look at its status after it."""
    old = _watchdog(module)
    module.reserve(4)
    try:
        yield from module.expect(dcon.SetHostWatchdogTimeout(module.address, enabled=True, timeout=_TENTHS))
        yield from _status(module, _ENABLED | _TIMED_OUT, _ENABLED)
        for _ in range(3):
            yield from module.wait(0.6)
            if fed:
                yield from _fed(module)
        yield from _status(module, _ENABLED | _TIMED_OUT if fed else _TIMED_OUT, _ENABLED if fed else _TIMED_OUT)
    except Reason:
        yield from put_back(module, old, dcon.ResetHostWatchdogStatus(module.address))
        raise
    yield from module.expect(dcon.ResetHostWatchdogStatus(module.address))
    yield from module.expect(old)
    yield from _status(module, _TIMED_OUT, 0)


def _fed(module: Subject) -> Procedure[None]:
    wire = module.wire(dcon.HostOk())
    module.hear(wire)
    heard = (yield from module.send(wire, seconds=0.1)).wire
    if heard:
        raise module.wrong(f"answered {len(heard)} bytes", wire, heard, "silence")


def _status(module: Subject, bits: int, right: int) -> Procedure[None]:
    command = dcon.ReadHostWatchdogStatus(module.address)
    response = yield from module.expect(command)
    if response.status & bits != right:
        received = dcon.encode(response, module.profile, force=True)
        text = f"the status is {response.status:02X}"
        raise module.wrong(text, module.wire(command), received, f"{right:02X} in the bits {bits:02X}")


STEPS: dict[str, Steps] = {
    "dcon/2.1/set": _set_configuration,
    "dcon/2.1/set-n1": _no_configuration,
    "dcon/2.26/refused": _protocol_refused,
    "dcon/2.26/refused-n1": _no_protocol,
    "dcon/2.32/reply": _soft_init,
    "dcon/2.32/reply-n1": _no_soft_init,
    "dcon/2.34/set": _set_soft_init_timeout,
    "dcon/2.34/set-n1": _no_soft_init_timeout,
    "dcon/2.39/set": _set_watchdog,
    "dcon/2.39/set-n1": _no_watchdog,
    "dcon/2.39/timeout": partial(_time_out, fed=False),
    "dcon/2.39/timeout-n1": partial(_time_out, fed=True),
}
