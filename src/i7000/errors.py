"""What can be wrong: every error of the package lives here.

Laws: given arguments of the right types, an encoder raises nothing but `EncodeError`, a decoder nothing but
`DecodeError`. A function called with another type raises `ArgumentError`. A constructor raises `InvalidValueError` for
a value that the field cannot have, whatever its type; `EncodeError` is the kind of it for messages and for what modules
can be. What a module may legally say is never an error: a refusal (``?AA``) is a value.
"""

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
]


class Fault(Enum):
    """Why bytes are not a frame, or a frame is not a message."""

    LENGTH = "length"
    """Too short or too long for what it is; or more than 256 bytes without an end."""
    TERMINATOR = "terminator"
    """The carriage return is missing, or comes early."""
    CHARACTER = "character"
    """A byte that may not stand where it stands: not ASCII, a lower-case digit, another letter than the syntax has."""
    LEADING = "leading"
    """Not the leading character of a message of this direction or kind."""
    CHECKSUM = "checksum"
    """The checksum is missing, wrong or in lower case."""
    COMMAND = "command"
    """No module has a command of this form."""
    UNSUPPORTED = "unsupported"
    """The command exists, but not on this model or firmware."""
    ADDRESS = "address"
    """The answer of another module than the one asked."""
    NUMBER = "number"
    """A data field that is not a number of its format."""
    VALUE = "value"
    """A digit or byte outside the few that are defined for its place."""
    CRC = "crc"
    """The CRC of a Modbus RTU frame is wrong."""
    FUNCTION = "function"
    """A function code that these modules do not have, or not the one that was asked for."""
    SUB_FUNCTION = "sub_function"
    """The same of the sub-function of function 46h."""
    RANGE = "range"
    """More items than one frame may ask for or carry, none at all, or items beyond address 65535."""
    COUNT = "count"
    """The byte count, or the number of items, does not agree with the rest of the frame or with the request."""
    ECHO = "echo"
    """A response that does not repeat what its request said."""
    RESERVED = "reserved"
    """A reserved byte or bit that is not zero."""


class I7000Error(Exception):
    """The base of every error that this package raises on purpose; it can be told whatever its facts are."""

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(map(shown, self.args))})"


class InvalidValueError(I7000Error, ValueError):
    """A value that a field or an argument cannot have, such as a negative timeout.

    Shape: `field`, `value`, `allowed` (what it could be, or who can), `section` of the manual, empty where the manual
        is not the reason; `reason` where more is to say than that the field cannot have the value.
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
    """Bytes that are not what they should be; `wire` holds them all, nothing is lost.

    Shape: `fault`, `wire`, `offset` (of the byte at fault, or of the field that is as a whole), `field` (its name, or
        empty), `allowed`, `section`.
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
        return f"{self.fault.value}{where} at byte {self.offset} of {shown(self.wire)}{allowed}{source}"


def _decode_error(fault: Fault, wire: bytes, offset: int, *facts: str) -> DecodeError:
    field, allowed, section = facts
    return DecodeError(fault, wire, offset, field=field, allowed=allowed, section=section)


class ArgumentError(I7000Error, TypeError):
    """An argument of a type that the function does not work on.

    Shape: `argument` (its name), `value` (what was given), `allowed` (the types that it can have); `reason` as in
        `EncodeError`.
    """

    def __init__(self, argument: str, value: object, allowed: str, reason: str = "") -> None:
        super().__init__(argument, value, allowed, reason)
        self.argument = argument
        self.value = value
        self.allowed = allowed
        self.reason = reason

    def __str__(self) -> str:
        reason = self.reason or f"{self.argument} cannot be {shown(self.value)} ({type(self.value).__name__})"
        return f"{reason}: {self.allowed}"


class StateError(I7000Error):
    """A call at the wrong time: a request is still open, or the clock went back; the text says what to do instead."""


def _named(value: object) -> object:
    """A member of an enumeration by its name, alone or in a tuple."""
    if type(value) is tuple:
        return tuple(map(_named, value))
    return value.name if isinstance(value, Enum) else value


_SHOWN = 60
"""Characters of a value that a message shows; the attribute holds all of it."""


def shown(value: object) -> str:
    """Write a value for a message: whole if that is short, and never with an error of its own."""
    try:
        text = repr(_named(value))
    except ValueError:  # sys.set_int_max_str_digits
        return f"a number too long to be written, of or in {type(value).__name__}"
    except Exception:  # noqa: BLE001 - a `__repr__` of another's
        return f"a value that cannot be written, of {type(value).__name__}"
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN]}... ({len(text)} characters)"


@frozen
class Noise:
    """Bytes of a stream that belong to no frame, and what was wrong with the first of them."""

    wire: bytes
    fault: Fault
