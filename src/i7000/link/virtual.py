"""Simulated modules behind a serial port in virtual time: tests and dry runs without hardware and without waiting.

Laws: the time moves only when the host waits: in `read`, `flush`, `sleep`, or `write` to a full buffer. All randomness
comes from the seed: the same calls give the same bytes at the same times. `i7000.device` defines the behaviour of the
modules, `i7000.simulator.faults` the faults of the line.
"""

from collections import deque
from collections.abc import Callable, Iterable
from heapq import heappop, heappush
from itertools import count
from math import ceil, floor, inf
from operator import itemgetter
from random import Random

import serial
from attrs import evolve, frozen

from i7000.arguments import as_bytes, check_seconds
from i7000.device import Bus, Ear, Heard, Signals, State, Uart, advance, power_on
from i7000.errors import InvalidValueError, Noise, StateError
from i7000.models import Model
from i7000.settings import LineSettings, Protocol
from i7000.simulator.faults import Exchange, Faults
from i7000.simulator.observed import Observed
from i7000.simulator.simulator import Simulated
from i7000.simulator.sources import SAMPLES_A_SECOND, Sources, default_sources

__all__ = ["BUFFER", "VirtualPort"]

BUFFER = 4096
"""The bytes that each of the two buffers of the port holds, as those of an operating system."""
_MOST_POLLS = 100_000
"""The number of times that `in_waiting` can be read while the time stands still."""
_SILENT_CHARACTERS = 3.5
_SHORTEST_SILENCE = 0.00175
"""The silence after a Modbus frame, in characters, and the shortest one in seconds."""
_TICK = 0.25
"""The interval in seconds at which a data logger notices the time without traffic."""


@frozen
class _Burst:
    """Bytes that the host sends without a pause, and the time when the first of them starts."""

    wire: bytes
    start: float
    uart: Uart

    @property
    def end(self) -> float:
        return self.start + len(self.wire) * self.uart.character_time


