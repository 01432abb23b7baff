"""What is found in plain lines is what the whole search finds."""

from datetime import timedelta

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from i7000.dissect.finder import read_line, without_end
from i7000.dissect.found import Found, Kind
from i7000.dissect.plain import find_plain
from tests.dissect.frames import DCON, MODBUS

TOKENS = (
    "", " ", "  ", "\t", ": ", ":", ", ", ";", "|", "[", "]", "(", ")", "{", "}", "<", "=", "-", "_", "/", ".", '"',
    "'", "TX", "RX", "send", "Data", "be", "FF", "a", "b", "12", "123", "1", "0", "0x", "old_data: ", "ok",
    "> ", ">", ">> ", "-> ", "$", "h", "\\", "%0D", "<CR>", "0.020000", "12:00:01", "12:00", "2026-11-30",
    "2026-11-30 12:00:01.123", "12:00:01,5", "12:00:01Z", "COM3", "00000000",
)  # fmt: skip
ENDS = (
    "",
    "\\r",
    "<CR>",
    "\r",
    "\n",
    "\r\n",
    "\\r\\n",
    " ",
    '"',
    "'",
    ")",
    "]",
    ">",
    ".",
    "\\r'",
    " ok",
    " (15 ms)",
    ",",
)


def spelled() -> st.SearchStrategy[str]:
    """A frame, or nearly one, in the spellings that plain lines have."""
    damaged = st.binary(min_size=3, max_size=8)
    in_hex = st.tuples(st.sampled_from((" ", "", ":", "-", ",", ", ", "  ")), st.sampled_from(MODBUS + DCON) | damaged)
    in_text = st.sampled_from([wire[:-1].decode() for wire in DCON])
    return in_text | in_hex.map(lambda it: it[0].join(f"{byte:02X}" for byte in it[1]))


@pytest.mark.no_cover
@settings(max_examples=1000, deadline=timedelta(seconds=1))
@given(st.lists(st.sampled_from(TOKENS), max_size=6).map("".join), spelled(), st.sampled_from(ENDS))
def test_a_plain_line_has_the_frame_that_the_whole_search_finds(before: str, frame: str, end: str) -> None:
    line = without_end(before + frame + end)
    plain = find_plain(line)

    assert plain is None or read_line(line).found == (Found(*plain),)


@pytest.mark.parametrize(
    ("line", "kind"),
    [
        ("$012", Kind.DCON),
        ("2026-11-30 12:00:01.123 TX: #01\\r", Kind.DCON),
        ("DEBUG:root:RX b'!010F0600\\r'", Kind.DCON),
        ('"12:00:01","TX","$012"', Kind.DCON),
        ("12:00:01 RX 24 30 31 32 0D", Kind.DCON),
        ("12:00:01 TX 01 04 00 00 00 08 F1 CC", Kind.MODBUS),
        ("[12:00:01][D][uart_debug:114]: >>> 01:04:00:00:00:08:F1:CC", Kind.MODBUS),
        ("01040000000131CA", Kind.MODBUS),
    ],
)
def test_the_lines_that_most_logs_have_are_plain(line: str, kind: Kind) -> None:
    plain = find_plain(line)

    assert plain is not None
    assert plain[0] is kind
