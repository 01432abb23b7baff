"""Functions that convert fields to readings and back: text, percent, hex and Modbus words (manual 1.11, 3.5, A.5).

Laws: a field decodes to the double nearest to the number sent. Numbers that no module of the type sends raise
`DecodeError`, unless `lenient` is set: wrong decimals, or a value more than a tenth of full scale beyond the span
(E121), also in DCON hex. Every register word decodes. A reading is encoded to the nearest count of its format; readings
that the type and format cannot express raise `EncodeError`. Nothing is clamped. Sentinels are compared as text or word
before conversion to a number.
"""

from itertools import repeat
from math import ceil, floor
from operator import le
from types import MethodType
from typing import NamedTuple

from i7000.errors import DecodeError, EncodeError, Fault, shown
from i7000.fields import FIELD_WIDTHS, LEGACY_SENTINELS, TEXT_SENTINELS, TEXT_WIDTH, Status, is_field, not_a_field
from i7000.profile import Profile
from i7000.settings import DataFormat
from i7000.type_codes import TypeCode, Unit

__all__ = [
    "Reading",
    "Status",
    "decode_engineering_word",
    "decode_field",
    "decode_word",
    "encode_engineering_word",
    "encode_field",
    "encode_word",
]


class Reading(NamedTuple):
    """The reading of one channel.

    Unit: `value` is in `unit`, whatever the data format; it is None unless `status` is OK.
    """

    # A named tuple, not an attrs class: every poll makes one a channel, and these are made three times as fast.

    value: float | None
    unit: Unit
    status: Status = Status.OK


# --- DCON fields ------------------------------------------------------------------------------------------------------

_OUT_OF_RANGE_TEXTS = {
    DataFormat.ENGINEERING: {Status.OVER_RANGE: "+9999.9", Status.UNDER_RANGE: "-9999.9"},
    DataFormat.PERCENT: {Status.OVER_RANGE: "+999.99", Status.UNDER_RANGE: "-999.99"},
}
_LEGACY_TEXTS = {status: text for text, status in LEGACY_SENTINELS.items()}


def decode_field(
    field: str, type_code: TypeCode, data_format: DataFormat, *, legacy: bool = False, lenient: bool = False
) -> Reading:
    """Decode the field of one channel in a DCON report.

    Shape: 7 characters in engineering units and percent, 4 in hex; blanks of the same width for a disabled channel.
    Unit: that of the type code. A percentage is one of `TypeCode.full_scale`; of types 07 and 1A, one of their span.
    Special: ``+9999.9`` and ``+999.99`` are over range, ``-9999.9`` and ``-999.99`` under range; with `legacy`
        (`Profile.legacy_sentinels`) ``+9999`` and ``-0000`` too. For hex see `decode_word`.
    Range: the decimals of the type, and up to a tenth of full scale beyond its span; with `lenient`, any.
    Errors: `DecodeError` with `Fault.NUMBER`; with `CHARACTER` for an invalid hex word.
    Manual: 1.11, 2.3; E46, E48, E49, E50, E121.

    >>> decode_field("-025.12", TypeCode.J, DataFormat.ENGINEERING)
    Reading(value=-25.12, unit=<Unit.CELSIUS: 'degC'>, status=<Status.OK: 'ok'>)
    """
    if not is_field(field, data_format, legacy=legacy):
        raise not_a_field(field, 0, data_format)
    if field.isspace():
        return Reading(None, type_code.unit, Status.DISABLED)
    if legacy and field in LEGACY_SENTINELS:
        return Reading(None, type_code.unit, LEGACY_SENTINELS[field])
    if data_format is DataFormat.HEX:
        reading = decode_word(int(field, 16), type_code)
    elif field in TEXT_SENTINELS:
        reading = Reading(None, type_code.unit, TEXT_SENTINELS[field])
    elif data_format is DataFormat.ENGINEERING:
        reading = Reading(float(field), type_code.unit)
    else:
        reading = Reading(_from_part(float(field.replace(".", "")), 10_000, type_code), type_code.unit)
    if not lenient and reading.value is not None and not _is_written(field, reading.value, type_code, data_format):
        allowed = _written(type_code, data_format)
        raise DecodeError(Fault.NUMBER, field.encode(), field="value", allowed=allowed, section="1.11")
    return reading


def _is_written(field: str, value: float, type_code: TypeCode, data_format: DataFormat) -> bool:
    """Return whether a module sends this number with this type (E121)."""
    pointed = data_format is not DataFormat.ENGINEERING or field[-1 - type_code.decimals] == "."
    return pointed and type_code.lowest <= value <= type_code.highest


