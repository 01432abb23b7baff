"""The likely causes of frames that cannot be decoded, in the words that are printed."""

import pytest

from i7000 import DataFormat, Model, Protocol, TypeCode, dcon, modbus
from i7000.dissect import Heard, Known, Line, flush, hear, hear_frame
from tests.dissect.hearing import last_heard, line_of

I_7018, I_7019R = Known(Model.I_7018), Known(Model.I_7019R, types=(TypeCode.K,))
ONLY_RTU = ": these modules speak RTU"
SIX = "+0025.1+0025.3+0024.9+0025.9-0003.2+0101.7"


def sealed(body: str) -> str:
    return dcon.seal(body.encode(), checksum=True)[:-1].decode()


def hexed(digits: str) -> bytes:
    return bytes.fromhex(digits)


# --- Modbus -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("wire", "said"),
    [
        ("01 04 00 00 00 01", "no CRC? ReadInputRegisters without it, which would be 31 CA"),
        (
            "00 07 00 00 00 06 01 04 00 00 00 08",
            f"a Modbus TCP header (transaction 7, 6 bytes follow){ONLY_RTU}; the rest is ReadInputRegisters",
        ),
        (
            "00 07 00 00 00 04 01 FF 00 00",
            f"a Modbus TCP header (transaction 7, 4 bytes follow){ONLY_RTU}",
        ),
        ("23 30 31 0D", "the shape of a DCON frame: ReadAnalogInputs"),
        (
            "01 04 00 00 00 01 CA 31",
            "the bytes of the CRC are in the wrong order: the low byte comes first, 31 CA",
        ),
        ("01 04 00 00 00 01 CA 32", "damaged? ReadInputRegisters would have the CRC 31 CA"),
        ("01 04 00 00 00 01 31", "cut: ReadInputRegisters without its last byte, CA"),
        ("00 1E 04 02 0B 61 EA", "cut: InputRegisters without its last byte, 2A"),
        ("00 80 FF 00 FF 80 FF 00", "noise: another baud rate or parity?"),
        ("00", "noise: 1 byte beside the frames"),
        ("FF FF", "noise: 2 bytes beside the frames"),
    ],
)
def test_the_cause_that_a_frame_cannot_be_read_by_modbus_is_named(wire: str, said: str) -> None:
    heard = last_heard(hexed(wire))

    assert heard.notes == (said,)
    assert heard.error is not None


@pytest.mark.parametrize("wire", ["01 02 03 04 05 06 07", "01" * 300])
def test_where_no_cause_is_likely_none_is_named(wire: str) -> None:
    assert last_heard(hexed(wire)).notes == ()


def test_where_the_crc_is_right_the_error_says_what_is_wrong() -> None:
    heard = last_heard(modbus.seal(hexed("01 19 00")))

    assert heard.notes == ()
    assert str(heard.error).startswith("function at byte 1")


@pytest.mark.parametrize(
    ("request_body", "said"),
    [
        (
            "01 03 9C 41 00 01",
            "40001 is a number of the manual: in a frame it is address 0 (3.2); address 40001 would be number 440002",
        ),
        (
            "01 04 75 31 00 08",
            "30001 is a number of the manual: in a frame it is address 0 (3.2); address 30001 would be number 330002",
        ),
        (
            "01 06 9E 29 00 01",
            "40489 is a number of the manual: in a frame it is address 488 (3.2); address 40489 would be number 440490",
        ),
        (
            "01 02 27 11 00 08",
            "10001 is a number of the manual: in a frame it is address 0 (3.2); address 10001 would be number 110002",
        ),
    ],
)
def test_a_number_of_the_manual_that_is_used_as_an_address_is_noticed(request_body: str, said: str) -> None:
    heard = last_heard(modbus.seal(hexed(request_body)))

    assert said in heard.notes
    assert heard.error is None


@pytest.mark.parametrize("body", ["01 03 00 00 00 01", "01 03 9C 40 00 01", "01 03 C3 50 00 01", "01 01 9C 41 00 01"])
def test_other_addresses_are_not_taken_for_numbers_of_the_manual(body: str) -> None:
    assert not any("number of the manual" in note for note in last_heard(modbus.seal(hexed(body))).notes)


