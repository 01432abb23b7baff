"""How modules are described on the command line."""

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from i7000 import BaudRate, CharacterFormat, DataFormat, Filter, LineSettings, ModbusDataFormat, Model, TypeCode
from i7000.cli.module import read_module
from i7000.cli.words import UsageError
from i7000.device import Eeprom, factory, power_on
from i7000.settings import Protocol
from i7000.strategies import firmwares
from tests.terminal import refusal


def module(text: str) -> Eeprom:
    return read_module(text, 0x01).eeprom


def refusal_of_module(text: str) -> str:
    return refusal(lambda: module(text)).removeprefix(f"--model {text}: ")


# --- modules ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("model", Model)
def test_a_model_alone_is_the_module_from_the_factory(model: Model) -> None:
    assert module(model.value) == factory(model)


@given(st.sampled_from(Model), firmwares())
def test_every_firmware_can_be_given(model: Model, firmware: object) -> None:
    assert str(firmware) == str(module(f"{model.value}@{firmware}").firmware)


def test_the_address_in_the_description_replaces_the_default() -> None:
    assert [read_module(text, 0x07).eeprom.address for text in ("I-7018", "I-7018,address=02")] == [7, 2]


def test_the_init_switch_is_set_if_given() -> None:
    assert [read_module(text, 1).init_switch for text in ("I-7018", "I-7018,init=true", "I-7018,init=no")] == [
        False,
        True,
        False,
    ]


@pytest.mark.parametrize(
    ("text", "field", "value"),
    [
        ("i-7018@b2.9".upper(), "model", Model.I_7018),
        ("m-7019r", "model", Model.M_7019R),
        ("M-7019R,address=0x0a", "address", 0x0A),
        ("M-7019R, address = ffh", "address", 0xFF),
        ("M-7019R,address=10", "address", 10),
        ("M-7019R,type=K", "type_codes", (TypeCode.K,) * 8),
        ("M-7019R,type=K/J/T/05/V_10/ma_4-20/0x0E/B", "type_codes",
         (TypeCode.K, TypeCode.J, TypeCode.T, TypeCode.V_2_5, TypeCode.V_10, TypeCode.MA_4_20, TypeCode.J, TypeCode.B)),
        ("M-7017Z,type=" + "/".join(["V_5"] * 10), "type_codes", (TypeCode.V_5,) * 10 + (TypeCode.V_10,) * 10),
        ("M-7017Z,type=" + "/".join(["V_5"] * 20), "type_codes", (TypeCode.V_5,) * 20),
        ("M-7019R,protocol=dcon", "protocol", Protocol.DCON),
        ("M-7019R,protocol=RTU", "protocol", Protocol.MODBUS_RTU),
        ("I-7018,baud=115200", "line_settings", LineSettings(BaudRate.BAUD_115200)),
        ("I-7018,baud=1200,character_format=e81", "line_settings",
         LineSettings(BaudRate.BAUD_1200, CharacterFormat.E81)),
        ("M-7019R,modbus_format=engineering", "modbus_data_format", ModbusDataFormat.ENGINEERING),
        ("M-7019R,response_delay=30", "response_delay", 30),
        ("M-7017Z,protocol=rtu,single_ended=true", "single_ended", True),
        ("M-7019R,mask=0x3F", "channel_mask", 0x3F),
        ("M-7019R,mask=3Fh", "channel_mask", 0x3F),
        ("M-7019R,mask=3", "channel_mask", 0b11),
        ("M-7019R,channels=0/1/3", "channel_mask", 0b1011),
        ("M-7019R,channels=0-2/7", "channel_mask", 0b10000111),
        ("M-7019R,channels=3", "channel_mask", 0b1000),
        ("M-7017Z,channels=all", "channel_mask", 0xFFFFF),
        ("M-7019R,name=BOILER", "name", "BOILER"),
        ("M-7019R,open_wire_detection=false", "open_wire_detection", False),
        ("M-7019R,cjc_enabled=off", "cjc_enabled", False),
        ("M-7019R,cjc_offset=-0.29", "cjc_offset", -29),
        ("M-7019R,cjc_offset=40.96degC", "cjc_offset", 4096),
        ("M-7019R,channel_offsets=1.5", "channel_offsets", (15,) * 8),
        ("M-7019R,channel_cjc_offsets=0/1/2/3/4/5/6/0.07", "channel_cjc_offsets", (0, 100, 200, 300, 400, 500, 600, 7)),
        ("M-7019R,host_watchdog_enabled=yes", "host_watchdog_enabled", True),
        ("M-7019R,host_watchdog_timeout=2.5", "host_watchdog_timeout", 25),
    ],
)  # fmt: skip
def test_settings_that_are_given_are_those_of_the_module(text: str, field: str, value: object) -> None:
    assert value == getattr(module(text), field)


