"""Strategies for the values that both protocols share: profiles, settings, readings, errors."""

from collections.abc import Callable, Mapping
from functools import cache
from string import ascii_uppercase
from typing import Any

from attrs import evolve
from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

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
    Protocol,
    Reading,
    ReportSettings,
    Status,
    TypeCode,
    series,
)
from i7000.message import Message
from i7000.readings import decode_engineering_word, decode_field, decode_word

__all__ = [
    "addresses",
    "errors",
    "firmwares",
    "line_settings",
    "profiles",
    "readings",
    "report_settings",
    "word_readings",
]


@cache
def addresses() -> SearchStrategy[int]:
    """Make addresses, 01 first and 00 last."""
    return st.sampled_from((*range(1, 0x100), 0))


# --- models -----------------------------------------------------------------------------------------------------------


@cache
def firmwares() -> SearchStrategy[Firmware]:
    """Make firmware versions, most of them near the versions that added features."""
    deciding = st.builds("B{}.{}".format, st.integers(1, 4), st.integers(0, 9))
    ends = (
        *(f".{minor}" for minor in range(10)),
        *(f"{point}{minor:02}" for point in (".", "") for minor in range(100)),
    )
    any_of_them = st.builds("{}{}{}".format, st.sampled_from(ascii_uppercase), st.integers(0, 9), st.sampled_from(ends))
    return (deciding | any_of_them).map(Firmware)


@cache
def _known_firmwares() -> SearchStrategy[Firmware | None]:
    return st.none() | firmwares()


@st.composite
def profiles(draw: st.DrawFn, *models: Model, known_types: bool = False) -> Profile:
    """Make profiles of `models`, or of all, in every combination that a module has.

    Shape: with `known_types` there is a type code for every channel; without, there may be no type codes.
    """
    model = draw(st.sampled_from(models or tuple(Model)))
    profile = Profile(
        model,
        firmware=draw(_known_firmwares()),
        single_ended=model in series("7017Z") and draw(st.booleans()),
        data_format=draw(st.sampled_from(DataFormat)),
        checksum=draw(st.booleans()),
        modbus_data_format=draw(
            st.sampled_from(ModbusDataFormat if Protocol.MODBUS_RTU in model.protocols else (ModbusDataFormat.HEX,))
        ),
    )
    supported = st.sampled_from(supported_types(profile))
    types = (draw(supported),) * profile.channels
    if profile.individually_configurable and draw(st.booleans()):
        types = draw(st.tuples(*[supported] * profile.channels))
    if not known_types and draw(st.sampled_from((False,) * 9 + (True,))):
        types = ()
    return evolve(profile, type_codes=types)


def is_accepted(message: Message, profile: Profile) -> bool:
    """Return whether the module of `profile` accepts or sends a message."""
    try:
        message.check(profile)
    except EncodeError:
        return False
    return True


def supported_types(profile: Profile) -> list[TypeCode]:
    """Return the types that the module can be set to, the factory type first."""
    codes = [code for code, since in profile.model.type_codes.items() if profile.runs(since)]
    return sorted(codes, key=lambda code: code is not profile.model.default_type)


# --- settings ---------------------------------------------------------------------------------------------------------


def line_settings(profile: Profile | None = None) -> SearchStrategy[LineSettings]:
    """Make line settings: those that the module of `profile` can be set to, or any byte."""

    def settable(line: LineSettings) -> bool:
        if profile is None:
            return True
        plain = line.character_format is CharacterFormat.N81 or profile.has_character_formats
        return plain and isinstance(line.baud_rate, BaudRate)

    every = sorted(map(LineSettings.from_byte, range(0x100)), key=lambda line: line != LineSettings())
    return st.sampled_from([line for line in every if settable(line)])


def report_settings(profile: Profile | None = None) -> SearchStrategy[ReportSettings]:
    """Make report settings: those that the module of `profile` can be set to, or any byte."""

    def settable(report: ReportSettings) -> bool:
        if profile is None:
            return True
        slow = not report.fast_mode or profile.model.fast_mode
        filtered = report.filter is Filter.REJECT_60_HZ or profile.has_filter
        return slow and filtered and isinstance(report.data_format, DataFormat) and not report.reserved

    return st.sampled_from([report for report in map(ReportSettings.from_byte, range(0x100)) if settable(report)])


