"""What the CRC notices, and what is found in every stream of Modbus frames and noise."""

from typing import Any

import pytest
from attrs import frozen
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from i7000 import DecodeError, Fault, Noise, Profile, modbus
from i7000.modbus import Side
from i7000.strategies.modbus import DAMAGES, Exchange, chunkings, exchanges, frames, profiles, streams

pytestmark = pytest.mark.no_cover

# --- what the CRC notices, and what it cannot -------------------------------------------------------------------------

SHORT = frames().filter(lambda frame: len(frame) <= 8)
LONGEST = modbus.seal(bytes(range(254)))


def with_flipped(frame: bytes, *bits: int) -> bytes:
    number = int.from_bytes(frame, "little")
    for bit in bits:
        number ^= 1 << bit
    return number.to_bytes(len(frame), "little")


def is_refused(wire: bytes) -> bool:
    try:
        modbus.unseal(wire)
    except DecodeError as error:
        return error.fault is Fault.CRC
    return False


@settings(suppress_health_check=[*settings().suppress_health_check, HealthCheck.filter_too_much])
@given(SHORT)
def test_one_or_two_flipped_bits_of_a_short_frame_are_noticed(frame: bytes) -> None:
    bits = range(8 * len(frame))

    assert [bit for bit in bits if not is_refused(with_flipped(frame, bit))] == []
    assert [
        (bit, other) for bit in bits for other in range(bit) if not is_refused(with_flipped(frame, bit, other))
    ] == []


@given(st.data())
def test_the_crc_of_a_sum_is_the_sum_of_the_crcs(data: st.DataObject) -> None:
    size = data.draw(st.integers(1, modbus.LONGEST_FRAME))
    one, two, three = (data.draw(st.binary(min_size=size, max_size=size)) for _ in range(3))
    total = bytes(a ^ b ^ c for a, b, c in zip(one, two, three, strict=True))

    assert modbus.crc16(one) ^ modbus.crc16(two) ^ modbus.crc16(three) == modbus.crc16(total)


def test_one_or_two_flipped_bits_of_the_longest_frame_are_noticed() -> None:
    # The CRC being a sum, two flips leave it right where each changes it in the same way.
    changes = {modbus.crc16(with_flipped(LONGEST, bit)) for bit in range(8 * len(LONGEST))}

    assert len(LONGEST) == modbus.LONGEST_FRAME
    assert len(changes) == 8 * len(LONGEST)
    assert 0 not in changes


@given(frames(), st.data())
def test_one_or_two_flipped_bits_of_any_frame_are_noticed(frame: bytes, data: st.DataObject) -> None:
    places = st.integers(0, 8 * len(frame) - 1)
    flipped = data.draw(st.sets(places, min_size=1, max_size=2))

    assert is_refused(with_flipped(frame, *flipped))


@given(frames(), st.data())
def test_a_burst_of_up_to_16_bits_is_noticed(frame: bytes, data: st.DataObject) -> None:
    first = data.draw(st.integers(0, 8 * len(frame) - 16))
    burst = data.draw(st.integers(1, 0xFFFF)) << first

    assert is_refused((int.from_bytes(frame, "little") ^ burst).to_bytes(len(frame), "little"))


@given(frames(), st.data())
@example(modbus.seal(b"\x01\x04\x02\x09\xd0"), None)
def test_a_burst_like_the_polynomial_is_not_noticed(frame: bytes, data: st.DataObject | None) -> None:
    first = data.draw(st.integers(0, 8 * len(frame) - 17)) if data else 24
    changed = (int.from_bytes(frame, "little") ^ 0x14003 << first).to_bytes(len(frame), "little")

    assert changed[:-2] == modbus.unseal(changed)


@pytest.mark.parametrize("frame", [bytes.fromhex("010400000008f1cc"), bytes.fromhex("018402c2c1")], ids=bytes.hex)
def test_every_other_crc_is_refused(frame: bytes) -> None:
    right = int.from_bytes(frame[-2:], "little")
    accepted = [crc for crc in range(0x10000) if not is_refused(frame[:-2] + crc.to_bytes(2, "little"))]

    assert accepted == [right]


