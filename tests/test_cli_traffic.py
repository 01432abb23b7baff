from collections.abc import Sequence

import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st

from i7000 import Fault, Model, Noise, Profile, Protocol, TypeCode, dcon, modbus, strategies
from i7000.cli.traffic import change_line, lines
from i7000.simulator.observed import Change, Observed

DCON, RTU = Protocol.DCON, Protocol.MODBUS_RTU
I_7018R = Profile(Model.I_7018R, type_codes=(TypeCode.J,) * 8)
M_7019R = Profile(Model.M_7019R, type_codes=(TypeCode.K,) * 8)
REPORT = b">+025.12+9999.9-9999.9+000.00+000.00+000.00+000.00+000.00\r"
WRONG = "the checksum is missing or wrong"
TCP = "a Modbus TCP header (transaction 1, 6 bytes follow): these modules speak RTU"


def observed(
    heard: bytes | Noise,
    answer: bytes | None = None,
    profile: Profile | None = I_7018R,
    faults: Sequence[str] = (),
    client: str = "127.0.0.1:51234",
) -> Observed:
    protocol = DCON if profile is None or profile.model.value.startswith("I") else RTU
    return Observed(12.345, client, heard, protocol, profile, answer, tuple(faults))


def told(*arguments: object, **named: object) -> list[str]:
    return [line.plain for line in lines(observed(*arguments, **named))]  # type: ignore[arg-type] # passed on


def rtu(message: modbus.Message) -> bytes:
    return modbus.encode(message, M_7019R, force=True)


# --- what is told of DCON ---------------------------------------------------------------------------------------------


def test_a_command_and_its_answer_are_two_lines_with_readings_in_units() -> None:
    assert told(b"#01\r", REPORT) == [
        "    12.345  127.0.0.1:51234  -> #01  ReadAnalogInputs",
        f"            <- {REPORT[:-1].decode()}  AnalogInputs  25.12, OVER_RANGE, UNDER_RANGE, "
        + "0.00, " * 4
        + "0.00 degC",
    ]


def test_a_unit_is_shown_once_for_neighbours_that_share_it() -> None:
    mixed = Profile(Model.I_7019R, type_codes=(TypeCode.K,) * 2 + (TypeCode.V_10,) * 5 + (TypeCode.K,))
    report = b">+0025.1       +01.000       +02.500+03.000+04.000-9999.9\r"

    _, answer = told(b"#01\r", report, mixed)

    assert answer.endswith("25.1 degC, disabled, 1.000, disabled, 2.500, 3.000, 4.000 V, UNDER_RANGE")


def test_one_channel_is_read_in_its_unit() -> None:
    asked, answer = told(b"#013\r", b">+025.12\r")

    assert asked.endswith("#013  ReadAnalogInput  channel 3")
    assert answer.endswith(">+025.12  AnalogInput  25.12 degC")


def test_fields_are_shown_in_words() -> None:
    _, answer = told(b"$012\r", b"!010E0642\r")

    words = "type_code 0E, thermocouple J, -210..760 degC; line_settings 06, 9600 baud, N81; report_settings 42, hex,"
    assert f"Configuration  {words}" in answer


def test_a_refusal_is_shown_by_its_name() -> None:
    assert told(b"#019\r", b"?01\r")[1] == "            <- ?01  Refused"


def test_silence_of_a_module_that_was_asked_is_shown() -> None:
    assert told(b"#01\r") == ["    12.345  127.0.0.1:51234  -> #01  ReadAnalogInputs  silence"]


def test_what_is_for_no_module_is_shown_as_such() -> None:
    assert told(b"$99M\r", profile=None) == ["    12.345  127.0.0.1:51234  -> $99M  for no module here"]


