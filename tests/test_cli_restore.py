"""``i7000 restore``: what is written, what is left alone, and how it ends."""

import os
import signal
from pathlib import Path
from typing import Any

import pytest
from attrs import evolve

from i7000 import BaudRate, LineSettings, Model, Protocol, TypeCode
from i7000.cli.snapshot_file import read_snapshot
from i7000.cli.text import Printer
from i7000.host.procedures import Snapshot
from i7000.simulator.faults import Faults
from tests.simulator.running import module
from tests.terminal import Run
from tests.workbench import DEAD, Bench, Workbench

KELVIN = module(Model.M_7019R, type_codes=(TypeCode.K,) * 8)
SETTINGS: dict[str, Any] = {"host_watchdog_timeout": 2.5, "name": "OVEN", "type_code.0": "J", "type_code.1": "J"}


def file(folder: Path, model: Model = Model.M_7019R, **settings: Any) -> str:
    path = folder / "wanted.json"
    path.write_text(Snapshot(model, settings=settings or SETTINGS).to_json())
    return str(path)


OVEN: dict[str, Any] = {
    "host_watchdog_timeout": 25,
    "name": "OVEN",
    "type_codes": (TypeCode.J,) * 2 + (TypeCode.K,) * 6,
}


def test_what_would_change_is_shown_and_then_what_became_of_it(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(KELVIN)

    told = bench("restore", file(tmp_path), "--yes")

    assert told.out.splitlines() == [
        "setting                now    restored",
        "host_watchdog_timeout  0 s    2.5 s",
        "name                   7019R  OVEN",
        "type_code.0            K      J",
        "type_code.1            K      J",
        f"{'type_code.0':<24} {'K -> J':<24} done",
        f"{'type_code.1':<24} {'K -> J':<24} done",
        f"{'name':<24} {'7019R -> OVEN':<24} done",
        f"{'host_watchdog_timeout':<24} {'0 s -> 2.5 s':<24} done",
    ]
    assert (told.code, bench.eeprom) == (0, evolve(KELVIN.eeprom, **OVEN))


def test_what_is_so_already_is_not_asked_about(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(KELVIN)
    path = file(tmp_path)
    assert bench("restore", path, "--yes").code == 0

    told = bench("restore", path, "--yes")

    assert (told.code, told.out) == (0, "")
    assert told.err.splitlines()[-1] == "i7000: nothing to change: M-7019R at address 01 has all these values"


def test_only_what_is_named_is_restored(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(KELVIN)

    told = bench("restore", file(tmp_path), "type_code", "name", "--yes", "--json")

    assert [(it["name"], it["status"]) for it in told.records] == [
        ("type_code.0", "done"), ("type_code.1", "done"), ("name", "done"),
    ]  # fmt: skip
    assert bench.eeprom == evolve(KELVIN.eeprom, name="OVEN", type_codes=OVEN["type_codes"])


def test_what_could_lose_the_module_is_left_alone_unless_it_is_named(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(KELVIN)
    path = file(tmp_path, address=5, baud_rate=19200, name="OVEN")

    left = bench("restore", path, "--yes")
    named = bench("restore", path, "address", "--yes")

    assert "i7000: not restored unless you name it, as it could lose the module: address, baud_rate\n" in left.err
    assert named.err.splitlines()[-1] == "i7000: the module now has address 05"
    assert (left.code, named.code) == (0, 0)
    assert bench.eeprom == evolve(KELVIN.eeprom, name="OVEN", address=5)


def test_a_module_that_got_another_baud_rate_is_followed(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(KELVIN)

    told = bench("restore", file(tmp_path, baud_rate=19200, checksum=True), "baud_rate", "checksum", "--yes")

    assert told.err.splitlines()[-1] == "i7000: the module now has 19200 N81, a checksum"
    assert (told.code, bench.eeprom.line_settings.baud_rate) == (0, BaudRate.BAUD_19200)


def test_settings_are_restored_in_init_mode(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(
        module(Model.I_7018, init_switch=True, address=3, line_settings=LineSettings(BaudRate.BAUD_115200))
    )

    told = bench("restore", file(tmp_path, Model.I_7018, baud_rate=9600), "baud_rate", "--address", "0", "--yes")

    assert told.out.endswith("pending: in use from the next power-on\n")
    assert (told.code, bench.eeprom.address, bench.eeprom.line_settings) == (0, 3, LineSettings())


def test_calibration_is_never_touched(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(module(Model.M_7019R, protocol=Protocol.MODBUS_RTU))
    written: list[bytes] = []
    bench.port.before_write = written.append
    path = str(tmp_path / "a.json")
    assert bench("backup", path).code == 0
    assert bench("set", "type_code=J", "response_delay=3").code == 0

    assert bench("restore", path, "--yes").code == 0
    assert not any(wire[1] in (0x05, 0x0F) and wire[2:4] == b"\x01\x0f" for wire in written)


# --- another model ----------------------------------------------------------------------------------------------------


def test_a_file_of_another_model_is_refused(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(KELVIN)

    path = file(tmp_path, Model.I_7017, name="OVEN", filter="reject_50_hz")

    told = bench("restore", path, "--yes")

    words = f"{path} is of I-7017, the module is M-7019R: name the settings to restore"
    assert told.err.splitlines()[-1] == f"i7000: {words}"
    assert (told.code, bench.eeprom) == (2, KELVIN.eeprom)


def test_named_settings_of_a_file_of_another_model_are_restored(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(KELVIN)

    told = bench("restore", file(tmp_path, Model.I_7017, name="OVEN", type_code="V_10"), "name", "type_code", "--yes")

    assert told.out.splitlines()[-1].endswith("skipped: M-7019R with firmware B4.5 has no setting type_code")
    assert (told.code, bench.eeprom) == (1, evolve(KELVIN.eeprom, name="OVEN"))


def test_a_module_that_can_be_several_is_taken_for_that_of_the_file(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(module(Model.M_7018))

    told = bench("restore", file(tmp_path, Model.M_7018, name="OVEN"), "--yes")

    assert (told.code, bench.eeprom.name) == (0, "OVEN")


# --- questions --------------------------------------------------------------------------------------------------------


def test_without_a_terminal_yes_is_needed(run: Run, tmp_path: Path) -> None:
    told = run("restore", "nowhere", file(tmp_path))

    assert told.err == ("i7000: restoring changes the module; there is no terminal to ask you at: give --yes\n")
    assert told.code == 2


@pytest.mark.usefixtures("answered")
@pytest.mark.parametrize(("answer", "name", "code"), [(b"y\n", "OVEN", 0), (b"no\n", "7019R", 1)])
def test_you_are_asked_after_what_would_change_is_shown(
    answer: bytes, name: str, code: int, workbench: Bench, tmp_path: Path
) -> None:
    bench = workbench(KELVIN)

    told = bench("restore", file(tmp_path), stdin=answer)

    assert "Change these settings of M-7019R at address 01? [y/N] " in told.err
    assert (told.code, bench.eeprom.name) == (code, name)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("filter",), "the snapshot has no setting 'filter'"),
        (("--address", "x"), "--address x"),
    ],
)
def test_wrong_usage_is_reported_before_the_module_is_asked(
    arguments: tuple[str, ...], message: str, run: Run, tmp_path: Path
) -> None:
    told = run("restore", "nowhere", file(tmp_path), *arguments, "--yes")

    assert (told.code, message in told.err, told.err.count("\n")) == (2, True, 1)


# --- ends in the middle -----------------------------------------------------------------------------------------------


def test_a_module_that_stops_answering_before_the_change_is_not_changed(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(KELVIN)
    seen: list[bytes] = []

    def look(wire: bytes) -> None:
        seen.append(wire)
        if seen.count(b"$01F\r") > 1:
            bench.port.faults = DEAD

    bench.port.before_write = look
    told = bench("restore", file(tmp_path), "--yes")

    assert told.err.splitlines()[-1].endswith("stopped answering: nothing was changed")
    assert (told.code, bench.eeprom) == (3, KELVIN.eeprom)


@pytest.mark.parametrize("before", [True, False])
def test_a_module_that_loses_power_while_it_is_written_is_in_doubt(
    workbench: Bench, tmp_path: Path, *, before: bool
) -> None:
    bench = workbench(KELVIN)
    bench.lose_power(lambda wire: wire.startswith(b"~01O"), before=before)

    told = bench("restore", file(tmp_path), "--yes", "--retries", "0")

    assert told.out.splitlines()[-2:] == [
        f"{'name':<24} {'7019R -> OVEN':<24} in doubt: no answer to the command; it may have either value",
        f"{'host_watchdog_timeout':<24} {'- -> 2.5 s':<24} unread: the module does not answer",
    ]
    assert (told.code, bench.eeprom.name) == (6, "7019R" if before else "OVEN")


@pytest.mark.parametrize(
    ("wire", "time", "words"),
    [
        (b"~01OOVEN\r", 1, "in doubt: name may have the old value or the new one"),
        (b"~012\r", 2, "the port is gone: type_code.0-1, name was changed before"),
    ],
)
def test_a_port_that_is_lost_in_the_middle_leaves_the_module_changed(
    wire: bytes, time: int, words: str, workbench: Bench, tmp_path: Path
) -> None:
    bench = workbench(KELVIN)
    lose_port(bench, wire, time)

    told = bench("restore", file(tmp_path), "--yes")

    assert told.err.splitlines()[-1].endswith(words)
    assert told.code == 6


def test_a_port_that_is_lost_before_the_first_change_is_a_lost_port(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(KELVIN)
    lose_port(bench, b"$018C0\r", 3)

    told = bench("restore", file(tmp_path), "--yes")

    assert told.err.splitlines()[-1].endswith("the port is gone")
    assert (told.code, bench.eeprom) == (3, KELVIN.eeprom)


def lose_port(bench: Workbench, wire: bytes, time: int) -> None:
    """Lose the port when something is sent for the first, second, ... time."""
    seen: list[bytes] = []

    def look(sent: bytes) -> None:
        seen.append(sent)
        if seen.count(wire) == time:
            raise OSError("the port is gone")

    bench.port.before_write = look


def test_an_output_that_nobody_reads_any_more_leaves_the_module_changed(
    workbench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    bench = workbench(KELVIN)

    def closed(*_: object) -> None:
        raise BrokenPipeError("nobody reads")

    monkeypatch.setattr(Printer, "record", closed)
    told = bench("restore", file(tmp_path), "--yes")

    assert told.err.splitlines()[-1] == "i7000: nobody reads: type_code.0 was changed before"
    assert told.code == 6


# --- Ctrl-C -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_stops_after_the_setting_at_hand(number: int, code: int, workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(KELVIN)
    bench.port.before_write = lambda wire: os.kill(os.getpid(), number) if wire.startswith(b"~01O") else None

    told = bench("restore", file(tmp_path), "--yes")

    assert told.err.splitlines()[-1] == "i7000: stopped: type_code.0-1, name was changed before"
    assert bench.eeprom == evolve(KELVIN.eeprom, name="OVEN", type_codes=OVEN["type_codes"])
    assert told.code == code


def test_a_signal_during_the_last_setting_is_not_lost(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(KELVIN)
    bench.port.before_write = lambda wire: os.kill(os.getpid(), signal.SIGINT) if wire.startswith(b"~01O") else None

    told = bench("restore", file(tmp_path, name="OVEN"), "--yes")

    assert (told.code, bench.eeprom.name) == (130, "OVEN")
    assert told.err.splitlines()[-1] == "i7000: stopped: name was changed before"


def test_a_second_signal_leaves_the_setting_at_hand_in_doubt(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(KELVIN)

    def look(wire: bytes) -> None:
        if wire.startswith(b"~01O"):
            os.kill(os.getpid(), signal.SIGINT)
            os.kill(os.getpid(), signal.SIGINT)

    bench.port.before_write = look
    told = bench("restore", file(tmp_path), "--yes")

    assert told.err.splitlines()[-2:] == [
        "i7000: stopped: type_code.0-1 was changed before",
        "i7000: in doubt: name may have the old value or the new one",
    ]
    assert told.code == 6


def test_a_signal_while_the_module_is_identified_breaks_off_at_once(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(KELVIN)
    bench.port.before_write = lambda wire: os.kill(os.getpid(), signal.SIGINT) if wire == b"$01F\r" else None

    told = bench("restore", file(tmp_path), "--yes")

    assert (told.code, told.out, bench.eeprom) == (130, "", KELVIN.eeprom)


def test_a_restore_on_a_line_with_faults_that_retries_mend_is_complete(workbench: Bench, tmp_path: Path) -> None:
    bench = workbench(module(Model.M_7019R, protocol=Protocol.MODBUS_RTU))
    path = str(tmp_path / "a.json")
    assert bench("backup", path).code == 0
    assert bench("set", "type_code=J", "response_delay=3").code == 0
    bench.port.faults = Faults(silent=0.1, late=0.1, duplicate=0.1, noise=0.05)

    told = bench("restore", path, "--yes", "--retries", "8")

    bench.port.faults = Faults()
    assert (told.code, bench("diff", path).code) == (0, 0)
    assert read_snapshot(path)["response_delay"] == 0
