"""One statement of a message's syntax -> its encoder and its decoder.

A message class has the manual's notation in `syntax`, and its fields are annotated with the part of that notation they
fill: ``syntax = "$AA9SNNNN"`` with ``address: Address`` (``AA``) and ``offset: CjcOffset`` (``SNNNN``), in the order in
which they stand. What is between the parts is literal. The first use of a class compiles its statement to straight-line
code: slices, look-ups and one ``%``.

Laws: the constructor takes exactly the values that a part `accepts`; what a part writes, it reads back as it was.
"""

from collections.abc import Callable, Iterable, Iterator
from typing import Annotated, Any, NamedTuple, get_origin

from i7000.dcon.names import CHARACTERS, is_name, is_version
from i7000.errors import DecodeError, EncodeError, Fault
from i7000.fields import FIELD_WIDTHS, LEGACY_WIDTH, are_fields, split_fields
from i7000.frozen import frozen
from i7000.profile import Profile
from i7000.settings import CjcUpdate, DataFormat, LineSettings, Protocol, ReportSettings, is_int
from i7000.type_codes import TypeCode

# --- parts ------------------------------------------------------------------------------------------------------------

_DIGITS = "0123456789ABCDEF"


class Part(NamedTuple):
    """One field's place in a syntax."""

    notation: str
    """What stands for it in the syntax."""
    allowed: str
    """Its values, for messages."""
    format: str
    """How ``%`` writes it."""
    arguments: str
    """What ``%`` is given: an expression of the field, ``{}``, and the profile, ``p``."""
    accepts: Callable[[Any], bool]
    """Whether the field can have this value."""
    parse: Callable[..., Any]
    """Read it from its characters; `KeyError` where they are none of the expected."""
    fault: Fault = Fault.CHARACTER
    """What a `KeyError` of `parse` means."""
    width: int | str | None = None
    """Characters: a number, an attribute of the profile, or ``rest``: all that are left; None: as the notation."""
    contextual: bool = False
    """Whether `parse` takes the profile after the text."""
    longest: Callable[[Profile], int] | None = None
    """The most characters of a part that takes all that are left."""
    characters: str = _DIGITS
    """What its characters can be, where a wrong one is a fault of its own."""
    signed: bool = False
    """Whether a sign stands before its `characters`; `parse` judges the sign itself."""


_PAIRS = {f"{byte:02X}": byte for byte in range(256)}
_TYPE_CODES = {text: TypeCode.of(byte) for text, byte in _PAIRS.items()}


def _parse_hex(text: str) -> int:
    """Read upper-case digits only, where `int` would take more."""
    if text.strip(_DIGITS):
        raise KeyError(text)
    return int(text, 16)


def _byte(notation: str) -> Part:
    """Two hex digits."""
    return Part(notation, "00..FF", "%02X", "{}", lambda value: is_int(value, 0, 0xFF), _PAIRS.__getitem__)


def _type_code(notation: str) -> Part:
    """Two hex digits that are a type code, or a number that is none."""
    return Part(notation, "00..FF", "%02X", "{}", lambda value: is_int(value, 0, 0xFF), _TYPE_CODES.__getitem__)


def _settings(notation: str, kind: type[LineSettings] | type[ReportSettings]) -> Part:
    """Two hex digits that are a byte of settings."""
    return Part(
        notation, f"{kind.__name__}", "%02X", "{}.byte",
        lambda value: isinstance(value, kind), lambda text: kind.from_byte(_PAIRS[text]),
    )  # fmt: skip


def _choice(notation: str, kind: type[bool | CjcUpdate | Protocol]) -> Part:
    """One digit, of the few that have a meaning."""
    values = {f"{value:d}": value for value in (kind if issubclass(kind, CjcUpdate | Protocol) else (False, True))}
    allowed = " ".join(f"{digit} ({value!s})" if kind is bool else digit for digit, value in values.items())
    return Part(
        notation, f"{kind.__name__}: {allowed}", "%d", "{}",
        lambda value: isinstance(value, kind), values.__getitem__, Fault.VALUE,
    )  # fmt: skip


def _channel(notation: str) -> Part:
    """A channel number: one digit, or two in single-ended mode (E21, E22)."""
    return Part(
        notation, "0..F, or 00..FF in single-ended mode", "%0*X", "p.channel_digits, {}",
        lambda value: is_int(value, 0, 0xFF), _parse_hex, width="channel_digits",
    )  # fmt: skip


def _digit(notation: str) -> Part:
    """A channel number in one hex digit, whatever the connecting mode."""
    return Part(notation, "0..F", "%X", "{}", lambda value: is_int(value, 0, 0xF), _parse_hex)


def _mask(notation: str) -> Part:
    """A bit for each channel, channel 0 the lowest: 2, 4 or 6 digits (2.13; E11, E12, E13)."""
    return Part(
        notation, "2, 4 or 6 hex digits", "%0*X", "p.mask_digits, {}",
        lambda value: is_int(value, 0, 0xFFFFFF), _parse_hex, width="mask_digits",
    )  # fmt: skip


