"""Firmware of one module, made of the device model, with places for bugs; and its line in virtual time.

Laws: without a bug it is the device model. `Animal` knows no clock and no I/O.
"""

from __future__ import annotations

from collections import deque
from typing import Any

from i7000 import LineSettings, Noise, Protocol, dcon, modbus
from i7000.device import Eeprom, Signals, State, power_on, step

SILENCE = 3.5
"""The characters of silence that end a frame of Modbus RTU."""


class Animal:
    """A module that hears bytes and answers; a bug overrides one of its methods."""

    def __init__(self, eeprom: Eeprom, signals: Signals, *, init_switch: bool = False, now: float = 0.0) -> None:
        self.state: State = power_on(eeprom, init_switch=init_switch, now=now)
        self.signals = signals
        self._heard = b""

    # --- the places for bugs ------------------------------------------------------------------------------------------

    def step(self, state: State, frame: bytes, now: float) -> tuple[State, bytes | None]:
        """Carry out a frame."""
        return step(state, frame, self.signals, now)

    def damaged(self, frame: bytes) -> bytes | None:
        """Return the frame that is made of bytes with a wrong CRC; None for none."""
        del frame
        return None

    def answer(self, frame: bytes, answer: bytes | None) -> bytes | None:
        """Return what is sent in place of the right answer."""
        del frame
        return answer

    def stored(self, eeprom: Eeprom) -> Eeprom:
        """Return what the EEPROM holds after the power was off."""
        return eeprom

    # --- the line -----------------------------------------------------------------------------------------------------

    @property
    def protocol(self) -> Protocol:
        """The protocol that it uses now."""
        return self.state.ram.protocol

    def hear(self, data: bytes, now: float) -> bytes:
        """Hear bytes, and return what is sent at once."""
        self._heard += data
        if self.protocol is Protocol.MODBUS_RTU:
            return b""
        found, self._heard = dcon.split(self._heard)
        return b"".join(self._carried_out(it.wire if isinstance(it, Noise) else it, now) for it in found)

    def silence(self, now: float) -> bytes:
        """Hear a silence, and return what is sent then."""
        if self.protocol is Protocol.DCON or not self._heard:
            return b""
        burst, self._heard = self._heard, b""
        try:
            modbus.unseal(burst)
        except ValueError:
            frame = self.damaged(burst)
            return b"" if frame is None else self._carried_out(frame, now)
        return self._carried_out(burst, now)

    def _carried_out(self, frame: bytes, now: float) -> bytes:
        self.state, answer = self.step(self.state, frame, now)
        return self.answer(frame, answer) or b""

    def power_cycle(self, now: float, *, init_switch: bool) -> None:
        """Switch the power off and on."""
        self._heard = b""
        self.state = power_on(self.stored(self.state.eeprom), init_switch=init_switch, now=now)


class AnimalPort:
    """A port with firmware at its other end, in virtual time; it has no line settings, as a pipe has none."""

    def __init__(self, animal: Animal) -> None:
        self.animal = animal
        self.name = type(animal).__name__
        self.timeout: float | None = 1.0
        self.baudrate, self.parity, self.stopbits = 9600, "N", 1.0
        self._now = 0.0
        self._sent: deque[tuple[float, bytes]] = deque()
        self._coming: deque[tuple[float, bytes]] = deque()
        self._silent_at: float | None = None

    @property
    def _character(self) -> float:
        return 10 / self.baudrate

    def now(self) -> float:
        """The virtual time."""
        return self._now

    @property
    def in_waiting(self) -> int:
        """The bytes that have come."""
        return sum(len(data) for at, data in self._coming if at <= self._now)

    def write(self, data: bytes, /) -> int:
        """Send bytes."""
        start = max(self._now, self._sent[-1][0] if self._sent else self._now)
        self._sent.append((start + len(data) * self._character, bytes(data)))
        return len(data)

    def read(self, size: int = 1, /) -> bytes:
        """Return bytes, or none after the timeout."""
        end = self._now + (self.timeout or 0.0)
        self._live(end)
        if not self._coming or self._coming[0][0] > end:
            self._now = end
            return b""
        self._now = max(self._now, self._coming[0][0])
        found = b""
        while self._coming and self._coming[0][0] <= self._now and len(found) < size:
            found += self._coming.popleft()[1]
        return found

    def _live(self, end: float) -> None:
        """Let the firmware hear what it hears until a time."""
        while True:
            sent = self._sent[0][0] if self._sent else None
            begins = sent - len(self._sent[0][1]) * self._character if sent is not None else None
            if self._silent_at is not None and self._silent_at <= end and (begins is None or begins >= self._silent_at):
                at, self._silent_at = self._silent_at, None
                self._send(self.animal.silence(at), at)
            elif sent is not None and sent <= end:
                at, data = self._sent.popleft()
                self._silent_at = at + SILENCE * self._character
                self._send(self.animal.hear(data, at), at)
            else:
                return

    def _send(self, data: bytes, at: float) -> None:
        for place in range(len(data)):
            self._coming.append((at + (place + 1) * self._character, data[place : place + 1]))

    def power_cycle(self, *, init_switch: bool = False) -> None:
        """Switch the power of the firmware off and on."""
        self._live(self._now)
        self._coming.clear()
        self._sent.clear()
        self._silent_at = None
        self.animal.power_cycle(self._now, init_switch=init_switch)

    def close(self) -> None:
        """Do nothing."""


def line_of(animal: Animal) -> LineSettings:
    """The line settings of a module now."""
    return animal.state.ram.line_settings


def serve(animal: Animal, read: Any, write: Any, clock: Any) -> None:
    """Play firmware until its input ends: `read(seconds)` returns bytes, None for silence, and b"" at the end."""
    while True:
        data = read(0.02)
        if data == b"":
            return
        answer = animal.silence(clock()) if data is None else animal.hear(data, clock())
        if answer:
            write(answer)
