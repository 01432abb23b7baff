"""What readings refuse, and where two meanings share one field."""

import math
import re
from collections.abc import Callable

import pytest

from i7000 import DataFormat, DecodeError, EncodeError, Fault, Model, Profile, Reading, Status, TypeCode, Unit
from i7000.fields import split_fields
from i7000.readings import (
    decode_engineering_word,
    decode_field,
    decode_fields,
    decode_word,
    encode_engineering_word,
    encode_field,
    encode_fields,
    encode_word,
)

ENCODERS = [
    lambda reading, code: encode_field(reading, code, DataFormat.ENGINEERING),
    lambda reading, code: encode_field(reading, code, DataFormat.PERCENT),
    lambda reading, code: encode_field(reading, code, DataFormat.HEX),
    encode_engineering_word,
]


@pytest.mark.parametrize("encode", ENCODERS, ids=["engineering", "percent", "hex", "modbus engineering"])
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, None, True, "1.0", 10.1, -10.1])
def test_a_value_that_the_format_cannot_say_is_refused(encode: object, value: float) -> None:
    assert callable(encode)

    with pytest.raises(EncodeError, match="value cannot be"):
        encode(Reading(value, Unit.VOLT), TypeCode.V_10)


@pytest.mark.parametrize("encode", ENCODERS, ids=["engineering", "percent", "hex", "modbus engineering"])
def test_a_value_in_another_unit_is_refused(encode: object) -> None:
    assert callable(encode)

    with pytest.raises(EncodeError, match="V, the unit of type 08"):
        encode(Reading(1.0, Unit.MILLIVOLT), TypeCode.V_10)


@pytest.mark.parametrize("encode", ENCODERS, ids=["engineering", "percent", "hex", "modbus engineering"])
@pytest.mark.parametrize("value", [3.99, 20.01])
def test_a_current_beyond_4_to_20_ma_is_refused(encode: object, value: float) -> None:
    assert callable(encode)

    with pytest.raises(EncodeError, match=r"4\.\.20 mA \(type 07\)"):
        encode(Reading(value, Unit.MILLIAMPERE), TypeCode.MA_4_20)


@pytest.mark.parametrize("encode", ENCODERS, ids=["engineering", "percent", "hex", "modbus engineering"])
def test_a_status_that_is_none_is_refused(encode: object) -> None:
    assert callable(encode)

    with pytest.raises(EncodeError, match="status cannot be 'ok': a Status"):
        encode(Reading(1.0, Unit.VOLT, "ok"), TypeCode.V_10)  # type: ignore[arg-type]


def test_a_temperature_below_the_span_has_a_word_but_no_text() -> None:
    reading = decode_word(0x9000, TypeCode.K)

    assert encode_word(reading, TypeCode.K) == 0x9000
    with pytest.raises(EncodeError, match=r"-270\.\.1372 degC"):
        encode_field(reading, TypeCode.K, DataFormat.ENGINEERING)


@pytest.mark.parametrize(
    ("field", "data_format", "fault"),
    [
        ("", DataFormat.ENGINEERING, Fault.NUMBER),
        ("025.12 ", DataFormat.ENGINEERING, Fault.NUMBER),
        ("+025,12", DataFormat.ENGINEERING, Fault.NUMBER),
        ("+02512.", DataFormat.ENGINEERING, Fault.NUMBER),
        ("+1e5.00", DataFormat.ENGINEERING, Fault.NUMBER),
        ("+\u066025.12", DataFormat.ENGINEERING, Fault.NUMBER),
        ("+01.500", DataFormat.PERCENT, Fault.NUMBER),
        ("+9999", DataFormat.ENGINEERING, Fault.NUMBER),
        ("4c53", DataFormat.HEX, Fault.CHARACTER),
        ("+4C5", DataFormat.HEX, Fault.CHARACTER),
        ("4C533", DataFormat.HEX, Fault.CHARACTER),
        ("       ", DataFormat.HEX, Fault.CHARACTER),
    ],
)
def test_a_field_of_another_form_is_refused(field: str, data_format: DataFormat, fault: Fault) -> None:
    with pytest.raises(DecodeError) as caught:
        decode_field(field, TypeCode.V_10, data_format)

    assert fault is caught.value.fault


