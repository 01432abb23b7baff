"""``i7000 backup``: what it writes, and what it never does."""

import json
import os
import stat
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from i7000 import BaudRate, CharacterFormat, LineSettings, Model, Protocol, ReportSettings
from i7000.cli.snapshot_file import read_snapshot, write_new
from i7000.cli.words import UsageError
from i7000.host.procedures import Snapshot
from i7000.simulator.faults import Faults
from i7000.simulator.simulator import Simulated
from tests.each import each
from tests.simulator.running import module
from tests.terminal import Run
from tests.workbench import DEAD, EVERY_MODULE, Bench

KELVIN = "sim:M-7019R,type=K"


@each("simulated", EVERY_MODULE)
def test_every_module_is_saved_without_its_model(simulated: Simulated, workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(simulated)
    path = tmp_path / f"{simulated.eeprom.model.value}-{simulated.eeprom.protocol.name}.json"

    told = bench("backup", str(path))

    taken = Snapshot.from_json(path.read_bytes())
    assert (told.code, told.out, taken.unread) == (0, "", ())
    assert taken.model.series == simulated.eeprom.model.series
    assert taken["address"] == 1
    assert taken.protocol is simulated.eeprom.protocol
    assert bench.eeprom == simulated.eeprom
    assert f"{path} has {len(taken.settings)} settings of {taken.model.value} at address 01\n" in told.err


@pytest.mark.parametrize(
    ("simulated", "arguments"),
    [
        (module(Model.I_7018, report_settings=ReportSettings(checksum=True)), ()),
        (module(Model.I_7018, report_settings=ReportSettings(checksum=True)), ("--checksum", "--protocol", "dcon")),
        (module(Model.M_7019R, line_settings=LineSettings(BaudRate.BAUD_38400, CharacterFormat.E81)),
         ("--baud", "38400", "--character-format", "E81")),
        (module(Model.M_7019R, protocol=Protocol.MODBUS_RTU, line_settings=LineSettings(BaudRate.BAUD_115200)),
         ("--baud", "115200", "--protocol", "rtu", "--model", "M-7019R")),
        (module(Model.M_7018, address=0x1F), ("--address", "1Fh", "--model", "M-7018")),
        (module(Model.M_7018, address=5), ("--model", "5=M-7018,protocol=dcon")),
    ],
)  # fmt: skip
def test_a_module_is_saved_on_any_line(
    simulated: Simulated, arguments: tuple[str, ...], workbench: Bench, tmp_path: Path
) -> None:
    path = tmp_path / "module.json"

    told = workbench(simulated)("backup", str(path), *arguments)

    taken = Snapshot.from_json(path.read_bytes())
    assert (told.code, taken["address"]) == (0, simulated.eeprom.address)
    assert str(taken["baud_rate"]) in (*arguments, "9600")


def test_a_module_in_init_mode_is_saved_with_its_stored_settings(workbench: Bench, tmp_path: Path) -> None:
    stored = LineSettings(BaudRate.BAUD_115200)
    bench = workbench(module(Model.M_7019R, init_switch=True, address=9, line_settings=stored))

    told = bench("backup", str(tmp_path / "module.json"), "--address", "0")

    taken = Snapshot.from_json((tmp_path / "module.json").read_bytes())
    assert (told.code, taken["address"], taken["baud_rate"]) == (0, 9, 115200)


def test_the_file_can_be_standard_output(run: Run) -> None:
    told = run("backup", KELVIN, "-")

    assert Snapshot.from_json(told.out).to_json() == told.out
    assert told.code == 0


def test_an_existing_file_is_never_overwritten_and_the_module_not_asked(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "module.json"
    path.write_text("mine")

    told = run("backup", "nowhere", str(path))

    assert (told.code, told.err) == (2, f"i7000: {path} exists: give the name of a new file\n")
    assert path.read_text() == "mine"


def test_a_link_to_nothing_is_an_existing_file(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "module.json"
    path.symlink_to(tmp_path / "elsewhere")

    assert run("backup", KELVIN, str(path)).code == 2
    assert not (tmp_path / "elsewhere").exists()


def test_a_file_without_a_folder_is_refused_at_once(run: Run, tmp_path: Path) -> None:
    told = run("backup", KELVIN, str(tmp_path / "no" / "module.json"))

    assert (told.code, f"there is no folder {tmp_path / 'no'}\n" in told.err) == (2, True)


def test_what_could_not_be_read_is_reported_and_noted_with_its_reason(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(module(Model.I_7018))

    def look(wire: bytes) -> None:
        bench.port.faults = Faults(silent=1.0) if wire == b"$016\r" else Faults()

    bench.port.before_write = look
    told = bench("backup", str(tmp_path / "module.json"))

    taken = Snapshot.from_json((tmp_path / "module.json").read_bytes())
    reason = "no answer, although the module answers other commands"
    assert dict(taken.unread) == {"channel_mask": reason}
    assert told.err.splitlines()[-1] == f"i7000: channel_mask could not be read: {reason}"
    assert told.code == 1


def test_a_module_that_does_not_answer_function_46h_is_saved_by_its_registers(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(module(Model.M_7019R, protocol=Protocol.MODBUS_RTU))

    def look(wire: bytes) -> None:
        bench.port.faults = Faults(silent=1.0) if wire[1] == 0x46 else Faults()

    bench.port.before_write = look
    told = bench("backup", str(tmp_path / "a.json"), "--model", "M-7019R", "--retries", "0")

    taken = Snapshot.from_json((tmp_path / "a.json").read_bytes())
    assert (told.code, {name for name, _ in taken.unread}) == (1, {"channel_mask", "firmware", "name"})
    assert taken["address"] == 1


def test_a_module_that_does_not_answer_leaves_no_file(run: Run, tmp_path: Path) -> None:
    told = run("backup", "sim:I-7018,address=3", str(tmp_path / "module.json"))

    assert (told.code, [*tmp_path.iterdir()]) == (3, [])
    assert "address 01 does not answer: nothing came" in told.err


def test_a_module_that_stops_answering_leaves_no_file(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(module(Model.I_7018))
    seen: list[bytes] = []

    def look(wire: bytes) -> None:
        seen.append(wire)
        if seen.count(b"$01F\r") > 1:
            bench.port.faults = DEAD

    bench.port.before_write = look
    told = bench("backup", str(tmp_path / "module.json"))

    assert (told.code, [*tmp_path.iterdir()]) == (3, [])
    assert told.err.splitlines()[-1].endswith("stopped answering: nothing is saved")


def test_another_product_is_refused_unless_model_is_given(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(module(Model.I_7018, name="7012D"))

    told = bench("backup", str(tmp_path / "a.json"))
    given = bench("backup", str(tmp_path / "b.json"), "--model", "I-7018")

    assert (told.code, given.code) == (2, 0)
    assert told.err == "i7000: address 01: 7012D is the name of another product: give --model\n"
    assert [it.name for it in tmp_path.iterdir()] == ["b.json"]


def test_what_is_given_and_does_not_fit_the_module_is_refused(run: Run) -> None:
    told = run("backup", "sim:I-7018,name=OVEN", "-", "--type", "V_5")

    assert (told.code, told.out) == (2, "")
    assert "address 01: what is given does not fit the module: " in told.err


def test_what_the_model_has_and_the_module_not_is_reported_by_its_reason(run: Run) -> None:
    told = run("backup", "sim:I-7018", "-", "--model", "M-7017Z", "--single-ended")

    reason = "could not be read: no answer, although the module answers other commands"
    assert f"i7000: protocol, single_ended, type_code.0-19 {reason}" in told.err.splitlines()
    assert "i7000: channel_mask could not be read: the answer is not understood" in told.err.splitlines()
    assert told.code == 1


def test_several_modules_of_model_need_an_address(run: Run) -> None:
    told = run("backup", KELVIN, "-", "--model", "1=M-7019R", "--model", "2=I-7018")

    assert (told.code, told.err) == (2, "i7000: --model describes several modules: give the --address of one\n")


# --- files ------------------------------------------------------------------------------------------------------------


def test_a_file_is_written_whole_and_nothing_else_stays(tmp_path: Path) -> None:
    write_new(str(tmp_path / "a.json"), "text\n")

    assert [it.name for it in tmp_path.iterdir()] == ["a.json"]
    assert (tmp_path / "a.json").read_text() == "text\n"


@pytest.mark.parametrize("links", [True, False])
def test_a_file_that_came_meanwhile_is_not_overwritten(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, *, links: bool
) -> None:
    path = tmp_path / "a.json"
    path.write_text("mine")
    if not links:
        monkeypatch.setattr(os, "link", no_links)

    with pytest.raises(UsageError, match="exists"):
        write_new(str(path), "text\n")
    assert [(it.name, it.read_text()) for it in tmp_path.iterdir()] == [("a.json", "mine")]


def no_links(*_: Any) -> None:
    raise PermissionError


def test_a_file_system_without_hard_links_will_do(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "link", no_links)

    write_new(str(tmp_path / "a.json"), "text\n")

    assert [(it.name, it.read_text()) for it in tmp_path.iterdir()] == [("a.json", "text\n")]


def test_a_file_has_the_mode_that_the_user_wants_for_new_ones(tmp_path: Path) -> None:
    write_new(str(tmp_path / "a.json"), "text\n")
    (tmp_path / "b.json").touch()

    modes = [stat.S_IMODE((tmp_path / name).stat().st_mode) for name in ("a.json", "b.json")]
    assert modes[0] == modes[1]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "this is not a snapshot"),
        ("[]", "this is not a snapshot: it is not an object; give a file of i7000 backup"),
        ("[]", "it is not an object"),
        ("{}", "missing"),
        ("x" * (1 << 21), "more than 1048576 bytes"),
    ],
)
def test_a_file_that_is_no_snapshot_is_refused(tmp_path: Path, text: str, words: str) -> None:
    (tmp_path / "a.json").write_text(text)

    with pytest.raises(UsageError) as refused:
        read_snapshot(str(tmp_path / "a.json"))
    assert words in str(refused.value)
    assert str(refused.value).startswith(f"{tmp_path / 'a.json'}: ")


def test_a_file_of_another_version_is_refused(tmp_path: Path) -> None:
    document = json.loads(Snapshot(Model.I_7018).to_json()) | {"schema_version": 2}
    (tmp_path / "a.json").write_text(json.dumps(document))

    with pytest.raises(UsageError, match="schema_version cannot be 2"):
        read_snapshot(str(tmp_path / "a.json"))


def test_without_a_standard_input_nothing_is_read_from_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", None)

    with pytest.raises(UsageError, match="no standard input"):
        read_snapshot("-")


SCRIPT = """
import sys
sys.modules["serial"] = None
from i7000.cli import main
sys.exit(main(sys.argv[1:]))
"""


@pytest.mark.parametrize(
    "arguments",
    [
        ("backup", "sim:I-7018", "-"),
        ("diff", "sim:I-7018", "FILE"),
        ("restore", "sim:I-7018", "FILE", "--yes"),
        ("set", "sim:I-7018", "name=OVEN"),
        ("send", "sim:I-7018", "ReadConfiguration", "address=1"),
    ],
    ids=lambda arguments: arguments[0],
)
def test_without_pyserial_its_extra_is_named(arguments: tuple[str, ...], tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    path.write_text(Snapshot(Model.I_7018).to_json())
    given = [str(path) if it == "FILE" else it for it in arguments]

    told = subprocess.run([sys.executable, "-c", SCRIPT, *given], capture_output=True, text=True, check=False)  # noqa: S603

    assert told.stderr == 'i7000: no module serial; this needs: pip install "i7000[serial]"\n'
    assert told.returncode == 2
