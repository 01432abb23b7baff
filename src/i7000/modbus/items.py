"""The fields of Modbus messages: their values, their ranges, their wire form, and their description in words.

Laws: an `Item` reads back every value that it writes.
"""

from collections.abc import Callable
from typing import Annotated, Any, NamedTuple

from i7000 import describe
from i7000.errors import Fault
from i7000.readings import signed
from i7000.settings import CjcUpdate, LineSettings, Protocol, is_int
from i7000.type_codes import TypeCode


class Item(NamedTuple):
    """One field of a PDU: its values, and how it is written and read."""

    allowed: str
    """The allowed values, for messages."""
    accepts: Callable[[Any], bool]
    """Returns whether the field can have this value."""
    write: str = "{}"
    """The wire form, as an expression of the field."""
    read: Callable[[Any], Any] | None = None
    """Returns the field from its wire form; raises `KeyError` for an undefined one."""
    fault: Fault = Fault.VALUE
    """The fault when `read` raises, or when the field is not accepted."""
    bounds: tuple[int, int] | None = None
    """The range of a plain number; checked before `accepts`, which accepts other kinds of int too."""
    most: int | None = None
    """The maximum number of items of a sequence."""
    role: str = ""
    """The role: ``first`` of several addresses, or the ``count`` of them; empty for any other field."""
    values: Any = None
    """The type of the values, if they are not plain numbers or bytes: an enumeration, bool or settings."""
    describe: Callable[[Any], str] = describe.value
    """Returns the value in words."""

    def __repr__(self) -> str:
        """Return what `help` shows beside a field: the values."""
        return f"<{self.allowed}>"


def _number(low: int, high: int, fault: Fault = Fault.VALUE) -> Item:
    return Item(f"{low}..{high}", lambda value: is_int(value, low, high), fault=fault, bounds=(low, high))


def byte(words: Callable[[int], str] = describe.hex_byte) -> Item:
    """Return an item for a byte that is a number, described with `words`."""
    return _number(0, 0xFF)._replace(describe=words)


def _choice(kind: Any) -> Item:  # noqa: ANN401 - bool or an enumeration of codes
    values = {int(value): value for value in ((False, True) if kind is bool else kind)}
    allowed = " ".join(map(str, values))
    return Item(allowed, lambda value: isinstance(value, kind), read=values.__getitem__, values=kind)


def _sequence(kind: type, most: int, accepts: Callable[[Any], bool]) -> Item:
    def all_accepted(value: object) -> bool:
        return isinstance(value, tuple) and 1 <= len(value) <= most and all(map(accepts, value))

    return Item(
        f"a tuple of 1 to {most} items ({kind.__name__})", all_accepted, fault=Fault.RANGE, most=most,
        describe=lambda bits: " ".join(f"{bit:d}" for bit in bits),
    )  # fmt: skip


def _count(most: int) -> Item:
    return _number(1, most, Fault.RANGE)._replace(role="count")


def _words(most: int) -> Item:
    def all_words(value: object) -> bool:
        if not isinstance(value, tuple) or not 1 <= len(value) <= most:
            return False
        plain = {int}.issuperset(map(type, value))  # nearly always
        return 0 <= min(value) <= max(value) <= 0xFFFF if plain else all(is_int(it, 0, 0xFFFF) for it in value)

    return Item(
        f"a tuple of 1 to {most} items (int)", all_words, fault=Fault.RANGE, most=most,
        describe=lambda words: " ".join(f"{word:04X}" for word in words),
    )  # fmt: skip


def _bits(most: int) -> Item:
    return _sequence(bool, most, lambda value: isinstance(value, bool))


MOST_BITS, MOST_WORDS, MOST_WRITTEN_BITS, MOST_WRITTEN_WORDS = 2000, 125, 1968, 123
"""The limits of what one frame can request or carry."""

Address = Annotated[int, _number(0, 247)._replace(describe=describe.address)]
NewAddress = Annotated[int, byte(describe.address)]
Byte = Annotated[int, byte(describe.value)]
Word = Annotated[int, _number(0, 0xFFFF)]
Start = Annotated[int, _number(0, 0xFFFF)._replace(role="first")]
SignedWord = Annotated[int, _number(-0x8000, 0x7FFF)._replace(write="{} & 0xFFFF", read=signed)]
BitCount = Annotated[int, _count(MOST_BITS)]
WordCount = Annotated[int, _count(MOST_WORDS)]
WrittenBitCount = Annotated[int, _count(MOST_WRITTEN_BITS)]
WrittenWordCount = Annotated[int, _count(MOST_WRITTEN_WORDS)]
Bits = Annotated[tuple[bool, ...], _bits(MOST_BITS)]
Words = Annotated[tuple[int, ...], _words(MOST_WORDS)]
WrittenBits = Annotated[tuple[bool, ...], _bits(MOST_WRITTEN_BITS)]
WrittenWords = Annotated[tuple[int, ...], _words(MOST_WRITTEN_WORDS)]
_COIL = {0xFF00: True, 0x0000: False}
Coil = Annotated[
    bool, Item("True False", lambda it: isinstance(it, bool), "0xFF00 if {} else 0", _COIL.__getitem__, values=bool)
]
Flag = Annotated[bool, _choice(bool)]
ProtocolByte = Annotated[Protocol, _choice(Protocol)]
UpdateByte = Annotated[CjcUpdate, _choice(CjcUpdate)]
TypeCodeByte = Annotated[
    TypeCode | int,
    Item(
        "0..255", lambda it: is_int(it, 0, 0xFF), read=TypeCode.of, values=TypeCode, describe=describe.type_code,
    ),
]  # fmt: skip
LineByte = Annotated[
    LineSettings,
    Item(
        "a LineSettings", lambda it: isinstance(it, LineSettings), "{}.byte", LineSettings.from_byte,
        values=LineSettings, describe=describe.line_settings,
    ),
]  # fmt: skip
ExceptionFunction = Annotated[
    int,
    _number(1, 0x7F)._replace(write="{} | 0x80", read=lambda number: number & 0x7F, describe=describe.hex_byte),
]
Mask = Annotated[int, _number(0, 0xFFFFFF)._replace(describe=describe.mask)]
ResultByte = Annotated[int, byte(lambda result: f"{result:02X}, {'not ' if result else ''}done")]
Name = Annotated[
    bytes, Item("4 bytes", lambda it: isinstance(it, bytes) and len(it) == 4, describe=describe.module_name)
]
