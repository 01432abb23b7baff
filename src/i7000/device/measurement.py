"""What a module makes of its signals: readings, fields, words, range bits (manual 1.11, 2.11, 2.22, 3.2, 3.5).

Laws: every signal has a reading, every reading a field and a word. The model is linear: a thermocouple without
compensation reads its hot end less the cold junction, and an error of the cold junction is an error of the reading
(assumption: the manual has no tables of thermocouples). What is asked for again while nothing has changed is
remembered.
"""

from functools import lru_cache

from i7000.device.signals import Signal, Signals
from i7000.device.state import Eeprom, Inputs, State, profile_of
from i7000.errors import EncodeError
from i7000.models import Model, series
from i7000.readings import Reading, Status, encode_engineering_word, encode_field, encode_word
from i7000.settings import CjcUpdate, DataFormat, ModbusDataFormat
from i7000.type_codes import TypeCode, Unit

__all__ = ["cold_junction", "faults", "fields", "readings", "temperatures", "words"]

_7018_SERIES, _7019_SERIES = series("7018"), series("7019")
_MILLIVOLTS = {Unit.MILLIVOLT: 1.0, Unit.VOLT: 1000.0, Unit.MILLIAMPERE: 125.0}
"""Of one unit at the terminals: a current input has a resistor of 125 ohms across it (1.11)."""
_FAST_STEPS = 0x1000
_REMEMBERED = 256

# --- readings ---------------------------------------------------------------------------------------------------------


def readings(state: State, signals: Signals) -> tuple[Reading, ...]:
    """Tell what the channels read, those included that only the single-ended mode has.

    Special: a disabled channel is `Status.DISABLED`; beyond the span of the type is over or under range, for voltages
        and currents too (assumption); an open thermocouple wire is over range where it is looked for (assumption), and
        else reads as a short circuit does.
    Manual: 1.3, 1.11; E42, E50, E69, E96.
    """
    return _readings(state.inputs, _junction(state, signals), signals)


@lru_cache(_REMEMBERED)
def _readings(inputs: Inputs, junction: float, signals: Signals) -> tuple[Reading, ...]:
    eeprom = inputs.eeprom
    return tuple(_reading(eeprom, junction, signals, channel) for channel in range(len(eeprom.type_codes)))


def _reading(eeprom: Eeprom, junction: float, signals: Signals, channel: int) -> Reading:
    type_code = eeprom.type_codes[channel]
    if not eeprom.channel_mask >> channel & 1:
        return Reading(None, type_code.unit, Status.DISABLED)
    signal = signals.channel(channel)
    if type_code.thermocouple:
        value = _hot(eeprom, signals, signal) - signals.cold_junction + _compensation(eeprom, junction, channel)
    else:
        value = _electrical(signal, type_code.unit)
        if eeprom.model is Model.M_7017RMS:
            value = abs(value)
    if value > type_code.maximum:
        return Reading(None, type_code.unit, Status.OVER_RANGE)
    if value < type_code.minimum:
        return Reading(None, type_code.unit, Status.UNDER_RANGE)
    if eeprom.report_settings.fast_mode:
        value = _in_twelve_bits(value, type_code)
    return Reading(value, type_code.unit)


def _electrical(signal: Signal | None, unit: Unit) -> float:
    """Tell the voltage or current at an input; nothing and thermocouples are as good as 0."""
    if signal is None or signal.unit is Unit.CELSIUS:
        return 0.0
    if signal.unit is unit:
        return signal.value
    return signal.value * _MILLIVOLTS[signal.unit] / _MILLIVOLTS[unit]


def _hot(eeprom: Eeprom, signals: Signals, signal: Signal | None) -> float:
    """Tell the hot end of a thermocouple; voltages and currents drive it out of range, and 0 shorts it."""
    if signal is None:
        return float("inf") if eeprom.open_wire_detection else signals.cold_junction
    if signal.unit is Unit.CELSIUS:
        return signal.value
    return signal.value * float("inf") if signal.value else signals.cold_junction


def _compensation(eeprom: Eeprom, junction: float, channel: int) -> float:
    """Tell what is added to the difference of hot and cold: the cold junction as it is known, and offsets (E62)."""
    own = eeprom.channel_offsets[channel] / 10
    if eeprom.model not in _7019_SERIES:
        return junction + eeprom.cjc_offset / 100 + own if eeprom.cjc_enabled else 0.0
    if eeprom.cjc_enabled:
        own += junction + eeprom.cjc_offset / 100 + eeprom.channel_cjc_offsets[channel] / 100
    return own


def _in_twelve_bits(value: float, type_code: TypeCode) -> float:
    """Round to the steps of the fast mode, of which the span has 4096 (E96); the last is one step below the top."""
    low = -type_code.full_scale if type_code.signed_hex else type_code.minimum
    step = (type_code.maximum - low) / _FAST_STEPS
    return low + min(round((value - low) / step), _FAST_STEPS - 1) * step