# --- DCON -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("known", "frame", "said"),
    [
        (I_7018, "$012B6", "B6 in place of a checksum? that of ReadConfiguration would be B7"),
        (
            Known(Model.I_7018, checksum=False),
            "$012B7",
            "B7 is the checksum of ReadConfiguration; no checksum was expected",
        ),
        (
            Known(Model.I_7018, checksum=True),
            "$012",
            "without a checksum it is ReadConfiguration; the checksum would be B7",
        ),
        (
            Known(Model.I_7018, checksum=True),
            "$012B6",
            "B6 in place of a checksum? that of ReadConfiguration would be B7",
        ),
        (I_7018, "$0aM", "lower case: in upper case it is ReadModuleName"),
        (I_7018, "$01ÿ\xff\xff\xff\xff\xff", "noise: another baud rate or parity?"),
    ],
)
def test_the_cause_that_a_command_cannot_be_read_is_named(known: Known, frame: str, said: str) -> None:
    heard = last_heard(frame, known=known)

    assert heard.notes == (said,)
    assert heard.error is not None


@pytest.mark.parametrize(
    ("wire", "said"),
    [
        (b"#01\n", "a line feed (0A) at its end: DCON frames end with a carriage return (0D)"),
        (b"#01\r\n", "a line feed (0A) at its end: DCON frames end with a carriage return (0D)"),
        (b"#01", "no carriage return (0D) at its end"),
        (bytes.fromhex("01040000000131CA"), "the CRC is right: a Modbus RTU frame, ReadInputRegisters"),
        (modbus.seal(b"\x01\x2b\x0e"), "the CRC is right: a Modbus RTU frame"),
    ],
)
def test_the_cause_that_the_end_of_a_frame_is_not_that_of_dcon_is_named(wire: bytes, said: str) -> None:
    _, heard = hear_frame(line_of(I_7018), wire, Protocol.DCON)

    assert heard.notes == (said,)
    assert heard.error is not None


@pytest.mark.parametrize(
    ("known", "report", "said"),
    [
        (I_7019R, SIX + "+0000.0", "7 blanks short: the last channel is disabled, and the log has lost the blanks?"),
        (I_7019R, SIX, "14 blanks short: the last 2 channels are disabled, and the log has lost the blanks?"),
        (
            I_7018,
            "+0025.1" * 10,
            "it is AnalogInputs of other models than an I-7018: I-7017Z, M-7017Z, I-7018Z, M-7018Z, M-7019Z",
        ),
        (
            Known(Model.I_7018, data_format=DataFormat.ENGINEERING),
            "7FFF" * 8,
            "it can be read in data format hex",
        ),
    ],
)
def test_the_cause_that_a_report_cannot_be_read_is_named(known: Known, report: str, said: str) -> None:
    heard = last_heard("#01", f">{report}", known=known)

    assert said in heard.notes
    assert heard.error is not None


def test_a_report_that_nothing_explains_has_no_cause() -> None:
    assert last_heard("#01", ">+0025.1+00", known=Known()).notes == ()


def test_a_response_without_the_checksum_that_the_module_had_before_names_the_frame_that_had_one() -> None:
    frames = [sealed("#010"), sealed(">+0025.1"), sealed("#010"), ">+0025.1"]

    assert last_heard(*frames).notes == (
        "without a checksum it is AnalogInput, but frame 2 had one; the checksum would be 8F",
    )


def test_a_response_with_a_checksum_that_the_module_did_not_have_before_names_the_frame_without() -> None:
    frames = ["$012", "!010F0600", "#010", sealed(">+0025.1")]

    assert last_heard(*frames, known=I_7018).notes == ("8F is the checksum of AnalogInput, but frame 2 had none",)


def test_a_response_without_the_checksum_that_its_command_has_is_explained() -> None:
    assert last_heard(sealed("$012"), "!010F0600", known=I_7018).notes == (
        "without a checksum it is Configuration, but the command had one; the checksum would be BE",
    )


@pytest.mark.parametrize(
    ("frame", "said"),
    [
        ("!010706001AF", "1AF is the whole sum: the checksum of Configuration is its last two digits, AF"),
        ("!0107060001AF", "01AF is the whole sum: the checksum of Configuration is its last two digits, AF"),
        ("!010706001AE", None),
        ("!0107060002AF", None),
    ],
)
def test_a_sum_of_three_digits_in_place_of_a_checksum_is_explained(frame: str, said: str | None) -> None:
    notes = last_heard("$012", frame, known=I_7018).notes

    assert notes == (() if said is None else (said,))