@pytest.mark.parametrize("decode", [decode_word, decode_engineering_word])
@pytest.mark.parametrize("word", [-1, 65536])
def test_a_word_has_16_bits(decode: object, word: int) -> None:
    assert callable(decode)

    with pytest.raises(DecodeError, match=r"0\.\.65535"):
        decode(word, TypeCode.V_10)


@pytest.mark.parametrize(
    ("status", "code", "word"),
    [
        (Status.OVER_RANGE, TypeCode.K, 0x7FFF),
        (Status.UNDER_RANGE, TypeCode.K, 0x8000),
        (Status.UNDER_RANGE, TypeCode.MA_4_20, 0x0000),
    ],
)
def test_a_status_has_the_word_that_it_is_read_from(status: Status, code: TypeCode, word: int) -> None:
    assert word == encode_word(Reading(None, code.unit, status), code)
    assert status is decode_word(word, code).status


@pytest.mark.parametrize(
    ("status", "code"),
    [
        (Status.OVER_RANGE, TypeCode.V_10),
        (Status.UNDER_RANGE, TypeCode.MA_0_20),
        (Status.OVER_RANGE, TypeCode.MA_4_20),
        (Status.DISABLED, TypeCode.K),
    ],
)
def test_a_status_without_a_word_is_refused(status: Status, code: TypeCode) -> None:
    with pytest.raises(EncodeError, match=f"status cannot be '{status.value}': ok.* for a word of type {code:02X}"):
        encode_word(Reading(None, code.unit, status), code)


@pytest.mark.parametrize(("status", "word"), [(Status.OVER_RANGE, 0x7FFF), (Status.UNDER_RANGE, 0x8000)])
def test_modbus_engineering_words_out_of_range_are_the_same_for_every_type(status: Status, word: int) -> None:
    for code in TypeCode:
        reading = Reading(None, code.unit, status)

        assert word == encode_engineering_word(reading, code)
        assert reading == decode_engineering_word(word, code)


def test_the_full_scale_of_a_thermocouple_has_the_word_of_over_range() -> None:
    assert encode_word(Reading(760.0, Unit.CELSIUS), TypeCode.J) == 0x7FFF
    assert decode_word(0x7FFF, TypeCode.J).status is Status.OVER_RANGE


def test_exactly_4_ma_has_the_word_of_under_range() -> None:
    assert encode_word(Reading(4.0, Unit.MILLIAMPERE), TypeCode.MA_4_20) == 0x0000
    assert decode_word(0x0000, TypeCode.MA_4_20).status is Status.UNDER_RANGE


@pytest.mark.parametrize("text", ["", "+00.000" * 7, "+00.000" * 9, "+00.000" * 7 + "+00.00"])
def test_fields_are_as_many_as_channels(text: str) -> None:
    with pytest.raises(DecodeError) as caught:
        split_fields(text, 8, DataFormat.ENGINEERING)

    assert Fault.LENGTH is caught.value.fault


def test_the_first_bad_field_is_pointed_at() -> None:
    with pytest.raises(DecodeError) as caught:
        split_fields("+00.000" * 2 + "+0a.000" * 6, 8, DataFormat.ENGINEERING)

    assert (caught.value.fault, caught.value.offset) == (Fault.NUMBER, 14)


@pytest.mark.parametrize("value", [0.0, -0.0, -0.0004])
def test_zero_is_written_with_a_plus(value: float) -> None:
    for data_format, field in ((DataFormat.ENGINEERING, "+00.000"), (DataFormat.PERCENT, "+000.00")):
        assert field == encode_field(Reading(value, Unit.VOLT), TypeCode.V_10, data_format)


