"""The search for modules of unknown address and line settings.

Laws: a scan only reads what changes nothing, and never sends a broadcast. It asks once at each place, and once more
where something answers Modbus.
"""

from collections.abc import Iterable
from enum import Enum
from typing import Any

from attrs import field

from i7000 import dcon, modbus
from i7000.arguments import check_type
from i7000.errors import Fault, Noise
from i7000.frozen import frozen
from i7000.host.bus import Policy
from i7000.host.events import Answered, Declined, Ended
from i7000.host.procedures.asking import outcome_words
from i7000.host.procedures.places import SCAN_POLICY, Place, places, seconds_at
from i7000.host.procedures.step import Procedure, Result, Tell, Tune, ask
from i7000.message import Response
from i7000.models import Model
from i7000.settings import LineSettings, Protocol

__all__ = ["Finding", "FindingKind", "Progress", "Scanned", "scan"]


class FindingKind(Enum):
    """The kind of what was received at a place."""

    NOTHING = "nothing"
    """No byte."""
    NOISE = "noise"
    """Bytes that are not a frame: interference, or frames at another baud rate or character format."""
    ECHO = "echo"
    """Only the request itself: the adapter echoes what the host sends, and the host does not expect it."""
    OTHER_PROTOCOL = "frames of the other protocol"
    """Frames of the other protocol; modules of both can share a line."""
    WRONG_CHECKSUM = "a wrong checksum"
    """A frame whose checksum or CRC is missing or wrong."""
    FRAME = "another frame"
    """A frame that is not the response: late, of another module, or a name that no module of these models has."""
    REFUSAL = "a refusal"
    """A refusal or an exception, which only a device at this place sends."""
    ANSWER = "an answer"
    """The response."""


@frozen
class Finding:
    """What was received at a place, if it is not nothing.

    Shape: `name` is the name that the module sent (by Modbus that of the series, as 8 hex digits), and `models` are
        the models that have it from the factory. `reason` is what came of the request in words.
    """

    place: Place
    heard: FindingKind
    outcome: Ended
    name: str | None = field(default=None, kw_only=True)
    models: tuple[Model, ...] = field(default=(), kw_only=True)
    reason: str = field(default="", kw_only=True)

    @property
    def is_device(self) -> bool:
        """Whether a device is at the place: it answered, or refused."""
        return self.heard in (FindingKind.ANSWER, FindingKind.REFUSAL)


@frozen
class Progress:
    """How far a scan is: `done` of `total` places, the `place` where it looks now, and the time left.

    Unit: `seconds_left` in seconds, if nothing more answers.
    """

    done: int
    total: int
    place: Place
    seconds_left: float


@frozen
class Scanned:
    """The findings of a scan, in the order of the places, and how many places there were."""

    findings: tuple[Finding, ...]
    total: int

    @property
    def devices(self) -> tuple[Finding, ...]:
        """The findings of devices: places that answered or refused."""
        return tuple(finding for finding in self.findings if finding.is_device)


def scan(
    lines: Iterable[LineSettings],
    addresses: Iterable[int] = range(0x100),
    protocols: Iterable[Protocol] = (Protocol.DCON, Protocol.MODBUS_RTU),
    checksums: Iterable[bool] = (False, True),
    *,
    policy: Policy = SCAN_POLICY,
) -> Procedure[Scanned]:
    """Make the procedure that looks for modules at `places`, in their order.

    Shape: the arguments are those of `places`, and `policy` is that of every request. The procedure yields `Tell` of a
        `Progress` before each place, and of a `Finding` after it unless nothing was received. It yields `Tune` where
        the line settings change, and leaves the host at those of the last place.
    Time: `scan_time` returns it.
    Special: where a module answers DCON, the other checksum setting is not tried.
    Errors: as for `places`.

    >>> next(scan([LineSettings()], [0x01])).value.total
    4
    """
    check_type("policy", policy, Policy)
    return _scan(places(lines, addresses, protocols, checksums), policy)


