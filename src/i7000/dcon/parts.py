"""The parts of the syntax of DCON messages: the notation of each field, and its values.

Laws: a part reads back every value that it writes.
"""

from collections.abc import Callable
from typing import Annotated, Any, NamedTuple

from i7000 import describe
from i7000.errors import DecodeError, Fault
from i7000.fields import FIELD_WIDTHS, LEGACY_WIDTH, are_fields, split_fields
from i7000.names import CHARACTERS, LONGEST_NAME, is_name, is_version
from i7000.profile import Profile
from i7000.settings import CjcUpdate, DataFormat, LineSettings, Protocol, ReportSettings, is_int
from i7000.type_codes import TypeCode

DIGITS = "0123456789ABCDEF"


class Part(NamedTuple):
    """One field of a syntax: its notation, its values, and how it is written and read."""

    notation: str
    """The notation in the syntax."""
    allowed: str
    """The allowed values, for messages."""
    format: str
    """The ``%`` format that writes it."""
    arguments: str
    """The arguments of ``%``: an expression of the field, ``{}``, and the profile, ``p``."""
    accepts: Callable[[Any], bool]
    """Returns whether the field can have this value."""
    parse: Callable[..., Any]
    """Parses the characters of the field; raises `KeyError` for unexpected ones."""
    fault: Fault = Fault.CHARACTER
    """The fault that a `KeyError` of `parse` means."""
    width: int | str | None = None
    """Its width in characters: a number, an attribute of the profile, or ``rest`` (all remaining); None: as the
    notation.
    """
    contextual: bool = False
    """Whether `parse` takes the profile as its second argument."""
    longest: Callable[[Profile], int] | None = None
    """Returns the maximum width of a part that takes all remaining characters."""
    shortest: int = 1
    """The minimum width of such a part."""
    characters: str = DIGITS
    """The allowed characters; for another one `explain` reports `Fault.CHARACTER`."""
    signed: bool = False
    """Whether a sign precedes the `characters`; `parse` checks the sign."""
    bounds: tuple[int, int] | None = None
    """The range of a plain number, for all models."""
    values: Any = None
    """The type of the values, if they are not plain numbers or text: an enumeration, bool or settings."""
    unit: str | None = None
    """The unit of a quantity."""
    scale: float = 1
    """The value of one count in the unit."""
    describe: Callable[[Any], str] = describe.value
    """Returns the value in words, with its unit."""

    def __repr__(self) -> str:
        """Return what `help` shows beside a field: the notation and the values."""
        return f"<{self.notation}: {self.allowed}>"


_PAIRS = {f"{byte:02X}": byte for byte in range(256)}
_TYPE_CODES = {text: TypeCode.of(byte) for text, byte in _PAIRS.items()}


def _parse_hex(text: str) -> int:
    """Parse upper-case hex digits; raise `KeyError` for other text that `int` would accept."""
    if text.strip(DIGITS):
        raise KeyError(text)
    return int(text, 16)


def _number(notation: str, allowed: str, low: int, high: int, **more: Any) -> Part:  # noqa: ANN401 - fields of `Part`
    """Return a part for a number within limits, in hex digits."""
    form: dict[str, Any] = {"format": f"%0{len(notation)}X", "arguments": "{}", "parse": _parse_hex} | more
    return Part(
        notation, allowed, accepts=lambda value: is_int(value, low, high), bounds=(low, high), **form,
    )  # fmt: skip


def byte(notation: str, words: Callable[[int], str] = describe.hex_byte) -> Part:
    """Return a part for two hex digits, described with `words`."""
    return _number(notation, "00..FF", 0, 0xFF, parse=_PAIRS.__getitem__, describe=words)


def _quantity(part: Part, unit: str, scale: float, form: str) -> Part:
    """Return a part for a number that counts `scale` of a unit, described in the format `form`."""
    return part._replace(unit=unit, scale=scale, describe=describe.quantity(unit, scale, form))


def _type_code(notation: str) -> Part:
    """Return a part for a type code in two hex digits, or an undefined number."""
    return byte(notation, describe.type_code)._replace(parse=_TYPE_CODES.__getitem__, values=TypeCode)


def _settings(notation: str, kind: type[LineSettings] | type[ReportSettings], words: Callable[[Any], str]) -> Part:
    """Return a part for a byte of settings in two hex digits."""
    return Part(
        notation, f"{kind.__name__}", "%02X", "{}.byte",
        lambda value: isinstance(value, kind), lambda text: kind.from_byte(_PAIRS[text]), values=kind, describe=words,
    )  # fmt: skip