_NOISE = 6
"""The number of decimals after which a product of floats is noise."""


def _written(type_code: TypeCode, data_format: DataFormat) -> str:
    """Return what a module sends with this type, for messages."""
    low, high, unit = type_code.lowest, type_code.highest, type_code.unit
    if data_format is DataFormat.HEX:
        ends = f"{low:g}..{high:g} {unit}"
    else:
        if data_format is DataFormat.PERCENT:
            low = ceil(round(_percent(low, type_code) * 100, _NOISE)) / 100
            high = floor(round(_percent(high, type_code) * 100, _NOISE)) / 100
        form, _, _ = _TEXTS[data_format, type_code]
        ends = f"{form}..{form}" % (low, high)
    span = f"{type_code.minimum:g}..{type_code.maximum:g} {unit}"
    return f"type {type_code:02X} ({type_code.thermocouple or span}) sends {ends}"


def encode_field(reading: Reading, type_code: TypeCode, data_format: DataFormat, *, legacy: bool = False) -> str:
    """Encode the field of one channel in a DCON report, to the nearest count.

    Special: with `legacy` (`Profile.legacy_sentinels`) out of range is ``+9999`` and ``-0000`` in every format. Zero is
        written with a plus, also if a negative value is rounded to it.
    Errors: `EncodeError` for a value that is not finite, of another unit, or beyond the span of the type (in hex:
        beyond its words, see `encode_word`), and for a value with a status that has no value.
    Manual: 1.11; E48, E49, E50.

    >>> encode_field(Reading(15.0, Unit.MILLIVOLT), TypeCode.MV_15, DataFormat.ENGINEERING)
    '+15.000'
    """
    _check(reading, type_code)
    if reading.status is Status.DISABLED:
        return " " * FIELD_WIDTHS[data_format]
    if legacy and reading.status is not Status.OK:
        return _LEGACY_TEXTS[reading.status]
    if data_format is DataFormat.HEX:
        return f"{encode_word(reading, type_code):04X}"
    if reading.status is not Status.OK:
        return _OUT_OF_RANGE_TEXTS[data_format][reading.status]
    value = _number(reading)
    if data_format is DataFormat.PERCENT:
        value = _percent(value, type_code)
    form, low, high = _TEXTS[data_format, type_code]
    text = form % value
    number = float(text)
    if not low <= number <= high:
        raise _beyond(reading, type_code, type_code.minimum, type_code.maximum)
    return text if number else text.replace("-", "+")


def encode_fields(
    readings: tuple[Reading, ...], types: tuple[TypeCode, ...], data_format: DataFormat, *, legacy: bool = False
) -> tuple[str, ...]:
    """Encode the fields of all channels, channel 0 first; errors as for `encode_field`."""
    if data_format is DataFormat.ENGINEERING and len(set(types)) == 1:
        values, units, statuses = zip(*readings, strict=True)
        form, low, high = _TEXTS[data_format, types[0]]
        if (
            statuses.count(Status.OK) == units.count(types[0].unit) == len(types)
            and {float, Unit}.issuperset(map(type, values + units))
            and False not in [low <= value <= high for value in values]
        ):  # nearly always, so it is done without a step in Python for each channel
            text = form * len(types) % values
            fields = tuple([text[at : at + TEXT_WIDTH] for at in range(0, len(text), TEXT_WIDTH)])
            if _MINUS_ZEROS.isdisjoint(fields):
                return fields
    return tuple(
        [encode_field(reading, code, data_format, legacy=legacy) for reading, code in zip(readings, types, strict=True)]
    )


def decode_numbers(fields: tuple[str, ...], profile: Profile) -> tuple[Reading, ...] | None:
    """Decode the fields of all channels if all are numbers of their types in engineering units, the most common case.

    Special: runs no Python code for each channel. Returns None for any other report: see `decode_fields`.
    """
    numbers = profile.numbers
    if numbers is None:
        return None
    width, points, all_points, lowest, highest = numbers
    line = "".join(fields)
    if len(line) != width:
        return None
    if isinstance(points, slice):
        if line[points] != all_points:
            return None
        values = tuple(map(float, fields))
        ordered = sorted(values)
        within = lowest[0] <= ordered[0] and ordered[-1] <= highest[0]
    else:
        if points(line) != all_points:
            return None
        values = tuple(map(float, fields))
        within = all(map(le, lowest, values)) and all(map(le, values, highest))
    if not within:
        return None
    return tuple(map(_new, _A_READING, zip(values, profile.units, _ALL_OK)))  # noqa: B905 - as many as fields


