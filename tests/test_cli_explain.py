"""One thing explained in full: ``i7000 commands NAME``, ``i7000 registers NAME``, ``i7000 errata``."""

from typing import Any

import pytest

from i7000 import Model, Profile, dcon, modbus
from tests.spec.lint import Record, rows
from tests.terminal import Run

KINDS: list[Any] = [*dcon.COMMANDS, *modbus.REQUESTS]
ROWS: dict[str, Record] = {
    **{f"dcon {row['name']}": row for row in rows("dcon_commands")},
    **{f"rtu {row['name']}": row for row in (*rows("modbus_functions"), *rows("module_settings"))},
}


def protocol_of(kind: Any) -> str:
    return "rtu" if issubclass(kind, modbus.Message) else "dcon"


def explained(run: Run, *arguments: str) -> list[Record]:
    result = run(*arguments, "--json")
    assert (result.code, result.err) == (0, "")
    return result.records


# --- commands ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: f"{protocol_of(kind)}-{kind.__name__}")
def test_a_command_is_explained_with_what_the_tables_say(run: Run, kind: Any) -> None:
    (record,) = explained(run, "commands", kind.__name__, "--protocol", protocol_of(kind))

    row = ROWS[f"{protocol_of(kind)} {kind.__name__}"]
    assert [row[key] for key in ("section", "description", "models")] == [
        record[key] for key in ("section", "description", "models")
    ]
    assert row["errata"] == [erratum["id"] for erratum in record["errata_explained"]]
    assert row.get("pause") == record["pause"]
    stated = {field["name"]: field["meaning"] for field in row.get("fields", [])}
    assert stated.items() <= {field["name"]: field["meaning"] for field in record["parameters"]}.items()


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: f"{protocol_of(kind)}-{kind.__name__}")
def test_a_command_has_an_example_that_is_accepted(run: Run, kind: Any) -> None:
    (record,) = explained(run, "commands", kind.__name__, "--protocol", protocol_of(kind))

    side = "request" if protocol_of(kind) == "rtu" else "command"
    assert record["examples"]
    assert {kind.__name__} == {example[side]["type"] for example in record["examples"]}
    answers = {example["response"] and example["response"]["type"] for example in record["examples"]}
    assert {record["response"]} == answers


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: f"{protocol_of(kind)}-{kind.__name__}")
def test_an_explanation_fits_the_terminal(run: Run, kind: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    lines = run("commands", kind.__name__, "--protocol", protocol_of(kind)).out.splitlines()

    assert lines[0].startswith(f"{kind.__name__}: {kind.title}, ")
    assert [line for line in lines[1:] if len(line) > 80 and " -> " not in line and len(line.split()) > 4] == []


@pytest.mark.parametrize(
    ("name", "found"),
    [
        ("ReadConfiguration", ["ReadConfiguration"]),
        ("read-configuration", ["ReadConfiguration"]),
        ("read configuration", ["ReadConfiguration"]),
        ("Configuration", ["ReadConfiguration"]),
        ("$AA2", ["ReadConfiguration"]),
        ("$012", ["ReadConfiguration"]),
        ("#**", ["SynchronizedSampling"]),
        ("$AAA", ["ReadAnalogInputsHex", "ReadCjcUpdate"]),
        ("2.10", ["ReadConfiguration"]),
        ("3.3.11", ["SetMiscellaneousSettings"]),
        ("46 2A", ["SetMiscellaneousSettings"]),
        ("46 2a...", ["SetMiscellaneousSettings"]),
        ("46h 2Ah", ["SetMiscellaneousSettings"]),
        ("0x46 0x2A", ["SetMiscellaneousSettings"]),
        ("46 2A settings", ["SetMiscellaneousSettings"]),
        ("03", ["ReadHoldingRegisters"]),
        ("ReadCoils", ["ReadCoils"]),
        ("SetCjcOffset", ["SetCjcOffset", "SetCjcOffset"]),
    ],
)
def test_a_command_is_found_by_what_people_know_of_it(run: Run, name: str, found: list[str]) -> None:
    assert found == [record["name"] for record in explained(run, "commands", name)]


def test_the_protocol_chooses_among_commands_of_one_name(run: Run) -> None:
    records = [explained(run, "commands", "SetCjcOffset", "--protocol", protocol) for protocol in ("dcon", "rtu")]

    assert [[record["section"] for record in found] for found in records] == [["2.18"], ["3.3.13"]]


@pytest.mark.parametrize(("name", "count"), [("46", 17), ("3.3", 17), ("3.4", 6), ("Acknowledged", 22)])
def test_what_means_many_commands_lists_them(run: Run, name: str, count: int) -> None:
    lines = run("commands", name).out.splitlines()

    assert count == len(lines)
    assert all(line.startswith(("2.", "3.")) for line in lines)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("ReadConfig", "there is no command 'ReadConfig'; did you mean ReadConfiguration?\n"),
        ("ReadConfigurtion", "did you mean ReadConfiguration"),
        ("$AA8", "did you mean $AA8Ci?\n"),
        ("2.99 --protocol dcon", "there is no command in section 2.99: those of DCON are 2.1 to 2.43\n"),
        ("9.9", "there is no command in section 9.9: those of DCON are 2.1 to 2.43, those of Modbus are 3.1 to 3.4\n"),
        ("xyzzy", "there is no command 'xyzzy': give a name, a syntax such as $AA2, a function such as 46 2A, or"),
        ("setcjc", "'setcjc'; did you mean SetCjcOffset, SetCjcUpdate or SetCjcEnabled?\n"),
        ("47", "there is no command '47'"),
        ("Set", "there is no command 'Set'; did you mean SetTypeCode, "),
        ("ReadCoils --protocol dcon", "ReadCoils is a Modbus command: use --protocol rtu\n"),
        ("ReadCoils --model I-7018", "I-7018 has no ReadCoils: M-7000 series only; M-7017 series and "),
        ("$AA2 --protocol rtu", "$AA2 is a DCON command: use --protocol dcon\n"),
        ("ReadCjcUpdate --model I-7018", "has no ReadCjcUpdate: 7019 series only, in Modbus M-7019 series only\n"),
    ],
)  # fmt: skip
def test_a_command_that_there_is_not_is_refused_with_what_is_near(run: Run, arguments: str, message: str) -> None:
    result = run("commands", *arguments.split())

    assert message in result.err
    assert (result.code, result.out) == (2, "")


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        ("2.1", "  command        %AANNTTCCFF"),
        ("2.1", "    NN           new_address: 0..255; address from now on"),
        ("2.1", "  or             ?AA  Refused"),
        ("2.1", "  refused        %0101000A00 -> ?01"),
        ("2.1", "                 115200 baud is refused: no INIT. (I-7018; manual)"),
        ("2.2", "  response       none: it is for all modules"),
        ("2.2", "  pause          0.002 s before the next command"),
        ("2.2", "  example        #** -> no response"),
        ("2.8", "  pause          16 s until done, firmware up to B2.6"),
        ("2.11", "    (Data)       temperature: -9999.9..9999.9 degC; sign and five digits"),
        ("2.18 --protocol dcon", "    SNNNN        offset: -4096..4096 counts of 0.01 degC; sign and"),
        ("2.39", "    VV           timeout: 0..255 counts of 0.1 s"),
        ("2.10", "  example        $012B7 -> !01050640B1"),
        ("2.15", "  models         7017Z, 7018Z, 7019 series, "),
        ("3.3.13", "  request        46 2C channel offset:2"),
        ("WriteMultipleCoils", "  broadcast      to address 0: all modules do it, none answers"),
        ("WriteMultipleCoils", "                 values: 1 to 1968 items"),
        ("WriteMultipleCoils", "                 01: the module does not have the function"),
        ("ReadCoils", "  example        01 01 01 00 00 01 FC 36 -> 01 01 01 01 90 48"),
    ],
)  # fmt: skip
def test_an_explanation_has_labelled_lines(run: Run, arguments: str, line: str) -> None:
    lines = run("commands", *arguments.split()).out.splitlines()

    assert [it for it in lines if it.startswith(line)]


