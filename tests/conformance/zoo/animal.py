"""Firmware of one module, made of the device model, with places for bugs; and its line in virtual time.

Laws: without a bug it is the device model. `Animal` knows no clock and no I/O.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from functools import partial
from math import inf

from i7000 import Noise, Protocol, dcon, modbus
from i7000.device import Eeprom, Signals, State, Uart, power_on, step

SILENCE = 3.5
"""The characters of silence that end a frame of Modbus RTU."""
_LISTEN = 0.02
"""The seconds without bytes that are such a silence where there is no line: a pipe has no baud rate."""


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

    def delay(self) -> float:
        """Return how many seconds after a frame its answer begins."""
        return self.state.response_delay

    period: float | None = None
    """The seconds between bytes that nobody asked for; None without such bytes."""

    def unasked(self) -> bytes:
        """Return bytes that nobody asked for."""
        return b""

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
    """A port with firmware at its other end, in virtual time; with other line settings nothing is heard."""

    def __init__(self, animal: Animal) -> None:
        self.animal = animal
        self.name = type(animal).__name__
        self.timeout: float | None = 1.0
        self.baudrate, self.parity, self.stopbits = 9600, "N", 1.0
        self._now = 0.0
        self._sent: deque[tuple[float, bytes]] = deque()
        self._coming: deque[tuple[float, bytes]] = deque()
        self._silent_at: float | None = None
        self._unasked_at = animal.period

    @property
    def _is_tuned(self) -> bool:
        """Whether both ends have the same line settings."""
        uart = Uart.of(self.animal.state.ram.line_settings)
        return (self.baudrate, self.parity, self.stopbits) == (uart.rate, uart.parity, uart.stop_bits)

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
        if not size:
            return b""
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
        """Give the firmware what is sent to it until a time."""
        while True:
            sent = self._sent[0] if self._sent else None
            begins = inf if sent is None else sent[0] - len(sent[1]) * self._character
            times = (self._silent_at or inf, inf if sent is None else sent[0], self._unasked_at or inf)
            if min(times) > end:
                return
            if times[2] == min(times) and self.animal.period:
                self._unasked_at = times[2] + self.animal.period
                self._send(self.animal.unasked(), times[2])
            elif times[0] < inf and times[0] <= begins + 1e-9:
                self._silent_at = None
                self._hear(self.animal.silence, times[0])
            elif sent is not None:
                self._sent.popleft()
                self._silent_at = sent[0] + SILENCE * self._character
                self._hear(partial(self.animal.hear, sent[1]), sent[0])

    def _hear(self, heard: Callable[[float], bytes], at: float) -> None:
        if self._is_tuned:
            delay = self.animal.delay()
            self._send(heard(at), at + delay)

    def _send(self, data: bytes, at: float) -> None:
        start = max(at, self._coming[-1][0] if self._coming else at)
        for place in range(len(data)):
            self._coming.append((start + (place + 1) * self._character, data[place : place + 1]))

    def power_cycle(self, *, init_switch: bool = False) -> None:
        """Switch the power of the firmware off and on."""
        self._live(self._now)
        self._coming.clear()
        self._sent.clear()
        self._silent_at = None
        self.animal.power_cycle(self._now, init_switch=init_switch)

    def close(self) -> None:
        """Do nothing."""


def serve(
    animal: Animal,
    read: Callable[[float], bytes | None],
    write: Callable[[bytes], None],
    clock: Callable[[], float],
    sleep: Callable[[float], None],
) -> None:
    """Play firmware until its input ends: `read(seconds)` returns bytes, None for silence, and b"" at the end."""
    spoken = clock()
    while (data := read(_LISTEN)) != b"":
        delay = animal.delay()
        answer = animal.silence(clock()) if data is None else animal.hear(data, clock())
        if answer:
            sleep(delay)
            write(answer)
        if animal.period and clock() - spoken >= animal.period:
            spoken = clock()
            write(animal.unasked())
