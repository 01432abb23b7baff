"""What people post when a module does not answer: lines of well-known tools, each with the frames that are in it."""

from typing import Any

import pytest

from i7000.dissect.finder import find
from i7000.dissect.found import Kind
from i7000.dissect.transcript import pieces
from tests.dissect.frames import REQUEST, RESPONSE
from tests.each import each
from tests.spec.lint import vectors

READ_8 = bytes.fromhex("010400000008F1CC")
WRITE = bytes.fromhex("010601E8006409E9")
DAMAGED_RESPONSE = RESPONSE[:-1] + b"\xe9"

FRAMES: dict[str, tuple[list[str], list[bytes]]] = {
    "pymodbus without leading zeros": (["0x1 0x4 0x0 0x0 0x0 0x1 0x31 0xca"], [REQUEST]),
    "pymodbus with what was left before": (["recv: 0x1 0x4 0x2 0xb 0x61 0x7f 0xe8 old_data:  addr=None"], [RESPONSE]),
    "libmodbus, request": (["[01][04][00][00][00][01][31][CA]", "Waiting for a confirmation..."], [REQUEST]),
    "libmodbus with blanks": (["< 01 >< 04 >< 02 >< 0B >< 61 >< 7F >< E8 >"], [RESPONSE]),
    "ESPHome, a string of C": ([r'[D][uart_debug:158]: >>> "\x01\x04\x00\x00\x00\b\xF1\xCC"'], [READ_8]),
    "modbus-tk in decimal": (["-> 1-4-0-0-0-1-49-202"], [REQUEST]),
    "NModbus": (["TX: 1, 4, 0, 0, 0, 1, 49, 202"], [REQUEST]),
    "ModScan": (["[001][004][000][000][000][001][049][202]"], [REQUEST]),
    "node-modbus-serial": (
        [f"request: <Buffer {REQUEST.hex(' ')}>, responses: [ <Buffer {RESPONSE.hex(' ')}> ]"], [REQUEST, RESPONSE],
    ),
    "request and response with an arrow": ([f"{REQUEST.hex(' ')} -> {RESPONSE.hex(' ')}"], [REQUEST, RESPONSE]),
    "request and response with a bar": ([f"{REQUEST.hex(' ')} | {RESPONSE.hex(' ')}"], [REQUEST, RESPONSE]),
    "request and response with a comma": ([f"{REQUEST.hex(' ')} , {RESPONSE.hex(' ')}"], [REQUEST, RESPONSE]),
    "tshark -T fields": (["12 01:04:00:00:00:01:31:CA"], [REQUEST]),
    "a time in seconds": (["0.020000 01:04:00:00:00:01:31:CA"], [REQUEST]),
    "a time since 1970": (["1700000000 01-04-00-00-00-01-31-CA"], [REQUEST]),
    "a number and commas": (["12 01,04,00,00,00,01,31,CA"], [REQUEST]),
    "pymodbus, a response in pieces": (
        ["send: 0x01 0x04 0x00 0x00 0x00 0x01 0x31 0xca", "recv: 0x01 0x04 0x02", "recv: 0x0b 0x61 0x7f 0xe8"],
        [REQUEST, RESPONSE],
    ),
    "pymodbus, pieces that are repeated": (
        ["recv: 0x01 0x04 0x02 extra data: ", "recv: 0x0b 0x61 0x7f 0xe8 extra data: 0x01 0x04 0x02"], [RESPONSE],
    ),
    "a register number for an address": (["01 03 9C 41 00 01 FA 4E"], [bytes.fromhex("01039C410001FA4E")]),
    "many frames in a line": (
        [f"{REQUEST.hex(' ')} {RESPONSE.hex(' ')} {REQUEST.hex(' ')} {RESPONSE.hex(' ')}"],
        [REQUEST, RESPONSE, REQUEST, RESPONSE],
    ),
    "arrows and a time": ([f">>> 21:03:12 {REQUEST.hex(' ')}"], [REQUEST]),
    "an exception": (["RTU recv (stable 2 polls, 5 bytes): 01 83 02 C0 F1"], [bytes.fromhex("018302C0F1")]),
    "a manual": (["Command: $012    Response: !01050600"], [b"$012\r", b"!01050600\r"]),
    "a manual, a broadcast": (["Command: #**   No response "], [b"#**\r"]),
    "another manual": (["Command : $033 Receive : >+0025.4"], [b"$033\r", b">+0025.4\r"]),
    "an equals sign between": (["$012 = !010F0600"], [b"$012\r", b"!010F0600\r"]),
    "no blanks between": (["$012;!010F0600", "TX=$022&RX=!020F0600"], [
        b"$012\r", b"!010F0600\r", b"$022\r", b"!020F0600\r",
    ]),
    "a sniffer with columns": (
        ["24 30 31 32 0d    $012.", "21 30 31 30 46 30 36 30 30 0d    !010F0600."], [b"$012\r", b"!010F0600\r"],
    ),
    "StreamDevice": (['"#01<0d>"'], [b"#01\r"]),
    "ESPHome, text in hex": ([">>> 24:30:31:32:0D"], [b"$012\r"]),
    "node, a buffer of text": (["<Buffer 24 30 31 32 0d>"], [b"$012\r"]),
    "LabVIEW": (
        [r">+0025.1\s\s\s\s\s\s\s+0024.9+0025.9-0003.2+0101.7+0000.0+0025.0\r"],
        [b">+0025.1       +0024.9+0025.9-0003.2+0101.7+0000.0+0025.0\r"],
    ),
    "a name and a duration": (["$01M", "!017018R (15 ms)"], [b"$01M\r", b"!017018R\r"]),
    "a version and a remark": (["$01F", "!01B1.5   // firmware"], [b"$01F\r", b"!01B1.5\r"]),
    "blanks stripped from the end": (
        [">+0025.1+0025.3+0024.9+0025.9-0003.2+0101.7+0000.0"],
        [b">+0025.1+0025.3+0024.9+0025.9-0003.2+0101.7+0000.0\r"],
    ),
    "a report in hex": (
        ["#01", ">0000012301257FFF1802744F98238124"], [b"#01\r", b">0000012301257FFF1802744F98238124\r"],
    ),
    "a checksum": (["$012B7"], [b"$012B7\r"]),
    "a module at 10h": (["TX: #10", "TX: #13"], [b"#10\r", b"#13\r"]),
    "a name with letters": (["!034018P", "!018017SC"], [b"!034018P\r", b"!018017SC\r"]),
    "both protocols": (["$012", REQUEST.hex(" ")], [b"$012\r", REQUEST]),
}  # fmt: skip


