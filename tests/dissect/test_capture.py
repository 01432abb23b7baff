"""Packets of capture files are read whoever wrote them, and nothing that is given raises."""

import struct
from collections.abc import Iterable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000.dissect.capture import LONGEST_BLOCK, Damage, Packet, is_capture, packets
from tests.dissect.frames import REQUEST, RESPONSE

IN, OUT = 1, 2


def pcap(*records: bytes, link_type: int = 147, order: str = "<", mark: int = 0xA1B2C3D4) -> bytes:
    return struct.pack(f"{order}IHHiIII", mark, 2, 4, 0, 0, 65535, link_type) + b"".join(records)


def record(wire: bytes, order: str = "<", fraction: int = 500_000, original: int | None = None) -> bytes:
    return struct.pack(f"{order}IIII", 1_700_000_000, fraction, len(wire), original or len(wire)) + wire


def block(kind: int, body: bytes, order: str = "<") -> bytes:
    body += b"\0" * (-len(body) % 4)
    length = struct.pack(f"{order}I", len(body) + 12)
    return struct.pack(f"{order}I", kind) + length + body + length


def section(order: str = "<") -> bytes:
    return block(0x0A0D0D0A, struct.pack(f"{order}IHHq", 0x1A2B3C4D, 1, 0, -1), order)


def option(code: int, value: bytes, order: str = "<") -> bytes:
    return struct.pack(f"{order}HH", code, len(value)) + value + b"\0" * (-len(value) % 4)


def interface(link_type: int = 147, order: str = "<", options: bytes = b"", snap_length: int = 0) -> bytes:
    return block(1, struct.pack(f"{order}HHI", link_type, 0, snap_length) + options, order)


def packet(  # noqa: PLR0913 - the fields of the block
    wire: bytes,
    flags: int | None = None,
    order: str = "<",
    *,
    ticks: int = 1_700_000_000_500_000,
    at: int = 0,
    lost: int = 0,
) -> bytes:
    head = struct.pack(f"{order}IIIII", at, ticks >> 32, ticks & 0xFFFFFFFF, len(wire), len(wire) + lost)
    options = b"" if flags is None else option(2, struct.pack(f"{order}I", flags), order) + option(0, b"")
    return block(6, head + wire + b"\0" * (-len(wire) % 4) + options, order)


def rtac(event: int, wire: bytes) -> bytes:
    return struct.pack(">IIBBH", 1_700_000_000, 0, event, 0, 0) + wire


def read(data: bytes) -> list[Packet | Damage]:
    return list(packets([data]))


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize(("mark", "fraction"), [(0xA1B2C3D4, 500_000), (0xA1B23C4D, 500_000_000)])
def test_a_pcap_file_is_read_in_both_byte_orders_and_resolutions(order: str, mark: int, fraction: int) -> None:
    data = pcap(record(REQUEST, order, fraction), record(RESPONSE, order, fraction), order=order, mark=mark)

    assert read(data) == [
        Packet(1, 1_700_000_000.5, None, REQUEST),
        Packet(2, 1_700_000_000.5, None, RESPONSE),
    ]


@pytest.mark.parametrize("order", ["<", ">"])
def test_a_pcapng_file_is_read_with_its_directions(order: str) -> None:
    blocks = (
        packet(REQUEST, OUT, order),
        packet(RESPONSE, IN, order),
        packet(REQUEST, 0, order),
        packet(REQUEST, None, order),
    )

    found = read(section(order) + interface(148, order) + b"".join(blocks))

    assert [(it.outbound, it.wire) for it in found if isinstance(it, Packet)] == [
        (True, REQUEST),
        (False, RESPONSE),
        (None, REQUEST),
        (None, REQUEST),
    ]


@pytest.mark.parametrize(
    ("options", "ticks"),
    [
        (b"", 1_700_000_000_500_000),
        (option(9, b"\x09"), 1_700_000_000_500_000_000),
        (option(9, b"\x81"), 3_400_000_001),
        (option(14, struct.pack("<q", 1_000_000_000)) + option(0, b""), 700_000_000_500_000),
    ],
)
def test_times_have_the_resolution_and_offset_of_the_interface(options: bytes, ticks: int) -> None:
    (found,) = read(section() + interface(options=options) + packet(REQUEST, ticks=ticks))

    assert found == Packet(1, 1_700_000_000.5, None, REQUEST)


def test_a_second_section_has_a_byte_order_and_interfaces_of_its_own() -> None:
    data = section() + interface() + packet(REQUEST) + section(">") + interface(order=">") + packet(RESPONSE, order=">")

    assert [it.wire for it in read(data) if isinstance(it, Packet)] == [REQUEST, RESPONSE]


def test_blocks_of_other_kinds_are_passed_over() -> None:
    data = section() + block(4, b"names") + interface() + block(5, b"statistics") + packet(REQUEST)

    assert [type(it) for it in read(data)] == [Packet]


def test_a_simple_packet_has_neither_time_nor_direction() -> None:
    data = section() + interface(snap_length=6) + block(3, struct.pack("<I", len(REQUEST)) + REQUEST[:6])

    assert read(data) == [Packet(1, None, None, REQUEST[:6], 2)]


