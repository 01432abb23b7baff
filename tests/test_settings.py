"""Every byte of CC and FF is read and written back; what is no byte, or no setting, is refused."""

from typing import Any

import pytest

from i7000 import (
    BaudRate,
    CharacterFormat,
    DataFormat,
    EncodeError,
    Filter,
    LineSettings,
    ReportSettings,
)


@pytest.mark.parametrize("kind", [LineSettings, ReportSettings])
def test_every_byte_survives(kind: Any) -> None:
    assert list(range(256)) == [kind.from_byte(byte).byte for byte in range(256)]


@pytest.mark.parametrize("kind", [LineSettings, ReportSettings])
@pytest.mark.parametrize("byte", [-1, 256, "x", 1.5, True])
def test_what_is_no_byte_is_refused(kind: Any, byte: Any) -> None:
    with pytest.raises(EncodeError, match="settings"):
        kind.from_byte(byte)


def test_an_undefined_code_stays_a_number() -> None:
    assert LineSettings.from_byte(0x3F).baud_rate == 0x3F
    assert not isinstance(LineSettings.from_byte(0x02).baud_rate, BaudRate)
    assert not isinstance(ReportSettings.from_byte(0x03).data_format, DataFormat)


def test_the_bits_are_where_the_manual_has_them() -> None:
    settings = ReportSettings.from_byte(0xE1)

    assert settings == ReportSettings(DataFormat.PERCENT, checksum=True, fast_mode=True, filter=Filter.REJECT_50_HZ)
    assert ReportSettings.from_byte(0x1C).reserved == 7


@pytest.mark.parametrize(
    ("kind", "values"),
    [
        (LineSettings, {"baud_rate": 64}),
        (LineSettings, {"baud_rate": True}),
        (LineSettings, {"baud_rate": "9600"}),
        (LineSettings, {"character_format": 2}),
        (ReportSettings, {"data_format": 4}),
        (ReportSettings, {"data_format": "hex"}),
        (ReportSettings, {"reserved": 8}),
        (ReportSettings, {"reserved": None}),
        (ReportSettings, {"filter": 50}),
        (ReportSettings, {"checksum": 1}),
        (ReportSettings, {"fast_mode": None}),
    ],
)
def test_a_setting_of_another_kind_is_refused_by_name(kind: Any, values: dict[str, Any]) -> None:
    with pytest.raises(EncodeError) as caught:
        kind(**values)

    assert caught.value.field == next(iter(values))


@pytest.mark.parametrize(
    ("form", "parity", "stop_bits", "bits"),
    [("N81", "N", 1, 10), ("N82", "N", 2, 11), ("E81", "E", 1, 11), ("O81", "O", 1, 11)],
)
def test_a_character_format_has_parity_stop_bits_and_length(form: str, parity: str, stop_bits: int, bits: int) -> None:
    character_format = CharacterFormat[form]

    assert (parity, stop_bits, bits) == (character_format.parity, character_format.stop_bits, character_format.bits)
