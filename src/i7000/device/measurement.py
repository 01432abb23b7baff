"""The measurements of a module: readings, fields, words and range bits (manual 1.11, 2.11, 2.22, 3.2, 3.5).

Laws: every signal has a reading, every reading a field and a word. The model is linear: a thermocouple without
compensation reads its hot end minus the cold junction, and an error of the cold junction is an error of the reading
(E116, assumption: the manual has no thermocouple tables). Results are cached while nothing changes.
"""

from collections.abc import Callable
from functools import lru_cache, partial
from itertools import chain, repeat
from typing import TypeVar

from i7000.device.ram import Sample
from i7000.device.signals import OPEN_WIRE, Signal, Signals
from i7000.device.state import Eeprom, Inputs, State, profile_of
from i7000.errors import EncodeError
from i7000.models import Model, series
from i7000.readings import (
    Reading,
    Status,
    encode_engineering_word,
    encode_field,
    encode_fields,
    encode_word,
    make_reading,
)
from i7000.settings import DataFormat, ModbusDataFormat
from i7000.type_codes import TypeCode, Unit

__all__ = ["cold_junction", "faults", "fields", "readings", "sample", "sampled_fields", "temperatures", "words"]

_7018_SERIES, _7019_SERIES = series("7018"), series("7019")
_MILLIVOLTS = {Unit.MILLIVOLT: 1.0, Unit.VOLT: 1000.0, Unit.MILLIAMPERE: 125.0}
"""The millivolts of one unit at the terminals: a current input has a resistor of 125 ohms across it (1.11)."""
_FAST_STEPS = 0x1000
_REMEMBERED = 256

# --- readings ---------------------------------------------------------------------------------------------------------


def readings(state: State, signals: Signals) -> tuple[Reading, ...]:
    """Return the readings of the channels, including those that only the single-ended mode has.

    Special: a disabled channel is `Status.DISABLED`; beyond the span of the type is over or under range, for voltages
        and currents too (E50, assumption); an open thermocouple wire is over range with open wire detection (E69,
        assumption), and otherwise reads as a short circuit (E116, assumption).
    Manual: 1.3, 1.11; E42, E50, E69, E96, E116, E118, E119, E133.
    """
    return _readings(state.inputs, _junction(state, signals), signals)


@lru_cache(_REMEMBERED)
def _readings(inputs: Inputs, junction: float, signals: Signals) -> tuple[Reading, ...]:
    eeprom = inputs.eeprom
    fast_mode, rms = eeprom.report_settings.fast_mode, eeprom.model is Model.M_7017RMS
    found = []
    for channel, (type_code, signal) in enumerate(
        zip(eeprom.type_codes, chain(signals.channels, repeat(OPEN_WIRE)), strict=False)
    ):
        unit = type_code.unit
        if not eeprom.channel_mask >> channel & 1:
            found.append(Reading(None, unit, Status.DISABLED))
            continue
        if type_code.thermocouple:
            value = _hot(eeprom, signals, signal) - signals.cold_junction + _compensation(eeprom, junction, channel)
        else:
            value = signal.value if signal and signal.unit is unit else _electrical(signal, unit)
            if rms:
                value = abs(value)
        if value > type_code.maximum:
            found.append(Reading(None, unit, Status.OVER_RANGE))
        elif value < type_code.minimum:
            found.append(Reading(None, unit, Status.UNDER_RANGE))
        else:
            value = _in_twelve_bits(value, type_code) if fast_mode else value
            found.append(make_reading((value, unit, Status.OK)))
    return tuple(found)


def _electrical(signal: Signal | None, unit: Unit) -> float:
    """Return the voltage or current at an input in another unit; open inputs and thermocouples are 0."""
    if signal is None or signal.unit is Unit.CELSIUS:
        return 0.0
    return signal.value * _MILLIVOLTS[signal.unit] / _MILLIVOLTS[unit]


def _hot(eeprom: Eeprom, signals: Signals, signal: Signal | None) -> float:
    """Return the hot end of a thermocouple; voltages and currents drive it out of range, and 0 shorts it."""
    if signal is None:
        return float("inf") if eeprom.open_wire_detection else signals.cold_junction
    if signal.unit is Unit.CELSIUS:
        return signal.value
    return signal.value * float("inf") if signal.value else signals.cold_junction


def _compensation(eeprom: Eeprom, junction: float, channel: int) -> float:
    """Return the temperature to add to hot minus cold: the measured cold junction, and offsets (E62, E134)."""
    own = eeprom.channel_offsets[channel] / 10
    if eeprom.model not in _7019_SERIES:
        return junction + eeprom.cjc_offset / 100 + own if eeprom.cjc_enabled else 0.0
    if eeprom.cjc_enabled:
        own += junction + eeprom.cjc_offset / 100 + eeprom.channel_cjc_offsets[channel] / 100
    return own


def _in_twelve_bits(value: float, type_code: TypeCode) -> float:
    """Round to the steps of the fast mode, 4096 over the span (E119); the last is one step below the top."""
    low = -type_code.full_scale if type_code.signed_hex else type_code.minimum
    step = (type_code.maximum - low) / _FAST_STEPS
    return low + min(round((value - low) / step), _FAST_STEPS - 1) * step


# --- the cold junction ------------------------------------------------------------------------------------------------


def _junction(state: State, signals: Signals) -> float:
    """Return the measured temperature of the cold junction: the present one, or that of the last update."""
    held = state.ram.held_cold_junction
    return signals.cold_junction if held is None else held


