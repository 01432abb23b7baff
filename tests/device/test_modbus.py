"""Modules that speak Modbus: the same facts as by DCON, silence, exceptions, the whole map of every model."""

from collections.abc import Callable
from typing import Any

import pytest
from attrs import evolve

from i7000 import (
    BaudRate,
    CharacterFormat,
    CjcUpdate,
    Filter,
    Firmware,
    LineSettings,
    ModbusDataFormat,
    Model,
    Protocol,
    ReportSettings,
    TypeCode,
    dcon,
    modbus,
    series,
)
from i7000.device import power_on
from i7000.modbus import Access, ExceptionCode, ExceptionResponse
from tests.device.driver import Bench, bench

M_MODELS = sorted(series("M-7017", "M-7018", "M-7019"), key=lambda model: model.value)
ADDRESS, VALUE = ExceptionCode.ILLEGAL_DATA_ADDRESS, ExceptionCode.ILLEGAL_DATA_VALUE

each_model = pytest.mark.parametrize("model", M_MODELS, ids=lambda model: model.value)


def rtu(model: Model, firmware: str | None = None, **stored: Any) -> Bench:
    return bench(model, firmware, **{"protocol": Protocol.MODBUS_RTU} | stored)


def by_dcon(module: Bench, command: str) -> str | None:
    """What the same module says to a DCON command."""
    eeprom = evolve(module.state.eeprom, protocol=Protocol.DCON)
    ram = evolve(module.state.ram, protocol=Protocol.DCON)
    return Bench(evolve(power_on(eeprom, now=module.now), ram=ram), module.signals, module.now).say(command)


# --- one fact, several doors ------------------------------------------------------------------------------------------

A_LINE = LineSettings(BaudRate.BAUD_19200, CharacterFormat.E81)

TWINS: dict[str, tuple[Model, Any, Any, str, str]] = {
    "mask by 46h": (
        Model.M_7017, modbus.SetChannelMask(1, 0x3A), modbus.ReadChannelMask(1), "$016", "!013A",
    ),
    "type by 46h": (
        Model.M_7019R, modbus.SetTypeCode(1, 5, 0x16), modbus.ReadTypeCode(1, 5), "$018C5", "!01C5R16",
    ),
    "type of all by 46h": (
        Model.M_7017, modbus.SetTypeCode(1, 0, 0x09), modbus.ReadTypeCode(1, 0), "$012", "!01090600",
    ),
    "filter by 46h": (
        Model.M_7018, modbus.SetMiscellaneousSettings(1, 0x80), modbus.ReadMiscellaneousSettings(1), "$012",
        "!01050680",
    ),
    "fast mode by 46h": (
        Model.M_7017R, modbus.SetMiscellaneousSettings(1, 0x20), modbus.ReadMiscellaneousSettings(1), "$012",
        "!01080620",
    ),
    "module offset by 46h": (
        Model.M_7018, modbus.SetCjcOffset(1, 0, -0x10), modbus.ReadCjcOffset(1, 0), "$019", "!01-0010",
    ),
    "CJC by 46h": (
        Model.M_7018, modbus.SetCjcEnabled(1, enabled=False), modbus.ReadCjcEnabled(1), "~01C", "!010",
    ),
    "update by 46h": (
        Model.M_7019R, modbus.SetCjcUpdate(1, CjcUpdate.STOPPED), modbus.ReadCjcUpdate(1), "$01A", "!010",
    ),
}  # fmt: skip


@pytest.mark.parametrize(("model", "setter", "getter", "command", "answer"), TWINS.values(), ids=TWINS)
def test_a_setting_of_function_46h_is_read_by_it_and_by_dcon(
    model: Model, setter: Any, getter: Any, command: str, answer: str
) -> None:
    module = rtu(model)

    result = module.ask(setter)
    told = module.ask(getter)

    assert result.result == 0
    name = next(
        name for name in ("mask", "type_code", "settings", "offset", "enabled", "update") if hasattr(told, name)
    )
    assert getattr(told, name) == getattr(setter, name)
    assert by_dcon(module, command) == answer


