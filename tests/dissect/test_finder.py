"""Every frame of a line is found, whatever its spelling, and nothing else is taken for one."""

from itertools import cycle, pairwise

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from i7000 import modbus
from i7000.dissect.finder import find
from i7000.dissect.found import Kind
from i7000.dissect.in_bytes import frames_of
from i7000.dissect.shapes import is_shaped
from i7000.strategies.dcon import exchanges
from i7000.strategies.modbus import exchanges as modbus_exchanges
from tests.dissect.frames import DCON, MODBUS, REQUEST, RESPONSE
from tests.dissect.spellings import AFTER, BEFORE, BETWEEN, BYTES, COLUMNS, TEXTS, WITHOUT_FRAMES, Spelling


def modbus_wires() -> st.SearchStrategy[bytes]:
    return modbus_exchanges().flatmap(lambda it: st.sampled_from((it.request_wire, it.response_wire)))


SPELLINGS = [*(("bytes", name) for name in BYTES), *(("text", name) for name in TEXTS)]
"""Numbers in words are read for good frames only, so that what is damaged is not found in them."""


def spelling(kind: str, name: str) -> Spelling:
    return (BYTES if kind == "bytes" else TEXTS)[name]


def wires(text: str) -> list[bytes]:
    return [found.wire for found in find(text)]


@pytest.mark.parametrize(("kind", "name"), SPELLINGS, ids=" ".join)
def test_a_frame_is_found_in_every_spelling_and_nothing_else(kind: str, name: str) -> None:
    spell = spelling(kind, name)
    frames = cycle(DCON if kind == "text" else MODBUS + DCON)
    lines = [(before, next(frames), after) for before, after in zip(BEFORE * 2, cycle(AFTER), strict=False)]
    missed = [line for line in lines if wires(line[0] + spell(line[1]) + line[2]) != [line[1]]]

    assert missed == []


@pytest.mark.parametrize(("kind", "name"), SPELLINGS, ids=" ".join)
def test_two_frames_of_a_line_are_found_and_nothing_between(kind: str, name: str) -> None:
    if name in COLUMNS:
        pytest.skip("a dump has one frame a line")
    spell = spelling(kind, name)
    frames = DCON if kind == "text" else MODBUS + DCON
    pairs = zip(frames, frames[1:] + frames[:1], cycle(BETWEEN), strict=False)
    missed = [pair for pair in pairs if wires(spell(pair[0]) + pair[2] + spell(pair[1])) != [*pair[:2]]]

    assert missed == []


@pytest.mark.parametrize("text", WITHOUT_FRAMES)
def test_no_frame_is_found_in_a_line_without_one(text: str) -> None:
    assert find(text) == ()


@pytest.mark.no_cover
@given(
    st.sampled_from(SPELLINGS), st.sampled_from(BEFORE), st.sampled_from(AFTER),
    exchanges().flatmap(lambda it: st.sampled_from((it.command_wire, it.response_wire))) | modbus_wires(),
)  # fmt: skip
def test_what_a_module_hears_and_says_is_found_in_every_spelling(
    which: tuple[str, str], before: str, after: str, wire: bytes
) -> None:
    kind, name = which
    is_text = wire.endswith(b"\r") and wire[:-1].isascii() and is_shaped(wire[:-1].decode("ascii"))
    assume(is_text or kind == "bytes")
    assume(is_text or (modbus.crc16(wire) == 0 and not wire.decode("latin-1").isprintable()))

    assert wires(before + spelling(kind, name)(wire) + after) == [wire]


@given(st.text(max_size=200) | st.text("$#%!?>@~0123456789ABCDEFx\\'\"[]<>(){}.,:;- \r\n", max_size=200))
def test_no_line_raises_and_nothing_found_overlaps(text: str) -> None:
    found = find(text)

    assert all(0 <= one.start < one.end <= len(text) for one in found)
    assert all(one.end <= other.start for one, other in pairwise(found))
    assert all(one.wire for one in found)


