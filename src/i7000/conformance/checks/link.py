"""Whether there is a module on the line, whether it is alone, and how soon it answers."""

from i7000.conformance.checks.steps import Steps
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Difference, Skipped, SkipReason, Strange
from i7000.host.procedures import Procedure

__all__ = ["STEPS"]

_LISTEN = 1.0
_SLOW = 0.2
"""The longest time in seconds to an answer that hosts wait for with the usual settings."""


def _alive(module: Subject) -> Procedure[None]:
    yield from module.expect(module.sentinel)


def _quiet(module: Subject) -> Procedure[None]:
    heard = (yield from module.send(b"", seconds=_LISTEN)).wire
    if heard:
        raise module.wrong(f"{len(heard)} bytes without a request", b"", heard, "silence")
    yield from module.alive(b"")


def _echo(module: Subject) -> Procedure[None]:
    wire = module.wire(module.sentinel)
    heard = (yield from module.send(wire)).wire
    if heard.startswith(wire):
        raise Strange("the request comes back before the answer: give --echo", sent=wire, received=heard)
    try:
        yield from module.alive(wire)
    except Difference:
        raise Skipped(SkipReason.PREREQUISITE, "the module does not answer as it should: see link/alive") from None


def _prompt(module: Subject) -> Procedure[None]:
    wire = module.wire(module.sentinel)
    heard = yield from module.send(wire)
    if not heard.wire:
        yield from module.alive(wire)
    took = heard.pieces[0][0] - module.twin.state.response_delay if heard.pieces else 0.0
    if took > _SLOW * module.timeout_scale:
        text = f"the answer came after {took * 1000:.0f} ms: many hosts wait for {_SLOW * 1000:.0f} ms"
        raise Strange(text, sent=wire, received=heard.wire)


STEPS: dict[str, Steps] = {
    "link/alive": _alive,
    "link/no-stray-bytes": _quiet,
    "link/no-echo": _echo,
    "link/prompt": _prompt,
}
