"""Registers by name: what is found, read, written and told, in which units, and what is refused."""

from typing import Any

import pytest
from attrs import evolve

from i7000 import (
    BaudRate,
    CharacterFormat,
    CjcUpdate,
    DecodeError,
    EncodeError,
    Fault,
    Filter,
    Firmware,
    InvalidValueError,
    LineSettings,
    LogCommand,
    ModbusDataFormat,
    Model,
    Profile,
    Protocol,
    Reading,
    Status,
    TypeCode,
    Unit,
    modbus,
)
from i7000.modbus import Access, Area, Kind, Register, RegisterMap, WordOrder

MODBUS_MODELS = [model for model in Model if Protocol.MODBUS_RTU in model.protocols]
CLEARED_BY = {"host_watchdog_timeout_count": 0, "host_watchdog_timed_out": 1}
PROFILES = [*map(Profile, MODBUS_MODELS), Profile(Model.M_7017Z, single_ended=True)]
M_7017 = RegisterMap(Profile(Model.M_7017))
UNKNOWN_TYPES = RegisterMap(Profile(Model.M_7017, type_codes=()))
M_7017Z = RegisterMap(Profile(Model.M_7017Z))
M_7018 = RegisterMap(Profile(Model.M_7018))
M_7019R = RegisterMap(Profile(Model.M_7019R))
LOGGER = RegisterMap(Profile(Model.M_7017mC_16))

every_map = pytest.mark.parametrize(
    "registers",
    [RegisterMap(profile) for profile in PROFILES],
    ids=lambda it: it.profile.model.value + " single-ended" * it.profile.single_ended,
)


# --- find -------------------------------------------------------------------------------------------------------------


@every_map
def test_a_row_is_found_by_its_name_its_numbers_and_its_addresses(registers: RegisterMap) -> None:
    for row in registers:
        assert row == registers.find(row.name, row.area)
        for at in (row.address, row.address + row.count - 1):
            number = f"{row.area.value}{at + 1:04d}"
            assert row == registers.find(number)
            assert row == registers.find(at, row.area)
            if row.area is not Area.COIL:
                assert row == registers.find(int(number))
            if row.area is Area.HOLDING_REGISTER:
                assert row == registers.find(at)


@every_map
def test_a_name_finds_the_input_of_two_rows(registers: RegisterMap) -> None:
    for row in registers:
        twins = [it.area for it in registers if it.name == row.name]
        inputs = [area for area in twins if area in (Area.DISCRETE_INPUT, Area.INPUT_REGISTER)]

        assert registers.find(row.name).area is (inputs or twins)[0]


@pytest.mark.parametrize(
    "key",
    [
        "protocols",
        "",
        40500,
        "40500",
        500,
        -1,
        0x10000,
        20001,
        "20001",
        "00000",
        "4048",
        "404890",
        "\N{FULLWIDTH DIGIT FOUR}0489",
        "-0489",
        257,
    ],
)
def test_what_a_module_does_not_have_is_refused_with_what_it_has(key: str | int) -> None:
    with pytest.raises(EncodeError, match=r"M-7017 has no register .*: analog_input, channel_mask, .*, manual 3\.4"):
        M_7017.find(key)


def test_a_module_without_a_map_has_nothing() -> None:
    registers = RegisterMap(Profile(Model.I_7017))

    assert list(registers) == []
    with pytest.raises(EncodeError, match="I-7017 has no register 'protocol': it has no address map"):
        registers.find("protocol")


def test_old_firmware_has_what_its_functions_read() -> None:
    registers = RegisterMap(Profile(Model.M_7018, firmware=Firmware("B3.4")))

    assert [row.number for row in registers] == ["30001", "30129"]
    with pytest.raises(EncodeError, match=r"M-7018 with firmware B3\.4 has no register 'filter'"):
        registers.read(0x01, "filter")


@pytest.mark.parametrize(("area", "bits"), [(Area.COIL, True), (Area.DISCRETE_INPUT, True),
                                            (Area.INPUT_REGISTER, False), (Area.HOLDING_REGISTER, False)])  # fmt: skip
def test_an_area_has_bits_or_words(area: Area, bits: bool) -> None:  # noqa: FBT001 - a case
    assert bits == area.bits


# --- read, write, decode ----------------------------------------------------------------------------------------------

READERS = {
    Area.COIL: modbus.ReadCoils,
    Area.DISCRETE_INPUT: modbus.ReadDiscreteInputs,
    Area.INPUT_REGISTER: modbus.ReadInputRegisters,
    Area.HOLDING_REGISTER: modbus.ReadHoldingRegisters,
}


