"""The command line, in process as a user calls it; once as a process of its own."""

import io
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from i7000 import Firmware, Model, TypeCode, dcon
from i7000.cli import main
from i7000.cli.dcon import Known, errata
from i7000.cli.log import pieces
from i7000.cli.message import DCON, encode, find, make
from i7000.cli.records import line_records
from i7000_cli import CLOSED
from tests.spec.lint import Record, rows
from tests.terminal import Run
from tests.vectors import dcon_vectors, message_of, profile_of

pytestmark = pytest.mark.usefixtures("plain")

SESSION = Path(__file__).parent / "data" / "session.log"
EXCHANGES = SESSION.with_name("exchanges.log")
ENGINEERING = ">" + "+025.12" * 7 + "+9999.9"


def told(*frames: str, **known: Any) -> list[Record]:
    """The records of a log that has `frames` in its lines."""
    return list(line_records(pieces(frame.encode() for frame in frames), Known(**known)))


def names(record: Record) -> list[str]:
    return [candidate["name"] for candidate in record["candidates"]]


# --- lines of a log ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("line", "frame"),
    [
        (b"$012", b"$012\r"),
        (b"$012\n", b"$012\r"),
        (b"$012\r\n", b"$012\r"),
        (b"  $012  ", b"$012\r"),
        (b"\xef\xbb\xbf$012", b"$012\r"),
        (b"$012(CR)", b"$012\r"),
        (b"$012<cr><lf>", b"$012\r"),
        (b"$012[CR]", b"$012\r"),
        (b"$012\\r", b"$012\r"),
        (b"$012\\r\\n", b"$012\r"),
        (b"$012\\n", b"$012\r"),
        (b"$012\\x0d", b"$012\r"),
        (b"'$012'", b"$012\r"),
        (b"TX: b'$012\\r'", b"$012\r"),
        (b'sent "$012\\r"', b"$012\r"),
        (b"-> '$012'", b"$012\r"),
        (b"-> $012", b"$012\r"),
        (b"->$012", b"$012\r"),
        (b"--> TX $012", b"$012\r"),
        (b"=> $012", b"$012\r"),
        (b">> $012", b"$012\r"),
        (b">>$012", b"$012\r"),
        (b">> TX: $012", b"$012\r"),
        (b"> $012", b"$012\r"),
        (b"<- !01", b"!01\r"),
        (b"<- >+025.12", b">+025.12\r"),
        (b"<->+025.12", b">+025.12\r"),
        (b"<< >+025.12", b">+025.12\r"),
        (b"<<>+025.12", b">+025.12\r"),
        (b"< >+025.12", b">+025.12\r"),
        (b">>+025.12", b">+025.12\r"),
        (b">>>+025.12", b">+025.12\r"),
        (b"->+025.12", b">+025.12\r"),
        (b"->>+025.12", b">+025.12\r"),
        (b">+025.12", b">+025.12\r"),
        (b">       +025.12", b">       +025.12\r"),
        (b"RX: >+025.12       ", b">+025.12       \r"),
        (b"!01NAME  (CR)", b"!01NAME  \r"),
        (b"2024-03-07T08:15:00.101+01:00 TX $012", b"$012\r"),
        (b"08:15:00,101 | COM3 | $012", b"$012\r"),
        (b"[12.5 ms] (host) $012", b"$012\r"),
        (b"Mar  7 08:15:00 pi ser2net[71]: TX: @01S", b"@01S\r"),
        ("08:15 → $012".encode(), b"$012\r"),
        (b"24 30 31 32 0d", b"$012\r"),
        (b"2430313242370D", b"$012B7\r"),
        (b"12:00:01 RX: 24 30 31 32 0D ", b"$012\r"),
        (b"#**", b"#**\r"),
        (b"~01O\xff", b"~01O\xff\r"),
        (b"$012 ; asked", b"$012 ; asked\r"),
    ],
)
def test_the_frame_of_a_line_is_found(line: bytes, frame: bytes) -> None:
    (piece,) = pieces([line])

    assert frame == piece.frame