def test_a_byte_of_settings_is_explained_by_its_parts(run: Run) -> None:
    (record,) = explained(run, "commands", "SetConfiguration")

    values = {field["name"]: field["values"] for field in record["parameters"]}
    assert (values["line_settings"]["0A"], values["line_settings"]["80"]) == ("115200 baud", "added for E81")
    assert (values["report_settings"]["02"], values["report_settings"]["40"]) == ("hex", "added for a checksum")
    assert values["address"] == {}


def test_an_erratum_is_shown_once(run: Run) -> None:
    out = run("commands", "SetCjcOffset").out

    assert out.count("The CJC offset of DCON is a sign and an") == 1
    assert "\n  E85            see above\n" in out
    assert "\n\nSetCjcOffset: CJC offset, Modbus RTU (manual 3.3.13)\n" in out


# --- registers --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("model", [model for model in Model if model.value.startswith("M")])
def test_every_register_of_a_model_is_explained_with_its_row(run: Run, model: Model) -> None:
    registers = modbus.RegisterMap(Profile(model))
    for name in {row.name for row in registers}:
        records = explained(run, "registers", name, "--model", model.value)

        assert [row.number for row in registers if row.name == name] == [record["number"] for record in records]
        assert all(record["meaning"] and record["models"] == [model.value] for record in records)


