"""The guard, reading by reading: what is dangerous to a lenient firmware, and what must not be refused."""

from collections.abc import Iterator
from random import Random
from typing import Any

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from i7000 import (
    ArgumentError,
    BaudRate,
    CharacterFormat,
    InvalidValueError,
    LineSettings,
    Model,
    Profile,
    dcon,
    modbus,
)
from i7000.conformance import DEFAULT_ALLOWED, LONGEST_WRITE, Guard, GuardError, Hazard, allowing, hazards_of
from i7000.conformance.guard_rtu import begins_nothing, hazards_at, hazards_of_modules, hazards_with_crc
from i7000.conformance.hazard import hazard_of
from i7000.modbus.registers import Access, Area, rows
from tests.conformance.acting import LINES
from tests.conformance.near_misses import SLOW_COMMANDS, half_as_fast, sealed
from tests.each import each
from tests.vectors import dcon_vectors, message_of, modbus_vectors, profile_of

LINE = LineSettings()
CLASSES = {
    "observe": b"",
    "memory": b"$014\r $014F\r",
    "broadcast": b"#** #**\r ~**\r ~**62\r $**2\r",
    "write": (
        b"$015\r $0153A\r $0153A14\r $017C0R08\r $017\r $019+0010\r $0191\r $01A1\r $01A107\r"
        b" $01AC6F\r ~01C1\r ~01C7X\r ~01EO1\r"
        b" ~01C2F\r ~01CA\r ~01C\x0022\r"
        b" ~01EO1A\r @01S1\r @01S14\r ~01ONAME\r ~01O ~011\r"
    ),
    "comm": (
        b"%0102080600\r %0102 %01\r ~01T10\r ~01T ~01I\r $01P1\r $01P106\r $01P0 $01PX\r $01PXY\r $FFP00\r ~013100\r"
        b" ~013 xx%0102080600\r $01%0102080600\r %01020806\r"
    ),
    "calibration": (
        b"$010\r $010 $01000\r $0100C4\r $011\r $010C0\r $011C9\r $01S0\r $01S1\r $01S ~01E1\r ~01E0 ~01E\r ~01E1F5\r"
        b" $0\x7f10\r $01$010\r #01$010\r !01$010 $012\r$010\r ~01EX\r ~01EE\r"
    ),
}  # fmt: skip


def texts() -> Iterator[Any]:
    for name, wires in CLASSES.items():
        for wire in filter(None, wires.split(b" ")):
            yield pytest.param(wire, Hazard(name), id=f"{name} {wire!r}")


@each(("wire", "hazard"), texts())
def test_text_has_its_hazard_however_it_is_written(wire: bytes, hazard: Hazard) -> None:
    spellings = (
        wire,
        wire.lower(),
        bytes(byte | 0x80 for byte in wire),
        b"\xff\x00" + wire,
        b"".join(wire[at : at + 1] + b"\x00 \n" for at in range(len(wire))) if hazard is Hazard.CALIBRATION else wire,
    )

    for spelling in spellings:
        assert hazard in hazards_of(spelling), spelling


@each("wire", [
    b"", b"\r", b"$", b"$01", b"$01\r", b"#01\r", b"#010\r", b"#0135\r", b"$012\r", b"$012B7\r", b"$012b7\r",
    b"$01200\r", b"$01P", b"$01P\r", b"$01PD5\r", b"$01PE9\r", b"$01PD", b"$019BE\r", b"$01AC6\r", b"~01C",
    b"~01C22\r", b"~01E", b"~01EO\r", b"~01EO73\r", b"@01S\r", b"@01SF4\r", b"@A0S04\r", b"~010\r", b"~012\r",
    b"$018C0\r", b"$01F\r", b"$01M\r", b"$01Z\r", b"~01Z9\r", b"@01Z\r", b"&0100\r", b"!0106\r", b"$0G0\r",
    b"$01P$012\r", b"~01E$012\r", b"$F02\r", b"#F0CC\r",
])  # fmt: skip
def test_what_only_reads_is_harmless(wire: bytes) -> None:
    assert hazards_of(wire) == {Hazard.OBSERVE}


