"""``i7000 decode``: what a log by DCON is decoded to, and what is printed of it."""

import io
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import Firmware, Model, Protocol, TypeCode, dcon
from i7000.cli import main
from i7000.cli.readers import of_lines
from i7000.dissect import Knowledge, Known, Place
from i7000.modbus import seal
from tests.each import each
from tests.spec.lint import Record
from tests.terminal import Run, known_of, logged
from tests.vectors import dcon_vectors

pytestmark = pytest.mark.usefixtures("plain")

SESSION = Path(__file__).parent / "data" / "session.log"
EXCHANGES = SESSION.with_name("exchanges.log")
ENGINEERING = ">" + "+025.12" * 7 + "+9999.9"


def told(*frames: str, **known: Any) -> list[Record]:
    """The records of a log that has `frames` in its lines."""
    return logged(*frames, known=Known(**known), protocol=Protocol.DCON)


def names(record: Record) -> list[str]:
    return [candidate["name"] for candidate in record["candidates"]]


# --- decode: what frames mean -----------------------------------------------------------------------------------------


def log_of(vector: Record) -> list[str]:
    wires = [vector["command_wire"], vector["response_wire"]]
    return [bytes.fromhex(wire).decode("utf-8", "surrogateescape") for wire in wires if wire]


@each("vector", dcon_vectors("response", "refused", "silence"))
def test_an_exchange_is_shown_as_the_vector_says(vector: Record) -> None:
    records = logged(*log_of(vector), known=known_of(vector), protocol=Protocol.DCON)

    messages = [vector["command"], vector["response"]][: len(records)]
    assert [(message["type"], message["fields"]) for message in messages] == [
        (record["name"], record["fields"]) for record in records
    ]
    assert [record["wire"] for record in records] == [
        wire for wire in (vector["command_wire"], vector["response_wire"]) if wire
    ]


@each("vector", dcon_vectors("response", "refused"))
def test_an_exchange_with_an_unknown_module_is_shown_among_others(vector: Record) -> None:
    response = logged(*log_of(vector), protocol=Protocol.DCON)[1]

    meanings = [(one["command"], one["name"], one["fields"]) for one in response["candidates"] or [response]]
    assert (vector["command"]["type"], vector["response"]["type"], vector["response"]["fields"]) in meanings


@each(
    "vector",
    [
        case
        for case in dcon_vectors("reject")
        # In a log the line is the end of a frame, and the leading character tells its direction.
        if case.values[0]["fault"] not in ("leading", "terminator") and log_of(case.values[0])
    ],
)
def test_a_damaged_frame_has_the_fault_of_the_vector(vector: Record) -> None:
    *_, record = logged(*log_of(vector), known=known_of(vector), protocol=Protocol.DCON)

    assert vector["fault"] == record["fault"]


def test_every_record_has_the_same_keys() -> None:
    records = told("$012", "!01050600", "#01", "!01", "nothing", "?0", "$02A")

    assert len({frozenset(record) for record in records}) == 1
    assert set(records[-1]["candidates"][0]) < set(records[0])


def test_a_command_of_two_models_could_be_both() -> None:
    (record,) = told("$01A")

    assert names(record) == ["ReadAnalogInputsHex", "ReadCjcUpdate"]
    assert record["name"] is None
    assert record["error"] is None


def test_the_model_decides_what_a_command_is() -> None:
    (record,) = told("$01A", model=Model.M_7019R)

    assert record["name"] == "ReadCjcUpdate"


def test_the_response_shows_what_the_command_was() -> None:
    _, record = told("$01A", "!012")

    assert (record["name"], record["command"], record["answers"]) == ("CjcUpdateSetting", "ReadCjcUpdate", 1)
    assert record["models"] == ["I-7019R", "M-7019R", "M-7019Z"]


def test_a_checksum_is_noticed_with_and_without_a_model() -> None:
    for model in (None, Model.I_7018):
        command, response = told("$012B7", "!0105060077"[:-2] + "AD", model=model)

        assert (command["name"], command["checksum"]) == ("ReadConfiguration", True)
        assert (response["name"], response["checksum"]) == ("Configuration", True)