# --- the cold junction ------------------------------------------------------------------------------------------------


def _junction(state: State, signals: Signals) -> float:
    """Tell the temperature of the cold junction as the module knows it: of now, or of when its update ended."""
    held = state.ram.held_cold_junction
    return signals.cold_junction if state.ram.cjc_update is CjcUpdate.STARTED or held is None else held


def cold_junction(state: State, signals: Signals) -> float:
    """Tell the temperature of the cold junction as it is reported: with the offset on the 7018 series.

    Manual: 2.11; E29 (the same by Modbus).
    """
    offset = state.eeprom.cjc_offset / 100 if state.eeprom.model in _7018_SERIES else 0.0
    return _junction(state, signals) + offset


# --- how they are told ------------------------------------------------------------------------------------------------

_OUT_OF_RANGE = (Status.OVER_RANGE, Status.UNDER_RANGE)


def faults(state: State, signals: Signals, channels: int) -> tuple[bool, ...]:
    """Tell which channels are on and out of range: all types on the 7019 series, 4..20 and 0..20 mA elsewhere.

    Manual: 2.22, 3.1, 3.4; E14, E58, E71, E84.
    """
    every = state.eeprom.model in _7019_SERIES
    told = zip(state.eeprom.type_codes[:channels], readings(state, signals), strict=False)
    return tuple([(every or not code.signed_hex) and reading.status in _OUT_OF_RANGE for code, reading in told])


def fields(state: State, signals: Signals, data_format: DataFormat | None = None) -> tuple[str, ...]:
    """Tell the fields of a report of all channels, in the module's data format or in one that is given.

    Special: a disabled channel is blanks on the 7019 series, and elsewhere 0 (assumption).
    Manual: 1.11, 2.3; E25, E49.
    """
    if data_format is None:
        data_format = state.profile.data_format
    return _fields(state.inputs, _junction(state, signals), signals, data_format)


@lru_cache(_REMEMBERED)
def _fields(inputs: Inputs, junction: float, signals: Signals, data_format: DataFormat) -> tuple[str, ...]:
    eeprom = inputs.eeprom
    profile = profile_of(eeprom)
    told = list(zip(profile.type_codes, _readings(inputs, junction, signals), strict=False))
    if eeprom.model not in _7019_SERIES:
        told = [(code, _zero_if_disabled(reading, code)) for code, reading in told]
    legacy = profile.legacy_sentinels
    return tuple([_field(reading, code, data_format, legacy=legacy) for code, reading in told])


def _field(value: Reading, type_code: TypeCode, data_format: DataFormat, *, legacy: bool) -> str:
    """Write a reading, or the end of the span that is nearest to what the format cannot say."""
    try:
        return encode_field(value, type_code, data_format, legacy=legacy)
    except EncodeError:
        return encode_field(_clamped(value, type_code), type_code, data_format)


def words(state: State, signals: Signals) -> tuple[int, ...]:
    """Tell the registers of the channels, in the Modbus data format.

    Special: a disabled channel is 0 (assumption).
    Manual: 3.2, 3.5; E83, E97.
    """
    return _words(state.inputs, _junction(state, signals), signals)


@lru_cache(_REMEMBERED)
def _words(inputs: Inputs, junction: float, signals: Signals) -> tuple[int, ...]:
    eeprom = inputs.eeprom
    told = zip(eeprom.type_codes, _readings(inputs, junction, signals), strict=True)
    write = encode_engineering_word if eeprom.modbus_data_format is ModbusDataFormat.ENGINEERING else _hex_word
    return tuple([write(_zero_if_disabled(reading, code), code) for code, reading in told])


def _hex_word(value: Reading, type_code: TypeCode) -> int:
    try:
        return encode_word(value, type_code)
    except EncodeError:
        return encode_word(_clamped(value, type_code), type_code)


def _zero_if_disabled(value: Reading, type_code: TypeCode) -> Reading:
    return Reading(max(0.0, type_code.minimum), value.unit) if value.status is Status.DISABLED else value


def _clamped(value: Reading, type_code: TypeCode) -> Reading:
    """Put the end of the span in the place of a range error that has no word: hex, voltages and currents (E46)."""
    return Reading(type_code.maximum if value.status is Status.OVER_RANGE else type_code.minimum, value.unit)


_OUT_OF_RANGE_DEGREES = {Status.OVER_RANGE: 0x7FFF, Status.UNDER_RANGE: -0x8000, Status.DISABLED: 0}


def temperatures(state: State, signals: Signals) -> tuple[int, ...]:
    """Tell the registers of whole degrees of the M-7018-16 (30033..); 0 for what is no thermocouple (assumption).

    Manual: 3.4.7.
    """
    told = zip(state.eeprom.type_codes, readings(state, signals), strict=True)
    return tuple(
        [
            0 if not code.thermocouple else _OUT_OF_RANGE_DEGREES.get(reading.status, round(reading.value or 0))
            for code, reading in told
        ]
    )
