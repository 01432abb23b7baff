"""Words that people type -> values: types, units, channels, choices."""

import re
from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from enum import Enum
from math import isfinite
from typing import TypeVar

from i7000 import MIXED, InvalidValueError, Model, TypeCode, Unit

__all__ = [
    "LineError",
    "UsageError",
    "channel_numbers",
    "choice",
    "member",
    "model",
    "near",
    "plain",
    "quantity",
    "truth",
    "type_code",
    "type_codes",
]


_T = TypeVar("_T")


class UsageError(Exception):
    """Wrong usage of the command line; the message says what to write instead."""

    code = 2
    """The exit code."""


class LineError(UsageError):
    """A port that cannot be opened or is lost, or no answer; the message names it."""

    code = 3


def plain(name: str) -> str:
    """Return a name in lower case, without separators.

    >>> plain("Set-CJC_offset")
    'setcjcoffset'
    """
    return re.sub(r"[-_\s]", "", name).lower()


_MOST_NEAR = 6
"""If a word is a part of more names, the most similar ones are suggested."""


def near(word: str, known: Iterable[str]) -> str:
    """Return the end of a message that suggests what was meant: names with the word in them, or similar ones.

    >>> near("offset", ["cjc_offset", "filter"]), near("fliter", ["cjc_offset", "filter"]), near("?", ["filter"])
    ('; did you mean cjc_offset?', '; did you mean filter?', '')
    """
    names = {plain(name): name for name in known}
    within = [name for name in names if len(word) > 2 and plain(word) in name]
    if not 0 < len(within) <= _MOST_NEAR:
        within = get_close_matches(plain(word), within or names, n=3, cutoff=0.0 if within else 0.5)
    *others, last = [names[name] for name in within] or [""]
    return f"; did you mean {', '.join(others)}{' or ' if others else ''}{last}?" if last else ""


# --- words for values -------------------------------------------------------------------------------------------------


_TRUTH = {"true": True, "yes": True, "on": True, "1": True, "false": False, "no": False, "off": False, "0": False}


def truth(text: str) -> bool:
    """Read true or false."""
    if text.lower() not in _TRUTH:
        raise UsageError(f"{text!r} is not true or false: give one of {', '.join(_TRUTH)}")
    return _TRUTH[text.lower()]


def model(text: str) -> Model:
    """Read the name of a model.

    >>> model("m-7018r").value
    'M-7018R'
    """
    try:
        return Model.find(text)
    except InvalidValueError as refusal:
        every = [one.value for one in Model]
        few = refusal.allowed if len(refusal.allowed.split(", ")) < len(every) else ""
        hint = f": {few}" if few else near(text, every) or "; models have names such as I-7017, M-7018R and M-7019Z"
        raise UsageError(f"there is no model {text!r}{hint}") from None


def choice(text: str, choices: Mapping[str, _T]) -> _T:
    """Read one of a few words, in any case.

    >>> choice("RTU", {"dcon": 0, "rtu": 1})
    1
    """
    if text.lower() not in choices:
        raise UsageError(f"{text!r} is not one of {', '.join(choices)}{near(text, choices)}")
    return choices[text.lower()]


def member(text: str, kind: type[Enum]) -> Enum:
    """Read the name of a member, or its value as a number.

    >>> from i7000 import CharacterFormat
    >>> member("e81", CharacterFormat)
    <CharacterFormat.E81: 2>
    """
    names = {one.name.lower(): one for one in kind} | {f"{one.value:d}": one for one in kind}
    if text.lower() not in names:
        raise UsageError(f"{text!r} is not one of {', '.join(names)}")
    return names[text.lower()]


_TYPES: dict[str, TypeCode] = {code.name: code for code in TypeCode} | {
    code.thermocouple: code for code in TypeCode if len(code.thermocouple) == 1
}


def type_code(text: str) -> TypeCode | int:
    """Read a type: two hex digits, a thermocouple's letter, a name of `TypeCode`, or ``mixed``.

    >>> type_code("0F") is type_code("K") is TypeCode.K
    True
    """
    name = re.sub(r"\W+", "_", text.strip()).upper()
    if name == "MIXED":
        return MIXED
    if name in _TYPES:
        return _TYPES[name]
    if re.fullmatch(r"(?:0X)?[0-9A-F]{2}", name):
        return TypeCode.of(int(name, 16))
    raise UsageError(f"{text!r} is not a type: give two hex digits, or one of {', '.join(_TYPES)}{near(name, _TYPES)}")


def type_codes(text: str) -> tuple[TypeCode, ...]:
    """Read the types of channels, with commas between."""
    codes = [type_code(part) for part in text.split(",")]
    unknown = [f"{code:02X}" for code in codes if not isinstance(code, TypeCode)]
    if unknown:
        raise UsageError(f"type {unknown[0]} is not defined: types are 00..{max(TypeCode):02X}")
    return tuple(code for code in codes if isinstance(code, TypeCode))


_UNITS = {"": None, "v": Unit.VOLT, "mv": Unit.MILLIVOLT, "ma": Unit.MILLIAMPERE} | dict.fromkeys(
    ("degc", "°c", "c"), Unit.CELSIUS
)
_QUANTITY = re.compile(r"([-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?) *([^0-9]*)")


def quantity(text: str) -> tuple[float, Unit | None]:
    """Read a number, and its unit if it has one.

    >>> quantity("1.5"), quantity("-500mV"), quantity("25degC")
    ((1.5, None), (-500.0, <Unit.MILLIVOLT: 'mV'>), (25.0, <Unit.CELSIUS: 'degC'>))
    """
    match = _QUANTITY.fullmatch(text.strip())
    if not match or match[2].lower() not in _UNITS or not isfinite(float(match[1])):
        raise UsageError(f"{text!r} is not a quantity: give a number, with {', '.join(Unit)} or no unit")
    return float(match[1]), _UNITS[match[2].lower()]


def channel_numbers(text: str, count: int, separator: str = ",") -> tuple[int, ...]:
    """Read channels of a module with `count`: numbers and ranges, or ``all``.

    >>> channel_numbers("0-2,5", 8), channel_numbers("all", 3)
    ((0, 1, 2, 5), (0, 1, 2))
    """
    if text.lower() == "all":
        return tuple(range(count))
    found: list[int] = []
    for part in text.split(separator):
        match = re.fullmatch(r"([0-9]{1,3})(?:-([0-9]{1,3}))?", part.strip())
        if not match:
            raise UsageError(f"{part!r} is not a channel: give 0..{count - 1}, a range such as 0-{count - 1}, or all")
        first, last = int(match[1]), int(match[2] or match[1])
        if not first <= last < count:
            raise UsageError(f"there is no channel {part}: 0..{count - 1}")
        found.extend(range(first, last + 1))
    return tuple(found)
