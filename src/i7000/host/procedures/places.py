"""The places of a scan: where a module can be, in which order to look there, and how long that takes."""

from collections.abc import Iterable, Iterator
from functools import lru_cache
from itertools import product
from typing import cast

from attrs import field

from i7000 import dcon, describe, modbus
from i7000.arguments import as_tuple, check_int, check_type
from i7000.errors import EncodeError
from i7000.frozen import frozen
from i7000.host.bus import Bus, Policy, next_deadline, receive, send
from i7000.host.events import Ended, Transmit
from i7000.message import Query, Response
from i7000.modbus.request import LAST_ADDRESS
from i7000.models import Model
from i7000.profile import Profile
from i7000.settings import BaudRate, CharacterFormat, LineSettings, Protocol

__all__ = ["EVERY_LINE", "SCAN_POLICY", "Place", "places", "scan_time"]

_LIKELY_RATES = (9600, 115200, 19200, 38400, 57600, 4800, 2400, 1200)
EVERY_LINE = tuple(
    LineSettings(BaudRate[f"BAUD_{rate}"], character_format)
    for character_format in CharacterFormat
    for rate in _LIKELY_RATES
)
"""All line settings that a module can have, the likely ones first."""
_FACTORY_ADDRESS = 0x01
_INIT_ADDRESS = 0x00
"""The address of a module in INIT mode, with 9600 baud, N81, DCON and no checksum (A.1)."""
SCAN_POLICY = Policy(retries=0, turnaround=0.1, grace=0.05)
"""The policy of a scan: short, since nearly every request of it is in vain."""


@frozen
class Place:
    """Where a module can be: line settings, address, protocol, and whether DCON frames have a checksum."""

    line: LineSettings
    address: int
    protocol: Protocol = Protocol.DCON
    checksum: bool = field(default=False, kw_only=True)
    """Whether DCON frames have a checksum; False for Modbus, whose frames always have a CRC."""

    def __str__(self) -> str:
        """Return the place in words: ``address 01, 06, 9600 baud, N81, DCON without checksum``."""
        words = "Modbus RTU"
        if self.protocol is Protocol.DCON:
            words = f"DCON {'with' if self.checksum else 'without'} checksum"
        return f"address {self.address:02X}, {describe.line_settings(self.line)}, {words}"

    @property
    def profile(self) -> Profile:
        """The profile for requests that every module answers here."""
        model = Model.I_7017 if self.protocol is Protocol.DCON else Model.M_7017
        return Profile(model, type_codes=(), checksum=self.checksum)

    @property
    def question(self) -> Query[Response]:
        """The request that every module answers here, and that changes nothing: its name, or an input register."""
        if self.protocol is Protocol.DCON:
            return dcon.ReadModuleName(self.address)
        return modbus.ReadInputRegisters(self.address, 0, 1)


def places(
    lines: Iterable[LineSettings],
    addresses: Iterable[int] = range(0x100),
    protocols: Iterable[Protocol] = (Protocol.DCON, Protocol.MODBUS_RTU),
    checksums: Iterable[bool] = (False, True),
) -> tuple[Place, ...]:
    """Return the places where a module can be, the likely ones first.

    Shape: first address 01, where modules come from the factory, with all line settings, 9600 N81 first; then the other
        addresses, line by line. Otherwise the order is that of the arguments. With 9600 N81 and DCON, address 00
        without checksum is one of the first places, even if it is not in `addresses`: there a module in INIT mode is.
    Range: addresses 00..FF; those that Modbus does not have (00, F8..FF) are places of DCON only.
    Errors: `EncodeError` for another address, `InvalidValueError` for an undefined baud rate.
    Manual: 1.9, 1.12.2, A.1.
    """
    wanted = sorted(_checked_lines(lines), key=lambda line: line != LineSettings())
    numbers = _checked_addresses(addresses)
    kinds = tuple(_kinds(as_tuple("protocols", protocols), as_tuple("checksums", checksums)))
    found = [
        Place(line, address, protocol, checksum=checksum)
        for line, address, (protocol, checksum) in product(wanted, (_FACTORY_ADDRESS,), kinds)
        if address in numbers
    ]
    if LineSettings() in wanted and (Protocol.DCON, False) in kinds:
        found.insert(len(kinds) if _FACTORY_ADDRESS in numbers else 0, Place(LineSettings(), _INIT_ADDRESS))
    found += [
        Place(line, address, protocol, checksum=checksum)
        for line, address, (protocol, checksum) in product(wanted, numbers, kinds)
        if protocol is Protocol.DCON or 1 <= address <= LAST_ADDRESS
    ]
    return tuple(dict.fromkeys(found))


def _checked_lines(lines: Iterable[LineSettings]) -> tuple[LineSettings, ...]:
    wanted = as_tuple("lines", lines)
    for line in wanted:
        check_type("lines", line, LineSettings)
        Bus[Response](line=line)  # which refuses an undefined baud rate
    return wanted


def _checked_addresses(addresses: Iterable[int]) -> tuple[int, ...]:
    numbers = as_tuple("addresses", addresses)
    for address in numbers:
        check_int("addresses", address)
        if not 0 <= address <= 0xFF:
            raise EncodeError("addresses", address, "00..FF", "2")
    return numbers


def _kinds(protocols: tuple[Protocol, ...], checksums: tuple[bool, ...]) -> Iterator[tuple[Protocol, bool]]:
    """Yield the protocols with the checksum settings that each has."""
    for protocol in protocols:
        check_type("protocols", protocol, Protocol)
        for checksum in checksums if protocol is Protocol.DCON else (False,):
            check_type("checksums", checksum, bool)
            yield protocol, checksum


def scan_time(
    lines: Iterable[LineSettings],
    addresses: Iterable[int] = range(0x100),
    protocols: Iterable[Protocol] = (Protocol.DCON, Protocol.MODBUS_RTU),
    checksums: Iterable[bool] = (False, True),
    *,
    policy: Policy = SCAN_POLICY,
) -> float:
    """Return how long `scan` takes with the same arguments if nothing answers, up to the end of its last silence.

    Unit: seconds.
    Special: each Modbus device that answers adds the time of a request; each module that answers by DCON saves time.
    Errors: as for `places`.
    """
    check_type("policy", policy, Policy)
    return sum((seconds_at(place, policy) for place in places(lines, addresses, protocols, checksums)), 0.0)


def seconds_at(place: Place, policy: Policy) -> float:
    """Return how long it takes to look at a place, up to the next request."""
    return _silent_seconds(place.line, place.protocol, place.checksum, policy)


@lru_cache(maxsize=256)
def _silent_seconds(line: LineSettings, protocol: Protocol, checksum: bool, policy: Policy) -> float:  # noqa: FBT001
    """Return the time from one request to the next on a silent line, as the host takes it."""
    place = Place(line, _FACTORY_ADDRESS, protocol, checksum=checksum)
    bus: Bus[Response] = Bus[Response](line=line, policy=policy)
    now = 0.0
    sent: list[float] = []
    bus = send(bus, place.question, place.profile, now)
    ended = False
    while not ended:
        now = _due(bus)
        bus, events = receive(bus, b"", now)
        ended = any(isinstance(event, Ended) for event in events)
        sent += [now for event in events if isinstance(event, Transmit)]
    return _due(send(bus, place.question, place.profile, now)) - sent[0]


def _due(bus: Bus[Response]) -> float:
    """Return the deadline of a line with an open request, which has one."""
    return cast(float, next_deadline(bus))
