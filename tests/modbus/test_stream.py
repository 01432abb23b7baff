"""Frames in what a line delivers: all of them, whatever is around them and however it arrives."""

from collections.abc import Iterable
from typing import Any

import pytest

from i7000 import DecodeError, Fault, Model, Noise, Profile, modbus
from i7000.modbus import LONGEST_FRAME, Side, drop_echo, flush, seal, split
from tests.each import each
from tests.spec.lint import Record, vectors
from tests.vectors import parameters, profile_of


def frames_of_vectors(side: str) -> list[bytes]:
    """Every frame of a side that the vectors have with a model of 8 channels, which no mask makes ambiguous."""
    found = {
        bytes.fromhex(vector[f"{side}_wire"])
        for _, vector in vectors("modbus")
        if vector[side] is not None and len(vector["profile"]["type_codes"]) == 8
        if vector["outcome"] != "reject" or vector["response_wire"] is not None
    }
    return sorted(found)


REQUESTS, RESPONSES = frames_of_vectors("request"), frames_of_vectors("response")
EXCHANGES = [frame for pair in zip(REQUESTS, RESPONSES, strict=False) for frame in pair]
STREAMS = {Side.REQUESTS: REQUESTS, Side.RESPONSES: RESPONSES, Side.BOTH: EXCHANGES}
PROFILE = Profile(Model.M_7017)
NOISE = bytes.fromhex("ff00f884ffc6fe")
"""Bytes that begin no frame, wherever one looks: not even a half one that waits for more."""


def together(events: Iterable[bytes | Noise]) -> list[tuple[str, bytes]]:
    """What was found, adjacent noise put together."""
    found: list[tuple[str, bytes]] = []
    for event in events:
        if isinstance(event, bytes):
            found.append(("frame", event))
        elif found and found[-1][0] == "noise":
            found[-1] = ("noise", found[-1][1] + event.wire)
        else:
            found.append(("noise", event.wire))
    return found


def fed(
    stream: bytes, size: int, side: Side = Side.BOTH, profile: Profile | None = None
) -> tuple[list[tuple[str, bytes]], bytes]:
    """What `split` tells of a stream that arrives in pieces; that nothing is lost and little is kept is asserted."""
    events: list[bytes | Noise] = []
    rest = b""
    for at in range(0, len(stream), size):
        found, rest = split(rest + stream[at : at + size], side, profile)
        events += found
        assert len(rest) < LONGEST_FRAME
    assert stream == b"".join(it if isinstance(it, bytes) else it.wire for it in events) + rest
    return together(events), rest


@pytest.mark.parametrize("size", [1, 2, 3, 7, 64, 255, 256, 257, 1 << 20])
@pytest.mark.parametrize("side", Side)
def test_every_frame_of_the_vectors_is_found_however_it_arrives(side: Side, size: int) -> None:
    frames = STREAMS[side]

    assert ([("frame", frame) for frame in frames], b"") == fed(b"".join(frames), size, side, PROFILE)


@pytest.mark.parametrize("size", [1, 5, 1 << 20])
@pytest.mark.parametrize("side", Side)
def test_every_frame_of_the_vectors_is_found_after_noise(side: Side, size: int) -> None:
    frames = STREAMS[side]

    events, rest = fed(b"".join(NOISE + frame for frame in frames), size, side, PROFILE)

    assert [event for frame in frames for event in (("noise", NOISE), ("frame", frame))] == events
    assert rest == b""


@pytest.mark.parametrize("side", [Side.REQUESTS, Side.RESPONSES])
def test_every_beginning_of_a_frame_waits_for_its_end(side: Side) -> None:
    for frame in STREAMS[side]:
        for cut in range(len(frame)):
            assert ((), frame[:cut]) == split(frame[:cut], side, PROFILE)
            assert (
                b"".join(it if isinstance(it, bytes) else it.wire for it in flush(frame[:cut], side, PROFILE))
                == (frame[:cut])
            )