LONGEST = f"01 17 0000 0001 01E9 007F FF {'00' * 255}"
REQUESTS = (
    ("observe", "01 04 0000 0008"), ("observe", "01 46 00"), ("observe", "01 46 29"), ("observe", "01 07"),
    ("observe", "01 46 99"), ("observe", "01 08 0000 1234"), ("observe", "01 2B 0E 01 00"),
    ("observe", "00 64 0000 0001"),
    ("memory", "01 01 0110 0001"), ("memory", "01 01 0000 07D0"), ("memory", "01 01 FFFF 0800"),
    ("broadcast", "00 04 0000 0008"), ("broadcast", "00 46 00"), ("broadcast", "00 06 01E9 0001"),
    ("write", "01 05 0102 FF00"), ("write", "01 05 9999 0000"), ("write", "01 06 01E9 0001"),
    ("write", "01 85 0102 FF00"),
    ("write", "01 0F 0102 0001 01 01"), ("comm", "01 0F 00F7 0001 03 010101"),
    ("write", "01 10 01E9 0001 02 0001"), ("write", "01 10 01E6 0001 02 0001"), ("write", "01 46 08 00 06 0E"),
    ("write", "01 46 26 FF"), ("write", "01 46 26 00FF"), ("write", "01 46 30 01"), ("write", "01 C6 30 01"),
    ("write", "01 15 07 06 0001 0000 0001"), ("write", "01 16 01E9 00FF 0001"),
    ("write", "01 17 0000 0001 01E9 0001 02 0001"),
    ("comm", "01 06 01E4 0002"), ("comm", "01 05 0100 0000"), ("comm", "01 05 0104 FF00"),
    ("comm", "01 0F 00F0 0011 03 000000"), ("comm", "01 10 01E0 0005 0A 0001 0001 0001 0001 0001"),
    ("comm", "01 10 01E0 0001 0A 0001 0001 0001 0001 0001"), ("comm", "01 10 FFFF 0300 02 0001"),
    ("comm", "01 46 04 02 0000 00"), ("comm", "01 46 06 00 06 00 00 00 00 00"), ("comm", "01 08 0001 0000"),
    ("comm", "01 16 01E4 00FF 0001"), ("comm", "01 17 0000 0001 01E4 0001 02 0001"),
    ("comm", "01 46 06 00 06 00 00 00 00 00 00"), ("comm", "01 08 0100 0000"),
    ("write", "01 0F 0000 0050 0A 00000000000000000000"), ("write", "01 15 0E 06 0001 0000 0001 0000 0000 000000"),
    ("comm", "01 0F 00F0 0001 03 000000"), ("observe", "01 01 0111 0001"), ("write", "01 46 26 0000FF"),
    ("write", LONGEST),
    ("calibration", "01 05 010F FF00"), ("calibration", "01 0F 0108 0010 02 FFFF"), ("calibration", "00 05 010F FF00"),
)  # fmt: skip


@each(("name", "body"), [pytest.param(name, bytes.fromhex(text), id=text) for name, text in REQUESTS])
def test_a_request_has_its_hazard_with_the_right_crc_wherever_it_begins(name: str, body: bytes) -> None:
    wire = sealed(body)

    assert Hazard(name) in hazards_of(wire) <= allowing([*Hazard]) - _above(name)
    for around in (b"\x02" + wire, b"$01M\r" + wire, sealed(b"\x01\x04\x00\x00\x00\x08") + wire, b"\x63" * 200 + wire):
        assert Hazard(name) in hazards_of(around) or body[1] & 0x7F not in KNOWN


KNOWN = {1, 2, 3, 4, 5, 6, 8, 0x0F, 0x10, 0x15, 0x16, 0x17, 0x46}


def _above(name: str) -> frozenset[Hazard]:
    order = list(Hazard)
    return frozenset(order[order.index(Hazard(name)) + 1 :]) - ({Hazard.WRITE} if name == "broadcast" else set())


CHANGING = ("write", "comm", "calibration")


@each(("name", "body"), [pytest.param(it, bytes.fromhex(text), id=text) for it, text in REQUESTS if it in CHANGING])
def test_a_request_that_changes_something_is_dangerous_with_a_wrong_crc_and_without_one(name: str, body: bytes) -> None:
    for wire in (body, body + b"\x00", body + b"\x12\x34", sealed(body)[:-1], body + b"\x12\x34\x56"):
        assert Hazard(name) in hazards_of(wire)


