"""The values of settings: as plain JSON values, and as people write them.

Laws: `typed` accepts what `plain` returns, and the same as text. Nothing is clamped; only rounding errors are rounded.
"""

import re
from collections.abc import Iterable
from decimal import Decimal
from enum import Enum
from typing import Any

from i7000.arguments import is_number
from i7000.errors import InvalidValueError
from i7000.frozen import frozen
from i7000.names import LONGEST_NAME, is_name
from i7000.profile import Profile
from i7000.settings import BaudRate, CharacterFormat, Protocol, channels_of, is_int, mask_of
from i7000.type_codes import TypeCode

__all__ = ["Channels", "Choice", "Name", "Plain", "Quantity", "Values", "choices", "switch", "types"]

PROTOCOLS = {"dcon": Protocol.DCON, "rtu": Protocol.MODBUS_RTU}
"""The words for the protocols."""
Plain = bool | int | float | str | tuple[int, ...]
"""A value of a setting in a snapshot: JSON has all of them; a tuple of channels is an array there."""
_LONGEST_TEXT = 100
_NEARLY = Decimal("1e-6")
"""The rounding error that a number may have, in counts."""


@frozen
class Choice:
    """A few values, each with its plain form.

    Shape: `options` are pairs of plain and typed values; `aliases` more texts for the typed values. `also` are plain
        forms that are read in snapshots, and never written.
    """

    options: tuple[tuple[Plain, Any], ...]
    aliases: tuple[tuple[str, Any], ...] = ()
    also: tuple[str, ...] = ()

    @property
    def unit(self) -> None:
        """The unit: choices have none."""

    @property
    def allowed(self) -> str:
        """The allowed values, for messages."""
        return ", ".join(_text(plain) for plain, _ in self.options)

    def plain(self, name: str, value: object) -> Plain:
        """Return the plain form of a typed value.

        Errors: `InvalidValueError` for an undefined value.
        """
        for plain, typed in self.options:
            if type(typed) is type(value) and typed == value:
                return plain
        raise InvalidValueError(name, value, self.allowed, "")

    def typed(self, name: str, value: object) -> Any:  # noqa: ANN401 - of any setting
        """Return the value of a plain value, of text, or of a typed value.

        Errors: `InvalidValueError` for any other value.
        """
        for plain, typed in self.options:
            if any(type(it) is type(value) and it == value for it in (plain, typed)):
                return typed
        if isinstance(value, str):
            words = {_text(plain).lower(): typed for plain, typed in self.options} | dict(self.aliases)
            if value.strip().lower() in words:
                return words[value.strip().lower()]
        raise InvalidValueError(name, value, self.allowed, "")


@frozen
class Quantity:
    """A number in steps of a unit.

    Shape: `low` and `high` in counts; `per_unit` is how many counts are one unit.
    """

    low: int
    high: int
    per_unit: int = 1
    unit: str | None = None

    @property
    def allowed(self) -> str:
        """The allowed values, for messages."""
        unit = f" {self.unit}" if self.unit else ""
        step = f" in steps of {1 / self.per_unit:g}" if self.per_unit > 1 else ""
        return f"{self.low / self.per_unit:.7g}..{self.high / self.per_unit:.7g}{unit}{step}"

    def plain(self, name: str, value: object) -> Plain:
        """Return a number of the range.

        Errors: `InvalidValueError` for any other value.
        """
        return self.typed(name, value)

    def typed(self, name: str, value: object) -> int | float:
        """Return the number of a number or a text, such as ``2.5`` or ``2.5 s``; hex as ``0x19`` or ``19h`` is counts.

        Errors: `InvalidValueError` for any other value, beyond the range, and between two counts.
        """
        exact: Decimal | int | None = None
        if isinstance(value, str):
            exact = self._read(value)
        elif is_number(value) and not isinstance(value, Enum):
            exact = Decimal(repr(value)) * self.per_unit
        counts = self.low - 1 if exact is None else round(exact)
        if abs(Decimal(exact or 0) - counts) > _NEARLY or not self.low <= counts <= self.high:
            raise InvalidValueError(name, value, self.allowed, "")
        return counts if self.per_unit == 1 else counts / self.per_unit

    def _read(self, text: str) -> Decimal | int | None:
        """Return the counts of a text; None if it is not a number."""
        found = _HEX.fullmatch(text.strip())
        if found:
            return int(found[1] or found[2], 16)
        found = _DECIMAL.fullmatch(text.strip())
        if not found or found[2].lower() not in ("", (self.unit or "").lower()):
            return None
        return Decimal(found[1]) * self.per_unit


_HEX = re.compile(r"0[xX]([0-9A-Fa-f]{1,8})|([0-9A-Fa-f]{1,8})[hH]", re.ASCII)
_DECIMAL = re.compile(r"([-+]?[0-9]{1,10}(?:\.[0-9]{0,9})?) *([A-Za-z]*)", re.ASCII)


