"""The faults of real lines and modules: damaged, lost, late, repeated and wrong answers.

Laws: all randomness comes from the generator argument: the same seed and traffic give the same faults. A fault that is
off draws no random number, so switching one on leaves the others of a seed as they were until it first happens.
"""

from enum import StrEnum
from functools import lru_cache
from random import Random
from typing import Any

from attrs import evolve, fields_dict, frozen

from i7000 import dcon, modbus
from i7000.errors import InvalidValueError
from i7000.settings import Protocol, is_int

__all__ = ["Exchange", "Faults", "Piece", "Scoped", "Transfer", "Way"]

_LUMP_TIME = 0.016
"""USB adapters collect received bytes for this many seconds before they pass them on."""
_LONGEST_BURST = 16
_LAST_ADDRESS = 247
"""The last address of Modbus."""


class Way(StrEnum):
    """The directions of a line, as a host sees them."""

    TO = "to"
    """Requests: to the modules."""
    FROM = "from"
    """Answers: from the modules."""


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


@frozen
class Exchange:
    r"""The request of an answer, for faults that replace the answer by another one.

    >>> Exchange(b"$1FM\r", Protocol.DCON).address, Exchange(b"", Protocol.DCON).address
    (31, None)
    """

    request: bytes
    protocol: Protocol
    checksum: bool = False
    """Whether DCON frames have a checksum."""
    earlier: bytes | None = None
    """The answer to the last request that differed."""

    @property
    def address(self) -> int | None:
        """The address in the request; None if it has none."""
        if self.protocol is Protocol.MODBUS_RTU:
            return self.request[0] if self.request else None
        digits = self.request[1:3]
        return int(digits, 16) if len(digits) == 2 and digits.isalnum() and digits.strip(_HEX) == b"" else None


_HEX = b"0123456789ABCDEF"


@frozen
class Scoped:
    """The value of a fault in one direction, or for the answers of the module at one address."""

    where: Way | int
    name: str
    value: float


