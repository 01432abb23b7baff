r"""The guard: the hazards of bytes that a host sends, and the state of a line whose hazards are limited.

Every byte string is classified by the worst reading that a firmware could make of it, together with what is unfinished
on the line: as DCON (`guard_dcon`), as Modbus RTU (`guard_rtu`), and as what modules with other line settings receive.

Laws: whatever a module would carry out has hazards that are found here. Modules with other line settings are not
lenient: they carry out complete lines and requests only. All commands and requests that read are allowed on an idle
line, at every address and with and without a checksum, but for two that look like others: ``$FFP00``, the protocol of
module FF with its checksum, which looks like a new protocol; and the type of channel 5 of module A4 by function 46h,
whose text is ``$F1S``. What is unfinished on the line can make others look dangerous. A guard keeps the last 255 bytes
of each protocol, more than any frame needs to be completed; of longer text it keeps the last 255 characters that no
firmware drops.

>>> Guard().sending(b"$012\r", LineSettings()).allowed == DEFAULT_ALLOWED
True
"""

from collections.abc import Callable, Iterator
from functools import cache, lru_cache
from typing import NamedTuple

from attrs import field

from i7000.arguments import as_bytes, check_type
from i7000.conformance.guard_dcon import DROPPED, HEARD_AS, hazards_in_text
from i7000.conformance.guard_rtu import begins_nothing, hazards_at, hazards_of_modules, hazards_with_crc, is_frame
from i7000.conformance.hazard import DEFAULT_ALLOWED, Hazard, worst_of
from i7000.device.uart import Uart, levels_of, receiver
from i7000.errors import I7000Error, InvalidValueError, written
from i7000.frozen import frozen
from i7000.settings import BaudRate, CharacterFormat, LineSettings

__all__ = ["LONGEST_WRITE", "Guard", "GuardError", "hazards_of"]

LONGEST_WRITE = 4096
"""The most bytes of one write."""
_KEPT = 255
_HARMLESS = frozenset({Hazard.OBSERVE})

_LINES = tuple(LineSettings(rate, form) for rate in BaudRate for form in CharacterFormat if form.name != "N82")
"""The line settings that a module can have; those that differ only in stop bits sound alike."""
_UARTS = tuple(map(Uart.of, _LINES))


class GuardError(I7000Error):
    """Bytes that were not sent, because they can do more than is allowed.

    Shape: `wire`; `hazards`, those that are not allowed; `before`, the unfinished bytes on the line if they are part of
        the reason; `line`, the line settings of the modules that would carry it out.
    """

    def __init__(
        self, wire: bytes, hazards: frozenset[Hazard], before: bytes, line: LineSettings, *, own: bool
    ) -> None:
        super().__init__(wire, hazards, before, line, own)
        self.wire = wire
        self.hazards = hazards
        self.before = before
        self.line = line
        self.own = own

    def __str__(self) -> str:
        worst = worst_of(self.hazards)
        after = f" after {written(self.before)}" if self.before else ""
        rate, form = Uart.of(self.line).rate, self.line.character_format.name
        where = "" if self.own else f", as modules at {rate} baud {form} receive it"
        options = " ".join(f"--allow {hazard.value}" for hazard in Hazard if hazard in self.hazards)
        return f"{written(self.wire)}{after} was not sent: it {worst.words}{where} ({options})"


class Rest(NamedTuple):
    """What may still become a frame to modules with one line setting."""

    text: bytes = b""
    """The text since the last carriage return, as a lenient firmware hears it."""
    frame: bytes = b""
    """The last bytes since the line was silent."""
    starts: tuple[int, ...] = ()
    """Where in `frame` the writes of the host begin that no request with the right CRC has ended."""


