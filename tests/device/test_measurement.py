"""What a module makes of its signals, seen through both protocols."""

from typing import Any

import pytest

from i7000 import (
    CjcUpdate,
    DataFormat,
    InvalidValueError,
    ModbusDataFormat,
    Model,
    Protocol,
    ReportSettings,
    TypeCode,
    Unit,
    modbus,
)
from i7000.device import OPEN_WIRE, Signal, Signals
from tests.device.driver import Bench, bench
from tests.spec.lint import rows

ENGINEERING, PERCENT, HEX = DataFormat.ENGINEERING, DataFormat.PERCENT, DataFormat.HEX


def reads(
    model: Model, type_code: TypeCode, signal: Signal | None, data_format: DataFormat = ENGINEERING, **stored: Any
) -> str | None:
    """What channel 0 reads in a data format, by DCON."""
    report = ReportSettings(data_format, fast_mode=bool(stored.pop("fast_mode", False)))
    signals = Signals((signal,))
    return bench(model, signals=signals, type_code=type_code, report_settings=report, **stored).say("#010")


def words(module: Bench) -> tuple[int, ...]:
    """What the registers of the readings hold."""
    response = module.ask(modbus.ReadInputRegisters(1, 0, module.state.profile.channels))
    values: tuple[int, ...] = response.values
    return values


@pytest.mark.parametrize(
    ("model", "type_code", "signal", "text", "percent", "word"),
    [
        (Model.I_7018, TypeCode.MV_15, Signal(15, Unit.MILLIVOLT), "+15.000", "+100.00", "7FFF"),
        (Model.I_7018, TypeCode.MV_15, Signal(-0.015, Unit.VOLT), "-15.000", "-100.00", "8000"),
        (Model.I_7018, TypeCode.V_2_5, Signal(1250, Unit.MILLIVOLT), "+1.2500", "+050.00", "4000"),
        (Model.I_7018, TypeCode.MA_20_06, Signal(10, Unit.MILLIAMPERE), "+10.000", "+050.00", "4000"),
        (Model.I_7018, TypeCode.MA_20_06, Signal(1.25, Unit.VOLT), "+10.000", "+050.00", "4000"),
        (Model.I_7018, TypeCode.V_2_5, Signal(20, Unit.MILLIAMPERE), "+2.5000", "+100.00", "7FFF"),
        (Model.I_7017, TypeCode.V_10, Signal(-10, Unit.VOLT), "-10.000", "-100.00", "8000"),
        (Model.I_7017, TypeCode.MA_4_20, Signal(12, Unit.MILLIAMPERE), "+12.000", "+050.00", "8000"),
        (Model.I_7017, TypeCode.MA_0_20, Signal(20, Unit.MILLIAMPERE), "+20.000", "+100.00", "FFFF"),
        (Model.I_7017R_A5, TypeCode.V_150, Signal(-150, Unit.VOLT), "-150.00", "-100.00", "8000"),
        (Model.I_7018, TypeCode.J, Signal(-210, Unit.CELSIUS), "-210.00", "-027.63", "DCA2"),
        (Model.I_7018, TypeCode.K, Signal(1372, Unit.CELSIUS), "+1372.0", "+100.00", "7FFF"),
        (Model.I_7018P, TypeCode.M, Signal(100, Unit.CELSIUS), "+100.00", "+050.00", "4000"),
        (Model.M_7017RMS, TypeCode.V_10, Signal(-2, Unit.VOLT), "+02.000", "+020.00", "1999"),
        # out of range
        (Model.I_7018, TypeCode.K, Signal(1373, Unit.CELSIUS), "+9999.9", "+999.99", "7FFF"),
        (Model.I_7018, TypeCode.K, Signal(-271, Unit.CELSIUS), "-9999.9", "-999.99", "8000"),
        (Model.I_7018, TypeCode.V_2_5, Signal(3, Unit.VOLT), "+9999.9", "+999.99", "7FFF"),
        (Model.I_7018, TypeCode.V_2_5, Signal(-3, Unit.VOLT), "-9999.9", "-999.99", "8000"),
        (Model.I_7017, TypeCode.MA_4_20, Signal(3.9, Unit.MILLIAMPERE), "-9999.9", "-999.99", "0000"),
        (Model.I_7017, TypeCode.MA_4_20, Signal(21, Unit.MILLIAMPERE), "+9999.9", "+999.99", "FFFF"),
        (Model.I_7017, TypeCode.MA_0_20, Signal(-1, Unit.MILLIAMPERE), "-9999.9", "-999.99", "0000"),
        # what is not meant for the type
        (Model.I_7018, TypeCode.K, Signal(0, Unit.VOLT), "+0025.0", "+001.82", "0255"),
        (Model.I_7018, TypeCode.K, Signal(1, Unit.VOLT), "+9999.9", "+999.99", "7FFF"),
        (Model.I_7018, TypeCode.K, Signal(-20, Unit.MILLIAMPERE), "-9999.9", "-999.99", "8000"),
        (Model.I_7018, TypeCode.V_2_5, Signal(1000, Unit.CELSIUS), "+0.0000", "+000.00", "0000"),
        # nothing connected
        (Model.I_7018, TypeCode.V_2_5, OPEN_WIRE, "+0.0000", "+000.00", "0000"),
        (Model.I_7017, TypeCode.MA_4_20, OPEN_WIRE, "-9999.9", "-999.99", "0000"),
        (Model.I_7018, TypeCode.K, OPEN_WIRE, "+0025.0", "+001.82", "0255"),
        (Model.I_7018R, TypeCode.K, OPEN_WIRE, "+9999.9", "+999.99", "7FFF"),
        (Model.I_7018BL, TypeCode.K, OPEN_WIRE, "+9999.9", "+999.99", "7FFF"),
    ],
)
def test_a_signal_reads_in_every_data_format(  # noqa: PLR0913, PLR0917 - a table
    model: Model, type_code: TypeCode, signal: Signal | None, text: str, percent: str, word: str
) -> None:
    found = [reads(model, type_code, signal, data_format) for data_format in (ENGINEERING, PERCENT, HEX)]

    assert [f">{text}", f">{percent}", f">{word}"] == found


