"""What the fields of a report mean, which of them are refused, and how they are written."""

import pytest
from attrs import evolve

from i7000 import (
    DataFormat,
    DecodeError,
    EncodeError,
    Fault,
    Firmware,
    Model,
    Profile,
    Reading,
    Status,
    TypeCode,
    Unit,
    dcon,
)

I_7017 = Profile(Model.I_7017)
M_7019R = Profile(Model.M_7019R)


def test_disabled_channels_keep_their_places() -> None:
    data = b">+01.000       -01.000" + b"+00.000" * 5 + b"\r"
    response = dcon.decode_response(data, dcon.ReadAnalogInputs(0x01), M_7019R)
    assert isinstance(response, dcon.AnalogInputs)

    told = dcon.readings(response, M_7019R)

    assert [reading.value for reading in told[:3]] == [1.0, None, -1.0]
    assert Status.DISABLED is told[1].status
    assert response.values == dcon.fields(told, M_7019R)


def test_a_single_reading_has_the_type_of_its_channel() -> None:
    mixed = evolve(M_7019R, type_codes=(TypeCode.V_10,) * 7 + (TypeCode.J,))

    assert Reading(25.13, Unit.CELSIUS) == dcon.reading(dcon.AnalogInput("+025.13"), 7, mixed)


@pytest.mark.parametrize(
    "profile", [Profile(Model.I_7018BL), Profile(Model.M_7019Z)], ids=["unknown types", "ten channels"]
)
def test_readings_need_the_types_of_all_channels(profile: Profile) -> None:
    with pytest.raises(DecodeError, match="a profile with a type code for each channel"):
        dcon.readings(dcon.AnalogInputs(("+00.000",) * 8), profile)


def test_the_fields_of_old_firmware_are_written_as_they_are_read() -> None:
    for data_format in DataFormat:
        old = Profile(Model.I_7018, firmware=Firmware("B1.4"), type_codes=(TypeCode.K,) * 8, data_format=data_format)
        values = [Reading(None, Unit.CELSIUS, status) for status in (Status.OVER_RANGE, Status.UNDER_RANGE)] * 4

        written = dcon.fields(values, old)

        assert written == ("+9999", "-0000") * 4
        assert tuple(values) == dcon.readings(dcon.AnalogInputs(written), old)
        assert dcon.field(values[1], 7, old) == "-0000"


def test_the_field_of_one_channel_is_the_inverse_of_its_reading() -> None:
    assert dcon.field(Reading(1.5, Unit.VOLT), 7, I_7017) == "+01.500"
    for channel in (8, -1):
        with pytest.raises(EncodeError, match="channel cannot be"):
            dcon.field(Reading(1.5, Unit.VOLT), channel, I_7017)


@pytest.mark.parametrize(
    ("reading", "field"),
    [
        (Reading(5.0, Unit.VOLT, Status.DISABLED), "value"),
        (Reading(5.0, Unit.VOLT, Status.OVER_RANGE), "value"),
        (Reading(None, Unit.CELSIUS, Status.OVER_RANGE), "unit"),
        (Reading(None, Unit.VOLT), "value"),
    ],
)
def test_a_reading_that_contradicts_itself_or_its_type_is_refused(reading: Reading, field: str) -> None:
    with pytest.raises(EncodeError) as caught:
        dcon.field(reading, 0, I_7017)

    assert field == caught.value.field


@pytest.mark.parametrize("channel", [8, -1])
def test_a_reading_needs_a_channel_that_is_there(channel: int) -> None:
    with pytest.raises(DecodeError, match="type_codes"):
        dcon.reading(dcon.AnalogInput("+00.000"), channel, I_7017)


@pytest.mark.parametrize("values", [("4C53",) * 8, ("+9999",) * 8])
def test_readings_of_another_data_format_are_refused(values: tuple[str, ...]) -> None:
    with pytest.raises(DecodeError, match="number in the value of channel 0"):
        dcon.readings(dcon.AnalogInputs(values), I_7017)


