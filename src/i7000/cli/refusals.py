"""Refusals of values, with the values as they were written at the terminal."""

from i7000 import InvalidValueError

__all__ = ["as_written"]


def as_written(refusal: InvalidValueError, name: str, text: str, allowed: str = "") -> InvalidValueError:
    """Return a refusal with the name and text of a value as they were written, and `allowed` if it is given.

    >>> print(as_written(InvalidValueError("type_codes", "K", "V_10 V_5: I-7017", "1.11"), "type", "k"))
    type cannot be k: V_10 V_5: I-7017, manual 1.11
    """
    reason = refusal.reason or f"{name} cannot be {text or 'empty'}"
    return InvalidValueError(name, text, allowed or refusal.allowed, refusal.section, reason)
