"""``i7000 encode``: values in units, and requests that are held against the map of a model."""

from typing import Any

import pytest

from i7000 import Model, Profile, modbus
from i7000.cli.message import make
from i7000.modbus import Access, Area, Register, RegisterMap, seal
from tests.each import each
from tests.terminal import Run

MAPS = [RegisterMap(Profile(model)) for model in Model if model.value.startswith("M")]
READERS: dict[Area, Any] = {
    Area.COIL: modbus.ReadCoils,
    Area.DISCRETE_INPUT: modbus.ReadDiscreteInputs,
    Area.INPUT_REGISTER: modbus.ReadInputRegisters,
    Area.HOLDING_REGISTER: modbus.ReadHoldingRegisters,
}
ROWS = [
    pytest.param(registers, row, id=f"{registers.profile.model.value}-{row.number}")
    for registers in MAPS
    for row in registers
    if row.access is not Access.WRITE
]


def encoded(run: Run, arguments: str) -> str:
    """The frame in hex without address and CRC; DCON as text."""
    result = run("encode", *arguments.split())
    assert (result.code, result.err) == (0, "")
    return result.out.splitlines()[0]


# --- units ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "frame"),
    [
        ("SetCjcOffset address=1 offset=-0.5", "$019-0032"),
        ("SetCjcOffset address=1 offset=-.5degC", "$019-0032"),
        ("SetCjcOffset address=1 offset=40.96", "$019+1000"),
        ("SetCjcOffset address=1 offset=0x32", "$019+0032"),
        ("SetCjcOffset address=1 offset=-32h", "$019-0032"),
        ("CjcOffset address=1 offset=0.29", "!01+001D"),
        ("SetHostWatchdogTimeout address=1 enabled=true timeout=2.5", "~013119"),
        ("SetHostWatchdogTimeout address=1 enabled=true timeout=25.5s", "~0131FF"),
        ("SetHostWatchdogTimeout address=1 enabled=no timeout=0xFF", "~0130FF"),
        ("SetSoftInitTimeout address=1 timeout=60", "~01T3C"),
    ],
)
def test_a_field_with_a_unit_is_given_in_it_or_in_counts(run: Run, arguments: str, frame: str) -> None:
    assert frame == encoded(run, arguments)


@pytest.mark.parametrize(
    ("arguments", "body"),
    [
        ("channel=0 offset=-0.5", "01462C00FFCE"),
        ("channel=80h offset=-0.5", "01462C8000FB"),
        ("channel=0x82 offset=12.7", "01462C82007F"),
        ("channel=0x82 offset=0xFB", "01462C8200FB"),
    ],
)
def test_the_offset_of_a_channel_has_other_counts_than_that_of_the_module(run: Run, arguments: str, body: str) -> None:
    frame = encoded(run, f"SetCjcOffset address=1 {arguments} --protocol rtu --model M-7019R")

    assert seal(bytes.fromhex(body)).hex(" ").upper() == frame


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        ("SetCjcOffset offset=0.005", 2, "offset: 0.005 is not a multiple of 0.01 degC"),
        (
            "SetCjcOffset offset=1mV",
            2,
            "offset: '1mV' is not a value in degC: give a decimal number such as 2.5, or counts in ",
        ),
        ("SetCjcOffset offset=1A", 2, "offset: '1A' is not a value in degC"),
        ("SetCjcOffset offset=", 2, "offset: '' is not a value in degC"),
        ("SetCjcOffset offset=50", 1, "offset cannot be 50: -40.96..40.96 degC in steps of 0.01, manual 2.18"),
        ("SetCjcOffset offset=700", 1, "offset cannot be 700: -655.35..655.35 degC in steps of 0.01, manual 2.18"),
        ("SetCjcOffset offset=1388h", 1, "offset cannot be 1388h: -4096..+4096 counts of 0.01 degC, manual 2.18"),
        ("SetCjcOffset channel=0 offset=400 --protocol rtu", 1, "400: -327.68..327.67 degC in steps of 0.01, manual "),
        ("SetHostWatchdogTimeout enabled=1 timeout=100h", 1, "100h: 0..255 or 00h..FFh, counts of 0.1 s, manual 2.39"),
        ("SetSoftInitTimeout timeout=61", 1, "timeout cannot be 61: 0..60 s, manual 2.34\n"),
        (
            "SetHostWatchdogTimeout enabled=1 timeout=30s",
            1,
            "timeout cannot be 30s: 0..25.5 s in steps of 0.1, manual ",
        ),
        ("SetCjcOffset channel=81h offset=13 --protocol rtu", 2, "offset: 13 is not within -12.8..12.7 degC"),
        ("SetCjcOffset channel=81h offset=0x8000 --protocol rtu", 1, "offset cannot be 0x8000: -32768..32767, counts "),
    ],
)
def test_a_value_that_its_unit_does_not_have_is_refused(run: Run, arguments: str, code: int, message: str) -> None:
    result = run("encode", *arguments.split(), "address=1")

    assert message in result.err
    assert (code, "") == (result.code, result.out)