@pytest.mark.parametrize("row", rows("full_scale"), ids=lambda row: f"{row['code']}-{row['format']}")
def test_full_scale_reads_as_printed(row: dict[str, str]) -> None:
    type_code = TypeCode(int(row["code"], 16))
    model = next(
        model for model in Model if type_code in model.type_codes and model.suffix not in ("RMS", "mC-16", "-16")
    )
    data_format = DataFormat[row["format"].upper()]

    low, high = (
        reads(model, type_code, Signal(end, type_code.unit), data_format)
        for end in (type_code.minimum, type_code.maximum)
    )

    assert high == f">{row['plus_fs']}"
    if (row["code"], row["format"]) in (("0F", "hex"), ("15", "hex")):  # printed one count away (E51)
        assert int(str(low)[1:], 16) == int(row["minus_fs"], 16) - 1
    else:
        assert low == f">{row['minus_fs']}"


@pytest.mark.parametrize(
    ("type_code", "value", "text"),
    [
        (TypeCode.V_10, 10.0, "+09.995"),
        (TypeCode.V_10, -10.0, "-10.000"),
        (TypeCode.V_10, 0.002, "+00.000"),
        (TypeCode.V_10, 0.003, "+00.005"),
        (TypeCode.V_10, 11.0, "+9999.9"),
        (TypeCode.MA_4_20, 20.0, "+19.996"),
        (TypeCode.MA_4_20, 4.0, "+04.000"),
    ],
)
def test_the_fast_mode_has_12_bits(type_code: TypeCode, value: float, text: str) -> None:
    assert f">{text}" == reads(Model.I_7017F, type_code, Signal(value, type_code.unit), fast_mode=True)


@pytest.mark.parametrize(
    ("data_format", "over", "under"),
    [(ENGINEERING, "+9999", "-0000"), (PERCENT, "+9999", "-0000"), (HEX, "+9999", "-0000")],
)
def test_old_firmware_has_short_sentinels_in_every_format(data_format: DataFormat, over: str, under: str) -> None:
    signals = Signals.of(Unit.CELSIUS, 5000, -5000, 25)
    report = ReportSettings(data_format)
    module = bench(Model.I_7018, "B1.4", signals=signals, type_code=TypeCode.K, report_settings=report)

    assert str(module.say("#01")).startswith(f">{over}{under}")
    assert module.say("#010") == f">{over}"


