"""Compilation of source generated from message classes, and the constructor that both protocols share.

Laws: generated code is readable: tracebacks and debuggers show its lines like those of any other source.
"""

import linecache
from collections.abc import Callable, Container, Iterable, Iterator, Mapping
from typing import Any, Never, Protocol

from i7000.errors import EncodeError

__all__ = ["Field", "compiled", "constructor_names", "constructor_source"]


def compiled(source: str, name: str, names: dict[str, Any]) -> dict[str, Any]:
    """Execute the source of functions, which can use `names`, and return the namespace with the functions.

    >>> compiled("def double(it): return factor * it", "doctest", {"factor": 2})["double"](21)
    42
    """
    place = f"<i7000: {name}>"
    exec(compile(source, place, "exec"), names)  # noqa: S102 - made of our own statements
    linecache.cache[place] = (len(source), None, source.splitlines(keepends=True), place)
    return names


class Field(Protocol):
    """The values of a message field."""

    @property
    def allowed(self) -> str:
        """The allowed values, for messages."""

    @property
    def accepts(self) -> Callable[[Any], bool]:
        """Return whether the field can have a value."""

    @property
    def bounds(self) -> tuple[int, int] | None:
        """The range of a plain number."""


def constructor_source(fields: Mapping[str, Field], keywords: Container[str], more: Iterable[str]) -> Iterator[str]:
    """Yield the lines of a constructor that raises for values that no message of a class can have.

    Shape: `keywords` are the keyword-only fields; `more` are lines that check combinations of fields.
    Special: most values are plain numbers within bounds, so that is checked first; `accepts` also accepts other kinds
        of int.
    """
    positional = [name for name in fields if name not in keywords]
    named = [name for name in fields if name in keywords]
    yield f"def construct({', '.join(['self', *positional, *['*'] * bool(named), *named])}):"
    if not fields:
        yield "    pass"
    for name, field in fields.items():
        plain = ""
        if field.bounds:
            low, high = field.bounds
            plain = f"not ({name}.__class__ is int and {low} <= {name} <= {high}) and "
        yield f"    if {plain}not accepts_{name}({name}):"
        yield f"        refuse({name!r}, {name})"
    yield from more
    yield from (f"    set_{name}(self, {name})" for name in fields)


def constructor_names(message: Any, fields: Mapping[str, Field]) -> dict[str, Any]:  # noqa: ANN401 - a message class
    """Return the names that `constructor_source` uses.

    Errors: its `refuse` raises `EncodeError`.
    """

    def refuse(name: str, value: object, allowed: str = "") -> Never:
        raise EncodeError(name, value, allowed or fields[name].allowed, message.section)

    names: dict[str, Any] = {"refuse": refuse}
    for name, field in fields.items():
        names |= {f"accepts_{name}": field.accepts, f"set_{name}": getattr(message, name).__set__}
    return names
