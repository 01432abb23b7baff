"""One end of a Telnet connection without I/O: data, options and subnegotiations, in order of arrival.

Sections: RFC 854 (commands), RFC 855 (options and subnegotiations).
Laws: any bytes in any pieces are accepted. At most `LONGEST_SUBNEGOTIATION` bytes are kept. A negotiation that changes
nothing gets no reply, and the replies about an option are limited, so two ends never answer each other for ever.
"""

from collections import Counter
from collections.abc import Iterator
from collections.abc import Set as AbstractSet

from attrs import frozen

__all__ = [
    "DO",
    "DONT",
    "IAC",
    "LONGEST_SUBNEGOTIATION",
    "MOST_REPLIES",
    "SB",
    "SE",
    "WILL",
    "WONT",
    "Negotiation",
    "Options",
    "Subnegotiation",
    "Telnet",
    "escaped",
    "subnegotiation",
]

SE, SB, WILL, WONT, DO, DONT, IAC = 240, 250, 251, 252, 253, 254, 255

LONGEST_SUBNEGOTIATION = 256
"""The maximum length of a subnegotiation in bytes; a longer one is skipped."""
MOST_REPLIES = 8
"""The maximum number of replies about one option."""


@frozen
class Negotiation:
    """A ``WILL``, ``WONT``, ``DO`` or ``DONT``, and its option."""

    verb: int
    option: int


@frozen
class Subnegotiation:
    """The content between ``IAC SB`` and ``IAC SE``; the option comes first."""

    content: bytes


def escaped(data: bytes) -> bytes:
    r"""Escape data, so that no byte is mistaken for a command.

    >>> escaped(b"\xfe\xff")
    b'\xfe\xff\xff'
    """
    return data.replace(b"\xff", b"\xff\xff")


def subnegotiation(content: bytes) -> bytes:
    r"""Encode a subnegotiation.

    >>> subnegotiation(b"\x2c\x65\xff")
    b'\xff\xfa,e\xff\xff\xff\xf0'
    """
    return bytes((IAC, SB)) + escaped(content) + bytes((IAC, SE))


class Telnet:
    """The receiving half of one end."""

    def __init__(self) -> None:
        self._command: tuple[int, ...] = ()
        """An incomplete command: ``IAC``, or ``IAC`` and a verb."""
        self._content: bytearray | None = None
        """The received part of a subnegotiation."""

    def receive(self, data: bytes) -> Iterator[bytes | Negotiation | Subnegotiation]:
        r"""Split the bytes from the peer into data, negotiations and subnegotiations.

        Special: a command in the middle of a subnegotiation ends it; other commands have no effect.

        >>> list(Telnet().receive(b"$01M\r\xff\xfa\x2c\x01\0\0\x25\x80\xff\xf0$02M\r"))
        [b'$01M\r', Subnegotiation(content=b',\x01\x00\x00%\x80'), b'$02M\r']
        """
        plain = bytearray()
        for byte in data:
            if not self._command and byte == IAC:
                self._command = (IAC,)
            elif not self._command or (self._command == (IAC,) and byte == IAC):
                self._command = ()
                self._keep(byte, plain)
            elif self._command == (IAC,) and byte in (WILL, WONT, DO, DONT):
                self._command = (IAC, byte)
                self._content = None
            else:
                command, self._command = self._command, ()
                found = self._ended(command, byte)
                if found is not None:
                    if plain:
                        yield bytes(plain)
                        plain.clear()
                    yield found
        if plain:
            yield bytes(plain)

    def _keep(self, byte: int, plain: bytearray) -> None:
        if self._content is None:
            plain.append(byte)
        elif len(self._content) <= LONGEST_SUBNEGOTIATION:
            self._content.append(byte)

    def _ended(self, command: tuple[int, ...], byte: int) -> Negotiation | Subnegotiation | None:
        """Return the result of a command that ends with `byte`."""
        if command != (IAC,):
            return Negotiation(command[1], byte)
        content, self._content = self._content, bytearray() if byte == SB else None
        if byte == SE and content is not None and len(content) <= LONGEST_SUBNEGOTIATION:
            return Subnegotiation(bytes(content))
        return None


class Options:
    """The options that are on, at this end and at the peer's (RFC 855).

    Shape: `ours` are the options that this end can use, `theirs` those that the peer may use.
    """

    def __init__(self, ours: AbstractSet[int], theirs: AbstractSet[int]) -> None:
        self._possible = {WILL: ours, DO: theirs}
        self._offered: set[tuple[int, int]] = set()
        self._on: set[tuple[int, int]] = set()
        self._replies: Counter[tuple[int, int]] = Counter()

    def offer(self, verb: int, option: int) -> bytes:
        """Return an offer to use an option (``WILL``), or to let the peer use it (``DO``)."""
        self._offered.add((verb, option))
        return bytes((IAC, verb, option))

    def answer(self, negotiation: Negotiation) -> bytes:
        """Return the reply to a negotiation; empty if there is none.

        Special: an unknown option is refused once; for a known one, `MOST_REPLIES` changes are answered.
        """
        yes, no = (WILL, WONT) if negotiation.verb in (DO, DONT) else (DO, DONT)
        key = yes, negotiation.option
        wanted = negotiation.verb in (DO, WILL)
        possible = negotiation.option in self._possible[yes]
        known = key in self._on or (wanted and key in self._offered)
        self._offered.discard(key)
        if wanted and possible:
            self._on.add(key)
        else:
            self._on.discard(key)
        if wanted == known or self._replies[key] >= (MOST_REPLIES if possible else 1):
            return b""
        self._replies[key] += 1
        return bytes((IAC, yes if wanted and possible else no, negotiation.option))

    def is_on(self, option: int) -> bool:
        """Return whether an option is on at one of the ends."""
        return (WILL, option) in self._on or (DO, option) in self._on