@pytest.mark.parametrize(
    "line",
    [
        b"port opened", b"-> 012", b"->", b"(CR)", b"24 30 31 32", b"00 30 31 0d", b"24 3 0d", b"+025.12",
        b"\x00$012", b"\xff\xfe", b"[" * 1000, b"***",
    ],
)  # fmt: skip
def test_a_line_without_a_frame_is_kept_as_it_is(line: bytes) -> None:
    (piece,) = pieces([line])

    assert piece.frame is None
    assert line.decode("utf-8", "backslashreplace") == piece.text


@pytest.mark.parametrize("line", [b"", b"\n", b"\r\n", b"   \n", b"\t"])
def test_a_blank_line_is_no_piece(line: bytes) -> None:
    assert list(pieces([line])) == []


def test_several_frames_of_a_line_are_told_one_by_one() -> None:
    found = [
        (piece.number, piece.frame) for piece in pieces([b"x\n", b"$012\r!01050600\r", b"TX $012\\r\\nRX !01(CR)"])
    ]

    assert found == [(1, None), (2, b"$012\r"), (2, b"!01050600\r"), (3, b"$012\r"), (3, b"!01\r")]


@given(st.lists(st.binary() | st.sampled_from([b"-> $012", b">> ", b"(CR)", b"\\r", b"24 30 0d"])).map(b"".join))
def test_no_byte_of_a_line_is_lost(line: bytes) -> None:
    kept = "".join(piece.text for piece in pieces([line]))

    assert "".join(line.decode("utf-8", "backslashreplace").split()) == "".join(kept.split())


# --- decode: what frames mean -----------------------------------------------------------------------------------------


def known_of(vector: Record) -> Known:
    profile = profile_of(vector["profile"])
    return Known(
        profile.model,
        profile.firmware,
        profile.type_codes,
        profile.data_format,
        profile.checksum,
        profile.single_ended,
    )


def log_of(vector: Record) -> list[bytes]:
    wires = [vector["command_wire"], vector["response_wire"]]
    return [bytes.fromhex(wire) for wire in wires if wire]


@pytest.mark.parametrize("vector", dcon_vectors("response", "refused", "silence"))
def test_an_exchange_is_told_as_the_vector_says(vector: Record) -> None:
    records = list(line_records(pieces(log_of(vector)), known_of(vector)))

    messages = [vector["command"], vector["response"]][: len(records)]
    assert [(message["type"], message["fields"]) for message in messages] == [
        (record["name"], record["fields"]) for record in records
    ]
    assert [record["wire"] for record in records] == [wire.hex() for wire in log_of(vector)]


@pytest.mark.parametrize("vector", dcon_vectors("response", "refused"))
def test_an_exchange_with_an_unknown_module_is_told_among_others(vector: Record) -> None:
    response = list(line_records(pieces(log_of(vector)), Known()))[1]

    meanings = [(one["command"], one["name"], one["fields"]) for one in response["candidates"] or [response]]
    assert (vector["command"]["type"], vector["response"]["type"], vector["response"]["fields"]) in meanings


@pytest.mark.parametrize(
    "vector",
    [
        case
        for case in dcon_vectors("reject")
        # In a log the line is the end of a frame, and the leading character tells its direction.
        if case.values[0]["fault"] not in ("leading", "terminator") and log_of(case.values[0])
    ],
)
def test_a_damaged_frame_has_the_fault_of_the_vector(vector: Record) -> None:
    *_, record = line_records(pieces(log_of(vector)), known_of(vector))

    assert vector["fault"] == record["fault"]


def test_every_record_has_the_same_keys() -> None:
    records = told("$012", "!01050600", "$01A", "!01", "nothing", "?0")

    assert len({tuple(record) for record in records}) == 1
    assert tuple(records[0])[6:-3] == tuple(records[2]["candidates"][0])


def test_a_command_of_two_models_could_be_both() -> None:
    (record,) = told("$01A")

    assert names(record) == ["ReadAnalogInputsHex", "ReadCjcUpdate"]
    assert record["name"] is None
    assert record["error"] is None


def test_the_model_decides_what_a_command_is() -> None:
    (record,) = told("$01A", model=Model.M_7019R)

    assert record["name"] == "ReadCjcUpdate"


def test_the_response_tells_what_the_command_was() -> None:
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


def test_the_decimals_of_a_type_tell_the_format() -> None:
    _, record = told("#01", ">" + "+025.00" * 8, model=Model.I_7018, types=(TypeCode.K,))

    assert record["data_formats"] == ["percent"]
    assert record["readings"][0]["value"] == 343.0


