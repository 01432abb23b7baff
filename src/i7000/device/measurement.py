"""What a module makes of its signals: readings, fields, words, range bits (manual 1.11, 2.11, 2.22, 3.2, 3.5).

Laws: every signal has a reading, every reading a field and a word. The model is linear: a thermocouple without
compensation reads its hot end less the cold junction, and an error of the cold junction is an error of the reading
(assumption: the manual has no tables of thermocouples).
"""

from i7000.device.signals import Signal, Signals
from i7000.device.state import State
from i7000.errors import EncodeError
from i7000.readings import Reading, Status, encode_engineering_word, encode_field, encode_word
from i7000.settings import CjcUpdate, DataFormat, ModbusDataFormat
from i7000.type_codes import TypeCode, Unit

__all__ = ["cold_junction", "faults", "fields", "reading", "temperature", "word"]

_MILLIVOLTS = {Unit.MILLIVOLT: 1.0, Unit.VOLT: 1000.0, Unit.MILLIAMPERE: 125.0}
"""Of one unit at the terminals: a current input has a resistor of 125 ohms across it (1.11)."""
_FAST_STEPS = 0x1000
_LEGACY_TEXTS = {Status.OVER_RANGE: "+9999", Status.UNDER_RANGE: "-0000"}


def reading(state: State, signals: Signals, channel: int) -> Reading:
    """Tell what a channel reads.

    Special: a disabled channel is `Status.DISABLED`; beyond the span of the type is over or under range, for voltages
        and currents too (assumption); an open thermocouple wire is over range where it is looked for (assumption), and
        else reads as a short circuit does.
    Manual: 1.3, 1.11; E42, E50, E69, E96.
    """
    type_code = state.eeprom.type_codes[channel]
    if not state.eeprom.channel_mask >> channel & 1:
        return Reading(None, type_code.unit, Status.DISABLED)
    signal = signals.channel(channel)
    if type_code.thermocouple:
        value = _temperature(state, signals, channel, signal)
    else:
        value = _electrical(signal, type_code.unit)
        if state.eeprom.model.suffix == "RMS":
            value = abs(value)
    if value > type_code.maximum:
        return Reading(None, type_code.unit, Status.OVER_RANGE)
    if value < type_code.minimum:
        return Reading(None, type_code.unit, Status.UNDER_RANGE)
    if state.eeprom.report_settings.fast_mode:
        value = _in_twelve_bits(value, type_code)
    return Reading(value, type_code.unit)


def _electrical(signal: Signal | None, unit: Unit) -> float:
    """Tell the voltage or current at an input; nothing and thermocouples are as good as 0."""
    if signal is None or signal.unit is Unit.CELSIUS:
        return 0.0
    if signal.unit is unit:
        return signal.value
    return signal.value * _MILLIVOLTS[signal.unit] / _MILLIVOLTS[unit]


def _temperature(state: State, signals: Signals, channel: int, signal: Signal | None) -> float:
    """Tell what a thermocouple input makes of a signal; voltages and currents drive it out of range, 0 shorts it."""
    eeprom = state.eeprom
    if signal is None:
        hot = float("inf") if eeprom.open_wire_detection else signals.cold_junction
    elif signal.unit is Unit.CELSIUS:
        hot = signal.value
    else:
        hot = signal.value * float("inf") if signal.value else signals.cold_junction
    value = hot - signals.cold_junction
    own = eeprom.channel_offsets[channel] / 10
    if eeprom.cjc_enabled:
        of_cjc = eeprom.channel_cjc_offsets[channel] / 100 if eeprom.model.series == "7019" else own
        value += _measured(state, signals) + eeprom.cjc_offset / 100 + of_cjc
    return value + own if eeprom.model.series == "7019" else value


def _in_twelve_bits(value: float, type_code: TypeCode) -> float:
    """Round to the steps of the fast mode, of which the span has 4096 (E96); the last is one step below the top."""
    low = -type_code.full_scale if type_code.signed_hex else type_code.minimum
    step = (type_code.maximum - low) / _FAST_STEPS
    return low + min(round((value - low) / step), _FAST_STEPS - 1) * step


