"""The calibration commands of DCON (manual 2.5 to 2.9, 2.27, 2.28, 2.31): what they send changes the calibration.

Laws: calibration is disabled at the end of every check, also of one that finds something wrong.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

from i7000 import dcon
from i7000.conformance.checks.steps import Steps, beyond, body_of, not_carried_out, put_back, with_tail
from i7000.conformance.oracle import difference
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Reason
from i7000.host.procedures import Procedure

__all__ = ["STEPS"]

_LONGEST = 20.0
"""The seconds in which a calibration is answered."""

OfModule = Callable[[Subject], tuple[dcon.Command[Any], ...]]


def _span(module: Subject) -> tuple[dcon.Command[Any], ...]:
    return (dcon.CalibrateSpan(module.address),)


def _zero(module: Subject) -> tuple[dcon.Command[Any], ...]:
    return (dcon.CalibrateZero(module.address),)


def _of_channels(command: Callable[[int, int], dcon.Command[Any]], module: Subject) -> tuple[dcon.Command[Any], ...]:
    return tuple(command(module.address, channel) for channel in module.channels)


_CALIBRATIONS: dict[str, OfModule] = {
    "2.5": _span,
    "2.6": _zero,
    "2.7": partial(_of_channels, dcon.CalibrateCurrentChannelSpan),
    "2.8": partial(_of_channels, dcon.CalibrateChannelZero),
    "2.9": partial(_of_channels, dcon.CalibrateChannelSpan),
}
"""The calibrations that have to be enabled before, by section: one for each channel, or one for all."""


def _enable(module: Subject, *, enabled: bool) -> dcon.SetCalibrationEnabled:
    return dcon.SetCalibrationEnabled(module.address, enabled=enabled)


def _carried_out(module: Subject, command: dcon.Command[Any]) -> Procedure[None]:
    """Send a command that the module may need a while for, and wait until it is ready for the next one."""
    wire = module.wire(command)
    answer = module.hear(wire)
    heard = (yield from module.send(wire, seconds=_LONGEST)).wire
    if not heard:
        yield from module.alive(wire)
    if found := difference(answer, heard):
        raise module.wrong(found, wire, heard, f"!{module.address:02X}")
    yield from module.wait(dcon.pause_after(command, module.profile))


def _disabled_at_the_end(module: Subject, steps: Procedure[None]) -> Procedure[None]:
    try:
        yield from steps
    except Reason:
        yield from put_back(module, _enable(module, enabled=False))
        raise
    yield from module.expect(_enable(module, enabled=False))


def _each_carried_out(module: Subject, commands: tuple[dcon.Command[Any], ...]) -> Procedure[None]:
    for command in commands:
        yield from module.expect(_enable(module, enabled=True))
        yield from _carried_out(module, command)


def _calibrate(section: str, module: Subject) -> Procedure[None]:
    """Calibrate the first channel and the last one, or all at once."""
    commands = _CALIBRATIONS[section](module)
    yield from _disabled_at_the_end(
        module, _each_carried_out(module, tuple(dict.fromkeys((commands[0], commands[-1]))))
    )


def _not_calibrated(section: str, module: Subject) -> Procedure[None]:
    """Send the calibration while it is disabled, and with characters too many while it is enabled."""
    yield from module.expect(_enable(module, enabled=False))
    commands = _CALIBRATIONS[section](module)
    for command in commands:
        yield from module.expect(command)
    yield from module.expect(_enable(module, enabled=True))
    yield from _disabled_at_the_end(module, not_carried_out(module, with_tail(module, commands[0])))


def _not_beyond(command: Callable[[int, int], dcon.Command[Any]], module: Subject) -> Procedure[None]:
    yield from module.expect(_enable(module, enabled=True))
    yield from _disabled_at_the_end(module, _refused_beyond(command, module))


def _refused_beyond(command: Callable[[int, int], dcon.Command[Any]], module: Subject) -> Procedure[None]:
    for channel in beyond(module.channels, 1):
        yield from module.expect(command(module.address, channel))
    body = body_of(module, command(module.address, 0))
    yield from not_carried_out(module, module.seal(body[:-1] + b"G"))


def _internally(module: Subject) -> Procedure[None]:
    yield from _carried_out(module, dcon.CalibrateInternally(module.address))


def _reload(module: Subject) -> Procedure[None]:
    yield from _carried_out(module, dcon.ReloadDefaultCalibration(module.address))


def _not_longer(command: type[dcon.Command[Any]], module: Subject) -> Procedure[None]:
    yield from not_carried_out(module, with_tail(module, command(module.address)))


def _enable_and_disable(module: Subject) -> Procedure[None]:
    yield from _disabled_at_the_end(module, module.expect(_enable(module, enabled=True)))


def _not_enabled(module: Subject) -> Procedure[None]:
    yield from module.expect(_enable(module, enabled=False))
    body = body_of(module, _enable(module, enabled=True))
    tries = not_carried_out(module, module.seal(body[:-1] + b"2"), with_tail(module, _enable(module, enabled=True)))
    yield from _disabled_at_the_end(module, _still_refused(module, tries))


def _still_refused(module: Subject, tries: Procedure[None]) -> Procedure[None]:
    yield from tries
    of_channels = dcon.CalibrateChannelSpan.availability not in module.profile.refused
    span = _CALIBRATIONS["2.9" if of_channels else "2.5"](module)[0]
    yield from module.expect(span)


STEPS: dict[str, Steps] = {
    **{f"dcon/{section}/calibrate": partial(_calibrate, section) for section in _CALIBRATIONS},
    **{f"dcon/{section}/calibrate-n1": partial(_not_calibrated, section) for section in _CALIBRATIONS},
    "dcon/2.7/calibrate-n2": partial(_not_beyond, dcon.CalibrateCurrentChannelSpan),
    "dcon/2.8/calibrate-n2": partial(_not_beyond, dcon.CalibrateChannelZero),
    "dcon/2.9/calibrate-n2": partial(_not_beyond, dcon.CalibrateChannelSpan),
    "dcon/2.27/calibrate": _internally,
    "dcon/2.27/calibrate-n1": partial(_not_longer, dcon.CalibrateInternally),
    "dcon/2.28/reload": _reload,
    "dcon/2.28/reload-n1": partial(_not_longer, dcon.ReloadDefaultCalibration),
    "dcon/2.31/enable": _enable_and_disable,
    "dcon/2.31/enable-n1": _not_enabled,
}
