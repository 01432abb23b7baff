"""Logs, streams and capture files -> what is read of them."""

from collections.abc import Iterable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import Model, Protocol, modbus
from i7000.cli.readers import Missing, Read, of_capture, of_lines, of_recording, of_stream
from i7000.dissect import Knowledge, Known
from i7000.recording import Carried, End, Event, Record, Start, text
from tests.dissect.frames import REQUEST, RESPONSE
from tests.dissect.strategies import frames, protocols
from tests.dissect.test_capture import IN, OUT, interface, option, packet, pcap, record, rtac, section

NOTHING = Knowledge()
LONG = modbus.seal(bytes.fromhex("0104200102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f20"))


def log(*lines: str, protocol: Protocol | None = None) -> list[Read]:
    return list(of_lines(enumerate(lines, 1), NOTHING, protocol))


def captured(*blocks: bytes, protocol: Protocol | None = None) -> list[Read]:
    return list(of_capture([section() + interface() + b"".join(blocks)], NOTHING, protocol))


def names(reads: Iterable[Read]) -> list[str | None]:
    return [
        type(read.heard.meanings[0].message).__name__ if read.heard and read.heard.meanings else None for read in reads
    ]


# --- logs -------------------------------------------------------------------------------------------------------------


def test_a_frame_is_read_with_its_line_and_time() -> None:
    (read,) = log("2026-11-30 12:00:01.250 TX $012\r\n")

    assert (read.number, read.line, read.last) == (1, 1, 1)
    assert (read.text, read.time) == ("2026-11-30 12:00:01.250 TX $012", "2026-11-30 12:00:01.250")
    assert names([read]) == ["ReadConfiguration"]
    assert read.understood


def test_a_colon_alone_is_no_time() -> None:
    assert [read.time for read in log("TX: $012", "$012")] == [None, None]


def test_a_line_without_a_frame_is_no_error() -> None:
    (read,) = log("COM3 opened")

    assert (read.heard, read.missing, read.note) == (None, Missing.NOTHING, "no frame in this line")
    assert read.understood


def test_a_frame_that_is_printed_twice_is_read_once() -> None:
    reads = log("recv: 01 04 02 0B 61 7F E8", "Processing: 01 04 02 0B 61 7F E8")

    assert [read.missing for read in reads] == [None, Missing.REPEAT]
    assert reads[1].note == "the same as line 1, printed once more"


def test_a_frame_that_is_cut_over_lines_is_read_once() -> None:
    (read,) = log("01 04 00 00", "00 01 31 CA")

    assert (read.line, read.last, names([read])) == (1, 2, ["ReadInputRegisters"])


@pytest.mark.parametrize(
    ("line", "protocol"), [("RX 24 30 31 32", Protocol.DCON), ("RX 01 04 00 00 00 01 31 CB", Protocol.MODBUS_RTU)]
)
def test_a_damaged_frame_is_of_the_protocol_that_it_looks_like(line: str, protocol: Protocol) -> None:
    (read,) = log(line)

    assert read.heard is not None
    assert read.heard.protocol is protocol


def test_a_log_of_one_protocol_is_read_by_that() -> None:
    (read,) = log("$012", protocol=Protocol.DCON)

    assert names([read]) == ["ReadConfiguration"]


# --- streams ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("protocol", [None, Protocol.DCON])
def test_a_stream_is_read_as_it_arrives(protocol: Protocol | None) -> None:
    arrived: list[str] = []

    def chunks() -> Iterable[bytes]:
        for chunk in (b"$01", b"2\r!010506", b"00\r", b""):
            arrived.append("chunk")
            yield chunk

    found = [(read.text, len(arrived)) for read in of_stream(chunks(), NOTHING, protocol)]

    assert [text for text, _ in found] == ["$012", "!01050600"]
    assert protocol is None or [after for _, after in found] == [2, 3]


def test_a_silence_ends_a_frame_of_modbus() -> None:
    reads = list(of_stream([REQUEST, b"", RESPONSE, b""], NOTHING, None))

    assert names(reads) == ["ReadInputRegisters", "InputRegisters"]
    assert [read.line for read in reads] == [1, 2]
    assert reads[0].text == "01 04 00 00 00 01 31 CA"


def test_the_end_of_a_stream_ends_a_frame_too() -> None:
    (read,) = of_stream([b"$01"], NOTHING, Protocol.DCON)

    assert not read.understood
    assert read.text == "$01"