# --- disabled channels ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("data_format", "width"), [(ENGINEERING, 7), (PERCENT, 7), (HEX, 4)])
def test_a_disabled_channel_is_blanks_on_the_7019_series(data_format: DataFormat, width: int) -> None:
    signals = Signals.of(Unit.VOLT, *[1.0] * 8)
    module = bench(Model.I_7019R, signals=signals, report_settings=ReportSettings(data_format), channel_mask=0xFD)

    report = str(module.say("#01"))[1:]

    assert [channel for channel in range(8) if report[channel * width :][:width].isspace()] == [1]
    assert module.say("#011") == ">" + " " * width


def test_a_disabled_channel_is_0_elsewhere() -> None:
    signals = Signals.of(Unit.MILLIAMPERE, 12, 12)
    stored: dict[str, Any] = {"signals": signals, "type_code": TypeCode.MA_4_20, "channel_mask": 0x01}

    assert str(bench(Model.I_7017, **stored).say("#01")).startswith(">+12.000+04.000")
    assert bench(Model.I_7017, **stored).say("$01A") == ">8000" + "0000" * 7


# --- ranges -----------------------------------------------------------------------------------------------------------

RANGES = Signals.of(Unit.MILLIAMPERE, 12, 3, 21, 25, -30)


def test_diagnostics_show_enabled_channels_that_are_out_of_range_or_open() -> None:
    module = bench(Model.M_7019R, signals=RANGES, type_code=TypeCode.MA_20_0D, channel_mask=0xF7)
    module.say("$017C5R0F")

    assert module.say("$01B") == "!0134"
    module.say("~01EO0")
    assert module.say("$01B") == "!0114"


@pytest.mark.parametrize(
    ("model", "type_code", "bits"),
    [
        (Model.M_7017, TypeCode.MA_4_20, (1, 2, 3, 4, 5, 6, 7)),
        (Model.M_7017, TypeCode.MA_0_20, (2, 3, 4)),
        (Model.M_7017, TypeCode.MA_20_0D, ()),
        (Model.M_7019R, TypeCode.MA_20_0D, (2, 3, 4)),
        (Model.M_7019R, TypeCode.K, (0, 1, 2, 3, 4, 5, 6, 7)),
    ],
)
def test_range_bits_are_for_unipolar_currents_only_but_on_the_7019_series(
    model: Model, type_code: TypeCode, bits: tuple[int, ...]
) -> None:
    module = bench(model, signals=RANGES, type_code=type_code, protocol=Protocol.MODBUS_RTU)

    status = module.ask(modbus.ReadDiscreteInputs(1, 128, 8)).values

    assert bits == tuple(channel for channel, bit in enumerate(status) if bit)
    assert status == module.ask(modbus.ReadCoils(1, 128, 8)).values


# --- Modbus words -----------------------------------------------------------------------------------------------------


def test_registers_are_in_the_modbus_data_format_whatever_the_dcon_one_is() -> None:
    signals = Signals.of(Unit.VOLT, 10.0, -10.0, 5.0, 12.0, -12.0)
    report = ReportSettings(DataFormat.PERCENT)
    module = bench(
        Model.M_7017, signals=signals, report_settings=report, protocol=Protocol.MODBUS_RTU, channel_mask=0xFB
    )

    assert words(module)[:5] == (0x7FFF, 0x8000, 0, 0x7FFF, 0x8000)
    module.write("modbus_data_format", ModbusDataFormat.ENGINEERING)
    assert words(module)[:5] == (10000, 0x10000 - 10000, 0, 32767, 32768)


def test_thermocouples_out_of_range_have_the_words_of_the_manual() -> None:
    signals = Signals.of(Unit.CELSIUS, 1372.1, -270.1, 100.0)
    module = bench(Model.M_7018, signals=signals, type_code=TypeCode.K, protocol=Protocol.MODBUS_RTU)

    assert words(module)[:2] == (0x7FFF, 0x8000)
    module.write("modbus_data_format", ModbusDataFormat.ENGINEERING)
    assert words(module)[:3] == (32767, 32768, 1000)