@given(frames().filter(lambda frame: frame[-1] != frame[-2]))
def test_a_crc_with_its_high_byte_first_is_refused(frame: bytes) -> None:
    assert [is_refused(wire) for wire in DAMAGES["CRC high byte first"](frame)] == [True]


@given(exchanges())
def test_no_flipped_bit_of_a_message_goes_unnoticed(exchange: Exchange) -> None:
    for wire in DAMAGES["flipped bit"](exchange.request_wire):
        with pytest.raises(DecodeError):
            modbus.decode_request(wire, exchange.profile)
    for wire in DAMAGES["flipped bit"](exchange.response_wire):
        with pytest.raises(DecodeError):
            modbus.decode_response(wire, exchange.request, exchange.profile)


@given(st.binary(max_size=300))
def test_a_body_that_is_sealed_is_unsealed_if_it_has_the_length_of_a_frame(body: bytes) -> None:
    frame = modbus.seal(body)

    assert modbus.crc16(frame) == 0
    if modbus.SHORTEST_FRAME <= len(frame) <= modbus.LONGEST_FRAME:
        assert body == modbus.unseal(frame)
        return
    with pytest.raises(DecodeError) as caught:
        modbus.unseal(frame)

    assert caught.value.fault is Fault.LENGTH


# --- streams ----------------------------------------------------------------------------------------------------------

Events = list[bytes | Noise]


@frozen
class Listener:
    """What is known of a stream beforehand."""

    side: Side = Side.BOTH
    profile: Profile | None = None
    request: modbus.Request[Any] | None = None

    def split(self, pieces: tuple[bytes, ...]) -> tuple[Events, bytes]:
        """What is found in a stream that arrives in pieces; each rest is shorter than a frame."""
        found: Events = []
        rest = b""
        for piece in pieces:
            events, rest = modbus.split(rest + piece, self.side, self.profile, request=self.request)
            assert len(rest) < modbus.LONGEST_FRAME
            found += events
        return found, rest

    def flush(self, rest: bytes) -> Events:
        return list(modbus.flush(rest, self.side, self.profile, request=self.request))

    def split_to_the_end(self, pieces: tuple[bytes, ...]) -> Events:
        """What is found in a stream after which the line falls silent."""
        found, rest = self.split(pieces)
        return [*found, *self.flush(rest)]


def runs(events: Events) -> tuple[bytes | Noise, ...]:
    """The events with adjacent noise put together."""
    found: Events = []
    for event in events:
        last = found[-1] if found else None
        if isinstance(event, Noise) and isinstance(last, Noise):
            found[-1] = Noise(last.wire + event.wire, last.fault)
        else:
            found.append(event)
    return tuple(found)


def wires(events: Events) -> bytes:
    return b"".join(event.wire if isinstance(event, Noise) else event for event in events)


def chopped(wires: st.SearchStrategy[bytes]) -> st.SearchStrategy[tuple[bytes, tuple[bytes, ...]]]:
    return wires.flatmap(lambda wire: st.tuples(st.just(wire), chunkings(wire)))


LISTENERS = st.builds(Listener, st.sampled_from(Side), st.none() | profiles()) | exchanges().map(
    lambda exchange: Listener(profile=exchange.profile, request=exchange.request)
)
LIKELY = st.sampled_from((0x00, 0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x08, 0x0F, 0x10, 0x46, 0x83, 0xC6, 0xFF))
MANY_BYTES = st.binary(max_size=1000) | st.lists(
    st.binary(max_size=4) | st.lists(LIKELY, max_size=12).map(bytes) | frames(), max_size=12
).map(b"".join)
"""Bytes of every kind, and such as look like frames, or are."""

each_side = pytest.mark.parametrize("side", Side)


@each_side
@given(data=st.data())
def test_every_frame_of_a_stream_is_found_and_all_noise_is_named(side: Side, data: st.DataObject) -> None:
    stream = data.draw(streams(side))

    assert stream.events == runs(Listener(side, stream.profile).split_to_the_end((stream.wire,)))


