"""What holds for every profile, setting, firmware and error."""

import pickle
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import (
    BaudRate,
    CharacterFormat,
    DataFormat,
    DecodeError,
    EncodeError,
    Fault,
    Filter,
    Firmware,
    I7000Error,
    LineSettings,
    ModbusDataFormat,
    Model,
    Noise,
    Profile,
    ReportSettings,
    TypeCode,
    series,
)
from i7000.settings import channels_of, mask_of
from i7000.strategies import errors, firmwares, line_settings, profiles, report_settings

BYTES = range(0x100)
JUNK = st.one_of(st.none(), st.booleans(), st.integers(-5, 300), st.floats(), st.text(), st.binary(), st.just(()))
COMBINATIONS = st.fixed_dictionaries(
    {"model": st.sampled_from(Model)},
    optional={
        "firmware": st.none() | firmwares(),
        "single_ended": st.booleans(),
        "type_codes": st.lists(st.sampled_from(TypeCode), max_size=1).map(tuple)
        | profiles().map(lambda it: it.type_codes),
        "data_format": st.sampled_from(DataFormat),
        "checksum": st.booleans(),
        "modbus_data_format": st.sampled_from(ModbusDataFormat),
    },
)
PROFILE_FIELDS = ("model", "firmware", "single_ended", "type_codes", "data_format", "checksum", "modbus_data_format")


def test_every_byte_of_settings_survives() -> None:
    assert list(BYTES) == [LineSettings.from_byte(byte).byte for byte in BYTES]
    assert list(BYTES) == [ReportSettings.from_byte(byte).byte for byte in BYTES]


@given(line_settings())
def test_line_settings_are_read_as_they_were_written(settings: LineSettings) -> None:
    assert settings == LineSettings.from_byte(settings.byte)


@given(report_settings())
def test_report_settings_are_read_as_they_were_written(settings: ReportSettings) -> None:
    assert settings == ReportSettings.from_byte(settings.byte)


@given(st.integers().filter(lambda number: number not in BYTES))
def test_what_is_no_byte_is_no_settings(number: int) -> None:
    for kind in (LineSettings, ReportSettings):
        with pytest.raises(EncodeError):
            kind.from_byte(number)


@pytest.mark.parametrize("kind", [TypeCode, BaudRate, DataFormat])
@given(code=st.integers(0, 0xFF))
def test_a_code_without_a_member_stays_a_number(kind: type[TypeCode | BaudRate | DataFormat], code: int) -> None:
    found = kind.of(code)

    assert code == found
    assert isinstance(found, kind) == (code in {member.value for member in kind})


def refused_or(make: Callable[[], object]) -> object:
    """What a constructor makes, or the error that it refuses with."""
    try:
        return make()
    except EncodeError as error:
        return error


@given(JUNK | st.sampled_from(BaudRate), JUNK | st.sampled_from(CharacterFormat))
def test_line_settings_of_anything_are_a_byte_or_refused(
    baud_rate: BaudRate, character_format: CharacterFormat
) -> None:
    settings = refused_or(lambda: LineSettings(baud_rate, character_format))

    assert isinstance(settings, EncodeError) or (isinstance(settings, LineSettings) and settings.byte in BYTES)


@given(
    JUNK | st.sampled_from(DataFormat),
    st.fixed_dictionaries(
        {}, optional={"checksum": JUNK, "fast_mode": JUNK, "reserved": JUNK, "filter": JUNK | st.sampled_from(Filter)}
    ),
)
def test_report_settings_of_anything_are_a_byte_or_refused(data_format: DataFormat, others: dict[str, bool]) -> None:
    settings = refused_or(lambda: ReportSettings(data_format, **others))  # type: ignore[arg-type]

    assert isinstance(settings, EncodeError) or (isinstance(settings, ReportSettings) and settings.byte in BYTES)


@given(COMBINATIONS)
def test_every_combination_is_a_profile_or_refused(combination: dict[str, object]) -> None:
    profile = refused_or(lambda: Profile(**combination))  # type: ignore[arg-type]

    if isinstance(profile, Profile):
        assert len(profile.type_codes) in (0, profile.channels)
        assert all(profile.supports(code) for code in profile.type_codes)
    else:
        assert isinstance(profile, EncodeError)
        assert profile.field in PROFILE_FIELDS


@given(st.fixed_dictionaries({"model": st.sampled_from(Model)}, optional=dict.fromkeys(PROFILE_FIELDS[1:], JUNK)))
def test_a_profile_of_anything_is_a_profile_or_refused(values: dict[str, object]) -> None:
    assert isinstance(refused_or(lambda: Profile(**values)), Profile | EncodeError)  # type: ignore[arg-type]


@given(profiles())
def test_a_mask_has_a_place_for_every_channel(profile: Profile) -> None:
    assert profile.channels <= 4 * profile.mask_digits < profile.channels + 8
    assert profile.channels <= 16**profile.channel_digits


@given(st.integers(0, (1 << 20) - 1))
def test_a_mask_is_that_of_its_channels(mask: int) -> None:
    assert mask == mask_of(channels_of(mask))


@given(profiles(), profiles())
def test_equal_profiles_have_equal_hashes(one: Profile, other: Profile) -> None:
    assert one != other or hash(one) == hash(other)
    assert one == pickle.loads(pickle.dumps(one))  # noqa: S301 - our own


@given(firmwares())
def test_a_firmware_is_the_one_that_it_shows(firmware: Firmware) -> None:
    assert firmware == Firmware(str(firmware))
    assert hash(firmware) == hash(Firmware(str(firmware)))


@given(st.lists(firmwares(), max_size=5))
def test_firmwares_come_in_the_order_of_letter_number_and_minor_number(versions: list[Firmware]) -> None:
    def key(firmware: Firmware) -> tuple[str, int, int]:
        return str(firmware)[0], int(str(firmware)[1]), int(str(firmware)[3:])

    assert sorted(versions, key=key) == sorted(versions)


@given(JUNK | st.text(alphabet="AB0123456789."))
def test_any_text_is_a_firmware_or_refused(text: str) -> None:
    assert isinstance(refused_or(lambda: Firmware(text)), Firmware | EncodeError)


@given(st.text() | st.text(alphabet="IM-70189RZ"))
def test_any_text_names_models_or_is_refused(text: str) -> None:
    assert isinstance(refused_or(lambda: series(text)), frozenset | EncodeError)
    assert isinstance(refused_or(lambda: Model.find(text)), Model | EncodeError)


@given(errors())
def test_an_error_survives_pickling(error: I7000Error) -> None:
    copy = pickle.loads(pickle.dumps(error))  # noqa: S301 - our own

    assert (type(error), error.args, str(error)) == (type(copy), copy.args, str(copy))
    assert vars(error) == vars(copy)


@given(errors())
def test_an_error_says_where_it_comes_from(error: I7000Error) -> None:
    assert isinstance(error, EncodeError | DecodeError)
    assert error.section in str(error)


@given(st.binary(), st.sampled_from(Fault))
def test_noise_keeps_its_bytes(wire: bytes, fault: Fault) -> None:
    noise = Noise(wire, fault)

    assert (wire, fault) == (noise.wire, noise.fault)
    assert noise == pickle.loads(pickle.dumps(noise))  # noqa: S301 - our own