@frozen
class Guard:
    """A line on which only bytes of some hazards may be sent."""

    allowed: frozenset[Hazard] = field(default=DEFAULT_ALLOWED)
    rests: tuple[Rest, ...] = field(default=(Rest(),) * len(_LINES), kw_only=True, repr=False)

    def __attrs_post_init__(self) -> None:
        if not isinstance(self.allowed, frozenset) or not {Hazard}.issuperset(map(type, self.allowed)):
            raise InvalidValueError("allowed", self.allowed, "a frozenset of Hazard, see allowing()", "")

    def hazards_of(self, wire: bytes, line: LineSettings) -> frozenset[Hazard]:
        """Return the hazards of bytes that a host sends now, with line settings `line`."""
        found = _HARMLESS
        for hazards, *_ in self._heard(_checked(wire, line), line):
            found |= hazards
        return found

    def sending(self, wire: bytes, line: LineSettings) -> "Guard":
        r"""Return the guard after bytes were sent; `line` is the line settings of the host.

        Errors: `GuardError` for bytes with a hazard that is not allowed; they must not be sent. `InvalidValueError`
            for more than `LONGEST_WRITE` bytes, and for an undefined baud rate.

        >>> Guard().sending(b"~01", LineSettings()).sending(b"O7018\r", LineSettings())
        Traceback (most recent call last):
        i7000.conformance.guard.GuardError: O7018\r after ~01 was not sent: it changes a setting (--allow write)
        """
        return self.judged(wire, line)[0]

    def judged(self, wire: bytes, line: LineSettings) -> tuple["Guard", frozenset[Hazard]]:
        """Return the guard after bytes were sent, and their hazards.

        Errors: as `sending`.
        """
        wire = _checked(wire, line)
        rests, found = list(self.rests), _HARMLESS
        for hazards, place, rest in self._heard(wire, line):
            refused = hazards - self.allowed - _HARMLESS
            if refused:
                alone = refused <= Guard().hazards_of(wire, line)
                before = b"" if alone else rests[place].frame or rests[place].text
                raise GuardError(wire, refused, before, _LINES[place], own=place == _ends(line)[1])
            rests[place] = rest
            found |= hazards
        return Guard(self.allowed, rests=tuple(rests)), found

    def after_silence(self) -> "Guard":
        """Return the guard after a silence that ends every Modbus frame; text stays, for DCON has no timeout."""
        return Guard(self.allowed, rests=tuple([Rest(rest.text) for rest in self.rests]))

    def _heard(self, wire: bytes, line: LineSettings) -> Iterator[tuple[frozenset[Hazard], int, Rest]]:
        """Yield the hazards at each line setting at which something is received, its place, and the new rest."""
        own = _ends(line)[1]
        yield _lenient(self.rests[own], wire, own)
        for place, heard in _received(wire, line):
            yield _strict(self.rests[place], heard, place)


@cache
def _ends(line: LineSettings) -> tuple[Uart, int, tuple[tuple[int, Callable[[bytes], bytes]], ...]]:
    """Return the host's end of the line, the place that hears the same, and what makes each other place receive."""
    sent = Uart.of(line)
    own = next(place for place, uart in enumerate(_UARTS) if uart.sounds_like(sent))
    return sent, own, tuple([(at, receiver(sent, uart)) for at, uart in enumerate(_UARTS) if at != own])


@lru_cache(maxsize=64)
def _received(wire: bytes, line: LineSettings) -> tuple[tuple[int, bytes], ...]:
    """Return what modules with other line settings than those of the host receive, where they receive something."""
    sent, _, others = _ends(line)
    levels = levels_of(wire, sent)
    heard = [(place, receive(levels)) for place, receive in others]
    return tuple([(place, found) for place, found in heard if found])


def hazards_of(wire: bytes, line: LineSettings = LineSettings()) -> frozenset[Hazard]:  # noqa: B008 - frozen
    r"""Return the hazards of bytes on an idle line.

    >>> sorted(hazard.value for hazard in hazards_of(b"#**\r"))
    ['broadcast', 'observe']
    """
    return Guard().hazards_of(wire, line)


def _checked(wire: bytes, line: LineSettings) -> bytes:
    wire = as_bytes("wire", wire)
    check_type("line", line, LineSettings)
    if len(wire) > LONGEST_WRITE:
        raise InvalidValueError("wire", len(wire), f"at most {LONGEST_WRITE} bytes in one write", "")
    return wire


def _lenient(rest: Rest, wire: bytes, place: int) -> tuple[frozenset[Hazard], int, Rest]:
    """Return what modules with the line settings of the host could do, and what is unfinished then."""
    text = rest.text + wire.translate(HEARD_AS)
    frame, new = rest.frame + wire, len(rest.frame)
    found = hazards_in_text(text) | hazards_with_crc(frame, new) | hazards_at(wire, whole_body=False)
    for start in rest.starts:
        found |= hazards_at(frame[start:], whole_body=True)
    starts = tuple([start for start in (*rest.starts, new) if not begins_nothing(frame[start:])])
    if any(is_frame(frame[start:]) for start in starts):
        starts = ()
    return found, place, _rest(text, frame, starts)


def _strict(rest: Rest, heard: bytes, place: int) -> tuple[frozenset[Hazard], int, Rest]:
    """Return what modules with other line settings could do, and what is unfinished then."""
    text, frame = rest.text + heard.translate(HEARD_AS), rest.frame + heard
    found = hazards_of_modules(frame, len(rest.frame))
    if b"\r" in text:
        found |= hazards_in_text(text[: text.rindex(b"\r") + 1])
    return found, place, _rest(text, frame, ())


def _rest(text: bytes, frame: bytes, starts: tuple[int, ...]) -> Rest:
    cut = max(0, len(frame) - _KEPT)
    kept = tuple([start - cut for start in starts if start >= cut])
    text = text[text.rfind(b"\r") + 1 :]
    if len(text) > _KEPT:
        text = text.translate(None, DROPPED)[-_KEPT:]
    return Rest(text, frame[cut:], kept)