ROWS: dict[str, tuple[Model, str, Any, str, str]] = {
    "40257": (Model.M_7019R, "type_code", (TypeCode.K, *[TypeCode.V_10] * 7), "$018C0", "!01C0R0F"),
    "40486": (Model.M_7018, "line_settings", A_LINE, "$012", "!01058700"),
    "40487": (Model.M_7018, "module_type_code", TypeCode.K, "$012", "!010F0600"),
    "40489": (Model.M_7017, "host_watchdog_timeout", 10.0, "~012", "!01064"),
    "40490": (Model.M_7017, "channel_mask", 0x3A, "$016", "!013A"),
    "40491": (Model.M_7018, "module_cjc_offset", -0.16, "$019", "!01-0010"),
    "40493": (Model.M_7019Z, "cjc_update", CjcUpdate.ONCE, "$01A", "!012"),
    "00257": (Model.M_7017, "protocol", Protocol.DCON, "$01P", "!0110"),
    "00259": (Model.M_7017, "filter", Filter.REJECT_50_HZ, "$012", "!01080680"),
    "00261": (Model.M_7017, "host_watchdog_enabled", True, "~012", "!01100"),
    "00268": (Model.M_7018, "cjc_enabled", False, "~01C", "!010"),
    "00271": (Model.M_7017R, "fast_mode", True, "$012", "!01080620"),
    "00276": (Model.M_7019R, "open_wire_detection", False, "~01EO", "!010"),
    "00277": (Model.M_7017Z, "single_ended", True, "@01S", "!011"),
}


@pytest.mark.parametrize(("model", "name", "value", "command", "answer"), ROWS.values(), ids=ROWS)
def test_a_value_written_to_the_map_is_read_there_and_by_dcon(
    model: Model, name: str, value: Any, command: str, answer: str
) -> None:
    module = rtu(model)

    assert not isinstance(module.write(name, value), ExceptionResponse)
    assert module.read(name) == value
    assert by_dcon(module, command) == answer


def test_the_high_word_of_the_mask_is_for_the_single_ended_mode() -> None:
    module = rtu(Model.M_7017Z)

    assert module.read("channel_mask_high") == 0
    assert module.write("channel_mask_high", 1).exception_code == VALUE
    assert module.write("channel_mask", 0x400).exception_code == VALUE
    module.write("single_ended", True)
    assert module.read("channel_mask_high") == 0xF
    module.write("channel_mask_high", 0xA)
    module.write("channel_mask", 0x400)
    assert module.ask(modbus.ReadChannelMask(1)).mask == 0xA0400


@pytest.mark.parametrize(("model", "row"), [(Model.M_7018, "cjc_offset"), (Model.M_7019R, "temperature_offset")])
def test_channel_offsets_are_tenths_by_46h_and_by_the_map(model: Model, row: str) -> None:
    module = rtu(model)

    assert module.ask(modbus.SetCjcOffset(1, 0x81, 0xFF)).result == 0
    assert module.read(row)[:3] == (0, -0.1, 0)
    module.write(row, (12.7, -12.8, 0, 0, 0, 0, 0, 0))
    assert [module.ask(modbus.ReadCjcOffset(1, channel)).offset for channel in (0x80, 0x81, 0x87)] == [0x7F, 0x80, 0]
    assert module.ask(modbus.ReadCjcOffset(1, 0)).offset == 0


def test_cjc_offsets_of_the_7019_series_are_hundredths_of_their_own() -> None:
    module = rtu(Model.M_7019R)
    offsets = (40.96, -40.96, 0.01, 0, 0, 0, 0, -0.01)
    module.write("cjc_offset", offsets)

    assert module.read("cjc_offset") == offsets
    assert module.read("temperature_offset") == (0,) * 8


def test_different_types_are_ff_in_the_register_of_the_module() -> None:
    module = rtu(Model.M_7018R)
    module.ask(modbus.SetTypeCode(1, 1, 0x0F))

    assert module.read("module_type_code") == 0xFF