def _offset(notation: str) -> Part:
    """A sign and the magnitude in four hex digits; -0 is read as 0 (2.18; E85)."""

    def parse(text: str) -> int:
        if text[0] not in "+-":
            raise DecodeError(Fault.NUMBER, text.encode(), allowed="+ or -")
        return _parse_hex(text[1:]) * (-1 if text[0] == "-" else 1)

    return Part(
        notation, "-FFFF..+FFFF in hex", "%c%04X", "43 if {0} >= 0 else 45, abs({0})",
        lambda value: is_int(value, -0xFFFF, 0xFFFF), parse, width=5, signed=True,
    )  # fmt: skip


def _temperature(notation: str) -> Part:
    """A sign, four digits, a point and one digit (2.11)."""

    def parse(text: str) -> float:
        if text[:1] not in ("+", "-") or text[5:6] != "." or (text[1:5] + text[6:]).strip("0123456789"):
            raise KeyError(text)
        return float(text)

    def accepts(value: Any) -> bool:  # noqa: ANN401
        number = isinstance(value, int | float) and not isinstance(value, bool)
        return number and -9999.9 <= value <= 9999.9 and round(value, 1) == value

    return Part(
        notation, "-9999.9..+9999.9, in tenths", "%+07.1f", "{} + 0.0", accepts, parse, Fault.NUMBER, 7
    )  # fmt: skip


def _text(
    notation: str, lengths: tuple[int, int], allowed: str, is_valid: Callable[[str], bool] = lambda _: True
) -> Part:
    """Characters to the end: those of names, in a form of their own (E102, E122)."""
    shortest, longest = lengths

    def accepts(value: Any) -> bool:  # noqa: ANN401
        short = isinstance(value, str) and shortest <= len(value) <= longest
        return short and CHARACTERS.issuperset(value) and is_valid(value)

    def parse(text: str) -> str:
        if not shortest <= len(text) <= longest:
            raise DecodeError(Fault.LENGTH, text.encode(), min(len(text), longest), allowed=allowed)
        if not CHARACTERS.issuperset(text):
            raise KeyError(text)
        if not is_valid(text):
            raise DecodeError(Fault.VALUE, text.encode(), allowed=allowed)
        return text

    return Part(
        notation, allowed, "%b", "{}.encode()",
        accepts, parse, width="rest", longest=lambda _: longest, characters="".join(sorted(CHARACTERS)),
    )  # fmt: skip


_NAME_LENGTHS = (1, 6)
_NAME = "1 to 6 characters, printable ASCII without % # $ ~ @ ! > ?"


def _longest_field(data_format: DataFormat, profile: Profile) -> int:
    width = FIELD_WIDTHS[data_format]
    return max(width, LEGACY_WIDTH) if profile.legacy_sentinels else width


def _values(notation: str, data_format: DataFormat | None = None) -> Part:
    """The fields of all channels: in the data format of the profile, or in one that is given."""

    def form(profile: Profile) -> DataFormat:
        return profile.data_format if data_format is None else data_format

    def parse(text: str, profile: Profile) -> tuple[str, ...]:
        return split_fields(text, profile.channels, form(profile), legacy=profile.legacy_sentinels)

    def accepts(value: Any) -> bool:  # noqa: ANN401
        strings = isinstance(value, tuple) and value and all(isinstance(text, str) for text in value)
        return bool(strings) and are_fields(value)

    return Part(
        notation, "a tuple of channel fields, each as sent", "%b", "''.join({}).encode()",
        accepts, parse, Fault.NUMBER, "rest", contextual=True,
        longest=lambda profile: profile.channels * _longest_field(form(profile), profile),
    )  # fmt: skip


def _value(notation: str) -> Part:
    """The field of one channel, in the data format of the profile."""

    def parse(text: str, profile: Profile) -> str:
        return split_fields(text, 1, profile.data_format, legacy=profile.legacy_sentinels)[0]

    def accepts(value: object) -> bool:
        return isinstance(value, str) and are_fields((value,))

    return Part(
        notation, "a channel field, as sent", "%b", "{}.encode()",
        accepts, parse, Fault.NUMBER, "rest", contextual=True,
        longest=lambda profile: _longest_field(profile.data_format, profile),
    )  # fmt: skip


