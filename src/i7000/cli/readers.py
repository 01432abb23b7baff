"""The input of ``i7000 decode`` -> what is read of it: frames with their meanings, and lines without.

Laws: pure; what is read of a line, packet or chunk depends on those before it, never on those after it.
"""

import re
from collections.abc import Iterable, Iterator
from datetime import UTC, date, datetime
from enum import Enum
from math import isnan, nan
from typing import NamedTuple

from attrs import evolve

from i7000.dissect import Heard, Kind, Knowledge, Line, Piece, Place, flush, hear, hear_frame, pieces
from i7000.dissect.capture import Damage, Packet, packets
from i7000.dissect.repeats import sent
from i7000.dissect.stream import looks_like, split
from i7000.dissect.timing import Times, taken
from i7000.recording import Carried, Damaged, End, Start, read
from i7000.settings import Protocol

__all__ = ["Missing", "Read", "hinted", "of_capture", "of_lines", "of_recording", "of_stream", "stamped"]

_STAMP = re.compile(
    r"(?<![\w:.])(?:\d{4}[-/.]\d\d[-/.]\d\d[T ])?\d\d?:\d\d:\d\d(?:[.,]\d{1,9})?(?:Z|[-+]\d\d:?\d\d)?(?![\w:])"
)
_CLOCK = re.compile(r"(\d\d?):(\d\d):(\d\d)(?:[.,](\d+))?")
_HALF_A_DAY = 12 * 3600
_SILENCE = 0.5
"""Seconds between two packets after which what is unfinished has ended."""


class Missing(Enum):
    """What is there in place of a frame."""

    NOTHING = "no frame in this line"
    REPEAT = "a frame that was there already, and was not on the wire again"
    DAMAGE = "what the file has not, or has no more"


class Read(NamedTuple):
    """A frame, or a line, packet or piece of a stream without one."""

    number: int
    """Records are counted from 1."""
    line: int
    """The line of a log, the packet of a capture file, or the frame of a stream: the first that has it."""
    last: int
    text: str
    """What was written there."""
    time: str | None
    """When, as it is written there, or in UTC."""
    heard: Heard | None
    missing: Missing | None = None
    """Why nothing was heard there."""
    note: str | None = None
    """The same in words."""
    knowledge: Knowledge | None = None
    """What is known of the modules after it was heard; None if nothing was heard."""
    times: Times | None = None
    """When, in seconds; None if unknown, or only written in `time`."""
    sent: bool | None = None
    """Whether the host sent it; None if the input does not say."""

    @property
    def understood(self) -> bool:
        """Whether nothing is wrong with it."""
        return self.missing is not Missing.DAMAGE if self.heard is None else self.heard.understood


def of_lines(lines: Iterable[tuple[int, str]], knowledge: Knowledge, protocol: Protocol | None) -> Iterator[Read]:
    """Read a log."""
    line = Line(knowledge, protocol)
    before: tuple[str, str] | None = None
    for number, piece in enumerate(pieces(lines, protocol), 1):
        start, last, text, kind, wire, same_as = piece
        heard, missing, note = None, None, None
        if same_as is not None:
            missing, note = Missing.REPEAT, f"the same as line {same_as}, printed once more"
        elif kind is None:
            missing, note = Missing.NOTHING, Missing.NOTHING.value
        else:
            place = Place(number, f"line {start}")
            asked = line.requests.asked
            again = asked is not None and asked.wire == wire  # Only the words beside it show what it is.
            kind_of = _protocol_of(piece) if protocol is None else protocol
            line, heard = hear_frame(line, wire, kind_of, place, sent=sent(text) if again else None)
        time = _time(text)
        if time is not None:
            if heard is not None and before is not None and _is_before(time, before[0]):
                heard = _noted(heard, before[1])
            before = time, f"line {start}"
        yield Read(number, start, last, _shown(text), time, heard, missing, note, line.knowledge)


def hinted(reads: Iterable[Read], protocol: Protocol | None) -> Iterator[Read]:
    """Yield what was read; with a note where a frame can be decoded without the option that names the protocol."""
    for one in reads:
        heard = one.heard
        hint = () if heard is None or heard.error is None or protocol is None else _hint(heard.wire, protocol)
        yield one._replace(heard=evolve(heard, notes=(*heard.notes, *hint))) if heard and hint else one


def _hint(wire: bytes, protocol: Protocol) -> tuple[str, ...]:
    option, other = _OTHERS[protocol]
    _, found = hear_frame(Line(), wire, other)
    return () if found.error else (f"decode it without {option}",)


