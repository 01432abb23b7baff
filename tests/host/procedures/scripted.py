"""Procedures whose requests have outcomes written by hand."""

from collections.abc import Callable, Mapping
from typing import Any, TypeVar

from i7000 import dcon, modbus
from i7000.host import Answered, Declined, Ended, TimedOut
from i7000.host.procedures import Ask, Procedure, Result

T = TypeVar("T")

Outcomes = Mapping[type, Callable[[Any], Any]]
"""What comes of each class of request: a function of it that returns a response, a `Result`, or None for silence."""


def refused(command: Any) -> Any:
    """Refuse a request in its protocol."""
    if isinstance(command, modbus.Request):
        return modbus.ExceptionResponse(command.address, command.function, 1)
    return dcon.Refused(command.address)


def unanswered(_: Any) -> None:
    """Leave a request without an answer."""


def run(procedure: Procedure[T], outcomes: Outcomes) -> tuple[T, list[Any]]:
    """Return what a procedure returns with these outcomes, silence for any other request; and its steps."""
    steps: list[Any] = []
    reply: Any = None
    while True:
        try:
            step = procedure.send(reply)
        except StopIteration as end:
            return end.value, steps
        steps.append(step)
        reply = _result(step, outcomes) if isinstance(step, Ask) else None


def _result(step: Ask[Any], outcomes: Outcomes) -> Result[Any]:
    command: Any = step.command
    answer: Callable[[Any], Any] = outcomes.get(type(command), unanswered)
    response = answer(command)
    if isinstance(response, Result):
        return response
    outcome: Ended = TimedOut(command)
    if isinstance(response, dcon.Refused | modbus.ExceptionResponse):
        outcome = Declined(command, response)
    elif response is not None:
        outcome = Answered(command, response)
    return Result(outcome)  # type: ignore[arg-type] # every outcome is one


def commands(steps: list[Any]) -> list[Any]:
    """Return the requests among steps."""
    return [step.command for step in steps if isinstance(step, Ask)]
