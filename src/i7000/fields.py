"""Channel fields as text: their forms, and the data of a report that consists of them (manual 1.11).

Laws: this module knows only the characters of a field, and the texts that replace a number; `i7000.readings` decodes
them.
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
    """The status of a reading."""

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
"""The sentinels of old firmware (`Profile.legacy_sentinels`), in every data format. ``-0000.5`` is not one of them
(E49).
"""

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
"""Maps digits to 0 and signs to +: texts of one shape have one form."""
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
"""The lines whose fields are all numbers of one form, by count and format: they are recognized and split at once."""


def is_field(field: str, data_format: DataFormat, *, legacy: bool = False) -> bool:
    """Return whether `field` is one complete channel field of `data_format`: a number, a sentinel or blanks."""
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
"""A field of old firmware: from a sign to the next one or to blanks; in hex, five characters with a sign, else four."""


def not_a_field(text: str, at: int, data_format: DataFormat) -> DecodeError:
    """Return the error for a field of another form, which begins at `at`."""
    fault = Fault.CHARACTER if data_format is DataFormat.HEX else Fault.NUMBER
    wire = text.encode("ascii", "backslashreplace")
    return DecodeError(fault, wire, at, field="value", allowed=_FORMS[data_format], section="1.11")


def are_fields(fields: tuple[str, ...]) -> bool:
    """Return whether all of `fields` are complete channel fields of the same data format, of any firmware."""
    known = _UNIFORM.get(len(fields))
    if known:  # nearly always: all are numbers, which is seen at one glance
        text = "".join(fields)
        shape, uniform, split = known[DataFormat.ENGINEERING]
        if text.encode("ascii", "replace").translate(shape) in uniform and split(text) == fields:
            return True
    return any(all(is_field(field, data_format, legacy=True) for field in fields) for data_format in DataFormat)
