"""Several modules on one pair of wires, of whatever models and protocols."""

from collections.abc import Sequence
from itertools import zip_longest

from attrs import frozen

from i7000.device.module import step
from i7000.device.signals import Signals
from i7000.device.state import State
from i7000.errors import EncodeError

__all__ = ["Bus"]


@frozen
class Bus:
    """Modules that all hear the same frames."""

    modules: tuple[State, ...]

    def step(self, frame: bytes, signals: Sequence[Signals], now: float) -> tuple["Bus", bytes | None]:
        r"""Let all modules hear a frame: the bus after it, and what comes back or None for silence.

        Shape: `signals` are those of each module, in their order.
        Errors: `EncodeError` for signals of more or fewer modules.
        Special: if several answer at once, each bit is 1 where all send 1 (assumption): equal answers look like one.

        >>> from i7000 import Model
        >>> from i7000.device import factory, power_on
        >>> bus = Bus((power_on(factory(Model.I_7018), now=0.0), power_on(factory(Model.M_7019R), now=0.0)))
        >>> bus.step(b"$01M\r", (Signals(), Signals()), 0.0)[1]
        b'!017018\r'
        """
        if len(signals) != len(self.modules):
            raise EncodeError("signals", len(signals), f"{len(self.modules)}, those of each module", "2")
        after, answers = [], []
        for module, own in zip(self.modules, signals, strict=True):
            state, answer = step(module, frame, own, now)
            after.append(state)
            if answer is not None:
                answers.append(answer)
        return Bus(tuple(after)), _collided(answers)


def _collided(answers: list[bytes]) -> bytes | None:
    if not answers:
        return None
    heard, *others = answers
    for other in others:
        heard = bytes(one & two for one, two in zip_longest(heard, other, fillvalue=0xFF))
    return heard