class VirtualPort(serial.SerialBase):
    r"""A serial port with simulated modules at its other end; it has the methods and attributes of `serial.Serial`.

    Shape: `modules` are states of `i7000.device`, or modules of the simulator, which are powered on at time 0.
        `signals` has `Signals` (constant) or `Sources` (functions of time) for each module; without it, a `Simulated`
        has its own, and each channel of a `State` has another value within its range. `line` has the settings of the
        host's end: other settings than those of a module give garbage, in both directions.
    Time: each character takes its time on the line. A module answers a DCON command at the end of the command, and a
        Modbus request after 3.5 characters of silence and its response delay (40488).
    Special: `faults`, `signals` and `init_switches` may be changed at any time. A driver that polls `in_waiting` has to
        call `sleep`: the time stands still otherwise.
    Errors: `InvalidValueError` for the wrong number of signals; `StateError` for a `read` that would wait forever.

    >>> from i7000 import Model, Unit
    >>> from i7000.device import factory
    >>> module = power_on(factory(Model.I_7018), now=0.0)
    >>> port = VirtualPort([module], [Signals.of(Unit.VOLT, 1.5)])
    >>> port.write(b"#010\r")
    5
    >>> port.timeout = 1.0
    >>> port.read_until(b"\r"), round(port.now(), 4)
    (b'>+1.5000\r', 0.0146)
    """

    def __init__(
        self,
        modules: Iterable[State | Simulated],
        signals: Iterable[Signals | Sources] | None = None,
        faults: Faults | None = None,
        *,
        seed: int = 0,
        line: LineSettings = LineSettings(),  # noqa: B008 - frozen
    ) -> None:
        self._uart = uart = Uart.of(line)
        super().__init__(None, uart.rate, parity=uart.parity, stopbits=uart.stop_bits)
        given = tuple(modules)
        states = tuple(it if isinstance(it, State) else power_on(it.eeprom, now=0.0, init_switch=it.init_switch)
                       for it in given)  # fmt: skip
        own = [default_sources(it.eeprom) if isinstance(it, State) else it.sources for it in given]
        self.signals: list[Signals | Sources] = own if signals is None else list(signals)  # type: ignore[assignment]
        """The signals at the inputs of each module."""
        if len(self.signals) != len(given):
            raise InvalidValueError("signals", len(self.signals), f"{len(given)}, one for each module", "")
        self.init_switches = [isinstance(it, Simulated) and it.init_switch for it in given]
        """The INIT switch of each module, which it reads when its power is switched on."""
        self.faults = faults or Faults()
        self.observe: Callable[[Observed], object] | None = None
        """It is called with each request that a module answers, and the response."""
        self._chance = Random(seed)  # noqa: S311 - repeatable
        self._bus = Bus(states)
        self._began = self._now = max((0.0, *(it.clock for it in states)))
        self._ticked = self._now
        self._order = count()
        self._received = bytearray()
        self._last_request: bytes | None = None
        self._last_answer: bytes | None = None
        self._earlier: bytes | None = None
        """The answer to the last request that differed from the last one."""
        self._polls = 0
        self._clear()
        self.is_open = True

    def _clear(self) -> None:
        """Forget everything that is on the line."""
        self._ear = Ear(self._uart)
        self._burst = _Burst(b"", self._now, self._uart)
        self._silent_at = inf
        self._pieces: list[tuple[float, int, bytes, bool]] = []
        """The bytes on their way to the host: when they start at the earliest, their order, and whether in a lump."""
        self._arriving: deque[tuple[float, bytes]] = deque()
        self._free_at = self._now

    # --- time, and the modules ----------------------------------------------------------------------------------------

    def now(self) -> float:
        """Return the virtual time in seconds: the `clock` of a `Line`."""
        return self._now

    def sleep(self, seconds: float) -> None:
        """Move the time on.

        Errors: `InvalidValueError` for a time that is negative or not finite.
        """
        check_seconds("seconds", seconds)
        if seconds < 0:
            raise InvalidValueError("seconds", seconds, "0 or more", "")
        self._pass(self._now + seconds)

    @property
    def modules(self) -> tuple[State, ...]:
        """The modules as they are now."""
        self._pass(self._now)
        self._advance()
        return self._bus.modules

    def power_cycle(self, *, init_switch: bool | None = None) -> None:
        """Switch the power of all modules off and on; what is on the line is lost.

        Shape: `init_switch` sets all `init_switches` before; None leaves them as they are.
        """
        if init_switch is not None:
            self.init_switches = [init_switch] * len(self.init_switches)
        self._pass(self._now)
        self._bus = Bus(
            tuple(
                power_on(module.eeprom, now=self._now, init_switch=switch)
                for module, switch in zip(self._bus.modules, self.init_switches, strict=True)
            )
        )
        self._clear()

    # --- the methods of a serial port ---------------------------------------------------------------------------------

    def open(self) -> None:
        """Open the port again after `close`, with empty buffers."""
        if self.is_open:
            raise serial.SerialException("the port is already open")
        self.is_open = True
        self._reconfigure_port()
        self._received.clear()

    def close(self) -> None:
        """Close the port; the modules keep their power, and the time stands still."""
        self.is_open = False

    def read(self, size: int = 1) -> bytes:
        """Return received bytes, after as much time as it takes: until there are `size`, or until `timeout` is over.

        Errors: `StateError` without a timeout, if no byte is on its way; `serial.SerialException` if it is closed.
        """
        self._check_open()
        self._pass(inf if self.timeout is None else self._now + self.timeout, size)
        data = bytes(self._received[:size])
        del self._received[:size]
        return data

    def write(self, data: object) -> int:
        """Send bytes after those that are still being sent; wait only if the buffer is full."""
        self._check_open()
        wire = as_bytes("data", data)
        for start in range(0, len(wire), BUFFER):
            part = wire[start : start + BUFFER]
            if self.out_waiting + len(part) > BUFFER:
                self.flush()
            self._pass(self._now)
            burst = self._burst if self._burst.wire else _Burst(b"", self._now, self._uart)
            if self.faults.echo:
                heappush(self._pieces, (burst.end, next(self._order), part, False))
            self._burst = evolve(burst, wire=burst.wire + part)
            self._silent_at = inf
        return len(wire)

    def flush(self) -> None:
        """Wait until everything is sent."""
        self._check_open()
        if self._burst.wire:
            self._pass(self._burst.end)

    @property
    def in_waiting(self) -> int:
        """The number of received bytes.

        Errors: `StateError` for a driver that polls it forever without `sleep`.
        """
        self._check_open()
        self._polls += 1
        if self._polls > _MOST_POLLS:
            raise StateError(f"in_waiting was read {_MOST_POLLS} times at one time: call sleep() between")
        self._pass(self._now)
        return len(self._received)

    @property
    def out_waiting(self) -> int:
        """The number of bytes that are not sent yet."""
        self._check_open()
        return len(self._burst.wire) - self._sent

    def reset_input_buffer(self) -> None:
        """Drop received bytes; bytes that are still on the line arrive later."""
        self._check_open()
        self._pass(self._now)
        self._received.clear()

    def reset_output_buffer(self) -> None:
        """Drop the bytes that are not sent yet."""
        self._check_open()
        self._burst = evolve(self._burst, wire=self._burst.wire[: self._sent])

    @property
    def _sent(self) -> int:
        """The number of bytes of the burst that are sent, or being sent."""
        burst = self._burst
        return min(len(burst.wire), ceil((self._now - burst.start) / burst.uart.character_time))

    def _check_open(self) -> None:
        if not self.is_open:
            raise serial.PortNotOpenError

    def _reconfigure_port(self) -> None:
        """Apply settings; what was written before is sent with the old ones."""
        if self.inter_byte_timeout is not None:
            raise InvalidValueError("inter_byte_timeout", self.inter_byte_timeout, "None: use timeout", "")
        now = self._uart
        if (now.rate, now.parity, now.stop_bits, now.data_bits) != (
            self.baudrate,
            self.parity,
            self.stopbits,
            self.bytesize,
        ):
            uart = Uart(self.baudrate, parity=self.parity, stop_bits=self.stopbits, data_bits=self.bytesize)
            self.flush()
            self._uart = uart
            self._ear = evolve(self._ear, uart=uart)

    def _update_state(self) -> None:
        """Do nothing: RTS, DTR and break have no effect on RS-485."""

    _update_rts_state = _update_dtr_state = _update_break_state = _update_state

    # --- what happens while the time passes ---------------------------------------------------------------------------

    def _pass(self, until: float, enough: float = inf) -> None:
        """Move the time on until there are enough received bytes, but not beyond `until`."""
        while len(self._received) < enough:
            at, happen = self._next()
            if at == until == inf:
                raise StateError("read() would wait forever: no answer is on its way, and the port has no timeout")
            self._move(min(at, until))
            if at > until:
                return
            happen()

    def _next(self) -> tuple[float, Callable[[], None]]:
        """Return the time of the next event, and what happens then."""
        return min(
            (self._arriving[0][0] if self._arriving else inf, self._arrive),
            (self._pieces[0][0] if self._pieces else inf, self._start),
            (self._burst.end if self._burst.wire else inf, self._hear),
            (self._silent_at, self._silence),
            key=itemgetter(0),
        )

    def _move(self, at: float) -> None:
        """Set the time; the data logger of an M-7017mC-16 notices each quarter of a second of it."""
        if at <= self._now:
            return
        self._polls = 0
        if at < inf and any(module.eeprom.model is Model.M_7017mC_16 for module in self._bus.modules):
            for tick in range(ceil(self._now / _TICK), ceil(at / _TICK)):
                self._now = max(self._now, tick * _TICK)
                self._advance()
        self._now = at

    def _advance(self) -> None:
        pairs = zip(self._bus.modules, self._sampled(), strict=True)
        self._bus = Bus(tuple(advance(module, signals, self._now) for module, signals in pairs))

    def _sampled(self) -> list[Signals]:
        """Return the signals at the inputs of each module now."""
        seconds = floor((self._now - self._began) * SAMPLES_A_SECOND) / SAMPLES_A_SECOND
        return [it.at(seconds) if isinstance(it, Sources) else it for it in self.signals]

    def _arrive(self) -> None:
        """Receive bytes; those that do not fit into the buffer are lost."""
        _, wire = self._arriving.popleft()
        self._received += wire[: BUFFER - len(self._received)]

    def _start(self) -> None:
        """Put a piece on the line, after what is on it already."""
        start, _, wire, lump = heappop(self._pieces)
        if lump:
            self._arriving.append((self._now, wire))
            return
        character_time = self._uart.character_time
        at = max(start, self._free_at)
        self._free_at = at + len(wire) * character_time
        for place in range(len(wire)):
            self._arriving.append((at + (place + 1) * character_time, wire[place : place + 1]))

    def _hear(self) -> None:
        """Give the modules what the host has sent."""
        wire, _ = self.faults.requests.carried(self._burst.wire, self._chance)
        self._burst = _Burst(b"", self._now, self._uart)
        self._bus, self._ear, told = self._bus.hear(self._ear, wire, self._sampled(), self._now)
        self._silent_at = self._now + self._silence_time if self._ear.waiting else inf
        self._answer(told, self._silence_time)

    def _silence(self) -> None:
        """End the frames that only silence ends."""
        self._silent_at = inf
        self._bus, self._ear, told = self._bus.silence(self._ear, self._sampled(), self._now)
        self._answer(told, 0.0)

    @property
    def _silence_time(self) -> float:
        return max(_SILENT_CHARACTERS * self._uart.character_time, _SHORTEST_SILENCE)

    def _answer(self, told: Iterable[Heard], silence: float) -> None:
        """Send responses; those of Modbus begin after the silence that ends their request."""
        for heard in told:
            if isinstance(heard.frame, Noise) or heard.answer is None:
                continue
            exchange = self._exchange(heard.frame, heard.answer, heard)
            faults, character_time = self.faults.answers(exchange.address), self._uart.character_time
            start = self._now + heard.delay + (silence if heard.protocol is Protocol.MODBUS_RTU else 0.0)
            transfer = faults.delivered(heard.answer, character_time, self._chance, exchange)
            for piece in transfer.pieces:
                heappush(self._pieces, (start + piece.after, next(self._order), piece.wire, faults.lumps))
            if self.observe:
                seen = Observed(self._now, "", heard.frame, heard.protocol, heard.profile, heard.answer)
                pieces = tuple(evolve(it, after=start - self._now + it.after) for it in transfer.pieces)
                self.observe(evolve(seen, faults=transfer.faults, pieces=pieces))

    def _exchange(self, request: bytes, answer: bytes, heard: Heard) -> Exchange:
        """Return the exchange of an answer, and remember the answer."""
        if request != self._last_request:
            self._last_request, self._earlier = request, self._last_answer
        self._last_answer = answer
        checksum = heard.profile is not None and heard.profile.checksum
        return Exchange(request, heard.protocol, checksum, self._earlier)
