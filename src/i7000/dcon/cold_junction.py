"""Cold-junction compensation: temperature, offset, update, switch (2.11, 2.17, 2.18, 2.20, 2.21, 2.29, 2.30)."""

from attrs import field

from i7000.availability import Availability
from i7000.dcon import parts
from i7000.dcon.command import Acknowledged, Command, Response
from i7000.message import frozen
from i7000.profile import Profile

__all__ = [
    "CjcEnabled",
    "CjcOffset",
    "CjcTemperature",
    "CjcUpdateSetting",
    "ReadCjcEnabled",
    "ReadCjcOffset",
    "ReadCjcTemperature",
    "ReadCjcUpdate",
    "SetCjcEnabled",
    "SetCjcOffset",
    "SetCjcUpdate",
]


@frozen
class CjcTemperature(Response):
    """The temperature of the cold junction.

    Wire: ``>(Data)``
    Shape: sign, four digits, a point and one digit.
    Unit: degrees Celsius, in tenths.
    Special: the offset is included on the 7018 series, not on the 7019 series.
    Manual: 2.11; E24, E29.
    """

    syntax = ">(Data)"
    section = "2.11"
    title = "CJC temperature"

    temperature: parts.Temperature


class ReadCjcTemperature(Command[CjcTemperature]):
    """A command to read the temperature of the cold junction.

    Wire: ``$AA3`` -> ``>(Data)``
    Models: 7018 and 7019 series.
    Manual: 2.11; E24, E29.
    """

    syntax = "$AA3"
    section = "2.11"
    title = "CJC temperature"
    availability = Availability.SERIES_7018_7019


@frozen
class CjcOffset(Response):
    """The offset of the cold-junction temperature.

    Wire: ``!AA(Data)``
    Shape: a sign and the magnitude in four hex digits; ``-0000`` is read as 0.
    Unit: counts of 0.01 degC; `celsius` is the offset in degrees.
    Manual: 2.17; E85.
    """

    syntax = "!AA(Data)"
    section = "2.17"
    title = "CJC offset"

    address: parts.Address
    offset: parts.OffsetData

    @property
    def celsius(self) -> float:
        """The offset in degrees Celsius."""
        return self.offset / 100

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for an offset beyond the limit."""
        profile.check_cjc_offset(self.offset, self.section)


class ReadCjcOffset(Command[CjcOffset]):
    """A command to read the offset of the cold-junction temperature.

    Wire: ``$AA9`` -> ``!AA(Data)``
    Models: 7018 and 7019 series.
    Manual: 2.17; E85.
    """

    syntax = "$AA9"
    section = "2.17"
    title = "CJC offset"
    availability = Availability.SERIES_7018_7019


@frozen
class SetCjcOffset(Command[Acknowledged]):
    """A command to set the offset of the cold-junction temperature.

    Wire: ``$AA9SNNNN`` -> ``!AA``
    Shape: a sign and the magnitude in four hex digits; ``-0000`` is read as 0.
    Unit: counts of 0.01 degC.
    Range: up to 1000h either way, 40.96 degC.
    Models: 7018 and 7019 series.
    Errors: `EncodeError` beyond the range.
    Manual: 2.18; E85.
    """

    syntax = "$AA9SNNNN"
    section = "2.18"
    title = "CJC offset"
    availability = Availability.SERIES_7018_7019

    offset: parts.Offset

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for an offset beyond the limit."""
        profile.check_cjc_offset(self.offset, self.section)


@frozen
class CjcUpdateSetting(Response):
    """The update setting of the cold-junction temperature: started, stopped or once.

    Wire: ``!AAi``
    Manual: 2.20; E8, E115.
    """

    syntax = "!AAi"
    section = "2.20"
    title = "CJC update setting"

    address: parts.Address
    update: parts.Update


class ReadCjcUpdate(Command[CjcUpdateSetting]):
    """A command to read whether the cold-junction temperature is being updated.

    Wire: ``$AAA`` -> ``!AAi``
    Models: 7019 series; the same characters are `ReadAnalogInputsHex` for the 7017 series.
    Manual: 2.20; E8, E115.
    """

    syntax = "$AAA"
    section = "2.20"
    title = "CJC update setting"
    availability = Availability.SERIES_7019


@frozen
class SetCjcUpdate(Command[Acknowledged]):
    """A command to start or stop the update of the cold-junction temperature, or update it once.

    Wire: ``$AAAi`` -> ``!AA``
    Models: 7019 series.
    Manual: 2.21; E8, E115.
    """

    syntax = "$AAAi"
    section = "2.21"
    title = "CJC update setting"
    availability = Availability.SERIES_7019

    update: parts.Update


@frozen
class CjcEnabled(Response):
    """The state of the cold-junction compensation: on or off.

    Wire: ``!AAN``
    Manual: 2.29.
    """

    syntax = "!AAN"
    section = "2.29"
    title = "CJC switch"

    address: parts.Address
    enabled: parts.FlagN = field(kw_only=True)


class ReadCjcEnabled(Command[CjcEnabled]):
    """A command to read whether cold-junction compensation is on.

    Wire: ``~AAC`` -> ``!AAN``
    Models: 7018 and 7019 series.
    Manual: 2.29.
    """

    syntax = "~AAC"
    section = "2.29"
    title = "CJC switch"
    availability = Availability.SERIES_7018_7019


@frozen
class SetCjcEnabled(Command[Acknowledged]):
    """A command to switch cold-junction compensation on or off.

    Wire: ``~AACN`` -> ``!AA``
    Models: 7018 and 7019 series.
    Manual: 2.30.
    """

    syntax = "~AACN"
    section = "2.30"
    title = "CJC switch"
    availability = Availability.SERIES_7018_7019

    enabled: parts.FlagN = field(kw_only=True)


COMMANDS = (
    ReadCjcTemperature,
    ReadCjcOffset,
    SetCjcOffset,
    ReadCjcUpdate,
    SetCjcUpdate,
    ReadCjcEnabled,
    SetCjcEnabled,
)
"""The commands of this module, by section."""
