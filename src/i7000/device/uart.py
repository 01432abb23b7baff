"""Characters on a line between two ends with possibly different line settings (manual 1.11).

Laws: an end with the same settings receives what was sent. Another end receives what it samples from the levels of the
line at its own speed. It drops characters with a wrong parity or stop bit.
"""

import re
from collections.abc import Callable, Iterable, Iterator
from functools import lru_cache

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

    Special: a receiver samples each bit in its middle, counted from the edge of the start bit. What begins at the
        moment of a sample counts.

    >>> hear_at(b"$012\r", Uart(9600), Uart(9600, stop_bits=2)), hear_at(b"$012\r", Uart(9600), Uart(19200))
    (b'$012\r', b'\x98\xe0\xe6\x80')
    """
    return data if sent.sounds_like(heard) else receiver(sent, heard)(levels_of(data, sent))


@lru_cache(maxsize=16)
def levels_of(data: bytes, uart: Uart) -> bytes:
    """Return the levels of a line on which one end sends characters without a pause, for `receiver`.

    Shape: one byte, 0 or 1, for each step of `_steps_of`, after a silence of one step.
    """
    characters = _characters(uart)
    return b"\1" + b"".join([characters[byte] for byte in data])


def _steps_of(uart: Uart) -> int:
    """Return how many levels one bit has: two if stop bits are not whole bits."""
    return 2 if uart.stop_bits == 1.5 else 1


@lru_cache(maxsize=64)
def _characters(uart: Uart) -> tuple[bytes, ...]:
    """Return the levels of each character."""
    steps, found = _steps_of(uart), []
    for byte in range(0x100):
        value = byte & (1 << uart.data_bits) - 1
        bits = [0, *(value >> bit & 1 for bit in range(uart.data_bits))]
        if uart.parity != "N":
            bits.append(uart.parity_bit(value))
        found.append(bytes(bit for bit in bits for _ in range(steps)) + b"\1" * round(uart.stop_bits * steps))
    return tuple(found)


@lru_cache(maxsize=1024)
def receiver(sent: Uart, heard: Uart) -> Callable[[bytes], bytes]:
    """Return the function that makes what an end with settings `heard` receives from the `levels_of` another end."""
    count = heard.data_bits + 2 + (heard.parity != "N")
    sampled = _sampler(sent.rate * _steps_of(sent), heard.rate, count)

    @lru_cache(maxsize=8192)
    def value_of(bits: bytes) -> int | None:
        value = sum(bit << at for at, bit in enumerate(bits[1 : 1 + heard.data_bits]))
        right = bits[-1] and (heard.parity == "N" or bits[-2] == heard.parity_bit(value))
        return value if right else None

    def receive(levels: bytes) -> bytes:
        return bytes([value for value in map(value_of, sampled(levels)) if value is not None])

    return receive


@lru_cache(maxsize=1024)
def _sampler(rate: int, heard_rate: int, count: int) -> Callable[[bytes], tuple[bytes, ...]]:
    """Return the function that samples the `count` bits of each character on a line with `rate` levels a second."""
    samples = [(2 * bit + 1) * rate // (2 * heard_rate) for bit in range(count)]
    found = _finder(samples[0], samples[-1] + 1, -((1 - 2 * count) * rate // (2 * heard_rate)))
    step = rate // heard_rate

    @lru_cache(maxsize=8192)
    def picked(levels: bytes) -> bytes:
        size = len(levels)
        return bytes([at >= size or levels[at] for at in samples])

    @lru_cache(maxsize=4)
    def sampled(levels: bytes) -> tuple[bytes, ...]:
        if rate != step * heard_rate:
            return tuple(map(picked, found(levels)))
        return tuple([levels[samples[0] :: step].ljust(count, b"\1") for levels in found(levels)])

    return sampled


def _finder(start_bit: int, width: int, length: int) -> Callable[[bytes], Iterable[bytes]]:
    """Return the function that finds the characters on a line, as the `width` levels from the edge of the start bit on.

    Shape: a character whose level is high again at `start_bit` is a spike; the next can begin at its next edge. After
        others, the next can begin `length` levels later.
    """
    if width > _WIDEST:
        return lambda levels: _found_slowly(levels, start_bit, width, length)
    spike = f"(?=\0.{{{start_bit - 1}}}(?:\1|$))|(?=\0.{{,{start_bit - 1}}}$)|" if start_bit else ""
    after = f".{{,{length - 2}}}" if length > 1 else ""
    pattern = re.compile(f"\1(?:{spike}(?=(\0.{{,{width - 1}}}))\0{after})".encode(), re.DOTALL)

    def found(levels: bytes) -> Iterable[bytes]:
        return filter(None, pattern.findall(levels))

    return found


_WIDEST = 1000
"""The widest character that is found by a pattern."""


def _found_slowly(levels: bytes, start_bit: int, width: int, length: int) -> Iterator[bytes]:
    start = levels.find(_FALL) + 1
    while start:
        spike = start + start_bit >= len(levels) or levels[start + start_bit]
        if not spike:
            yield levels[start : start + width]
        start = levels.find(_FALL, start if spike else start + length - 1) + 1


_FALL = b"\1\0"
