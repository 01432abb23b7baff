r"""A port whose writes pass the guard of the conformance kit: nothing that is not allowed gets out.

Laws: the port behind the guard is not reachable by a public name. Every byte that is sent was classified with the line
settings that the port had. What is unfinished is forgotten after a silence of 0.25 s at the host. A gateway that holds
bytes back for longer can join them to the next ones.
"""

from collections.abc import Callable

from i7000.arguments import as_bytes
from i7000.conformance import DEFAULT_ALLOWED, Guard, Hazard
from i7000.conformance.hazard import STORED
from i7000.errors import I7000Error, InvalidValueError, written
from i7000.link.port import Port, clock_of, named
from i7000.settings import BaudRate, CharacterFormat, LineSettings, is_int

__all__ = ["BudgetError", "GuardedPort"]

_SILENCE = 0.25
"""The silence in seconds after which no firmware waits for the rest of a Modbus frame."""
_LARGEST_BUDGET = 1_000_000
_LINES: dict[tuple[int, str, float], LineSettings] = {
    (rate.bits_per_second, form.parity, form.stop_bits): LineSettings(rate, form)
    for rate in BaudRate
    for form in CharacterFormat
}
"""The line settings of modules by those of a port."""


class BudgetError(I7000Error):
    """A write that was not sent, because the budget of writes that change settings is used up.

    Shape: `wire` and `budget`.
    """

    def __init__(self, wire: bytes, budget: int) -> None:
        super().__init__(wire, budget)
        self.wire = wire
        self.budget = budget

    def __str__(self) -> str:
        return f"{written(self.wire)} was not sent: the budget of {self.budget} writes that change settings is used up"


class GuardedPort:
    r"""A port that refuses to send bytes with a hazard that is not allowed.

    Shape: `port` is what `i7000.link.Line` takes. The guarded port has the methods and attributes of
        `i7000.link.Port`, and `now`, `sleep`, `power_cycle`, `flush`, `reset_input_buffer`, `is_open` and `name` if
        the port has them. `budget` is the number of writes that can change settings, because an EEPROM wears out; None
        is any number.
    Errors: `i7000.conformance.GuardError` for bytes that are not allowed; `BudgetError`; `InvalidValueError` for
        arguments, and for a write with line settings that no module can have.

    >>> from i7000 import Model
    >>> from i7000.device import factory, power_on
    >>> from i7000.link import VirtualPort
    >>> port = GuardedPort(VirtualPort([power_on(factory(Model.I_7018), now=0.0)]))
    >>> port.write(b"~01O7018\r")
    Traceback (most recent call last):
    i7000.conformance.guard.GuardError: ~01O7018\r was not sent: it changes a setting (--allow write)
    """

    __slots__ = ("__budget", "__clock", "__guard", "__port", "__quiet_from", "__writes")

    def __init__(self, port: Port, allowed: frozenset[Hazard] = DEFAULT_ALLOWED, *, budget: int | None = None) -> None:
        _check_budget(budget)
        self.__port = port
        self.__guard = Guard(allowed)
        self.__clock = clock_of(port)
        self.__quiet_from = self.__clock()
        self.__budget = budget
        self.__writes = 0

    @property
    def allowed(self) -> frozenset[Hazard]:
        """The hazards that are allowed."""
        return self.__guard.allowed

    @property
    def budget(self) -> int | None:
        """The number of writes that can change settings; None is any number, as for a module that is restored."""
        return self.__budget

    @budget.setter
    def budget(self, writes: int | None, /) -> None:
        _check_budget(writes)
        self.__budget = writes

    @property
    def writes(self) -> int:
        """The number of writes so far that can change settings."""
        return self.__writes

    def write(self, data: bytes, /) -> int | None:
        """Send bytes, if all that they can do is allowed."""
        wire = as_bytes("data", data)
        line = self.__line()
        now = self.__clock()
        guard = self.__guard if now - self.__quiet_from < _SILENCE else self.__guard.after_silence()
        after, hazards = guard.judged(wire, line)
        counted = not STORED.isdisjoint(hazards)
        if counted and self.__budget is not None and self.__writes >= self.__budget:
            raise BudgetError(wire, self.__budget)
        self.__guard = after
        self.__writes += counted
        self.__quiet_from = max(now, self.__quiet_from) + len(wire) * line.character_format.bits / self.__port.baudrate
        return self.__port.write(wire)

    def __line(self) -> LineSettings:
        """Return the line settings that the port has now."""
        port = self.__port
        line = _LINES.get((port.baudrate, port.parity, port.stopbits))
        if line is None or getattr(port, "bytesize", 8) != 8:
            given = f"{port.baudrate} baud {getattr(port, 'bytesize', 8)}{port.parity}{port.stopbits:g}"
            raise InvalidValueError("line", given, "1200 to 115200 baud, N81, N82, E81 or O81", "1.11")
        return line

    # --- what passes unchanged ----------------------------------------------------------------------------------------

    @property
    def timeout(self) -> float | None:
        """The seconds that a read waits; None is for ever."""
        return self.__port.timeout

    @timeout.setter
    def timeout(self, seconds: float | None, /) -> None:
        self.__port.timeout = seconds

    @property
    def baudrate(self) -> int:
        """The bits per second."""
        return self.__port.baudrate

    @baudrate.setter
    def baudrate(self, rate: int, /) -> None:
        self.__port.baudrate = rate

    @property
    def parity(self) -> str:
        """The parity: ``N``, ``E`` or ``O``."""
        return self.__port.parity

    @parity.setter
    def parity(self, parity: str, /) -> None:
        self.__port.parity = parity

    @property
    def stopbits(self) -> float:
        """The number of stop bits: 1 or 2."""
        return self.__port.stopbits

    @stopbits.setter
    def stopbits(self, count: int, /) -> None:
        self.__port.stopbits = count

    @property
    def in_waiting(self) -> int:
        """The number of bytes that can be read now."""
        return self.__port.in_waiting

    @property
    def name(self) -> str:
        """The name of the port for messages."""
        return named(self.__port)

    @property
    def is_open(self) -> bool:
        """Whether the port is open."""
        return bool(getattr(self.__port, "is_open", True))

    def read(self, size: int, /) -> bytes:
        """Return `size` bytes, or fewer after `timeout`."""
        return self.__port.read(size)

    def close(self) -> None:
        """Close the port."""
        self.__port.close()

    def __getattr__(self, name: str) -> Callable[..., object]:
        """Return a method that only some ports have."""
        if name not in _OPTIONAL or not hasattr(self.__port, name):
            raise AttributeError(f"{self.name} has no {name}", name=name, obj=self)
        method = getattr(self.__port, name)

        def call(*arguments: float, **options: bool | None) -> object:
            result = method(*arguments, **options)
            if name == "power_cycle":
                self.__guard = Guard(self.__guard.allowed)
            return result

        return call


def _check_budget(budget: int | None) -> None:
    if budget is not None and not is_int(budget, 0, _LARGEST_BUDGET):
        raise InvalidValueError("budget", budget, f"0..{_LARGEST_BUDGET} writes, or None", "")


_OPTIONAL = frozenset({"flush", "now", "power_cycle", "reset_input_buffer", "sleep"})