@pytest.mark.parametrize(
    ("frame", "protocol", "deaf", "words"),
    [
        (
            b"$01M\r",
            DCON,
            M_7019R,
            "$01M  a DCON frame; the M-7019R speaks Modbus RTU: give --model M-7019R,protocol=dcon",
        ),
        (
            rtu(modbus.ReadCoils(1, 0, 1)),
            RTU,
            M_7019R,
            "00001  a Modbus RTU frame; the M-7019R speaks DCON: give --model M-7019R,protocol=rtu",
        ),
        (
            rtu(modbus.ReadCoils(1, 0, 1)),
            RTU,
            I_7018R,
            "00001  a Modbus RTU frame; the I-7018R speaks DCON only",
        ),
        (modbus.seal(b"\x01\x2b"), RTU, I_7018R, "the I-7018R speaks DCON only"),
    ],
)
def test_a_frame_that_a_module_does_not_understand_is_shown_with_the_reason(
    frame: bytes, protocol: Protocol, deaf: Profile, words: str
) -> None:
    (line,) = lines(Observed(0.0, "pty", frame, protocol, None, None, deaf=deaf))

    assert line.plain.endswith(words)


@pytest.mark.parametrize("frame", [b"#**\r", b"#**77\r"])
def test_a_command_to_all_modules_is_shown_as_such(frame: bytes) -> None:
    (line,) = told(frame, profile=None)

    assert line.endswith(f"{frame[:-1].decode()}  SynchronizedSampling  to all modules")


def test_the_answer_to_a_change_of_the_checksum_setting_is_read_with_the_new_one() -> None:
    _, answer = told(b"%01010E0640\r", dcon.seal(b"!01", checksum=True))

    assert "Acknowledged" in answer


def test_an_answer_that_cannot_be_read_is_shown_with_the_fault() -> None:
    assert told(b"$012\r", b"!01\x07\r", faults=["flipped a bit", "late by 0.25 s"])[1] == (
        r"            <- !01\x07  not understood: character at byte 3; allowed: characters 20h..7Eh"
        "  [flipped a bit, late by 0.25 s]"
    )


def test_an_answer_to_what_cannot_be_read_is_shown() -> None:
    asked, answer = told(b"$01\xffZ\r", b"?01\r")

    assert r"$01\xffZ  not understood: character at byte 3" in asked
    assert answer.strip() == "<- ?01"


def test_noise_is_shown_escaped_and_cut() -> None:
    first, second = (told(Noise(wire, Fault.LEADING), profile=None)[0] for wire in (b"\x1b[2J\xe4", b"\x00" * 1000))

    assert r"\x1b[2J\xe4  no frame: leading" in first
    assert r"\x00... (1000 bytes)  no frame: leading" in second


def test_an_answer_to_noise_is_shown() -> None:
    assert told(Noise(b"x", Fault.LEADING), b"!01\r", None)[1].strip() == "<- !01"


def test_nothing_that_moves_a_cursor_comes_from_a_client_or_a_fault() -> None:
    (line,) = told(b"$99M\r", profile=None, client="/dev/\x1b[2J\n", faults=["\x07"])

    assert line.endswith(r"/dev/\x1b[2J\n  -> $99M  for no module here  [\x07]")


def test_a_profile_without_types_leaves_readings_as_they_were_sent() -> None:
    _, answer = told(b"#01\r", REPORT, evolve(I_7018R, type_codes=()))

    assert "AnalogInputs  +025.12, OVER_RANGE, UNDER_RANGE, +000.00, " in answer


@pytest.mark.parametrize(
    ("command", "words"),
    [
        (
            b"#01\r",
            f"{WRONG}; without a checksum it is ReadAnalogInputs; the checksum would be 84",
        ),
        (
            b"$01M00\r",
            f"{WRONG}; 00 in place of a checksum? that of ReadModuleName would be D2",
        ),
        (
            b"$01m\r",
            f"{WRONG}; lower case and no checksum: it would be ReadModuleName, with the checksum D2",
        ),
    ],
)
def test_a_command_that_is_not_understood_is_shown_with_its_cause(command: bytes, words: str) -> None:
    (line,) = told(command, profile=evolve(I_7018R, checksum=True))

    assert line.endswith(f"{command[:-1].decode()}  not understood: {words}  silence")


