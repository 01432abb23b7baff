"""What an animal of the zoo is, and how animals are made: what they take for something else, and what they say instead.

Laws: an animal is legal beside its bug: what it changes gets its right checksum or CRC, unless that is the bug.
"""

import re
from collections.abc import Callable, Iterable
from typing import Any

from attrs import evolve, frozen

from i7000 import DecodeError, Firmware, Model, Protocol, dcon, modbus
from i7000.conformance.hazard import Hazard
from i7000.device import Eeprom, Signals, State, factory
from i7000.simulator import default_sources
from tests.conformance.zoo.animal import Animal

__all__ = ["Herd", "Kind", "Species", "acknowledging", "answering", "hearing", "refusing", "saying", "settings"]

Kind = Callable[..., Animal]
"""Makes an animal: `Animal`, or a class that is derived from it."""


By = bytes | Callable[[re.Match[bytes]], bytes]
"""What takes the place of a pattern."""


@frozen
class Species:
    """A firmware with a bug.

    Shape: `caught` are the checks that find the bug; at most `others` fail beside them. `allow` is what a run has to
        be allowed for that. With `select`, only these checks are run: a family of like animals is not to take long.
    """

    name: str
    bug: str
    kind: Kind
    eeprom: Eeprom
    signals: Signals
    caught: tuple[str, ...]
    allow: tuple[Hazard, ...]
    others: int
    select: tuple[str, ...]

    def born(self, *, init_switch: bool = False, now: float = 0.0) -> Animal:
        """Return one of them, with its power on."""
        return self.kind(self.eeprom, self.signals, init_switch=init_switch, now=now)


def settings(
    model: Model,
    protocol: Protocol = Protocol.DCON,
    firmware: str | None = None,
    *,
    checksum: bool = False,
    **changes: Any,
) -> Eeprom:
    """Return the settings of a module: those of the factory, with changes."""
    made = factory(model, None if firmware is None else Firmware(firmware))
    return evolve(made, protocol=protocol, report_settings=evolve(made.report_settings, checksum=checksum), **changes)


def signals_of(eeprom: Eeprom, scale: float = 1.0) -> Signals:
    """Return constant signals, another one for each channel, times a factor."""
    signals = default_sources(eeprom).at(0.0)
    return evolve(signals, channels=tuple(it and evolve(it, value=it.value * scale) for it in signals.channels))


class Herd:
    """The animals of a module of the zoo, by their names."""

    def __init__(self) -> None:
        self.animals: dict[str, Species] = {}

    def add(  # noqa: PLR0913 - what a species is made of
        self,
        name: str,
        bug: str,
        kind: Kind,
        eeprom: Eeprom,
        caught: str,
        *,
        allow: Iterable[Hazard] = (),
        others: int = 6,
        scale: float = 1.0,
        select: str = "",
    ) -> None:
        """Add a species.

        Shape: `caught` and `select` are ids with spaces between them; `scale` is the factor of the signals.
        """
        if name in self.animals:
            raise ValueError(name)
        ids, chosen = tuple(caught.split()), tuple(select.split())
        made = Species(name, bug, kind, eeprom, signals_of(eeprom, scale), ids, tuple(allow), others, chosen)
        self.animals[name] = made

    def animal(self, name: str, eeprom: Eeprom, caught: str, **how: Any) -> Callable[[type[Animal]], type[Animal]]:
        """Add a class of animals: its docstring says what the bug is."""

        def add(kind: type[Animal]) -> type[Animal]:
            self.add(name, kind.__doc__ or "", kind, eeprom, caught, **how)
            return kind

        return add


# --- what is heard and said otherwise ---------------------------------------------------------------------------------


def body_of(animal: Animal, frame: bytes) -> bytes:
    """Return a frame without checksum and CR, or without CRC.

    Errors: `DecodeError`.
    """
    if animal.protocol is Protocol.MODBUS_RTU:
        return modbus.unseal(frame)
    return dcon.unseal(frame, checksum=animal.state.ram.checksum)


def sealed(animal: Animal, body: bytes) -> bytes:
    """Return a body as a frame."""
    if animal.protocol is Protocol.MODBUS_RTU:
        return modbus.seal(body)
    return dcon.seal(body, checksum=animal.state.ram.checksum)


def answering(change: Callable[[bytes, bytes], bytes]) -> type[Animal]:
    """Return firmware whose answers are altered: by the bodies of the command and of its answer."""

    class Answering(Animal):
        def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
            try:
                heard, said = body_of(self, frame), body_of(self, answer or b"")
            except DecodeError:
                return answer
            return sealed(self, change(heard, said))

    return Answering


def saying(pattern: bytes, by: By, *, to: bytes = b"") -> type[Animal]:
    """Return firmware that says something else in place of a pattern, to commands that match `to` from their begin."""

    def change(heard: bytes, said: bytes) -> bytes:
        return re.sub(pattern, by, said, flags=re.DOTALL) if re.match(to, heard, re.DOTALL) else said

    return answering(change)


def hearing(pattern: bytes, by: By) -> type[Animal]:
    """Return firmware that takes what matches a pattern for something else."""

    class Hearing(Animal):
        def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
            try:
                body = body_of(self, frame)
            except DecodeError:
                return super().step(state, frame, now)
            taken = re.sub(pattern, by, body, flags=re.DOTALL)
            return super().step(state, sealed(self, taken), now)

    return Hearing


def _instead(pattern: bytes, reply: Callable[[Animal, bytes], bytes]) -> type[Animal]:
    class Instead(Animal):
        def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
            try:
                body = body_of(self, frame)
            except DecodeError:
                return super().step(state, frame, now)
            if re.match(pattern, body, re.DOTALL):
                return state, sealed(self, reply(self, body))
            return super().step(state, frame, now)

    return Instead


def refusing(pattern: bytes, code: int = 2) -> type[Animal]:
    """Return firmware that refuses, and does not carry out, what a pattern begins."""

    def reply(animal: Animal, body: bytes) -> bytes:
        if animal.protocol is Protocol.DCON:
            return b"?%02X" % animal.state.ram.address
        return bytes((body[0], body[1] | 0x80, code))

    return _instead(pattern, reply)


def acknowledging(pattern: bytes, size: int = 6) -> type[Animal]:
    """Return firmware that says that it carried out what a pattern begins, and does nothing."""

    def reply(animal: Animal, body: bytes) -> bytes:
        return b"!%02X" % animal.state.ram.address if animal.protocol is Protocol.DCON else body[:size]

    return _instead(pattern, reply)