@pytest.mark.parametrize(
    ("name", "missing"),
    [
        ("SetCjcOffset address=1", "offset=... (a number, in degC)\n"),
        ("SetCjcUpdate address=1", "update=... (stopped, started, once)\n"),
        ("SetCjcEnabled address=1", "enabled=... (true or false)\n"),
        ("SetChannelMask address=1", "mask=... (a number, or channels=...)\n"),
        ("SetChannelTypeCode address=1 channel=1", "type_code=... (two hex digits or a name such as K)\n"),
        ("AnalogInputs", "values=... (with commas between)\n"),
    ],
)
def test_a_field_that_is_missing_is_named_with_how_it_is_written(run: Run, name: str, missing: str) -> None:
    result = run("encode", *name.split())

    assert result.err.endswith(f" needs {missing}")
    assert result.code == 2


# --- registers by name ------------------------------------------------------------------------------------------------


@each(("registers", "row"), ROWS)
def test_a_row_is_read_by_its_name(registers: RegisterMap, row: Register) -> None:
    request: Any = make(READERS[row.area], ("address=1", f"start={row.name}"), registers)

    assert (row.address, registers.read(1, row.name).count) == (request.start, request.count)


@pytest.mark.parametrize(
    ("arguments", "body"),
    [
        ("WriteSingleRegister register=host_watchdog_timeout value=2.5", "010601E80019"),
        ("WriteSingleRegister register=488 value=2.5s", "010601E80019"),
        ("WriteSingleRegister register=1E8h value=0x19", "010601E80019"),
        ("WriteSingleRegister register=module_cjc_offset value=-0.5", "010601EAFFCE"),
        ("WriteSingleRegister register=module_cjc_offset value=0xFFCE", "010601EAFFCE"),
        ("WriteSingleRegister register=module_cjc_offset value=0x32", "010601EA0032"),
        ("WriteSingleRegister register=type_code value=K", "01060100000F"),
        ("WriteSingleRegister register=line_settings value=86h", "010601E50086"),
        ("WriteSingleRegister register=cjc_update value=once", "010601EC0002"),
        ("WriteSingleRegister register=channel_mask value=0x0F", "010601E9000F"),
        ("WriteMultipleRegisters start=type_code values=K,J,0F", "011001000003 06 000F000E000F"),
        ("WriteMultipleRegisters start=host_watchdog_timeout values=2.5,15", "011001E8000204 0019000F"),
        ("WriteSingleCoil coil=protocol value=dcon", "010501000000"),
        ("WriteSingleCoil coil=protocol value=rtu", "01050100FF00"),
        ("WriteSingleCoil coil=filter value=50hz", "01050102FF00"),
        ("WriteSingleCoil coil=260 value=on", "01050104FF00"),
        ("WriteMultipleCoils start=cjc_enabled values=true,hex", "010F010B000201 01"),
        ("ReadHoldingRegisters start=480 count=6", "010301E00006"),
        ("ReadInputRegisters start=analog_input", "010400000008"),
        ("ReadInputRegisters start=analog_input count=2", "010400000002"),
        ("ReadHoldingRegisters start=600 count=2 --force", "010302580002"),
        ("ReadHoldingRegisters start=type_code --force", "010301000008"),
        ("WriteSingleRegister register=host_watchdog_timeout value=300 --force", "010601E8012C"),
    ],
)
def test_registers_are_named_and_values_are_in_units(run: Run, arguments: str, body: str) -> None:
    frame = encoded(run, f"{arguments} address=1 --protocol rtu --model M-7019R")

    assert seal(bytes.fromhex(body)).hex(" ").upper() == frame