def test_the_line_feeds_of_a_stream_are_shown_escaped() -> None:
    reads = list(of_stream([b"$012\r\n!010F0600\r\n\r"], NOTHING, None))

    assert [(read.line, read.text) for read in reads] == [
        (1, "$012"), (2, r"\n"), (3, "!010F0600"), (4, r"\n"), (5, r"\r"),
    ]  # fmt: skip


# --- times ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("first", "second", "is_before"),
    [
        ("12:00:05", "12:00:01", True),
        ("12:00:05.250", "12:00:05,249", True),
        ("12:00:05", "12:00:05", False),
        ("9:59:59", "10:00:00", False),
        ("23:59:59", "00:00:01", False),
        ("2026-11-30 12:00:05", "2026-11-30 12:00:01", True),
        ("2026-11-30T23:00:00Z", "2026-11-29T23:30:00Z", True),
        ("2026-11-30 23:59:59", "2026-12-01 00:00:01", False),
        ("12:00:05", "2026-11-30 12:00:01", False),
        ("2026-11-30T12:00:05+01:00", "2026-11-30T11:00:06Z", False),
    ],
)
def test_a_time_before_that_of_the_line_before_is_noted(first: str, second: str, *, is_before: bool) -> None:
    lines = [f"{first} $012", "the port is open", f"{second} !010F0600"]
    *_, last = of_lines(enumerate(lines, 1), NOTHING, None)

    assert last.heard is not None
    assert ("its time is before that of line 1" in last.heard.notes) is is_before
    assert last.understood


def test_a_time_of_a_capture_before_that_of_the_packet_before_is_noted() -> None:
    first, second = captured(packet(REQUEST, OUT), packet(RESPONSE, IN, ticks=1_700_000_000_400_000))

    assert first.heard is not None
    assert second.heard is not None
    assert "its time is before that of packet 1" not in first.heard.notes
    assert "its time is before that of packet 1" in second.heard.notes


# --- capture files ----------------------------------------------------------------------------------------------------


def test_packets_have_times_and_directions() -> None:
    request, response = captured(packet(REQUEST, OUT), packet(RESPONSE, IN))

    assert names([request, response]) == ["ReadInputRegisters", "InputRegisters"]
    assert (request.line, response.line) == (1, 2)
    assert request.time == "2023-11-14T22:13:20.500000+00:00"
    assert response.heard is not None
    assert response.heard.answers == (1, "packet 1")


def test_a_frame_in_several_packets_is_read_once() -> None:
    (read,) = captured(packet(LONG[:10]), packet(LONG[10:20]), packet(LONG[20:]))

    assert names([read]) == ["InputRegisters"]
    assert read.line == 3


def test_a_packet_has_several_frames() -> None:
    assert names(captured(packet(REQUEST + RESPONSE))) == ["ReadInputRegisters", "InputRegisters"]


@pytest.mark.parametrize("second", [packet(LONG[10:], IN), packet(LONG[10:], OUT, ticks=1_700_000_009_000_000)])
def test_packets_of_two_sides_or_far_apart_have_no_frame_in_common(second: bytes) -> None:
    reads = captured(packet(LONG[:10], OUT), second)

    assert len(reads) > 1
    assert not any(read.understood for read in reads)


def test_a_file_that_cannot_be_read_on_is_reported_after_what_was_read() -> None:
    frame, damage = captured(packet(REQUEST), b"\x06\0\0\0")

    assert names([frame]) == ["ReadInputRegisters"]
    assert (damage.missing, damage.line, damage.understood) == (Missing.DAMAGE, 1, False)


def test_a_file_of_nothing_is_reported() -> None:
    (damage,) = of_capture([b"GIF89a"], NOTHING, None)

    assert (damage.line, damage.text, damage.missing) == (0, "byte 4", Missing.DAMAGE)
    assert damage.note == "not a capture file: it begins with 47 49 46 38"


def test_bytes_that_were_not_captured_are_reported() -> None:
    lost, *_ = captured(packet(REQUEST, lost=4))

    assert (lost.note, lost.understood) == ("4 bytes of the packet were not captured", False)


def test_what_the_interface_saw_beside_bytes_is_reported() -> None:
    data = section() + interface(250) + packet(rtac(8, b"\x01"))
    first, *_ = of_capture([data], NOTHING, None)

    assert (first.note, first.understood) == ("parity error", False)


