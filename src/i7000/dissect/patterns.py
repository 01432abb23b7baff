"""Regular expressions that are compiled when they are first used, so that an import stays short."""

import re
from typing import Any, cast

__all__ = ["pattern"]

_METHODS = ("finditer", "fullmatch", "match", "search", "sub")


class _Pattern:
    def __init__(self, text: str, flags: re.RegexFlag) -> None:
        self._text = text
        self._flags = flags

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - a method of a pattern
        if name not in _METHODS:
            raise AttributeError(name)
        compiled = re.compile(self._text, self._flags)
        for method in _METHODS:
            setattr(self, method, getattr(compiled, method))
        return getattr(compiled, name)


def pattern(text: str, flags: re.RegexFlag = re.NOFLAG) -> re.Pattern[str]:
    """Return a pattern that has the methods of `re.compile`, which it calls when the first of them is needed.

    >>> pattern("[0-9]+").search("COM3")[0]
    '3'
    """
    return cast("re.Pattern[str]", _Pattern(text, flags))