@pytest.mark.parametrize(
    ("text", "field", "value"),
    [
        ("I-7018,checksum=true", "checksum", True),
        ("I-7018,format=hex", "data_format", DataFormat.HEX),
        ("I-7018,format=PERCENT", "data_format", DataFormat.PERCENT),
        ("I-7017R,fast_mode=true", "fast_mode", True),
        ("I-7017F,fast_mode=false", "fast_mode", False),
        ("I-7018,filter=50Hz", "filter", Filter.REJECT_50_HZ),
        ("I-7018,filter=reject_60_hz", "filter", Filter.REJECT_60_HZ),
    ],
)
def test_reports_are_set_by_their_parts(text: str, field: str, value: object) -> None:
    assert value == getattr(module(text).report_settings, field)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "--model '': there is no model ''; models have names such as I-7017, M-7018R and M-7019Z"),
        ("I-7020", "there is no model 'I-7020'; did you mean I-7018, "),
        ("M-7019X", "there is no model 'M-7019X': I-7019R, M-7019R, M-7019Z"),
        ("M-7019R@", "firmware cannot be '': a letter, a digit and a minor number"),
        ("M-7019R@3.7", "firmware cannot be '3.7': a letter"),
        ("M-7019R,", "'' is not name=value"),
        ("M-7019R,checksum", "'checksum' is not name=value"),
        ("M-7019R,xyzzy=2", "a module has no setting 'xyzzy': the settings are address, type, "),
        ("M-7019R,adress=2", "a module has no setting 'adress'; did you mean address?"),
        ("M-7019R,type=K,type=J", "type is given twice"),
        ("M-7019R,address=300", "address cannot be 300"),
        ("M-7019R,address=1A", "address: '1A' has hex digits: write 0x1A or 1Ah"),
        ("M-7019R,address=x", "address: 'x' is not a whole number: write it in decimal, or in hex as 0x1A or 1Ah"),
        ("M-7019R,type=Q", "type: 'Q' is not a type"),
        ("M-7019R,type=mixed", "type: type FF is not defined"),
        ("M-7019R,type=K/J", "type: 'K/J' has 2 values: M-7019R takes 1 or 8, with / between them"),
        ("M-7017Z,type=V_5/V_5", "type: 'V_5/V_5' has 2 values: M-7017Z takes 1 or 10 or 20, with / "),
        ("I-7018,type=V_10", "type cannot be V_10: MV_15 MV_50 "),
        ("I-7018,type=K/K/K/K/K/K/K/J", "type cannot be K/K/K/K/K/K/K/J: one type for all channels"),
        ("M-7019R,protocol=modbus", "protocol: 'modbus' is not one of dcon, rtu"),
        ("M-7019R,protocol=dkon", "protocol: 'dkon' is not one of dcon, rtu; did you mean dcon?"),
        ("I-7018,protocol=rtu", "protocol cannot be rtu: DCON: I-7018 has no Modbus"),
        ("I-7018,baud=14400", "baud: 14400 is not a baud rate: give one of 1200, 2400"),
        ("I-7018,baud=2", "baud: 2 is not a baud rate: give one of 1200, 2400"),
        ("I-7018,character_format=E71", "character_format: 'E71' is not one of n81, n82, e81, o81"),
        ("I-7018@B2.8,character_format=E81", "character_format cannot be E81: N81 with firmware before B2.9"),
        ("I-7018,format=decimal", "format: 'decimal' is not one of engineering, percent, hex"),
        ("I-7018,checksum=maybe", "checksum: 'maybe' is not true or false"),
        ("I-7018,fast_mode=true", "fast_mode cannot be true: I-7018 has no fast mode"),
        ("I-7018,filter=55hz", "filter: '55hz' is not one of 50hz, 60hz, reject_60_hz, reject_50_hz"),
        ("M-7019R@B2.6,filter=50hz", "filter cannot be 50hz: REJECT_60_HZ"),
        ("I-7018,modbus_format=hex", "I-7018 has no modbus_format: M-7000 series only"),
        ("I-7018,response_delay=1", "I-7018 has no response_delay: M-7000 series only"),
        ("M-7019R,response_delay=31", "response_delay cannot be 31: 0..30"),
        ("M-7019R,response_delay=1ms", "response_delay: '1ms' is not a whole number"),
        ("M-7019R,single_ended=true", "single_ended cannot be true: 7017Z only"),
        ("M-7019R,mask=0x1FF", "mask cannot be 0x1FF: 0..255"),
        ("M-7019R,channels=8", "channels: there is no channel 8: 0..7"),
        ("M-7019R,channels=3F", "channels: '3F' is not a channel: give 0..7, a range such as 0-7, or all"),
        ("M-7019R,mask=3F", "mask: '3F' has hex digits: write 0x3F or 3Fh"),
        ("M-7019R,mask=1,channels=0", "give mask or channels: they are the same"),
        ("M-7019R,name=", "name cannot be empty: "),
        ("M-7019R,name=TOOLONG", "name cannot be TOOLONG"),
        ("I-7018,open_wire_detection=true", "I-7018 has no open_wire_detection: models that notice"),
        ("M-7017,cjc_offset=1", "M-7017 has no cjc_offset: 7018 and 7019 series only"),
        ("I-7018,channel_cjc_offsets=1", "I-7018 has no channel_cjc_offsets: 7019 series only"),
        ("M-7019R,cjc_offset=0.125", "cjc_offset: '0.125' is not within -40.96..40.96 degC in steps of 0.01"),
        ("M-7019R,cjc_offset=41", "cjc_offset: '41' is not within -40.96..40.96 degC"),
        ("M-7019R,cjc_offset=1e308", "cjc_offset: '1e308' is not within -40.96..40.96 degC"),
        ("M-7019R,cjc_offset=1mV", "cjc_offset: '1mV' is not within -40.96..40.96 degC"),
        ("M-7019R,channel_offsets=-12.9", "channel_offsets: '-12.9' is not within -12.8..12.7 degC in steps of 0.1"),
        ("M-7019R,host_watchdog_timeout=25.6", "host_watchdog_timeout: '25.6' is not within 0..25.5 in steps of 0.1"),
        ("M-7019R,host_watchdog_timeout=long", "host_watchdog_timeout: 'long' is not a quantity"),
    ],
)
def test_a_module_that_there_is_not_is_refused_with_the_reason(text: str, message: str) -> None:
    assert refusal_of_module(text).startswith(message)


