"""The identity of a module of unknown model and settings, by either protocol.

Laws: a procedure of this module never writes and never sends a broadcast, and leaves the line settings alone. It ends
on every line, after a bounded number of requests.
"""

from collections.abc import Callable, Iterable, Mapping

from i7000 import dcon, modbus
from i7000.arguments import as_tuple, check_int, check_type
from i7000.errors import EncodeError
from i7000.host.bus import Policy
from i7000.host.events import TimedOut
from i7000.host.procedures.asking import unlearned
from i7000.host.procedures.identified import Identified, Unknown
from i7000.host.procedures.identify_dcon import identify_by_dcon
from i7000.host.procedures.identify_modbus import identify_by_modbus
from i7000.host.procedures.step import Procedure, ask
from i7000.message import Query, Response
from i7000.modbus.request import LAST_ADDRESS
from i7000.models import Model
from i7000.profile import Profile
from i7000.settings import Protocol

__all__ = ["identify"]

_MODBUS = range(1, LAST_ADDRESS + 1)
"""The addresses of Modbus."""
_QUICK = Policy(retries=0, turnaround=0.2, grace=0.2)
"""The policy with which every protocol and checksum setting is tried first, since most of them are in vain."""
_QUESTIONS: Mapping[Protocol, tuple[Callable[[int], Query[Response]], ...]] = {
    Protocol.DCON: (dcon.ReadConfiguration, dcon.ReadModuleName),
    Protocol.MODBUS_RTU: (modbus.ReadModuleName, lambda address: modbus.ReadInputRegisters(address, 0, 1)),
}
"""What every module answers: in DCON a second one in case the configuration is unreadable, in Modbus what other devices
answer too.
"""
_PLAIN = {
    (protocol, checksum): Profile(model, type_codes=(), checksum=checksum)
    for protocol, model in ((Protocol.DCON, Model.I_7017), (Protocol.MODBUS_RTU, Model.M_7017))
    for checksum in (False, True)
}
"""Profiles for what every module answers."""


def identify(
    address: int,
    *,
    protocols: Iterable[Protocol] = (Protocol.DCON, Protocol.MODBUS_RTU),
    checksum: bool | None = None,
    policy: Policy | None = None,
) -> Procedure[Identified]:
    """Make the procedure that identifies the module at an address, with the line settings of the host.

    Shape: `protocols` are tried in their order, until something answers; Modbus is not tried at an address that it does
        not have. `checksum` is the setting for DCON; None tries both. `policy` is that of every request; None means the
        policy of the line. Before that, each way is tried once with a short one; so is what only some models answer, if
        the module answered to the short one.
    Special: the firmware of a module does not say whether it is an I- or an M-model. By DCON, an I-model may not answer
        what only M-models have, so that both remain candidates. Without a checksum, a
        damaged answer can look like another one; `confirmed` asks everything twice.
    Errors: `EncodeError` for an address that none of the protocols has.
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
    checksums = (False, True) if checksum is None else (checksum,)
    ways = [(it, sealed) for it in tried for sealed in (checksums if it is Protocol.DCON else (False,))]
    ways = [way for way in ways if way[0] is Protocol.DCON or address in _MODBUS]
    if not ways:
        raise EncodeError("address", address, f"1..{LAST_ADDRESS} by Modbus, and at least one protocol", "3")
    return _identify(address, tuple(ways), policy)


def _identify(address: int, ways: tuple[tuple[Protocol, bool], ...], policy: Policy | None) -> Procedure[Identified]:
    unheard: list[Unknown] = []
    for contact in (_QUICK, policy):
        unheard.clear()
        for protocol, checksum in ways:
            profile = _PLAIN[protocol, checksum]
            silent = yield from _contact(protocol, address, profile, contact)
            if silent is None and protocol is Protocol.DCON:
                return (yield from identify_by_dcon(address, profile, policy, contact))
            if silent is None:
                return (yield from identify_by_modbus(address, policy))
            unheard.append(silent)
    return Identified(address, unknown=tuple(unheard))


def _contact(protocol: Protocol, address: int, profile: Profile, policy: Policy | None) -> Procedure[Unknown | None]:
    """Make the procedure that returns None if the module answers or refuses a question, else what is unknown."""
    first, second = _QUESTIONS[protocol]
    result = yield from ask(first(address), profile, policy)
    silent = isinstance(result.outcome, TimedOut)
    if silent and (result.others or protocol is Protocol.MODBUS_RTU):
        result = yield from ask(second(address), profile, policy)
        silent = isinstance(result.outcome, TimedOut)
    return unlearned("protocol", result, profile) if silent else None