@pytest.mark.parametrize("data_format", DataFormat)
def test_a_disabled_channel_is_blanks_both_ways(data_format: DataFormat) -> None:
    reading = Reading(None, Unit.VOLT, Status.DISABLED)

    field = encode_field(reading, TypeCode.V_10, data_format)

    assert field.isspace()
    assert reading == decode_field(field, TypeCode.V_10, data_format)


@pytest.mark.parametrize("word", [-1, 0x10000, 10**5000], ids=["negative", "17-bit", "large"])
def test_a_number_that_is_no_word_is_refused(word: int) -> None:
    for decode in (decode_word, decode_engineering_word):
        with pytest.raises(DecodeError) as caught:
            decode(word, TypeCode.K)

        assert Fault.NUMBER is caught.value.fault


# --- what a module of the type writes ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("field", "code", "data_format", "allowed"),
    [
        ("+0152.4", TypeCode.V_10, DataFormat.ENGINEERING, "type 08 (-10..10 V) sends -11.000..+11.000"),
        ("+11.001", TypeCode.V_10, DataFormat.ENGINEERING, "type 08 (-10..10 V) sends -11.000..+11.000"),
        ("+025.12", TypeCode.K, DataFormat.ENGINEERING, "type 0F (K) sends -0407.2..+1509.2"),
        ("+112.51", TypeCode.MA_4_20, DataFormat.PERCENT, "type 07 (4..20 mA) sends -012.50..+112.50"),
        ("-110.01", TypeCode.V_10, DataFormat.PERCENT, "type 08 (-10..10 V) sends -110.00..+110.00"),
        ("9000", TypeCode.K, DataFormat.HEX, "type 0F (K) sends -407.2..1509.2 degC"),
    ],
)
def test_a_number_that_no_module_of_the_type_writes_takes_leniency(
    field: str, code: TypeCode, data_format: DataFormat, allowed: str
) -> None:

    with pytest.raises(DecodeError) as caught:
        decode_field(field, code, data_format)

    assert (caught.value.fault, caught.value.wire, caught.value.allowed) == (Fault.NUMBER, field.encode(), allowed)
    assert decode_field(field, code, data_format, lenient=True).status is Status.OK


@pytest.mark.parametrize("data_format", [DataFormat.ENGINEERING, DataFormat.PERCENT])
@pytest.mark.parametrize("code", TypeCode, ids=lambda code: f"{code:02X}")
def test_the_ends_that_an_error_names_are_read_and_nothing_beyond(code: TypeCode, data_format: DataFormat) -> None:
    decimals = code.decimals if data_format is DataFormat.ENGINEERING else 2
    step = 10.0**-decimals
    with pytest.raises(DecodeError) as caught:
        decode_field(f"{99_998 * step:+07.{decimals}f}", code, data_format)
    ends = re.findall(r"[+-][0-9.]{6}", caught.value.allowed.partition("sends ")[2].replace("..", " "))

    assert len(ends) == 2
    for end, beyond in zip(ends, (-step, step), strict=True):
        assert decode_field(end, code, data_format).status is Status.OK
        with pytest.raises(DecodeError):
            decode_field(f"{float(end) + beyond:+07.{decimals}f}", code, data_format)


@pytest.mark.parametrize("code", TypeCode, ids=lambda code: f"{code:02X}")
def test_texts_of_statuses_are_those_of_every_type(code: TypeCode) -> None:
    for field, status in (("+9999.9", Status.OVER_RANGE), ("-9999.9", Status.UNDER_RANGE), (" " * 7, Status.DISABLED)):
        assert status is decode_field(field, code, DataFormat.ENGINEERING).status
    for field, status in (("+9999", Status.OVER_RANGE), ("-0000", Status.UNDER_RANGE)):
        assert status is decode_field(field, code, DataFormat.ENGINEERING, legacy=True).status


# --- reports ----------------------------------------------------------------------------------------------------------

VOLTS = tuple(Reading(value, Unit.VOLT) for value in (0.0, 1.5, -10.0, 10.0, -0.001, 9.999, 0.0004, 5.0))


