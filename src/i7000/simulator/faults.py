"""The faults of real lines: lost and flipped bits, noise, and bytes that arrive in lumps, late, or twice.

Laws: all randomness comes from the generator argument: the same seed and traffic give the same faults.
"""

from random import Random

from attrs import fields_dict, frozen

from i7000.errors import InvalidValueError

__all__ = ["Faults", "Piece", "Transfer"]

_LUMP_TIME = 0.016
"""USB adapters collect received bytes for this many seconds before they pass them on."""
_LONGEST_BURST = 16


@frozen
class Piece:
    """Bytes, and the delay in seconds until they arrive."""

    wire: bytes
    after: float = 0.0


@frozen
class Transfer:
    """The result of a transfer over the line: the bytes, and the faults in words."""

    pieces: tuple[Piece, ...]
    faults: tuple[str, ...] = ()


@frozen(kw_only=True)
class Faults:
    """The faults of a line.

    Unit: probabilities from 0 to 1; times in seconds.
    Errors: `InvalidValueError` for an invalid probability or time.
    """

    echo: bool = False
    """Whether the host receives what it sends, as with 2-wire adapters that do not turn off their receiver."""
    lumps: bool = False
    """Whether responses arrive in lumps every 16 ms, as from USB adapters."""
    drop: float = 0.0
    """The probability that a byte is lost, in either direction."""
    flip: float = 0.0
    """The probability that a bit of a byte is flipped, in either direction."""
    noise: float = 0.0
    """The probability that random bytes precede the bytes sent, in either direction."""
    late: float = 0.0
    """The probability that a response is late, when the host may have sent its next request."""
    late_by: float = 0.3

    def __attrs_post_init__(self) -> None:
        for name in fields_dict(Faults):
            value = getattr(self, name)
            if isinstance(value, bool):
                continue
            most = 60.0 if name == "late_by" else 1.0
            if not 0 <= value <= most:
                raise InvalidValueError(name, value, f"0..{most:g}", "")

    def carried(self, data: bytes, chance: Random) -> tuple[bytes, tuple[str, ...]]:
        """Return the bytes after their way over the line, and the faults in words."""
        if not (self.drop or self.flip or self.noise):
            return data, ()
        happened = []
        carried = bytearray()
        if self.noise and chance.random() < self.noise:
            carried += chance.randbytes(chance.randint(1, _LONGEST_BURST))
            happened.append(f"{len(carried)} bytes of noise before")
        for place, byte in enumerate(data):
            if self.drop and chance.random() < self.drop:
                happened.append(f"byte {place} lost")
            elif self.flip and chance.random() < self.flip:
                bit = chance.randrange(8)
                carried.append(byte ^ 1 << bit)
                happened.append(f"bit {bit} of byte {place} flipped")
            else:
                carried.append(byte)
        return bytes(carried), tuple(happened)

    def delivered(self, answer: bytes, character_time: float, chance: Random) -> Transfer:
        """Return the pieces in which a response arrives, and their delays."""
        wire, happened = self.carried(answer, chance)
        after = 0.0
        if self.late and chance.random() < self.late:
            after = self.late_by
            happened = (*happened, f"late by {after:g} s")
        if not self.lumps:
            return Transfer((Piece(wire, after),), happened)
        size = max(1, int(_LUMP_TIME / character_time))
        pieces = [
            Piece(wire[at : at + size], after + _LUMP_TIME * (1 + at // size)) for at in range(0, len(wire), size)
        ]
        return Transfer(tuple(pieces), (*happened, f"in {len(pieces)} lumps"))
