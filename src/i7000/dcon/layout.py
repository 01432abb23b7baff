"""The compiler of DCON message classes: from a syntax to a constructor, an encoder and a decoder.

A message class has the manual's notation in `syntax`. Each field is annotated with its part of that notation:
``syntax = "$AA9SNNNN"`` with ``address: Address`` (``AA``) and ``offset: CjcOffset`` (``SNNNN``), in the order of the
notation. Characters between the parts are literal. At its first use, a class is compiled to straight-line code: slices,
look-ups and one ``%``.

Laws: the constructor accepts exactly the values for which a part's `accepts` is true.

>>> from i7000 import dcon
>>> print(dcon.SetCjcOffset.layout.source)
def construct(self, address, offset):
    if not (address.__class__ is int and 0 <= address <= 255) and not accepts_address(address):
        refuse('address', address)
    if not (offset.__class__ is int and -65535 <= offset <= 65535) and not accepts_offset(offset):
        refuse('offset', offset)
    set_address(self, address)
    set_offset(self, offset)
<BLANKLINE>
def encode(m, p):
    return b'$%02X9%c%04X' % (m.address, 43 if m.offset >= 0 else 45, abs(m.offset), )
<BLANKLINE>
def decode(t, p):
    if len(t) != 9 or t[0] != '$' or t[3] != '9':
        raise KeyError
    m = new(message)
    set_address(m, parse_address(t[1:3]))
    set_offset(m, parse_offset(t[4:9]))
    return m
"""

from collections.abc import Callable, Iterable, Iterator
from typing import Annotated, Any, get_origin

from attrs import fields

from i7000.compiled import compiled, constructor_names, constructor_source
from i7000.dcon.parts import DIGITS, Part
from i7000.errors import DecodeError, EncodeError, Fault
from i7000.frozen import frozen
from i7000.profile import Profile

# --- layouts ----------------------------------------------------------------------------------------------------------


@frozen(eq=False)
class Layout:
    """The compiled syntax of one message class."""

    syntax: str
    pieces: tuple[tuple[str, str | Part], ...]
    """The pieces in wire order: ``("", literal)`` or ``(field name, part)``."""
    source: str
    """The source code of the three functions."""
    construct: Callable[..., None]
    """The constructor; it raises `EncodeError` for values that no message of this class can have."""
    encode: Callable[[Any, Profile], bytes]
    """Encodes a message to a body, for a profile."""
    decode: Callable[[str, Profile], Any]
    """Decodes a body to a message, for a profile; `KeyError` or `DecodeError` on a mismatch, then `explain` finds the
    reason.
    """
    leads: bytes
    """The leading character; for responses also the leading character of a refusal."""
    addressed: bool
    """Whether the message contains an address."""

    @classmethod
    def compile(cls, message: Any) -> "Layout":  # noqa: ANN401 - a message class; those stand on this module
        """Compile the syntax of a message class."""
        pieces = tuple(pieces_of(message))
        parts = {name: part for name, part in pieces if isinstance(part, Part)}
        keywords = {field.name for field in fields(message) if field.kw_only}
        source = "\n".join((*constructor_source(parts, keywords, ()), "", *_encoder(pieces), "", *_decoder(pieces)))
        names: dict[str, Any] = {"message": message, "new": object.__new__, **constructor_names(message, parts)}
        for name, part in parts.items():
            names[f"parse_{name}"] = part.parse
        made = compiled(source, f"{message.__module__}.{message.__name__}", names)
        leads = f"{message.syntax[0]}?".encode()
        addressed = any(name == "address" for name, _ in pieces)
        functions = (made["construct"], made["encode"], made["decode"])
        return cls(message.syntax, pieces, source, *functions, leads, addressed)

    def check_digits(self, message: Any, profile: Profile) -> None:  # noqa: ANN401
        """Raise `EncodeError` for numbers with more digits than the module reads."""
        for name, part in self.pieces:
            if isinstance(part, Part) and isinstance(part.width, str) and part.width != "rest":
                digits: int = getattr(profile, part.width)
                if getattr(message, name) >> 4 * digits:
                    allowed = f"{digits} hex digit(s) on {profile.model.value}"
                    raise EncodeError(name, getattr(message, name), allowed, message.section)

    def longest(self, profile: Profile) -> int:
        """Return the length in characters of the longest body."""
        return sum(
            piece.longest(profile) if isinstance(piece, Part) and piece.longest else _width(piece, profile) or 0
            for _, piece in self.pieces
        )

    def explain(self, body: str, profile: Profile, frame: bytes, section: str) -> DecodeError:
        """Return the reason why `decode` fails on `body`: its length, or the first mismatch from the left."""
        widths = [_width(piece, profile) for _, piece in self.pieces]
        shortest = sum(
            piece.shortest if isinstance(piece, Part) and width is None else width or 0
            for (_, piece), width in zip(self.pieces, widths, strict=True)
        )
        longest = self.longest(profile)
        if not shortest <= len(body) <= longest:
            characters = f"{shortest}" if shortest == longest else f"{shortest} to {longest}"
            allowed = f"{characters} characters: {self.syntax}"
            return DecodeError(Fault.LENGTH, frame, min(len(body), longest), allowed=allowed, section=section)
        at = 0
        for (name, piece), width in zip(self.pieces, widths, strict=True):
            text = body[at:] if width is None else body[at : at + width]
            if isinstance(piece, Part):
                fault = _part_fault(piece, text, profile)
                if fault:
                    return DecodeError(
                        fault.fault, frame, at + fault.offset, field=name, allowed=fault.allowed, section=section
                    )
            elif text != piece:
                at += next(same for same in range(len(piece)) if text[same] != piece[same])
                return DecodeError(Fault.CHARACTER, frame, at, allowed=self.syntax, section=section)
            at += len(text)
        raise AssertionError(body)  # pragma: no cover - it fits


