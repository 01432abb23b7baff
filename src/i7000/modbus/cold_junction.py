"""Function 46h, cold-junction compensation: offsets, switch, update (manual 3.3.12 to 3.3.17).

Laws: reserved bytes are zero. A `result` of 0 means that a setting was made; other values are not documented (E90).
"""

from typing import Annotated

from attrs import field

from i7000 import message
from i7000.arguments import check_type
from i7000.availability import Availability
from i7000.errors import EncodeError
from i7000.message import frozen
from i7000.modbus import items
from i7000.modbus.request import Message, Request, Response, SettingResult
from i7000.profile import Profile

__all__ = [
    "CjcEnabled",
    "CjcEnabledResult",
    "CjcOffset",
    "CjcOffsetResult",
    "CjcUpdateResult",
    "CjcUpdateSetting",
    "ReadCjcEnabled",
    "ReadCjcOffset",
    "ReadCjcUpdate",
    "SetCjcEnabled",
    "SetCjcOffset",
    "SetCjcUpdate",
]

FIRST_CHANNEL = 0x80
"""The number of channel 0 in `channel`, where 0 is the module."""


_LOW_BYTE = 0xFF


def offset_in_celsius(channel: int, offset: int) -> float:
    """Return an offset in degrees Celsius; `channel` is 0 for the module."""
    return ((offset & 0xFF) - ((offset & 0x80) << 1)) / 10 if channel else offset / 100


def check_offset_channel(sent: Message, channel: int, profile: Profile) -> None:
    """Raise `EncodeError` for a number that is neither the module nor one of its channels."""
    if channel and not 0 <= channel - FIRST_CHANNEL < profile.channels:
        allowed = f"00, 80..{FIRST_CHANNEL + profile.channels - 1:02X} on {profile.model.value}"
        raise EncodeError("channel", f"{channel:02X}", allowed, sent.section)


def _channel(channel: int) -> str:
    if not channel:
        return "00, the module"
    return f"{channel:02X}, " + (f"channel {channel - FIRST_CHANNEL}" if channel >= FIRST_CHANNEL else "not defined")


def _offset(channel: int, offset: int) -> str:
    return f"{offset_in_celsius(channel, offset):+.{1 if channel else 2}f} degC"


_OffsetChannel = Annotated[int, items.byte(_channel)]


@frozen
class CjcOffset(Response):
    """An offset of the cold-junction temperature.

    Wire: ``46 2B offset:2``
    Unit: counts of 0.01 degC for the module; of 0.1 degC for a channel, two's complement in the low byte (E62).
    Manual: 3.3.12; E62, E63, E104.
    """

    pdu = "46 2B offset:2"
    section = "3.3.12"
    title = "CJC offset"

    offset: items.SignedWord

    def describe(self, request: message.Message | None = None) -> dict[str, str]:
        """Return the fields in words; the unit of the offset depends on `request`."""
        if isinstance(request, ReadCjcOffset):
            words = _offset(request.channel, self.offset)
        else:
            words = f"{self.offset}, {_offset(0, self.offset)} if it is the module's"
        return Message.describe(self) | {"offset": words}

    def celsius(self, request: "ReadCjcOffset") -> float:
        """Return the offset in degrees Celsius, as the response to `request`: of the module or of a channel."""
        check_type("request", request, ReadCjcOffset)
        return offset_in_celsius(request.channel, self.offset)

    def reserved_bits(self, request: "ReadCjcOffset", profile: Profile) -> int:  # noqa: ARG002 - of the channel
        """Return the set bits that should be zero: the high byte of the offset of a channel."""
        return self.offset & 0xFF00 if request.channel else 0


