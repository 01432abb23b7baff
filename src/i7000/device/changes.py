"""The changes that both protocols make to a module.

Laws: each protocol checks its changes; the functions here make them.
"""

from collections.abc import Iterable

from i7000.device.signals import Signals
from i7000.device.state import State
from i7000.settings import CjcUpdate, LineSettings, Protocol
from i7000.type_codes import MIXED, TypeCode

__all__ = [
    "enable_channels",
    "set_address",
    "set_cjc_update",
    "set_host_watchdog",
    "set_line",
    "set_types",
    "type_code",
]


def type_code(state: State) -> int:
    """Return the type of all channels, or `MIXED` if they differ; also for models that ignore TT (E81).

    Manual: 2.10.
    """
    types = set(state.profile.type_codes)
    return types.pop() if len(types) == 1 else MIXED


def set_types(state: State, code: TypeCode, channels: Iterable[int] | None = None) -> State:
    """Set the type of some channels, or of all; models whose channels cannot differ set all."""
    types = list(state.eeprom.type_codes)
    if channels is None or not state.profile.individually_configurable:
        return state.store(type_codes=(code,) * len(types))
    for channel in channels:
        types[channel] = code
    return state.store(type_codes=tuple(types))


def set_address(state: State, address: int) -> State:
    """Set the address: at once, except in INIT mode, where it stays 00 until the next power-on.

    Manual: 2.1, 3.3.2; E90 (at once by Modbus too: assumption), E101.
    """
    stored = state.store(address=address)
    return stored if state.ram.init_mode else stored.keep(address=address)


def set_line(state: State, line: LineSettings, protocol: Protocol) -> State:
    """Store the line settings and protocol of the next power-on, as Modbus does without the INIT switch.

    Manual: 3.3.4, 3.4; E91 (by register as by function 46h: assumption).
    """
    return state.store(line_settings=line, protocol=protocol)


def enable_channels(state: State, mask: int, among: int) -> State:
    """Switch the channels `among` on or off; leave the others unchanged."""
    return state.store(channel_mask=state.eeprom.channel_mask & ~among | mask)


def set_host_watchdog(state: State, now: float, *, enabled: bool, timeout: int) -> State:
    """Switch the host watchdog and set its timeout, in tenths of a second; the timeout restarts now."""
    return state.store(host_watchdog_enabled=enabled, host_watchdog_timeout=timeout).keep(fed_at=now)


def set_cjc_update(state: State, update: CjcUpdate, signals: Signals) -> State:
    """Start or stop the update of the cold-junction temperature, or update it once.

    Special: the temperature at the stop, or at the single update, stays; another stop changes nothing.
    Manual: 2.21; E115.
    """
    held = state.ram.held_cold_junction
    if update is CjcUpdate.STARTED:
        held = None
    elif held is None or update is CjcUpdate.ONCE:
        held = signals.cold_junction
    return state.keep(cjc_update=update, held_cold_junction=held)