@frozen(kw_only=True)
class Faults:
    """The faults of a line.

    Unit: probabilities from 0 to 1; times in seconds.
    Errors: `InvalidValueError` for an invalid probability, time or code.

    >>> faults = Faults(late=0.1).at(0x02, late=1.0).at(Way.TO, drop=0.01)
    >>> faults.requests.drop, faults.answers(0x01).late, faults.answers(0x02).late
    (0.01, 0.1, 1.0)
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
    silent: float = 0.0
    """The probability that a response is lost completely."""
    refuse: float = 0.0
    """The probability that ``?AA`` or a Modbus exception replaces a response; the module has carried out the request.
    """
    refuse_code: int = 4
    """The code of the exception."""
    replay: float = 0.0
    """The probability that the response to the last different request of the host replaces a response."""
    misaddress: float = 0.0
    """The probability that a response has the address of another module; a DCON response with ``>`` has no address."""
    misfunction: float = 0.0
    """The probability that a response is one to another command: with another function code and a good CRC, or in DCON
    with ``!`` and the address in place of ``>``, and the other way round.
    """
    corrupt: float = 0.0
    """The probability that one bit of a response is flipped, wherever it is."""
    lookalike: float = 0.0
    """The probability that a frame precedes a response which looks like it but is shorter, with a good checksum or CRC.
    """
    trailing: float = 0.0
    """The probability that a byte 00 follows a response; a CRC stays good when it is included."""
    truncate: float = 0.0
    """The probability that a response ends early."""
    duplicate: float = 0.0
    """The probability that a response arrives twice."""
    split: float = 0.0
    """The probability that a response arrives in two pieces, with a pause between them."""
    split_by: float = 0.05
    scoped: tuple[Scoped, ...] = ()
    """The values in one direction or for one address, from `at`."""

    def __attrs_post_init__(self) -> None:
        for name in _NAMES:
            _check(name, getattr(self, name))

    def at(self, where: Way | int, **values: float) -> "Faults":
        """Return the faults with other values in one direction, or for the answers of one address.

        Special: the value for an address replaces that for the direction `Way.FROM`, which replaces the common one.
        Errors: `InvalidValueError`, also for a fault that does not occur there: requests can only be damaged, since all
            modules hear them, and an echo has neither direction nor address.
        """
        if not isinstance(where, Way) and not is_int(where, 0, 0xFF):
            raise InvalidValueError("where", where, "Way.TO, Way.FROM or an address of 0..255", "")
        allowed = _OF_REQUESTS if where is Way.TO else _OF_ANSWERS
        scoped = {(it.where, it.name): it for it in self.scoped}
        for name, value in values.items():
            if name not in allowed:
                raise InvalidValueError("fault", name, f"{', '.join(allowed)}, at {where}", "")
            _check(name, value)
            scoped[where, name] = Scoped(where, name, value)
        return evolve(self, scoped=tuple(scoped.values()))

    @property
    def requests(self) -> "Faults":
        """The faults of requests."""
        return _at(self, (Way.TO,)) if self.scoped else self

    def answers(self, address: int | None) -> "Faults":
        """Return the faults of the answers to requests to an address; None if the request has none."""
        return _at(self, (Way.FROM, address)) if self.scoped else self

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

    def delivered(
        self, answer: bytes, character_time: float, chance: Random, exchange: Exchange | None = None
    ) -> Transfer:
        """Return the pieces in which a response arrives, and their delays.

        Special: without `exchange` no other response replaces it.
        """
        if _happens(self.silent, chance):
            return Transfer((), ("the answer is lost",))
        wire, other = (answer, ()) if exchange is None else self._replaced(answer, exchange, chance)
        wire, changed = self._changed(wire, exchange, chance)
        wire, damage = self.carried(wire, chance)
        happened = other + changed + damage
        after = 0.0
        if _happens(self.late, chance):
            after = self.late_by
            happened = (*happened, f"late by {after:g} s")
        if _happens(self.split, chance) and len(wire) > 1:
            place = chance.randrange(1, len(wire))
            pieces = [Piece(wire[:place], after), Piece(wire[place:], after + self.split_by)]
            return Transfer(tuple(pieces), (*happened, f"split after {place} bytes for {self.split_by:g} s"))
        if not self.lumps:
            return Transfer((Piece(wire, after),), happened)
        size = max(1, int(_LUMP_TIME / character_time))
        pieces = [
            Piece(wire[at : at + size], after + _LUMP_TIME * (1 + at // size)) for at in range(0, len(wire), size)
        ]
        return Transfer(tuple(pieces), (*happened, f"in {len(pieces)} lumps"))

    def _changed(self, wire: bytes, exchange: Exchange | None, chance: Random) -> tuple[bytes, tuple[str, ...]]:
        """Return the bytes of a response with what is wrong with them, and the faults in words."""
        happened: list[str] = []
        if _happens(self.corrupt, chance) and wire:
            bit = chance.randrange(8 * len(wire))
            wire = wire[: bit // 8] + bytes((wire[bit // 8] ^ 1 << bit % 8,)) + wire[bit // 8 + 1 :]
            happened.append(f"bit {bit % 8} of byte {bit // 8} flipped")
        if _happens(self.truncate, chance) and len(wire) > 1:
            wire = wire[: chance.randrange(1, len(wire))]
            happened.append(f"cut after {len(wire)} bytes")
        if _happens(self.duplicate, chance):
            wire *= 2
            happened.append("sent twice")
        if _happens(self.lookalike, chance) and exchange is not None and (other := _lookalike(wire, exchange)):
            wire = other + wire
            happened.append(f"a frame of {len(other)} bytes that looks like it before")
        if _happens(self.trailing, chance):
            wire += b"\0"
            happened.append("00 after it")
        return wire, tuple(happened)

    def _replaced(self, answer: bytes, exchange: Exchange, chance: Random) -> tuple[bytes, tuple[str, ...]]:
        """Return the response that arrives in place of another one, and why."""
        if _happens(self.refuse, chance) and (refusal := _refusal(exchange, self.refuse_code)):
            return refusal
        if _happens(self.replay, chance) and exchange.earlier is not None:
            return exchange.earlier, ("an earlier answer",)
        if _happens(self.misaddress, chance) and (misaddressed := _misaddressed(answer, exchange)):
            return misaddressed
        if _happens(self.misfunction, chance) and (misread := _misfunction(answer, exchange)):
            return misread
        return answer, ()


_NAMES = tuple(name for name in fields_dict(Faults) if name != "scoped")
_OF_REQUESTS = ("drop", "flip", "noise")
_OF_ANSWERS = tuple(name for name in _NAMES if name != "echo")


def _check(name: str, value: object) -> None:
    if name in ("echo", "lumps"):
        allowed, valid = "True or False", isinstance(value, bool)
    elif name == "refuse_code":
        allowed, valid = "1..255", is_int(value, 1, 0xFF)
    else:
        most = 60.0 if name in ("late_by", "split_by") else 1.0
        allowed, valid = f"0..{most:g}", isinstance(value, int | float) and 0 <= value <= most
    if not valid:
        raise InvalidValueError(name, value, allowed, "")


def _happens(probability: float, chance: Random) -> bool:
    return probability > 0 and chance.random() < probability


@lru_cache(maxsize=1024)
def _at(faults: Faults, where: tuple[Way | int | None, ...]) -> Faults:
    """Return the faults in some scopes, the last of which counts."""
    values: dict[str, Any] = {it.name: it.value for one in where for it in faults.scoped if it.where == one}
    return evolve(faults, scoped=(), **values)


# --- other answers ----------------------------------------------------------------------------------------------------


def _refusal(exchange: Exchange, code: int) -> tuple[bytes, tuple[str, ...]] | None:
    address = exchange.address
    if address is None:
        return None
    if exchange.protocol is Protocol.DCON:
        return dcon.seal(b"?%02X" % address, checksum=exchange.checksum), ("refused",)
    function = exchange.request[1:2] or b"\0"
    return modbus.seal(bytes((address, function[0] | 0x80, code))), (f"refused with exception {code:02X}",)


def _misaddressed(answer: bytes, exchange: Exchange) -> tuple[bytes, tuple[str, ...]] | None:
    """Return the response with the address of another module; None if it has no address."""
    address = exchange.address
    if address is None:
        return None
    other = address % _LAST_ADDRESS + 1
    words = (f"with address {other:02X}",)
    if exchange.protocol is Protocol.MODBUS_RTU:
        return (modbus.seal(bytes((other,)) + answer[1:-2]), words) if answer[:1] == bytes((address,)) else None
    if answer[:3] not in (b"!%02X" % address, b"?%02X" % address):
        return None
    body = answer[:1] + b"%02X" % other + answer[3 : -3 if exchange.checksum else -1]
    return dcon.seal(body, checksum=exchange.checksum), words


_PAIRS = {1: 2, 3: 4, 5: 6, 15: 16}
_OTHER_FUNCTIONS = _PAIRS | {other: function for function, other in _PAIRS.items()}
"""Functions whose responses have the same shape."""
_NO_SUCH_FUNCTION = 0x47


def _misfunction(answer: bytes, exchange: Exchange) -> tuple[bytes, tuple[str, ...]] | None:
    """Return the response as one to another command; None if it is neither."""
    address = exchange.address
    if exchange.protocol is Protocol.MODBUS_RTU:
        if len(answer) < _SHORTEST_RTU:
            return None
        other = _OTHER_FUNCTIONS.get(answer[1], _NO_SUCH_FUNCTION)
        return modbus.seal(bytes((answer[0], other)) + answer[2:-2]), (f"with function {other:02X}",)
    body = answer[: -3 if exchange.checksum else -1]
    if body[:1] == b">" and address is not None:
        other_body = b"!%02X" % address + body[1:]
    elif body[:1] == b"!" and len(body) > 3:
        other_body = b">" + body[3:]
    else:
        return None
    words = f"with {other_body[:1].decode()} in place of {body[:1].decode()}"
    return dcon.seal(other_body, checksum=exchange.checksum), (words,)


_SHORTEST_RTU = 5
"""The length of the shortest response of Modbus RTU: an exception."""


def _lookalike(wire: bytes, exchange: Exchange) -> bytes | None:
    """Return a good frame that is a byte or a register shorter than a response; None if there is no shorter one."""
    if exchange.protocol is Protocol.MODBUS_RTU:
        count = wire[2] - 2 if len(wire) > _SHORTEST_RTU + 2 else 0
        return modbus.seal(wire[:2] + bytes((count,)) + wire[3 : 3 + count]) if count > 0 else None
    body = wire[: -3 if exchange.checksum else -1]
    return dcon.seal(body[:-1], checksum=exchange.checksum) if len(body) > 3 else None