@pytest.mark.no_cover
@pytest.mark.parametrize("side", Side)
def test_the_neighbours_of_a_damaged_frame_are_found(side: Side) -> None:
    first, last = seal(bytes.fromhex("010600020003")), seal(bytes.fromhex("7b05000cff00"))

    for frame in STREAMS[side]:
        for at in range(len(frame)):
            damaged = frame[:at] + bytes((frame[at] ^ 0x15,)) + frame[at + 1 :]
            events, rest = split(first + damaged + last + NOISE * 40, side, PROFILE)
            assert [it for it in events if isinstance(it, bytes)] == [first, last], damaged.hex()
            assert rest == b""


@pytest.mark.no_cover
@pytest.mark.parametrize("side", Side)
def test_half_a_frame_hides_nothing_of_what_follows(side: Side) -> None:
    whole = seal(bytes.fromhex("ee0600020003"))

    for frame in STREAMS[side]:
        for cut in range(1, len(frame)):
            if whole.startswith(frame[cut:]):
                continue  # the one happens to complete the other
            events, rest = split(frame[:cut] + whole, side, PROFILE)
            events += flush(rest, side, PROFILE)
            assert [it for it in events if isinstance(it, bytes)] == [whole], frame[:cut].hex()


def shown(event: bytes | Noise) -> str:
    return event.hex() if isinstance(event, bytes) else f"{event.fault.value} {event.wire.hex()}"


def sealed(body: str) -> str:
    return seal(bytes.fromhex(body)).hex()


READ, ANSWER, REFUSED = sealed("010400000001"), sealed("0104021234"), sealed("018402")
MASK_8, MASK_16, MASK_24 = sealed("01462501"), sealed("0146250102"), sealed("014625010203")
END = "ff" * 9
"""Bytes that begin no frame, enough of them to end one that only seems to have begun."""
MANY_COILS = sealed("010f000007b0f6" + "ff" * 246)
LONGEST = sealed("0101fb" + "00" * 251)
MANY_WORDS = sealed("0103fa" + "1234" * 125)


@pytest.mark.parametrize(
    ("stream", "side", "events", "rest"),
    [
        ("", Side.BOTH, [], ""),
        ("01", Side.BOTH, [], "01"),
        ("0146", Side.BOTH, [], "0146"),
        ("0184", Side.BOTH, [], "0184"),
        ("01ff03", Side.BOTH, ["function 01ff"], "03"),
        ("014603", Side.BOTH, ["sub_function 01"], "4603"),
        (LONGEST, Side.RESPONSES, [LONGEST], ""),
        (READ + ANSWER + READ + REFUSED, Side.BOTH, [READ, ANSWER, READ, REFUSED], ""),
        (ANSWER + REFUSED, Side.RESPONSES, [ANSWER, REFUSED], ""),
        (REFUSED + END, Side.REQUESTS, [f"function {REFUSED}{END}"], ""),
        (READ + END, Side.RESPONSES, [f"count {READ}{END}"], ""),
        (ANSWER + END, Side.REQUESTS, [f"crc {ANSWER}{END}"], ""),
        (MANY_COILS, Side.REQUESTS, [MANY_COILS], ""),
        (MANY_COILS[:-2], Side.REQUESTS, [], MANY_COILS[:-2]),
        (MANY_WORDS, Side.RESPONSES, [MANY_WORDS], ""),
        (MANY_WORDS[:-2], Side.RESPONSES, [], MANY_WORDS[:-2]),
        ("f8" * 4, Side.BOTH, ["address f8f8f8f8"], ""),
        ("0107" + END, Side.BOTH, [f"function 0107{END}"], ""),
        ("014603" + END, Side.BOTH, [f"sub_function 014603{END}"], ""),
        ("018407" + END, Side.BOTH, [f"crc 018407{END}"], ""),
        ("018400" + END, Side.BOTH, [f"crc 018400{END}"], ""),
        ("0103fc" + END, Side.RESPONSES, [f"count 0103fc{END}"], ""),
        ("010303" + END, Side.RESPONSES, [f"count 010303{END}"], ""),
        ("010300" + END, Side.RESPONSES, [f"count 010300{END}"], ""),
        ("01100000000103" + END, Side.REQUESTS, [f"count 01100000000103{END}"], ""),
        (sealed("000400000001") + END, Side.BOTH, [f"address {sealed('000400000001')}{END}"], ""),
        (sealed("000600020003"), Side.BOTH, [sealed("000600020003")], ""),
        (sealed("000600020003") + END, Side.RESPONSES, [f"address {sealed('000600020003')}{END}"], ""),
        (sealed("001000000001021234"), Side.BOTH, [sealed("001000000001021234")], ""),
        (sealed("001000000001") + END, Side.BOTH, [f"count {sealed('001000000001')}{END}"], ""),
    ],
)
def test_a_stream_is_split_as_it_should_be(stream: str, side: Side, events: list[str], rest: str) -> None:
    found, left = split(bytes.fromhex(stream), side)

    assert (events, rest) == ([shown(event) for event in found], left.hex())