def test_a_byte_before_a_frame_in_its_own_spelling_is_found_as_damaged() -> None:
    noise, frame = find("<00><01><04><02><0B><61><7F><E8>Bytes flushed (0)")

    assert (noise.kind, noise.wire) == (Kind.DAMAGED, b"\x00")
    assert (frame.kind, frame.wire) == (Kind.MODBUS, RESPONSE)


@pytest.mark.parametrize(
    "text",
    [
        "12 01:04:00:00:00:01:31:CA",
        "1700000000 01-04-00-00-00-01-31-CA",
        "12 0x1 0x4 0x0 0x0 0x0 0x1 0x31 0xca",
        "1700000000 0104 0000 0001 31CA",
        "12 $01 $04 $00 $00 $00 $01 $31 $CA",
    ],
)
def test_a_number_before_a_frame_in_another_spelling_is_not_part_of_it(text: str) -> None:
    assert wires(text) == [REQUEST]


@pytest.mark.parametrize(
    ("text", "wire"),
    [
        ("TX 01 04 00 00 00 01 31 CB", bytes.fromhex("01040000000131CB")),
        ("01040000000131CB", bytes.fromhex("01040000000131CB")),
        (r"Response: '\x00\x1e\x04\x02\x0ba\xea' (00 1E 04 02 0B 61 EA) (7 bytes)", bytes.fromhex("001E04020B61EA")),
        (r"b'\x01\x04\x00a'", b"\x01\x04\x00a"),
        (r"b'\x01\x83\x02\x81\xf1'", bytes.fromhex("01830281F1")),
        (r'read(3, "\1\4\2%\264\332", 256) = 6', bytes.fromhex("01040225B4DA")),
        ("RX\t8\t01 04 00 00 00 01 31 CB", bytes.fromhex("01040000000131CB")),
        ("RX\t13\t01 04 00 00 00 01 31 CB", bytes.fromhex("01040000000131CB")),
        ("$0aM", b"$0aM\r"),
        ("#01 extra\\r", b"#01 extra\r"),
        ("$01zz", b"$01zz\r"),
        (">+0025.1+00", b">+0025.1+00\r"),
        ('"$012\\n"', b"$012\n"),
        ("%0101", b"%0101\r"),
    ],
)
def test_a_damaged_frame_is_found_as_it_is_written(text: str, wire: bytes) -> None:
    (found,) = find(text)

    assert (found.kind, found.wire) == (Kind.DAMAGED, wire)


def test_of_two_frames_the_damaged_one_is_found_too() -> None:
    request, response = find("TX 01 04 00 00 00 01 31 CA RX 01 04 02 0B 61 7F E9")

    assert (request.kind, request.wire) == (Kind.MODBUS, REQUEST)
    assert (response.kind, response.wire) == (Kind.DAMAGED, RESPONSE[:-1] + b"\xe9")


def test_blanks_in_a_report_are_a_disabled_channel_however_they_are_written() -> None:
    assert wires(r">+0025.1\s\s\s\s\s\s\s+0024.9\r") == [b">+0025.1       +0024.9\r"]


def test_both_protocols_are_found_in_one_line() -> None:
    assert wires("$012 and then 01 04 00 00 00 01 31 CA") == [b"$012\r", REQUEST]


def test_the_place_of_a_frame_in_the_line_is_shown() -> None:
    (found,) = find("TX: $012 ok")

    assert (found.start, found.end) == (4, 8)


def test_text_inside_a_good_frame_is_not_a_frame() -> None:
    wire = modbus.seal(b"\x01\x04\x06$012\r\x00")

    assert wires(wire.hex(" ")) == [wire]


def test_a_string_with_a_character_that_is_no_byte_has_no_frame() -> None:
    assert wires('"\\x01\u044f\\x04"') == []


def damaged_wires() -> st.SearchStrategy[bytes]:
    """A frame of which one byte is another, or the last are missing, and in which no good frame is left."""
    changed = st.tuples(st.sampled_from(MODBUS), st.integers(0, 255), st.integers(1, 255)).map(_change)
    cut = st.tuples(st.sampled_from(MODBUS), st.integers(1, 3)).map(lambda it: it[0][: -it[1]])
    return (changed | cut).filter(lambda wire: len(wire) > 3 and not frames_of(wire))


