"""What text on the line can do to modules, by the worst reading of a lenient firmware (DCON, manual 2).

A lenient firmware ignores case and bit 7, and drops control characters and blanks. It begins at any leading character,
and does not wait for the carriage return. It takes ``**`` for every address. It accepts a command with or without a
checksum, and with too few or too many characters.

Laws: the syntaxes of the command classes define the commands; only their first characters count. Text that no command
begins with is harmless. Two hex digits after a command that reads are its checksum. If the command that sets the same
setting accepts the first of them as a value, they must be the right checksum, and the setting must not be able to lose
the module.
"""

import re
from functools import cache

from i7000 import dcon
from i7000.conformance.hazard import Hazard, hazard_of
from i7000.dcon.codec import AnyCommand
from i7000.dcon.layout import pieces_of
from i7000.frozen import frozen

__all__ = ["DROPPED", "HEARD_AS", "hazards_in_text"]

_HARMLESS = frozenset({Hazard.OBSERVE})
HEARD_AS = bytes(range(0x80)).upper() * 2
"""The translation of bytes to what a firmware hears that ignores case and bit 7."""
DROPPED = bytes((*range(0x0D), *range(0x0E, 0x21), 0x7F))
"""The bytes that a firmware drops that takes printable characters only, without the carriage return."""
_START = re.compile(rb"(?=([%#$~@])([0-9A-F]{2}|\*\*)([^%#$~@]*))", re.DOTALL)
_HEX_DIGITS = frozenset(b"0123456789ABCDEF")
_DIGITS_OF_VALUES = frozenset(b"012")
"""The hex digits that settings of one character accept."""
_SHORTEST_CONFIGURATION = 2
"""The characters after the address with which ``%`` is dangerous before its carriage return: a new address."""


@frozen
class Group:
    """The commands with one leading character and one character after the address."""

    read: bytes | None
    """The text of the command that reads, if there is one."""
    beyond: frozenset[Hazard]
    """The hazards of the commands that have the text of `read` and more."""
    others: frozenset[Hazard]
    """The hazards of all other commands."""


def _text_of(command: type[AnyCommand]) -> bytes:
    """Return the letters after the address of a command."""
    literals = [piece for name, piece in pieces_of(command) if not name]
    return "".join(map(str, literals[1:2])).encode()


@cache
def _groups() -> dict[bytes, Group]:
    """Return the groups by leading character and first character."""
    found: dict[bytes, list[type[AnyCommand]]] = {}
    for command in dcon.COMMANDS:
        if not issubclass(command, dcon.Broadcast):
            found.setdefault(command.syntax[:1].encode() + _text_of(command)[:1], []).append(command)
    return {key: _group(commands) for key, commands in found.items()}


def _group(commands: list[type[AnyCommand]]) -> Group:
    hazards = {command: hazard_of(command) for command in commands}
    read = next((_text_of(command) for command, hazard in hazards.items() if hazard is Hazard.OBSERVE), None)
    changing = {command: hazard for command, hazard in hazards.items() if hazard is not Hazard.OBSERVE}
    beyond = frozenset(hazard for command, hazard in changing.items() if _text_of(command) == read)
    others = frozenset(hazard for command, hazard in changing.items() if _text_of(command) != read)
    return Group(read, beyond or _HARMLESS, others or _HARMLESS)


def hazards_in_text(text: bytes) -> frozenset[Hazard]:
    r"""Return the hazards of all commands in a text, whose last line may be unfinished.

    Shape: `text` is translated by `HEARD_AS`.

    >>> sorted(hazard.value for hazard in hazards_in_text(b"$01M\r$010"))
    ['calibration', 'observe']
    """
    found = _HARMLESS
    *finished, rest = text.split(b"\r")
    for line in finished:
        found |= _hazards_of_line(line, finished=True)
    return found | _hazards_of_line(rest, finished=False)


def _hazards_of_line(line: bytes, *, finished: bool) -> frozenset[Hazard]:
    found = _HARMLESS
    for heard in dict.fromkeys((line, line.translate(None, DROPPED))):
        for start in _START.finditer(heard):
            lead, address, rest = start.groups()
            ended = finished and start.end(3) == len(heard)
            found |= _hazards_of_command(lead, address, rest, finished=ended)
    return found


def _hazards_of_command(lead: bytes, address: bytes, rest: bytes, *, finished: bool) -> frozenset[Hazard]:
    found = frozenset({Hazard.BROADCAST}) if address == b"**" else _HARMLESS
    if lead == b"%":
        complete = finished or (len(rest) >= _SHORTEST_CONFIGURATION and _HEX_DIGITS.issuperset(rest[:2]))
        return found | _groups()[lead].others if complete else found
    group = _groups().get(lead + rest[:1]) if rest else None
    if group is None:
        return found
    if group.read is None:
        return found | group.others
    if not rest.startswith(group.read):
        unfinished = not finished and group.read.startswith(rest)
        return found if unfinished else found | group.others
    tail = rest[len(group.read) :]
    if not tail or _is_checksum(lead + address + group.read, tail, group, finished=finished):
        return found
    return found | group.beyond


def _is_checksum(body: bytes, tail: bytes, group: Group, *, finished: bool) -> bool:
    """Return whether what follows a command that reads is a checksum, or the first digit of one to come."""
    if not _HEX_DIGITS.issuperset(tail) or len(tail) > 2 or (finished and len(tail) < 2):
        return False
    if tail[0] not in _DIGITS_OF_VALUES:
        return True
    return tail == b"%02X" % dcon.checksum(body) and group.beyond.isdisjoint({Hazard.COMM, Hazard.CALIBRATION})