def test_a_time_that_is_no_date_is_given_in_seconds() -> None:
    far = option(14, (1 << 60).to_bytes(8, "little")) + option(0, b"")
    data = section() + interface(options=far) + packet(REQUEST)
    (read,) = of_capture([data], NOTHING, None)

    assert read.time is not None
    assert read.time.endswith(" s")


def test_a_pcap_has_times_and_no_directions() -> None:
    reads = list(of_capture([pcap(record(REQUEST), record(RESPONSE))], NOTHING, Protocol.MODBUS_RTU))

    assert names(reads) == ["ReadInputRegisters", "InputRegisters"]
    assert reads[0].time == "2023-11-14T22:13:20.500000+00:00"


@given(frames, protocols, st.lists(st.sampled_from([None, IN, OUT]), min_size=1, max_size=4))
def test_every_byte_of_a_capture_is_read_once(
    sent: list[bytes], protocol: Protocol | None, sides: list[int | None]
) -> None:
    blocks = [packet(frame, sides[at % len(sides)]) for at, frame in enumerate(sent)]
    reads = captured(*blocks, protocol=protocol)

    assert b"".join(read.heard.wire for read in reads if read.heard) == b"".join(sent)
    assert [read.number for read in reads] == list(range(1, len(reads) + 1))


@given(st.binary(max_size=200))
def test_no_capture_file_makes_it_raise(data: bytes) -> None:
    reads = list(of_capture([section() + interface() + data], Knowledge.given(Known(Model.M_7018)), None))

    assert all(read.heard or read.missing for read in reads)


@pytest.mark.parametrize("frames", [(b"$012\r", b"!010F0600\r", b"#010\r", b">+0025.1\r"), (REQUEST, RESPONSE) * 2])
def test_a_frame_has_the_number_of_its_own_packet(frames: tuple[bytes, ...]) -> None:
    reads = list(of_capture([pcap(*(record(frame) for frame in frames))], NOTHING, None))

    assert [read.line for read in reads] == [1, 2, 3, 4]
    assert [read.heard.answers.where for read in reads if read.heard and read.heard.answers] == ["packet 1", "packet 3"]


# --- recordings -------------------------------------------------------------------------------------------------------

BEGIN = Start("2026-11-30T12:00:00.000000+00:00", "i7000 listen", "1", "COM3")


def recorded(*records: Record | str) -> list[Read]:
    lines = (it if isinstance(it, str) else text(it) for it in records)
    return list(of_recording(enumerate(lines, 1), NOTHING, None))


def test_a_recording_has_dates_and_directions() -> None:
    reads = recorded(
        BEGIN,
        Carried(0.5, b"$012\r", sent=True),
        Carried(0.6, b"!010F", sent=False),
        Event(0.65, "a type changed"),
        Carried(0.7, b"0600\r", sent=False),
        End(0.7),
    )

    assert names(reads) == ["ReadConfiguration", "Configuration"]
    assert [(read.line, read.time) for read in reads] == [
        (2, "2026-11-30T12:00:00.500000+00:00"),
        (5, "2026-11-30T12:00:00.700000+00:00"),
    ]
    assert all(read.understood for read in reads)


def test_a_recording_without_an_end_is_incomplete() -> None:
    *_, last = recorded(BEGIN, Carried(0.5, b"$012\r", sent=True))

    assert (last.missing, last.note) == (Missing.DAMAGE, "the recording has no end: what followed is not in it")
    assert last.text == "line 2"


def test_a_recording_without_a_line_is_incomplete_too() -> None:
    (only,) = recorded()

    assert (only.missing, only.text) == (Missing.DAMAGE, "line 0")


def test_a_line_that_is_no_record_is_reported_and_the_rest_is_read() -> None:
    reads = recorded(BEGIN, Carried(0.5, b"$0", sent=True), '{"record": "bytes"', Carried(0.6, b"$012\r"), End(0.6))

    assert [read.note for read in reads if read.missing] == ["no JSON object"]
    assert names(reads)[-1] == "ReadConfiguration"


@pytest.mark.parametrize("time", ["", "yesterday", "0001-01-01T00:00:00"])
def test_a_recording_without_a_date_has_no_times(time: str) -> None:
    (read,) = recorded(BEGIN._replace(time=time), Carried(0.5, b"$012\r"), End(0.5))

    assert read.time is None
