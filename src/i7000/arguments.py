"""Checks of the arguments of public functions: one rule for all of them.

Laws: bytes, bytearray and memoryview are accepted as bytes; results never share memory with them. An argument of the
wrong type raises `ArgumentError`; a value out of range does not.
"""

from collections.abc import Iterable, Mapping
from enum import Enum
from types import NoneType
from typing import Any, TypeVar

from i7000.errors import ArgumentError, InvalidValueError, StateError

__all__ = [
    "as_bytes",
    "as_tuple",
    "check_clock",
    "check_fields",
    "check_int",
    "check_seconds",
    "check_type",
    "is_number",
    "kind_words",
]

T = TypeVar("T")

LARGEST_FLOAT = float.fromhex("0x1.fffffffffffffp+1023")
_BYTES_LIKE = "bytes, bytearray or memoryview"
_BYTES_LIKE_KINDS = (bytes, bytearray, memoryview)
_NUMBERS = (int, float)


def as_bytes(name: str, value: object) -> bytes:
    """Return a bytes-like argument as bytes.

    Errors: `ArgumentError` for another type, and for a memoryview that was released.
    """
    if value.__class__ is bytes:
        return value
    if not isinstance(value, _BYTES_LIKE_KINDS):
        raise ArgumentError(name, value, _BYTES_LIKE)
    try:
        return memoryview(value).tobytes()
    except ValueError:
        raise ArgumentError(name, value, _BYTES_LIKE, f"{name} is a memoryview that was released") from None


def as_tuple(name: str, values: Iterable[T]) -> tuple[T, ...]:
    """Return the items of an iterable argument.

    Errors: `ArgumentError` for an object that is not iterable.
    """
    try:
        items = iter(values)
    except TypeError:
        raise ArgumentError(name, values, "an iterable") from None
    return tuple(items)


def check_type(name: str, value: object, *kinds: Any, optional: bool = False) -> None:  # noqa: ANN401 - classes
    """Check that an argument is an instance of one of `kinds`; or None, if it is optional.

    Errors: `ArgumentError`.
    """
    if not isinstance(value, kinds) and not (optional and value is None):
        names = [kind.__name__ for kind in kinds] + ["None"] * optional
        raise ArgumentError(name, value, " or ".join(names))


def check_int(name: str, value: object) -> None:
    """Check that an argument is an int and not a bool.

    Errors: `ArgumentError`.
    """
    if not isinstance(value, int) or isinstance(value, bool):
        raise ArgumentError(name, value, "int")


def check_fields(instance: object, kinds: Mapping[str, tuple[type, ...]]) -> None:
    """Check that fields are instances of the classes that are named for them.

    Errors: `InvalidValueError`.
    """
    for name, allowed in kinds.items():
        value = getattr(instance, name)
        if not isinstance(value, allowed):
            raise InvalidValueError(name, value, " or ".join(map(kind_words, allowed)), "")


def kind_words(kind: type) -> str:
    """Return the words for the values of a class, for messages.

    >>> kind_words(bool), kind_words(int), kind_words(type(None))
    ('True or False', 'an instance of int', 'None')
    """
    if kind in _KIND_WORDS:
        return _KIND_WORDS[kind]
    return f"{'a member' if issubclass(kind, Enum) else 'an instance'} of {kind.__name__}"


_KIND_WORDS: dict[type, str] = {bool: "True or False", NoneType: "None"}


def is_number(value: object) -> bool:
    """Return whether a value is a finite number that fits in a float, and not a bool."""
    return isinstance(value, _NUMBERS) and not isinstance(value, bool) and abs(value) <= LARGEST_FLOAT


def check_seconds(name: str, value: object) -> None:
    """Check that a field is a time in seconds.

    Errors: `InvalidValueError`.
    """
    if not is_number(value):
        raise InvalidValueError(name, value, "a finite number of seconds", "")


def check_clock(now: float, before: float = -LARGEST_FLOAT) -> None:
    """Check a clock reading in seconds against the previous one, `before`.

    Errors: `ArgumentError` for another type, `InvalidValueError` for a number that is not finite, `StateError` for a
        clock that went back.
    """
    if not isinstance(now, _NUMBERS) or isinstance(now, bool):
        raise ArgumentError("now", now, "int or float")
    check_seconds("now", now)
    if now < before:
        raise StateError(f"the clock went back from {before!r} to {now!r}: use a monotonic clock")
