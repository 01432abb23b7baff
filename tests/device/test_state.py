"""What modules remember: from the factory, and what none can have stored."""

import copy
import math
import pickle
from collections.abc import Callable
from types import FunctionType, ModuleType
from typing import Any

import attrs
import pytest
from attrs import evolve, exceptions

from i7000 import (
    ArgumentError,
    BaudRate,
    DataFormat,
    Firmware,
    InvalidValueError,
    LineSettings,
    ModbusDataFormat,
    Model,
    Profile,
    Protocol,
    ReportSettings,
    TypeCode,
    Unit,
    device,
)
from i7000.availability import Availability
from i7000.device import (
    CAPACITY,
    OPEN_WIRE,
    Eeprom,
    Log,
    Record,
    Signal,
    Signals,
    State,
    advance,
    factory,
    power_on,
    step,
)
from i7000.device.measurement import fields, words
from i7000.device.state import NEWEST
from i7000.models import CONFIGURABLE


@pytest.mark.parametrize("name", device.__all__)
def test_every_public_name_is_there_and_documented(name: str) -> None:
    value = getattr(device, name)

    assert not isinstance(value, type | FunctionType) or value.__doc__


def test_nothing_public_is_left_out() -> None:
    public = {
        name for name, value in vars(device).items() if not name.startswith("_") and not isinstance(value, ModuleType)
    }

    assert set(device.__all__) == public


@pytest.mark.parametrize("model", Model, ids=lambda model: model.value)
def test_a_module_from_the_factory_has_its_defaults(model: Model) -> None:
    made = factory(model)
    state = power_on(made, now=0.0)

    assert (made.address, made.line_settings, made.protocol) == (1, LineSettings(), max(model.protocols))
    assert set(made.type_codes) == {model.default_type or TypeCode.J}
    assert made.report_settings == ReportSettings(fast_mode=model.fast_mode_default)
    assert 1 <= len(made.name) <= 6
    assert state.profile == evolve(Profile(model, firmware=NEWEST), type_codes=made.type_codes[: model.channels])


def test_the_newest_firmware_has_everything() -> None:
    gates = [*(it.gates for it in Availability), CONFIGURABLE, *(model.type_codes for model in Model)]
    firmwares = [firmware for gate in gates for firmware in dict(gate).values() if firmware]  # type: ignore[call-overload]

    assert max(firmwares) <= NEWEST
    assert max(model.character_formats_from for model in Model) <= NEWEST


@pytest.mark.parametrize(
    ("model", "changes"),
    [
        (Model.I_7018, {"address": 256}),
        (Model.I_7018, {"address": -1}),
        (Model.I_7018, {"address": 1.5}),
        (Model.I_7018, {"address": True}),
        (Model.I_7018, {"address": "1"}),
        (Model.I_7018, {"name": ""}),
        (Model.I_7018, {"name": "7018ABC"}),
        (Model.I_7018, {"name": "70$8"}),
        (Model.I_7018, {"protocol": Protocol.MODBUS_RTU}),
        (Model.I_7018, {"type_codes": (TypeCode.K,) * 7}),
        (Model.I_7018, {"type_codes": (TypeCode.V_10,) * 8}),
        (Model.I_7018, {"type_codes": (TypeCode.K, *[TypeCode.J] * 7)}),
        (Model.I_7017Z, {"type_codes": (*[TypeCode.V_10] * 19, TypeCode.K)}),
        (Model.I_7018, {"type_codes": [TypeCode.K] * 8}),
        (Model.I_7018, {"channel_mask": 0x100}),
        (Model.I_7018, {"channel_mask": 1.5}),
        (Model.I_7018, {"channel_offsets": (0,) * 9}),
        (Model.I_7018, {"channel_offsets": (128, *[0] * 7)}),
        (Model.I_7019R, {"channel_cjc_offsets": (-4097, *[0] * 7)}),
        (Model.I_7018, {"cjc_offset": 4097}),
        (Model.I_7018, {"host_watchdog_timeout": 256}),
        (Model.M_7018, {"response_delay": 31}),
        (Model.I_7018, {"line_settings": LineSettings(0x0B)}),
        (Model.I_7018, {"report_settings": ReportSettings(3)}),
        (Model.I_7018, {"report_settings": ReportSettings(reserved=1)}),
        (Model.I_7018, {"single_ended": True}),
    ],
)
def test_what_no_module_can_have_stored_is_refused(model: Model, changes: dict[str, Any]) -> None:
    with pytest.raises(InvalidValueError):
        evolve(factory(model), **changes)


@pytest.mark.parametrize("change", [State.keep, lambda state, **changes: evolve(state.ram, **changes)])
@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("address", 256),
        ("checksum", 1),
        ("sampled", ((TypeCode.K, 1.0),)),
        *[(name, value) for name in ("fed_at", "soft_init_until") for value in (math.nan, math.inf, True)],
        ("held_cold_junction", math.nan),
        *[("soft_init_timeout", value) for value in (-5, 256, True)],
    ],
)
def test_what_no_module_can_hold_in_its_ram_is_refused(change: Callable[..., object], name: str, value: Any) -> None:
    with pytest.raises(InvalidValueError, match=f"{name} cannot be"):
        change(power_on(factory(Model.M_7019R), now=0.0), **{name: value})