def counts_within(row: Register, profile: Profile) -> list[int]:
    """Counts that a single item of the row may have: its ends, zero and what is between."""
    if row.kind is Kind.CODE and "type_code" in row.name:
        return [int(code) for code in profile.model.type_codes]
    if row.name == "line_settings":
        return [0x03, 0x0A, 0x46, 0xCA]
    low = 0 if row.minimum is None else row.minimum
    high = (0xFFFFFFFF if row.kind is Kind.UINT32 else 0xFFFF) if row.maximum is None else row.maximum
    return [low, *([0] if low < 0 else []), low + (high - low) // 3, high]


def items_of(row: Register, counts: list[int], *, big_endian: bool) -> tuple[int, ...]:
    """What stands in the registers of a row for these counts, written in another way than the code does."""
    if row.kind is Kind.UINT32:
        words = [(count >> 16, count & 0xFFFF) for count in counts]
        return tuple(it for pair in words for it in (pair if big_endian else pair[::-1]))
    return tuple(count % (0x100 if row.kind is Kind.INT8 else 0x10000) for count in counts)


def written(request: Any) -> tuple[int, tuple[int, ...]]:
    """Where a request writes, and what."""
    match request:
        case modbus.WriteSingleCoil():
            return request.coil, (int(request.value),)
        case modbus.WriteSingleRegister():
            return request.register, (request.value,)
    return request.start, request.values


@every_map
def test_a_row_is_read_as_far_as_the_module_has_channels(registers: RegisterMap) -> None:
    for row in registers:
        if row.access is Access.WRITE:
            with pytest.raises(EncodeError, match=f"register cannot be '{row.name}': it can only be written"):
                registers.read(0x01, row.number)
            continue
        single = row.count == 1 or row.kind in (Kind.UINT32, Kind.RECORD)
        count = row.count if single else min(row.count, registers.profile.channels)
        area = registers.find(row.name).area

        assert READERS[area](0x01, row.address, count) == registers.read(0x01, row.name)
        assert modbus.encode(registers.read(0x01, row.name), registers.profile)


@every_map
def test_a_number_or_address_means_the_value_that_it_is_in(registers: RegisterMap) -> None:
    for row in registers:
        width = {Kind.UINT32: 2, Kind.RECORD: 18}.get(row.kind, 1)
        most = row.count if row.kind is not Kind.READING else registers.profile.channels
        for at in range(most if row.access is not Access.WRITE else 0):
            number = f"{row.area.value}{row.address + at + 1:04d}"
            request = READERS[row.area](0x01, row.address + at - at % width, width)

            assert request == registers.read(0x01, number)
            if row.area is Area.HOLDING_REGISTER:
                assert request == registers.read(0x01, int(number)) == registers.read(0x01, row.address + at)


@pytest.mark.parametrize("big_endian", [False, True])
@every_map
def test_what_is_written_is_what_is_read(registers: RegisterMap, big_endian: bool) -> None:  # noqa: FBT001 - a case
    for row in registers:
        if row.access is Access.READ:
            with pytest.raises(EncodeError, match=f"register cannot be '{row.name}': it can only be read"):
                registers.write(0x01, row.number, 0)
            continue
        channels = 1 if row.kind is Kind.UINT32 else min(row.count, registers.profile.channels)
        for count in counts_within(row, registers.profile):
            items = items_of(row, [count] * channels, big_endian=big_endian)
            value = registers.decode(row.name, items, big_endian=big_endian)
            if count != CLEARED_BY.get(row.name, count):
                with pytest.raises(EncodeError, match=f"{row.name} cannot be .*: {CLEARED_BY[row.name]}, manual 3.4"):
                    registers.write(0x01, row.name, value)
                continue
            request: Any = registers.write(0x01, row.name, value, big_endian=big_endian)

            assert (row.address, items) == written(request)
            assert modbus.encode(request, registers.profile)


@every_map
def test_what_is_beyond_the_limits_of_a_row_is_not_written(registers: RegisterMap) -> None:
    for row in registers:
        if row.access is Access.READ or row.kind is Kind.UINT32:
            continue
        scale = row.scale or 1
        low, high = row.minimum or 0, 0xFFFF if row.maximum is None else row.maximum
        channels = range(1) if row.count > 1 else None
        for count in (low - 1, high + 1, low + 0.5):
            said = " in steps of .*" if low < high and row.name not in CLEARED_BY else ": [01]"
            with pytest.raises(EncodeError, match=f"{row.name} cannot be .*{said}, manual 3.4"):
                registers.write(0x01, row.number, count * scale, channels=channels)


@pytest.mark.parametrize(
    ("registers", "key", "value", "request_"),
    [
        (M_7017, "host_watchdog_timeout", 10.0, modbus.WriteSingleRegister(1, 488, 100)),
        (M_7017, "host_watchdog_timeout", 0.3, modbus.WriteSingleRegister(1, 488, 3)),
        (M_7017, "response_delay", 30, modbus.WriteSingleRegister(1, 487, 30)),
        (M_7017, "response_delay", [30], modbus.WriteSingleRegister(1, 487, 30)),
        (M_7017, "filter", Filter.REJECT_50_HZ, modbus.WriteSingleCoil(1, 258, True)),
        (M_7017, "filter", False, modbus.WriteSingleCoil(1, 258, False)),
        (M_7017, "response_delay", 2.0, modbus.WriteSingleRegister(1, 487, 2)),
        (M_7017, "host_watchdog_timeout_count", 0, modbus.WriteSingleRegister(1, 491, 0)),
        (M_7017, "host_watchdog_timed_out", True, modbus.WriteSingleCoil(1, 269, True)),
        (M_7019R, 40258, TypeCode.K, modbus.WriteSingleRegister(1, 257, 0x0F)),
        (M_7019R, 40257, [TypeCode.K], modbus.WriteSingleRegister(1, 256, 0x0F)),
        (M_7019R, 263, 0x0F, modbus.WriteSingleRegister(1, 263, 0x0F)),
        (LOGGER, 40018, 0x12345678, modbus.WriteMultipleRegisters(1, 16, (0x5678, 0x1234))),
        (M_7017, "protocol", Protocol.DCON, modbus.WriteSingleCoil(1, 256, False)),
        (M_7017, "modbus_data_format", ModbusDataFormat.ENGINEERING, modbus.WriteSingleCoil(1, 268, True)),
        (M_7017, "module_type_code", TypeCode.V_10, modbus.WriteSingleRegister(1, 486, 0x08)),
        (M_7017, "line_settings", LineSettings(BaudRate.BAUD_9600), modbus.WriteSingleRegister(1, 485, 0x06)),
        (M_7017, "line_settings", 0x06, modbus.WriteSingleRegister(1, 485, 0x06)),
        (M_7017, 40490, 0x81, modbus.WriteSingleRegister(1, 489, 0x81)),
        (M_7018, "module_cjc_offset", -0.16, modbus.WriteSingleRegister(1, 490, 0xFFF0)),
        (M_7018, "cjc_offset", (-0.1,) * 8, modbus.WriteMultipleRegisters(1, 352, (0x00FF,) * 8)),
        (M_7019R, "cjc_offset", (-0.1,) * 8, modbus.WriteMultipleRegisters(1, 352, (0xFFF6,) * 8)),
        (M_7019R, "temperature_offset", (12.7,) * 8, modbus.WriteMultipleRegisters(1, 288, (0x007F,) * 8)),
        (M_7019R, "cjc_update", CjcUpdate.ONCE, modbus.WriteSingleRegister(1, 492, 2)),
        (M_7019R, "load_factory_calibration", True, modbus.WriteSingleCoil(1, 271, True)),
        (M_7019R, "00272", 1, modbus.WriteSingleCoil(1, 271, True)),
        (M_7017Z, "type_code", (TypeCode.V_10,) * 10, modbus.WriteMultipleRegisters(1, 256, (8,) * 10)),
        (LOGGER, "rtc_epoch", 0x12345678, modbus.WriteMultipleRegisters(1, 16, (0x5678, 0x1234))),
        (LOGGER, "log_read_index", 1, modbus.WriteMultipleRegisters(1, 872, (1, 0))),
    ],
    ids=str,
)
def test_a_value_is_written_in_the_unit_of_its_row(
    registers: RegisterMap, key: str | int, value: Any, request_: Any
) -> None:
    assert request_ == registers.write(0x01, key, value)


@pytest.mark.parametrize(
    ("registers", "key", "items", "value"),
    [
        (M_7017, "host_watchdog_timeout", [25], 2.5),
        (M_7017, "firmware_version", [0x0305, 0x000B], Firmware("B3.5")),
        (M_7017, "firmware_version", [0x0305, 0x0001], 0x00010305),
        (M_7017, "firmware_version", [0x0A05, 0x000B], 0x000B0A05),
        (M_7017, "firmware_version", [0x0364, 0x000B], 0x000B0364),
        (M_7017, "firmware_version", [0x0305, 0x0024], 0x00240305),
        (M_7017, "firmware_version", [0x0305, 0x010B], 0x010B0305),
        (M_7017, "module_name", [0x1700, 0x0070], "7017"),
        (M_7017, "module_name", [0x1700, 0x0071], 0x00711700),
        (M_7017, "protocol", [True], Protocol.MODBUS_RTU),
        (M_7017, "filter", [False], Filter.REJECT_60_HZ),
        (M_7017, "modbus_data_format", [True], ModbusDataFormat.ENGINEERING),
        (M_7017, "host_watchdog_enabled", [True], True),
        (M_7017, "range_status", [True] + [False] * 7, (True, *(False,) * 7)),
        (M_7017, "module_type_code", [0x08], TypeCode.V_10),
        (M_7017, "module_type_code", [0xFF], 0xFF),
        (M_7017, "line_settings", [0x86], LineSettings(BaudRate.BAUD_9600, CharacterFormat.E81)),
        (M_7017, "line_settings", [0x186], 0x186),
        (M_7017, "response_delay", [0xFFFF], 0xFFFF),
        (M_7018, "cjc_temperature", [0xFF9C], -1.0),
        (M_7018, "module_cjc_offset", [0xF000], -40.96),
        (M_7018, "cjc_offset", [0x80, 0x7F, 0xFF, *[0] * 5], (-12.8, 12.7, -0.1, *[0.0] * 5)),
        (RegisterMap(Profile(Model.M_7018_16)), "temperature", [0xFFFF] * 16, (-1,) * 16),
        (M_7019R, "cjc_offset", [0xFFFF] * 8, (-0.01,) * 8),
        (M_7019R, "temperature_offset", [0xFF80] * 8, (-12.8,) * 8),
        (M_7019R, "cjc_update", [1], CjcUpdate.STARTED),
        (M_7019R, "type_code", [0x0F] * 8, (TypeCode.K,) * 8),
        (LOGGER, "rtc_epoch", [0x5678, 0x1234], 0x12345678),
        (LOGGER, "log_command", [2], LogCommand.PERIOD),
        (LOGGER, "log_status", [1], 1),
        (M_7017, 30003, [0x7FFF], Reading(10.0, Unit.VOLT)),
        (M_7017, "40001", [0x8000], Reading(-10.0, Unit.VOLT)),
        (M_7017, 7, [0x8000], Reading(-10.0, Unit.VOLT)),
        (M_7017, 10131, [1], True),
        (M_7019R, 40258, [0x0F], TypeCode.K),
        (M_7017, 40482, [0x0305, 0x000B], Firmware("B3.5")),
    ],
    ids=str,
)  # fmt: skip
def test_items_are_decoded_in_the_unit_of_their_row(
    registers: RegisterMap, key: str | int, items: Any, value: Any
) -> None:
    told = registers.decode(key, items)

    assert (value, type(value)) == (told, type(told))


@pytest.mark.parametrize(("key", "told"), [("firmware_version", 0x12345678), ("module_name", 0x12345678)])
def test_the_words_of_version_and_name_have_one_order(key: str, told: Any) -> None:
    for big_endian in (False, True):
        assert told == LOGGER.decode(key, [0x5678, 0x1234], big_endian=big_endian)


@pytest.mark.parametrize("key", ["rtc_epoch", "log_last_index", "log_read_index"])
def test_the_words_of_clock_and_log_have_the_order_that_the_coil_says(key: str) -> None:
    assert LOGGER.decode(key, [0x5678, 0x1234]) == 0x12345678
    assert LOGGER.decode(key, [0x1234, 0x5678], big_endian=True) == 0x12345678


def test_the_coil_big_endian_says_which_word_of_32_bits_is_first() -> None:
    assert LOGGER.decode("rtc_epoch", [0x1234, 0x5678], big_endian=True) == 0x12345678
    assert modbus.WriteMultipleRegisters(1, 16, (0x1234, 0x5678)) == LOGGER.write(
        0x01, "rtc_epoch", 0x12345678, big_endian=True
    )


@pytest.mark.parametrize(
    ("registers", "key", "value", "said"),
    [
        (M_7017, "analog_input", (0,) * 8, "register cannot be 'analog_input': it can only be read"),
        (
            M_7017,
            "host_watchdog_timeout",
            25.6,
            r"timeout cannot be 25\.6: 0\.\.25\.5 s in steps of 0\.1",
        ),
        (M_7017, "host_watchdog_timeout", 0.25, r"cannot be 0\.25"),
        (M_7017, "response_delay", -1, r"response_delay cannot be -1: 0\.\.30 ms in steps of 1"),
        (M_7017, "module_address", 0, r"module_address cannot be 0: 1\.\.247 in steps of 1"),
        (M_7017, "channel_mask", 0x100, r"channel_mask cannot be 256: 0\.\.255"),
        (M_7017, "host_watchdog_timeout_count", 1, "host_watchdog_timeout_count cannot be 1: 0, manual"),
        (M_7017, "host_watchdog_timed_out", False, "host_watchdog_timed_out cannot be False: 1, manual"),
        (M_7017, "response_delay", True, "a number or a value of the row's type"),
        (M_7017, "host_watchdog_timeout_count", False, "a number or a value of the row's type"),
        (M_7017, "modbus_data_format", Protocol.MODBUS_RTU, "a number or a value of the row's type"),
        (M_7017, "filter", CjcUpdate.STARTED, "a number or a value of the row's type"),
        (M_7017, "line_settings", TypeCode.V_10, "a number or a value of the row's type"),
        (M_7017, "module_type_code", BaudRate.BAUD_38400, "a number or a value of the row's type"),
        (M_7019R, 40258, (TypeCode.K, TypeCode.J), r"cannot be \('K', 'J'\): 1 value$"),
        (M_7017, "response_delay", None, "a number or a value of the row's type"),
        (M_7017, "response_delay", "1", "a number or a value of the row's type"),
        (M_7017, "response_delay", float("nan"), "a number or a value of the row's type"),
        (M_7017, "response_delay", float("inf"), "a number or a value of the row's type"),
        (M_7017, "response_delay", 10**400, "a number or a value of the row's type"),
        (M_7017, "response_delay", Filter.REJECT_50_HZ, "a number or a value of the row's type"),
        (M_7017, "response_delay", LineSettings(), "a number or a value of the row's type"),
        (M_7017, "response_delay", (1, 2), r"response_delay cannot be \(1, 2\): 1 value$"),
        (M_7017, "response_delay", (), r"1 value$"),
        (M_7018, "cjc_offset", (0.0,) * 7, "8 values, one for each channel; or channels="),
        (
            M_7019R,
            "type_code",
            TypeCode.K,
            r"'K': 8 values, one for each channel; or channels=range\(0, 1\) to write one$",
        ),
        (M_7018, "cjc_offset", (12.8,) * 8, r"cjc_offset cannot be 12\.8: -12\.8\.\.12\.7 degC in steps of 0\.1"),
        (M_7018, "module_cjc_offset", 40.97, r"-40\.96\.\.40\.96 degC in steps of 0\.01"),
        (
            M_7017,
            "module_type_code",
            TypeCode.K,
            r"module_type_code cannot be 'K': V_10 V_5 .* on M-7017, manual 1\.11",
        ),
        (M_7019R, "type_code", (0x07,) * 7 + (0x1D,), r"type_code cannot be 29: 0\.\.28"),
        (M_7019R, "type_code", (0x1B,) * 8, "type_code cannot be 'V_150': .* on M-7019R"),
        (M_7017, "line_settings", LineSettings(0x3F), r"baud_rate cannot be '3F': 03\.\.0A"),
        (M_7017, "line_settings", 0x0B, r"baud_rate cannot be '0B': 03\.\.0A, manual 3\.4"),
        (M_7017, "line_settings", 0xCB, r"line_settings cannot be 203: 3\.\.202"),
        (M_7019R, "load_factory_calibration", False, r"load_factory_calibration cannot be False: 1, manual"),
        (M_7017, "filter", 2, r"filter cannot be 2: 0\.\.1"),
        (M_7017, "filter", 0.5, r"filter cannot be 0\.5: 0\.\.1 in steps of 1"),
        (LOGGER, "rtc_epoch", 1 << 32, r"rtc_epoch cannot be 4294967296: 0\.\.4.29497e\+09 s"),
        (LOGGER, "rtc_epoch", (0, 0), r"1 value$"),
        (LOGGER, "rtc_year", 1999, r"rtc_year cannot be 1999: 2000\.\.2159"),
    ],
    ids=str,
)
def test_a_value_that_a_row_cannot_hold_is_refused_with_what_it_can(
    registers: RegisterMap, key: str, value: Any, said: str
) -> None:
    with pytest.raises(EncodeError, match=said):
        registers.write(0x01, key, value)


def test_a_line_that_the_firmware_does_not_have_is_not_written() -> None:
    registers = RegisterMap(Profile(Model.M_7019R, firmware=Firmware("B3.0")))

    with pytest.raises(EncodeError, match=r"character_format cannot be 'E81': N81 with firmware before B3\.1"):
        registers.write(0x01, "line_settings", LineSettings(BaudRate.BAUD_9600, CharacterFormat.E81))


@pytest.mark.parametrize(
    ("registers", "key", "items", "fault"),
    [
        (M_7017, "response_delay", [], Fault.COUNT),
        (M_7017, "response_delay", [1, 2], Fault.COUNT),
        (M_7017, "analog_input", [0] * 7, Fault.COUNT),
        (M_7019R, "cjc_update", [3], Fault.VALUE),
        (M_7017, "analog_input", [0x10000] * 8, Fault.NUMBER),
        (UNKNOWN_TYPES, "analog_input", [0] * 8, Fault.NUMBER),
        (M_7017, 30003, [0] * 8, Fault.COUNT),
        (M_7017, "line_settings", [-1], Fault.NUMBER),
        (M_7017, "module_name", [70000, 70000], Fault.NUMBER),
        (M_7017, "module_name", [0, -1], Fault.NUMBER),
        (M_7017, "response_delay", [1.5], Fault.NUMBER),
        (M_7017, "response_delay", [None], Fault.NUMBER),
        (M_7017, "response_delay", [-5], Fault.NUMBER),
        (M_7017, "response_delay", [True], Fault.NUMBER),
        (M_7017, "host_watchdog_enabled", [7], Fault.NUMBER),
        (M_7017, "range_status", [False] * 7 + [2], Fault.NUMBER),
        (LOGGER, "type_code", [99999] * 16, Fault.NUMBER),
        (LOGGER, "rtc_epoch", ["a", "b"], Fault.NUMBER),
        (LOGGER, "log_records", [0] * 107 + [0x10000], Fault.NUMBER),
        (M_7018, "cjc_offset", [0] * 7 + [0x0100], Fault.RESERVED),
        (M_7018, "cjc_offset", [0xFF80] * 8, Fault.RESERVED),
    ],
    ids=str,
)
def test_invalid_items_of_a_row_are_refused(registers: RegisterMap, key: str | int, items: Any, fault: Fault) -> None:
    with pytest.raises(DecodeError) as caught:
        registers.decode(key, items)

    name = "type_codes" if registers is UNKNOWN_TYPES else registers.find(key).name
    assert (fault, b"", name) == (caught.value.fault, caught.value.wire, caught.value.field)


@pytest.mark.parametrize(
    ("registers", "key", "items", "said"),
    [
        (M_7017, "response_delay", [1, 2], "count in response_delay .*; allowed: 1 items, not 2"),
        (M_7017, "host_watchdog_enabled", [7], r"allowed: 0\.\.1; item 0 is 7"),
        (M_7017, "analog_input", [0] * 7 + [-1], r"allowed: 0\.\.65535; item 7 is -1"),
        (M_7019R, "cjc_update", [3], r"allowed: 0\.\.2, not 3"),
        (M_7018, "cjc_offset", [0xFF80] * 8, "allowed: 00 in the high byte, not FF"),
        (UNKNOWN_TYPES, 30001, [0], "number in type_codes .*; allowed: a profile with type codes; this one has none"),
    ],
    ids=str,
)
def test_an_error_says_what_could_be_there(registers: RegisterMap, key: str | int, items: Any, said: str) -> None:
    with pytest.raises(DecodeError, match=said + r" \(manual 3\.[45]\)"):
        registers.decode(key, items)


# --- channels ---------------------------------------------------------------------------------------------------------


def test_some_channels_of_a_row_are_read_written_and_decoded() -> None:
    mixed = RegisterMap(evolve(M_7019R.profile, type_codes=(TypeCode.V_10,) * 6 + (TypeCode.K,) * 2))

    assert modbus.ReadInputRegisters(1, 5, 2) == mixed.read(0x01, "analog_input", channels=range(5, 7))
    assert (Reading(10.0, Unit.VOLT), Reading(None, Unit.CELSIUS, Status.OVER_RANGE)) == mixed.decode(
        "analog_input", [0x7FFF, 0x7FFF], channels=range(5, 7)
    )
    assert modbus.WriteSingleRegister(1, 258, 0x0F) == mixed.write(0x01, "type_code", [15], channels=range(2, 3))
    assert mixed.decode("type_code", [0x0E], channels=range(7, 8)) == (TypeCode.J,)
    assert mixed.read(0x01, 40007, channels=range(5, 7)) == modbus.ReadHoldingRegisters(1, 5, 2)
    assert mixed.decode(30007, [0x7FFF]) == Reading(None, Unit.CELSIUS, Status.OVER_RANGE)


def test_readings_of_channels_that_the_connecting_mode_does_not_have_are_not_read() -> None:
    single_ended = RegisterMap(evolve(M_7017Z.profile, single_ended=True, type_codes=(TypeCode.V_10,) * 20))
    several = range(10, 12)

    assert modbus.ReadInputRegisters(1, 10, 2) == single_ended.read(0x01, "analog_input", channels=several)
    assert modbus.ReadHoldingRegisters(1, 266, 2) == M_7017Z.read(0x01, "type_code", channels=several)
    for key, channels in (("analog_input", several), ("analog_input", range(9, 11)), (30011, None), (40020, None)):
        with pytest.raises(
            EncodeError, match=r"channels cannot be range\(.*\): a range within 0\.\.9, the channels of this"
        ):
            M_7017Z.read(0x01, key, channels=channels)
    with pytest.raises(DecodeError, match=r"allowed: channels 0\.\.9 of the profile"):
        M_7017Z.decode("analog_input", [0, 0], channels=several)


@pytest.mark.parametrize(
    ("key", "channels", "said"),
    [
        ("analog_input", range(8), ""),
        ("analog_input", range(9), r"a range within 0\.\.7"),
        ("analog_input", range(-1, 2), r"a range within 0\.\.7"),
        ("analog_input", range(3, 3), r"a range within 0\.\.7"),
        ("analog_input", range(0, 4, 2), r"a range within 0\.\.7"),
        ("response_delay", range(1), "no channels: response_delay is a single value"),
        ("module_name", range(2), "no channels: module_name is a single value"),
    ],
)
def test_channels_are_a_range_of_what_the_row_has(key: str, channels: range, said: str) -> None:
    if not said:
        assert M_7017.read(0x01, key) == M_7017.read(0x01, key, channels=channels)
        return
    with pytest.raises(EncodeError, match=f"channels cannot be .*: {said}, manual 3.4"):
        M_7017.read(0x01, key, channels=channels)


# --- readings ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("data_format", "words", "values"),
    [
        (ModbusDataFormat.HEX, (0x7FFF, 0x8000), (10.0, -10.0)),
        (ModbusDataFormat.ENGINEERING, (10000, 0xD8F0), (10.0, -10.0)),
    ],
)
def test_words_are_readings_in_the_format_of_the_profile(
    data_format: ModbusDataFormat, words: tuple[int, int], values: tuple[float, float]
) -> None:
    profile = evolve(M_7017.profile, modbus_data_format=data_format)
    told = tuple(Reading(value, Unit.VOLT) for value in values)

    assert told == modbus.readings(words, profile)
    assert told == modbus.readings(iter(words), profile, channel=6)
    assert told == RegisterMap(profile).decode("analog_input", words, channels=range(2))