def decode_fields(
    fields: tuple[str, ...], profile: Profile, data_format: DataFormat, *, lenient: bool = False
) -> tuple[Reading, ...]:
    """Decode the fields of all channels, channel 0 first; `fields` must be of one data format."""
    found = []
    for channel, (field, code) in enumerate(zip(fields, profile.type_codes, strict=True)):
        try:
            found.append(decode_field(field, code, data_format, legacy=profile.legacy_sentinels, lenient=lenient))
        except DecodeError as error:
            name = f"the value of channel {channel}"
            raise DecodeError(error.fault, error.wire, field=name, allowed=error.allowed, section="1.11") from None
    return tuple(found)


_ALL_OK = repeat(Status.OK)
_A_READING = repeat(Reading)
_new = tuple.__new__
make_reading = MethodType(tuple.__new__, Reading)
"""Makes a reading of value, unit and status, faster than `Reading`."""

# --- 16-bit words -----------------------------------------------------------------------------------------------------

_THERMOCOUPLE_WORDS = {0x7FFF: Status.OVER_RANGE, 0x8000: Status.UNDER_RANGE}
_MA_4_20_WORDS = {0x0000: Status.UNDER_RANGE}
_ENGINEERING_WORDS = {0x7FFF: Status.OVER_RANGE, 0x8000: Status.UNDER_RANGE}


def _hex_sentinels(type_code: TypeCode) -> dict[int, Status]:
    if type_code.thermocouple:
        return _THERMOCOUPLE_WORDS
    return _MA_4_20_WORDS if type_code is TypeCode.MA_4_20 else {}


def decode_word(word: int, type_code: TypeCode) -> Reading:
    """Decode the word of one channel in the hex data format, of DCON or Modbus.

    Shape: 0..65535; two's complement except for types 07 and 1A.
    Unit: one count is `TypeCode.full_scale` / 32767 above zero, / 32768 below; types 07 and 1A: their span / 65535.
    Special: 7FFF and 8000 of a thermocouple are over and under range. 0000 of type 07 is under range, although exactly
        4 mA has the same word: engineering text and the range status bits (10129..) tell the two apart.
    Manual: 1.11, A.5; E45, E46, E47, E54.

    >>> decode_word(0xC000, TypeCode.M).value
    -100.0
    """
    _check_word(word)
    status = _hex_sentinels(type_code).get(word)
    if status is not None:
        return Reading(None, type_code.unit, status)
    if not type_code.signed_hex:
        return Reading(_from_part(word, 0xFFFF, type_code), type_code.unit)
    counts = signed(word)
    return Reading(counts * type_code.full_scale / (0x7FFF if counts >= 0 else 0x8000), type_code.unit)


def encode_word(reading: Reading, type_code: TypeCode) -> int:
    """Encode the word of one channel in the hex data format: the word that `decode_word` decodes nearest to the value.

    Special: the full scale of a thermocouple is 7FFF, as printed, and decodes as over range.
    Errors: `EncodeError` for a value that is not finite, of another unit or beyond +/- `TypeCode.full_scale` (types 07
        and 1A: beyond the span), and for a status that has no word with this type.
    Manual: 1.11, A.5; E46, E47, E51.

    >>> f"{encode_word(Reading(-210.0, Unit.CELSIUS), TypeCode.J):04X}"
    'DCA2'
    """
    _check(reading, type_code)
    if reading.status is not Status.OK:
        return _sentinel_word(reading, type_code, _hex_sentinels(type_code))
    value = _number(reading)
    if type_code.signed_hex:
        low, high = -type_code.full_scale, type_code.full_scale
        counts = round(value * (0x7FFF if value >= 0 else 0x8000) / type_code.full_scale)
        within = -0x8000 <= counts <= 0x7FFF
    else:
        low, high = type_code.minimum, type_code.maximum
        counts = round((value - low) * 0xFFFF / (high - low))
        within = 0 <= counts <= 0xFFFF
    if not within:
        raise _beyond(reading, type_code, low, high)
    return counts & 0xFFFF