@frozen
class ReadCjcOffset(Request[CjcOffset]):
    """A request to read the offset of the cold-junction temperature, of the module or a channel.

    Wire: ``46 2B channel`` -> ``46 2B offset:2``
    Shape: `channel` 00h is the module, 80h channel 0, 81h channel 1 and so on.
    Errors: `EncodeError` for a channel that the module does not have.
    Manual: 3.3.12; E62, E63, E104.
    """

    pdu = "46 2B channel"
    section = "3.3.12"
    title = "CJC offset"
    availability = Availability.M_7018_M_7019

    channel: _OffsetChannel

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for a channel that the module does not have."""
        check_offset_channel(self, self.channel, profile)


class CjcOffsetResult(SettingResult):
    """The result of setting an offset.

    Wire: ``46 2C result``
    Manual: 3.3.13; E62, E63, E85, E104.
    """

    pdu = "46 2C result"
    section = "3.3.13"
    title = "CJC offset"


@frozen
class SetCjcOffset(Request[CjcOffsetResult]):
    """A request to set the offset of the cold-junction temperature, of the module or a channel.

    Wire: ``46 2C channel offset:2`` -> ``46 2C result``
    Shape: `channel` 00h is the module, 80h channel 0, 81h channel 1 and so on.
    Unit: counts of 0.01 degC for the module; of 0.1 degC for a channel, two's complement in the low byte (E62).
    Range: -1000h..1000h for the module; 00h..FFh for a channel.
    Errors: `EncodeError` for a channel that the module does not have, and beyond the range.
    Manual: 3.3.13; E62, E63, E85, E104.
    """

    pdu = "46 2C channel offset:2"
    section = "3.3.13"
    title = "CJC offset"
    availability = Availability.M_7018_M_7019

    channel: _OffsetChannel
    offset: items.SignedWord

    def describe(self, request: message.Message | None = None) -> dict[str, str]:  # noqa: ARG002 - it is a request
        """Return the fields in words."""
        return Message.describe(self) | {"offset": _offset(self.channel, self.offset)}

    @property
    def celsius(self) -> float:
        """The offset in degrees Celsius."""
        return offset_in_celsius(self.channel, self.offset)

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for a channel that the module does not have, or an offset beyond its range."""
        check_offset_channel(self, self.channel, profile)
        if not self.channel:
            profile.check_cjc_offset(self.offset, self.section)
        elif not 0 <= self.offset <= _LOW_BYTE:
            raise EncodeError("offset", self.offset, f"0..{_LOW_BYTE}", self.section)


@frozen
class CjcEnabled(Response):
    """The state of the cold-junction compensation: on or off.

    Wire: ``46 2D enabled``
    Manual: 3.3.14; E63.
    """

    pdu = "46 2D enabled"
    section = "3.3.14"
    title = "CJC switch"

    enabled: items.Flag = field(kw_only=True)


class ReadCjcEnabled(Request[CjcEnabled]):
    """A request to read whether cold-junction compensation is on.

    Wire: ``46 2D 00`` -> ``46 2D enabled``
    Manual: 3.3.14; E63.
    """

    pdu = "46 2D 00"
    section = "3.3.14"
    title = "CJC switch"
    availability = Availability.M_7018_M_7019


class CjcEnabledResult(SettingResult):
    """The result of switching cold-junction compensation.

    Wire: ``46 2E result``
    Manual: 3.3.15; E64.
    """

    pdu = "46 2E result"
    section = "3.3.15"
    title = "CJC switch"


@frozen
class SetCjcEnabled(Request[CjcEnabledResult]):
    """A request to switch cold-junction compensation on or off.

    Wire: ``46 2E 00 enabled`` -> ``46 2E result``
    Manual: 3.3.15; E64.
    """

    pdu = "46 2E 00 enabled"
    section = "3.3.15"
    title = "CJC switch"
    availability = Availability.M_7018_M_7019

    enabled: items.Flag = field(kw_only=True)


@frozen
class CjcUpdateSetting(Response):
    """The update setting of the cold-junction temperature: started, stopped or once.

    Wire: ``46 2F update``
    Manual: 3.3.16.
    """

    pdu = "46 2F update"
    section = "3.3.16"
    title = "CJC update setting"

    update: items.UpdateByte


class ReadCjcUpdate(Request[CjcUpdateSetting]):
    """A request to read whether the cold-junction temperature is being updated.

    Wire: ``46 2F`` -> ``46 2F update``
    Manual: 3.3.16.
    """

    pdu = "46 2F"
    section = "3.3.16"
    title = "CJC update setting"
    availability = Availability.M_7019


class CjcUpdateResult(SettingResult):
    """The result of setting the update of the cold-junction temperature.

    Wire: ``46 30 result``
    Manual: 3.3.17; E64.
    """

    pdu = "46 30 result"
    section = "3.3.17"
    title = "CJC update setting"


@frozen
class SetCjcUpdate(Request[CjcUpdateResult]):
    """A request to start or stop the update of the cold-junction temperature, or update it once.

    Wire: ``46 30 update`` -> ``46 30 result``
    Manual: 3.3.17; E64.
    """

    pdu = "46 30 update"
    section = "3.3.17"
    title = "CJC update setting"
    availability = Availability.M_7019

    update: items.UpdateByte


REQUESTS = (
    ReadCjcOffset,
    SetCjcOffset,
    ReadCjcEnabled,
    SetCjcEnabled,
    ReadCjcUpdate,
    SetCjcUpdate,
)
"""The requests of this module, by function and sub-function."""
