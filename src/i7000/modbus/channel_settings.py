"""Function 46h, the channels: types, mask, filter and fast mode (manual 3.3.5, 3.3.6, 3.3.8 to 3.3.11).

Laws: reserved bytes are zero. A `result` of 0 means that a setting was made; other values are not documented (E90).
"""

from typing import Annotated

from i7000.availability import Availability
from i7000.errors import EncodeError
from i7000.message import frozen
from i7000.modbus import items
from i7000.modbus.request import Request, Response, SettingResult
from i7000.profile import Profile
from i7000.settings import Filter, channels_of, mask_of

__all__ = [
    "ChannelMask",
    "ChannelMaskResult",
    "MiscellaneousSettings",
    "MiscellaneousSettingsResult",
    "ReadChannelMask",
    "ReadMiscellaneousSettings",
    "ReadTypeCode",
    "SetChannelMask",
    "SetMiscellaneousSettings",
    "SetTypeCode",
    "TypeCodeResult",
    "TypeCodeSetting",
    "channels_of",
    "mask_of",
]

FILTER_BIT, FAST_MODE_BIT = 0x80, 0x20


def _check_channel(channel: int, profile: Profile, section: str) -> None:
    """Raise `EncodeError` for a channel that the module does not have, or cannot set individually."""
    if channel and not profile.individually_configurable:
        raise EncodeError("channel", channel, f"0, which means all channels, on {profile.model.value}", section)
    profile.check_channel(channel, section)


@frozen
class TypeCodeSetting(Response):
    """The type of a channel.

    Wire: ``46 07 type_code``
    Manual: 3.3.5; E60.
    """

    pdu = "46 07 type_code"
    section = "3.3.5"
    title = "type code"

    type_code: items.TypeCodeByte


@frozen
class ReadTypeCode(Request[TypeCodeSetting]):
    """A request to read the type of a channel; channel 0 if all channels have the same type.

    Wire: ``46 07 00 channel`` -> ``46 07 type_code``
    Errors: `EncodeError` for a channel that the module does not have.
    Manual: 3.3.5; E60.
    """

    pdu = "46 07 00 channel"
    section = "3.3.5"
    title = "type code"
    availability = Availability.M_SERIES

    channel: items.Byte

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for a channel that the module does not have."""
        _check_channel(self.channel, profile, self.section)


class TypeCodeResult(SettingResult):
    """The result of setting the type of a channel.

    Wire: ``46 08 result``
    Manual: 3.3.6; E60, E64.
    """

    pdu = "46 08 result"
    section = "3.3.6"
    title = "type code"


@frozen
class SetTypeCode(Request[TypeCodeResult]):
    """A request to set the type of a channel; channel 0 sets all channels if they have the same type.

    Wire: ``46 08 00 channel type_code`` -> ``46 08 result``
    Errors: `EncodeError` for a channel or type that the module does not have.
    Manual: 3.3.6; E60, E64.
    """

    pdu = "46 08 00 channel type_code"
    section = "3.3.6"
    title = "type code"
    availability = Availability.M_SERIES

    channel: items.Byte
    type_code: items.TypeCodeByte

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for a channel or type that the module does not have."""
        _check_channel(self.channel, profile, self.section)
        profile.check_type_code(self.type_code, self.section)


@frozen
class ChannelMask(Response):
    """The mask of the channels that are on.

    Wire: ``46 25 mask:mask``
    Shape: a bit for each channel, in 1, 2 or 3 bytes by model, high byte first (assumption).
    Manual: 3.3.8; E12, E61.
    """

    pdu = "46 25 mask:mask"
    section = "3.3.8"
    title = "channel mask"

    mask: items.Mask

    def reserved_bits(self, request: "ReadChannelMask", profile: Profile) -> int:  # noqa: ARG002 - of the module
        """Return the set bits that should be zero: those of channels that the module does not have."""
        return self.mask >> profile.channels

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for channels that the module does not have."""
        profile.check_mask(self.mask, self.section)


class ReadChannelMask(Request[ChannelMask]):
    """A request to read which channels are on.

    Wire: ``46 25`` -> ``46 25 mask:mask``
    Manual: 3.3.8; E12, E61.
    """

    pdu = "46 25"
    section = "3.3.8"
    title = "channel mask"
    availability = Availability.M_SERIES


class ChannelMaskResult(SettingResult):
    """The result of switching channels on and off.

    Wire: ``46 26 result``
    Manual: 3.3.9; E12, E61, E97.
    """

    pdu = "46 26 result"
    section = "3.3.9"
    title = "channel mask"


@frozen
class SetChannelMask(Request[ChannelMaskResult]):
    """A request to switch channels on and off.

    Wire: ``46 26 mask:mask`` -> ``46 26 result``
    Shape: a bit for each channel, in 1, 2 or 3 bytes by model, high byte first (assumption).
    Errors: `EncodeError` for a channel that the module does not have.
    Manual: 3.3.9; E12, E61, E97.
    """

    pdu = "46 26 mask:mask"
    section = "3.3.9"
    title = "channel mask"
    availability = Availability.M_SERIES

    mask: items.Mask

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for channels that the module does not have."""
        profile.check_mask(self.mask, self.section)


