"""The table of settings: that it has everything, and nothing else, and says what the codecs say."""

from functools import cache
from typing import Any, get_args

import pytest
from attrs import evolve, fields_dict

from i7000 import Firmware, InvalidValueError, Model, Profile, Protocol, dcon, modbus
from i7000.device import factory
from i7000.host.procedures.access import InMessage, InRegister
from i7000.host.procedures.change import set_one
from i7000.host.procedures.restoring import Status
from i7000.host.procedures.settings import (
    NOT_SETTINGS,
    Hazard,
    Setting,
    find_setting,
    hazard_of,
    known_settings,
    settings_of,
)
from i7000.host.procedures.step import Procedure, ask
from i7000.host.procedures.values import Channels, Choice, Name, Quantity
from i7000.modbus.registers import Access
from tests.host.procedures.eeproms import NOT_SET, differences, parts
from tests.host.procedures.runner_settings import Bench

FIRMWARES = (None, Firmware("B2.0"))
PROFILES = [
    Profile(model, firmware=firmware, single_ended=single_ended, type_codes=())
    for model in Model
    for firmware in FIRMWARES
    for single_ended in ((False, True) if model.value[2:] == "7017Z" else (False,))
]
EACH = [(profile, protocol) for profile in PROFILES for protocol in sorted(profile.model.protocols)]
FORGOTTEN = {
    dcon.SetCjcUpdate, modbus.SetCjcUpdate, dcon.SetSoftInitTimeout, dcon.SoftInit, dcon.SetCalibrationEnabled,
}  # fmt: skip
"""Commands that change only what a module forgets without power."""
CALIBRATION = {
    dcon.CalibrateSpan, dcon.CalibrateZero, dcon.CalibrateCurrentChannelSpan, dcon.CalibrateChannelZero,
    dcon.CalibrateChannelSpan, dcon.CalibrateInternally, dcon.ReloadDefaultCalibration,
}  # fmt: skip
STATES = {dcon.ResetHostWatchdogStatus}
ITEMS = {
    modbus.WriteSingleCoil, modbus.WriteSingleRegister, modbus.WriteMultipleCoils, modbus.WriteMultipleRegisters,
}  # fmt: skip
"""Requests that write rows of the address map."""


def another(setting: Setting, held: Any) -> Any:
    """A value other than the one that is held, the plainest."""
    values = setting.values
    match values:
        case Choice():
            return next(plain for plain, _ in values.options if plain != held)
        case Quantity():
            counts = values.low + 1 if held != (values.low + 1) / values.per_unit else values.high
            return counts if values.per_unit == 1 else counts / values.per_unit
        case Channels():
            return (0,) if held != (0,) else (1,)
        case Name():
            return "OVEN 2"


# --- it has everything ------------------------------------------------------------------------------------------------


def test_every_command_that_sets_anything_is_in_the_table_or_named_as_left_out() -> None:
    used = {
        setting.access.writer
        for profile, protocol in EACH
        for setting in settings_of(profile, protocol)
        if isinstance(setting.access, InMessage)
    }
    by_dcon = {it for it in dcon.COMMANDS if getattr(it, "response", None) is dcon.Acknowledged}
    by_modbus = {it for it in modbus.REQUESTS if it.__name__.startswith(("Set", "Write"))}

    assert by_dcon | by_modbus == used | FORGOTTEN | CALIBRATION | STATES | ITEMS
    assert used.isdisjoint(FORGOTTEN | CALIBRATION | STATES | ITEMS)


@pytest.mark.parametrize("profile", PROFILES, ids=lambda it: f"{it.name}{it.single_ended * ' single-ended'}")
def test_every_row_that_can_be_written_is_a_setting_or_named_as_left_out(profile: Profile) -> None:
    settings = settings_of(profile, Protocol.MODBUS_RTU)
    used = {it.access.name for it in settings if isinstance(it.access, InRegister)}
    rows = {row.name for row in modbus.RegisterMap(profile) if row.access is not Access.READ}
    mask = {"channel_mask", "channel_mask_high"}  # by function 46h, which has both in one
    several = {"module_type_code"} if profile.individually_configurable else set()  # each channel has its own

    assert rows <= used | set(NOT_SETTINGS) | mask | several
    assert used.isdisjoint(NOT_SETTINGS)


@cache
def changes_of(model: Model, protocol: Protocol) -> dict[str, tuple[Status, set[str]]]:
    """What setting each setting to another value does: its status, and the parts of the memory that change."""
    several = model.value[2:] == "7017Z"
    eeprom = evolve(factory(model), protocol=protocol, single_ended=several)
    profile = Profile(model, single_ended=several)
    init = protocol is Protocol.DCON  # in which baud rate, checksum and protocol can be changed
    found = {}
    for setting in settings_of(profile, protocol):
        bench = Bench.of(eeprom, init_switch=init)
        value = another(setting, Bench.of(eeprom).run(read(setting, profile)))
        made = bench.run(set_one(0 if init else 1, profile, setting.name, value, protocol=protocol))
        parts_changed = differences(eeprom, bench.eeprom)
        parts_changed.discard("log.next_at")
        found[setting.name] = made.of(setting.name).status, parts_changed
    return found


def read(setting: Setting, profile: Profile) -> Procedure[Any]:
    result: Any = yield from ask(setting.access.read(1), profile)
    return setting.values.plain(setting.name, setting.access.value(result.outcome.response))


SPOKEN = [(model, protocol) for model in Model for protocol in sorted(model.protocols)]