@pytest.mark.parametrize("word", [1.5, "a", None, True, -1, 0x10000])
def test_what_is_no_word_is_no_reading(word: Any) -> None:
    with pytest.raises(DecodeError, match=r"number in words .*; allowed: 0\.\.65535; item 1 is ") as caught:
        modbus.readings([0, word], M_7017.profile)

    assert (caught.value.fault, caught.value.wire) == (Fault.NUMBER, b"")


@pytest.mark.parametrize(("words", "channel"), [((0,), 8), ((0, 0), 7), ((0,), -1), ((0,) * 9, 0)])
def test_words_of_channels_that_are_not_there_are_no_readings(words: tuple[int, ...], channel: int) -> None:
    with pytest.raises(DecodeError, match=r"number in type_codes .*; allowed: channels 0\.\.7 of the profile"):
        modbus.readings(words, M_7017.profile, channel=channel)


def test_a_log_has_six_records_of_16_readings_and_a_time() -> None:
    words = [word for record in range(6) for word in (*range(record, record + 16), 0x5678 + record, 0x1234)]
    assert modbus.ReadInputRegisters(1, 1000, 108) == LOGGER.read(0x01, "log_records")

    records: Any = LOGGER.decode("log_records", words)

    assert [record.time for record in records] == [0x12345678 + at for at in range(6)]
    assert [record.readings for record in records] == [
        modbus.readings(range(at, at + 16), LOGGER.profile) for at in range(6)
    ]
    swapped = [words[at ^ 1] if at % 18 >= 16 else word for at, word in enumerate(words)]
    assert records == LOGGER.decode("log_records", swapped, big_endian=True)


