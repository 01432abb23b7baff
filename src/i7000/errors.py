"""Every error of the package.

Laws: with arguments of the right types, encoders raise only `EncodeError` and decoders raise only `DecodeError`.
Arguments of the wrong type raise `ArgumentError`. Constructors raise `InvalidValueError` for an invalid value of any
type; for messages and module settings they raise its subclass `EncodeError`. A valid response is never an error: a
refusal (``?AA``) is a value.
"""

import re
from enum import Enum

from i7000.frozen import frozen

__all__ = [
    "ArgumentError",
    "DecodeError",
    "EncodeError",
    "Fault",
    "I7000Error",
    "InvalidValueError",
    "Noise",
    "StateError",
    "shown",
    "written",
]


class Fault(Enum):
    """The reason why bytes are not a frame, or a frame is not a message."""

    LENGTH = "length"
    """The wrong number of bytes, or more than 256 bytes without an end."""
    TERMINATOR = "terminator"
    """The carriage return is missing, or comes early."""
    CHARACTER = "character"
    """A byte that is not allowed at its place: not ASCII, a lower-case digit, or a letter that is not in the syntax."""
    LEADING = "leading"
    """Not the leading character of a message of this direction or kind."""
    CHECKSUM = "checksum"
    """The checksum is missing, wrong or in lower case."""
    COMMAND = "command"
    """No module has a command of this form."""
    UNSUPPORTED = "unsupported"
    """The command exists, but not on this model or firmware."""
    ADDRESS = "address"
    """The response of a module other than the addressed one."""
    NUMBER = "number"
    """A data field that is not a number of its format."""
    VALUE = "value"
    """An undefined value of a digit or byte."""
    CRC = "crc"
    """The CRC of a Modbus RTU frame is wrong."""
    FUNCTION = "function"
    """A function code that these modules do not have, or that does not match the request."""
    SUB_FUNCTION = "sub_function"
    """A sub-function of function 46h that these modules do not have, or that does not match the request."""
    RANGE = "range"
    """More items than one frame can request or carry, zero items, or items beyond address 65535."""
    COUNT = "count"
    """The byte count, or the number of items, does not agree with the rest of the frame or with the request."""
    ECHO = "echo"
    """A response that does not repeat its request."""
    RESERVED = "reserved"
    """A reserved byte or bit that is not zero."""


class I7000Error(Exception):
    """The base class of all errors that this package raises deliberately; their text can always be printed."""

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(map(shown, self.args))})"


class InvalidValueError(I7000Error, ValueError):
    """A value that a field or an argument cannot have, such as a negative timeout.

    Shape: `field`, `value`, `allowed` (the allowed values, or the models that have it), `section` of the manual, empty
        if the manual is not the reason; `reason`, a text in place of "field cannot be value".
    """

    def __init__(self, field: str, value: object, allowed: str, section: str, reason: str = "") -> None:
        super().__init__(field, value, allowed, section, reason)
        self.field = field
        self.value = value
        self.allowed = allowed
        self.section = section
        self.reason = reason

    def __str__(self) -> str:
        reason = self.reason or f"{self.field} cannot be {shown(self.value)}"
        source = f", manual {self.section}" if self.section else ""
        return f"{reason}: {self.allowed}{source}"


class EncodeError(InvalidValueError):
    """A value that cannot be sent, or that no module can have."""


class DecodeError(I7000Error, ValueError):
    """Bytes that cannot be decoded; `wire` has all of them.

    Shape: `fault`, `wire`, `offset` (of the invalid byte or field), `field` (its name, or empty), `allowed`, `section`.
    """

    def __init__(  # noqa: PLR0913 - the facts of one fault
        self, fault: Fault, wire: bytes, offset: int = 0, *, field: str = "", allowed: str = "", section: str = ""
    ) -> None:
        super().__init__(fault, wire, offset, field, allowed, section)
        self.fault = fault
        self.wire = wire
        self.offset = offset
        self.field = field
        self.allowed = allowed
        self.section = section

    def __reduce__(self) -> tuple[object, ...]:
        return _decode_error, self.args

    def __str__(self) -> str:
        where = f" in {self.field}" if self.field not in ("", self.fault.value) else ""
        allowed = f"; allowed: {self.allowed}" if self.allowed else ""
        source = f" (manual {self.section})" if self.section else ""
        frame = written(self.wire) or "an empty frame"
        return f"{self.fault.value}{where} at byte {self.offset} of {frame}{allowed}{source}"


