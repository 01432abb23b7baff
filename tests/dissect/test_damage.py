"""Lines in which a damaged frame stands, and nothing else."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import Protocol
from i7000.dissect.damage import in_place_of_a_frame
from tests.dissect.strategies import protocols

DCON, MODBUS = Protocol.DCON, Protocol.MODBUS_RTU


@pytest.mark.parametrize(
    ("text", "protocol", "wire"),
    [
        ("-> !0", DCON, b"!0\r"),
        ("12:00:01 RX $01 ", DCON, b"$01\r"),
        ("> +0025.1  ", DCON, b"> +0025.1  \r"),
        (">+0025.1  ", DCON, b">+0025.1  \r"),
        ("$01 \r", DCON, b"$01 \r"),
        ("the port $01", DCON, None),
        ("port opened", DCON, None),
        ("12:00:01 RX 01 04 02", None, b"\x01\x04\x02"),
        ("01 04 02", MODBUS, b"\x01\x04\x02"),
        ("01", MODBUS, b"\x01"),
        ("request 01 04 02", MODBUS, b"\x01\x04\x02"),
        ("01 04 02 of the meter", MODBUS, None),
        ("01 04 02 of the meter", None, None),
        ("01", None, None),
        ("12345", None, None),
        ("-> 1-4-0-0-0-1-49-203", None, bytes.fromhex("01040000000131CB")),
        ("RX: 1, 131, 2, 192, 242", None, bytes.fromhex("018302C0F2")),
        ("12:00:01 Sent: 20 4 0 0 0 D 76 7F", None, bytes.fromhex("20040000000D767F")),
        ("[1, 4, 2, 11, 97, 127, 233]", MODBUS, bytes.fromhex("0104020B617FE9")),
        ("-> 1-4-0-0-0-1-49-203", DCON, None),
        ("1, 2, 3", None, None),
        ("[10, 3, 13, 10, 0, 2, -25, -97]", None, bytes.fromhex("0A030D0A0002E79F")),
        ("1-4-0-0-0-1-49-99", None, None),
        ("0, 1, 2, 3, 4, 5", None, None),
        ("12, 99, 3, 4, 300", None, None),
        ("channels 1, 4, 5, 6, 7", None, None),
        ("00 01 02 03", None, None),
        ("$01", None, None),
        ("", None, None),
    ],
)
def test_what_stands_in_place_of_a_frame_is_found_where_nothing_else_stands_there(
    text: str, protocol: Protocol | None, wire: bytes | None
) -> None:
    assert wire == in_place_of_a_frame(text, protocol)


@given(st.text(), protocols)
def test_no_line_raises(text: str, protocol: Protocol | None) -> None:
    found = in_place_of_a_frame(text, protocol)

    assert found is None or len(found) > 0