# --- vectors ----------------------------------------------------------------------------------------------------------


def recorded(events: Iterable[bytes | Noise]) -> list[Record]:
    """What was found as the vectors have it: adjacent noise put together, with the first fault."""
    found: list[Record] = []
    for event in events:
        if isinstance(event, bytes):
            found.append({"frame": event.hex()})
        elif found and "noise" in found[-1]:
            found[-1]["noise"] += event.wire.hex()
        else:
            found.append({"noise": event.wire.hex(), "fault": event.fault.value})
    return found


@each("vector", parameters("vectors/frames/rtu_split.json"))
def test_a_stream_is_split_as_the_vector_says_however_it_arrives(vector: Record) -> None:
    stream, side = bytes.fromhex(vector["stream"]), Side(vector["side"])
    profile = None if vector["profile"] is None else profile_of(vector["profile"])

    for size in (len(stream) or 1, 1):
        events: list[bytes | Noise] = []
        rest = b""
        for at in range(0, len(stream), size):
            found, rest = split(rest + stream[at : at + size], side, profile)
            events += found
        assert (vector["events"], vector["rest"]) == (recorded(events), rest.hex())
        assert vector["flushed"] == recorded(flush(rest, side, profile))


# --- masks ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("size", [1, 4, 1 << 20])
@pytest.mark.parametrize("side", [Side.RESPONSES, Side.BOTH])
def test_without_a_profile_the_crc_decides_the_length_of_a_mask(side: Side, size: int) -> None:
    masks = [bytes.fromhex(it) for it in (MASK_24, MASK_8, MASK_16, MASK_24, MASK_16, MASK_8)]

    events, rest = fed(b"".join(masks), size, side)

    assert [("frame", mask) for mask in masks] == [*events, *together(flush(rest, side))]


@pytest.mark.parametrize(
    ("profile", "mask"),
    [
        (Profile(Model.M_7017), MASK_8),
        (Profile(Model.M_7019Z), MASK_16),
        (Profile(Model.M_7018_16), MASK_16),
        (Profile(Model.M_7017Z), MASK_16),
        (Profile(Model.M_7017Z, single_ended=True), MASK_24),
    ],
    ids=lambda value: value.model.value if isinstance(value, Profile) else "",
)
def test_with_a_profile_a_mask_has_the_length_of_its_model(profile: Profile, mask: str) -> None:
    for other in (MASK_8, MASK_16, MASK_24):
        found, rest = split(bytes.fromhex(other) + NOISE * 40, Side.RESPONSES, profile)
        assert (other == mask) == (shown(found[0]) == other)
        assert rest == b""


def test_a_mask_that_is_still_short_of_its_longest_form_waits_for_it() -> None:
    cut = bytes.fromhex(MASK_16)[:-1]

    assert ((), cut) == split(cut, Side.RESPONSES)
    assert (Noise(cut, Fault.CRC),) == flush(cut, Side.RESPONSES)


# --- the end ----------------------------------------------------------------------------------------------------------


def test_a_flush_finds_the_frame_that_a_false_beginning_held_back() -> None:
    begun = "0110000000018020"
    found, rest = split(bytes.fromhex(begun + ANSWER))

    assert ((), begun + ANSWER) == (found, rest.hex())
    assert [f"crc {begun}", ANSWER] == [shown(event) for event in flush(rest)]