def test_a_log_is_read_a_record_at_a_time() -> None:
    words = (*range(16), 0x5678, 0x1234)
    record = modbus.LogRecord(modbus.readings(words[:16], LOGGER.profile), 0x12345678)
    some = range(2, 4)

    assert modbus.ReadInputRegisters(1, 1000, 18) == LOGGER.read(0x01, "log_records", channels=range(1))
    assert modbus.ReadInputRegisters(1, 1036, 36) == LOGGER.read(0x01, "log_records", channels=some)
    assert modbus.ReadInputRegisters(1, 1018, 18) == LOGGER.read(0x01, 31019)
    assert LOGGER.decode("log_records", words, channels=range(1)) == (record,)
    assert LOGGER.decode("log_records", words * 2, channels=some) == (record, record)
    assert LOGGER.decode(31019, words) == record
    with pytest.raises(EncodeError, match=r"channels cannot be range\(5, 7\): a range within 0\.\.5"):
        LOGGER.read(0x01, "log_records", channels=range(5, 7))


# --- plans ------------------------------------------------------------------------------------------------------------


@every_map
def test_a_plan_reads_every_row_with_its_neighbours(registers: RegisterMap) -> None:
    readable = [row for row in registers if row.access is not Access.WRITE and row == registers.find(row.name)]
    spans: list[list[Any]] = []
    for row in readable:
        request = registers.read(0x01, row.name)
        if spans and spans[-1][0] is row.area and spans[-1][1] + spans[-1][2] == row.address:
            spans[-1][2] += request.count
        else:
            spans.append([row.area, row.address, request.count])

    plan = registers.plan(0x01, [row.name for row in reversed(readable)])

    assert [READERS[area](0x01, start, count) for area, start, count in spans] == list(plan.requests)