@pytest.mark.parametrize(
    ("name", "numbers"),
    [
        ("host_watchdog_timeout", ["40489"]),
        ("Host-Watchdog-Timeout", ["40489"]),
        ("40489", ["40489"]),
        ("488", ["40489"]),
        ("1E8h", ["40489"]),
        ("40355", ["40353"]),
        ("00257", ["00257"]),
        ("cjc_temperature", ["30129", "40129"]),
    ],
)
def test_a_register_is_found_by_name_number_or_address(run: Run, name: str, numbers: list[str]) -> None:
    assert numbers == [record["number"] for record in explained(run, "registers", name, "--model", "M-7019R")]


def test_models_with_the_same_row_are_shown_together(run: Run) -> None:
    records = explained(run, "registers", "cjc_offset")

    assert [tuple(record["models"]) for record in records] == [
        ("M-7018", "M-7018R"),
        ("M-7018Z",),
        ("M-7018-16",),
        ("M-7019R",),
        ("M-7019Z",),
    ]


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        ("host_watchdog_timeout", "host_watchdog_timeout: 40489 (manual 3.4.8)"),
        ("host_watchdog_timeout", "  address        488"),
        ("host_watchdog_timeout", "  access         R/W, by function 03 06 10"),
        ("host_watchdog_timeout", "  unit           0.1 s a count"),
        ("host_watchdog_timeout", "  range          0..25.5 s, counts 0..255"),
        ("40353", "cjc_offset: 40353..40360 (manual 3.4.8)"),
        ("40353", "  address        352..359"),
        ("firmware_version", "  access         R, by function 03"),
        ("load_factory_calibration", "  access         W, by function 05 0F"),
        ("protocol", "                 1: Modbus RTU"),
        ("host_watchdog_timed_out", "  writing        only 1, which clears it"),
        ("response_delay", "  range          0..30"),
    ],
)
def test_an_explained_register_has_labelled_lines(run: Run, arguments: str, line: str) -> None:
    lines = run("registers", arguments, "--model", "M-7019R").out.splitlines()

    assert line in lines


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("foo", "there is no register 'foo': give a name, a number such as 40489, or an address such as 488\n"),
        ("watchdog", "did you mean host_watchdog_enabled, host_watchdog_mode, host_"),
        ("host_watchdg_timeout", "did you mean host_watchdog_timeout, host_"),
        ("49999", "there is no register 49999; the nearest is 41001 log_records\n"),
        ("40999 --model M-7018", "M-7018 has no register 40999; the nearest is 40492 host_watchdog_timeout_count\n"),
        ("40001 --model M-7018 --firmware A1.0", "M-7018 has no register 40001, and no other holding register\n"),
        ("440002", "there is no register 440002; the nearest is 41001 log_records\n"),
        ("9999", "at address 9999: the last address is 1107; numbers of the manual have five digits, such as 40489\n"),
        ("cjc_offset --model M-7017", "M-7017 has no register 'cjc_offset': give a name, "),
        ("", "give --model to list its registers, or a register to explain, such as i7000 registers 40489\n"),
    ],
)
def test_a_register_that_there_is_not_is_refused_with_what_is_near(run: Run, arguments: str, message: str) -> None:
    result = run("registers", *arguments.split())

    assert message in result.err
    assert (result.code, result.out) == (2, "")


