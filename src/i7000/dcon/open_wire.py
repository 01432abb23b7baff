"""Detection of open thermocouple wires (manual 2.40, 2.41).

Laws: ``~AAEO`` ends in the letter O; ``~AAE0``, with the digit 0, forbids calibration (E10).
"""

from attrs import field

from i7000.availability import Availability
from i7000.dcon import parts
from i7000.dcon.command import Acknowledged, Command, Response
from i7000.message import frozen

__all__ = ["OpenWireDetection", "ReadOpenWireDetection", "SetOpenWireDetection"]


@frozen
class OpenWireDetection(Response):
    """The state of open wire detection: on or off.

    Wire: ``!AAN``
    Manual: 2.40; E1, E68.
    """

    syntax = "!AAN"
    section = "2.40"
    title = "open wire detection"

    address: parts.Address
    enabled: parts.FlagN = field(kw_only=True)


class ReadOpenWireDetection(Command[OpenWireDetection]):
    """A command to read whether open wire detection is on.

    Wire: ``~AAEO`` -> ``!AAN``
    Models: 7018R from firmware B4.2, 7019 series from B3.7.
    Manual: 2.40; E1, E68, E69.
    """

    syntax = "~AAEO"
    section = "2.40"
    title = "open wire detection setting"
    availability = Availability.OPEN_WIRE


@frozen
class SetOpenWireDetection(Command[Acknowledged]):
    """A command to switch open wire detection on or off.

    Wire: ``~AAEON`` -> ``!AA``
    Models: 7018R from firmware B4.2, 7019 series from B3.7.
    Manual: 2.41; E2, E68, E69.
    """

    syntax = "~AAEON"
    section = "2.41"
    title = "open wire detection setting"
    availability = Availability.OPEN_WIRE

    enabled: parts.FlagN = field(kw_only=True)


COMMANDS = (
    ReadOpenWireDetection,
    SetOpenWireDetection,
)
"""The commands of this module, by section."""
