"""The Modbus half of the command line: frames in hex, exchanges, registers by name."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import ModbusDataFormat, Model, Protocol, TypeCode, modbus
from i7000.cli.message import MODBUS, encode, find, make
from i7000.dissect import Known
from i7000.modbus import seal
from tests.each import each
from tests.spec.lint import Record, rows
from tests.terminal import Run, known_of, logged
from tests.vectors import modbus_message_of, modbus_vectors, written_modbus_vectors

ASK = "01 04 00 00 00 08 F1 CC"
FRAME = bytes.fromhex(ASK)
M_7019R = {"model": Model.M_7019R, "types": (TypeCode.K,)}


def told(*bodies: str, **known: Any) -> list[Record]:
    """The records of a log that has frames in its lines: address and PDU in hex, to which the CRC is put."""
    return logged(
        *(seal(bytes.fromhex(body)).hex() for body in bodies), known=Known(**known), protocol=Protocol.MODBUS_RTU
    )


def texts(record: Record) -> list[tuple[str, str | None, str | None]]:
    return [(cell["number"], cell["name"], cell["text"]) for cell in record["registers"]]


# --- decode: the vectors ----------------------------------------------------------------------------------------------


def log_of(vector: Record) -> list[str]:
    wires = [vector["request_wire"], vector["response_wire"]]
    return [wire for wire in wires if wire]


def printed(fields: Record) -> Record:
    """The fields of a vector as the terminal prints them: bits as truth values."""
    values = fields.get("values")
    return fields | {"values": [bit == "1" for bit in values]} if isinstance(values, str) else fields


@pytest.mark.parametrize("model_is_known", [True, False])
@each("vector", modbus_vectors("response", "exception", "silence"))
def test_an_exchange_is_shown_as_the_vector_says(vector: Record, *, model_is_known: bool) -> None:
    known = known_of(vector) if model_is_known else Known()

    records = logged(*log_of(vector), known=known, protocol=Protocol.MODBUS_RTU)

    messages = [vector["request"], vector["response"]][: len(records)]
    assert [(message["type"], printed(message["fields"])) for message in messages] == [
        (record["name"], record["fields"]) for record in records
    ]
    assert [record["direction"] for record in records] == ["request", "response"][: len(records)]
    assert [record["wire"] for record in records] == log_of(vector)
    assert [record["error"] for record in records] == [None] * len(records)


DAMAGED = [case for case in modbus_vectors("reject") if log_of(case.values[0])]


@each("vector", DAMAGED)
def test_a_damaged_frame_has_the_fault_of_the_vector_or_is_something_else(vector: Record) -> None:
    *_, record = logged(*log_of(vector), known=known_of(vector), protocol=Protocol.MODBUS_RTU)

    # What is no response can be a request or its echo, and what is no request a response.
    otherwise = ("response",) if vector["response_wire"] is None else ("request", "echo")
    assert record["fault"] == vector["fault"] or (record["fault"] is None and record["direction"] in otherwise)


@each("vector", DAMAGED)
def test_a_damaged_frame_of_an_unknown_module_is_shown_too(vector: Record) -> None:
    *_, record = logged(*log_of(vector), protocol=Protocol.MODBUS_RTU)

    assert record["error"] or record["name"]


# --- decode: who said it ----------------------------------------------------------------------------------------------


def test_every_record_has_the_same_keys(run: Run) -> None:
    frames = [seal(bytes.fromhex(body)).hex() for body in ("010400000001", "01040200FA", "0304020001")]
    records = run("decode", "--protocol", "rtu", "--json", *frames, "nothing", "01").records
    records += run("decode", "--json", "$012", "$01A", "nothing").records

    assert len({tuple(record) for record in records}) == 1


def test_a_response_is_read_with_the_request_before_it() -> None:
    request, response = told("010301E80001", "0103020064")

    assert (request["command"], request["answers"]) == (None, None)
    assert (response["name"], response["command"], response["answers"]) == (
        "HoldingRegisters", "ReadHoldingRegisters", 1,
    )  # fmt: skip


def test_a_response_alone_is_read_as_far_as_possible() -> None:
    (record,) = told("01040400FA00FB", **M_7019R)

    assert (record["direction"], record["name"], record["note"]) == (
        "response", "InputRegisters", "read without its request",
    )  # fmt: skip
    assert record["explained"]["values"] == "00FA 00FB"
    assert record["registers"] == []


def test_coils_alone_are_shown_with_their_spare_bits() -> None:
    (record,) = told("01010105")

    assert record["explained"]["values"] == "1 0 1 0 0 0 0 0"


def test_an_exception_alone_is_read() -> None:
    (record,) = told("018402")

    assert record["explained"] == {"address": "01", "function": "04", "exception_code": "02, illegal data address"}


def test_an_exception_names_what_was_asked() -> None:
    _, record = told("0146070000", "01C603")

    assert (record["name"], record["command"], record["section"]) == ("ExceptionResponse", "ReadTypeCode", "3.3.5")


def test_a_second_response_is_read_alone() -> None:
    *_, record = told("010301E80001", "0103020064", "0103020064")

    assert (record["answers"], record["note"]) == (None, "read without its request")


def test_a_response_after_a_request_to_all_modules_is_read_alone() -> None:
    *_, record = told("000601E80064", "0103020064")

    assert record["note"] == "read without its request"


def test_a_request_that_could_be_a_response_has_a_note() -> None:
    first, second = told("010601E80064", "010601E80064")

    assert (first["direction"], first["note"]) == (
        "request", "or a response, SingleRegisterWritten, of which the request is not there",
    )  # fmt: skip
    assert (second["direction"], second["answers"], second["note"]) == ("response", 1, None)


def test_after_an_exchange_a_request_is_not_doubted() -> None:
    *_, record = told("010301E80001", "0103020064", "010601E80064")

    assert (record["direction"], record["note"]) == ("request", None)


def test_an_echo_is_noticed() -> None:
    _, echo, response = told("010301E80001", "010301E80001", "0103020064")

    assert (echo["direction"], echo["name"], echo["answers"]) == ("echo", "ReadHoldingRegisters", None)
    assert echo["note"] == "the same as line 1: a 2-wire adapter's echo, or asked again"
    assert (response["direction"], response["answers"]) == ("response", 1)


def test_on_a_line_that_echoes_what_is_the_same_is_an_echo_first() -> None:
    read = ["010301E80001", "010301E80001", "0103020064"]
    write = ["010601E80064"] * 3

    assert [record["direction"] for record in told(*read, *write)] == ["request", "echo", "response"] * 2


def test_a_request_to_all_modules_is_echoed_too() -> None:
    assert [record["direction"] for record in told("000601E80064", "000601E80064")] == ["request", "echo"]


def test_the_third_time_it_is_asked_again() -> None:
    records = told("010301E80001", "010301E80001", "010301E80001", "0103020064")

    assert [record["direction"] for record in records] == ["request", "echo", "request", "response"]
    assert records[3]["answers"] == 3


def test_a_request_may_have_no_response() -> None:
    _, second, response = told("010301E80001", "010400000001", "01040200FA")

    assert (second["direction"], second["note"]) == ("request", None)
    assert response["answers"] == 2


def test_a_write_that_does_not_repeat_the_one_before_could_be_its_response() -> None:
    _, record = told("010601E80064", "010601E80065")

    assert record["direction"] == "request"
    assert record["note"].startswith("or a wrong response to line 1: echo at byte 5 of ")


def test_the_answer_of_another_module_is_an_error_and_shown_alone() -> None:
    _, late, right = told("010301E80001", "0203020001", "0103020064")

    assert (late["fault"], late["direction"], late["answers"]) == ("address", "response", None)
    assert [candidate["name"] for candidate in late["candidates"]] == ["HoldingRegisters"]
    assert right["answers"] == 1


def test_a_damaged_frame_could_have_been_a_request() -> None:
    ask, answer = (seal(bytes.fromhex(body)).hex() for body in ("010301E80001", "0103020064"))
    *_, record = logged(ask, "01 03 01 E9 00 01 00 00", answer, protocol=Protocol.MODBUS_RTU)

    assert (record["direction"], record["answers"]) == ("response", None)


def test_noise_that_is_no_frame_does_not_part_an_exchange() -> None:
    ask, answer = (seal(bytes.fromhex(body)).hex(" ") for body in ("010301E80001", "0103020064"))
    *_, noise, record = logged(ask, f"00 {answer}", protocol=Protocol.MODBUS_RTU)

    assert (noise["wire"], noise["fault"], record["answers"]) == ("00", "length", 1)


@pytest.mark.parametrize(
    ("body", "fault"),
    [("0107", "function"), ("0187", "function"), ("01461F", "sub_function"), ("0146", "length"),
     ("F8030200FA", "address"), ("00030200FA", "address")],
)  # fmt: skip
def test_what_is_no_message_has_a_fault(body: str, fault: str) -> None:
    (record,) = told(body)

    assert (record["fault"], record["direction"], record["name"]) == (fault, None, None)


# --- decode: registers and fields -------------------------------------------------------------------------------------


def test_registers_have_names_and_values_in_units() -> None:
    request, response = told("010301E70002", "01030400050064", **M_7019R)

    assert texts(request) == [("40488", "response_delay", None), ("40489", "host_watchdog_timeout", None)]
    assert response["registers"][1] == {
        "number": "40489", "name": "host_watchdog_timeout", "channel": None, "value": 10.0, "unit": "s", "status": None,
        "text": "10 s",
    }  # fmt: skip


def test_registers_have_only_numbers_without_a_model() -> None:
    request, response = told("010301E70002", "01030400050064")

    assert texts(request) == [("40488", None, None), ("40489", None, None)]
    assert texts(response) == [("40488", None, "0005"), ("40489", None, "0064")]


@pytest.mark.parametrize(
    ("request_body", "response_body", "cells"),
    [
        ("010101000001", "01010101", [("00257", "protocol", "modbus_rtu")]),
        ("010101040001", "01010101", [("00261", "host_watchdog_enabled", "yes")]),
        ("010200800002", "01020102", [("10129", "range_status", "no"), ("10130", "range_status", "yes")]),
        ("010301000001", "010302000F", [("40257", "type_code", "0F, thermocouple K, -270..1372 degC")]),
        ("010301200001", "010302FFF6", [("40289", "temperature_offset", "-1 degC")]),
        ("010301E00002", "010304030000 0B", [("40481", "firmware_version", "B3.0")]),
        ("010301E00001", "0103020300", [("40481", "firmware_version", "0300, word 1 of 2")]),
        ("010301E10001", "010302000B", [("40482", "firmware_version", "000B, word 2 of 2")]),
        ("010301E20002", "01030419000070", [("40483", "module_name", "M-7019 series")]),
        ("010301E50001", "0103020086", [("40486", "line_settings", "86, 9600 baud, E81")]),
        ("010301E50001", "0103020186", [("40486", "line_settings", "186, not defined")]),
        ("010301E90001", "010302000A", [("40490", "channel_mask", "0A, channels 1, 3")]),
        ("010301EC0001", "0103020002", [("40493", "cjc_update", "once")]),
        ("010301EC0001", "0103020007", [("40493", "cjc_update", "0007, not defined")]),
        ("010302000001", "010302ABCD", [("40513", None, "ABCD, not in the map")]),
        ("010601E80064", "010601E80064", [("40489", "host_watchdog_timeout", "10 s")]),
        ("0105010DFF00", "0105010DFF00", [("00270", "host_watchdog_timed_out", "yes")]),
        ("011001E8000204 00640001", "011001E80002",
         [("40489", "host_watchdog_timeout", None), ("40490", "channel_mask", None)]),
    ],
)  # fmt: skip
def test_a_register_is_shown_in_words(request_body: str, response_body: str, cells: list[Any]) -> None:
    _, record = told(request_body, response_body, **M_7019R)

    assert cells == texts(record)


def test_what_is_written_is_shown() -> None:
    coils, registers = told("010F01040002 01 01", "011001E8000204 00640001", **M_7019R)

    assert texts(coils) == [("00261", "host_watchdog_enabled", "yes"), ("00262", None, "0, not in the map")]
    assert texts(registers) == [
        ("40489", "host_watchdog_timeout", "10 s"), ("40490", "channel_mask", "01, channel 0"),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("data_format", "value"), [(ModbusDataFormat.ENGINEERING, 25.0), (ModbusDataFormat.HEX, 250 * 1372 / 32767)]
)
def test_analog_words_are_readings(data_format: ModbusDataFormat, value: float) -> None:
    _, record = told("010400020002", "01040400FA8000", modbus_data_format=data_format, **M_7019R)

    assert record["readings"] == [
        {"channel": 2, "text": "00FA", "status": "ok", "type_code": 15, "value": value, "unit": "degC"},
        {"channel": 3, "text": "8000", "status": "under_range", "type_code": 15, "value": None, "unit": "degC"},
    ]
    assert (record["data_formats"], record["assumed"], record["note"]) == ([data_format.name.lower()], [], None)


def test_what_is_assumed_of_readings_is_reported() -> None:
    _, record = told("010400000001", "01040200FA", model=Model.M_7017)

    assert record["assumed"] == ["type", "modbus_format"]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--model", "M-7019R", "--type", "K"], "modbus format as the broadcast of line 1 set"),
        (["--model", "M-7019R"], "the factory default of type\n{}modbus format as the broadcast of line 1 set"),
    ],
)
def test_what_a_broadcast_set_is_shown_as_assumed(run: Run, options: list[str], words: str) -> None:
    frames = (modbus.seal(bytes.fromhex(body)) for body in ("0005010CFF00", "010400000001", "01040200FA"))
    result = run("decode", *options, *(frame.hex(" ") for frame in frames))

    label = f"{'':5}  {'assumed':<15} "
    assert label + words.format(label) + "\n" in result.out
    assert result.code == 0


def test_a_word_of_a_channel_that_is_not_there_is_no_reading() -> None:
    _, record = told("0104000A0001", "01040200FA", model=Model.M_7017Z)

    assert (texts(record), record["readings"]) == ([("30011", "analog_input", "00FA")], [])


def test_the_log_of_the_m_7017mc_16_is_shown_record_by_record() -> None:
    words = [0x7FFF, *[0] * 15, 5, 0] * 6
    _, record = told(
        "010403E8006C",
        "0104D8" + "".join(f"{word:04X}" for word in words),
        model=Model.M_7017mC_16,
        types=(TypeCode.MA_4_20,),
        modbus_data_format=ModbusDataFormat.ENGINEERING,
    )

    assert len(record["registers"]) == 6
    assert texts(record)[1] == ("31001", "log_records", f"record 1, 5 s: over_range{' 0' * 15} mA")


def test_a_request_that_the_model_does_not_have_is_shown_all_the_same() -> None:
    (record,) = told("01462F", model=Model.M_7018)

    assert record["name"] == "ReadCjcUpdate"
    assert record["note"] == "M-7018 has no CJC update setting by Modbus: M-7019 series only"


@pytest.mark.parametrize(
    ("bodies", "explained"),
    [
        (["014600", "014600 00701700"], {"name": "00701700, M-7017 series"}),
        (["0146 0405000000", "0146 0400000000"], {"result": "00, done"}),
        (["0146 0500", "0146 05 00 86 000000 01 0000"],
         {"line_settings": "86, 9600 baud, E81", "protocol": "modbus_rtu"}),
        (["0146 06 00 06 000000 00 0000", "0146 06 00 00 000000 03 0000"],
         {"line_result": "00, done", "protocol_result": "03, not done"}),
        (["0146 07 0000", "0146 07 0F"], {"type_code": "0F, thermocouple K, -270..1372 degC"}),
        (["0146 20", "0146 20 0B 03 00"], {"major": "11", "minor": "3", "build": "0"}),
        (["0146 25", "0146 25 0A"], {"mask": "0A, channels 1, 3"}),
        (["0146 29", "0146 29 A0"], {"settings": "A0, 50 Hz rejected, fast mode"}),
        (["0146 2A 41"], {"settings": "41, 60 Hz rejected, normal mode, reserved bits 41"}),
        (["0146 2B 00"], {"channel": "00, the module"}),
        (["0146 2B 82"], {"channel": "82, channel 2"}),
        (["0146 2B 02"], {"channel": "02, not defined"}),
        (["0146 07 0002"], {"channel": "2"}),
        (["0146 2B 00", "0146 2B FFCE"], {"offset": "-0.50 degC"}),
        (["0146 2B 80", "0146 2B 00FB"], {"offset": "-0.5 degC"}),
        (["0146 2B 0032"], {"offset": "50, +0.50 degC if it is the module's"}),
        (["0146 2C 00 0032"], {"channel": "00, the module", "offset": "+0.50 degC"}),
        (["0146 2D 00", "0146 2D 01"], {"enabled": "yes"}),
        (["0146 2F", "0146 2F 02"], {"update": "once"}),
        (["0146 20", "01C6 0C"], {"function": "46", "exception_code": "0C, not defined"}),
    ],
)  # fmt: skip
def test_fields_are_shown_in_words(bodies: list[str], explained: Record) -> None:
    *_, record = told(*bodies)

    assert record["explained"] == {"address": "01"} | explained


def test_numbers_are_those_of_the_vectors() -> None:
    _, settings = told("0146 0500", "0146 05 00 86 000000 01 0000")
    _, name = told("014600", "014600 00701700")

    assert settings["fields"] == {"address": 1, "line_settings": 0x86, "protocol": 1}
    assert name["fields"] == {"address": 1, "name": "00701700"}


# --- decode: what is printed ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "words",
    [
        "1    > 01 04 00 00 00 08 F1 CC\n     ReadInputRegisters: input registers (manual 3.2; E55)\n",
        "       30001..30008    analog_input\n",
        "       answers         ReadInputRegisters, line 1\n",
        "       channel 0       00FA     25 degC\n",
        "       channel 1       7FFF     OVER_RANGE\n",
        "       type            0F, thermocouple K, -270..1372 degC\n",
        "       40489           host_watchdog_timeout  10 s\n",
        "       10130           range_status 1  yes\n",
        "       note            the same as line 5: a 2-wire adapter's echo, or asked again\n",
        "8    nothing\n       note            no frame in this line\n",
    ],
)
def test_a_log_is_shown_in_words(run: Run, words: str) -> None:
    write, read = seal(bytes.fromhex("010601E80064")).hex(" "), seal(bytes.fromhex("010200800002")).hex(" ")
    answer = seal(bytes.fromhex("010410 00FA 7FFF 0000 0000 0000 0000 0000 0000")).hex(" ")
    lines = [f"> {ASK}", f"< {answer}", write, write, read, read, seal(bytes.fromhex("01020102")).hex(), "nothing"]
    options = "--protocol rtu --model M-7019R --type K --modbus-format engineering"
    result = run("decode", *options.split(), stdin="\n".join(lines).encode())

    assert words in result.out
    assert (result.code, result.err) == (0, "")


def test_without_a_model_raw_registers_and_the_models_are_shown(run: Run) -> None:
    result = run("decode", "--protocol", "rtu", ASK, seal(bytes.fromhex("010410" + "00FA" * 8)).hex())

    assert "       30001..30008\n" in result.out
    assert "       30008           00FA\n" in result.out
    assert "       models          M-7000 series only\n" in result.out
    assert result.code == 0


def test_options_of_the_model_are_taken(run: Run) -> None:
    options = "--protocol rtu --model M-7017Z --single-ended --firmware B3.0 --modbus-format hex --json"
    (record,) = run("decode", *options.split(), seal(bytes.fromhex("014626 0FFFFF")).hex()).records

    assert record["fields"] == {"address": 1, "mask": 0xFFFFF}


def test_the_length_of_a_mask_leaves_the_models_that_have_it() -> None:
    (record,) = told("014626 0FFFFF")

    assert record["models"] == ["M-7017Z"]


@given(st.binary())
def test_no_log_makes_it_raise(log: bytes) -> None:
    records = logged(*log.decode("utf-8", "surrogateescape").split("\n"), protocol=Protocol.MODBUS_RTU)

    assert all(record["error"] or record["name"] or record["notes"] for record in records)


BODIES = st.binary(min_size=2, max_size=12) | st.sampled_from([1, 2, 3, 4, 5, 6, 15, 16, 0x46, 0x83]).flatmap(
    lambda function: st.binary(min_size=1, max_size=10).map(lambda rest: bytes((1, function)) + rest)
)


@given(st.lists(BODIES), st.sampled_from([None, Model.M_7017Z, Model.M_7017mC_16, Model.M_7019R]))
def test_no_frame_makes_it_raise(bodies: list[bytes], model: Model | None) -> None:
    records = told(*(body.hex() for body in bodies), model=model)

    assert all(record["error"] or record["name"] or record["notes"] for record in records)


# --- encode -----------------------------------------------------------------------------------------------------------


def assignments(fields: Record) -> tuple[str, ...]:
    """The fields of a vector as a person writes them."""

    def written(name: str, value: Any) -> str:
        if name == "type_code":
            return f"{value:02X}"
        if name in ("line_settings", "offset"):
            return f"{value:#x}"
        return ",".join(map(str, value)) if name == "values" else str(value)

    return tuple(f"{name}={written(name, value)}" for name, value in fields.items())


@each("vector", written_modbus_vectors("response", "exception", "silence"))
def test_a_request_is_written_as_the_vector_says(vector: Record) -> None:
    message = make(find(vector["request"]["type"], MODBUS), assignments(vector["request"]["fields"]))

    assert modbus_message_of(vector["request"]) == message
    force = bool({"host-refuses", "host-may-refuse"} & set(vector["flags"]))
    assert vector["request_wire"] == encode(message, known_of(vector), force=force).hex()


@each("vector", modbus_vectors("response", "exception"))
def test_a_response_is_made_of_its_fields(vector: Record) -> None:
    message = make(find(vector["response"]["type"], MODBUS), assignments(vector["response"]["fields"]))

    assert modbus_message_of(vector["response"]) == message


@pytest.mark.parametrize(
    ("arguments", "frame"),
    [
        ("ReadInputRegisters address=1 start=0 count=8", ASK),
        ("ReadModuleName address=1", "01 46 00 12 60"),
        ("WriteMultipleRegisters address=1 start=488 values=10,0x1F --model M-7019R",
         seal(bytes.fromhex("011001E8000204 0064001F")).hex(" ").upper()),
        ("WriteMultipleCoils address=1 start=0 values=true,off,1",
         seal(bytes.fromhex("010F0000000301 05")).hex(" ").upper()),
        ("WriteSingleCoil address=0 coil=0x10 value=on", seal(bytes.fromhex("00050010FF00")).hex(" ").upper()),
        ("SetCommunicationSettings address=1 baud_rate=9600 character_format=E81 protocol=modbus_rtu --model M-7019R",
         seal(bytes.fromhex("014606008600000001 0000")).hex(" ").upper()),
        ("SetChannelMask address=1 channels=1,3 --model M-7019R", seal(bytes.fromhex("0146260A")).hex(" ").upper()),
        ("ModuleName address=1 name=00701900", "01 46 00 00 70 19 00 0F 2D"),
    ],
)  # fmt: skip
def test_a_frame_is_written_in_hex(run: Run, arguments: str, frame: str) -> None:
    result = run("encode", "--protocol", "rtu", *arguments.split())

    assert result.out == f"{frame}\n"
    assert result.code == 0


def test_a_frame_is_written_as_json(run: Run) -> None:
    result = run("encode", "ReadModuleName", "address=1", "--protocol", "rtu", "--json")

    assert result.records == [
        {"name": "ReadModuleName", "section": "3.3.1", "frame": "01 46 00 12 60", "wire": "0146001260"}
    ]


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        ("ReadConfiguration address=1", 2, "ReadConfiguration is a message of the other protocol: add --protocol dcon"),
        ("ReadConfigurations address=1", 2, "there is no command or response 'ReadConfigurations'; did you mean "),
        ("ReadCoils address=1", 2, "ReadCoils needs start=... (0..65535), count=... (1..2000)"),
        ("SetChannelMask address=1 channels=1", 2, "give --model: 01 46 26 02 7B AC for M-7017, M-7017C, "),
        ("ModuleName address=1 name=7019Z", 2, "name: '7019Z' is not bytes in hex"),
        ("ReadModuleName address=1 --model I-7018", 2, "I-7018 does not speak Modbus: M-7000 series only"),
        ("ReadModuleName address=1 --single-ended --type K", 2, "--single-ended cannot be given"),
        ("ReadModuleName address=1 --checksum", 2, "--format and --checksum are for DCON"),
        ("ReadCjcUpdate address=1 --model M-7018", 1, "M-7018 has no CJC update setting by Modbus"),
        ("ReadCoils address=1 start=65535 count=2", 1, "count cannot be 2"),
    ],
)
def test_what_is_not_written_is_reported(run: Run, arguments: str, code: int, message: str) -> None:
    result = run("encode", "--protocol", "rtu", *arguments.split())

    assert message in result.err
    assert (result.code, result.out) == (code, "")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            "decode $012 --modbus-format hex --protocol dcon",
            "--modbus-format is for --protocol rtu; for DCON give --format",
        ),
        ("decode 01 --protocol rtu --format hex", "--format and --checksum are for DCON"),
        ("decode 01 --protocol rtu --model I-7018", "I-7018 does not speak Modbus"),
        ("decode 01 --protocol ascii", "ascii"),
        ("registers", "model"),
        ("registers --model I-7018", "I-7018 does not speak Modbus: M-7000 series only"),
    ],
)
def test_wrong_usage_is_reported(run: Run, arguments: str, message: str) -> None:
    result = run(*arguments.split())

    assert message in result.err
    assert (result.code, result.out) == (2, "")


# --- commands, registers ----------------------------------------------------------------------------------------------


def test_all_requests_are_listed_with_their_pdus_and_models(run: Run) -> None:
    records = run("commands", "--protocol", "rtu", "--json").records

    table = [row for row in rows("modbus_functions") if row["request"]] + rows("module_settings")
    listed = {record["name"]: record for record in records}
    assert len(records) == len(listed) == len(modbus.REQUESTS)
    for row in table:
        assert (row["request"], row["section"], row["models"]) == (
            listed[row["name"]]["syntax"], listed[row["name"]]["section"], listed[row["name"]]["models"],
        )  # fmt: skip


def test_a_request_is_listed_in_a_line(run: Run) -> None:
    lines = run("commands", "--protocol", "rtu").out.splitlines()

    assert [line.split() for line in lines if "SetCjcUpdate" in line] == [
        ["3.3.17", "46", "30", "update", "SetCjcUpdate", "CJC", "update", "setting", "M-7019", "series", "only"]
    ]


def test_the_firmware_decides_what_is_listed(run: Run) -> None:
    def listed(firmware: str) -> set[str]:
        options = f"--protocol rtu --model M-7018 --firmware {firmware} --json"
        return {record["name"] for record in run("commands", *options.split()).records}

    assert "ReadHoldingRegisters" in listed("B3.5") - listed("B3.4")


@pytest.mark.parametrize("model", [model for model in Model if model.value.startswith("M")])
def test_the_registers_of_a_model_are_those_of_its_map(run: Run, model: Model) -> None:
    records = run("registers", "--model", model.value, "--json").records

    rows_of_map = modbus.RegisterMap(profile_of_model(model))
    assert [(record["number"], record["name"], record["access"]) for record in records] == [
        (row.number, row.name, row.access.value) for row in rows_of_map
    ]


def profile_of_model(model: Model) -> Any:
    return Known(model).default


@pytest.mark.parametrize(
    "line",
    [
        "30001..30008 analog_input                 R   reading",
        "40289..40296 temperature_offset           R/W int16   0.1 degC  -128..127",
        "40492        host_watchdog_timeout_count  R/W uint16",
    ],
)
def test_a_register_is_listed_in_a_line(run: Run, line: str) -> None:
    assert line in run("registers", "--model", "M-7019R").out.splitlines()


def test_the_firmware_decides_which_registers_are_listed(run: Run) -> None:
    old = run("registers", "--model", "M-7019R", "--firmware", "B3.0", "--json").records
    new = run("registers", "--model", "M-7019R", "--firmware", "B3.7", "--json").records

    assert {record["name"] for record in new} - {record["name"] for record in old} == {"open_wire_detection"}


def test_help_names_both_protocols(run: Run) -> None:
    for command in ("decode", "encode", "commands"):
        assert "rtu" in run(command, "--help").out
    assert "registers" in run("--help").out
