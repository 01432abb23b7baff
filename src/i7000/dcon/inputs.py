"""The analog inputs: readings, channel mask, connecting mode and diagnostics.

Manual 2.3, 2.4, 2.13, 2.14, 2.19, 2.22, 2.42, 2.43.

Laws: a response keeps the field of each channel as it was sent, so channel 5 is always index 5. `i7000.dcon.readings`
decodes the fields.
"""

from attrs import field

from i7000.availability import Availability
from i7000.dcon import parts
from i7000.dcon.command import Acknowledged, Command, Message, Response
from i7000.errors import EncodeError
from i7000.fields import is_field
from i7000.message import frozen
from i7000.profile import Profile
from i7000.settings import DataFormat, channels_of, mask_of

__all__ = [
    "AnalogInput",
    "AnalogInputs",
    "AnalogInputsHex",
    "ChannelMask",
    "ConnectingMode",
    "Diagnostics",
    "ReadAnalogInput",
    "ReadAnalogInputs",
    "ReadAnalogInputsHex",
    "ReadChannelMask",
    "ReadConnectingMode",
    "ReadDiagnostics",
    "SetChannelMask",
    "SetConnectingMode",
    "channels_of",
    "mask_of",
]


def check_values(message: Message, values: tuple[str, ...], data_format: DataFormat, profile: Profile) -> None:
    """Raise `EncodeError` for fields that are not those of the module's channels."""
    legacy = profile.legacy_sentinels
    if len(values) != profile.channels or not all(is_field(value, data_format, legacy=legacy) for value in values):
        allowed = f"{profile.channels} {data_format.name.lower()} fields on {profile.model.value}"
        raise EncodeError("values", values, allowed, message.section)


@frozen
class AnalogInputs(Response):
    """The readings of all channels.

    Wire: ``>(Data)``
    Shape: one field for each channel, 7 characters in engineering units and percent, 4 in hex; blanks for a disabled
        channel.
    Manual: 2.3, 1.11; E24, E25, E49.
    """

    syntax = ">(Data)"
    section = "2.3"
    title = "readings of all channels"

    values: parts.Values

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for fields that are not those of the module's channels."""
        check_values(self, self.values, profile.data_format, profile)


class ReadAnalogInputs(Command[AnalogInputs]):
    """A command to read the readings of all channels.

    Wire: ``#AA`` -> ``>(Data)``
    Manual: 2.3; E24.
    """

    syntax = "#AA"
    section = "2.3"
    title = "readings of all channels"


@frozen
class AnalogInput(Response):
    """The reading of one channel.

    Wire: ``>(Data)``
    Shape: 7 characters in engineering units and percent, 4 in hex; blanks for a disabled channel.
    Manual: 2.4, 1.11; E24, E25, E49.
    """

    syntax = ">(Data)"
    section = "2.4"
    title = "reading of one channel"

    value: parts.Value

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for a field of another data format."""
        if not is_field(self.value, profile.data_format, legacy=profile.legacy_sentinels):
            raise EncodeError("value", self.value, f"one {profile.data_format.name.lower()} field", self.section)


@frozen
class ReadAnalogInput(Command[AnalogInput]):
    """A command to read the reading of one channel.

    Wire: ``#AAN`` -> ``>(Data)``
    Shape: the channel has one hex digit, in single-ended mode two.
    Errors: `EncodeError` for a channel that the module does not have.
    Manual: 2.4; E21, E24.
    """

    syntax = "#AAN"
    section = "2.4"
    title = "reading of one channel"

    channel: parts.ChannelN

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for a channel that the module does not have."""
        profile.check_channel(self.channel, self.section)


@frozen
class AnalogInputsHex(Response):
    """The readings of all channels in hex, whatever the data format of the module.

    Wire: ``>(Data)``
    Shape: 4 hex digits for each channel; blanks for a disabled channel are accepted.
    Manual: 2.19; E8, E24, E25.
    """

    syntax = ">(Data)"
    section = "2.19"
    title = "readings of all channels in hex"

    values: parts.HexValues

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for fields that are not those of the module's channels."""
        check_values(self, self.values, DataFormat.HEX, profile)