@pytest.mark.parametrize(
    ("model", "arguments", "body"),
    [
        ("M-7018", "WriteSingleRegister register=352 value=-0.5", "0106016000FB"),
        ("M-7018", "WriteSingleRegister register=352 value=0xFB", "0106016000FB"),
        ("M-7017mC-16", "WriteMultipleRegisters start=rtc_epoch values=1000000", "011000100002044240000F"),
        ("M-7019R", "WriteSingleCoil coil=sampling_rate value=1", "01050111FF00"),
    ],
)
def test_a_value_is_written_as_the_map_of_the_model_has_it(run: Run, model: str, arguments: str, body: str) -> None:
    frame = encoded(run, f"{arguments} address=1 --protocol rtu --model {model}")

    assert seal(bytes.fromhex(body)).hex(" ").upper() == frame


def test_the_values_of_a_row_have_their_words(run: Run) -> None:
    options = ("--protocol", "rtu", "--model", "M-7019R")
    result = run("encode", "WriteSingleCoil", "address=1", "coil=sampling_rate", "value=8 Hz", *options)

    assert result.out.startswith("01 05 01 11 FF 00")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("WriteSingleRegister register=40489 value=1",
         "register: 40489 is the number of host_watchdog_timeout; its address in frames is register=488"),
        ("WriteSingleRegister register=40258 value=K",
         "register: 40258 is the number of type_code; its address in frames is register=257\n"),
        ("ReadInputRegisters start=30001 count=8",
         "start: 30001 is the number of analog_input; its address in frames is start=0"),
        ("ReadHoldingRegisters start=30001 count=8",
         "start: 30001 is the number of analog_input at address 0 of the input registers; Read"),
        ("ReadHoldingRegisters start=400489 count=1", "400489 is the number of host_watchdog_timeout; its address in "),
        ("ReadHoldingRegisters start=49000 count=8", "start: 49000 is the number of a holding register; its address "),
        ("WriteSingleCoil coil=00257 value=dcon", "coil=256 or coil=protocol"),
        ("WriteSingleCoil coil=host_watchdog_timeout value=1",
         "coil: host_watchdog_timeout of M-7019R is a holding register, not a coil"),
        ("WriteSingleRegister register=protocol value=1", "register: protocol of M-7019R is a coil, not a holding "),
        ("ReadCoils start=analog_input", "analog_input of M-7019R is an input register, not a coil"),
        ("WriteSingleRegister register=wachdog value=1", "register 'wachdog'; did you mean host_watchdog_timeout?\n"),
        ("WriteSingleRegister register=host_watchdog value=1", "; did you mean host_watchdog_timeout or "),
        ("WriteSingleRegister register=1E8 value=1", "'1E8' has hex digits: write 0x1E8 or 1E8h"),
        ("WriteSingleRegister register=line_settings value=86", "line_settings: '86' can be hex or decimal"),
        ("WriteSingleRegister register=response_delay value=1.5", "response_delay: 1.5 is not a multiple of 1 ms"),
        ("WriteSingleRegister register=channel_mask value=1A", "channel_mask: '1A' has hex digits"),
        ("WriteSingleRegister register=channel_mask value=1.5", "channel_mask: 1.5 is not a multiple of 1\n"),
        ("WriteSingleRegister register=488", "WriteSingleRegister needs value=... (0..65535)"),
        ("WriteSingleRegister value=1", "WriteSingleRegister needs register=... (0..65535)"),
        ("ReadHoldingRegisters start=480", "ReadHoldingRegisters needs count=... (1..125)"),
        ("WriteSingleRegister register=488 value=1,2", "value: WriteSingleRegister writes one, and this is 2: use "),
    ],
)  # fmt: skip
def test_what_cannot_be_a_register_is_refused_with_what_can(run: Run, arguments: str, message: str) -> None:
    result = run("encode", *arguments.split(), "address=1", "--protocol", "rtu", "--model", "M-7019R")

    assert message in result.err
    assert (result.code, result.out) == (2, "")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("WriteSingleRegister register=500 value=1",
         "M-7019R has no holding register at address 500, 40501 in the manual: i7000 registers --model M-7019R lists"),
        ("ReadHoldingRegisters start=480 count=40", "M-7019R has no holding register at address 486, 40487 in the "),
        ("ReadHoldingRegisters start=600 count=9999", "M-7019R has no holding register at address 600"),
        ("WriteSingleRegister register=firmware_version value=1",
         "firmware_version cannot be written: it can only be read\n"),
        ("ReadHoldingRegisters start=65536 count=1", "start cannot be 65536: 0..65535, manual 3.4\n"),
        ("ReadHoldingRegisters start=9999 count=1", "M-7019R has no holding register at address 9999: i7000 registers"),
        ("ReadCoils start=271 count=1", "load_factory_calibration cannot be read: it can only be written\n"),
        ("ReadCoils start=load_factory_calibration", "load_factory_calibration"),
        ("WriteSingleRegister register=488 value=30",
         "host_watchdog_timeout cannot be 30: 0..25.5 s in steps of 0.1, manual 3.4"),
        ("WriteSingleRegister register=488 value=0x100", "host_watchdog_timeout cannot be 0x100: 0..25.5 s in steps "),
        ("WriteSingleRegister register=host_watchdog_timeout_count value=5", "timeout_count cannot be 5: 0"),
        ("WriteMultipleRegisters start=type_code values=K,V_150", "type_code cannot be V_150: "),
    ],
)  # fmt: skip
def test_what_the_model_does_not_take_is_refused(run: Run, arguments: str, message: str) -> None:
    result = run("encode", *arguments.split(), "address=1", "--protocol", "rtu", "--model", "M-7019R")

    assert message in result.err
    assert (result.code, result.out) == (1, "")


