"""Firmware with bugs on the line, in both protocols: when it answers, how often, and what comes beside its answers."""

# ruff: noqa: ARG002 - a bug rarely looks at all that it is given

from i7000 import Model, Protocol
from i7000.device import Eeprom
from tests.conformance.zoo.animal import Animal
from tests.conformance.zoo.species import Herd, settings

HERD = Herd()
DCON = settings(Model.M_7018)
RTU = settings(Model.M_7018, Protocol.MODBUS_RTU)


class Silent(Animal):
    """There is no module, or no cable."""

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        del frame, answer
        return None


class Babbler(Animal):
    """It sends without end, whatever it is asked."""

    period = 0.1

    def unasked(self) -> bytes:
        return b"!01\r"

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        del frame, answer
        return b"!01\r"


class Murmurer(Animal):
    """Every second a byte comes that nobody asked for."""

    period = 0.9

    def unasked(self) -> bytes:
        return b"\0"


class Echo(Animal):
    """What is sent comes back before the answer."""

    def hear(self, data: bytes, now: float) -> bytes:
        return data + super().hear(data, now)


class Slow(Animal):
    """The answers come after 300 ms."""

    def delay(self) -> float:
        return 0.3


class Seventh(Animal):
    """Every seventh answer is lost."""

    count = 0

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        self.count += answer is not None
        return None if self.count % 7 == 0 else answer


class Twice(Animal):
    """Every answer is sent twice."""

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        return None if answer is None else answer * 2


class NoiseBefore(Animal):
    """A byte of noise comes before each answer: the driver of the line is switched on too late."""

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        return None if answer is None else b"\xff" + answer


class ZeroAfter(Animal):
    """A byte of 00 comes after each answer: the driver of the line is switched off too late."""

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        return None if answer is None else answer + b"\0"


class WholeFrames(Animal):
    """A request is only understood if all its characters come at once."""

    def hear(self, data: bytes, now: float) -> bytes:
        if self.protocol is Protocol.DCON and data[-1:] != b"\r":
            return b""
        self._heard = b""
        return super().hear(data, now)


_KINDS: dict[str, tuple[type[Animal], str, int]] = {
    "no-cable": (Silent, "", 0),
    "babbler": (Babbler, "link/alive", 10),
    "murmurer": (Murmurer, "", 90),
    "echo": (Echo, "link/no-echo", 2),
    "slow": (Slow, "link/prompt", 90),
    "every-seventh-lost": (Seventh, "timing/repeated", 60),
    "twice": (Twice, "link/alive", 2),
    "noise-before": (NoiseBefore, "link/alive", 2),
    "zero-after": (ZeroAfter, "link/alive", 90),
    "whole-frames": (WholeFrames, "timing/by-character", 3),
}


def _add(protocol: str, eeprom: Eeprom) -> None:
    for name, (kind, caught, others) in _KINDS.items():
        HERD.add(f"{name}-{protocol}", kind.__doc__ or "", kind, eeprom, caught, others=others)


_add("dcon", DCON)
_add("rtu", RTU)