def _change(which: tuple[bytes, int, int]) -> bytes:
    wire, at, by = which
    changed = bytearray(wire)
    changed[at % len(wire)] ^= by
    return bytes(changed)


EACH_A_WORD = (
    "blanks", "upper case", "colons", "dashes", "commas", "commas and blanks", "semicolons", "bars", "underscores",
    "0x", "pymodbus", "libmodbus, requests", "libmodbus, responses", "h", "escapes", "C, an array", "node",
)  # fmt: skip
"""Spellings that no sentence has, so that a frame which is damaged is seen to be one."""


@given(st.sampled_from(EACH_A_WORD), st.sampled_from(BEFORE), st.sampled_from(AFTER), damaged_wires())
def test_a_damaged_frame_is_found_whole_and_never_for_a_good_one(
    name: str, before: str, after: str, wire: bytes
) -> None:
    found = find(before + BYTES[name](wire) + after)

    assert [(one.kind, one.wire) for one in found] == [(Kind.DAMAGED, wire)]


@given(st.sampled_from(EACH_A_WORD), st.sampled_from(BETWEEN), st.sampled_from(MODBUS), damaged_wires(), st.booleans())
def test_a_damaged_frame_beside_a_good_one_is_found_too(
    name: str,
    between: str,
    good: bytes,
    damaged: bytes,
    first: bool,  # noqa: FBT001 - drawn
) -> None:
    assume(name not in COLUMNS)
    pair = (damaged, good) if first else (good, damaged)
    found = find(between.join(BYTES[name](wire) for wire in pair))

    assert [one.wire for one in found] == [*pair]


def test_bytes_behind_a_frame_in_its_own_spelling_are_found_as_damaged() -> None:
    frame, noise = find(f"RX {RESPONSE.hex(' ')} FF FF ok")

    assert (frame.wire, noise.wire) == (RESPONSE, b"\xff\xff")


@pytest.mark.parametrize("separator", [" ", ", ", " | ", "; ", " / "])
@pytest.mark.parametrize("noise", [b"\xff\xfe", b"\x7f\xe8"])
def test_bytes_beside_a_frame_are_found_behind_another_separator(separator: str, noise: bytes) -> None:
    request, others = REQUEST.hex(" ").upper(), noise.hex(" ").upper()

    assert wires(request + separator + others) == [REQUEST, noise]
    assert wires(others + separator + request) == [noise, REQUEST]
    assert b"".join(wires(separator.join((others, others, request, others, others)))) == noise * 2 + REQUEST + noise * 2


@pytest.mark.parametrize(
    "after", [", 15 ms", " | 12 34", "; 8", ", 31, CA", " | 0xFF 0xFE", " (31 CA)", ", CRC: 31 CA"]
)
def test_numbers_and_another_spelling_beside_a_frame_are_no_part_of_it(after: str) -> None:
    assert wires(REQUEST.hex(" ").upper() + after) == [REQUEST]


@pytest.mark.parametrize("text", ["1: 04 00 00 00 01 31 CA", "1; 4, 0, 0, 0, 1, 49, 202"])
def test_a_line_number_is_not_the_first_byte_of_a_frame(text: str) -> None:
    assert Kind.MODBUS not in [found.kind for found in find(text)]


def test_a_line_of_many_frames_and_columns_is_not_searched_for_repeats() -> None:
    line = "$012 24 30 31 32 0D " * 300

    assert wires(line) == [b"$012\r"] * 600


@pytest.mark.parametrize(
    "text",
    [
        "it costs ~01 of that", "see @01", "mail @01, or ~01.", "$01 2 for one", "a price of $01", "about ~10zz",
        "took ~100 ms", "took ~100ms", "within #10 s", "value >+1 of",
    ],
)  # fmt: skip
def test_a_sentence_has_no_frame(text: str) -> None:
    assert find(text) == ()


