"""The splitters: no byte is lost, chunking changes nothing, less than a frame is kept, every good frame is found."""

from collections.abc import Callable, Iterable, Sequence
from functools import partial

from fuzz.codec_targets import REQUESTS
from fuzz.inputs import HEADER, pieces, profile_of
from i7000 import DecodeError, Noise, dcon, modbus
from i7000.modbus import Side

__all__ = ["WITH_PROFILE", "dcon_split", "modbus_split", "spans"]

Events = Sequence[bytes | Noise]
_SIDES = tuple(Side)
WITH_PROFILE, _WITH_REQUEST = 4, 8
"""Bits of the byte after the profile; below them is the side."""


def _wire(event: bytes | Noise) -> bytes:
    return event.wire if isinstance(event, Noise) else event


def spans(events: Iterable[bytes | Noise]) -> list[tuple[bool, bytes]]:
    """Return frames and the noise between them, joined, with whether each is a frame."""
    found: list[tuple[bool, bytes]] = []
    for event in events:
        if isinstance(event, Noise) and found and not found[-1][0]:
            found[-1] = (False, found[-1][1] + event.wire)
        else:
            found.append((not isinstance(event, Noise), _wire(event)))
    return found


def _in_pieces(
    split: Callable[[bytes], tuple[Events, bytes]], data: Iterable[bytes], longest: int
) -> tuple[list[bytes | Noise], bytes]:
    found: list[bytes | Noise] = []
    rest = b""
    for piece in data:
        events, rest = split(rest + piece)
        assert len(rest) < longest
        found += events
    return found, rest


def dcon_split(data: bytes) -> None:
    """Split a stream of DCON.

    Shape: whether frames have checksums, the size of the pieces, then the stream.
    """
    if len(data) < 2:
        return
    checksum, stream = bool(data[0] & 1), data[2:]
    split = partial(dcon.split, checksum=checksum)
    whole, rest = split(stream)
    assert b"".join(map(_wire, whole)) + rest == stream
    assert len(rest) < dcon.LONGEST_FRAME
    for event in whole:
        if not isinstance(event, Noise):
            dcon.unseal(event, checksum=checksum)
    found, kept = _in_pieces(split, pieces(stream, data[1]), dcon.LONGEST_FRAME)
    assert kept == rest
    assert spans(found) == spans(whole)
    good = dcon.seal(b"$012", checksum=checksum)
    assert split(rest + b"\r" + good)[0][-1] == good


def modbus_split(data: bytes) -> None:
    """Split a stream of Modbus RTU, and flush it.

    Shape: the profile, the side and whether profile and open request are known, the request, the size of the pieces,
        then the stream.
    """
    if len(data) < HEADER + 3:
        return
    options, number, cut = data[HEADER : HEADER + 3]
    stream = data[HEADER + 3 :]
    side = _SIDES[(options & 3) % len(_SIDES)]
    profile = profile_of(data) if options & WITH_PROFILE else None
    request = REQUESTS[number % len(REQUESTS)] if options & _WITH_REQUEST else None
    split = partial(modbus.split, side=side, profile=profile, request=request)
    flush = partial(modbus.flush, side=side, profile=profile, request=request)
    whole, rest = split(stream)
    end = flush(rest)
    assert b"".join(map(_wire, (*whole, *end))) == stream
    assert len(rest) < modbus.LONGEST_FRAME
    for event in (*whole, *end):
        if not isinstance(event, Noise):
            modbus.unseal(event)
    found, kept = _in_pieces(split, pieces(stream, cut), modbus.LONGEST_FRAME)
    assert kept == rest
    assert spans(found) == spans(whole)
    good = b"\x01\x04\x00\x00\x00\x08\xf1\xcc" if side is Side.REQUESTS else b"\x01\x84\x02\xc2\xc1"
    if request is not None:
        good = modbus.seal(bytes((request.address, request.function | 0x80, 2)))
    if request is None or modbus.is_answered(request):
        events, left = split(rest + good)
        _check_found(good, len(rest), (*events, *flush(left)))
    try:
        modbus.drop_echo(stream, good)
    except DecodeError as error:
        assert not good.startswith(stream)
        assert str(error)


def _check_found(good: bytes, start: int, events: Events) -> None:
    """Check that a good frame behind other bytes is found, unless a frame of those bytes goes over it."""
    at = 0
    for event in events:
        end = at + len(_wire(event))
        if not isinstance(event, Noise) and at < start + len(good) and end > start:
            return
        at = end
    raise AssertionError(f"{good.hex()} at {start} is not found")
