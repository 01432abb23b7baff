"""A line as the tests of the judge hear it: pieces with their times, of a list or of a port in virtual time."""

from collections.abc import Iterable

from i7000 import Protocol
from i7000.conformance.judge import Finding, Judge, Rule, judge
from i7000.dissect import Knowledge, Known, Line, hear_frame
from i7000.dissect.timing import TimedHeard, TimedLine, Times, flush_at, hear_at
from i7000.link import VirtualPort

__all__ = ["CHARACTER", "Piece", "conversation", "judged", "judged_frames", "rules"]

CHARACTER = 10 / 9600
"""Seconds of a character of a line as it comes from the factory."""
Piece = tuple[float, bytes]
"""The time of some bytes, and the bytes."""


def judged(
    pieces: Iterable[Piece], state: Judge | None = None, known: Known | None = None, protocol: Protocol | None = None
) -> tuple[Judge, list[Finding]]:
    """The judgement of pieces at their times; a silence of 50 ms ends what is unfinished."""
    state = state or Judge(character_time=CHARACTER)
    timed = TimedLine(Line(Knowledge.given(known or Known()), protocol))
    findings: list[Finding] = []

    def take(state: Judge, found: tuple[TimedHeard, ...]) -> Judge:
        for it in found:
            times = Times(it.began, it.ended, it.gap)
            state, of_frame = judge(state, it.heard, timed.line.knowledge, times)
            findings.extend(of_frame)
        return state

    before = None
    for now, data in pieces:
        if before is not None and now - before >= 0.05:
            timed, found = flush_at(timed, now)
            state = take(state, found)
        timed, found = hear_at(timed, data, now)
        state = take(state, found)
        before = now
    timed, found = flush_at(timed, timed.clock)
    return take(state, found), findings


def judged_frames(
    *frames: tuple[float | None, bytes], state: Judge | None = None, known: Known | None = None
) -> tuple[Judge, list[Finding]]:
    """The judgement of whole frames, each so many seconds after the one before; None: the times are unknown."""
    state, line, now = state or Judge(character_time=CHARACTER), Line(Knowledge.given(known or Known())), 100.0
    findings: list[Finding] = []
    for wait, wire in frames:
        now += wait or 0.0
        protocol = Protocol.DCON if wire[-1:] in (b"\r", b"\n") and wire[0] > 0x20 else Protocol.MODBUS_RTU
        line, heard = hear_frame(line, wire, protocol)
        state, found = judge(state, heard, line.knowledge, None if wait is None else Times(now, now))
        findings.extend(found)
    return state, findings


def rules(findings: Iterable[Finding]) -> list[Rule]:
    """The rules that were broken."""
    return [finding.rule for finding in findings]


def conversation(port: VirtualPort, *steps: tuple[float, bytes]) -> list[Piece]:
    """What a listener hears of a driver that waits, sends a frame and reads for 100 ms, each byte at its time.

    A frame after a negative time is sent when so many seconds have passed since the frame before, unread.
    """
    pieces: list[Piece] = []
    port.timeout = 0.1
    unread = [wait < 0 for wait, _ in (*steps[1:], (0.0, b""))]
    for (wait, wire), hurried in zip(steps, unread, strict=True):
        port.sleep(abs(wait))
        began = port.now()
        port.write(wire)
        port.flush()
        pieces += [(began + (at + 1) * CHARACTER, wire[at : at + 1]) for at in range(len(wire))]
        while not hurried and (byte := port.read(1)):
            pieces.append((port.now(), byte))
    return sorted(pieces, key=lambda piece: piece[0])