def _decode_error(fault: Fault, wire: bytes, offset: int, *facts: str) -> DecodeError:
    field, allowed, section = facts
    return DecodeError(fault, wire, offset, field=field, allowed=allowed, section=section)


class ArgumentError(I7000Error, TypeError):
    """An argument of the wrong type.

    Shape: `argument` (its name), `value`, `allowed` (the allowed types); `reason` as in `EncodeError`.
    """

    def __init__(self, argument: str, value: object, allowed: str, reason: str = "") -> None:
        super().__init__(argument, value, allowed, reason)
        self.argument = argument
        self.value = value
        self.allowed = allowed
        self.reason = reason

    def __str__(self) -> str:
        if self.reason:
            return f"{self.reason}: {self.allowed}"
        return f"{self.argument} must be {self.allowed}, not {shown(self.value)} ({type(self.value).__name__})"


class StateError(I7000Error):
    """A call at the wrong time: a request is still open, or the clock went back; the text says what to do next."""


def _named(value: object) -> object:
    """Return the name of an enumeration member, alone or in a tuple; other values unchanged."""
    if type(value) is tuple:
        return tuple(map(_named, value))
    return value.name if isinstance(value, Enum) else value


_SHOWN = 60
"""The maximum length of a value in a message; the attribute has the whole value."""


def shown(value: object) -> str:
    """Return a value as text for a message, shortened if necessary; never raises."""
    try:
        text = repr(_named(value))
    except ValueError:  # sys.set_int_max_str_digits
        return f"a value of {type(value).__name__} with a number too long to print"
    except Exception:  # noqa: BLE001 - a `__repr__` of another's
        return f"a value of {type(value).__name__} whose repr() fails"
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN]}... ({len(text)} characters)"


_ESCAPES = {byte: f"\\x{byte:02X}" for byte in range(0x100) if not 0x20 <= byte <= 0x7E} | {
    ord("\r"): r"\r", ord("\n"): r"\n", ord("\t"): r"\t", ord("\\"): r"\\",
}  # fmt: skip
_TEXT = bytes((*range(0x20, 0x7F), *b"\r\n\t"))


def written(wire: bytes) -> str:
    r"""Return bytes as people write frames: DCON as text with escapes, Modbus as pairs of hex digits.

    Shape: text if at least half of the bytes are text, and for a single byte; else hex. More than 60 characters of text
        or 20 bytes of hex are cut. Whatever is not cut has no second reading: blanks at the ends are escaped, and so is
        each blank of a text that would read as hex.

    >>> print(written(b"$012B6\r"), written(b"!01\xff\r"), written(bytes.fromhex("010400000008F1CC")), sep=", ")
    $012B6\r, !01\xFF\r, 01 04 00 00 00 08 F1 CC
    """
    part = wire[:_SHOWN]
    if len(part) > 1 and len(part.translate(None, _TEXT)) * 2 > len(part):
        most = _SHOWN // 3
        text = part[:most].hex(" ").upper()
    else:
        most = _SHOWN
        text = re.sub("^ +| +$", lambda blanks: r"\x20" * len(blanks[0]), part.decode("latin-1").translate(_ESCAPES))
        if re.fullmatch("[0-9A-F]{2}( [0-9A-F]{2})+", text):
            text = text.replace(" ", r"\x20")
    return text if len(wire) <= most else f"{text}... ({len(wire)} bytes)"


@frozen
class Noise:
    """Bytes of a stream that belong to no frame, and the fault of the first of them."""

    wire: bytes
    fault: Fault
