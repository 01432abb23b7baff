"""Errors carry the facts, name them in their text, and survive pickling."""

import pickle
import re
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import (
    DecodeError,
    EncodeError,
    Fault,
    InvalidValueError,
    Model,
    Profile,
    Unit,
    dcon,
    device,
    host,
    modbus,
)
from i7000.errors import written


def test_an_encode_error_names_field_value_allowed_and_section() -> None:
    error = EncodeError("channel", 9, "0..7", "2.4")

    assert str(error) == "channel cannot be 9: 0..7, manual 2.4"


def test_an_encode_error_with_a_reason_shows_it() -> None:
    error = EncodeError("model", "M-7018", "7019 series only", "2.21", "M-7018 has no CJC update setting")

    assert str(error) == "M-7018 has no CJC update setting: 7019 series only, manual 2.21"


def test_an_encode_error_without_a_section_shows_no_section() -> None:
    error = EncodeError("period", 0.0, "more than 0 seconds", "")

    assert str(error) == "period cannot be 0.0: more than 0 seconds"


def test_a_decode_error_names_what_is_wrong_and_where() -> None:
    error = DecodeError(Fault.VALUE, b"~01C2\r", 4, field="enabled", allowed="0 1", section="2.30")

    assert str(error) == r"value in enabled at byte 4 of ~01C2\r; allowed: 0 1 (manual 2.30)"


def test_a_decode_error_of_few_facts_is_short() -> None:
    assert str(DecodeError(Fault.LENGTH, b"")) == "length at byte 0 of an empty frame"


def test_a_long_frame_is_kept_whole_and_shown_in_part() -> None:
    error = DecodeError(Fault.LENGTH, b"x" * 1_000_000, 256)

    assert len(error.wire) == 1_000_000
    assert str(error) == f"length at byte 256 of {'x' * 60}... (1000000 bytes)"


@pytest.mark.parametrize(
    ("wire", "text"),
    [
        (b"$012B6\r", r"$012B6\r"),
        (b"!01\xff\n\r", r"!01\xFF\n\r"),
        (b"~01O\\x41\r", r"~01O\\x41\r"),
        (b"       ", r"\x20" * 7),
        (b" +1 2 ", r"\x20+1 2\x20"),
        (b"01 03", r"01\x2003"),
        (b"01", "01"),
        (b"\x01", r"\x01"),
        (b"", ""),
        (bytes.fromhex("0104000000 08F1CC"), "01 04 00 00 00 08 F1 CC"),
        (bytes(21), "00 " * 19 + "00... (21 bytes)"),
    ],
    ids=repr,
)
def test_a_frame_is_written_as_people_write_it(wire: bytes, text: str) -> None:
    assert written(wire) == text


@given(st.binary(max_size=20) | st.text("0A2 \\x\r", max_size=60).map(str.encode))
def test_a_frame_that_is_not_cut_can_be_read_back(wire: bytes) -> None:
    text = written(wire)
    escape = r"\\(?:x([0-9A-F]{2})|(.))"

    def unescaped(found: "re.Match[str]") -> str:
        return chr(int(found[1], 16)) if found[1] else {"r": "\r", "n": "\n", "t": "\t"}.get(found[2], found[2])

    if re.fullmatch("[0-9A-F]{2}( [0-9A-F]{2})+", text):
        read = bytes.fromhex(text)
    else:
        read = re.sub(escape, unescaped, text).encode("latin-1")

    assert wire == read


@pytest.mark.parametrize("value", [10**5000, -(10**5000), (10**5000,)], ids=["large", "negative", "within"])
def test_a_number_of_any_size_can_be_shown(value: object) -> None:
    error = EncodeError("address", value, "00..FF", "2")

    assert str(error).startswith("address cannot be a value of ")
    assert "with a number too long to print: 00..FF" in str(error)
    assert repr(error).startswith("EncodeError('address', a value of ")
    assert error.value == value


def test_an_error_is_shown_with_its_facts() -> None:
    assert repr(EncodeError("channel", 9, "0..7", "2.4")) == "EncodeError('channel', 9, '0..7', '2.4', '')"


def test_errors_survive_pickling() -> None:
    decode = DecodeError(Fault.VALUE, b"~01C2\r", 4, field="enabled", allowed="0 1", section="2.30")
    encode = EncodeError("model", "M-7018", "7019 series only", "2.21", "reason")

    for error in (decode, encode):
        assert vars(error) == vars(pickle.loads(pickle.dumps(error)))  # noqa: S301


def test_only_what_is_sent_or_what_a_module_can_be_is_an_encode_error() -> None:
    refused: list[type[InvalidValueError]] = []
    for function in (
        lambda: dcon.ReadAnalogInput(0x01, 256),
        lambda: Profile(Model.I_7018, single_ended=True),
        lambda: host.Policy(retries=-1),
        lambda: host.receive(host.Bus[Any](), b"", float("nan")),
        lambda: device.Signal(float("inf"), Unit.VOLT),
        lambda: modbus.RegisterMap(Profile(Model.M_7017)).plan(1, ["filter"]).decode([]),
    ):
        with pytest.raises(InvalidValueError) as caught:
            function()
        refused.append(type(caught.value))

    assert refused == [EncodeError, EncodeError, *[InvalidValueError] * 4]
