"""Strategies for DCON frames: damaged frames, and streams of frames and noise.

Laws: every damage has a name and changes the bytes. The expected frames of a stream are known from how it was made, not
from `i7000.dcon.split`.
"""

from collections.abc import Iterator
from typing import TypeGuard

from attrs import frozen
from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from i7000 import Fault, Noise
from i7000.dcon import LONGEST_FRAME, seal, unseal
from i7000.dcon.frame import COMMAND_LEADS, RESPONSE_LEADS
from i7000.strategies.wires import Damage, Damages, chunkings, damaged_by, each_byte, flipped_bits

__all__ = ["DAMAGES", "Damage", "Stream", "chunkings", "damaged", "frames", "near_misses", "streams"]

# --- damage -----------------------------------------------------------------------------------------------------------


def damaged(frame: bytes) -> SearchStrategy[Damage]:
    """Make damaged variants of a frame, with or without checksum."""
    return damaged_by(DAMAGES, frame)


def _wrong_checksums(frame: bytes) -> Iterator[bytes]:
    for value in range(0x100):
        yield frame[:-3] + b"%02X\r" % value


DAMAGES: Damages = {
    "flipped bit": flipped_bits,
    "lost byte": each_byte(lambda before, _, after: before + after),
    "doubled byte": each_byte(lambda before, byte, after: before + byte + byte + after),
    "swapped neighbours": each_byte(lambda before, byte, after: before + after[:1] + byte + after[1:]),
    "lower-cased": each_byte(lambda before, byte, after: before + byte.lower() + after),
    "truncated": each_byte(lambda before, _, __: before),
    "wrong checksum": _wrong_checksums,
    "foreign byte": each_byte(lambda before, byte, after: before + b"\xff" + byte + after),
    "early end": each_byte(lambda before, byte, after: before + b"\r" + byte + after),
    "glued": lambda frame: iter((frame + frame,)),
}
"""The kinds of damage by label: each returns all wires that may result."""

_OF_FIELDS = b"+-. 09AF" + b"Ga_"
"""The characters of fields, and those that a lax number parser accepts as well."""


def near_misses(frame: bytes, *, checksum: bool) -> Iterator[bytes]:
    """Yield frames with one character of a field replaced, each with its correct checksum."""
    body = unseal(frame, checksum=checksum)
    for at in range(1, len(body)):
        for character in _OF_FIELDS:
            if character != body[at]:
                yield seal(body[:at] + bytes((character,)) + body[at + 1 :], checksum=checksum)


# --- streams ----------------------------------------------------------------------------------------------------------

_LEADS = COMMAND_LEADS + RESPONSE_LEADS
_PLAIN = bytes(sorted(set(range(0x20, 0x7F)) - set(_LEADS)))
_FOREIGN = bytes(sorted(set(range(0x100)) - set(range(0x20, 0x7F)) - set(b"\r")))


def _text(alphabet: bytes, smallest: int, longest: int) -> SearchStrategy[bytes]:
    return st.lists(st.sampled_from(alphabet), min_size=smallest, max_size=longest).map(bytes)


def _beginnings() -> SearchStrategy[bytes]:
    """Make incomplete frames."""
    return st.builds(bytes.__add__, st.sampled_from([bytes((lead,)) for lead in _LEADS]), _text(_PLAIN, 0, 20))


def frames(*, checksum: bool = False) -> SearchStrategy[bytes]:
    """Make frames that `i7000.dcon.split` accepts as complete, whether or not they are messages."""
    return _beginnings().map(lambda body: seal(body, checksum=checksum))


@frozen
class Stream:
    """Received bytes, and the expected frames and noise."""

    wire: bytes
    checksum: bool
    events: tuple[bytes | Noise, ...]
    """The frames, and the longest runs of noise between them; a frame with a wrong checksum is a run of its own."""
    rest: bytes


@st.composite
def streams(draw: st.DrawFn, *, checksum: bool = False) -> Stream:
    """Make streams of frames and noise."""
    events: list[bytes | Noise] = []
    kinds = [_frame, _cut_frame, _between, _foreign, _overlong, *([_wrongly_sealed] if checksum else [])]
    for kind in draw(st.lists(st.sampled_from(kinds), max_size=8)):
        for event in kind(draw, checksum):
            if events and _is_run(events[-1]) and _is_run(event):
                events[-1] = Noise(events[-1].wire + event.wire, events[-1].fault)
            else:
                events.append(event)
    rest = draw(st.just(b"") | _beginnings())
    wire = b"".join(event.wire if isinstance(event, Noise) else event for event in events) + rest
    return Stream(wire, checksum, tuple(events), rest)


def _is_run(event: bytes | Noise) -> TypeGuard[Noise]:
    return isinstance(event, Noise) and event.fault is not Fault.CHECKSUM


_Events = list[bytes | Noise]


def _frame(draw: st.DrawFn, checksum: bool) -> _Events:  # noqa: FBT001 - as its fellows
    return [draw(frames(checksum=checksum))]


def _cut_frame(draw: st.DrawFn, checksum: bool) -> _Events:  # noqa: FBT001
    return [Noise(draw(_beginnings()), Fault.TERMINATOR), draw(frames(checksum=checksum))]


def _between(draw: st.DrawFn, _: object) -> _Events:
    return [Noise(draw(_text(_PLAIN + _FOREIGN + b"\r", 1, 20)), Fault.LEADING)]


def _foreign(draw: st.DrawFn, _: object) -> _Events:
    foreign = draw(_text(_FOREIGN, 1, 2)) + draw(_text(_PLAIN + _FOREIGN + b"\r", 0, 20))
    return [Noise(draw(_beginnings()) + foreign, Fault.CHARACTER)]


def _overlong(draw: st.DrawFn, _: object) -> _Events:
    return [Noise(draw(_beginnings()) + b"0" * LONGEST_FRAME + draw(st.sampled_from((b"", b"\r"))), Fault.LENGTH)]


def _wrongly_sealed(draw: st.DrawFn, _: object) -> _Events:
    right = draw(frames(checksum=True))
    wrong = draw(st.sampled_from([wire for wire in _wrong_checksums(right) if wire != right]))
    return [Noise(wrong, Fault.CHECKSUM)]
