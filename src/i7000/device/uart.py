"""Characters on a line between two ends with possibly different line settings (manual 1.11).

Laws: an end with the same settings receives what was sent. Another end receives what it samples from the levels of the
line at its own speed. It drops characters with a wrong parity or stop bit.
"""

from itertools import pairwise

from attrs import field

from i7000.arguments import check_int, check_type, is_number
from i7000.errors import InvalidValueError
from i7000.frozen import frozen
from i7000.settings import BaudRate, LineSettings, is_int

__all__ = ["Uart", "hear_at"]


_FASTEST = 1_000_000_000


@frozen
class Uart:
    """The settings of one end of a line; every setting that a serial port can have.

    Unit: `rate` in bits per second.
    Errors: `InvalidValueError`.
    """

    rate: int = 9600
    parity: str = field(default="N", kw_only=True)
    """``N``, ``E``, ``O``, ``M`` (always 1) or ``S`` (always 0)."""
    stop_bits: float = field(default=1, kw_only=True)
    data_bits: int = field(default=8, kw_only=True)

    def __attrs_post_init__(self) -> None:
        if not is_int(self.rate, 1, _FASTEST):
            raise InvalidValueError("rate", self.rate, f"1..{_FASTEST} bits per second", "1.11")
        if self.parity not in ("N", "E", "O", "M", "S"):
            raise InvalidValueError("parity", self.parity, "N, E, O, M or S", "1.11")
        if not is_number(self.stop_bits) or self.stop_bits not in (1, 1.5, 2):
            raise InvalidValueError("stop_bits", self.stop_bits, "1, 1.5 or 2", "1.11")
        if not is_int(self.data_bits, 5, 8):
            raise InvalidValueError("data_bits", self.data_bits, "5 to 8", "1.11")

    @classmethod
    def of(cls, line: LineSettings) -> "Uart":
        """Return the settings of a module's line.

        Errors: `InvalidValueError` for a baud rate that is not defined.

        >>> Uart.of(LineSettings())
        Uart(rate=9600, parity='N', stop_bits=1, data_bits=8)
        """
        check_type("line", line, LineSettings)
        rate = BaudRate.of(line.baud_rate)
        if not isinstance(rate, BaudRate):
            raise InvalidValueError("baud_rate", f"{rate:02X}", "03..0A", "1.11")
        form = line.character_format
        return cls(rate.bits_per_second, parity=form.parity, stop_bits=form.stop_bits)

    @property
    def character_time(self) -> float:
        """The length of a character in seconds."""
        return (1 + self.data_bits + (self.parity != "N") + self.stop_bits) / self.rate

    def parity_bit(self, byte: int) -> int:
        """Return the parity bit of a character; 0 without parity.

        Errors: `InvalidValueError` for a value that is not a byte.
        """
        check_int("byte", byte)
        if not 0 <= byte <= 0xFF:
            raise InvalidValueError("byte", byte, "00..FF", "1.11")
        return {"E": byte.bit_count() & 1, "O": ~byte.bit_count() & 1, "M": 1}.get(self.parity, 0)

    def sounds_like(self, other: "Uart") -> bool:
        """Return whether one end receives what the other sends; stop bits are only a minimum silence."""
        check_type("other", other, Uart)
        return (self.rate, self.parity, self.data_bits) == (other.rate, other.parity, other.data_bits)


def hear_at(data: bytes, sent: Uart, heard: Uart) -> bytes:
    r"""Return what an end with settings `heard` receives if one with settings `sent` sends characters without a pause.

    >>> hear_at(b"$012\r", Uart(9600), Uart(9600, stop_bits=2)), hear_at(b"$012\r", Uart(9600), Uart(19200))
    (b'$012\r', b'\x98\xe0\xe6\x80')
    """
    if sent.sounds_like(heard):
        return data
    levels = _levels(data, sent)
    falls = [at for (level, _), (lower, at) in pairwise(levels) if level > lower]
    return _sampled(levels, falls, heard)


Levels = list[tuple[int, float]]
"""The levels of a line, each with the time when it starts."""


def _levels(data: bytes, uart: Uart) -> Levels:
    levels: Levels = [(1, 0.0)]
    at = 1 / uart.rate
    for byte in data:
        value = byte & (1 << uart.data_bits) - 1
        bits = [0, *(value >> bit & 1 for bit in range(uart.data_bits))]
        if uart.parity != "N":
            bits.append(uart.parity_bit(value))
        for bit in bits:
            levels.append((bit, at))
            at += 1 / uart.rate
        levels.append((1, at))
        at += uart.stop_bits / uart.rate
    return levels


def _sampled(levels: Levels, falls: list[float], uart: Uart) -> bytes:
    """Sample each character in the middle of its bits, counted from the edge of its start bit."""
    heard = bytearray()
    free_at = 0.0
    place = 0

    def level(time: float) -> int:
        nonlocal place
        while place + 1 < len(levels) and levels[place + 1][1] <= time:
            place += 1
        return levels[place][0]

    for fall in falls:
        if fall < free_at:
            continue
        times = [fall + (bit + 0.5) / uart.rate for bit in range(uart.data_bits + 2 + (uart.parity != "N"))]
        start, *bits = map(level, times)
        if start:
            continue
        free_at = times[-1]
        value = sum(bit << at for at, bit in enumerate(bits[: uart.data_bits]))
        if bits[-1] and (uart.parity == "N" or bits[-2] == uart.parity_bit(value)):
            heard.append(value)
    return bytes(heard)
