"""A module that is read: identified at first, then polled.

Laws: what is given beats what a module says, and that beats the factory defaults.
"""

from collections.abc import Iterator
from datetime import UTC, datetime
from math import inf
from time import monotonic
from typing import Any

from attrs import define, evolve, fields, frozen

from i7000 import LineSettings, Profile, Protocol, describe
from i7000.cli.silence import protocol_words
from i7000.cli.stored import Stored, stored_settings
from i7000.cli.wanted import Wanted
from i7000.dissect import Fact, Known
from i7000.dissect.known import fact_words
from i7000.errors import InvalidValueError
from i7000.host import TimedOut
from i7000.host.procedures import ChannelFault, Identified, Place, Procedure, Report, identify, read, scan
from i7000.host.procedures.identified import profile_of
from i7000.link import Line

__all__ = ["Polled", "Station", "at_words", "found_words", "merged"]

_SILENT = "no answer"
_TRIED = 2
"""The retries that are made otherwise: the quick look before, and the search for the cause of a silence after it."""
_FIRST_REST = 2.0
_LONGEST_REST = 60.0
"""Seconds for which a module that does not say what it is is left alone, at first and at most."""


@frozen
class Polled:
    """What came of reading a module once.

    Shape: `report` is None if the module is not identified; `reason` says why there are no readings.
    """

    address: int
    time: datetime
    answered: bool
    """Whether the module answered, if only with a refusal."""
    reason: str = ""
    report: Report | None = None
    profile: Profile | None = None
    protocol: Protocol | None = None

    @property
    def has_readings(self) -> bool:
        """Whether there are readings, if not of all channels."""
        return self.report is not None and self.report.readings is not None

    @property
    def faults(self) -> tuple[ChannelFault, ...]:
        """The readings that are not understood."""
        return () if self.report is None else self.report.faults

    @property
    def understood(self) -> bool:
        """Whether there are readings of all channels."""
        return self.has_readings and not self.faults


@define
class Station:
    """A module that is read, and what is known of it by now."""

    wanted: Wanted
    protocol: Protocol | None = None
    profile: Profile | None = None
    mask: int | None = None
    reason: str = _SILENT
    """Why it is not read, while `profile` is None."""
    identified: bool = False
    """Whether it said what it is."""
    answered: bool = True
    """Whether it answered the last time."""
    pause: float = 0.0
    """The seconds until then."""
    again: float = -inf
    """When it is to be identified again."""

    def identify(self, line: Line) -> tuple[str, ...]:
        """Identify the module, unless that is done, and return what there is to say about it."""
        if self.profile is not None or monotonic() < self.again:
            return ()
        wanted = self.wanted
        protocols, checksum, policy = wanted.protocols, wanted.given.checksum, line.policy
        place = line.run(_look(wanted, line.line)) if len(wanted.tried) > 1 else None
        if place is not None:
            protocols = (place.protocol,)
            checksum = place.checksum if place.protocol is Protocol.DCON else checksum
        else:
            policy = evolve(policy, retries=0 if self.pause else max(0, policy.retries - _TRIED))
        found = line.run(identify(wanted.address, protocols=protocols, checksum=checksum, policy=policy))
        self.pause = min(max(2 * self.pause, _FIRST_REST), _LONGEST_REST)
        self.again = monotonic() + self.pause
        self.answered = self.identified = found.protocol is not None
        if not self.answered and wanted.given.model is None:
            return ()
        try:
            profile = merged(wanted.given, found)
        except InvalidValueError as error:
            return self._not_read(f"what is given does not fit the module: {error}")
        if profile is None:
            return self._not_read(f"{'; '.join(found.reasons)}: give --model")
        self.profile = profile
        self.protocol = wanted.protocols[0] if found.protocol is None else found.protocol
        if not self.answered:
            return ()
        return tuple(found_words(wanted, found, profile, line.run(stored_settings(found))))

    def _not_read(self, reason: str) -> tuple[str, ...]:
        """Remember why the module is not read; it is said once."""
        before, self.reason = self.reason, reason
        return () if reason == before else (f"{at_words(self.wanted.address)}: {reason}",)

    def poll(self, line: Line) -> Polled:
        """Read the module once, if it is identified."""
        address = self.wanted.address
        if self.profile is None or self.protocol is None:
            return Polled(address, _now(), self.answered, self.reason)
        policy = None if self.answered else evolve(line.policy, retries=0)
        report = line.run(read(address, self.profile, protocol=self.protocol, mask=self.mask, policy=policy))
        self.answered = not isinstance(report.outcome, TimedOut)
        self.mask = report.mask if self.answered else None
        return Polled(address, _now(), self.answered, report.reason, report, self.profile, self.protocol)


