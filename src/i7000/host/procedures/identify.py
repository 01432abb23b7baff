"""The identity of a module of unknown model and settings, by either protocol.

Laws: a procedure of this module never writes and never sends a broadcast, and leaves the line settings alone. It ends
on every line, after a bounded number of requests.
"""

from collections.abc import Iterable

from i7000.arguments import as_tuple, check_int, check_type
from i7000.errors import EncodeError
from i7000.host.bus import Policy
from i7000.host.procedures.identified import Identified, Unknown
from i7000.host.procedures.identify_dcon import identify_by_dcon
from i7000.host.procedures.identify_modbus import identify_by_modbus
from i7000.host.procedures.step import Procedure
from i7000.settings import Protocol

__all__ = ["identify"]

_MODBUS_ADDRESSES = range(1, 248)


def identify(
    address: int,
    *,
    protocols: Iterable[Protocol] = (Protocol.DCON, Protocol.MODBUS_RTU),
    checksum: bool | None = None,
    policy: Policy | None = None,
) -> Procedure[Identified]:
    """Make the procedure that identifies the module at an address, with the line settings of the host.

    Shape: `protocols` are tried in their order, until something answers; an address that Modbus does not have is tried
        by DCON only. `checksum` is the setting for DCON; None tries both. `policy` is that of every request; None means
        the policy of the line.
    Special: the firmware of a module does not say whether it is an I- or an M-model. By DCON, an I-model may not answer
        what only M-models have, so that both remain candidates. Without a checksum, a flipped bit can change an answer.
    Errors: `EncodeError` for an address beyond 00..FF.
    Manual: 1.12, 2, 3; E75, E77, E81.

    >>> next(identify(0x01)).command
    ReadConfiguration(address=0x01)
    """
    check_int("address", address)
    if not 0 <= address <= 0xFF:
        raise EncodeError("address", address, "00..FF", "2")
    tried = as_tuple("protocols", protocols)
    for protocol in tried:
        check_type("protocols", protocol, Protocol)
    check_type("checksum", checksum, bool, optional=True)
    check_type("policy", policy, Policy, optional=True)
    return _identify(address, tried, (False, True) if checksum is None else (checksum,), policy)


def _identify(
    address: int, protocols: tuple[Protocol, ...], checksums: tuple[bool, ...], policy: Policy | None
) -> Procedure[Identified]:
    unheard: tuple[Unknown, ...] = ()
    for protocol in protocols:
        if protocol is Protocol.DCON:
            found = yield from identify_by_dcon(address, checksums, policy)
        elif address in _MODBUS_ADDRESSES:
            found = yield from identify_by_modbus(address, policy)
        else:
            found = Identified(address, unknown=(Unknown("protocol", f"Modbus has no address {address}: 1..247"),))
        if found.protocol is not None:
            return found
        unheard += found.unknown
    return Identified(address, unknown=unheard)
