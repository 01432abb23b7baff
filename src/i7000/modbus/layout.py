"""The compiler of Modbus message classes: from a PDU to a constructor, an encoder, a decoder and a length.

A message class has its PDU in `pdu`: tokens separated by blanks. Two hex digits are a literal byte, ``00`` a reserved
one. Any other token is a field of the class, or is computed from the sequence at the end: ``count`` is its number of
items and ``bytes`` its number of bytes, unless a field has that name. ``:2`` and ``:4`` give the length of a token in
bytes; ``:mask``, ``:bits`` and ``:words`` mark a token of variable length. At its first use, a class is compiled to
straight-line code around one `struct.Struct`.

Laws: the constructor accepts exactly the values that a field's `Item` accepts; every message written can be read back.

>>> from i7000 import modbus
>>> print(modbus.SetTypeCode.layout.source)
def construct(self, address, channel, type_code):
    if not (address.__class__ is int and 0 <= address <= 247) and not accepts_address(address):
        refuse('address', address)
    if not (channel.__class__ is int and 0 <= channel <= 255) and not accepts_channel(channel):
        refuse('channel', channel)
    if not accepts_type_code(type_code):
        refuse('type_code', type_code)
    set_address(self, address)
    set_channel(self, channel)
    set_type_code(self, type_code)
<BLANKLINE>
def encode(m, p):
    return pack(m.address, 70, 8, 0, m.channel, m.type_code)
<BLANKLINE>
def decode(b, p):
    if len(b) != 6:
        fail(b, Fault.LENGTH, min(len(b), 6), '', 'address and PDU of 6 bytes')
    address, literal_1, literal_2, literal_3, channel, type_code, = unpack(b)
    if literal_3 != 0:
        fail(b, Fault.RESERVED, 3, '', '00')
    try:
        type_code = read_type_code(type_code)
    except KeyError:
        fail(b, Fault.VALUE, 5, 'type_code', item_type_code.allowed)
    m = new(message)
    set_address(m, address)
    set_channel(m, channel)
    set_type_code(m, type_code)
    return m
"""

import struct
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

from attrs import fields

from i7000.compiled import compiled, constructor_names, constructor_source
from i7000.errors import DecodeError, EncodeError, Fault
from i7000.frozen import frozen
from i7000.modbus.frame import WordStructs
from i7000.modbus.items import MOST_WORDS, Item
from i7000.profile import Profile

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
    """The name of the field; empty for a literal."""
    form: str
    """The form: ``B``, ``H`` or ``4s`` as of `struct`; or ``mask``, ``bits``, ``words``."""
    literal: int = 0

    @property
    def width(self) -> int:
        """The length in bytes; 0 for a token of variable length."""
        return _WIDTHS.get(self.form, 0)


def tokens_of(pdu: str) -> tuple[Token, ...]:
    """Return the tokens of a PDU; the address comes first."""
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
    """The length in bytes of address and PDU, without the token of variable length."""
    tail: str
    """The form of the token of variable length; empty if there is no such token."""
    source: str
    """The source code of the three functions."""
    construct: Callable[..., None]
    """The constructor; it raises `EncodeError` for values that no message of this class can have."""
    encode: Callable[[Any, Profile | None], bytes]
    """Encodes a message to address and PDU; `EncodeError` for a mask that is too long or has no profile."""
    decode: Callable[[bytes, Profile], Any]
    """Decodes address and PDU of known function and sub-function to a message; raises `DecodeError`."""

    @classmethod
    def compile(cls, message: Any) -> "Layout":  # noqa: ANN401 - a message class; those stand on this module
        """Compile the PDU of a message class."""
        statement = _Statement.of(message)
        form = struct.Struct(">" + "".join(token.form for token in statement.fixed))
        names: dict[str, Any] = {
            "Fault": Fault, "message": message, "new": object.__new__, "pack": form.pack, "unpack": form.unpack_from,
            "pack_words": _pack_words, "WORDS": _WORDS, "pack_bits": _pack_bits,
            "unpack_bits": _unpack_bits, "pack_mask": _pack_mask, "mask_bytes": _mask_bytes,
            "fail": _fail, **constructor_names(message, statement.items),
        }  # fmt: skip
        for name, item in statement.items.items():
            names |= {f"read_{name}": item.read, f"item_{name}": item}
        lines = (*_constructor(statement), "", *_encoder(statement), "", *_decoder(statement, form.size))
        source = "\n".join(lines)
        made = compiled(source, f"{message.__module__}.{message.__name__}", names)
        functions = (made["construct"], made["encode"], made["decode"])
        return cls(tokens_of(message.pdu), form.size, statement.tail.form, source, *functions)


class _Statement(NamedTuple):
    """A PDU and the fields of its class."""

    items: dict[str, Item]
    fixed: tuple[Token, ...]
    """The tokens before the one of variable length."""
    tail: Token
    """The token of variable length; without a form if there is no such token."""
    keywords: frozenset[str]
    """The keyword-only fields."""

    @classmethod
    def of(cls, message: Any) -> "_Statement":  # noqa: ANN401 - a message class
        items = {field.name: field.type.__metadata__[0] for field in fields(message)}
        tokens = tokens_of(message.pdu)
        tail = next((token for token in tokens if not token.width), Token("", ""))
        keywords = frozenset(field.name for field in fields(message) if field.kw_only)
        return cls(items, tuple(token for token in tokens if token.width), tail, keywords)

    def named(self, role: str) -> str:
        """Return the field that has a role, or an empty string."""
        return next((name for name, item in self.items.items() if item.role == role), "")

    def follows(self, token: Token) -> bool:
        """Return whether a token is computed from the sequence at the end."""
        return bool(token.name) and token.name not in self.items


