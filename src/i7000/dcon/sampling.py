"""Synchronized sampling: one broadcast makes all modules sample; each is read later (manual 2.2, 2.12).

Models: 7019 series.
"""

from attrs import field

from i7000.availability import Availability
from i7000.dcon import parts
from i7000.dcon.command import Broadcast, Command, Response
from i7000.dcon.inputs import check_values
from i7000.message import frozen
from i7000.profile import Profile

__all__ = ["ReadSynchronizedData", "SynchronizedData", "SynchronizedSampling"]


@frozen
class SynchronizedSampling(Broadcast):
    """A broadcast that makes all modules sample their inputs now and keep the readings.

    Wire: ``#**``, no response
    Time: 2 ms before the next command.
    Models: 7019 series; the others ignore it (assumption).
    Manual: 2.2; E26.
    """

    syntax = "#**"
    section = "2.2"
    title = "synchronized sampling"
    availability = Availability.SERIES_7019


@frozen
class SynchronizedData(Response):
    """The readings kept at the last `SynchronizedSampling`.

    Wire: ``>AAS(Data)``
    Shape: `values` as in `AnalogInputs`.
    Manual: 2.12, 1.11; E15, E24, E25, E108.
    """

    syntax = ">AAS(Data)"
    section = "2.12"
    title = "synchronized readings of all channels"

    address: parts.Address
    first_reading: parts.FlagS = field(kw_only=True)
    """Whether the readings are sent for the first time."""
    values: parts.Values

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for fields that are not those of the module's channels."""
        check_values(self, self.values, profile.data_format, profile)


class ReadSynchronizedData(Command[SynchronizedData]):
    """A command to read the readings kept at the last `SynchronizedSampling`; refused if there was none.

    Wire: ``$AA4`` -> ``>AAS(Data)``
    Models: 7019 series.
    Manual: 2.12; E15, E108.
    """

    syntax = "$AA4"
    section = "2.12"
    title = "synchronized sampling"
    availability = Availability.SERIES_7019


COMMANDS = (
    SynchronizedSampling,
    ReadSynchronizedData,
)
"""The commands of this module, by section."""