def cold_junction(state: State, signals: Signals) -> float:
    """Return the reported temperature of the cold junction: with the offset on the 7018 series.

    Manual: 2.11; E29 (the same by Modbus).
    """
    offset = state.eeprom.cjc_offset / 100 if state.eeprom.model in _7018_SERIES else 0.0
    return _junction(state, signals) + offset


# --- reports ----------------------------------------------------------------------------------------------------------

_OUT_OF_RANGE = (Status.OVER_RANGE, Status.UNDER_RANGE)


def faults(state: State, signals: Signals, channels: int) -> tuple[bool, ...]:
    """Return the channels that are on and out of range: all types on the 7019 series, 4..20 and 0..20 mA on others.

    Manual: 2.22, 3.1, 3.4; E14, E58, E71, E84.
    """
    every = state.eeprom.model in _7019_SERIES
    told = zip(state.eeprom.type_codes[:channels], readings(state, signals), strict=False)
    return tuple([(every or not code.signed_hex) and reading.status in _OUT_OF_RANGE for code, reading in told])


def fields(state: State, signals: Signals, data_format: DataFormat | None = None) -> tuple[str, ...]:
    """Return the fields of a report of all channels, in the module's data format or in another one.

    Special: a disabled channel is blanks on the 7019 series; on others it has the value of its register (E25,
        assumption).
    Manual: 1.11, 2.3; E25, E49.
    """
    if data_format is None:
        data_format = state.profile.data_format
    return _fields(state.inputs, _junction(state, signals), signals, data_format)


@lru_cache(_REMEMBERED)
def _fields(inputs: Inputs, junction: float, signals: Signals, data_format: DataFormat) -> tuple[str, ...]:
    profile = profile_of(inputs.eeprom)
    types = profile.type_codes
    told = _readings(inputs, junction, signals)[: len(types)]
    if profile.model not in _7019_SERIES:
        told = _zero_if_disabled(told, types)
    return _written(told, types, data_format, legacy=profile.legacy_sentinels)


def sample(state: State, signals: Signals) -> Sample:
    """Return the sample that ``#**`` keeps: the type of each channel, and its reading."""
    return tuple(zip(state.profile.type_codes, readings(state, signals), strict=False))


def sampled_fields(kept: Sample, data_format: DataFormat) -> tuple[str, ...]:
    """Return the fields of the sample kept by ``#**``; later settings have no effect, except the data format.

    Manual: 2.12; E25, E108.
    """
    types, told = zip(*kept, strict=True)
    return _written(told, types, data_format, legacy=False)


def _written(
    told: tuple[Reading, ...], types: tuple[TypeCode, ...], data_format: DataFormat, *, legacy: bool
) -> tuple[str, ...]:
    """Encode readings, or the nearest end of the span for a reading that the format cannot express."""
    try:
        return encode_fields(told, types, data_format, legacy=legacy)
    except EncodeError:
        return _clamped(partial(encode_field, data_format=data_format, legacy=legacy), told, types)


def words(state: State, signals: Signals) -> tuple[int, ...]:
    """Return the registers of the channels, in the Modbus data format.

    Special: a disabled channel is 0, or the lower end of a type that begins above it (E97, assumption).
    Manual: 3.2, 3.5; E83, E97, E118.
    """
    return _words(state.inputs, _junction(state, signals), signals)


@lru_cache(_REMEMBERED)
def _words(inputs: Inputs, junction: float, signals: Signals) -> tuple[int, ...]:
    types = inputs.eeprom.type_codes
    engineering = inputs.eeprom.modbus_data_format is ModbusDataFormat.ENGINEERING
    told = _zero_if_disabled(_readings(inputs, junction, signals), types)
    write = encode_engineering_word if engineering else encode_word
    try:
        return tuple(map(write, told, types))
    except EncodeError:
        return _clamped(write, told, types)


def _zero_if_disabled(told: tuple[Reading, ...], types: tuple[TypeCode, ...]) -> tuple[Reading, ...]:
    return tuple(
        [
            Reading(max(0.0, code.minimum), code.unit) if reading.status is Status.DISABLED else reading
            for reading, code in zip(told, types, strict=True)
        ]
    )


_Written = TypeVar("_Written", str, int)


def _clamped(
    write: Callable[[Reading, TypeCode], _Written], told: tuple[Reading, ...], types: tuple[TypeCode, ...]
) -> tuple[_Written, ...]:
    """Encode readings; use the nearest end of the span for a range error without a word (E46, E137)."""
    written = []
    for reading, type_code in zip(told, types, strict=True):
        try:
            written.append(write(reading, type_code))
        except EncodeError:
            end = type_code.maximum if reading.status is Status.OVER_RANGE else type_code.minimum
            written.append(write(Reading(end, reading.unit), type_code))
    return tuple(written)


_OUT_OF_RANGE_DEGREES = {Status.OVER_RANGE: 0x7FFF, Status.UNDER_RANGE: -0x8000, Status.DISABLED: 0}


def temperatures(state: State, signals: Signals) -> tuple[int, ...]:
    """Return the registers of whole degrees of the M-7018-16 (30033..); 0 for types that are not thermocouples (E117).

    Manual: 3.4.7.
    """
    told = zip(state.eeprom.type_codes, readings(state, signals), strict=True)
    return tuple(
        [
            0 if not code.thermocouple else _OUT_OF_RANGE_DEGREES.get(reading.status, round(reading.value or 0))
            for code, reading in told
        ]
    )