def test_a_broadcast_that_changes_something_is_one_with_a_wrong_crc_and_without_one() -> None:
    write, read = bytes.fromhex("00 06 01E9 0001"), bytes.fromhex("00 04 0000 0008")

    for rest in (b"", b"\x00", b"\x12\x34"):
        assert hazards_of(write + rest) == {Hazard.OBSERVE, Hazard.WRITE, Hazard.BROADCAST}
        assert hazards_of(read + rest) == {Hazard.OBSERVE}


OF_MODULES = {0x01, 0x05, 0x06, 0x0F, 0x10, 0x46}
TOO_SHORT = "01 46 06 00 06 00 00 00 00 00"
WHOLE = [
    pytest.param(name, bytes.fromhex(text), id=text) for name, text in REQUESTS
    if name != "observe" and text != TOO_SHORT
]  # fmt: skip


@each(("name", "body"), WHOLE)
def test_a_request_that_is_sent_in_pieces_is_found_by_its_right_crc(name: str, body: bytes) -> None:
    for before in (b"", b"\x63" * 200):
        wire = before + sealed(body)
        for new in range(len(before) + 1, len(wire)):
            assert Hazard(name) in hazards_with_crc(wire, new)
            if body[1] in OF_MODULES:
                assert Hazard(name) in hazards_of_modules(wire, new)

        assert hazards_with_crc(wire, len(wire)) == hazards_of_modules(wire, len(wire)) == {Hazard.OBSERVE}


@each(("name", "body"), [it for it in WHOLE if it.id != LONGEST])
def test_a_request_of_another_length_is_found_by_its_right_crc_if_silence_can_end_it(name: str, body: bytes) -> None:
    for extra in (1, 2, 5):
        wire = b"\x02" + sealed(body + bytes(extra))

        assert Hazard(name) in hazards_with_crc(wire, 0) & hazards_with_crc(wire, 1)


KNOWN_AT = {0x05: 4, 0x06: 4, 0x08: 4, 0x0F: 4, 0x10: 4, 0x15: 3, 0x16: 4, 0x17: 8, 0x46: 3}
"""The bytes from which on a request is dangerous: its function code or its first address."""
SHORTEST = {0x05: 6, 0x06: 6, 0x08: 6, 0x0F: 8, 0x10: 9, 0x15: 10, 0x16: 8, 0x17: 13}


BODIES = [bytes.fromhex(text) for name, text in REQUESTS if name in CHANGING]


@each("body", BODIES)
def test_a_request_is_dangerous_from_its_first_address_on(body: bytes) -> None:
    known = KNOWN_AT[body[1] & 0x7F]

    assert hazards_at(body[: known - 1], whole_body=False) == {Hazard.OBSERVE}
    assert hazards_at(body[:known], whole_body=False) != {Hazard.OBSERVE}


@each("body", [it for it in BODIES if len(it) == SHORTEST.get(it[1] & 0x7F)])
def test_a_request_after_other_bytes_is_dangerous_once_it_is_complete(body: bytes) -> None:
    assert hazards_at(body[:-1], whole_body=True) == {Hazard.OBSERVE}
    assert hazards_at(body, whole_body=True) != {Hazard.OBSERVE}


def test_only_a_known_function_code_begins_a_request() -> None:
    assert begins_nothing(b"\x01\x63")
    assert not any(map(begins_nothing, (b"", b"\x63", b"\x01\x06", b"\x01\x86")))


def test_an_unfinished_request_after_a_long_write_is_remembered() -> None:
    guard = Guard(frozenset(Hazard)).sending(b"\x63" * 300, LINE).sending(b"\x01", LINE)

    assert Hazard.WRITE in guard.hazards_of(b"\x06\x01\xe9\x00\x01", LINE)


def test_the_last_byte_of_the_longest_request_is_dangerous_after_all_others() -> None:
    wire = sealed(b"\x01\x10\x01\xe9\x00\x7b\xf7" + bytes(247))
    guard = Guard(frozenset(Hazard)).sending(b"\x63" + wire[:-1], LINE)

    assert len(wire) == 256
    assert Hazard.WRITE in guard.hazards_of(wire[-1:], LINE)


