"""The host watchdog: a module that hears no host for too long remembers it (manual 2.35 to 2.39, A.2)."""

from typing import Annotated

from attrs import field

from i7000.dcon import parts
from i7000.dcon.command import Acknowledged, Broadcast, Command, Response
from i7000.message import frozen

__all__ = [
    "HostOk",
    "HostWatchdogStatus",
    "HostWatchdogTimeout",
    "ReadHostWatchdogStatus",
    "ReadHostWatchdogTimeout",
    "ResetHostWatchdogStatus",
    "SetHostWatchdogTimeout",
]


@frozen
class HostOk(Broadcast):
    """A broadcast that restarts the host watchdog of all modules.

    Wire: ``~**``, no response
    Time: 2 ms before the next command.
    Manual: 2.35, A.2.
    """

    syntax = "~**"
    section = "2.35"
    title = "host OK broadcast"


def _status(status: int) -> str:
    message = HostWatchdogStatus(0, status)
    enabled = "enabled" if message.enabled else "disabled"
    return f"{status:02X}, {enabled}, {'timed out' if message.timed_out else 'not timed out'}"


@frozen
class HostWatchdogStatus(Response):
    """The host watchdog status: on or off, and timed out or not.

    Wire: ``!AASS``
    Shape: bit 7 of `status` is `enabled`, bit 2 `timed_out`; the others are kept as sent.
    Manual: 2.36, A.2; E30, E31.
    """

    syntax = "!AASS"
    section = "2.36"
    title = "host watchdog status"

    address: parts.Address
    status: Annotated[int, parts.byte("SS", _status)]

    @property
    def enabled(self) -> bool:
        """Whether the watchdog is on."""
        return bool(self.status & 0x80)

    @property
    def timed_out(self) -> bool:
        """Whether it has timed out since the last reset."""
        return bool(self.status & 0x04)


class ReadHostWatchdogStatus(Command[HostWatchdogStatus]):
    """A command to read whether the host watchdog is on, and whether it has timed out.

    Wire: ``~AA0`` -> ``!AASS``
    Manual: 2.36; E30, E31.
    """

    syntax = "~AA0"
    section = "2.36"
    title = "host watchdog status"


class ResetHostWatchdogStatus(Command[Acknowledged]):
    """A command to reset the host watchdog status: the module forgets the timeout.

    Wire: ``~AA1`` -> ``!AA``
    Manual: 2.37; E30.
    """

    syntax = "~AA1"
    section = "2.37"
    title = "host watchdog status"


@frozen
class HostWatchdogTimeout(Response):
    """The host watchdog settings: on or off, and the timeout.

    Wire: ``!AAEVV``
    Unit: `timeout` in tenths of a second.
    Manual: 2.38; E5.
    """

    syntax = "!AAEVV"
    section = "2.38"
    title = "host watchdog timeout"

    address: parts.Address
    enabled: parts.FlagE = field(kw_only=True)
    timeout: parts.Tenths


class ReadHostWatchdogTimeout(Command[HostWatchdogTimeout]):
    """A command to read whether the host watchdog is on, and its timeout.

    Wire: ``~AA2`` -> ``!AAEVV``
    Manual: 2.38; E5.
    """

    syntax = "~AA2"
    section = "2.38"
    title = "host watchdog timeout"


@frozen
class SetHostWatchdogTimeout(Command[Acknowledged]):
    """A command to switch the host watchdog on or off and to set its timeout.

    Wire: ``~AA3EVV`` -> ``!AA``
    Unit: `timeout` in tenths of a second; 0 with the watchdog on is not documented.
    Manual: 2.39; E5, E100.
    """

    syntax = "~AA3EVV"
    section = "2.39"
    title = "host watchdog timeout"

    enabled: parts.FlagE = field(kw_only=True)
    timeout: parts.Tenths


COMMANDS = (
    HostOk,
    ReadHostWatchdogStatus,
    ResetHostWatchdogStatus,
    ReadHostWatchdogTimeout,
    SetHostWatchdogTimeout,
)
"""The commands of this module, by section."""