def test_a_reading_that_its_type_cannot_have_is_not_understood() -> None:
    _, record = told("#01", ">" + "+0762.2" + "+05.000" * 7, model=Model.I_7017, types=(TypeCode.V_10,))

    assert record["name"] == "AnalogInputs"
    assert record["fault"] == "number"
    assert "type 08 (-10..10 V) writes -11.000..+11.000" in record["error"]
    assert [reading["value"] for reading in record["readings"]] == [None] + [5.0] * 7
    assert [reading["unit"] for reading in record["readings"]] == [None] + ["V"] * 7


def test_a_reading_that_its_type_cannot_have_is_shown_without_a_value(run: Run) -> None:
    result = run("decode", "--model", "I-7017", "--type", "V_10", "#010", ">+0152.4")

    assert result.code == 1
    assert "channel 0       +0152.4\n" in result.out
    assert "not known" not in result.out


def test_types_can_be_told_for_each_channel() -> None:
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


def test_the_pause_that_is_owed_is_told() -> None:
    (slow,) = told("$010C0", model=Model.I_7019R, firmware=Firmware("B2.6"))

    assert [record["pause"] for record in (slow, *told("#**", "$012"))] == [16.0, 0.002, 0.0]


# --- decode: commands and their responses -----------------------------------------------------------------------------


def test_a_refusal_is_that_of_the_command_before_it() -> None:
    _, record = told("$0153A", "?01")

    assert (record["name"], record["command"], record["section"]) == ("Refused", "SetChannelMask", "2.13")


def test_the_second_response_to_a_command_is_read_alone() -> None:
    *_, second = told("$012", "!01050600", "!01050600")

    assert second["answers"] is None
    assert set(names(second)) == {"Configuration", "ChannelMask"}


def test_what_stands_behind_a_name_is_no_part_of_it() -> None:
    _, name, _, version = told("$01M", "!017018R (15 ms)", "$01F", "!01B1.5   // firmware")

    assert (name["fault"], name["candidates"]) == ("length", [])
    assert (version["fault"], version["candidates"]) == ("length", [])


def test_a_response_after_a_broadcast_is_read_alone() -> None:
    _, record = told("~**", "?01")

    assert (record["name"], record["answers"]) == ("Refused", None)


def test_the_answer_of_another_module_is_an_error_and_told_alone() -> None:
    _, late, right = told("$016", "!02FF", "!01FF")

    assert (late["fault"], late["answers"]) == ("address", None)
    assert "ChannelMask" in names(late)
    assert (right["name"], right["answers"]) == ("ChannelMask", 1)


def test_a_command_that_was_not_understood_has_no_response() -> None:
    *_, record = told("$016", "$01x", "?01")

    assert record["answers"] is None


def test_a_response_of_no_module_has_a_fault() -> None:
    (record,) = told("!0")

    assert record["fault"] == "command"


def test_a_wrong_checksum_is_told_where_there_has_to_be_one() -> None:
    (record,) = told("$012B8", checksum=True)

    assert (record["fault"], record["name"]) == ("checksum", None)


# --- decode: what is printed ------------------------------------------------------------------------------------------


def test_every_line_of_a_log_is_printed(run: Run) -> None:
    result = run("decode", "--file", str(SESSION), "--model", "M-7019R", "--type", "K")

    lines = SESSION.read_bytes().decode("utf-8", "backslashreplace").splitlines()
    assert [f"{number:<4} {line}" for number, line in enumerate(lines, 1)] == [
        line for line in result.out.splitlines() if line[0].isdigit()
    ]
    assert result.err == "i7000: 2 not understood: line 1, 24\n"
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
        "assumed         the factory default of format\n",
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
def test_a_log_is_told_in_words(run: Run, words: str) -> None:
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
        (["#01", ENGINEERING], "type            not known: --type tells\n"),
        ([">+0025.1"], "channel         +0025.1\n"),
    ],
)
def test_fields_are_told_in_words(run: Run, frames: list[str], words: str) -> None:
    result = run("decode", *frames)

    assert words in result.out
    assert result.code == 0


def test_models_are_told_if_they_are_not_known(run: Run) -> None:
    assert "models  " in run("decode", "$012").out
    assert "models  " not in run("decode", "$012", "--model", "I-7018").out