def test_what_is_too_short_for_an_address_is_no_request_with_the_right_crc() -> None:
    assert hazards_with_crc(sealed(b"\x01\x06"), 0) == {Hazard.OBSERVE}


def test_text_in_the_data_of_a_request_is_heard() -> None:
    wire = sealed(b"\x01\x10\x01\xe9\x00\x02\x04$010")

    assert Hazard.CALIBRATION in hazards_of(wire)


@each("before", [b"$", b"$0", b"$01"])
def test_unfinished_text_is_remembered(before: bytes) -> None:
    guard = Guard().sending(before, LINE)

    with pytest.raises(GuardError) as refused:
        guard.sending(b"$010\r"[len(before) :], LINE)
    assert refused.value.hazards == {Hazard.CALIBRATION}
    assert refused.value.before == before
    assert "calibration" in str(refused.value)


def test_what_is_on_the_line_is_named_only_if_it_is_part_of_the_reason() -> None:
    guard = Guard().sending(b"$012\r", LINE).sending(b"$01", LINE)
    refused = {}
    for wire in (b"0\r", b"\r$010\r"):
        with pytest.raises(GuardError) as error:
            guard.sending(wire, LINE)
        refused[wire] = error.value.before

    assert refused == {b"0\r": b"$012\r$01", b"\r$010\r": b""}


def test_unfinished_text_outlives_a_silence_and_ends_with_its_carriage_return() -> None:
    guard = Guard().sending(b"$01", LINE)

    assert Hazard.CALIBRATION in guard.after_silence().hazards_of(b"0\r", LINE)
    assert guard.sending(b"\r", LINE).hazards_of(b"0\r", LINE) == {Hazard.OBSERVE}


@each("cut", range(1, 8))
def test_an_unfinished_request_is_remembered_until_the_line_is_silent(cut: int) -> None:
    wire = sealed(bytes.fromhex("01 46 2A A0"))[:6]
    guard, rest = Guard(allowing([Hazard.WRITE])), wire[cut:]
    guard = guard.sending(wire[:cut], LINE)

    assert (Hazard.WRITE in guard.hazards_of(rest, LINE)) is (cut < len(wire))
    assert guard.after_silence().hazards_of(rest, LINE) <= DEFAULT_ALLOWED


def test_a_request_sent_byte_by_byte_is_refused_before_it_is_complete() -> None:
    guard = Guard()
    for byte in bytes.fromhex("01 06 01E4 00"):
        guard = guard.sending(bytes((byte,)), LINE)

    with pytest.raises(GuardError):
        guard.sending(b"\x02", LINE)


@each("wire", [b"$012\r", b"$01PD5\r", b"~01EO73\r", sealed(b"\x01\x04\x00\x00\x00\x06"), sealed(b"\x01\x46\x25")])
def test_what_only_reads_may_be_sent_byte_by_byte(wire: bytes) -> None:
    guard = Guard()
    for byte in wire * 3:
        guard = guard.sending(bytes((byte,)), LINE)

    assert guard.allowed == DEFAULT_ALLOWED


def test_a_frame_that_ends_a_write_ends_what_began_before_it() -> None:
    read = sealed(b"\x17\x04\x00\x00\x00\x01")
    guard = Guard().sending(b"\x01", LINE)

    assert guard.sending(read, LINE).hazards_of(bytes(6), LINE) == {Hazard.OBSERVE}
    assert Hazard.WRITE in guard.sending(read[:-1] + b"\x00", LINE).hazards_of(bytes(6), LINE)


@each("wire", SLOW_COMMANDS)
def test_what_modules_at_another_baud_rate_hear_is_found(wire: bytes) -> None:
    fast, slow = LineSettings(BaudRate.BAUD_19200), LineSettings(BaudRate.BAUD_9600)
    sent = half_as_fast(Random(len(wire)), wire)

    with pytest.raises(GuardError) as refused:
        Guard().sending(sent, fast)
    assert refused.value.line == slow
    assert "9600 baud N81" in str(refused.value)
    half = len(sent) // 2 // 2 * 2
    assert refused.value.hazards <= Guard().sending(sent[:half], fast).hazards_of(sent[half:], fast)