_OTHERS = {
    Protocol.DCON: ("--protocol dcon", Protocol.MODBUS_RTU),
    Protocol.MODBUS_RTU: ("--protocol rtu", Protocol.DCON),
}
"""The option for a protocol, and the protocol that it excludes."""


def _noted(heard: Heard, where: str) -> Heard:
    return evolve(heard, notes=(*heard.notes, f"its time is before that of {where}"))


def _is_before(time: str, other: str) -> bool:
    """Return whether a time is certainly before another; the time of a day without its date can be of the next day."""
    (date, zone, seconds), (other_date, other_zone, other_seconds) = map(_read_time, (time, other))
    if zone != other_zone or bool(date) != bool(other_date):
        return False
    if not date:
        return 0 < other_seconds - seconds < _HALF_A_DAY
    return (date, seconds) < (other_date, other_seconds)


def _read_time(time: str) -> tuple[str, str, float]:
    """Return the date of a time, its zone, and its seconds."""
    date, hours, minutes, seconds, fraction, zone = _CLOCK.split(time, 1)
    return date, zone, int(hours) * 3600 + int(minutes) * 60 + float(f"{seconds}.{fraction or 0}")


def stamped(time: str) -> Times | None:
    """Return the time that a log has beside a frame in seconds, as fine as it is written; None for what is not a date.

    >>> stamped("12:00:01.25")
    Times(began=43201.25, ended=43201.25, gap=0.0, resolution=0.01)
    """
    if not _CLOCK.search(time):
        return None
    day, _, seconds = _read_time(time)
    try:
        days = date(*map(int, _NUMBER.findall(day))).toordinal() if day else 0
    except ValueError:
        return None
    *_, fraction, _ = _CLOCK.split(time, 1)
    at = days * 86400 + seconds
    return Times(at, at, resolution=10.0 ** -len(fraction or ""))


_NUMBER = re.compile(r"\d+")


def _protocol_of(piece: Piece) -> Protocol:
    if piece.kind is Kind.DAMAGED:
        return looks_like(piece.wire)
    return Protocol.DCON if piece.kind is Kind.DCON else Protocol.MODBUS_RTU


def _shown(text: str) -> str:
    """Return a line without its end; bytes that are not UTF-8 are escaped."""
    text = text.rstrip("\r\n")
    return text if text.isascii() else text.encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")


def _time(text: str) -> str | None:
    if ":" not in text:
        return None
    stamp = _STAMP.search(text)
    return stamp and stamp[0]


def of_stream(data: Iterable[bytes], knowledge: Knowledge, protocol: Protocol | None) -> Iterator[Read]:
    """Read what was on a line; an empty piece is a silence."""
    line = Line(knowledge, protocol)
    for piece in data:
        line, found = hear(line, piece) if piece else flush(line)
        yield from (_frame(heard, heard.place.number, line.knowledge) for heard in found)
    line, found = flush(line)
    yield from (_frame(heard, heard.place.number, line.knowledge) for heard in found)


def of_capture(data: Iterable[bytes], knowledge: Knowledge, protocol: Protocol | None) -> Iterator[Read]:
    """Read a pcap or pcapng file; a frame can be in several packets, and a packet can have several frames."""
    return _of_packets(packets(data), "packet", knowledge, protocol)


def of_recording(lines: Iterable[tuple[int, str]], knowledge: Knowledge, protocol: Protocol | None) -> Iterator[Read]:
    """Read a recording, whose lines are as packets of a capture file."""
    return _of_packets(_recorded(lines), "line", knowledge, protocol)


def _recorded(lines: Iterable[tuple[int, str]]) -> Iterator[Packet | Damage]:
    """Yield what a recording has of the line, with dates."""
    began: float | None = None
    ended = False
    number = 0
    for number, text in lines:
        ended = False
        match read(text):
            case Start() as start:
                began = _date(start.time)
            case Carried() as carried:
                time = None if began is None else began + carried.seconds
                yield Packet(number, time, carried.sent, carried.wire)
            case End():
                ended = True
            case Damaged(reason):
                yield Damage(number, reason)
    if not ended:
        yield Damage(number, "the recording has no end: what followed is not in it")


def _date(text: str) -> float | None:
    """Return a date as seconds since 1970."""
    try:
        return datetime.fromisoformat(text).timestamp()
    except (ValueError, OverflowError):
        return None