def test_a_checksum_can_be_undecided() -> None:
    _, record = told("$9F6", "!9F0000")

    assert (record["name"], record["fields"]["mask"], record["checksum"]) == ("ChannelMask", 0, False)
    assert [one["checksum"] for one in told("!9F0000")[0]["candidates"] if one["name"] == "ChannelMask"] == [None]


def test_a_frame_is_read_with_factory_defaults_if_it_fits_them() -> None:
    _, record = told("#01", ">" + "+02.500" * 8, model=Model.I_7017)

    assert record["readings"][7] == {
        "channel": 7, "text": "+02.500", "status": "ok", "type_code": 8, "value": 2.5, "unit": "V",
    }  # fmt: skip
    assert record["assumed"] == ["type", "format"]


def test_a_frame_that_does_not_fit_the_factory_defaults_leaves_them_open() -> None:
    _, record = told("#01", ENGINEERING, model=Model.I_7018R)

    assert record["data_formats"] == ["engineering", "percent"]
    assert record["assumed"] == []
    assert [reading["status"] for reading in record["readings"]] == [None] * 7 + ["over_range"]


def test_the_decimals_of_a_type_show_the_format() -> None:
    _, record = told("#01", ">" + "+025.00" * 8, model=Model.I_7018, types=(TypeCode.K,))

    assert record["data_formats"] == ["percent"]
    assert record["readings"][0]["value"] == 343.0


def test_a_reading_that_its_type_cannot_have_is_not_understood() -> None:
    _, record = told("#01", ">" + "+0762.2" + "+05.000" * 7, model=Model.I_7017, types=(TypeCode.V_10,))

    assert record["name"] == "AnalogInputs"
    assert record["fault"] == "number"
    assert "type 08 (-10..10 V) sends -11.000..+11.000" in record["error"]
    assert [reading["value"] for reading in record["readings"]] == [None] + [5.0] * 7
    assert [reading["unit"] for reading in record["readings"]] == [None] + ["V"] * 7


def test_a_reading_that_its_type_cannot_have_is_shown_without_a_value(run: Run) -> None:
    result = run("decode", "--model", "I-7017", "--type", "V_10", "#010", ">+0152.4")

    assert result.code == 1
    assert "channel 0       +0152.4\n" in result.out
    assert "not known" not in result.out


def test_types_can_be_given_for_each_channel() -> None:
    types = (TypeCode.K,) * 7 + (TypeCode.T,)
    _, record = told("#01", ">" + "+0025.1" * 7 + "+025.12", model=Model.I_7019R, types=types)

    assert [reading["type_code"] for reading in record["readings"]] == [15] * 7 + [16]


def test_a_type_leaves_the_models_that_have_it() -> None:
    (record,) = told("#01", types=(TypeCode.V_150,))

    assert record["models"] == ["I-7017R-A5", "M-7017R-A5"]


def test_the_channel_of_a_reading_is_that_of_the_command() -> None:
    _, record = told("#015", ">+0025.1", model=Model.I_7019R, types=(TypeCode.K,))

    assert (record["readings"][0]["channel"], record["readings"][0]["value"]) == (5, 25.1)


def test_a_reading_of_a_channel_that_is_not_there_has_no_type() -> None:
    _, record = told("#01F", ">+0025.1", model=Model.I_7019R, types=(TypeCode.K,))

    assert record["readings"][0]["type_code"] is None


@pytest.mark.parametrize(
    ("frame", "status", "value"),
    [(">+0025.1", "ok", 25.1), (">-9999.9", "under_range", None), (">" + " " * 7, "disabled", None)],
)
def test_a_reading_alone_has_the_type_of_all_channels(frame: str, status: str, value: float | None) -> None:
    (record,) = told(frame, model=Model.I_7019R, types=(TypeCode.K,))

    (found,) = [one for one in record["candidates"] or [record] if one["name"] == "AnalogInput"]
    assert found["readings"] == [
        {"channel": None, "text": frame[1:], "status": status, "type_code": 15, "value": value, "unit": "degC"}
    ]