@pytest.mark.parametrize(
    ("model", "name"),
    [(Model.M_7017mC_16, b"\0\x70\x17\0"), (Model.M_7018, b"\0\x70\x18\0"), (Model.M_7019Z, b"\0\x70\x19\0")],
)
def test_the_name_is_that_of_the_series(model: Model, name: bytes) -> None:
    module = rtu(model)

    assert module.ask(modbus.ReadModuleName(1)).name == name
    assert module.read("module_name") == model.series


def test_the_firmware_is_three_bytes() -> None:
    module = rtu(Model.M_7017R, "B405")

    assert module.ask(modbus.ReadFirmwareVersion(1)) == modbus.FirmwareVersion(1, 0x0B, 4, 5)
    assert module.read("firmware_version") == Firmware("B4.5")


# --- address, line, protocol ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "change",
    [lambda module: module.ask(modbus.SetModuleAddress(1, 7)).result, lambda module: module.write("module_address", 7)],
    ids=["46h", "40485"],
)
def test_a_new_address_answers_at_once_the_change_from_the_old_one(change: Callable[[Bench], Any]) -> None:
    module = rtu(Model.M_7017)
    change(module)

    assert module.ask(modbus.ReadModuleName(1)) is None
    assert module.ask(modbus.ReadModuleName(7)) == modbus.ModuleName(7, b"\0\x70\x17\0")


def test_line_and_protocol_change_at_the_next_power_on_without_the_switch() -> None:
    module = rtu(Model.M_7018)

    answer = module.ask(modbus.SetCommunicationSettings(1, A_LINE, Protocol.DCON))

    assert answer == modbus.CommunicationSettingsResult(1, 0, 0)
    assert module.ask(modbus.ReadCommunicationSettings(1)) == modbus.CommunicationSettings(1, A_LINE, Protocol.DCON)
    assert module.state.ram.line_settings == LineSettings()
    module.power_cycle()
    assert module.state.ram.line_settings == A_LINE
    assert module.say("$01P") == "!0110"


@pytest.mark.parametrize(("value", "firmware"), [(0x0B, None), (0x3F, None), (0x86, "B3.0")])
def test_a_line_that_the_module_cannot_have_is_refused(value: int, firmware: str | None) -> None:
    module = rtu(Model.M_7018Z, firmware)
    before = module.state

    assert module.ask(modbus.WriteSingleRegister(1, 485, value)).exception_code == VALUE
    assert module.state == before


def test_the_response_delay_is_in_seconds_and_not_for_dcon() -> None:
    module = rtu(Model.M_7017)
    module.write("response_delay", 30)

    assert module.state.response_delay == 0.03
    module.power_cycle(init_switch=True)
    assert module.state.response_delay == 0.0


# --- the host watchdog and the reset status ---------------------------------------------------------------------------


def test_any_request_keeps_the_watchdog_from_timing_out_and_refused_ones_do_not() -> None:
    module = rtu(Model.M_7017)
    module.write("host_watchdog_timeout", 1.0)
    module.write("host_watchdog_enabled", True)
    for _ in range(3):
        module.wait(0.6)
        assert module.ask(modbus.ReadModuleName(1)) is not None
    module.wait(0.6)
    assert module.ask(modbus.ReadCoils(1, 0, 1)).exception_code == ADDRESS
    module.wait(0.6)

    assert module.read("host_watchdog_timed_out")
    assert not module.read("host_watchdog_enabled")
    assert module.read("host_watchdog_timeout_count") == 1


def test_writing_clears_the_time_out_and_its_count() -> None:
    module = rtu(Model.M_7017, host_watchdog_timed_out=True, host_watchdog_timeouts=3)

    assert module.ask(modbus.WriteSingleCoil(1, 269, False)).exception_code == VALUE
    assert module.read("host_watchdog_timed_out")
    module.write("host_watchdog_timed_out", True)
    assert not module.read("host_watchdog_timed_out")
    assert module.ask(modbus.WriteSingleRegister(1, 491, 1)).exception_code == VALUE
    assert module.read("host_watchdog_timeout_count") == 3
    module.write("host_watchdog_timeout_count", 0)
    assert module.read("host_watchdog_timeout_count") == 0