def test_a_request_that_modules_at_another_baud_rate_hear_is_found_in_one_piece_and_in_two() -> None:
    fast, slow = LineSettings(BaudRate.BAUD_19200), LineSettings(BaudRate.BAUD_9600)
    bodies = (bytes((8, 0x0F, 8, 8, 8, 8, 8, *(8,) * 7, last)) for last in range(0x100))
    wire = next(wire for wire in map(sealed, bodies) if all(byte & 8 for byte in wire))
    sent = half_as_fast(Random(1), wire)
    half = len(sent) // 4 * 2

    with pytest.raises(GuardError) as refused:
        Guard().sending(sent, fast)
    assert (refused.value.line, set(refused.value.hazards)) == (slow, {Hazard.WRITE})
    assert Hazard.WRITE in Guard().sending(sent[:half], fast).hazards_of(sent[half:], fast)


def test_a_request_that_modules_with_another_parity_hear_is_found() -> None:
    body = next(
        body for mask in range(0x100) for address in range(1, 0xF8)
        if (body := sealed(bytes((address, 0x46, 0x26, mask)))) and all(byte.bit_count() & 1 for byte in body)
    )  # fmt: skip
    guard = Guard(allowing([Hazard.WRITE]))

    guard = guard.sending(body[:3], LineSettings(character_format=CharacterFormat.E81))
    assert Hazard.WRITE in guard.hazards_of(body[3:], LineSettings(character_format=CharacterFormat.E81))


def test_a_mode_without_permission_is_refused_with_the_option_that_permits_it() -> None:
    with pytest.raises(
        GuardError, match=r"^#\*\*\\r was not sent: it goes to every module of the line \(--allow broadcast\)$"
    ):
        Guard().sending(b"#**\r", LINE)
    with pytest.raises(GuardError, match=r"\(--allow write --allow comm\)$"):
        Guard().sending(bytes.fromhex("0110 01E0 0005"), LINE)


@given(st.binary(max_size=40), st.sampled_from(LINES), st.frozensets(st.sampled_from(Hazard)))
def test_bytes_go_out_only_if_all_their_hazards_are_allowed(
    wire: bytes, line: LineSettings, hazards: frozenset[Hazard]
) -> None:
    guard = Guard(hazards)
    found = hazards_of(wire, line)
    if found <= hazards | {Hazard.OBSERVE}:
        after, judged = guard.judged(wire, line)

        assert (after.allowed, judged) == (hazards, found)
    else:
        with pytest.raises(GuardError) as refused:
            guard.sending(wire, line)
        assert refused.value.hazards <= found - hazards


@given(st.lists(st.binary(max_size=300), max_size=4), st.sampled_from(LINES))
def test_what_is_remembered_is_bounded(wires: list[bytes], line: LineSettings) -> None:
    guard = Guard(frozenset(Hazard))
    for wire in wires:
        guard = guard.sending(wire, line)

    assert all(len(rest.text) <= 255 and len(rest.frame) <= 255 for rest in guard.rests)
    assert all(0 <= start < 256 for rest in guard.rests for start in rest.starts)


@pytest.mark.parametrize("dropped", [b" ", b"\0", b"\x7f", b"\xa0"])
def test_characters_that_a_firmware_drops_do_not_push_out_what_is_unfinished(dropped: bytes) -> None:
    guard = Guard().sending(b"~01" + 300 * dropped, LineSettings())

    with pytest.raises(GuardError, match="changes a setting"):
        guard.sending(b"O7018\r", LineSettings())


def test_arguments_are_checked() -> None:
    wrong: Any = {"write"}
    with pytest.raises(InvalidValueError, match="allowed"):
        Guard(wrong)
    with pytest.raises(InvalidValueError, match="allowed"):
        Guard(frozenset(wrong))
    with pytest.raises(ArgumentError):
        hazards_of("$012\r")  # type: ignore[arg-type]
    with pytest.raises(ArgumentError):
        hazards_of(b"$012\r", 9600)  # type: ignore[arg-type]
    with pytest.raises(InvalidValueError, match="4096"):
        hazards_of(bytes(LONGEST_WRITE + 1))
    with pytest.raises(InvalidValueError, match="baud_rate"):
        hazards_of(b"$012\r", LineSettings(0x3F))


