"""One statement of a PDU -> its encoder, its decoder and its length.

A message class has its PDU in `pdu`: tokens with a blank between. Two hex digits are a literal byte, ``00`` a reserved
one; ``name`` is a byte of the field of that name, ``name:2`` two bytes, high byte first, ``name:4`` four as they are.
Three tokens have a length of their own and stand last:

* ``name:mask``: a bit for each channel, in 1, 2 or 3 bytes by the profile, high byte first;
* ``name:bits``: a bit an item, the first in bit 0 of the first byte; padding bits are written as 0, and read as any;
* ``name:words``: two bytes an item.

The last two follow ``bytes``, the count of their bytes; ``count:2`` where no field has that name is that of items. The
first use of a class compiles its statement to straight-line code around one `struct.Struct`: encoder, decoder and the
constructor, which checks the values before it sets them.

Laws: the constructor takes exactly the values that a field's `Item` accepts; what is written is read back as it was.
"""

import struct
from collections.abc import Callable, Iterable, Iterator
from functools import partial, update_wrapper
from typing import Annotated, Any, NamedTuple

from attrs import fields

from i7000 import describe
from i7000.errors import DecodeError, EncodeError, Fault
from i7000.frozen import frozen
from i7000.modbus.frame import WordStructs
from i7000.profile import Profile
from i7000.readings import signed
from i7000.settings import CjcUpdate, LineSettings, Protocol, is_int
from i7000.type_codes import TypeCode

# --- fields -----------------------------------------------------------------------------------------------------------


class Item(NamedTuple):
    """What a field of a PDU can be."""

    allowed: str
    """Its values, for messages."""
    accepts: Callable[[Any], bool]
    """Whether the field can have this value."""
    write: str = "{}"
    """What is on the wire, as an expression of the field."""
    read: Callable[[Any], Any] | None = None
    """The field from what is on the wire; `KeyError` where that means nothing."""
    fault: Fault = Fault.VALUE
    """What is wrong when `read` raises, or when what was read is not accepted."""
    bounds: tuple[int, int] | None = None
    """The range of a plain number: what is looked at before `accepts` is asked, which takes other kinds of int too."""
    most: int | None = None
    """The most items of a sequence."""
    values: Any = None
    """The type of its values where they are more than numbers or bytes: an enumeration, bool or settings."""
    describe: Callable[[Any], str] = describe.value
    """The value in words."""

    def __repr__(self) -> str:
        """What `help` shows beside a field: the values."""
        return f"<{self.allowed}>"


def _number(low: int, high: int, fault: Fault = Fault.VALUE) -> Item:
    return Item(f"{low}..{high}", lambda value: is_int(value, low, high), fault=fault, bounds=(low, high))


def byte(words: Callable[[int], str] = describe.hex_byte) -> Item:
    """A byte that is a number, described with `words`."""
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
"""What one frame may ask for or carry."""

Address = Annotated[int, _number(0, 247)._replace(describe=describe.hex_byte)]
NewAddress = Annotated[int, byte()]
Byte = Annotated[int, byte(describe.value)]
Word = Annotated[int, _number(0, 0xFFFF)]
SignedWord = Annotated[int, _number(-0x8000, 0x7FFF)._replace(write="{} & 0xFFFF", read=signed)]
BitCount = Annotated[int, _number(1, MOST_BITS, Fault.RANGE)]
WordCount = Annotated[int, _number(1, MOST_WORDS, Fault.RANGE)]
WrittenBitCount = Annotated[int, _number(1, MOST_WRITTEN_BITS, Fault.RANGE)]
WrittenWordCount = Annotated[int, _number(1, MOST_WRITTEN_WORDS, Fault.RANGE)]
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

# --- bits and words ---------------------------------------------------------------------------------------------------


_WORDS = WordStructs(">")


def _pack_words(words: tuple[int, ...]) -> bytes:
    return _WORDS[len(words)].pack(*words)


def _pack_bits(bits: tuple[bool, ...]) -> bytes:
    number = sum(1 << at for at, bit in enumerate(bits) if bit)
    return number.to_bytes((len(bits) + 7) >> 3, "little")


def _unpack_bits(data: bytes) -> tuple[bool, ...]:
    return tuple([bool(byte >> at & 1) for byte in data for at in range(8)])


# --- layouts ----------------------------------------------------------------------------------------------------------

_WIDTHS = {"B": 1, "H": 2, "4s": 4}
_FORMS = {"": "B", "2": "H", "4": "4s"}
_ADDRESSES = 0x10000
_WITH_SUB_FUNCTIONS = 0x46


class Token(NamedTuple):
    """One token of a PDU."""

    name: str
    """The field it is for; empty for a literal."""
    form: str
    """``B``, ``H`` or ``4s`` as of `struct`; or ``mask``, ``bits``, ``words``."""
    literal: int = 0

    @property
    def width(self) -> int:
        """Bytes; 0 for a token that has a length of its own."""
        return _WIDTHS.get(self.form, 0)