MIXED_TYPES = evolve(M_7019R, type_codes=(TypeCode.V_10,) * 7 + (TypeCode.K,))


@pytest.mark.parametrize(
    ("profile", "values", "channel"),
    [
        (I_7017, ("+0762.2",) + ("+05.000",) * 7, 0),
        (I_7017, ("+05.000",) * 7 + ("+11.001",), 7),
        (I_7017, ("+05.000",) * 3 + ("-11.001",) + ("+05.000",) * 4, 3),
        (I_7017, ("+05.000",) * 7 + ("+9999",), 7),
        (evolve(I_7017, data_format=DataFormat.PERCENT), ("+110.01",) * 8, 0),
        (MIXED_TYPES, ("+05.000",) * 8, 7),
        (MIXED_TYPES, ("+05.000",) * 6 + ("+12.000", "+0025.1"), 6),
    ],
)
def test_a_reading_that_its_type_cannot_have_is_refused(
    profile: Profile, values: tuple[str, ...], channel: int
) -> None:
    with pytest.raises(DecodeError, match=f"number in the value of channel {channel} ") as caught:
        dcon.readings(dcon.AnalogInputs(values), profile)

    assert (caught.value.fault, caught.value.wire) == (Fault.NUMBER, values[channel].encode())


def test_readings_beyond_the_range_are_those_of_the_module() -> None:
    values = ("+11.000", "-11.000", "+10.001", "+00.000", "+9999.9", "-9999.9", "       ", "-00.001")

    told = dcon.readings(dcon.AnalogInputs(values), I_7017)

    assert [reading.value for reading in told] == [11.0, -11.0, 10.001, 0.0, None, None, None, -0.001]


def test_a_lenient_caller_gets_the_value_that_was_sent() -> None:
    report = dcon.AnalogInputs(("+0762.2",) + ("+05.000",) * 7)

    assert [reading.value for reading in dcon.readings(report, I_7017, lenient=True)] == [762.2] + [5.0] * 7
    assert dcon.reading(dcon.AnalogInput("+0762.2"), 0, I_7017, lenient=True) == Reading(762.2, Unit.VOLT)
    with pytest.raises(DecodeError, match="number in value"):
        dcon.reading(dcon.AnalogInput("+0762.2"), 0, I_7017)


def test_a_lenient_caller_gets_no_text_of_other_firmware() -> None:
    with pytest.raises(DecodeError, match="number in the value of channel 7"):
        dcon.readings(dcon.AnalogInputs(("+05.000",) * 7 + ("+9999",)), I_7017, lenient=True)


def test_numbers_of_one_type_are_read_channel_by_channel() -> None:
    numbers = (0.0, 1.5, -10.0, 10.0, -0.001, 9.999, 11.0, -11.0)

    told = dcon.readings(dcon.AnalogInputs(tuple(f"{number:+07.3f}" for number in numbers)), I_7017)

    assert told == tuple(Reading(number, Unit.VOLT) for number in numbers)


def test_readings_in_percent_are_parts_of_the_full_scale() -> None:
    told = dcon.readings(dcon.AnalogInputs(("+015.00",) * 8), evolve(I_7017, data_format=DataFormat.PERCENT))

    assert [reading.value for reading in told] == [1.5] * 8


def test_channels_of_several_types_are_read_each_by_its_own() -> None:
    told = dcon.readings(dcon.AnalogInputs(("+05.000",) * 7 + ("+0025.1",)), MIXED_TYPES)

    assert [(reading.value, reading.unit) for reading in told[6:]] == [(5.0, Unit.VOLT), (25.1, Unit.CELSIUS)]


def test_hex_readings_are_hex_whatever_the_data_format_is() -> None:
    told = dcon.readings(dcon.AnalogInputsHex(("7FFF",) * 8), I_7017)

    assert [reading.value for reading in told] == [10.0] * 8


def test_fields_are_as_many_as_channels() -> None:
    with pytest.raises(EncodeError, match="readings cannot be 1: 8, one for each type code"):
        dcon.fields([Reading(0.0, Unit.VOLT)], I_7017)
