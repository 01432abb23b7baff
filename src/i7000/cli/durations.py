"""Durations as people write them, ``500ms``, ``1s``, ``2``, ``1min``, and as they read them."""

import re

from i7000.cli.words import UsageError

__all__ = ["duration_words", "seconds"]

_SECONDS = {"ms": 0.001, "": 1.0, "s": 1.0, "min": 60.0, "h": 3600.0}
_DURATION = re.compile(r"([0-9]{1,9}(?:\.[0-9]{1,9})?|\.[0-9]{1,9}) *([a-z]*)")


def seconds(text: str) -> float:
    """Read a duration.

    Unit: seconds.
    Errors: `UsageError`.

    >>> seconds("500ms"), seconds("2"), seconds("1.5 s"), seconds("1min")
    (0.5, 2.0, 1.5, 60.0)
    """
    match = _DURATION.fullmatch(text.strip())
    if not match or match[2] not in _SECONDS:
        raise UsageError(f"{text!r} is not a duration: write 500ms, 1s, 2 (seconds), 1min or 1h")
    return float(match[1]) * _SECONDS[match[2]]


def duration_words(seconds: float) -> str:
    """Return a duration in words.

    >>> duration_words(0.4), duration_words(75), duration_words(7300)
    ('1 s', '1 min 15 s', '2 h 1 min')
    """
    whole = max(1, round(seconds))
    hours, minutes, rest = whole // 3600, whole // 60 % 60, whole % 60
    if hours:
        return f"{hours} h {minutes} min"
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"