def test_a_refusal_begins_with_what_was_written() -> None:
    with pytest.raises(UsageError, match=r"^--model I-7018,baud=1: baud: "):
        read_module("I-7018,baud=1", 1)


def test_a_misspelt_name_is_answered_with_suggestions() -> None:
    assert refusal_of_module("I-7018,checksums=true").endswith("; did you mean checksum?")


def test_more_modules_than_addresses_are_refused() -> None:
    with pytest.raises(UsageError, match="address cannot be 256"):
        read_module("I-7018", 0x100)


NAMES = (
    "address",
    "type",
    "protocol",
    "baud",
    "format",
    "filter",
    "mask",
    "channels",
    "cjc_offset",
    "name",
    "x",
    "single_ended",
)
WORDS = ("02", "K", "K/J", "rtu", "9600", "hex", "50hz", "0x3F", "0/1", "0.5", "1e400", "true", "-1", "")
SAID = st.builds("{}={}".format, st.sampled_from(NAMES), st.sampled_from(WORDS) | st.text(max_size=4))


@given(
    st.builds(lambda model, said: ",".join((model.value, *said)), st.sampled_from(Model), st.lists(SAID, max_size=4))
)
def test_any_settings_are_a_module_or_refused(text: str) -> None:
    message = refusal(lambda: power_on(module(text), now=0.0))

    assert not message or message.startswith(f"--model {text or repr(text)}: ")


@given(st.text())
@example("M-7019R@B3.7@")
def test_any_text_is_a_module_or_refused(text: str) -> None:
    message = refusal(lambda: power_on(module(text), now=0.0))

    assert not message or message.startswith(f"--model {text or repr(text)}: ")


def test_a_description_takes_both_words_for_modbus_rtu() -> None:
    short, whole = (read_module(f"M-7018,protocol={word}", 0x01).eeprom for word in ("rtu", "modbus_rtu"))

    assert short == whole