def _mask_bytes(profile: Profile) -> int:
    return profile.mask_digits // 2


def _pack_mask(mask: int, profile: Profile | None) -> bytes:
    if profile is None:
        raise EncodeError("profile", None, "the profile of the module, which determines the length of a mask", "3.3.9")
    length = _mask_bytes(profile)
    if mask >> 8 * length:
        raise EncodeError("mask", f"{mask:X}", f"{length} byte(s) on {profile.model.value}", "3.3.9")
    return mask.to_bytes(length, "big")


def _fail(body: bytes, fault: Fault, at: int, field: str, allowed: str) -> None:
    raise DecodeError(fault, body, at, field=field, allowed=allowed)


_PACKERS = {"words": "pack_words({})", "bits": "pack_bits({})", "mask": "pack_mask({}, p)"}
_BYTES = {"words": "2 * len({})", "bits": "len({}) + 7 >> 3"}


def _constructor(statement: _Statement) -> Iterator[str]:
    together = []
    first = statement.named("first")
    if first:
        count = statement.named("count") or f"len({statement.tail.name})"
        together = [
            f"    if {first} + {count} > {_ADDRESSES}:",
            f"        refuse('count', {count}, 'none beyond address 65535')",
        ]
    yield from constructor_source(statement.items, statement.keywords, together)


def _encoder(statement: _Statement) -> Iterator[str]:
    items, tail = statement.items, statement.tail
    values = []
    for token in statement.fixed:
        if token.name in items:
            values.append(items[token.name].write.format(f"m.{token.name}"))
        elif token.name == "bytes":
            values.append(_BYTES[tail.form].format(f"m.{tail.name}"))
        else:
            values.append(f"len(m.{tail.name})" if token.name else str(token.literal))
    yield "def encode(m, p):"
    packed = f"pack({', '.join(values)})"
    if tail.form:
        packed += " + " + _PACKERS[tail.form].format(f"m.{tail.name}")
    yield f"    return {packed}"


def _decoder(statement: _Statement, size: int) -> Iterator[str]:
    """Yield the source of the decoder: it checks length, then ranges, counts, reserved bytes and single values."""
    items, fixed, tail, _ = statement
    names = [token.name or f"literal_{at}" for at, token in enumerate(fixed)]
    places = [sum(token.width for token in fixed[:at]) for at in range(len(fixed))]
    extra = " + mask_bytes(p)" if tail.form == "mask" else ""
    yield "def decode(b, p):"
    yield f"    if len(b) {'<' if tail.form in _BYTES else '!='} {size}{extra}:"
    allowed = f"address and PDU of {size} bytes" + " and more" * bool(tail.form)
    yield f"        fail(b, Fault.LENGTH, min(len(b), {size}), '', {allowed!r})"
    yield f"    {', '.join(names)}, = unpack(b)"
    for name, at in zip(names, places, strict=True):
        if name in items and items[name].fault is Fault.RANGE:
            yield f"    if not accepts_{name}({name}):"
            yield f"        fail(b, Fault.RANGE, {at}, {name!r}, item_{name}.allowed)"
    if tail.form == "mask":
        yield f"    {tail.name} = int.from_bytes(b[{size}:], 'big')"
    elif tail.form:
        yield from _counted(statement, size)
    first, count = statement.named("first"), statement.named("count")
    if first and count:
        yield from _beyond(first, count, places[names.index(count)])
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


def _beyond(first: str, count: str, at: int) -> Iterator[str]:
    """Raise `DecodeError` for a count of items, at `at`, that goes beyond the last address."""
    yield f"    if {first} + {count} > {_ADDRESSES}:"
    yield f"        fail(b, Fault.RANGE, {at}, 'count', 'none beyond address 65535')"


def _counted(statement: _Statement, size: int) -> Iterator[str]:
    """Decode what follows the byte count, the last of `size` bytes; a count of items may precede it."""
    name, words = statement.tail.name, statement.tail.form == "words"
    yield f"    if bytes != len(b) - {size}:"
    yield f"        fail(b, Fault.LENGTH, min(len(b), {size} + bytes), 'bytes', 'as many as follow')"
    count = next((token.name for token in statement.fixed[:-1] if statement.follows(token)), "")
    if count:
        yield f"    if not 1 <= {count} <= {statement.items[name].most}:"
        yield f"        fail(b, Fault.RANGE, {size - 3}, 'count', item_{name}.allowed)"
        yield from _beyond(statement.named("first"), count, size - 3)
        yield f"    if bytes != {f'2 * {count}' if words else f'{count} + 7 >> 3'}:"
        yield f"        fail(b, Fault.COUNT, {size - 1}, 'bytes', 'as many as the items have')"
    else:
        yield f"    if not 1 <= bytes <= {2 * MOST_WORDS}{' or bytes & 1' if words else ''}:"
        yield f"        fail(b, Fault.COUNT, {size - 1}, 'bytes', item_{name}.allowed)"
    unpacked = f"WORDS[bytes >> 1].unpack_from(b, {size})" if words else f"unpack_bits(b[{size}:])"
    yield f"    {name} = {unpacked}"
    if count and not words:
        yield f"    {name} = {name}[:{count}]"