class ReadAnalogInputsHex(Command[AnalogInputsHex]):
    """A command to read the readings of all channels in hex.

    Wire: ``$AAA`` -> ``>(Data)``
    Models: 7017 series; the same characters are `ReadCjcUpdate` for the 7019 series.
    Manual: 2.19; E8, E34.
    """

    syntax = "$AAA"
    section = "2.19"
    title = "readings of all channels in hex"
    availability = Availability.SERIES_7017


@frozen
class SetChannelMask(Command[Acknowledged]):
    """A command to switch channels on and off.

    Wire: ``$AA5VV`` -> ``!AA``
    Shape: the mask has a bit for each channel, in 2, 4 or 6 hex digits by model; see `mask_of`.
    Errors: `EncodeError` for a channel that the module does not have.
    Manual: 2.13; E11, E12.
    """

    syntax = "$AA5VV"
    section = "2.13"
    title = "channel mask"

    mask: parts.Mask

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for channels that the module does not have."""
        profile.check_mask(self.mask, self.section)


@frozen
class ChannelMask(Response):
    """The mask of the channels that are on.

    Wire: ``!AAVV``
    Shape: a bit for each channel, in 2, 4 or 6 hex digits by model; see `channels_of`.
    Manual: 2.14; E11, E12.
    """

    syntax = "!AAVV"
    section = "2.14"
    title = "channel mask"

    address: parts.Address
    mask: parts.Mask

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for channels that the module does not have."""
        profile.check_mask(self.mask, self.section)


class ReadChannelMask(Command[ChannelMask]):
    """A command to read which channels are on.

    Wire: ``$AA6`` -> ``!AAVV``
    Manual: 2.14.
    """

    syntax = "$AA6"
    section = "2.14"
    title = "channel mask"


@frozen
class Diagnostics(Response):
    """The mask of the channels that are on and over range, under range or open.

    Wire: ``!AANN``
    Shape: a bit for each channel, in 2 hex digits; in 4 on the M-7019Z (assumption). See `channels_of`.
    Manual: 2.22; E13, E14.
    """

    syntax = "!AANN"
    section = "2.22"
    title = "channel diagnostics"

    address: parts.Address
    mask: parts.DiagnosticMask

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for channels that the module does not have."""
        profile.check_mask(self.mask, self.section)


class ReadDiagnostics(Command[Diagnostics]):
    """A command to read which channels are over range, under range or open.

    Wire: ``$AAB`` -> ``!AANN``
    Models: 7019 series.
    Manual: 2.22; E13, E14.
    """

    syntax = "$AAB"
    section = "2.22"
    title = "channel diagnostics"
    availability = Availability.SERIES_7019


@frozen
class ConnectingMode(Response):
    """The connecting mode of the inputs: single-ended or differential.

    Wire: ``!AAN``
    Manual: 2.42.
    """

    syntax = "!AAN"
    section = "2.42"
    title = "connecting mode"

    address: parts.Address
    single_ended: parts.FlagN = field(kw_only=True)


class ReadConnectingMode(Command[ConnectingMode]):
    """A command to read whether the inputs are single-ended.

    Wire: ``@AAS`` -> ``!AAN``
    Models: 7017Z.
    Manual: 2.42.
    """

    syntax = "@AAS"
    section = "2.42"
    title = "connecting mode"
    availability = Availability.SERIES_7017Z


@frozen
class SetConnectingMode(Command[Acknowledged]):
    """A command to make the inputs single-ended or differential.

    Wire: ``@AASN`` -> ``!AA``
    Models: 7017Z.
    Manual: 2.43; E3.
    """

    syntax = "@AASN"
    section = "2.43"
    title = "connecting mode"
    availability = Availability.SERIES_7017Z

    single_ended: parts.FlagN = field(kw_only=True)


COMMANDS = (
    ReadAnalogInputs,
    ReadAnalogInput,
    SetChannelMask,
    ReadChannelMask,
    ReadAnalogInputsHex,
    ReadDiagnostics,
    ReadConnectingMode,
    SetConnectingMode,
)
"""The commands of this module, by section."""