def test_the_reset_status_is_set_once_after_power_on() -> None:
    module = rtu(Model.M_7017)

    assert module.read("host_watchdog_enabled") is False
    assert [module.read("reset_status"), module.read("reset_status")] == [True, False]
    module.power_cycle()
    assert module.read("reset_status") is True


def test_the_calibration_of_the_factory_can_be_loaded_and_not_be_read() -> None:
    module = rtu(Model.M_7019R)

    assert module.write("load_factory_calibration", True) == modbus.SingleCoilWritten(1, 271, True)
    assert module.ask(modbus.WriteSingleCoil(1, 271, False)).exception_code == VALUE
    assert module.ask(modbus.ReadCoils(1, 271, 1)).exception_code == ADDRESS


# --- the whole map ----------------------------------------------------------------------------------------------------


@each_model
def test_every_row_is_read_and_what_is_read_can_be_written(model: Model) -> None:
    module = rtu(model)
    for row in modbus.RegisterMap(module.state.profile):
        if row.access is Access.WRITE:
            continue
        value = module.read(row.number)

        assert not isinstance(value, ExceptionResponse), row
        if row.access is Access.READ_WRITE and row.name != "host_watchdog_timed_out":
            assert not isinstance(module.write(row.number, value), ExceptionResponse), row
            if row.name != "rtc_epoch" and not row.name.startswith("rtc_"):
                assert module.read(row.number) == value


@pytest.mark.no_cover
@each_model
def test_no_item_outside_the_map_is_read_or_written(model: Model) -> None:
    module = rtu(model)
    registers = modbus.RegisterMap(module.state.profile)
    there = {(row.area, row.address + at) for row in registers for at in range(row.count)}
    readers: dict[modbus.Area, Any] = {
        modbus.Area.COIL: modbus.ReadCoils,
        modbus.Area.DISCRETE_INPUT: modbus.ReadDiscreteInputs,
        modbus.Area.HOLDING_REGISTER: modbus.ReadHoldingRegisters,
        modbus.Area.INPUT_REGISTER: modbus.ReadInputRegisters,
    }
    functions = (
        {modbus.Area.DISCRETE_INPUT}
        if modbus.ReadDiscreteInputs.availability in module.state.profile.refused
        else set()
    )
    before = module.state
    for area, reader in readers.items():
        for address in range(1200):
            if (area, address) not in there:
                code = ExceptionCode.ILLEGAL_FUNCTION if area in functions else ADDRESS
                assert module.ask(reader(1, address, 1)).exception_code == code
    for address in range(1200):
        if (modbus.Area.HOLDING_REGISTER, address) not in there:
            assert module.ask(modbus.WriteSingleRegister(1, address, 0)).exception_code == ADDRESS
    assert module.state == before


def test_several_rows_are_read_at_once_and_holes_between_them_are_not() -> None:
    module = rtu(Model.M_7018)

    assert module.ask(modbus.ReadHoldingRegisters(1, 484, 8)).values == (1, 6, 5, 0, 0, 0xFF, 0, 0)
    assert module.ask(modbus.ReadCoils(1, 258, 3)).values == (False, False, False)
    assert module.ask(modbus.ReadCoils(1, 260, 8)).exception_code == VALUE
    assert module.ask(modbus.ReadCoils(1, 260, 2)).exception_code == VALUE
    assert module.ask(modbus.ReadCoils(1, 266, 2)).exception_code == ADDRESS


def test_a_write_is_made_as_a_whole_or_not_at_all() -> None:
    module = rtu(Model.M_7017)
    before = module.state

    assert module.ask(modbus.WriteMultipleRegisters(1, 487, (5, 256))).exception_code == VALUE
    assert module.ask(modbus.WriteMultipleRegisters(1, 489, (5, 0, 0))).exception_code == VALUE
    assert module.ask(modbus.WriteMultipleRegisters(1, 487, (5, 6, 7, 8))).exception_code == VALUE
    assert module.state == before
    assert module.ask(modbus.WriteMultipleRegisters(1, 487, (5, 6, 7))) == modbus.MultipleRegistersWritten(1, 487, 3)
    assert module.ask(modbus.ReadHoldingRegisters(1, 487, 3)).values == (5, 6, 7)
    assert module.ask(modbus.WriteMultipleCoils(1, 268, (True, True))) == modbus.MultipleCoilsWritten(1, 268, 2)
    assert module.read("modbus_data_format") is ModbusDataFormat.ENGINEERING