def _look(wanted: Wanted, settings: LineSettings) -> Procedure[Place | None]:
    """Make the procedure that looks quickly by which protocol a module answers; None if it does not."""
    checksums = {checksum for protocol, checksum in wanted.tried if protocol is Protocol.DCON}
    scanned = yield from scan([settings], [wanted.address], wanted.protocols, sorted(checksums))
    return next((finding.place for finding in scanned.devices if finding.place.address == wanted.address), None)


def _now() -> datetime:
    return datetime.now(UTC)


def merged(given: Known, found: Identified) -> Profile | None:
    """Return the profile of a module: what is given, then what it says, then the factory defaults.

    Shape: None if neither says which model it is. Without types if neither says them.
    Errors: `EncodeError` if no module has this combination.
    """
    model = given.model or found.model
    if model is None:
        return None
    both = evolve(found.known, **{name: value for name, value in _facts(given) if name not in ("model", "models")})
    if found.protocol is None:
        both = evolve(both, types=both.types or Profile(model).type_codes)
    profile = profile_of(both, model)
    if given.types is not None:
        profile = evolve(profile, type_codes=_every(given, profile))
    return profile


def _every(given: Known, profile: Profile) -> Any:  # noqa: ANN401 - types, which the profile checks
    types = given.types or ()
    return types * profile.channels if len(types) == 1 else types


def _facts(known: Known) -> Iterator[tuple[str, Any]]:
    return ((it.name, value) for it in fields(Known) if (value := getattr(known, it.name)) not in (None, ()))


def found_words(wanted: Wanted, found: Identified, profile: Profile, stored: Stored | None) -> Iterator[str]:
    """Yield what a module says that it is, with the reasons, and what contradicts what is given."""
    at = at_words(wanted.address)
    models = " or ".join(candidate.model.value for candidate in found.candidates) or profile.model.value
    read_as = f", read as {profile.model.value}" if len(found.candidates) > 1 else ""
    version = found.known.firmware or found.version
    firmware = f" {version}" if version else ""
    protocol = protocol_words(found.protocol or Protocol.DCON, checksum=profile.checksum)
    reasons = f" ({'; '.join(found.reasons)})" if found.reasons else ""
    yield f"{at}: {models}{firmware}{read_as}, {protocol}{reasons}"
    if stored is not None:
        yield f"{at}: it is {stored.words()}"
    if wanted.given.model and found.candidates and wanted.given.model not in {it.model for it in found.candidates}:
        yield f"{at}: it is read as {wanted.given.model.value}, as given, but it answers as {models}"
    learned = dict(_facts(found.known))
    for name, value in _facts(wanted.given):
        said = learned.get(name)
        if name != "model" and said is not None and not _agree(value, said):
            yield f"{at}: {fact_words(Fact(name, value))} is given, but the module says {fact_words(Fact(name, said))}"


def _agree(given: object, said: object) -> bool:
    """Return whether two facts are the same; one type stands for all channels."""
    if isinstance(given, tuple) and isinstance(said, tuple) and 1 in (len(given), len(said)):
        return {*given} == {*said}
    return given == said


def at_words(address: int) -> str:
    """Return an address in words."""
    return f"address {describe.address(address)}"