def test_a_flush_of_nothing_is_nothing() -> None:
    assert flush(b"") == ()


@pytest.mark.parametrize("junk", ["00", "01", "0104", "0110", "014625", "46", "0103fa", "ff", "0184"])
@pytest.mark.parametrize("side", Side)
def test_less_than_a_frame_is_kept_whatever_comes(junk: str, side: Side) -> None:
    stream = bytes.fromhex(junk) * 2_000

    found, rest = split(stream, side)

    assert len(rest) < LONGEST_FRAME
    assert stream == b"".join(it if isinstance(it, bytes) else it.wire for it in found) + rest


# --- echo -------------------------------------------------------------------------------------------------------------


def test_an_echo_is_taken_off_as_it_comes_in() -> None:
    sent, answer = bytes.fromhex(READ), bytes.fromhex(ANSWER)

    for length in range(len(sent) + 1):
        assert drop_echo(sent[:length], sent) == (None if length < len(sent) else b"")
    for length in range(len(answer) + 1):
        assert answer[:length] == drop_echo(sent + answer[:length], sent)


@pytest.mark.parametrize("at", range(8))
def test_a_wrong_echo_raises_the_place_of_the_difference(at: int) -> None:
    sent = bytes.fromhex(READ)
    received = sent[:at] + bytes((sent[at] ^ 1,)) + sent[at + 1 :]

    with pytest.raises(DecodeError, match=f"echo at byte {at} of .*allowed: {sent.hex(' ')}") as caught:
        drop_echo(received, sent)

    assert (Fault.ECHO, at, received) == (caught.value.fault, caught.value.offset, caught.value.wire)


# --- several lengths --------------------------------------------------------------------------------------------------

LONGER = ["014625013b5d00", "5701010300010000"]
"""Frames whose beginning has a good CRC and the length of another frame."""


@pytest.mark.parametrize("size", [1, 3, 1 << 20])
@pytest.mark.parametrize("frame", [bytes.fromhex(it) for it in LONGER], ids=LONGER)
def test_a_frame_that_begins_like_a_shorter_one_is_whole(frame: bytes, size: int) -> None:
    events, rest = fed(frame + NOISE * 40, size, Side.BOTH)

    assert [("frame", frame), ("noise", NOISE * 40)] == [*events, *together(flush(rest))]


def test_every_mask_is_found_with_its_profile_and_without() -> None:
    profile = Profile(Model.M_7019Z)
    for mask in range(1 << 10):
        frame = modbus.encode(modbus.ChannelMask(0x01, mask), profile)

        assert ((frame,), b"") == split(frame, Side.RESPONSES, profile)
        assert (frame,) == flush(frame, Side.RESPONSES)


@pytest.mark.parametrize("function", [0x11, 0x91])
def test_a_whole_frame_of_an_unknown_function_is_one_at_the_silence(function: int) -> None:
    frame = seal(bytes((0x01, function)))

    assert (frame,) == flush(frame)


# --- the open request -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("request_", "answer", "others"),
    [
        (modbus.ReadInputRegisters(0x01, 0, 2), "01040400010002", ["01040200ff", "02040400010002", "01030400010002"]),
        (modbus.ReadCoils(0x01, 0, 9), "01010201ff", ["010101ff"]),
        (modbus.ReadInputRegisters(0x01, 0, 2), "018402", ["018302", "028402"]),
        (modbus.ReadChannelMask(0x01), "014625ff", ["014629ff"]),
        (modbus.WriteSingleCoil(0x01, 1, True), "01050001ff00", ["01060001ff00"]),
    ],
)
def test_only_what_can_answer_the_open_request_is_a_frame(request_: Any, answer: str, others: list[str]) -> None:
    profile = Profile(Model.M_7017)
    good = seal(bytes.fromhex(answer))

    for other in map(seal, map(bytes.fromhex, others)):
        frames, rest = split(other + good, Side.RESPONSES, profile, request=request_)

        assert (good,) == tuple(it for it in (*frames, *flush(rest, request=request_)) if isinstance(it, bytes))
    assert ((good,), b"") == split(good, Side.RESPONSES, profile, request=request_)