def _settings(settings: int) -> str:
    words = [f"{settings:02X}", f"{50 if settings & FILTER_BIT else 60} Hz rejected"]
    words.append("fast mode" if settings & FAST_MODE_BIT else "normal mode")
    reserved = settings & ~(FILTER_BIT | FAST_MODE_BIT)
    if reserved:
        words.append(f"reserved bits {reserved:02X}")
    return ", ".join(words)


_SettingsByte = Annotated[int, items.byte(_settings)]


@frozen
class MiscellaneousSettings(Response):
    """The filter and the fast mode.

    Wire: ``46 29 settings``
    Shape: bit 7 set rejects 50 Hz, else 60 Hz; bit 5 is fast mode; the others are zero.
    Manual: 3.3.10; E43, E88.
    """

    pdu = "46 29 settings"
    section = "3.3.10"
    title = "miscellaneous settings"

    settings: _SettingsByte

    @property
    def filter(self) -> Filter:
        """The mains frequency that is rejected."""
        return Filter(bool(self.settings & FILTER_BIT))

    @property
    def fast_mode(self) -> bool:
        """Whether the module is in fast mode."""
        return bool(self.settings & FAST_MODE_BIT)

    def reserved_bits(self, request: "ReadMiscellaneousSettings", profile: Profile) -> int:  # noqa: ARG002 - of none
        """Return the set bits that should be zero."""
        return self.settings & ~(FILTER_BIT | FAST_MODE_BIT)


class ReadMiscellaneousSettings(Request[MiscellaneousSettings]):
    """A request to read the filter and the fast mode.

    Wire: ``46 29`` -> ``46 29 settings``
    Manual: 3.3.10; E43, E88.
    """

    pdu = "46 29"
    section = "3.3.10"
    title = "miscellaneous settings"
    availability = Availability.M_SERIES


class MiscellaneousSettingsResult(SettingResult):
    """The result of setting the filter and the fast mode.

    Wire: ``46 2A result``
    Manual: 3.3.11; E43, E88.
    """

    pdu = "46 2A result"
    section = "3.3.11"
    title = "miscellaneous settings"


@frozen
class SetMiscellaneousSettings(Request[MiscellaneousSettingsResult]):
    """A request to set the filter and the fast mode.

    Wire: ``46 2A settings`` -> ``46 2A result``
    Shape: bit 7 set rejects 50 Hz, else 60 Hz; bit 5 is fast mode; the others are zero.
    Errors: `EncodeError` for a bit that the module does not have.
    Manual: 3.3.11; E43, E88.
    """

    pdu = "46 2A settings"
    section = "3.3.11"
    title = "miscellaneous settings"
    availability = Availability.M_SERIES

    settings: _SettingsByte

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for bits that the module does not have."""
        bits = FILTER_BIT * profile.has_filter | FAST_MODE_BIT * profile.model.fast_mode
        if self.settings & ~bits:
            raise EncodeError(
                "settings", f"{self.settings:02X}", f"only bits of {bits:02X}h on {profile.model.value}", self.section
            )


REQUESTS = (
    ReadTypeCode,
    SetTypeCode,
    ReadChannelMask,
    SetChannelMask,
    ReadMiscellaneousSettings,
    SetMiscellaneousSettings,
)
"""The requests of this module, by function and sub-function."""