@pytest.mark.parametrize(("model", "protocol"), SPOKEN)
def test_each_setting_changes_its_part_of_the_memory_and_nothing_else(model: Model, protocol: Protocol) -> None:
    for name, (status, changed) in changes_of(model, protocol).items():
        all_types = {f"type_codes.{channel}" for channel in range(model.channels)}
        logged = name.startswith("log_")  # several registers of one date or period

        assert status in (Status.DONE, Status.PENDING), name
        assert len(changed) == 1 or (name == "type_code" and changed == all_types), name
        assert logged or all(
            changed.isdisjoint(it[1]) for other, it in changes_of(model, protocol).items() if other != name
        )


def test_every_part_of_the_memory_is_set_by_a_setting_or_named_as_none() -> None:
    changed = {part for each in SPOKEN for _, found in changes_of(*each).values() for part in found}
    every = {part for model in Model for part in parts(factory(model))}
    beyond = {f"channel_cjc_offsets.{channel}" for channel in range(10, 20)}  # of models without such offsets
    beyond |= {f"channel_offsets.{channel}" for channel in range(16, 20)}

    assert every - beyond == changed | set(NOT_SET)
    assert changed.isdisjoint(NOT_SET)


@pytest.mark.parametrize(("model", "protocol"), SPOKEN)
def test_only_what_is_known_to_need_it_is_in_use_after_the_next_power_on(model: Model, protocol: Protocol) -> None:
    deferred = {"baud_rate", "character_format", "checksum", "protocol"}
    in_init_mode = {"address"} if protocol is Protocol.DCON else set()
    changes = changes_of(model, protocol)

    assert (deferred | in_init_mode) & set(changes) == {name for name, it in changes.items() if it[0] is Status.PENDING}


# --- it says what the codecs say --------------------------------------------------------------------------------------


@pytest.mark.parametrize("profile", PROFILES, ids=lambda it: f"{it.name}{it.single_ended * ' single-ended'}")
def test_a_setting_has_the_same_values_in_both_protocols(profile: Profile) -> None:
    by_dcon = {setting.name: setting.values for setting in settings_of(profile, Protocol.DCON)}
    by_modbus = {setting.name: setting.values for setting in settings_of(profile, Protocol.MODBUS_RTU)}
    shared = set(by_dcon) & set(by_modbus) - {"address"}

    assert {name: by_dcon[name] for name in shared} == {name: by_modbus[name] for name in shared}


@pytest.mark.parametrize(
    ("kind", "field", "name"),
    [
        (dcon.SetHostWatchdogTimeout, "timeout", "host_watchdog_timeout"),
        (dcon.SetCjcOffset, "offset", "module_cjc_offset"),
    ],
)
def test_a_quantity_has_the_unit_and_the_scale_of_the_command(kind: Any, field: str, name: str) -> None:
    part = get_args(fields_dict(kind)[field].type)[1]
    values: Any = find_setting(name, Profile(Model.I_7018), Protocol.DCON).values

    assert (part.unit, part.scale) == (values.unit, 1 / values.per_unit)


@pytest.mark.parametrize("profile", PROFILES, ids=lambda it: f"{it.name}{it.single_ended * ' single-ended'}")
def test_the_limits_are_those_of_the_registers(profile: Profile) -> None:
    for setting in settings_of(profile, Protocol.MODBUS_RTU):
        if isinstance(setting.access, InRegister) and isinstance(setting.values, Quantity):
            row = setting.access.row

            assert (row.minimum, row.maximum, row.unit) == (setting.values.low, setting.values.high, setting.unit)
            assert 1 / setting.values.per_unit == (row.scale or 1)


# --- names ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("profile", "protocol"), EACH, ids=str)
def test_a_setting_is_found_by_its_name(profile: Profile, protocol: Protocol) -> None:
    settings = settings_of(profile, protocol)

    assert settings == tuple(find_setting(it.name, profile, protocol) for it in settings)
    assert len(settings) == len({it.name for it in settings})
    assert {it.name for it in settings} <= set(known_settings(profile.model))
    assert all(it.hazard is hazard_of(it.name) for it in settings)


@pytest.mark.parametrize(
    ("name", "profile", "protocol", "words"),
    [
        ("rtc_year", Profile(Model.M_7017mC_16), Protocol.MODBUS_RTU, "rtc_year is not a setting: it is the clock"),
        ("cjc_update", Profile(Model.M_7019R), Protocol.DCON, "a module forgets it without power"),
        ("response_delay", Profile(Model.M_7017), Protocol.DCON, "M-7017 has no setting response_delay by DCON"),
        ("cjc_enabled", Profile(Model.I_7017), Protocol.DCON, "I-7017 has no setting cjc_enabled: type_code, data_"),
        ("type_code.8", Profile(Model.M_7019R), Protocol.DCON, "no setting type_code.8: type_code.0..7, data_format"),
        ("colour", Profile(Model.I_7017), Protocol.DCON, "I-7017 has no such setting as colour"),
    ],
)
def test_another_name_is_refused_with_the_reason(name: str, profile: Profile, protocol: Protocol, words: str) -> None:
    with pytest.raises(InvalidValueError) as error:
        find_setting(name, profile, protocol)

    assert words in str(error.value)


def test_what_could_lose_the_module_is_known_by_its_name() -> None:
    losing = {"address", "baud_rate", "character_format", "checksum", "protocol"}
    found = {name for model in Model for name in known_settings(model) if hazard_of(name) is Hazard.LOSES}

    assert losing == found
