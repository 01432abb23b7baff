"""What holds for every reading, in every format and type: much of it is tried out whole."""

from collections import Counter
from collections.abc import Callable
from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import DataFormat, DecodeError, EncodeError, ModbusDataFormat, Reading, Status, TypeCode, Unit
from i7000.fields import are_fields, is_field
from i7000.readings import (
    decode_engineering_word,
    decode_field,
    decode_word,
    encode_engineering_word,
    encode_field,
    encode_fields,
    encode_word,
)
from i7000.strategies import readings, word_readings

pytestmark = pytest.mark.no_cover

each_type = pytest.mark.parametrize("code", TypeCode, ids=lambda code: f"{code:02X}")
WORDS = range(0x10000)
TYPES = st.sampled_from(TypeCode)
FORMATS = st.sampled_from(DataFormat)


def engineering_texts(code: TypeCode) -> list[str]:
    """Every text of the span, made of its digits."""
    places = code.decimals
    low, high = (round(end * 10**places) for end in (code.minimum, code.maximum))
    digits = ((f"{abs(count):05d}", "-" if count < 0 else "+") for count in range(low, high + 1))
    return [f"{sign}{text[: 5 - places]}.{text[5 - places :]}" for text, sign in digits]


def percent_texts(code: TypeCode) -> list[str]:
    """Every text between the printed ends of the type."""
    whole = code.full_scale if code.signed_hex else code.maximum - code.minimum
    zero = 0 if code.signed_hex else code.minimum
    low, high = (round((end - zero) * 10_000 / whole) for end in (code.minimum, code.maximum))
    return [
        f"{'-' if count < 0 else '+'}{abs(count) // 100:03d}.{abs(count) % 100:02d}" for count in range(low, high + 1)
    ]


# --- exactness --------------------------------------------------------------------------------------------------------


@each_type
def test_every_hex_word_is_written_as_it_was_read(code: TypeCode) -> None:
    assert [word for word in WORDS if word != encode_word(decode_word(word, code), code)] == []


@each_type
def test_every_modbus_engineering_word_of_the_span_is_written_as_it_was_read(code: TypeCode) -> None:
    scale = 10**code.modbus_decimals
    counts = range(round(code.minimum * scale), round(code.maximum * scale) + 1)
    words = [0x7FFF, 0x8000, *(count & 0xFFFF for count in counts)]

    assert [word for word in words if word != encode_engineering_word(decode_engineering_word(word, code), code)] == []


@each_type
def test_every_modbus_engineering_word_is_a_reading(code: TypeCode) -> None:
    statuses = Counter(decode_engineering_word(word, code).status for word in WORDS)

    assert statuses == {Status.OK: 0xFFFE, Status.OVER_RANGE: 1, Status.UNDER_RANGE: 1}


@given(TYPES, st.integers(-0x7FFF, 0x7FFE))
def test_a_modbus_engineering_word_beyond_the_span_is_not_written(code: TypeCode, counts: int) -> None:
    scale = 10**code.modbus_decimals
    reading = decode_engineering_word(counts & 0xFFFF, code)
    if code.minimum * scale <= counts <= code.maximum * scale:
        assert encode_engineering_word(reading, code) == counts & 0xFFFF
        return

    with pytest.raises(EncodeError) as caught:
        encode_engineering_word(reading, code)

    assert caught.value.field == "value"


@each_type
@pytest.mark.parametrize(
    ("data_format", "texts"), [(DataFormat.ENGINEERING, engineering_texts), (DataFormat.PERCENT, percent_texts)]
)
def test_every_text_of_the_span_is_a_number_and_written_as_it_was_read(
    code: TypeCode, data_format: DataFormat, texts: Callable[[TypeCode], list[str]]
) -> None:
    read = {text: decode_field(text, code, data_format) for text in texts(code)}

    assert {reading.status for reading in read.values()} == {Status.OK}
    assert [text for text, reading in read.items() if text != encode_field(reading, code, data_format)] == []


@given(TYPES, FORMATS, st.data())
def test_a_reading_of_a_format_is_said_exactly(code: TypeCode, data_format: DataFormat, data: st.DataObject) -> None:
    reading = data.draw(readings(code, data_format))

    assert reading == decode_field(encode_field(reading, code, data_format), code, data_format)


