"""Which commands are dangerous: compared with the table of settings, and with what the manual calls calibration."""

from collections.abc import Iterator
from typing import Any

import pytest

from i7000 import ArgumentError, Firmware, Model, Profile, dcon, modbus
from i7000.availability import Availability
from i7000.host.dangers import Danger, danger_of
from i7000.host.procedures import Hazard, Setting, settings_of
from i7000.host.procedures.access import InMessage, InRegister, registers_of
from i7000.modbus import Access, Area
from tests.each import each
from tests.vectors import dcon_vectors, message_of, modbus_message_of, modbus_vectors

PROFILES = tuple(
    Profile(model, firmware=firmware, single_ended=single_ended, type_codes=())
    for model in Model
    for firmware in (None, Firmware("A0.0"))
    for single_ended in ((False, True) if model in Availability.SERIES_7017Z.gates else (False,))
)
COMMANDS = {
    **{type(it): it for it in (message_of(it.values[0]["command"]) for it in dcon_vectors("response", "silence"))},
    **{type(it): it for it in (modbus_message_of(it.values[0]["request"]) for it in modbus_vectors("response"))},
}
"""An example of each command."""
SLOWER = "response_delay"
"""Dangerous to send, although it is restored as a plain setting: a host may not wait that long."""
PERMISSIONS = {dcon.SoftInit, dcon.SetSoftInitTimeout}
"""Dangerous because of what they permit."""
BY_ADDRESS = {
    modbus.WriteSingleCoil,
    modbus.WriteSingleRegister,
    modbus.WriteMultipleCoils,
    modbus.WriteMultipleRegisters,
}


def commands_with(danger: Danger | None) -> set[Any]:
    return {kind for kind, example in COMMANDS.items() if danger_of(example) is danger and kind not in BY_ADDRESS}


def settings() -> Iterator[tuple[str, Setting]]:
    for profile in PROFILES:
        for protocol in profile.model.protocols:
            for setting in settings_of(profile, protocol):
                name = f"{profile.model.value}-{profile.firmware}-{profile.single_ended}-{protocol.name}-{setting.name}"
                yield name, setting


def writers(hazard: Hazard) -> set[Any]:
    """The commands that set something of this hazard."""
    return {it.access.writer for _, it in settings() if isinstance(it.access, InMessage) and it.hazard is hazard}


def writes(area: Area, address: int) -> tuple[Any, Any]:
    """Requests that write an item: alone, and the last of three."""
    start = max(address - 2, 0)
    if area is Area.COIL:
        alone: Any = modbus.WriteSingleCoil(0x01, address, value=True)
        return alone, modbus.WriteMultipleCoils(0x01, start, (True,) * 3)
    return modbus.WriteSingleRegister(0x01, address, 1), modbus.WriteMultipleRegisters(0x01, start, (1,) * 3)


def test_there_is_an_example_of_every_command() -> None:
    assert {*dcon.COMMANDS, *modbus.REQUESTS} == set(COMMANDS)


def test_a_command_that_sets_what_could_lose_a_module_is_dangerous() -> None:
    assert writers(Hazard.LOSES) | PERMISSIONS == commands_with(Danger.LOSES)


def test_a_command_that_changes_calibration_is_dangerous() -> None:
    assert {kind for kind in COMMANDS if "calibration" in kind.title} == commands_with(Danger.CALIBRATION)


def test_no_other_command_is_dangerous() -> None:
    plain = writers(Hazard.PLAIN) - writers(Hazard.LOSES)
    harmless = {kind for kind in COMMANDS if kind.__name__.startswith(("Read", "Reset"))} - {
        dcon.ReloadDefaultCalibration
    }

    assert commands_with(None) >= plain | (harmless - commands_with(Danger.CALIBRATION))


@each("setting", [pytest.param(setting, id=name) for name, setting in settings()])
def test_a_register_that_holds_a_setting_is_as_dangerous_as_the_setting(setting: Setting) -> None:
    if isinstance(setting.access, InRegister):
        row = setting.access.row
        loses = setting.hazard is Hazard.LOSES or setting.name == SLOWER

        alone, _ = writes(row.area, row.address + (setting.channel or 0))
        assert (Danger.LOSES if loses else None) is danger_of(alone)


ROWS = {row for profile in PROFILES for row in registers_of(profile) if row.access is not Access.READ}


@each("row", [pytest.param(it, id=f"{it.number}-{it.name}") for it in sorted(ROWS, key=repr)])
def test_a_row_that_can_be_written_is_at_least_as_dangerous_among_others(row: Any) -> None:
    alone, among = map(danger_of, writes(row.area, row.address))

    assert ("calibration" in row.name) is (alone is Danger.CALIBRATION)
    assert alone in (None, among)


def test_a_write_of_several_items_is_as_dangerous_as_the_worst_of_them() -> None:
    assert danger_of(modbus.WriteMultipleRegisters(0x01, 488, (1, 1))) is None
    assert danger_of(modbus.WriteMultipleRegisters(0x01, 486, (1, 1))) is Danger.LOSES
    assert danger_of(modbus.WriteMultipleCoils(0x01, 260, (True,) * 12)) is Danger.CALIBRATION
    assert danger_of(modbus.WriteMultipleCoils(0x01, 256, (True,) * 16)) is Danger.LOSES


def test_a_broadcast_that_changes_settings_is_dangerous() -> None:
    assert danger_of(modbus.WriteSingleRegister(0x00, 488, 1)) is Danger.BROADCAST
    assert danger_of(modbus.WriteSingleRegister(0x00, 484, 1)) is Danger.LOSES
    assert danger_of(modbus.WriteSingleCoil(0x00, 271, value=True)) is Danger.CALIBRATION


def test_the_broadcasts_of_dcon_change_no_setting() -> None:
    assert danger_of(dcon.HostOk()) is danger_of(dcon.SynchronizedSampling()) is None


def test_what_is_no_command_is_refused() -> None:
    wrong: Any = b"$012\r"
    with pytest.raises(ArgumentError):
        danger_of(wrong)