def test_the_m_7018_16_has_registers_of_whole_degrees() -> None:
    signals = Signals.of(Unit.CELSIUS, 99.6, -99.6, 5000, -5000, 100)
    module = bench(
        Model.M_7018_16, signals=signals, type_code=TypeCode.K, protocol=Protocol.MODBUS_RTU, channel_mask=0xFFEF
    )

    assert module.read("temperature")[:5] == (100, -100, 32767, -32768, 0)
    module.write("module_type_code", TypeCode.V_2_5)
    assert module.read("temperature") == (0,) * 16


# --- the cold junction ------------------------------------------------------------------------------------------------

HOT = Signals.of(Unit.CELSIUS, *[100.0] * 10, cold_junction=30.0)


@pytest.mark.parametrize(("model", "told"), [(Model.M_7018, 31.0), (Model.M_7019R, 30.0)])
def test_the_offset_is_in_the_temperature_of_the_7018_series_only(model: Model, told: float) -> None:
    module = bench(model, signals=HOT, cjc_offset=100)

    assert module.say("$013") == f">+{told:06.1f}"
    modbus_module = bench(model, signals=HOT, cjc_offset=100, protocol=Protocol.MODBUS_RTU)
    assert modbus_module.read("cjc_temperature") == told


@pytest.mark.parametrize(
    ("stored", "text"),
    [
        ({}, "+0100.0"),
        ({"cjc_enabled": False}, "+0070.0"),
        ({"cjc_offset": -250}, "+0097.5"),
        ({"cjc_offset": -250, "cjc_enabled": False}, "+0070.0"),
        ({"channel_offsets": (15,) * 8}, "+0101.5"),
        ({"channel_cjc_offsets": (150,) * 8}, "+0101.5"),
        ({"channel_offsets": (15,) * 8, "cjc_enabled": False}, "+0071.5"),
    ],
)
def test_offsets_and_compensation_move_a_thermocouple_of_the_7019_series(stored: dict[str, Any], text: str) -> None:
    assert bench(Model.I_7019R, signals=HOT, type_code=TypeCode.K, **stored).say("#010") == f">{text}"


@pytest.mark.parametrize(("enabled", "text"), [(True, "+0101.5"), (False, "+0070.0")])
def test_channel_offsets_of_the_7018_series_are_of_the_cold_junction(enabled: bool, text: str) -> None:  # noqa: FBT001
    stored: dict[str, Any] = {"channel_offsets": (15,) * 8, "cjc_enabled": enabled}

    assert bench(Model.I_7018, signals=HOT, type_code=TypeCode.K, **stored).say("#010") == f">{text}"


def test_a_voltage_has_no_cold_junction() -> None:
    signals = Signals.of(Unit.VOLT, 1.0, cold_junction=30.0)
    offsets = (10,) * 8

    assert bench(Model.I_7019R, signals=signals, cjc_offset=100, channel_offsets=offsets).say("#010") == ">+01.000"


def test_a_stopped_update_keeps_the_temperature_of_when_it_was_stopped() -> None:
    module = bench(Model.I_7019R, signals=HOT, type_code=TypeCode.K)
    module.say("$01A0")
    module.signals = Signals.of(Unit.CELSIUS, 100.0, cold_junction=40.0)

    assert [module.say("$013"), module.say("#010")] == [">+0030.0", ">+0090.0"]
    module.say("$01A0")
    assert module.say("$013") == ">+0030.0"
    module.say("$01A2")
    assert [module.say("$013"), module.say("$01A")] == [">+0040.0", f"!01{CjcUpdate.ONCE:d}"]
    module.signals = HOT
    assert module.say("$013") == ">+0040.0"
    module.say("$01A1")
    assert module.say("$013") == ">+0030.0"


# --- signals ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("value", [float("nan"), float("inf"), -float("inf")])
def test_a_signal_is_finite(value: float) -> None:
    with pytest.raises(InvalidValueError):
        Signal(value, Unit.VOLT)


@pytest.mark.parametrize("value", [float("nan"), 201.0, -201.0])
def test_a_cold_junction_is_where_modules_can_be(value: float) -> None:
    with pytest.raises(InvalidValueError):
        Signals(cold_junction=value)


def test_a_disabled_channel_of_old_firmware_is_0_too() -> None:
    module = bench(Model.I_7018, "B1.4", type_code=TypeCode.K, channel_mask=0xFE)

    assert str(module.say("#01")).startswith(">+0000.0+0025.0")
