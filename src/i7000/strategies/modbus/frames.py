"""Strategies for Modbus RTU frames: damaged frames, and streams of frames and noise.

Laws: every damage has a name and changes the bytes. The expected frames of a stream are known from how it was made, not
from `i7000.modbus.split`.
"""

from collections.abc import Callable, Iterator

from attrs import frozen
from hypothesis import assume
from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from i7000 import Fault, Noise, Profile
from i7000.modbus import LONGEST_FRAME, SHORTEST_FRAME, Side, crc16, encode, seal
from i7000.strategies.modbus.messages import exchanges, profiles, requests
from i7000.strategies.wires import Damage, Damages, chunkings, damaged_by, each_byte, flipped_bits

__all__ = ["DAMAGES", "Damage", "Stream", "chunkings", "damaged", "frames", "streams"]

# --- damage -----------------------------------------------------------------------------------------------------------


def damaged(frame: bytes) -> SearchStrategy[Damage]:
    """Make damaged variants of a frame."""
    return damaged_by(DAMAGES, frame)


def _wrong_crcs(frame: bytes) -> Iterator[bytes]:
    for value in range(0x100):
        yield frame[:-2] + bytes((value,)) + frame[-1:]
        yield frame[:-1] + bytes((value,))


def _sealed(damage: Callable[[bytes], Iterator[bytes]]) -> Callable[[bytes], Iterator[bytes]]:
    """Apply `damage` to address and PDU, and compute the CRC again."""
    return lambda frame: map(seal, damage(frame[:-2]))


DAMAGES: Damages = {
    "flipped bit": flipped_bits,
    "lost byte": each_byte(lambda before, _, after: before + after),
    "doubled byte": each_byte(lambda before, byte, after: before + byte + byte + after),
    "swapped neighbours": each_byte(lambda before, byte, after: before + after[:1] + byte + after[1:]),
    "truncated": each_byte(lambda before, _, __: before),
    "wrong CRC": _wrong_crcs,
    "CRC high byte first": lambda frame: iter((frame[:-2] + frame[:-3:-1],)),
    "foreign byte": each_byte(lambda before, byte, after: before + b"\xff" + byte + after),
    "glued": lambda frame: iter((frame + frame,)),
    "flipped bit, right CRC": _sealed(flipped_bits),
    "lost byte, right CRC": _sealed(each_byte(lambda before, _, after: before + after)),
    "doubled byte, right CRC": _sealed(each_byte(lambda before, byte, after: before + byte + byte + after)),
    "truncated, right CRC": _sealed(each_byte(lambda before, _, __: before)),
}
"""The kinds of damage by label: each returns all wires that may result."""

# --- streams ----------------------------------------------------------------------------------------------------------

_FUNCTIONS = bytes((*range(0x01, 0x07), 0x0F, 0x10, 0x46))
_TELLING = 7
"""The number of bytes that determine the length of every frame."""
_NO_ADDRESSES = bytes(range(0xF8, 0x100))
_NO_FUNCTIONS = bytes(sorted(set(range(0xF8)) - {it | bit for it in _FUNCTIONS for bit in (0, 0x80)}))
_NO_SUB_FUNCTIONS = bytes(range(0x31, 0xF8))


@st.composite
def frames(draw: st.DrawFn, side: Side = Side.BOTH, profile: Profile | None = None) -> bytes:
    """Make frames of one side or both, including broadcasts and exceptions, of one module or of any."""
    profile = profile or draw(profiles())
    if side is Side.BOTH:
        side = draw(st.sampled_from((Side.REQUESTS, Side.RESPONSES)))
    if side is Side.REQUESTS:
        return encode(draw(requests(profile)), profile)
    return draw(exchanges(profile=profile)).response_wire


@frozen
class Stream:
    """Bytes received before a silence, and the expected frames and noise."""

    wire: bytes
    side: Side
    profile: Profile | None
    """The profile of the module, if known."""
    events: tuple[bytes | Noise, ...]
    """The frames, and the longest runs of noise between them."""


