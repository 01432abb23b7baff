"""The identity of a module, its protocol, and the soft INIT that unlocks its line settings.

Manual 2.23, 2.24, 2.25, 2.26, 2.32, 2.33, 2.34.
"""

from attrs import field

from i7000.availability import Availability
from i7000.dcon import parts
from i7000.dcon.command import Acknowledged, Command, Response
from i7000.errors import EncodeError
from i7000.message import frozen
from i7000.profile import Profile

__all__ = [
    "FirmwareVersion",
    "ModuleName",
    "ProtocolSetting",
    "ReadFirmwareVersion",
    "ReadModuleName",
    "ReadProtocol",
    "SetModuleName",
    "SetProtocol",
    "SetSoftInitTimeout",
    "SoftInit",
]

LONGEST_TIMEOUT = 60
"""The longest soft INIT timeout, in seconds (2.34)."""


@frozen
class FirmwareVersion(Response):
    """The firmware version.

    Wire: ``!AA(Data)``
    Shape: `version` as sent: a letter, a digit, a point, one or two digits, such as ``A2.0``; compare versions as
        `i7000.Firmware`.
    Manual: 2.23; E67, E122.
    """

    syntax = "!AA(Data)"
    section = "2.23"
    title = "firmware version"

    address: parts.Address
    version: parts.Version


class ReadFirmwareVersion(Command[FirmwareVersion]):
    """A command to read the firmware version.

    Wire: ``$AAF`` -> ``!AA(Data)``
    Manual: 2.23.
    """

    syntax = "$AAF"
    section = "2.23"
    title = "firmware version"


@frozen
class ModuleName(Response):
    """The name of the module.

    Wire: ``!AA(Name)``
    Shape: 1 to 6 characters, printable ASCII without the leading characters of messages, and not the text of another
        response, such as ``0506`` or ``A2.0`` (assumption).
    Manual: 2.24; E6, E102, E122.
    """

    syntax = "!AA(Name)"
    section = "2.24"
    title = "module name"

    address: parts.Address
    name: parts.Name


class ReadModuleName(Command[ModuleName]):
    """A command to read the name of the module.

    Wire: ``$AAM`` -> ``!AA(Name)``
    Manual: 2.24; E6.
    """

    syntax = "$AAM"
    section = "2.24"
    title = "module name"


@frozen
class SetModuleName(Command[Acknowledged]):
    """A command to set the name of the module.

    Wire: ``~AAO(Name)`` -> ``!AA``
    Shape: 1 to 6 characters, printable ASCII without the leading characters of messages (assumption).
    Errors: `EncodeError` for a name that could not be read back: the text of another response (assumption).
    Manual: 2.33; E102, E122.
    """

    syntax = "~AAO(Name)"
    section = "2.33"
    title = "module name"

    name: parts.NewName

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for a name that is the text of another response."""
        profile.check_name(self.name, self.section)


@frozen
class ProtocolSetting(Response):
    """The supported protocols, and the protocol after the next power-on.

    Wire: ``!AASC``
    Manual: 2.25; E92.
    """

    syntax = "!AASC"
    section = "2.25"
    title = "protocol"

    address: parts.Address
    modbus_supported: parts.FlagS = field(kw_only=True)
    """True on every module that has the command (E92)."""
    protocol: parts.ProtocolC


class ReadProtocol(Command[ProtocolSetting]):
    """A command to read the supported protocols, and the protocol after the next power-on.

    Wire: ``$AAP`` -> ``!AASC``
    Models: M-7000 series.
    Manual: 2.25; E92.
    """

    syntax = "$AAP"
    section = "2.25"
    title = "protocol"
    availability = Availability.M_SERIES


@frozen
class SetProtocol(Command[Acknowledged]):
    """A command to set the protocol after the next power-on; modules refuse it outside INIT mode.

    Wire: ``$AAPN`` -> ``!AA``
    Models: M-7000 series.
    Manual: 2.26, 1.12.1; E17, E91.
    """

    syntax = "$AAPN"
    section = "2.26"
    title = "protocol"
    availability = Availability.M_SERIES

    protocol: parts.ProtocolN


class SoftInit(Command[Acknowledged]):
    """A command to allow changes of the baud rate and the checksum by the next command, until the timeout.

    Wire: ``~AAI`` -> ``!AA``
    Special: send `SetSoftInitTimeout` first: the timeout is 0 after power-on.
    Models: M-7017mC-16 and 7019 series.
    Manual: 2.32; E20, E32, E107.
    """

    syntax = "~AAI"
    section = "2.32"
    title = "soft INIT"
    availability = Availability.SOFT_INIT


@frozen
class SetSoftInitTimeout(Command[Acknowledged]):
    """A command to set how long `SoftInit` lasts; 0 forbids changes by software.

    Wire: ``~AATnn`` -> ``!AA``
    Unit: seconds.
    Range: 0 to 60 (3Ch).
    Models: M-7017mC-16 and 7019 series.
    Errors: `EncodeError` for a longer timeout.
    Manual: 2.34; E20, E32.
    """

    syntax = "~AATnn"
    section = "2.34"
    title = "soft INIT timeout"
    availability = Availability.SOFT_INIT

    timeout: parts.Seconds

    def check(self, profile: Profile) -> None:  # noqa: ARG002 - the limit is the same for all
        """Raise `EncodeError` for a longer timeout."""
        if self.timeout > LONGEST_TIMEOUT:
            raise EncodeError("timeout", self.timeout, f"0..{LONGEST_TIMEOUT} s", self.section)


COMMANDS = (
    ReadFirmwareVersion,
    ReadModuleName,
    ReadProtocol,
    SetProtocol,
    SoftInit,
    SetModuleName,
    SetSoftInitTimeout,
)
"""The commands of this module, by section."""