@every_map
def test_the_values_of_a_plan_are_those_of_single_reads(registers: RegisterMap) -> None:
    names = sorted({row.name for row in registers if row.access is not Access.WRITE})
    plan = registers.plan(0x01, names)
    memory = {
        (READERS[row.area], row.address + at): items_of(row, counts_within(row, registers.profile), big_endian=False)[
            at % 2
        ]
        for row in registers
        for at in range(row.count)
    }

    def answer(request: Any) -> Any:
        items = [memory[type(request), request.start + at] & 0xFFFF for at in range(request.count)]
        bits = request.response in (modbus.Coils, modbus.DiscreteInputs)
        return request.response(0x01, tuple(map(bool, items) if bits else items))

    single = {name: registers.decode(name, answer(registers.read(0x01, name)).values) for name in names}

    assert single == plan.decode([answer(request) for request in plan.requests])


def test_an_exception_is_the_value_of_all_that_it_refused() -> None:
    plan = M_7017.plan(0x01, ["response_delay", "filter", "host_watchdog_timeout", 40489])
    refused = modbus.ExceptionResponse(0x01, 3, 2)

    told = plan.decode([modbus.Coils(0x01, (True,)), refused])

    assert {"filter": Filter.REJECT_50_HZ, "response_delay": refused, "host_watchdog_timeout": refused} == told