# --- readings ---------------------------------------------------------------------------------------------------------


def readings(type_code: TypeCode, data_format: DataFormat) -> SearchStrategy[Reading]:
    """Make readings that a DCON field expresses exactly: on the counts of the format, out of range, disabled."""
    if data_format is DataFormat.HEX:
        words = word_readings(type_code, ModbusDataFormat.HEX)
        return _some_of(Status.DISABLED, words.filter(lambda reading: _is_written(reading, type_code)))
    low, high, decimals = text_counts(type_code, data_format)
    numbers = st.integers(low, high).map(
        lambda counts: decode_field(f"{counts / 10**decimals:+07.{decimals}f}", type_code, data_format)
    )
    disabled = _some_of(Status.DISABLED, numbers)
    return _some_of(Status.OVER_RANGE, _some_of(Status.UNDER_RANGE, disabled))


def _is_written(reading: Reading, type_code: TypeCode) -> bool:
    return reading.value is None or type_code.lowest <= reading.value <= type_code.highest


def _some_of(status: Status, others: SearchStrategy[Reading]) -> SearchStrategy[Reading]:
    """Replace one reading in ten by a status."""
    return st.builds(
        lambda reading, chosen: Reading(None, reading.unit, status) if chosen else reading,
        others,
        st.sampled_from((False,) * 9 + (True,)),
    )


def text_counts(type_code: TypeCode, data_format: DataFormat) -> tuple[int, int, int]:
    """Return the lowest and the highest count of the span in a text format, and its digits after the point."""
    low, high = type_code.minimum, type_code.maximum
    if data_format is DataFormat.ENGINEERING:
        scale = 10**type_code.decimals
        return round(low * scale), round(high * scale), type_code.decimals
    if not type_code.signed_hex:
        return 0, 100_00, 2
    return round(low * 100_00 / type_code.full_scale), round(high * 100_00 / type_code.full_scale), 2


def word_readings(type_code: TypeCode, data_format: ModbusDataFormat) -> SearchStrategy[Reading]:
    """Make readings that a 16-bit word expresses exactly, out of range included."""
    if data_format is ModbusDataFormat.HEX:
        return st.integers(0, 0xFFFF).map(lambda word: decode_word(word, type_code))
    scale = 10**type_code.modbus_decimals
    counts = st.integers(round(type_code.minimum * scale), round(type_code.maximum * scale))
    words = counts.map(lambda count: count & 0xFFFF) | st.sampled_from((0x7FFF, 0x8000))
    return words.map(lambda word: decode_engineering_word(word, type_code))


# --- errors -----------------------------------------------------------------------------------------------------------


def errors() -> SearchStrategy[I7000Error]:
    """Make errors of every class."""
    return _encode_errors() | _decode_errors()


def _encode_errors() -> SearchStrategy[EncodeError]:
    values = st.integers() | st.text() | st.none()
    return st.builds(EncodeError, st.text(), values, st.text(), st.text(), st.text())


@st.composite
def _decode_errors(draw: st.DrawFn) -> DecodeError:
    wire = draw(st.binary())
    return DecodeError(
        draw(st.sampled_from(Fault)),
        wire,
        draw(st.integers(0, len(wire))),
        field=draw(st.text()),
        allowed=draw(st.text()),
        section=draw(st.text()),
    )


def _readings() -> SearchStrategy[Reading]:
    choices = st.tuples(st.sampled_from(TypeCode), st.sampled_from(DataFormat))
    return choices.flatmap(lambda choice: readings(*choice))


BY_KIND: Mapping[type, Callable[[], SearchStrategy[Any]]] = {
    DecodeError: _decode_errors,
    EncodeError: _encode_errors,
    Firmware: firmwares,
    I7000Error: errors,
    LineSettings: line_settings,
    Noise: lambda: st.builds(Noise, st.binary(min_size=1), st.sampled_from(Fault)),
    Profile: profiles,
    Reading: _readings,
    ReportSettings: report_settings,
}
"""The strategies of the public classes."""
