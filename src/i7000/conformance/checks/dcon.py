"""The DCON commands (manual 2): what is read, sampled and unknown.

`dcon_settings`, `dcon_line` and `dcon_calibration` have those that change something.

Laws: a command with other characters after it is never carried out. Whether the module is silent then or answers
``?AA`` is open (E27).
"""

from collections.abc import Callable
from functools import partial
from typing import Any

from i7000 import dcon
from i7000.conformance.checks import dcon_calibration, dcon_line, dcon_settings
from i7000.conformance.checks.steps import Steps, beyond, body_of, not_carried_out, one_digit, text_of, with_tail
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Note, Skipped, SkipReason
from i7000.errors import DecodeError
from i7000.host.procedures import Procedure

__all__ = ["STEPS"]

Command = type[dcon.Command[Any]]
OfChannel = Callable[[int, int], dcon.Command[Any]]
"""A command about one channel, by address and channel."""

_READS: tuple[Command, ...] = (
    dcon.ReadAnalogInputs,
    dcon.ReadConfiguration,
    dcon.ReadCjcTemperature,
    dcon.ReadChannelMask,
    dcon.ReadCjcOffset,
    dcon.ReadAnalogInputsHex,
    dcon.ReadCjcUpdate,
    dcon.ReadDiagnostics,
    dcon.ReadFirmwareVersion,
    dcon.ReadModuleName,
    dcon.ReadProtocol,
    dcon.ReadCjcEnabled,
    dcon.ReadHostWatchdogStatus,
    dcon.ReadHostWatchdogTimeout,
    dcon.ReadOpenWireDetection,
    dcon.ReadConnectingMode,
)
"""The commands that read something of the whole module."""
_READS_OF_CHANNELS: dict[str, OfChannel] = {"2.4": dcon.ReadAnalogInput, "2.16": dcon.ReadChannelTypeCode}


# --- what is read -----------------------------------------------------------------------------------------------------


def _reply(command: Command, module: Subject) -> Procedure[None]:
    yield from module.expect(command(module.address))


def _not_longer(command: Command, module: Subject) -> Procedure[None]:
    yield from not_carried_out(module, with_tail(module, command(module.address)))


def _diagnostics(module: Subject) -> Procedure[None]:
    response = yield from module.expect(dcon.ReadDiagnostics(module.address))
    strange = response.mask & ~module.twin.state.enabled
    if strange:
        channels = ", ".join(map(str, sorted(dcon.channels_of(strange))))
        wire = module.wire(dcon.ReadDiagnostics(module.address))
        text = f"channels that are off, or not there, are at fault: {channels}"
        raise module.wrong(text, wire, dcon.encode(response, module.profile, force=True), "no bit of theirs")


def _reply_of_channels(command: OfChannel, module: Subject) -> Procedure[None]:
    for channel in module.channels:
        yield from module.expect(command(module.address, channel))


def _reading_of_channels(module: Subject) -> Procedure[None]:
    for channel in one_digit(module):
        yield from module.expect(dcon.ReadAnalogInput(module.address, channel))


def _reading_of_later_channels(module: Subject) -> Procedure[None]:
    for channel in module.channels[10:]:
        yield from module.expect(dcon.ReadAnalogInput(module.address, channel))


def _channel_not_longer(command: OfChannel, module: Subject) -> Procedure[None]:
    yield from not_carried_out(module, with_tail(module, command(module.address, 0)))


def _no_more_channels(command: OfChannel, module: Subject) -> Procedure[None]:
    channels = beyond(module.channels, module.profile.channel_digits)
    for channel in channels:
        yield from module.expect(command(module.address, channel))
    if command is dcon.ReadAnalogInput:  # another letter could be a command of a vendor
        if not channels:
            raise Skipped(SkipReason.NOT_APPLICABLE, f"{module.profile.name} has a channel for each digit")
        return
    bodies = [body_of(module, command(module.address, channel)) for channel in (0, 1)]
    at = next(at for at, pair in enumerate(zip(*bodies, strict=True)) if len(set(pair)) > 1)
    yield from not_carried_out(module, module.seal(bodies[0][:at] + b"G" + bodies[0][at + 1 :]))


# --- synchronized sampling --------------------------------------------------------------------------------------------


def _sampled(module: Subject) -> Procedure[dcon.SynchronizedData | None]:
    """Read what was sampled, whenever that was; return None if the module refuses because nothing was."""
    command = dcon.ReadSynchronizedData(module.address)
    wire = module.wire(command)
    heard = (yield from module.send(wire)).wire
    if not heard:
        yield from module.alive(wire)
    try:
        response = dcon.decode_response(heard, command, module.profile)
    except DecodeError as error:
        raise module.wrong(
            str(error), wire, heard, f">{module.address:02X}S(Data), or {text_of(module.refused)}"
        ) from None
    return response if isinstance(response, dcon.SynchronizedData) else None


def _kept(module: Subject) -> Procedure[None]:
    first = yield from _sampled(module)
    if first is not None:
        yield from _read_again(module, first)


