"""The configuration of a module: all its settings, and the type of each channel (manual 2.1, 2.10, 2.15, 2.16).

Laws: to change one setting, read the configuration, change it and write it back (`Configuration.command`); the other
settings stay as they are.
"""

from typing import Any

from attrs import evolve

from i7000.availability import Availability
from i7000.dcon import parts
from i7000.dcon.command import Acknowledged, Command, Response
from i7000.message import frozen
from i7000.profile import Profile
from i7000.type_codes import MIXED

__all__ = [
    "ChannelTypeCode",
    "Configuration",
    "ReadChannelTypeCode",
    "ReadConfiguration",
    "SetChannelTypeCode",
    "SetConfiguration",
]


@frozen
class SetConfiguration(Command[Acknowledged]):
    """A command to set the address, the type of all channels, the line settings and the report settings.

    Wire: ``%AANNTTCCFF`` -> ``!NN``
    Special: `type_code` is `MIXED` where the channels have different types; modules whose channels are set one by one
        ignore it. The baud rate and the checksum can only be changed in INIT mode, or after `SoftInit` on models that
        have it. A module refuses from its old address.
    Time: the address, type, format and filter change at once. The baud rate and the checksum change at the next
        power-on; after `SoftInit`, right after the response.
    Errors: `EncodeError` for what the model or its firmware does not have.
    Manual: 2.1, 1.11; E16, E17, E20, E81, E89, E101.
    """

    syntax = "%AANNTTCCFF"
    section = "2.1"
    title = "module configuration"

    new_address: parts.NewAddress
    type_code: parts.NewTypeCode
    line_settings: parts.Line
    report_settings: parts.Report

    @property
    def answering_address(self) -> int:
        """The new address: the module answers from it (E16)."""
        return self.new_address

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for what the model or its firmware does not have."""
        mixed = self.type_code == MIXED and profile.individually_configurable
        if profile.model.type_by_configuration and not mixed:
            profile.check_type_code(self.type_code, self.section)
        profile.check_line(self.line_settings, "1.11")
        profile.check_report(self.report_settings, "1.11")


@frozen
class Configuration(Response):
    """The configuration of a module.

    Wire: ``!AATTCCFF``
    Special: `type_code` is `MIXED` where the channels have different types, and has no meaning for modules whose
        channels are set one by one. In INIT mode the address is the stored one (assumption).
    Manual: 2.10, 1.11; E4, E18, E81.
    """

    syntax = "!AATTCCFF"
    section = "2.10"
    title = "module configuration"

    address: parts.Address
    type_code: parts.NewTypeCode
    line_settings: parts.Line
    report_settings: parts.Report

    def command(self, **changes: Any) -> SetConfiguration:  # noqa: ANN401 - checked by the constructor
        """Return the command that writes this configuration back, with `changes` to the fields of `SetConfiguration`.

        >>> from i7000.settings import LineSettings, ReportSettings
        >>> configuration = Configuration(0x01, 0x05, LineSettings(), ReportSettings())
        >>> configuration.command(new_address=0x02).new_address
        2
        """
        command = SetConfiguration(self.address, self.address, self.type_code, self.line_settings, self.report_settings)
        return evolve(command, **changes)


class ReadConfiguration(Command[Configuration]):
    """A command to read the configuration of a module.

    Wire: ``$AA2`` -> ``!AATTCCFF``
    Special: in INIT mode, address the module as 00; it answers with its stored address (assumption).
    Manual: 2.10; E4, E18.
    """

    syntax = "$AA2"
    section = "2.10"
    title = "module configuration"


@frozen
class SetChannelTypeCode(Command[Acknowledged]):
    """A command to set the type of one channel.

    Wire: ``$AA7CiRrr`` -> ``!AA``
    Shape: the channel has one hex digit, in single-ended mode two.
    Models: those with individually configurable channels.
    Errors: `EncodeError` for a channel or type that the module does not have.
    Manual: 2.15; E22, E23.
    """

    syntax = "$AA7CiRrr"
    section = "2.15"
    title = "type code of a channel"
    availability = Availability.CONFIGURABLE

    channel: parts.ChannelI
    type_code: parts.ChannelTypeCode

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for a channel or a type that the module does not have."""
        profile.check_channel(self.channel, self.section)
        profile.check_type_code(self.type_code, self.section)


@frozen
class ChannelTypeCode(Response):
    """The type of one channel.

    Wire: ``!AACiRrr``
    Manual: 2.16; E22.
    """

    syntax = "!AACiRrr"
    section = "2.16"
    title = "type code of a channel"

    address: parts.Address
    channel: parts.ChannelI
    type_code: parts.ChannelTypeCode


@frozen
class ReadChannelTypeCode(Command[ChannelTypeCode]):
    """A command to read the type of one channel.

    Wire: ``$AA8Ci`` -> ``!AACiRrr``
    Shape: the channel has one hex digit, in single-ended mode two.
    Models: those with individually configurable channels.
    Errors: `EncodeError` for a channel that the module does not have.
    Manual: 2.16; E22.
    """

    syntax = "$AA8Ci"
    section = "2.16"
    title = "type code of a channel"
    availability = Availability.CONFIGURABLE

    channel: parts.ChannelI

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for a channel that the module does not have."""
        profile.check_channel(self.channel, self.section)


COMMANDS = (
    SetConfiguration,
    ReadConfiguration,
    SetChannelTypeCode,
    ReadChannelTypeCode,
)
"""The commands of this module, by section."""
