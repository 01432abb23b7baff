"""Function 46h, the module: name, firmware, address, line and protocol (manual 3.3.1 to 3.3.4, 3.3.7).

Laws: reserved bytes are zero. A `result` of 0 means that a setting was made; other values are not documented (E90).
"""

from i7000.availability import Availability
from i7000.errors import EncodeError
from i7000.message import frozen
from i7000.modbus import items
from i7000.modbus.request import LAST_ADDRESS, Request, Response, SettingResult
from i7000.models import Firmware, Model
from i7000.profile import Profile

__all__ = [
    "CommunicationSettings",
    "CommunicationSettingsResult",
    "FirmwareVersion",
    "ModuleAddressResult",
    "ModuleName",
    "ReadCommunicationSettings",
    "ReadFirmwareVersion",
    "ReadModuleName",
    "SetCommunicationSettings",
    "SetModuleAddress",
]


@frozen
class ModuleName(Response):
    """The name of the series.

    Wire: ``46 00 name:4``
    Shape: 00 70 17 00 is the M-7017 series, 00 70 18 00 the M-7018, 00 70 19 00 the M-7019 series.
    Manual: 3.3.1; E75, E77.
    """

    pdu = "46 00 name:4"
    section = "3.3.1"
    title = "module name"

    name: items.Name

    @property
    def series(self) -> str | None:
        """The series, such as ``7019``; None for an unknown series."""
        return Model.series_of(self.name)


class ReadModuleName(Request[ModuleName]):
    """A request to read the name of the series.

    Wire: ``46 00`` -> ``46 00 name:4``
    Manual: 3.3.1; E75, E77.
    """

    pdu = "46 00"
    section = "3.3.1"
    title = "module name"
    availability = Availability.M_SERIES


class ModuleAddressResult(SettingResult):
    """The result of setting the address.

    Wire: ``46 04 result 00 00 00``
    Manual: 3.3.2; E82, E90.
    """

    pdu = "46 04 result 00 00 00"
    section = "3.3.2"
    title = "module address"


@frozen
class SetModuleAddress(Request[ModuleAddressResult]):
    """A request to set the address of the module.

    Wire: ``46 04 new_address 00 00 00`` -> ``46 04 result 00 00 00``
    Range: 1..247.
    Errors: `EncodeError` beyond the range.
    Manual: 3.3.2; E82, E90.
    """

    pdu = "46 04 new_address 00 00 00"
    section = "3.3.2"
    title = "module address"
    availability = Availability.M_SERIES

    new_address: items.NewAddress

    def check(self, profile: Profile) -> None:  # noqa: ARG002 - the same for all
        """Raise `EncodeError` for an address that no module has."""
        if not 1 <= self.new_address <= LAST_ADDRESS:
            raise EncodeError("new_address", self.new_address, f"1..{LAST_ADDRESS}", self.section)


@frozen
class CommunicationSettings(Response):
    """The line settings and the protocol after the next power-on.

    Wire: ``46 05 00 line_settings 00 00 00 protocol 00 00``
    Manual: 3.3.3; E44, E65.
    """

    pdu = "46 05 00 line_settings 00 00 00 protocol 00 00"
    section = "3.3.3"
    title = "communication settings"

    line_settings: items.LineByte
    protocol: items.ProtocolByte


class ReadCommunicationSettings(Request[CommunicationSettings]):
    """A request to read the line settings and the protocol after the next power-on.

    Wire: ``46 05 00`` -> ``46 05 00 line_settings 00 00 00 protocol 00 00``
    Manual: 3.3.3; E44, E65.
    """

    pdu = "46 05 00"
    section = "3.3.3"
    title = "communication settings"
    availability = Availability.M_SERIES


@frozen
class CommunicationSettingsResult(Response):
    """The result of setting the line settings and the protocol.

    Wire: ``46 06 00 line_result 00 00 00 protocol_result 00 00``
    Manual: 3.3.4; E44, E65, E90, E91.
    """

    pdu = "46 06 00 line_result 00 00 00 protocol_result 00 00"
    section = "3.3.4"
    title = "communication settings"

    line_result: items.ResultByte
    protocol_result: items.ResultByte


@frozen
class SetCommunicationSettings(Request[CommunicationSettingsResult]):
    """A request to set the line settings and the protocol after the next power-on.

    Wire: ``46 06 00 line_settings 00 00 00 protocol 00 00`` -> ``46 06 00 line_result 00 00 00 protocol_result 00 00``
    Errors: `EncodeError` for a baud rate or character format that the module does not have.
    Manual: 3.3.4; E44, E65, E90, E91.
    """

    pdu = "46 06 00 line_settings 00 00 00 protocol 00 00"
    section = "3.3.4"
    title = "communication settings"
    availability = Availability.M_SERIES

    line_settings: items.LineByte
    protocol: items.ProtocolByte

    def check(self, profile: Profile) -> None:
        """Raise `EncodeError` for line settings that the module does not have."""
        profile.check_line(self.line_settings, self.section)


@frozen
class FirmwareVersion(Response):
    """The firmware version.

    Wire: ``46 20 major minor build``
    Manual: 3.3.7; E67, E75.
    """

    pdu = "46 20 major minor build"
    section = "3.3.7"
    title = "firmware version"

    major: items.Byte
    minor: items.Byte
    build: items.Byte

    @property
    def firmware(self) -> Firmware | None:
        """The version: B4.5 for the bytes 0B, 04, 05 (assumption); None for invalid bytes."""
        return Firmware.from_bytes(bytes((self.major, self.minor, self.build)))


class ReadFirmwareVersion(Request[FirmwareVersion]):
    """A request to read the firmware version.

    Wire: ``46 20`` -> ``46 20 major minor build``
    Manual: 3.3.7; E67, E75.
    """

    pdu = "46 20"
    section = "3.3.7"
    title = "firmware version"
    availability = Availability.M_SERIES


REQUESTS = (
    ReadModuleName,
    SetModuleAddress,
    ReadCommunicationSettings,
    SetCommunicationSettings,
    ReadFirmwareVersion,
)
"""The requests of this module, by function and sub-function."""