def _scan(looked: tuple[Place, ...], policy: Policy) -> Procedure[Scanned]:
    left = sum(seconds_at(place, policy) for place in looked)
    line: LineSettings | None = None
    findings: list[Finding] = []
    answering: set[tuple[LineSettings, int]] = set()
    for done, place in enumerate(looked):
        yield Tell(Progress(done, len(looked), place, max(left, 0.0)))
        left -= seconds_at(place, policy)
        if place.protocol is Protocol.DCON and (place.line, place.address) in answering:
            continue
        if place.line != line:
            line = place.line
            yield Tune(line)
        finding = yield from _look(place, policy)
        if finding.heard is FindingKind.NOTHING:
            continue
        findings.append(finding)
        yield Tell(finding)
        if finding.is_device and place.protocol is Protocol.DCON:
            answering.add((place.line, place.address))
    return Scanned(tuple(findings), len(looked))


def _look(place: Place, policy: Policy) -> Procedure[Finding]:
    result = yield from ask(place.question, place.profile, policy)
    heard = heard_at(place, result)
    name = None
    models: tuple[Model, ...] = ()
    named: Result[Any] = result
    if place.protocol is Protocol.MODBUS_RTU and heard in (FindingKind.ANSWER, FindingKind.REFUSAL):
        named = yield from ask(modbus.ReadModuleName(place.address), place.profile, policy)
    if isinstance(named.outcome, Answered):
        name, models = _identity(named.outcome.response)
    reason = outcome_words(result, place.profile)
    return Finding(place, heard, result.outcome, name=name, models=models, reason=reason)


def _identity(response: dcon.ModuleName | modbus.ModuleName) -> tuple[str, tuple[Model, ...]]:
    """Return a name and the models that have it."""
    if isinstance(response, dcon.ModuleName):
        return response.name, tuple(model for model in Model if model.factory_name == response.name)
    speaking = (model for model in Model if Protocol.MODBUS_RTU in model.protocols)
    return response.name.hex().upper(), tuple(model for model in speaking if model.modbus_name == response.name)


# --- what was received ------------------------------------------------------------------------------------------------


def heard_at(place: Place, result: Result[Response]) -> FindingKind:
    """Return what was received at a place."""
    if isinstance(result.outcome, Answered):
        return FindingKind.ANSWER
    if isinstance(result.outcome, Declined):
        return FindingKind.REFUSAL
    wire = b"".join(other.wire for other in result.others)
    codec = dcon if place.protocol is Protocol.DCON else modbus
    request = codec.encode(place.question, place.profile)
    rest = wire.replace(request, b"", 1)
    if not rest:
        return FindingKind.ECHO if wire else FindingKind.NOTHING
    if _has_frames(rest, place):
        return FindingKind.OTHER_PROTOCOL
    if any(not isinstance(other, Noise) and other.wire != request for other in result.others):
        return FindingKind.FRAME
    return FindingKind.WRONG_CHECKSUM if _has_wrong_checksum(rest, place, result) else FindingKind.NOISE


def _has_frames(wire: bytes, place: Place) -> bool:
    """Return whether bytes have frames of the other protocol."""
    if place.protocol is Protocol.MODBUS_RTU:
        found, _ = dcon.split(wire)
    else:
        parts, rest = modbus.split(wire)
        found = (*parts, *modbus.flush(rest))
    return any(isinstance(part, bytes) for part in found)


def _has_wrong_checksum(wire: bytes, place: Place, result: Result[Response]) -> bool:
    """Return whether bytes are a frame of the protocol, but for its checksum or CRC."""
    if place.protocol is Protocol.DCON:
        return any(isinstance(other, Noise) and other.fault is Fault.CHECKSUM for other in result.others)
    function = wire[1:2]
    return wire[0] == place.address and function in (b"\x04", b"\x84")
