"""Which commands are dangerous to send: what they could lose, miscalibrate, or change on every module of a line.

Laws: a command is classified by the worst that it can do to any model, whatever its values are. What could lose a
module is the same as in the table of settings; the response delay is added, because a host may not wait long enough.
"""

from collections.abc import Iterator, Mapping
from enum import Enum
from functools import cache
from types import MappingProxyType
from typing import Any

from i7000 import dcon, modbus
from i7000.arguments import check_type
from i7000.host.procedures.access import registers_of
from i7000.message import Query
from i7000.modbus.registers import Area
from i7000.models import Model
from i7000.profile import Profile

__all__ = ["Danger", "danger_of"]


class Danger(Enum):
    """The worst that a command can do."""

    LOSES = "loses"
    """The module may not be found again: its address, line settings, protocol, checksum or response delay change."""
    CALIBRATION = "calibration"
    """The calibration changes, or can be changed by the commands that follow."""
    BROADCAST = "broadcast"
    """A setting changes on every module of the line that has it."""


BY_CLASS: Mapping[type[Any], Danger] = MappingProxyType({
    **dict.fromkeys(
        (
            dcon.SetConfiguration, dcon.SetProtocol, dcon.SoftInit, dcon.SetSoftInitTimeout,
            modbus.SetModuleAddress, modbus.SetCommunicationSettings,
        ),
        Danger.LOSES,
    ),
    **dict.fromkeys(
        (
            dcon.CalibrateSpan, dcon.CalibrateZero, dcon.CalibrateCurrentChannelSpan, dcon.CalibrateChannelZero,
            dcon.CalibrateChannelSpan, dcon.CalibrateInternally, dcon.ReloadDefaultCalibration,
            dcon.SetCalibrationEnabled,
        ),
        Danger.CALIBRATION,
    ),
})  # fmt: skip
_BY_ROW: Mapping[str, Danger] = MappingProxyType(
    {
        **dict.fromkeys(("module_address", "line_settings", "protocol", "response_delay"), Danger.LOSES),
        "load_factory_calibration": Danger.CALIBRATION,
    }
)
"""The rows of the address maps that are dangerous to write."""


def danger_of(command: Query[Any]) -> Danger | None:
    """Return the worst that a command can do to a module; None if it only reads, or changes a plain setting.

    Special: a broadcast that could lose or miscalibrate the modules is classified as that. The DCON broadcasts change
        no setting.
    Errors: `ArgumentError`.
    Manual: 2.1, 2.5 to 2.9, 2.26 to 2.28, 2.31, 2.32, 2.34, 3.3.2, 3.3.4, 3.4.

    >>> from i7000 import Protocol
    >>> danger_of(dcon.SetProtocol(0x01, Protocol.MODBUS_RTU)), danger_of(dcon.ReadConfiguration(0x01))
    (<Danger.LOSES: 'loses'>, None)
    >>> danger_of(modbus.WriteMultipleRegisters(0x01, 483, (0, 5)))
    <Danger.LOSES: 'loses'>
    """
    check_type("command", command, Query)
    found = [BY_CLASS.get(type(command)), *map(dangers_of_rows().get, _written(command))]
    if isinstance(command, modbus.Request) and command.address == modbus.BROADCAST:
        found.append(Danger.BROADCAST)
    return next((danger for danger in Danger if danger in found), None)


def _written(command: Any) -> Iterator[tuple[Area, int]]:  # noqa: ANN401 - of either protocol
    """Yield the addresses that a request writes."""
    if isinstance(command, modbus.WriteSingleCoil):
        yield Area.COIL, command.coil
    elif isinstance(command, modbus.WriteSingleRegister):
        yield Area.HOLDING_REGISTER, command.register
    elif isinstance(command, modbus.WriteMultipleCoils | modbus.WriteMultipleRegisters):
        area = Area.COIL if isinstance(command, modbus.WriteMultipleCoils) else Area.HOLDING_REGISTER
        yield from ((area, command.start + at) for at in range(len(command.values)))


@cache
def dangers_of_rows() -> Mapping[tuple[Area, int], Danger]:
    """Return the addresses that are dangerous to write on any model."""
    return MappingProxyType(
        {
            (row.area, row.address + at): _BY_ROW[row.name]
            for model in Model
            for row in registers_of(Profile(model, type_codes=()))
            for at in range(row.count)
            if row.name in _BY_ROW
        }
    )