@st.composite
def streams(draw: st.DrawFn, side: Side | None = None) -> Stream:
    """Make streams of frames and noise, of one side or of any."""
    side = side or draw(st.sampled_from(Side))
    profile = draw(st.none() | profiles())
    kinds: list[Callable[[st.DrawFn, Side, Profile | None], _Events]] = [
        _frame,
        _foreign,
        _without_function,
        _without_sub_function,
        _with_wrong_crc,
        _cut_short,
    ]
    events: list[bytes | Noise] = []
    for kind in [*draw(st.lists(st.sampled_from(kinds), max_size=8)), *draw(st.sampled_from(([], [_unfinished])))]:
        for event in kind(draw, side, profile):
            last = events[-1] if events else None
            if isinstance(last, Noise) and isinstance(event, Noise):
                events[-1] = Noise(last.wire + event.wire, last.fault)
            else:
                events.append(event)
    wire = b"".join(event.wire if isinstance(event, Noise) else event for event in events)
    assume(_is_unambiguous(wire, events))
    return Stream(wire, side, profile, tuple(events))


_Events = list[bytes | Noise]


def _frame(draw: st.DrawFn, side: Side, profile: Profile | None) -> _Events:
    return [draw(frames(side, profile))]


def _foreign(draw: st.DrawFn, *_: object) -> _Events:
    first, others = draw(st.sampled_from(_NO_ADDRESSES)), draw(st.binary(max_size=20))
    return [Noise(bytes((first,)) + others, Fault.ADDRESS)]


def _without_function(draw: st.DrawFn, *_: object) -> _Events:
    address, function = draw(st.integers(1, 247)), draw(st.sampled_from(_NO_FUNCTIONS))
    return [Noise(bytes((address, function)), Fault.FUNCTION)]


def _without_sub_function(draw: st.DrawFn, *_: object) -> _Events:
    address, sub_function = draw(st.integers(1, 247)), draw(st.sampled_from(_NO_SUB_FUNCTIONS))
    return [Noise(bytes((address, 0x46, sub_function)), Fault.SUB_FUNCTION)]


def _with_wrong_crc(draw: st.DrawFn, side: Side, profile: Profile | None) -> _Events:
    frame = draw(frames(side, profile))
    return [Noise(draw(st.sampled_from([wire for wire in _wrong_crcs(frame) if wire != frame])), Fault.CRC)]


def _cut_short(draw: st.DrawFn, side: Side, profile: Profile | None) -> _Events:
    """Make a frame cut off after the bytes that determine its length; the next frame is longer than the rest."""
    frame = draw(frames(side, profile))
    last = len(frame) - 1
    end = draw(st.integers(max(min(_TELLING, last), last - 3), last))
    return [Noise(frame[:end], Fault.CRC), draw(frames(side, profile))]


def _unfinished(draw: st.DrawFn, side: Side, profile: Profile | None) -> _Events:
    """Make the beginning of a frame, shorter than any frame."""
    return [Noise(draw(frames(side, profile))[: draw(st.integers(1, 4))], Fault.LENGTH)]


def _is_unambiguous(wire: bytes, events: list[bytes | Noise]) -> bool:
    """Return whether only the frames have a valid CRC: no accidental one begins in noise or at a frame."""
    ends: dict[int, list[int]] = {}
    at = 0
    for event in events:
        if isinstance(event, Noise):
            ends |= {place: [] for place in range(at, at + len(event.wire))}
            at += len(event.wire)
        else:
            ends[at] = [at + len(event)]
            at += len(event)
    return all(_good_ends(wire, place) == good for place, good in ends.items())


_STARTS = {bytes((function | bit,)) for function in _FUNCTIONS for bit in (0, 0x80)}


def _good_ends(wire: bytes, at: int) -> list[int]:
    """Return the places where a CRC from a given start is valid: the end of the wire, or any if a function is there."""
    if wire[at + 1 : at + 2] not in _STARTS:
        return [] if crc16(wire[at:]) else [len(wire)]
    longest = min(len(wire), at + LONGEST_FRAME)
    return [end for end in range(at + SHORTEST_FRAME, longest + 1) if not crc16(wire[at:end])]
