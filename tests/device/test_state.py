"""What modules remember: from the factory, and what none can have stored."""

from types import FunctionType, ModuleType
from typing import Any

import pytest
from attrs import evolve, exceptions

from i7000 import (
    BaudRate,
    DataFormat,
    EncodeError,
    Firmware,
    LineSettings,
    Model,
    Profile,
    Protocol,
    ReportSettings,
    TypeCode,
    Unit,
    device,
)
from i7000.device import OPEN_WIRE, Signal, Signals, factory, power_on, step
from i7000.device.state import NEWEST
from i7000.models import AVAILABILITY, CONFIGURABLE


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
    gates = [*(it.gates for it in AVAILABILITY.values()), CONFIGURABLE, *(model.type_codes for model in Model)]
    firmwares = [firmware for gate in gates for firmware in dict(gate).values() if firmware]  # type: ignore[call-overload]

    assert max(firmwares) <= NEWEST
    assert max(model.character_formats_from for model in Model) <= NEWEST


@pytest.mark.parametrize(
    ("model", "changes"),
    [
        (Model.I_7018, {"address": 256}),
        (Model.I_7018, {"address": -1}),
        (Model.I_7018, {"name": ""}),
        (Model.I_7018, {"name": "7018ABC"}),
        (Model.I_7018, {"name": "70$8"}),
        (Model.I_7018, {"protocol": Protocol.MODBUS_RTU}),
        (Model.I_7018, {"type_codes": (TypeCode.K,) * 7}),
        (Model.I_7018, {"type_codes": (TypeCode.V_10,) * 8}),
        (Model.I_7018, {"type_codes": (TypeCode.K, *[TypeCode.J] * 7)}),
        (Model.I_7017Z, {"type_codes": (*[TypeCode.V_10] * 19, TypeCode.K)}),
        (Model.I_7018, {"channel_mask": 0x100}),
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
    with pytest.raises(EncodeError):
        evolve(factory(model), **changes)


def test_a_state_is_frozen_and_keeps_its_profile() -> None:
    state = power_on(factory(Model.M_7017Z, Firmware("B3.9")), now=0.0)

    with pytest.raises(exceptions.FrozenInstanceError):
        state.ram = state.ram  # type: ignore[misc]
    assert state.store(single_ended=True).profile.channels == 20
    assert state.store(report_settings=ReportSettings(DataFormat.HEX)).profile.data_format is DataFormat.HEX
    assert state.keep(checksum=True).profile.checksum
    assert state.keep(checksum=True).store(address=5).profile.checksum
    assert state.keep(line_settings=LineSettings(BaudRate.BAUD_1200)).profile == state.profile


@pytest.mark.parametrize("now", [float("nan"), float("inf"), 10**400])
def test_a_time_that_is_not_finite_is_refused(now: float) -> None:
    state = power_on(factory(Model.M_7017mC_16), now=0.0)

    with pytest.raises(EncodeError, match="now cannot be"):
        power_on(state.eeprom, now=now)
    with pytest.raises(EncodeError, match="now cannot be"):
        step(state, b"$012\r", Signals(), now)


@pytest.mark.parametrize("value", [float("nan"), float("inf"), 10**400, True, "1"])
def test_a_signal_is_a_finite_number(value: Any) -> None:
    with pytest.raises(EncodeError, match="value cannot be"):
        Signal(value, Unit.VOLT)
    with pytest.raises(EncodeError, match="cold_junction cannot be"):
        Signals(cold_junction=value)


def test_nothing_is_on_a_channel_that_is_not_there() -> None:
    signals = Signals.of(Unit.VOLT, 1.0)

    assert [signals.channel(number) for number in (-1, 1, 10**30)] == [OPEN_WIRE] * 3