def test_a_reading_alone_has_no_type_if_the_channels_have_several() -> None:
    (record,) = told(">+0025.1", model=Model.M_7019R, types=(TypeCode.K,) * 7 + (TypeCode.T,))

    assert [one["readings"][0]["type_code"] for one in record["candidates"] if one["name"] == "AnalogInput"] == [None]


def test_readings_in_hex_need_no_format() -> None:
    _, record = told("$01A", ">" + "7FFF" * 8, model=Model.I_7017, types=(TypeCode.V_10,))

    assert record["readings"][0]["value"] == 10.0
    assert record["data_formats"] == []


def test_old_firmware_is_thought_of() -> None:
    _, record = told("#01", ">+9999" + "+0025.1" * 7, model=Model.I_7018P, types=(TypeCode.K,))

    assert [reading["status"] for reading in record["readings"]] == ["over_range"] + ["ok"] * 7


def test_firmware_decides_what_a_module_has() -> None:
    (old,) = told("~01EO", model=Model.I_7019R, firmware=Firmware("B3.6"))
    (new,) = told("~01EO", model=Model.I_7019R, firmware=Firmware("B3.7"))

    assert (old["fault"], new["name"]) == ("unsupported", "ReadOpenWireDetection")


def test_the_pause_that_is_owed_is_shown() -> None:
    (slow,) = told("$010C0", model=Model.I_7019R, firmware=Firmware("B2.6"))

    assert [record["pause"] for record in (slow, *told("#**", "$012"))] == [16.0, 0.002, 0.0]


# --- decode: commands and their responses -----------------------------------------------------------------------------


def test_a_refusal_is_that_of_the_command_before_it() -> None:
    _, record = told("$0153A", "?01")

    assert (record["name"], record["command"], record["section"]) == ("Refused", "SetChannelMask", "2.13")


def test_the_second_response_to_a_command_is_read_alone() -> None:
    *_, second = told("$012", "!01050600", "!01050600")

    assert second["answers"] is None
    assert second["name"] == "Configuration"
    assert "the same again" in second["note"]


def test_what_stands_behind_a_name_is_no_part_of_it() -> None:
    _, name, _, version = told("$01M", "!017018R (15 ms)", "$01F", "!01B1.5   // firmware")

    assert name["fields"] == {"address": 1, "name": "7018R"}
    assert version["fields"] == {"address": 1, "version": "B1.5"}


def test_a_response_after_a_broadcast_is_read_alone() -> None:
    _, record = told("~**", "?01")

    assert (record["name"], record["answers"]) == ("Refused", None)


def test_the_answer_of_another_module_is_an_error_and_shown_alone() -> None:
    _, late, right = told("$016", "!02FF", "!01FF")

    assert (late["fault"], late["answers"]) == ("address", None)
    assert "ChannelMask" in names(late)
    assert (right["name"], right["answers"]) == ("ChannelMask", 1)


def test_a_command_that_was_not_understood_has_no_response() -> None:
    *_, record = told("$016", "$01x", "?01")

    assert record["answers"] is None


def test_a_response_of_no_module_has_a_fault() -> None:
    (record,) = told("!0")

    assert record["fault"] == "length"


def test_a_wrong_checksum_is_reported_if_one_is_required() -> None:
    (record,) = told("$012B8", checksum=True)

    assert (record["fault"], record["name"]) == ("checksum", None)


# --- decode: what is printed ------------------------------------------------------------------------------------------


def test_every_line_of_a_log_is_printed(run: Run) -> None:
    result = run("decode", "--file", str(SESSION), "--model", "M-7019R", "--type", "K")

    lines = SESSION.read_bytes().decode("utf-8", "backslashreplace").splitlines()
    assert [f"{number:<4} {line}" for number, line in enumerate(lines, 1)] == [
        line for line in result.out.splitlines() if line[0].isdigit()
    ]
    assert result.err == "i7000: 1 not understood: line 24\n"
    assert result.code == 1


def test_a_log_of_good_exchanges_is_understood(run: Run) -> None:
    result = run("decode", "--file", str(EXCHANGES), "--model", "M-7019R", "--type", "K", "--json")

    assert [record["text"] for record in result.records] == EXCHANGES.read_text(encoding="utf-8").splitlines()
    assert result.err == ""
    assert result.code == 0