@pytest.mark.parametrize("name", FRAMES)
def test_the_frames_of_a_log_are_found_and_nothing_else(name: str) -> None:
    lines, wires = FRAMES[name]
    found = [piece for piece in pieces(enumerate(lines, 1)) if piece.kind]

    assert [piece.wire for piece in found] == wires
    assert Kind.DAMAGED not in [piece.kind for piece in found]


DAMAGED = {
    "a gateway without CRC": ("conn[10.0.0.1]: request: [01][04][00][00][00][01]", REQUEST[:-2]),
    "Modbus TCP": ("00 07 00 00 00 06 01 04 00 00 00 08", bytes.fromhex("000700000006010400000008")),
    "a response with its last byte missing": (
        r"Response from instrument: '\x00\x1e\x04\x02\x0ba\xea' (00 1E 04 02 0B 61 EA) (7 bytes), roundtrip: 41.7 ms.",
        bytes.fromhex("001E04020B61EA"),
    ),
    "garbage of a wrong baud rate": ("RX: FE 7C 00 F8 80 FC", bytes.fromhex("FE7C00F880FC")),
    "LF for CR": (r"TX '#01\n'", b"#01\n"),
    "a field of another vendor": (">+888888", b">+888888\r"),
    "a sum that is not a byte": ("!010706001AF", b"!010706001AF\r"),
    "lower case": ("$0aM", b"$0aM\r"),
}


@pytest.mark.parametrize("name", DAMAGED)
def test_what_is_damaged_is_reported_with_all_its_bytes(name: str) -> None:
    line, wire = DAMAGED[name]
    (found,) = find(line)

    assert (found.kind, found.wire) == (Kind.DAMAGED, wire)


def test_a_damaged_response_behind_its_request_is_reported() -> None:
    line = f"TX {REQUEST.hex(' ').upper()} RX {DAMAGED_RESPONSE.hex(' ').upper()}"

    assert [(it.kind, it.wire) for it in find(line)] == [(Kind.MODBUS, REQUEST), (Kind.DAMAGED, DAMAGED_RESPONSE)]


def test_a_debug_log_of_pymodbus_has_every_frame_once() -> None:
    written = WRITE.hex(" ")
    lines = [f"send: {written}", f"recv: {written} old_data:  addr=None", f"Processing: {written}"]

    assert [piece.same_as for piece in pieces(enumerate(lines, 1))] == [None, None, 2]


def printed_examples() -> list[Any]:
    """The exchanges that the manual prints, as one line each."""
    examples = [
        vector for _, vector in vectors("dcon") if vector["source"] == "manual" and vector["outcome"] != "reject"
    ]
    assert len(examples) > 70
    return [pytest.param(vector, id=vector["id"]) for vector in examples]


@each("vector", printed_examples())
@pytest.mark.parametrize(
    "words", ["Command: {}    Response: {}", "Command : {} Receive : {}", "{} -> {}", "TX: {} RX: {}"]
)
def test_an_example_of_the_manual_is_read_as_it_is_printed(vector: dict[str, Any], words: str) -> None:
    texts = [vector["command_text"], vector["response_text"] or "No response"]
    wires = [bytes.fromhex(vector[key]) for key in ("command_wire", "response_wire") if vector[key]]

    assert [it.wire for it in find(words.format(*texts))] == wires