def test_a_word_of_a_longer_number_cannot_be_written_alone(run: Run) -> None:
    arguments = "WriteSingleRegister address=1 register=16 value=1 --protocol rtu --model M-7017mC-16"

    assert "use WriteMultipleRegisters" in run("encode", *arguments.split()).err


def test_names_of_registers_need_a_model(run: Run) -> None:
    result = run("encode", *["ReadHoldingRegisters", "address=1", "start=type_code", "count=1", "--protocol", "rtu"])

    assert "start: 'type_code' is not a number, and names of registers need --model\n" in result.err
    assert result.code == 2


def test_without_a_model_values_are_the_numbers_of_the_frame(run: Run) -> None:
    frame = encoded(run, "WriteSingleRegister address=1 register=488 value=25 --protocol rtu")

    assert seal(bytes.fromhex("010601E80019")).hex(" ").upper() == frame


@pytest.mark.parametrize("options", ["", "--model M-7019R --force"])
def test_a_number_of_the_manual_in_place_of_an_address_is_encoded_with_a_note(run: Run, options: str) -> None:
    result = run("encode", *f"ReadHoldingRegisters address=1 start=40489 count=1 {options}".split())

    note = "start=40489: 40489 looks like a number of the manual; its address in frames is 488"
    assert (result.code, result.out, result.err) == (0, "01 03 9E 29 00 01 7A 2A\n", f"i7000: {note}\n")


@pytest.mark.parametrize("start", ["488", "0x9E29", "10000"])
def test_other_addresses_are_encoded_without_a_note(run: Run, start: str) -> None:
    result = run("encode", *f"ReadHoldingRegisters address=1 start={start} count=1".split())

    assert (result.code, result.err) == (0, "")


def test_what_every_model_allows_is_named_if_all_refuse_a_value(run: Run) -> None:
    result = run("encode", "ReadChannelTypeCode", "address=1", "channel=16")

    assert result.err == (
        "i7000: no model accepts it: channel cannot be 16: "
        "0..7 on I-7017R, M-7017R, M-7017RMS, I-7018R, M-7018R, I-7019R, M-7019R; "
        "0..9 on I-7017Z, M-7017Z, I-7018Z, M-7018Z, M-7019Z; 0..15 on M-7017mC-16, manual 2.16\n"
    )


def test_where_models_allow_too_much_to_be_named_the_first_stands_for_them(run: Run) -> None:
    result = run("encode", "SetChannelTypeCode", "address=1", "channel=1", "type_code=50")

    assert result.err.endswith("MA_0_20 on I-7017R, manual 2.15\n")
