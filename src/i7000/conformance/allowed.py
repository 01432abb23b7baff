"""Procedures on a port with a guard: what the guard refuses ends a question, not the procedure.

Laws: nothing that the guard refuses is sent. A refused question is reported, and counts as one without an answer.
"""

from typing import Any, TypeVar

from i7000 import modbus
from i7000.conformance.guard import GuardError
from i7000.errors import I7000Error
from i7000.host.events import TimedOut
from i7000.host.procedures.step import Ask, Procedure, Result, SendBytes, Tell, Wait

__all__ = ["LINE_END", "SILENCE", "as_allowed"]

T = TypeVar("T")

SILENCE = 0.3
"""The silence in seconds that ends every request by Modbus, also for the guard of the port."""
LINE_END = b"#\r"
"""The bytes that end every line of text, and that no module carries out."""


def as_allowed(procedure: Procedure[T]) -> Procedure[T]:
    """Make the procedure that does the same on a port with a guard, apart from what the guard refuses.

    Shape: it yields a `Tell` with the `GuardError` of each refused request. The procedure is sent a
        `i7000.host.TimedOut`, as if there were no answer.
    Special: a request by Modbus may be refused only because of text that earlier requests left on the line. It is sent
        again after `LINE_END`.

    >>> from i7000.host.procedures import identify
    >>> next(as_allowed(identify(0xFF))).command
    ReadConfiguration(address=0xFF)
    """
    answer: Any = None
    refusal: I7000Error | None = None
    while True:
        try:
            step = procedure.throw(refusal) if refusal else procedure.send(answer)
        except StopIteration as end:
            value: T = end.value
            return value
        answer, refusal = None, None
        try:
            answer = (yield from _asked(step)) if isinstance(step, Ask) else (yield step)
        except I7000Error as error:
            refusal = error


def _asked(step: Ask[Any]) -> Procedure[Any]:
    """Make the procedure of one request that the guard may refuse."""
    try:
        try:
            return (yield step)
        except GuardError as error:
            if not (error.before and isinstance(step.command, modbus.Request)):
                raise
        yield Wait(SILENCE)
        yield SendBytes(((0.0, LINE_END),), 0.0)
        return (yield step)
    except GuardError as error:
        yield Tell(error)
        return Result(TimedOut(step.command))