@pytest.mark.parametrize(
    ("wire", "words"),
    [
        (b"$01M\n", "a line feed (0A) at its end: DCON frames end with a carriage return (0D)"),
        (b"\xff\xfe\x80\r", "noise: another baud rate or parity?"),
        (b"\x01\x04\0\0\0\x081\xcb", "damaged? ReadInputRegisters would have the CRC F1 CC"),
        (
            b"\0\1\0\0\0\6\1\4\0\0\0\x08",
            f"{TCP}; the rest is ReadInputRegisters",
        ),
    ],
)
def test_noise_is_shown_with_its_likely_cause(wire: bytes, words: str) -> None:
    (line,) = told(Noise(wire, Fault.LEADING), profile=None)

    assert line.endswith(f"  no frame: leading; {words}")


def test_a_type_that_the_model_does_not_have_is_noted() -> None:
    (line,) = told(b"$017C0R50\r")

    assert "; an I-7018R has no type 50" in line


# --- what is told of Modbus -------------------------------------------------------------------------------------------


def test_registers_are_shown_by_name_with_readings_in_units() -> None:
    asked, answer = told(
        rtu(modbus.ReadInputRegisters(1, 0, 3)), rtu(modbus.InputRegisters(1, (0x0258, 0x7FFF, 0x8000))), M_7019R
    )

    assert asked.endswith("01 04 00 00 00 03 B0 0B  ReadInputRegisters  30001..30003 analog_input")
    assert answer.endswith("InputRegisters  30001..30003 analog_input 25.1 degC, OVER_RANGE, UNDER_RANGE")


def test_what_is_written_is_shown_in_units() -> None:
    frame = rtu(modbus.WriteSingleRegister(1, 488, 100))

    asked, answer = told(frame, frame, M_7019R)

    assert asked.endswith("WriteSingleRegister  40489 host_watchdog_timeout 10 s")
    assert answer.endswith("SingleRegisterWritten  40489 host_watchdog_timeout 10 s")


def test_fields_of_module_settings_are_shown_by_name() -> None:
    request = modbus.ReadTypeCode(1, 2)

    asked, answer = told(rtu(request), rtu(modbus.TypeCodeSetting(1, TypeCode.K)), M_7019R)

    assert asked.endswith("ReadTypeCode  channel 2")
    assert answer.endswith("TypeCodeSetting  type_code 0F, thermocouple K, -270..1372 degC")


def test_an_exception_is_shown_in_words() -> None:
    _, answer = told(rtu(modbus.ReadInputRegisters(1, 0, 3)), rtu(modbus.ExceptionResponse(1, 4, 2)), M_7019R)

    assert answer.endswith("ExceptionResponse  function 04; exception_code 02, illegal data address")


def test_registers_that_the_module_does_not_have_are_shown_as_such() -> None:
    (line,) = told(rtu(modbus.ReadInputRegisters(1, 100, 3)), profile=M_7019R)

    assert line.endswith("30101..30103 not in the map  silence")


@pytest.mark.parametrize("count", [200, 2000])
def test_of_many_registers_the_first_are_shown(count: int) -> None:
    (line,) = told(rtu(modbus.ReadCoils(1, 256, count)), profile=M_7019R)

    assert line.endswith("; 00261 host_watchdog_enabled; 00262..00267 not in the map; ...  silence")


def test_values_of_what_has_no_name_are_shown_as_they_were_sent() -> None:
    (line,) = told(rtu(modbus.WriteMultipleRegisters(1, 3000, (1, 2, 0xABCD))), profile=M_7019R)

    assert line.endswith("WriteMultipleRegisters  43001..43003 not in the map 0001, 0002, ABCD  silence")


def modbus_line(message: modbus.Message | bytes, answer: bytes | None = None) -> list[str]:
    heard = message if isinstance(message, bytes) else rtu(message)
    return [line.plain for line in lines(Observed(0.0, "pty", heard, RTU, None, answer))]


def test_a_request_for_no_module_here_is_shown_by_number() -> None:
    (line,) = modbus_line(modbus.ReadInputRegisters(9, 0, 2))

    assert line.endswith("ReadInputRegisters  30001..30002; for no module here")


def test_a_request_to_all_modules_is_shown_as_such() -> None:
    (line,) = modbus_line(modbus.WriteSingleCoil(0, 259, True))

    assert line.endswith("WriteSingleCoil  00260 1; to all modules")