@pytest.mark.parametrize(
    "words",
    [
        "channel 5       +0101.7  101.7 degC\n",
        "channel 3       +9999.9  OVER_RANGE\n",
        "channel 6                DISABLED\n",
        "type            0F, thermocouple K, -270..1372 degC\n",
        "Refused: command refused (manual 2.15; E16 E27)\n       answers         SetChannelTypeCode, line 18\n",
        "pause           0.002 s before the next command\n",
        "mask            BF, channels 0, 1, 2, 3, 4, 5, 7\n",
        "mask            08, channel 3\n",
        "first_reading   yes\n",
        "offset          +0.50 degC\n",
        "temperature     +24.6 degC\n",
        "version         'B3.7'\n",
        "type_code       20, not defined\n",
    ],
)
def test_a_log_is_shown_in_words(run: Run, words: str) -> None:
    assert words in run("decode", "--file", str(SESSION), "--model", "M-7019R", "--type", "K").out


@pytest.mark.parametrize(
    ("frames", "words"),
    [
        (["%0102FF0600"], "type_code       FF, the channels have different types"),
        (["%0102050BDF"], "line_settings   0B, baud rate code 0B not defined, N81"),
        (["%01020506FF"], "FF, data format 3 not defined, checksum, fast mode, 50 Hz rejected, reserved bits 111\n"),
        (["$01500"], "mask            00, no channel\n"),
        (["~010", "!0184"], "status          84, enabled, timed out\n"),
        (["~010", "!0100"], "status          00, disabled, not timed out\n"),
        (["~01311F"], "timeout         3.1 s\n"),
        (["~01T3C"], "timeout         60 s\n"),
        (["$01P1"], "protocol        modbus_rtu\n"),
        (["@01S0"], "single_ended    no\n"),
        (["$012B7"], "checksum        right\n"),
        (["$01A"], "     could be\n     ReadAnalogInputsHex: "),
        (["$01A"], "       models          7019 series only\n"),
        (["#0184"], "       models          I-7017Z, M-7017Z\n"),
        (["$0153A"], "       models          all but I-7017Z, M-7017Z, M-7017mC-16, "),
        (["#01", ENGINEERING], "format          engineering or percent\n"),
        (["#01", ENGINEERING], "type            unknown: give --type\n"),
        ([">+0025.1"], "channel         +0025.1\n"),
    ],
)
def test_fields_are_shown_in_words(run: Run, frames: list[str], words: str) -> None:
    result = run("decode", *frames)

    assert words in result.out
    assert result.code == 0


def test_a_type_that_the_reading_contradicts_is_not_asked_for(run: Run) -> None:
    result = run("decode", "--model", "I-7017", "$012", "!01080600", "#010", ">+0152.4")

    assert "type            unknown: not the one that line 2 said\n" in result.out
    assert "--type" not in result.out
    assert result.code == 1


def test_models_are_shown_if_they_are_not_known(run: Run) -> None:
    assert "models  " in run("decode", "$012").out
    assert "models  " not in run("decode", "$012", "--model", "I-7018").out


def test_json_is_one_object_a_line(run: Run) -> None:
    result = run("decode", "--json", "TX: $012", "foo\x1b[31m", "!01050600", "$01")

    assert [record["line"] for record in result.records] == [1, 2, 3, 4]
    assert [record["direction"] for record in result.records] == ["command", None, "response", "command"]
    assert [record["text"] for record in result.records] == ["TX: $012", "foo\x1b[31m", "!01050600", "$01"]
    assert [record["note"] for record in result.records] == [None, "no frame in this line", None, None]
    assert [record["fault"] for record in result.records] == [None, None, None, "length"]
    assert result.code == 1


def test_all_options_are_taken(run: Run) -> None:
    options = "--model I-7017Z --firmware B3.0 --type V_10 --format hex --single-ended --checksum --json"
    (record,) = run("decode", *options.split(), f"#0113{dcon.checksum(b'#0113'):02X}").records

    assert (record["name"], record["fields"]) == ("ReadAnalogInput", {"address": 1, "channel": 19})


