"""Procedures that ask everything twice, for lines whose damage no checksum shows."""

from collections.abc import Generator
from typing import Any, TypeVar

from i7000.arguments import check_type
from i7000.host.events import TimedOut
from i7000.host.procedures.step import Ask, Procedure, Result

__all__ = ["confirmed"]

T = TypeVar("T")

_MOST = 3
"""How often a question is asked until two outcomes agree."""


def confirmed(procedure: Procedure[T]) -> Procedure[T]:
    """Make the procedure that does the same, but believes an answer only if the module gives it twice.

    Shape: each request is sent until two outcomes agree, at most three times. If none do, the procedure is sent a
        `i7000.host.TimedOut`, as if there were no answer.
    Special: use it for what stays the same, such as `identify` without a checksum. Readings change between two reads.
    Errors: `ArgumentError` for anything but a procedure.

    >>> from i7000.host.procedures import identify
    >>> next(confirmed(identify(0x01))).command
    ReadConfiguration(address=0x01)
    """
    check_type("procedure", procedure, Generator)
    return _confirmed(procedure)


def _confirmed(procedure: Procedure[T]) -> Procedure[T]:
    reply: Any = None
    while True:
        try:
            step = procedure.send(reply)
        except StopIteration as end:
            value: T = end.value
            return value
        reply = (yield from _asked(step)) if isinstance(step, Ask) else (yield step)


def _asked(step: Ask[Any]) -> Procedure[Result[Any]]:
    """Make the procedure of one request that is confirmed."""
    outcomes: list[object] = []
    others: tuple[Any, ...] = ()
    for _ in range(_MOST):
        result: Result[Any] = yield step
        others += result.others
        if result.outcome in outcomes or (not outcomes and isinstance(result.outcome, TimedOut)):
            return Result(result.outcome, others)
        outcomes.append(result.outcome)
    return Result(TimedOut(step.command), others)