def test_a_command_with_a_sum_of_three_digits_is_explained() -> None:
    assert last_heard("$01M0D2", known=I_7018).notes == (
        "0D2 is the whole sum: the checksum of ReadModuleName is its last two digits, D2",
    )


# --- addresses --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("known_at", "command", "said"),
    [
        (0x10, "#16", "no module at 16h (22) is known, but one at 10h (16): in decimal?"),
        (0x0A, "#10", "no module at 10h (16) is known, but one at 0Ah (10): in decimal?"),
    ],
)
def test_an_address_in_decimal_is_noticed(known_at: int, command: str, said: str) -> None:
    assert last_heard(command, by_address={known_at: I_7018}).notes == (said,)


@pytest.mark.parametrize("command", ["#0A", "#11", "#**"])
def test_an_address_of_a_known_module_or_of_none_like_it_is_not_doubted(command: str) -> None:
    assert last_heard(command, by_address={0x0A: I_7018}).notes == ()


def test_an_address_in_decimal_is_noticed_by_modbus_too() -> None:
    known = Known(Model.M_7018)

    assert (
        "no module at 16h (22) is known, but one at 10h (16): in decimal?"
        in last_heard(modbus.encode(modbus.ReadInputRegisters(0x16, 0, 1)), by_address={0x10: known}).notes
    )


# --- types that a model does not have ---------------------------------------------------------------------------------


def test_a_type_that_is_set_and_that_the_model_does_not_have_is_noticed() -> None:
    heard = last_heard("%0101080600", known=I_7018)

    assert heard.notes == ("an I-7018 has no type 08, -10..10 V; it answers ?AA",)
    assert heard.error is None


def test_a_type_that_is_read_and_that_the_model_does_not_have_contradicts_it() -> None:
    assert last_heard("!01080600", known=I_7018).notes == ("an I-7018 has no type 08, -10..10 V; another model?",)
    assert last_heard("$012", "!01080600", known=I_7018).contradictions == (
        "an I-7018 has no type 08, -10..10 V; another model?",
    )


def test_the_code_of_different_types_is_one_that_every_model_can_have() -> None:
    heard = last_heard("$012", "!01FF0600", known=Known(Model.I_7019R))

    assert (heard.notes, heard.contradictions) == ((), ())


def test_what_has_no_more_characters_than_a_checksum_has_no_cause() -> None:
    assert last_heard("$012", "01", known=I_7018).notes == ()


MESSAGE = bytes.fromhex("000700000006010400000008")
TCP = "a Modbus TCP header (transaction 7, 6 bytes follow): these modules speak RTU; the rest is ReadInputRegisters"


@pytest.mark.parametrize("size", [1, 5, 99])
@pytest.mark.parametrize(
    ("stream", "noise"),
    [
        (b"$012", [("terminator", "no carriage return (0D) at its end")]),
        (
            b"$012\n!010F0600\n",
            [("terminator", "a line feed (0A) at its end: DCON frames end with a carriage return (0D)")] * 2,
        ),
        (b"$01m\r", [("command", "lower case: in upper case it is ReadModuleName")]),
        (
            b"$01m\r" + MESSAGE,
            [
                ("command", "lower case: in upper case it is ReadModuleName"),
                ("crc", TCP),
            ],
        ),
        (
            bytes.fromhex("0104000000010D"),
            [("crc", "no CRC? ReadInputRegisters with the end of a line in its place; the CRC would be 31 CA")],
        ),
        (b"xx$012\r", [("leading", None)]),
    ],
)
def test_noise_in_a_stream_has_its_fault_and_cause_in_whatever_pieces_it_comes(
    stream: bytes, noise: list[tuple[str, str | None]], size: int
) -> None:
    line = Line()
    heard: list[Heard] = []
    for at in range(0, len(stream), size):
        line, found = hear(line, stream[at : at + size])
        heard += found
    heard += flush(line)[1]

    faults = [(it.error.fault.value, next(iter(it.notes), None)) for it in heard if it.error]
    assert faults == noise


def test_a_modbus_frame_on_a_line_of_dcon_is_named() -> None:
    _, (heard,) = hear(Line(protocol=Protocol.DCON), bytes.fromhex("01040000000131CA"))

    assert heard.notes == ("the CRC is right: a Modbus RTU frame, ReadInputRegisters",)


def test_noise_leaves_the_command_before_it_waiting() -> None:
    _, (_, _, response) = hear(Line(protocol=Protocol.DCON), b"$012\r\n!010F0600\r")

    assert response.answers is not None
