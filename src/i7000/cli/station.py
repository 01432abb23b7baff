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
from i7000.host import Declined, TimedOut
from i7000.host.procedures import ChannelFault, Identified, Place, Procedure, Report, identify, read, scan
from i7000.host.procedures.identified import profile_of
from i7000.link import Line

__all__ = ["Polled", "Station", "at_words", "candidates_words", "found_words", "merged"]

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
    doubted: bool = False
    """Whether it may be another module, or have other settings, than `profile` says."""
    pause: float = 0.0
    """The seconds between the last two attempts to identify it; 0 if there was one, or none."""
    again: float = -inf
    """The time of the next one."""
    said: tuple[str, ...] = ()
    """What was said about it."""

    def identify(self, line: Line) -> tuple[str, ...]:
        """Identify the module if it is unknown or doubted, and return what there is to say about it.

        Time: a module that does not say what it is, or is not as it said, is left alone for a while.
        """
        if (self.profile is not None and not self.doubted) or monotonic() < self.again:
            return ()
        wanted = self.wanted
        quick = self.doubted or len(wanted.tried) > 1
        there, silent = line.run(_look(wanted, line.line)) if quick else ((), False)
        place = next(iter(there), None)
        again = self.pause > 0
        self.pause = min(max(2 * self.pause, _FIRST_REST), _LONGEST_REST)
        self.again = monotonic() + self.pause
        if self.doubted and place is None:
            return ()
        protocols, checksum, policy = wanted.protocols, wanted.given.checksum, line.policy
        if place is not None:
            protocols = (place.protocol,)
            checksum = place.checksum if place.protocol is Protocol.DCON else checksum
        elif again:
            policy = evolve(policy, retries=0)
        elif silent:
            policy = evolve(policy, retries=max(0, policy.retries - _TRIED))
        found = line.run(identify(wanted.address, protocols=protocols, checksum=checksum, policy=policy))
        return self._take(found, line.run(stored_settings(found)), tuple(_others(there)))

    def _take(self, found: Identified, stored: Stored | None, others: tuple[str, ...]) -> tuple[str, ...]:
        """Take what a module says that it is, and the protocols by which others answer at its address.

        Special: a profile is kept until there is a better one.
        """
        given = self.wanted.given
        if found.protocol is None and (self.profile is not None or given.model is None):
            self.answered = self.profile is not None and self.answered
            return ()
        self.answered = self.identified = found.protocol is not None
        try:
            profile = merged(given, found)
        except InvalidValueError as error:
            return self._not_read(f"what is given does not fit the module: {error}")
        if profile is None:
            return self._not_read(f"{'; '.join(found.reasons)}: give --model")
        if not profile.type_codes:
            return self._not_read(_untyped_words(self.wanted, found))
        self.profile, self.doubted, self.mask = profile, False, None
        self.protocol = self.wanted.protocols[0] if found.protocol is None else found.protocol
        words = (*found_words(self.wanted, found, profile, stored), *others) if self.answered else ()
        before, self.said = self.said, words
        return () if words == before else words

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
        self.answered = report.rejected or not isinstance(report.outcome, TimedOut)
        self.mask = report.mask if self.answered else None
        polled = Polled(address, _now(), self.answered, report.reason, report, self.profile, self.protocol)
        self.doubted = not (polled.understood or isinstance(report.outcome, Declined))
        if not self.doubted:
            self.pause = 0.0
        return polled


def _look(wanted: Wanted, settings: LineSettings) -> Procedure[tuple[tuple[Place, ...], bool]]:
    """Make the procedure that looks quickly by which protocols modules answer, and whether nothing was heard."""
    checksums = {checksum for protocol, checksum in wanted.tried if protocol is Protocol.DCON}
    scanned = yield from scan([settings], [wanted.address], wanted.protocols, sorted(checksums))
    places = tuple(finding.place for finding in scanned.devices if finding.place.address == wanted.address)
    return places, not scanned.findings


def _others(places: tuple[Place, ...]) -> Iterator[str]:
    """Yield what answers in another protocol than the first at an address."""
    for place in places:
        if place.protocol is not places[0].protocol:
            others = protocol_words(place.protocol, checksum=place.checksum)
            yield f"{at_words(place.address)}: another module answers there by {others}; --protocol chooses one"


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
    models = candidates_words(found) or profile.model.value
    read_as = f", read as {profile.model.value}" if len(found.candidates) > 1 else ""
    version = found.known.firmware or found.version
    firmware = f" {version}" if version else ""
    protocol = protocol_words(found.protocol or Protocol.DCON, checksum=profile.checksum)
    reasons = f" ({'; '.join(found.reasons)})" if found.reasons else ""
    yield f"{at}: {models}{firmware}{read_as}, {protocol}{reasons}"
    if stored is not None:
        yield f"{at}: it is {stored.words()}"
    if other := _other_model(wanted, found):
        yield f"{at}: it is read as {profile.model.value}, as given, but it answers as {other}"
    learned = dict(_facts(found.known))
    for name, value in _facts(wanted.given):
        said = learned.get(name)
        if name != "model" and said is not None and not _agree(value, said):
            yield f"{at}: {fact_words(Fact(name, value))} is given, but the module says {fact_words(Fact(name, said))}"


def _untyped_words(wanted: Wanted, found: Identified) -> str:
    """Return why a module has no types, and what to give."""
    if wanted.given.model and (other := _other_model(wanted, found)):
        given = wanted.given.model.value
        return f"--model {given} is given, but it answers as {other}: leave out --model, or give --type too"
    reasons = "; ".join(it.reason for it in found.unknown if it.name == "types")
    return f"the types of its channels are unknown{f' ({reasons})' if reasons else ''}: give --type"


def _models(found: Identified) -> str:
    return " or ".join(candidate.model.value for candidate in found.candidates)


def candidates_words(found: Identified) -> str:
    """Return the models that a module can be, the most likely one first; an empty text if there are none."""
    words = _models(found)
    doubted = len(found.candidates) == 1 and found.candidates[0].doubts
    return f"probably {words}" if doubted else words


def _other_model(wanted: Wanted, found: Identified) -> str:
    """Return the models that a module can be if the given one is not among them, or else an empty text."""
    given = wanted.given.model
    return _models(found) if given and given not in {it.model for it in found.candidates} else ""


def _agree(given: object, said: object) -> bool:
    """Return whether two facts are the same; one type stands for all channels."""
    if isinstance(given, tuple) and isinstance(said, tuple) and 1 in (len(given), len(said)):
        return {*given} == {*said}
    return given == said


def at_words(address: int) -> str:
    """Return an address in words."""
    return f"address {describe.address(address)}"