@each_side
@given(data=st.data())
def test_however_a_stream_arrives_the_same_is_found(side: Side, data: st.DataObject) -> None:
    stream = data.draw(streams(side))
    pieces = data.draw(chunkings(stream.wire))

    assert stream.events == runs(Listener(side, stream.profile).split_to_the_end(pieces))


@given(chopped(MANY_BYTES), LISTENERS)
def test_no_byte_of_a_stream_is_lost(case: tuple[bytes, tuple[bytes, ...]], listener: Listener) -> None:
    wire, pieces = case

    events, rest = listener.split(pieces)

    assert wire == wires(events) + rest
    assert rest == wires(listener.flush(rest))


@given(chopped(MANY_BYTES), LISTENERS)
def test_any_bytes_are_split_the_same_however_they_arrive(
    case: tuple[bytes, tuple[bytes, ...]], listener: Listener
) -> None:
    wire, pieces = case
    one_by_one = tuple(wire[at : at + 1] for at in range(len(wire)))

    whole, rest = listener.split((wire,))

    for chunks in (pieces, one_by_one):
        events, kept = listener.split(chunks)
        assert rest == kept
        assert runs(whole) == runs(events)


@given(chopped(MANY_BYTES), LISTENERS)
def test_what_is_found_is_a_frame(case: tuple[bytes, tuple[bytes, ...]], listener: Listener) -> None:
    for event in listener.split_to_the_end(case[1]):
        if isinstance(event, bytes):
            assert event[:-2] == modbus.unseal(event)
        else:
            assert event.wire


@given(st.data(), st.sampled_from(Side))
def test_a_frame_without_its_end_is_kept_for_later(data: st.DataObject, side: Side) -> None:
    listener = Listener(side, data.draw(profiles()))
    frame = data.draw(frames(side, listener.profile))
    end = data.draw(st.integers(0, len(frame) - 1))

    assert listener.split((frame[:end],)) == ([], frame[:end])
    assert listener.split_to_the_end((frame[:end], frame[end:])) == [frame]


@given(exchanges(), st.integers(1, 247), st.lists(frames(), max_size=2).map(b"".join))
def test_with_the_open_request_nothing_is_a_frame_but_what_can_answer_it(
    exchange: Exchange, address: int, others: bytes
) -> None:
    request, answer = exchange.request, exchange.response_wire
    listener = Listener(profile=exchange.profile, request=request)
    moved = modbus.seal(bytes((address,)) + answer[1:-2])

    assert listener.split((answer,)) == ([answer], b"")
    for found in listener.split((moved, others, answer))[0]:
        if isinstance(found, bytes):
            assert found[0] == request.address
            assert found[1] & 0x7F == request.function


@given(st.binary(min_size=2, max_size=2), st.integers(1, 247), st.sampled_from((0x03, 0x04)))
def test_of_a_response_and_a_request_that_begin_alike_the_longer_is_found(
    word: bytes, address: int, function: int
) -> None:
    response = modbus.seal(bytes((address, function, 2)) + word)
    request = response + b"\0"  # of which the CRC is good too

    assert request[:-2] == modbus.unseal(request)
    assert Listener().split((request,)) == ([request], b"")
    assert Listener().split_to_the_end((response,)) == [response]
    assert Listener(Side.RESPONSES).split((request,))[0][0] == response


@given(exchanges(), st.binary(max_size=8))
def test_an_echo_is_dropped_and_nothing_else(exchange: Exchange, more: bytes) -> None:
    sent = exchange.request_wire

    assert modbus.drop_echo(sent + more, sent) == more
    assert [modbus.drop_echo(sent[:end], sent) for end in range(len(sent))] == [None] * len(sent)
    for wire in DAMAGES["flipped bit"](sent):
        with pytest.raises(DecodeError) as caught:
            modbus.drop_echo(wire + more, sent)

        assert caught.value.fault is Fault.ECHO
        assert caught.value.wire == wire + more