@pytest.mark.parametrize(
    ("text", "wire"),
    [
        ("$01", b"$01\r"),
        ("TX: $01", b"$01\r"),
        ("12:00:01.5 TX $01", b"$01\r"),
        ("12:00:01 -> $01zz 15 bytes", b"$01zz\r"),
        ("write('$01')", b"$01\r"),
        (r"the last was $01\r", b"$01\r"),
    ],
)
def test_a_damaged_frame_in_the_place_of_one_is_found(text: str, wire: bytes) -> None:
    assert [(it.kind, it.wire) for it in find(text)] == [(Kind.DAMAGED, wire)]


@pytest.mark.parametrize(
    ("text", "wire"),
    [
        ("$01\x082\r", b"$01\x082\r"),
        ("$01\x002\r", b"$01\x002\r"),
        ("#0\udcb11\r", b"#0\xb11\r"),
        (r"TX: $\xb112\r", b"$\xb112\r"),
        ("TX: $0I2", b"$0I2\r"),
        ("the last was: $0I2\r", b"$0I2\r"),
        ("12:00:01 -> #0l", b"#0l\r"),
        ("~*1", b"~*1\r"),
        (">+OO25.1", b">+OO25.1\r"),
        ("12:00:01 <- >+00\udcfe\udcb2.1", b">+00\xfe\xb2.1\r"),
    ],
)
def test_a_frame_whose_address_or_text_is_damaged_is_found_where_nothing_else_stands(text: str, wire: bytes) -> None:
    assert [(it.kind, it.wire) for it in find(text)] == [(Kind.DAMAGED, wire)]


def test_a_damaged_frame_behind_a_good_one_is_found_without_its_address() -> None:
    assert wires("$012 -> !0I0F0600") == [b"$012\r", b"!0I0F0600\r"]


@pytest.mark.parametrize(
    "text",
    [
        "$PATH", "#define\n", "see #v2", "see: #v2", "a@b12", "# comment\r", "-> ?\r", "-->x\r", "really?!\r",
        "#!/bin/sh", "~/x", "$PATH and 50% done! really?\r", "<td>5</td>\r", "~1%", "well -#define\r",
    ],
)  # fmt: skip
def test_words_behind_a_leading_character_are_no_damaged_frame(text: str) -> None:
    assert find(text) == ()


@pytest.mark.parametrize(
    ("text", "found"),
    [
        (r"$012\r\xff\xfe", [b"$012\r", b"\xff\xfe"]),
        (r"$012\r\n\xff", [b"$012\r", b"\xff"]),
        (r"$012 \xff", [b"$012\r", b"\xff"]),
        (r"$012\x08\x07", [b"$012\r", b"\x08\x07"]),
        (r"$012\xff\r", [b"$012\r", b"\xff\r"]),
        (r"\xff\xfe$012\r", [b"\xff\xfe", b"$012\r"]),
        (r"\xff $012", [b"\xff", b"$012\r"]),
        (r"$012\xff#01\r", [b"$012\r", b"\xff", b"#01\r"]),
        ("$012\r\udcff", [b"$012\r", b"\xff"]),
        (r'b"$012\r\x00"', [b"$012\r", b"\x00"]),
    ],
)
def test_bytes_that_touch_a_frame_are_found(text: str, found: list[bytes]) -> None:
    assert wires(text) == found


@pytest.mark.parametrize("text", ["caf\udce9 $012", "$012 \udce9t\udce9", "$012\x1b[K"])
def test_a_letter_of_another_encoding_or_a_command_of_a_terminal_beside_a_frame_is_no_part_of_it(text: str) -> None:
    assert wires(text) == [b"$012\r"]


