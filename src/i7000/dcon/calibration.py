"""Calibration (manual 1.10, 2.5, 2.6, 2.7, 2.8, 2.9, 2.27, 2.28, 2.31).

Laws: a module refuses a calibration command unless `SetCalibrationEnabled` came before it. The digit after the address
has opposite meanings: ``0`` is span and ``1`` zero for whole modules, ``0`` zero and ``1`` span for single channels
of the 7019 series, and ``0`` span for those of the M-7017mC-16; the model decides, not the characters (E7, E9).
"""

from attrs import field

from i7000.availability import Availability
from i7000.dcon import parts
from i7000.dcon.command import Acknowledged, Command
from i7000.message import frozen
from i7000.profile import Profile

__all__ = [
    "CalibrateChannelSpan",
    "CalibrateChannelZero",
    "CalibrateCurrentChannelSpan",
    "CalibrateInternally",
    "CalibrateSpan",
    "CalibrateZero",
    "ReloadDefaultCalibration",
    "SetCalibrationEnabled",
]


class CalibrateSpan(Command[Acknowledged]):
    """A command to calibrate the span, with the span signal applied.

    Wire: ``$AA0`` -> ``!AA``
    Models: 7017 and 7018 series.
    Manual: 2.5, 1.10; E9, E34.
    """

    syntax = "$AA0"
    section = "2.5"
    title = "span calibration of the whole module"
    availability = Availability.SERIES_7017_7018


class CalibrateZero(Command[Acknowledged]):
    """A command to calibrate the zero, with the zero signal applied.

    Wire: ``$AA1`` -> ``!AA``
    Models: 7017 and 7018 series.
    Manual: 2.6, 1.10; E9, E34.
    """

    syntax = "$AA1"
    section = "2.6"
    title = "zero calibration of the whole module"
    availability = Availability.SERIES_7017_7018


@frozen
class CalibrateCurrentChannelSpan(Command[Acknowledged]):
    """A command to calibrate the span of one current input, with the span signal applied.

    Wire: ``$AA0Ci`` -> ``!AA``
    Models: M-7017mC-16; the same characters are `CalibrateChannelZero` for the 7019 series.
    Manual: 2.7, 1.10; E7, E9.
    """

    syntax = "$AA0Ci"
    section = "2.7"
    title = "span calibration of single current inputs"
    availability = Availability.M_7017MC_16

    channel: parts.CalibratedChannel


@frozen
class CalibrateChannelZero(Command[Acknowledged]):
    """A command to calibrate the zero of one channel, with the zero signal applied.

    Wire: ``$AA0Ci`` -> ``!AA``
    Time: about 16 s with firmware up to B2.6.
    Models: 7019 series; the same characters are `CalibrateCurrentChannelSpan` for the M-7017mC-16.
    Errors: `EncodeError` for a channel that the module does not have.
    Manual: 2.8, 1.10; E7, E9.
    """

    syntax = "$AA0Ci"
    section = "2.8"
    title = "zero calibration of single channels"
    availability = Availability.SERIES_7019

    channel: parts.CalibratedChannel

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for a channel that the module does not have."""
        profile.check_channel(self.channel, self.section)


@frozen
class CalibrateChannelSpan(Command[Acknowledged]):
    """A command to calibrate the span of one channel, with the span signal applied.

    Wire: ``$AA1Ci`` -> ``!AA``
    Time: about 16 s with firmware up to B2.6.
    Models: 7019 series.
    Errors: `EncodeError` for a channel that the module does not have.
    Manual: 2.9, 1.10; E9.
    """

    syntax = "$AA1Ci"
    section = "2.9"
    title = "span calibration of single channels"
    availability = Availability.SERIES_7019

    channel: parts.CalibratedChannel

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for a channel that the module does not have."""
        profile.check_channel(self.channel, self.section)


class CalibrateInternally(Command[Acknowledged]):
    """A command to calibrate the module against itself.

    Wire: ``$AAS0`` -> ``!AA``
    Models: 7019 series.
    Manual: 2.27.
    """

    syntax = "$AAS0"
    section = "2.27"
    title = "internal calibration"
    availability = Availability.SERIES_7019


class ReloadDefaultCalibration(Command[Acknowledged]):
    """A command to load the factory calibration, the internal calibration included.

    Wire: ``$AAS1`` -> ``!AA``
    Time: about 3 s.
    Models: M-7017mC-16 and 7019 series.
    Manual: 2.28; E103.
    """

    syntax = "$AAS1"
    section = "2.28"
    title = "reload of the default calibration"
    availability = Availability.SOFT_INIT


@frozen
class SetCalibrationEnabled(Command[Acknowledged]):
    """A command to allow or forbid calibration commands.

    Wire: ``~AAEV`` -> ``!AA``
    Manual: 2.31, 1.10; E10, E33.
    """

    syntax = "~AAEV"
    section = "2.31"
    title = "calibration switch"

    enabled: parts.FlagV = field(kw_only=True)


COMMANDS = (
    CalibrateSpan,
    CalibrateZero,
    CalibrateCurrentChannelSpan,
    CalibrateChannelZero,
    CalibrateChannelSpan,
    CalibrateInternally,
    ReloadDefaultCalibration,
    SetCalibrationEnabled,
)
"""The commands of this module, by section."""
