"""The readings of all channels of a module, by either protocol, in any data format.

Laws: a channel that cannot be decoded does not hide the others. A disabled channel is never reported as a number if its
mask is known.
"""

from typing import Any

from attrs import evolve, field

from i7000 import dcon, modbus
from i7000.arguments import check_type
from i7000.errors import DecodeError, EncodeError
from i7000.frozen import frozen
from i7000.host.bus import Policy
from i7000.host.events import Answered, Ended, Rejected
from i7000.host.procedures.asking import outcome_words, value
from i7000.host.procedures.identified import Unknown
from i7000.host.procedures.step import Procedure, Result, ask
from i7000.profile import Profile
from i7000.readings import Reading, Status
from i7000.settings import Protocol, channels_of

__all__ = ["ChannelFault", "Report", "read"]

_BLANK_IF_DISABLED = "7019"
"""The series whose DCON readings show by blanks that a channel is disabled (E25)."""


@frozen
class ChannelFault:
    """A reading that could not be decoded: the `channel`, or None if it is all of them, and the `error`."""

    channel: int | None
    error: DecodeError


@frozen
class Report:
    """The readings of all channels, or what prevented them.

    Shape: `readings` has an entry for each channel, None for one in `faults`; it is None if there is no response, or if
        the profile has no types. `outcome` is that of the request for the readings, and `reason` says in words why
        there are none. `mask` has the enabled channels, None if unknown.
    """

    outcome: Ended
    readings: tuple[Reading | None, ...] | None = None
    faults: tuple[ChannelFault, ...] = field(default=(), kw_only=True)
    mask: int | None = field(default=None, kw_only=True)
    unknown: tuple[Unknown, ...] = field(default=(), kw_only=True)
    """What was not learned: ``mask``, so that a reading of 0 can be that of a disabled channel."""
    reason: str = field(default="", kw_only=True)
    rejected: bool = field(default=False, kw_only=True)
    """Whether the outcome is a timeout although something answered: what came is not a response to the request."""


def read(
    address: int,
    profile: Profile,
    *,
    protocol: Protocol = Protocol.DCON,
    mask: int | None = None,
    policy: Policy | None = None,
) -> Procedure[Report]:
    """Make the procedure that reads all channels of the module at an address.

    Shape: `mask` has the enabled channels, as in `Report.mask` of an earlier read; None asks the module for it where
        the readings do not show it. `policy` is that of every request; None means the policy of the line.
    Special: without a checksum, a flipped bit can make another number of a DCON reading: where that matters, read twice
        and compare.
    Errors: `EncodeError` for an address, mask or protocol that the module cannot have.
    Manual: 2.3, 2.14, 3.2, 3.3.8; E25, E97.

    >>> from i7000 import Model
    >>> next(read(0x01, Profile(Model.I_7018))).command
    ReadAnalogInputs(address=0x01)
    """
    check_type("profile", profile, Profile)
    check_type("protocol", protocol, Protocol)
    check_type("mask", mask, int, optional=True)
    check_type("policy", policy, Policy, optional=True)
    if protocol not in profile.model.protocols:
        raise EncodeError("protocol", protocol.name, f"DCON: {profile.model.value} has no Modbus", "1.12")
    if mask is not None:
        profile.check_mask(mask, "2.14")
    if protocol is Protocol.DCON:
        dcon.encode(dcon.ReadAnalogInputs(address), profile)
        return _by_dcon(address, profile, mask, policy)
    modbus.encode(modbus.ReadInputRegisters(address, 0, profile.channels), profile)
    return _by_modbus(address, profile, mask, policy)


def _by_dcon(address: int, profile: Profile, mask: int | None, policy: Policy | None) -> Procedure[Report]:
    result = yield from ask(dcon.ReadAnalogInputs(address), profile, policy)
    if not isinstance(result.outcome, Answered):
        return _unanswered(result, mask, profile)
    report = _decoded(result.outcome, profile)
    if profile.model.series == _BLANK_IF_DISABLED:
        return evolve(report, mask=mask)
    if mask is not None:
        return _without_disabled(report, mask, profile)
    answer, missing = yield from value("mask", dcon.ReadChannelMask(address), profile, policy)
    return _masked(report, answer, missing, profile)


def _by_modbus(address: int, profile: Profile, mask: int | None, policy: Policy | None) -> Procedure[Report]:
    result = yield from ask(modbus.ReadInputRegisters(address, 0, profile.channels), profile, policy)
    if not isinstance(result.outcome, Answered):
        return _unanswered(result, mask, profile)
    try:
        report = Report(result.outcome, modbus.readings(result.outcome.response.values, profile))
    except DecodeError as error:
        report = _undecoded(result.outcome, error)
    if mask is not None:
        return _without_disabled(report, mask, profile)
    answer, missing = yield from value("mask", modbus.ReadChannelMask(address), profile, policy)
    return _masked(report, answer, missing, profile)


def _unanswered(result: Result[Any], mask: int | None, profile: Profile) -> Report:
    rejected = any(isinstance(it, Rejected) for it in result.others)
    return Report(result.outcome, mask=mask, reason=outcome_words(result, profile), rejected=rejected)


def _undecoded(outcome: Ended, error: DecodeError) -> Report:
    return Report(outcome, faults=(ChannelFault(None, error),), reason=str(error))


def _decoded(outcome: Answered[dcon.AnalogInputs], profile: Profile) -> Report:
    """Return the readings of a response, and the faults of those that cannot be decoded."""
    try:
        return Report(outcome, dcon.readings(outcome.response, profile))
    except DecodeError as error:
        if not profile.type_codes:
            return _undecoded(outcome, error)
    found: list[Reading | None] = []
    faults = []
    for channel, text in enumerate(outcome.response.values):
        try:
            found.append(dcon.reading(dcon.AnalogInput(text), channel, profile))
        except DecodeError as error:
            found.append(None)
            faults.append(ChannelFault(channel, error))
    return Report(outcome, tuple(found), faults=tuple(faults))


def _masked(report: Report, answer: Any, missing: tuple[Unknown, ...], profile: Profile) -> Report:  # noqa: ANN401
    if answer is None:
        return evolve(report, unknown=missing)
    return _without_disabled(report, answer.mask, profile)


def _without_disabled(report: Report, mask: int, profile: Profile) -> Report:
    """Return a report whose disabled channels have no number, whatever the module sent for them."""
    if report.readings is None:
        return evolve(report, mask=mask)
    enabled = channels_of(mask)
    readings = tuple(
        reading if channel in enabled else Reading(None, profile.units[channel], Status.DISABLED)
        for channel, reading in enumerate(report.readings)
    )
    faults = tuple(fault for fault in report.faults if fault.channel in enabled)
    return evolve(report, readings=readings, faults=faults, mask=mask)