@pytest.mark.parametrize("arguments", [(), ("--file", "-"), ("--file=-",)])
def test_a_log_is_read_from_standard_input(run: Run, arguments: tuple[str, ...]) -> None:
    result = run("decode", *arguments, stdin=b"$012\n\n!01050600\n")

    assert "\n3    !01050600\n" in result.out
    assert "answers         ReadConfiguration, line 1\n" in result.out
    assert (result.code, result.err) == (0, "")


def test_lines_of_a_log_can_be_arguments(run: Run) -> None:
    result = run("decode", "--model", "M-7019R", "--", "-> $01A", "<- !012")

    assert (
        "       answers         ReadCjcUpdate, line 1\n       address         01\n       update          once\n"
        in result.out
    )
    assert result.code == 0


def test_nothing_at_all_is_understood(run: Run) -> None:
    result = run("decode", stdin=b"")

    assert (result.code, result.out, result.err) == (0, "", "i7000: nothing to decode: the input is empty\n")


def test_a_line_without_a_frame_is_no_error(run: Run) -> None:
    nothing, something = run("decode", "COM3 opened", "ready"), run("decode", "COM3 opened", "$012")

    assert (nothing.code, nothing.err) == (0, "i7000: no frame in the input\n")
    assert (something.code, something.err) == (0, "")


def test_frameless_lines_count_if_that_is_asked_for(run: Run) -> None:
    result = run("decode", "COM3 opened", "$012", "--strict")

    assert (result.code, result.err) == (1, "i7000: 1 without a frame: line 1\n")


def test_no_line_is_wrapped_or_cut(run: Run) -> None:
    report = ">" + "+0025.1" * 19 + " " * 7
    result = run("decode", "#01", report, "x" * 1_000_000)

    lines = result.out.splitlines()
    assert f"2    {report}" in lines
    assert f"3    {'x' * 1_000_000}" in lines


def test_only_the_first_lines_that_are_not_understood_are_named(run: Run) -> None:
    result = run("decode", *["$01"] * 21)

    assert result.err.startswith("i7000: 21 not understood: line 1, 2, ")
    assert result.err.endswith(", 20, ...\n")


def test_what_a_terminal_could_take_for_a_control_sequence_is_escaped(run: Run) -> None:
    result = run("decode", stdin=b"\x1b[2J\t\xe2\x80\xae\xff G\xc3\xbcte")

    assert result.out.startswith("1    \\x1b[2J\\t\\u202e\\xff Güte\n")


def test_what_cannot_be_written_is_escaped(monkeypatch: pytest.MonkeyPatch) -> None:
    written = io.BytesIO()
    monkeypatch.setattr("sys.stdout", io.TextIOWrapper(written, encoding="ascii", write_through=True))

    assert main(["decode", "Güte"]) == 0
    assert written.getvalue().startswith(b"1    G\\xfcte\n")