@given(TYPES, st.data())
def test_a_reading_of_a_modbus_word_is_said_exactly(code: TypeCode, data: st.DataObject) -> None:
    in_hex = data.draw(word_readings(code, ModbusDataFormat.HEX))
    in_units = data.draw(word_readings(code, ModbusDataFormat.ENGINEERING))

    assert in_hex == decode_word(encode_word(in_hex, code), code)
    assert in_units == decode_engineering_word(encode_engineering_word(in_units, code), code)


def span(code: TypeCode) -> st.SearchStrategy[float]:
    return st.floats(code.minimum, code.maximum)


@given(TYPES.flatmap(lambda code: st.tuples(st.just(code), span(code))))
def test_a_value_between_two_counts_is_said_by_the_nearer_one(case: tuple[TypeCode, float]) -> None:
    code, value = case
    reading = Reading(value, code.unit)
    width = code.full_scale if code.signed_hex else code.maximum - code.minimum
    steps = {
        10**-code.decimals: decode_field(
            encode_field(reading, code, DataFormat.ENGINEERING), code, DataFormat.ENGINEERING
        ),
        width / 10_000: decode_field(encode_field(reading, code, DataFormat.PERCENT), code, DataFormat.PERCENT),
        width / (0x7FFF if code.signed_hex else 0xFFFF): decode_word(encode_word(reading, code), code),
        10**-code.modbus_decimals: decode_engineering_word(encode_engineering_word(reading, code), code),
    }

    for step, told in steps.items():
        # The ends of some spans have the word of a status.
        assert told.value is None or abs(told.value - value) <= step / 2 * (1 + 1e-9)


@each_type
def test_an_end_of_a_span_that_reads_back_as_a_status_is_one_of_these(code: TypeCode) -> None:
    ends = {end: decode_word(encode_word(Reading(end, code.unit), code), code) for end in (code.minimum, code.maximum)}
    statuses = {end: reading.status for end, reading in ends.items() if reading.status is not Status.OK}

    if code is TypeCode.M:  # full scale is its lower end
        assert statuses == {-200: Status.UNDER_RANGE}
    elif code is TypeCode.MA_4_20:
        assert statuses == {4: Status.UNDER_RANGE}
    elif code.thermocouple:
        assert statuses == {code.maximum: Status.OVER_RANGE}
    else:
        assert statuses == {}


# --- what cannot be said ----------------------------------------------------------------------------------------------

ENCODERS: list[Callable[[Reading, TypeCode], object]] = [
    lambda reading, code: encode_field(reading, code, DataFormat.ENGINEERING),
    lambda reading, code: encode_field(reading, code, DataFormat.PERCENT),
    lambda reading, code: encode_field(reading, code, DataFormat.HEX),
    encode_word,
    encode_engineering_word,
]
each_encoder = pytest.mark.parametrize(
    "encode", ENCODERS, ids=["engineering", "percent", "hex", "word", "engineering-word"]
)


HUGE = 1e300


@each_encoder
@given(code=TYPES, value=st.sampled_from((nan, inf, -inf)))
def test_what_is_not_finite_is_refused(
    encode: Callable[[Reading, TypeCode], object], code: TypeCode, value: float
) -> None:
    with pytest.raises(EncodeError):
        encode(Reading(value, code.unit), code)


@each_encoder
@given(case=TYPES.flatmap(lambda code: st.tuples(st.just(code), st.floats(code.full_scale * 1.001, HUGE))))
def test_what_is_above_the_span_is_refused(
    encode: Callable[[Reading, TypeCode], object], case: tuple[TypeCode, float]
) -> None:
    code, value = case

    with pytest.raises(EncodeError):
        encode(Reading(value, code.unit), code)


@each_encoder
@given(case=TYPES.flatmap(lambda code: st.tuples(st.just(code), st.floats(-HUGE, -code.full_scale * 1.001))))
def test_what_is_below_the_span_is_refused(
    encode: Callable[[Reading, TypeCode], object], case: tuple[TypeCode, float]
) -> None:
    code, value = case

    with pytest.raises(EncodeError):
        encode(Reading(value, code.unit), code)


