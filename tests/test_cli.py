"""The command line, in process as a user calls it; once as a process of its own."""

import io
import subprocess
import sys
from typing import Any

import pytest

from i7000 import __version__, dcon
from i7000.cli import app, main
from i7000.cli.message import DCON, encode, find, make
from i7000.dissect.meaning import errata
from i7000_cli import CLOSED
from tests.each import each
from tests.spec.lint import Record, rows
from tests.terminal import Run, known_of
from tests.vectors import dcon_vectors, message_of

pytestmark = pytest.mark.usefixtures("plain")


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


@each("vector", dcon_vectors("response", "refused", "silence"))
def test_a_command_is_written_as_the_vector_says(vector: Record) -> None:
    message = make(find(vector["command"]["type"], DCON), assignments(vector["command"]["fields"]))

    assert message_of(vector["command"]) == message
    if "decode-only" not in vector["flags"]:
        wire = encode(message, known_of(vector), force="host-refuses" in vector["flags"])
        assert vector["command_wire"] == wire.hex()


@each("vector", dcon_vectors("response", "refused"))
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
        ("ReadAnalogInput address=1 channel=12 --model I-7018", "channel cannot be 12: 0..7 on I-7018, manual 2.4"),
        ("ReadAnalogInput address=1 channel=17", "no model accepts it: channel cannot be 17: "),
        ("ReadAnalogInput address=300 channel=1", "address cannot be 300: 0..255 or 00h..FFh, manual 2.4"),
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
        ("SetChannelMask address=1 channels=3- --model I-7018", "channels: '' is not a whole number"),
        ("ReadConfiguration address=1 address=2", "address is given twice"),
        (
            "ReadConfiguration address=1 adress=2",
            "ReadConfiguration has no field 'adress'; its fields are address; did you mean address?",
        ),
        (
            "ReadConfiguration address=1 fast_mode=1",
            "ReadConfiguration has no field 'fast_mode'; its fields are address\n",
        ),
        ("ReadConfiguration address=1F", "address: '1F' has hex digits: write 0x1F or 1Fh"),
        ("ReadConfiguration address=", "address: '' is not a whole number"),
        ("SetChannelMask address=1 mask=1 channels=1 --model I-7018", "mask and channels mean the same"),
        ("SetChannelMask address=1 channels=x --model I-7018", "channels: 'x' is not a whole number"),
        ("SetChannelMask address=1 channels=1,3,4,5", "give --model: $0153A for all but I-7017Z, "),
        ("SetChannelTypeCode address=1 channel=2 type_code=KK", "type_code: 'KK' is not a type: "),
        ("SetProtocol address=1 protocol=dkon", "protocol: 'dkon' is not one of dcon, rtu; did you mean dcon?\n"),
        ("SetCjcUpdate address=1 update=never", "update: 'never' is not one of stopped, started, once, 0, 1, 2"),
        ("SetCjcEnabled address=1 enabled=maybe", "enabled: 'maybe' is not true or false: give one of true, yes, "),
        (f"{SET} line_settings=106h", "line_settings: '106h' is not a byte: 00h..FFh"),
        (f"{SET} baud_rate=9601", "baud_rate: 9601 is not a baud rate: give one of 1200, 2400, "),
        ("CjcTemperature temperature=warm", "temperature: 'warm' is not a number"),
        ("", "requires an argument"),
    ],
)
def test_what_cannot_be_understood_is_reported(run: Run, arguments: str, message: str) -> None:
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


def test_the_firmware_can_be_given_without_a_model(run: Run) -> None:
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
        ("decode --file .", "i7000: .: Is a directory\n"),
        ("decode $012 --file x", "give either frames, or --file or --raw"),
        ("decode $012 --model I-7020", "there is no model 'I-7020'; did you mean I-7018, I-7017 or I-7019R?"),
        ("decode $012 --model=", "there is no model ''; models have names such as I-7017, M-7018R and M-7019Z"),
        ("decode $012 --firmware new", "--firmware cannot be new"),
        ("decode $012 --type Q", "'Q' is not a type"),
        ("decode $012 --type 20", "--type: type 20 is not defined: types are 00..1C"),
        ("decode $012 --type MIXED,K", "--type: type FF is not defined"),
        ("decode $012 --type K --model I-7017", "--type cannot be K: "),
        ("decode $012 --type K,K,K", "type codes, or none"),
        ("decode $012 --type K,J,K --model I-7019R", "8 type codes"),
        ("decode $012 --single-ended --model I-7018", "--single-ended cannot be given"),
        ("commands --model x", "there is no model 'x'; models have names such as I-7017, M-7018R and M-7019Z"),
    ],
)
def test_wrong_usage_is_reported(run: Run, arguments: str, message: str) -> None:
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


@pytest.mark.parametrize(
    ("missing", "extra"),
    [("filelock", "simulator"), ("cattrs", "simulator"), ("rich", "cli"), ("serial", "serial")],
)
def test_a_module_that_is_not_installed_is_reported_with_its_extra(
    missing: str, extra: str, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    def end(*_: object, **__: object) -> None:
        raise ModuleNotFoundError(name=missing)

    monkeypatch.setattr(app, "app", end)
    result = run("simulate", "--eeprom", "modules.json")

    assert result.err == f'i7000: no module {missing}; this needs: pip install "i7000[{extra}]"\n'
    assert result.code == 2


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("read sim:I-7018 3", "unexpected argument '3': write --address 3"),
        ("read sim:I-7018 0x1F", "unexpected argument '0x1F': write --address 0x1F"),
        ("backup sim:I-7018 unwritten.json 3", "unexpected argument '3': write --address 3"),
        ("read sim:I-7018 300", "unexpected argument '300': put what has blanks in quotes"),
        ("scan sim:I-7018 3", "unexpected argument '3': put what has blanks in quotes"),
    ],
)
def test_a_number_too_many_is_taken_for_an_address_where_there_can_be_one(
    run: Run, arguments: str, message: str
) -> None:
    result = run(*arguments.split())

    assert (result.err, result.code) == (f"i7000: {message}\n", 2)


def test_an_argument_too_many_is_refused_with_what_may_be_meant(run: Run) -> None:
    result = run("commands", "46", "2A")

    assert result.err == "i7000: unexpected argument '2A': put what has blanks in quotes\n"
    assert result.code == 2


@pytest.mark.parametrize("command", ["", "decode", "encode", "commands", "backup", "diff", "restore", "set", "send"])
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
        [sys.executable, "-c", SCRIPT, "decode"], input=b"$012\n$01\xff\n", capture_output=True, check=False
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

    assert (told.code, r"\xed\xa0\x80" in told.out) == (0, True)


def test_without_a_standard_error_a_wrong_call_still_has_its_exit_code(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stderr", None)

    assert main(["decode", "--protocol", "none"]) == 2


def test_only_the_program_has_a_version(run: Run) -> None:
    assert run("--version").out == f"{__version__}\n"
    told = run("decode", "--version")
    assert (told.code, told.out) == (2, "")
    assert "--version" in told.err