@pytest.mark.parametrize(
    ("text", "wire"),
    [
        ("&#35;01", b"#01\r"),
        ("<td>&#x24;012&#13;&#10;</td>", b"$012\r"),
        ("&#62;+0025.1", b">+0025.1\r"),
        ("cmd=%21010F0600", b"!010F0600\r"),
        ("cmd=%2301%0D", b"#01\r"),
        ("%2301%0D", b"#01\r"),
        ("GET /send?c=%24012%0D&x=1 HTTP/1.1", b"$012\r"),
        ("c=%3E%2B0025.1%0D", b">+0025.1\r"),
        ("c=%3e%2b0025.1-0003.2%2B0101.7%0d%0a", b">+0025.1-0003.2+0101.7\r"),
        ("%250101050600%0D", b"%0101050600\r"),
        ("%2323050600%0D", b"%2323050600\r"),
        ("TX: %2101050600", b"%2101050600\r"),
        ("%0101050600%0D", b"%0101050600\r"),
    ],
)
def test_characters_as_html_and_urls_write_them_are_read(text: str, wire: bytes) -> None:
    assert [(it.kind, it.wire) for it in find(text)] == [(Kind.DCON, wire)]


def test_a_damaged_frame_in_a_url_is_read_as_it_was_sent() -> None:
    assert wires("c=%7E01M%0D") == [b"~01M\r"]


@pytest.mark.parametrize(
    "before", ["#17 ", "@12:00 ", "1704067200 ", "1704067200123 ", "[pid  1234] ", "~5ms ", "50% ", "E01 ", "0x1F4 "]
)
@pytest.mark.parametrize("name", ["colons", "one word", "JSON, numbers", "modbus-tk", "octal", "libmodbus, requests"])
def test_a_number_before_a_frame_is_no_frame(before: str, name: str) -> None:
    spell = BYTES[name]

    assert [wires(before + spell(wire)) for wire in MODBUS + DCON] == [[wire] for wire in MODBUS + DCON]


@pytest.mark.parametrize("after", [" @12", " ~5ms", " #2", " 100%", " $ok", " -> module 01", " // 01"])
def test_a_number_behind_a_frame_is_no_frame(after: str) -> None:
    found = [find(REQUEST.hex(":") + after), find("!01050600\\r" + after)]

    assert [[it.wire for it in one] for one in found] == [[REQUEST], [b"!01050600\r"]]


def test_a_command_before_its_response_is_no_counter() -> None:
    assert wires("#01 >+0025.1") == wires("#01 RX: 3E 2B 30 30 32 35 2E 31 0D") == [b"#01\r", b">+0025.1\r"]
    assert wires("#17 is polled") == [b"#17\r"]


@pytest.mark.parametrize(
    "text",
    [
        r'"\u{1}\u{4}\0\0\0\u{1}1\u{ca}"',
        "".join(f"x{byte:02x}" for byte in REQUEST),
        "".join(f"%{byte:02X}" for byte in REQUEST),
        "frame=%01%04%00%00%00%011%CA&x=1",
        f"#12 {REQUEST.hex(' ')}",
    ],
)
def test_a_frame_in_the_spelling_of_rust_of_urls_or_of_x_is_found_alone(text: str) -> None:
    assert wires(text) == [REQUEST]


@pytest.mark.parametrize("end", [r"\13", r"\13\10"])
def test_a_carriage_return_can_be_escaped_in_decimal(end: str) -> None:
    assert [(it.kind, it.wire) for it in find(f"$012{end}")] == [(Kind.DCON, b"$012\r")]


def test_a_counter_before_a_damaged_frame_is_no_frame() -> None:
    (found,) = find("#12 01 04 00 00 00 01 31 CB")

    assert (found.kind, found.wire) == (Kind.DAMAGED, REQUEST[:-1] + b"\xcb")


@pytest.mark.parametrize("text", ["x86 and x64", "x10x", "0x01x04", "max12x34"])
def test_words_with_an_x_are_no_bytes(text: str) -> None:
    assert find(text) == ()


@pytest.mark.parametrize("name", ["0\0\0\0", "\x01", "\x7f", "7018\u00e9"])
def test_no_good_frame_has_characters_that_no_name_has(name: str) -> None:
    good = [found.wire for found in find(f"!01{name}\r") if found.kind is Kind.DCON]

    assert not is_shaped(f"!01{name}")
    assert [wire for wire in good if not wire[:-1].decode("ascii").isprintable()] == []
