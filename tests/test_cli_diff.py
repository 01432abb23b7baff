"""``i7000 diff``: a module and a file, and two files."""

from pathlib import Path

import pytest

from i7000 import Model, Protocol, TypeCode
from i7000.cli.diff import Compared, compare
from i7000.host.procedures import Snapshot
from i7000.simulator.faults import Faults
from i7000.simulator.simulator import Simulated
from tests.each import each
from tests.simulator.running import module
from tests.terminal import Run
from tests.workbench import DEAD, EVERY_MODULE, Bench, changed

OVEN = Snapshot(Model.I_7018, settings={"type_code": "K", "baud_rate": 9600, "host_watchdog_timeout": 2.5})
OTHER = Snapshot(Model.I_7018, settings={"type_code": "J", "baud_rate": 19200, "host_watchdog_timeout": 2.5})


def written(folder: Path, name: str, snapshot: Snapshot) -> str:
    (folder / name).write_text(snapshot.to_json())
    return str(folder / name)


@each("simulated", EVERY_MODULE)
def test_every_module_is_the_same_as_its_backup_until_it_is_changed(
    simulated: Simulated, workbench: Bench, tmp_path: Path
) -> None:
    bench = workbench(simulated)
    path = str(tmp_path / f"{simulated.eeprom.model.value}-{simulated.eeprom.protocol.name}.json")
    assert bench("backup", path).code == 0

    same = bench("diff", path)
    assert (same.code, same.out, same.err.splitlines()[-1]) == (0, "", "i7000: no differences")

    name = changed(simulated.eeprom.protocol)
    assert bench("set", name).code == 0
    assert (bench("diff", path).code, bench("diff", path).out.count("\n")) == (1, 2)

    assert bench("restore", path, "--yes").code == 0
    assert bench("diff", path).code == 0
    assert bench.eeprom == simulated.eeprom


def test_what_differs_is_a_table_with_units_and_hazards(workbench: Bench, tmp_path: Path) -> None:
    told = workbench(module(Model.I_7018))("diff", written(tmp_path, "a.json", OTHER))

    assert told.out == (
        "setting                module  file\n"
        "baud_rate              9600    19200  could lose the module\n"
        "host_watchdog_timeout  0 s     2.5 s\n"
        "type_code              V_2_5   J\n"
    )
    assert told.code == 1


def test_what_differs_is_json(run: Run, tmp_path: Path) -> None:
    told = run("diff", written(tmp_path, "a.json", OVEN), written(tmp_path, "b.json", OTHER), "--json")

    assert told.records == [
        {"record": "difference", "name": "baud_rate", "first": 9600, "second": 19200, "hazard": "loses"},
        {"record": "difference", "name": "type_code", "first": "K", "second": "J", "hazard": "plain"},
    ]
    assert told.code == 1


def test_two_files_can_be_the_same(run: Run, tmp_path: Path) -> None:
    told = run("diff", written(tmp_path, "a.json", OVEN), "-", stdin=OVEN.to_json().encode())

    assert (told.code, told.out, told.err) == (0, "", "i7000: no differences\n")


def test_what_only_one_has_is_reported_and_does_not_count(run: Run, tmp_path: Path) -> None:
    more = Snapshot(Model.I_7018, settings={"channel_mask": (0, 1, 2, 5), **dict(OVEN.settings)})

    told = run("diff", written(tmp_path, "a.json", OVEN), written(tmp_path, "b.json", more))

    assert (told.code, told.out) == (0, "")
    assert (
        told.err
        == "i7000: not compared, as only one of them has it: channel_mask\ni7000: no differences in what both have\n"
    )


def test_another_model_is_a_difference(run: Run, tmp_path: Path) -> None:
    one, other = (Snapshot(model, settings={"filter": "reject_50_hz"}) for model in (Model.I_7018, Model.I_7018R))

    told = run("diff", written(tmp_path, "a.json", one), written(tmp_path, "b.json", other))

    assert (told.code, told.out) == (1, "")
    assert "the model differs: I-7018 and I-7018R" in told.err


def test_what_could_not_be_read_counts(run: Run, tmp_path: Path) -> None:
    less = Snapshot(Model.I_7018, settings=dict(OVEN.settings[1:]), unread={"baud_rate": "no answer"})

    told = run("diff", written(tmp_path, "a.json", less), written(tmp_path, "b.json", OVEN))

    assert (told.code, told.err) == (1, "i7000: baud_rate could not be read: no answer\n")


def test_another_model_and_firmware_are_reported(run: Run, tmp_path: Path) -> None:
    other = Snapshot(Model.M_7018, "B4.5", settings=dict(OVEN.settings))

    told = run("diff", written(tmp_path, "a.json", OVEN), written(tmp_path, "b.json", other))

    assert told.err.splitlines()[:2] == [
        "i7000: the model differs: I-7018 and M-7018",
        "i7000: the firmware differs: unknown and B4.5",
    ]


def test_a_module_that_can_be_several_is_taken_for_that_of_the_file(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(module(Model.M_7018))
    assert bench("backup", str(tmp_path / "a.json"), "--model", "M-7018").code == 0

    told = bench("diff", str(tmp_path / "a.json"))

    assert "differs" not in told.err
    assert told.code == 0


def test_a_file_of_the_other_protocol_is_compared_in_what_both_have(workbench: Bench, tmp_path: Path) -> None:
    types = (TypeCode.K,) * 8
    by_modbus = workbench(module(Model.M_7019R, protocol=Protocol.MODBUS_RTU, type_codes=types))
    assert by_modbus("backup", str(tmp_path / "a.json")).code == 0

    told = workbench(module(Model.M_7019R, type_codes=types))("diff", str(tmp_path / "a.json"))

    assert told.out.splitlines()[1:] == ["protocol  dcon    rtu   could lose the module"]
    assert "not compared, as only one of them has it: checksum, cjc_offset.0-7, data_format, " in told.err
    assert told.code == 1


def test_a_module_that_stops_answering_is_not_compared(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(module(Model.I_7018))
    seen: list[bytes] = []

    def look(wire: bytes) -> None:
        seen.append(wire)
        if seen.count(b"$01F\r") > 1:
            bench.port.faults = DEAD

    bench.port.before_write = look
    told = bench("diff", written(tmp_path, "a.json", OVEN))

    assert (told.code, told.out) == (3, "")
    assert told.err.splitlines()[-1].endswith("stopped answering")


def test_a_line_with_faults_that_retries_mend_shows_no_difference(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(module(Model.M_7019R, protocol=Protocol.MODBUS_RTU))
    assert bench("backup", str(tmp_path / "a.json")).code == 0

    bench.port.faults = Faults(silent=0.1, late=0.1, duplicate=0.1, noise=0.1)
    told = bench("diff", str(tmp_path / "a.json"), "--retries", "8")

    assert (told.code, told.out) == (0, "")


@pytest.mark.parametrize("file", ["nothing.json", "."])
def test_a_file_that_cannot_be_read_is_reported_before_the_module_is_asked(run: Run, file: str) -> None:
    told = run("diff", "nowhere", file)

    assert (told.code, told.err.count("\n")) == (2, 1)
    assert file in told.err


def test_equal_snapshots_have_no_changes() -> None:
    assert compare(OVEN, OVEN) == Compared((), (), ())