def test_a_request_that_cannot_be_read_is_shown_with_the_fault_and_the_answer() -> None:
    asked, answer = modbus_line(modbus.seal(b"\x01\x2b"), modbus.seal(b"\x01\xab\x01"))

    assert "01 2B 40 3F  not understood: function at byte 1" in asked
    assert answer.strip() == "<- 01 AB 01 9E F0"


def test_a_response_that_cannot_be_read_is_shown_with_the_fault() -> None:
    _, answer = told(rtu(modbus.ReadInputRegisters(1, 0, 3)), b"\x01\x04", M_7019R)

    assert answer.strip().startswith("<- 01 04  not understood: length at byte 2; allowed: 4 to 256 bytes; ")


def test_modbus_noise_is_shown_in_hex_and_cut() -> None:
    first, answer = (
        line.plain for line in lines(Observed(0.0, "pty", Noise(b"\x1b" * 90, Fault.CRC), RTU, None, b"x"))
    )

    assert "1B 1B... (90 bytes)  no frame: crc" in first
    assert answer.strip() == "<- 78"


@pytest.mark.parametrize("profile", [M_7019R, None])
def test_a_number_of_the_manual_in_place_of_an_address_is_noted(profile: Profile | None) -> None:
    request = rtu(modbus.ReadHoldingRegisters(1, 40001, 1))

    (line,) = lines(Observed(0.0, "pty", request, RTU, profile, None))

    note = "40001 is a number of the manual: in a frame it is address 0 (3.2); address 40001 would be number 440002"
    assert f"; {note}" in line.plain


# --- nothing raises ---------------------------------------------------------------------------------------------------

ANY_HEARD = st.binary(max_size=300) | st.builds(Noise, st.binary(max_size=300), st.sampled_from(Fault))


@given(
    st.builds(
        Observed,
        at=st.floats(),
        client=st.text(),
        heard=ANY_HEARD | st.binary(max_size=20).map(modbus.seal) | st.binary(max_size=20).map(lambda it: it + b"\r"),
        protocol=st.sampled_from(Protocol),
        profile=st.none() | strategies.profiles(),
        answer=st.none() | st.binary(max_size=300),
        faults=st.lists(st.text(), max_size=2).map(tuple),
        deaf=st.none() | strategies.profiles(),
    )
)
def test_whatever_was_on_the_line_is_shown_without_control_characters(any_: Observed) -> None:
    found = list(lines(any_))

    assert len(found) == 1 + (any_.answer is not None)
    assert all(line.plain.isprintable() for line in found)


@given(strategies.dcon.exchanges())
def test_every_exchange_by_dcon_is_shown_by_name(exchange: strategies.dcon.Exchange) -> None:
    heard = Observed(1.0, "pty", exchange.command_wire, DCON, exchange.profile, exchange.response_wire)

    asked, answered = lines(heard)

    assert f"  {type(exchange.command).__name__}" in asked.plain
    assert f"  {type(exchange.response).__name__}" in answered.plain or not exchange.profile.type_codes


@given(strategies.modbus.exchanges(), st.booleans())
def test_every_exchange_by_modbus_is_shown_by_name(exchange: strategies.modbus.Exchange, known: bool) -> None:  # noqa: FBT001
    profile = exchange.profile if known or exchange.request.function == 0x46 else None
    heard = Observed(1.0, "pty", exchange.request_wire, RTU, profile, exchange.response_wire)

    asked, answered = lines(heard)

    assert f"  {type(exchange.request).__name__}" in asked.plain
    assert f"  {type(exchange.response).__name__}" in answered.plain


# --- changes of modules -----------------------------------------------------------------------------------------------


def test_a_change_of_a_module_is_a_line_of_its_own() -> None:
    stored = Change(1.5, 0x1F, Model.I_7018, ("name 7018 -> HOT", "address 1 -> 31"), stored=True)
    power = Change(1.5, 0x01, Model.I_7018, ("power cycle",))

    assert change_line(stored).plain == "     1.500  1F I-7018  EEPROM: name 7018 -> HOT, address 1 -> 31"
    assert change_line(power).plain == "     1.500  01 I-7018  power cycle"