def _choice(notation: str, kind: type[bool | CjcUpdate | Protocol]) -> Part:
    """Return a part for one digit out of a few defined ones."""
    values = {f"{value:d}": value for value in (kind if issubclass(kind, CjcUpdate | Protocol) else (False, True))}
    allowed = " ".join(f"{digit} ({value!s})" if kind is bool else digit for digit, value in values.items())
    return Part(
        notation, f"{kind.__name__}: {allowed}", "%d", "{}",
        lambda value: isinstance(value, kind), values.__getitem__, Fault.VALUE, values=kind,
    )  # fmt: skip


def _channel(notation: str) -> Part:
    """Return a part for a channel number: one digit, or two in single-ended mode (E21, E22)."""
    return _number(
        notation, "0..F, or 00..FF in single-ended mode", 0, 0xFF,
        format="%0*X", arguments="p.channel_digits, {}", width="channel_digits",
    )  # fmt: skip


def _digit(notation: str) -> Part:
    """Return a part for a channel number in one hex digit, in every connecting mode."""
    return _number(notation, "0..F", 0, 0xF)


def _mask(notation: str) -> Part:
    """Return a part for a bit for each channel, channel 0 the lowest: 2, 4 or 6 digits (2.13; E11, E12, E13)."""
    return _number(
        notation, "2, 4 or 6 hex digits", 0, 0xFFFFFF,
        format="%0*X", arguments="p.mask_digits, {}", width="mask_digits", describe=describe.mask,
    )  # fmt: skip


def _offset(notation: str) -> Part:
    """Return a part for a sign and the magnitude in four hex digits; -0 is read as 0 (2.18; E85)."""

    def parse(text: str) -> int:
        if text[0] not in "+-":
            raise DecodeError(Fault.NUMBER, text.encode(), allowed="+ or -")
        return _parse_hex(text[1:]) * (-1 if text[0] == "-" else 1)

    part = _number(
        notation, "-FFFF..+FFFF in hex", -0xFFFF, 0xFFFF,
        format="%c%04X", arguments="43 if {0} >= 0 else 45, abs({0})", parse=parse, width=5, signed=True,
    )  # fmt: skip
    return _quantity(part, "degC", 0.01, "+.2f")


def _temperature(notation: str) -> Part:
    """Return a part for a sign, four digits, a point and one digit (2.11)."""

    def parse(text: str) -> float:
        if text[:1] not in ("+", "-") or text[5:6] != "." or (text[1:5] + text[6:]).strip("0123456789"):
            raise KeyError(text)
        return float(text)

    def accepts(value: Any) -> bool:  # noqa: ANN401
        number = isinstance(value, int | float) and not isinstance(value, bool)
        return number and -9999.9 <= value <= 9999.9 and round(value, 1) == value

    part = Part(notation, "-9999.9..+9999.9, in tenths", "%+07.1f", "{} + 0.0", accepts, parse, Fault.NUMBER, 7)
    return _quantity(part, "degC", 1, "+.1f")


def _text(
    notation: str, lengths: tuple[int, int], allowed: str, is_valid: Callable[[str], bool] = lambda _: True
) -> Part:
    """Return a part for text to the end of the body: names and versions (E102, E122)."""
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
        accepts, parse, width="rest", longest=lambda _: longest, shortest=shortest,
        characters="".join(sorted(CHARACTERS)), describe=repr,
    )  # fmt: skip


_NAME_LENGTHS = (1, LONGEST_NAME)
_NAME = f"1 to {LONGEST_NAME} characters, printable ASCII without % # $ ~ @ ! > ?"


def _longest_field(data_format: DataFormat, profile: Profile) -> int:
    width = FIELD_WIDTHS[data_format]
    return max(width, LEGACY_WIDTH) if profile.legacy_sentinels else width


def _values(notation: str, data_format: DataFormat | None = None) -> Part:
    """Return a part for the fields of all channels, in `data_format` or else in the data format of the profile."""

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
    """Return a part for the field of one channel, in the data format of the profile."""

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
Address = Annotated[int, byte("AA", describe.address)]
NewAddress = Annotated[int, byte("NN", describe.address)]
NewTypeCode = Annotated[TypeCode | int, _type_code("TT")]
ChannelTypeCode = Annotated[TypeCode | int, _type_code("rr")]
Line = Annotated[LineSettings, _settings("CC", LineSettings, describe.line_settings)]
Report = Annotated[ReportSettings, _settings("FF", ReportSettings, describe.report_settings)]
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
        f"{_NAME}; not the text of another response (2, 4 or 6 hex digits, a version, ...)",
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
Seconds = Annotated[int, _quantity(byte("nn"), "s", 1, "d")]
Tenths = Annotated[int, _quantity(byte("VV"), "s", 0.1, ".1f")]