@pytest.mark.parametrize("encode", ENCODERS[1:])
@pytest.mark.parametrize("value", [1.7e308, -1.7e308])
def test_what_is_too_large_to_be_scaled_is_refused(encode: Callable[[Reading, TypeCode], object], value: float) -> None:
    with pytest.raises(EncodeError):
        encode(Reading(value, Unit.VOLT), TypeCode.V_10)


@each_encoder
def test_what_is_too_large_for_a_float_is_refused(encode: Callable[[Reading, TypeCode], object]) -> None:
    with pytest.raises(EncodeError):
        encode(Reading(10**400, Unit.VOLT), TypeCode.V_10)


@each_encoder
@given(
    code=TYPES,
    reading=st.builds(
        Reading, st.floats() | st.integers() | st.none() | st.text(), st.sampled_from(Unit), st.sampled_from(Status)
    ),
)
def test_any_reading_is_written_or_refused(
    encode: Callable[[Reading, TypeCode], object], code: TypeCode, reading: Reading
) -> None:
    try:
        wire = encode(reading, code)
    except EncodeError as error:
        refused = error
    else:
        assert isinstance(wire, str) or 0 <= int(str(wire)) <= 0xFFFF
        return

    assert refused.field in ("value", "unit", "status")


# --- totality ---------------------------------------------------------------------------------------------------------

FIELDS = st.text() | st.text(alphabet="+-.0123456789 ABCDEFabcdef", max_size=8)


@given(FIELDS, TYPES, FORMATS, st.booleans())
def test_any_text_is_a_reading_or_a_decode_error(
    text: str,
    code: TypeCode,
    data_format: DataFormat,
    legacy: bool,  # noqa: FBT001
) -> None:
    try:
        reading = decode_field(text, code, data_format, legacy=legacy)
    except DecodeError as error:
        fault = error
    else:
        assert reading.unit is code.unit
        assert (reading.value is None) == (reading.status is not Status.OK)
        return

    assert fault.wire == text.encode("ascii", "backslashreplace")


@given(st.integers(), TYPES)
def test_any_number_is_a_word_or_a_decode_error(number: int, code: TypeCode) -> None:
    for decode in (decode_word, decode_engineering_word):
        if number in WORDS:
            assert decode(number, code).unit is code.unit
        else:
            with pytest.raises(DecodeError):
                decode(number, code)


# --- reports ----------------------------------------------------------------------------------------------------------


def some_readings(code: TypeCode) -> st.SearchStrategy[Reading]:
    """Readings of all kinds, most of which can be written."""
    values = st.floats(code.minimum, code.maximum) | st.sampled_from((-1e-9, 0.0, -0.0, nan, inf, 1, 1e9))
    spoilt = st.builds(Reading, values, st.sampled_from(Unit), st.sampled_from(Status))
    return st.one_of(
        values.map(lambda value: Reading(value, code.unit)), readings(code, DataFormat.ENGINEERING), spoilt
    )


@given(st.lists(TYPES, max_size=3) | TYPES.map(lambda code: [code] * 8), FORMATS, st.booleans(), st.data())
def test_a_report_is_written_as_its_fields_are(
    types: list[TypeCode],
    data_format: DataFormat,
    legacy: bool,  # noqa: FBT001 - drawn
    data: st.DataObject,
) -> None:
    found = tuple(data.draw(some_readings(code)) for code in types)
    try:
        alone = [encode_field(it, code, data_format, legacy=legacy) for it, code in zip(found, types, strict=True)]
    except EncodeError:
        with pytest.raises(EncodeError):
            encode_fields(found, tuple(types), data_format, legacy=legacy)
    else:
        assert tuple(alone) == encode_fields(found, tuple(types), data_format, legacy=legacy)


NUMBERS = ("+01.000", "-1.0000")
OTHERS = ("+1.", "0000", "+9999", "+9999.9", "       ", "00000+1", "0001.00", "é" * 7)


def eight_of(*texts: str) -> st.SearchStrategy[list[str]]:
    return st.lists(st.sampled_from(texts), min_size=8, max_size=8)


@given(eight_of(*NUMBERS, *OTHERS) | eight_of(*NUMBERS))
def test_fields_are_fields_if_each_is_one_of_the_same_format(texts: list[str]) -> None:
    each = any(all(is_field(text, data_format, legacy=True) for text in texts) for data_format in DataFormat)

    assert each == are_fields(tuple(texts))