def _read_again(module: Subject, first: dcon.SynchronizedData) -> Procedure[None]:
    again = yield from _sampled(module)
    wire = module.wire(dcon.ReadSynchronizedData(module.address))
    expected = f">{module.address:02X}0{''.join(first.values)}"
    if again is None:
        raise module.wrong("refused what it has just sent", wire, module.refused, expected)
    if again.first_reading or again.values != first.values:
        text = "status 1 for readings that it has sent before" if again.first_reading else "other readings than before"
        raise module.wrong(text, wire, dcon.encode(again, module.profile, force=True), expected)


def _sample(module: Subject, *, tail: bool = False) -> Procedure[None]:
    """Broadcast ``#**``, which no module answers; with `tail`, it has characters too many."""
    command = dcon.SynchronizedSampling()
    wire = with_tail(module, command) if tail else module.wire(command)
    module.hear(wire)
    yield from module.silent(wire)


def _sampling(module: Subject) -> Procedure[None]:
    yield from _sample(module)
    first = yield from module.expect(dcon.ReadSynchronizedData(module.address))
    if not first.first_reading:
        wire = module.wire(dcon.ReadSynchronizedData(module.address))
        received = dcon.encode(first, module.profile, force=True)
        raise module.wrong("status 0 for the first reading", wire, received, "status 1")
    yield from _read_again(module, first)


def _no_sampling(module: Subject) -> Procedure[None]:
    yield from _sampling(module)
    yield from _sample(module, tail=True)
    again = yield from module.expect(dcon.ReadSynchronizedData(module.address))
    if again.first_reading:
        wire = module.wire(dcon.ReadSynchronizedData(module.address))
        received = dcon.encode(again, module.profile, force=True)
        raise module.wrong("a damaged #** was carried out", wire, received, "status 0")


def _host_ok(module: Subject, *, tail: bool = False) -> Procedure[None]:
    command = dcon.HostOk()
    wire = with_tail(module, command) if tail else module.wire(command)
    module.hear(wire)
    yield from module.silent(wire)


# --- unknown commands -------------------------------------------------------------------------------------------------

_UNKNOWN = ("$%02XZ", "~%02XZ", "@%02XZ", "#%02XG")
"""Bodies that no model has as a command; they could be commands of a vendor that no manual has."""
_BARE = ("$%02X", "~%02X", "@%02X")
"""Bodies that end before the letter of a command."""


def _no_commands(forms: tuple[str, ...], module: Subject) -> Procedure[None]:
    bodies = [(form % module.address).encode() for form in forms]
    yield from not_carried_out(module, *(module.seal(body) for body in bodies))


def _way_of_refusal(module: Subject) -> Procedure[None]:
    body = (_BARE[0] % module.address).encode()
    heard = yield from module.expect_one_of(module.seal(body), (None, module.refused))
    raise Note(f"an unknown command is answered with {'silence' if heard is None else text_of(heard)}", erratum="E27")


def _of_other_models(module: Subject) -> Procedure[None]:
    """Send the reads of other models, those apart that have the text of a command of this one."""
    had = []
    own = {command.syntax for command in dcon.COMMANDS if command.availability not in module.profile.refused}
    for command in _READS:
        if command.availability not in module.profile.refused or command.syntax in own:
            continue
        wire = module.wire(command(module.address))
        heard = (yield from module.send(wire, seconds=0.15)).wire
        if heard not in (b"", module.refused):
            had.append(text_of(wire))
    yield from module.alive(b"")
    if had:
        raise Note(f"the module answers commands of other models: {', '.join(had)}")


# --- all of them ------------------------------------------------------------------------------------------------------

STEPS: dict[str, Steps] = {
    **{f"dcon/{command.section}/reply": partial(_reply, command) for command in _READS},
    **{f"dcon/{command.section}/reply-n1": partial(_not_longer, command) for command in _READS},
    **{
        f"dcon/{section}/reply": partial(_reply_of_channels, command) for section, command in _READS_OF_CHANNELS.items()
    },
    **{
        f"dcon/{section}/reply-n1": partial(_channel_not_longer, command)
        for section, command in _READS_OF_CHANNELS.items()
    },
    **{
        f"dcon/{section}/reply-n2": partial(_no_more_channels, command)
        for section, command in _READS_OF_CHANNELS.items()
    },
    "dcon/2.4/reply": _reading_of_channels,
    "dcon/2.4/channels-a-to-f": _reading_of_later_channels,
    "dcon/2.14/reply-of-16": partial(_reply, dcon.ReadChannelMask),
    "dcon/2.22/reply": _diagnostics,
    "dcon/2.22/reply-of-10": _diagnostics,
    "dcon/2.12/reply": _kept,
    "dcon/2.12/reply-n1": partial(_not_longer, dcon.ReadSynchronizedData),
    "dcon/2.2/sampling": _sampling,
    "dcon/2.2/sampling-n1": _no_sampling,
    "dcon/2.2/ignored": _sample,
    "dcon/2.35/silent": _host_ok,
    "dcon/2.35/silent-n1": partial(_host_ok, tail=True),
    **dcon_settings.STEPS,
    **dcon_line.STEPS,
    **dcon_calibration.STEPS,
    "dcon/2/unknown-command": partial(_no_commands, _UNKNOWN),
    "dcon/2/bare": partial(_no_commands, _BARE),
    "dcon/2/way-of-refusal": _way_of_refusal,
    "dcon/2/of-other-models": _of_other_models,
}