# --- what must not be refused -----------------------------------------------------------------------------------------

ADDRESSES = range(0x100)


def reading_commands() -> set[tuple[Any, bool]]:
    """Each command that reads, of every model: its class, its fields, and whether the channel has two digits."""
    found = set()
    for vector in (it.values[0] for it in dcon_vectors("response", "refused")):
        message = message_of(vector["command"])
        if hazard_of(type(message)) in DEFAULT_ALLOWED:
            found.add((message, profile_of(vector["profile"]).single_ended))
    return found


def test_no_command_that_reads_is_refused_but_one() -> None:
    refused = set()
    for message, single_ended in reading_commands():
        for checksum in (False, True):
            profile = Profile(
                Model.M_7017Z if single_ended else Model.M_7019R, single_ended=single_ended, checksum=checksum
            )
            for address in ADDRESSES:
                wire = dcon.encode(evolve(message, address=address), profile, force=True)
                if not hazards_of(wire) <= DEFAULT_ALLOWED:
                    refused.add(wire)

    assert refused == {b"$FFP00\r"}, "its checksum begins with a protocol"


def reading_requests() -> set[Any]:
    """A read of every row of every map, and of every setting that function 46h reads, at address 01."""
    found = {
        modbus.decode_request(bytes.fromhex(it.values[0]["request_wire"]), PROFILE)
        for it in modbus_vectors("response")
        if it.values[0]["request"]["type"].startswith("Read")
    }
    for row in {row for model in Model for row in rows(Profile(model, type_codes=()))}:
        if row.access is not Access.WRITE:
            found.add(READERS[row.area](0x01, row.address, row.count))
    return found


PROFILE = Profile(Model.M_7019R)
READERS: dict[Area, Any] = {
    Area.COIL: modbus.ReadCoils,
    Area.DISCRETE_INPUT: modbus.ReadDiscreteInputs,
    Area.INPUT_REGISTER: modbus.ReadInputRegisters,
    Area.HOLDING_REGISTER: modbus.ReadHoldingRegisters,
}


@pytest.mark.no_cover
def test_no_request_that_reads_is_refused_but_some_that_are_text_without_their_control_characters() -> None:
    refused = {}
    for request in reading_requests():
        for address in range(1, 248):
            wire = modbus.encode(evolve(request, address=address))
            if not hazards_of(wire) <= DEFAULT_ALLOWED:
                refused[wire.hex(" ")] = bytes(byte & 0x7F for byte in wire if byte & 0x7F > 0x20)

    assert refused == REFUSED


REFUSED = {"a4 46 07 00 05 31 53": b"$F1S"}
"""The type code of channel 5 of module A4: without control characters it reads like a calibration of module F1."""


@pytest.mark.no_cover
@each("address", [0x01, 0x24, 0x25, 0x40, 0x7E, 0xA4, 0xF0])
def test_the_reads_of_a_module_can_follow_each_other(address: int) -> None:
    text, binary = Guard(), Guard()
    for message, single_ended in sorted(reading_commands(), key=repr):
        model = Model.M_7017Z if single_ended else Model.M_7019R
        profile = Profile(model, single_ended=single_ended, checksum=True)
        text = text.sending(dcon.encode(evolve(message, address=address), profile, force=True), LINE)
    for request in sorted(reading_requests(), key=repr):
        wire = modbus.encode(evolve(request, address=address))
        if wire.hex(" ") not in REFUSED:
            binary = binary.sending(wire, LINE)

    assert text.allowed == binary.allowed == DEFAULT_ALLOWED


@pytest.mark.no_cover
def test_the_longest_write_is_classified_in_bounded_work(monkeypatch: pytest.MonkeyPatch) -> None:
    work: list[int] = []

    def crc_of(frame: bytes) -> int:
        work.append(len(frame))
        return 1

    monkeypatch.setattr("i7000.conformance.guard_rtu.crc_of", crc_of)
    for unit in (b"\x05", b"\x10", b"\x00\x46", b"$01", b"\x01\x10\x00\x00\x00\x01\xff"):
        hazards_of((unit * LONGEST_WRITE)[:LONGEST_WRITE])

    assert max(work) <= 0x100 + 12
    assert sum(work) < 5 * 24 * 40 * LONGEST_WRITE
