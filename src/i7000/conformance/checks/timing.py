"""When the module answers, and what it takes for one frame (manual 2, 3)."""

from i7000.conformance.checks.steps import Steps
from i7000.conformance.oracle import difference
from i7000.conformance.subject import Subject
from i7000.conformance.verdict import Note
from i7000.host.procedures import Procedure
from i7000.settings import Protocol

__all__ = ["STEPS"]

_GAP = 0.01
"""The pause in seconds between characters of a slow host."""
_BREAK = 0.1
"""A pause that no frame of Modbus RTU survives."""
_AFTER_BROADCAST = 0.002
_TOLERANCE = 0.003
"""How much earlier than due an answer can seem, in seconds."""
_REPEATS = 12


def _by_character(module: Subject) -> Procedure[None]:
    """Send a request by single characters; by Modbus in two pieces, since other ports put gaps between characters."""
    wire = module.wire(module.sentinel)
    answer = module.hear_sentinel()
    if module.protocol is Protocol.DCON:
        pieces: list[bytes | tuple[float, bytes]] = [(_GAP, wire[at : at + 1]) for at in range(len(wire))]
    else:
        pieces = [wire[:3], wire[3:]]
    heard = (yield from module.send(*pieces)).wire
    if difference(answer, heard):
        yield from module.alive(wire)
        raise module.wrong("a request in pieces is not understood", wire, heard, "the answer to it")


def _broken(module: Subject) -> Procedure[None]:
    wire = module.wire(module.sentinel)
    yield from module.silent(wire[:3], (_BREAK, wire[3:]))


def _together(module: Subject) -> Procedure[None]:
    wire = module.wire(module.sentinel)
    answer = module.hear_sentinel().wire or b""
    heard = (yield from module.send(wire + wire)).wire
    heard += (yield from module.send(b"")).wire  # a slow module needs its time twice
    if heard not in (answer, answer * 2, b""):
        raise module.wrong("another answer", wire * 2, heard, "one answer, two, or none")
    yield from module.alive(wire)
    count = len(heard) // len(answer)
    words = ("neither", "one", "both")[count]
    raise Note(f"of two requests without a pause between them, the module answers {words}")


def _repeated(module: Subject) -> Procedure[None]:
    for _ in range(_REPEATS):
        yield from module.expect(module.sentinel)


def _delayed(module: Subject) -> Procedure[None]:
    delay = module.twin.state.response_delay
    wire = module.wire(module.sentinel)
    heard = yield from module.send(wire)
    if not heard.wire:
        yield from module.alive(wire)
    first = heard.pieces[0][0] if heard.pieces else delay
    if first < delay - _TOLERANCE:
        text = f"the answer came {first * 1000:.0f} ms after the request"
        raise module.wrong(text, wire, heard.wire, f"not before {delay * 1000:.0f} ms")


def _after_broadcast(broadcast: bytes) -> Steps:
    def steps(module: Subject) -> Procedure[None]:
        wire = module.wire(module.sentinel)
        frame = module.seal(broadcast)
        module.hear(frame)
        answer = module.hear_sentinel()
        heard = (yield from module.send(frame, (_AFTER_BROADCAST, wire))).wire
        if difference(answer, heard):
            raise module.wrong("a request 2 ms after a broadcast has another answer", frame + wire, heard, "its answer")

    return steps


STEPS: dict[str, Steps] = {
    "timing/by-character": _by_character,
    "timing/broken": _broken,
    "timing/together": _together,
    "timing/repeated": _repeated,
    "timing/response-delay": _delayed,
    "timing/after-sampling": _after_broadcast(b"#**"),
    "timing/after-host-ok": _after_broadcast(b"~**"),
}