def test_a_plan_knows_the_order_of_words() -> None:
    plan = LOGGER.plan(0x01, ["rtc_epoch"], big_endian=True)

    assert plan.decode([modbus.HoldingRegisters(0x01, (0x1234, 0x5678))]) == {"rtc_epoch": 0x12345678}


def test_a_plan_of_nothing_asks_nothing() -> None:
    plan = M_7017.plan(0x01, [])

    assert plan.requests == ()
    assert plan.decode([]) == {}


def test_a_plan_needs_a_response_for_each_request() -> None:
    plan = M_7017.plan(0x01, ["filter", "response_delay"])

    with pytest.raises(InvalidValueError, match="responses cannot be 1: 2, one for each request"):
        plan.decode([modbus.Coils(0x01, (True,))])


def test_a_response_with_too_few_items_is_refused() -> None:
    plan = M_7017.plan(0x01, ["response_delay", "host_watchdog_timeout"])

    with pytest.raises(DecodeError, match=r"count in responses .*; allowed: 2 items, not 1"):
        plan.decode([modbus.HoldingRegisters(0x01, (0,))])


@pytest.mark.parametrize(
    ("response", "fault", "allowed"),
    [
        (modbus.HoldingRegisters(0x01, (0, 25, 0)), Fault.COUNT, "2 items, not 3"),
        (modbus.HoldingRegisters(0x02, (0, 25)), Fault.ADDRESS, "01, not 02"),
        (modbus.ExceptionResponse(0x02, 3, 2), Fault.ADDRESS, "01, not 02"),
        (modbus.InputRegisters(0x01, (0, 25)), Fault.FUNCTION, "HoldingRegisters, or an exception of function 03"),
        (modbus.ExceptionResponse(0x01, 4, 2), Fault.FUNCTION, "HoldingRegisters, or an exception of function 03"),
        (None, Fault.FUNCTION, "HoldingRegisters, or an exception of function 03"),
    ],
    ids=str,
)
def test_a_response_that_does_not_answer_its_request_is_refused(response: Any, fault: Fault, allowed: str) -> None:
    plan = M_7017.plan(0x01, ["response_delay", "host_watchdog_timeout"])

    with pytest.raises(DecodeError) as caught:
        plan.decode([response])

    error = caught.value
    assert (fault, b"", "responses", allowed, "3.4") == (
        error.fault, error.wire, error.field, error.allowed, error.section,
    )  # fmt: skip