def _measured(state: State, signals: Signals) -> float:
    """Tell the temperature of the cold junction as the module knows it: of now, or of when its update ended."""
    held = state.ram.held_cold_junction
    return signals.cold_junction if state.ram.cjc_update is CjcUpdate.STARTED or held is None else held


def cold_junction(state: State, signals: Signals) -> float:
    """Tell the temperature of the cold junction as it is reported: with the offset on the 7018 series.

    Manual: 2.11; E29 (the same by Modbus).
    """
    offset = state.eeprom.cjc_offset / 100 if state.eeprom.model.series == "7018" else 0.0
    return _measured(state, signals) + offset


def faults(state: State, signals: Signals, channels: int) -> tuple[bool, ...]:
    """Tell which channels are on and out of range: all types on the 7019 series, 4..20 and 0..20 mA elsewhere.

    Manual: 2.22, 3.1, 3.4; E14, E58, E71, E84.
    """
    every = state.eeprom.model.series == "7019"
    return tuple(
        (every or not state.eeprom.type_codes[channel].signed_hex)
        and reading(state, signals, channel).status in (Status.OVER_RANGE, Status.UNDER_RANGE)
        for channel in range(channels)
    )


def fields(
    state: State, signals: Signals, channels: range | None = None, data_format: DataFormat | None = None
) -> tuple[str, ...]:
    """Tell the fields of a report, in the module's data format or in one that is given.

    Special: a disabled channel is blanks on the 7019 series, and elsewhere 0 (assumption).
    Manual: 1.11, 2.3; E25, E49.
    """
    profile = state.profile
    data_format = profile.data_format if data_format is None else data_format
    found = []
    for channel in range(profile.channels) if channels is None else channels:
        type_code, value = state.eeprom.type_codes[channel], reading(state, signals, channel)
        if profile.legacy_sentinels and value.status in _LEGACY_TEXTS:
            found.append(_LEGACY_TEXTS[value.status])
            continue
        if state.eeprom.model.series != "7019":
            value = _zero_if_disabled(value, type_code)
        found.append(_field(value, type_code, data_format))
    return tuple(found)


def _field(value: Reading, type_code: TypeCode, data_format: DataFormat) -> str:
    """Write a reading; what is nearest to 0 from below has a plus."""
    try:
        text = encode_field(value, type_code, data_format)
    except EncodeError:
        return encode_field(_clamped(value, type_code), type_code, data_format)
    is_minus_zero = text[0] == "-" and not text.strip("-0.")
    return encode_field(Reading(0.0, value.unit), type_code, data_format) if is_minus_zero else text


def word(state: State, signals: Signals, channel: int) -> int:
    """Tell the register of a channel, in the Modbus data format.

    Special: a disabled channel is 0 (assumption).
    Manual: 3.2, 3.5; E83, E97.
    """
    type_code = state.eeprom.type_codes[channel]
    value = _zero_if_disabled(reading(state, signals, channel), type_code)
    if state.eeprom.modbus_data_format is ModbusDataFormat.ENGINEERING:
        return encode_engineering_word(value, type_code)
    try:
        return encode_word(value, type_code)
    except EncodeError:
        return encode_word(_clamped(value, type_code), type_code)


def _zero_if_disabled(value: Reading, type_code: TypeCode) -> Reading:
    return Reading(max(0.0, type_code.minimum), value.unit) if value.status is Status.DISABLED else value


def _clamped(value: Reading, type_code: TypeCode) -> Reading:
    """Put the end of the span in the place of a range error that has no word: hex, voltages and currents (E46)."""
    return Reading(type_code.maximum if value.status is Status.OVER_RANGE else type_code.minimum, value.unit)


_OUT_OF_RANGE_DEGREES = {Status.OVER_RANGE: 0x7FFF, Status.UNDER_RANGE: -0x8000}


def temperature(state: State, signals: Signals, channel: int) -> int:
    """Tell the register of whole degrees of the M-7018-16 (30033..); 0 if that is no thermocouple (assumption).

    Manual: 3.4.7.
    """
    if not state.eeprom.type_codes[channel].thermocouple:
        return 0
    value = reading(state, signals, channel)
    if value.status is Status.DISABLED:
        return 0
    return _OUT_OF_RANGE_DEGREES[value.status] if value.value is None else round(value.value)