def test_a_report_of_one_type_is_written_channel_by_channel() -> None:
    fields = encode_fields(VOLTS, (TypeCode.V_10,) * 8, DataFormat.ENGINEERING)

    assert fields == ("+00.000", "+01.500", "-10.000", "+10.000", "-00.001", "+09.999", "+00.000", "+05.000")


@pytest.mark.parametrize(
    "wrong",
    [
        Reading(10.001, Unit.VOLT),
        Reading(-10.001, Unit.VOLT),
        Reading(math.nan, Unit.VOLT),
        Reading(True, Unit.VOLT),
        Reading(None, Unit.VOLT),
        Reading(1.0, Unit.MILLIVOLT),
        Reading(1.0, "V"),  # type: ignore[arg-type]
        Reading(1.0, Unit.VOLT, Status.OVER_RANGE),
        Reading(1.0, Unit.VOLT, "ok"),  # type: ignore[arg-type]
    ],
    ids=repr,
)
@pytest.mark.parametrize("channel", [0, 7])
def test_one_reading_that_cannot_be_written_is_refused_among_seven_that_can(channel: int, wrong: Reading) -> None:
    readings = [*VOLTS]
    readings[channel] = wrong

    with pytest.raises(EncodeError):
        encode_fields(tuple(readings), (TypeCode.V_10,) * 8, DataFormat.ENGINEERING)


@pytest.mark.parametrize("value", [-0.0, -0.0004])
@pytest.mark.parametrize("channel", [0, 7])
def test_one_zero_below_zero_is_written_with_a_plus_among_seven_others(channel: int, value: float) -> None:
    readings = [*VOLTS]
    readings[channel] = Reading(value, Unit.VOLT)

    assert encode_fields(tuple(readings), (TypeCode.V_10,) * 8, DataFormat.ENGINEERING)[channel] == "+00.000"


def test_a_whole_number_is_written_as_any_other() -> None:
    readings = (*VOLTS[:7], Reading(5, Unit.VOLT))

    assert encode_fields(readings, (TypeCode.V_10,) * 8, DataFormat.ENGINEERING)[7] == "+05.000"


def test_a_report_of_several_types_has_the_decimals_of_each() -> None:
    readings = (Reading(1.5, Unit.VOLT), Reading(25.1, Unit.CELSIUS))

    assert encode_fields(readings, (TypeCode.V_10, TypeCode.K), DataFormat.ENGINEERING) == ("+01.500", "+0025.1")
    assert encode_fields(readings, (TypeCode.V_10, TypeCode.K), DataFormat.PERCENT) == ("+015.00", "+001.83")


@pytest.mark.parametrize(
    ("text", "code", "data_format", "ends"),
    [
        ("+11.001", TypeCode.V_10, DataFormat.ENGINEERING, "08 (-10..10 V) sends -11.000..+11.000"),
        ("+1.0000", TypeCode.V_10, DataFormat.ENGINEERING, "08 (-10..10 V) sends -11.000..+11.000"),
        ("+110.01", TypeCode.V_10, DataFormat.PERCENT, "08 (-10..10 V) sends -110.00..+110.00"),
        ("+200.00", TypeCode.J, DataFormat.PERCENT, "0E (J) sends -037.63..+110.00"),
        ("8001", TypeCode.J, DataFormat.HEX, "0E (J) sends -286..836 degC"),
    ],
)
def test_a_number_that_no_module_sends_is_refused_with_what_it_sends(
    text: str, code: TypeCode, data_format: DataFormat, ends: str
) -> None:
    with pytest.raises(DecodeError) as caught:
        decode_field(text, code, data_format)

    assert str(caught.value) == f"number in value at byte 0 of {text}; allowed: type {ends} (manual 1.11)"
    assert (caught.value.wire, caught.value.field) == (text.encode(), "value")