@pytest.mark.parametrize("name", ["clock_offset", "next_at"])
@pytest.mark.parametrize("value", [math.nan, math.inf, "x", True])
def test_a_log_has_no_time_that_is_not_finite(name: str, value: Any) -> None:
    with pytest.raises(InvalidValueError, match=f"{name} cannot be .*: a finite number of seconds"):
        Log(**{name: value})


@pytest.mark.parametrize(
    ("name", "value"),
    [
        *[("command", value) for value in (1, "STOP", None)],
        ("overwrite", 1),
        *[("period", value) for value in ((0, 60, 0), (25, 0, 0), (0, 0), [0, 0, 1], (0, 0, 1.0), (0, 0, True), 10)],
        *[(name, (2021, 2, 32, 0, 0, 0)) for name in ("start", "end")],
        *[("start", value) for value in ((1999, 12, 31, 23, 59, 59), (2160, 1, 1, 0, 0, 0), (2021, 1, 1), "2021")],
        *[(name, value) for name in ("read_index", "last_index") for value in (-1, 1 << 32, 1.0, True, None)],
        ("records", [Record(1, (0,) * 16, 0)]),
        ("records", (1,)),
        ("records", (Record(1, (0,) * 16, 0),) * (CAPACITY + 1)),
    ],
    ids=lambda it: it if isinstance(it, str) else repr(it)[:20],
)
def test_what_no_data_logger_can_have_stored_is_refused(name: str, value: Any) -> None:
    with pytest.raises(InvalidValueError, match=f"^{name} cannot be "):
        Log(**{name: value})


@pytest.mark.parametrize(
    ("name", "value"),
    [
        *[(name, value) for name in ("index", "time") for value in (-1, 1 << 32, 1.5, False, "1")],
        *[("words", value) for value in ([0], (0x10000,), (-1,), (1.0,), (True,), None)],
    ],
)
def test_what_no_record_can_hold_is_refused(name: str, value: Any) -> None:
    fields: dict[str, Any] = {"index": 1, "words": (0,), "time": 0}

    with pytest.raises(InvalidValueError, match=f"^{name} cannot be "):
        Record(**fields | {name: value})


def test_a_state_is_frozen_and_keeps_its_profile() -> None:
    state = power_on(factory(Model.M_7017Z, Firmware("B3.9")), now=0.0)

    with pytest.raises(exceptions.FrozenInstanceError):
        state.ram = state.ram  # type: ignore[misc]
    assert state.store(single_ended=True).profile.channels == 20
    assert state.store(report_settings=ReportSettings(DataFormat.HEX)).profile.data_format is DataFormat.HEX
    assert state.keep(checksum=True).profile.checksum
    assert state.keep(checksum=True).store(address=5).profile.checksum
    assert state.keep(line_settings=LineSettings(BaudRate.BAUD_1200)).profile == state.profile


def test_a_state_that_is_made_from_another_by_its_parts_reads_by_its_own() -> None:
    state = power_on(factory(Model.I_7019R), now=0.0)
    signals = Signals.of(Unit.CELSIUS, *[100.0] * 8)

    warmer = evolve(state, eeprom=evolve(state.eeprom, type_codes=(TypeCode.K,) * 8, cjc_offset=100))
    sealed = evolve(state, ram=evolve(state.ram, checksum=True))

    assert warmer.profile.type_codes == (TypeCode.K,) * 8
    assert fields(warmer, signals) == ("+0101.0",) * 8
    assert sealed.profile.checksum


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda it: pickle.loads(pickle.dumps(it))])  # noqa: S301
def test_a_copy_of_a_state_is_equal_to_it_and_reads_the_same(copied: Callable[[State], State]) -> None:
    state = power_on(factory(Model.M_7019R), now=0.0).store(type_codes=(TypeCode.K,) * 8).keep(checksum=True)

    again = copied(state)

    assert (again, hash(again), again.profile) == (state, hash(state), state.profile)
    assert fields(again, Signals()) == fields(state, Signals())


def test_what_no_module_can_have_stored_is_not_stored() -> None:
    state = power_on(factory(Model.M_7019R), now=0.0)

    for changes in (
        {"address": 256},
        {"name": ""},
        {"channel_mask": 256},
        {"single_ended": True},
        {"model": Model.I_7018},
    ):
        with pytest.raises(InvalidValueError):
            state.store(**changes)
    with pytest.raises(InvalidValueError, match="type_codes"):
        power_on(factory(Model.M_7017Z), now=0.0).store(type_codes=(*[TypeCode.V_10] * 19, TypeCode.K))


@pytest.mark.parametrize("changes", [{"colour": "red"}, {"address": 5, "colour": 1}, {"model": Model.M_7018, "a": 1}])
@pytest.mark.parametrize("change", [State.store, State.keep])
def test_a_field_that_a_module_does_not_have_cannot_be_changed(
    change: Callable[..., State], changes: dict[str, Any]
) -> None:
    state = power_on(factory(Model.M_7019R), now=0.0)

    with pytest.raises(ArgumentError, match=r"^(Eeprom|Ram) has no (colour|a|model): (model|address), "):
        change(state, **changes)


