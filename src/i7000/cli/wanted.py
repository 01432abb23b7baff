"""The modules that a command asks: their addresses, what is given about them, and the protocols to try."""

from typing import Literal

from attrs import frozen

from i7000 import describe
from i7000.cli.options import Module, address_of
from i7000.cli.words import UsageError
from i7000.dissect import Known
from i7000.settings import Protocol

__all__ = ["ProtocolChoice", "Wanted", "wanted"]

_MODBUS_ADDRESSES = range(1, 248)
ProtocolChoice = Literal["auto", "dcon", "rtu"]
_PROTOCOLS = {
    "auto": (Protocol.DCON, Protocol.MODBUS_RTU),
    "dcon": (Protocol.DCON,),
    "rtu": (Protocol.MODBUS_RTU,),
}


@frozen
class Wanted:
    """A module to be asked: its address, what is given about it, and the protocols to try, in their order."""

    address: int
    given: Known
    protocols: tuple[Protocol, ...]

    @property
    def tried(self) -> tuple[tuple[Protocol, bool], ...]:
        """The protocols, each with the checksum settings that are tried."""
        checksums = (False, True) if self.given.checksum is None else (self.given.checksum,)
        return tuple(
            (protocol, checksum)
            for protocol in self.protocols
            for checksum in (checksums if protocol is Protocol.DCON else (False,))
        )


def wanted(addresses: tuple[str, ...], module: Module, protocol: ProtocolChoice) -> tuple[Wanted, ...]:
    """Return the modules to ask: those of --address, and those that have an address in --model.

    Errors: `UsageError`.
    """
    knowledge = module.knowledge(protocol)
    protocols = module.protocols()
    numbers = dict.fromkeys((*map(address_of, addresses), *knowledge.modules)) or {1: None}
    found = []
    for number in numbers:
        given = knowledge.of(number).given
        spoken = protocols.get(number, protocols.get(None))
        if spoken is not None and spoken not in _PROTOCOLS[protocol]:
            raise UsageError(f"--protocol {protocol}: --model says another protocol for address {number}")
        tried = _spoken(given, protocol) if spoken is None else (spoken,)
        tried = tuple(it for it in tried if it is Protocol.DCON or number in _MODBUS_ADDRESSES)
        if not tried:
            raise UsageError(f"address {describe.address(number)}: by Modbus, an address is 1..247")
        found.append(Wanted(number, given, tried))
    return tuple(found)


def _spoken(given: Known, protocol: ProtocolChoice) -> tuple[Protocol, ...]:
    """Return the protocols to try; modules that speak both have Modbus from the factory."""
    tried = _PROTOCOLS[protocol]
    if given.model is None:
        return tried
    return tuple(it for it in reversed(tried) if it in given.model.protocols)