def test_a_number_of_a_channel_that_no_module_sends_is_refused_with_the_channel() -> None:
    profile = Profile(Model.I_7017, type_codes=(TypeCode.V_10,) * 8)
    texts = ("+01.000", "+11.500") + ("+01.000",) * 6

    with pytest.raises(DecodeError) as caught:
        decode_fields(texts, profile, DataFormat.ENGINEERING)

    assert str(caught.value) == (
        "number in the value of channel 1 at byte 0 of +11.500; allowed: type 08 (-10..10 V) sends -11.000..+11.000"
        " (manual 1.11)"
    )
    assert decode_fields(texts, profile, DataFormat.ENGINEERING, lenient=True)[1].value == 11.5


@pytest.mark.parametrize("decode", [decode_word, decode_engineering_word])
@pytest.mark.parametrize("word", [-1, 65536])
def test_what_is_no_word_is_refused(decode: Callable[[int, TypeCode], Reading], word: int) -> None:
    with pytest.raises(DecodeError) as caught:
        decode(word, TypeCode.V_10)

    assert str(caught.value) == f"number in word at byte 0 of {word}; allowed: 0..65535 (manual A.5)"
    assert caught.value.field == "word"


@pytest.mark.parametrize(
    ("encode", "code", "reading", "message"),
    [
        (
            encode_word, TypeCode.V_10, (None, Status.OVER_RANGE),
            "status cannot be 'over_range': ok for a word of type 08",
        ),
        (
            encode_word, TypeCode.MA_4_20, (None, Status.OVER_RANGE),
            "status cannot be 'over_range': ok, under_range for a word of type 07",
        ),
        (
            encode_engineering_word, TypeCode.V_10, (None, Status.DISABLED),
            "status cannot be 'disabled': ok, over_range, under_range for a word of type 08",
        ),
        (encode_word, TypeCode.V_10, (1.0, Status.OVER_RANGE), "value cannot be 1.0: None with status over_range"),
        (encode_word, TypeCode.V_10, (1.0, "ok"), "status cannot be 'ok': a Status"),
        (
            encode_word, TypeCode.V_10, (math.nan, Status.OK),
            "value cannot be nan: a finite number that a module can measure",
        ),
        (encode_word, TypeCode.V_10, (10.5, Status.OK), "value cannot be 10.5: -10..10 V (type 08)"),
        (encode_word, TypeCode.MA_4_20, (21.0, Status.OK), "value cannot be 21.0: 4..20 mA (type 07)"),
        (encode_engineering_word, TypeCode.V_10, (10.5, Status.OK), "value cannot be 10.5: -10..10 V (type 08)"),
    ],
)  # fmt: skip
def test_a_reading_without_a_word_is_refused_with_the_reason(
    encode: Callable[[Reading, TypeCode], int], code: TypeCode, reading: tuple[float | None, Status], message: str
) -> None:
    value, status = reading
    with pytest.raises(EncodeError) as caught:
        encode(Reading(value, code.unit, status), code)

    assert str(caught.value) == f"{message}, manual 1.11"


def test_a_unit_of_another_type_is_refused_with_the_reason() -> None:
    with pytest.raises(EncodeError, match=r"unit cannot be 'MILLIVOLT': V, the unit of type 08, manual 1.11"):
        encode_word(Reading(1.0, Unit.MILLIVOLT), TypeCode.V_10)


@pytest.mark.parametrize(
    ("code", "ends"),
    [
        (TypeCode.V_10, {-10.0: 0x8000, 10.0: 0x7FFF}),
        (TypeCode.MA_4_20, {4.0: 0x0000, 20.0: 0xFFFF}),
    ],
)
def test_the_ends_have_words_and_one_count_beyond_them_has_none(code: TypeCode, ends: dict[float, int]) -> None:
    (low, first), (high, last) = ends.items()
    count = (high - low) / 0xFFFF

    assert (encode_word(Reading(low, code.unit), code), encode_word(Reading(high, code.unit), code)) == (first, last)
    for value in (low - count, high + count):
        with pytest.raises(EncodeError, match="value cannot be"):
            encode_word(Reading(value, code.unit), code)