def test_json_is_one_object_a_line(run: Run) -> None:
    result = run("decode", "--json", "TX: $012", "foo\x1b[31m", "!01050600")

    assert [record["line"] for record in result.records] == [1, 2, 3]
    assert [record["direction"] for record in result.records] == ["command", None, "response"]
    assert [record["text"] for record in result.records] == ["TX: $012", "foo\x1b[31m", "!01050600"]
    assert result.records[1]["error"] == "no frame in this line"
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

    assert (result.code, result.out, result.err) == (0, "", "i7000: there was nothing to decode\n")


def test_no_line_is_wrapped_or_cut(run: Run) -> None:
    report = ">" + "+0025.1" * 19 + " " * 7
    result = run("decode", "#01", report, "x" * 1_000_000)

    lines = result.out.splitlines()
    assert f"2    {report}" in lines
    assert f"3    {'x' * 1_000_000}" in lines


def test_only_the_first_lines_that_are_not_understood_are_named(run: Run) -> None:
    result = run("decode", *["foo"] * 21)

    assert result.err.startswith("i7000: 21 not understood: line 1, 2, ")
    assert result.err.endswith(", 20, ...\n")


def test_what_a_terminal_could_take_for_a_control_sequence_is_escaped(run: Run) -> None:
    result = run("decode", stdin=b"\x1b[2J\t\xe2\x80\xae\xff G\xc3\xbcte")

    assert result.out.startswith("1    \\x1b[2J\\t\\u202e\\xff Güte\n")


def test_what_cannot_be_written_is_escaped(monkeypatch: pytest.MonkeyPatch) -> None:
    written = io.BytesIO()
    monkeypatch.setattr("sys.stdout", io.TextIOWrapper(written, encoding="ascii", write_through=True))

    assert main(["decode", "Güte"]) == 1
    assert written.getvalue().startswith(b"1    G\\xfcte\n")