def test_colours_are_for_those_who_want_them(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    assert "\x1b" not in run("decode", "$012").out
    monkeypatch.setenv("FORCE_COLOR", "1")
    assert "\x1b[36mReadConfiguration\x1b[0m" in run("decode", "$012").out
    assert "\x1b[31m     not understood: length at byte 3" in run("decode", "$01").out
    assert run("decode", "$01").err.startswith("\x1b[31m")
    monkeypatch.setenv("NO_COLOR", "1")
    assert "\x1b[36m" not in run("decode", "$012").out


@given(st.binary())
def test_no_log_makes_it_raise(log: bytes) -> None:
    lines = log.decode("utf-8", "surrogateescape").split("\n")
    records = logged(*lines)

    assert all(record["error"] or record["name"] or record["candidates"] or record["notes"] for record in records)


@given(st.text(alphabet="%#$~@!>?0123456789ABCDEF+-. *OETMCSR", max_size=24))
def test_no_frame_makes_it_raise(frame: str) -> None:
    records = logged(frame, "$016", frame, protocol=Protocol.DCON)

    assert all(record["error"] or record["name"] or record["candidates"] or record["notes"] for record in records)


# --- decode: several modules, and changes -----------------------------------------------------------------------------

REPORT_K = ">" + "+0025.1" * 8


@pytest.mark.parametrize(
    ("arguments", "code", "err"),
    [
        (["$012", "!010F0600", "$012", "!01100600"], 1, "i7000: 1 contradicting what is known: line 4\n"),
        (["%01010F0640", "!01", "$012B7", "!010F0640C2"], 0, ""),
        (["$01M", "!017018", "~01O7019R", "!01", "$01M", "!017019R"], 0, ""),
        (["07 06 01 E4 01 01 08 37"] * 2, 0, ""),
        (["--address", "1A", "$012"], 2, "i7000: --address 1A: '1A' has hex digits: write 0x1A or 1Ah\n"),
        (["--address", "256", "$012"], 2, "i7000: --address 256: an address is 0..255 or 00h..FFh\n"),
        (["--address", "3", "$012"], 0, "i7000: no frame of this address\n"),
    ],
)  # fmt: skip
def test_what_contradicts_the_log_is_counted_apart(run: Run, arguments: list[str], code: int, err: str) -> None:
    result = run("decode", *arguments)

    assert (result.code, result.err) == (code, err)


def test_a_late_response_is_decoded_as_that_of_its_own_module() -> None:
    knowledge = Knowledge.given(
        Known(), {1: Known(Model.I_7017, types=(TypeCode.V_10,)), 2: Known(Model.I_7017, types=(TypeCode.MA_20_0D,))}
    )
    *_, late = of_lines(enumerate(["#01", "$022", ">" + "+01.000" * 8], 1), knowledge, None)

    assert late.heard is not None
    assert (late.heard.address, late.heard.answers) == (1, Place(1, "line 1"))
    assert late.heard.meanings[0].readings[0].unit == "V"


@pytest.mark.parametrize(("second", "direction", "types"), [("TX", "request", "K"), ("RX", "response", "T")])
def test_words_for_the_direction_tell_a_retry_from_a_response(second: str, direction: str, types: str) -> None:
    write = seal(bytes.fromhex("010601000010")).hex(" ")
    known = Known(Model.M_7019R, types=(TypeCode.K,))
    *_, again, _, read = logged(
        f"TX {write}", f"{second} {write}", "TX " + seal(bytes.fromhex("010400000001")).hex(" "),
        "RX " + seal(bytes.fromhex("0104020100")).hex(" "), known=known,
    )  # fmt: skip

    assert again["direction"] == direction
    assert read["readings"][0]["type_code"] == TypeCode[types]


def test_colours_around_a_frame_are_no_part_of_it() -> None:
    command, response = logged("\x1b[32m#01\x1b[0m", f"\x1b[33m{REPORT_K}\x1b[0m")

    assert (command["name"], response["name"]) == ("ReadAnalogInputs", "AnalogInputs")


def test_a_broadcast_that_sets_something_is_noted() -> None:
    (record,) = logged(seal(bytes.fromhex("0005010CFF00")).hex())

    assert record["notes"] == [
        "a broadcast, which no module confirms: taken to hold from here on for all that have the register (E94)"
    ]


@pytest.mark.parametrize(
    ("frame", "protocol", "name"),
    [
        ("23 30 31 0D", "rtu", "the shape of a DCON frame: ReadAnalogInputs"),
        ("01 04 00 00 00 01 31 CA", "dcon", "the CRC is right: a Modbus RTU frame, ReadInputRegisters"),
    ],
)
def test_a_frame_of_the_protocol_that_an_option_excludes_is_named_with_the_option(
    run: Run, frame: str, protocol: str, name: str
) -> None:
    (record,) = run("decode", frame, "--protocol", protocol, "--json").records

    assert record["notes"] == [name, f"decode it without --protocol {protocol}"]


@pytest.mark.parametrize("protocol", ["auto", "dcon", "rtu"])
def test_a_frame_of_neither_protocol_names_no_option(run: Run, protocol: str) -> None:
    (record,) = run("decode", "01 44 00 00 00 01 31 CA", "--protocol", protocol, "--json").records

    assert not [note for note in record["notes"] if "--protocol" in note]
