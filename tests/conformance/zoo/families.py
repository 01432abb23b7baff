"""Two firmwares for whole families of checks: everything is acknowledged and nothing done, and every answer is short.

Laws: the answer to the plain read that shows that a module is there is right.
"""

import re
from collections.abc import Iterator

from i7000 import Model, Protocol
from i7000.conformance.hazard import Hazard
from i7000.device import State
from tests.conformance.zoo.animal import Animal
from tests.conformance.zoo.species import Herd, answering, body_of, sealed, settings

SENTINELS = re.compile(rb"\$01M|\x01F\x00")
_SETS = re.compile(
    rb"%01.*|\$01(5|7C|9.|A.|P.|S|[01]).*|~01(C.|E|I|O|T|1|3).*|@01S..*|[~#]\*\*.*"
    rb"|\x01[\x05\x06\x0f\x10].*|\x01F[\x04\x06\x08\x26\x2a\x2c\x2e\x30].*",
    re.DOTALL,
)
"""The commands and requests that change something, whatever follows them."""

ShortAnswers = answering(lambda heard, said: said if SENTINELS.match(heard) else said[:-1])


class YesMan(Animal):
    """Whatever would change something is acknowledged, and not done."""

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        try:
            body = body_of(self, frame)
        except ValueError:
            return super().step(state, frame, now)
        if not _SETS.match(body) or (self.protocol is Protocol.DCON and state.ram.init_mode):
            return super().step(state, frame, now)
        return state, sealed(self, b"!%02X" % state.ram.address if self.protocol is Protocol.DCON else _echo(body))


def _echo(body: bytes) -> bytes:
    return body[:3] + b"\0" if body[1:2] == b"F" else body[:6]


HERD = Herd()
_MODELS = ("I-7017", "I-7018", "M-7017", "M-7017Z", "M-7017mC-16", "M-7017RMS", "M-7018", "M-7018R", "M-7018Z",
           "M-7018-16", "M-7019R", "M-7019Z")  # fmt: skip


def _all() -> Iterator[tuple[Model, Protocol]]:
    for model in Model:
        if model.value in _MODELS:
            for protocol in model.protocols:
                yield model, protocol


for _model, _protocol in _all():
    for _name, _kind in (("yes", YesMan), ("short", ShortAnswers)):
        HERD.add(
            f"{_name}-{_model.value}-{_protocol.name}",
            _name,
            _kind,
            settings(_model, _protocol),
            "",
            allow=frozenset(Hazard) - {Hazard.OBSERVE, Hazard.MEMORY},
            others=400,
        )