def test_colours_are_for_those_who_want_them(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    assert "\x1b" not in run("decode", "$012").out
    monkeypatch.setenv("FORCE_COLOR", "1")
    assert "\x1b[36mReadConfiguration\x1b[0m" in run("decode", "$012").out
    assert "\x1b[31m     not understood: no frame in this line\x1b[0m" in run("decode", "foo").out
    assert run("decode", "foo").err.startswith("\x1b[31m")
    monkeypatch.setenv("NO_COLOR", "1")
    assert "\x1b[36m" not in run("decode", "$012").out


@given(st.binary())
def test_no_log_makes_it_raise(log: bytes) -> None:
    records = list(line_records(pieces(io.BytesIO(log)), Known()))

    assert all(record["error"] or record["name"] or record["candidates"] for record in records)


@given(st.text(alphabet="%#$~@!>?0123456789ABCDEF+-. *OETMCSR", max_size=24).map(str.encode))
def test_no_frame_makes_it_raise(frame: bytes) -> None:
    records = list(line_records(pieces([frame, b"$016", frame]), Known()))

    assert all(record["error"] or record["name"] or record["candidates"] for record in records)


# --- encode -----------------------------------------------------------------------------------------------------------


def assignments(fields: Record) -> tuple[str, ...]:
    """The fields of a vector as a person writes them."""

    def written(name: str, value: Any) -> str:
        if name == "type_code":
            return f"{value:02X}"
        if name in ("line_settings", "report_settings", "offset", "timeout"):
            return f"{value:#x}"
        return ",".join(value) if name == "values" else str(value)

    return tuple(f"{name}={written(name, value)}" for name, value in fields.items())


@pytest.mark.parametrize("vector", dcon_vectors("response", "refused", "silence"))
def test_a_command_is_written_as_the_vector_says(vector: Record) -> None:
    message = make(find(vector["command"]["type"], DCON), assignments(vector["command"]["fields"]))

    assert message_of(vector["command"]) == message
    if "decode-only" not in vector["flags"]:
        wire = encode(message, known_of(vector), force="host-refuses" in vector["flags"])
        assert vector["command_wire"] == wire.hex()


@pytest.mark.parametrize("vector", dcon_vectors("response", "refused"))
def test_a_response_is_made_of_its_fields(vector: Record) -> None:
    message = make(find(vector["response"]["type"], DCON), assignments(vector["response"]["fields"]))

    assert message_of(vector["response"]) == message


SET = "SetConfiguration address=1 new_address=1 type_code=J"


@pytest.mark.parametrize(
    ("arguments", "frame"),
    [
        ("ReadConfiguration address=1", "$012"),
        ("read-configuration address=0x1F", "$1F2"),
        ("READ_CONFIGURATION address=31 --checksum", "$1F2CD"),
        ("SetChannelMask address=1 mask=0x3A --model I-7018", "$0153A"),
        ("SetChannelMask address=1 channels=1,3,4,5 --model I-7018", "$0153A"),
        ("SetChannelMask address=1 channels= --model I-7018", "$01500"),
        ("SetChannelMask address=1 channels=0-2,7 --model I-7018", "$01587"),
        ("SetChannelMask address=1 channels=19 --model I-7017Z --single-ended", "$015080000"),
        ("SetChannelTypeCode address=1 channel=2 type_code=K", "$017C2R0F"),
        ("SetChannelTypeCode address=1 channel=2 type_code=0x0f", "$017C2R0F"),
        (f"{SET} line_settings=06 report_settings=0x80 --model I-7018", "%01010E0680"),
        (f"{SET} baud_rate=9600 data_format=hex --model I-7018", "%01010E0602"),
        (f"{SET} baud_rate=0x0A character_format=e81 checksum=yes fast_mode=off filter=reject_50_hz reserved=0",
         "%01010E8AC0"),
        (f"{SET} line_settings=86h baud_rate=1200 report_settings=0xC0 data_format=percent --model I-7018",
         "%01010E83C1"),
        (f"{SET} baud_rate=2 data_format=hex --model I-7018 --force", "%01010E0202"),
        (f"{SET[:-1]}mixed line_settings=06 report_settings=00 --model I-7019R", "%0101FF0600"),
        ("SetCjcUpdate address=1 update=once", "$01A2"),
        ("SetCjcOffset address=1 offset=-0x10", "$019-0010"),
        ("SetModuleName address=1 name=7018", "~01O7018"),
        ("CalibrateSpan address=1 --model I-7019R --force", "$010"),
        ("CjcTemperature temperature=24.6", ">+0024.6"),
        ("AnalogInput value=+02.500", ">+02.500"),
        ("Refused address=1", "?01"),
        ("HostOk", "~**"),
    ],
)  # fmt: skip
def test_a_frame_is_written_of_fields(run: Run, arguments: str, frame: str) -> None:
    result = run("encode", *arguments.split())

    assert result.out.splitlines()[0] == frame
    assert bytes.fromhex(result.out.splitlines()[1]) == frame.encode() + b"\r"
    assert result.code == 0


def test_a_frame_is_written_as_json(run: Run) -> None:
    result = run("encode", "ReadConfiguration", "address=1", "--json")

    assert result.records == [{"name": "ReadConfiguration", "section": "2.10", "frame": "$012", "wire": "243031320d"}]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("ReadAnalogInput address=1 channel=12 --model I-7018", "channel cannot be 12: 0..7: I-7018, manual 2.4"),
        ("ReadAnalogInput address=1 channel=17", "no model takes it: channel cannot be 17: "),
        ("ReadAnalogInput address=300 channel=1", "address cannot be 300: 00..FF, manual 2.4"),
        ("ReadCjcUpdate address=1 --model I-7018", "I-7018 has no CJC update setting: 7019 series only, manual 2.20"),
        ("SetChannelMask address=1 channels=25 --model I-7018", "channel cannot be 25: 0..19, manual 2.13"),
        ("SetChannelMask address=1 channels=0-99999999 --model I-7018", "channel cannot be 99999999: 0..19"),
        ("SetChannelMask address=1 channels=1,9 --model I-7018", "I-7018 has no channel 9: 0..7, manual 2.13"),
        (f"{SET} baud_rate=9600 fast_mode=yes --model I-7018", "fast_mode cannot be yes: I-7018 has no fast mode"),
    ],
)
def test_a_frame_that_a_module_refuses_is_not_written(run: Run, arguments: str, message: str) -> None:
    result = run("encode", *arguments.split())

    assert message in result.err
    assert (result.code, result.out) == (1, "")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("Foo address=1", "there is no command or response 'Foo': i7000 commands lists them\n"),
        ("-- -", "there is no command or response '-'"),
        ("ReadConf address=1", "did you mean ReadConfiguration?"),
        ("ReadConfigurtion address=1", "did you mean ReadConfiguration"),
        ("ReadConfiguration", "ReadConfiguration needs address=... (0..255 or 00h..FFh)\n"),
        ("SetConfiguration address=1", "new_address=... (0..255 or 00h..FFh), type_code=... "),
        ("ReadConfiguration 1", "'1' is not field=value; the fields of ReadConfiguration are address\n"),
        ("$012", "there is no command or response '$012'; that is a frame, and i7000 decode reads it\n"),
        ("SetChannelMask address=1 channels=5-2 --model I-7018", "channels: 5-2 has no channel: write 2-5\n"),
        ("SetChannelMask address=1 channels=3- --model I-7018", "channels: '' is not a number"),
        ("ReadConfiguration address=1 address=2", "address is given twice"),
        ("ReadConfiguration address=1 adress=2", "ReadConfiguration has no adress: address; did you mean address?"),
        ("ReadConfiguration address=1 fast_mode=1", "ReadConfiguration has no fast_mode: address\n"),
        ("ReadConfiguration address=1F", "address: '1F' has hex digits: write 0x1F or 1Fh"),
        ("ReadConfiguration address=", "address: '' is not a number"),
        ("SetChannelMask address=1 mask=1 channels=1 --model I-7018", "mask and channels are the same"),
        ("SetChannelMask address=1 channels=x --model I-7018", "channels: 'x' is not a number"),
        ("SetChannelMask address=1 channels=1,3,4,5", "give --model: $0153A for all but I-7017Z, "),
        ("SetChannelTypeCode address=1 channel=2 type_code=KK", "type_code: 'KK' is no type: "),
        ("SetCjcUpdate address=1 update=never", "update: 'never' is none of stopped, started, once, 0, 1, 2"),
        ("SetCjcEnabled address=1 enabled=maybe", "enabled: 'maybe' is neither true nor false: true, yes, "),
        (f"{SET} line_settings=106h", "line_settings: '106h' is not a byte: 00h..FFh"),
        (f"{SET} baud_rate=9601", "baud_rate: 9601 baud is none of 1200, 2400, "),
        ("CjcTemperature temperature=warm", "temperature: 'warm' is not a number"),
        ("", "requires an argument"),
    ],
)
def test_what_cannot_be_understood_is_said(run: Run, arguments: str, message: str) -> None:
    result = run("encode", *arguments.split())

    assert message in result.err
    assert (result.code, result.out) == (2, "")


