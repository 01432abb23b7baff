"""The compiler of syntax statements."""

import pytest
from attrs import frozen

from i7000 import DecodeError, EncodeError, Fault, Model, Profile, dcon
from i7000.dcon import layout


def test_a_field_without_its_notation_in_the_syntax_is_a_slip_of_ours() -> None:
    @frozen
    class Slip(dcon.Command[dcon.Acknowledged]):
        syntax = "$AA9"
        section = "2.18"

        offset: layout.Offset

    with pytest.raises(TypeError, match=r"Slip: '\$AA9' has no 'SNNNN'"):
        _ = Slip.layout


@pytest.mark.parametrize("data", ["0031.2+", "+0031,2", "+003a.2", "*0031.2"])
def test_a_temperature_is_a_sign_and_five_digits_with_a_point(data: str) -> None:
    with pytest.raises(DecodeError) as caught:
        dcon.decode_response(f">{data}\r".encode(), dcon.ReadCjcTemperature(0x01), Profile(Model.I_7018))

    assert (caught.value.fault, caught.value.offset) == (Fault.NUMBER, 1)


def test_a_name_with_a_leading_character_is_refused() -> None:
    with pytest.raises(DecodeError) as caught:
        dcon.decode_response(b"!0170#18\r", dcon.ReadModuleName(0x01), Profile(Model.I_7018))

    assert caught.value.fault is Fault.CHARACTER


@pytest.mark.parametrize(
    ("digits", "fault", "offset"),
    [
        ("+-000", Fault.CHARACTER, 1),
        ("+000+", Fault.CHARACTER, 4),
        ("-0_10", Fault.CHARACTER, 2),
        ("+ 010", Fault.CHARACTER, 1),
        ("+00g0", Fault.CHARACTER, 3),
        ("00+10", Fault.NUMBER, 0),
    ],
)
def test_an_offset_is_a_sign_and_four_digits(digits: str, fault: Fault, offset: int) -> None:
    profile = Profile(Model.I_7018)
    with pytest.raises(DecodeError) as in_command:
        dcon.decode_command(f"$019{digits}\r".encode(), profile)
    with pytest.raises(DecodeError) as in_response:
        dcon.decode_response(f"!01{digits}\r".encode(), dcon.ReadCjcOffset(0x01), profile)

    assert (fault, len("$019") + offset) == (in_command.value.fault, in_command.value.offset)
    assert (fault, len("!01") + offset) == (in_response.value.fault, in_response.value.offset)


def test_a_calibrated_channel_has_one_digit_in_every_mode() -> None:
    profile = Profile(Model.M_7017Z, single_ended=True)

    assert dcon.encode(dcon.CalibrateChannelZero(0x01, 5), profile, force=True) == b"$010C5\r"


def test_a_calibrated_channel_of_two_digits_is_refused() -> None:
    with pytest.raises(EncodeError, match=r"channel cannot be 16: 0\.\.F"):
        dcon.CalibrateCurrentChannelSpan(0x01, 16)