def decode_engineering_word(word: int, type_code: TypeCode) -> Reading:
    """Decode the word of one channel in the Modbus engineering data format.

    Shape: 0..65535, two's complement.
    Unit: one count is 10 ** -`TypeCode.modbus_decimals` of the type's unit.
    Special: 32767 is over range, -32768 under range.
    Manual: 3.5; E50, E52, E53.

    >>> decode_engineering_word(0xF7CC, TypeCode.J).value
    -210.0
    """
    _check_word(word)
    status = _ENGINEERING_WORDS.get(word)
    if status is not None:
        return Reading(None, type_code.unit, status)
    return Reading(signed(word) / 10**type_code.modbus_decimals, type_code.unit)


def encode_engineering_word(reading: Reading, type_code: TypeCode) -> int:
    """Encode the word of one channel in the Modbus engineering data format, to the nearest count.

    Errors: `EncodeError` for a value that is not finite, of another unit or beyond the span; for a disabled channel.
    Manual: 3.5.

    >>> encode_engineering_word(Reading(1372.0, Unit.CELSIUS), TypeCode.K)
    13720
    """
    _check(reading, type_code)
    if reading.status is not Status.OK:
        return _sentinel_word(reading, type_code, _ENGINEERING_WORDS)
    scale: int = 10**type_code.modbus_decimals
    counts = round(_number(reading) * scale)
    if not type_code.minimum * scale <= counts <= type_code.maximum * scale:
        raise _beyond(reading, type_code, type_code.minimum, type_code.maximum)
    return counts & 0xFFFF


def _check_word(word: int) -> None:
    if not 0 <= word <= 0xFFFF:
        raise DecodeError(Fault.NUMBER, shown(word).encode(), field="word", allowed="0..65535", section="A.5")


def signed(word: int) -> int:
    return word - ((word & 0x8000) << 1)


def _sentinel_word(reading: Reading, type_code: TypeCode, sentinels: dict[int, Status]) -> int:
    for word, status in sentinels.items():
        if status is reading.status:
            return word
    allowed = ", ".join(["ok", *(status.value for status in sentinels.values())])
    raise EncodeError("status", reading.status.value, f"{allowed} for a word of type {type_code:02X}", "1.11")


# --- scales -----------------------------------------------------------------------------------------------------------


def _from_part(part: float, whole: int, type_code: TypeCode) -> float:
    """Return the value at `part` of `whole` of the scale, rounded only once."""
    if type_code.signed_hex:
        return part * type_code.full_scale / whole
    return (type_code.minimum * whole + part * (type_code.maximum - type_code.minimum)) / whole


def _percent(value: float, type_code: TypeCode) -> float:
    if type_code.signed_hex:
        return value * 100 / type_code.full_scale
    return (value - type_code.minimum) * 100 / (type_code.maximum - type_code.minimum)


_TEXTS: dict[tuple[DataFormat, TypeCode], tuple[str, float, float]] = {}
"""The text form of numbers, and their range."""
for _code in TypeCode:
    _low, _high = _code.minimum, _code.maximum
    _TEXTS[DataFormat.ENGINEERING, _code] = (f"%+0{TEXT_WIDTH}.{_code.decimals}f", _low, _high)
    _TEXTS[DataFormat.PERCENT, _code] = (
        f"%+0{TEXT_WIDTH}.2f", round(_percent(_low, _code), 2), round(_percent(_high, _code), 2),
    )  # fmt: skip

_MINUS_ZEROS = frozenset(form % -0.0 for form, _, _ in _TEXTS.values())

_HUGE = 1e9
"""A number beyond every span, and small enough to be scaled."""
_NUMBERS = (int, float)


def _check(reading: Reading, type_code: TypeCode) -> None:
    """Raise `EncodeError` for an invalid reading of a channel of this type, whatever its value."""
    if not isinstance(reading.status, Status):
        raise EncodeError("status", reading.status, "a Status", "1.11")
    if reading.unit is not type_code.unit:
        raise EncodeError("unit", reading.unit, f"{type_code.unit}, the unit of type {type_code:02X}", "1.11")
    if reading.status is not Status.OK and reading.value is not None:
        raise EncodeError("value", reading.value, f"None with status {reading.status.value}", "1.11")


def _number(reading: Reading) -> float:
    """Return the value of a reading that is sent as a number."""
    value = reading.value
    if isinstance(value, bool) or not isinstance(value, _NUMBERS) or not -_HUGE < value < _HUGE:
        raise EncodeError("value", value, "a finite number that a module can measure", "1.11")
    return value


def _beyond(reading: Reading, type_code: TypeCode, low: float, high: float) -> EncodeError:
    return EncodeError("value", reading.value, f"{low:g}..{high:g} {type_code.unit} (type {type_code:02X})", "1.11")