@pytest.mark.parametrize("keys", [[30001, 40001], [30001, 30002], ["analog_input", 30001], ["40003", "analog_input"]])
def test_two_things_of_one_name_are_not_planned(keys: list[str | int]) -> None:
    with pytest.raises(
        EncodeError, match="analog_input is requested twice, but values are returned by name: each name once"
    ):
        M_7017.plan(0x01, keys)


def test_a_thing_is_planned_once_by_whatever_keys() -> None:
    assert M_7017.plan(0x01, ["filter"]) == M_7017.plan(0x01, ["filter", "00259"])


def test_a_plan_reads_single_channels_by_their_numbers() -> None:
    plan = M_7019R.plan(0x01, [40258, 30008, "cjc_temperature"])

    assert plan.requests == (
        modbus.ReadInputRegisters(1, 7, 1),
        modbus.ReadInputRegisters(1, 128, 1),
        modbus.ReadHoldingRegisters(1, 257, 1),
    )
    assert plan.decode(
        [modbus.InputRegisters(1, (0,)), modbus.InputRegisters(1, (2500,)), modbus.HoldingRegisters(1, (0x0F,))]
    ) == {
        "analog_input": Reading(0.0, M_7019R.profile.units[7]),
        "cjc_temperature": 25.0,
        "type_code": TypeCode.K,
    }


def test_what_can_only_be_written_cannot_be_planned() -> None:
    with pytest.raises(EncodeError, match="it can only be written"):
        M_7019R.plan(0x01, ["load_factory_calibration"])


def test_a_number_selects_the_area_of_its_first_digit() -> None:
    registers = modbus.RegisterMap(Profile(Model.M_7017))

    with pytest.raises(EncodeError, match="has no register '40489'"):
        registers.find("40489", modbus.Area.COIL)


def test_bytes_are_no_value() -> None:
    registers = modbus.RegisterMap(Profile(Model.M_7017))

    with pytest.raises(EncodeError, match="response_delay cannot be"):
        registers.write(0x01, "response_delay", b"\x05")


