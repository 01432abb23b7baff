"""Many small cases in one test.

pytest and its workers spend some 10 ms on a test; most vectors need far less than 1 ms. `each` makes one test of all
cases. It goes on after a case that fails, and shows every one that failed, with its id.
"""

import inspect
from collections.abc import Callable, Iterable
from functools import wraps
from typing import Any

import pytest

Check = Callable[..., None]


def each(names: str | tuple[str, ...], cases: Iterable[Any]) -> Callable[[Check], Check]:
    """A decorator that runs a test with every case, as `pytest.mark.parametrize` does, but as one test.

    A case is a value for the one name, or a `pytest.param` with a value for each.
    Errors: a group of what the failing cases raised, each with a note that names the case.
    """
    given = (names,) if isinstance(names, str) else names
    found = [case if hasattr(case, "values") else pytest.param(case, id=repr(case)) for case in cases]
    assert found

    def decorate(check: Check) -> Check:
        @wraps(check)
        def test(**fixtures: Any) -> None:
            failures: dict[str, BaseException] = {}
            for case in found:
                try:
                    check(**dict(zip(given, case.values, strict=True)), **fixtures)
                except (Exception, pytest.fail.Exception) as failure:  # noqa: BLE001 - whatever it is, it is shown
                    failure.add_note(f"of the case {case.id}")
                    failures[str(case.id)] = failure
            if failures:
                raise BaseExceptionGroup(
                    f"{len(failures)} of {len(found)} cases: {', '.join(failures)}", [*failures.values()]
                )

        signature = inspect.signature(check)
        kept = [parameter for name, parameter in signature.parameters.items() if name not in given]
        vars(test)["__signature__"] = signature.replace(parameters=kept)
        return test

    return decorate