def tokens_of(pdu: str) -> tuple[Token, ...]:
    """Read a statement; the address stands before every PDU."""
    tokens = [Token("address", "B")]
    for text in pdu.split(" "):
        name, _, form = text.partition(":")
        if set(text) <= set("0123456789ABCDEF"):
            tokens.append(Token("", "B", int(text, 16)))
        else:
            tokens.append(Token(name, _FORMS.get(form, form)))
    return tuple(tokens)


@frozen(eq=False)
class Layout:
    """The compiled PDU of one message class."""

    tokens: tuple[Token, ...]
    fixed: int
    """Bytes of address and PDU without the token that has a length of its own."""
    tail: str
    """The form of that token, or empty."""
    encode: Callable[[Any, Profile | None], bytes]
    """Message and profile -> address and PDU; `EncodeError` for a mask that has no profile, or is too long for it."""
    decode: Callable[[bytes, Profile], Any]
    """Address and PDU, and profile -> message; function and sub-function are known to be right; `DecodeError`."""

    @classmethod
    def compile(cls, message: Any) -> "Layout":  # noqa: ANN401 - a message class; those stand on this module
        """Compile the PDU of a message class."""
        tokens = tokens_of(message.pdu)
        items: dict[str, Item] = {field.name: field.type.__metadata__[0] for field in fields(message)}
        fixed = [token for token in tokens if token.width]
        tail = next((token for token in tokens if not token.width), Token("", ""))
        form = struct.Struct(">" + "".join(token.form for token in fixed))
        names: dict[str, Any] = {
            "Fault": Fault, "message": message, "new": object.__new__, "pack": form.pack, "unpack": form.unpack_from,
            "pack_words": _pack_words, "WORDS": _WORDS, "pack_bits": _pack_bits,
            "unpack_bits": _unpack_bits, "pack_mask": _pack_mask, "mask_bytes": _mask_bytes,
            "fail": _fail, "refuse": partial(_refuse, message.section),
        }  # fmt: skip
        for name, item in items.items():
            names |= {f"accepts_{name}": item.accepts, f"read_{name}": item.read, f"item_{name}": item}
            names[f"set_{name}"] = getattr(message, name).__set__
        keywords = [field.name for field in fields(message) if field.kw_only]
        constructor = _constructor(tail, items, keywords)
        lines = (*_encoder(fixed, tail, items), *_decoder(fixed, tail, items, form.size), *constructor)
        exec(compile("\n".join(lines), f"<layout of {message.__name__}>", "exec"), names)  # noqa: S102 - our statements
        message.__init__ = update_wrapper(names["construct"], message.__init__)
        return cls(tokens, form.size, tail.form, names["encode"], names["decode"])

    def check(self, message: Any) -> None:  # noqa: ANN401 - a message
        """Refuse values that no message can have: the first of its class, made by attrs, is constructed again."""
        message.__init__(**{field.name: getattr(message, field.name) for field in fields(type(message))})


def _mask_bytes(profile: Profile) -> int:
    return profile.mask_digits // 2


def _pack_mask(mask: int, profile: Profile | None) -> bytes:
    if profile is None:
        raise EncodeError("profile", None, "the module's, which the length of a mask depends on", "3.3.9")
    length = _mask_bytes(profile)
    if mask >> 8 * length:
        raise EncodeError("mask", f"{mask:X}", f"what {length} byte(s) hold: {profile.model.value}", "3.3.9")
    return mask.to_bytes(length, "big")


def _fail(body: bytes, fault: Fault, at: int, field: str, allowed: str) -> None:
    raise DecodeError(fault, body, at, field=field, allowed=allowed)


def _refuse(section: str, field: str, value: object, allowed: str) -> None:
    raise EncodeError(field, value, allowed, section)


_PACKERS = {"words": "pack_words({})", "bits": "pack_bits({})", "mask": "pack_mask({}, p)"}
_BYTES = {"words": "2 * len(m.values)", "bits": "len(m.values) + 7 >> 3"}


def _encoder(fixed: Iterable[Token], tail: Token, items: dict[str, Item]) -> Iterator[str]:
    values = []
    for token in fixed:
        if token.name in items:
            values.append(items[token.name].write.format(f"m.{token.name}"))
        elif token.name == "bytes":
            values.append(_BYTES[tail.form])
        else:
            values.append("len(m.values)" if token.name else str(token.literal))
    yield "def encode(m, p):"
    packed = f"pack({', '.join(values)})"
    if tail.form:
        packed += " + " + _PACKERS[tail.form].format(f"m.{tail.name}")
    yield f"    return {packed}"