# --- commands ---------------------------------------------------------------------------------------------------------


def test_all_commands_are_listed_as_in_the_tables(run: Run) -> None:
    result = run("commands", "--json")

    keys = ("section", "name", "syntax", "response", "response_syntax")
    assert [[row[key] for key in keys] for row in rows("dcon_commands")] == [
        [record[key] for key in keys] for record in result.records
    ]


def test_the_models_of_a_command_are_those_of_the_tables(run: Run) -> None:
    result = run("commands", "--json")

    assert [row["models"] for row in rows("dcon_commands")] == [record["models"] for record in result.records]


def test_the_commands_of_a_model_are_listed(run: Run) -> None:
    lines = run("commands", "--model", "i-7018").out.splitlines()

    assert len(lines) == sum("I-7018" in row["models"] for row in rows("dcon_commands"))
    assert lines[0].split() == [
        "2.1", "%AANNTTCCFF", "!AA", "SetConfiguration", "module", "configuration", "I-7018",
    ]  # fmt: skip


def test_the_firmware_decides_what_is_listed(run: Run) -> None:
    def listed(firmware: str) -> set[str]:
        result = run("commands", "--model", "I-7018R", "--firmware", firmware, "--json")
        return {record["name"] for record in result.records}

    assert listed("B4.2") - listed("B4.1") == {
        "SetChannelTypeCode", "ReadChannelTypeCode", "ReadOpenWireDetection", "SetOpenWireDetection",
    }  # fmt: skip


def test_the_firmware_can_be_told_without_a_model(run: Run) -> None:
    result = run("commands", "--firmware", "B3.8", "--json")

    (setter,) = [record for record in result.records if record["name"] == "SetChannelTypeCode"]
    assert "I-7017R" not in setter["models"]
    assert "I-7019R" in setter["models"]


