"""What comes of calling a function that may refuse what it is given."""

from collections.abc import Callable
from typing import Any, TypeVar

from i7000 import DecodeError, EncodeError

__all__ = ["decoded", "encoded"]

T = TypeVar("T")


def decoded(read: Callable[..., T], *arguments: Any) -> T | DecodeError:
    """What a decoder returns or, with facts that fit the bytes, raises."""
    try:
        return read(*arguments)
    except DecodeError as error:
        found = error

    wire = arguments[0]
    assert wire == found.wire
    assert 0 <= found.offset <= len(wire)
    assert str(found).startswith(f"{found.fault.value} ")
    return found


def encoded(write: Callable[..., T], *arguments: Any, **fields: Any) -> T | EncodeError:
    """What an encoder or a constructor returns or raises."""
    try:
        return write(*arguments, **fields)
    except EncodeError as error:
        return error