def _decoder(fixed: list[Token], tail: Token, items: dict[str, Item], size: int) -> Iterator[str]:
    """Make the decoder: it looks at the length first, then at ranges, counts, reserved bytes and single values."""
    names = [token.name or f"literal_{at}" for at, token in enumerate(fixed)]
    places = [sum(token.width for token in fixed[:at]) for at in range(len(fixed))]
    extra = " + mask_bytes(p)" if tail.form == "mask" else ""
    yield "def decode(b, p):"
    yield f"    if len(b) {'<' if tail.form in _BYTES else '!='} {size}{extra}:"
    allowed = f"address and PDU of {size} bytes" + " and what follows" * bool(tail.form)
    yield f"        fail(b, Fault.LENGTH, min(len(b), {size}), '', {allowed!r})"
    yield f"    {', '.join(names)}, = unpack(b)"
    for name, at in zip(names, places, strict=True):
        if name in items and items[name].fault is Fault.RANGE:
            yield f"    if not accepts_{name}({name}):"
            yield f"        fail(b, Fault.RANGE, {at}, {name!r}, item_{name}.allowed)"
    if tail.form == "mask":
        yield f"    {tail.name} = int.from_bytes(b[{size}:], 'big')"
    elif tail.form:
        yield from _counted(tail, size, "count" in names)
    if "start" in names and not tail.form:
        yield from _beyond(places[names.index("count")])
    code = 3 if fixed[1].literal == _WITH_SUB_FUNCTIONS else 2
    for name, token, at in zip(names[code:], fixed[code:], places[code:], strict=True):
        if not token.name:
            yield f"    if {name} != {token.literal}:"
            yield f"        fail(b, Fault.RESERVED, {at}, '', '{token.literal:02X}')"
    for name, at in zip(names, places, strict=True):
        if name in items and items[name].read:
            yield "    try:"
            yield f"        {name} = read_{name}({name})"
            yield "    except KeyError:"
            yield f"        fail(b, Fault.VALUE, {at}, {name!r}, item_{name}.allowed)"
    yield "    m = new(message)"
    yield from (f"    set_{name}(m, {name})" for name in items)
    yield "    return m"


def _beyond(at: int) -> Iterator[str]:
    """Refuse a count of items, which stands at `at`, that leads beyond the last address."""
    yield f"    if start + count > {_ADDRESSES}:"
    yield f"        fail(b, Fault.RANGE, {at}, 'count', 'none beyond address 65535')"


def _counted(tail: Token, size: int, items_are_counted: bool) -> Iterator[str]:  # noqa: FBT001 - of our own
    """Read what follows the byte count, the last of `size` bytes; the count of items is before it, if there is one."""
    name, words = tail.name, tail.form == "words"
    yield f"    if bytes != len(b) - {size}:"
    yield f"        fail(b, Fault.LENGTH, min(len(b), {size} + bytes), 'bytes', 'as many as follow')"
    if items_are_counted:
        yield f"    if not 1 <= count <= {MOST_WRITTEN_WORDS if words else MOST_WRITTEN_BITS}:"
        yield f"        fail(b, Fault.RANGE, {size - 3}, 'count', item_{name}.allowed)"
        yield from _beyond(size - 3)
        yield f"    if bytes != {'2 * count' if words else 'count + 7 >> 3'}:"
        yield f"        fail(b, Fault.COUNT, {size - 1}, 'bytes', 'as many as the items have')"
    else:
        yield f"    if not 1 <= bytes <= {2 * MOST_WORDS}{' or bytes & 1' if words else ''}:"
        yield f"        fail(b, Fault.COUNT, {size - 1}, 'bytes', item_{name}.allowed)"
    unpacked = f"WORDS[bytes >> 1].unpack_from(b, {size})" if words else f"unpack_bits(b[{size}:])"
    yield f"    {name} = {unpacked}"
    if items_are_counted and not words:
        yield f"    {name} = {name}[:count]"


def _constructor(tail: Token, items: dict[str, Item], keywords: list[str]) -> Iterator[str]:
    """Make the constructor: what attrs makes of the fields, but straight to the slots, and the values are looked at."""
    parameters = [name for name in items if name not in keywords] + ["*"] * bool(keywords) + keywords
    yield f"def construct(self, {', '.join(parameters)}):"
    for name, item in items.items():
        plain = ""
        if item.bounds:
            low, high = item.bounds
            plain = f"not ({name}.__class__ is int and {low} <= {name} <= {high}) and "
        yield f"    if {plain}not accepts_{name}({name}): refuse({name!r}, {name}, item_{name}.allowed)"
    if "start" in items:
        count = "count" if "count" in items else f"len({tail.name})"
        yield f"    if start + {count} > {_ADDRESSES}: refuse('count', {count}, 'none beyond address 65535')"
    yield from (f"    set_{name}(self, {name})" for name in items)
