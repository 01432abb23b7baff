"""Why a module does not answer: a short search at its address, and the likely cause in a sentence.

Laws: the search only reads what changes nothing, and ends after a bounded number of requests. What does not answer in
time is asked once more with a long timeout, before anything else is taken for the cause.
"""

from collections.abc import Collection

from attrs import evolve

from i7000 import Model, Protocol
from i7000.host import TimedOut
from i7000.host.procedures import SCAN_POLICY, FindingKind, Place, Procedure, ask, scan
from i7000.link import Line

__all__ = ["LONG_TIMEOUT", "protocol_words", "silence_cause"]

_INIT_ADDRESS = 0x00
LONG_TIMEOUT = 1.0
"""Seconds after which even slow adapters and networks have passed a response on."""
_CAUSES = {
    FindingKind.NOTHING: "nothing came: check the address, --baud, the power and the wires (swap A and B)",
    FindingKind.ECHO: "only the echo of the request came: give --echo",
    FindingKind.NOISE: "bytes came that are not a frame: another --baud or --character-format, or swapped wires",
    FindingKind.FRAME: "a frame came that is not the response: another host or module is sending, or responses are late"
    " (a longer --timeout)",
    FindingKind.OTHER_PROTOCOL: "frames of the other protocol came: another host or module is sending, or responses are"
    " late (a longer --timeout)",
    FindingKind.WRONG_CHECKSUM: "a frame with a wrong checksum came: interference, or two modules at one address",
}
"""What was heard, the more telling the later, and what to do."""


def protocol_words(protocol: Protocol, *, checksum: bool) -> str:
    """Return a protocol in words.

    >>> protocol_words(Protocol.DCON, checksum=True)
    'DCON with a checksum'
    """
    return "Modbus RTU" if protocol is Protocol.MODBUS_RTU else f"DCON {'with' if checksum else 'without'} a checksum"


def silence_cause(
    line: Line, address: int, tried: Collection[tuple[Protocol, bool]], given: Model | None = None
) -> str:
    """Look for the module at an address, and return the likely cause of its silence.

    Shape: `tried` has the protocols that were tried, each with whether DCON frames had a checksum; `given` is the model
        that the user gave.
    Errors: `LinkError` for a port that is lost.
    """
    policy = evolve(SCAN_POLICY, turnaround=max(SCAN_POLICY.turnaround, line.policy.turnaround))
    scanned = line.run(scan([line.line], [address], policy=policy))
    devices = {finding.place.address: finding.place for finding in scanned.devices}
    if address in devices:
        return _device_cause(devices[address], tried, given)
    if _INIT_ADDRESS in devices:
        return (
            "a module in INIT mode answers at address 00: give --address 0, or switch INIT off and its power off and on"
        )
    if policy.turnaround < LONG_TIMEOUT and line.run(_answers_late(line, address, tried)):
        return f"its responses are late: give --timeout {LONG_TIMEOUT:g}"
    found = (finding.heard for finding in scanned.findings)
    return _CAUSES[max(found, key=[*_CAUSES].index, default=FindingKind.NOTHING)]


def _answers_late(line: Line, address: int, tried: Collection[tuple[Protocol, bool]]) -> Procedure[bool]:
    """Make the procedure that returns whether something answers within a long timeout."""
    policy = evolve(SCAN_POLICY, turnaround=LONG_TIMEOUT)
    for protocol, checksum in tried:
        place = Place(line.line, address, protocol, checksum=checksum)
        result = yield from ask(place.question, place.profile, policy)
        if not isinstance(result.outcome, TimedOut):
            return True
    return False


def _device_cause(place: Place, tried: Collection[tuple[Protocol, bool]], given: Model | None) -> str:
    words = protocol_words(place.protocol, checksum=place.checksum)
    if (place.protocol, place.checksum) in tried:
        return (
            f"it does answer {words} now: an unreliable line or a slow module; give a longer --timeout, more --retries"
        )
    if given is not None and place.protocol not in given.protocols:
        return f"it answers {words}, and {given.value} does not: leave out --model, or give another one"
    if place.protocol is Protocol.MODBUS_RTU:
        return f"it answers {words}: give --protocol rtu"
    return f"it answers {words}: give --protocol dcon {'--checksum' if place.checksum else '--no-checksum'}"