def test_bytes_that_the_snap_length_cut_off_are_counted() -> None:
    assert read(pcap(record(REQUEST[:6], original=8))) == [Packet(1, 1_700_000_000.5, None, REQUEST[:6], 2)]
    assert read(section() + interface() + packet(REQUEST[:6], lost=2))[0] == Packet(
        1, 1_700_000_000.5, None, REQUEST[:6], 2
    )


def test_the_header_of_an_rtac_says_the_direction_and_what_was_wrong() -> None:
    events = [rtac(1, REQUEST), rtac(4, RESPONSE), rtac(0, b""), rtac(8, b""), rtac(2, b""), b"\0" * 11]

    found = read(pcap(*map(record, events), link_type=250))

    assert found == [
        Packet(1, 1_700_000_000.5, True, REQUEST),
        Packet(2, 1_700_000_000.5, False, RESPONSE),
        Packet(4, 1_700_000_000.5, None, b"", note="parity error"),
        Damage(found[-1].offset, "packet 6 is too short for an RTAC header: 11 bytes"),  # type: ignore[union-attr]
    ]


def test_packets_of_another_link_type_are_passed_over_with_one_damage() -> None:
    first, second = read(
        section() + interface(1) + packet(REQUEST) + packet(REQUEST) + interface() + packet(RESPONSE, at=1)
    )

    assert isinstance(first, Damage)
    assert first.reason == "link type 1 is not that of a serial line; allowed: 147, 148, 250"
    assert second == Packet(3, 1_700_000_000.5, None, RESPONSE)


WHOLE = section() + interface()


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"", "not a capture file: it begins with nothing"),
        (pcap()[:20], "the file ends in its header: 16 of 20 bytes"),
        (pcap(link_type=1), "link type 1 is not that of a serial line; allowed: 147, 148, 250"),
        (pcap(record(REQUEST))[:30], "the file ends in the header of packet 1"),
        (pcap(record(REQUEST))[:-1], "the file ends in packet 1: 7 of 8 bytes"),
        (pcap(struct.pack("<IIII", 0, 0, 0xFFFFFFFF, 0)), f"a block of 4294967295 bytes; allowed: {LONGEST_BLOCK}"),
        (section()[:6], "the file ends in the head of a block: 2 of 4 bytes"),
        (section()[:10], "the file ends in the head of a section: 2 of 4 bytes"),
        (section()[:8] + b"\0" * 20, "a section without byte order: 00 00 00 00"),
        (section()[:-4] + b"\0" * 4, "a block does not end with the length that it begins with"),
        (WHOLE + b"\x06\0", "the file ends in the head of a block"),
        (WHOLE + struct.pack("<II", 6, 13), "a block cannot have 13 bytes"),
        (WHOLE + packet(REQUEST)[:-6], "the file ends in a block: 26 of 32 bytes"),
        (WHOLE + packet(REQUEST, at=1), "packet 1 is of interface 1, which the file does not describe"),
        (WHOLE + block(6, b"\0" * 8), "the block of packet 1 is too short: 8 bytes"),
        (WHOLE + block(6, struct.pack("<IIIII", 0, 0, 0, 9, 9)), "packet 1 has 9 bytes in a block of 20"),
        (section() + interface() * 257, "more than 256 interfaces"),
    ],
)
def test_a_damaged_file_ends_with_what_is_wrong(data: bytes, reason: str) -> None:
    damage = read(data)[-1]

    assert isinstance(damage, Damage)
    assert damage.reason == reason


def test_packets_before_the_damage_are_read() -> None:
    found, damage = read(pcap(record(REQUEST), record(RESPONSE)[:-1]))

    assert (found, type(damage)) == (Packet(1, 1_700_000_000.5, None, REQUEST), Damage)


@pytest.mark.parametrize(
    ("beginning", "expected"), [(pcap()[:4], True), (section()[:4], True), (b"TX: ", False), (b"\xa1\xb2", False)]
)
def test_a_capture_file_is_known_by_its_first_bytes(beginning: bytes, *, expected: bool) -> None:
    assert is_capture(beginning) is expected


FILES = (
    pcap(record(REQUEST), record(RESPONSE)),
    section() + interface(options=option(9, b"\x09")) + packet(REQUEST, OUT) + packet(RESPONSE, IN),
    pcap(record(rtac(1, REQUEST)), link_type=250),
)


@given(st.sampled_from(FILES), st.lists(st.integers(0, 200), max_size=5))
def test_a_file_is_read_alike_however_it_arrives(data: bytes, cuts: list[int]) -> None:
    ends = [*sorted(cuts), len(data)]
    chunks = [data[start:end] for start, end in zip([0, *ends], ends, strict=False)]

    assert list(packets(chunks)) == read(data)


@given(
    st.sampled_from(FILES),
    st.lists(st.tuples(st.integers(0, 255), st.integers(0, 255)), max_size=4),
    st.integers(0, 300),
)
def test_no_damage_raises(data: bytes, changes: Iterable[tuple[int, int]], length: int) -> None:
    changed = bytearray(data)
    for at, value in changes:
        changed[at % len(data)] = value

    assert all(isinstance(it, Packet | Damage) for it in read(bytes(changed[:length])))


@given(st.binary(max_size=200), st.sampled_from((b"", section()[:4], section(), WHOLE, pcap())))
def test_no_bytes_raise(data: bytes, start: bytes) -> None:
    assert all(isinstance(it, Packet | Damage) for it in read(start + data))
