"""Frames of the protocol that a module does not use: noise to the module, and a hint for the user."""

from collections.abc import Sequence

from i7000 import dcon, modbus
from i7000.device import Heard, State
from i7000.errors import Noise
from i7000.profile import Profile
from i7000.settings import Protocol

__all__ = ["LONGEST", "deaf_module", "foreign_frames"]

LONGEST = max(dcon.LONGEST_FRAME, modbus.LONGEST_FRAME)
"""The longest frame of any protocol, in bytes."""


def foreign_frames(modules: Sequence[State], wire: bytes) -> tuple[Heard, ...]:
    """Return the complete frames of a protocol that no module uses, among bytes that no module understood."""
    found: list[Heard] = []
    for protocol in set(Protocol) - {module.ram.protocol for module in modules}:
        parts = dcon.split(wire)[0] if protocol is Protocol.DCON else modbus.flush(wire, modbus.Side.REQUESTS)
        found += [Heard(part, protocol) for part in parts if not isinstance(part, Noise)]
    return tuple(found)


def deaf_module(modules: Sequence[State], heard: Heard) -> Profile | None:
    """Return the profile of a module that cannot understand a frame because it uses the other protocol.

    Special: it is the module with the address of the frame, or else the first one if no module uses the protocol.
    """
    if heard.module is not None or isinstance(heard.frame, Noise):
        return None
    deaf = [module for module in modules if module.ram.protocol is not heard.protocol]
    asked = [module for module in deaf if _has_address(module, heard.frame, heard.protocol)]
    chosen = asked or (deaf if len(deaf) == len(modules) else [])
    return chosen[0].profile if chosen else None


def _has_address(module: State, frame: bytes, protocol: Protocol) -> bool:
    address = module.ram.address
    return frame[1:3] == b"%02X" % address if protocol is Protocol.DCON else frame[0] == address