def _of_packets(
    found: Iterable[Packet | Damage], word: str, knowledge: Knowledge, protocol: Protocol | None
) -> Iterator[Read]:
    line = Line(knowledge, protocol)
    arrivals: list[tuple[float, int]] = []
    before: Packet | None = None
    late: str | None = None
    for packet in found:
        if before is not None and (isinstance(packet, Damage) or _is_apart(before, packet)):
            line, heard = flush(line, f"{word} {before.number}", sent=before.outbound)
            yield from _frames(heard, line.knowledge, before, late, arrivals)
        if isinstance(packet, Damage):
            line = evolve(line, count=line.count + 1)
            at = before.number if before else 0
            yield Read(
                line.count,
                at,
                at,
                f"{'byte' if word == 'packet' else word} {packet.offset}",
                None,
                None,
                Missing.DAMAGE,
                packet.reason,
            )
            continue
        for note in _lost(packet):
            line = evolve(line, count=line.count + 1)
            yield Read(line.count, packet.number, packet.number, "", _utc(packet), None, Missing.DAMAGE, note)
        arrivals += [(nan if packet.time is None else packet.time, len(packet.wire))] if packet.wire else []
        line, heard = hear(line, packet.wire, f"{word} {packet.number}", sent=packet.outbound)
        late = f"{word} {before.number}" if before and _is_late(before, packet) else None
        yield from _frames(heard, line.knowledge, packet, late, arrivals)
        if line.rest and _is_whole(line.rest, protocol):
            line, heard = flush(line, f"{word} {packet.number}", sent=packet.outbound)
            yield from _frames(heard, line.knowledge, packet, late, arrivals)
        before = packet
    if before is not None:
        line, heard = flush(line, f"{word} {before.number}", sent=before.outbound)
        yield from _frames(heard, line.knowledge, before, late, arrivals)


def _frames(
    found: Iterable[Heard], knowledge: Knowledge, packet: Packet, late: str | None, arrivals: list[tuple[float, int]]
) -> Iterator[Read]:
    """Yield frames with the times of the packets that had them, which are removed from `arrivals`."""
    for heard in found:
        times = taken(arrivals, len(heard.wire))
        read = _frame(heard, packet.number, knowledge, packet, late)
        known = not any(map(isnan, times)) and times == sorted(times)
        yield (
            read._replace(times=Times.of(times), sent=packet.outbound) if known else read._replace(sent=packet.outbound)
        )


def _is_late(before: Packet, packet: Packet) -> bool:
    """Return whether the times of two packets go back."""
    return before.time is not None and packet.time is not None and packet.time < before.time


def _is_whole(rest: bytes, protocol: Protocol | None) -> bool:
    """Return whether bytes that could still become another frame are frames as they stand, as most packets are."""
    spans, _ = split(rest, protocol, last=True)
    return all(span.is_frame for span in spans)


def _lost(packet: Packet) -> Iterator[str]:
    """Yield what of a packet is not in the file."""
    if packet.note:
        yield packet.note
    if packet.missing:
        yield f"{packet.missing} bytes of the packet were not captured"


def _utc(packet: Packet) -> str | None:
    """Return the time of a packet; the seconds since 1970 where that is not a date."""
    try:
        return None if packet.time is None else datetime.fromtimestamp(packet.time, UTC).isoformat()
    except (ValueError, OverflowError, OSError):
        return f"{packet.time} s"


def _is_apart(before: Packet, packet: Packet) -> bool:
    """Return whether two packets cannot have parts of one frame."""
    turned = before.outbound is not None and packet.outbound is not None and before.outbound != packet.outbound
    late = before.time is not None and packet.time is not None and packet.time - before.time > _SILENCE
    return turned or late


_ESCAPES = {code: f"\\x{code:02x}" for code in (*range(0x20), 0x7F)} | {9: r"\t", 10: r"\n", 13: r"\r"}


def _frame(
    heard: Heard, line: int, knowledge: Knowledge, packet: Packet | None = None, late: str | None = None
) -> Read:
    """Return what was heard; `late` is the packet before, if the time of that is later."""
    wire = heard.wire
    text = wire.hex(" ").upper()
    if heard.protocol is Protocol.DCON:
        shown = wire[:-1] if len(wire) > 1 and wire[-1:] == b"\r" else wire
        text = shown.decode("ascii", "backslashreplace").translate(_ESCAPES)
    heard = heard if late is None else _noted(heard, late)
    time = packet and _utc(packet)
    return Read(heard.place.number, line, line, text, time, heard, knowledge=knowledge)
