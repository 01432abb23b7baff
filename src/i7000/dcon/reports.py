"""Functions that convert the fields of reports to readings and back, for a profile.

Laws: a field is decoded with the type of its channel, in the data format of the module. `fields` and `field` are the
inverse of `readings` and `reading`.
"""

from collections.abc import Iterable

from i7000.arguments import as_tuple, check_int, check_type
from i7000.dcon.inputs import AnalogInput, AnalogInputs, AnalogInputsHex
from i7000.dcon.sampling import SynchronizedData
from i7000.errors import DecodeError, EncodeError, Fault
from i7000.profile import Profile
from i7000.readings import Reading, decode_field, decode_fields, decode_numbers, encode_field, encode_fields
from i7000.settings import DataFormat
from i7000.type_codes import TypeCode

__all__ = ["field", "fields", "reading", "readings"]

_REPORTS = (AnalogInputs, AnalogInputsHex, SynchronizedData)
"""The responses with a field for each channel."""
_IN_DATA_FORMAT = (AnalogInputs, SynchronizedData)
"""The responses whose fields are in the data format of the profile."""


def readings(
    response: AnalogInputs | AnalogInputsHex | SynchronizedData, profile: Profile, *, lenient: bool = False
) -> tuple[Reading, ...]:
    """Return the readings of a report, channel 0 first.

    Special: with `lenient`, numbers that no module of the type sends are accepted too; use it for modules that differ
        from the manual.
    Errors: `DecodeError` with `Fault.NUMBER` if the profile does not fit: other channels, another data format, unknown
        types, or a number with the wrong decimals or size for its type.
    Manual: 1.11, A.5; E121.

    >>> from i7000 import Model, TypeCode
    >>> report = AnalogInputs(("+025.12",) * 7 + ("-9999.9",))
    >>> [reading.value for reading in readings(report, Profile(Model.I_7018R, type_codes=(TypeCode.J,) * 8))]
    [25.12, 25.12, 25.12, 25.12, 25.12, 25.12, 25.12, None]
    """
    if profile.__class__ is not Profile:
        check_type("profile", profile, Profile)
    if response.__class__ in _IN_DATA_FORMAT and lenient is False:  # nearly always
        found = decode_numbers(response.values, profile)
        if found is not None:
            return found
    check_type("response", response, *_REPORTS)
    check_type("lenient", lenient, bool)
    values, in_hex = response.values, isinstance(response, AnalogInputsHex)
    if len(values) != len(profile.type_codes):
        raise _unknown_types("".join(values), profile)
    return decode_fields(values, profile, DataFormat.HEX if in_hex else profile.data_format, lenient=lenient)


def reading(response: AnalogInput, channel: int, profile: Profile, *, lenient: bool = False) -> Reading:
    """Return the reading of one channel.

    Special: `lenient` as for `readings`.
    Errors: `DecodeError` as for `readings`.
    Manual: 1.11, A.5; E121.
    """
    check_type("response", response, AnalogInput)
    check_type("lenient", lenient, bool)
    types = _types_of(channel, profile)
    if not types:
        raise _unknown_types(response.value, profile)
    return decode_field(response.value, types[0], profile.data_format, legacy=profile.legacy_sentinels, lenient=lenient)


def fields(values: Iterable[Reading], profile: Profile) -> tuple[str, ...]:
    """Encode the fields of a report: the inverse of `readings`.

    Errors: `EncodeError` for a reading that its channel cannot have.
    Manual: 1.11, A.5; E50, E51.

    >>> from i7000 import Model, Unit
    >>> fields([Reading(1.5, Unit.VOLT)] * 8, Profile(Model.I_7017))[0]
    '+01.500'
    """
    if profile.__class__ is not Profile:
        check_type("profile", profile, Profile)
    if values.__class__ is not tuple:
        values = as_tuple("values", values)
    if not {Reading}.issuperset(map(type, values)):
        for value in values:
            check_type("values", value, Reading)
    if len(values) != len(profile.type_codes):
        raise EncodeError("readings", len(values), f"{len(profile.type_codes)}, one for each type code", "1.11")
    return encode_fields(values, profile.type_codes, profile.data_format, legacy=profile.legacy_sentinels)


def field(value: Reading, channel: int, profile: Profile) -> str:
    """Encode the field of one channel: the inverse of `reading`.

    Errors: `EncodeError` for a reading that the channel cannot have, and for a channel of unknown type.
    Manual: 1.11, A.5.
    """
    check_type("value", value, Reading)
    types = _types_of(channel, profile)
    if not types:
        raise EncodeError("channel", channel, f"0..{len(profile.type_codes) - 1}, channels of known type", "1.11")
    return encode_field(value, types[0], profile.data_format, legacy=profile.legacy_sentinels)


def _types_of(channel: int, profile: Profile) -> tuple[TypeCode, ...]:
    """Return the type of one channel as a tuple; empty if the profile does not have the channel."""
    check_type("profile", profile, Profile)
    check_int("channel", channel)
    return profile.type_codes[channel : channel + 1] if channel >= 0 else ()


def _unknown_types(data: str, profile: Profile) -> DecodeError:
    allowed = f"a profile with a type code for each channel; this one has {len(profile.type_codes)}"
    return DecodeError(Fault.NUMBER, data.encode(), field="type_codes", allowed=allowed, section="1.11")