def test_a_change_of_the_firmware_changes_the_profile() -> None:
    state = power_on(factory(Model.M_7019R), now=0.0)

    assert state.store(firmware=Firmware("B1.0")).profile.firmware == Firmware("B1.0")


CHANGES: dict[str, Any] = {
    "model": Model.M_7018R,
    "firmware": Firmware("B4.0"),
    "type_codes": (TypeCode.J,) * 8,
    "report_settings": ReportSettings(DataFormat.HEX, fast_mode=True),
    "name": "A",
    "protocol": Protocol.DCON,
    "channel_mask": 0x55,
    "channel_offsets": (10,) * 8,
    "channel_cjc_offsets": (100,) * 8,
    "open_wire_detection": False,
    "address": 2,
    "line_settings": LineSettings(BaudRate.BAUD_1200),
    "single_ended": False,
    "modbus_data_format": ModbusDataFormat.ENGINEERING,
    "cjc_offset": 100,
    "cjc_enabled": False,
    "host_watchdog_enabled": True,
    "host_watchdog_timeout": 1,
    "host_watchdog_timed_out": True,
    "host_watchdog_timeouts": 1,
    "host_watchdog_mode": True,
    "response_delay": 1,
    "sampling_rate_8_hz": False,
    "big_endian": True,
    "log": Log(read_index=2),
}


def test_every_setting_is_changed_below() -> None:
    assert CHANGES.keys() == attrs.fields_dict(Eeprom).keys()


@pytest.mark.parametrize("name", CHANGES)
def test_a_module_that_was_changed_is_as_one_that_was_made_so(name: str) -> None:
    signals = Signals((Signal(100.0, Unit.CELSIUS), None))
    before = power_on(evolve(factory(Model.M_7019R), type_codes=(TypeCode.K,) * 8), now=0.0)
    changed = before.store(**{name: CHANGES[name]})

    made = State(evolve(before.eeprom, **{name: CHANGES[name]}), before.ram)

    assert made == changed
    assert made.profile == changed.profile
    assert (fields(made, signals), words(made, signals)) == (fields(changed, signals), words(changed, signals))


def test_a_module_of_20_channels_that_was_changed_is_as_one_that_was_made_so() -> None:
    before = power_on(factory(Model.M_7017Z), now=0.0)
    changed = before.store(single_ended=True)

    made = power_on(evolve(before.eeprom, single_ended=True), now=0.0)

    assert made.profile == changed.profile
    assert fields(made, Signals()) == fields(changed, Signals())


@pytest.mark.parametrize("now", [float("nan"), float("inf"), 10**400])
def test_a_time_that_is_not_finite_is_refused(now: float) -> None:
    state = power_on(factory(Model.M_7017mC_16), now=0.0)

    with pytest.raises(InvalidValueError, match="now cannot be"):
        power_on(state.eeprom, now=now)
    with pytest.raises(InvalidValueError, match="now cannot be"):
        step(state, b"$012\r", Signals(), now)


@pytest.mark.parametrize("value", [float("nan"), float("inf"), 10**400, True, "1"])
def test_a_signal_is_a_finite_number(value: Any) -> None:
    with pytest.raises(InvalidValueError, match="value cannot be"):
        Signal(value, Unit.VOLT)
    with pytest.raises(InvalidValueError, match="cold_junction cannot be"):
        Signals(cold_junction=value)


@pytest.mark.parametrize("channels", [[Signal(1.0, Unit.VOLT)], (1.0,), None])
def test_signals_are_a_tuple_of_signals_and_open_wires(channels: Any) -> None:
    with pytest.raises(InvalidValueError, match="channels cannot be"):
        Signals(channels)


def test_a_signal_has_a_unit() -> None:
    with pytest.raises(InvalidValueError, match=r"unit cannot be 'V': a member of Unit: MILLIVOLT, VOLT, .*CELSIUS$"):
        Signal(1.0, "V")  # type: ignore[arg-type]


def test_a_signal_is_on_its_channel() -> None:
    signals = Signals.of(Unit.VOLT, 1.0, 2.0)

    assert [Signal(1.0, Unit.VOLT), Signal(2.0, Unit.VOLT)] == [signals.channel(number) for number in (0, 1)]


def test_nothing_is_on_a_channel_that_is_not_there() -> None:
    signals = Signals.of(Unit.VOLT, 1.0)

    assert [signals.channel(number) for number in (-1, 1, 10**30)] == [OPEN_WIRE] * 3


def test_the_count_of_host_watchdog_time_outs_ends_where_its_register_does() -> None:
    eeprom = evolve(
        factory(Model.M_7018), host_watchdog_enabled=True, host_watchdog_timeout=1, host_watchdog_timeouts=0xFFFF
    )

    later = advance(power_on(eeprom, now=0.0), Signals(), 1.0)

    assert later.eeprom.host_watchdog_timed_out
    assert later.eeprom.host_watchdog_timeouts == 0xFFFF
