"""Whose frame it is: the side of the line that a frame came from, as far as its form, its turn and the times show.

Laws: echoes and noise have no side. What is damaged belongs to the side whose turn it is, if it is like a frame of it.
"""

from typing import Any

from i7000 import modbus
from i7000.conformance.judge_frames import resembles
from i7000.conformance.judge_rules import Side
from i7000.conformance.judge_state import Judge
from i7000.dissect import Direction, Heard
from i7000.dissect.dcon import LEADS
from i7000.dissect.timing import Times
from i7000.settings import Protocol

__all__ = ["LUMP", "side_of", "since_of"]

LUMP = 0.02
"""The seconds that adapters can hold bytes back, and that an echo can take."""
_RTU = Protocol.MODBUS_RTU


def side_of(state: Judge, heard: Heard, times: Times | None, sent: bool | None) -> Side | None:  # noqa: FBT001
    """Return the side that a frame came from; None for noise, echoes, and the answers that a host sends itself."""
    if heard.error is None and heard.same_as is not None:
        return None if _is_echo(state, heard, times) else Side.DRIVER
    if heard.direction is Direction.RESPONSE:
        return None if sent else _module_or_noise(state, heard)
    if heard.direction is not None:
        return Side.MODULE if _is_wrong_echo(state, heard, times, sent) else Side.DRIVER
    return _side_of_damage(state, heard, times, sent)


def _is_echo(state: Judge, heard: Heard, times: Times | None) -> bool:
    """Return whether what is the same as the last command is its echo, and not the command again."""
    before = state.asked or state.answered
    since = None if before is None else since_of(before.times, times)
    if since is None:
        return heard.direction is Direction.ECHO and state.asked is not None
    return since <= LUMP + len(heard.wire) * (state.character_time or 0.0)


def _module_or_noise(state: Judge, heard: Heard) -> Side | None:
    """Return the module for a response, and for text in its place; None for other noise."""
    asked = state.asked
    if heard.protocol is Protocol.DCON and heard.wire[:1] not in LEADS:
        meant = asked is not None and asked.protocol is Protocol.DCON and len(heard.wire) >= len("!AA\r")
        return Side.MODULE if meant and heard.wire.endswith(b"\r") else None
    return Side.MODULE


_ECHO = len("afssvvcc")
"""Bytes of every answer to a write."""


def _is_wrong_echo(state: Judge, heard: Heard, times: Times | None, sent: bool | None) -> bool:  # noqa: FBT001
    """Return whether what reads as a request is an answer that does not repeat its request."""
    asked = state.asked
    if sent or asked is None or heard.protocol is not _RTU or asked.wire[:2] != heard.wire[:2]:
        return False
    if len(heard.wire) != _ECHO:
        return False
    since = since_of(asked.times, times)
    message: Any = heard.meanings[0].message
    return message.broadcast and since is not None and since <= state.bound


def _side_of_damage(state: Judge, heard: Heard, times: Times | None, sent: bool | None) -> Side | None:  # noqa: FBT001
    """Return the side that a damaged Modbus frame came from: the one whose turn it is."""
    asked = state.asked
    since = since_of(state.last, times)
    fragment = state.damaged and since is not None and since < LUMP
    if len(heard.wire) < modbus.SHORTEST_FRAME or fragment:
        return None
    since = None if asked is None else since_of(asked.times, times)
    turn = asked is not None and not (since is not None and since > state.bound)
    if sent is not None:
        turn = not sent
    if turn:
        meant = asked is not None and asked.protocol is _RTU and resembles(heard.wire, asked.wire)
        return Side.MODULE if meant else None
    return Side.DRIVER if resembles(heard.wire, None) else None


def since_of(earlier: Times | None, times: Times | None) -> float | None:
    """Return the seconds from the end of one frame to the beginning of another; None if the times cannot tell."""
    if earlier is None or times is None or times.began < earlier.ended:
        return None
    return times.began - earlier.ended