# The types of fields, by the notation of the manual.
Address = Annotated[int, _byte("AA")]
NewAddress = Annotated[int, _byte("NN")]
NewTypeCode = Annotated[TypeCode | int, _type_code("TT")]
ChannelTypeCode = Annotated[TypeCode | int, _type_code("rr")]
Line = Annotated[LineSettings, _settings("CC", LineSettings)]
Report = Annotated[ReportSettings, _settings("FF", ReportSettings)]
ChannelN = Annotated[int, _channel("N")]
ChannelI = Annotated[int, _channel("i")]
CalibratedChannel = Annotated[int, _digit("i")]
Mask = Annotated[int, _mask("VV")]
DiagnosticMask = Annotated[int, _mask("NN")]
Offset = Annotated[int, _offset("SNNNN")]
OffsetData = Annotated[int, _offset("(Data)")]
Temperature = Annotated[float, _temperature("(Data)")]
Version = Annotated[str, _text("(Data)", (4, 5), "a letter, a digit, a point, one or two digits", is_version)]
Name = Annotated[
    str,
    _text(
        "(Name)",
        _NAME_LENGTHS,
        f"{_NAME}; not the text of another answer (2, 4 or 6 hex digits, a version, ...)",
        is_name,
    ),
]
NewName = Annotated[str, _text("(Name)", _NAME_LENGTHS, _NAME)]
Values = Annotated[tuple[str, ...], _values("(Data)")]
HexValues = Annotated[tuple[str, ...], _values("(Data)", DataFormat.HEX)]
Value = Annotated[str, _value("(Data)")]
Update = Annotated[CjcUpdate, _choice("i", CjcUpdate)]
ProtocolN = Annotated[Protocol, _choice("N", Protocol)]
ProtocolC = Annotated[Protocol, _choice("C", Protocol)]
FlagN = Annotated[bool, _choice("N", bool)]
FlagS = Annotated[bool, _choice("S", bool)]
FlagE = Annotated[bool, _choice("E", bool)]
FlagV = Annotated[bool, _choice("V", bool)]
Seconds = Annotated[int, _byte("nn")]
Tenths = Annotated[int, _byte("VV")]
StatusByte = Annotated[int, _byte("SS")]


# --- layouts ----------------------------------------------------------------------------------------------------------


@frozen(eq=False)
class Layout:
    """The compiled syntax of one message class."""

    syntax: str
    pieces: tuple[tuple[str, str | Part], ...]
    """In wire order: ``("", literal)`` or ``(field name, part)``."""
    encode: Callable[[Any, Profile], bytes]
    """Message and profile -> body."""
    decode: Callable[[str, Profile], Any]
    """Body and profile -> message; `KeyError` or `DecodeError` where it does not fit, `explain` then tells why."""
    leads: bytes
    """The leading character; and that of a refusal, which stands in the place of every response."""
    addressed: bool
    """Whether the message carries an address."""

    @classmethod
    def compile(cls, message: Any) -> "Layout":  # noqa: ANN401 - a message class; those stand on this module
        """Compile the syntax of a message class."""
        pieces = tuple(pieces_of(message))
        source = "\n".join((*_encoder(pieces), *_decoder(pieces)))
        names: dict[str, Any] = {"message": message, "new": object.__new__}
        for name, part in pieces:
            if isinstance(part, Part):
                names[f"parse_{name}"] = part.parse
                names[f"set_{name}"] = getattr(message, name).__set__
        exec(compile(source, f"<layout of {message.__name__}>", "exec"), names)  # noqa: S102 - our own syntax strings
        leads = f"{message.syntax[0]}?".encode()
        addressed = any(name == "address" for name, _ in pieces)
        return cls(message.syntax, pieces, names["encode"], names["decode"], leads, addressed)

    def check(self, message: Any) -> None:  # noqa: ANN401
        """Refuse values that no message of this class can have."""
        for name, part in self.pieces:
            if isinstance(part, Part):
                value = getattr(message, name)
                if not part.accepts(value):
                    raise EncodeError(name, value, part.allowed, message.section)

    def check_digits(self, message: Any, profile: Profile) -> None:  # noqa: ANN401
        """Refuse numbers that have more digits than the module reads."""
        for name, part in self.pieces:
            if isinstance(part, Part) and isinstance(part.width, str) and part.width != "rest":
                digits: int = getattr(profile, part.width)
                if getattr(message, name) >> 4 * digits:
                    allowed = f"{digits} hex digit(s): {profile.model.value}"
                    raise EncodeError(name, getattr(message, name), allowed, message.section)

    def longest(self, profile: Profile) -> int:
        """Tell the most characters that a body can have."""
        return sum(
            piece.longest(profile) if isinstance(piece, Part) and piece.longest else _width(piece, profile) or 0
            for _, piece in self.pieces
        )

    def explain(self, body: str, profile: Profile, frame: bytes, section: str) -> DecodeError:
        """Tell why `decode` could not read `body`: its length, or the first thing from the left that does not fit."""
        widths = [_width(piece, profile) for _, piece in self.pieces]
        shortest, longest = sum(1 if width is None else width for width in widths), self.longest(profile)
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
    """Characters of a piece; None: all that are left, however many."""
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
        allowed = "0-9 A-F" if part.characters == _DIGITS else part.allowed
        return DecodeError(part.fault, text.encode(), at, allowed=allowed)
    except DecodeError as error:
        return error
    return None


def _fields(message: Any) -> Iterator[tuple[str, Part]]:  # noqa: ANN401
    """Read the annotations of a class and its bases; attrs has not made the class yet, perhaps, and takes long to."""
    for base in reversed(message.__mro__):
        for name, annotation in vars(base).get("__annotations__", {}).items():
            if get_origin(annotation) is Annotated:
                yield name, annotation.__metadata__[0]


def pieces_of(message: Any) -> Iterator[tuple[str, str | Part]]:  # noqa: ANN401
    """Find the notation of each field in the syntax, from the left, and the literals between."""
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
