"""Values of JSON as Lua."""

import re
from collections.abc import Iterator

__all__ = ["assigned"]

WIDTH = 120
"""The longest line, if it can be broken."""
_NAME = re.compile(r"[A-Za-z_]\w*")
_WORDS = frozenset(("and", "end", "for", "function", "if", "in", "not", "or", "repeat", "then", "until", "while"))
"""Words of Lua that may be names in ``spec/``."""


def assigned(name: str, value: object) -> str:
    """Return a statement that gives a local variable a value.

    >>> print(assigned("KINDS", [{"name": "a", "no": None, "of": {1: True}}]), end="")
    local KINDS = { { name = "a", of = { [1] = true } } }
    """
    return "\n".join(_lines(f"local {name} = ", value, 0)) + "\n"


def _lines(before: str, value: object, indent: int) -> Iterator[str]:
    """Yield a value in one line if it is short enough, else a line for each of its items."""
    short = " " * indent + before + _short(value)
    if len(short) < WIDTH or not isinstance(value, dict | list):
        yield short
        return
    yield " " * indent + before + "{"
    for key, item in _items(value):
        *lines, last = _lines(key, item, indent + 4)
        yield from lines
        yield last + ","
    yield " " * indent + "}"


def _items(value: dict[str | int, object] | list[object]) -> Iterator[tuple[str, object]]:
    """Yield keys as they are written, and items; those without a value are left out."""
    if isinstance(value, list):
        yield from (("", item) for item in value)
        return
    for key, item in value.items():
        if item is not None:
            yield f"{_key(key)} = ", item


def _key(key: str | int) -> str:
    return key if isinstance(key, str) and _NAME.fullmatch(key) and key not in _WORDS else f"[{_short(key)}]"


def _short(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return '"' + "".join(_escaped(character) for character in value) + '"'
    if isinstance(value, dict | list):
        inside = ", ".join(key + _short(item) for key, item in _items(value))
        return f"{{ {inside} }}" if inside else "{}"
    return repr(value)


def _escaped(character: str) -> str:
    return {"\\": "\\\\", '"': '\\"', "\n": "\\n"}.get(character, character)
