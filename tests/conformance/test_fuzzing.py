"""Near misses of reads, and the search for the fewest frames."""

from random import Random

import pytest

from i7000 import Model, Profile, Protocol
from i7000.conformance import DEFAULT_ALLOWED, hazards_of
from i7000.conformance.fuzzing import fewest, near_miss, reads, sentinel
from tests.each import each


def search(frames: tuple[bytes, ...], needed: tuple[bytes, ...], most: int = 1000) -> tuple[tuple[bytes, ...], int]:
    """The result for a module that fails after frames that begin like `needed`, in this order."""
    trying = fewest(frames, most)
    try:
        tried = next(trying)
        while True:
            rest = iter(tried)
            tried = trying.send(all(any(wire.startswith(start) for wire in rest) for start in needed))
    except StopIteration as end:
        result: tuple[tuple[bytes, ...], int] = end.value
        return result


@pytest.mark.parametrize("needed", [(b"7",), (b"0", b"19"), (b"3", b"4", b"5")])
def test_the_fewest_frames_and_bytes_remain(needed: tuple[bytes, ...]) -> None:
    frames = tuple(b"%d-rest of the frame" % number for number in range(20))

    found, tries = search(frames, needed)

    assert [wire[: len(start)] for wire, start in zip(found, needed, strict=True)] == list(needed)
    assert sum(map(len, found)) < 5 * len(needed)
    assert 0 < tries < 200


def test_the_search_ends_after_its_tries() -> None:
    frames = tuple(b"%02d" % number for number in range(20))

    found, tries = search(frames, (b"07",), 3)

    assert tries == 3
    assert b"07" in found
    assert search(frames, (b"07",), 0) == (frames, 0)


def test_a_single_frame_is_only_shortened() -> None:
    assert search((b"#01XXXXXXXX",), (b"#01X",))[0][0].startswith(b"#01X")
    assert search((b"#",), (b"#",)) == ((b"#",), 0)


@each("model", Model)
def test_the_reads_of_a_module_are_allowed(model: Model) -> None:
    for protocol in model.protocols:
        frames = reads(Profile(model, type_codes=()), protocol, 0x01)

        assert len(frames) > 9
        assert all(hazards_of(wire) <= DEFAULT_ALLOWED for wire in frames)


@each("protocol", Protocol)
def test_near_misses_are_many_and_repeat_for_a_seed(protocol: Protocol) -> None:
    frames = reads(Profile(Model.M_7019R), protocol, 0x01)
    chances = [Random(seed).randrange for seed in (1, 1, 2)]

    first, second, third = ([near_miss(frames, protocol, chance) for _ in range(400)] for chance in chances)

    assert first == second != third
    assert len(set(first)) > 300
    assert all(1 <= len(wire) <= 300 for wire in first)
    assert {*first} - {*frames}


@each("protocol", Protocol)
def test_the_sentinel_only_reads(protocol: Protocol) -> None:
    assert type(sentinel(protocol, 0x01)).__name__ in ("ReadConfiguration", "ReadCommunicationSettings")