def test_errata_are_those_of_the_document() -> None:
    assert errata(dcon.SetConnectingMode) == ("E03",)


# --- wrong usage, and what is not there -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("decod", "decode"),
        ("decode --nope", "--nope"),
        ("decode --format octal", "octal"),
        ("decode --file", "--file"),
        ("decode --file nowhere.log", "nowhere.log"),
        ("decode --file .", "'.'"),
        ("decode $012 --file x", "give one of them"),
        ("decode $012 --model I-7020", "--model cannot be I-7020: I-7017, "),
        ("decode $012 --model=", "--model cannot be empty"),
        ("decode $012 --firmware new", "--firmware cannot be new"),
        ("decode $012 --type Q", "'Q' is no type"),
        ("decode $012 --type 20", "type 20 of '20' is not defined: 00..1C"),
        ("decode $012 --type MIXED,K", "type FF of 'MIXED,K' is not defined"),
        ("decode $012 --type K --model I-7017", "--type cannot be K: "),
        ("decode $012 --type K,K,K", "of them, or none"),
        ("decode $012 --type K,J,K --model I-7019R", "8 of them"),
        ("decode $012 --single-ended --model I-7018", "--single-ended cannot be given"),
        ("commands --model x", "--model cannot be x"),
    ],
)
def test_wrong_usage_is_said(run: Run, arguments: str, message: str) -> None:
    result = run(*arguments.split())

    assert message in result.err
    assert result.err.count("\n") == 1
    assert (result.code, result.out) == (2, "")


@pytest.mark.parametrize("terminal", [True, False])
def test_frames_are_asked_for_where_none_can_come(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], *, terminal: bool
) -> None:
    stdin = io.StringIO()
    monkeypatch.setattr(stdin, "isatty", lambda: True)
    monkeypatch.setattr("sys.stdin", stdin if terminal else None)

    assert main(["decode"]) == 2
    assert "no frames" in capsys.readouterr().err


def test_an_interruption_ends_it_quietly(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    class Interrupted(io.RawIOBase):
        def readable(self) -> bool:
            return True

        def readinto(self, _: Any) -> int:
            raise KeyboardInterrupt

    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BufferedReader(Interrupted())))

    assert main(["decode"]) == 130
    assert capsys.readouterr().err == ""


def test_the_extra_is_named_if_it_is_not_installed(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "cyclopts", None)
    monkeypatch.delitem(sys.modules, "i7000.cli.app", raising=False)

    assert main(["decode", "$012"]) == 2
    assert 'pip install "i7000[cli]"' in capsys.readouterr().err


@pytest.mark.parametrize("command", ["", "decode", "encode", "commands"])
def test_help_is_there(run: Run, command: str) -> None:
    result = run(*command.split(), "--help")

    assert "Usage: i7000" in result.out
    assert result.code == 0


def test_arguments_are_those_of_the_process(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.argv", ["i7000", "encode", "HostOk"])

    assert main() == 0
    assert capsys.readouterr().out.startswith("~**\n")


SCRIPT = "import sys; from i7000.cli import main; sys.exit(main())"


def test_it_runs_as_a_process() -> None:
    result = subprocess.run(  # noqa: S603
        [sys.executable, "-c", SCRIPT, "decode"], input=b"$012\n\xff\n", capture_output=True, check=False
    )

    assert result.stdout.splitlines()[0] == b"1    $012"
    assert result.stderr.splitlines() == [b"i7000: 1 not understood: line 2"]
    assert result.returncode == 1


def test_a_closed_pipe_ends_it_quietly() -> None:
    process = subprocess.Popen(  # noqa: S603
        [sys.executable, "-c", SCRIPT, "decode", *["$012"] * 2000], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    assert process.stdout is not None
    assert process.stdout.readline() == b"1    $012\n"
    process.stdout.close()

    assert process.stderr is not None
    assert process.stderr.read() == b""
    process.stderr.close()
    assert process.wait() == CLOSED


def test_an_argument_that_is_no_text_of_any_encoding_is_shown_escaped(run: Run) -> None:
    told = run("decode", "\ud800")

    assert (told.code, r"\xed\xa0\x80" in told.out) == (1, True)


def test_without_a_standard_error_a_wrong_call_still_has_its_exit_code(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stderr", None)

    assert main(["decode", "--protocol", "none"]) == 2