@frozen
class Channels:
    """The channels that are on, of `count`; the typed value is a mask."""

    count: int

    @property
    def unit(self) -> None:
        """The unit: channels have none."""

    @property
    def allowed(self) -> str:
        """The allowed values, for messages."""
        return f"channels of 0..{self.count - 1} such as 0-3,5, or all, or none"

    def plain(self, name: str, value: object) -> Plain:
        """Return the channels of a mask, in order.

        Errors: `InvalidValueError` for a channel that the module does not have.
        """
        if not is_int(value, 0, (1 << self.count) - 1):
            raise InvalidValueError(name, value, self.allowed, "")
        return tuple(sorted(channels_of(value)))  # type: ignore[arg-type] # it is an int

    def typed(self, name: str, value: object) -> int:
        """Return the mask of channels: of numbers, or of text such as ``0-3,5``, ``all`` or ``none``.

        Errors: `InvalidValueError` for any other value, and a channel that the module does not have.
        """
        found: Iterable[Any] = (None,)
        if isinstance(value, str):
            found = self._read(value)
        elif isinstance(value, tuple | list | frozenset | set):
            found = value
        if not all(is_int(channel, 0, self.count - 1) for channel in found):
            raise InvalidValueError(name, value, self.allowed, "")
        return mask_of(found)

    def _read(self, text: str) -> Iterable[Any]:
        """Return the channels of a text; a channel that no module has, if it is not one of channels."""
        word = text.strip().lower()
        if word in ("all", "none"):
            return range(self.count if word == "all" else 0)
        found: list[int] = []
        for part in word[:_LONGEST_TEXT].split(","):
            ends = _RANGE.fullmatch(part.strip())
            if not ends or len(word) > _LONGEST_TEXT or int(ends[1]) > int(ends[2] or ends[1]):
                return (None,)
            found += range(int(ends[1]), int(ends[2] or ends[1]) + 1)
        return found


_RANGE = re.compile(r"([0-9]{1,2})(?:-([0-9]{1,2}))?", re.ASCII)


@frozen
class Name:
    """The name of a module."""

    @property
    def unit(self) -> None:
        """The unit: a name has none."""

    @property
    def allowed(self) -> str:
        """The allowed values, for messages."""
        other = "not the text of another response (2, 4 or 6 hex digits, a version, ...)"
        return f"1 to {LONGEST_NAME} characters, {other}"

    def plain(self, name: str, value: object) -> Plain:
        """Return a name.

        Errors: `InvalidValueError` for text that a module cannot have as its name.
        """
        return self.typed(name, value)

    def typed(self, name: str, value: object) -> str:
        """Return a name.

        Errors: `InvalidValueError` for any other value.
        """
        if not isinstance(value, str) or not is_name(value):
            raise InvalidValueError(name, value, self.allowed, "2.33")
        return value


Values = Choice | Quantity | Channels | Name
"""The values that a setting can have."""


def _text(plain: Plain) -> str:
    """Return a plain value as people write it.

    >>> _text(True), _text(9600), _text("K")
    ('yes', '9600', 'K')
    """
    if isinstance(plain, bool):
        return "yes" if plain else "no"
    return str(plain)


def switch() -> Choice:
    """Return the values of a switch.

    >>> switch().typed("fast_mode", "on"), switch().plain("fast_mode", False)
    (True, False)
    """
    words = ("false", False), ("true", True), ("off", False), ("on", True), ("0", False), ("1", True)
    return Choice(((False, False), (True, True)), words)


def choices(kind: type[Enum]) -> Choice:
    """Return the members of an enumeration by their names.

    Special: baud rates are numbers, character formats have capitals, and Modbus RTU is ``rtu``, as in every option.

    >>> choices(BaudRate).typed("baud_rate", "9600"), choices(CharacterFormat).typed("character_format", "e81").name
    (<BaudRate.BAUD_9600: 6>, 'E81')
    """
    if kind is BaudRate:
        return Choice(tuple((rate.bits_per_second, rate) for rate in BaudRate))
    upper = kind is CharacterFormat
    if kind is Protocol:
        whole = Protocol.MODBUS_RTU.name.lower()
        return Choice(tuple(PROTOCOLS.items()), ((whole, Protocol.MODBUS_RTU),), (whole,))
    return Choice(tuple((member.name if upper else member.name.lower(), member) for member in kind))


def types(profile: Profile) -> Choice:
    """Return the types that a module can be set to, by their names; text may have two hex digits too.

    >>> from i7000 import Model
    >>> types(Profile(Model.I_7018)).typed("type_code", "0F").name
    'K'
    """
    codes = [code for code in TypeCode if profile.supports(code)]
    return Choice(tuple((code.name, code) for code in codes), tuple((f"{code:02x}", code) for code in codes))