@pytest.mark.parametrize("data_format", list(ModbusDataFormat))
def test_the_words_of_readings_are_read_as_the_readings(data_format: ModbusDataFormat) -> None:
    profile = Profile(Model.M_7019R, modbus_data_format=data_format)
    values = [Reading(value, Unit.VOLT) for value in (-10.0, 0.0, 2.5, 10.0)]

    told = modbus.readings(modbus.words(values, profile, channel=2), profile, channel=2)

    assert [it.value for it in values] == [pytest.approx(it.value, abs=0.001) for it in told]


@pytest.mark.parametrize("channel", [-1, 8])
def test_words_are_of_channels_that_are_there(channel: int) -> None:
    with pytest.raises(EncodeError, match="channel cannot be"):
        modbus.words([Reading(0.0, Unit.VOLT)], Profile(Model.M_7019R), channel=channel)


@pytest.mark.parametrize("key", [10**5000, -(10**5000), 1 << 64], ids=["large", "negative", "64-bit"])
def test_a_number_of_any_size_is_no_register(key: int) -> None:
    for find in (M_7019R.find, lambda number: M_7019R.read(0x01, number), lambda number: M_7019R.plan(0x01, [number])):
        with pytest.raises(EncodeError, match="M-7019R has no register"):
            find(key)


@pytest.mark.parametrize("channels", [3, 0, (0, 1), "0", slice(0, 2)])
def test_channels_are_a_range(channels: Any) -> None:
    for use in (
        lambda: M_7019R.read(0x01, "type_code", channels=channels),
        lambda: M_7019R.write(0x01, "type_code", [5], channels=channels),
        lambda: M_7019R.decode("type_code", [5], channels=channels),
    ):
        with pytest.raises(EncodeError, match=r"channels cannot be .*: a range within 0\.\.7"):
            use()


@pytest.mark.parametrize(
    ("registers", "name", "value", "words"),
    [
        (M_7017, "protocol", Protocol.MODBUS_RTU, "modbus_rtu"),
        (M_7017, "filter", Filter.REJECT_50_HZ, "reject_50_hz"),
        (M_7017, "host_watchdog_enabled", False, "no"),
        (M_7017, "host_watchdog_timeout", 2.5, "2.5 s"),
        (M_7017, "response_delay", 30, "30 ms"),
        (M_7017, "module_address", 26, "1Ah (26)"),
        (M_7017, "module_type_code", TypeCode.V_10, "08, -10..10 V"),
        (M_7017, "module_type_code", 0xFF, "FF, the channels have different types"),
        (M_7017, "line_settings", LineSettings(), "06, 9600 baud, N81"),
        (M_7017, "line_settings", 0x186, "186, not defined"),
        (M_7017, "channel_mask", 0x05, "05, channels 0, 2"),
        (M_7017, "firmware_version", Firmware("B307"), "B3.7"),
        (M_7017, "firmware_version", 0x00010305, "00010305, not defined"),
        (M_7017, "module_name", "7017", "M-7017 series"),
        (M_7017, "module_name", 0x00711700, "00711700, not defined"),
        (M_7017, "host_watchdog_timeout_count", 7, "7"),
        (M_7018, "module_cjc_offset", -40.96, "-40.96 degC"),
        (M_7019R, "cjc_update", CjcUpdate.ONCE, "once"),
        (M_7019R, "sampling_rate", True, "8 Hz"),
        (M_7019R, "sampling_rate", False, "10 Hz"),
        (RegisterMap(Profile(Model.M_7017Z)), "channel_mask_high", 0x9, "09, channels 16, 19"),
        (LOGGER, "log_status", 1, "running"),
        (LOGGER, "log_status", 2, "2"),
        (LOGGER, "log_command", LogCommand.CONTINUOUS, "continuous"),
    ],
    ids=str,
)
def test_a_value_is_described_with_its_meaning_and_unit(
    registers: RegisterMap, name: str, value: Any, words: str
) -> None:
    assert words == registers.find(name).describe(value)


def test_what_only_a_clearing_value_can_be_written_to_says_which() -> None:
    assert {row.name: row.cleared_by for row in LOGGER if row.cleared_by is not None} == CLEARED_BY


def test_every_number_of_32_bits_has_a_word_order() -> None:
    ordered = {row.name: row.word_order for row in LOGGER if row.word_order}
    fixed = {name for name, order in ordered.items() if order is WordOrder.LOW_FIRST}

    assert set(ordered) == {row.name for row in LOGGER if row.kind in (Kind.UINT32, Kind.RECORD)}
    assert fixed == {"firmware_version", "module_name"}


def test_only_reading_the_reset_status_changes_it() -> None:
    assert [row.name for row in LOGGER if row.ends_when_read] == ["reset_status"]


@pytest.mark.parametrize(
    ("message", "area", "first"),
    [
        (modbus.ReadCoils(1, 5, 2), modbus.Area.COIL, 5),
        (modbus.ReadDiscreteInputs(1, 6, 2), modbus.Area.DISCRETE_INPUT, 6),
        (modbus.WriteSingleCoil(1, 7, True), modbus.Area.COIL, 7),
        (modbus.SingleRegisterWritten(1, 8, 100), modbus.Area.HOLDING_REGISTER, 8),
        (modbus.MultipleCoilsWritten(1, 9, 2), modbus.Area.COIL, 9),
        (modbus.InputRegisters(1, (1, 2)), modbus.Area.INPUT_REGISTER, None),
        (modbus.ReadModuleName(1), None, None),
    ],
)
def test_a_message_names_the_area_and_the_first_item_that_it_is_about(
    message: modbus.Message, area: modbus.Area | None, first: int | None
) -> None:
    assert (message.area, message.first_item) == (area, first)
