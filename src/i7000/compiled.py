"""Source that is made from the statements of messages, compiled; and the check of values, which both protocols share.

Laws: what is made can be read: tracebacks and debuggers show its lines, as those of any other source.
"""

import linecache
from collections.abc import Callable, Iterator, Mapping
from typing import Any, Never, Protocol

from i7000.errors import EncodeError

__all__ = ["Field", "check_names", "check_source", "compiled"]


def compiled(source: str, name: str, names: dict[str, Any]) -> dict[str, Any]:
    """Run the source of some functions, which can use `names`, and return these names with theirs.

    >>> compiled("def double(it): return factor * it", "doctest", {"factor": 2})["double"](21)
    42
    """
    place = f"<i7000: {name}>"
    exec(compile(source, place, "exec"), names)  # noqa: S102 - made of our own statements
    linecache.cache[place] = (len(source), None, source.splitlines(keepends=True), place)
    return names


class Field(Protocol):
    """What the field of a message can be."""

    @property
    def allowed(self) -> str:
        """Its values, for messages."""

    @property
    def accepts(self) -> Callable[[Any], bool]:
        """Whether the field can have a value."""

    @property
    def bounds(self) -> tuple[int, int] | None:
        """The range of a plain number."""


def check_source(fields: Mapping[str, Field]) -> Iterator[str]:
    """Yield the lines of a function that refuses values that no message of a class can have.

    Special: a plain number within its bounds is nearly always there, so it is looked at first; `accepts` takes other
        kinds of int too.
    """
    yield "def check(m):"
    if not fields:
        yield "    pass"
    for name, field in fields.items():
        plain = ""
        if field.bounds:
            low, high = field.bounds
            plain = f"not ({name}.__class__ is int and {low} <= {name} <= {high}) and "
        yield f"    {name} = m.{name}"
        yield f"    if {plain}not accepts_{name}({name}):"
        yield f"        refuse({name!r}, {name})"


def check_names(fields: Mapping[str, Field], section: str) -> dict[str, Any]:
    """Return what `check_source` uses.

    Errors: its `refuse` raises `EncodeError`, with `section` of the manual.
    """

    def refuse(name: str, value: object, allowed: str = "") -> Never:
        raise EncodeError(name, value, allowed or fields[name].allowed, section)

    return {f"accepts_{name}": field.accepts for name, field in fields.items()} | {"refuse": refuse}
