"""Strategies for bytes of both protocols: damaged frames, and the pieces in which a stream arrives."""

from collections.abc import Callable, Iterator, Mapping

from attrs import frozen
from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

__all__ = ["Damage", "Damages", "chunkings", "damaged_by", "each_byte", "flipped_bits"]

Damages = Mapping[str, Callable[[bytes], Iterator[bytes]]]
"""The kinds of damage by label: each returns all wires that may result."""


@frozen
class Damage:
    """A frame, its damage, and the resulting bytes, which differ from the frame."""

    label: str
    """The label of the damage, from `DAMAGES` of the protocol."""
    frame: bytes
    wire: bytes


def damaged_by(damages: Damages, frame: bytes) -> SearchStrategy[Damage]:
    """Make damaged variants of a frame."""
    labels = [label for label, damage in damages.items() if any(wire != frame for wire in damage(frame))]
    return st.sampled_from(labels).flatmap(lambda label: _damaged(frame, label, damages[label]))


def _damaged(frame: bytes, label: str, damage: Callable[[bytes], Iterator[bytes]]) -> SearchStrategy[Damage]:
    wires = [wire for wire in damage(frame) if wire != frame]
    return st.sampled_from(wires).map(lambda wire: Damage(label, frame, wire))


def each_byte(damage: Callable[[bytes, bytes, bytes], bytes]) -> Callable[[bytes], Iterator[bytes]]:
    """Return a function that yields a wire for each byte of a frame with `damage` applied to it."""
    return lambda frame: (damage(frame[:at], frame[at : at + 1], frame[at + 1 :]) for at in range(len(frame)))


def flipped_bits(frame: bytes) -> Iterator[bytes]:
    """Yield a wire for each flipped bit."""
    for at, byte in enumerate(frame):
        for bit in range(8):
            yield frame[:at] + bytes((byte ^ 1 << bit,)) + frame[at + 1 :]


@st.composite
def chunkings(draw: st.DrawFn, stream: bytes) -> tuple[bytes, ...]:
    """Make the pieces in which a stream may arrive: one, many, or each of the same size."""
    length = len(stream)
    cuts = draw(
        st.lists(st.integers(0, length), max_size=8).map(sorted)
        | st.integers(1, 64).map(lambda size: list(range(0, length, size)))
    )
    return tuple(stream[start:end] for start, end in zip((0, *cuts), (*cuts, length), strict=True))