def test_explained_registers_have_an_empty_line_between_them(run: Run) -> None:
    out = run("registers", "response_delay").out

    assert [block.partition(" (")[0] for block in out.split("\n\n")] == ["response_delay: 40488"] * 2


# --- errata -----------------------------------------------------------------------------------------------------------


def test_all_errata_are_listed_as_in_the_file(run: Run) -> None:
    assert rows("errata") == explained(run, "errata")


def test_an_erratum_is_listed_with_what_it_is_about(run: Run) -> None:
    assert "  E02  2.41      The syntax line of the section names the command ~AAEEN.\n" in run("errata").out


@pytest.mark.parametrize(
    ("name", "ids"),
    [("E24", ["E24"]), ("e24", ["E24"]), ("E1", ["E01"]), ("2.40", ["E01"]), ("set-connecting-mode", ["E03"])],
)
def test_an_erratum_is_found_by_id_section_or_command(run: Run, name: str, ids: list[str]) -> None:
    assert ids == [record["id"] for record in explained(run, "errata", name)][:1]


@pytest.mark.parametrize(
    ("name", "line"),
    [
        ("E24", "E24 (manual 2, 2.3, 2.4, 2.11, 2.12, 2.19)"),
        ("E24", "  reading        No address behind >, except in the response of $AA4."),
        ("E31", "  assumption     the manual does not support the reading, or a part of it, by itself"),
        ("E31", "  used by        tables/settings.json, ReadHostWatchdogStatus, device"),
    ],
)
def test_an_erratum_is_explained(run: Run, name: str, line: str) -> None:
    assert line in run("errata", name).out.splitlines()


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("E999", "there is no erratum E999: the ids are E01 to E140\n"),
        ("9.9", "there is no erratum about section 9.9\n"),
        ("SetCjc", "'SetCjc'; did you mean SetCjcEnabled, SetCjcOffset or SetCjcUpdate?\n"),
        ("xyzzy", "'xyzzy': give an id such as E24, a section such as 2.11, or a command\n"),
        ("", "there is no erratum '': give an id"),
    ],
)
def test_an_erratum_that_there_is_not_is_refused(run: Run, name: str, message: str) -> None:
    result = run("errata", name)

    assert message in result.err
    assert (result.code, result.out) == (2, "")


@pytest.mark.parametrize("command", ["commands", "registers"])
def test_an_empty_name_is_refused_like_any_other(run: Run, command: str) -> None:
    result = run(command, "")

    assert f"there is no {command.removesuffix('s')} '': give a name" in result.err
    assert (result.code, result.out) == (2, "")


def test_a_number_of_six_digits_is_one_of_the_manual(run: Run) -> None:
    assert explained(run, "registers", "400489") == explained(run, "registers", "40489")