def test_the_high_byte_of_an_offset_of_one_byte_is_zero() -> None:
    module = rtu(Model.M_7018)

    assert module.ask(modbus.WriteSingleRegister(1, 352, 0x0180)).exception_code == VALUE
    assert module.ask(modbus.WriteSingleRegister(1, 352, 0x0080)) == modbus.SingleRegisterWritten(1, 352, 0x80)


def test_a_type_that_the_module_does_not_have_cannot_be_written() -> None:
    module = rtu(Model.M_7019R)

    assert module.ask(modbus.WriteSingleRegister(1, 256, 0x1B)).exception_code == VALUE
    assert module.ask(modbus.WriteSingleRegister(1, 256, 0x0F)) == modbus.SingleRegisterWritten(1, 256, 0x0F)


# --- silence and exceptions -------------------------------------------------------------------------------------------


def test_a_broadcast_is_done_and_not_answered() -> None:
    module = rtu(Model.M_7017)

    assert module.ask(modbus.WriteSingleRegister(0, 487, 5)) is None
    assert module.read("response_delay") == 5
    assert module.ask(modbus.WriteSingleRegister(0, 487, 31)) is None
    assert module.read("response_delay") == 5


@pytest.mark.parametrize(
    "body",
    [
        "",
        "01",
        "02 46 00",
        "00 46 00",
        "00 04 0000 0001",
        "00 63",
        "F8 04 0000 0001",
        "01 00",
        "01 80",
        "00 05 010C 0001",
    ],
)
def test_what_is_not_for_the_module_is_not_answered(body: str) -> None:
    module = rtu(Model.M_7017)
    before = module.state

    assert module.send(modbus.seal(bytes.fromhex(body))) is None
    assert module.state == before


def test_a_wrong_crc_is_not_answered() -> None:
    module = rtu(Model.M_7017)

    assert module.send(bytes.fromhex("010400000008f1cd")) is None
    assert module.send(b"") is None
    assert module.send(b"\x01" * 300) is None
    assert module.send(b"$01M\r") is None


@pytest.mark.parametrize(
    ("firmware", "body", "code"),
    [
        (None, "01 63", 1), (None, "01 83 00", 1), (None, "01 46", 3), (None, "01 46 63", 2), (None, "01 46 00 00", 3),
        (None, "01 46 2F", 2), (None, "01 46 2F 00", 2), (None, "01 02 0080 0000", 1), (None, "01 04 0000 0000", 3),
        (None, "01 03 0000 007E", 3), (None, "01 05 010C 0001", 3), ("B3.4", "01 03 01E4 0001", 1),
        ("B3.4", "01 03 01E4", 1), ("B3.4", "01 04 0000 0008", 0),
    ],
)  # fmt: skip
def test_what_cannot_be_done_is_answered_with_an_exception(firmware: str | None, body: str, code: int) -> None:
    module = rtu(Model.M_7018, firmware)
    before = module.state
    frame = bytes.fromhex(body)

    answer = module.send(modbus.seal(frame))

    assert answer is not None
    assert module.state == before
    if code:
        assert answer == modbus.seal(bytes((1, frame[1] | 0x80, code)))
    else:
        assert answer[1] == frame[1]


def test_a_checksum_that_is_stored_for_dcon_means_nothing_to_modbus() -> None:
    module = rtu(Model.M_7017, report_settings=ReportSettings(checksum=True))

    assert module.ask(modbus.ReadMiscellaneousSettings(1)) == modbus.MiscellaneousSettings(1, 0)
    module.write("protocol", Protocol.DCON)
    module.power_cycle()
    assert module.send(dcon.seal(b"$01M", checksum=True)) is not None
