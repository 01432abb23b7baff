"""Modules with bugs at a port in virtual time, in place of those that a target names."""

from collections.abc import Callable, Iterable

import pytest
from attrs import evolve

from i7000 import LineSettings, Model, Protocol
from i7000.device import factory
from i7000.device.bus import Heard
from i7000.link import LinkError, Port, VirtualPort
from i7000.simulator import Simulated, default_sources

__all__ = ["Answer", "FirmwarePort", "Lost", "Play", "played"]

Answer = Callable[[bytes, bytes | None], bytes | None]
"""What is answered to a frame in place of the right answer."""


def _right(frame: bytes, answer: bytes | None) -> bytes | None:
    del frame
    return answer


class FirmwarePort(VirtualPort):
    """A port with an I-7018 that answers what a function returns.

    `write` gets what `edit` makes of what is sent; answers are late by `delay` seconds.
    """

    def __init__(
        self,
        answer: Answer = _right,
        *,
        edit: Callable[[bytes], bytes] = lambda wire: wire,
        delay: float = 0.0,
        model: Model = Model.I_7018,
    ) -> None:
        eeprom = evolve(factory(model), protocol=Protocol.DCON)
        super().__init__([Simulated(eeprom, default_sources(eeprom))])
        self.name = "sim:I-7018"
        self._change, self._edit, self._delay = answer, edit, delay

    def write(self, data: object) -> int:
        """Send bytes."""
        assert isinstance(data, bytes)
        super().write(self._edit(data))
        return len(data)

    def _answer(self, told: Iterable[Heard], silence: float) -> None:
        changed = [evolve(it, answer=self._change(it.frame, it.answer), delay=it.delay + self._delay)
                   for it in told if isinstance(it.frame, bytes)]  # fmt: skip
        super()._answer(changed, silence)

    @property
    def kept_name(self) -> str:
        """The name in the EEPROM of the module."""
        return self.modules[0].eeprom.name


class Lost:
    """What loses the port at the first frame that begins with some bytes."""

    def __init__(self, begins: bytes) -> None:
        self.begins = begins

    def __call__(self, data: bytes) -> bytes:
        """Lose it, or not."""
        if data.startswith(self.begins):
            raise LinkError("the port is lost: gone")
        return data


Play = Callable[[Port], None]


@pytest.fixture
def played(monkeypatch: pytest.MonkeyPatch) -> Play:
    """Open a port in place of every target."""

    def play(port: Port) -> None:
        def opened(text: str, line: LineSettings) -> Port:  # noqa: ARG001
            return port

        monkeypatch.setattr("i7000.link.open_target", opened)

    return play
