"""Channel fields as text: their forms, and the lines of a report that are made of them (manual 1.11).

Laws: what a field means is known to `i7000.readings`; here are only its characters, and the texts that stand in the
place of a number.
"""

import re
from collections.abc import Callable
from enum import Enum
from operator import itemgetter

from i7000.errors import DecodeError, Fault
from i7000.settings import DataFormat

__all__ = [
    "FIELD_WIDTHS",
    "LEGACY_SENTINELS",
    "LEGACY_WIDTH",
    "TEXT_SENTINELS",
    "TEXT_WIDTH",
    "Status",
    "are_fields",
    "is_field",
    "not_a_field",
    "split_fields",
]


class Status(Enum):
    """What a reading is worth."""

    OK = "ok"
    OVER_RANGE = "over_range"
    UNDER_RANGE = "under_range"
    DISABLED = "disabled"
    """The channel is switched off and reports blanks."""


TEXT_SENTINELS = {
    "+9999.9": Status.OVER_RANGE,
    "-9999.9": Status.UNDER_RANGE,
    "+999.99": Status.OVER_RANGE,
    "-999.99": Status.UNDER_RANGE,
}
LEGACY_SENTINELS = {"+9999": Status.OVER_RANGE, "-0000": Status.UNDER_RANGE}
"""Of old firmware (`Profile.legacy_sentinels`), in every data format. ``-0000.5`` is not one of them (E49)."""

LEGACY_WIDTH = 5
FIELD_WIDTHS = {DataFormat.ENGINEERING: 7, DataFormat.PERCENT: 7, DataFormat.HEX: 4}
TEXT_WIDTH = FIELD_WIDTHS[DataFormat.ENGINEERING]

_FORMS = {
    DataFormat.ENGINEERING: "sign, five digits and a point among them, or 7 blanks",
    DataFormat.PERCENT: "sign, three digits, point, two digits, or 7 blanks",
    DataFormat.HEX: "four digits 0-9 A-F, or 4 blanks",
}

_TEXT_SHAPE = bytes.maketrans(b"123456789-", b"000000000+")
_SHAPE = {
    DataFormat.ENGINEERING: _TEXT_SHAPE,
    DataFormat.PERCENT: _TEXT_SHAPE,
    DataFormat.HEX: bytes.maketrans(b"123456789ABCDEF", b"000000000000000"),
}
"""Digits as 0 and signs as +: what has the same shape is written in the same form."""
_SHAPES = {
    DataFormat.ENGINEERING: frozenset({b"+0.0000", b"+00.000", b"+000.00", b"+0000.0"}),
    DataFormat.PERCENT: frozenset({b"+000.00"}),
    DataFormat.HEX: frozenset({b"0000"}),
}


def _splitter(count: int, width: int) -> Callable[[str], tuple[str, ...]]:
    if count == 1:
        return lambda text: (text,)
    return itemgetter(*(slice(at * width, (at + 1) * width) for at in range(count)))


_UNIFORM = {
    count: tuple(
        (
            _SHAPE[data_format],
            frozenset(shape * count for shape in _SHAPES[data_format]),
            _splitter(count, FIELD_WIDTHS[data_format]),
        )
        for data_format in sorted(DataFormat)
    )
    for count in (1, 8, 10, 16, 20)
}
"""How lines of which all fields are numbers of one form are known at one glance, and split: by count and format."""


def is_field(field: str, data_format: DataFormat, *, legacy: bool = False) -> bool:
    """Whether `field` is one whole channel field of `data_format`: a number, a sentinel or blanks."""
    if field == " " * FIELD_WIDTHS[data_format] or (legacy and field in LEGACY_SENTINELS):
        return True
    if field.encode("ascii", "replace").translate(_SHAPE[data_format]) in _SHAPES[data_format]:
        return True
    return data_format is DataFormat.PERCENT and field in TEXT_SENTINELS


def split_fields(text: str, count: int, data_format: DataFormat, *, legacy: bool = False) -> tuple[str, ...]:
    """Split the (Data) of a report into the fields of its `count` channels (1, 8, 10, 16 or 20), each as sent.

    Errors: `DecodeError` with `Fault.LENGTH`, `NUMBER` (text) or `CHARACTER` (hex) and the offset in `text`.
    Manual: 1.11, 2.3; E25, E49.

    >>> split_fields("+9999-0000.5-0000", 3, DataFormat.ENGINEERING, legacy=True)
    ('+9999', '-0000.5', '-0000')
    """
    if not legacy:
        shape, uniform, split = _UNIFORM[count][data_format]
        if text.encode().translate(shape) in uniform:
            return split(text)
    width = FIELD_WIDTHS[data_format]
    if legacy:
        fields = tuple(re.findall(_LEGACY_FIELD[data_format], text))
    else:
        fields = tuple(text[at : at + width] for at in range(0, len(text), width))
    if len(fields) != count or (len(text) != count * width and not legacy):
        length = f"{count} fields of {width} characters"
        raise DecodeError(Fault.LENGTH, text.encode(), min(len(text), count * width), allowed=length, section="1.11")
    at = 0
    for field in fields:
        if not is_field(field, data_format, legacy=legacy):
            raise not_a_field(text, at, data_format)
        at += len(field)
    return fields


_LEGACY_FIELD = dict.fromkeys(DataFormat, f"[-+]?[^-+ ]+|[-+]| {{1,{TEXT_WIDTH}}}") | {
    DataFormat.HEX: "[-+].{0,4}|.{1,4}",
}
"""From a sign to the next one or to blanks; in hex, five characters behind a sign and four elsewhere."""


def not_a_field(text: str, at: int, data_format: DataFormat) -> DecodeError:
    """Return the error for a field of another form, which begins at `at`."""
    fault = Fault.CHARACTER if data_format is DataFormat.HEX else Fault.NUMBER
    wire = text.encode("ascii", "backslashreplace")
    return DecodeError(fault, wire, at, field="value", allowed=_FORMS[data_format], section="1.11")


def are_fields(fields: tuple[str, ...]) -> bool:
    """Whether all of `fields` are whole channel fields of some one data format, of whatever firmware."""
    known = _UNIFORM.get(len(fields))
    if known:  # nearly always: all are numbers, which is seen at one glance
        text = "".join(fields)
        shape, uniform, split = known[DataFormat.ENGINEERING]
        if text.encode("ascii", "replace").translate(shape) in uniform and split(text) == fields:
            return True
    return any(all(is_field(field, data_format, legacy=True) for field in fields) for data_format in DataFormat)
