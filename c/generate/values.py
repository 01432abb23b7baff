"""Values of C with their bytes in a digest: numbers, names, strings, wires, rows and lists."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

__all__ = [
    "Value", "enum", "enumerator", "items", "lines", "number", "numbered", "optional_text", "pointer", "real", "row",
    "text", "upper", "wire",
]  # fmt: skip


WIDTH = 120
"""The longest line of C, if it can be broken."""
CHUNK = 22
"""The most bytes of a literal of a wire; longer ones are written as several."""
_STRING = re.compile(r'"(?:\\.|[^"\\])*"')


class Value(NamedTuple):
    """A value of C."""

    source: str
    """How it is written in C."""
    proof: bytes
    """What the self-test makes of it: numbers as four bytes, low byte first; strings with their zero."""


def number(value: int | bool, source: str | None = None) -> Value:  # noqa: FBT001 - truth values are numbers in C
    """Return a number of at most 32 bits, signed or unsigned; `source` is the constant that stands for it."""
    return Value(source or str(int(value)), (int(value) & 0xFFFFFFFF).to_bytes(4, "little"))


def real(value: float | None) -> Value:
    """Return a double; its digest has its millionths, in eight bytes, rounded toward zero. None is 0."""
    written = 0.0 if value is None else float(value)
    return Value(repr(written), int(written * 1e6).to_bytes(8, "little", signed=True))


def text(value: str) -> Value:
    """Return a string."""
    return Value(quoted(value.encode()), value.encode() + b"\0")


def optional_text(value: str | None) -> Value:
    """Return a string, or NULL."""
    return Value("NULL", b"\xff") if value is None else text(value)


def wire(value: str | None, *, readable: bool) -> Value:
    """Return bytes in hex as a pointer and a length; no bytes are NULL and 0."""
    if value is None:
        return Value("I7000_NO_WIRE", number(0).proof)
    data = bytes.fromhex(value)
    chunks = (data[at : at + CHUNK] for at in range(0, len(data) or 1, CHUNK))
    literal = " ".join(map(quoted if readable else escaped, chunks))
    return Value(f"I7000_WIRE({literal})", number(len(data)).proof + data)


def row(*values: Value) -> Value:
    """Return a structure."""
    return Value("{" + ", ".join(it.source for it in values) + "}", b"".join(it.proof for it in values))


def items(values: Sequence[Value], kind: str) -> Value:
    """Return an array of a kind as a pointer and a count; an empty one is NULL and 0."""
    proof = number(len(values)).proof + b"".join(it.proof for it in values)
    if not values:
        return Value("NULL, 0", proof)
    return Value(f"(const {kind}[]){{{', '.join(it.source for it in values)}}}, {len(values)}", proof)


def pointer(value: Value | None, kind: str) -> Value:
    """Return a pointer to one structure, or NULL."""
    if value is None:
        return Value("NULL", b"\xff")
    return Value(f"&(const {kind}){value.source}", value.proof)


def quoted(data: bytes) -> str:
    """Return bytes as a string literal that people can read."""
    return '"' + "".join(_character(byte, data[at - 1 : at]) for at, byte in enumerate(data)) + '"'


def _character(byte: int, before: bytes) -> str:
    char = chr(byte)
    if byte == 0x0D:
        return "\\r"
    if not 0x20 <= byte <= 0x7E:
        return f"\\x{byte:02x}"
    ends_escape = char in "0123456789abcdefABCDEF" and before != b"\r" and before and not 0x20 <= before[0] <= 0x7E
    return ('" "' if ends_escape else "") + ("\\" if char in '"\\?' else "") + char


def escaped(data: bytes) -> str:
    """Return bytes as a string literal of hex escapes."""
    return '"' + "".join(f"\\x{byte:02x}" for byte in data) + '"'


def enumerator(prefix: str, values: Mapping[str, int], key: str) -> Value:
    """Return the number of a key as the constant ``I7000_PREFIX_KEY``."""
    return number(values[key], f"I7000_{prefix}_{upper(key)}")


def upper(name: str) -> str:
    """Return the name of a message or field as an identifier in capitals.

    >>> upper("ReadCjcOffset"), upper("sub_function"), upper("host-may-refuse")
    ('READ_CJC_OFFSET', 'SUB_FUNCTION', 'HOST_MAY_REFUSE')
    """
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).replace("-", "_").upper()


def enum(title: str, prefix: str, values: dict[str, int]) -> Iterator[str]:
    """Yield the lines of an enumeration."""
    yield from ("", f"/* {title} */", "enum {")
    yield from (f"    {prefix}{key} = {value}," for key, value in values.items())
    yield "};"


def lines(source: str, indent: int, end: str) -> Iterator[str]:
    """Yield an initializer in lines of at most `WIDTH` characters: what is longer is broken at its braces."""
    whole = " " * indent + source + end
    brace = _brace(source)
    if len(whole) <= WIDTH or brace is None:
        yield whole
        return
    head, inner, tail = source[: brace[0] + 1], source[brace[0] + 1 : brace[1]], source[brace[1] :]
    yield " " * indent + head
    line = ""
    for part in _parts(inner):
        is_broken = _brace(part) is not None
        room = WIDTH - indent - 4
        pieces = _pieces(part) if len(part) >= room and not is_broken else [part]
        if line and (is_broken or len(pieces) > 1 or len(line) + len(part) + 2 > room):
            yield " " * (indent + 4) + line
            line = ""
        if is_broken:
            yield from lines(part, indent + 4, ",")
            continue
        yield from (" " * (indent + 4) + piece for piece in pieces[:-1])
        line += f"{' ' if line else ''}{pieces[-1]},"
    if line:
        yield " " * (indent + 4) + line
    yield " " * indent + tail + end


def _pieces(part: str) -> list[str]:
    """Return a part that has a long string, with `CHUNK` bytes of it a line."""
    pieces = part.split('" "')
    return [('"' if at else "") + piece + ('"' if at + 1 < len(pieces) else "") for at, piece in enumerate(pieces)]


def _brace(source: str) -> tuple[int, int] | None:
    """Return the places of the first brace and of the last one, or None."""
    bare = _STRING.sub(lambda found: "." * len(found[0]), source)
    return (bare.index("{"), bare.rindex("}")) if "{" in bare else None


def _parts(inner: str) -> list[str]:
    """Return what commas separate, those within brackets aside."""
    bare = _STRING.sub(lambda found: "." * len(found[0]), inner)
    parts, depth, start = [], 0, 0
    for at, char in enumerate(bare):
        depth += (char in "({[") - (char in ")}]")
        if char == "," and not depth:
            parts.append(inner[start:at].strip())
            start = at + 1
    return [*parts, inner[start:].strip()]


def numbered(names: Iterable[str]) -> dict[str, int]:
    """Return names with their places."""
    return {name: at for at, name in enumerate(names)}
