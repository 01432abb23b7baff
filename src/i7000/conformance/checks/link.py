"""Whether there is a module on the line, and whether it is alone."""

from i7000.conformance.checks.steps import Steps
from i7000.conformance.subject import Subject
from i7000.host.procedures import Procedure

__all__ = ["STEPS"]


def _alive(module: Subject) -> Procedure[None]:
    yield from module.expect(module.sentinel)


def _quiet(module: Subject) -> Procedure[None]:
    heard = (yield from module.send(b"", seconds=1.0)).wire
    if heard:
        raise module.wrong(f"{len(heard)} bytes without a request", b"", heard, "silence")
    yield from module.alive(b"")


STEPS: dict[str, Steps] = {"link/alive": _alive, "link/no-stray-bytes": _quiet}