def _width(piece: str | Part, profile: Profile) -> int | None:
    """Return the width of a piece in characters; None for a piece that takes all remaining characters."""
    if isinstance(piece, str):
        return len(piece)
    if piece.width is None:
        return len(piece.notation)
    if piece.width == "rest":
        fixed = piece.contextual and not profile.legacy_sentinels
        return piece.longest(profile) if fixed and piece.longest else None
    return piece.width if isinstance(piece.width, int) else int(getattr(profile, piece.width))


def _part_fault(part: Part, text: str, profile: Profile) -> DecodeError | None:
    try:
        part.parse(text, profile) if part.contextual else part.parse(text)
    except KeyError:
        if part.fault is not Fault.CHARACTER:
            return DecodeError(part.fault, text.encode(), allowed=part.allowed)
        at = next(at for at in range(part.signed, len(text)) if text[at] not in part.characters)
        allowed = "0-9 A-F" if part.characters == DIGITS else part.allowed
        return DecodeError(part.fault, text.encode(), at, allowed=allowed)
    except DecodeError as error:
        return error
    return None


def _fields(message: Any) -> Iterator[tuple[str, Part]]:  # noqa: ANN401
    """Yield the annotated fields of a class and its bases; attrs may not have processed the class yet."""
    for base in reversed(message.__mro__):
        for name, annotation in vars(base).get("__annotations__", {}).items():
            if get_origin(annotation) is Annotated:
                yield name, annotation.__metadata__[0]


def pieces_of(message: Any) -> Iterator[tuple[str, str | Part]]:  # noqa: ANN401
    """Yield the literals and the fields of a syntax, from the left."""
    rest: str = message.syntax
    for name, part in _fields(message):
        literal, found, rest = rest.partition(part.notation)
        if not found:
            raise TypeError(f"{message.__name__}: {message.syntax!r} has no {part.notation!r}")
        if literal:
            yield "", literal
        yield name, part
    if rest:
        yield "", rest


def _encoder(pieces: Iterable[tuple[str, str | Part]]) -> Iterator[str]:
    parts = [(name, part) for name, part in pieces if isinstance(part, Part)]
    form = "".join(piece.format if isinstance(piece, Part) else piece.replace("%", "%%") for _, piece in pieces)
    arguments = "".join(part.arguments.format(f"m.{name}") + ", " for name, part in parts)
    yield "def encode(m, p):"
    yield f"    return b{form!r} % ({arguments})"


def _decoder(pieces: Iterable[tuple[str, str | Part]]) -> Iterator[str]:
    yield "def decode(t, p):"
    at, moved, end = 0, "", True
    lines, literals = [], []
    for name, piece in pieces:
        width = len(piece) if isinstance(piece, str) else len(piece.notation) if piece.width is None else piece.width
        start = f"{at}{moved}"
        if width == "rest":
            text, end = f"t[{start}:]", False
        elif isinstance(width, str):
            moved += f" + p.{width}"
            text = f"t[{start}:{at}{moved}]"
        else:
            at += width
            text = f"t[{start}:{at}{moved}]" if width > 1 or moved else f"t[{start}]"
        if isinstance(piece, str):
            literals.append(f"{text} != {piece!r}")
        else:
            lines.append(f"    set_{name}(m, parse_{name}({text}{', p' if piece.contextual else ''}))")
    wrong = [f"len(t) {'!=' if end else '<='} {at}{moved}", *literals]
    yield f"    if {' or '.join(wrong)}:"
    yield "        raise KeyError"
    yield "    m = new(message)"
    yield from lines
    yield "    return m"
